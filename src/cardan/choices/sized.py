"""What a part was sized to, by which checks, and what stood before."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from cardan.checks import Verdict
from cardan.drive.drive import Drive
from cardan.maths.ties import foremost_of

Hold: TypeAlias = Literal["ratio", "wall", "outer"]

HOLDS: tuple[Hold, ...] = ("ratio", "wall", "outer")
"""What a tube keeps while it is sized: its wall over its outer diameter, its wall, its outer diameter."""

PARTS = ("tube", "shaft", "journal", "needles", "joint")
"""What can be sized."""

CHECKS = {
    "tube": ("tube_strength", "tube_fatigue", "tube_buckling", "twist", "critical_speed"),
    "shaft": ("tube_strength", "tube_fatigue", "twist", "critical_speed"),
    "journal": ("journal_strength",),
    "needles": ("bearing_life", "needle_static"),
    "joint": (
        "joint_angle",
        "joint_torque",
        "rated_torque",
        "max_speed",
        "speed_angle",
        "rim_speed",
        "journal_strength",
        "yoke_strength",
        "needle_static",
        "bearing_life",
    ),
}
"""Part -> checks that its size must pass."""

STEPS = {
    "outer": 1.0,
    "inner": 1.0,
    "wall": 0.1,
    "ply_thickness": 0.01,
    "journal": 0.5,
    "capacity": 100.0,
    "static_capacity": 100.0,
}
"""Steps of a drawing, by the key that is sized, in its unit: mm and N."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Tried:
    """A size of the catalogue and what the checks say of it."""

    id: str
    outer: float  # outer, mass [m, kg]: nan where the catalogue does not say
    mass: float  # [kg]
    utilisation: float  # largest of the checks that could be judged; nan where none could
    passed: bool
    worst: Verdict | None = None  # the check with the largest utilisation
    missing: tuple[str, ...] = ()  # paths for want of which some checks could not be judged


@dataclass(frozen=True, eq=False, kw_only=True)
class Sizing:
    """The smallest size of a part that passes.

    Attributes
    ----------
    part, subject : str
        What was sized, as ``tube`` and ``shafts[1]``; the subject is empty for all joints alike.
    exact : mapping of str to float
        Paths with units -> the values at which the part is just at its limit.
    values : mapping of str to float, str or None
        The same as they are made, rounded up; the row of the catalogue of a joint; None where a key is to be left out.
    before : mapping of str to float or None
        What the drive says now.
    limits : tuple of Verdict
        Of the checks that count, at the exact size; at the chosen one for a joint.
    made : tuple of Verdict
        The same for the part as it is made.
    drive : Drive
        With the part as it is made.
    tried : tuple of Tried
        Sizes of the catalogue, the smallest first.
    skipped : tuple of str
        Paths for want of which some checks do not count.
    series : str
        What the sizes were rounded up to.
    """

    part: str
    subject: str
    exact: Mapping[str, float]
    values: Mapping[str, float | str | None]
    before: Mapping[str, float | str | None]
    limits: tuple[Verdict, ...]
    made: tuple[Verdict, ...]
    drive: Drive
    tried: tuple[Tried, ...] = ()
    skipped: tuple[str, ...] = ()
    series: str = "step"

    @property
    def governing(self) -> Verdict | None:
        """The check that decides the size."""
        return foremost_of(self.limits, used) if self.limits else None

    @property
    def found(self) -> bool:
        """Whether any size passes."""
        return bool(self.values)


def used(verdict: Verdict) -> float:
    """Return the largest utilisation of a verdict."""
    return float(np.max(verdict.utilisation))
