"""Torsional vibration with a joint that turns far from tan θ' = κ tan θ, against equations written apart from cardan.

Pins touch where the triple product of what joins their starts and both pin directions is 0; turns and derivatives
follow from that alone. The equations of motion are Lagrange's, two coordinates, integrated by SciPy.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from cardan import Drive
from cardan.book.mathieu_modes import mathieu_modes
from cardan.drive.duty import Duty
from cardan.drive.joints import Hooke
from cardan.drive.movement import Harmonic
from cardan.drive.shaft import Shaft
from cardan.drive.station import Station
from cardan.joints import PinCoupling
from cardan.questions.torsion.model.torsion import torsion_modes
from cardan.questions.torsion.model.torsional_balance import places
from cardan.questions.torsion.model.torsional_modes import base_order, main_order
from cardan.questions.torsion.model.torsional_train import TorsionalTrain, torsional_train
from cardan.questions.torsion.road.road import road_torsion
from cardan.questions.torsion.stability.torsion_stability import stability
from cardan.questions.torsion.steady.run_stability import Verdict
from cardan.questions.torsion.steady.torsion_response import TorsionResponse, torsion_response
from cardan.questions.torsion.transient.torsion_transient import transient
from cardan.units import deg

ALPHA, BEND = 20.0 * deg, 15.0 * deg
A, B, ONE, TWO = 0.050, 0.054, 40.0 * deg, 44.0 * deg
YOKES, TWIST, START = 25.0 * deg, -35.0 * deg, 10.0 * deg
C1, C2, DAMP, NEAR, FAR = 3000.0, 5000.0, 6.0, 0.05, 0.3
SPEED, TORQUE = 37.0, 40.0

DRIVE = replace(
    Drive.from_angles([ALPHA, BEND], plane_twists=[TWIST], yoke_angles=[YOKES], start_phase=START),
    joints=(
        PinCoupling(joint_angle=ALPHA, driving_slant=ONE, driven_slant=TWO, driving_distance=A, driven_distance=B),
        Hooke(joint_angle=BEND, plane_twist=TWIST),
    ),
    shafts=(
        Shaft(number=1, stiffness=C1, damping=DAMP),
        Shaft(number=2, stiffness=C2, damping=DAMP, yoke_angle=YOKES),
        Shaft(number=3),
    ),
    stations=(
        Station(shaft=1, end="end", inertia=0.02),
        Station(shaft=2, end="start", inertia=NEAR),
        Station(shaft=3, end="end", inertia=FAR),
    ),
    duty=Duty(speed=SPEED, torque=TORQUE),
)
Law = Callable[[float], tuple[float, float, float]]


def pins(angle: float, alpha: float = ALPHA) -> tuple[float, float, float]:
    """Return the driven angle of the pin coupling with two derivatives, from the contact of its pins."""
    e1, e2 = np.asarray([1.0, 0.0, 0.0]), np.asarray([-math.cos(alpha), math.sin(alpha), 0.0])
    u1, u2 = np.asarray([0.0, 1.0, 0.0]), np.asarray([math.sin(alpha), math.cos(alpha), 0.0])
    normal, between = np.asarray([0.0, 0.0, 1.0]), A * e1 - B * e2

    def pin(turn: float, axis: np.ndarray, inner: np.ndarray, slant: float) -> list[np.ndarray]:
        across = [
            math.cos(turn) * inner + math.sin(turn) * normal,
            -math.sin(turn) * inner + math.cos(turn) * normal,
            -math.cos(turn) * inner - math.sin(turn) * normal,
        ]
        return [-math.cos(slant) * axis + math.sin(slant) * across[0], *(math.sin(slant) * one for one in across[1:])]

    def product(one: np.ndarray, other: np.ndarray) -> float:
        return float(np.dot(between, np.cross(one, other)))

    first = pin(angle, e1, u1, ONE)
    turned = brentq(
        lambda t: product(first[0], pin(t, e2, u2, TWO)[0]), angle - 0.3, angle + 0.3, xtol=1e-15, rtol=9e-16
    )
    other = pin(turned, e2, u2, TWO)
    by_one, by_two = product(first[1], other[0]), product(first[0], other[1])
    ratio = -by_one / by_two
    slope = product(first[2], other[0]) + 2.0 * product(first[1], other[1]) * ratio
    return turned, ratio, -(slope + product(first[0], other[2]) * ratio**2) / by_two


def cross(angle: float) -> tuple[float, float, float]:
    """Return the same of a Hooke joint: tan θ' = tan θ/cos α."""
    turned = math.atan2(math.sin(angle), math.cos(angle) * math.cos(BEND))
    turned += 2.0 * math.pi * round((angle - turned) / (2.0 * math.pi))
    below = 1.0 - (math.sin(BEND) * math.cos(angle)) ** 2
    ratio = math.cos(BEND) / below
    return turned, ratio, -ratio * math.sin(BEND) ** 2 * math.sin(2.0 * angle) / below


def followed(law: Law, phase: float) -> Law:
    start = law(phase)[0]

    def turned(angle: float) -> tuple[float, float, float]:
        value, ratio, slope = law(angle + phase)
        return value - start, ratio, slope

    return turned


PIN = followed(pins, START)
CROSS = followed(cross, pins(START)[0] - YOKES - TWIST)


def motion(time: float, state: np.ndarray) -> list[float]:
    """Return the rates of both driving yokes: x of the pin coupling, y of the cross."""
    x, y, v, w = state
    (f, f1, f2), (_g, g1, g2) = PIN(x), CROSS(y)
    second = C2 * (f - y) + DAMP * (f1 * v - w)
    pushed = C1 * (SPEED * time - x) + DAMP * (SPEED - v) - f1 * second
    return [
        v,
        w,
        (pushed - NEAR * f1 * f2 * v * v) / (0.02 + NEAR * f1 * f1),
        (second - g1 * TORQUE - FAR * g1 * g2 * w * w) / (FAR * g1 * g1),
    ]


def torques(time: np.ndarray, states: np.ndarray) -> np.ndarray:
    """Return the torques of both shafts, array (2, t) [N·m]."""
    found = []
    for t, (x, y, v, w) in zip(time, states.T, strict=True):
        f, f1, _f2 = PIN(x)
        found.append((C1 * (SPEED * t - x) + DAMP * (SPEED - v), C2 * (f - y) + DAMP * (f1 * v - w)))
    return np.asarray(found).T


def integrated(start: np.ndarray, end: float, times: np.ndarray | None = None) -> np.ndarray:
    run = solve_ivp(motion, (0.0, end), start, method="DOP853", rtol=1e-11, atol=1e-12, t_eval=times)
    assert run.success
    return run.y if times is not None else run.y[:, -1]


def shafts(train: TorsionalTrain) -> list[int]:
    """Return the elements that are the shafts 1 and 2."""
    stiffness = train.model.stiffness.tolist()
    return [stiffness.index(one) for one in (C1, C2)]


def begun(found: TorsionResponse) -> np.ndarray:
    """Return angles and speeds of both driving yokes where the periodic motion begins."""
    q, rate, _acceleration = (one[0, 0] for one in found.steady.orbit.of(np.asarray([0]), [0.0]))
    own = [found.train.model.coordinate[driving] for driving, _driven in found.train.joints]
    return np.concatenate([q[own], rate[own]])


def test_the_model_turns_as_the_pins_do() -> None:
    """Both joints, also the phase at which the cross starts behind the pins; T'' of the sum is right to 1e-11."""
    train = torsional_train(DRIVE)
    assert (base_order(train.model), main_order(train.model)) == (1.0, 2.0)
    turn = np.linspace(0.0, 9.0, 40)
    q = np.repeat(turn[:, None], train.model.coordinates, axis=1)
    found = places(train.model, q)
    for (_driving, driven), law in zip(train.joints, (PIN, CROSS), strict=True):
        wanted = np.asarray([law(one) for one in turn]).T
        for column, one, least in zip(
            (found.angle, found.first, found.second), wanted, (1e-13, 1e-12, 2e-11), strict=True
        ):
            np.testing.assert_allclose(column[:, driven], one, rtol=0.0, atol=least)


@pytest.mark.slow
def test_a_simulation_is_what_scipy_integrates() -> None:
    """From untwisted shafts that turn as rigid ones: the second with the driven yoke of the pin coupling."""
    times = np.linspace(0.0, 0.6, 61)
    found = transient(DRIVE, times=times, span=0.6)
    wanted = torques(times, integrated(np.asarray([0.0, 0.0, SPEED, PIN(0.0)[1] * SPEED]), 0.6, times))
    own = found.motion.torque[:, shafts(found.train)].T
    np.testing.assert_allclose(own, wanted, rtol=0.0, atol=1e-7 * np.max(np.abs(wanted)))


@pytest.mark.slow
def test_the_steady_motion_repeats_by_scipy() -> None:
    """From where the periodic motion begins SciPy comes back after a turn, not half of one, with the same torques."""
    found = torsion_response(DRIVE)
    turn, count = 2.0 * math.pi / SPEED, 64
    state = begun(found)
    times = turn * np.arange(count + 1) / count
    run = integrated(state, turn, times)
    after = run[:, -1] - np.asarray([2.0 * math.pi, 2.0 * math.pi, 0.0, 0.0])
    np.testing.assert_allclose(after, state, rtol=1e-8, atol=1e-9)
    wave = 2.0 * np.fft.rfft(torques(times[:-1], run[:, :-1]), axis=-1) / count
    assert found.steady.orbit.period == pytest.approx(2.0 * math.pi)
    for order in (1, 2, 3, 4):
        k = int(np.argmin(np.abs(found.steady.order - order)))
        own = found.steady.torque.amplitude[shafts(found.train), k]
        np.testing.assert_allclose(own, np.abs(wave[:, order]), rtol=1e-6, atol=1e-6)
    assert np.abs(wave[:, 1]).max() > 10.0


@pytest.mark.slow
def test_disturbances_grow_as_scipy_finds() -> None:
    """Multipliers over a turn, by differences of motions that begin a little apart: these err by 1e-8."""
    found = torsion_response(DRIVE)
    state, turn, step = begun(found), 2.0 * math.pi / SPEED, 1e-4
    columns = [
        (integrated(state + step * side, turn) - integrated(state - step * side, turn)) / (2.0 * step)
        for side in np.eye(4)
    ]
    wanted = np.linalg.eigvals(np.stack(columns, axis=-1))
    assert np.sort(np.abs(found.floquet.multipliers)) == pytest.approx(np.sort(np.abs(wanted)), rel=1e-5, abs=1e-8)


@pytest.mark.slow
def test_play_that_opens_is_told_as_a_simulation_ends() -> None:
    """No steps of one length follow these laws; the periodic motion is what a simulation settles to."""
    first, second = DRIVE.joints
    drive = replace(DRIVE, joints=(replace(first, backlash=0.01), second), duty=Duty(speed=SPEED, torque=60.0))
    found = torsion_response(drive)
    times = 2.5 - 2.0 * math.pi / SPEED * np.linspace(1.0, 0.0, 401)
    torque = transient(drive, times=times, span=2.5).motion.torque
    assert np.all(found.torque_lowest < 0.0)
    np.testing.assert_allclose(found.torque_lowest, np.min(torque, axis=0), rtol=1e-3)
    np.testing.assert_allclose(found.torque_highest, np.max(torque, axis=0), rtol=1e-3)


@pytest.mark.slow
def test_a_law_of_order_one_opens_zones_about_twice_the_natural_frequency() -> None:
    """Growth amid the principal zone of first order, and about where the exact one begins and ends."""
    light = replace(
        Drive.from_angles([8.0 * deg]),
        joints=(replace(DRIVE.joints[0], joint_angle=8.0 * deg),),
        shafts=(Shaft(number=1, stiffness=C1, damping=0.01),),
        stations=(Station(shaft=2, end="start", inertia=0.3),),
        duty=Duty(speed=200.0),
    )
    modes = torsion_modes(light)
    assert (modes.order, main_order(modes.train.model)) == ([1.0], 1.0)
    assert modes.parametric_speed == pytest.approx(2.0 * modes.omega, rel=1e-12)
    at_zone = replace(light, duty=Duty(speed=float(modes.parametric_speed[0])))
    amid = stability(at_zone)
    assert amid.verdict == Verdict.UNSTABLE
    assert amid.zone.name() == "principal zone of mode 1"
    assert amid.growth_rate == pytest.approx(float(modes.growth_rate[0]), rel=0.02)
    assert 1.0 in [one.order for one in modes.crossings]
    (mathieu,) = np.asarray(mathieu_modes(at_zone).exponent.growth)
    assert 0.5 * float(modes.parametric_speed[0]) * mathieu == pytest.approx(float(modes.growth_rate[0]), rel=0.02)
    inside, outside = (1.0 + side * 0.5 * float(modes.modulation[0]) for side in (0.8, 1.2))
    edges = stability(light, over={"duty.speed_rad_s": modes.parametric_speed[0] * np.asarray([inside, outside])})
    assert edges.stable.tolist() == [False, True]


@pytest.mark.slow
def test_a_quick_movement_is_followed_by_the_law_of_every_instant() -> None:
    """The joint angle swings at 8 rad/s about 11°, order 1 near the mode; SciPy turns by the contact at every α(t)."""
    speed, stiffness, damping, inertia = 104.0, 4000.0, 4.0, 0.4
    swing = Harmonic(moves=("output",), amplitude=(0.0, 0.0, 0.1), frequency=8.0)
    bent = Drive.from_points([(-0.3, 0, 0), (0, 0, 0), (1, 0, 0.2)])
    drive = replace(
        bent,
        joints=(replace(DRIVE.joints[0], joint_angle=None, centre=bent.joints[0].centre),),
        movements=(swing,),
        shafts=(Shaft(number=2, stiffness=stiffness, damping=damping),),
        stations=(Station(shaft=2, inertia=inertia),),
        duty=Duty(speed=speed, torque=TORQUE),
    )
    found = road_torsion(drive)
    assert found.moving is not None
    assert found.moving.times is not None

    def turned(time: float) -> float:
        return pins(speed * time, math.atan(0.2 + 0.1 * math.sin(8.0 * time)))[0]

    def torque(time: float, state: np.ndarray) -> float:
        rate = (turned(time + 1e-5) - turned(time - 1e-5)) / 2e-5
        return stiffness * (turned(time) - state[0]) + damping * (rate - state[1])

    window = 2.0 * math.pi / speed
    times = found.moving.times[0] + (np.arange(32 * len(found.moving.times)) / 32.0 - 0.5) * window
    run = solve_ivp(
        lambda time, state: [state[1], (torque(time, state) - TORQUE) / inertia],
        (float(times[0]) - 1.5, float(times[-1])),
        [speed * (float(times[0]) - 1.5), speed],
        method="DOP853",
        t_eval=times,
        rtol=1e-6,
        atol=1e-8,
    )
    wanted = np.asarray([torque(time, state) for time, state in zip(times, run.y.T, strict=True)]).reshape(-1, 32)
    np.testing.assert_allclose(found.moving.high[:, 0], np.max(wanted, axis=-1), rtol=0.03, atol=2.0)
    np.testing.assert_allclose(found.moving.low[:, 0], np.min(wanted, axis=-1), rtol=0.03, atol=2.0)
    assert np.max(np.abs(wanted)) > 1.1 * np.max(found.standing.high) or np.max(wanted) < 0.9 * np.max(
        found.standing.high
    )
