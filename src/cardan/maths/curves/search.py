"""Searches for the best place: of a box with many good ones, and where the largest of curves is smallest."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
import scipy

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


# The place at which the largest of many curves is smallest.

Curves: TypeAlias = Callable[[Array], Array]
"""From places (D, v) in the unit box to values (D, K), finite; each row may be asked many at a time."""

STEP = 1e-4
"""Step of the difference quotients, share of the box."""

ROUNDS = 40
"""Steps of the local search at most."""


GAIN = 1e-4
"""Share by which a place must be better to be worth a step."""

IDLE = 6
"""Places in a row that are not, after which the local search ends: at a corner of the curves it would go on."""


class _EndedError(Exception):
    """Nothing more is to be gained."""


@dataclass(frozen=True, eq=False, kw_only=True)
class LeastPeak:
    """Where the largest of many curves is smallest."""

    place: Array  # (v,): in the unit box
    peak: float  # largest value there
    evaluations: int  # places asked for
    converged: bool  # whether the search ended by itself


def least_peak(curves: Curves, start: Array) -> LeastPeak:
    """Return the place in the unit box near a start at which the largest of many smooth curves is smallest.

    curves: values at places; start (v,).
    min t under t ≥ f_k(x) for all k, by sequential quadratic programming; slopes by differences, asked all at once.

    Two parabolas, highest where they cross:

    >>> found = least_peak(lambda x: np.stack([(x[:, 0] - 0.1) ** 2, (x[:, 0] - 0.7) ** 2], axis=-1), np.asarray([0.9]))
    >>> found.place, round(found.peak, 6)
    (array([0.4]), 0.09)
    """
    asked = idle = 0
    last: dict[bytes, tuple[Array, Array]] = {}
    best, least = np.clip(start, 0.0, 1.0), np.inf

    def known(z: Array) -> tuple[Array, Array]:
        nonlocal asked, idle, best, least
        x = np.clip(z[:-1], 0.0, 1.0)
        key = x.tobytes()
        if key not in last:
            step = np.where(x > 0.5, -STEP, STEP)
            values = curves(np.concatenate([x[None], x + np.diag(step)]))
            asked += len(values)
            peak = float(np.max(values[0]))
            idle = 0 if peak < least * (1.0 - GAIN) else idle + 1
            if peak < least:
                best, least = x, peak
            if idle > IDLE:
                raise _EndedError
            last.clear()
            last[key] = values[0], ((values[1:] - values[0]) / step[:, None]).T
        return last[key]

    size = float(np.max(known(np.append(best, 0.0))[0])) or 1.0

    def room(z: Array) -> Array:
        return z[-1] - known(z)[0] / size

    def slope(z: Array) -> Array:
        joint_angle = known(z)[1]
        return np.column_stack([-joint_angle / size, np.ones(len(joint_angle))])

    count = len(start)
    solve: Any = scipy.optimize.minimize
    try:
        ended = solve(
            lambda z: float(z[-1]),
            np.append(best, 1.0),
            jac=lambda z: np.append(np.zeros(count), 1.0),
            method="SLSQP",
            bounds=[(0.0, 1.0)] * count + [(None, None)],
            constraints=[{"type": "ineq", "fun": room, "jac": slope}],
            options={"maxiter": ROUNDS, "ftol": 1e-5},
        )
        converged = bool(ended.success)
    except _EndedError:
        converged = True
    return LeastPeak(place=best, peak=least, evaluations=asked, converged=converged)
