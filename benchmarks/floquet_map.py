"""Stability maps and proofs, against integrating the variational equations."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from scipy.integrate import solve_ivp

from cardan import Drive, example, stability
from cardan.maths.compiled.method import Compiled
from cardan.questions.torsion.model.inputs import Constant
from cardan.questions.torsion.model.torsional_balance import slopes
from cardan.questions.torsion.model.torsional_model import Torque, TorsionalModel, torsional_line
from cardan.questions.torsion.stability.floquet_map import floquet_map
from cardan.questions.torsion.stability.proved_speeds import proved_speeds
from cardan.questions.torsion.steady.steady import periodic_response
from cardan.questions.torsion.steady.torsion_response import loaded_model, parted
from cardan.units import rpm

from .harness import Figure, fastest

AIM = 10.0
"""Seconds for 300 × 300 points on two processors."""

PROVED, FROM_FILE = 10.0, 30.0
"""Seconds for stability proved from 500 to 3000 rpm on one processor, and for a map of 300 × 300 points of a file."""

TOLERANCE = 1e-8


def drive() -> TorsionalModel:
    """Return three shafts and two joints; with the input forced four coordinates are free."""
    return torsional_line(
        [[1.0, 0.05], [0.03, 0.2, 0.03], [0.03, 0.4]],
        stiffness=[[4000.0], [6000.0, 6000.0], [5000.0]],
        damping=[[0.5], [0.5, 0.5], [0.5]],
        joint_angle=[0.3, 0.3],
        phase=[0.0, 0.5],
        torques=[Torque(station=6, law=Constant(value=-60.0))],
        input_speed=50.0,
    )


def over(points: int) -> TorsionalModel:
    """Return the drive over joint angles and speeds."""
    joint_angles = np.linspace(0.0, 0.45, points)[:, None, None] * np.ones(2)
    return replace(drive(), joint_angle=joint_angles, input_speed=np.linspace(15.0, 120.0, points))


def by_scipy(speed: float) -> np.ndarray:
    """Return the monodromy matrix about a motion that is known, by scipy."""
    model = replace(drive(), input_speed=speed)
    orbit = periodic_response(model).orbit
    count = model.coordinates - 1

    def right(t: float, y: np.ndarray) -> np.ndarray:
        found = slopes(model, *(one[0] for one in orbit.at([speed * t])))
        x, v = y.reshape(2, count, 2 * count)
        pull = found.damping[1:, 1:] @ v + found.stiffness[1:, 1:] @ x
        return np.concatenate([v, -pull / found.mass[1:, None]]).ravel()

    span = (0.0, np.pi / speed)
    done = solve_ivp(right, span, np.eye(2 * count).ravel(), method="DOP853", rtol=TOLERANCE, atol=TOLERANCE)
    return done.y[:, -1].reshape(2 * count, 2 * count)


def _proved(stand: Drive) -> object:
    def build(speeds: np.ndarray) -> TorsionalModel:
        return parted(loaded_model(stand, stand.duty, speeds)[1])[0]

    return proved_speeds(build, 500.0 * rpm, 3000.0 * rpm, method=Compiled(threads=1))


def figures(quick: bool) -> Iterator[Figure]:
    points = 24 if quick else 300
    model = over(points)
    seconds = fastest({"map": lambda: floquet_map(model, method=Compiled())}, rounds=1 if quick else 3)["map"]
    stand = example("unstable-drive")
    proof = fastest({"proof": lambda: _proved(stand)}, rounds=1 if quick else 3)["proof"]
    yield Figure(
        bench="stability proved from 500 to 3000 rpm, test stand with its zone",
        value=proof,
        unit="s",
        yardstick=f"aim ≤ {PROVED:g} s on one processor",
        ratio=proof / PROVED,
    )
    over_both = {
        "duty.speed_rpm": np.linspace(500.0, 3000.0, points),
        "joint_angle_deg": np.linspace(5.0, 30.0, points),
    }
    whole = fastest({"map": lambda: stability(stand, over=over_both)}, rounds=1)["map"]
    yield Figure(
        bench=f"stability map of {points} × {points} points from a drive file, stations without inertia",
        value=whole,
        unit="s",
        yardstick=f"aim ≤ {FROM_FILE:g} s for 300 × 300",
        ratio=whole / FROM_FILE,
    )
    probes = (50.0,) if quick else (20.0, 50.0, 100.0)
    by_scipy(50.0)
    begin = time.perf_counter()
    for speed in probes:
        by_scipy(speed)
    each = (time.perf_counter() - begin) / len(probes)
    yield Figure(
        bench=f"stability map of {points} × {points} points, four degrees of freedom",
        value=1e6 * seconds / points**2,
        unit="µs a point",
        yardstick=f"{1e6 * each:.3g} µs by DOP853 about a motion already known; aim ≤ {1e6 * AIM / 300**2:.3g} µs",
        ratio=seconds / (points**2 * each),
    )
