"""Even powers of the cosine of half an angle: a hump at 0 that is nought opposite, and its Fourier sum."""

from __future__ import annotations

import numpy as np

from cardan.maths.arrays import Array


def hump_coefficients(power: int) -> Array:
    """Return a_0 … a_m of cos^(2m)(θ/2) = a_0 + Σ a_j cos jθ.

    power: m, at least 0.
    Returns (m+1,).
    a_0 = C(2m, m)/4^m and a_j = 2 C(2m, m-j)/4^m, from one to the next by their ratios: no binomial leaves the range
    of numbers, whatever m.
    """
    order = np.arange(1, power + 1)
    mean = np.prod((2.0 * order - 1.0) / (2.0 * order))
    return np.concatenate(([1.0], 2.0 * np.cumprod((power - order + 1.0) / (power + order)))) * mean


def hump(unit: Array, power: int) -> tuple[Array, Array]:
    """Return cos^(2m)(θ/2) and its slope by θ [1/rad], arrays (...), or numbers of a number.

    unit (...), complex: e^(iθ); power: m, at least 0.
    ((1 + cos θ)/2)^m.
    """
    half = 0.5 * (1.0 + unit.real)
    if power == 0:
        return 0.0 * half + 1.0, 0.0 * half
    return half**power, -0.5 * power * unit.imag * half ** (power - 1)
