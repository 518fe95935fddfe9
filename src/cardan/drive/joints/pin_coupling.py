"""The pin coupling: each shaft carries a slanting pin, and the pins touch."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from cardan.errors import Problem
from cardan.maths.arrays import Array, ArrayLike, floats, namespace
from cardan.maths.kernel import mobius
from cardan.maths.kernel.meshes import joined, placed, revolved
from cardan.texts import _, mark
from cardan.units import deg, quantity

from .common.inner import DRIVEN, DRIVING, Contact, InnerPair, Stance
from .common.laws import beside, contact_push, lost_contact, nearest, reached
from .common.site import Site, about
from .joint import CROSS_ONLY, FREE, REFUSALS, Inside, Joint, both_or_none

FAR = 400
"""Places of a pin at which it is looked at how far it misses the other one."""


@dataclass(frozen=True, kw_only=True, slots=True)
class PinCoupling(Joint):
    """Pin coupling with straight pins: even where both pins are alike."""

    kind: ClassVar[str] = "pin_coupling"
    title: ClassVar[str] = mark("pin coupling")
    types: ClassVar[tuple[str, ...]] = ("pin_ball",)
    foreign: ClassVar[frozenset[str]] = CROSS_ONLY - {"friction"}
    rubbing: ClassVar[tuple[str, ...]] = ("driving_distance", "driven_distance")
    loose: ClassVar[bool] = True
    many_angles: ClassVar[bool] = True
    law_sizes: ClassVar[tuple[str, ...]] = (
        "driving_slant", "driven_slant", "driving_distance", "driven_distance",
    )  # fmt: skip
    steepest: ClassVar[float] = 0.5 * math.pi
    refusals: ClassVar[Mapping[str, str]] = {
        **REFUSALS,
        "forces": mark("without the distances of its pins it is open where they touch, and so with what force"),
    }
    stays: ClassVar[str] = FREE

    driving_slant: float = quantity(
        "angle", math.pi / 4, doc="angle of the driving pin with its shaft's axis", above=0.0, below=math.pi / 2
    )
    driven_slant: float | None = quantity(
        "angle", None, doc="that of the driven pin; as the driving one when not given", above=0.0, below=math.pi / 2
    )
    driving_distance: float | None = quantity(
        "length", None, doc="from the joint centre to the start of the driving pin on its shaft's axis", above=0.0
    )
    driven_distance: float | None = quantity(
        "length", None, doc="from the joint centre to the start of the driven pin on its shaft's axis", above=0.0
    )

    pin_diameter: float | None = quantity("length", None, doc="diameter of both pins where they touch", above=0.0)

    def own_problems(self) -> Iterator[Problem]:
        """Yield a distance that stands alone, and distances that unlike pins need."""
        yield from both_or_none(self, "driving_distance", "driven_distance")
        if self._slants[0] != self._slants[1] and self.driving_distance is None and self.driven_distance is None:
            yield from (
                Problem(name, _("missing; pins with unlike slants need it"), "missing")
                for name in ("driving_distance", "driven_distance")
            )

    @property
    def _slants(self) -> tuple[float, float]:
        return self.driving_slant, self.driving_slant if self.driven_slant is None else self.driven_slant

    def sizes(self) -> dict[str, float | None]:
        """Return slants and distances of its pins, the driven slant as the driving one where it is not given."""
        return {**Joint.sizes(self), "driven_slant": self._slants[1]}

    def pair(self, joint_angle: Array) -> mobius.Pair | None:
        """Return the identity for pins alike, nan where they do not reach round a turn; None for unlike pins."""
        one, other = self._slants
        if one != other or self.driving_distance != self.driven_distance:
            return None
        xp = namespace(joint_angle)
        low, high = slant_range(joint_angle)
        a, b = mobius.turn(0.0 * joint_angle)
        return xp.where((low < one) & (one < high), a, xp.nan), b

    def deviation(self, angle: Array, joint_angle: Array) -> tuple[Array, Array, Array]:
        """Return the law of the contact of both pins; nan where they do not reach round a turn."""
        one, other = self._slants
        low, high = slant_range(joint_angle)
        if not np.all((low < min(one, other)) & (max(one, other) < high)):
            nothing = angle + math.nan
            return nothing, nothing, nothing
        if self.driving_distance is None or self.driven_distance is None:
            return 0.0 * angle, 1.0 + 0.0 * angle, 0.0 * angle
        found = pin_contact(angle, joint_angle, self.driving_distance, self.driven_distance, one, other)
        return reached((found.deviation, found.ratio, found.ratio_slope))

    def stuck(self, joint_angle: float) -> str:
        """Return which pin leans too little or too much, or where both do not meet."""
        text, names = Joint.stuck(self, joint_angle), ("driving_slant", "driven_slant")
        low, high = (float(end) for end in slant_range(joint_angle))
        for name, slant in zip(names, self._slants, strict=True):
            if low < slant < high:
                continue
            said = {"pin": name, "slant": slant / deg, "low": low / deg, "high": high / deg}
            if slant <= low:
                why = _(
                    "{pin} is {slant:.4g}°, between {low:.4g}° and {high:.4g}° pins go all the way round; with its "
                    "driving mark {angle:.4g}° from the plane of the shafts these lie in one line"
                )
                place = math.acos(math.tan(slant) / math.tan(low))
            else:
                why = _(
                    "{pin} is {slant:.4g}°, between {low:.4g}° and {high:.4g}° pins go all the way round; with its "
                    "driving mark {angle:.4g}° from the plane of the shafts these are parallel"
                )
                place = math.acos(-math.tan(high) / math.tan(slant))
            return f"{text}: {why.format(**said, angle=place / deg)}"
        if self.driving_distance is None or self.driven_distance is None:
            return text
        (one, other), a, b = self._slants, self.driving_distance, self.driven_distance

        def contact(theta: Array) -> tuple[Array, Array, Array]:
            found = pin_contact(theta, joint_angle, a, b, one, other)
            return found.deviation, found.ratio, found.ratio_slope

        def missed(theta: Array) -> Array:
            def far(x: Array) -> Array:
                along, off = beside(a - x * math.cos(one), x * math.sin(one), theta[:, None], joint_angle)
                way = np.maximum((b - along) * math.cos(other) + off * math.sin(other), 0.0)
                return np.hypot(along - b + way * math.cos(other), off - way * math.sin(other))

            return nearest(far, max(a, b) * (np.geomspace(1.0, 101.0, FAR) - 1.0))

        why = lost_contact(contact, missed, joint_angle)
        return f"{text}: {why}" if why else text

    def inside(self, joint_angle: float) -> Iterator[Inside]:
        """Yield which slants turn all round, and way and force of the contact where the distances are given."""
        low, high = (float(end) for end in slant_range(joint_angle))
        text = _("slant above which pins turn all the way round at this joint angle")
        yield Inside(key="least_slant", meaning=text, value=low)
        yield Inside(key="most_slant", meaning=_("slant below which they do"), value=high)
        if self.driving_distance is None or self.driven_distance is None:
            return
        turn, distances = np.arange(360) * deg, (self.driving_distance, self.driven_distance)
        found = pin_contact(turn, joint_angle, *distances, *self._slants)
        text = _("way of the contact along the driving pin")
        yield Inside(key="stroke", meaning=text, value=float(np.ptp(found.first)), dimension="length")
        text = _("largest contact force, without friction, for each N·m of torque, in N")
        yield Inside(key="force_N_per_Nm", meaning=text, value=float(np.max(found.force)), dimension=None)

    def mechanism(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield both its pins, along which the point slides in which they touch; a contact without their distances."""
        if self.driving_distance is None or self.driven_distance is None:
            yield from Joint.mechanism(self, stance)
            return
        one, other = self._slants
        found = pin_contact(
            stance.theta, np.asarray(stance.joint_angle), self.driving_distance, self.driven_distance, one, other
        )
        back, u, v = -stance.before, stance.driving, stance.driven
        first = -np.cos(one) * back + np.sin(one) * u
        last = -np.cos(other) * stance.after + np.sin(other) * v
        at = stance.centre + self.driving_distance * back + np.asarray(found.first)[..., None] * first
        point = mark("contact of joint {number}")
        pins = mark("driving pin of joint {number}"), mark("driven pin of joint {number}")
        touching = None if self.pin_diameter is None else crossed_pins(self.pin_diameter, first, last)
        for name, kind, side, way in ((pins[0], "P", DRIVING, first), (pins[1], "SG", DRIVEN, last)):
            own: dict[str, Any] = {"rubs": True, "contact": touching}
            yield InnerPair(name=name, type=kind, links=(side, point), point=at, axis=way, **own)

    def loaded(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield the same, where it is told how they touch."""
        if self.told:
            yield from self.mechanism(stance)

    @property
    def told(self) -> bool:
        """Whether its distances are given."""
        return self.driving_distance is not None and self.driven_distance is not None

    def push(self, angle: Array, joint_angle: Array) -> Array | None:
        """Return the force of the contact of its pins."""
        if self.driving_distance is None or self.driven_distance is None:
            return None
        one, other = self._slants
        found = pin_contact(angle, joint_angle, self.driving_distance, self.driven_distance, one, other)
        way = np.asarray(found.first)
        slopes = [np.asarray([-math.cos(slant), math.sin(slant)]) + 0.0 * way[..., None] for slant in (one, other)]
        height, out = self.driving_distance - way * math.cos(one), way * math.sin(one)
        return contact_push(height, out, angle, joint_angle, (slopes[0], slopes[1]))

    def solid(self, site: Site) -> None:
        """Add its hubs, and the pins that lean toward each other and touch."""
        usual = 0.85 * site.size.radius
        slants, starts = self._slants, (self.driving_distance or usual, self.driven_distance or usual)
        count = 3 if slants[0] == slants[1] and starts[0] == starts[1] else 1
        for side, slant, start in zip(site.sides, slants, starts, strict=True):
            long = 1.12 * start / max(np.cos(slant) - np.sin(slant) * np.tan(0.5 * site.stance.joint_angle), 0.35)
            thin = 0.09 * start
            tip = [(long - thin, thin), (long - 0.3 * thin, 0.7 * thin), (long, 0.0)]
            pin = revolved([(0.0, 0.0), (0.0, thin), *tip], 14)
            lean = np.asarray([-np.cos(slant), np.sin(slant), 0.0])
            frame = np.stack((lean, np.asarray([-np.sin(slant), -np.cos(slant), 0.0]), np.asarray([0.0, 0.0, 1.0])))
            one = placed(pin, frame, (start, 0.0, 0.0))
            reach = max(side.reach, 1.12 * start)
            hub = revolved(
                [(0.72 * start, 0.0), (0.72 * start, 0.4 * start), (start, 0.55 * start), (1.06 * start, 0.55 * start),
                 (reach, side.body), (reach, 0.0)], 24,
            )  # fmt: skip
            made = joined(hub, *(about(one, j * 2.0 * np.pi / count) for j in range(count)))
            site.add_to(side, side.yoke, site.said(_("hub and pins of {joint}")), made)


# Pin couplings: each shaft carries a straight pin in its own meridian plane, and the two pins touch.
#
# The axes meet at O under the joint angle α. Coordinates: e1 from O along shaft 1 away from the joint, e2 along shaft 2
# away from it, p1 and p2 at right angles to them in the plane of the shafts on the inner side of the joint angle, n at
# right angles to that plane. Both turns count from p toward n, so that equal angles are even running. A pin starts on
# its axis at the distance a from O and leans by its slant θ toward O. Pins alike touch in the plane that halves the
# angle of the shafts, and the coupling runs evenly at any joint angle, whatever the shape of the pins.


def crossed_pins(diameter: float, first: Array, second: Array) -> Contact:
    """Return the contact of two cylinders alike whose axes have directions first and second (..., 3).

    diameter [m]: d. Under the angle γ of their axes 2 (1 ± |cos γ|)/d: parallel they touch along a line.
    """
    along = np.abs(np.sum(first * second, axis=-1))
    return Contact(across=2.0 * (1.0 + along) / diameter, along=2.0 * (1.0 - along) / diameter)


@dataclass(frozen=True, eq=False, kw_only=True)
class PinContact:
    """Where two pins touch, and what they pass on; not a number where they do not meet."""

    deviation: Array  # (...) [rad]: how far the output runs ahead of the input, φ2 - φ1, in (-π, π]
    ratio: Array  # (...): speed ratio dφ2/dφ1
    ratio_slope: Array  # (...) [1/rad]: its derivative by φ1
    # first, second (...) [m]: distances x and y of the contact along pin 1 and pin 2 from where they start on their
    # axes
    first: Array
    second: Array  # (...) [m]
    force: Array  # (...) [1/m]: contact force without friction for each unit of input torque


def pin_contact(
    angle: ArrayLike,
    joint_angle: ArrayLike,
    distance1: ArrayLike,
    distance2: ArrayLike,
    slant1: ArrayLike,
    slant2: ArrayLike,
) -> PinContact:
    """Return where two straight pins touch, exactly.

    angle (...) [rad]: input angle φ1, from the inner side of the bend.
    joint_angle (...) [rad]: bend α of the shafts in [0, π/2).
    distance1, distance2 (...) [m]: distances a and b from O at which the pins start on their axes.
    slant1, slant2 (...) [rad]: angles θ1 and θ2 of the pins with their axes, toward O, in (0, π/2).
    Returns: arrays (...).
    Completes Book (3)-(7), whose z is unknown: the contact A = a e1 + x d1 lies on the cone of pin 2,
    (v·e2)² = cos² θ2 |v|² with v = A - b e2, a quadratic in x; of its positive roots with v·e2 < 0 the one with x/a
    nearest to y/b. Then φ2 = atan2(A·n, A·p2). Pins meet while F = (a e1 - b e2)·(d1 × d2) = 0; the derivatives of F
    by φ1 and φ2 give ratio and slope. With N = d1 × d2 the force is |N|/|(e1 × A)·N| for unit torque.
    """
    phi, alpha, a, b, one, two = floats(angle, joint_angle, distance1, distance2, slant1, slant2)
    xp = namespace(phi, alpha, a, b, one, two)
    ca, sa, cos, sin = xp.cos(alpha), xp.sin(alpha), xp.cos(two), xp.sin(one)
    d = -xp.cos(one), sin * xp.cos(phi), sin * xp.sin(phi)  # pin 1 along e1, p1, n
    w = a + b * ca, -b * sa  # from the start of pin 2 to that of pin 1; e2 is (-cos α, sin α, 0)
    along, behind = sa * d[1] - ca * d[0], sa * w[1] - ca * w[0]
    onto, square = w[0] * d[0] + w[1] * d[1], w[0] * w[0] + w[1] * w[1]
    x, y = _along_pins(along, behind, onto, square, cos * cos, a, b)
    output = xp.atan2(x * d[2], (a + x * d[0]) * sa + x * d[1] * ca)
    ratio, slope, force = _passed_on(phi, output, x, alpha, a, b, one, two)
    return PinContact(deviation=wrapped(output - phi), ratio=ratio, ratio_slope=slope, first=x, second=y, force=force)


def _along_pins(
    along: Array, behind: Array, onto: Array, square: Array, c: Array, a: Array, b: Array
) -> tuple[Array, Array]:
    """Return x and y of the contact: the root of the cone's quadratic that uses both pins most alike."""
    xp = namespace(along, behind, onto, square, c, a, b)
    high, half, low = along * along - c, behind * along - c * onto, behind * behind - c * square
    inner = half * half - high * low
    root = xp.sqrt(xp.where(inner >= 0.0, inner, xp.nan))
    q = -(half + xp.where(half < 0.0, -root, root))
    found, other = xp.nan * q, xp.nan * q
    least = xp.inf + xp.zeros_like(q)
    for above, below in ((q, high), (low, q)):
        x = above / xp.where(below == 0.0, xp.nan, below)
        y = xp.sqrt(square + 2.0 * x * onto + x * x)
        apart = xp.abs(x / a - y / b)
        nearer = (x > 0.0) & (behind + x * along <= 0.0) & (apart < least)
        found, other, least = xp.where(nearer, x, found), xp.where(nearer, y, other), xp.where(nearer, apart, least)
    return found, other


def _passed_on(
    phi: Array, output: Array, x: Array, alpha: Array, a: Array, b: Array, one: Array, two: Array
) -> tuple[Array, Array, Array]:
    """Return speed ratio, its slope and the force at the angles of both pins.

    F = p sin φ1 cos φ2 - q cos φ1 sin φ2 - r sin φ1 + s sin φ2, the triple product written out.
    """
    xp = namespace(phi, output, x, alpha, a, b, one, two)
    ca, sa = xp.cos(alpha), xp.sin(alpha)
    c1, s1, c2, s2 = xp.cos(one), xp.sin(one), xp.cos(two), xp.sin(two)
    cf, sf, cg, sg = xp.cos(phi), xp.sin(phi), xp.cos(output), xp.sin(output)
    p, q = s1 * s2 * (a * ca + b), s1 * s2 * (a + b * ca)
    r, s = s1 * c2 * a * sa, s2 * c1 * b * sa
    by_one = p * cf * cg + q * sf * sg - r * cf
    by_two = -p * sf * sg - q * cf * cg + s * cg
    ratio = -by_one / by_two
    mixed = -p * cf * sg + q * sf * cg
    pure = -p * sf * cg + q * cf * sg
    slope = -(pure + r * sf + 2.0 * mixed * ratio + (pure - s * sg) * ratio * ratio) / by_two
    d1 = -c1, s1 * cf, s1 * sf
    d2 = c2 * ca + s2 * cg * sa, -c2 * sa + s2 * cg * ca, s2 * sg
    n = d1[1] * d2[2] - d1[2] * d2[1], d1[2] * d2[0] - d1[0] * d2[2], d1[0] * d2[1] - d1[1] * d2[0]
    lever = x * (d1[1] * n[2] - d1[2] * n[1])
    return ratio, slope, xp.sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / xp.abs(lever)


def wrapped(angle: ArrayLike) -> Array:
    """Return an angle within half a turn, in (-π, π]."""
    (phi,) = floats(angle)
    xp = namespace(phi)
    return xp.atan2(xp.sin(phi), xp.cos(phi))


def deviation(
    angle: ArrayLike,
    joint_angle: ArrayLike,
    distance1: ArrayLike,
    distance2: ArrayLike,
    slant1: ArrayLike,
    slant2: ArrayLike,
) -> Array:
    """Return how far the output of a pin coupling runs ahead of its input, φ2 - φ1 [rad]; see `pin_contact`."""
    return pin_contact(angle, joint_angle, distance1, distance2, slant1, slant2).deviation


def ratio(
    angle: ArrayLike,
    joint_angle: ArrayLike,
    distance1: ArrayLike,
    distance2: ArrayLike,
    slant1: ArrayLike,
    slant2: ArrayLike,
) -> Array:
    """Return the speed ratio dφ2/dφ1 of a pin coupling; see `pin_contact`."""
    return pin_contact(angle, joint_angle, distance1, distance2, slant1, slant2).ratio


def slant_range(joint_angle: ArrayLike) -> tuple[Array, Array]:
    """Return between which slants pins turn all the way round [rad].

    α/2 < θ < π/2 - α/2: at the lower end the pins fall in line once a turn, at the upper end they run parallel and
    touch nowhere; θ = 45° is furthest from both.
    """
    (alpha,) = floats(joint_angle)
    return 0.5 * alpha, 0.5 * math.pi - 0.5 * alpha


def stroke(joint_angle: ArrayLike, distance: ArrayLike, slant: ArrayLike) -> tuple[Array, Array]:
    """Return between which distances along its pins the contact of a coupling with pins alike runs.

    joint_angle (...) [rad]: bend α; distance (...) [m]: distance a of the start of both pins from O.
    slant (...) [rad]: slant θ of both pins, within `slant_range`.
    Returns (...) [m], array (...) [m]: least and greatest.
    x = a/(cos θ + sin θ cos φ tan(α/2)): a cos(α/2)/cos(θ - α/2) on the inner side, a cos(α/2)/cos(θ + α/2) on the
    outer side of the bend.
    """
    alpha, a, theta = floats(joint_angle, distance, slant)
    xp = namespace(alpha, a, theta)
    half = 0.5 * alpha
    inner = a * xp.cos(half)
    return inner / xp.cos(theta - half), inner / xp.cos(theta + half)


def along_alike(angle: ArrayLike, joint_angle: ArrayLike, distance: ArrayLike, slant: ArrayLike) -> Array:
    """Return where the contact of pins alike stands along them, x = y; see `stroke`.

    angle (...) [rad]: input angle φ1; joint_angle (...) [rad]: bend α.
    distance (...) [m]: distance a of the start of both pins from O; slant (...) [rad]: slant θ of both pins.
    Returns (...) [m].
    x = a/(cos θ + sin θ cos φ tan(α/2)): where a pin passes through the halving plane.
    """
    phi, alpha, a, theta = floats(angle, joint_angle, distance, slant)
    xp = namespace(phi, alpha, a, theta)
    return a / (xp.cos(theta) + xp.sin(theta) * xp.cos(phi) * xp.tan(0.5 * alpha))


def force_alike(angle: ArrayLike, joint_angle: ArrayLike, distance: ArrayLike, slant: ArrayLike) -> Array:
    """Return the contact force without friction of pins alike for each unit of torque.

    angle (...) [rad]: input angle φ1; joint_angle (...) [rad]: bend α.
    distance (...) [m]: distance a of the start of both pins from O.
    slant (...) [rad]: slant θ of both pins, within `slant_range`.
    Returns (...) [1/m].

    |d1 × m| c/(a cos(α/2) sin θ (sin θ - cos θ cos φ tan(α/2))), c = cos θ + sin θ cos φ tan(α/2), with
    |d1 × m|² = sin² θ sin² φ + (cos θ sin(α/2) - sin θ cos φ cos(α/2))²: the pins are each other's image in the halving
    plane, so that d1 × d2 is twice (d1·m)(d1 × m), m its normal. In the plane of the shafts the force is one over the
    distance of the contact from the axis.
    """
    phi, alpha, a, theta = floats(angle, joint_angle, distance, slant)
    xp = namespace(phi, alpha, a, theta)
    ch, th = xp.cos(0.5 * alpha), xp.tan(0.5 * alpha)
    c = xp.cos(theta) + xp.sin(theta) * xp.cos(phi) * th
    across = xp.sin(theta) - xp.cos(theta) * xp.cos(phi) * th
    flat = (xp.sin(theta) * xp.sin(phi)) ** 2 + (ch * (xp.cos(theta) * th - xp.sin(theta) * xp.cos(phi))) ** 2
    return xp.sqrt(flat) * c / (a * ch * xp.sin(theta) * across)


def eccentricity(joint_angle: ArrayLike, slant: ArrayLike) -> Array:
    """Return the eccentricity of the ellipse on which the contact of pins alike runs, sin(α/2)/cos θ."""
    alpha, theta = floats(joint_angle, slant)
    xp = namespace(alpha, theta)
    return xp.sin(0.5 * alpha) / xp.cos(theta)


def missed_plane(angle: ArrayLike, joint_angle: ArrayLike, offset: ArrayLike, radius: ArrayLike) -> Array:
    """Return by how much the output runs ahead where the contact misses the plane that halves the angle of the shafts.

    angle (...) [rad]: input angle φ1; joint_angle (...) [rad]: bend α.
    offset (...) [m]: distance d of the contact from that plane, toward shaft 1.
    radius (...) [m]: distance r of the contact from the axis.
    Returns (...) [rad].
    -2 (d/r) sin(α/2) sin φ1, to first order in d, for couplings of any profile.
    """
    phi, alpha, d, r = floats(angle, joint_angle, offset, radius)
    xp = namespace(phi, alpha, d, r)
    return -2.0 * d / r * xp.sin(0.5 * alpha) * xp.sin(phi)


def missed_by_pins(angle: ArrayLike, joint_angle: ArrayLike, change: ArrayLike, slant: ArrayLike) -> Array:
    """Return how far the contact of pins misses the halving plane where one starts too far out, the other too near.

    angle (...) [rad]: input angle φ1; joint_angle (...) [rad]: bend α.
    change (...) [m]: δ by which the distances differ from their mean, a = a0 + δ, b = a0 - δ.
    slant (...) [rad]: slant θ of both pins.
    Returns (...) [m]: toward shaft 1, for `missed_plane`.
    d = δ sin θ/(cos(α/2) sin θ - sin(α/2) cos φ cos θ), to first order in δ.
    """
    phi, alpha, delta, theta = floats(angle, joint_angle, change, slant)
    xp = namespace(phi, alpha, delta, theta)
    half = 0.5 * alpha
    return delta * xp.sin(theta) / (xp.cos(half) * xp.sin(theta) - xp.sin(half) * xp.cos(phi) * xp.cos(theta))
