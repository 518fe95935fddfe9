"""Which steady motions has a non-linear drive at a speed? Those that are stable, also those of several periods."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cardan.later import later
from cardan.maths.arrays import Array
from cardan.maths.compiled import plain
from cardan.maths.compiled import torsion_line as lines
from cardan.maths.compiled.method import has_numba
from cardan.maths.periodic.harmonics import HarmonicBalance, Status, odd_growth
from cardan.maths.periodic.switching_orbit import Pieces
from cardan.questions.torsion.model.torsional_balance import element_torques
from cardan.questions.torsion.model.torsional_layouts import Turning, chosen, line_of, single
from cardan.questions.torsion.model.torsional_modes import straight_modes

from .orbit import Backlashed, Orbit, at_rest, pieces_near, straight_stiffness
from .run_stability import Verdict, floquet
from .steady import CHUNK, HARMONICS, LOWER, MOST, fourier_of, sums_of
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

STEPS, REACH, LIGHT = 256, 0.4, 3.0
"""Steps of a period at least, phase of the fastest oscillation in one, by how much what has no inertia is faster."""

LONGEST, EVERY, RUN = 6, 60, 36
"""Periods after which a motion is looked at whether it repeats, what divides by all of them, and how many periods are
followed of one that does not."""

CLOSE, COARSE = 64, 32
"""Samples of a period, to tell a motion and to follow what does not repeat."""

SETTLED = 0.2
"""Share by which the swing of what does not repeat may change from one half of that run to the other."""

ALIKE, SAME = 0.03, 1e-4
"""Difference of two motions, over the larger of them, below which it is one: as sought, and exactly."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Beside:
    """A further stable motion of one of many drives: as likely as the one that is told, by how it was reached."""

    row: int  # which drive, counted through the leading axes
    orbit: Orbit | None  # (1,); None of what does not repeat
    lowest: Array  # lowest, highest (E,) [N·m]: true extremes of the torque of every element
    highest: Array
    periods: int = 1  # after how many periods it repeats; 0 where not within `LONGEST`: extremes of a long run
    runs: bool = False  # whether it is what runs, since no motion of one period is stable

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
    that is known; of them none is sought. With play motions may repeat after several periods only, or not at all, as
    where the one of one period has doubled: they stand beside the one of one period, and run where that is unstable.
    """
    rows = np.flatnonzero(_several(orbit, status))
    coefficient = orbit.coefficient.reshape(orbit.count, *orbit.coefficient.shape[-2:])
    states, pieces = np.array(status).reshape(-1), dict(orbit.pieces)
    beside: list[Beside] = []
    for row, runs in _searched(orbit, rows):
        own = _alone(orbit, row)
        known = [own] if floquet(own).verdict[0] == Verdict.STABLE else []
        motions = _distinct([*known, *_others(orbit, row, [one.wave for one in runs if one.periods == 1])])
        every = [Beside(row=row, orbit=one, **_extremes(one)) for one in motions]
        beside += _longer(orbit, row, runs, every)
        if not every:
            continue
        every.sort(key=lambda one: -float(np.max(one.swing)))
        first, beside = every[0].orbit, beside + every[1:]
        if first is None or first is own:
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


def widened(lowest: Array, highest: Array, beside: Sequence[Beside]) -> tuple[Array, Array]:
    """Return extremes (b, E) with those of motions of several periods, or that do not repeat, where these run."""
    low, high = lowest.copy(), highest.copy()
    for one in beside:
        if one.runs:
            low[one.row] = np.minimum(low[one.row], one.lowest)
            high[one.row] = np.maximum(high[one.row], one.highest)
    return low, high


@dataclass(frozen=True, eq=False, kw_only=True)
class _Run:
    """Where a search led: a sum (R, H+1) over some periods; of what does not repeat its torques (E,)."""

    wave: Array
    periods: int = 1
    lowest: Array | None = None
    highest: Array | None = None

    def same(self, other: _Run) -> bool:
        """Tell whether another is alike, be it some periods later."""
        if self.periods != other.periods:
            return False
        turn = 2j * np.pi * np.arange(self.wave.shape[-1]) / self.periods
        return any(_near(self.wave * np.exp(turn * k), other.wave, ALIKE) for k in range(self.periods))


def _longer(orbit: Orbit, row: int, runs: Sequence[_Run], known: Sequence[Beside]) -> list[Beside]:
    """Return the stable motions of several periods, and the widest of those that do not repeat, beside known ones."""
    part = orbit.turning.part(np.asarray([row]))
    found: list[Beside] = []

    def new(lowest: Array, highest: Array, share: float) -> bool:
        least = share * float(np.max(highest - lowest))
        every = [(one.lowest, one.highest) for one in (*known, *found)]
        return not any(max(np.max(abs(a - lowest)), np.max(abs(b - highest))) <= least for a, b in every)

    begun: list[_Run] = []
    for run in (one for one in runs if one.periods > 1):
        if any(run.same(other) for other in begun):
            continue
        begun.append(run)
        longer = Turning(part.model, part.angle_error, part.speed, run.periods * part.period)
        pieces = pieces_near(longer, run.wave)
        if pieces is None:
            continue
        sums = np.pad(fourier_of(pieces, run.periods * LOWER), ((part.first, 0), (0, 0)))
        alone = _of_one(longer, sums, {0: pieces})
        ends = _extremes(alone)
        if floquet(alone).verdict[0] == Verdict.STABLE and new(**ends, share=SAME):
            found.append(Beside(row=row, orbit=alone, periods=run.periods, **ends))
    wild = [(one.lowest, one.highest) for one in runs if one.lowest is not None and one.highest is not None]
    if wild:
        low, high = max(wild, key=lambda one: float(np.max(one[1] - one[0])))
        if new(low, high, ALIKE):
            found.append(Beside(row=row, orbit=None, lowest=low, highest=high, periods=0))
    found.sort(key=lambda one: -float(np.max(one.swing)))
    return [replace(one, runs=not known) for one in found]


def _searched(orbit: Orbit, rows: Array) -> Iterator[tuple[int, list[_Run]]]:
    """Yield rows with where searches led that began with other swings."""
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
    few = HARMONICS * round(turning.period / np.pi)
    starts = np.concatenate([_wide(one, wide) for one in parts])
    led, _fine = _sums(turning, np.repeat(smooth, each), starts, HarmonicBalance(harmonics=few, most=few))
    begun = [_unlike(led[k * each : (k + 1) * each]) for k in range(len(smooth))]
    own = np.repeat(np.arange(len(smooth)), [len(one) for one in begun])
    how = HarmonicBalance(harmonics=few, most=MOST)
    waves, fine = _sums(turning, np.asarray(smooth)[own], np.concatenate(begun), how)
    for k, row in enumerate(smooth):
        yield row, [_Run(wave=one) for one in waves[fine & (own == k)]]


def _sums(turning: Turning, rows: Array, starts: Array, how: HarmonicBalance) -> tuple[Array, Array]:
    """Return where sums (b, R, H+1) of some of the drives lead, nan where nowhere, and which are fine enough (b,)."""
    parts = [sums_of(turning.part(rows[k : k + CHUNK]), starts[k : k + CHUNK], how) for k in range(0, len(rows), CHUNK)]
    wide = max([starts.shape[-1], *(part.coefficient.shape[-1] for part in parts)])
    sums = np.concatenate([_wide(starts[:0], wide), *[_wide(part.coefficient, wide) for part in parts]])
    return sums, np.concatenate([np.zeros(0), *[part.status for part in parts]]) == Status.CONVERGED


def _unlike(sums: Array) -> Array:
    """Return those of sums (b, R, H+1) that were found and unlike each other."""
    found: list[Array] = []
    for one in sums[np.isfinite(sums).all(axis=(-1, -2))]:
        if not any(_near(one, other, ALIKE) for other in found):
            found.append(one)
    return np.asarray(found).reshape(len(found), *sums.shape[1:])


def _settled(part: Turning, starts: Array) -> list[_Run]:
    """Return what one drive with play does after a while, followed in time.

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
    steps = STEPS * max(1, math.ceil(duration * fastest / (REACH * STEPS)))
    periods = min(max(math.ceil(FADED / (decay * duration)), PERIODS[0]), PERIODS[1])
    periods = EVERY * math.ceil(periods / EVERY)

    def advanced(begin: float, taken: int) -> Array:
        """Return what each coordinate is off even rotation, and that of its speed, after some steps."""
        block.advance(begin, taken, duration / steps, (begin * speed, speed, 0.0 * speed), last=False)
        angle, turning, _work = block.now()
        then = begin + taken * duration / steps
        return np.stack([angle[1:] - then * speed, (turning[1:] - speed) / abs(base)])

    def followed(first: int, count: int, samples: int) -> Array:
        """Return the same at the samples of some periods, each at the end of its step, array (2, R, k, s)."""
        times = duration * (first + np.arange(count * samples) / samples)
        return np.stack([advanced(float(time), steps // samples) for time in times], axis=-1)

    advanced(0.0, periods * steps)
    path = followed(periods, LONGEST + 1, CLOSE)
    swing = np.max(np.ptp(path[0], axis=-1), axis=0)
    finite = np.isfinite(path).all(axis=(0, 1, 3))
    found: list[_Run] = []
    left = finite.copy()
    for m in range(1, LONGEST + 1):
        shifted = np.max(np.abs(path[..., m * CLOSE :] - path[..., : -m * CLOSE]), axis=(0, 1, 3))
        rows = np.flatnonzero(left & (shifted <= REPEATS * swing))
        left[rows] = False
        samples = np.roll(path[0][..., : m * CLOSE], 1, axis=-1)[:, rows]
        wave = np.fft.rfft(samples, axis=-1)[..., : m * LOWER] / (m * CLOSE)
        wave[..., 1:] *= 2.0
        found += [_Run(wave=wave[:, k] if base > 0.0 else wave[:, k].conj(), periods=m) for k in range(len(rows))]
    rows = np.flatnonzero(left)
    if rows.size:
        path = followed(periods + LONGEST + 1, RUN, COARSE)[:, :, rows]
        halves = [np.max(np.ptp(one[0], axis=-1), axis=0) for one in np.split(path, 2, axis=-1)]
        lasts = np.abs(halves[0] - halves[1]) <= SETTLED * np.maximum(*halves)
        times = duration * (periods + LONGEST + 1 + (np.arange(RUN * COARSE) + 1) / COARSE)
        angle = np.pad(np.moveaxis(path[0], 0, -1), ((0, 0), (0, 0), (1, 0)))
        rate = np.pad(np.moveaxis(path[1] * abs(base), 0, -1), ((0, 0), (0, 0), (1, 0)))
        torque = element_torques(
            part.drives(np.zeros(len(rows), dtype=int)), angle + (times * speed[0])[:, None], rate + speed[0]
        )
        for k in np.flatnonzero(lasts).tolist():
            ends = {"lowest": np.min(torque[k], axis=0), "highest": np.max(torque[k], axis=0)}
            found.append(_Run(wave=np.zeros((len(path[0]), 0)), periods=0, **ends))
    return found


def _starts(orbit: Orbit, row: int) -> Array:
    """Return swings of the mode next to a low multiple of the speed, about the twist at rest, array (k, R, H+1)."""
    turning, drive = orbit.turning.part(np.asarray([row])), single(orbit.model, orbit.angle_error, row)
    amid = replace(turning.model, backlash=np.zeros_like(turning.model.backlash))
    rests = [at_rest(one)[0, :, 0] for one in (turning, Turning(amid, (1,), turning.speed, turning.period))]
    modes = straight_modes(replace(drive, torques=(), input_speed=0.0))
    if not modes.omega.size:
        return np.repeat(rests[0][None, :, None], len(SIZES) * PHASES, axis=0)
    base = abs(float(turning.frequency[0]))
    times = np.maximum(np.round(modes.omega / base), 1.0)
    far = np.abs(np.log(modes.omega / (times * base)))
    low = times <= HARMONICS * round(turning.period / np.pi)
    m = int(np.argmin(np.where(low, far, np.inf) if low.any() else modes.omega))
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


def _others(orbit: Orbit, row: int, sums: Sequence[Array]) -> Iterator[Orbit]:
    """Yield the stable motions of one period of a drive to which sums (R, H+1) lead."""
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
