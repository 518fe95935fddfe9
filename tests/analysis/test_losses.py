from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cardan import Drive, InputError
from cardan.analysis.chain_friction import chain_friction
from cardan.analysis.friction import Turning, joint_friction
from cardan.analysis.loss_model import mean_powers, powers
from cardan.analysis.loss_parts import counted, model_of
from cardan.analysis.losses import loss_map, losses
from cardan.drive.cross import Cross
from cardan.drive.duty import Duty, Harmonic
from cardan.drive.joints import Hooke
from cardan.drive.movement import Harmonic as Swing
from cardan.drive.shaft import Shaft, Spline
from cardan.drive.support import Support
from cardan.units import deg, mm, rpm
from tests.builders.drives import plans

CROSS = Cross(span=80 * mm, journal=20 * mm)
STEADY = Duty(speed=3000 * rpm, torque=200.0)


def rubbing(drive, friction=0.1, **parts):
    """Return a drive whose joints rub, κ = a quarter of the friction."""
    joints = tuple(replace(joint, friction=friction, cross=CROSS) for joint in drive.joints)
    return replace(drive, joints=joints, **parts)


def single(bend=30 * deg, friction=0.1, **parts):
    return rubbing(Drive.from_points([[-0.4, 0, 0], [0, 0, 0], [np.cos(bend), 0, -np.sin(bend)]]), friction, **parts)


@given(plans(most=4), st.sampled_from(["output", "input"]), st.sampled_from([1, -1]), st.sampled_from([1, -1]))
def test_without_masses_it_is_the_friction_of_the_chain_whichever_way_it_runs(plan, at, turning, pulling):
    duty = Duty(speed=turning * 100.0, torque=pulling * 50.0, torque_at=at)
    found = losses(rubbing(plan.drive), duty)
    chain = chain_friction(plan.drive, [0.025] * len(plan.bends), torque_at=at, backwards=turning != pulling)
    assert found.efficiency == pytest.approx(float(chain.efficiency), rel=1e-13)
    assert np.allclose(found.driving_pins, 5000 * chain.driving_loss, rtol=0, atol=1e-10)
    assert np.allclose(found.driven_pins, 5000 * chain.driven_loss, rtol=0, atol=1e-10)
    assert np.sign(found.input_power) == turning * pulling
    assert found.residual < 1e-13
    assert found.first_order == pytest.approx(float(chain.first_order), rel=1e-14)


def loaded(plan, seed):
    """Return a drive with inertia, resisting torques and a torque that swings through zero."""
    random = np.random.default_rng(seed)
    shafts = tuple(
        Shaft(
            number=k + 1, yoke_angle=shaft.yoke_angle, inertia=random.uniform(0, 0.05), resisting_torque=random.normal()
        )
        for k, shaft in enumerate(plan.drive.shafts)
    )
    duty = Duty(
        speed=random.choice([-1, 1]) * random.uniform(50, 300),
        torque=random.normal() * 20,
        torque_at=random.choice(["output", "input"]),
        acceleration=random.normal() * 100,
        harmonics=(Harmonic(order=2, torque=30.0, phase=0.4), Harmonic(order=0.5, torque=5.0)),
    )
    return rubbing(plan.drive, shafts=shafts), duty


@settings(max_examples=20)
@given(plans(most=4), st.integers(0, 2**32 - 1))
def test_power_balances_with_masses_and_swinging_torque(plan, seed):
    drive, duty = loaded(plan, seed)
    found = losses(drive, duty)
    assert found.residual < 1e-12
    heat = found.input_power - found.output_power - np.sum(found.resisting) - np.sum(found.storing)
    assert found.heat == pytest.approx(heat, abs=1e-12 * max(abs(found.input_power), abs(found.output_power)))


@settings(max_examples=8)
@given(plans(most=3), st.integers(0, 2**32 - 1))
def test_means_are_those_of_many_places(plan, seed):
    drive, duty = loaded(plan, seed)
    model = model_of(drive, duty, counted(drive, duty, None)[0])
    assert model.turns == 2
    many = powers(model, (np.arange(40_000) + 0.5) * (4 * np.pi / 40_000))
    mean = mean_powers(model)
    size = float(np.max(np.abs(many.input)))
    # Each of some tens of kinks is missed by the square of the step, 1e-8, times a slope of order one.
    for name in ("input", "output", "driving", "driven", "resisting", "storing"):
        assert np.allclose(getattr(mean, name), np.mean(getattr(many, name), axis=-1), rtol=0, atol=3e-8 * size), name


def book_layout(friction, bend=30 * deg):
    """Both shafts in two bearings each, the cross free to slide along its journals: forces as in Book (106), (107)."""
    supports = tuple(
        Support(shaft=shaft, position=place, axial=place == -0.35, bore=40 * mm, friction=friction)
        for shaft, place in ((1, -0.05), (1, -0.35), (2, 0.1), (2, 0.4))
    )
    free = single(bend, friction=0.0, supports=supports)
    joint = replace(free.joints[0], cross=replace(CROSS, slides=True))
    return replace(free, joints=(joint,))


@pytest.mark.parametrize("at", ["output", "input"])
def test_supports_heat_by_load_times_turning(at):
    """A hair's breadth of friction in bearings 0.3 m apart: the closed form of Book (128)-(132)."""
    tiny = 1e-8
    found = losses(book_layout(tiny), replace(STEADY, torque_at=at))
    rule = joint_friction(30 * deg, 0.0, bearing_drag=tiny * 0.04 / 0.3, torque_at=at)
    assert np.sum(found.supports) == pytest.approx(float(rule.bearing_work) * 200 * 3000 * rpm / (2 * np.pi), rel=1e-7)
    assert found.supports[0] == pytest.approx(found.supports[1], rel=1e-9)
    assert found.supports[2] == pytest.approx(found.supports[3], rel=1e-9)


def test_supports_and_torques_are_in_balance_with_one_another():
    drive = book_layout(0.05)
    drive = replace(drive, joints=(replace(drive.joints[0], friction=0.1),))
    found = losses(drive, STEADY)
    assert found.residual < 1e-12
    assert np.all(found.supports > 0)
    alone = losses(book_layout(0.0), STEADY), losses(single(), STEADY)
    assert alone[0].efficiency == pytest.approx(1.0, abs=1e-15)
    together = float(np.sum(found.supports)) + float(np.sum(found.joints))
    apart = float(np.sum(losses(book_layout(0.05), STEADY).supports) + np.sum(alone[1].joints))
    # Each rubs on what the other adds: more than the sum, by the product of both shares.
    assert apart < together < apart * 1.01


def test_weight_heats_supports_without_torque():
    """Two bearings of a shaft of 10 kg midway carry 49 N each; the joint's torque is nought."""
    supports = (
        Support(shaft=1, position=-0.1, bore=40 * mm, friction=0.01),
        Support(shaft=1, position=-0.3, axial=True, bore=40 * mm, friction=0.01),
        Support(shaft=2, position=0.5),
    )
    heavy = Shaft(number=1, mass=10.0, centre_of_mass=-0.2)
    found = losses(single(supports=supports, shafts=(heavy,)), replace(STEADY, torque=0.0))
    want = 0.01 * 0.02 * 5 * 9.80665 * 3000 * rpm
    assert found.supports[:2] == pytest.approx([want, want], rel=1e-12)
    assert found.input_power == pytest.approx(2 * want, rel=1e-3)
    assert found.efficiency == 0.0


TEETH = Spline(friction=0.12, mean_diameter=50 * mm, pressure_angle=30 * deg)


def sliding(spline=TEETH):
    points = [[-0.4, 0, 0], [0, 0, 0], [1, 0, 0], [1.4, 0, 0]]
    drive = rubbing(Drive.from_points(points), shafts=(Shaft(number=2, spline=spline),))
    swing = Swing(moves=("joints[1]", "output"), amplitude=(0.02, 0.0, 0.0), frequency=2 * np.pi * 3.0)
    return drive, swing


def test_a_spline_heats_by_thrust_times_way():
    drive, swing = sliding()
    found = losses(drive, STEADY, movement=swing)
    way = 4 * 0.02 * 3.0  # of a swing of 20 mm, three times a second
    want = 2 * 0.12 / np.cos(30 * deg) * 200.0 / 0.05 * way
    assert found.splines == pytest.approx([0, want, 0], rel=1e-6)
    assert found.residual < 1e-13, "what moves the drive pays for its splines"
    assert found.efficiency == pytest.approx(found.output_power / (found.input_power + want), rel=1e-6)
    assert losses(replace(drive, movements=(swing,)), STEADY).splines == pytest.approx(found.splines)


def fields(parts):
    return [one.field for one in parts]


def test_what_is_left_out_is_named_with_its_key():
    drive, _swing = sliding()
    assert fields(losses(drive, STEADY).uncounted) == ["supports", "movements"]
    assert fields(losses(sliding(Spline(teeth=16))[0], STEADY).uncounted) == ["supports", "shafts[1].spline.friction"]
    joints = (Hooke(bend=0.1, friction=0.1, cross=CROSS), Hooke(bend=0.1), Hooke(bend=0.1, friction=0.1))
    assert fields(losses(Drive(joints=joints), STEADY).uncounted) == [
        "joints[1].friction",
        "joints[2].cross.span",
        "supports",
    ]
    partly = (Hooke(bend=0.1, friction=0.1, cross=Cross(span=0.1)), Hooke(bend=0.1, friction=0.1, cross=CROSS))
    assert fields(losses(Drive(joints=partly), STEADY).uncounted) == ["joints[0].cross.journal", "supports"]


@pytest.mark.parametrize(
    ("supports", "say"),
    [
        ([(1, -0.1, False)], "leave the drive"),
        ([(1, -0.1, True), (1, -0.3, True), (2, 0.1, True), (2, 0.4, False)], "more than balance"),
    ],
)
def test_supports_that_balance_cannot_tell_apart_are_left_out(supports, say):
    held = tuple(
        Support(shaft=shaft, position=place, axial=axial, bore=0.04, friction=0.01) for shaft, place, axial in supports
    )
    found = losses(single(supports=held), STEADY)
    assert fields(found.uncounted) == ["supports"]
    assert say in found.uncounted[0].message
    assert np.all(found.supports == 0)


def test_a_drive_of_which_nothing_rubs_is_told_what_to_add():
    with pytest.raises(InputError) as caught:
        losses(Drive.from_angles([0.1, 0.2]), Duty())
    assert [problem.field for problem in caught.value.problems] == [
        "duty.speed",
        "duty.torque",
        "joints[0].friction",
        "joints[1].friction",
        "supports",
    ]
    with pytest.raises(InputError, match="standstill"):
        losses(single(), Duty(speed=0.0, torque=1.0))


def test_a_joint_that_locks_is_a_status():
    found = losses(single(80 * deg, friction=1.0), STEADY)
    assert found.status == Turning.LOCKED
    assert found.locked == (1,)
    assert np.isnan(found.efficiency)
    assert losses(single(), STEADY).status == Turning.FREE
    with pytest.raises(InputError, match="joint 1 locks"):
        loss_map(single(80 * deg, friction=1.0, duty=STEADY))


def test_the_duty_of_the_drive_counts_where_none_is_given():
    assert losses(single(duty=STEADY)).heat == losses(single(), STEADY).heat


def test_a_map_holds_what_single_answers_say():
    supports = book_layout(0.03).supports
    drive = single(supports=supports, shafts=(Shaft(number=2, inertia=0.02),))
    drive = replace(drive, joints=(replace(drive.joints[0], cross=replace(CROSS, slides=True)),))
    speeds, torques = np.asarray([-100.0, 50.0, 400.0]), np.asarray([-30.0, 5.0, 200.0])
    found = loss_map(drive, speeds, torques)
    for i, speed in enumerate(speeds):
        for k, torque in enumerate(torques):
            one = losses(drive, Duty(speed=float(speed), torque=float(torque)))
            assert found.efficiency[i, k] == pytest.approx(one.efficiency, rel=1e-9)
            assert found.heat[i, k] == pytest.approx(one.heat, rel=1e-9)
            assert found.supports[i, k] == pytest.approx(one.supports, rel=1e-9)


def test_a_map_of_journals_alone_is_flat_and_has_axes_of_its_own():
    found = loss_map(single(duty=STEADY))
    assert found.efficiency.shape == (15, 15)
    assert np.ptp(found.efficiency) < 1e-14
    assert found.speed[-1] == pytest.approx(1.5 * 3000 * rpm)
    with pytest.raises(InputError) as caught:
        loss_map(single())
    assert [problem.field for problem in caught.value.problems] == ["duty.speed", "duty.torque"]
    with pytest.raises(InputError, match="standstill"):
        loss_map(single(duty=STEADY), [0.0, 1.0])
