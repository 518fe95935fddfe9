"""Rating of deep groove ball bearings by ISO 281 and ISO 76: equivalent loads and the life they allow."""

from __future__ import annotations

import math

import numpy as np

from cardan.maths.arrays import Array, ArrayLike

from .joint_rating import lasting

POWER = 3.0
"""Exponent of the life of ball bearings."""

MILLION = 1e6
"""Revolutions of the rating life under the dynamic capacity."""

RADIAL = 0.56
"""X where the axial force counts."""

THRUST = (0.014, 0.028, 0.056, 0.084, 0.11, 0.17, 0.28, 0.42, 0.56)
"""Axial force over static capacity at which the table of ISO 281 has a row: e and Y below."""

LEAST = (0.19, 0.22, 0.26, 0.28, 0.30, 0.34, 0.38, 0.42, 0.44)
"""e: axial over radial force up to which the axial force does not count."""

AXIAL = (2.30, 1.99, 1.71, 1.55, 1.45, 1.31, 1.15, 1.04, 1.00)
"""Y where it counts."""


def equivalent_load(radial: ArrayLike, axial: ArrayLike, static_capacity: ArrayLike) -> Array:
    """Return the radial load of a deep groove ball bearing that damages as much, P = X F_r + Y F_a, ISO 281.

    Parameters
    ----------
    radial, axial : arrays (...) [N]
        Sizes of the forces on the bearing.
    static_capacity : array (...) [N]
        C_0; it does not count where there is no axial force, and may be nan there.

    Notes
    -----
    X = 1 and Y = 0 up to F_a/F_r = e, then X = 0.56; e and Y by F_a/C_0, straight between the rows of the table and as
    at its ends outside of it. Normal internal clearance.

    Examples
    --------
    A 6207, TPI catalogue 2202/TE, p. 11: e = 0.29, Y = 1.48, P = 3.94 kN.

    >>> print(f"{equivalent_load(2.8e3, 1.6e3, 15.3e3):.0f} N")
    3921 N
    """
    across, along, static = np.broadcast_arrays(
        *(np.asarray(one, dtype=float) for one in (radial, axial, static_capacity))
    )
    push = np.divide(along, static, out=np.zeros_like(along), where=along > 0.0)
    counts = along > np.interp(push, THRUST, LEAST) * across
    found: Array = np.where(counts, RADIAL * across + np.interp(push, THRUST, AXIAL) * along, across)
    return found if found.ndim else found[()]


def static_load(radial: ArrayLike, axial: ArrayLike) -> Array:
    """Return the radial load at rest of a deep groove ball bearing, P_0 = max(F_r, 0.6 F_r + 0.5 F_a), ISO 76 [N].

    Parameters
    ----------
    radial, axial : arrays (...) [N]
        Sizes of the forces on the bearing.

    Examples
    --------
    >>> print(static_load(2000.0, 1000.0), static_load(1000.0, 2000.0))
    2000.0 1600.0
    """
    across, along = np.asarray(radial, dtype=float), np.asarray(axial, dtype=float)
    found: Array = np.maximum(across, 0.6 * across + 0.5 * along)
    return found


def ball_life(capacity: ArrayLike, load: ArrayLike, *, speed: ArrayLike) -> Array:
    """Return the rating life L_10 of a ball bearing, 10^6 (2π/ω) (C/P)^3, ISO 281 [s]; infinite without load or speed.

    Parameters
    ----------
    capacity : array (...) [N]
        C, dynamic capacity.
    load : array (...) [N]
        P, equivalent load.
    speed : array (...) [rad/s]
        ω, either way round.

    Examples
    --------
    A 6207 under 2.8 kN at 650 rpm, TPI catalogue 2202/TE, p. 11: about 20 000 h.

    >>> from cardan.units import rpm
    >>> print(f"{ball_life(25.7e3, 2.8e3, speed=650 * rpm) / 3600:.0f} h")
    19827 h
    """
    rate = np.abs(np.asarray(speed, dtype=float)) / (2.0 * math.pi)
    return lasting(MILLION, rate * (np.asarray(load, dtype=float) / np.asarray(capacity, dtype=float)) ** POWER)
