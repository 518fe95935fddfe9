"""Life of the needle bearings of a joint: ISO 281 with its exact integral of the swing, and the makers' formulas."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache

import numpy as np

from cardan.formulas.joint_rating import NOMINAL, POWER, RATED_LIFE, RATED_SPEED_ANGLE, lasting, rated_joint_angle
from cardan.maths.arrays import Array, ArrayLike, floats, namespace
from cardan.units import deg, hour, rpm

MILLION = 1e6

CONVENTIONS = {
    "Tc": 1.5e6 * hour * rpm * deg,
    "CR": 1.5e7 * hour * rpm * deg,
    "book": RATED_LIFE * RATED_SPEED_ANGLE * (2.0 * NOMINAL) ** POWER,
}
"""Convention of a maker -> constant of L = constant/(n α)·(rating/M)^(10/3) [rad²]; the rating of book is C R."""

RELIABILITIES = {
    0.90: 1.0,
    0.95: 0.64,
    0.96: 0.55,
    0.97: 0.47,
    0.98: 0.37,
    0.99: 0.25,
    0.992: 0.22,
    0.994: 0.19,
    0.996: 0.16,
    0.998: 0.12,
    0.999: 0.093,
    0.9992: 0.087,
    0.9994: 0.080,
    0.9995: 0.077,
}
"""a_1 of ISO 281:2007, table 12."""

SLOPE = 1.5
"""Slope of Weibull's line that the table follows, with a least life of `LEAST`; ISO/TR 1281-2."""

LEAST = 0.05
"""Least life over L_10 in that law."""

LINE_SLOPE = 9.0 / 8.0
"""Slope of Weibull's line of bearings with line contact, below 90 %."""

POINT_SLOPE = 10.0 / 9.0
"""The same with point contact: of ball bearings."""

POINTS = 96
"""Gauss points of the integral over the swing: rounding up to bends of 89.9°."""


@dataclass(frozen=True, eq=False, kw_only=True)
class BearingLife:
    """Life L_10 of the bearings of a joint, arrays (...) [s]."""

    simple: Array  # (...): by the mean load M/(2R) and a travel of 4α a turn
    # driving, driven (...): of the bearings in the driving and in the driven yoke, by the exact integral over the turn
    driving: Array
    driven: Array  # (...)

    @property
    def worst(self) -> Array:
        """The shorter of the two exact lives, array (...) [s]."""
        return namespace(self.driving).minimum(self.driving, self.driven)


def bearing_life(
    capacity: ArrayLike, arm: ArrayLike, torque: ArrayLike, *, speed: ArrayLike, joint_angle: ArrayLike, torque_at: str
) -> BearingLife:
    """Return the life L_10 of the bearings of one joint by ISO 281.

    Parameters
    ----------
    capacity : array (...) [N]
        C, dynamic capacity of one bearing.
    arm : array (...) [m]
        R, half the span.
    torque : array (...) [N·m]
        M, constant on the shaft that ``torque_at`` names; without it the life is infinite.
    speed : array (...) [rad/s]
        n, not zero.
    joint_angle : array (...) [rad]
        0 < α < π/2; infinite lives at zero, where nothing rolls and ISO 281 rates nothing.
    torque_at : str
        Where the torque is constant, ``input`` or ``output``.

    Returns
    -------
    BearingLife

    Notes
    -----
    L = 10^6 turns/D. Simple: D = (2α/π)(M/(2RC))^(10/3). Exact: D = (1/2π) ∮ \\|dδ/dφ\\| (Q/C)^(10/3) dφ with
    tan δ = tan α sin φ in the driving and sin δ = sin α cos φ in the driven yoke, Q the load of a journal.

    Examples
    --------
    >>> found = bearing_life(20e3, 0.040, 800.0, speed=1000 * rpm, joint_angle=30 * deg, torque_at="input")
    >>> print(f"{found.simple / 3600:.3f} {found.driving / 3600:.3f} {found.driven / 3600:.3f} h")
    503.968 426.418 361.413 h
    """
    c, r, load, n, alpha = floats(capacity, arm, torque, speed, joint_angle)
    xp = namespace(alpha, load)
    share = xp.abs(load) / (2.0 * r * c)
    driving, driven = swing_damage(alpha, torque_at=torque_at)
    turn = 2.0 * math.pi / xp.abs(n)

    whole, load_damage = MILLION * turn, share**POWER
    simple, one, two = (lasting(whole, load_damage * travel) for travel in (2.0 * alpha / math.pi, driving, driven))
    return BearingLife(simple=simple, driving=one, driven=two)


def swing_damage(joint_angle: ArrayLike, *, torque_at: str) -> tuple[Array, Array]:
    """Return the damage of a turn in the bearings of the driving and of the driven yoke, for Q = C at the mean load.

    joint_angle (...) [rad]: 0 ≤ α < π/2; torque_at: where the torque is constant, ``input`` or ``output``.
    Returns tuple of arrays (...): (1/2π) ∮ |dδ/dφ| (2R Q/M)^(10/3) dφ; both are 2α/π for small bends.
    Taken over the swing δ itself the load is 1/cos δ in the yoke beside the constant torque and cos δ/cos α in the
    other one: (2/π) ∫_0^α (1/cos δ)^p dδ and (2/π) ∫_0^α (cos δ/cos α)^p dδ. With δ = gd(x) both are smooth up to 90°.
    """
    (alpha,) = floats(joint_angle)
    xp = namespace(alpha)
    node, weight = (xp.asarray(row) for row in _rule())
    end = xp.asinh(xp.tan(alpha))
    wide = xp.cosh(end[..., None] * node)
    scale = 2.0 / math.pi * end
    rising = scale * xp.sum(weight * wide ** (POWER - 1.0), axis=-1)
    falling = scale * xp.sum(weight * wide ** (-POWER - 1.0), axis=-1) / xp.cos(alpha) ** POWER
    return (rising, falling) if torque_at == "input" else (falling, rising)


def maker_life(
    rating: ArrayLike,
    torque: ArrayLike,
    *,
    speed: ArrayLike,
    joint_angle: ArrayLike,
    convention: str,
    shock: ArrayLike = 1.0,
) -> Array:
    """Return the life of a joint by a maker's formula, constant/(n α)·(rating/M)^(10/3) [s].

    rating (...) [N·m]: T_c, rated torque for 5000 h at 3° and 100 rpm, or C R, by the convention.
    torque (...) [N·m]: M; infinite life without it.
    speed (...) [rad/s]: n, not zero.
    joint_angle (...) [rad]: α; below 3° counted as 3°.
    convention: a name of `CONVENTIONS`. Constants of makers differ, some by a factor of two: never mix rating and
    formula.
    shock (...): factor on the torque.
    """
    rated, load, n, alpha, f = floats(rating, torque, speed, joint_angle, shock)
    xp = namespace(load)
    share = xp.abs(load) * f / rated
    return lasting(CONVENTIONS[convention] / (xp.abs(n) * rated_joint_angle(alpha)), share**POWER)


def reliability_factor(reliability: ArrayLike, *, slope: float = LINE_SLOPE) -> Array:
    """Return a_1, the life that a share of bearings reaches over the life L_10 that 90 % reach.

    reliability (...): share of bearings that last, in (0, 1); slope: of Weibull's law below 90 %.
    From 90 to 99.95 % the table of ISO 281, between its values along Weibull's law behind it,
    a_1 = 0.05 + 0.95 (ln S/ln 0.9)^(2/3), which goes on beyond. Below 90 % Weibull's law with this slope: half of the
    bearings with line contact, 9/8, reach 5.3 L_10, makers say 5.
    """
    share = np.asarray(reliability, dtype=float)
    left = np.log(share) / math.log(0.9)
    shares = np.asarray(list(RELIABILITIES))
    factors = np.asarray(list(RELIABILITIES.values()))
    law = left ** (1.0 / SLOPE)
    at = (np.log(shares) / math.log(0.9)) ** (1.0 / SLOPE)
    table = np.interp(law, at[::-1], factors[::-1])
    beyond = LEAST + (1.0 - LEAST) * law
    found: Array = np.where(share < 0.9, left ** (1.0 / slope), np.where(share > shares[-1], beyond, table))
    return found if found.ndim else found[()]


@cache
def _rule() -> tuple[Array, Array]:
    """Return Gauss's nodes and weights on (0, 1)."""
    node, weight = np.polynomial.legendre.leggauss(POINTS)
    return 0.5 + 0.5 * node, 0.5 * weight
