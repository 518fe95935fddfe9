"""A shaft of a drive as a mass on a spring, and what it does: against the uniform beam in closed form."""

import math
from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, InputError
from cardan.drive.body import weight
from cardan.drive.machine import RunUp
from cardan.drive.shaft import PointMass, Shaft, ShaftCrack, Unbalance
from cardan.formulas.crack_compliance import crack_compliance
from cardan.io import example
from cardan.questions.bending.cracked_rotor import cracked_rotor
from cardan.questions.bending.line_whirl import line_whirl
from cardan.questions.bending.rotor import joined_rotors, rotor, rotor_response, rotor_run
from cardan.units import deg, mm, rpm

LENGTH = 1.5
G = 9.80665


def beam(joint_angle=5 * deg, **more):
    """Return a drive of one long thin bar between two joints: the beam of the textbooks."""
    drive = Drive.from_angles([joint_angle, joint_angle])
    bar = Shaft(number=2, length=LENGTH, outer=0.03, **more)
    return replace(drive, shafts=(bar,), duty=replace(drive.duty, speed=1000.0 * rpm))


def test_a_uniform_shaft_is_half_its_mass_and_sags_as_its_first_mode():
    """φ = sin πx/L: M = m/2, and the push of the weight over M is g 2/π / (1/2)."""
    drive = beam()
    found = rotor(drive)
    mass = weight(drive.shafts[1], LENGTH).mass
    assert found.mass == pytest.approx(0.5 * mass, rel=1e-3)  # Timoshenko's shape, sums over pieces
    assert found.gravity == pytest.approx(4.0 / math.pi * G, rel=5e-3)  # the shaft slopes by 5°, cos 5° = 0.996
    area, second = math.pi * 0.03**2 / 4.0, math.pi * 0.03**4 / 64.0
    euler = (math.pi / LENGTH) ** 2 * math.sqrt(2.06e11 * second / (7850.0 * area))
    assert found.critical == pytest.approx(euler, rel=2e-3)
    assert found.sag == pytest.approx(found.gravity / euler**2, rel=5e-3)


def test_unbalances_count_by_where_they_sit_and_look():
    quarter = Unbalance(position=0.25 * LENGTH, amount=2e-5)
    middle = Unbalance(position=0.5 * LENGTH, amount=1e-5, angle=90 * deg)
    found = rotor(beam(unbalance=(quarter, middle)))
    along, across = 2e-5 * math.sin(0.25 * math.pi), 1e-5
    assert found.unbalance == pytest.approx(math.hypot(along, across), rel=1e-3)
    assert found.unbalance_angle == pytest.approx(math.atan2(across, along), rel=1e-3)
    assert "shafts[1].unbalance" not in found.assumed


@pytest.mark.slow
def test_a_lump_amid_the_shaft_adds_its_whole_mass():
    lump = PointMass(position=0.5 * LENGTH, mass=3.0)
    bare, laden = rotor(beam()), rotor(beam(masses=(lump,)))
    assert laden.mass == pytest.approx(bare.mass + 3.0, rel=1e-2)  # the shape moves a little
    assert laden.stiffness == pytest.approx(bare.stiffness, rel=1e-2)


@pytest.mark.slow
def test_the_response_is_that_of_the_cracked_rotor():
    crack = ShaftCrack(losses=(0.2, 0.05), breathing=2, angle=30 * deg)
    drive = beam(crack=crack, unbalance=(Unbalance(position=0.5 * LENGTH, amount=5e-5, angle=70 * deg),))
    one = rotor(drive)
    speed = one.critical * np.asarray([0.3, 0.7])
    found = rotor_response(drive, speed=speed)
    same = cracked_rotor(
        one.mass, one.stiffness, speed, crack=one.crack, damping_ratio=0.02, unbalance=5e-5,
        unbalance_phase=40 * deg, gravity=one.gravity,
    )  # fmt: skip
    np.testing.assert_allclose(found.steady.amplitude, same.amplitude, rtol=1e-3, atol=1e-12)
    assert one.crack.breathing == 2
    assert one.crack.losses == (0.2, 0.05)


def test_a_crack_swells_order_2_at_half_and_order_3_at_a_third_of_the_critical_speed():
    found = rotor_response(beam(crack=ShaftCrack(losses=(0.1, 0.02))), speed=None)
    found = replace(found, used=None)
    critical = found.rotor.critical
    for order in (2, 3):
        speed, size = found.peak(order)
        # A crack makes the shaft a little softer, and losses of a tenth by a twentieth slower at most.
        assert 0.95 / order < speed / critical < 1.0 / order
        assert size > 3.0 * float(found.steady.order_amplitude(order)[0])


@pytest.mark.parametrize("place", [0.5, 0.2])
@pytest.mark.parametrize("wall", [None, 2 * mm])
def test_a_crack_by_its_depth_is_a_hinge_in_the_first_mode(place, wall):
    """φ = sin πx/L bends with EI (π/L)² sin πx/L over the stiffness EI π⁴/2L³: a hinge c takes 2cEI/L sin² πx/L."""
    crack = ShaftCrack(depth_ratio=0.8, position=place * LENGTH)
    inner = 0.0 if wall is None else 0.03 - 2.0 * wall
    found = rotor(beam(crack=crack, wall=wall))
    second = math.pi * (0.03**4 - inner**4) / 64.0
    hinge = crack_compliance(0.015, 0.8, 2.06e11, inner=0.5 * inner)
    for loss, compliance in zip(found.crack.losses, (hinge.along, hinge.across), strict=True):
        softer = 2.0 * float(compliance) * 2.06e11 * second / LENGTH * math.sin(math.pi * place) ** 2
        assert loss == pytest.approx(softer / (1.0 + softer), rel=4e-3)


def test_one_shaft_and_the_whole_line_count_the_same_crack():
    crack = ShaftCrack(depth_ratio=0.8, position=0.5 * LENGTH)
    drive = beam(0.0, crack=crack, unbalance=(Unbalance(position=0.5 * LENGTH, amount=1e-9),))
    critical = rotor(drive).critical
    alone = rotor_response(drive, speed=[0.45 * critical])
    line = line_whirl(drive, speed=[0.45 * critical], damping_ratio=0.02)
    for order in (1, 2, -1):
        here = float(np.max(np.abs(line.deflection[0, line.order == order])))
        assert here == pytest.approx(float(alone.steady.order_amplitude(order)[0]), rel=0.2), order  # the kink


@pytest.mark.slow
def test_a_deep_crack_makes_whirling_unstable_with_half_orders():
    found = rotor_response(beam(crack=ShaftCrack(losses=(0.446, 0.1))), damping_ratio=0.002, speed=None)
    critical = found.rotor.critical
    assert any(low / critical < 0.9 < high / critical for low, high in found.unstable)  # as the article's rotor
    upper = rotor_response(beam(crack=ShaftCrack(losses=(0.446, 0.1))), damping_ratio=0.002, speed=1.9 * critical)
    assert upper.steady.half_order.tolist() == [True]


def test_the_worst_shaft_is_taken_unless_one_is_asked_for():
    drive = example("truck-supports")
    bent = tuple(
        replace(one, unbalance=(Unbalance(position=0.1, amount=one.number * 1e-5),)) if one.number in (2, 3) else one
        for one in drive.shafts
    )
    assert rotor(replace(drive, shafts=bent)).shaft == 3
    broken = (*bent[:1], replace(bent[1], crack=ShaftCrack(losses=(0.1, 0.02))), *bent[2:])
    assert rotor(replace(drive, shafts=broken)).shaft == 2
    assert rotor(replace(drive, shafts=broken), 3).shaft == 3


def test_behind_a_joint_the_unbalance_has_odd_orders():
    behind = rotor_response(beam(20 * deg), speed=100.0).behind
    tau = math.tan(10 * deg) ** 2
    assert behind.size[list(behind.order).index(3)] == pytest.approx(4.5 * tau, rel=0.05)  # first order in τ


@pytest.mark.slow
def test_a_run_up_follows_the_duty():
    drive = beam(crack=ShaftCrack(losses=(0.1, 0.02)))
    critical = rotor(drive).critical
    course = RunUp(start=0.4 * critical, end=0.6 * critical, duration=2.0)
    one, run = rotor_run(replace(drive, duty=replace(drive.duty, run_up=course)))
    assert one.critical == pytest.approx(critical)
    speed, order, size = run.orders()
    twice = np.abs(size[:, order == 2])[:, 0]
    assert speed[np.argmax(twice)] / critical == pytest.approx(0.51, abs=0.02)  # late by the rate of the run
    with pytest.raises(InputError, match=r"duty\.run_up"):
        rotor_run(drive)


@pytest.mark.slow
def test_two_shafts_joined_shake_each_with_its_own_orders():
    drive = example("truck-supports")
    cracked = replace(drive.shafts[1], crack=ShaftCrack(losses=(0.2, 0.05)))
    drive = replace(drive, shafts=(drive.shafts[0], cracked, *drive.shafts[2:]))
    first, second, found = joined_rotors(drive, 2, speed=150.0, turns=6.0)
    assert (first.shaft, second.shaft) == (2, 3)
    assert found.residual < 1e-6  # account of energy
    order, size = found.orders(0, turns=2)
    assert abs(size[order == 0][0]) == pytest.approx(first.sag, rel=0.2)  # a crack lets it sag more


@pytest.mark.parametrize(
    ("options", "field"),
    [({"shaft": 9}, "shaft"), ({"shaft": 1}, "shaft"), ({"damping_ratio": 1.0}, "damping_ratio")],
)
def test_what_cannot_be_is_refused(options, field):
    with pytest.raises(InputError) as caught:
        rotor_response(beam(), **options)
    assert caught.value.field == field


@pytest.mark.parametrize(
    ("crack", "field"),
    [
        (ShaftCrack(), "shafts[1].crack"),
        (ShaftCrack(losses=(0.1, 0.1), depth_ratio=0.1), "shafts[1].crack"),
        (ShaftCrack(losses=(0.1,)), "shafts[1].crack.losses"),
        (ShaftCrack(losses=(0.1, 1.0)), "shafts[1].crack.losses"),
    ],
)
def test_a_crack_that_contradicts_itself_is_refused(crack, field):
    with pytest.raises(InputError) as caught:
        beam(crack=crack)
    assert caught.value.field == field
    with pytest.raises(InputError, match=r"shafts\[1\]\.crack\.depth_ratio: is more than 1"):
        rotor(beam(crack=ShaftCrack(depth_ratio=1.2)))
