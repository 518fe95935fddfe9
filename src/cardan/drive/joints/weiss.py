"""The Weiss joint: balls between circular grooves, without a cage."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from cardan.errors import Problem
from cardan.maths.arrays import Array, ArrayLike, floats, namespace
from cardan.maths.kernel import frames, mobius
from cardan.maths.kernel.meshes import ball, placed
from cardan.texts import _, mark
from cardan.units import deg, mm, plain, quantity

from .common import site as drawn
from .common.inner import DRIVEN, DRIVING, Contact, InnerPair, Stance, carried, centred
from .common.laws import faded, waved
from .common.site import Site
from .joint import CROSS_ONLY, NO_BEARING, REFUSALS, Inside, Joint, both_or_none, missed


def groove_course(
    angle: Array, joint_angle: Array, first: float | None, second: float | None, radius: float | None, balls: int
) -> tuple[Array, Array, Array]:
    """Return the mean of what balls in offset grooves ask for; even where both offsets are equal.

    angle (...) [rad]: θ of the first ball; joint_angle () [rad]: α.
    first, second, radius [m]: offsets of the groove centres and radius of the grooves.
    balls: balls at equal angles that carry.
    """
    if first is None or second is None or radius is None or first == second:
        return 0.0 * angle, 1.0 + 0.0 * angle, 0.0 * angle
    places = np.arange(balls) * (2.0 * np.pi / balls)

    def angle_error(theta: Array) -> Array:
        each: Array = deviation(theta[:, None] + places, joint_angle, first, second, radius)
        leaps = np.abs(each - np.roll(each, 1, axis=0)) > LEAP  # it turns the shaft another way round: no joint
        return np.mean(np.where(np.any(leaps), np.nan, each), axis=-1)

    return course(angle, angle_error)


def groove_stuck(said: str, joint_angle: float, first: float | None, second: float | None, radius: float | None) -> str:
    """Return what is said of a joint that does not turn, with where its grooves do not meet."""
    why = _unmet(joint_angle, first, second, radius)
    return f"{said}: {why}" if why else said


def _unmet(joint_angle: float, first: float | None, second: float | None, radius: float | None) -> str:
    """Return in a sentence where offset grooves do not meet, or turn the shaft back; "" where a ball goes round."""
    if first is None or second is None or radius is None:
        return ""
    theta = np.arange(720) * (0.5 * deg)
    with np.errstate(invalid="ignore", divide="ignore"):
        along, _out = ball_centre(theta, joint_angle, first, second, radius)
        ahead = deviation(theta, joint_angle, first, second, radius)
    if np.any(np.isnan(along)):
        lean, rise = second * math.sin(joint_angle) * np.cos(theta), first + second * math.cos(joint_angle)
        far = 0.5 * float(_distance(*floats(joint_angle, first, second))) ** 2 / np.hypot(rise, lean)
        k = int(np.argmax(far))
        if far[k] > radius:
            text = _(
                "with its driving mark {angle:.4g}° from the plane of the shafts its grooves miss the plane of the "
                "balls by {gap:.3g} mm"
            )
            return text.format(angle=float(theta[k]) / deg, gap=float(far[k] - radius) / mm)
        return _("a ball would stand on the axis of its shaft")
    turned = float(np.ptp(np.unwrap(theta + ahead)))
    if turned < 2.0 * math.pi - LEAP:
        text = _("its balls pass between both shafts, so that the driven one turns to and fro by {angle:.4g}°")
        return text.format(angle=turned / deg)
    return ""


def balls_inside(tilt: float, angle_errors: Array) -> Iterator[Inside]:
    """Yield by how much the plane of the balls misses the middle, and what they ask for among themselves.

    tilt [rad]; angle_errors (p, k) [rad]: what each of k balls asks for, over a turn.
    """
    yield missed(tilt)
    text = _("play that its balls need, or strain between them")
    yield Inside(key="ball_spread", meaning=text, value=float(np.max(np.ptp(angle_errors, axis=-1))))


def groove_inside(
    joint_angle: float, first: float | None, second: float | None, radius: float | None, balls: int
) -> Iterator[Inside]:
    """Yield what balls in offset grooves do beside turning; nothing where the grooves are not given."""
    if first is None or second is None or radius is None:
        return
    angle_errors = deviation(ball_places(balls), joint_angle, first, second, radius)
    yield from balls_inside(float(plane_tilt(joint_angle, first, second)), angle_errors)


def groove_mechanism(
    stance: Stance, first: float, second: float, radius: float, balls: int, *, press: float = 1.0
) -> Iterator[InnerPair]:
    """Yield the balls between circular grooves: each swings about the centres of its two grooves.

    first, second, radius [m]: offsets of the groove centres and radius of the grooves; balls: how many carry.
    press: force on a contact over that which a ball passes on; with it grow the levers at which they rub.
    """
    name = mark("driving groove {count} of joint {number}"), mark("driven groove {count} of joint {number}")
    ball = mark("ball {count} of joint {number}")
    back, alpha = -stance.before, stance.joint_angle
    for k in range(balls):
        turn = k * 2.0 * np.pi / balls
        way = frames.rotate(
            stance.driving, stance.before + 0.0 * stance.driving, np.full(stance.driving.shape[:-1], turn)
        )
        along, out = ball_centre(stance.theta + turn, alpha, first, second, radius)
        at = stance.centre + along[..., None] * back + out[..., None] * way
        pivots = stance.centre + first * back, stance.centre + second * stance.after
        aside = at - stance.centre
        beyond = frames.unit(aside - frames.dot(aside, stance.after + 0.0 * aside)[..., None] * stance.after)
        axes = frames.cross(stance.before + 0.0 * way, way), frames.cross(stance.after + 0.0 * beyond, beyond)
        one, two = (
            mark("driving side of ball {count} of joint {number}"),
            mark("driven side of ball {count} of joint {number}"),
        )
        for groove, links, pivot, axis in (
            (name[0], (DRIVING, one), pivots[0], axes[0]),
            (name[1], (two, DRIVEN), pivots[1], axes[1]),
        ):
            yield InnerPair(
                name=groove,
                type="R",
                links=links,
                point=pivot,
                axis=axis,
                count=k + 1,
                repeats=k > 0,
                rubs=True,
                lever=press * radius,
            )
        yield InnerPair(name=ball, type="S", links=(one, two), point=at, axis=way, count=k + 1, repeats=k > 0)


def groove_contact(diameter: float | None, conformity: float | None, *, bent: float = 0.0) -> Contact | None:
    """Return the contact of a ball with its groove, None where a size is not given.

    diameter [m]: of the ball; conformity: radius of the section of the groove over it; bent [1/m]: curvature of the
    groove along its way, where the ball touches it, positive where it is hollow.
    """
    if diameter is None or conformity is None:
        return None
    return Contact(across=2.0 / diameter - 1.0 / (conformity * diameter), along=2.0 / diameter - bent)


def ball_places(balls: int) -> Array:
    """Return the angles of balls over a turn, array (360, k) [rad]."""
    return np.arange(360)[:, None] * deg + np.arange(balls) * (2.0 * np.pi / balls)


@dataclass(frozen=True, kw_only=True, slots=True)
class Weiss(Joint):
    """Weiss joint: balls where curved grooves cross; even where the grooves of both shafts are offset alike."""

    kind: ClassVar[str] = "weiss"
    title: ClassVar[str] = mark("Weiss")
    types: ClassVar[tuple[str, ...]] = ("weiss_curved", "weiss_straight")
    foreign: ClassVar[frozenset[str]] = CROSS_ONLY - {"friction"}
    rubbing: ClassVar[tuple[str, ...]] = ("driving_offset", "driven_offset", "groove_radius")
    pressed: ClassVar[tuple[str, ...]] = (*rubbing, "ball_diameter", "groove_conformity")
    refusals: ClassVar[Mapping[str, str]] = {**REFUSALS, "life": NO_BEARING}
    stays: ClassVar[str] = mark(
        "a centre ball holds its shafts; what is off in its grooves is play of the balls, or strain"
    )
    fixed: ClassVar[bool] = True
    law_sizes: ClassVar[tuple[str, ...]] = ("driving_offset", "driven_offset", "groove_radius")
    centred: ClassVar[bool] = True
    steepest: ClassVar[float] = math.radians(40.0)

    balls: int = plain(2, doc="number of balls that carry in one sense of turning", low=1)
    driving_offset: float | None = quantity(
        "length", None, doc="from the joint centre to the centre of the grooves on the driving shaft", above=0.0
    )
    driven_offset: float | None = quantity(
        "length", None, doc="from the joint centre to the centre of the grooves on the driven shaft", above=0.0
    )
    groove_radius: float | None = quantity("length", None, doc="radius of the grooves' middle line", above=0.0)
    ball_diameter: float | None = quantity("length", None, doc="diameter of the balls", above=0.0)
    groove_conformity: float | None = plain(
        None, doc="radius of the section of a groove over the diameter of the balls", above=0.5
    )

    def own_problems(self) -> Iterator[Problem]:
        """Yield grooves that are half given."""
        yield from both_or_none(self, "driving_offset", "driven_offset", "groove_radius")

    def pair(self, joint_angle: Array) -> mobius.Pair | None:
        """Return the identity where the offsets are equal or not given, else None."""
        return mobius.turn(0.0 * joint_angle) if self.driving_offset == self.driven_offset else None

    def deviation(self, angle: Array, joint_angle: Array) -> tuple[Array, Array, Array]:
        """Return the mean of what the carrying balls ask for."""
        return groove_course(
            angle, joint_angle, self.driving_offset, self.driven_offset, self.groove_radius, self.balls
        )

    def stuck(self, joint_angle: float) -> str:
        """Return where its grooves do not meet."""
        said = Joint.stuck(self, joint_angle)
        return groove_stuck(said, joint_angle, self.driving_offset, self.driven_offset, self.groove_radius)

    @property
    def alike(self) -> int:
        """Its balls."""
        return self.balls

    def mechanism(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield its grooves with the balls that carry; what holds as much where the grooves are not given."""
        if self.driving_offset is None or self.driven_offset is None or self.groove_radius is None:
            return Joint.mechanism(self, stance)
        return groove_mechanism(stance, self.driving_offset, self.driven_offset, self.groove_radius, self.balls)

    def loaded(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield its balls between their grooves, where all balls fit at once."""
        fits = self.driving_offset == self.driven_offset or self.balls == 1
        touching = groove_contact(self.ball_diameter, self.groove_conformity)
        for pair in self.mechanism(stance) if self.groove_radius is not None and fits else ():
            yield replace(pair, told=pair.type == "S", contact=touching if pair.type == "S" else None)

    def centring(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield its centre ball, as far as its grooves are given."""
        if self.groove_radius is not None:
            yield centred(mark("centre ball of joint {number}"), stance)

    @property
    def repeated(self) -> int:
        """The balls beyond the first: each could carry alone."""
        return self.balls - 1

    def carried(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield bearings of both shafts: it does not hold its centre by itself."""
        return carried(stance, loose=True)

    def inside(self, joint_angle: float) -> Iterator[Inside]:
        """Yield what its balls do beside turning."""
        yield from groove_inside(joint_angle, self.driving_offset, self.driven_offset, self.groove_radius, self.balls)

    @property
    def own_span(self) -> float | None:
        """Distance of opposite balls, with their grooves [m]."""
        return 2.3 * self.groove_radius if self.groove_radius is not None else None

    def solid(self, site: Site) -> None:
        """Add its two claws and the balls where their grooves cross."""
        size, stance = site.size, site.stance
        tip = -0.5 * size.radius
        drawn.yoke(site, site.driving, size, bore=False, tip=tip)
        drawn.yoke(site, site.driven, size, bore=False, tip=tip, quarter=True)
        groove = self.groove_radius or 0.72 * size.radius
        theta, said = stance.theta, site.said(_("ball of {joint}"))
        for j in range(4):
            own = drawn.across_halving(site, theta + (j + 0.5) * 0.5 * np.pi)
            shape = placed(ball(0.32 * groove, 18), None, (0.94 * groove, 0.0, 0.0))
            site.add("ball", said, own, shape, shade=0.55)
        own = site.along(stance.centre, stance.middle, stance.halving(theta))
        site.add("ball", said, own, ball(0.28 * groove, 18), shade=0.4)


# A law of motion known point by point: its derivatives by its harmonics.

SAMPLES = 256  # places in a turn at which a law is looked at, and more where it has harmonics beyond
MOST = 16 * SAMPLES  # most of them
LEAP = 1.0  # step [rad] of what a ball asks for from one place to the next that its grooves cannot have


def course(angle: Array, angle_error: Callable[[Array], Array]) -> tuple[Array, Array, Array]:
    """Return a smooth law of period 2π with two derivatives.

    angle (...) [rad]: θ; angle_error: T - θ at angles (p,).
    Returns angle_error, ratio, slope (...) [rad, 1, 1/rad]: T - θ, T' and T''; nan where the law has none.
    Trigonometric interpolation: its error falls faster than any power of the number of samples.

    >>> found = course(np.asarray(0.3), lambda x: 0.1 * np.sin(3.0 * x))
    >>> print([f"{float(one):.9f}" for one in found])
    ['0.078332691', '1.186482990', '-0.704994219']
    """
    count = SAMPLES
    while True:
        samples = np.asarray(angle_error(np.arange(count) * (2.0 * np.pi / count)), dtype=float)
        if count == MOST or faded(samples):
            return waved(angle, samples)
        count *= 4


# Balls between circular grooves whose centres stand off the joint: curved Weiss grooves, offset Rzeppa grooves.
#
# The groove of shaft 1 is a circle in its meridian plane about a point of its axis at the distance c_1 from the joint's
# centre O, that of shaft 2 likewise at c_2, both of one radius R. Then the centre of a ball is as far from one point as
# from the other: the centres of all balls lie in one plane, and with c_1 = c_2 it is the bisecting plane.


def _distance(joint_angle: Array, first: Array, second: Array) -> Array:
    """Return the distance between the groove centres."""
    xp = namespace(joint_angle, first, second)
    across, along = (first + second) * xp.cos(0.5 * joint_angle), (first - second) * xp.sin(0.5 * joint_angle)
    return xp.sqrt(across * across + along * along)


def plane_tilt(joint_angle: ArrayLike, first: ArrayLike, second: ArrayLike) -> Array:
    """Return the tilt of the plane of the balls against the bisecting plane.

    joint_angle (...) [rad]: α in [0, π/2), angle between the shafts.
    first, second (...) [m]: c_1, c_2 > 0, distances of the groove centres from the centre of the joint, each on the
    side of its shaft.
    Returns (...) [rad]: η of `laws.tilted_plane`: arctan[(c_2 - c_1)/(c_1 + c_2) tan(α/2)]; the normal leans to the
    shaft whose groove stands farther off.
    """
    alpha, one, two = floats(joint_angle, first, second)
    xp = namespace(alpha, one, two)
    return xp.atan((two - one) / (one + two) * xp.tan(0.5 * alpha))


def plane_offset(joint_angle: ArrayLike, first: ArrayLike, second: ArrayLike) -> Array:
    """Return the distance of the plane of the balls from the centre of the joint, positive towards shaft 1.

    joint_angle (...) [rad]: α in [0, π/2); first, second (...) [m]: c_1, c_2 > 0.
    Returns (...) [m]: (c_1² - c_2²)/(2 |c_1 e_1 - c_2 e_2|).

    >>> from cardan.units import deg, mm
    >>> print(plane_offset(30 * deg, 3.0 * mm, 3.3 * mm) / mm)
    -0.15527878
    """
    alpha, one, two = floats(joint_angle, first, second)
    return 0.5 * (one - two) * ((one + two) / _distance(alpha, one, two))


def ball_centre(
    angle: ArrayLike, joint_angle: ArrayLike, first: ArrayLike, second: ArrayLike, radius: ArrayLike
) -> tuple[Array, Array]:
    """Return where the centre of a ball is, in the meridian plane of shaft 1.

    angle (...) [rad]: φ_1, of the meridian plane from the inner side of the plane of the shafts.
    joint_angle (...) [rad]: α in [0, π/2); first, second (...) [m]: c_1, c_2 > 0; radius (...) [m]: R, of both
    grooves.
    Returns along, out (...) [m]: distance from O along shaft 1, and from its axis; nan where the grooves do not meet.
    (c_1 + c_2 cos α)(h - c_1) - c_2 sin α cos φ_1 r = -|c_1 e_1 - c_2 e_2|²/2 is the plane of the balls, and
    (h - c_1)² + r² = R² the groove; of the two points the one away from the axis.

    >>> from cardan.units import deg, mm
    >>> along, out = ball_centre(50 * deg, 30 * deg, 3.0 * mm, 3.3 * mm, 30.0 * mm)
    >>> print(along / mm, out / mm)
    5.25496523 29.91513215
    """
    phi, alpha, one, two, size = floats(angle, joint_angle, first, second, radius)
    xp = namespace(phi, alpha, one, two, size)
    lean = two * xp.sin(alpha) * xp.cos(phi)
    rise = one + two * xp.cos(alpha)
    length = xp.sqrt(rise * rise + lean * lean)
    foot = 0.5 * _distance(alpha, one, two) ** 2 / length
    rest = (size - foot) * (size + foot)
    half = xp.sqrt(xp.where((rest > 0.0) & (size > 0.0), rest, xp.nan))
    out = (foot * lean + half * rise) / length
    meets = out > 0.0
    along = one - (foot * rise - half * lean) / length
    return xp.where(meets, along, xp.nan), xp.where(meets, out, xp.nan)


def deviation(
    angle: ArrayLike, joint_angle: ArrayLike, first: ArrayLike, second: ArrayLike, radius: ArrayLike
) -> Array:
    """Return how far shaft 2 runs ahead of shaft 1 with one ball, φ_2 - φ_1.

    angle (...) [rad]: φ_1, of the ball's meridian plane from the inner side of the plane of the shafts.
    joint_angle (...) [rad]: α in [0, π/2); first, second (...) [m]: c_1, c_2 > 0; radius (...) [m]: R, of both
    grooves.
    Returns (...) [rad]: exactly 0 where the offsets are equal; nan where the grooves do not meet.
    The centre of the ball is s = δ (1 - sin(α/2) A·v/m)/cos(α/2) off the bisecting plane, towards shaft 1, with
    m = (c_1 + c_2)/2, δ = (c_1 - c_2)/2 and v the bisector of e_1 + e_2; then
    tan(φ_2 - φ_1) = -2 s sin(α/2) sin φ_1/[r (sin²φ_1 + cos α cos²φ_1) + h sin α cos φ_1].
    """
    phi, alpha, one, two, size = floats(angle, joint_angle, first, second, radius)
    xp = namespace(phi, alpha, one, two, size)
    h, r = ball_centre(phi, alpha, one, two, size)
    sine, cosine = xp.sin(phi), xp.cos(phi)
    small, large = xp.sin(0.5 * alpha), xp.cos(0.5 * alpha)
    side = h * small + r * cosine * large
    off = (one - two) * (0.5 - small * side / (one + two)) / large
    rest = r * (sine * sine + xp.cos(alpha) * cosine * cosine) + h * xp.sin(alpha) * cosine
    return xp.atan2(-2.0 * off * small * sine, rest)
