"""Points of which none is better in all goals: chosen from a table, or searched for in a box (NSGA-II)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from cardan.batch.work import STATUS, Column, Rows
from cardan.errors import Problem, check
from cardan.later import later
from cardan.maths.arrays import Array
from cardan.maths.curves.pareto import front
from cardan.texts import _, mark

from .goals import Evaluator, Goal, Limit, Progress, StoppedError, check_names, excess, tell
from .optimise import KEPT, UNANSWERED, Bounds, check_bounds

MISSING = mark("a search for several goals needs pymoo: pip install 'cardan[pareto]'")
nsga2 = later("pymoo.algorithms.moo.nsga2", MISSING)
problem = later("pymoo.core.problem")
optimize = later("pymoo.optimize")

WORST = 1e9  # cost of a point without an answer: pymoo takes no nan


def pareto(rows: Rows, goals: Sequence[Goal], limits: Sequence[Limit] = ()) -> Array:
    """Return which rows of a table keep all limits and are not beaten in all goals by another one that does.

    rows, mapping of str to array (n,): the columns that goals and limits name, and the status where there is one.
    Returns (n,) of bool: exact; rows without an answer are never chosen.
    """
    costs = np.stack([goal.cost(rows) for goal in goals], axis=1)
    allowed = excess(limits, rows, len(costs)) <= KEPT
    if STATUS in rows:
        allowed &= np.asarray(rows[STATUS]) == 0
    found = np.zeros(len(costs), dtype=bool)
    found[allowed] = front(costs[allowed])
    return found


@dataclass(frozen=True, eq=False, kw_only=True)
class ParetoSet:
    """Points that were found of which none is better in all goals.

    Attributes
    ----------
    fields, answers : tuple of Column
        What varied, and what was asked.
    goals : tuple of Goal
    limits : tuple of Limit
    points : array (n, d)
        In the units of the fields, in the order of the first goal.
    values : mapping of str to array (n,)
        The answers there.
    evaluations : int
        Points asked.
    status : str
        "done"; "nothing found": no point asked keeps the limits; "cancelled": what was found until then.
    """

    fields: tuple[Column, ...]
    answers: tuple[Column, ...]
    goals: tuple[Goal, ...]
    limits: tuple[Limit, ...]
    points: Array
    values: Rows
    evaluations: int
    status: str


def pareto_search(
    ask: Evaluator,
    bounds: Bounds,
    goals: Sequence[Goal],
    *,
    limits: Sequence[Limit] = (),
    population: int = 60,
    generations: int = 60,
    seed: int = 0,
    progress: Progress | None = None,
) -> ParetoSet:
    """Return points of a box of which none is better in all goals, limits kept, by NSGA-II.

    Parameters
    ----------
    ask : Evaluator
        What answers, over d fields.
    bounds : sequence of (float, float) (d,)
        Range of each field, in its unit.
    goals : sequence of Goal
        Two or more.
    limits : sequence of Limit
        What is to be kept.
    population : int
        Points of a generation.
    generations : int
        How many.
    seed : int
        The same finds the same.
    progress : function, optional
        Told the share done; when it answers "stop", what was found until then is returned.

    Returns
    -------
    ParetoSet
        Of all points that were asked, those of the last generation and of all before.

    Raises
    ------
    InputError
        Not one range for each field, fewer than two goals, a column that is not there.
    MissingExtraError
        pymoo is not installed.

    See Also
    --------
    optimise, evaluator

    Notes
    -----
    Deb, Pratap, Agarwal, Meyarivan 2002, as pymoo has it; points that break limits rank behind all others.

    Examples
    --------
    >>> from cardan.batch.answering.asking import Formula
    >>> from cardan.sweeps import Goal, pareto_search
    >>> ask = Formula.of(["x"], {"one": lambda x: x**2, "two": lambda x: (x - 2.0) ** 2})
    >>> found = pareto_search(ask, [(-5.0, 5.0)], [Goal(name="one"), Goal(name="two")], generations=20)
    >>> found.status, bool(found.points.min() > -0.05), bool(found.points.max() < 2.05)
    ('done', True, True)
    """
    check_names([*goals, *limits], ask.answers)
    problems = check_bounds(ask, bounds)
    if len(goals) < 2:
        problems.append(Problem("goals", _("a choice needs two goals or more; one is for optimise"), "missing"))
    for name, size in (("population", population), ("generations", generations)):
        if size < 2:
            text = _("{given} are too few; at least {least} are needed")
            problems.append(Problem(name, text.format(given=size, least=2), "out_of_range"))
    check(problems)
    archive = _Archive(ask, bounds, goals, limits, population * generations, progress)
    status = "done"
    try:
        _evolve(archive, population, generations, seed)
    except StoppedError:
        status = "cancelled"
    points, rows = archive.whole()
    chosen = np.flatnonzero(pareto(rows, goals, limits)) if len(points) else np.empty(0, dtype=int)
    chosen = chosen[np.lexsort([goal.cost(rows)[chosen] for goal in reversed(goals)])] if len(chosen) else chosen
    return ParetoSet(
        fields=ask.points,
        answers=ask.answers,
        goals=tuple(goals),
        limits=tuple(limits),
        points=points[chosen],
        values={name: column[chosen] for name, column in rows.items() if name != STATUS},
        evaluations=len(points),
        status=status if len(chosen) or status == "cancelled" else "nothing found",
    )


class _Archive:
    """All points that were asked, with their answers."""

    def __init__(
        self,
        ask: Evaluator,
        bounds: Bounds,
        goals: Sequence[Goal],
        limits: Sequence[Limit],
        most: int,
        progress: Progress | None,
    ) -> None:
        self.ask, self.goals, self.limits = ask, tuple(goals), tuple(limits)
        self.low = np.asarray([low for low, _high in bounds], dtype=float)
        self.high = np.asarray([high for _low, high in bounds], dtype=float)
        self.most, self.progress = most, progress
        self.points: list[Array] = []
        self.rows: list[Rows] = []
        self.count = 0

    def costs(self, points: Array) -> tuple[Array, Array]:
        """Return costs (n, goals) and excess over each limit (n, limits) at points (n, d)."""
        points = np.clip(points, self.low, self.high)
        rows = self.ask(points)
        self.points.append(points)
        self.rows.append(rows)
        self.count += len(points)
        tell(self.progress, self.count / self.most)
        unknown = np.asarray(rows[STATUS]) != 0
        costs = np.stack([goal.cost(rows) for goal in self.goals], axis=1)
        over = np.stack([*(limit.excess(rows) for limit in self.limits), np.zeros(len(points))], axis=1)
        costs = np.where(unknown[:, None] | ~np.isfinite(costs), WORST, costs)
        return costs, np.where(unknown[:, None] | np.isnan(over), UNANSWERED, np.maximum(over, -1.0))

    def whole(self) -> tuple[Array, Rows]:
        """Return all points (n, d) and their answers (n,)."""
        if not self.points:
            return np.empty((0, len(self.low))), {}
        names = self.rows[0].keys()
        rows = {name: np.concatenate([np.asarray(one[name]) for one in self.rows]) for name in names}
        return np.concatenate(self.points), rows


def _evolve(archive: _Archive, population: int, generations: int, seed: int) -> None:
    """Let generations of points better each other."""
    evolution = nsga2()

    class Box(problem().Problem):  # type: ignore[misc]
        """The goals over the box."""

        def __init__(self) -> None:
            super().__init__(
                n_var=len(archive.low),
                n_obj=len(archive.goals),
                n_ieq_constr=len(archive.limits) + 1,
                xl=archive.low,
                xu=archive.high,
            )

        def _evaluate(self, x: Any, out: dict[str, Any], *_args: Any, **_options: Any) -> None:
            out["F"], out["G"] = archive.costs(np.asarray(x, dtype=float))

    optimize().minimize(Box(), evolution.NSGA2(pop_size=population), ("n_gen", generations), seed=seed, verbose=False)
