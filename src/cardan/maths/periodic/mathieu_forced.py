"""Steady solution of Mathieu's equation under harmonic forcing, by harmonic balance."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from cardan.errors import Problem, check
from cardan.maths.arrays import Array, ArrayLike
from cardan.texts import _

from .mathieu import check_range

TERMS = 15
"""Side bands on either side of a forcing order, beyond those that reach past nought and past √a."""

NOUGHT = 1e-200
"""Stiffness of a band that would be without any: its neighbour then rests, and the band answers in its stead."""

SAME = 1e-9
"""Orders nearer to one another than this are one."""

UNBOUNDED = 1e11
"""A response so many times the largest amplitude over the least stiffness is taken for a resonance."""


@dataclass(frozen=True, eq=False, kw_only=True)
class ForcedSolution:
    """A steady solution y = Im Σ C_ω e^(iωz)."""

    order: Array  # (k,): ω ≥ 0, rising
    coefficient: Array  # (..., k), complex: C_ω; purely imaginary where ω = 0

    @property
    def amplitude(self) -> Array:
        """Amplitude of each order, array (..., k)."""
        return np.abs(self.coefficient)

    @property
    def phase(self) -> Array:
        """Phase δ of each A sin(ωz + δ), array (..., k) [rad]."""
        return np.angle(self.coefficient)

    @property
    def mean(self) -> Array:
        """Mean of y, array (...)."""
        there = self.order < SAME
        return np.sum(np.where(there, self.coefficient.imag, 0.0), axis=-1)

    def at(self, z: ArrayLike) -> Array:
        """Return y at places (p,) [rad], array (..., p)."""
        wave = np.exp(1j * self.order[:, None] * np.asarray(z, dtype=float))
        return np.asarray((self.coefficient[..., None, :] @ wave)[..., 0, :].imag)


def forced(
    a: ArrayLike,
    q: ArrayLike,
    n: ArrayLike = 0.0,
    *,
    order: ArrayLike,
    amplitude: ArrayLike,
    phase: ArrayLike = 0.0,
) -> ForcedSolution:
    """Return the steady solution of y'' + 2n y' + (a - 2q cos 2z) y = Σ Q sin(νz + δ).

    a, q, n (...): of one equation or many.
    order (m,): ν ≥ 0 of each forcing term; 0 is a constant Q sin δ.
    amplitude, phase (m,): Q, and δ [rad].
    Returns ForcedSolution: of all orders ν ± 2r.
    For each ν, (a - ω² + 2inω) Y_ω - q (Y_(ω+2) + Y_(ω-2)) = Q e^(iδ) where ω = ν, else 0, with ω = ν + 2r. Book
    (200)-(204) finds the same by variation of parameters.
    """
    a, q, n = np.broadcast_arrays(*(np.asarray(value, dtype=float) for value in (a, q, n)))
    check_range(a, q, n, np)
    order = np.atleast_1d(np.asarray(order, dtype=float))
    force = np.broadcast_to(np.asarray(amplitude) * np.exp(1j * np.asarray(phase, dtype=float)), order.shape)
    text = _("{value} is not a finite number of at least 0")
    check(
        Problem(f"order[{i}]", text.format(value=value))
        for i, value in enumerate(order)
        if not (math.isfinite(value) and value >= 0.0)
    )
    wide = math.sqrt(max(float(np.max(np.abs(a) + 2.0 * np.abs(q), initial=0.0)), 0.0))
    found: list[tuple[float, Array]] = []
    for i, nu in enumerate(order):
        reach = TERMS + math.ceil(0.5 * (nu + wide))
        omega = nu + 2.0 * np.arange(-reach, reach + 1)
        y = _bands(a, q, n, omega, reach)
        if not np.all(np.abs(y) < UNBOUNDED / max(1.0, wide) ** 2):
            text = _("order {order:g} is in resonance: without damping nothing bounds the vibration")
            check([Problem(f"order[{i}]", text.format(order=nu))])
        for k, w in enumerate(omega):
            part = force[i] * y[..., k]
            found.append((w, part) if w >= 0.0 else (-w, -np.conj(part)))
    found.sort(key=lambda row: row[0])
    orders: list[float] = []
    sums: list[Array] = []
    for w, part in found:
        if orders and w - orders[-1] < SAME:
            sums[-1] = sums[-1] + part
        else:
            orders.append(w)
            sums.append(part)
    coefficient = np.stack(sums, axis=-1) if sums else np.zeros((*a.shape, 0), dtype=complex)
    if orders and orders[0] < SAME:
        coefficient[..., 0] = 1j * coefficient[..., 0].imag
    return ForcedSolution(order=np.asarray(orders), coefficient=coefficient)


def _bands(a: Array, q: Array, n: Array, omega: Array, middle: int) -> Array:
    """Return the answer (..., k) of all bands to a unit force on the middle one, by sweeps from both ends.

    A band beyond the middle answers its inner neighbour by q over what is left of its stiffness.
    """
    direct = a[..., None] - omega**2 + (2j * n[..., None] * omega if np.any(n) else 0.0)
    share = np.zeros(direct.shape, dtype=direct.dtype)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        for k in (*range(middle), *range(omega.size - 1, middle, -1)):
            outer = k - 1 if k < middle else k + 1
            beyond = share[..., outer] if 0 <= outer < omega.size else 0.0
            left = direct[..., k] - q * beyond
            share[..., k] = q / np.where(left == 0.0, NOUGHT, left)
        y = np.empty(direct.shape, dtype=direct.dtype)
        y[..., middle] = 1.0 / (direct[..., middle] - q * (share[..., middle - 1] + share[..., middle + 1]))
        for k in range(middle - 1, -1, -1):
            y[..., k] = share[..., k] * y[..., k + 1]
        for k in range(middle + 1, omega.size):
            y[..., k] = share[..., k] * y[..., k - 1]
    return y
