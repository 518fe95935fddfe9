"""Checks: one drive at a prompt, and a hundred thousand variants of it in one call."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan import check, example, remedies

from .harness import Figure, fastest

AIM = 100.0
"""Milliseconds of all checks of one drive."""


def figures(quick: bool) -> Iterator[Figure]:
    drive = example("car-propshaft")
    many = 1_000 if quick else 100_000
    sizes = np.linspace(60.0, 100.0, many)
    jobs = {
        "all checks of one drive": lambda: check(drive),
        f"all checks of {many} tubes of one drive": lambda: check(drive, vary={"shafts[1].outer_mm": sizes}),
        f"all checks of {many} places of an axle": lambda: check(
            drive, vary={"joints[1].centre_mm[2]": -sizes, "output.point_mm[2]": -sizes}
        ),
        "remedies of a truck": lambda: remedies(example("truck-duty-cycle")),
    }
    for name, seconds in fastest(jobs, rounds=2 if quick else 5).items():
        yield Figure(
            bench=name, value=1e3 * seconds, unit="ms", yardstick="100 ms for one drive", ratio=1e3 * seconds / AIM
        )
