"""Yoke angles that make four-joint drives synchronous: one drive, and many at once."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan import extremes, phases
from cardan.drive.models.kinematics_model import chain
from cardan.questions.phases.batch import synchronous_yokes
from cardan.sweeps import Drives

from .harness import Figure, fastest, random_drives
from .single_drive import truck

ONE, MANY, RESIDUAL = 50.0, 1.0, 1e-14
"""Aims: microseconds a drive, seconds for 100,000 drives, speed fluctuation left."""


def figures(quick: bool) -> Iterator[Figure]:
    drive, count = truck(), 10_000 if quick else 100_000
    one, many = chain(drive), random_drives(count)
    jobs = (
        ("construction", lambda: synchronous_yokes(one), 500, ", aim ≤ 1"),
        ("all settings of phases", lambda: phases(drive), 9, ""),
    )
    for name, job, rounds, aim in jobs:
        seconds = fastest({name: job}, rounds=rounds)[name]
        yield Figure(
            bench=f"synthesis of one drive, {name}",
            value=1e6 * seconds,
            unit="µs",
            yardstick=f"{ONE:g} µs{aim}",
            ratio=1e6 * seconds / ONE,
        )
    seconds = fastest({"many": lambda: synchronous_yokes(many)}, rounds=3)["many"]
    yield Figure(
        bench=f"synthesis of {count} drives at once",
        value=seconds,
        unit="s",
        yardstick=f"{MANY * count / 1e5:g} s, aim ≤ 1",
        ratio=seconds / (MANY * count / 1e5),
    )
    found = synchronous_yokes(many)
    again = Drives.from_angles(
        many.chain.joint_angle, plane_twist=many.chain.plane_twist, yoke_angle=found.yoke_angle, start_phase=0.0
    )
    left = float(np.max(extremes(again).speed_fluctuation[found.feasible]))
    yield Figure(
        bench=f"speed fluctuation left in the worst of {int(found.feasible.sum())} drives that can be synchronous",
        value=left,
        unit="1",
        yardstick=f"{RESIDUAL:g}, aim ≤ 1",
        ratio=left / RESIDUAL,
    )
