"""The Clemens coupling: hinged arms that meet, each end on a circle; other couplings with circular profiles alike."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields, replace
from typing import Any, ClassVar

import numpy as np

from cardan.drive.shapes import ring
from cardan.errors import Problem
from cardan.maths.arrays import Array, ArrayLike, floats, namespace
from cardan.maths.kernel import frames, mobius
from cardan.maths.kernel.meshes import Surface, ball, joined, placed, revolved
from cardan.texts import _, mark
from cardan.units import KEY, Key, plain, quantity

from .common.inner import DRIVEN, DRIVING, InnerPair, Stance
from .common.laws import beside, contact_push, lost_contact, nearest, reached
from .common.site import Site
from .joint import CROSS_ONLY, FREE, REFUSALS, Joint, both_or_none
from .pin_coupling import wrapped


@dataclass(frozen=True, kw_only=True, slots=True)
class ClemensProfile:
    """Circular profile of a coupling in the meridian plane of its shaft: the path of an arm's end."""

    axial: float = quantity("length", doc="centre of the circle, along its own shaft from the joint centre")
    radial: float = quantity("length", doc="centre of the circle, from the axis of its shaft")
    radius: float = quantity("length", doc="radius of the circle: length of the arm", above=0.0)


SIDES = ("driving", "driven")
PROFILES = tuple(f"{side}_{one.name}" for side in SIDES for one in fields(ClemensProfile))
"""Sizes of both profiles."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Clemens(Joint):
    """Clemens coupling, or another one with circular profiles: even where both profiles are alike."""

    kind: ClassVar[str] = "clemens"
    title: ClassVar[str] = mark("Clemens")
    types: ClassVar[tuple[str, ...]] = ("clemens",)
    foreign: ClassVar[frozenset[str]] = CROSS_ONLY - {"friction"}
    rubbing: ClassVar[tuple[str, ...]] = ("driving", "hinge_diameter", "hinge_length", "tip_diameter")
    loose: ClassVar[bool] = True
    many_angles: ClassVar[bool] = True
    law_sizes: ClassVar[tuple[str, ...]] = PROFILES
    steepest: ClassVar[float] = 0.5 * math.pi
    refusals: ClassVar[Mapping[str, str]] = {
        **REFUSALS,
        "forces": mark("without its profile it is open where its arms touch, and so with what force"),
    }
    stays: ClassVar[str] = FREE

    driving: ClemensProfile | None = plain(
        None, doc="profile of the driving shaft; without it the coupling counts as uniform"
    )
    driven: ClemensProfile | None = plain(
        None, doc="profile of the driven shaft; as that of the driving one when not given"
    )
    hinge_diameter: float | None = quantity("length", None, doc="diameter of the pins of the arms", above=0.0)
    hinge_length: float | None = quantity(
        "length", None, doc="distance of the middles of both bearings of such a pin", above=0.0
    )
    hinge_width: float | None = quantity("length", None, doc="width of each bearing of such a pin", above=0.0)
    tip_diameter: float | None = quantity("length", None, doc="diameter of the ball in which two arms meet", above=0.0)

    def own_problems(self) -> Iterator[Problem]:
        """Yield a driven profile without a driving one."""
        if self.driven is not None and self.driving is None:
            yield Problem("driving", _("missing; it goes with {other}").format(other="driven"), "missing")
        yield from both_or_none(self, "hinge_diameter", "hinge_length", "tip_diameter")

    @classmethod
    def size_keys(cls) -> dict[str, Key]:
        """Return what the sizes of both profiles mean."""
        return dict(zip(PROFILES, [one.metadata[KEY] for one in fields(ClemensProfile)] * 2, strict=True))

    def sizes(self) -> dict[str, float | None]:
        """Return the sizes of both profiles, the driven one as the driving one where it is not given."""
        both = self.driving, self.driving if self.driven is None else self.driven
        values = [None if side is None else getattr(side, one.name) for side in both for one in fields(ClemensProfile)]
        return dict(zip(PROFILES, values, strict=True))

    def sized(self, sizes: Mapping[str, Any]) -> Joint:
        """Return it with other sizes of its profiles."""
        whole = {**self.sizes(), **sizes}
        one, other = (
            ClemensProfile(**{f.name: whole[f"{side}_{f.name}"] for f in fields(ClemensProfile)}) for side in SIDES
        )
        return replace(self, driving=one, driven=other)

    def pair(self, joint_angle: Array) -> mobius.Pair | None:
        """Return the identity for profiles alike, nan where they do not meet all round; None for unlike ones."""
        if self.driven is not None and self.driven != self.driving:
            return None
        a, b = mobius.turn(0.0 * joint_angle)
        if self.driving is None:
            return a, b
        xp = namespace(joint_angle)
        return xp.where(meets(self.driving, joint_angle), a, xp.nan), b

    def deviation(self, angle: Array, joint_angle: Array) -> tuple[Array, Array, Array]:
        """Return the law of the contact of both profiles; nan where they do not meet."""
        if self.driving is None:
            return 0.0 * angle, 1.0 + 0.0 * angle, 0.0 * angle
        if self.driven is None or self.driven == self.driving:
            return Joint.deviation(self, angle, joint_angle)
        return reached(course(angle, joint_angle, *self._circles))

    @property
    def _circles(self) -> tuple[Circle, Circle]:
        """Both its profiles, where one is given."""
        assert self.driving is not None
        sides = self.driving, self.driving if self.driven is None else self.driven
        one, two = (Circle(axial=side.axial, radial=side.radial, radius=side.radius) for side in sides)
        return one, two

    def stuck(self, joint_angle: float) -> str:
        """Return where its arms do not meet."""
        plain_ = Joint.stuck(self, joint_angle)
        if self.driving is None:
            return plain_
        one, two = self._circles

        def missed(theta: Array) -> Array:
            def far(place: Array) -> Array:
                height, out = one.axial + one.radius * np.cos(place), one.radial + one.radius * np.sin(place)
                along, off = beside(height, out, theta[:, None], joint_angle)
                gap = np.abs(np.hypot(along - two.axial, off - two.radial) - two.radius)
                return np.where(out > 0.0, gap, np.inf)

            return nearest(far, np.linspace(0.0, 2.0 * np.pi, MISSED))

        why = lost_contact(lambda theta: course(theta, joint_angle, one, two), missed, joint_angle)
        return f"{plain_}: {why}" if why else plain_

    def mechanism(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield the two hinged arms that meet and carry; a contact without their profile."""
        if self.driving is None:
            yield from Joint.mechanism(self, stance)
            return
        one, other = self.driving, self.driving if self.driven is None else self.driven
        found = profile_contact(stance.theta, stance.joint_angle, *self._circles)
        back, u, v = -stance.before, stance.driving, stance.driven
        height, out = np.asarray(found.height1)[..., None], np.asarray(found.radius1)[..., None]
        at = stance.centre + height * back + out * u
        first = stance.centre + one.axial * back + one.radial * u
        last = stance.centre + other.axial * stance.after + other.radial * v
        arms = mark("driving arm of joint {number}"), mark("driven arm of joint {number}")
        for name, links, hinge, axis in (
            (mark("driving hinge of joint {number}"), (DRIVING, arms[0]), first, frames.cross(back + 0.0 * u, u)),
            (mark("driven hinge of joint {number}"), (arms[1], DRIVEN), last, frames.cross(stance.after + 0.0 * v, v)),
        ):
            lever, spread = 0.5 * (self.hinge_diameter or 0.0), self.hinge_length or math.inf
            own: dict[str, Any] = {
                "rubs": True,
                "lever": lever,
                "spread": spread,
                "area": 2.0 * lever * (self.hinge_width or 0.0),
            }
            yield InnerPair(name=name, type="R", links=links, point=hinge, axis=axis, **own)
        tip, ball = mark("contact of joint {number}"), 0.5 * (self.tip_diameter or 0.0)
        area = math.pi * ball * ball
        yield InnerPair(name=tip, type="S", links=arms, point=at, axis=u, rubs=True, lever=ball, area=area)

    def loaded(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield the same, where it is told how they touch."""
        if self.told:
            yield from self.mechanism(stance)

    @property
    def told(self) -> bool:
        """Whether its profile is given."""
        return self.driving is not None

    def push(self, angle: Array, joint_angle: Array) -> Array | None:
        """Return the force of the contact of its arms."""
        if self.driving is None:
            return None
        sides = self.driving, self.driving if self.driven is None else self.driven
        found = profile_contact(angle, joint_angle, *self._circles)
        ends = (found.height1, found.radius1), (found.height2, found.radius2)
        slopes = [
            np.stack((side.radial - np.asarray(out), np.asarray(height) - side.axial), axis=-1)
            for side, (height, out) in zip(sides, ends, strict=True)
        ]
        return contact_push(
            np.asarray(found.height1), np.asarray(found.radius1), angle, joint_angle, (slopes[0], slopes[1])
        )

    def solid(self, site: Site) -> None:
        """Add its hubs and its hinged arms, which meet in the bisecting plane."""
        stance, radius = site.stance, site.size.radius
        tan = np.tan(0.5 * stance.joint_angle)
        marks, axes = (stance.driving, stance.driven), (stance.before, stance.after)
        for side, mark_, axis in zip(site.sides, marks, axes, strict=True):
            profile = self.driving if side.driving or self.driven is None else self.driven
            axial, radial, arm = 1.0 * radius, 0.3 * radius, 1.2 * radius
            if profile is not None:
                axial, radial, arm = profile.axial, profile.radial, profile.radius
            reach = max(side.reach, 1.15 * axial)
            wide = max(1.25 * radial, 0.3 * arm)
            hub = revolved(
                [(0.9 * axial, 0.0), (0.9 * axial, 0.8 * wide), (0.94 * axial, wide), (1.08 * axial, wide),
                 (reach, side.body), (reach, 0.0)], 24,
            )  # fmt: skip
            site.add_to(side, side.yoke, site.said(_("hub of {joint}")), hub)
            away = (-1.0 if side.driving else 1.0) * axis
            inward = frames.cross(stance.normal, axis)
            for j in range(3):
                spread = np.full(len(mark_), j * 2.0 * np.pi / 3.0)
                way = frames.rotate(mark_, np.broadcast_to(axis, mark_.shape), spread)
                slope = (way @ inward) * tan
                half = (slope * axial + radial) / (1.0 + slope**2)
                left = half**2 - (axial**2 + radial**2 - arm**2) / (1.0 + slope**2)
                height = half + np.sqrt(np.maximum(left, 0.0))
                hinge = stance.centre + axial * away + radial * way
                tip = stance.centre + (slope * height)[:, None] * away + height[:, None] * way
                along = frames.unit(tip - hinge)
                across = frames.unit(frames.cross(np.broadcast_to(away, way.shape), way))
                own = site.stage.track(hinge, along, frames.cross(across, along), across)
                said = site.said(_("arm of {joint}"))
                site.stage.add("arm", side.number, site.path, said, own, _link(arm), role=side.role, shade=0.2)


def _link(length: float) -> Surface:
    """Return an arm along x with an eye at its hinge and a knob at its end."""
    thin = 0.075 * length
    bar = revolved([(0.0, 0.0), (0.0, thin), (length, 0.8 * thin), (length, 0.0)], 12)
    eye = placed(
        ring(0.5 * thin, 1.7 * thin, 2.4 * thin, 16), np.asarray([(0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)])
    )
    return joined(bar, eye, placed(ball(1.3 * thin, 12), None, (length, 0.0, 0.0)))


# Couplings whose touching profiles are circles: Clemens, curved Weiss and offset Rzeppa grooves.
#
# Axes, angles and the plane that halves them as in `pin_coupling`. A profile lies in the meridian plane of its shaft:
# heights h along e_i from O, radii r from the axis. It is a circle about (h0, r0) of radius R: the end of an arm R
# hinged there about the tangential axis, or the middle line of a groove in which a ball runs. Profiles alike touch in
# the halving plane and run evenly at any bend.

CELLS = 90  # pieces in which the circle of shaft 1 is searched
START = -math.pi + 0.003  # where the search begins: off the places at which a drawing would put a contact
DENSEST = 0.02  # least spacing of the pieces over an even one
NEWTON = 7  # steps from a straight line between the ends of a piece to rounding
MISSED = 361  # places of the circle at which it is looked at how far it misses the other one
STEP = 2e-5  # step of the difference quotient of the ratio [rad]: its error of second order is at that of rounding


@dataclass(frozen=True, eq=False, kw_only=True)
class Circle:
    """A circular profile in the meridian plane of its shaft."""

    axial: ArrayLike  # (...) [m]: height h0 of its centre along the shaft from O
    radial: ArrayLike  # (...) [m]: distance r0 of its centre from the axis
    radius: ArrayLike  # (...) [m]: radius R


@dataclass(frozen=True, eq=False, kw_only=True)
class ProfileContact:
    """Where two profiles touch, and what they pass on; not a number where they do not meet."""

    deviation: Array  # (...) [rad]: how far the output runs ahead of the input, φ2 - φ1, in (-π, π]
    ratio: Array  # (...): speed ratio dφ2/dφ1
    # height1, radius1, height2, radius2 (...) [m]: where the contact stands in the meridian plane of each shaft
    height1: Array
    radius1: Array  # (...) [m]
    height2: Array  # (...) [m]
    radius2: Array  # (...) [m]
    force: Array  # (...) [1/m]: contact force without friction for each unit of input torque


def meets(profile: ClemensProfile, joint_angle: Array) -> Array:
    """Return whether two profiles alike meet all round at joint angles (...) [rad], array of bool (...).

    In the halving plane, h = s r with \\|s\\| up to tan(α/2): a circle that does not hold the joint centre is met by
    these lines as long as by both outermost ones, on the side of r > 0.
    """
    xp, a, b, radius = namespace(joint_angle), profile.axial, profile.radial, profile.radius
    s = xp.tan(0.5 * joint_angle)
    inner = 0.0 * s + (a * a + b * b - radius * radius) <= 0.0
    ends = [(xp.abs(a - way * b) <= radius * xp.sqrt(1.0 + way * way)) & (way * a + b > 0.0) for way in (s, -s)]
    return inner | (ends[0] & ends[1])


def profile_contact(angle: ArrayLike, joint_angle: ArrayLike, first: Circle, second: Circle) -> ProfileContact:
    """Return where two circular profiles touch.

    angle (...) [rad]: input angle φ1, from the inner side of the bend.
    joint_angle (...) [rad]: bend α of the shafts in [0, π/2); first, second: profiles of shaft 1 and shaft 2.
    Returns ProfileContact: arrays (...).
    A = h e1 + r u1 on circle 1 is seen by shaft 2 at h2 = A·e2, r2 = |A - h2 e2|; the scalar equation
    (h2 - h02)² + (r2 - r02)² = R2² is solved along circle 1 to rounding. Of its solutions with r > 0 the one with φ2
    nearest to φ1 counts. The ratio is that of velocities along the common normal of both profiles.
    """
    phi, alpha, one, two = _arrays(angle, joint_angle, first, second)
    return _at(_place(phi, alpha, one, two), phi, alpha, one, two)


def _at(place: Array, phi: Array, alpha: Array, first: Circle, second: Circle) -> ProfileContact:
    """Return the contact that stands at a place of circle 1."""
    xp = namespace(place, phi, alpha)
    ca, sa, cf, sf = xp.cos(alpha), xp.sin(alpha), xp.cos(phi), xp.sin(phi)
    h, r = first.axial + first.radius * xp.cos(place), first.radial + first.radius * xp.sin(place)
    x, y, z = h, r * cf, r * sf
    h2, inward = -x * ca + y * sa, x * sa + y * ca
    r2 = xp.sqrt(inward * inward + z * z)
    cg, sg = inward / r2, z / r2
    t1 = -xp.sin(place), xp.cos(place) * cf, xp.cos(place) * sf
    back, out = second.radial - r2, h2 - second.axial
    t2 = -back * ca + out * cg * sa, back * sa + out * cg * ca, out * sg
    n = t1[1] * t2[2] - t1[2] * t2[1], t1[2] * t2[0] - t1[0] * t2[2], t1[0] * t2[1] - t1[1] * t2[0]
    one = y * n[2] - z * n[1]  # (e1 × A)·N
    two = inward * n[2] - z * (sa * n[0] + ca * n[1])  # -(e2 × A)·N
    size = xp.sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2])
    return ProfileContact(
        deviation=wrapped(xp.atan2(z, inward) - phi),
        ratio=one / two,
        height1=h,
        radius1=r,
        height2=h2,
        radius2=r2,
        force=size / xp.abs(one),
    )


def _arrays(
    angle: ArrayLike, joint_angle: ArrayLike, first: Circle, second: Circle
) -> tuple[Array, Array, Circle, Circle]:
    """Return everything as arrays: the angles of the shape of all, the circles of their own."""
    given = (angle, joint_angle, *(getattr(c, name) for c in (first, second) for name in ("axial", "radial", "radius")))
    phi, alpha, *sizes = floats(*given)
    none = 0.0 * sum((phi, alpha, *sizes))
    one, two = (Circle(axial=h, radial=r, radius=rho) for h, r, rho in (sizes[:3], sizes[3:]))
    return phi + none, alpha + none, one, two


def _widened(circle: Circle) -> Circle:
    """Return the circle with one more axis at the end."""
    return Circle(axial=circle.axial[..., None], radial=circle.radial[..., None], radius=circle.radius[..., None])


def _miss(place: Array, angle: Array, joint_angle: Array, first: Circle, second: Circle) -> tuple[Array, Array]:
    """Return by how much a point of circle 1 misses circle 2, and the slope of that along it."""
    xp = namespace(place, angle, joint_angle)
    ca, sa, cf, sf = xp.cos(joint_angle), xp.sin(joint_angle), xp.cos(angle), xp.sin(angle)
    dr, dh = first.radius * xp.cos(place), -first.radius * xp.sin(place)
    h, r = first.axial + dr, first.radial - dh
    h2, inward, up = r * cf * sa - h * ca, h * sa + r * cf * ca, r * sf
    r2 = xp.sqrt(inward * inward + up * up)
    dh2 = dr * cf * sa - dh * ca
    dr2 = (inward * (dh * sa + dr * cf * ca) + up * dr * sf) / r2
    value = (h2 - second.axial) ** 2 + (r2 - second.radial) ** 2 - second.radius**2
    slope = 2.0 * ((h2 - second.axial) * dh2 + (r2 - second.radial) * dr2)
    return value, slope


def _away(place: Array, angle: Array, joint_angle: Array, first: Circle) -> tuple[Array, Array]:
    """Return φ2 - φ1 of a point of circle 1, and its distance from the axis."""
    xp = namespace(place, angle, joint_angle)
    h, r = first.axial + first.radius * xp.cos(place), first.radial + first.radius * xp.sin(place)
    inward = h * xp.sin(joint_angle) + r * xp.cos(angle) * xp.cos(joint_angle)
    return wrapped(xp.atan2(r * xp.sin(angle), inward) - angle), r


def _better(place: Array, angle: Array, joint_angle: Array, first: Circle, second: Circle) -> Array:
    """Return a place of circle 1 after a step of Newton's method."""
    miss, slope = _miss(place, angle, joint_angle, first, second)
    xp = namespace(miss, slope)
    return place - miss / xp.where(slope == 0.0, xp.inf, slope)


def _grid(circle: Circle) -> Array:
    """Return ends of the pieces of a circle, array (..., CELLS + 1), closer together where it passes the joint centre.

    Evenly spaced angles u about the direction to the centre go to 2 arctan(k tan(u/2)), k four times the least distance
    over the radius: a circle so large that it is nearly a pin is looked at where it is used.
    """
    xp = namespace(circle.axial, circle.radial, circle.radius)
    far = xp.sqrt(circle.axial * circle.axial + circle.radial * circle.radial)
    k = xp.minimum(xp.maximum(4.0 * xp.abs(far - circle.radius) / circle.radius, DENSEST + 0.0 * far), 1.0 + 0.0 * far)
    half = 0.5 * (START + 2.0 * math.pi / CELLS * xp.arange(CELLS + 1, dtype=xp.float64))
    toward = xp.atan2(-circle.radial, -circle.axial)
    return toward[..., None] + 2.0 * xp.atan2(k[..., None] * xp.sin(half), xp.cos(half))


def _place(angle: Array, joint_angle: Array, first: Circle, second: Circle) -> Array:
    """Return where on circle 1 the contact stands, as the angle about its centre, array (...)."""
    xp = namespace(angle, joint_angle)
    value, grid = _misses(angle, joint_angle, first, second)
    below = value < 0.0
    crossed = below[..., :-1] != below[..., 1:]
    cells, rows = xp.arange(CELLS), xp.reshape(xp.arange(angle.size), angle.shape) * (CELLS + 1)
    flat = [xp.reshape(xp.broadcast_to(one, value.shape), (-1,)) for one in (value, grid)]

    def picked(cell: Array) -> list[Array]:
        places = xp.reshape(rows + cell, (-1,))
        return [xp.reshape(xp.take(one, places), angle.shape) for one in flat]

    best, least = xp.nan * angle, xp.inf + xp.zeros_like(angle)
    while bool(xp.any(crossed)):  # at most four contacts lie on it
        cell = xp.argmax(xp.astype(crossed, xp.int8), axis=-1)
        crossed, there = crossed & (cells > cell[..., None]), xp.any(crossed, axis=-1)
        (low, begin), (high, end) = picked(cell), picked(cell + 1)
        place = begin - (end - begin) * low / xp.where(there, high - low, xp.inf)
        there = there & (_away(place, angle, joint_angle, first)[1] > 0.0)
        for _step in range(NEWTON):
            place = _better(place, angle, joint_angle, first, second)
            place = xp.minimum(xp.maximum(place, begin), end)
        away = xp.abs(_away(place, angle, joint_angle, first)[0])
        nearer = there & (away < least)
        best, least = xp.where(nearer, place, best), xp.where(nearer, away, least)
    return best


def _misses(angle: Array, joint_angle: Array, first: Circle, second: Circle) -> tuple[Array, Array]:
    """Return by how much the ends of the pieces of circle 1 miss circle 2, array (..., CELLS + 1), and these ends.

    As `_miss`, with r2² = h² + r² - h2²: few steps over so many places.
    """
    xp, one, two = namespace(angle, joint_angle), _widened(first), _widened(second)
    grid = _grid(first)
    h, r = one.axial + one.radius * xp.cos(grid), one.radial + one.radius * xp.sin(grid)
    square = h * h + r * r
    h2 = (xp.cos(angle) * xp.sin(joint_angle))[..., None] * r - xp.cos(joint_angle)[..., None] * h
    r2 = xp.sqrt(xp.maximum(square - h2 * h2, 0.0 * h2))
    rest = square + (two.axial * two.axial + two.radial * two.radial - two.radius * two.radius)
    return rest - 2.0 * (two.axial * h2 + two.radial * r2), grid


def deviation(angle: ArrayLike, joint_angle: ArrayLike, first: Circle, second: Circle) -> Array:
    """Return how far the output of a coupling with circular profiles runs ahead [rad]; see `profile_contact`."""
    return profile_contact(angle, joint_angle, first, second).deviation


def ratio(angle: ArrayLike, joint_angle: ArrayLike, first: Circle, second: Circle) -> Array:
    """Return the speed ratio dφ2/dφ1 of a coupling with circular profiles; see `profile_contact`."""
    return profile_contact(angle, joint_angle, first, second).ratio


def course(angle: ArrayLike, joint_angle: ArrayLike, first: Circle, second: Circle) -> tuple[Array, Array, Array]:
    """Return how a coupling with circular profiles turns, with two derivatives; see `profile_contact`.

    angle (...) [rad]: input angle φ1, from the inner side of the bend.
    joint_angle (...) [rad]: bend α of the shafts in [0, π/2); first, second: profiles of shaft 1 and shaft 2.
    Returns deviation, ratio, slope (...) [rad, 1, 1/rad]: φ2 - φ1, dφ2/dφ1 and d²φ2/dφ1²; the last by a central
    difference of the exact ratio.
    """
    phi, alpha, one, two = _arrays(angle, joint_angle, first, second)
    place = _place(phi, alpha, one, two)
    found = _at(place, phi, alpha, one, two)
    beside = []
    for turned in (phi - STEP, phi + STEP):
        near = place
        for _step in range(3):
            near = _better(near, turned, alpha, one, two)
        beside.append(_at(near, turned, alpha, one, two).ratio)
    return found.deviation, found.ratio, (beside[1] - beside[0]) / (2.0 * STEP)


def ratio_slope(angle: ArrayLike, joint_angle: ArrayLike, first: Circle, second: Circle) -> Array:
    """Return the derivative of `ratio` by the input angle [1/rad]; see `course`."""
    return course(angle, joint_angle, first, second)[2]
