"""Stationary normal processes given by a one-sided power spectral density, drawn as a polygon.

The density S(Ω) is piecewise linear between the frequencies given and zero outside; the variance is ∫S dΩ.
"""

from __future__ import annotations

import math

import numpy as np

from cardan.maths.arrays import Array, ArrayLike

from .paths import Jet

BLOCK = 64
"""Cosines summed at once."""


def variance(frequency: ArrayLike, density: ArrayLike) -> float:
    """Return ∫S dΩ of a spectrum, exactly."""
    return float(_accumulated(*_polygon(frequency, density))[-1])


def rate_variance(frequency: ArrayLike, density: ArrayLike) -> float:
    """Return ∫Ω² S dΩ, the variance of the rate of the process, exactly (Simpson, the integrand is cubic)."""
    omega, s = _polygon(frequency, density)
    middle = 0.5 * (omega[1:] + omega[:-1])
    half = 0.5 * (s[1:] + s[:-1])
    curve = omega**2 * s
    return float(np.sum(np.diff(omega) * (curve[1:] + 4.0 * middle**2 * half + curve[:-1])) / 6.0)


def two_sided(frequency: ArrayLike, density: ArrayLike, at: ArrayLike) -> Array:
    """Return the two-sided density at frequencies of either sign: half the one-sided one at \\|Ω\\|."""
    omega, s = _polygon(frequency, density)
    return 0.5 * np.interp(np.abs(np.asarray(at, dtype=float)), omega, s, left=0.0, right=0.0)


def enough_components(frequency: ArrayLike, duration: float) -> int:
    """Return how many cosines a sample path of a duration needs so that it does not repeat within twice that time."""
    omega = np.asarray(frequency, dtype=float)
    return max(256, math.ceil(float(omega[-1] - omega[0]) * duration / math.pi))


def sample_path(frequency: ArrayLike, density: ArrayLike, times: ArrayLike, *, seed: int, components: int = 256) -> Jet:
    """Return the jet of one sample path of zero mean, arrays (t,).

    frequency (m,) [rad/s]: corners of the spectrum, strictly rising.
    density (m,) [unit²·s/rad]: one-sided density there; times (t,) [s]; seed: the same seed gives the same path.
    components: number of cosines; the path repeats, up to signs, after 2π · components/(bandwidth).
    x(t) = Σ √(2 S_k ΔΩ) cos(Ω_k t + χ_k), χ_k uniform, Ω_k the middles of equal bands; S_k ΔΩ is the exact variance in
    the band, so the mean square over a long time is exactly the variance. The derivatives are those of the same sum.
    """
    omega, s = _polygon(frequency, density)
    edges = np.linspace(omega[0], omega[-1], components + 1)
    inside = np.clip(np.searchsorted(omega, edges, side="right") - 1, 0, omega.size - 2)
    step = edges - omega[inside]
    slope = np.diff(s) / np.diff(omega)
    below = _accumulated(omega, s)[inside] + s[inside] * step + 0.5 * slope[inside] * step**2
    amplitude = np.sqrt(2.0 * np.maximum(np.diff(below), 0.0))
    phase = np.random.default_rng(seed).uniform(0.0, 2.0 * np.pi, components)
    at = np.asarray(times, dtype=float)
    width = edges[1] - edges[0]
    waves = amplitude * np.exp(1j * phase)
    slopes = 1j * (edges[:-1] + 0.5 * width)
    parts = np.stack((waves, slopes * waves, slopes**2 * waves))
    sums = [_cosines(parts, edges[0] + 0.5 * width, width, piece) for piece in _pieces(at.ravel())]
    value, rate, acceleration = np.concatenate(sums, axis=-1).reshape(3, *at.shape)
    return value, rate, acceleration


def _cosines(parts: Array, first: float, step: float, times: Array) -> Array:
    """Return Re Σ_k c_k e^{i(first + k step)t} of several rows of coefficients c (m, K); array (m, t).

    Equal steps let k = row · BLOCK + column split the sum into a matrix product, with far fewer sines than terms.
    """
    rows = -(-parts.shape[-1] // BLOCK)
    table = np.zeros((parts.shape[0], rows * BLOCK), dtype=complex)
    table[:, : parts.shape[-1]] = parts
    inner = np.exp(1j * np.outer(times, first + step * np.arange(BLOCK)))
    outer = np.exp(1j * np.outer(times, step * BLOCK * np.arange(rows)))
    blocks = inner @ table.reshape(-1, BLOCK).T
    result: Array = np.einsum("tmr,tr->mt", blocks.reshape(times.size, parts.shape[0], rows), outer).real
    return result


def _pieces(times: Array) -> list[Array]:
    """Return the times in pieces that keep the tables of `_cosines` small."""
    return np.array_split(times, max(1, -(-times.size // 2048)))


def _polygon(frequency: ArrayLike, density: ArrayLike) -> tuple[Array, Array]:
    return np.asarray(frequency, dtype=float), np.asarray(density, dtype=float)


def _accumulated(omega: Array, s: Array) -> Array:
    return np.concatenate(([0.0], np.cumsum(0.5 * (s[1:] + s[:-1]) * np.diff(omega))))
