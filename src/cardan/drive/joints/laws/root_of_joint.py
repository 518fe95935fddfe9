"""A unit vector that turns with the output of a Hooke joint: its Fourier sum over the input angle, in closed form.

The joint maps w = e^(2iθ) to w' = (w - τ)/(1 - τw); the vector is e^(iθ') = √w', a root of that map.
"""

from __future__ import annotations

import numpy as np
import scipy

from cardan.maths.arrays import Array, ArrayLike


def vector_orders(tau: ArrayLike, order: ArrayLike) -> Array:
    """Return the coefficients E_n of e^(iθ') = Σ E_n e^(inθ).

    tau (...): τ = tan²(α/2) in [0, 1).
    order (N,) of int: n; even ones are nought.
    Returns (..., N): real; θ counts from the plane of the shafts. Their squares add up to 1.
    e^(iθ') = e^(iθ) (1 - τ/w)^(1/2) (1 - τw)^(-1/2), the product of two binomial series; with n = 1 + 2p

    E_n = (1/2)_p/p! τ^p F(-1/2, p + 1/2; p + 1; τ²) for p ≥ 0,

    E_n = (-1/2)_q/q! τ^q F(q - 1/2, 1/2; q + 1; τ²) for q = -p > 0.
    """
    t = np.asarray(tau, dtype=float)
    found = np.zeros((*t.shape, len(np.atleast_1d(order))))
    for k, n in enumerate(np.atleast_1d(order)):
        p = (int(n) - 1) // 2
        if n % 2 == 0:
            continue
        if p >= 0:
            found[..., k] = _rising(0.5, p) * t**p * scipy.special.hyp2f1(-0.5, p + 0.5, p + 1.0, t * t)
        else:
            q = -p
            found[..., k] = _rising(-0.5, q) * t**q * scipy.special.hyp2f1(q - 0.5, 0.5, q + 1.0, t * t)
    return found


def _rising(start: float, count: int) -> float:
    """Return start (start + 1) … (start + count - 1)/count!."""
    steps = np.arange(count)
    return float(np.prod((start + steps) / (steps + 1.0)))
