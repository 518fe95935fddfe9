"""Torsional motion in time: 2 inertias, 2 joints, 1500 rpm, one drive and 256, against a user of SciPy."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from cardan.questions.torsion.model.inputs import Constant, Falling
from cardan.questions.torsion.model.torsional_model import Torque, TorsionalModel, torsional_line
from cardan.questions.torsion.transient.fixed_steps import FixedStep
from cardan.questions.torsion.transient.transient import simulate
from cardan.units import deg, rpm

from .harness import Figure, fastest

ONE, MANY = 500.0, 50_000.0
"""Aims: seconds of motion followed in a second, where DOP853 comes to `TODAY`."""

TODAY = 22.0
"""What DOP853 came to on the machine the aims stand for."""

ERROR = 1e-7
"""Largest error of an angle [rad]."""

SPEED, DRIVES = 1500.0 * rpm, 256
FIRST, LAST, STIFFNESS, DAMPING, PUSH = 1.0, 0.5, 20_000.0, 2.0, 20.0
JOINT_ANGLE, PHASE = (20 * deg, 15 * deg), (0.3, 1.0)


def drive() -> TorsionalModel:
    """Return a rigid shaft, two joints and a shaft of rubber: a motor holds the speed, a load takes 100 N·m."""
    torques = (
        Torque(station=0, law=Falling(standstill=100.0 + PUSH * SPEED, slope=PUSH)),
        Torque(station=3, law=Constant(value=-100.0)),
    )
    return torsional_line(
        [[FIRST], [0.0], [0.0, LAST]],
        stiffness=[[], [], [STIFFNESS]],
        damping=[[], [], [DAMPING]],
        joint_angle=JOINT_ANGLE,
        phase=PHASE,
        torques=torques,
    )


def by_scipy(span: float, tolerance: float) -> np.ndarray:
    """Return the two angles at the end as a user of SciPy gets them: a function of plain numbers."""
    from scipy.integrate import solve_ivp

    (a1, a2), (p1, p2) = JOINT_ANGLE, PHASE

    def turned(theta: float, joint_angle: float) -> tuple[float, float]:
        tau = math.tan(0.5 * joint_angle) ** 2
        angle_error = math.atan2(tau * math.sin(2 * theta), 1.0 - tau * math.cos(2 * theta))
        return theta + angle_error, math.cos(joint_angle) / (1.0 - (math.sin(joint_angle) * math.cos(theta)) ** 2)

    start1, start2 = turned(p1, a1)[0], turned(p2, a2)[0]

    def slope(_time: float, y: np.ndarray) -> list[float]:
        q1, q2, v1, v2 = y.tolist()
        f, first = turned(q1 + p1, a1)
        g, second = turned(f - start1 + p2, a2)
        first *= second
        torque = STIFFNESS * (g - start2 - q2) + DAMPING * (first * v1 - v2)
        drive = 100.0 + PUSH * (SPEED - v1)
        return [v1, v2, (drive - first * torque) / FIRST, (torque - 100.0) / LAST]

    start = [0.0, 0.0, SPEED, SPEED]
    found = solve_ivp(slope, (0.0, span), start, method="DOP853", rtol=tolerance, atol=tolerance)
    return np.asarray(found.y[:2, -1])


def figures(quick: bool) -> Iterator[Figure]:
    short, span = (0.2, 1.0) if quick else (2.0, 100.0)
    exact = by_scipy(short, 1e-13)
    tolerance = next(one for one in (1e-7, 1e-8, 1e-9, 1e-10) if np.max(np.abs(by_scipy(short, one) - exact)) <= ERROR)
    begin = time.perf_counter()
    by_scipy(short, tolerance)
    today = short / (time.perf_counter() - begin)
    per_period = next(
        one for one in np.arange(7.0, 20.0, 0.5) if np.max(np.abs(_angles(drive(), short, float(one)) - exact)) <= ERROR
    )
    way, one = FixedStep(per_period=float(per_period)), drive()
    many = replace(one, joint_angle=one.joint_angle + np.linspace(0.0, 0.05, DRIVES)[:, None])
    jobs = {
        "one drive": lambda: simulate(one, span=span, times=2, speed=SPEED, method=way),
        f"{DRIVES} drives": lambda: simulate(many, span=span, times=2, speed=SPEED, method=way),
    }
    for (name, seconds), aim, count in zip(
        fastest(jobs, rounds=1 if quick else 3).items(), (ONE, MANY), (1, DRIVES), strict=True
    ):
        reached = count * span / seconds
        yield Figure(
            bench=f"torsional motion of {name}, {span:g} s at 1500 rpm, angles right to {ERROR:g} rad",
            value=reached,
            unit="× real time",
            yardstick=f"{today:.3g} × by SciPy's DOP853, aim ≥ {aim / TODAY:.0f} times that",
            ratio=reached / today,
        )


def _angles(model: TorsionalModel, span: float, per_period: float) -> np.ndarray:
    found = simulate(model, span=span, times=2, speed=SPEED, method=FixedStep(per_period=per_period))
    return np.asarray(found.coordinate[-1])
