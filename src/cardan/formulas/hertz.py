"""Contact of two curved bodies by Hertz: of balls in grooves, of rollers on tracks."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from cardan.later import later
from cardan.maths.arrays import Array, ArrayLike, floats

special = later("scipy.special")

CONTACT_MODULUS = 206e9 / (2.0 * (1.0 - 0.3**2))
"""E* of steel on steel [Pa]."""

HALVINGS = 60
"""Bisections of the logarithm of the axis ratio: down to rounding."""

SLIMMEST = math.log(1e8)
"""Logarithm of the largest axis ratio that is looked for."""


@dataclass(frozen=True, eq=False, kw_only=True)
class PointContact:
    """Ellipse of contact, arrays (...)."""

    pressure: Array  # (...) [Pa]: p_0, largest pressure
    long: Array  # long, short (...) [m]: half axes a ≥ b
    short: Array


def point_contact(
    force: ArrayLike, first: ArrayLike, second: ArrayLike, *, modulus: float = CONTACT_MODULUS
) -> PointContact:
    """Return the contact of two bodies that touch at a point, by Hertz.

    force (...) [N]: F, not negative; first, second (...) [1/m]: sums of the curvatures of both bodies in their two
    principal planes, hollow ones negative, both sums above zero; modulus [Pa]: E*, 1/E* = (1 - ν_1²)/E_1 +
    (1 - ν_2²)/E_2, that of steel on steel by default.

    With A ≤ B half of both sums, κ = a/b and e² = 1 - 1/κ²: B/A = (κ² E(e) - K(e))/(K(e) - E(e)),
    p_0³ = 3 F E*² (A + B)²/(2π κ E(e)²), b = p_0 E(e)/(E* (A + B)), K and E the complete elliptic integrals;
    K. L. Johnson, Contact Mechanics (1985), eq. 4.25 to 4.28.

    A ball of 10 mm on a plane:

    >>> found = point_contact(100.0, 200.0, 200.0)
    >>> print(f"{found.pressure / 1e6:.1f} MPa, {found.long * 1e6:.2f} µm")
    2148.4 MPa, 149.08 µm
    """
    load, one, other = floats(force, first, second)
    small, large = 0.5 * np.minimum(one, other), 0.5 * np.maximum(one, other)
    low, high = np.zeros(np.shape(large / small)), np.full(np.shape(large / small), SLIMMEST)
    for _half in range(HALVINGS):
        middle = 0.5 * (low + high)
        flat = np.exp(-2.0 * middle)
        whole, rest = special().ellipe(-np.expm1(-2.0 * middle)), special().ellipkm1(flat)
        slim = (whole - flat * rest) * small > flat * (rest - whole) * large
        low, high = np.where(slim, low, middle), np.where(slim, middle, high)
    ratio = np.exp(0.5 * (low + high))
    whole = special().ellipe(1.0 - 1.0 / ratio**2)
    both = modulus * (small + large)
    pressure = np.cbrt(1.5 * load * both**2 / (math.pi * ratio * whole**2))
    short = pressure * whole / both
    return PointContact(pressure=pressure, long=ratio * short, short=short)
