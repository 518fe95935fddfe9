"""Fourier sums: their values, their coefficients from samples, and their true extremes."""

from __future__ import annotations

import numpy as np

from cardan.maths.arrays import Array, ArrayLike

FINER = 8
"""Places on a period for each harmonic, before extremes are refined."""

ROUNDS = 4
"""Newton steps towards an extreme; from a sixteenth of the shortest wave they reach rounding."""


def series_at(coefficient: Array, phase: ArrayLike) -> tuple[Array, Array, Array]:
    """Return Re Σ c_k e^(ikz) and its first two derivatives by z.

    coefficient (..., R, H+1), complex, phase (p,) [rad].
    Returns three arrays (..., p, R).
    """
    order = np.arange(coefficient.shape[-1])
    wave = np.exp(1j * np.asarray(phase, dtype=float)[:, None] * order)
    factors = (wave, 1j * order * wave, -(order**2) * wave)
    value, rate, joint_angle = (
        np.matmul(factor.real, coefficient.real.swapaxes(-1, -2))
        - np.matmul(factor.imag, coefficient.imag.swapaxes(-1, -2))
        for factor in factors
    )
    return value, rate, joint_angle


def sampled_series(samples: Array) -> Array:
    """Return the coefficients c_k, k < p/2, of curves sampled evenly over a period, array (..., p/2) of (..., p)."""
    count = samples.shape[-1]
    found = np.fft.rfft(samples, axis=-1)[..., : (count + 1) // 2] * (2.0 / count)
    found[..., 0] *= 0.5
    return found


def extremes(coefficient: Array) -> tuple[Array, Array]:
    """Return the lowest and the highest value of Fourier sums, arrays (...), of coefficients (..., H+1)."""
    outer = coefficient.shape[:-1]
    flat = coefficient.reshape(-1, coefficient.shape[-1])
    size = np.abs(flat)
    if not size.size or not np.isfinite(size).all():
        size = np.where(np.isfinite(size), size, 0.0)
    heavy = np.flatnonzero(np.any(size > 1e-14 * np.max(size, initial=0.0), axis=0))
    flat = flat[:, : (heavy[-1] + 1 if heavy.size else 1)]
    order = np.arange(flat.shape[-1])
    count = FINER * max(len(order), 2)
    padded = np.zeros((len(flat), count // 2 + 1), dtype=complex)
    padded[:, : len(order)] = 0.5 * count * flat
    padded[:, 0] *= 2.0
    values = np.fft.irfft(padded, n=count, axis=-1)
    ends = []
    for side in (-1.0, 1.0):
        best = np.argmax(side * values, axis=-1)
        place = 2.0 * np.pi * best / count
        level = values[np.arange(len(flat)), best]
        for _round in range(ROUNDS):
            wave = flat * np.exp(1j * place[:, None] * order)
            slope, joint_angle = -np.sum(order * wave.imag, axis=-1), -np.sum(order**2 * wave.real, axis=-1)
            safe = np.where(side * joint_angle < 0.0, joint_angle, -side)
            step = np.where(side * joint_angle < 0.0, -slope / safe, 0.0)
            place = place + np.clip(step, -2.0 * np.pi / count, 2.0 * np.pi / count)
        refined = np.sum((flat * np.exp(1j * place[:, None] * order)).real, axis=-1)
        ends.append(side * np.maximum(side * refined, side * level))
    return ends[0].reshape(outer), ends[1].reshape(outer)
