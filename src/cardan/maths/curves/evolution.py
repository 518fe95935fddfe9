"""A search for the best place of a box where there may be many good ones: differential evolution, many at once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from cardan.maths.arrays import Array

Cost: TypeAlias = Callable[[Array, Array], Array]
"""From places (D, v) and the costs to beat (D,) to costs (D,): a cost above the one to beat need not be exact."""

Progress: TypeAlias = Callable[[float], object]
"""Told the share done; may answer "stop"."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Evolution:
    """How to search everywhere: differential evolution.

    Attributes
    ----------
    size : int or None
        Places kept; ten for each unknown, at least 16, when not given.
    rounds : int
        Generations at most.
    runs : int
        Independent searches; that they agree is the evidence.
    tolerance : float
        A run ends where its places differ by less than this share of the box, or its costs by that of the smallest.
    seed : int
        Of the random numbers: the same seed gives the same answer.
    """

    size: int | None = None
    rounds: int = 40
    runs: int = 2
    tolerance: float = 0.01
    seed: int = 0


@dataclass(frozen=True, eq=False, kw_only=True)
class Evolved:
    """What a search found."""

    place: Array  # (v,): the best, in the unit box
    cost: float
    run_places: Array  # (r, v): best place of every run
    run_costs: Array  # (r,)
    # tuple of r arrays (g,): smallest cost after every generation of a run, its beginning first
    history: tuple[Array, ...]
    evaluations: int
    converged: bool  # whether every run ended by itself
    cancelled: bool


def evolve(
    cost: Cost,
    unknowns: int,
    *,
    start: Array | None = None,
    method: Evolution | None = None,
    progress: Progress | None = None,
) -> Evolved:
    """Return the place in the unit box of the smallest cost, sought everywhere.

    cost: a `Cost`; unknowns: v; start (v,): a place to begin with beside those at random.
    progress: told the share done; when it answers "stop" the best so far is returned.
    Storn and Price: best/1/bin and rand/1/bin by turns, weight 0.5 to 0.9 anew each generation, crossing 0.8, spread
    begin (Latin hypercube).
    """
    how = method or Evolution()
    size = how.size or max(16, 10 * unknowns)
    runs = [
        _Run(np.random.default_rng((how.seed, run)), size, unknowns, start if run == 0 else None)
        for run in range(how.runs)
    ]
    stopped = False
    for number, run in enumerate(runs):
        run.begin(cost)
        for generation in range(how.rounds):
            if progress is not None:
                stopped = progress((number + generation / how.rounds) / how.runs) == "stop"
            if stopped or run.settled(how.tolerance):
                break
            run.step(cost, generation)
        if stopped:
            runs = runs[: number + 1]
            break
    best = min(runs, key=lambda run: run.least)
    return Evolved(
        place=best.best,
        cost=best.least,
        run_places=np.stack([run.best for run in runs]),
        run_costs=np.asarray([run.least for run in runs]),
        history=tuple(np.asarray(run.history) for run in runs),
        evaluations=sum(run.asked for run in runs),
        converged=not stopped and all(run.settled(how.tolerance) for run in runs),
        cancelled=stopped,
    )


class _Run:
    """One search."""

    def __init__(self, random: np.random.Generator, size: int, unknowns: int, start: Array | None) -> None:
        self.random = random
        cells = np.stack([random.permutation(size) for _k in range(unknowns)], axis=-1)
        self.places = (cells + random.uniform(size=(size, unknowns))) / size
        if start is not None:
            self.places[0] = np.clip(start, 0.0, 1.0)
        self.costs = np.full(size, np.inf)
        self.history: list[float] = []
        self.asked = 0

    @property
    def best(self) -> Array:
        found: Array = self.places[int(np.argmin(self.costs))]
        return found

    @property
    def least(self) -> float:
        return float(np.min(self.costs))

    def begin(self, cost: Cost) -> None:
        self.costs = cost(self.places, self.costs)
        self.asked += len(self.places)
        self.history.append(self.least)

    def step(self, cost: Cost, generation: int) -> None:
        size, unknowns = self.places.shape
        weight = self.random.uniform(0.5, 0.9)
        others = np.stack([self.random.permutation(np.delete(np.arange(size), k))[:3] for k in range(size)])
        one, two, three = (self.places[others[:, k]] for k in range(3))
        base = self.best if generation % 2 else one
        mutant = base + weight * (two - three)
        kept = self.random.uniform(size=(size, unknowns)) < 0.8
        kept[np.arange(size), self.random.integers(unknowns, size=size)] = True
        trial = np.where(kept, mutant, self.places)
        trial = np.abs(trial)  # back into the box, as from a mirror
        trial = np.clip(1.0 - np.abs(1.0 - trial), 0.0, 1.0)
        costs = cost(trial, self.costs)
        self.asked += size
        better = costs <= self.costs
        self.places = np.where(better[:, None], trial, self.places)
        self.costs = np.where(better, costs, self.costs)
        self.history.append(self.least)

    def settled(self, tolerance: float) -> bool:
        wide = float(np.max(np.ptp(self.places, axis=0)))
        least, most = self.least, float(np.max(self.costs))
        return wide < tolerance or (np.isfinite(most) and most - least <= tolerance * abs(least))
