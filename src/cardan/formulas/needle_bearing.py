"""Needle bearings of a cross: what they carry by the book, ISO 76 and ISO 281, their contact pressure, their swing."""

from __future__ import annotations

import math
from dataclasses import dataclass

from cardan.maths.arrays import Array, ArrayLike, floats, namespace
from cardan.units import mm

CONTACT_MODULUS = 206e9 / (2.0 * (1.0 - 0.3**2))
"""E* of steel on steel [Pa]."""

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
