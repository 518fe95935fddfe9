"""A spring with two stiffnesses that turns with the angle θ and gives way more or less with it.

Displacements are complex, z = x + iy. With the share f(θ) in [0, 1] the stiffness along the turning axis is
k(1 - fΔ_ξ), across it k(1 - fΔ_η); with s = ½(Δ_ξ + Δ_η) and d = ½(Δ_ξ - Δ_η) the force is k[z - f(s z + d e^(2iθ)
z̄)].
"""

from __future__ import annotations

import math
from typing import TypeAlias

import numpy as np
import scipy

from cardan.maths.arrays import Array

Losses: TypeAlias = tuple[float, float]
"""Δ_ξ, Δ_η."""

MOST = 1 << 15
"""Harmonics on either side at most."""

NOTHING = 1e-19
"""Cosines of the law f below this are left out."""

TAIL = 1e-15
"""The highest harmonics are small if they are this share of the largest."""


def pull(z: Array, unit: Array, share: Array, losses: Losses) -> Array:
    """Return the force of the spring over k.

    z (...), complex: displacement; a number does as well.
    unit (...), complex: e^(iθ); share (...): f(θ); losses: Δ_ξ, Δ_η.
    """
    mean, half = _halves(losses)
    return z - share * (mean * z + half * unit**2 * z.conjugate())


def energy_slope(z: Array, unit: Array, share: Array, slope: Array, losses: Losses) -> Array:
    """Return how the energy of the spring changes with its angle over k: ½ zᵀK'z/k, the moment that turns it.

    z (...), complex: displacement; a number does as well.
    unit (...), complex: e^(iθ); share, slope (...): f(θ) and f'(θ); losses: Δ_ξ, Δ_η.
    """
    mean, half = _halves(losses)
    cross = half * (unit * z.conjugate()) ** 2
    square = z.real**2 + z.imag**2
    return -0.5 * (slope * (mean * square + cross.real) - 2.0 * share * cross.imag)


def matrices(angle: Array, share: Array, losses: Losses) -> Array:
    """Return the stiffness matrices over k, array (..., 2, 2) of angles (...) and shares (...)."""
    mean, half = _halves(losses)
    even, swing = 1.0 - share * mean, share * half
    along, across = swing * np.cos(2.0 * angle), swing * np.sin(2.0 * angle)
    return np.stack([np.stack([even - along, -across], -1), np.stack([-across, even + along], -1)], -2)


def orbit(ratio: float, damping: float, humps: Array, losses: Losses, still: complex, turning: complex) -> Array:
    """Return the periodic motion of a mass on the spring, array (2H+1,) of Z_n, n = 1-H … 1+H, complex.

    ratio: η = Ω/ω, the rate at which the spring turns over √(k/m); damping: ζ.
    humps (m+1,): a_j of f = a_0 + Σ a_j cos jθ; losses: Δ_ξ, Δ_η.
    still, turning: forces over k: one that stands, and F of F e^(iθ).
    Returns: of z = Σ Z_n e^(inθ), as many that the last ones are nought; nan where there is no such motion.

    With V_n = conj Z_-n, W_n = V_n-2, D_n = 1 - (nη)² + 2iζnη and f = Σ f_j e^(ijθ)

    D_n Z_n - Σ f_j (s Z_n-j + d W_n-j) = F_n, D_n-2 W_n - Σ f_j (s W_n-j + d Z_n-j) = conj F_2-n:

    a matrix with 2m + 1 diagonals on either side, however many harmonics.
    """
    heard = humps[: int(np.flatnonzero(humps > NOTHING)[-1]) + 1]
    reach = math.ceil(1.5 / ratio) + len(heard) + 8
    while True:
        found = _solved(reach, ratio, damping, heard, losses, (still, turning))
        size = np.abs(found)
        edge = max(1, reach // 8)
        last = max(float(np.max(size[:edge])), float(np.max(size[-edge:])))
        if not last > TAIL * float(np.max(size)) or 2 * reach > MOST:
            return found
        reach += reach // 2


def _solved(
    reach: int, ratio: float, damping: float, humps: Array, losses: Losses, forces: tuple[complex, complex]
) -> Array:
    (mean, half), order = _halves(losses), np.arange(1 - reach, 2 + reach)
    count, band = order.size, 2 * len(humps) - 1
    rows = np.zeros((2 * band + 1, 2 * count), dtype=complex)
    for j in range(1 - len(humps), len(humps)):
        share = humps[abs(j)] * (1.0 if j == 0 else 0.5)
        # Element (i, k) stands at row band + i - k of column k; Z_n at 2n, W_n at 2n + 1.
        rows[band + 2 * j, :] -= share * mean
        rows[band + 2 * j - 1, 1::2] -= share * half
        rows[band + 2 * j + 1, 0::2] -= share * half
    for part, of in ((0, order), (1, order - 2)):
        rows[band, part::2] += 1.0 - (of * ratio) ** 2 + 2j * damping * ratio * of
    right = np.zeros(2 * count, dtype=complex)
    middle = reach - 1  # place of order 0
    right[2 * middle], right[2 * middle + 2] = forces
    right[2 * (middle + 2) + 1], right[2 * (middle + 1) + 1] = np.conj(forces)
    try:
        return np.asarray(scipy.linalg.solve_banded((band, band), rows, right, check_finite=False))[::2]
    except scipy.linalg.LinAlgError:
        return np.full(count, complex(np.nan, np.nan))


def _halves(losses: Losses) -> Losses:
    return 0.5 * (losses[0] + losses[1]), 0.5 * (losses[0] - losses[1])


# Even powers of the cosine of half an angle: a hump at 0 that is nought opposite, and its Fourier sum.


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
