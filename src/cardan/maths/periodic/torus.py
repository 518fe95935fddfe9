"""Motions of oscillators that two frequencies drive whose ratio is no simple fraction.

Such a motion never repeats; it passes every pair of the two phases, so it is a Fourier sum in two angles. The balance
is formed at samples of both and brought back to harmonics; Newton's matrix is Hill's: harmonics of its slopes, by the
difference of two parts.
"""

from __future__ import annotations

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
    alone: Equation | None = None,
) -> Torus:
    """Return motions under two frequencies.

    equation: asked at the phases z of `torus_phases` of `samples_of` the harmonics; it knows which θ belongs to each.
    frequency (B,) [rad/s]: rate of z; ratio: that of θ over it; harmonics: H of z and G of θ.
    free: whether a motion may be shifted in time, as of `harmonic_balance`.
    start (B, R, h+1), complex: motions Re Σ c_k e^(ikz) to begin with.
    alone: the equation without the second frequency, in whose size both are linear. Where Newton's steps do not settle,
    motions are then followed from those without it as it grows, by the length of their path, which may turn back where
    a resonance bends over: H. B. Keller, in Applications of Bifurcation Theory (1977).
    """
    omega = np.atleast_1d(np.asarray(frequency, dtype=float))
    high, other = harmonics
    shape, samples = (2 * high + 1, 2 * other + 1), samples_of(harmonics)
    count = len(omega)
    whole = (count, coordinates, *shape)
    known = np.zeros(whole, dtype=complex) if start is None else _known(start, whole)
    found = Torus(coefficient=known, ratio=ratio, force=np.zeros(count), found=np.zeros(count, dtype=bool))
    system = _System(equation, omega, found.order, samples, harmonics, free)
    _settle(system, found, np.arange(count))
    lost = np.flatnonzero(~found.found)
    if alone is not None and lost.size:
        own = replace(system, equation=alone)
        begun = Torus(
            coefficient=np.zeros(whole, dtype=complex) if start is None else _known(start, whole),
            ratio=ratio,
            force=np.zeros(count),
            found=np.zeros(count, dtype=bool),
        )
        _settle(own, begun, lost)
        for row in lost[begun.found[lost]].tolist():
            near = _Path(own, system, row).followed(begun.coefficient[row], begun.force[row])
            if near is not None:
                known[row], found.force[row] = near
                _settle(system, found, np.asarray([row]))
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

    def solved(self, here: Linearised, rows: Array, left: Array) -> tuple[Array, Array]:
        """Return the steps of the parts (b, R, K) and of the forces (b,) that undo a balance to first order."""
        return _steps(here, left, self.omega[rows], self.order, self.samples, self.harmonics, free=self.free)


def _known(start: Array, shape: tuple[int, ...]) -> Array:
    """Return motions under the first frequency alone, Re Σ c_k e^(ikz), as parts of both, array (B, R, 2H+1, 2G+1)."""
    known = np.zeros(shape, dtype=complex)
    known[..., 0, 0] = start[..., 0].real
    for k in range(1, min(shape[-2] // 2, start.shape[-1] - 1) + 1):
        known[..., k, 0], known[..., -k, 0] = 0.5 * start[..., k], 0.5 * start[..., k].conj()
    return known


def _settle(system: _System, found: Torus, going: Array) -> None:
    """Bring some of the motions to balance where Newton's steps do, by their rows (b,) of int."""
    known, force = found.coefficient, found.force
    for _round in range(ROUNDS):
        here, left = system.balance(going, known[going], force[going])
        step, pushed = system.solved(here, going, left)
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
    """Motions of one row between those without the second frequency and with it: parts, force and share (n + 2,)."""

    def __init__(self, alone: _System, whole: _System, row: int) -> None:
        self.alone, self.whole, self.rows = alone, whole, np.asarray([row])
        self.shape: tuple[int, ...] = ()
        self.weight = 1.0

    def followed(self, coefficient: Array, force: float) -> tuple[Array, float] | None:
        """Return parts and force near a motion with the whole of it, from one without; None where no path leads there.

        coefficient (R, 2H+1, 2G+1).
        """
        self.shape = coefficient.shape
        state = np.concatenate([coefficient.ravel(), [force, 0.0]])
        slope = self._step(state)[1]
        self.weight = 1.0 / max(float(np.vdot(slope, slope).real), 1e-300)
        ahead, length = self._ahead(slope), FIRST
        for _step in range(ALONG):
            point, slope, taken = self._corrected(state + length * ahead, ahead)
            if taken > ENOUGH:
                length *= 0.5
                if length < SHORTEST:
                    return None
                continue
            if point[-1].real >= 1.0:
                near = state + (1.0 - state[-1].real) / (point[-1].real - state[-1].real) * (point - state)
                return near[:-2].reshape(self.shape), float(near[-2].real)
            fresh = self._ahead(slope)
            state, ahead = point, fresh if self._product(fresh, ahead) >= 0.0 else -fresh
            length = min(LONGEST, 1.5 * length) if taken <= QUICK else length
        return None

    def _step(self, state: Array) -> tuple[Array, Array]:
        """Return what is off the balance and by how much that grows with the share, both as steps (n + 1,) undo it."""
        parts, force, share = state[:-2].reshape(1, *self.shape), state[-2:-1].real, float(state[-1].real)
        (here, left), (other, far) = (one.balance(self.rows, parts, force) for one in (self.alone, self.whole))
        mixed = _mixed(here, other, share)
        steps = (self.whole.solved(mixed, self.rows, one) for one in (left + share * (far - left), far - left))
        step, slope = (np.append(moved.ravel(), pushed) for moved, pushed in steps)
        return step, slope

    def _corrected(self, point: Array, ahead: Array) -> tuple[Array, Array, int]:
        """Return a point brought to the path square to its direction, the slope there, and the Newton steps it took.

        These are more than `ENOUGH` where it is not reached.
        """
        for taken in range(1, ENOUGH + 1):
            step, slope = self._step(point)
            along = self.weight * np.vdot(ahead[:-1], step).real
            share = along / (ahead[-1].real - self.weight * np.vdot(ahead[:-1], slope).real)
            point = point - np.append(step + slope * share, -share)
            moved = float(np.max(np.abs(step)))
            if not moved <= WILD:
                break
            if moved <= NEAR * float(np.max(np.abs(point[:-2]))):
                return point, slope, taken
        return point, slope, ENOUGH + 1

    def _ahead(self, slope: Array) -> Array:
        """Return the direction of the path, of length 1, array (n + 2,)."""
        found = np.append(-slope, 1.0)
        return found / np.sqrt(self._product(found, found))

    def _product(self, one: Array, other: Array) -> float:
        return float((self.weight * np.vdot(one[:-1], other[:-1]) + one[-1].conj() * other[-1]).real)


def _mixed(one: Linearised, other: Linearised, share: float) -> Linearised:
    """Return what is a share of the way from one balance to another."""
    pairs = {name: (getattr(one, name), getattr(other, name)) for name in ("balance", "mass", "damping", "stiffness")}
    return Linearised(**{name: begin + share * (end - begin) for name, (begin, end) in pairs.items()})


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
    left: Array,
    omega: Array,
    order: Array,
    samples: tuple[int, int],
    harmonics: tuple[int, int],
    *,
    free: bool,
) -> tuple[Array, Array]:
    """Return Newton's steps (b, R, K) and those of the forces (b,)."""
    m, n = (one.reshape(-1) for one in np.meshgrid(*(np.fft.fftfreq(c, 1.0 / c) for c in order.shape), indexing="ij"))
    by = ((m[:, None] - m).astype(int), (n[:, None] - n).astype(int))
    turning = omega[:, None] * order.reshape(-1)
    coupled = np.any((here.damping != 0.0) | (here.stiffness != 0.0), axis=(0, 1))

    def spread(values: Array) -> Array:
        waves = np.fft.fft2(values.reshape(-1, *samples)) / (samples[0] * samples[1])
        return np.ascontiguousarray(waves[:, by[0], by[1]])  # chosen so, speeds would lie innermost

    blocks: dict[tuple[int, int], Array] = {}
    for r, s in np.argwhere(coupled | np.eye(len(coupled), dtype=bool)).tolist():
        block = spread(here.stiffness[:, :, r, s]) + spread(here.damping[:, :, r, s]) * (1j * turning[:, None])
        if r == s:
            block = block - spread(here.mass[:, :, r]) * turning[:, None] ** 2
        blocks[r, s] = block
    if free:
        for (_r, s), block in blocks.items():
            if s == 0:
                block[..., :, 0] = 0.0
        blocks[0, 0][..., 0, 0] = -1.0
    step = solve_blocks(blocks, left)
    pushed = step[:, 0, 0].real.copy() if free else np.zeros(len(step))
    if free:
        step[:, 0, 0] = 0.0
    return step, pushed
