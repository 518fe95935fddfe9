"""Steady running over speeds: an order map of eight stations, against integrating until the drive has settled."""

from __future__ import annotations

import time
from collections.abc import Iterator

import numpy as np
from scipy.integrate import solve_ivp

from cardan.questions.torsion.model.inputs import Constant
from cardan.questions.torsion.model.torsional_balance import accelerations
from cardan.questions.torsion.model.torsional_model import Torque, TorsionalModel, torsional_line
from cardan.questions.torsion.stability.floquet_map import speed_sweep

from .harness import Figure, fastest

AIM = 2.0
"""Seconds for 400 speeds."""

SETTLING, TOLERANCE = 60, 1e-8
"""Half turns until this drive has settled, and the tolerance that orders to 1e-6 need."""


def drive(speed: float) -> TorsionalModel:
    """Return three shafts with eight stations and two joints."""
    return torsional_line(
        [[1.0, 0.1, 0.05], [0.03, 0.2, 0.1], [0.1, 0.5]],
        stiffness=[[4000.0, 6000.0], [6000.0, 5000.0], [7000.0]],
        damping=[[1.0, 1.0], [1.0, 1.0], [1.0]],
        joint_angle=[0.3, 0.3],
        phase=[0.0, 1.5],
        torques=[Torque(station=7, law=Constant(value=-60.0))],
        input_speed=speed,
    )


def settled(speed: float) -> np.ndarray:
    """Return the state after the settling time, by scipy."""
    model = drive(speed)
    count = model.coordinates - 1

    def right(t: float, y: np.ndarray) -> np.ndarray:
        q, rate = np.concatenate([[speed * t], y[:count]]), np.concatenate([[speed], y[count:]])
        return np.concatenate([y[count:], accelerations(model, q, rate, t)[1:]])

    start = np.concatenate([np.zeros(count), np.full(count, speed)])
    span = (0.0, SETTLING * np.pi / speed)
    return solve_ivp(right, span, start, method="DOP853", rtol=TOLERANCE, atol=TOLERANCE, t_eval=span[1:]).y[:, -1]


def figures(quick: bool) -> Iterator[Figure]:
    count = 40 if quick else 400
    speeds = np.linspace(12.0, 120.0, count)
    seconds = fastest({"sweep": lambda: speed_sweep(drive(1.0), speeds)}, rounds=1 if quick else 5)["sweep"]
    probes = (100.0,) if quick else (30.0, 60.0, 100.0)
    begin = time.perf_counter()
    for speed in probes:
        settled(speed)
    each = (time.perf_counter() - begin) / len(probes)
    yield Figure(
        bench=f"orders and extremes of a drive with eight stations at {count} speeds",
        value=seconds,
        unit="s",
        yardstick=f"{count * each:.3g} s by integrating each until it has settled; aim for 400 speeds ≤ {AIM:g} s",
        ratio=seconds / (count * each),
    )
