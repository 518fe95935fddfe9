"""The best point: near a start, or anywhere in a box, over the same fields and questions as a sweep."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Literal, TypeAlias

import numpy as np
import scipy

from cardan.batch.points.distributions import uniforms
from cardan.batch.work import STATUS, Column, Rows
from cardan.errors import Problem, check
from cardan.maths.arrays import Array
from cardan.texts import _

from .goals import Evaluator, Goal, Limit, Progress, StoppedError, check_names, excess, tell

KEPT = 1e-9  # a limit is kept if it is passed by no more than this share of it
LOST = 1e100  # cost of a point that breaks a limit, times one plus its excess: all that keep them are better
UNANSWERED = 1e6  # excess of a point without an answer
Bounds: TypeAlias = Sequence[tuple[float, float]]  # ends of each field's range, in the unit of its column

Ending: TypeAlias = Literal["converged", "not converged", "nothing found", "cancelled"]


@dataclass(frozen=True, kw_only=True, slots=True)
class Local:
    """Downhill from a start, without slopes, by quadratic models (COBYQA).

    Attributes
    ----------
    start : tuple of float
        Where to begin; the middle of the box when empty.
    accuracy : float
        Share of the box to which the place is found.
    most : int
        Points asked at most.
    """

    start: tuple[float, ...] = ()
    accuracy: float = 1e-6
    most: int = 2000


@dataclass(frozen=True, kw_only=True, slots=True)
class Global:
    """All over the box by differential evolution, then downhill from the best.

    Attributes
    ----------
    seed : int
        The same finds the same.
    population : int
        Points of a generation, for each field.
    generations : int
        At most.
    spread : float
        The search has converged when the costs of a generation differ by this share, or by ``least``.
    least : float
        Difference of costs, in the unit of the goal, that is none.
    finish : Local
        How the best is bettered at last.
    """

    seed: int = 0
    population: int = 12
    generations: int = 200
    spread: float = 1e-4
    least: float = 1e-9
    finish: Local = field(default_factory=Local)


@dataclass(frozen=True, eq=False, kw_only=True)
class Optimum:
    """The best point that was found.

    Attributes
    ----------
    fields, answers : tuple of Column
        What varied, and what was asked.
    goal : Goal
    limits : tuple of Limit
    point : array (d,)
        In the units of the fields; nan where nothing was found.
    values : mapping of str to float
        The answers there.
    excess : float
        How far the worst limit is passed, a share of it; not above 0 where all are kept.
    evaluations : int
        Points asked.
    history : array (k, 2)
        Points asked and best value, whenever it became better.
    accuracy : float
        Share of the box to which the place was to be found.
    status : str
        "converged"; "not converged": better ones may be near; "nothing found": no point keeps the limits;
        "cancelled".
    """

    fields: tuple[Column, ...]
    answers: tuple[Column, ...]
    goal: Goal
    limits: tuple[Limit, ...]
    point: Array
    values: dict[str, float]
    excess: float
    evaluations: int
    history: Array
    status: Ending
    accuracy: float = 0.0

    @property
    def value(self) -> float:
        """The goal there, in the unit of its column."""
        return self.values.get(self.goal.name, math.nan)

    @property
    def uncertainty(self) -> float:
        """By how much the goal may differ where the place does by its accuracy, in its unit.

        From the best of what was asked first to the best of all the goal changes over a good part of the box; where
        it ends in a tip, as the speed fluctuation does at nought, it changes evenly down to the last.
        """
        return float(self.accuracy * np.ptp(self.history[:, 1])) if len(self.history) else 0.0

    @property
    def feasible(self) -> bool:
        """Whether all limits are kept there."""
        return self.excess <= KEPT


class _Search:
    """Asks at points of the unit box and remembers the best."""

    def __init__(
        self, ask: Evaluator, bounds: Bounds, goal: Goal, limits: Sequence[Limit], most: int, progress: Progress | None
    ) -> None:
        self.ask, self.goal, self.limits = ask, goal, tuple(limits)
        self.low = np.asarray([low for low, _high in bounds], dtype=float)
        self.width = np.asarray([high - low for low, high in bounds], dtype=float)
        self.most, self.progress = most, progress
        self.count = 0
        self.best: tuple[bool, float] = (True, math.inf)
        self.point = np.full(len(bounds), math.nan)
        self.values: dict[str, float] = {}
        self.over = math.inf
        self.history: list[tuple[float, float]] = []
        self.last: tuple[bytes, float, Array] = (b"", math.nan, np.empty(0))

    def costs(self, shares: Array) -> tuple[Array, Array, Rows]:
        """Return costs and excesses (n,) at places (n, d) of the unit box, and all answers."""
        points = np.clip(self.low + self.width * shares, self.low, self.low + self.width)
        rows = self.ask(points)
        cost = self.goal.cost(rows)
        unknown = ~np.isfinite(cost) | (np.asarray(rows[STATUS]) != 0)
        over = excess(self.limits, rows, len(points))
        over = np.where(unknown | np.isnan(over), UNANSWERED, over)
        self.count += len(points)
        outside = over > KEPT
        place = int(np.lexsort((np.where(outside, over, cost), outside))[0])
        rank = bool(outside[place]), float(over[place] if outside[place] else cost[place])
        if rank < self.best:
            self.best, self.point, self.over = rank, points[place], float(over[place])
            self.values = {column.name: float(rows[column.name][place]) for column in _numbers(self.ask, rows)}
            if not rank[0]:
                self.history.append((float(self.count), self.values[self.goal.name]))
        tell(self.progress, self.count / self.most)
        return np.where(unknown, math.nan, cost), over, rows

    def ranked(self, shares: Array) -> Array:
        """Return costs (n,) at places (d, n) by which any that keeps the limits is better than any that does not."""
        cost, over, _rows = self.costs(shares.T)
        found: Array = np.where(over > KEPT, LOST * (1.0 + np.maximum(over, 0.0)), np.nan_to_num(cost, nan=math.inf))
        return found

    def single(self, share: Array) -> tuple[float, Array]:
        """Return cost and excess of each limit at a place (d,)."""
        key = np.asarray(share, dtype=float).tobytes()
        if key != self.last[0]:
            cost, over, rows = self.costs(np.asarray(share, dtype=float)[None])
            known = math.isfinite(cost[0])
            each = [limit.excess(rows)[0] if known else UNANSWERED for limit in self.limits]
            worst = float(np.nan_to_num(over[0], neginf=0.0))
            self.last = (key, float(cost[0]) if known else LOST * (1.0 + worst), np.asarray(each))
        return self.last[1], self.last[2]

    def share(self, point: Array) -> Array:
        """Return the place of a point in the unit box."""
        found: Array = np.where(self.width > 0.0, (point - self.low) / np.where(self.width > 0.0, self.width, 1.0), 0.0)
        return np.clip(found, 0.0, 1.0)


def _numbers(ask: Evaluator, rows: Rows) -> list[Column]:
    return [column for column in ask.answers if np.asarray(rows[column.name]).dtype.kind in "bfiu"]


def optimise(
    ask: Evaluator,
    bounds: Bounds,
    goal: Goal,
    *,
    limits: Sequence[Limit] = (),
    method: Local | Global | None = None,
    progress: Progress | None = None,
) -> Optimum:
    """Return the point of a box at which an answer is best, limits on others kept.

    Parameters
    ----------
    ask : Evaluator
        What answers, over d fields.
    bounds : sequence of (float, float) (d,)
        Range of each field, in its unit.
    goal : Goal
        What is to be small or great.
    limits : sequence of Limit
        What is to be kept.
    method : Local or Global, optional
        Local by default.
    progress : function, optional
        Told the share done; when it answers "stop", the best so far is returned.

    Returns
    -------
    Optimum

    Raises
    ------
    InputError
        Not one range for each field, a range that is none, a column that is not there, a start outside the box.

    See Also
    --------
    evaluator, pareto_search

    Examples
    --------
    >>> from cardan.batch.answering.asking import Formula
    >>> from cardan.sweeps import Goal, optimise
    >>> ask = Formula.of(["x", "y"], {"z": lambda x, y: (x - 1.0) ** 2 + (y + 2.0) ** 2})
    >>> found = optimise(ask, [(-5.0, 5.0), (-5.0, 5.0)], Goal(name="z"))
    >>> print(found.status, found.point.round(4))
    converged [ 1. -2.]
    """
    how = Local() if method is None else method
    _check(ask, bounds, goal, limits, how)
    finish = how if isinstance(how, Local) else how.finish
    wide = how.population * len(bounds) * (how.generations + 1) if isinstance(how, Global) else 0
    search = _Search(ask, bounds, goal, limits, wide + finish.most, progress)
    ended: Ending
    try:
        spread_out = True
        start = np.asarray(finish.start or search.low + 0.5 * search.width, dtype=float)
        if isinstance(how, Global):
            spread_out = _evolve(search, how)
            if not search.best[0] or math.isfinite(search.best[1]):
                start = search.point
        settled = _descend(search, finish, search.share(start), small=isinstance(how, Global))
        ended = "converged" if settled and spread_out else "not converged"
    except StoppedError:
        ended = "cancelled"
    if search.best[0] and ended != "cancelled":
        ended = "nothing found"
    known = (math.isfinite(search.over) and search.over < UNANSWERED) or search.over == -math.inf
    return Optimum(
        fields=ask.points,
        answers=ask.answers,
        goal=goal,
        limits=tuple(limits),
        point=search.point if known else np.full(len(bounds), math.nan),
        values=search.values if known else {},
        excess=search.over if known else math.inf,
        evaluations=search.count,
        history=np.asarray(search.history, dtype=float).reshape(-1, 2),
        status=ended,
        accuracy=finish.accuracy,
    )


def _evolve(search: _Search, how: Global) -> bool:
    """Search the whole box and return whether the search has converged."""
    box: Any = [(0.0, 1.0)] * len(search.low)
    count = max(5, how.population * len(search.low))
    found: Any = scipy.optimize.differential_evolution(
        search.ranked,
        box,
        maxiter=how.generations,
        tol=how.spread,
        atol=how.least,
        rng=how.seed,
        init=uniforms("lhs", len(search.low), how.seed, 0, count, count),
        polish=False,
        updating="deferred",
        vectorized=True,
    )
    return bool(found.success)


def _descend(search: _Search, how: Local, start: Array, *, small: bool) -> bool:
    """Go downhill and return whether the place is found."""
    box: Any = [(0.0, 1.0)] * len(search.low)
    options: Any = {
        "maxfev": how.most,
        "initial_tr_radius": 0.02 if small else 0.25,
        "final_tr_radius": how.accuracy,
        "scale": False,
    }
    limits: Any = ()
    if search.limits:
        limits = scipy.optimize.NonlinearConstraint(lambda share: search.single(share)[1], -math.inf, 0.0)

    def cost(share: Any) -> Any:
        return search.single(share)[0]

    found: Any = scipy.optimize.minimize(cost, start, method="COBYQA", bounds=box, constraints=limits, options=options)
    return bool(found.success) or int(found.status) in (0, 1, 2)


def _check(ask: Evaluator, bounds: Bounds, goal: Goal, limits: Sequence[Limit], how: Local | Global) -> None:
    """Refuse what is no box and what is not asked, all at once."""
    check_names([goal, *limits], ask.answers)
    problems = check_bounds(ask, bounds)
    start = (how if isinstance(how, Local) else how.finish).start
    if start and len(start) != len(ask.points):
        text = _("{given} values given, {wanted} needed")
        problems.append(Problem("start", text.format(given=len(start), wanted=len(ask.points)), "inconsistent"))
    elif start and not problems:
        for column, value, (low, high) in zip(ask.points, start, bounds, strict=True):
            if not low <= value <= high:
                text = _("{value} is not between {low} and {high}")
                said = text.format(value=value, low=low, high=high)
                problems.append(Problem(f"start: {column.name}", said, "out_of_range"))
    check(problems)


def check_bounds(ask: Evaluator, bounds: Bounds) -> list[Problem]:
    """Return what is wrong with the ranges of the fields."""
    if len(bounds) != len(ask.points) or not bounds:
        text = _("{given} ranges given, {wanted} needed: one for each field that varies")
        return [Problem("bounds", text.format(given=len(bounds), wanted=len(ask.points)), "inconsistent")]
    return [
        Problem(
            f"bounds: {column.name}",
            _("{low} to {high} is not a range: it needs two finite numbers, the lower one first").format(
                low=low, high=high
            ),
            "out_of_range",
        )
        for column, (low, high) in zip(ask.points, bounds, strict=True)
        if not (math.isfinite(low) and math.isfinite(high) and low < high)
    ]
