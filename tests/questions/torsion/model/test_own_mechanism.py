"""Torsional vibration with a mechanism as a joint whose law is its own, against equations written apart from cardan.

A cross with arms that are not square: both yokes' arms and the bar between them meet in the centre, so that the arms
enclose a fixed angle; turns and derivatives follow from that alone. The equation of motion is integrated by SciPy.
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from cardan import Drive
from cardan.drive.duty import Duty
from cardan.drive.joints.mechanism import MechanismJoint
from cardan.drive.shaft import Shaft
from cardan.drive.station import Station
from cardan.mechanism.mechanism import Mechanism, Pair
from cardan.questions.torsion.model.torsion import torsion_modes
from cardan.questions.torsion.model.torsional_modes import base_order
from cardan.questions.torsion.model.torsional_train import torsional_train
from cardan.questions.torsion.steady.torsion_response import torsion_response
from cardan.questions.torsion.transient.torsion_transient import transient
from cardan.units import deg

ALPHA, ONE, TWO, BETWEEN = 20.0 * deg, 80.0 * deg, 84.0 * deg, 93.0 * deg
STIFFNESS, DAMPING, INERTIA, SPEED, TORQUE = 3000.0, 4.0, 0.4, 41.0, 40.0
DRIVING, DRIVEN = np.asarray([1.0, 0.0, 0.0]), np.asarray([math.cos(ALPHA), math.sin(ALPHA), 0.0])
NORMAL = np.asarray([0.0, 0.0, 1.0])


def arm(turn: float, axis: np.ndarray, slant: float) -> list[np.ndarray]:
    """Return the direction of an arm at a turn of its shaft, with two derivatives."""
    inner = np.cross(NORMAL, axis)
    across = math.cos(turn) * inner + math.sin(turn) * NORMAL
    ahead = -math.sin(turn) * inner + math.cos(turn) * NORMAL
    return [math.cos(slant) * axis + math.sin(slant) * across, math.sin(slant) * ahead, -math.sin(slant) * across]


def closed(angle: float) -> tuple[float, float, float]:
    """Return the turn of the driven arm with two derivatives, where both arms enclose the angle of the cross."""
    first, middle = arm(angle, DRIVING, ONE), angle + 0.5 * math.pi
    turned = brentq(
        lambda t: float(first[0] @ arm(t, DRIVEN, TWO)[0]) - math.cos(BETWEEN), middle - 0.6, middle + 0.6, xtol=1e-15
    )
    other = arm(turned, DRIVEN, TWO)
    below = first[0] @ other[1]
    ratio = -(first[1] @ other[0]) / below
    slope = first[2] @ other[0] + 2.0 * ratio * (first[1] @ other[1]) + ratio**2 * (first[0] @ other[2])
    return turned, float(ratio), float(-slope / below)


@cache
def mark() -> float:
    """Return how far the driving arm stands ahead of the mark that angles count from: there order 2 is a sine."""
    theta = np.arange(128) * (2.0 * np.pi / 128)
    lead = np.asarray([closed(one)[0] - one for one in theta])
    order2 = np.angle(np.mean(lead * np.exp(-2j * theta)))
    return float((0.5 * (order2 - 0.5 * np.pi) + 0.25 * np.pi) % (0.5 * np.pi) - 0.25 * np.pi)


def turned(angle: float) -> tuple[float, float, float]:
    """Return the turn of the driven shaft from the start, with two derivatives, by that of the driving shaft."""
    start = -mark()
    value, ratio, slope = closed(angle + start)
    return value - closed(start)[0], ratio, slope


def drawing() -> Mechanism:
    """Return the mechanism, drawn with the driving arm in the plane of the shafts."""

    def pair(name: str, links: tuple[str, str], axis: np.ndarray, reach: float) -> Pair:
        return Pair(id=name, type="R", links=links, point=tuple((reach * axis).tolist()), axis=tuple(axis.tolist()))

    return Mechanism(
        frame="frame",
        input_link="input",
        output_link="output",
        joints=(
            pair("input bearing", ("frame", "input"), DRIVING, -0.1),
            pair("driving arm", ("input", "bar"), arm(0.0, DRIVING, ONE)[0], 0.03),
            pair("driven arm", ("bar", "output"), arm(closed(0.0)[0], DRIVEN, TWO)[0], 0.03),
            pair("output bearing", ("frame", "output"), DRIVEN, 0.1),
        ),
    )


DRIVE = Drive(
    joints=(MechanismJoint(file="own.toml", drawing=drawing(), joint_angle=ALPHA),),
    shafts=(Shaft(number=1, stiffness=STIFFNESS, damping=DAMPING), Shaft(number=2)),
    stations=(Station(shaft=1, end="end", inertia=0.02), Station(shaft=2, end="end", inertia=INERTIA)),
    duty=Duty(speed=SPEED, torque=TORQUE),
)


def integrated(start: np.ndarray, times: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return angle and speed of the driving yoke (2, t), and the torque of the shaft before it (t,)."""

    def torque(time: float, x: float, v: float) -> float:
        return STIFFNESS * (SPEED * time - x) + DAMPING * (SPEED - v)

    def motion(time: float, state: np.ndarray) -> list[float]:
        x, v = state
        _turn, first, second = turned(x)
        pushed = torque(time, x, v) - first * TORQUE - INERTIA * first * second * v * v
        return [v, pushed / (0.02 + INERTIA * first * first)]

    run = solve_ivp(motion, (0.0, times[-1]), start, method="DOP853", rtol=1e-11, atol=1e-12, t_eval=times)
    assert run.success
    return run.y, np.asarray([torque(t, x, v) for t, x, v in zip(times, *run.y, strict=True)])


def shaft_element() -> int:
    return torsional_train(DRIVE).model.stiffness.tolist().index(STIFFNESS)


def test_order_one_of_the_mechanism_counts() -> None:
    """Its law has order 1 besides 2, and both are found."""
    modes = torsion_modes(DRIVE)
    assert not DRIVE.joints[0].has_map
    assert base_order(modes.train.model) == 1.0
    assert {1.0, 2.0} <= {one.order for one in modes.crossings}


@pytest.mark.slow
def test_a_simulation_is_what_scipy_integrates() -> None:
    times = np.linspace(0.0, 0.4, 41)
    found = transient(DRIVE, times=times, span=0.4)
    _states, wanted = integrated(np.asarray([0.0, SPEED]), times)
    own = found.motion.torque[:, shaft_element()]
    np.testing.assert_allclose(own, wanted, rtol=0.0, atol=1e-6 * np.max(np.abs(wanted)))


@pytest.mark.slow
def test_the_steady_motion_repeats_by_scipy() -> None:
    """From where the periodic motion begins SciPy comes back after a turn with the same harmonics of the torque."""
    found = torsion_response(DRIVE)
    q, rate, _acceleration = (one[0, 0] for one in found.steady.orbit.of(np.asarray([0]), [0.0]))
    own = found.train.model.coordinate[found.train.joints[0][0]]
    begun, turn, count = np.asarray([q[own], rate[own]]), 2.0 * math.pi / SPEED, 64
    states, torque = integrated(begun, turn * np.arange(count + 1) / count)
    np.testing.assert_allclose(states[:, -1] - [2.0 * math.pi, 0.0], begun, rtol=1e-7, atol=1e-8)
    wave = np.abs(2.0 * np.fft.rfft(torque[:-1]) / count)
    for order in (1, 2, 3):
        k = int(np.argmin(np.abs(found.steady.order - order)))
        assert found.steady.torque.amplitude[shaft_element(), k] == pytest.approx(wave[order], rel=1e-5, abs=1e-5)
    assert min(wave[1], wave[2]) > 1.0
