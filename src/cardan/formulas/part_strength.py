"""Strength of a joint's parts: the arms of its yokes, the journals of its cross, a straight-sided spline."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from cardan.maths.arrays import Array, ArrayLike, floats, namespace

TERMS = 20
"""Terms of Saint-Venant's series: the twentieth is below 1e-25 of the first for any section."""


@dataclass(frozen=True, eq=False, kw_only=True)
class PartStress:
    """Stresses of a part, arrays (...) [Pa]."""

    bending: Array  # (...): largest bending stress
    shear: Array  # (...): largest shear stress: of torsion in a yoke, of the force in a journal
    mises: Array  # (...): √(σ² + 3τ²); in a yoke both maxima taken at one point, which is on the safe side
    mean_shear: Array | None = None  # (...): force over area, of a journal


def yoke_stress(
    force: ArrayLike, *, bending_arm: ArrayLike, torsion_arm: ArrayLike, height: ArrayLike, width: ArrayLike, shape: str
) -> PartStress:
    """Return the stresses of an arm of a yoke, Book (263).

    Parameters
    ----------
    force : array (...) [N]
        Q of a journal.
    bending_arm, torsion_arm : array (...) [m]
        c and a, arms of the force at the weakest section.
    height, width : array (...) [m]
        Of this section, along and across the force.
    shape : "rectangle" or "ellipse"

    Examples
    --------
    >>> one = yoke_stress(22e3, bending_arm=0.03, torsion_arm=0.012, height=0.032, width=0.022, shape="rectangle")
    >>> round(float(one.bending) / 1e6, 3), round(float(one.shear) / 1e6, 2)
    (175.781, 74.32)
    """
    force, bending_arm, torsion_arm, height, width = floats(force, bending_arm, torsion_arm, height, width)
    xp = namespace(force)
    long, short = xp.maximum(height, width), xp.minimum(height, width)
    if shape == "ellipse":
        modulus = math.pi * width * height**2 / 32.0
        shear = 16.0 * force * torsion_arm / (math.pi * long * short**2)
    else:
        modulus = width * height**2 / 6.0
        shear = force * torsion_arm / rectangle_torsion_modulus(long, short)
    bending = force * bending_arm / modulus
    return PartStress(bending=bending, shear=shear, mises=xp.sqrt(bending**2 + 3.0 * shear**2))


def rectangle_torsion_modulus(long: ArrayLike, short: ArrayLike) -> Array:
    """Return torque over largest shear stress of a rectangular bar, by Saint-Venant [m³].

    long, short (...) [m]: sides A ≥ B.
    I_t = A B³[1/3 - (64/π⁵)(B/A) Σ tanh(kπA/2B)/k⁵], τ_max = (T B/I_t)[1 - (8/π²) Σ 1/(k² cosh(kπA/2B))] in the middle
    of the long side, k = 1, 3, 5 …

    >>> round(float(rectangle_torsion_modulus(1.0, 1.0)), 4)
    0.2082
    """
    long, short = floats(long, short)
    xp = namespace(long)
    inside, edge = 0.0 * long, 0.0 * long
    for k in range(1, 2 * TERMS, 2):
        reach = 0.5 * k * math.pi * long / short
        damped = xp.exp(-xp.minimum(reach, 0.0 * reach + 700.0))
        inside = inside + xp.tanh(reach) / k**5
        edge = edge + 2.0 * damped / (k**2 * (1.0 + damped**2))
    twisting = long * short**3 * (1.0 / 3.0 - 64.0 / math.pi**5 * short / long * inside)
    return twisting / (short * (1.0 - 8.0 / math.pi**2 * edge))


def journal_stress(force: ArrayLike, *, diameter: ArrayLike, arm: ArrayLike, bore: ArrayLike = 0.0) -> PartStress:
    """Return the stresses at the root of a journal, Book (264), (265), with its grease bore.

    Parameters
    ----------
    force : array (...) [N]
        Q.
    diameter, bore : array (...) [m]
        d and d_0, 0 ≤ d_0 < d.
    arm : array (...) [m]
        From the middle of the bearing to the root; half the journal's length in the book.

    Notes
    -----
    σ = 32 Q e d/(π(d⁴ - d_0⁴)); the shear stress is 4Q/(π(d² - d_0²)) on the mean and at most 4/3 of it times
    (r² + r r_0 + r_0²)/(r² + r_0²).

    Examples
    --------
    >>> round(float(journal_stress(22500.0, diameter=0.022, arm=0.009, bore=0.005).bending) / 1e6, 3)
    194.23
    """
    force, diameter, arm, bore = floats(force, diameter, arm, bore)
    xp = namespace(force)
    bending = 32.0 * force * arm * diameter / (math.pi * (diameter**4 - bore**4))
    mean = 4.0 * force / (math.pi * (diameter**2 - bore**2))
    shape = (diameter**2 + diameter * bore + bore**2) / (diameter**2 + bore**2)
    return PartStress(
        bending=bending,
        shear=4.0 / 3.0 * mean * shape,
        mises=xp.maximum(bending, math.sqrt(3.0) * 4.0 / 3.0 * mean * shape),
        mean_shear=mean,
    )


# Strength of a straight-sided spline.


@dataclass(frozen=True, eq=False, kw_only=True)
class SplineStress:
    """Stresses of a straight-sided spline, arrays (...)."""

    # mean_diameter, height (...) [m]: (D + d)/2 and the height of the flanks that bear, (D - d)/2 - 2c
    mean_diameter: Array
    height: Array  # (...) [m]
    pressure: Array  # (...) [Pa]: on the flanks
    tooth_shear: Array  # (...) [Pa]: at the roots of the teeth
    core_shear: Array  # (...) [Pa]: torsion at the root diameter


def spline_stress(
    torque: ArrayLike,
    *,
    outer: ArrayLike,
    root: ArrayLike,
    teeth: ArrayLike,
    tooth_width: ArrayLike,
    length: ArrayLike,
    chamfer: ArrayLike = 0.0,
    load_share: ArrayLike = 0.75,
) -> SplineStress:
    """Return the stresses of a straight-sided spline D × d × z × b.

    Parameters
    ----------
    torque : array (...) [N·m]
    outer, root, tooth_width, length, chamfer : array (...) [m]
        D, d, b, l and c; where the flanks keep no height, (D - d)/2 ≤ 2c, the pressure is infinite.
    teeth : array (...)
        z.
    load_share : array (...)
        ψ, share of the teeth that carry.

    Notes
    -----
    F = 2T/(d_m z ψ) on each carrying tooth; pressure F/(h l), shear F/(b l), torsion of the core 16 T/(π d³).

    Examples
    --------
    >>> one = spline_stress(1000.0, outer=0.042, root=0.036, teeth=8, tooth_width=0.007, length=0.08, chamfer=0.0004)
    >>> round(float(one.pressure) / 1e6, 3)
    48.563
    """
    torque, outer, root, teeth, width, length, chamfer, share = floats(
        torque, outer, root, teeth, tooth_width, length, chamfer, load_share
    )
    middle = 0.5 * (outer + root)
    height = np.maximum(0.5 * (outer - root) - 2.0 * chamfer, 0.0)
    force = 2.0 * torque / (middle * teeth * share)
    with np.errstate(divide="ignore"):
        pressure = force / (height * length)
    return SplineStress(
        mean_diameter=middle,
        height=height,
        pressure=pressure,
        tooth_shear=force / (width * length),
        core_shear=16.0 * torque / (math.pi * root**3),
    )
