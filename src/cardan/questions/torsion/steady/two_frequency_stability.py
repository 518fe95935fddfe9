"""Is steady running under two frequencies stable? Joints, and torques whose order does not repeat with them.

The equations linearised about that motion have coefficients of both phases. Over a period of the shaft a disturbance is
multiplied by a matrix that depends on the phase of the torques at its beginning; the mean growth over ever more periods
tells whether it dies out. It contains parametric resonance by these torques: with the slope of a torque over the angle
of its station at ν Ω = ω_i ± ω_j, and with the side bands |ν ± 2r|.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from cardan.maths.arrays import Array
from cardan.maths.periodic.floquet import Coefficients, across_directions, monodromy
from cardan.maths.periodic.skew_product import exponents, parts_of, tail, turning
from cardan.questions.torsion.model.torsional_balance import slopes
from cardan.questions.torsion.model.torsional_model import Torque
from cardan.questions.torsion.model.torsional_modes import base_order

from .orbit import Orbit, straight_frequencies
from .run_stability import (
    ASIDE,
    NEUTRAL,
    Floquet,
    Verdict,
    Zone,
    drifting,
    judged,
    liouville,
    replaced,
    unmoved,
)
from .two_frequencies import Moving, grouped, moving, others_of

FEW = 4
"""Points at most that are judged with both frequencies: each takes some tenths of a second."""

SAMPLES, MOST = 8, 256
"""Samples of the phase of the torques, doubled until its harmonics are small."""

SMALL = 1e-7
"""Largest of the upper quarter of these harmonics that is small, over the largest of all."""

FINER = (0, 1, 3)
"""Harmonics of both phases beyond those of the torques: what the motion makes of the growth is to settle."""

REACH = 2.0
"""Largest phase of the fastest oscillation in a step, with which these matrices err by 1e-7 of it."""

SURE, LEAST = 0.01, 1e-6
"""Error of the largest exponent, over itself and per period, with which it counts."""

APART = 1e-5
"""Difference of two exponents, per period, from which their disturbances do not swing about each other."""


@dataclass(frozen=True, eq=False, kw_only=True)
class _Growth:
    """Growth of disturbances of one motion."""

    exponents: Array  # (m,): ln of what disturbances are multiplied by over a period, the largest first
    removed: int
    error: float  # of the largest exponent
    residual: float
    matrices: Array  # (s, m, m): what they are made of, see `matrices_of`
    ratio: float

    @property
    def multipliers(self) -> Array:
        """Multipliers of a period with these moduli, array (m,), complex."""
        found: Array = np.exp(self.exponents) * _angles(self.matrices, self.ratio, self.exponents)
        return found


def with_torques(orbit: Orbit, known: Floquet, loose: tuple[Torque, ...]) -> tuple[Floquet, Array]:
    """Return what becomes of disturbances with torques that do not repeat, and where that is known, array (...).

    orbit (...), known (...): motions without these torques and their stability, which stays where their motion with
    them is not known: with play that opens, with dry friction or springs that bend, with torques of several orders that
    are no multiples of one, and at more points than `FEW`.
    """
    count, groups = orbit.count, list(grouped(loose))
    exact = np.zeros(count, dtype=bool)
    if len(groups) != 1 or orbit.model.special or count > FEW or not orbit.turning.coordinates:
        return known, exact.reshape(orbit.angle_error)
    ((base, group),) = groups
    states = known.verdict.reshape(-1)
    found = known
    for row in range(count):
        if states[row] == Verdict.UNKNOWN or row in orbit.pieces:
            continue
        growth = _settled(orbit, row, base, group)
        if growth is not None:
            exact[row], found = True, _put(found, orbit, row, growth)
    return found, exact.reshape(orbit.angle_error)


def _settled(orbit: Orbit, row: int, base: float, loose: tuple[Torque, ...]) -> _Growth | None:
    """Return the growth about the motion of one drive, its sum of so many harmonics that it no longer changes."""
    before: float | None = None
    samples = SAMPLES
    others = others_of(orbit, base, loose)[0]
    for finer in FINER:
        motion = moving(orbit, np.asarray([row]), base, loose, others, finer=finer)
        order = np.abs(motion.torus.order).ravel()[1:]
        if not motion.bands.found[0] or (orbit.model.free and np.any(order < LEAST)):  # nothing holds a part at rest
            return None
        found = _growth(orbit, row, motion, loose, samples)
        if found is None:
            return None
        first, samples = float(found.exponents[0]), len(found.matrices)
        if before is not None:
            error = found.error + abs(first - before)
            if error <= max(SURE * abs(first), LEAST):
                return replace(found, error=error)
        before = first
    return None


def coefficients_of(motion: Moving, theta: Array) -> Coefficients:
    """Return mass, damping and stiffness of the free coordinates of one drive over the share of a period of the shaft.

    theta (s,): phases of the torques at its beginning, each a drive of its own.
    """
    part, rows = motion.turning, np.zeros(len(theta), dtype=int)
    sense = float(np.sign(part.speed[0]))
    rate = float(part.frequency[0])

    def coefficients(share: Array) -> tuple[Array, Array, Array]:
        z = sense * 2.0 * np.pi * share
        x, v, a = (one[0] for one in motion.torus.along(z, theta))
        drives = motion.drives(rows, z, theta[:, None] + motion.ratio * z).of_disturbances
        by = slopes(drives, *part.motion(rows, z, x, rate * v, rate**2 * a))
        k = part.first
        return by.mass[..., k:], by.damping[..., k:, k:], by.stiffness[..., k:, k:]

    return coefficients


def matrices_of(motion: Moving, samples: int) -> tuple[Array, Array, Array]:
    """Return what disturbances of one drive are multiplied by in a period, array (s, m, m).

    At even phases of the torques at its beginning; of a free drive without the shift in time. With which coordinates
    are heavy, and the residuals (s,) by Liouville.
    """
    theta = 2.0 * np.pi * np.arange(samples) / samples
    part, sense = motion.turning, float(np.sign(motion.turning.speed[0]))
    coefficients = coefficients_of(motion, theta)
    duration = np.full(samples, part.period / abs(float(part.speed[0])))
    found = monodromy(coefficients, duration, reach=REACH)
    residual = liouville(coefficients, duration, found)
    heavy = np.any(coefficients(np.linspace(0.0, 1.0, 5))[0] != 0.0, axis=(0, 1))
    if part.model.free:
        begin, end = (_tangent(motion, one, heavy) for one in (theta, theta + sense * 2.0 * np.pi * motion.ratio))
        found = across_directions(found, begin, end)
    return found, heavy, residual


def _tangent(motion: Moving, theta: Array, heavy: Array) -> Array:
    """Return the disturbance by a shift in time at the beginning of a period, array (s, m)."""
    part = motion.turning
    rate = float(part.frequency[0])
    _x, v, a = (one[0, :, 0] for one in motion.torus.along(np.zeros(1), theta))
    found: Array = np.concatenate([part.speed[0] + rate * v, (rate**2 * a)[:, heavy]], axis=-1)
    return found


def _growth(orbit: Orbit, row: int, motion: Moving, loose: tuple[Torque, ...], samples: int) -> _Growth | None:
    """Return the growth about one motion, None where it is not known; from so many samples on."""
    while True:
        matrices, heavy, residuals = matrices_of(motion, samples)
        if not matrices.shape[-1]:
            return None
        if tail(parts_of(matrices[None]))[0] <= SMALL:
            break
        if samples >= MOST:
            return None
        samples *= 2
    part = motion.turning
    ratio = motion.ratio * float(np.sign(part.speed[0]))
    found = exponents(matrices[None], ratio)
    growth, error = found.growth[0], found.error[0]
    removed = int(part.model.free)
    if part.model.free and drifting(orbit.drives(np.asarray([row])), part.speed)[0]:
        drift = _drift(orbit, row, motion, loose, growth, error)
        if drift is None:
            return None
        growth, error = np.delete(growth, drift), np.delete(error, drift)
        removed += 1
    _mass, damping, _stiffness = coefficients_of(motion, np.zeros(1))(np.linspace(0.0, 1.0, 5))
    kept = len(growth) - int(unmoved(damping, heavy)[0])
    if kept < 1:
        return None
    return _Growth(
        exponents=growth[:kept],
        removed=removed,
        error=float(error[0]),
        matrices=matrices,
        ratio=ratio,
        residual=float(np.mean(residuals)),
    )


def _drift(
    orbit: Orbit, row: int, motion: Moving, loose: tuple[Torque, ...], growth: Array, error: Array
) -> int | None:
    """Return which exponent of a free drive is that of its drift to another speed; None where that is not told.

    As of periodic motions: where the torque that keeps the mean speed falls as that rises, the largest simple one above
    0, else the simple one next to 0 that is not above it.
    """
    gap = np.diff(growth, prepend=np.inf, append=-np.inf)
    alone = np.minimum(-gap[:-1], -gap[1:]) > APART + error
    above = growth > NEUTRAL + error
    if alone[0] and above[0]:
        forces = []
        for share in (1.0 - ASIDE, 1.0 + ASIDE):
            harmonics = motion.torus.coefficient.shape[-1] // 2
            near = moving(orbit, np.asarray([row]), motion.base, loose, harmonics, share=share)
            if not near.bands.found[0]:
                return None
            forces.append(float(near.torus.force[0]))
        if (forces[1] - forces[0]) * float(motion.turning.speed[0]) < 0.0:
            return 0
    fitting = np.flatnonzero(alone & ~above)
    return int(fitting[np.argmin(np.abs(growth[fitting]))]) if fitting.size else None


def _angles(matrices: Array, ratio: float, growth: Array) -> Array:
    """Return of what disturbances are multiplied by the part of modulus 1, array (m,).

    That of the shape nearest to one that does not swing with the torques; of several alike each has its own.
    """
    values, off = turning(matrices, ratio)
    with np.errstate(divide="ignore"):
        size = np.log(np.abs(values))
    left = np.ones(len(values), dtype=bool)
    found = np.ones(len(growth), dtype=complex)
    for k, rate in enumerate(growth):
        fitting = np.flatnonzero(left & (np.abs(size - rate) <= 1e-4 * max(1.0, abs(rate))))
        if fitting.size:
            best = fitting[np.argmin(off[fitting])]
            found[k], left[best] = values[best] / np.abs(values[best]), False
    return found


def _put(known: Floquet, orbit: Orbit, row: int, growth: _Growth) -> Floquet:
    """Return the same with the growth about one motion in its place."""
    frequencies = straight_frequencies(orbit.drives(np.asarray([row])))
    own = judged(
        growth.multipliers[None],
        np.asarray([growth.removed]),
        np.asarray([growth.residual]),
        frequencies[:, 1:] if orbit.model.free else frequencies,
        orbit.speed.reshape(-1)[[row]],
        orbit.period,
        np.ones(1, dtype=bool),
        neutral=max(NEUTRAL, growth.error),
        base=base_order(orbit.model),
    )

    if own.verdict[0] == Verdict.UNSTABLE and known.verdict.reshape(-1)[row] != Verdict.UNSTABLE:
        modes = np.maximum(known.zone.modes.reshape(-1, 2)[[row]], 1)
        one = np.ones(1, dtype=int)
        by = Zone(modes=modes, sign=one, multiple=0 * one, speed=np.abs(orbit.speed.reshape(-1)[[row]]))
        own = replace(own, zone=by)
    return replaced(known, np.asarray([row]), own, np.zeros(1, dtype=int))
