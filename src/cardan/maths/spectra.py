"""Stationary normal processes given by a one-sided power spectral density, drawn as a polygon.

The density S(Ω) is piecewise linear between the frequencies given and zero outside; the variance is ∫S dΩ.
"""

from __future__ import annotations

import math

import numpy as np

from .arrays import Array, ArrayLike
from .paths import Jet


def variance(frequency: ArrayLike, density: ArrayLike) -> float:
    """Return ∫S dΩ of a spectrum, exactly.

    Examples
    --------
    >>> variance([1.0, 3.0], [2.0, 2.0])
    4.0
    """
    return float(_accumulated(*_polygon(frequency, density))[-1])


def rate_variance(frequency: ArrayLike, density: ArrayLike) -> float:
    """Return ∫Ω² S dΩ, the variance of the rate of the process, exactly (Simpson, the integrand is cubic).

    Examples
    --------
    >>> rate_variance([0.0, 3.0], [1.0, 1.0])
    9.0
    """
    omega, s = _polygon(frequency, density)
    middle = 0.5 * (omega[1:] + omega[:-1])
    half = 0.5 * (s[1:] + s[:-1])
    curve = omega**2 * s
    return float(np.sum(np.diff(omega) * (curve[1:] + 4.0 * middle**2 * half + curve[:-1])) / 6.0)


def two_sided(frequency: ArrayLike, density: ArrayLike, at: ArrayLike) -> Array:
    """Return the two-sided density at frequencies of either sign: half the one-sided one at \\|Ω\\|.

    Examples
    --------
    >>> two_sided([1.0, 3.0], [2.0, 4.0], [-2.0, 0.0, 3.0])
    array([1.5, 0. , 2. ])
    """
    omega, s = _polygon(frequency, density)
    return 0.5 * np.interp(np.abs(np.asarray(at, dtype=float)), omega, s, left=0.0, right=0.0)


def enough_components(frequency: ArrayLike, duration: float) -> int:
    """Return how many cosines a sample path of a duration needs so that it does not repeat within twice that time."""
    omega = np.asarray(frequency, dtype=float)
    return max(256, math.ceil(float(omega[-1] - omega[0]) * duration / math.pi))


def sample_path(frequency: ArrayLike, density: ArrayLike, times: ArrayLike, *, seed: int, components: int = 256) -> Jet:
    """Return the jet of one sample path of zero mean, arrays (t,).

    Parameters
    ----------
    frequency : array (m,) [rad/s]
        Corners of the spectrum, strictly rising.
    density : array (m,) [unit²·s/rad]
        One-sided density there.
    times : array (t,) [s]
        Instants.
    seed : int
        The same seed gives the same path.
    components : int
        Number of cosines; the path repeats, up to signs, after 2π · components/(bandwidth).

    Notes
    -----
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
    middle = 0.5 * (edges[1:] + edges[:-1])
    at = np.asarray(times, dtype=float)
    value, rate, acceleration = np.zeros_like(at), np.zeros_like(at), np.zeros_like(at)
    for part in range(0, components, 256):
        w, size = middle[part : part + 256], amplitude[part : part + 256]
        argument = at[..., None] * w + phase[part : part + 256]
        cosine = np.cos(argument)
        value += cosine @ size
        rate -= np.sin(argument) @ (w * size)
        acceleration -= cosine @ (w**2 * size)
    return value, rate, acceleration


def _polygon(frequency: ArrayLike, density: ArrayLike) -> tuple[Array, Array]:
    return np.asarray(frequency, dtype=float), np.asarray(density, dtype=float)


def _accumulated(omega: Array, s: Array) -> Array:
    return np.concatenate(([0.0], np.cumsum(0.5 * (s[1:] + s[:-1]) * np.diff(omega))))
