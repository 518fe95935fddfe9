"""Which steady motions has a non-linear drive at a speed? Those that are stable, also those of several periods."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cardan.maths.arrays import Array
from cardan.maths.periodic.harmonics import HarmonicBalance, Status, odd_growth
from cardan.maths.periodic.switching_orbit import Pieces
from cardan.maths.remembered import remembered
from cardan.questions.torsion.model.torsional_layouts import Turning, single
from cardan.questions.torsion.model.torsional_model import TorsionalModel
from cardan.questions.torsion.model.torsional_modes import straight_modes

from .orbit import Orbit, at_rest, pieces_near
from .run_stability import Floquet, Kind, Verdict, floquet, replaced
from .settling import ALIKE, Run, near, padded, ramped, settled
from .steady import CHUNK, HARMONICS, LOWER, MOST, Progress, fourier_of, steady_orbits, sums_of
from .steady_result import read_off

SIZES = (1.0, 1.5, 3.0)
"""Swings that searches begin with, over what the drive twists anyway."""

PHASES = 8
"""Phases that they begin with."""

LOOKED = 100
"""Motions that may be middle ones are looked at by themselves, up to so many."""

FEW = 16
"""Motions of so many speeds are kept: one with open play takes 60 kB."""

ASIDE, WAY = 0.02, 25
"""Share of the speed from which motions of free drives are followed, and in how many steps."""

SAME = 1e-4
"""Difference of two motions, over the larger of them, below which it is one exactly."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Beside:
    """A further stable motion of one of many drives, beside the one of one period that is told."""

    row: int  # which drive, counted through the leading axes
    orbit: Orbit | None  # (1,); None of what does not repeat
    lowest: Array  # lowest, highest (E,) [N·m]: true extremes of the torque of every element
    highest: Array
    periods: int = 1  # after how many periods it repeats; 0 where not within `LONGEST`: extremes of a long run
    reached: bool | None = False  # whether a slow run-up or run-down leads to it; None where it is not known which
    runs: bool = False  # whether it counts while it repeats after several periods only, or not at all

    @property
    def swing(self) -> Array:
        """Half of highest less lowest torque of every element, array (E,) [N·m]."""
        found: Array = 0.5 * (self.highest - self.lowest)
        return found


def stable_motions(orbit: Orbit, status: Array, *, grow: bool = False) -> tuple[Orbit, Array, tuple[Beside, ...]]:
    """Return motions with a stable one wherever one is found, their status, and further stable ones.

    orbit (...), status (...): as `steady_orbits` gives them. grow: whether all are known to grow.
    Others are sought where play may open, by following the drive in time from swings of the mode next to a low multiple
    of the speed until they repeat, and where the motion found is the middle one of three, by harmonic balance from the
    same swings: a search from so many starts, no proof that there are no others. With play motions may repeat after
    several periods only, or not at all. The speed of free drives is held by nothing that is known, so that no ramp can
    be followed in time; where the motion found of one is the middle one, others are followed from lower and from
    higher speeds, each by the one before.

    Of several stable motions one counts, by one rule for all: of those that a slow run-up or run-down leads to
    (`cardan.questions.torsion.steady.settling`) the one with the largest swing of the torque. It is the motion that is
    told where it repeats with every period; else it runs beside one of one period, see `widened`. Others take a blow or
    an abrupt start: they stand beside it. Where neither leads to one that was found, too little damping lets no ramp
    settle, the drive is too stiff to be followed that long, or fixed steps do not follow it
    (`TorsionalModel.steppable`), the largest of one period counts.
    """
    rows = np.flatnonzero(_several(orbit, status, grow=grow))
    coefficient = orbit.coefficient.reshape(orbit.count, *orbit.coefficient.shape[-2:])
    states, pieces, force = np.array(status).reshape(-1), dict(orbit.pieces), np.array(orbit.force).reshape(-1)
    beside: list[Beside] = []
    for row, runs in _followed(orbit, rows) if orbit.model.free else _searched(orbit, rows):
        own = _alone(orbit, row)
        known = [own] if not grow and floquet(own).verdict[0] == Verdict.STABLE else []
        motions = _distinct([*known, *_others(orbit, row, [one.mean for one in runs if one.periods])])
        first, others = _counted(orbit, row, runs, motions)
        beside += others
        if first is None or first is own:
            continue
        width = max(coefficient.shape[-1], first.coefficient.shape[-1])
        coefficient = padded(coefficient, width)
        coefficient[row], states[row] = padded(first.coefficient, width)[0], Status.CONVERGED
        force[row] = first.force[0]
        pieces.pop(row, None)
        if first.pieces:
            pieces[row] = first.pieces[0]
    shaped = coefficient.reshape(*orbit.angle_error, *coefficient.shape[1:])
    found = replace(orbit, coefficient=shaped, pieces=pieces, force=force.reshape(np.shape(orbit.force)))
    return found, states.reshape(np.shape(status)), tuple(beside)


def several_looked_for(model: TorsionalModel) -> bool:
    """Tell whether steady motions of drives are searched for at every speed: play may open, a spring bend or rub."""
    return bool(np.any(model.backlash > 0.0)) or model.special


def _kept(found: tuple[Orbit, Array, tuple[Beside, ...]]) -> bool:
    """Tell whether motions are few and were not cancelled."""
    return np.size(found[1]) <= FEW and not np.any(found[1] == Status.CANCELLED)


@remembered(64, keep=_kept)  # drives of many joint sizes share few torsional models, and a model takes a second
def told_motions(
    model: TorsionalModel, speeds: Array, *, progress: Progress | None = None
) -> tuple[Orbit, Array, tuple[Beside, ...]]:
    """Return the motions that are told at speeds (s,) [rad/s], as `stable_motions`; few are kept for whoever asks next.

    progress: told the share done of what was not kept; when it answers "stop", the speeds not yet done are left out as
    cancelled.
    """
    return stable_motions(*steady_orbits(model, speed=speeds, progress=progress))


def _counted(
    orbit: Orbit, row: int, runs: Sequence[Run], motions: Sequence[Orbit]
) -> tuple[Orbit | None, list[Beside]]:
    """Return the motion of one period that is told, and what else is stable beside it, with what runs."""
    part = orbit.turning.part(np.asarray([row]))
    if len(motions) > 1 and part.model.steppable and not part.model.free and not any(one.reached for one in runs):
        runs = [*ramped(part), *runs]
    waves = [one.mean for one in runs if one.reached]
    once = []
    for one in motions:
        reached = any(near(one.coefficient[0, part.first :], wave, ALIKE) for wave in waves)
        once.append(Beside(row=row, orbit=one, reached=reached, **_extremes(one)))
    once.sort(key=_size, reverse=True)
    every = [*once, *_longer(part, row, runs, once)]
    if len(every) == 1:  # whatever the way, it leads there
        once, every = ([replace(one, reached=True) for one in each] for each in (once, every))
    elif not any(one.reached for one in every):
        once, every = ([replace(one, reached=None) for one in each] for each in (once, every))
    counted = max([one for one in every if one.reached] or once or every, key=_size, default=None)
    first = max([one for one in once if one.reached] or once, key=_size, default=None)
    others = [replace(one, runs=one is counted) for one in every if first is None or one.orbit is not first.orbit]
    return (None if first is None else first.orbit), others


def _size(one: Beside) -> float:
    """Return the largest swing of a torque [N·m]."""
    return float(np.max(one.swing))


def _several(orbit: Orbit, status: Array, *, grow: bool) -> Array:
    """Tell which drives may have several stable motions, or have one that was not found, array of bool (b,)."""
    turning, state = orbit.turning, np.ravel(status)
    if not turning.coordinates:
        return np.zeros(orbit.count, dtype=bool)
    if turning.model.free:
        return np.ones(orbit.count, dtype=bool) if grow else middle_ones(orbit)
    loose = np.broadcast_to(orbit.model.backlash, (*orbit.angle_error, len(orbit.model.elements))) > 0.0
    found: Array = (np.any(loose, axis=-1).reshape(-1) | orbit.model.special) & (state != Status.CANCELLED)
    smooth = np.flatnonzero(~found & (state != Status.CANCELLED) & (state != Status.NO_CONVERGENCE))
    smooth = smooth[[row not in orbit.pieces for row in smooth.tolist()]]
    for rows in np.split(smooth, range(CHUNK, len(smooth), CHUNK)):
        part, sums = turning.part(rows), orbit.coefficient.reshape(orbit.count, *orbit.coefficient.shape[-2:])
        found[rows] = odd_growth(part, part.frequency, sums[rows][:, part.first :])
    return found


def middle_ones(orbit: Orbit, judged: Floquet | None = None) -> Array:
    """Tell which motions may be the middle one of three: smooth, and growing without swinging, array of bool (b,).

    Of a free drive that growth may have met the drift of the mean speed, so that both swing.
    """
    said = floquet(orbit) if judged is None else judged
    kind = np.ravel(said.kind)
    grows = (np.ravel(said.verdict) == Verdict.UNSTABLE) & (kind != Kind.DOUBLING)
    grows &= (kind == Kind.REPEATING) | orbit.model.free
    played = np.broadcast_to(orbit.model.backlash, (*orbit.angle_error, len(orbit.model.elements))) > 0.0
    found: Array = grows & ~np.any(played, axis=-1).reshape(-1) & ~np.isin(np.arange(orbit.count), list(orbit.pieces))
    return found


def _followed(orbit: Orbit, rows: Array) -> Iterator[tuple[int, list[Run]]]:
    """Yield rows with the motions that are followed to their speed from below and from above."""
    few = HARMONICS * round(orbit.period / np.pi)
    way = np.linspace((1.0 - ASIDE, 1.0 + ASIDE), 1.0, WAY)
    steps = [*[(few, Status.COARSE)] * (WAY - 1), (MOST, Status.CONVERGED)]
    for some in np.split(rows, range(CHUNK, len(rows), CHUNK)):
        part = orbit.turning.part(some)
        runs: list[list[Run]] = [[] for _row in some]
        for shares in way.T:
            wave, there = at_rest(part), np.ones(len(some), dtype=bool)
            for share, (most, enough) in zip(shares, steps, strict=True):
                here = Turning(part.model, part.angle_error, share * part.speed, part.period)
                led = sums_of(here, wave, HarmonicBalance(harmonics=few, most=most))
                there &= led.status <= enough
                wave = np.where(np.isfinite(led.coefficient), led.coefficient, 0.0)
            for k in np.flatnonzero(there).tolist():
                runs[k].append(Run(wave=wave[k], reached=True))
        yield from zip(some.tolist(), runs, strict=True)


def widened(lowest: Array, highest: Array, beside: Sequence[Beside]) -> tuple[Array, Array]:
    """Return extremes (b, E) with those of motions of several periods, or that do not repeat, where these run."""
    low, high = lowest.copy(), highest.copy()
    for one in beside:
        if one.runs:
            low[one.row] = np.minimum(low[one.row], one.lowest)
            high[one.row] = np.maximum(high[one.row], one.highest)
    return low, high


def _longer(part: Turning, row: int, runs: Sequence[Run], known: Sequence[Beside]) -> list[Beside]:
    """Return the stable motions of several periods, and the widest of those that do not repeat, beside known ones."""
    found: list[Beside] = []

    def new(lowest: Array, highest: Array, share: float) -> bool:
        least = share * float(np.max(highest - lowest))
        every = [(one.lowest, one.highest) for one in (*known, *found)]
        return not any(max(np.max(abs(a - lowest)), np.max(abs(b - highest))) <= least for a, b in every)

    begun: list[Run] = []
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
            found.append(Beside(row=row, orbit=alone, periods=run.periods, reached=run.reached, **ends))
    for reached in (True, False):
        wild = [run for run in runs if run.periods == 0 and run.reached >= reached]
        torques = [(one.lowest, one.highest) for one in wild if one.lowest is not None and one.highest is not None]
        if torques:
            low, high = max(torques, key=lambda one: float(np.max(one[1] - one[0])))
            if new(low, high, ALIKE):
                found.append(Beside(row=row, orbit=None, lowest=low, highest=high, periods=0, reached=reached))
    return sorted(found, key=_size, reverse=True)


def _searched(orbit: Orbit, rows: Array) -> Iterator[tuple[int, list[Run]]]:
    """Yield rows with where searches led that began with other swings."""
    turning = orbit.turning
    loose = np.any(np.broadcast_to(orbit.model.backlash, (*orbit.angle_error, len(orbit.model.elements))) > 0.0, -1)
    open_ = [int(row) for row in rows if loose.reshape(-1)[row] and orbit.model.steppable]
    for row in open_:
        part = turning.part(np.asarray([row]))
        runs = settled(part, _starts(orbit, row))
        several = any(not run.same(runs[0]) for run in runs)
        yield row, [*ramped(part), *runs] if several else runs
    smooth = [int(row) for row in rows if row not in open_]
    if not smooth:
        return
    parts = [_starts(orbit, row) for row in smooth]
    wide, each = max(part.shape[-1] for part in parts), len(SIZES) * PHASES
    few = HARMONICS * round(turning.period / np.pi)
    starts = np.concatenate([padded(one, wide) for one in parts])
    led, _fine = _sums(turning, np.repeat(smooth, each), starts, HarmonicBalance(harmonics=few, most=few))
    begun = [_unlike(led[k * each : (k + 1) * each]) for k in range(len(smooth))]
    own = np.repeat(np.arange(len(smooth)), [len(one) for one in begun])
    how = HarmonicBalance(harmonics=few, most=MOST)
    waves, fine = _sums(turning, np.asarray(smooth)[own], np.concatenate(begun), how)
    for k, row in enumerate(smooth):
        yield row, [Run(wave=one) for one in waves[fine & (own == k)]]


def _sums(turning: Turning, rows: Array, starts: Array, how: HarmonicBalance) -> tuple[Array, Array]:
    """Return where sums (b, R, H+1) of some of the drives lead, nan where nowhere, and which are fine enough (b,)."""
    parts = [sums_of(turning.part(rows[k : k + CHUNK]), starts[k : k + CHUNK], how) for k in range(0, len(rows), CHUNK)]
    wide = max([starts.shape[-1], *(part.coefficient.shape[-1] for part in parts)])
    sums = np.concatenate([padded(starts[:0], wide), *[padded(part.coefficient, wide) for part in parts]])
    return sums, np.concatenate([np.zeros(0), *[part.status for part in parts]]) == Status.CONVERGED


def _unlike(sums: Array) -> Array:
    """Return those of sums (b, R, H+1) that were found and unlike each other."""
    found: list[Array] = []
    for one in sums[np.isfinite(sums).all(axis=(-1, -2))]:
        if not any(near(one, other, ALIKE) for other in found):
            found.append(one)
    return np.asarray(found).reshape(len(found), *sums.shape[1:])


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
        if any(near(one, other, ALIKE) for other in begun):
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
        if part.model.free:
            how = HarmonicBalance(harmonics=one.shape[-1] - 1, most=one.shape[-1] - 1)
            alone = replace(alone, force=sums_of(part, one[None], how).force)
        if floquet(alone).verdict[0] == Verdict.STABLE:
            yield alone


def settled_judgement(orbit: Orbit, status: Array, judged: Floquet, rows: Array | None = None) -> Floquet:
    """Return how stable motions (b,) are, those that are the middle one of three replaced by a stable one beside it.

    status, judged (b,): of the motions; many at a time are left as they are, see `LOOKED`.
    rows (k,) of int: which of the middle ones to look at; all by default.
    """
    asked = np.flatnonzero(middle_ones(orbit, judged)) if rows is None else rows
    if not asked.size or asked.size > LOOKED:
        return judged
    own = _some(orbit, asked)
    others = stable_motions(own, np.ravel(status)[asked], grow=True)[0]
    moved = np.flatnonzero(np.any(others.coefficient != padded(own.coefficient, others.coefficient.shape[-1]), (1, 2)))
    if not moved.size:
        return judged
    again = floquet(_some(others, moved))
    good = np.flatnonzero(again.verdict == Verdict.STABLE)
    return replaced(judged, asked[moved[good]], again, good) if good.size else judged


def _some(orbit: Orbit, rows: Array) -> Orbit:
    """Return smooth motions of some of the drives."""
    part = orbit.turning.part(rows)
    own = orbit.coefficient.reshape(orbit.count, *orbit.coefficient.shape[-2:])[rows]
    return Orbit(
        model=part.model, speed=part.speed, period=part.period, coefficient=own, force=np.ravel(orbit.force)[rows]
    )


def _alone(orbit: Orbit, row: int) -> Orbit:
    """Return the motion of one drive."""
    coefficient = orbit.coefficient.reshape(orbit.count, *orbit.coefficient.shape[-2:])[row]
    pieces = {0: orbit.pieces[row]} if row in orbit.pieces else {}
    return _of_one(orbit.turning.part(np.asarray([row])), coefficient, pieces)


def _of_one(part: Turning, coefficient: Array, pieces: dict[int, Pieces]) -> Orbit:
    """Return a motion (R, H+1) of one drive, without the force of a free one."""
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
        if not any(near(one.coefficient[0], other.coefficient[0], SAME) for other in found):
            found.append(one)
    return found


def _extremes(orbit: Orbit) -> dict[str, Array]:
    """Return lowest and highest torques of the one motion of an orbit, arrays (E,)."""
    found = read_off(orbit, 1)
    return {"lowest": found.lowest[0], "highest": found.highest[0]}
