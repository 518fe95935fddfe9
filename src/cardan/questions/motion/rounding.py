"""Is a small speed fluctuation one of the design, or only what the rounding of its figures leaves?"""

from __future__ import annotations

import math

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.models.laws import unmapped
from cardan.maths.arrays import Array

from .closure import closure
from .equivalence import SPECK, SYNCHRONOUS

UNDONE = 0.01
"""Share of what all joints together could make of it, below which joints cancel each other but for rounding."""


def is_rounding(drive: Drive, share: float, length: Array | None = None) -> bool:
    """Tell whether a speed fluctuation is no more than the rounding of the figures that describe a drive leaves.

    Joint angles that coordinates give are never quite those meant, nor are those of joints that cancel each other; a
    joint angle that a file gives by itself is meant. What breaks a limit of the file is never put down to rounding.
    share: its speed fluctuation δ at some setting of its yokes.
    length (n,): sides of its phase polygon, where they are known.

    >>> is_rounding(Drive.from_angles([0.2, 0.2 + 1e-6]), 1e-7), is_rounding(Drive.from_angles([1e-3]), 1e-7)
    (True, False)
    """
    if unmapped(drive.joints):
        return share < SYNCHRONOUS
    limit = drive.limits.speed_fluctuation
    sides = closure(drive).length if length is None else length
    together = 2.0 * math.sinh(float(np.sum(sides)))
    undone = len(drive.joints) > 1 and share < UNDONE * together
    left = drive.form == "points" or undone or share < SYNCHRONOUS
    return share < SPECK and left and (limit is None or share <= limit)


def each_uniform(drive: Drive) -> bool:
    """Tell whether every joint of a drive turns uniformly by itself, straight or of constant velocity.

    >>> each_uniform(Drive.from_angles([0.0])), each_uniform(Drive.from_angles([0.2, 0.2]))
    (True, False)
    """
    return not unmapped(drive.joints) and float(np.sum(closure(drive).length)) < SYNCHRONOUS
