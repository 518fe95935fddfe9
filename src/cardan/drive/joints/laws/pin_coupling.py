"""Pin couplings: each shaft carries a straight pin in its own meridian plane, and the two pins touch.

The axes meet at O under the joint angle α. Coordinates: e1 from O along shaft 1 away from the joint, e2 along shaft 2
away from it, p1 and p2 at right angles to them in the plane of the shafts on the inner side of the joint angle, n at
right angles to that plane. Both turns count from p toward n, so that equal angles are even running. A pin starts on its
axis at the distance a from O and leans by its slant θ toward O. Pins alike touch in the plane that halves the angle of
the shafts, and the coupling runs evenly at any joint angle, whatever the shape of the pins.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from cardan.maths.arrays import Array, ArrayLike, floats, namespace


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

    Parameters
    ----------
    angle : array (...) [rad]
        Input angle φ1, from the inner side of the bend.
    joint_angle : array (...) [rad]
        Bend α of the shafts in [0, π/2).
    distance1, distance2 : arrays (...) [m]
        Distances a and b from O at which the pins start on their axes.
    slant1, slant2 : arrays (...) [rad]
        Angles θ1 and θ2 of the pins with their axes, toward O, in (0, π/2).

    Returns
    -------
    PinContact
        arrays (...).

    Notes
    -----
    Completes Book (3)-(7), whose z is unknown: the contact A = a e1 + x d1 lies on the cone of pin 2,
    (v·e2)² = cos² θ2 |v|² with v = A - b e2, a quadratic in x; of its positive roots with v·e2 < 0 the one with x/a
    nearest to y/b. Then φ2 = atan2(A·n, A·p2). Pins meet while F = (a e1 - b e2)·(d1 × d2) = 0; the derivatives of F
    by φ1 and φ2 give ratio and slope. With N = d1 × d2 the force is |N|/|(e1 × A)·N| for unit torque.

    Examples
    --------
    >>> from cardan.units import deg
    >>> found = pin_contact(100 * deg, 30 * deg, 0.05, 0.052, 40 * deg, 42 * deg)
    >>> print(f"{found.deviation:.9f} {found.ratio:.9f} {found.first:.9f}")
    0.030906552 0.982785566 0.071884882
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
    """Return an angle within half a turn, in (-π, π].

    >>> print(f"{wrapped(3.5 * math.pi) / math.pi:.1f}")
    -0.5
    """
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
