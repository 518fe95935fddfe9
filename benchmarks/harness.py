"""Timing in turns, and one JSON line for each figure."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, dataclass

import numpy as np

from cardan.sweeps import Drives


@dataclass(frozen=True, kw_only=True)
class Figure:
    """One measured figure.

    Attributes
    ----------
    bench : str
        What was measured.
    value : float
        The figure, in ``unit``.
    yardstick : str
        What it is held against, with its own figure and the aim.
    ratio : float
        Value over yardstick.
    """

    bench: str
    value: float
    unit: str
    yardstick: str
    ratio: float

    def line(self) -> str:
        """Return the figure as JSON on one line."""
        rounded = {k: float(f"{v:.4g}") if isinstance(v, float) else v for k, v in asdict(self).items()}
        return json.dumps(rounded, ensure_ascii=False)


Bench = Callable[[bool], Iterator[Figure]]
"""Yields figures; true asks for a quick look on small sizes."""


def fastest(jobs: Mapping[str, Callable[[], object]], *, rounds: int = 7) -> dict[str, float]:
    """Return the shortest time of each job [s], all run in turns so that a slow spell hits them alike.

    Every job runs once before, unmeasured.
    """
    for job in jobs.values():
        job()
    best = dict.fromkeys(jobs, float("inf"))
    for _round in range(rounds):
        for name, job in jobs.items():
            begin = time.perf_counter()
            job()
            best[name] = min(best[name], time.perf_counter() - begin)
    return best


def random_drives(count: int, joints: int = 4) -> Drives:
    """Return drives with joint angles below 25° and any yokes and planes, always the same ones."""
    rng = np.random.default_rng(1)
    return Drives.from_angles(
        rng.uniform(0.0, 0.43, (count, joints)),
        plane_twist=rng.uniform(-3.0, 3.0, (count, joints - 1)),
        yoke_angle=rng.uniform(-1.5, 1.5, (count, joints - 1)),
        start_phase=rng.uniform(-3.0, 3.0, count),
    )
