"""Closed spatial loops of one revolute and three cylindrical pairs (RCCC), exactly, and their linearisation.

Four axes z_1 … z_4 follow each other around the loop. Between neighbours lies the common perpendicular x_{i+1} with
the length a_i and the angle α_i; φ_i and s_i are turn and way from x_i to x_{i+1} along z_i. Given φ_1 and s_1, six
unknowns close the loop. A universal joint is such a loop: z_1 the driving shaft, z_2 and z_3 the arms of the cross,
z_4 the driven shaft; three right angles and no lengths make it perfect. Lists of four run over i = 1 … 4; lists of
five over the *seats* of an error: s_1 or φ_1, a_1 or α_1, … a_4 or α_4.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

from cardan.maths.arrays import Array, ArrayLike, namespace, real

from .frames import cross, dot, norm

IDEAL = -1.0
"""Sign of the branch on which a universal joint runs; the other one is +1."""

DEAD = 1e-9
"""Below this volume of z_2, z_3, z_4 both branches meet and the slides leave all bounds."""

NEAR = 1e-12
"""A loop that misses closing by this share closes."""

NO_SIDE = 1e-12
"""Below this sine two neighbouring axes are parallel."""


class Status(IntEnum):
    """What became of a loop."""

    CLOSED = 0
    DEAD = 1
    """Both branches meet; the angles are given, the slides have no bound."""
    OPEN = 2
    """No assembly at this input angle; angles and slides are nan."""
    FREE = 3
    """z_3 is parallel to z_2 or z_4, or φ_4 is left free at this input angle; angles and slides are nan."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Loop:
    """Positions of closed loops; the axes (...) are those of the inputs."""

    angle: Array  # (..., 3) [rad]: φ_2, φ_3, φ_4 in (-π, π]
    slide: Array  # (..., 3) [m]: s_2, s_3, s_4
    # (..., 3, 5): derivatives of (φ_2, φ_3, φ_4) by (φ_1, α_1 … α_4), and exactly of (s_2, s_3, s_4) by
    # (s_1, a_1 … a_4)
    coefficient: Array
    status: Array  # (...) of int: a `Status` each


@dataclass(frozen=True, eq=False, kw_only=True)
class Range:
    """Input angles at which loops can be assembled: lowest ≤ cos φ_1 ≤ highest."""

    # lowest, highest (...): bounds of cos φ_1, not cut at -1 and 1; infinite where φ_1 makes no difference and the loop
    # closes, nan where it never does
    lowest: Array
    highest: Array  # (...)
    full: Array  # (...) of bool: whether the input can turn all the way round


def turning_range(alpha: ArrayLike) -> Range:
    """Return at which input angles loops can be assembled.

    Parameters
    ----------
    alpha : array (..., 4) [rad]
        α_1 … α_4.

    Notes
    -----
    The sides of the spherical triangle z_2, z_3, z_4: cos(α_2+α_3) ≤ cos α_1 cos α_4 - sin α_1 sin α_4 cos φ_1 ≤
    cos(α_2-α_3), for angles of any sign.

    Examples
    --------
    >>> import numpy as np
    >>> found = turning_range(np.radians([30, 40, 45, 70]))
    >>> float(found.lowest), float(found.highest), bool(found.full)
    (-1.48984157, 0.44491653, False)
    """
    xp = namespace(alpha)
    angles = real(alpha, xp)
    one, two, three, four = (angles[..., k] for k in range(4))
    level, depth = xp.cos(one) * xp.cos(four), xp.sin(one) * xp.sin(four)
    near, far = xp.cos(two + three), xp.cos(two - three)
    low, high = xp.minimum(near, far), xp.maximum(near, far)
    flat = xp.abs(depth) < NO_SIDE
    safe = xp.where(flat, xp.ones_like(depth), depth)
    ends = (level - high) / safe, (level - low) / safe
    closes = (level >= low - NEAR) & (level <= high + NEAR)
    wide = xp.where(closes, xp.full_like(depth, xp.inf), xp.full_like(depth, xp.nan))
    lowest = xp.where(flat, -wide, xp.minimum(*ends))
    highest = xp.where(flat, wide, xp.maximum(*ends))
    return Range(lowest=lowest, highest=highest, full=(lowest <= -1.0 + NEAR) & (highest >= 1.0 - NEAR))


def rccc(
    alpha: ArrayLike, angle: ArrayLike, *, length: ArrayLike = 0.0, slide: ArrayLike = 0.0, branch: ArrayLike = IDEAL
) -> Loop:
    """Return the position of loops at given input angles, exactly.

    Parameters
    ----------
    alpha : array (..., 4) [rad]
        α_1 … α_4, of any sign.
    angle : array (...) [rad]
        φ_1.
    length : array (..., 4) [m]
        a_1 … a_4, of any sign.
    slide : array (...) [m]
        s_1.
    branch : array (...)
        -1 for the branch of a universal joint, +1 for the other; kept over a turn the angles are continuous.

    Returns
    -------
    Loop

    Notes
    -----
    z_2·z_3 = cos α_2 is A sin φ_4 + B cos φ_4 = C with A = sin α_3 sin α_1 sin φ_1,
    B = -sin α_3 (cos α_1 sin α_4 + sin α_1 cos α_4 cos φ_1), C = cos α_2 - cos α_3 (cos α_1 cos α_4 -
    sin α_1 sin α_4 cos φ_1); its two solutions are the branches. The rest is vectors in the frame of z_1. Both
    s_1 z_1 + a_1 x_2 + s_2 z_2 + … = 0 and its twin with rates of turning, φ̇ for s and α̇ for a, are linear: one table
    of coefficients serves both. Book (141)-(156) and (171), (180), restored.

    Examples
    --------
    >>> import numpy as np
    >>> found = rccc(np.radians([90, 90, 90, 30]), np.radians(40))
    >>> np.degrees(found.angle).round(4)
    array([69.6394, 67.479 , 45.9047])
    """
    xp = namespace(alpha, angle, length, slide, branch)
    angles, phi = real(alpha, xp), real(angle, xp)
    c1, c2, c3, c4 = (xp.cos(angles[..., k]) for k in range(4))
    s1, s2, s3, s4 = (xp.sin(angles[..., k]) for k in range(4))
    cp, sp = xp.cos(phi), xp.sin(phi)
    sine, cosine, radius, excess = fourth_angle(c1, c2, c3, c4, s1, s3, s4, cp, sp, real(branch, xp))
    zero, full = 0.0 * (sine + c1), 1.0 + 0.0 * (sine + c1)

    def vector(x: Array, y: Array, z: Array) -> Array:
        return xp.stack(tuple(xp.broadcast_to(part, zero.shape) for part in (x, y, z)), axis=-1)

    z1, z2 = vector(zero, zero, full), vector(s1 * sp, -s1 * cp, c1)
    z3 = vector(s3 * sine, s3 * c4 * cosine + c3 * s4, c3 * c4 - s3 * s4 * cosine)
    z4 = vector(zero, s4, c4)
    x1, x2, x4 = vector(full, zero, zero), vector(cp, sp, zero), vector(cosine, -c4 * sine, s4 * sine)
    across = cross(z2, z3)
    size = norm(across) * xp.where(s2 < 0.0, -full, full)
    parallel = (xp.abs(s2) < NO_SIDE) | (xp.abs(s3) < NO_SIDE)
    free = parallel | (radius < NO_SIDE)
    x3 = across / xp.where(free, full, size)[..., None]

    def about(axis: Array, start: Array, end: Array) -> Array:
        turned = xp.atan2(dot(axis, cross(start, end)), dot(start, end))
        return xp.where(turned <= -xp.pi, turned + 2.0 * xp.pi, turned)

    found = xp.stack((about(z2, x2, x3), about(z3, x3, x4), about(z4, x4, x1)), axis=-1)
    volume = dot(z2, cross(z3, z4))
    dead = xp.abs(volume) < DEAD
    table = _solved((z2, z3, z4), (z1, x2, x3, x4, x1), xp.where(dead, full, volume))
    opened = excess > NO_SIDE * xp.where(radius < NO_SIDE, full, zero)
    status = xp.zeros(zero.shape, dtype=xp.int64)
    for mask, cause in ((dead, Status.DEAD), (free, Status.FREE), (opened & ~parallel, Status.OPEN)):
        status = xp.where(mask, int(cause), status)
    lost = xp.full_like(zero, xp.nan)
    table = xp.where((status > 0)[..., None, None], lost[..., None, None], table)
    errors = xp.concat(
        (vector(real(slide, xp), zero, zero)[..., :1], xp.broadcast_to(real(length, xp), (*zero.shape, 4))), axis=-1
    )
    return Loop(
        angle=xp.where((status > int(Status.DEAD))[..., None], lost[..., None], found),
        slide=xp.sum(table * errors[..., None, :], axis=-1),
        coefficient=table,
        status=status,
    )


def fourth_angle(
    c1: Array,
    c2: Array,
    c3: Array,
    c4: Array,
    s1: Array,
    s3: Array,
    s4: Array,
    cosine: Array,
    sine: Array,
    branch: ArrayLike,
) -> tuple[Array, Array, Array, Array]:
    """Return sin φ_4, cos φ_4, r and by how much the loop misses closing, from cosines and sines of α_i and φ_1."""
    xp = namespace(c1, s1, cosine)
    a = s3 * s1 * sine
    b = -s3 * (c1 * s4 + s1 * c4 * cosine)
    c = c2 - c3 * (c1 * c4 - s1 * s4 * cosine)
    square = a * a + b * b
    r = xp.sqrt(square)
    root = branch * xp.sqrt(xp.maximum((r - c) * (r + c), 0.0 * c))
    safe = xp.where(square > 0.0, square, 1.0 + 0.0 * square)
    return (a * c + b * root) / safe, (b * c - a * root) / safe, r, xp.abs(c) - r * (1.0 + NEAR)


def driven(cosine: Array, sine: Array, along: Array, across: Array) -> tuple[Array, Array, Array]:
    """Return how loops near universal joints carry an angle and a shift from the driving to the driven shaft.

    cosine, sine (..., 4): of α_1 … α_4; along, across (...): cos θ and sin θ, θ = φ_1 the angle of the driving yoke.
    Returns along, across (...): cos θ' and sin θ' of the driven yoke, θ' = π/2 - φ_4; nan where the loop does not close
    or is dead; carried, tuple of five arrays (...): derivatives of θ' by (θ, α_1 … α_4); times the errors
    (s_1, a_1 … a_4) exactly the shift -s_4.
    `rccc` without a single inverse function: with w = z_2×z_3, the row of s_4 is
    (w·z_1, w·x_2, sin α_2, w·x_4, w·x_1)/(w·z_4).
    """
    xp = namespace(cosine, along)
    c1, c3, c4 = (cosine[..., k] for k in (0, 2, 3))
    s1, s2, s3, s4 = (sine[..., k] for k in range(4))
    s, c = followed(cosine, sine, along, across)
    x2, y2 = s1 * across, -s1 * along
    x3, y3, z3 = s3 * s, s3 * c4 * c + c3 * s4, c3 * c4 - s3 * s4 * c
    x, y, z = y2 * z3 - c1 * y3, c1 * x3 - x2 * z3, x2 * y3 - y2 * x3
    volume = y * s4 + z * c4
    share = 1.0 / xp.where(xp.abs(volume) < DEAD, xp.nan + 0.0 * volume, volume)
    lost = 0.0 * share
    side, reach = s4 * z - c4 * y, along * x + across * y
    return s + lost, c + lost, (z * share, reach * share, s2 * share, (c * x + s * side) * share, x * share)


def followed(cosine: Array, sine: Array, along: Array, across: Array) -> tuple[Array, Array]:
    """Return cos θ' and sin θ' alone, as `driven` does; nan where the loop does not close."""
    xp = namespace(cosine, along)
    c1, c2, c3, c4 = (cosine[..., k] for k in range(4))
    s1, _s2, s3, s4 = (sine[..., k] for k in range(4))
    s, c, _radius, excess = fourth_angle(c1, c2, c3, c4, s1, s3, s4, along, across, IDEAL)
    lost = xp.where(excess > 0.0, xp.nan + 0.0 * excess, 0.0 * excess)
    return s + lost, c + lost


def _solved(axes: tuple[Array, Array, Array], seats: tuple[Array, ...], volume: Array) -> Array:
    """Return X of [z_2 z_3 z_4] X = -[z_1 x_2 x_3 x_4 x_1] by cross products, refined once; array (..., 3, 5)."""
    xp = namespace(volume)
    one, two, three = axes
    rows = tuple(row / volume[..., None] for row in (cross(two, three), cross(three, one), cross(one, two)))

    def inverse(vector: Array) -> tuple[Array, Array, Array]:
        return dot(rows[0], vector), dot(rows[1], vector), dot(rows[2], vector)

    columns = []
    for seat in seats:
        first = inverse(-seat)
        rest = -seat - sum(part[..., None] * axis for part, axis in zip(first, axes, strict=True))
        columns.append(xp.stack([part + more for part, more in zip(first, inverse(rest), strict=True)], axis=-1))
    return xp.stack(columns, axis=-1)


def link(alpha: Array, angle: Array, length: Array, slide: Array) -> Array:
    """Return the homogeneous matrices from frame i+1 to frame i, order (1, x, y, z); array (..., 4, 4). Book (147)."""
    xp = namespace(alpha, angle, length, slide)
    c, s, cp, sp = xp.cos(alpha), xp.sin(alpha), xp.cos(angle), xp.sin(angle)
    a, d = real(length, xp), real(slide, xp)
    zero = 0.0 * (c + cp + a + d)
    rows = (
        (1.0 + zero, zero, zero, zero),
        (a * cp, cp, -c * sp, s * sp),
        (a * sp, sp, c * cp, -s * cp),
        (d, zero, s, c),
    )
    return xp.stack([xp.stack([zero + entry for entry in row], axis=-1) for row in rows], axis=-2)


def closure(alpha: Array, angle: Array, length: Array, slide: Array) -> Array:
    """Return by how much loops fail to close: the largest element of M_12 M_23 M_34 M_41 - E; array (...).

    alpha, angle, length, slide (..., 4): α_i, φ_i [rad], a_i, s_i [m], i = 1 … 4.
    Book (141), (145).
    """
    xp = namespace(alpha, angle, length, slide)
    whole = xp.eye(4, dtype=xp.float64)
    for k in range(4):
        whole = xp.matmul(whole, link(alpha[..., k], angle[..., k], length[..., k], slide[..., k]))
    return xp.max(xp.abs(whole - xp.eye(4, dtype=xp.float64)), axis=(-2, -1))


def influence(joint_angle: ArrayLike, angle: ArrayLike, *, branch: ArrayLike = IDEAL) -> Array:
    """Return the influence coefficients of a perfect universal joint in closed form.

    Parameters
    ----------
    joint_angle : array (...) [rad]
        α = α_4.
    angle : array (...) [rad]
        φ_1, from the plane of the shafts.
    branch : array (...)
        -1 for φ_4 = atan2(cos α cos φ_1, sin φ_1), +1 for the opposite one.

    Returns
    -------
    array (..., 3, 5)
        Rows 2, 3, 4; columns s_1 or φ_1, then a_j or α_j.

    Notes
    -----
    Δ = √(sin²φ_1 + cos²α cos²φ_1). Book (171), (180) with the zeros and signs restored; the two tables are one, because
    both follow from the same three linear equations.

    Examples
    --------
    >>> import numpy as np
    >>> influence(np.asarray(0.5), np.asarray(0.0))[2].round(4) + 0.0
    array([-1.1395,  0.    , -1.1395, -0.5463,  0.    ])
    """
    xp = namespace(joint_angle, angle, branch)
    alpha, phi = real(joint_angle, xp), real(angle, xp)
    c, s, cp, sp = xp.cos(alpha), xp.sin(alpha), xp.cos(phi), xp.sin(phi)
    square = sp * sp + (c * cp) ** 2
    near = -real(branch, xp) / xp.sqrt(square)
    none = 0.0 * near
    rows = (
        (-s * c * cp / square, -s * s * sp * cp / square, -s * cp * near, -near, -sp / square),
        (s * sp * near, -c * near, none, none, -c * cp * near),
        (-c / square, -s * sp / square, -near, -s * cp * near, -s * sp * cp / square),
    )
    return xp.stack([xp.stack([entry + none for entry in row], axis=-1) for row in rows], axis=-2)
