"""The search behind `calm`: every combination or the last steps, and the curves before and after."""

from __future__ import annotations

import contextlib
from dataclasses import dataclass
from itertools import product
from math import prod
from typing import TypeAlias

import numpy as np

from cardan.drive.drive import Drive
from cardan.errors import Problem
from cardan.maths.arrays import Array
from cardan.maths.curves.evolution import Evolution, Evolved
from cardan.questions.torsion.absorber.absorber_search import highest
from cardan.questions.torsion.absorber.band import about_peaks, fine_speeds, lines, unstable_speeds
from cardan.questions.torsion.absorber.least_swing import LeastSwing, Stopped, Watch, Watched
from cardan.questions.torsion.steady.torsion_response import Progress
from cardan.texts import _

from .calm_designs import Designs, Free

MOST = 200_000
"""Designs that an exhaustive search may have at most."""

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
    if not loose.any() or drive is None:
        return start, least

    def whole(places: Array) -> Array:
        found = np.tile(start, (len(places), 1))
        found[:, loose] = places
        return found

    def swings(places: Array, speed: Array) -> Array:
        designs.asked += len(places)
        return designs.swings(whole(places), speed)

    def closer(at: Array) -> Array:
        here = designs.drive_at(whole(at[None])[0])
        return fine_speeds(designs.band, [designs.built if here is None else lines([here], designs.middle)])

    first = designs.speeds(lines([drive], designs.middle))[0]
    watched = Watched(progress=progress, expected=EXPECTED * int(np.sum(loose)))
    search = LeastSwing(swings, first, closer if len(first) > 1 else None, watched)
    with contextlib.suppress(Stopped):
        search.run(start[loose][None])
    if not search.best.size:
        return start, least
    better = whole(search.best[None])
    cost = float(designs.cost(better, np.full(1, least))[0])
    return (better[0], cost) if cost < least else (start, least)


class Curves:
    """What the drive as built and another do over the band."""

    def __init__(self, designs: Designs, drive: Drive) -> None:
        both = (designs.built, lines([drive], designs.middle))
        rough = fine_speeds(designs.band, both)
        closer = [rough]
        for line in both:
            peak = np.max(line.swings(rough[None]).swing[:, designs.elements], axis=-1)
            closer.append(about_peaks(rough, peak))
        self.speed = np.unique(np.concatenate(closer))
        runs = [line.swings(self.speed[None]) for line in both]
        self.swing = [found.swing[:, line.elements] for found, line in zip(runs, both, strict=True)]
        self.peaks = [_peak(one, self.speed, designs.elements) for one in self.swing]
        self.unstable = [unstable_speeds(found, line.omega, self.speed) for found, line in zip(runs, both, strict=True)]
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
