"""Torques of a drive that vibrates in torsion, against equations written apart and integrated in time."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cardan import Drive, torsion_response
from cardan.checks import check
from cardan.drive.conditions import LoadCase
from cardan.drive.cross import Cross
from cardan.drive.duty import Duty
from cardan.drive.joint_parts import Needles
from cardan.drive.joints import Hooke
from cardan.drive.machine import HarmonicTorque
from cardan.drive.shaft import Shaft
from cardan.drive.station import Station
from cardan.drive.torsional_layout import has_torsion
from cardan.formulas.joint_rating import POWER
from cardan.questions.forces.turn_loads import case_loads
from cardan.questions.life.life import life
from cardan.questions.torsion.steady.dynamic_torque import dynamic_torque, steady_torque
from cardan.units import deg, mm, rpm
from tests.questions.torsion.steady.test_torsion_response import three_joints

ONE, TWO = 14 * deg, 9 * deg
STIFF, DAMP, INERTIA = 38_400.0, 4.0, 1.0
SPEED, LOAD = 1040 * rpm, 318.0


def drive(**changes):
    """Two joints, a soft shaft without mass between them, a flywheel: order 2 meets its mode at 936 rpm."""
    cross, needles = Cross(span=80 * mm, journal=18 * mm), Needles(capacity=25e3)
    joints = tuple(Hooke(joint_angle=one, cross=cross, needles=needles) for one in (ONE, TWO))
    return replace(
        Drive(joints=joints, shafts=(Shaft(number=2, length=1.0, stiffness=STIFF, damping=DAMP),)),
        stations=(Station(shaft=3, inertia=INERTIA),),
        duty=Duty(speed=SPEED, torque=LOAD),
        **changes,
    )


def law(theta, alpha):
    """Return the angle of a driven yoke and its slope; 0 in the plane of the two shafts."""
    turn = np.arctan2(np.sin(theta), np.cos(theta) * math.cos(alpha))
    angle = turn + 2 * np.pi * np.round((theta - turn) / (2 * np.pi))
    return angle, math.cos(alpha) / (1 - (math.sin(alpha) * np.cos(theta)) ** 2)


def integrated():
    """Return input angle, torque of the soft shaft and the torques that enter both joints, over the last turn.

    One unknown: the flywheel. The shaft's far end is the driving yoke of joint 2, which the flywheel turns back: its
    angle follows from φ_3 = T(φ_2 + ψ) - T(ψ). ψ: the yokes of shaft 2 are in one plane, so φ_2 starts a quarter turn
    behind the driving yoke of joint 1 in the same plane of shafts.
    """
    start = dynamic_torque(drive(), speed=[SPEED]).orbit.model.phase
    psi = [float(one) for one in start]
    zero = [float(law(np.asarray(one), alpha)[0]) for one, alpha in zip(psi, (ONE, TWO), strict=True)]

    def torque(t, q, rate):
        """q is the angle of the driving yoke of joint 2."""
        turned, slope = law(SPEED * t + psi[0], ONE)
        return STIFF * (turned - zero[0] - q) + DAMP * (slope * SPEED - rate)

    def rates(t, state):
        q, rate = state
        _angle, slope = law(q + psi[1], TWO)
        # φ_3 = T(q + ψ): J φ̈_3 = M_3 - load, M_3 = t/T'; φ̈_3 = T' q̈ + T'' q̇²
        bent = -math.cos(TWO) * math.sin(TWO) ** 2 * np.sin(2 * (q + psi[1]))
        second = bent / (1 - (math.sin(TWO) * np.cos(q + psi[1])) ** 2) ** 2
        own = torque(t, q, rate)
        return [rate, ((own / slope - LOAD) / INERTIA - second * rate**2) / slope]

    turn = 2 * np.pi / SPEED
    last = 400 * turn
    times = last + turn * np.arange(720) / 720
    found = solve_ivp(rates, (0.0, times[-1]), [0.0, SPEED], "DOP853", times, rtol=1e-10, atol=1e-10)
    own = np.asarray([torque(t, *state) for t, state in zip(times, found.y.T, strict=True)])
    _angle, slope = law(SPEED * times + psi[0], ONE)
    return SPEED * (times - last), own, own * slope, own


@pytest.fixture(scope="module")
def course():
    return integrated()


@pytest.mark.slow
def test_extremes_are_those_of_an_integration_in_time(course):
    """The shaft has no mass: what it carries enters joint 2, and times T' it enters joint 1."""
    _angle, own, first, _second = course
    (found,) = (steady_torque(drive()),)
    assert found.high[0, 1] == pytest.approx(own.max(), rel=2e-4)
    assert found.low[0, 1] == pytest.approx(own.min(), rel=2e-4)
    assert found.high[0, 0] == pytest.approx(first.max(), rel=2e-4)
    assert own.max() - own.min() > 4 * LOAD  # it does vibrate


@pytest.mark.slow
def test_torques_at_the_joints_follow_the_integration(course):
    angle, own, first, second = course
    entering, leaving = steady_torque(drive()).at_joints(angle)
    size = own.max() - own.min()
    np.testing.assert_allclose(entering[0], [first, second], atol=2e-4 * size)
    np.testing.assert_allclose(leaving[0, 0], own, atol=2e-4 * size)


@pytest.mark.slow
def test_the_life_counts_the_torque_as_it_runs(course):
    """D = (1/2π) ∮ |dδ/dφ| (K/(C d))^(10/3) dφ with the couple of the cross K = M_1 √(1 + tan²α sin²θ), by sums."""
    angle, _own, first, _second = course
    psi = float(dynamic_torque(drive(), speed=[SPEED]).orbit.model.phase[0])
    theta = angle + psi
    couple = np.abs(first) * np.sqrt(1 + (math.tan(ONE) * np.sin(theta)) ** 2)
    tilt = np.arctan(math.tan(ONE) * np.sin(theta))  # swing in the driving yoke
    swing = np.abs(np.gradient(np.concatenate([tilt, tilt[:2]]), angle[1])[1:-1])
    couple = np.concatenate([couple, couple[:1]])[1:]
    damage = np.mean(swing * (couple / (25e3 * 0.08)) ** POWER)
    by_hand = 1e6 / damage * 2 * np.pi / SPEED
    found = life(drive())
    assert found.driving[0, 0] == pytest.approx(by_hand, rel=2e-3)  # differences of 720 places
    assert found.vibration[0] > 1.0
    still = life(replace(drive(), stations=(), shafts=()))
    assert found.driving[0, 0] < 0.1 * still.driving[0, 0]


@pytest.mark.slow
def test_an_order_that_does_not_repeat_counts_as_in_the_response():
    """With its side bands, in the extremes of every shaft: strength must not say less than the response."""
    shaken = replace(drive().duty, torques=(HarmonicTorque(amplitude=40.0, order=3.3, station="output"),))
    asked = replace(drive(), duty=shaken)
    found, runs = steady_torque(asked), torsion_response(asked)
    assert found.high[0, 1] == pytest.approx(float(runs.torque_highest[0]), rel=1e-3)
    assert found.low[0, 1] == pytest.approx(float(runs.torque_lowest[0]), rel=1e-3)
    assert found.high[0, 1] - steady_torque(drive()).high[0, 1] == pytest.approx(float(found.beside[0, 1]), rel=0.05)


@pytest.mark.slow
def test_a_dip_that_the_response_does_not_show_is_no_reversal():
    """Up and down an order that does not repeat moves the torque by unlike amounts: 89 N·m up are no 89 N·m down.

    Shaft 1 ends in a yoke without mass, so that its joint carries what its spring carries: 5.9 to 284 N·m.
    """
    engine = three_joints()
    found, runs = steady_torque(engine), torsion_response(engine)
    assert found.low[0, 0] == pytest.approx(float(runs.torque_lowest[0]), rel=1e-3)
    assert found.high[0, 0] == pytest.approx(float(runs.torque_highest[0]), rel=1e-3)
    assert float(runs.torque_lowest[0]) > 5.0
    assert not [one for one in check(engine, only=["torque_reversal"]) if one.run]


def test_without_masses_the_torques_are_those_of_statics():
    """A stiff line with hardly any inertia carries what its joints make of the load: `turn_loads`."""
    light = replace(
        drive(),
        shafts=(Shaft(number=2, length=1.0, stiffness=1e7, damping=100.0),),
        stations=(Station(shaft=3, inertia=1e-7),),
    )
    found = steady_torque(light)
    plain = case_loads(light, LoadCase(torque=LOAD, speed=SPEED))
    np.testing.assert_allclose(found.high[0], plain.high, rtol=1e-4)
    np.testing.assert_allclose(found.low[0], plain.low, rtol=1e-4)


def test_a_file_without_masses_and_stiffness_tells_nothing():
    bare = replace(drive(), stations=(), shafts=(Shaft(number=2, length=1.0, outer=0.07, wall=0.002),))
    assert not has_torsion(bare)
    assert steady_torque(bare) is None
    assert math.isnan(life(bare).vibration[0])
