"""Strength of a straight-sided spline."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from cardan.maths.arrays import Array, ArrayLike, floats


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
