"""What every kind of joint has: a place in the drive."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, TypeAlias

from cardan.drive.accuracy import Error, Tolerance
from cardan.drive.cross import Cross
from cardan.drive.inspection import Inspection
from cardan.drive.joint_parts import Needles, Rating, Yoke
from cardan.units import plain, quantity

Point: TypeAlias = tuple[float, float, float]
Box: TypeAlias = tuple[tuple[float, float], tuple[float, float], tuple[float, float]]


@dataclass(frozen=True, kw_only=True, slots=True)
class Joint:
    """A joint and its place, in one of three forms: its centre, or its bend and plane, or neither (slopes)."""

    kind: ClassVar[str]

    name: str = plain("", doc="name of the joint, for tables and pictures")
    type: str = plain("", doc="type of joint in the catalogue, with its limits")
    size: str = plain("", doc="size of a maker's series in the catalogue, with its dimensions and ratings")
    centre: Point | None = quantity("length", None, doc="joint centre [x, y, z], z up")
    bend: float | None = quantity(
        "angle", None, doc="bend angle between the joint's two shafts", low=0.0, below=math.pi / 2
    )
    plane_twist: float | None = quantity(
        "angle",
        None,
        doc="angle from the plane of the joint before to this joint's plane, about the shaft between them",
    )
    move_within: Box | None = quantity(
        "length", None, doc="box [[x0, x1], [y0, y1], [z0, z1]] in which layout synthesis may put the centre"
    )
    friction: float | None = plain(
        None, doc="reduced coefficient of friction of the journals in their bearings", low=0.0
    )
    material_friction: float | None = plain(
        None,
        doc="coefficient of friction of the materials of plain journals, from which the reduced one follows",
        low=0.0,
    )
    fit: str = plain(
        "new",
        doc="how plain journals bear: new (evenly pressed) or run in (pressed as a cosine)",
        choices=("new", "run_in"),
    )
    backlash: float = quantity("angle", 0.0, doc="whole angular play, as its driving shaft feels it", low=0.0)
    cross: Cross | None = plain(None, doc="cross of the joint")
    needles: Needles | None = plain(None, doc="needle bearings of the cross")
    yoke: Yoke | None = plain(None, doc="yokes of the joint")
    rating: Rating | None = plain(None, doc="what the maker allows")
    inspection: Inspection | None = plain(None, doc="what was measured on yoke and cross")
    error: Error | None = plain(None, doc="manufacturing errors of the joint, as measured")
    tolerance: Tolerance | None = plain(None, doc="tolerances of the joint, each to both sides")
