"""Two Hooke joints close together, with a device that shares the joint angle between them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np

from cardan.drive.shapes import caps, cross_body, fork
from cardan.errors import Problem
from cardan.maths.arrays import Array, ArrayLike, floats, namespace
from cardan.maths.kernel import frames, mobius
from cardan.maths.kernel.meshes import ball, placed, revolved
from cardan.texts import _, mark
from cardan.units import plain, quantity

from .common import laws as tilted_plane
from .common import site as drawn
from .common.inner import DRIVEN, DRIVING, InnerPair, Stance
from .common.site import BACK, Site
from .joint import CROSS_ONLY, EXACT, Inside, Joint, both_or_none

APART = 0.1  # distance of both joint centres over the length of the shaft behind, where nobody says it


@dataclass(frozen=True, kw_only=True, slots=True)
class DoubleCardan(Joint):
    """Double Hooke joint, its inner yokes in one plane, centred by a ball on one shaft or by an exact device."""

    kind: ClassVar[str] = "double_cardan"
    title: ClassVar[str] = mark("double cardan")
    types: ClassVar[tuple[str, ...]] = ("double_centred", "double_frame")
    foreign: ClassVar[frozenset[str]] = CROSS_ONLY - {"friction"}
    rubbing: ClassVar[tuple[str, ...]] = ("centre_distance", "journal_span", "journal_diameter")
    rated: ClassVar[tuple[str, ...]] = (*rubbing, "bearing_capacity")
    fixed: ClassVar[bool] = True
    law_sizes: ClassVar[tuple[str, ...]] = ("centring_ratio",)
    place_sizes: ClassVar[tuple[str, ...]] = ("centring_ratio",)
    stays: ClassVar[str] = mark("without centre_distance it is open how far its ball stands off")
    steepest: ClassVar[float] = 0.5 * math.pi

    centring_ratio: float | None = plain(
        None,
        doc="distance of the centring ball from the joint centre on its own shaft, over the distance of both centres; "
        "without it the device halves the joint angle exactly",
        above=0.0,
        below=1.0,
    )
    ball_on: str = plain(
        "driving", doc="shaft that carries the centring ball: driving or driven", choices=("driving", "driven")
    )
    device: str = plain(
        "lever",
        doc="what halves the joint angle where no ball does: a lever through a slotted sphere, or a slotted frame with "
        "a ball tip on either side, of which one repeats the other",
        choices=("lever", "frame"),
    )
    centre_distance: float | None = quantity("length", None, doc="distance of the centres of both crosses", above=0.0)
    journal_span: float | None = quantity(
        "length", None, doc="distance between the middles of opposite bearings of both crosses", above=0.0
    )
    journal_diameter: float | None = quantity("length", None, doc="diameter of the journals of both crosses", above=0.0)

    bearing_capacity: float | None = quantity(
        "force", None, doc="dynamic load rating of one bearing of either cross", above=0.0
    )

    def own_problems(self) -> Iterator[Problem]:
        """Yield journals of which one size is missing, and a frame beside a ball."""
        yield from both_or_none(self, "journal_span", "journal_diameter")
        if self.centring_ratio is not None and self.device != "lever":
            text = _("of no use: with centring_ratio a ball centres the joint")
            yield Problem("device", text, "inconsistent")

    @property
    def repeated(self) -> int:
        """The second ball tip of a slotted frame."""
        return int(self.device == "frame")

    def pair(self, joint_angle: Array) -> mobius.Pair:
        """Return the map of both joints together."""
        if self.centring_ratio is None:
            return mobius.turn(0.0 * joint_angle)
        xp = namespace(joint_angle)
        pair = centred_pair(joint_angle, xp.asarray(self.centring_ratio, dtype=xp.float64))
        return pair if self.ball_on == "driving" else mobius.inverse(pair)

    def mechanism(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield both crosses, the piece between them and what centres them, see `_centring`.

        Without a ball and the distance of both centres it is told as what its exact device holds.
        """
        if self.centring_ratio is None and self.centre_distance is None:
            yield from Joint.mechanism(self, stance)
            return
        before, behind = self._spread(stance.joint_angle, self.centre_distance or APART * stance.length)
        one, two = stance.centre - before * stance.before, stance.centre + behind * stance.after
        u, between = stance.driving, frames.unit(two - one)
        inner = frames.unit(frames.cross(between + 0.0 * u, u))
        outer = frames.unit(frames.cross(stance.after + 0.0 * u, inner))
        first, middle, last = (
            mark("driving cross of joint {number}"),
            mark("middle piece of joint {number}"),
            mark("driven cross of joint {number}"),
        )
        for name, links, at, axis in (
            (mark("driving pin of joint {number}"), (DRIVING, first), one, u),
            (mark("driving pin of the middle piece of joint {number}"), (first, middle), one, inner),
            (mark("driven pin of the middle piece of joint {number}"), (middle, last), two, inner),
            (mark("driven pin of joint {number}"), (last, DRIVEN), two, outer),
        ):
            sizes = 0.5 * (self.journal_diameter or 0.0), self.journal_span or math.inf
            yield InnerPair(
                name=name, type="R", links=links, point=at, axis=axis, rubs=True, lever=sizes[0], spread=sizes[1]
            )
        yield from self._centring(stance, middle, between)

    def _centring(self, stance: Stance, middle: str, between: Array) -> Iterator[InnerPair]:
        """Yield the ball that slides on the other shaft, or the exact device, `middle` the piece between both crosses.

        The device is that of a slotted sphere: a ball where both shafts meet slides in a bore of either of them, and
        the middle piece holds it in its middle plane, so that both crosses stand equally far from it.
        """
        at = stance.centre
        if self.centring_ratio is not None:
            ball, on = (
                ((DRIVEN, DRIVING), stance.after) if self.ball_on == "driving" else ((DRIVING, DRIVEN), stance.before)
            )
            yield InnerPair(name=mark("ball of joint {number}"), type="SG", links=ball, point=at, axis=on, rubs=True)
            return
        part = mark("centring ball of joint {number}")
        for name, kind, link, axis in (
            (mark("driving bore of joint {number}"), "SG", DRIVING, stance.before),
            (mark("driven bore of joint {number}"), "SG", DRIVEN, stance.after),
            (mark("slot of joint {number}"), "PT", middle, between),
        ):
            yield InnerPair(name=name, type=kind, links=(link, part), point=at, axis=axis, rubs=True)

    def loaded(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield the same, where the distance of both centres is given."""
        if self.centre_distance is not None:
            yield from self.mechanism(stance)

    def inside(self, joint_angle: float) -> Iterator[Inside]:
        """Yield how it shares its joint angle, and the way of its ball."""
        ratio = self.centring_ratio
        if ratio is None:
            return
        joint_angles = split(joint_angle, ratio)
        first, second = joint_angles if self.ball_on == "driving" else joint_angles[::-1]
        yield Inside(
            key="driving_joint_angle", meaning=_("joint angle of the joint on the driving side"), value=float(first)
        )
        yield Inside(
            key="driven_joint_angle", meaning=_("joint angle of the joint on the driven side"), value=float(second)
        )
        text = _("way of the ball along the other shaft, over the distance of both joint centres")
        way = float(slide(joint_angle, ratio) - slide(0.0, ratio))
        yield Inside(key="ball_way", meaning=text, value=way, dimension=None)

    def placing(self) -> tuple[str, ...]:
        """Return its centring ratio, where the distance of both centres tells how far that moves the ball."""
        return () if self.centre_distance is None else super(DoubleCardan, self).placing()

    def head(self, stance: Stance, off: Mapping[str, Any] = EXACT) -> Array:
        """Return where its ball stands, the driving yoke in its place: on the driving shaft, farther on by the error.

        Of a ball on the driven shaft the triangle of both centres and the ball tells how far.
        """
        error, ratio = off.get("centring_ratio"), self.centring_ratio
        if error is None or ratio is None or self.centre_distance is None:
            return stance.centre
        drawn_angle = stance.joint_angle if stance.drawn_angle is None else stance.drawn_angle
        far = slide(stance.joint_angle, ratio + error) - slide(drawn_angle, ratio)
        far = error if self.ball_on == "driving" else far
        found: Array = stance.centre + np.asarray(self.centre_distance * far)[..., None] * stance.before
        return found

    def half_length(self, apart: float) -> float:
        """Return how far either cross stands off the centre [m]."""
        return apart

    def solid(self, site: Site) -> None:
        """Add two crosses, the piece between them and what centres it."""
        stance = site.stance
        size = replace(site.size, cavity=min(site.size.cavity, 0.72 * site.apart))
        before, behind = self._spread(stance.joint_angle, 2.0 * site.apart)
        one, two = stance.centre - before * stance.before, stance.centre + behind * stance.after
        between = frames.unit(two - one)
        u = stance.driving
        inner = frames.unit(frames.cross(np.broadcast_to(between, u.shape), u))
        outer = frames.unit(frames.cross(np.broadcast_to(stance.after, u.shape), inner))
        drawn.yoke(site, site.driving, size, away=before)
        drawn.yoke(site, site.driven, size, away=behind)
        half = 0.5 * float(np.linalg.norm(two - one))
        track = site.along(0.5 * (one + two), between, inner)
        made = fork(size.radius, size.ear, size.lug, size.cap, min(size.cavity, 0.75 * half), half, 0.75 * size.radius)
        bearings = caps(size.radius, size.ear, size.cap)
        ways = ((None, (-half, 0.0, 0.0)), (BACK, (half, 0.0, 0.0)))
        text = site.said(_("middle piece of {joint}"))
        site.add("middle yoke", text, track, *(placed(made, *way) for way in ways), shade=0.15)
        said = _("bearings of joint {number}").format(number=site.number)
        site.add("bearing cap", said, track, *(placed(bearings, *way) for way in ways), shade=0.35)
        shape = cross_body(size.radius, size.ear, size.journal)
        for at, first, second in ((one, u, inner), (two, inner, outer)):
            own = site.stage.track(at, first, second, frames.cross(first, second))
            site.add("cross", drawn.cross_text(site, size), own, shape)
        side, away = (site.driving, before) if self.ball_on == "driving" else (site.driven, behind)
        stem, far = 0.2 * size.radius, away + size.cavity
        rod = placed(revolved([(0.0, 0.0), (0.0, stem), (far, stem), (far, 0.0)], 14), side.turn)
        text = site.said(_("ball that centres {joint}"))
        site.add("centring", text, side.track, rod, ball(0.34 * size.radius, 18), shade=0.45)

    def _spread(self, joint_angle: float, apart: float) -> tuple[float, float]:
        """Return how far both crosses stand from where the shafts meet [m]; ``apart`` is their distance."""
        if self.centring_ratio is None:
            half = 0.5 * apart / math.cos(0.5 * joint_angle)
            return half, half
        fixed = self.centring_ratio * apart
        free = float(slide(joint_angle, self.centring_ratio)) * apart
        return (fixed, free) if self.ball_on == "driving" else (free, fixed)


# Double cardan joints whose middle is held by a centring device: two joints that share one bend.
#
# The joint centres O1 and O3 stand at the distance l; the axes of the outer shafts meet at O under the joint angle α,
# the first joint bends α12, the second α23, and α12 + α23 = α. A lever with a slotted sphere at O, or a slotted frame,
# halves the bend exactly. A ball on one shaft does so nearly: |OO1| = λl is fixed, |OO3| = x slides. All three axes lie
# in one plane and the inner yokes too, so that the whole is one map of the circle, see `cardan.maths.kernel.mobius`.


def lag(joint_angle: ArrayLike, share: ArrayLike) -> Array:
    """Return by how much a ball on one shaft misses half the joint angle, Δ = (α23 - α12)/2.

    joint_angle (...) [rad]: whole bend α in [0, π/2).
    share (...): centring ratio λ in (0, 1): distance of the ball from the first centre over that of the two centres.
    Returns (...) [rad].
    Δ = arcsin(λ sin α) - α/2 from the triangle O1 O O3, written without a difference of near numbers:
    sin Δ = sin(α/2) (4λ² cos²(α/2) - 1)/(2λ cos²(α/2) + √(1 - λ² sin² α)). Exact where Book (12) is not.
    """
    alpha, ratio = floats(joint_angle, share)
    xp = namespace(alpha, ratio)
    half = xp.cos(0.5 * alpha)
    twice = 2.0 * ratio * half
    below = twice * half + xp.sqrt(1.0 - (ratio * xp.sin(alpha)) ** 2)
    return xp.asin(xp.sin(0.5 * alpha) * (twice - 1.0) * (twice + 1.0) / below)


def lag_book(joint_angle: ArrayLike, share: ArrayLike) -> Array:
    """Return the book's approximation of `lag`, for comparison.

    joint_angle (...) [rad]: whole bend α in [0, π/2); share (...): centring ratio λ in (0, 1).
    Returns (...) [rad].
    Book (12), which takes Δ for small, with its fraction turned over so that it never reads 0/0:
    t (2λ² (1 + cos α) - 1)/(1 + 2λ √(1 - λ² sin² α)), t = tan(α/2). Off by 0.0015° at 50° and λ = 1/2.
    """
    alpha, ratio = floats(joint_angle, share)
    xp = namespace(alpha, ratio)
    root = xp.sqrt(1.0 - (ratio * xp.sin(alpha)) ** 2)
    above = 2.0 * ratio * ratio * (1.0 + xp.cos(alpha)) - 1.0
    return xp.tan(0.5 * alpha) * above / (1.0 + 2.0 * ratio * root)


def split(joint_angle: ArrayLike, share: ArrayLike) -> tuple[Array, Array]:
    """Return the joint angles of the first and the second joint where a ball on one shaft centres them.

    joint_angle (...) [rad]: whole bend α in [0, π/2); share (...): centring ratio λ in (0, 1).
    Returns first, second (...) [rad]: α12 and α23.
    sin α23 = λ sin α, α12 = α - α23: the sines of the triangle, exact; Book (9).
    """
    (alpha,) = floats(joint_angle)
    missed = lag(alpha, share)
    return 0.5 * alpha - missed, 0.5 * alpha + missed


def slide(joint_angle: ArrayLike, share: ArrayLike) -> Array:
    """Return where the ball stands on the shaft it slides on, x/l: |OO3| over the distance of the centres.

    joint_angle (...) [rad]: whole bend α in [0, π/2); share (...): centring ratio λ in (0, 1).
    Returns (...).
    x/l = sin α12/sin α, the positive root of Book (8), in the form in which a straight joint is no exception:
    √(1 - λ² sin² α) - λ cos α.
    """
    alpha, ratio = floats(joint_angle, share)
    xp = namespace(alpha, ratio)
    return xp.sqrt(1.0 - (ratio * xp.sin(alpha)) ** 2) - ratio * xp.cos(alpha)


def even_share(joint_angle: ArrayLike) -> Array:
    """Return the centring ratio that halves one joint angle exactly.

    joint_angle (...) [rad]: whole bend α in [0, π/2).
    λ = 1/(2 cos(α/2)), the closed form of what Book p. 55 leaves as an equation.
    """
    (alpha,) = floats(joint_angle)
    return 0.5 / namespace(alpha).cos(0.5 * alpha)


def centred_pair(joint_angle: ArrayLike, share: ArrayLike) -> mobius.Pair:
    """Return the map of the circle of a double joint centred by a ball on the driving shaft, over its whole bend.

    joint_angle (...) [rad]: whole bend α in [0, π/2); share (...): centring ratio λ in (0, 1).
    Returns (...).
    tan φ3 = κ tan φ1 with κ = cos α23/cos α12, angles from the driving yoke in the plane of the axes: the first joint
    leads by 1/cos α12, the second takes cos α23 of it back. It turns as contact in a plane Δ off the middle would.
    """
    alpha, ratio = floats(joint_angle, share)
    return tilted_plane.pair(alpha, lag(alpha, ratio))


def deviation(angle: ArrayLike, joint_angle: ArrayLike, share: ArrayLike) -> Array:
    """Return how far the output of a double joint centred by a ball runs ahead of its input, φ3 - φ1.

    angle (...) [rad]: input angle φ1, from the driving yoke in the plane of the axes.
    joint_angle (...) [rad]: whole bend α in [0, π/2); share (...): centring ratio λ in (0, 1).
    Returns (...) [rad].
    """
    phi, alpha, ratio = floats(angle, joint_angle, share)
    return tilted_plane.deviation(phi, alpha, lag(alpha, ratio))


def gain(first: ArrayLike, second: ArrayLike, *, crossed: bool = False) -> Array:
    """Return the ratio κ between which and 1/κ two joints in one plane swing.

    first, second (...) [rad]: bends α12 and α23, each in [0, π/2).
    crossed: whether the inner yokes stand at right angles: what the joints do then adds up, instead of cancelling.
    Returns (...).
    κ = cos α23/cos α12, crossed 1/(cos α12 cos α23).
    """
    one, other = floats(first, second)
    xp = namespace(one, other)
    return 1.0 / (xp.cos(one) * xp.cos(other)) if crossed else xp.cos(other) / xp.cos(one)


def unevenness(first: ArrayLike, second: ArrayLike, *, crossed: bool = False) -> Array:
    """Return κ - 1/κ of `gain`, whose size is the speed fluctuation δ.

    first, second (...) [rad]: bends α12 and α23, each in [0, π/2).
    crossed: whether the inner yokes stand at right angles.
    sin(α12 + α23) sin(α12 - α23)/(cos α12 cos α23), crossed (1 - c²)/c with c = cos α12 cos α23, both without a
    difference of near numbers. With α12, α23 = α/2 ∓ Δ its size is about 4 |Δ| tan(α/2).
    """
    one, other = floats(first, second)
    xp = namespace(one, other)
    both = xp.cos(one) * xp.cos(other)
    if crossed:
        return (xp.sin(one) ** 2 + (xp.cos(one) * xp.sin(other)) ** 2) / both
    return xp.sin(one + other) * xp.sin(one - other) / both
