"""Motions of oscillators that two frequencies drive whose ratio is no simple fraction.

Such a motion never repeats; it passes every pair of the two phases, so it is a Fourier sum in two angles. The balance
is formed at samples of both and brought back to harmonics; Newton's matrix is Hill's: harmonics of its slopes, by the
difference of two parts.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.maths.arrays import Array, ArrayLike

from .harmonics import Equation, Linearised, solve_blocks

ROUNDS = 15
"""Newton steps at most."""

SETTLED = 1e-9
"""Step, over the motion, after which the next one would be rounding."""

WILD = 1e3
"""Times the size of the forcing balance from which a motion counts as lost."""


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
) -> Torus:
    """Return motions under two frequencies.

    equation: asked at the phases z of `torus_phases` of `samples_of` the harmonics; it knows which θ belongs to each.
    frequency (B,) [rad/s]: rate of z; ratio: that of θ over it; harmonics: H of z and G of θ.
    free: whether a motion may be shifted in time, as of `harmonic_balance`.
    start (B, R, h+1), complex: motions Re Σ c_k e^(ikz) to begin with.
    """
    omega = np.atleast_1d(np.asarray(frequency, dtype=float))
    high, other = harmonics
    shape, samples = (2 * high + 1, 2 * other + 1), samples_of(harmonics)
    count = len(omega)
    known = np.zeros((count, coordinates, *shape), dtype=complex)
    if start is not None:
        kept = min(high, start.shape[-1] - 1)
        known[..., 0, 0] = start[..., 0].real
        for k in range(1, kept + 1):
            known[..., k, 0], known[..., -k, 0] = 0.5 * start[..., k], 0.5 * start[..., k].conj()
    found = Torus(coefficient=known, ratio=ratio, force=np.zeros(count), found=np.zeros(count, dtype=bool))
    phase = torus_phases(samples)[0]
    force, good = found.force, found.found
    going = np.arange(count)
    for _round in range(ROUNDS):
        x, v, a = _sampled(known[going], found.order, samples)
        rate = omega[going, None, None]
        here = equation(going, phase, x, rate * v, rate**2 * a)
        left = _parts(here.balance.swapaxes(-1, -2), samples, harmonics)
        left[:, 0, 0] -= force[going]
        step, pushed = _steps(here, left, omega[going], found.order, samples, harmonics, free=free)
        moved, size = (np.max(np.abs(one.reshape(len(going), -1)), axis=-1) for one in (step, known[going]))
        lost = ~np.isfinite(moved) | (moved > WILD)
        known[going[~lost]] -= step[~lost].reshape(-1, coordinates, *shape)
        force[going[~lost]] -= pushed[~lost]
        settled = ~lost & (moved <= SETTLED * size + 1e-13)
        good[going[settled]] = True
        going = going[~settled & ~lost]
        if not going.size:
            break
    return found


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
