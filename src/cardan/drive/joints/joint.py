"""What every kind of joint has: a place in the drive, and a law of motion."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, TypeAlias

import numpy as np

from cardan.drive.accuracy import Error, Tolerance
from cardan.drive.cross import Cross
from cardan.drive.inspection import Inspection
from cardan.drive.joint_parts import Needles, Rating, Yoke
from cardan.errors import Problem
from cardan.maths.arrays import Array, unit_complex
from cardan.maths.kernel import mobius
from cardan.texts import _
from cardan.units import plain, quantity

Point: TypeAlias = tuple[float, float, float]
Box: TypeAlias = tuple[tuple[float, float], tuple[float, float], tuple[float, float]]

CROSS_ONLY = frozenset(
    ("friction", "material_friction", "fit", "cross", "needles", "yoke", "inspection", "error", "tolerance")
)
"""Fields that only a joint with one cross can use."""


PLACES = 360
"""Places in a turn at which a law is looked at for its second order."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Joint:
    """A joint and its place, in one of three forms: its centre, or its bend and plane, or neither (slopes).

    A kind says how it turns by `pair`, or by `deviation` where its map of the circle is no Möbius map. Its marks are a
    line on the driving side and one on the driven side, from which yoke angles count: the yokes of a cross joint.
    """

    kind: ClassVar[str]

    foreign: ClassVar[frozenset[str]] = frozenset()
    """Fields of every joint that mean nothing in one of this kind."""

    crossed: ClassVar[bool] = False
    """Whether its marks are the arms of one cross, a quarter turn apart; else they lie on one line when straight."""

    fixed: ClassVar[bool] = False
    """Whether it holds both shafts at its centre and passes on one couple, so that forces follow from statics."""

    steepest: ClassVar[float] = math.pi / 4
    """Bend [rad] above which no real joint of this kind works."""

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

    def pair(self, bend: Array) -> mobius.Pair | None:
        """Return the joint's Möbius map, with real parts, for bends (...) [rad]; None where it has none."""
        raise NotImplementedError

    def near_pair(self, bend: Array) -> mobius.Pair:
        """Return the joint's Möbius map, or the one with the second order of its law: for loads, not for motion."""
        found = self.pair(bend)
        if found is not None:
            return found
        theta = np.arange(PLACES) * (2.0 * np.pi / PLACES)
        with np.errstate(invalid="ignore", divide="ignore"):
            each = [self.deviation(theta, one)[0] @ np.sin(2.0 * theta) for one in np.ravel(np.asarray(bend))]
        tau = np.reshape(np.asarray(each), np.shape(bend)) * (2.0 / PLACES)
        root = np.sqrt(1.0 - tau * tau)
        return (1.0 + 0.0j) / root, (-1.0 + 0.0j) * tau / root

    def deviation(self, angle: Array, bend: Array) -> tuple[Array, Array, Array]:
        """Return how far the driven side runs ahead of the driving side, with two derivatives.

        Parameters
        ----------
        angle : array (...) [rad]
            θ, angle of the driving mark from the plane of the shafts.
        bend : array (...) [rad]
            α.

        Returns
        -------
        lead, ratio, slope : arrays (...) [rad, 1, 1/rad]
            T(θ) - θ, T' and T'', T the angle of the driven mark, less a quarter turn where the joint has a cross.
        """
        pair = self.pair(bend)
        assert pair is not None, self.kind
        return mobius.course(pair, unit_complex(2.0 * angle))

    def own_problems(self) -> Iterator[Problem]:
        """Yield what contradicts itself in the fields of this kind, each path from the joint on."""
        yield from ()


def both_or_none(joint: Joint, *names: str) -> Iterator[Problem]:
    """Yield those fields that are missing where another one of them is given."""
    missing = [name for name in names if getattr(joint, name) is None]
    if len(missing) < len(names):
        given = next(name for name in names if name not in missing)
        for name in missing:
            yield Problem(name, _("missing; it goes with {other}").format(other=given), "missing")
