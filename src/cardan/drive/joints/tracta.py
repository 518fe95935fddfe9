"""The Tracta joint."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, ClassVar

from cardan.drive.shapes import ACROSS
from cardan.errors import Problem
from cardan.maths.arrays import Array, ArrayLike, floats, namespace
from cardan.maths.kernel import frames, mobius
from cardan.maths.kernel.meshes import ball, circle, placed, plate
from cardan.texts import _, mark
from cardan.units import quantity

from .common import laws as tilted_plane
from .common import site as drawn
from .common.inner import ARM, DRIVEN, DRIVING, InnerPair, Stance, carried
from .common.site import Site
from .joint import CROSS_ONLY, Inside, Joint, both_or_none, missed


@dataclass(frozen=True, kw_only=True, slots=True)
class Tracta(Joint):
    """Tracta joint: two forks and a grooved tongue between them; even where both forks are alike."""

    kind: ClassVar[str] = "tracta"
    title: ClassVar[str] = mark("Tracta")
    types: ClassVar[tuple[str, ...]] = ("tracta",)
    foreign: ClassVar[frozenset[str]] = CROSS_ONLY - {"friction"}
    rubbing: ClassVar[tuple[str, ...]] = (
        "driving_distance", "driven_distance", "swivel_diameter", "swivel_length", "tongue_length",
    )  # fmt: skip
    fixed: ClassVar[bool] = True
    law_sizes: ClassVar[tuple[str, ...]] = ("driving_distance", "driven_distance")
    centred: ClassVar[bool] = True
    steepest: ClassVar[float] = math.radians(50.0)
    stays: ClassVar[str] = mark("its halves slide on each other, so that both shafts stay in their bearings")

    driving_distance: float | None = quantity(
        "length", None, doc="from the joint centre to the middle of the groove of the driving fork", above=0.0
    )
    driven_distance: float | None = quantity(
        "length", None, doc="from the joint centre to the middle of the groove of the driven fork", above=0.0
    )

    swivel_diameter: float | None = quantity(
        "length", None, doc="diameter at which both halves swivel in their forks", above=0.0
    )
    swivel_length: float | None = quantity(
        "length", None, doc="distance of the middles of the two faces of a half that bear in its fork", above=0.0
    )
    tongue_length: float | None = quantity(
        "length", None, doc="distance of the places at which the tongue bears in its slot, along it", above=0.0
    )

    swivel_width: float | None = quantity(
        "length", None, doc="width of each face of a half that bears in its fork, along its axis", above=0.0
    )
    tongue_width: float | None = quantity(
        "length", None, doc="width of each of the places at which the tongue bears in its slot, along it", above=0.0
    )
    tongue_height: float | None = quantity("length", None, doc="height of these places, across the tongue", above=0.0)

    def own_problems(self) -> Iterator[Problem]:
        """Yield sizes that stand alone."""
        yield from both_or_none(self, "driving_distance", "driven_distance")
        yield from both_or_none(self, "swivel_diameter", "swivel_length", "tongue_length")
        yield from both_or_none(self, "tongue_width", "tongue_height")

    def pair(self, joint_angle: Array) -> mobius.Pair:
        """Return the map of the joint, the identity where both distances are equal."""
        if self.driving_distance is None or self.driven_distance is None:
            return mobius.turn(0.0 * joint_angle)
        return pair(joint_angle, self.driving_distance, self.driven_distance)

    def mechanism(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield its two halves, each swivelling in its fork, and the face on which they slide on each other.

        Its forks stand alike where their distances are not given.
        """
        usual = ARM * stance.length
        one, two = mark("driving half of joint {number}"), mark("driven half of joint {number}")
        first = stance.centre - (self.driving_distance or usual) * stance.before
        last = stance.centre + (self.driven_distance or usual) * stance.after
        u, v = stance.driving, stance.driven
        face = frames.unit(frames.cross(u, last - first + 0.0 * u))
        swivel = 0.5 * (self.swivel_diameter or 0.0), self.swivel_length or math.inf
        tongue = 0.5 * (self.tongue_length or 0.0), self.tongue_length or math.inf
        areas = (
            (self.swivel_diameter or 0.0) * (self.swivel_width or 0.0),
            (self.tongue_width or 0.0) * (self.tongue_height or 0.0),
        )
        for name, kind, links, at, axis, sizes in (
            (mark("driving swivel of joint {number}"), "R", (DRIVING, one), first, u, swivel),
            (mark("tongue of joint {number}"), "E", (one, two), stance.centre, face, tongue),
            (mark("driven swivel of joint {number}"), "R", (two, DRIVEN), last, v, swivel),
        ):
            lever, spread, area = *sizes, areas[kind == "E"]
            own: dict[str, Any] = {"rubs": True, "lever": lever, "spread": spread, "area": area}
            yield InnerPair(name=name, type=kind, links=links, point=at, axis=axis, **own)

    def loaded(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield the same, where the distances are given."""
        if self.driving_distance is not None:
            yield from self.mechanism(stance)

    def carried(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield bearings of both shafts: it does not hold its centre by itself."""
        return carried(stance, loose=True)

    def inside(self, joint_angle: float) -> Iterator[Inside]:
        """Yield how far its tongue misses the bisecting plane."""
        if self.driving_distance is not None and self.driven_distance is not None:
            yield missed(float(tilt(joint_angle, self.driving_distance, self.driven_distance)))

    def solid(self, site: Site) -> None:
        """Add its two forks and the slotted halves between them."""
        size, stance = site.size, site.stance
        tip = -0.3 * size.radius
        drawn.yoke(site, site.driving, size, bore=False, tip=tip)
        drawn.yoke(site, site.driven, size, bore=False, tip=tip, quarter=True)
        own = site.along(stance.centre, stance.middle, stance.halving(stance.theta))
        inner = 0.96 * (size.radius - 0.5 * size.ear)
        halves = (placed(ball(inner, 22, 0.06, 1.0), None), placed(ball(inner, 22, -1.0, -0.06), None))
        tongue = plate(circle(0.86 * inner, 24), -0.3 * inner, 0.3 * inner)
        text = site.said(_("tongue of {joint}, in the bisecting plane"))
        site.add("tongue", text, own, *halves, placed(tongue, ACROSS), shade=0.2)


# The Tracta joint: two forks with grooves, and a tongue between them that turns about the line of the fork centres.
#
# The centres A and B of the two grooves lie on the axes of the shafts, at OA and OB from their intersection. The tongue
# lies in a plane through AB: a double joint with AB as its middle shaft, even exactly where OA = OB.


def tilt(joint_angle: ArrayLike, first: ArrayLike, second: ArrayLike) -> Array:
    """Return by how much the angle at A exceeds half the bend.

    joint_angle (...) [rad]: α in [0, π/2), angle between the shafts; first, second (...) [m]: OA, OB > 0.
    Returns (...) [rad]: η = arctan[(OB - OA)/(OB + OA) tan(α/2)], by the law of tangents; exactly 0 for equal lengths.
    """
    alpha, one, two = floats(joint_angle, first, second)
    xp = namespace(alpha, one, two)
    return xp.atan((two - one) / (two + one) * xp.tan(0.5 * alpha))


def joint_angles(joint_angle: ArrayLike, first: ArrayLike, second: ArrayLike) -> tuple[Array, Array]:
    """Return the angles between the shafts and the line of the fork centres.

    joint_angle (...) [rad]: α in [0, π/2); first, second (...) [m]: OA, OB > 0.
    Returns at_first, at_second (...) [rad]: α_1 = atan2(OB sin α, OA + OB cos α) and α_2 = α - α_1, each as half the
    joint angle and the tilt.
    """
    alpha, one, two = floats(joint_angle, first, second)
    eta = tilt(alpha, one, two)
    return 0.5 * alpha + eta, 0.5 * alpha - eta


def pair(joint_angle: ArrayLike, first: ArrayLike, second: ArrayLike) -> mobius.Pair:
    """Return the map of the circle, tan φ_2 = (cos α_2/cos α_1) tan φ_1.

    joint_angle (...) [rad]: α in [0, π/2); first, second (...) [m]: OA, OB > 0.
    Returns (...): the identity where OA = OB.
    """
    alpha, one, two = floats(joint_angle, first, second)
    return tilted_plane.pair(alpha, -tilt(alpha, one, two))


def deviation(angle: ArrayLike, joint_angle: ArrayLike, first: ArrayLike, second: ArrayLike) -> Array:
    """Return how far shaft 2 runs ahead of shaft 1, φ_2 - φ_1.

    angle (...) [rad]: φ_1, from the plane of the shafts, of the axis about which the tongue's block swivels in its
    fork.
    joint_angle (...) [rad]: α in [0, π/2); first, second (...) [m]: OA, OB > 0.
    Returns (...) [rad].
    """
    alpha, one, two = floats(joint_angle, first, second)
    return tilted_plane.deviation(angle, alpha, -tilt(alpha, one, two))


def speed_fluctuation(joint_angle: ArrayLike, first: ArrayLike, second: ArrayLike) -> Array:
    """Return δ = |κ - 1/κ|, κ = cos α_2/cos α_1: largest less smallest speed ratio.

    joint_angle (...) [rad]: α in [0, π/2); first, second (...) [m]: OA, OB > 0.
    """
    alpha, one, two = floats(joint_angle, first, second)
    return tilted_plane.speed_fluctuation(alpha, tilt(alpha, one, two))
