from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cardan import InputError, example, motion
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.drive.duty import Duty
from cardan.drive.shaft import Shaft
from cardan.drive.support import Support
from cardan.formulas.friction import Turning, joint_friction
from cardan.questions.forces.forces import forces
from cardan.questions.losses.answer import answer
from cardan.questions.losses.chain_friction import chain_friction
from cardan.questions.losses.losses import loss_map, losses
from cardan.units import deg, mm, rpm
from tests.builders.drives import plans
from tests.builders.rubbing import CROSS, STEADY, book_layout, loaded, rubbing, single, sliding


@pytest.mark.slow
@given(plans(most=4), st.sampled_from(["output", "input"]), st.sampled_from([1, -1]), st.sampled_from([1, -1]))
def test_without_masses_it_is_the_friction_of_the_chain_whichever_way_it_runs(plan, at, turning, pulling):
    duty = Duty(speed=turning * 100.0, torque=pulling * 50.0, torque_at=at)
    found = losses(rubbing(plan.drive), duty)
    chain = chain_friction(plan.drive, [0.025] * len(plan.joint_angles), torque_at=at, backwards=turning != pulling)
    assert found.efficiency == pytest.approx(float(chain.efficiency), rel=1e-13)
    assert np.allclose(found.driving_pins, 5000 * chain.driving_loss, rtol=0, atol=1e-10)
    assert np.allclose(found.driven_pins, 5000 * chain.driven_loss, rtol=0, atol=1e-10)
    assert np.sign(found.input_power) == turning * pulling
    assert found.residual < 1e-13
    assert found.first_order == pytest.approx(float(chain.first_order), rel=1e-14)


@pytest.mark.slow
@settings(max_examples=20)
@given(plans(most=4), st.integers(0, 2**32 - 1))
def test_power_balances_with_masses_and_swinging_torque(plan, seed):
    drive, duty = loaded(plan, seed)
    found = losses(drive, duty)
    assert found.residual < 1e-12
    heat = found.input_power - found.output_power - np.sum(found.resisting) - np.sum(found.storing)
    assert found.heat == pytest.approx(heat, abs=1e-12 * max(abs(found.input_power), abs(found.output_power)))


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


@pytest.mark.slow
def test_a_spline_heats_by_thrust_times_way():
    drive, swing = sliding()
    found = losses(drive, STEADY, movement=swing)
    way = 4 * 0.02 * 3.0  # of a swing of 20 mm, three times a second
    want = 2 * 0.12 / np.cos(30 * deg) * 200.0 / 0.05 * way
    assert found.splines == pytest.approx([0, want, 0], rel=1e-6)
    assert found.residual < 1e-13, "what moves the drive pays for its splines"
    assert found.efficiency == pytest.approx(found.output_power / (found.input_power + want), rel=1e-6)
    assert losses(replace(drive, movements=(swing,)), STEADY).splines == pytest.approx(found.splines)


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
            # Where supports rub a mean rests within 1e-5 between two numbers of places; its error is of the square.
            assert found.efficiency[i, k] == pytest.approx(one.efficiency, rel=1e-8)
            assert found.heat[i, k] == pytest.approx(one.heat, rel=1e-7)
            assert found.supports[i, k] == pytest.approx(one.supports, rel=1e-7)


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


def test_a_centre_bearing_alone_heats_by_its_own_load_while_machines_hold_the_ends():
    """Friction times radius times load times speed of its shaft, the load from the forces; machines rub nothing."""
    shipped = example("pickup-two-piece")
    # the thrust of the spline, which forces count at its worst, either way, is left out
    smooth = (replace(one, spline=one.spline and replace(one.spline, friction=None)) for one in shipped.shafts)
    drive = replace(shipped, shafts=tuple(smooth))
    (bearing,) = drive.supports
    duty = replace(drive.duty, cases=())
    found = losses(drive, duty)
    angle = np.linspace(0.0, 2.0 * np.pi, 720, endpoint=False)
    load = np.linalg.norm(np.asarray(forces(drive, duty, angle).reaction)[0], axis=-1)
    ratio = motion(drive, angle).shaft_ratio[1]
    heat = np.mean(bearing.friction * 0.5 * bearing.bore * load * ratio) * duty.speed
    assert found.supports.shape == (1,)
    # The load is that without the friction of the joints, which changes it by less than a hundredth.
    assert float(found.supports[0]) == pytest.approx(heat, rel=0.01)
    assert loss_map(shipped, [100.0, 200.0], [50.0]).supports.shape == (2, 1, 1)
    said = [told(one.text, USUAL) for one in answer(shipped, losses(shipped)).remarks]
    assert any(text.startswith("Shafts 1 and 4 are held by their machines") for text in said)
