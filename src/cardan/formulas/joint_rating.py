"""The book's rating of a joint: factors of life and of speed times bend, the torque it may carry, its life."""

from __future__ import annotations

from functools import cache
from typing import Literal, TypeAlias

import numpy as np

from cardan.catalogue import catalogue
from cardan.catalogue.rows import LifeFactor
from cardan.maths.arrays import Array, ArrayLike, floats, namespace
from cardan.units import deg, rpm

Method: TypeAlias = Literal["power_law", "table"]

POWER = 10.0 / 3.0
"""Exponent of the life of roller bearings."""

HOUR = 3600.0

RATED_LIFE = 500.0 * HOUR
"""Life at which f_h is 1 [s]."""

RATED_SPEED_ANGLE = 100.0 * rpm * deg
"""Speed times bend at which f_na is 1."""

LEAST_JOINT_ANGLE = 3.0 * deg
"""Smaller bends count as this one: needles then no longer roll on each other's tracks."""

NOMINAL = 2.6
"""Nominal torque over dynamic capacity times arm."""

LIFE_RANGE = (100.0 * HOUR, 100_000.0 * HOUR)
"""Ends of table 6 [s]."""

SPEED_ANGLE_RANGE = (10.0 * rpm * deg, 35_000.0 * rpm * deg)
"""Ends of table 7."""

ROUNDING = 1e-9
"""What lies beyond the end of a table by this share of it is still its end."""


def life_factor(life: ArrayLike, *, method: Method = "power_law") -> Array:
    """Return f_h = (L_h/500 h)^(3/10), Book table 6.

    Parameters
    ----------
    life : array (...) [s]
        L_h, above zero.
    method : str
        ``power_law``, or ``table``: straight between the points of the table, both axes logarithmic, misprints put
        right; nan outside it.

    Notes
    -----
    The exponents of tables 6 and 7 by least squares are 0.30003 and 0.30066: both are the law of roller bearings.

    Examples
    --------
    >>> from cardan.units import factor
    >>> hour = factor("time", "h")
    >>> life_factor(2500 * hour).round(4), life_factor(2500 * hour, method="table")
    (np.float64(1.6207), np.float64(1.62))
    """
    (value,) = floats(life)
    if method == "table":
        return _interpolated(value / HOUR, "life_factors")
    return (value / RATED_LIFE) ** (1.0 / POWER)


def speed_angle_factor(speed_angle: ArrayLike, *, method: Method = "power_law") -> Array:
    """Return f_na = (n α/100)^(3/10), n in rpm and α in degrees, Book table 7.

    Parameters
    ----------
    speed_angle : array (...) [rad²/s]
        Speed times bend, above zero.
    method : str
        As for `life_factor`.

    Examples
    --------
    >>> speed_angle_factor(3000 * rpm * deg).round(4), speed_angle_factor(3000 * rpm * deg, method="table")
    (np.float64(2.7742), np.float64(2.77))
    """
    (value,) = floats(speed_angle)
    if method == "table":
        return _interpolated(value / (rpm * deg), "speed_angle_factors")
    return (value / RATED_SPEED_ANGLE) ** (1.0 / POWER)


def rated_joint_angle(joint_angle: ArrayLike) -> Array:
    """Return the joint angle that the book and the makers count: at least 3°.

    Parameters
    ----------
    joint_angle : array (...) [rad]
        α.
    """
    (value,) = floats(joint_angle)
    return namespace(value).maximum(value, value * 0.0 + LEAST_JOINT_ANGLE)


def nominal_torque(capacity: ArrayLike, arm: ArrayLike) -> Array:
    """Return M_nom = 2.6 c R, the torque for 5000 h at 33.3 rpm and 3°.

    Parameters
    ----------
    capacity : array (...) [N]
        c, dynamic capacity of one bearing.
    arm : array (...) [m]
        R, from the axis of the shaft to the middle of the bearing: half the span.

    Examples
    --------
    >>> print(nominal_torque(20e3, 0.040))
    2080.0
    """
    c, r = floats(capacity, arm)
    return NOMINAL * c * r


def rated_torque(
    nominal: ArrayLike, *, speed: ArrayLike, joint_angle: ArrayLike, life: ArrayLike, shock: ArrayLike = 1.0
) -> Array:
    """Return the torque that a joint may carry for a life, Book (267): 2 M_nom/(f_d f_h f_na) [N·m].

    Parameters
    ----------
    nominal : array (...) [N·m]
        M_nom.
    speed : array (...) [rad/s]
        n, either way round.
    joint_angle : array (...) [rad]
        α; below 3° counted as 3°.
    life : array (...) [s]
        L_h.
    shock : array (...)
        f_d, 1 for moderate shocks to 1.38 for strong ones.

    Notes
    -----
    The factor 2 cannot be read in print; without it the rating point 5000 h, n α = 100, where f_h is 2.00, would not
    give M_nom.

    Examples
    --------
    >>> torque = rated_torque(2080.0, speed=1000 * rpm, joint_angle=6 * deg, life=2000 * 3600.0, shock=1.38)
    >>> print(f"{torque:.4f}")
    582.3055
    """
    m, n, alpha, lasts, f = floats(nominal, speed, joint_angle, life, shock)
    factor = speed_angle_factor(namespace(n).abs(n) * rated_joint_angle(alpha))
    return 2.0 * m / (f * life_factor(lasts) * factor)


def book_life(
    nominal: ArrayLike, torque: ArrayLike, *, speed: ArrayLike, joint_angle: ArrayLike, shock: ArrayLike = 1.0
) -> Array:
    """Return the life of a joint by the book, (267) and (269) solved for it: 500 h [2 M_nom/(f_d f_na M)]^(10/3) [s].

    Parameters
    ----------
    nominal : array (...) [N·m]
        M_nom.
    torque : array (...) [N·m]
        M; without torque the life is unlimited, infinite here.
    speed : array (...) [rad/s]
        n, not zero.
    joint_angle : array (...) [rad]
        α; below 3° counted as 3°.
    shock : array (...)
        f_d.

    Examples
    --------
    >>> print(f"{book_life(2080.0, 900.0, speed=1500 * rpm, joint_angle=5 * deg) / 3600:.4f} h")
    1096.6755 h
    """
    m, load, n, alpha, f = floats(nominal, torque, speed, joint_angle, shock)
    xp = namespace(load)
    factor = speed_angle_factor(xp.abs(n) * rated_joint_angle(alpha))
    share = xp.abs(load) * f * factor / (2.0 * m)
    return lasting(RATED_LIFE, share**POWER)


def lasting(life: ArrayLike, damage: Array) -> Array:
    """Return a life over a damage, infinite where nothing is damaged."""
    xp = namespace(damage)
    some = damage > 0.0
    return xp.where(some, life / xp.where(some, damage, 0.0 * damage + 1.0), 0.0 * damage + float("inf"))


def within(value: ArrayLike, ends: tuple[float, float]) -> Array:
    """Tell whether values lie in the range of a table, its ends included."""
    (given,) = floats(value)
    return (given >= ends[0] * (1.0 - ROUNDING)) & (given <= ends[1] * (1.0 + ROUNDING))


def _interpolated(at: Array, name: str) -> Array:
    """Return the factors of a table, nan outside it."""
    place, factor = _points(name)
    value = np.asarray(at, dtype=float)
    inside = within(value, (place[0], place[-1]))
    safe = np.clip(np.where(value > 0.0, value, 1.0), place[0], place[-1])
    found: Array = np.where(inside, np.exp(np.interp(np.log(safe), np.log(place), np.log(factor))), np.nan)
    return found if found.ndim else found[()]


@cache
def _points(name: str) -> tuple[Array, Array]:
    """Return places and factors of a table, rising."""
    rows = sorted(catalogue().table(name, LifeFactor).values(), key=lambda row: row.at)
    return np.asarray([row.at for row in rows]), np.asarray([row.factor for row in rows])
