"""Which steady motions has a non-linear drive at a speed? Those that are stable, where there are several."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from cardan.later import later
from cardan.maths.arrays import Array
from cardan.maths.compiled import plain
from cardan.maths.compiled import torsion_line as lines
from cardan.maths.compiled.method import has_numba
from cardan.maths.periodic.harmonics import HarmonicBalance, Status, odd_growth
from cardan.maths.periodic.switching_orbit import Pieces
from cardan.questions.torsion.model.torsional_layouts import Turning, chosen, line_of, single
from cardan.questions.torsion.model.torsional_modes import straight_modes

from .orbit import Backlashed, Orbit, at_rest, pieces_near, straight_stiffness
from .run_stability import Verdict, floquet
from .steady import CHUNK, KINKED, LOWER, fourier_of, sums_of
from .steady_result import read_off

compiled = later("cardan.maths.compiled.torsion_block")

SIZES = (1.0, 1.5, 3.0)
"""Swings that searches begin with, over what the drive twists anyway."""

PHASES = 8
"""Phases that they begin with."""

FADED, PERIODS = 5.0, (40, 250)
"""By e to which power what a drive with play begins with has faded when it is looked at, and after how many periods."""

REPEATS = 0.02
"""Share of its swing by which it may still change from one period to the next."""

SAMPLES, REACH, LIGHT = 256, 0.4, 3.0
"""Samples of a period, phase of the fastest oscillation in a step, and times by which what has no inertia is faster."""

ALIKE, SAME = 0.03, 1e-4
"""Difference of two motions, over the larger of them, below which it is one: as sought, and exactly."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Beside:
    """A further stable motion of one of many drives: as likely as the one that is told, by how it was reached."""

    row: int  # which drive, counted through the leading axes
    orbit: Orbit  # (1,)
    lowest: Array  # lowest, highest (E,) [N·m]: true extremes of the torque of every element
    highest: Array

    @property
    def swing(self) -> Array:
        """Half of highest less lowest torque of every element, array (E,) [N·m]."""
        found: Array = 0.5 * (self.highest - self.lowest)
        return found


def stable_motions(orbit: Orbit, status: Array) -> tuple[Orbit, Array, tuple[Beside, ...]]:
    """Return motions with a stable one wherever one is found, their status, and further stable ones.

    orbit (...), status (...): as `steady_orbits` gives them.
    Of several stable motions the one with the largest swing of the torque is told, the others stand beside it. Others
    are sought where play may open, by following the drive in time from swings of the mode next to a multiple of the
    speed until they repeat, and where the motion found is the middle one of three, by harmonic balance from the same
    swings: a search from so many starts, no proof that there are no others. The speed of free drives is held by nothing
    that is known; of them none is sought.
    """
    rows = np.flatnonzero(_several(orbit, status))
    coefficient = orbit.coefficient.reshape(orbit.count, *orbit.coefficient.shape[-2:])
    states, pieces = np.array(status).reshape(-1), dict(orbit.pieces)
    beside: list[Beside] = []
    for row, sums in _searched(orbit, rows):
        own = _alone(orbit, row)
        known = [own] if floquet(own).verdict[0] == Verdict.STABLE else []
        motions = _distinct([*known, *_others(orbit, row, sums)])
        every = [Beside(row=row, orbit=one, **_extremes(one)) for one in motions]
        if not every:
            continue
        every.sort(key=lambda one: -float(np.max(one.swing)))
        first, beside = every[0].orbit, beside + every[1:]
        if first is own:
            continue
        wide = max(coefficient.shape[-1], first.coefficient.shape[-1])
        coefficient = _wide(coefficient, wide)
        coefficient[row], states[row] = _wide(first.coefficient, wide)[0], Status.CONVERGED
        pieces.pop(row, None)
        if first.pieces:
            pieces[row] = first.pieces[0]
    shaped = coefficient.reshape(*orbit.angle_error, *coefficient.shape[1:])
    return replace(orbit, coefficient=shaped, pieces=pieces), states.reshape(np.shape(status)), tuple(beside)


def _several(orbit: Orbit, status: Array) -> Array:
    """Tell which drives may have several stable motions, or have one that was not found, array of bool (b,)."""
    turning, state = orbit.turning, np.ravel(status)
    if turning.model.free or not turning.coordinates:
        return np.zeros(orbit.count, dtype=bool)
    loose = np.broadcast_to(orbit.model.backlash, (*orbit.angle_error, len(orbit.model.elements))) > 0.0
    found: Array = (np.any(loose, axis=-1).reshape(-1) | orbit.model.special) & (state != Status.CANCELLED)
    smooth = np.flatnonzero(~found & (state != Status.CANCELLED) & (state != Status.NO_CONVERGENCE))
    smooth = smooth[[row not in orbit.pieces for row in smooth.tolist()]]
    for rows in np.split(smooth, range(CHUNK, len(smooth), CHUNK)):
        part, sums = turning.part(rows), orbit.coefficient.reshape(orbit.count, *orbit.coefficient.shape[-2:])
        found[rows] = odd_growth(part, part.frequency, sums[rows][:, part.first :])
    return found


def _searched(orbit: Orbit, rows: Array) -> Iterator[tuple[int, Array]]:
    """Yield rows with the sums (k, R, H+1) to which searches led that began with other swings."""
    turning = orbit.turning
    loose = np.any(np.broadcast_to(orbit.model.backlash, (*orbit.angle_error, len(orbit.model.elements))) > 0.0, -1)
    open_ = [int(row) for row in rows if loose.reshape(-1)[row]]
    for row in open_:
        yield row, _settled(turning.part(np.asarray([row])), _starts(orbit, row))
    smooth = [int(row) for row in rows if row not in open_]
    if not smooth:
        return
    parts = [_starts(orbit, row) for row in smooth]
    wide, each = max(part.shape[-1] for part in parts), len(SIZES) * PHASES
    harmonics = KINKED * round(turning.period / np.pi)
    how = HarmonicBalance(harmonics=harmonics, most=4 * harmonics)
    waves = sums_of(turning.part(np.repeat(smooth, each)), np.concatenate([_wide(one, wide) for one in parts]), how)
    for k, row in enumerate(smooth):
        here = waves.coefficient[k * each : (k + 1) * each]
        yield row, here[np.isfinite(here).all(axis=(-1, -2))]


def _settled(part: Turning, starts: Array) -> Array:
    """Return the motions of one drive with play that repeat after a while, followed in time, array (k, R, H+1).

    starts (b, R, h+1), complex: motions whose places and speeds at the angle 0 are those to begin with. What turns
    no inertia gets so little that it swings faster than all else: the search alone follows it.
    """
    count = len(starts)
    model, switching = part.drives(np.zeros(1, dtype=int)), Backlashed(part)
    modes = straight_modes(replace(single(part.model, (1,), 0), torques=(), input_speed=0.0))
    duration, base = 2.0 * np.pi / abs(float(part.frequency[0])), float(part.frequency[0])
    decay = float(np.min(modes.damping_ratio * modes.omega, initial=np.inf))
    inertia, fastest = np.array(model.inertia), switching.fastest
    if not switching.heavy.all():
        spring = np.max(np.diagonal(straight_stiffness(model), axis1=-2, axis2=-1))
        for r in np.flatnonzero(~switching.heavy) + part.first:
            inertia[:, model.owner[r]] = spring / (LIGHT * fastest) ** 2
        fastest *= LIGHT
    single_model = chosen(replace(part.model, inertia=inertia), (1,), np.zeros(count, dtype=int), moments=False)
    line = line_of(single_model, count)
    order = np.arange(starts.shape[-1])
    place = np.sum(starts, axis=-1).real.T
    rate = np.sum(1j * base * order * starts, axis=-1).real.T
    speed = np.full(count, float(part.speed[0]))
    q, v = np.vstack([0.0 * speed, place]), np.vstack([speed, rate + speed])
    block = (compiled() if has_numba() else plain).Block(line, lines.begin(line, q, v))
    steps = SAMPLES * max(1, math.ceil(duration * fastest / (REACH * SAMPLES)))
    periods = min(max(math.ceil(FADED / (decay * duration)), PERIODS[0]), PERIODS[1])

    def advanced(begin: float, taken: int) -> Array:
        """Return what each coordinate is off even rotation, and that of its speed, after some steps."""
        block.advance(begin, taken, duration / steps, (begin * speed, speed, 0.0 * speed), last=False)
        angle, turning, _work = block.now()
        then = begin + taken * duration / steps
        return np.stack([angle[1:] - then * speed, (turning[1:] - speed) / abs(base)])

    advanced(0.0, periods * steps)
    times = duration * (periods + np.arange(SAMPLES) / SAMPLES)
    path = np.stack([advanced(float(time), steps // SAMPLES) for time in times], axis=-1)
    after = np.stack([advanced(float(time + duration), steps // SAMPLES) for time in times], axis=-1)
    swing = np.max(np.ptp(path[0], axis=-1), axis=0)
    kept = np.max(np.abs(after - path), axis=(0, 1, 3)) <= REPEATS * swing
    wave = np.fft.rfft(np.roll(after[0], 1, axis=-1), axis=-1)[..., :LOWER] / SAMPLES
    wave[..., 1:] *= 2.0
    found: Array = np.moveaxis(wave, 0, 1)
    return (found if base > 0.0 else found.conj())[kept & np.isfinite(found).all(axis=(1, 2))]


def _starts(orbit: Orbit, row: int) -> Array:
    """Return swings of the mode next to a multiple of the speed, about the twist at rest, array (k, R, H+1)."""
    turning, drive = orbit.turning.part(np.asarray([row])), single(orbit.model, orbit.angle_error, row)
    amid = replace(turning.model, backlash=np.zeros_like(turning.model.backlash))
    rests = [at_rest(one)[0, :, 0] for one in (turning, Turning(amid, (1,), turning.speed, turning.period))]
    modes = straight_modes(replace(drive, torques=(), input_speed=0.0))
    if not modes.omega.size:
        return np.repeat(rests[0][None, :, None], len(SIZES) * PHASES, axis=0)
    base = abs(float(turning.frequency[0]))
    times = np.maximum(np.round(modes.omega / base), 1.0)
    m = int(np.argmin(np.abs(np.log(modes.omega / (times * base)))))
    heads, tails = [a for a, _b in drive.elements], [b for _a, b in drive.elements]
    twist = np.abs(modes.shape[m, heads] - modes.shape[m, tails])
    e = int(np.argmax(twist))
    placed = np.pad(rests[1].real, (turning.first, 0))[list(drive.coordinate)]
    size = abs(placed[heads[e]] - placed[tails[e]]) + 0.5 * float(drive.backlash[e])
    own = orbit.coefficient.reshape(orbit.count, *orbit.coefficient.shape[-2:])[row]
    swung = np.sum(np.abs(own[:, 1:]), axis=-1)[list(drive.coordinate)]
    size += float(np.nan_to_num(abs(swung[heads[e]] - swung[tails[e]])))
    starts = np.zeros((len(SIZES) * PHASES, turning.coordinates, int(times[m]) + 1), dtype=complex)
    starts[:, :, 0] = np.repeat([rests[min(k, 1)] for k in range(len(SIZES))], PHASES, axis=0)
    turn = np.exp(2j * np.pi * np.arange(PHASES) / PHASES)
    shape = modes.shape[m, list(drive.owner)][turning.first :] * (size / twist[e])
    starts[:, :, -1] = (np.asarray(SIZES)[:, None] * turn).reshape(-1, 1) * shape
    return starts


def _others(orbit: Orbit, row: int, sums: Array) -> Iterator[Orbit]:
    """Yield the stable motions of a drive to which sums (k, R, H+1) lead."""
    part = orbit.turning.part(np.asarray([row]))
    loose = bool(np.any(part.model.backlash > 0.0))
    begun: list[Array] = []
    for one in sums:
        if any(_near(one, other, ALIKE) for other in begun):
            continue
        begun.append(one)
        coefficient = one
        pieces: dict[int, Pieces] = {}
        if loose:
            found = pieces_near(part, one)
            if found is None:
                continue
            coefficient, pieces = fourier_of(found, LOWER), {0: found}
        alone = _of_one(part, np.pad(coefficient, ((part.first, 0), (0, 0))), pieces)
        if floquet(alone).verdict[0] == Verdict.STABLE:
            yield alone


def _alone(orbit: Orbit, row: int) -> Orbit:
    """Return the motion of one drive."""
    coefficient = orbit.coefficient.reshape(orbit.count, *orbit.coefficient.shape[-2:])[row]
    pieces = {0: orbit.pieces[row]} if row in orbit.pieces else {}
    return _of_one(orbit.turning.part(np.asarray([row])), coefficient, pieces)


def _of_one(part: Turning, coefficient: Array, pieces: dict[int, Pieces]) -> Orbit:
    """Return a motion (R, H+1) of one drive whose speed is forced."""
    return Orbit(
        model=part.model,
        speed=part.speed,
        period=part.period,
        coefficient=coefficient[None],
        force=np.zeros(1),
        pieces=pieces,
    )


def _distinct(motions: list[Orbit]) -> list[Orbit]:
    """Return motions without those that stand there already."""
    found: list[Orbit] = []
    for one in motions:
        if not any(_near(one.coefficient[0], other.coefficient[0], SAME) for other in found):
            found.append(one)
    return found


def _near(one: Array, other: Array, share: float) -> bool:
    """Tell whether two sums (R, H+1) differ by less than a share of their swing."""
    wide = max(one.shape[-1], other.shape[-1])
    first, second = _wide(one, wide), _wide(other, wide)
    swing = max(float(np.max(np.abs(each[:, 1:]), initial=0.0)) for each in (first, second))
    return bool(np.max(np.abs(first - second)) <= share * swing)


def _wide(coefficient: Array, width: int) -> Array:
    return np.pad(coefficient, [(0, 0)] * (coefficient.ndim - 1) + [(0, width - coefficient.shape[-1])])


def _extremes(orbit: Orbit) -> dict[str, Array]:
    """Return lowest and highest torques of the one motion of an orbit, arrays (E,)."""
    found = read_off(orbit, 1)
    return {"lowest": found.lowest[0], "highest": found.highest[0]}
