"""The axes of a map of stability: what runs along them, in which unit."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.answers.quantity import Quantity
from cardan.maths.arrays import Array
from cardan.texts import _
from cardan.units import DIMENSIONS

from .torsion_stability import JOINT_ANGLE, Stability

SPEED = "duty.speed"
"""Path of the input speed, without unit."""


@dataclass(frozen=True, eq=False, kw_only=True)
class MapAxis:
    """What varies along an axis of a map."""

    key: str  # its path without unit
    label: str
    dimension: str  # dimension, unit: of the values, empty where they have none
    unit: str
    values: Array  # (s,): in that unit
    here: float | None  # value of the drive itself, in that unit

    @property
    def factor(self) -> float:
        """From the unit to SI."""
        return DIMENSIONS[self.dimension][self.unit] if self.dimension else 1.0

    @property
    def si(self) -> Array:
        """The values in SI."""
        return np.asarray(self.values, dtype=float) * self.factor

    def quantity(self, value: float, digits: int = 4, *, trim: bool = True) -> Quantity:
        """Return a value in the unit of the axis as a quantity."""
        return Quantity(float(value) * self.factor, self.dimension, digits, unit=self.unit, trim=trim)


def map_axes(found: Stability) -> tuple[MapAxis, ...]:
    """Return the axes of a map in the order of its paths; none of a single point."""
    here = dict(found.here)
    return tuple(
        _axis(path, values, dimension, unit, here.get(path))
        for (path, values), (dimension, unit) in zip(found.over, found.units, strict=True)
    )


def _axis(path: str, values: Array, dimension: str, unit: str, here: float | None) -> MapAxis:
    owner, dot, last = path.rpartition(".")
    bare = owner + dot + (last.replace(f"_{unit}", "", 1) if unit else last)
    key = "joint_angle" if path == JOINT_ANGLE else bare
    label = _("largest joint angle") if path == JOINT_ANGLE else _("input speed") if bare == SPEED else bare
    return MapAxis(key=key, label=label, dimension=dimension, unit=unit, values=values, here=here)
