"""Limits of joint angles in practice: angular accelerations of two joints, rules and products of speed and angle."""

from __future__ import annotations

import math
from dataclasses import dataclass

from cardan.maths.arrays import Array, ArrayLike, floats, namespace
from cardan.units import deg

from .equivalence import largest_acceleration

TABLE_TORSIONAL = 400.0
"""Torsional acceleration behind the articles' table of joint angles [rad/s²]."""

TABLE_INERTIA = 1010.0
"""Acceleration of the second joint where the rows of that table end, with its rounding [rad/s²]."""

RULE_ANGLE, RULE_DIFFERENCE = 6.0 * deg, 1.5 * deg
"""The articles' rule: each angle at most 6°, their difference at most 1.5°."""


@dataclass(frozen=True, eq=False, kw_only=True)
class AngleLimits:
    """Angular accelerations of a drive of two joints, arrays (...)."""

    residual: Array  # (...) [rad]: angle of the one joint that would be as uneven
    torsional: Array  # (...) [rad/s²]: of the output, for small angles
    torsional_exact: Array  # (...) [rad/s²]: the same without approximation
    # inertia_drive, inertia_coast (...) [rad/s²]: of the middle shaft, the input or the output turning evenly, for
    # small angles
    inertia_drive: Array
    inertia_coast: Array  # (...) [rad/s²]
    least: Array  # least, most (...) [rad]: range of the second angle that keeps the limit; nan where none does
    most: Array  # (...) [rad]


def angle_limits(
    speed: ArrayLike,
    first: ArrayLike,
    second: ArrayLike,
    *,
    phased: bool = True,
    torsional: ArrayLike = TABLE_TORSIONAL,
) -> AngleLimits:
    """Return the angular accelerations of two joints, and which second angle keeps the torsional limit.

    speed (...) [rad/s]: ω of the input; first, second (...) [rad]: θ_1 and θ_2.
    phased: whether the yokes of the middle shaft are set so that the joints cancel; else a quarter turn wrong.
    torsional (...) [rad/s²]: limit a of the output's acceleration.
    Small angles: ω²|θ_2² ∓ θ_1²|, ω²θ_1², ω²θ_2². Exact: that of the equivalent joint, cos α = cos θ_2/cos θ_1 or its
    inverse, cos θ_1 cos θ_2 when not phased.
    """
    speed, first, second, limit = floats(speed, first, second, torsional)
    xp = namespace(speed)
    square = speed**2
    one, two = square * first**2, square * second**2
    small = xp.abs(two - one) if phased else two + one
    high, low = xp.maximum(first, second), xp.minimum(first, second)
    cosine = xp.cos(high) / xp.cos(low) if phased else xp.cos(first) * xp.cos(second)
    sine = xp.sqrt(xp.sin(high + low) * xp.sin(high - low)) / xp.cos(low) if phased else None
    joint_angle = xp.acos(cosine) if sine is None else xp.atan2(sine, cosine)
    reach = limit / square
    nothing = 0.0 * (first + reach)
    if phased:
        least = xp.sqrt(xp.maximum(first**2 - reach, nothing))
        most = xp.sqrt(first**2 + reach)
    else:
        room = reach - first**2
        least = xp.where(room >= 0.0, nothing, math.nan)
        most = xp.where(room >= 0.0, xp.sqrt(xp.maximum(room, nothing)), math.nan)
    return AngleLimits(
        residual=xp.sqrt(small) / speed,
        torsional=small,
        torsional_exact=square * largest_acceleration(joint_angle),
        inertia_drive=one,
        inertia_coast=two,
        least=least,
        most=most,
    )


def compound_angle(top: ArrayLike, side: ArrayLike) -> tuple[Array, Array]:
    """Return the angle between two shafts from its top and side view, exact and by the shop's formula [rad].

    top, side (...) [rad]: T and S.
    tan θ = √(tan²T + tan²S); in the shop θ ≈ √(T² + S²).

    >>> [round(math.degrees(one), 4) for one in compound_angle(math.radians(20.0), math.radians(25.0))]
    [30.6059, 32.0156]
    """
    top, side = floats(top, side)
    xp = namespace(top)
    return xp.atan(xp.sqrt(xp.tan(top) ** 2 + xp.tan(side) ** 2)), xp.sqrt(top**2 + side**2)


def broken_rules(first: float, second: float) -> tuple[str, ...]:
    """Return which parts of the 6°/1.5° rule two angles break: "angle", "difference".

    >>> broken_rules(math.radians(4.0), math.radians(5.6))
    ('difference',)
    """
    slack = 1e-12
    angle = max(abs(first), abs(second)) > RULE_ANGLE + slack
    difference = abs(first - second) > RULE_DIFFERENCE + slack
    return (("angle",) if angle else ()) + (("difference",) if difference else ())
