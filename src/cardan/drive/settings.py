"""What holds for the drive as a whole: surroundings, poses, how it steers; and the title block of its report."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

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


@dataclass(frozen=True, kw_only=True, slots=True)
class TitleBlock:
    """Whom the report is for and who answers for it."""

    client: str = plain("", doc="client, in the head of the report")
    project: str = plain("", doc="project, in the head of the report")
    drawing_number: str = plain("", doc="number of the drawing, in the head of the report")
    revision: str = plain("", doc="revision of the drawing, in the head of the report")
    author: str = plain("", doc="author of the report, in its head")
    checked_by: str = plain("", doc="who checked the report, in its head")
    date: str = plain("", doc="date of the report, told in its head")
    logo: str = plain("", doc="PNG or SVG file with the logo in the head of the report, beside this file")


Value: TypeAlias = float | tuple[float, ...] | bool | str
Change: TypeAlias = tuple[str, Value]


@dataclass(frozen=True, kw_only=True, slots=True)
class Pose:
    """A named set of changed fields and the share of time spent so."""

    name: str = plain(doc="name of the pose")
    share: float | None = quantity("share", None, doc="share of running time in this pose", low=0.0, high=1.0)
    set: tuple[Change, ...] = plain(doc='changed fields by path: { "joints[1].centre_mm" = [1200, 0, -150] }')


@dataclass(frozen=True, kw_only=True, slots=True)
class Steering:
    """What a drive is to do as a steering column; its start position is straight ahead."""

    lock: float = quantity("angle", doc="turn of the steering wheel from straight ahead to either lock", above=0.0)
    centre_ratio: float = plain(
        1.0, doc="speed ratio of output to steering wheel wanted straight ahead: 1 as uniform as can be", above=0.0
    )
