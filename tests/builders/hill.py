"""Multipliers of linear oscillators by Hill's matrix, without integration: another way to what `monodromy` says."""

from __future__ import annotations

import numpy as np

from cardan.maths.arrays import Array
from cardan.maths.periodic.floquet import Coefficients


def hill_multipliers(coefficients: Coefficients, duration: float, *, harmonics: int = 12) -> Array:
    """Return the multipliers of one oscillator by Hill's matrix, without integration, array (2R,), largest first.

    Parameters
    ----------
    coefficients : callable
        `Coefficients` of a single oscillator, every coordinate with mass.
    duration : float [s]
        T.
    harmonics : int
        Harmonics of the disturbance on either side.

    Notes
    -----
    x = e^(λt) Σ p_k e^(ikωt), ω = 2π/T, makes a quadratic eigenvalue problem in λ; of the eigenvalues that differ by
    iω those in one strip of that height, amid the harmonics, are kept; ρ = e^(λT).

    Examples
    --------
    >>> def spring(share):
    ...     one = np.ones((1, share.size, 1))
    ...     return 4.0 * one, 0.4 * one[..., None], 36.0 * one[..., None]
    >>> print(np.abs(hill_multipliers(spring, 0.5)), np.exp(-0.05 * 0.5))
    [0.97530991 0.97530991] 0.97530991
    """
    from scipy.linalg import eig

    samples = 4 * harmonics + 4
    omega = 2.0 * np.pi / duration
    mass, damping, stiffness = (
        np.fft.fft(one[0], axis=0) / samples for one in coefficients(np.arange(samples) / samples)
    )
    rank = mass.shape[-1]
    order = np.arange(-harmonics, harmonics + 1)
    away = (order[:, None] - order) % samples
    count = len(order) * rank

    def spread(parts: Array) -> Array:
        return parts[away].swapaxes(1, 2).reshape(count, count)

    inertia = spread(mass[..., None] * np.eye(rank))
    turn = np.diag(np.repeat(1j * omega * order, rank))
    damper = spread(damping)
    first = 2.0 * inertia @ turn + damper
    last = inertia @ turn @ turn + damper @ turn + spread(stiffness)
    one, nothing = np.eye(count), np.zeros((count, count))
    values = eig(
        np.block([[nothing, one], [-last, -first]]), np.block([[one, nothing], [nothing, inertia]]), right=False
    )
    strip = values[(values.imag > -0.6180339 * omega) & (values.imag <= 0.3819661 * omega)]
    found = np.exp(strip * duration)
    return found[np.argsort(-np.abs(found))][: 2 * rank]
