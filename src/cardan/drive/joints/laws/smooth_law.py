"""A law of motion known point by point: its derivatives by its harmonics."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from cardan.maths.arrays import Array

SAMPLES = 256
"""Places in a turn at which a law is looked at; a joint that turns has no harmonics of half that order."""

NOISE = 1e-15
"""Harmonics below this [rad] are rounding; their derivatives would grow with the order."""


def course(angle: Array, angle_error: Callable[[Array], Array]) -> tuple[Array, Array, Array]:
    """Return a smooth law of period 2π with two derivatives.

    angle (...) [rad]: θ; angle_error: T - θ at angles (p,).
    Returns angle_error, ratio, slope (...) [rad, 1, 1/rad]: T - θ, T' and T''; nan where the law has none.
    Trigonometric interpolation: its error falls faster than any power of the number of samples.

    >>> found = course(np.asarray(0.3), lambda x: 0.1 * np.sin(3.0 * x))
    >>> print([f"{float(one):.9f}" for one in found])
    ['0.078332691', '1.186482990', '-0.704994219']
    """
    theta = np.asarray(angle, dtype=float)
    samples = np.asarray(angle_error(np.arange(SAMPLES) * (2.0 * np.pi / SAMPLES)), dtype=float)
    if not np.all(np.isfinite(samples)):
        nothing = theta + np.nan
        return nothing, nothing, nothing
    wave = np.fft.rfft(samples) / SAMPLES
    wave[1:] *= 2.0
    orders = np.flatnonzero(np.abs(wave[: SAMPLES // 2]) > NOISE)
    turn = np.exp(1j * theta[..., None] * orders)
    parts = wave[orders]
    return (
        (turn @ parts).real,
        1.0 + (turn @ (1j * orders * parts)).real,
        (turn @ (-(orders**2) * parts)).real,
    )
