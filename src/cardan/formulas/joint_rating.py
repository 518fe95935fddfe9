"""What joints and their needle bearings are rated for: by the book, ISO 76 and ISO 281."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from typing import Literal, TypeAlias

import numpy as np

from cardan.catalogue import catalogue
from cardan.catalogue.rows import LifeFactor
from cardan.maths.arrays import Array, ArrayLike, floats, namespace
from cardan.units import deg, hour, mm, rpm

from .hertz import CONTACT_MODULUS

Method: TypeAlias = Literal["power_law", "table"]

POWER = 10.0 / 3.0
"""Exponent of the life of roller bearings."""


RATED_LIFE = 500.0 * hour
"""Life at which f_h is 1 [s]."""

RATED_SPEED_ANGLE = 100.0 * rpm * deg
"""Speed times bend at which f_na is 1."""

LEAST_JOINT_ANGLE = 3.0 * deg
"""Smaller bends count as this one: needles then no longer roll on each other's tracks."""

NOMINAL = 2.6
"""Nominal torque over dynamic capacity times arm."""

LIFE_RANGE = (100.0 * hour, 100_000.0 * hour)
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
        return _interpolated(value / hour, "life_factors")
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


# Needle bearings of a cross: what they carry by the book, ISO 76 and ISO 281, their contact pressure, their swing.

STATIC_PRESSURE = 4000e6
"""Contact pressure behind the static capacity of roller bearings [Pa], ISO 76."""

SHARE = 4.0
"""Load of the most loaded needle of a full row over the mean, Stribeck's figure of a bearing without play."""


@dataclass(frozen=True, eq=False, kw_only=True)
class NeedleRating:
    """Ratings of a full row of needles, arrays (...)."""

    pitch_diameter: Array  # (...) [m]: D_pw
    slimness: Array  # (...): γ, needle over pitch diameter
    static: Array  # (...) [N]: C_0r of ISO 76
    factor: Array  # (...): f_c of ISO 281
    dynamic: Array  # (...) [N]: C_r of ISO 281


@dataclass(frozen=True, eq=False, kw_only=True)
class Contact:
    """Contact of the most loaded needle with its journal, arrays (...): force [N], pressure [Pa], half-width [m]."""

    force: Array
    pressure: Array
    half_width: Array


def book_load(count: ArrayLike, diameter: ArrayLike, length: ArrayLike, cycles: ArrayLike) -> Array:
    """Return the load that the book allows on a needle bearing, Book (266): 79 z l d/∛n_p, mm and N [N].

    Parameters
    ----------
    count : array (...)
        z.
    diameter, length : array (...) [m]
        Of a needle.
    cycles : array (...) [1/s]
        Swings in a second; one for every turn of the shaft.

    Notes
    -----
    It is called static and depends on the speed; below some nine swings a minute it exceeds ISO 76, which then holds.

    Examples
    --------
    >>> round(float(book_load(22, 2.5e-3, 14e-3, 1000.0 / 60.0)), 6)
    6083.0
    """
    count, diameter, length, cycles = floats(count, diameter, length, cycles)
    return 79.0 * count * (length / mm) * (diameter / mm) / (60.0 * cycles) ** (1.0 / 3.0)


def needle_rating(count: ArrayLike, diameter: ArrayLike, length: ArrayLike, journal: ArrayLike) -> NeedleRating:
    """Return the ratings of a full row of needles by ISO 76 and ISO 281.

    Parameters
    ----------
    count : array (...)
        z.
    diameter, length, journal : array (...) [m]
        Diameter and effective length of a needle, diameter of the journal.

    Examples
    --------
    >>> round(float(needle_rating(22, 2.5e-3, 14e-3, 16e-3).static), 1)
    29301.6
    """
    count, diameter, length, journal = floats(count, diameter, length, journal)
    pitch = journal + diameter
    slim = diameter / pitch
    wide, long = diameter / mm, length / mm
    inner = (1.04 * ((1.0 - slim) / (1.0 + slim)) ** (143.0 / 108.0)) ** 4.5
    factor = 207.9 * 0.83 * slim ** (2 / 9) * (1.0 - slim) ** (29 / 27) * (1.0 + slim) ** -0.25
    factor = factor * (1.0 + inner) ** (-2 / 9)
    return NeedleRating(
        pitch_diameter=pitch,
        slimness=slim,
        static=44.0 * (1.0 - slim) * count * long * wide,
        factor=factor,
        dynamic=factor * long ** (7 / 9) * count**0.75 * wide ** (29 / 27),
    )


def needle_contact(
    force: ArrayLike, count: ArrayLike, diameter: ArrayLike, length: ArrayLike, journal: ArrayLike
) -> Contact:
    """Return the contact of the most loaded needle with its journal, by Hertz.

    Parameters
    ----------
    force : array (...) [N]
        Q of the journal.
    count : array (...)
        z.
    diameter, length, journal : array (...) [m]

    Notes
    -----
    F = 4Q/z, q = F/L, 1/R = 2/D_w + 2/d_j, b = √(4qR/(πE*)), p = 2q/(πb).

    Examples
    --------
    >>> round(float(needle_contact(20e3, 22, 2.5e-3, 14e-3, 16e-3).pressure) / 1e6, 1)
    2942.1
    """
    force, count, diameter, length, journal = floats(force, count, diameter, length, journal)
    xp = namespace(force)
    most = SHARE * force / count
    line = most / length
    radius = 1.0 / (2.0 / diameter + 2.0 / journal)
    half = xp.sqrt(4.0 * line * radius / (math.pi * CONTACT_MODULUS))
    pressure = xp.sqrt(line * CONTACT_MODULUS / (math.pi * radius))
    return Contact(force=most, pressure=pressure, half_width=half)


def critical_swing(count: ArrayLike, diameter: ArrayLike, journal: ArrayLike) -> tuple[Array, Array]:
    """Return the joint angles from which needles reach their neighbours' tracks on the inner and the outer race [rad].

    Parameters
    ----------
    count : array (...)
        z.
    diameter, journal : array (...) [m]

    Notes
    -----
    2π/(z(1+γ)) and 2π/(z(1-γ)), pure rolling. Below the inner value every needle wears its own patch (false
    brinelling), and life formulas promise too much.

    Examples
    --------
    >>> [round(math.degrees(one), 3) for one in critical_swing(22, 2.5e-3, 16e-3)]
    [14.416, 18.92]
    """
    count, diameter, journal = floats(count, diameter, journal)
    slim = diameter / (journal + diameter)
    return 2.0 * math.pi / (count * (1.0 + slim)), 2.0 * math.pi / (count * (1.0 - slim))
