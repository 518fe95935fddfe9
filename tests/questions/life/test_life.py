"""Life of the joints of a drive: against one joint in closed form, plain vectors of a chain, and by hand."""

from dataclasses import replace

import numpy as np
import pytest

from cardan import InputError, forces, motion
from cardan.book.joint_forces import cross_loads
from cardan.drive.cross import Cross
from cardan.drive.drive import Drive
from cardan.drive.duty import Block, Duty, Harmonic, History
from cardan.drive.joint_parts import Needles, Rating
from cardan.drive.joints import Hooke
from cardan.drive.shaft import Shaft
from cardan.formulas.joint_rating import book_life, needle_rating
from cardan.questions.life.bearing_life import bearing_life, maker_life
from cardan.questions.life.duty_cycle import combined_life, equivalent_torque
from cardan.questions.life.life import life
from cardan.questions.life.lives import METHODS
from cardan.units import deg, hour, rpm

P = 10.0 / 3.0
CROSS, NEEDLES = Cross(span=0.08, journal=0.016), Needles(count=22, diameter=2.5e-3, length=14e-3, capacity=20e3)


def joint(joint_angle, **changed):
    return Hooke(**{"joint_angle": joint_angle * deg, "cross": CROSS, "needles": NEEDLES} | changed)


def one(joint_angle=12.0, **changed):
    return Drive(joints=(joint(joint_angle, **changed),))


@pytest.mark.parametrize("torque_at", ["input", "output"])
@pytest.mark.parametrize("joint_angle", [5.0, 30.0])
def test_one_joint_is_the_closed_form(joint_angle, torque_at):
    """Quadrature over the turn against the integral over the swing; both rest at 1e-10 and better."""
    found = life(one(joint_angle), Duty(speed=-1000 * rpm, torque=800.0, torque_at=torque_at))
    exact = bearing_life(20e3, 0.04, 800.0, speed=1000 * rpm, joint_angle=joint_angle * deg, torque_at=torque_at)
    assert found.driving[0, 0] == pytest.approx(exact.driving, rel=1e-9)
    assert found.driven[0, 0] == pytest.approx(exact.driven, rel=1e-9)
    assert found.simple[0, 0] == pytest.approx(exact.simple, rel=1e-9)
    assert found.book[0, 0] == pytest.approx(
        book_life(2080.0, 800.0, speed=1000 * rpm, joint_angle=joint_angle * deg), rel=1e-9
    )
    assert found.torque[0, 0] == pytest.approx(800.0, rel=1e-12)
    assert found.drive == pytest.approx(exact.worst, rel=1e-9)
    assert np.isnan(found.maker[0, 0])


SPATIAL = Drive(
    joints=(joint(12.0), joint(25.0, plane_twist=40 * deg), joint(18.0, plane_twist=-70 * deg)),
    shafts=(Shaft(number=2, yoke_angle=0.3), Shaft(number=3, yoke_angle=-0.5)),
)


def test_a_chain_is_the_sum_of_what_its_forces_and_swings_do():
    """Journal loads of `forces` and turns of the crosses from step to step, added up: the long way round.

    The sum errs with the square of its step, a hundredth of a degree: about 1e-7.
    """
    duty = Duty(speed=100.0, torque=500.0)
    phi = np.linspace(0.0, 2.0 * np.pi, 36_001)
    found, carried = life(SPATIAL, duty), forces(SPATIAL, duty, phi)
    moved, size = motion(SPATIAL, phi), np.linalg.norm(carried.journals.load, axis=-1)
    for swing, journal, lives in ((moved.cross_driving, 0, found.driving), (moved.cross_driven, 2, found.driven)):
        for i in range(3):
            load = size[i, :, journal]
            middle = 0.5 * (load[1:] ** P + load[:-1] ** P)
            damage = np.sum(np.abs(np.diff(swing[i])) * middle) / (2.0 * np.pi) / 20e3**P
            assert lives[0, i] == pytest.approx(1e6 * 2.0 * np.pi / 100.0 / damage, rel=1e-6)
    np.testing.assert_allclose(found.torque, 500.0, rtol=1e-10)


def test_blocks_add_their_damage_by_hand():
    """Each block alone, then 1/Σ(q/L); the torque that does the same lasts as long."""
    blocks = (
        Block(torque=900.0, speed=50.0, share=0.1),
        Block(torque=300.0, speed=200.0, share=0.9, joint_angle=6 * deg),
    )
    drive = one(10.0, rating=Rating(torque=1000.0))
    found = life(drive, Duty(blocks=blocks))
    alone = [
        life(one(joint_angle, rating=Rating(torque=1000.0)), Duty(speed=block.speed, torque=block.torque))
        for block, joint_angle in zip(blocks, (10.0, 6.0), strict=True)
    ]
    for name in ("driving", "driven", "simple", "maker", "book"):
        first, second = (getattr(each, name)[0, 0] for each in alone)
        assert found.combined(getattr(found, name))[0] == pytest.approx(1.0 / (0.1 / first + 0.9 / second), rel=1e-9)
    side = min(found.combined(found.driving)[0], found.combined(found.driven)[0])
    assert found.joints[0] == side
    np.testing.assert_allclose(np.sum(found.damage, axis=0), 1.0)
    assert found.speed_angle[0] == pytest.approx(0.1 * 50 * 10 * deg + 0.9 * 200 * 6 * deg)


def test_a_measured_torque_is_its_equivalent_one():
    """Where torques add no inertia, life goes with the mean of the 10/3rd power, whichever way they act."""
    times, torques = (0.0, 1.0, 1.5, 4.0), (-200.0, 700.0, 100.0, 900.0)
    duty = Duty(speed=100.0, torque_history=History(file="x.csv", times=times, torques=torques))
    found = life(SPATIAL, duty)
    assert found.history is not None
    same = life(SPATIAL, Duty(speed=100.0, torque=found.history.equivalent))
    np.testing.assert_allclose(found.joints, same.joints, rtol=1e-9)
    assert found.cycles is not None
    assert found.cycles.total == 1.5
    np.testing.assert_allclose(found.equivalent_torque, found.history.equivalent, rtol=1e-9)


def test_speeds_measured_beside_a_torque_are_those_of_its_levels():
    """Half the time 400 N·m at 60 rad/s, half 800 N·m at 20 rad/s, either way round: two parts of a duty cycle."""
    times, torques, speeds = (0.0, 10.0, 10.0 + 1e-7, 20.0), (400.0, 400.0, 800.0, 800.0), (60.0, 60.0, -20.0, -20.0)
    history = History(file="x.csv", times=times, torques=torques, speeds=speeds)
    parts = tuple(Block(torque=torque, speed=speed, share=0.5) for torque, speed in ((400.0, 60.0), (800.0, 20.0)))
    found = life(SPATIAL, Duty(speed=100.0, torque_history=history))
    wanted = life(SPATIAL, Duty(speed=100.0, blocks=parts))
    np.testing.assert_allclose(found.joints, wanted.joints, rtol=1e-5)
    held = life(SPATIAL, Duty(speed=100.0, torque_history=replace(history, speeds=())))
    assert np.all(held.joints < 0.9 * found.joints)


def test_shocks_reliability_and_demand():
    duty = Duty(speed=100.0, torque=500.0, life=4000 * hour)
    plain = life(one(), duty)
    hard = life(one(), replace(duty, shock_factor=1.3, reliability=0.99))
    for name in METHODS[:2] + METHODS[3:]:
        assert hard.of(name)[0] == pytest.approx(0.25 * plain.of(name)[0] / 1.3**P, rel=1e-12)
    assert hard.journal_force[0, 0] == pytest.approx(1.3 * plain.journal_force[0, 0])
    assert plain.journal_force[0, 0] == pytest.approx(500.0 / 0.08 / np.cos(12 * deg), rel=1e-9)
    assert (plain.enough, hard.enough) == (bool(plain.drive >= 4000 * hour), bool(hard.drive >= 4000 * hour))
    for found in (plain, hard):
        again = life(one(), Duty(speed=100.0, torque=500.0 * found.torque_margin, life=4000 * hour))
        if found is plain:
            assert again.drive == pytest.approx(4000 * hour, rel=1e-9)
        strong = replace(NEEDLES, capacity=float(found.needed_capacity[0]))
        stronger = life(
            one(needles=strong), replace(duty, shock_factor=found.shock_factor, reliability=found.reliability)
        )
        assert stronger.drive == pytest.approx(4000 * hour, rel=1e-9)
    assert plain.loaded([1.0, 2.0])[1, 0] == pytest.approx(plain.drive / 2.0**P)


def test_makers_ratings_go_by_their_own_convention():
    duty = Duty(speed=100.0, torque=500.0)
    for convention in ("Tc", "CR"):
        found = life(one(rating=Rating(torque=1000.0, convention=convention)), duty)
        case = {"speed": 100.0, "joint_angle": 12 * deg, "convention": convention}
        assert found.maker[0, 0] == pytest.approx(maker_life(1000.0, 500.0, **case), rel=1e-10)
    found = life(one(rating=Rating(torque=1000.0, convention="book")), duty)
    assert np.isnan(found.maker[0, 0])
    assert found.book[0, 0] == pytest.approx(book_life(1000.0, 500.0, speed=100.0, joint_angle=12 * deg), rel=1e-10)


def test_without_capacity_the_makers_rating_governs_and_iso_says_what_it_lacks():
    bare = one(cross=None, needles=None, rating=Rating(torque=1000.0))
    found = life(bare, Duty(speed=100.0, torque=500.0))
    assert found.method == "maker"
    assert [one.field for one in found.uncounted] == ["joints[0].cross.span", "joints[0].needles.capacity"]
    assert found.drive == found.maker[0, 0]
    with pytest.raises(InputError, match="no joint has what iso needs"):
        life(bare, Duty(speed=100.0, torque=500.0), method="iso")
    with pytest.raises(InputError, match="'best' is none of"):
        life(bare, Duty(speed=100.0, torque=500.0), method="best")


def test_capacity_follows_from_the_needles():
    needles = replace(NEEDLES, capacity=None)
    found = life(one(needles=needles), Duty(speed=100.0, torque=500.0))
    assert found.bearings.capacity[0] == pytest.approx(float(needle_rating(22, 2.5e-3, 14e-3, 0.016).dynamic))
    assert "joints[0].needles.capacity" in found.assumed
    with pytest.raises(InputError) as caught:
        life(one(needles=needles, cross=Cross(span=0.08)), Duty(speed=100.0, torque=500.0))
    assert caught.value.field == "joints[0].cross.journal"


@pytest.mark.parametrize(
    ("duty", "fields"),
    [
        (Duty(), ["duty.speed", "duty.torque"]),
        (Duty(speed=0.0, torque=1.0), ["duty.speed"]),
        (Duty(torque_history=History(file="x.csv")), ["duty.speed", "duty.torque_history"]),
    ],
)
def test_what_misses_is_named(duty, fields):
    with pytest.raises(InputError) as caught:
        life(one(), duty)
    assert [problem.field for problem in caught.value.problems] == fields


def test_what_misses_of_the_joints_is_named():
    with pytest.raises(InputError) as caught:
        life(one(cross=None, needles=None), Duty(speed=1.0, torque=1.0))
    assert {problem.code for problem in caught.value.problems} == {"missing"}
    with pytest.raises(InputError, match="friction locks joint 1"):
        life(one(80.0, friction=1.0), Duty(speed=1.0, torque=1.0))


def test_cautions():
    def said(drive, **duty):
        found = life(drive, Duty(**{"speed": 100.0, "torque": 400.0} | duty))
        return [(caution.code, caution.joint) for caution in found.cautions]

    assert said(one(20.0)) == []
    assert said(one(8.0)) == [("small_oscillation", 1)]  # needles meet from 14.4° on
    assert said(one(2.0, needles=Needles(capacity=20e3))) == [("angle_clamped_3deg", 1)]
    assert said(one(0.0, needles=Needles(capacity=20e3)))[0] == ("no_swing", 1)
    assert said(one(20.0), torque=900.0)[0] == ("heavy_load", 1)
    assert said(one(20.0), torque=10.0) == [("extrapolated", 1)]
    assert said(one(20.0), reliability=0.9999) == [("extrapolated", 0)]
    assert np.isinf(life(one(0.0), Duty(speed=1.0, torque=1.0)).drive)
    assert np.isinf(life(one(), Duty(speed=1.0, torque=0.0)).drive)


def test_friction_and_inertia_load_the_joints_more():
    duty = Duty(speed=200.0, torque=300.0)
    light = life(SPATIAL, duty)
    rubbing = tuple(replace(each, friction=0.1) for each in SPATIAL.joints)
    assert np.all(life(replace(SPATIAL, joints=rubbing), duty).joints[:2] < light.joints[:2])
    heavy = replace(SPATIAL, shafts=(*SPATIAL.shafts[:3], Shaft(number=4, inertia=0.5)))
    assert np.all(life(heavy, duty).joints < light.joints)
    swinging = life(SPATIAL, replace(duty, harmonics=(Harmonic(order=0.5, torque=150.0),)))
    assert np.all(swinging.joints < light.joints)


@pytest.mark.parametrize(("torque_at", "shaft"), [("input", 0), ("output", 1)])
def test_the_couple_of_a_shaft_is_order_one_in_it_and_order_two_in_its_housing(torque_at, shaft):
    """Vectors of `forces` in the housing; turned back with the shaft they keep one direction."""
    phi = np.linspace(0.0, 2.0 * np.pi, 64, endpoint=False)
    drive = Drive(joints=(Hooke(joint_angle=25 * deg),))
    whole = 300.0 * np.tan(25 * deg)
    turn = motion(drive, phi).shaft_angle[shaft]
    even = np.linspace(0.0, 2.0 * np.pi, 64, endpoint=False)
    at = phi if shaft == 0 else np.interp(even, np.append(turn, 2.0 * np.pi), np.append(phi, 2.0 * np.pi))
    if shaft:  # angles of the input at which the output has gone evenly on, by Newton's method
        for _round in range(5):
            gone = motion(drive, at)
            at = at - (gone.output_angle - even) / gone.ratio
    couple = forces(drive, Duty(torque=300.0, torque_at=torque_at), at).secondary_couple[shaft]
    axis = np.asarray([1.0, 0.0, 0.0]) if shaft == 0 else np.asarray([np.cos(25 * deg), 0.0, -np.sin(25 * deg)])
    first = np.asarray([0.0, 1.0, 0.0])
    plane = couple @ first + 1j * (couple @ np.cross(axis, first))
    assert np.max(np.abs(couple @ axis)) < 1e-9 * whole
    for course, sizes in (
        (plane, {0: 0.5 * whole, 2: 0.5 * whole}),
        (plane * np.exp(-1j * even), {1: 0.5 * whole, -1: 0.5 * whole}),
    ):
        orders = np.fft.fft(course) / 64
        for order, size in sizes.items():
            assert abs(orders[order]) == pytest.approx(size, rel=1e-9)
            orders[order] = 0.0
        assert np.max(np.abs(orders)) < 1e-9 * whole


def test_formulas_run_on_any_array_library():
    import array_api_strict as strict

    joint_angle, torque = strict.asarray([0.1, 0.4]), strict.asarray([0.0, 500.0])
    case = {"speed": strict.asarray([50.0, 100.0]), "joint_angle": joint_angle}
    plain = {"speed": np.asarray([50.0, 100.0]), "joint_angle": np.asarray([0.1, 0.4])}
    pairs = [
        (
            bearing_life(2e4, 0.04, torque, **case, torque_at="input").worst,
            bearing_life(2e4, 0.04, [0.0, 500.0], **plain, torque_at="input").worst,
        ),
        (book_life(2000.0, torque, **case), book_life(2000.0, [0.0, 500.0], **plain)),
        (
            maker_life(2000.0, torque, **case, convention="CR"),
            maker_life(2000.0, [0.0, 500.0], **plain, convention="CR"),
        ),
        (combined_life(joint_angle, joint_angle), combined_life([0.1, 0.4], [0.1, 0.4])),
        (equivalent_torque(torque, joint_angle), equivalent_torque([0.0, 500.0], [0.1, 0.4])),
        (
            cross_loads(joint_angle, torque, torque, span=strict.asarray(0.1)).journal,
            cross_loads([0.1, 0.4], [0.0, 500.0], [0.0, 500.0], span=0.1).journal,
        ),
    ]
    for one, other in pairs:
        assert one.__array_namespace__() is strict
        np.testing.assert_allclose(np.asarray(one), other, rtol=1e-12)
