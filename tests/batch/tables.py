"""A small sweep with words, brackets in names, and points without an answer, for all that reads results."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from cardan.batch.engine.running import run
from cardan.batch.work import Column

COLUMNS = (
    Column(name="joints[1].centre_mm[2]", unit="mm", role="point", text="height of joint 2"),
    Column(name="duty.speed_rpm", unit="rpm", role="point", text="input speed"),
    Column(name="supplier", unit="", role="point", text="supplier"),
    Column(name="speed_fluctuation", unit="", role="answer", text="speed fluctuation of the output"),
    Column(name="joint_angle_deg[1]", unit="deg", role="answer", text="joint angle of a joint"),
    Column(name="status", unit="", role="status", text="how the point was answered"),
)
HEIGHTS, SPEEDS = 21, 10
SIZE = HEIGHTS * SPEEDS


@dataclass(frozen=True)
class Suspension:
    """Joint 2 goes up and down at several speeds; beyond 90 mm there is no drive."""

    name: ClassVar[str] = "suspension"
    size: ClassVar[int] = SIZE
    columns: ClassVar = COLUMNS
    reductions: ClassVar = ()
    provenance: ClassVar = {"version": "0.1.0", "drive": {"name": "truck"}, "seed": 3}

    def evaluate(self, start, stop):
        index = np.arange(start, stop)
        height = -100.0 + 10.0 * (index // SPEEDS)
        speed = 500.0 + 250.0 * (index % SPEEDS)
        there = height <= 90.0
        return {
            "joints[1].centre_mm[2]": height,
            "duty.speed_rpm": speed,
            "supplier": np.where(index % 3 == 0, "Alpha", "Beta"),
            "speed_fluctuation": np.where(there, 1e-6 * height**2 + 1e-3, np.nan),
            "joint_angle_deg[1]": np.where(there, 12.0 - 0.05 * height, np.nan),
            "status": np.where(there, 0, 1).astype(np.int8),
        }


def whole():
    """Return the table as it should be read."""
    return Suspension().evaluate(0, SIZE)


def stored(folder, chunk=50):
    """Run the sweep into a folder and return it."""
    return run(Suspension(), into=folder, chunk=chunk)
