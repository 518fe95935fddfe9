"""With which yokes, stiffnesses, inertias and joint positions does a drive vibrate least in torsion over a band?"""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from math import prod
from typing import TypeAlias

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.errors import Problem, check, refuse
from cardan.maths.arrays import Array
from cardan.maths.curves.search import Evolution, Evolved, evolve
from cardan.questions.torsion.absorber.absorber_search import highest
from cardan.questions.torsion.absorber.band import (
    FINE,
    FINER,
    LeastSwing,
    Lines,
    Stopped,
    Watch,
    Watched,
    about_peaks,
    band_speeds,
    element_problems,
    fine_speeds,
    growth,
    lines,
    unstable_speeds,
    wanted_band,
)
from cardan.questions.torsion.stability.proved_speeds import ProvedSpeeds
from cardan.questions.torsion.stability.torsion_stability import proved_in_band
from cardan.questions.torsion.steady.alternating_torque import exactly, exactly_where_high
from cardan.questions.torsion.steady.torsion_response import Progress
from cardan.texts import _

from .designs import Designs, Free, free_quantities
from .modal_excitation import NodeRule, node_rules
from .spread import Spread, spreads

SHARES = (0.8, 0.92)
"""Shares of the work when the search everywhere ends, and when the last steps do."""


@dataclass(frozen=True, eq=False, kw_only=True)
class OptimisedTorsion:
    """A drive whose torques swing least over a band of speeds.

    Attributes
    ----------
    drive : Drive
        With the best values.
    free : tuple of v Free
        What was allowed to change.
    values : mapping of str to float
        Best values by their paths, in the unit of the path.
    elements : tuple of E str
        Names of the elements of the drive.
    judged : tuple of int
        Those whose torque was made small, from 0.
    speed : array (s,) [rad/s]
        Of the input.
    before, after : arrays (s, E) [N·m]
        Swing of the torque of every element as built and with the best values.
    peak_before, peak_after : Peak
    unstable_before, unstable_after : arrays (k,) [rad/s]
        Speeds, of those looked at, at which a small disturbance grows.
    rules_before, rules_after : tuple of NodeRule
        What the joints do to the modes whose resonances matter in the band: the explanation.
    method : Evolution or Grid
    evaluations : int
        Designs whose exact response was asked for over the band.
    infeasible : int
        Values that made no drive.
    run_peaks : array (r,) [N·m]
        Largest swing at the end of every independent run, its last steps done, as the search saw it.
    history : tuple of r arrays (g,) [N·m]
        The same after every generation.
    converged : bool
        Whether every run ended by itself.
    cancelled : bool
        Whether the search was stopped; the best so far stands here.
    play : bool
        Whether the drive has play: it counts as closed here.
    assumed : tuple of str
        Paths of what the drive does not say.
    off : tuple of Spread
        Tolerances for which it was searched.
    worst_before, worst_after : Worst or None
        The worst within them as built and with the best values; None without tolerances.
    exact, together : bool
        Whether torques and stability count orders that do not repeat within two turns by the motion with them at all
        speeds looked at; torques do so to first order elsewhere, and stability does not.
    proof : ProvedSpeeds or None
        Where in the band the drive with the best values is unstable, and whether that is proved to be all; None for a
        single speed.
    limited : (float, float) or None
        Largest share of a limit used as built and with the best values, at the worst of the tolerances; None where no
        limits were given.
    """

    drive: Drive
    free: tuple[Free, ...]
    values: Mapping[str, float]
    elements: tuple[str, ...]
    judged: tuple[int, ...]
    speed: Array
    before: Array
    after: Array
    peak_before: Peak
    peak_after: Peak
    unstable_before: Array
    unstable_after: Array
    rules_before: tuple[NodeRule, ...]
    rules_after: tuple[NodeRule, ...]
    method: Method
    evaluations: int
    infeasible: int
    run_peaks: Array
    history: tuple[Array, ...]
    converged: bool
    cancelled: bool
    play: bool
    assumed: tuple[str, ...]
    off: tuple[Spread, ...] = ()
    worst_before: Worst | None = None
    worst_after: Worst | None = None
    limited: tuple[float, float] | None = None
    exact: bool = True
    together: bool = True
    proof: ProvedSpeeds | None = None

    @property
    def reduction(self) -> float:
        """Peak with the best values over the peak as built."""
        return self.peak_after.torque / self.peak_before.torque if self.peak_before.torque else 1.0

    @property
    def agreement(self) -> float:
        """By how much the runs differ at their end, over the best of them; nan with a single run."""
        if len(self.run_peaks) < 2:
            return float("nan")
        return float(np.ptp(self.run_peaks) / np.min(self.run_peaks))

    @property
    def at_limits(self) -> tuple[str, ...]:
        """Paths whose best value lies at an end of its range: a wider range may do more."""
        found = []
        for one in self.free:
            slack = 1e-3 * (one.high - one.low) if one.step is None else 0.5 * one.step
            value = self.values[one.path]
            if "yoke" not in one.path and min(value - one.low, one.high - value) <= slack:
                found.append(one.path)
        return tuple(found)


def optimise_torsion(
    drive: Drive,
    duty: Duty | None = None,
    free: Mapping[str, Sequence[float]] | None = None,
    *,
    speeds: tuple[float, float] | None = None,
    elements: Sequence[int] | None = None,
    method: Method | None = None,
    tolerances: Mapping[str, float | str] | None = None,
    used: Callable[[Drive], float] | None = None,
    progress: Progress | None = None,
) -> OptimisedTorsion:
    """Return the values of a drive with which its largest swing of a torque over a band of speeds is smallest.

    drive: with bodies or inertias and stiffnesses of its shafts, or `[[stations]]`, and some damping.
    free, mapping of str to (low, high) or (low, high, step): path -> range in the unit of the path, as
    ``{"shafts[1].yoke_angle_deg": (-90, 90)}``; with a step only every such value from the lowest can be made. By
    default the yoke angles that are not fixed, in the steps of their splines.
    speeds [rad/s]: band of input speeds; that of the duty by default, else its speed alone.
    elements: elements of the drive whose torque is judged, from 0; all by default.
    method: how to search everywhere; differential evolution by default.
    tolerances: path -> how far its value may be off to either side as made, in the unit of the path or as a share
    ``"5%"``: stiffness, damping, angles. Every design then counts as the worst that it may be.
    used: the largest share of a limit that a drive uses; a design that uses more than 1 counts as worse than any other.
    progress: told the share done; when it answers "stop" the best so far is returned as cancelled.

    Every design runs on the exact equations at evenly spread speeds and about its own resonances, many designs in one
    harmonic balance; one that would be the best but is unstable amid a zone of parametric resonance counts as worse
    than any stable one. With tolerances the worst of the drive as drawn and of all corners counts; a place within them
    that turns out worse joins these, and the search is done again: J. W. Blankenship and J. E. Falk, Journal of
    Optimization Theory and Applications 19 (1976). From the best, values without steps are refined by sequential
    quadratic programming, peaks between the speeds met on the way.
    """
    asked = drive if duty is None else replace(drive, duty=duty)
    band = wanted_band(asked.duty, speeds)
    if band is None:
        raise refuse("duty.speed_range", _("missing; the band of speeds in which torsional vibration is to be least"))
    how = method or Evolution()
    quantities = free_quantities(asked, free)
    check([*method_problems(how, quantities), *element_problems(lines([asked], 0.5 * (band[0] + band[1])), elements)])
    judged = None if elements is None else np.asarray(elements, dtype=int)
    designs = Designs(asked, quantities, band, judged, spreads(asked, tolerances), used)
    watch = Watch(progress)
    for done in range(EXCHANGES):
        rounds = EXCHANGES if designs.off else 1
        start, end = done / rounds, (done + 1) / rounds
        everywhere_told = watch.part(start, start + SHARES[0] * (end - start))
        if isinstance(how, Grid):
            found = everywhere(designs, how, everywhere_told)
        else:
            found = evolve(designs.cost, len(quantities), start=designs.start, method=how, progress=everywhere_told)
        places, costs = found.run_places, found.run_costs
        if not watch.stopped:
            told = watch.part(*(start + one * (end - start) for one in SHARES))
            places, costs = all_refined(designs, found, told)
        best = places[_best(designs, places, costs)]
        if watch.stopped or not designs.off or not _worse_within(designs, best):
            break
    chosen = designs.drive_at(best, made=True) if np.min(costs) < np.inf else asked
    chosen = asked if chosen is None else chosen
    curves = Curves(designs, chosen)
    worst = (worst_of(designs, asked), worst_of(designs, chosen)) if designs.off else None
    limited = None if used is None else (designs.share_used(asked), designs.share_used(chosen))
    if not _calmer(curves, worst, limited):  # as built it runs calmest
        chosen, best = asked, None
        curves = Curves(designs, chosen)
        worst = None if worst is None else (worst[0], worst[0])
        limited = None if limited is None else (limited[0], limited[0])
    watch.share(1.0)
    rules = [_rules(one, band) for one in (designs.built, lines([chosen], designs.middle))]
    return OptimisedTorsion(
        drive=chosen,
        free=quantities,
        values={one.path: one.built for one in quantities} if best is None else designs.made(best),
        elements=designs.built.element_names,
        judged=tuple(int(k) for k in designs.elements),
        speed=curves.speed,
        before=curves.swing[0],
        after=curves.swing[1],
        peak_before=curves.peaks[0],
        peak_after=curves.peaks[1],
        unstable_before=curves.unstable[0],
        unstable_after=curves.unstable[1],
        rules_before=rules[0],
        rules_after=rules[1],
        method=how,
        evaluations=designs.asked,
        infeasible=designs.infeasible,
        run_peaks=costs,
        history=found.history,
        converged=found.converged,
        cancelled=watch.stopped,
        play=designs.built.play,
        assumed=designs.built.trains[0].assumed,
        off=designs.off,
        worst_before=None if worst is None else worst[0],
        worst_after=None if worst is None else worst[1],
        limited=limited,
        exact=curves.exact,
        together=curves.together,
        proof=proved_in_band(chosen, float(curves.speed[0]), float(curves.speed[-1])),
    )


def _best(designs: Designs, places: Array, costs: Array) -> int:
    """Return which of the ends (r, v) of searches costs least, those last that torques that do not repeat make grow."""
    order: list[int] = np.argsort(costs, kind="stable").tolist()
    return next((k for k in order if not designs.grows(places[k])), order[0])


def _calmer(curves: Curves, worst: tuple[Worst, Worst] | None, limited: tuple[float, float] | None) -> bool:
    """Tell whether another drive than the one as built keeps its limits better, or as well and runs calmer."""
    over = (0.0, 0.0) if limited is None else tuple(max(one, 1.0) for one in limited)
    if over[0] != over[1]:
        return over[1] < over[0]
    if worst is None:
        return curves.calmer
    before, after = ((one.unstable, one.torque) for one in worst)
    return after < before


def _worse_within(designs: Designs, at: Array) -> bool:
    """Tell whether a place (v,) is worse within its tolerances than at their corners; take what is to them."""
    drive = designs.drive_at(at)
    if drive is None:
        return False
    here = worst_of(designs, drive)
    within = np.random.default_rng(0).uniform(-1.0, 1.0, (WITHIN, len(designs.off)))
    other = worst_of(designs, drive, sides=list(within))
    if not (other.torque > here.torque * (1.0 + WORSE) or (other.unstable and not here.unstable)):
        return False
    designs.sides.append(np.asarray(other.sides))
    return True


def _rules(line: Lines, band: tuple[float, float]) -> tuple[NodeRule, ...]:
    """Return what joints do to the modes that their main order or its parametric resonance meets in the band.

    To the slowest mode where the band meets none.
    """
    every = node_rules(line.trains[0], speed=line.speed)
    met = [one for one in every if any(band[0] <= k * one.omega / one.order <= band[1] for k in (1.0, 2.0))]
    return tuple(met or every[:1])


# The search behind `optimise_torsion`: every combination or the last steps, and the curves before and after.

MOST = 200_000
"""Designs that an exhaustive search may have at most."""

EXCHANGES, WITHIN, WORSE = 3, 64, 0.01
"""Searches at most until no place within the tolerances is worse than those that the search counts, the places that are
looked at, and by how much worse one must be."""

PART = 64
"""Designs of an exhaustive search that are solved at once."""

EXPECTED = 25
"""Designs that the last steps of a search take for each unknown, about."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Grid:
    """How to search everywhere: every combination.

    Attributes
    ----------
    points : int
        Values of every quantity; of one with steps all of them are taken.
    """

    points: int = 11


Method: TypeAlias = Evolution | Grid


@dataclass(frozen=True, kw_only=True, slots=True)
class Peak:
    """Largest swing of a torque in the band."""

    torque: float  # [N·m]: half of highest less lowest
    speed: float  # [rad/s]
    element: int  # from 0 in `Calm.elements`


@dataclass(frozen=True, kw_only=True, slots=True)
class Worst:
    """The worst that a drive may be within its tolerances."""

    torque: float  # [N·m]: half of highest less lowest
    speed: float  # [rad/s]
    element: int  # from 0
    sides: tuple[float, ...]  # by how much of each tolerance it is off there, from -1 to 1
    unstable: bool  # whether a small disturbance grows anywhere within them


def worst_of(designs: Designs, drive: Drive, *, sides: Sequence[Array] | None = None) -> Worst:
    """Return the worst of a drive at the corners of its tolerances, or at places within them, each of (k,)."""
    places = list(designs.sides) if sides is None else list(sides)
    found = Worst(torque=0.0, speed=designs.middle, element=0, sides=(0.0,) * len(designs.off), unstable=False)
    for (_rows, which), line in designs.builds([drive], places):
        speed = band_speeds(*designs.band, line.omega, designs.orders, count=FINE, beside=FINER)
        run = exactly_where_high(line.swings(speed), len(which), designs.elements)
        grown = growth(run, speed, line.omega, np.ones(len(which), dtype=bool))
        table = run.swing.reshape(*speed.shape, -1)
        peaks = [highest(one, at, designs.elements) for one, at in zip(table, speed, strict=True)]
        k = int(np.argmax([torque for torque, _at, _element in peaks]))
        torque, at, element = peaks[k]
        unstable = found.unstable or bool(np.any(grown > 0.0))
        if torque > found.torque:
            off = tuple(float(one) for one in places[int(which[k])])
            found = Worst(torque=torque, speed=at, element=element, sides=off, unstable=unstable)
        else:
            found = replace(found, unstable=unstable)
    return found


def method_problems(method: Method, free: tuple[Free, ...]) -> list[Problem]:
    """Return what is wrong with a way to search."""
    if not isinstance(method, Grid):
        wrong = [name for name in ("rounds", "runs") if getattr(method, name) < 1]
        wrong += ["size"] if method.size is not None and method.size < 4 else []
        text = _("{given} given; at least {least}")
        return [
            Problem(f"method.{name}", text.format(given=getattr(method, name), least=4 if name == "size" else 1))
            for name in wrong
        ]
    if method.points < 2:
        return [Problem("method.points", _("{given} given; at least 2").format(given=method.points))]
    count = prod(len(one.places(method.points)) for one in free)
    if count > MOST:
        text = _("{count:,} designs; at most {most:,} are done")
        message = text.format(count=count, most=MOST).replace(",", "\u202f")
        return [Problem("method.points", message)]
    return []


def everywhere(designs: Designs, method: Grid, progress: Progress) -> Evolved:
    """Return the best of every combination."""
    table = np.asarray(list(product(*(one.places(method.points) for one in designs.free))))
    best, least, told = table[0], np.inf, []
    stopped = False
    for first in range(0, len(table), PART):
        rows = table[first : first + PART]
        cost = designs.cost(rows, np.full(len(rows), least))
        if float(np.min(cost)) < least:
            best, least = rows[int(np.argmin(cost))], float(np.min(cost))
        told.append(least)
        stopped = progress(min(first + PART, len(table)) / len(table)) == "stop"
        if stopped:
            break
    return Evolved(
        place=best,
        cost=least,
        run_places=best[None],
        run_costs=np.asarray([least]),
        history=(np.asarray(told),),
        evaluations=designs.asked,
        converged=not stopped,
        cancelled=stopped,
    )


def all_refined(designs: Designs, found: Evolved, progress: Progress) -> tuple[Array, Array]:
    """Return the places of all runs after their last steps, array (r, v), and their costs (r,) [N·m]."""
    watch, count = Watch(progress), len(found.run_places)
    runs = zip(found.run_places, found.run_costs, strict=True)
    ends = [
        _refined(designs, at, float(cost), watch.part(k / count, (k + 1) / count)) for k, (at, cost) in enumerate(runs)
    ]
    return np.stack([at for at, _cost in ends]), np.asarray([cost for _at, cost in ends])


def _refined(designs: Designs, start: Array, least: float, progress: Progress) -> tuple[Array, float]:
    """Return a better place near one of a cost, values with steps kept; the same where none is better and stable."""
    loose = np.asarray([one.step is None for one in designs.free])
    drive = designs.drive_at(start)
    if drive is None:
        return start, least
    if designs.nonsynchronous:  # which the search everywhere counts to first order
        least = float(designs.cost(start[None], np.full(1, np.inf), closely=True)[0])
    if not loose.any():
        return start, least

    def whole(places: Array) -> Array:
        found = np.tile(start, (len(places), 1))
        found[:, loose] = places
        return found

    def swings(places: Array, speed: Array) -> Array:
        designs.asked += len(places)
        return designs.swings(whole(places), speed)

    def closer(at: Array) -> Array:
        here = [one for _rows, one in designs.builds([designs.drive_at(whole(at[None])[0])])]
        return np.unique(np.concatenate([fine_speeds(designs.band, [one]) for one in here or [designs.built]]))

    first = np.unique(np.concatenate([np.ravel(designs.speeds(one)) for _rows, one in designs.builds([drive])]))
    watched = Watched(progress=progress, expected=EXPECTED * int(np.sum(loose)))
    search = LeastSwing(swings, first, closer if len(first) > 1 else None, watched)
    with contextlib.suppress(Stopped):
        search.run(start[loose][None])
    if not search.best.size:
        return start, least
    better = whole(search.best[None])
    cost = float(designs.cost(better, np.full(1, least), closely=designs.nonsynchronous)[0])
    return (better[0], cost) if cost < least else (start, least)


class Curves:
    """What the drive as built and another do over the band."""

    def __init__(self, designs: Designs, drive: Drive) -> None:
        both = (designs.built, lines([drive], designs.middle))
        rough = fine_speeds(designs.band, both)
        closer = [rough]
        for line in both:
            found = exactly_where_high(line.swings(rough[None]), 1, designs.elements)
            closer.append(about_peaks(rough, np.max(found.swing[:, designs.elements], axis=-1)))
        self.speed = np.unique(np.concatenate(closer))
        runs, known = zip(*(exactly(line.swings(self.speed[None])) for line in both), strict=True)
        self.swing = [found.swing[:, line.elements] for found, line in zip(runs, both, strict=True)]
        self.peaks = [_peak(one, self.speed, designs.elements) for one in self.swing]
        judged = [unstable_speeds(found, line.omega, self.speed) for found, line in zip(runs, both, strict=True)]
        self.unstable = [speeds for speeds, _together in judged]
        self.exact = bool(np.all(np.concatenate(known)))
        self.together = all(together for _speeds, together in judged)
        self.lost = [int(np.sum(~found.found)) for found in runs]

    @property
    def calmer(self) -> bool:
        """Whether the other drive runs calmer than the one as built: by stability, by motions found, by its peak."""
        before, after = (
            (bool(grown.size), lost, peak.torque)
            for grown, lost, peak in zip(self.unstable, self.lost, self.peaks, strict=True)
        )
        return after < before


def _peak(swing: Array, speed: Array, elements: Array) -> Peak:
    torque, at, element = highest(swing, speed, elements)
    return Peak(torque=torque, speed=at, element=element)
