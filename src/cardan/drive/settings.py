"""What holds for the drive as a whole."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.units import plain, quantity

from .joints.joint import Point


@dataclass(frozen=True, kw_only=True, slots=True)
class Settings:
    """Surroundings of the drive."""

    gravity: Point = quantity("acceleration", (0.0, 0.0, -9.80665), doc="acceleration of free fall [x, y, z]")
    norm: str = plain(
        "",
        doc="row of angle_norms in the catalogue: limits of angular accelerations; without it that of the application",
    )
    catalogues: tuple[str, ...] = plain((), doc="catalogue files of the user's own, beside this file")
