"""What holds for the drive as a whole."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.units import quantity

from .joints.joint import Point


@dataclass(frozen=True, kw_only=True, slots=True)
class Settings:
    """Surroundings of the drive."""

    gravity: Point = quantity("acceleration", (0.0, 0.0, -9.80665), doc="acceleration of free fall [x, y, z]")
