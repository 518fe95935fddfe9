"""Periodic motions of driven oscillators by harmonic balance, many of them at once.

The balance of an oscillator is known at any moment from its coordinates x, their rates and accelerations; its slopes
are known too. The motion is sought as a Fourier sum; the balance is formed at samples of a period and brought back to
harmonics (alternating frequency and time), its slopes give Newton's matrix exactly.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import IntEnum
from typing import TypeAlias

import numpy as np

from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.curves.extremes import series_at


class Status(IntEnum):
    """What became of a periodic motion."""

    CONVERGED = 0
    COARSE = 1
    """Found, but its highest harmonics are not small: a motion with kinks, or too few harmonics."""
    NO_CONVERGENCE = 2
    CANCELLED = 3


@dataclass(frozen=True, eq=False, kw_only=True)
class Linearised:
    """Balance of oscillators at moments of their motion, and its slopes."""

    balance: Array  # (..., R): left minus right side
    mass: Array  # (..., R): slopes by the accelerations; each acts in its own balance only
    damping: Array  # damping, stiffness (..., R, R): slopes by the rates and by the coordinates
    stiffness: Array  # (..., R, R)


SMALL = 1e-6
"""A balance is nought if it is this small beside what the motion makes of its terms."""

Equation: TypeAlias = Callable[[Array, Array, Array, Array, Array], Linearised]
"""From rows (b,) of the batch, phases (S,) of the period [rad], and x, ẋ, ẍ there (b, S, R), to what the balance is."""


@dataclass(frozen=True, kw_only=True, slots=True)
class HarmonicBalance:
    """How to find periodic motions by harmonic balance.

    Attributes
    ----------
    harmonics : int
        Harmonics of the period to begin with.
    most : int
        Harmonics at most; they are doubled until the tail is small.
    tail : float
        Largest of the upper quarter of the harmonics that is small, over the largest of all.
    steps : int
        Newton steps at most.
    """

    harmonics: int = 8
    most: int = 64
    tail: float = 1e-9
    steps: int = 40


@dataclass(frozen=True, eq=False, kw_only=True)
class Waves:
    """Periodic motions x = Re Σ c_k e^(ikz), z the phase of the period."""

    coefficient: Array  # (B, R, H+1), complex: c_k
    force: Array  # (B,): constant force on the first coordinate that keeps a free motion at its frequency; 0 elsewhere
    status: Array  # (B,) of int: a `Status` each
    tail: Array  # (B,): largest of the upper quarter of the harmonics over the largest of all

    def at(self, phase: ArrayLike) -> tuple[Array, Array, Array]:
        """Return x and its first two derivatives by the phase, arrays (B, p, R), at phases (p,) [rad]."""
        return series_at(self.coefficient, phase)


def harmonic_balance(
    equation: Equation,
    frequency: ArrayLike,
    coordinates: int,
    *,
    free: bool = False,
    start: Array | None = None,
    method: HarmonicBalance | None = None,
) -> Waves:
    """Return periodic motions of oscillators.

    equation: an `Equation`; frequency (B,) [rad/s]: base frequencies: the rate of the phase z; coordinates: R.
    free: whether a motion may be shifted in time; then the mean of the first coordinate is held at 0 and the constant
    force on it is sought instead.
    start (B, R, h+1), complex: motions to begin with; none by default.
    Block of coordinates r, s of Newton's matrix: Γ⁺(ω² M_rs Γ'' + ω C_rs Γ' + K_rs Γ), Γ the harmonics at the samples,
    4H + 4 of them, Γ⁺ the way back.
    """
    how = method or HarmonicBalance()
    omega = np.atleast_1d(np.asarray(frequency, dtype=float))
    count, harmonics = omega.shape[0], how.harmonics
    found = np.zeros((count, coordinates, harmonics + 1), dtype=complex)
    if start is not None:
        harmonics = max(harmonics, start.shape[-1] - 1)
        found = _widened(start, harmonics)
    force = np.zeros(count)
    status = np.full(count, int(Status.NO_CONVERGENCE))
    tail = np.zeros(count)
    rows = np.arange(count)
    while coordinates and rows.size:
        inner, inner_force, good = _newton(equation, rows, omega[rows], found[rows], force[rows], free, how)
        small = _tails(inner)
        found[rows], force[rows], tail[rows] = inner, inner_force, small
        status[rows] = np.where(good, np.where(small <= how.tail, Status.CONVERGED, Status.COARSE), status[rows])
        rows = rows[good & (small > how.tail)]
        if 2 * harmonics > how.most:
            break
        if rows.size:
            harmonics *= 2
            found = _widened(found, harmonics)
    if not coordinates:
        status[:] = Status.CONVERGED
    return Waves(coefficient=found, force=force, status=status, tail=tail)


def _widened(coefficient: Array, harmonics: int) -> Array:
    """Return the coefficients of more harmonics, the new ones zero."""
    wide = np.zeros((*coefficient.shape[:-1], harmonics + 1), dtype=complex)
    wide[..., : coefficient.shape[-1]] = coefficient
    return wide


def _tails(coefficient: Array) -> Array:
    size = np.max(np.abs(coefficient), axis=-2)
    upper = size.shape[-1] - max(2, (size.shape[-1] - 1) // 4)
    whole = np.max(size, axis=-1)
    return np.max(size[..., upper:], axis=-1) / np.where(whole > 0.0, whole, 1.0)


def _bases(harmonics: int) -> tuple[Array, Array, Array]:
    """Return phases of the samples (S,), harmonics with their two derivatives (3, S, n), and the way back (n, S)."""
    samples = 4 * harmonics + 4
    phase = 2.0 * np.pi * np.arange(samples) / samples
    order = np.arange(1, harmonics + 1)
    cosine, sine = np.cos(phase[:, None] * order), np.sin(phase[:, None] * order)
    one, nothing = np.ones((samples, 1)), np.zeros((samples, 1))
    value = np.concatenate([one, cosine, sine], axis=-1)
    rate = np.concatenate([nothing, -order * sine, order * cosine], axis=-1)
    joint_angle = np.concatenate([nothing, -(order**2) * cosine, -(order**2) * sine], axis=-1)
    back = value.T * (2.0 / samples)
    back[0] *= 0.5
    return phase, np.stack([value, rate, joint_angle]), back


def _newton(
    equation: Equation, rows: Array, omega: Array, start: Array, force: Array, free: bool, how: HarmonicBalance
) -> tuple[Array, Array, Array]:
    """Return the motions, their forces, and whether each was found; Newton's method with halved steps."""
    phase, bases, back = _bases(start.shape[-1] - 1)
    known = np.concatenate([start.real, -start.imag[..., 1:]], axis=-1)
    known_force = force.copy()
    step, step_force = np.zeros_like(known), np.zeros_like(force)
    share = np.ones(len(rows))
    best, first = np.full(len(rows), np.inf), np.zeros(len(rows))
    good = np.zeros(len(rows), dtype=bool)
    going = np.arange(len(rows))
    for _round in range(how.steps):
        part = share[going, None, None]
        trial = known[going] + part * step[going]
        trial_force = force_now = known_force[going] + share[going] * step_force[going]
        rate = omega[going, None, None]
        x, v, a = (np.matmul(basis, trial.swapaxes(-1, -2)) for basis in bases)
        here = equation(rows[going], phase, x, rate * v, rate**2 * a)
        left = np.matmul(back, here.balance).swapaxes(-1, -2)
        left[:, 0, 0] -= force_now
        size = np.sqrt(np.sum(left**2, axis=(-1, -2)))
        better = np.isfinite(size) & (size <= best[going] * (1.0 - 1e-4 * share[going]))
        stuck = ~better & (share[going] < 2.0**-7)
        still = _settled(part * step[going], known[going]) & np.isfinite(best[going])
        first[going] = np.where(np.isinf(best[going]), size, first[going])
        reach = np.max(np.abs(here.stiffness), axis=(1, 2, 3)) * (np.max(np.abs(trial), axis=(1, 2)) + SMALL)
        settled = still & (size <= SMALL * (first[going] + reach))
        stuck |= still & ~settled
        share[going] = np.where(better, 1.0, 0.5 * share[going])
        best[going] = np.where(better, size, best[going])
        accepted = going[better]
        known[accepted], known_force[accepted] = trial[better], trial_force[better]
        good[going[settled]] = True
        go_on = better & ~settled
        if np.any(go_on):
            moved, pushed = _steps(here, left, bases, back, omega[going], go_on, free)
            step[going[go_on]], step_force[going[go_on]] = moved, pushed
            finite = np.isfinite(moved).all(axis=(-1, -2))
            stuck[np.flatnonzero(go_on)[~finite]] = True
        going = going[~settled & ~stuck]
        if not going.size:
            break
    harmonics = start.shape[-1] - 1
    found = known[..., : harmonics + 1].astype(complex)
    found[..., 1:] -= 1j * known[..., harmonics + 1 :]
    return found, known_force, good


def _settled(step: Array, known: Array) -> Array:
    """Tell whether steps are so small that the next one would be rounding."""
    size = np.max(np.abs(known), axis=(-1, -2))
    return np.max(np.abs(step), axis=(-1, -2)) <= 1e-9 * size + 1e-13


def _steps(
    here: Linearised, left: Array, bases: Array, back: Array, omega: Array, chosen: Array, free: bool
) -> tuple[Array, Array]:
    """Return Newton's steps of the chosen rows and of the forces."""
    blocks = _matrix(here, bases, back, omega, chosen)
    if free:
        for (_r, s), block in blocks.items():
            if s == 0:
                block[..., :, 0] = 0.0
        blocks[0, 0][..., 0, 0] = -1.0
    step = -solve_blocks(blocks, left[chosen])
    pushed = step[:, 0, 0].copy() if free else np.zeros(len(step))
    if free:
        step[:, 0, 0] = 0.0
    return step, pushed


def _matrix(here: Linearised, bases: Array, back: Array, omega: Array, chosen: Array) -> dict[tuple[int, int], Array]:
    """Return Newton's matrix of the chosen rows in blocks, as `solve_blocks` takes them."""
    rows = slice(None) if chosen.all() else chosen  # most often all of them, which need no copy
    rate = omega[rows, None, None]
    damping, stiffness, mass = here.damping[rows], here.stiffness[rows], here.mass[rows]
    coupled = np.any((damping != 0.0) | (stiffness != 0.0), axis=(0, 1))
    blocks: dict[tuple[int, int], Array] = {}
    inner, part = (np.empty((*stiffness.shape[:2], back.shape[0])) for _one in range(2))  # new ones cost as much
    for r, s in np.ndindex(coupled.shape):
        if not (coupled[r, s] or r == s):
            continue
        np.multiply(stiffness[:, :, r, s, None], bases[0], out=inner)
        inner += np.multiply(rate * damping[:, :, r, s, None], bases[1], out=part)
        if r == s:
            inner += np.multiply(rate**2 * mass[:, :, r, None], bases[2], out=part)
        blocks[r, s] = np.matmul(back, inner)
    return blocks


def odd_growth(equation: Equation, frequency: ArrayLike, coefficient: Array) -> Array:
    """Tell about which motions an odd number of disturbances grows without swinging, array of bool (B,).

    frequency (B,) [rad/s]: of either sign; coefficient (B, R, H+1), complex: motions that are not free.
    So is the middle one of three motions: real multipliers above 1 are odd in number where the determinant of Newton's
    matrix is negative, which for a line at rest is positive and passes through 0 with a multiplier through 1.
    """
    omega = np.atleast_1d(np.asarray(frequency, dtype=float))
    phase, bases, back = _bases(coefficient.shape[-1] - 1)
    known = np.concatenate([coefficient.real, -coefficient.imag[..., 1:]], axis=-1)
    x, v, a = (np.matmul(basis, known.swapaxes(-1, -2)) for basis in bases)
    rate = omega[:, None, None]
    here = equation(np.arange(len(omega)), phase, x, rate * v, rate**2 * a)
    blocks = _matrix(here, bases, back, omega, np.ones(len(omega), dtype=bool))
    found: Array = np.linalg.slogdet(_assembled(blocks, coefficient.shape[-2]))[0] < 0.0
    return found


def solve_blocks(blocks: dict[tuple[int, int], Array], right: Array) -> Array:
    """Return the solution of systems made of blocks, array (B, R, n) as ``right``; the shortest where one is singular.

    blocks, dict from (r, s) to arrays (B, n, n): what is left out is zero. Where only neighbours are coupled
    elimination goes block by block.
    right (B, R, n).
    """
    rank = right.shape[-2]
    try:
        if all(abs(r - s) <= 1 for r, s in blocks):
            return _chain(blocks, right)
        return np.linalg.solve(_assembled(blocks, rank), right.reshape(len(right), -1, 1)).reshape(right.shape)
    except np.linalg.LinAlgError:
        if len(right) == 1:
            whole = _assembled(blocks, rank)
            if not np.isfinite(whole).all():
                return np.full_like(right, np.nan)
            return np.linalg.lstsq(whole[0], right.reshape(-1))[0].reshape(right.shape)
        parts = [
            solve_blocks({key: block[k : k + 1] for key, block in blocks.items()}, right[k : k + 1])
            for k in range(len(right))
        ]
        return np.concatenate(parts)


def _assembled(blocks: dict[tuple[int, int], Array], rank: int) -> Array:
    """Return whole matrices, array (B, R n, R n)."""
    count, size = next(iter(blocks.values())).shape[:2]
    whole = np.zeros((count, rank * size, rank * size), dtype=next(iter(blocks.values())).dtype)
    for (r, s), block in blocks.items():
        whole[:, r * size : (r + 1) * size, s * size : (s + 1) * size] = block
    return whole


def _chain(blocks: dict[tuple[int, int], Array], right: Array) -> Array:
    """Return the solution where only neighbours are coupled."""
    rank = right.shape[-2]
    above: list[Array] = []
    inner: list[Array] = []
    for r in range(rank):
        pivot, rest = blocks[r, r], right[:, r, :, None]
        if r and (r, r - 1) in blocks:
            below = blocks[r, r - 1]
            rest = rest - np.matmul(below, inner[-1])
            if (r - 1, r) in blocks:
                pivot = pivot - np.matmul(below, above[-1])
        ahead = blocks.get((r, r + 1))
        both = rest if ahead is None else np.concatenate([rest, ahead], axis=-1)
        solved = np.linalg.solve(pivot, both)
        inner.append(solved[..., :1])
        above.append(solved[..., 1:])
    found = [inner[-1]]
    for r in range(rank - 2, -1, -1):
        step = inner[r] - np.matmul(above[r], found[-1]) if (r, r + 1) in blocks else inner[r]
        found.append(step)
    return np.stack([one[..., 0] for one in found[::-1]], axis=-2)
