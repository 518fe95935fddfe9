"""Is steady running under two frequencies stable? Joints, and torques whose order does not repeat with them.

The equations linearised about that motion have coefficients of both phases. Over a period of the shaft a disturbance is
multiplied by a matrix that depends on the phase of the torques at its beginning; the mean growth over ever more periods
tells whether it dies out. It contains parametric resonance by these torques: with the slope of a torque over the angle
of its station at ν Ω = ω_i ± ω_j, and with the side bands |ν ± 2r|.
"""

from __future__ import annotations

from collections.abc import Iterator
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
    CLOSE,
    NEUTRAL,
    Floquet,
    Verdict,
    Zone,
    drifting,
    judged,
    liouville,
    replaced,
    slow_drift,
    unmoved,
)
from .steady import Progress
from .two_frequencies import Moving, grouped, moving, others_of

CHUNK = 32
"""Motions judged at once: they spread over as many phases of the torques."""

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

LOWEST = 3
"""Modes that torques which do not repeat may meet."""

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


def with_torques(
    orbit: Orbit, known: Floquet, loose: tuple[Torque, ...], *, progress: Progress | None = None
) -> tuple[Floquet, Array]:
    """Return what becomes of disturbances with torques that do not repeat, and where that is known, array (...).

    orbit (...), known (...): motions without these torques and their stability, which stays where their motion with
    them is not known: with play that opens, with dry friction or springs that bend, and with torques of several orders
    that are no multiples of one. A point takes some hundredths of a second.
    progress: told the share done; when it answers "stop", what was not done stays as without these torques.
    """
    rows = np.flatnonzero(known.verdict.reshape(-1) != Verdict.UNKNOWN)
    found: dict[int, _Growth] = {}
    for done, growths in _every(orbit, rows, loose):
        found |= growths
        if progress is not None and progress(done) == "stop":
            break
    return _put(known, orbit, found)


def growth_with_torques(orbit: Orbit, rows: Array, loose: tuple[Torque, ...]) -> Array:
    """Return by how much disturbances grow with torques that do not repeat, ln max|ρ| of a period, array (b,).

    rows (b,) of int: which motions, counted through the leading axes. Returns nan where it is not known.
    """
    found = {row: one for _done, growths in _every(orbit, rows, loose) for row, one in growths.items()}
    return np.asarray([float(found[row].exponents[0]) if row in found else np.nan for row in rows.tolist()])


def meetings(omega: Array, loose: tuple[Torque, ...]) -> Array:
    """Return the speeds at which torques that do not repeat, or their side bands, meet a mode twice or two as a sum.

    omega (..., m) [rad/s]: natural frequencies of straight lines; the lowest of them count. Returns array (..., n).
    """
    low = omega[..., :LOWEST]
    sums = (low[..., :, None] + low[..., None, :]).reshape(*omega.shape[:-1], -1)
    orders = np.asarray([base for base, _group in grouped(loose)])
    sides = np.abs(orders[:, None] + (0.0, -2.0, 2.0)).reshape(-1)
    return (sums[..., None] / sides).reshape(*omega.shape[:-1], -1)


def _every(orbit: Orbit, rows: Array, loose: tuple[Torque, ...]) -> Iterator[tuple[float, dict[int, _Growth]]]:
    """Yield which share of some motions is done, and the growth about those of them where it is known."""
    groups = list(grouped(loose))
    if len(groups) != 1 or orbit.model.special or not orbit.turning.coordinates:
        return
    ((base, group),) = groups
    rows = rows[~np.isin(rows, list(orbit.pieces))]
    speed = orbit.speed.reshape(-1)
    done = 0
    for sense in (speed[rows] > 0.0, speed[rows] < 0.0):
        alike = rows[sense][np.argsort(np.abs(speed[rows[sense]]), kind="stable")]
        for some in np.split(alike, range(CHUNK, len(alike), CHUNK)):
            done += len(some)
            if some.size:
                yield done / len(rows), _settled(orbit, some, base, group)


def _settled(orbit: Orbit, rows: Array, base: float, loose: tuple[Torque, ...]) -> dict[int, _Growth]:
    """Return the growth about motions by their rows, of sums of so many harmonics that it no longer changes.

    rows (b,) of int: of drives that turn the same way.
    """
    found: dict[int, _Growth] = {}
    before: dict[int, _Growth] = {}
    others = others_of(orbit, base, loose)[0]
    near: Array | None = None
    for finer in FINER:
        if not rows.size:
            break
        motion = moving(orbit, rows, base, loose, others, finer=finer, near=near)
        order = np.abs(motion.torus.order).ravel()[1:]
        if orbit.model.free and np.any(order < LEAST):  # nothing holds a part at rest
            break
        samples = min((len(one.matrices) for one in before.values()), default=SAMPLES)
        now = _growths(orbit, rows, motion, loose, samples)
        for row, one in now.items():
            if row in before:
                error = one.error + abs(float(one.exponents[0] - before[row].exponents[0]))
                if error <= max(SURE * abs(float(one.exponents[0])), LEAST):
                    found[row] = replace(one, error=error)
        before = now
        left = np.asarray([k for k, row in enumerate(rows.tolist()) if row in now and row not in found], dtype=int)
        rows, near = rows[left], motion.near[left]
    return found


def coefficients_of(motion: Moving, rows: Array, theta: Array) -> Coefficients:
    """Return mass, damping and stiffness of the free coordinates of drives over the share of a period of the shaft.

    rows (b,) of int: of drives that turn the same way; theta (s,): phases of the torques at its beginning, each with
    every one of them a drive of its own, (b·s,).
    """
    part, every = motion.turning, np.repeat(rows, len(theta))
    sense, rate = float(np.sign(part.speed[rows[0]])), part.frequency[every][:, None, None]
    torus = replace(motion.torus, coefficient=motion.torus.coefficient[rows])
    begin = np.tile(theta, len(rows))[:, None]

    def coefficients(share: Array) -> tuple[Array, Array, Array]:
        z = sense * 2.0 * np.pi * share
        x, v, a = (one.reshape(-1, *one.shape[2:]) for one in torus.along(z, theta))
        drives = motion.drives(every, z, begin + motion.ratio * z).of_disturbances
        by = slopes(drives, *part.motion(every, z, x, rate * v, rate**2 * a))
        k = part.first
        return by.mass[..., k:], by.damping[..., k:, k:], by.stiffness[..., k:, k:]

    return coefficients


def matrices_of(motion: Moving, rows: Array, theta: Array) -> tuple[Array, Array, Array]:
    """Return what disturbances of drives are multiplied by in a period, array (b, s, m, m).

    rows (b,) of int: of drives that turn the same way; theta (s,): phases of the torques at its beginning.
    Returns matrices: of a free drive without the shift in time; which coordinates are heavy; and the residuals (b,) by
    Liouville of the first phase.
    """
    part, sense = motion.turning, float(np.sign(motion.turning.speed[rows[0]]))
    coefficients = coefficients_of(motion, rows, theta)
    duration = part.period / np.abs(part.speed[rows])
    found = monodromy(coefficients, np.repeat(duration, len(theta)), reach=REACH)
    residual = liouville(coefficients_of(motion, rows, theta[:1]), duration, found[:: len(theta)])
    heavy = np.any(coefficients(np.linspace(0.0, 1.0, 5))[0] != 0.0, axis=(0, 1))
    if part.model.free:
        ends = (theta, theta + sense * 2.0 * np.pi * motion.ratio)
        found = across_directions(found, *(_tangent(motion, rows, one, heavy) for one in ends))
    return found.reshape(len(rows), len(theta), *found.shape[1:]), heavy, residual


def _sampled(motion: Moving, samples: int) -> Iterator[tuple[Array, Array, Array, Array]]:
    """Yield which motions (k,) of int have so many phases that sums of their harmonics hold the matrices between them.

    With what `matrices_of` gives of them; samples: of the phase, to begin with.
    """
    going = np.flatnonzero(motion.bands.found)
    if not going.size:
        return
    matrices, heavy, residual = matrices_of(motion, going, 2.0 * np.pi * np.arange(samples) / samples)
    while going.size and matrices.shape[-1]:
        held = tail(parts_of(matrices)) <= SMALL
        if np.any(held):
            yield going[held], matrices[held], heavy, residual[held]
        going, matrices, residual = going[~held], matrices[~held], residual[~held]
        if 2 * samples > MOST or not going.size:
            return
        between = matrices_of(motion, going, 2.0 * np.pi * (np.arange(samples) + 0.5) / samples)[0]
        samples *= 2
        matrices = np.stack([matrices, between], axis=2).reshape(len(going), samples, *matrices.shape[2:])


def _tangent(motion: Moving, rows: Array, theta: Array, heavy: Array) -> Array:
    """Return the disturbance by a shift in time at the beginning of a period, array (b·s, m)."""
    part = motion.turning
    rate = part.frequency[rows][:, None, None]
    _x, v, a = (one[rows, :, 0] for one in motion.torus.along(np.zeros(1), theta))
    found = np.concatenate([part.speed[rows][:, None, None] + rate * v, (rate**2 * a)[..., heavy]], axis=-1)
    return found.reshape(-1, found.shape[-1])


def _growths(orbit: Orbit, rows: Array, motion: Moving, loose: tuple[Torque, ...], samples: int) -> dict[int, _Growth]:
    """Return the growth about motions (b,) by their rows where it is known; from so many samples on."""
    found: dict[int, _Growth] = {}
    part = motion.turning
    ratio = motion.ratio * float(np.sign(part.speed[0]))
    for here, matrices, heavy, residual in _sampled(motion, samples):
        _mass, damping, _stiffness = coefficients_of(motion, here, np.zeros(1))(np.linspace(0.0, 1.0, 5))
        every, still = exponents(matrices, ratio), unmoved(damping, heavy)
        drifts = part.model.free & drifting(orbit.drives(rows[here]), part.speed[here])
        for k, row in enumerate(rows[here].tolist()):
            growth, error = every.growth[k], every.error[k]
            if drifts[k]:
                drift = _drift(orbit, row, motion, loose, growth, error)
                if drift is None:
                    continue
                growth, error = np.delete(growth, drift), np.delete(error, drift)
            kept = len(growth) - int(still[k])
            if kept >= 1:
                found[row] = _Growth(
                    exponents=growth[:kept],
                    removed=int(part.model.free) + int(drifts[k]),
                    error=float(error[0]),
                    matrices=matrices[k],
                    ratio=ratio,
                    residual=float(residual[k]),
                )
    return found


def _drift(
    orbit: Orbit, row: int, motion: Moving, loose: tuple[Torque, ...], growth: Array, error: Array
) -> int | None:
    """Return which exponent of a free drive is that of its drift to another speed; None where that is not told.

    As of periodic motions, see `vibrating`: where the torque that keeps the mean speed falls as that rises, the simple
    one above 0, or hardly below, nearest to what the slope makes, else the simple one next to 0 that is not above it.
    """
    gap = np.diff(growth, prepend=np.inf, append=-np.inf)
    alone = np.minimum(-gap[:-1], -gap[1:]) > APART + error
    above = growth > NEUTRAL + error
    if np.any(alone & above):
        forces = []
        for share in (1.0 - ASIDE, 1.0 + ASIDE):
            harmonics = motion.torus.coefficient.shape[-1] // 2
            near = moving(orbit, np.asarray([row]), motion.base, loose, harmonics, share=share)
            if not near.bands.found[0]:
                return None
            forces.append(float(near.torus.force[0]))
        leaving = float(slow_drift(near.turning, forces)[0])
        if leaving > 0.0:
            return int(np.argmin(np.where(alone & (growth > -CLOSE), np.abs(growth - leaving), np.inf)))
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


def _put(known: Floquet, orbit: Orbit, growths: dict[int, _Growth]) -> tuple[Floquet, Array]:
    """Return the same with the growth about some motions in its place, and where that is."""
    exact = np.zeros(orbit.count, dtype=bool)
    rows = np.asarray(sorted(growths), dtype=int)
    exact[rows] = True
    if not rows.size:
        return known, exact.reshape(orbit.angle_error)
    every = [growths[row] for row in rows.tolist()]
    multipliers = np.full((len(rows), max(len(one.exponents) for one in every)), np.nan + 0j)
    for values, one in zip(multipliers, every, strict=True):
        values[: len(one.exponents)] = one.multipliers
    frequencies, speed = straight_frequencies(orbit.drives(rows)), orbit.speed.reshape(-1)[rows]
    own = judged(
        multipliers,
        np.asarray([one.removed for one in every]),
        np.asarray([one.residual for one in every]),
        frequencies[:, 1:] if orbit.model.free else frequencies,
        speed,
        orbit.period,
        np.ones(len(rows), dtype=bool),
        neutral=np.asarray([max(NEUTRAL, one.error) for one in every]),
        base=base_order(orbit.model),
    )
    alone = known.verdict.reshape(-1)[rows] != Verdict.UNSTABLE
    by = (own.verdict == Verdict.UNSTABLE) & alone
    modes = np.maximum(known.zone.modes.reshape(-1, 2)[rows], 1)
    zone = Zone(
        modes=np.where(by[:, None], modes, own.zone.modes),
        sign=np.where(by, 1, own.zone.sign),
        multiple=np.where(by, 0, own.zone.multiple),
        speed=np.where(by, np.abs(speed), own.zone.speed),
    )
    found = replaced(known, rows, replace(own, zone=zone), np.arange(len(rows)))
    return found, exact.reshape(orbit.angle_error)
