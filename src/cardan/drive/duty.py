"""What the drive does, and the limits it is to keep."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.units import quantity


@dataclass(frozen=True, kw_only=True, slots=True)
class Duty:
    """Steady running of the input shaft."""

    speed: float | None = quantity("angular_speed", None, doc="input speed; negative runs the other way")
    acceleration: float = quantity("angular_acceleration", 0.0, doc="input angular acceleration")


@dataclass(frozen=True, kw_only=True, slots=True)
class Limits:
    """Limits that the user sets over the built-in ones."""

    spline_overlap: float | None = quantity("length", None, doc="smallest engaged spline length allowed", above=0.0)
