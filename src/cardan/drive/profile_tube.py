"""Profile tubes of power take-off shafts: lobed tubes that slide in one another, and what their cross section is."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from cardan.maths.arrays import Array, ArrayLike
from cardan.units import plain, quantity

LOBES = {"lemon": 2, "triangle": 3}
"""Lobes of the forms whose name says them."""

PLACES = 720
"""Places around the contour at which the wall is summed up: the sums of so smooth a curve are exact."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Profile:
    """Contour of a tube that is not round: equally spaced lobes between two circles."""

    form: str = plain(doc="form of the tube; a star needs its lobes", choices=("lemon", "triangle", "star"))
    inscribed: float = quantity("length", doc="diameter of the largest circle inside the outer contour", above=0.0)
    lobes: int | None = plain(None, doc="lobes around the tube; 2 of a lemon and 3 of a triangle", low=2)

    @property
    def count(self) -> int:
        """Lobes around the tube; 0 where the file does not say it."""
        return self.lobes or LOBES.get(self.form, 0)


@dataclass(frozen=True, eq=False, kw_only=True)
class ProfileSection:
    """Cross section of a lobed tube, arrays (...)."""

    area: Array  # [m²]
    second_moment: Array  # [m⁴]: about the softer of the axes of symmetry
    polar: Array  # [m⁴]: of the wall about the axis of the tube
    torsion: Array  # [m⁴]: constant of torsion
    modulus: Array  # [m³]: W_t, or twice the smaller modulus in bending where that is less

    @property
    def unequal(self) -> Array:
        """Share by which its critical speed about the stiffer axis is higher, array (...)."""
        found: Array = np.sqrt(self.polar / self.second_moment - 1.0) - 1.0
        return found

    @property
    def round(self) -> tuple[Array, Array]:
        """Outer and inner diameter of the round tube of the same area and second moment, arrays (...) [m]."""
        radius, wall = 8.0 * self.second_moment / self.area, 2.0 * self.area / np.pi
        return np.sqrt(radius + wall), np.sqrt(np.maximum(radius - wall, 0.0))


def profile_section(outer: ArrayLike, inscribed: ArrayLike, wall: ArrayLike, lobes: int) -> ProfileSection:
    """Return the cross section of a lobed tube of n lobes by the formulas of thin walls, arrays (...).

    outer, inscribed, wall [m]: circles around and inside the contour r = (D + d)/4 + (D - d)/4 cos nφ, and its wall.
    A = t ∮ ds, I = t ∮ y² ds, by Bredt I_t = 4 A_m² t/∮ ds (Timoshenko & Goodier, Theory of Elasticity, art. 116). The
    shear stress T/(2 A_m t) of the middle line changes by 2 T/I_t - T κ/(2 A_m t) a unit of length through the wall, of
    curvature κ. The contour is a cosine: a maker's own figures go before.

    >>> found = profile_section(0.054, 0.046, 0.004, 2)
    >>> print(f"{found.torsion * 1e12:.0f} mm4, {found.modulus * 1e9:.0f} mm3")
    305803 mm4, 11806 mm3
    """
    high, low, thick = (np.asarray(one, dtype=float)[..., None] for one in (outer, inscribed, wall))
    phi, t = 2.0 * np.pi * np.arange(PLACES) / PLACES, thick[..., 0]
    lobe = 0.25 * (high - low)
    radius = 0.25 * (high + low) + lobe * np.cos(lobes * phi)
    slope, bend = -lobe * lobes * np.sin(lobes * phi), -lobe * lobes**2 * np.cos(lobes * phi)
    middle = radius - 0.5 * thick
    along = np.hypot(middle, slope)
    step = along * (2.0 * np.pi / PLACES)
    length, inside = np.sum(step, axis=-1), np.sum(0.5 * middle**2, axis=-1) * (2.0 * np.pi / PLACES)
    waves = np.sin(phi), np.cos(phi)
    second = [t * np.sum((middle * wave) ** 2 * step, axis=-1) for wave in waves]
    bending = [i / np.max(np.abs(radius * wave), axis=-1) for i, wave in zip(second, waves, strict=True)]
    torsion, mean = 4.0 * inside**2 * t / length, 1.0 / (2.0 * inside * t)
    curvature = (middle**2 + 2.0 * slope**2 - middle * bend) / along**3
    through = np.max(np.abs(2.0 / torsion[..., None] - curvature * mean[..., None]), axis=-1)
    return ProfileSection(
        area=t * length,
        second_moment=np.minimum(*second),
        polar=second[0] + second[1],
        torsion=torsion,
        modulus=np.minimum(1.0 / (mean + 0.5 * t * through), 2.0 * np.minimum(*bending)),
    )


@lru_cache(maxsize=64)
def one_section(outer: float, inscribed: float, wall: float, lobes: int) -> ProfileSection:
    """Return the cross section of one tube."""
    return profile_section(outer, inscribed, wall, lobes)


def stressed_bore(outer: ArrayLike, modulus: ArrayLike) -> Array:
    """Return the bore of the round tube of an outer diameter whose modulus in torsion is given, array (...) [m]."""
    wide, resisting = np.asarray(outer, dtype=float), np.asarray(modulus, dtype=float)
    found: Array = np.maximum(wide**4 - 16.0 * wide * resisting / np.pi, 0.0) ** 0.25
    return found
