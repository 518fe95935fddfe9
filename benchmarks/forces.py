"""Kinetostatics: one four-joint drive over a turn, and many drives in one call."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from cardan.drive.models.dynamics_model import Hold, Train, train_of_points
from cardan.questions.forces.forces import kinetostatics

from .harness import Figure, fastest

ONE = 5.0
"""Aim: milliseconds for one drive over 360 positions."""

POINTS = np.asarray([[0.0, 0, 7], [100, 0, 7], [498, -72, 34], [707, -57, 27], [1064, 31, -68], [1164, 31, -86]]) / 1e3

SUPPORTS: tuple[tuple[int, tuple[Hold, ...]], ...] = (
    (0, ("radial", "axial")),
    (0, ("radial",)),
    (1, ("radial",)),
    (3, ("radial",)),
    (4, ("radial",)),
    (4, ("radial",)),
)

HEAVY = {
    "inertia": np.asarray([0.1, 0.02, 0.01, 0.02, 0.3]),
    "mass": np.asarray([3.0, 2.0, 1.0, 2.0, 4.0]),
    "centre_of_mass": np.asarray([0.05, 0.2, 0.1, 0.15, 0.05]),
    "cross_inertia": np.asarray([[0.001, 0.002, 0.0025]] * 4),
    "cross_mass": np.full(4, 0.4),
    "gravity": np.asarray([0.0, 0.0, -9.80665]),
}


def drives(count: int | None = None) -> Train:
    """Return the four-joint power unit with its supports, or many with points shifted by a few centimetres."""
    outer = () if count is None else (count,)
    shift = 0.0 if count is None else np.random.default_rng(1).uniform(-0.03, 0.03, (count, 6, 3))
    heavy = {k: v if k == "gravity" else np.broadcast_to(v, (*outer, *v.shape)) for k, v in HEAVY.items()}
    position = np.broadcast_to([0.02, 0.08, 0.25, 0.2, 0.02, 0.09], (*outer, 6))
    span = np.full((*outer, 4), 0.08)
    return train_of_points(POINTS + shift, bearings=SUPPORTS, position=position, span=span, **heavy)


def figures(quick: bool) -> Iterator[Figure]:
    turn, few = np.linspace(0.0, 2 * np.pi, 360), np.linspace(0.0, 2 * np.pi, 72)
    one, count = drives(), 200 if quick else 10_000
    light = replace(one, inertia=None, cross_inertia=None, mass=None, cross_mass=None)
    jobs = {
        "all masses": lambda: kinetostatics(one, turn, torque=300.0, speed=150.0),
        "no masses": lambda: kinetostatics(light, turn, torque=300.0),
    }
    for name, seconds in fastest(jobs, rounds=5 if quick else 50).items():
        yield Figure(
            bench=f"forces of a four-joint drive, 360 positions, {name}",
            value=1e3 * seconds,
            unit="ms",
            yardstick=f"{ONE:g} ms, aim ≤ 1",
            ratio=1e3 * seconds / ONE,
        )
    many = drives(count)
    seconds = fastest({"many": lambda: kinetostatics(many, few, torque=300.0, speed=150.0)}, rounds=1)["many"]
    single = fastest({"one": lambda: kinetostatics(one, few, torque=300.0, speed=150.0)})["one"]
    yield Figure(
        bench=f"forces of {count} four-joint drives × 72 positions in one call",
        value=seconds,
        unit="s",
        yardstick=f"{count * single:.3g} s one by one, aim ≤ 0.5",
        ratio=seconds / (count * single),
    )
