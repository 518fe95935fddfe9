"""Motions of oscillators that two frequencies drive whose ratio is no simple fraction.

Such a motion never repeats; it passes every pair of the two phases, so it is a Fourier sum in two angles. The balance
is formed at samples of both and brought back to harmonics; Newton's matrix is Hill's: harmonics of its slopes, by the
difference of two parts.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from cardan.maths.arrays import Array, ArrayLike

from .harmonics import Equation, Linearised, solve_blocks

ROUNDS = 15
"""Newton steps at most."""

SETTLED = 1e-9
"""Step, over the motion, after which the next one would be rounding."""

WILD = 1e3
"""Times the size of the forcing balance from which a motion counts as lost."""

FIRST, LONGEST, SHORTEST = 0.2, 0.5, 1e-4
"""Steps along a path of motions: the first, the longest, and the shortest after which it is given up; 1 is about as far
as the second frequency alone moves what is linear."""

ALONG, ENOUGH, QUICK = 80, 6, 3
"""Steps of a path at most, Newton steps of each, and how few of them let the next be longer."""

NEAR = 1e-3
"""Newton step, over the motion, after which a point counts as on the path."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Torus:
    """Motions x = Σ c_mn e^(i(m z + n θ)), z and θ two phases."""

    coefficient: Array  # (B, R, 2H+1, 2G+1), complex: c_mn, m and n in the order of `numpy.fft`
    ratio: float  # rate of θ over that of z
    force: Array  # (B,): constant force on the first coordinate that keeps a free motion at its frequency
    found: Array  # (B,) of bool

    @property
    def harmonics(self) -> tuple[int, int]:
        """H of z and G of θ."""
        return self.coefficient.shape[-2] // 2, self.coefficient.shape[-1] // 2

    @property
    def order(self) -> Array:
        """Frequency of every part over that of z, array (2H+1, 2G+1)."""
        m, n = (np.fft.fftfreq(count, 1.0 / count) for count in self.coefficient.shape[-2:])
        return m[:, None] + self.ratio * n

    def at(self, samples: tuple[int, int]) -> tuple[Array, Array, Array]:
        """Return x and its derivatives as z goes on, and θ with it, at samples of both, arrays (B, S T, R)."""
        return _sampled(self.coefficient, self.order, samples)

    def along(self, z: Array, theta: Array) -> tuple[Array, Array, Array]:
        """Return the same where θ is θ0 at z = 0 and goes on with z: z (p,), θ0 (s,); arrays (B, s, p, R)."""
        m, n = (np.fft.fftfreq(count, 1.0 / count) for count in self.coefficient.shape[-2:])
        waves, on = np.exp(1j * np.multiply.outer(z, m)), np.exp(1j * self.ratio * np.multiply.outer(z, n))
        begin = np.multiply.outer(n, theta)
        begin = np.concatenate([np.cos(begin), -np.sin(begin)])
        found = []
        for factor in (np.ones_like(self.order, dtype=complex), 1j * self.order, -(self.order**2)):
            parts = np.matmul(waves, self.coefficient * factor) * on  # (B, R, p, N)
            values = np.concatenate([parts.real, parts.imag], axis=-1) @ begin
            found.append(np.moveaxis(values, 1, -1).swapaxes(1, 2))
        return found[0], found[1], found[2]


def torus_phases(samples: tuple[int, int]) -> tuple[Array, Array]:
    """Return pairs of both phases at so many samples of each, arrays (S T,)."""
    z, theta = (2.0 * np.pi * np.arange(count) / count for count in samples)
    return np.repeat(z, len(theta)), np.tile(theta, len(z))


def samples_of(harmonics: tuple[int, int]) -> tuple[int, int]:
    """Return how many samples of each phase so many harmonics take."""
    first, second = (4 * count + 4 for count in harmonics)
    return first, second


def torus_balance(
    equation: Equation,
    frequency: ArrayLike,
    coordinates: int,
    *,
    ratio: float,
    harmonics: tuple[int, int],
    free: bool = False,
    start: Array | None = None,
    near: Array | None = None,
    alone: Equation | None = None,
    rows: Array | None = None,
) -> Torus:
    """Return motions under two frequencies.

    equation: asked at the phases z of `torus_phases` of `samples_of` the harmonics; it knows which θ belongs to each.
    frequency (B,) [rad/s]: rate of z; ratio: that of θ over it; harmonics: H of z and G of θ.
    free: whether a motion may be shifted in time, as of `harmonic_balance`.
    start (B, R, h+1), complex: motions Re Σ c_k e^(ikz) to begin with.
    near (B, R, 2h+1, 2g+1), complex: parts of both to begin with instead; nan where there are none.
    alone: the equation without the second frequency, in whose size both are linear. Where Newton's steps do not settle,
    motions are then followed from those without it as it grows, by the length of their path, which may turn back where
    a resonance bends over: H. B. Keller, in Applications of Bifurcation Theory (1977).
    rows (b,) of int: which motions are sought; all by default.
    """
    omega = np.atleast_1d(np.asarray(frequency, dtype=float))
    high, other = harmonics
    shape, samples = (2 * high + 1, 2 * other + 1), samples_of(harmonics)
    count = len(omega)
    whole = (count, coordinates, *shape)
    begin = np.zeros(whole, dtype=complex) if start is None else _known(start, whole)
    known = begin.copy()
    if near is not None:
        taken = np.isfinite(near).all(axis=(1, 2, 3))
        known[taken] = _resized(near[taken], shape)
    found = Torus(coefficient=known, ratio=ratio, force=np.zeros(count), found=np.zeros(count, dtype=bool))
    system = _System(equation, omega, found.order, samples, harmonics, free)
    sought = np.arange(count) if rows is None else rows
    _settle(system, found, sought)
    lost = sought[~found.found[sought]]
    if alone is not None and lost.size:
        own = replace(system, equation=alone)
        begun = replace(found, coefficient=begin, force=np.zeros(count), found=np.zeros(count, dtype=bool))
        _settle(own, begun, lost)
        lost = lost[begun.found[lost]]
        ahead, force, there = _Path(own, system, lost).followed(begun.coefficient[lost], begun.force[lost])
        known[lost[there]], found.force[lost[there]] = ahead[there], force[there]
        _settle(system, found, lost[there])
    return found


@dataclass(frozen=True, eq=False)
class _System:
    """Equations for the parts of motions."""

    equation: Equation
    omega: Array
    order: Array
    samples: tuple[int, int]
    harmonics: tuple[int, int]
    free: bool

    def balance(self, rows: Array, coefficient: Array, force: Array) -> tuple[Linearised, Array]:
        """Return the balance of motions at the samples, and its parts (b, R, K)."""
        x, v, a = _sampled(coefficient, self.order, self.samples)
        rate = self.omega[rows, None, None]
        here = self.equation(rows, torus_phases(self.samples)[0], x, rate * v, rate**2 * a)
        left = _parts(here.balance.swapaxes(-1, -2), self.samples, self.harmonics)
        left[:, 0, 0] -= force
        return here, left

    def solved(self, here: Linearised, rows: Array, *lefts: Array) -> list[tuple[Array, Array]]:
        """Return the steps of the parts (b, R, K) and of the forces (b,) that undo balances to first order."""
        return _steps(here, lefts, self.omega[rows], self.order, self.samples, self.harmonics, free=self.free)


def _known(start: Array, shape: tuple[int, ...]) -> Array:
    """Return motions under the first frequency alone, Re Σ c_k e^(ikz), as parts of both, array (B, R, 2H+1, 2G+1)."""
    known = np.zeros(shape, dtype=complex)
    known[..., 0, 0] = start[..., 0].real
    for k in range(1, min(shape[-2] // 2, start.shape[-1] - 1) + 1):
        known[..., k, 0], known[..., -k, 0] = 0.5 * start[..., k], 0.5 * start[..., k].conj()
    return known


def _resized(parts: Array, shape: tuple[int, int]) -> Array:
    """Return parts of both with more or fewer harmonics, array (b, R, 2H+1, 2G+1)."""
    found = np.zeros((*parts.shape[:-2], *shape), dtype=complex)
    m, n = (np.arange(-(k := min(old, new) // 2), k + 1) for old, new in zip(parts.shape[-2:], shape, strict=True))
    found[..., m[:, None], n] = parts[..., m[:, None], n]
    return found


def _settle(system: _System, found: Torus, going: Array) -> None:
    """Bring some of the motions to balance where Newton's steps do, by their rows (b,) of int."""
    known, force = found.coefficient, found.force
    for _round in range(ROUNDS if going.size else 0):
        here, left = system.balance(going, known[going], force[going])
        ((step, pushed),) = system.solved(here, going, left)
        moved, size = (np.max(np.abs(one.reshape(len(going), -1)), axis=-1) for one in (step, known[going]))
        lost = ~np.isfinite(moved) | (moved > WILD)
        known[going[~lost]] -= step[~lost].reshape(-1, *known.shape[1:])
        force[going[~lost]] -= pushed[~lost]
        settled = ~lost & (moved <= SETTLED * size + 1e-13)
        found.found[going[settled]] = True
        going = going[~settled & ~lost]
        if not going.size:
            break


class _Path:
    """Motions of rows (b,) as the second frequency grows from nothing: parts, force and share of it, (b, n + 2)."""

    def __init__(self, alone: _System, whole: _System, rows: Array) -> None:
        self.alone, self.whole, self.rows = alone, whole, rows
        self.shape: tuple[int, ...] = ()
        self.weight = np.ones(len(rows))

    def followed(self, coefficient: Array, force: Array) -> tuple[Array, Array, Array]:
        """Return parts and forces near motions with the whole of it, from those without, and whether a path led there.

        coefficient (b, R, 2H+1, 2G+1); force (b,).
        """
        self.shape = coefficient.shape[1:]
        count = len(self.rows)
        state = np.concatenate([coefficient.reshape(count, -1), force[:, None], np.zeros((count, 1))], axis=-1)
        there, going = np.zeros(count, dtype=bool), np.arange(count)
        if not count:
            return coefficient, force, there
        slope = self._step(going, state)[1]
        self.weight = 1.0 / np.maximum(np.sum(np.abs(slope) ** 2, axis=-1), 1e-300)
        ahead, length = self._ahead(going, slope), np.full(count, FIRST)
        for _step in range(ALONG):
            point, slope, taken = self._corrected(
                going, state[going] + length[going, None] * ahead[going], ahead[going]
            )
            length[going[taken > ENOUGH]] *= 0.5
            good = taken <= ENOUGH
            some, point, slope, taken = going[good], point[good], slope[good], taken[good]
            past = point[:, -1].real >= 1.0
            share = (1.0 - state[some, -1].real) / np.where(past, point[:, -1].real - state[some, -1].real, 1.0)
            fresh = self._ahead(some, slope)
            onward = self._product(some, fresh, ahead[some]) >= 0.0
            state[some] = np.where(past[:, None], state[some] + share[:, None] * (point - state[some]), point)
            ahead[some] = np.where(onward[:, None], fresh, -fresh)
            length[some] = np.where(taken <= QUICK, np.minimum(LONGEST, 1.5 * length[some]), length[some])
            there[some[past]] = True
            going = going[~there[going] & (length[going] >= SHORTEST)]
            if not going.size:
                break
        return state[:, :-2].reshape(coefficient.shape), state[:, -2].real, there

    def _step(self, which: Array, state: Array) -> tuple[Array, Array]:
        """Return what is off the balance and how that grows with the share, as the steps (b, n + 1) that undo both."""
        rows, share = self.rows[which], state[:, -1].real
        parts, force = state[:, :-2].reshape(-1, *self.shape), state[:, -2].real
        (here, left), (other, far) = (one.balance(rows, parts, force) for one in (self.alone, self.whole))
        off = left + share[:, None, None] * (far - left)
        steps = self.whole.solved(_mixed(here, other, share), rows, off, far - left)
        step, slope = (
            np.concatenate([moved.reshape(len(rows), -1), pushed[:, None]], axis=-1) for moved, pushed in steps
        )
        return step, slope

    def _corrected(self, which: Array, point: Array, ahead: Array) -> tuple[Array, Array, Array]:
        """Return points brought to their paths square to a direction, the slopes there, and the Newton steps it took.

        These are more than `ENOUGH` where a path is not reached.
        """
        point, slopes = point.copy(), np.zeros_like(point[:, :-1])
        taken, going = np.full(len(which), ENOUGH + 1), np.arange(len(which))
        for count in range(1, ENOUGH + 1):
            step, slope = self._step(which[going], point[going])
            weight, lean = self.weight[which[going]], ahead[going]
            share = weight * np.sum(lean[:, :-1].conj() * step, axis=-1).real
            share = share / (lean[:, -1].real - weight * np.sum(lean[:, :-1].conj() * slope, axis=-1).real)
            point[going] -= np.concatenate([step + slope * share[:, None], -share[:, None]], axis=-1)
            slopes[going] = slope
            moved, size = (np.max(np.abs(one), axis=-1) for one in (step, point[going, :-2]))
            taken[going[moved <= NEAR * size]] = count
            going = going[(moved > NEAR * size) & (moved <= WILD)]
            if not going.size:
                break
        return point, slopes, taken

    def _ahead(self, which: Array, slope: Array) -> Array:
        """Return the directions of paths, of length 1, array (b, n + 2)."""
        found = np.concatenate([-slope, np.ones((len(slope), 1))], axis=-1)
        return found / np.sqrt(self._product(which, found, found))[:, None]

    def _product(self, which: Array, one: Array, other: Array) -> Array:
        both = one.conj() * other
        found: Array = (self.weight[which] * np.sum(both[:, :-1], axis=-1) + both[:, -1]).real
        return found


def _mixed(one: Linearised, other: Linearised, share: Array) -> Linearised:
    """Return what is a share (b,) of the way from one balance to another."""
    found = {}
    for name in ("balance", "mass", "damping", "stiffness"):
        begin, end = getattr(one, name), getattr(other, name)
        found[name] = begin + share.reshape(-1, *[1] * (begin.ndim - 1)) * (end - begin)
    return Linearised(**found)


def _sampled(coefficient: Array, order: Array, samples: tuple[int, int]) -> tuple[Array, Array, Array]:
    m, n = (np.fft.fftfreq(count, 1.0 / count).astype(int) for count in order.shape)
    found = []
    for factor in (np.ones_like(order, dtype=complex), 1j * order, -(order**2)):
        wide = np.zeros((*coefficient.shape[:2], *samples), dtype=complex)
        wide[:, :, m[:, None], n] = coefficient * factor
        values = np.fft.ifft2(wide).real * (samples[0] * samples[1])
        found.append(values.reshape(*coefficient.shape[:2], -1).swapaxes(-1, -2))
    return found[0], found[1], found[2]


def _parts(values: Array, samples: tuple[int, int], harmonics: tuple[int, int]) -> Array:
    """Return the parts of values (..., S T) that the sum has, array (..., K), complex."""
    waves = np.fft.fft2(values.reshape(*values.shape[:-1], *samples)) / (samples[0] * samples[1])
    m, n = (np.fft.fftfreq(2 * count + 1, 1.0 / (2 * count + 1)).astype(int) for count in harmonics)
    kept: Array = waves[..., m[:, None], n]
    return kept.reshape(*values.shape[:-1], -1)


def _steps(
    here: Linearised,
    lefts: Sequence[Array],
    omega: Array,
    order: Array,
    samples: tuple[int, int],
    harmonics: tuple[int, int],
    *,
    free: bool,
) -> list[tuple[Array, Array]]:
    """Return Newton's steps (b, R, K) and those of the forces (b,) for balances.

    A motion is real, so that the parts of one half of the pairs (m, n) give the others: their real and imaginary parts
    are the unknowns.
    """
    m, n = (one.reshape(-1) for one in np.meshgrid(*(np.fft.fftfreq(c, 1.0 / c) for c in order.shape), indexing="ij"))
    half = np.flatnonzero((n > 0.0) | ((n == 0.0) & (m >= 0.0)))  # (0, 0) comes first
    away = ((m[half, None] - m[half]).astype(int), (n[half, None] - n[half]).astype(int))
    over = ((m[half, None] + m[half]).astype(int), (n[half, None] + n[half]).astype(int))
    turning = omega[:, None] * order.reshape(-1)[half]
    coupled = np.any((here.damping != 0.0) | (here.stiffness != 0.0), axis=(0, 1))

    def waves(values: Array) -> Array:
        found: Array = np.fft.fft2(values.reshape(-1, *samples)) / (samples[0] * samples[1])
        return found

    def spread(parts: list[Array], by: tuple[Array, Array], rate: Array) -> Array:
        chosen = [np.ascontiguousarray(one[:, by[0], by[1]]) for one in parts]  # else speeds would lie innermost
        found = chosen[0] + chosen[1] * (1j * rate[:, None])
        return found if len(parts) == 2 else found - chosen[2] * rate[:, None] ** 2

    blocks: dict[tuple[int, int], Array] = {}
    for r, s in np.argwhere(coupled | np.eye(len(coupled), dtype=bool)).tolist():
        parts = [waves(one[:, :, r, s]) for one in (here.stiffness, here.damping)]
        parts += [waves(here.mass[:, :, r])] if r == s else []
        blocks[r, s] = _real(spread(parts, away, turning), spread(parts, over, -turning))
    if free:
        for (_r, s), block in blocks.items():
            if s == 0:
                block[..., :, 0] = 0.0
        blocks[0, 0][..., 0, 0] = -1.0
    found = []
    minus = {place: k for k, place in enumerate(zip(m.tolist(), n.tolist(), strict=True))}
    other = [minus[-a, -b] for a, b in zip(m[half].tolist(), n[half].tolist(), strict=True)]
    for left in lefts:
        own = left[..., half]
        solved = solve_blocks(blocks, np.concatenate([own.real, own.imag[..., 1:]], axis=-1))
        step = np.zeros_like(left)
        waved = solved[..., : len(half)] + 1j * np.pad(solved[..., len(half) :], ((0, 0), (0, 0), (1, 0)))
        step[..., other] = waved.conj()
        step[..., half] = waved
        pushed = step[:, 0, 0].real.copy() if free else np.zeros(len(step))
        if free:
            step[:, 0, 0] = 0.0
        found.append((step, pushed))
    return found


def _real(away: Array, over: Array) -> Array:
    """Return by how much real and imaginary parts of balances follow those of motions, array (b, 2h-1, 2h-1).

    away, over (b, h, h): what the parts of one half do to these, and those of the other, which are their conjugates.
    """
    over = over.copy()
    over[..., 0] = 0.0  # the mean is its own conjugate
    top = np.concatenate([(away + over).real, (over - away).imag[..., 1:]], axis=-1)
    low = np.concatenate([(away + over).imag[:, 1:], (away - over).real[:, 1:, 1:]], axis=-1)
    return np.concatenate([top, low], axis=-2)
