"""Strength and stiffness of a shaft: stresses of torsion and bending, the diameter that carries a torque, the twist."""

from __future__ import annotations

import math
from dataclasses import dataclass

from cardan.maths.arrays import Array, ArrayLike, floats, namespace

RATED_TWIST = math.radians(9.0)
"""Largest twist of a drive's shafts by the book, p. 228 [rad]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class ShaftStress:
    """Stresses at the surface of a round shaft, arrays (...) [Pa]."""

    torsion: Array  # (...): τ = T/W_t
    bending: Array  # (...): σ = 2 M/W_t
    shear: Array  # (...): largest shear stress √(T² + M²)/W_t, that of Tresca
    mises: Array  # (...): √(σ² + 3τ²)


def torsion_modulus(outer: ArrayLike, inner: ArrayLike = 0.0) -> Array:
    """Return W_t = π(D⁴ - d⁴)/(16 D) of a round section [m³].

    outer, inner (...) [m].

    >>> round(float(torsion_modulus(0.075, 0.070)) * 1e9, 1)
    19976.9
    """
    outer, inner = floats(outer, inner)
    return math.pi * (outer**4 - inner**4) / (16.0 * outer)


def polar_moment(outer: ArrayLike, inner: ArrayLike = 0.0) -> Array:
    """Return J = π(D⁴ - d⁴)/32 of a round section [m⁴]."""
    outer, inner = floats(outer, inner)
    return math.pi * (outer**4 - inner**4) / 32.0


def shaft_stress(torque: ArrayLike, bending: ArrayLike, outer: ArrayLike, inner: ArrayLike = 0.0) -> ShaftStress:
    """Return the stresses of a round shaft under torque and bending, Book (261).

    Parameters
    ----------
    torque, bending : array (...) [N·m]
        T and M_b, dynamic loads included.
    outer, inner : array (...) [m]
        D and d, 0 ≤ d < D.

    Examples
    --------
    >>> round(float(shaft_stress(2000.0, 350.0, 0.075, 0.070).shear) / 1e6, 3)
    101.637
    """
    torque, bending = floats(torque, bending)
    xp = namespace(torque, bending)
    modulus = torsion_modulus(outer, inner)
    tau, sigma = torque / modulus, 2.0 * bending / modulus
    return ShaftStress(
        torsion=tau,
        bending=sigma,
        shear=xp.sqrt(torque**2 + bending**2) / modulus,
        mises=xp.sqrt(sigma**2 + 3.0 * tau**2),
    )


def shaft_diameter(torque: ArrayLike, shear_stress: ArrayLike, bore_ratio: ArrayLike = 0.0) -> Array:
    """Return the outer diameter that carries a torque, D = [16 T/(π [τ] (1 - k⁴))]^(1/3) [m].

    Parameters
    ----------
    torque : array (...) [N·m]
        T, with the bending moment √(T² + M²).
    shear_stress : array (...) [Pa]
        Largest shear stress allowed.
    bore_ratio : array (...)
        k = d/D, 0 ≤ k < 1.

    Examples
    --------
    >>> round(float(shaft_diameter(946.6875, 323.73e6)) * 1e3, 3)
    24.604
    """
    torque, shear_stress, ratio = floats(torque, shear_stress, bore_ratio)
    return (16.0 * torque / (math.pi * shear_stress * (1.0 - ratio**4))) ** (1.0 / 3.0)


def shaft_twist(
    torque: ArrayLike, shear_modulus: ArrayLike, length: ArrayLike, outer: ArrayLike, inner: ArrayLike = 0.0
) -> Array:
    """Return the twist of a stepped shaft, Σ T l_i/(G J_i) [rad].

    Parameters
    ----------
    torque : array (...) [N·m]
        Sign kept.
    shear_modulus : array (...) or (..., k) [Pa]
    length, outer, inner : array (..., k) [m]
        Of its segments.

    Notes
    -----
    Book (262) puts the combined moment of torsion and bending here; only the torque twists a shaft.

    Examples
    --------
    >>> round(math.degrees(shaft_twist(2000.0, 80e9, [1.5], [0.075], [0.070])), 4)
    2.8681
    """
    torque, shear_modulus, length = floats(torque, shear_modulus, length)
    xp = namespace(length, torque)
    flexible = length / (polar_moment(outer, inner) * shear_modulus)
    return torque * xp.sum(flexible, axis=-1)


def wall_buckling_torque(outer: ArrayLike, inner: ArrayLike, youngs: ArrayLike, poisson: ArrayLike = 0.3) -> Array:
    """Return the torque at which the wall of a long tube buckles, T = 2π r² t τ [N·m].

    outer, inner (...) [m]: D and d; for walls that are thin beside the radius.
    youngs, poisson (...) [Pa, -]: E and ν.
    τ = E (t/r)^(3/2)/(3√2 (1 - ν²)^(3/4)), r the mean radius: Timoshenko and Gere, Theory of elastic stability, 11.11,
    after Schwerin; 0.253 E (t/r)^(3/2) for ν = 0.3. Ends that are held close together hold more.

    >>> round(float(wall_buckling_torque(0.076, 0.072, 2.06e11)))
    11267
    """
    outer, inner, youngs, poisson = floats(outer, inner, youngs, poisson)
    radius, wall = 0.25 * (outer + inner), 0.5 * (outer - inner)
    stress = youngs * (wall / radius) ** 1.5 / (3.0 * math.sqrt(2.0) * (1.0 - poisson**2) ** 0.75)
    return 2.0 * math.pi * radius**2 * wall * stress
