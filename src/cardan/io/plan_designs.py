"""Designs of a plan file that choose their points themselves: a search, a sensitivity, a boundary."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias, TypeVar

import numpy as np

from cardan.batch.answering.asking import DriveEvaluator, evaluator
from cardan.batch.points.axes import SampledAxis
from cardan.batch.points.distributions import Distribution
from cardan.batch.points.fields import present
from cardan.batch.search.boundary import Boundary, boundary
from cardan.batch.search.goals import Goal, Limit, Progress, check_names, goal_of, limit_of
from cardan.batch.search.optimise import Global, Local, Optimum, optimise
from cardan.batch.search.pareto import ParetoSet, pareto_search
from cardan.batch.search.sobol import Sensitivity, sensitivity
from cardan.errors import InputError, Problem, check
from cardan.reading.table import Table
from cardan.texts import _

from .plan_file import Plan

Read = TypeVar("Read", Goal, Limit)


@dataclass(frozen=True, kw_only=True)
class Search:
    """``[search]``: the best point by one goal, or points of which none is better in all of several."""

    ask: DriveEvaluator  # what answers over the fields of ``between``
    bounds: tuple[tuple[float, float], ...]
    goals: tuple[Goal, ...]
    limits: tuple[Limit, ...] = ()
    method: str = "local"  # for one goal
    start: tuple[float, ...] = ()  # where a local search begins; where the drive stands by default
    seed: int = 0  # seed, population, generations: of a global search or one for several goals
    population: int = 0
    generations: int = 0

    def run(self, progress: Progress | None = None) -> Optimum | ParetoSet:
        """Return what the search finds."""
        if len(self.goals) > 1:
            return pareto_search(
                self.ask,
                self.bounds,
                self.goals,
                limits=self.limits,
                population=self.population or 60,
                generations=self.generations or 60,
                seed=self.seed,
                progress=progress,
            )
        method: Local | Global = Local(start=self.start)
        if self.method == "global":
            plain = Global()
            generations = self.generations or plain.generations
            method = Global(seed=self.seed, population=self.population or plain.population, generations=generations)
        return optimise(self.ask, self.bounds, self.goals[0], limits=self.limits, method=method, progress=progress)


@dataclass(frozen=True, kw_only=True)
class SensitivityPlan:
    """``[sensitivity]``: which share of the variance of answers each field brings about."""

    ask: DriveEvaluator  # what answers over the fields that the plan draws from distributions
    spread: tuple[Distribution, ...]
    answers: tuple[str, ...] = ()  # columns looked at; all when empty
    samples: int = 1024
    seed: int = 0
    confidence: float = 0.95

    def run(self, progress: Progress | None = None) -> Sensitivity:
        """Return the indices."""
        return sensitivity(
            self.ask,
            self.spread,
            answers=self.answers,
            samples=self.samples,
            seed=self.seed,
            confidence=self.confidence,
            progress=progress,
        )


@dataclass(frozen=True, kw_only=True)
class Following:
    """``[boundary]``: where limits begin to be broken over two fields."""

    ask: DriveEvaluator  # what answers over the two fields of ``between``
    bounds: tuple[tuple[float, float], ...]
    limits: tuple[Limit, ...]
    coarse: tuple[int, int] = (16, 16)
    halvings: int = 4
    accuracy: float = 0.01

    def run(self, progress: Progress | None = None) -> Boundary:
        """Return the boundary."""
        return boundary(
            self.ask,
            self.bounds,
            self.limits,
            coarse=self.coarse,
            halvings=self.halvings,
            accuracy=self.accuracy,
            progress=progress,
        )


Design: TypeAlias = Search | SensitivityPlan | Following


def design_of(plan: Plan, name: str) -> Design:
    """Return a design of a plan, ready to run."""
    table = Table(given=plan.parts[name], path=name)
    make: Callable[[Plan, Table], Design | None] = {"search": _search, "sensitivity": _owing, "boundary": _following}[
        name
    ]
    made = make(plan, table)
    table.finish()
    check(table.problems)
    assert made is not None
    return made


def _search(plan: Plan, table: Table) -> Search | None:
    goals = _read(table, "goals", goal_of, required=True)
    limits = _read(table, "limits", limit_of) if table.has("limits") else _constraints(plan)
    ask, bounds = _between(plan, table)
    method = table.text("method", "local", choices=("local", "global"))
    seed, population, generations = (table.whole(key, 0) for key in ("seed", "population", "generations"))
    given = table.table("start") if table.has("start") else None
    start: tuple[float, ...] = ()
    if ask is not None:
        _named(table, [*goals, *limits], ask)
        start = _start(ask, bounds, given)
    if table.problems or ask is None:
        return None
    return Search(
        ask=ask,
        bounds=bounds,
        goals=goals,
        limits=limits,
        method=method,
        start=start,
        seed=seed or plan.seed,
        population=population,
        generations=generations,
    )


def _start(ask: DriveEvaluator, bounds: tuple[tuple[float, float], ...], given: Table | None) -> tuple[float, ...]:
    """Return where a search begins: as given, else where the drive stands, no farther out than the box."""
    found = []
    for column, (low, high) in zip(ask.points, bounds, strict=True):
        if given is not None and given.has(column.name):
            found.append(given.number(column.name))
            continue
        here = present(ask.drive, column.name)
        found.append(0.5 * (low + high) if here is None else min(max(here, low), high))
    if given is not None:
        given.finish()
    return tuple(found)


def _owing(plan: Plan, table: Table) -> SensitivityPlan | None:
    drawn = next((axis for axis in plan.axes if isinstance(axis, SampledAxis)), None)
    if drawn is None:
        table.refuse("", _("needs a [[vary]] with design and fields: how they are distributed"))
    elif drawn.correlations:
        table.refuse("", _("fields that go together have no shares of their own; leave correlations out"))
    answers = tuple(table.texts("answers"))
    samples, seed = table.whole("samples", 1024), table.whole("seed", plan.seed)
    confidence = table.number("confidence", 0.95)
    if drawn is None or table.problems:
        return None
    ask = _asked(plan, table, tuple(drawn.distributions))
    if ask is None:
        return None
    spread = tuple(drawn.distributions.values())
    return SensitivityPlan(ask=ask, spread=spread, answers=answers, samples=samples, seed=seed, confidence=confidence)


def _following(plan: Plan, table: Table) -> Following | None:
    limits = _read(table, "limits", limit_of) if table.has("limits") else _constraints(plan)
    ask, bounds = _between(plan, table)
    coarse = table.items("coarse") or [16, 16]
    if len(coarse) != 2 or not all(isinstance(one, int) and not isinstance(one, bool) for one in coarse):
        table.refuse("coarse", _("two whole numbers are needed: cells across and upwards"))
        coarse = [16, 16]
    halvings, accuracy = table.whole("halvings", 4), table.number("accuracy", 0.01)
    if ask is not None:
        _named(table, limits, ask)
        if len(ask.points) != 2:
            table.refuse("between", _("a boundary lies over two fields; {given} vary").format(given=len(ask.points)))
    if table.problems or ask is None:
        return None
    return Following(
        ask=ask, bounds=bounds, limits=limits, coarse=(coarse[0], coarse[1]), halvings=halvings, accuracy=accuracy
    )


def _read(table: Table, key: str, of: Callable[[str], Read], *, required: bool = False) -> tuple[Read, ...]:
    """Return what the texts of a key tell."""
    found = []
    if required and not table.has(key):
        table.refuse(key, _("missing; {wanted} is needed").format(wanted=_("a list of texts")))
    for k, text in enumerate(table.texts(key)):
        try:
            found.append(of(text))
        except InputError as error:
            table.problems += [Problem(f"{table.at(key)}[{k}]", one.message, one.code) for one in error.problems]
    return tuple(found)


def _constraints(plan: Plan) -> tuple[Limit, ...]:
    return tuple(limit_of(text) for text in plan.constraints)


def _between(plan: Plan, table: Table) -> tuple[DriveEvaluator | None, tuple[tuple[float, float], ...]]:
    """Return what answers over the fields of ``between``, and their ranges."""
    given: Mapping[str, Any] = table.table("between").given
    if not given:
        table.refuse("between", _('missing; write between = { "joints[1].joint_angle_deg" = [0, 20] }'))
        return None, ()
    bounds = []
    for path, pair in given.items():
        numbers = isinstance(pair, list) and len(pair) == 2 and all(_is_number(one) for one in pair)
        if not numbers or not pair[0] < pair[1]:
            table.refuse(f'between."{path}"', _("two numbers are needed, the lower one first"))
            continue
        bounds.append((float(pair[0]), float(pair[1])))
    ask = _asked(plan, table, tuple(given))
    misfits = [] if ask is None else [spot.problem(np.zeros(1)) for spot in ask.spots]
    table.problems += [Problem(f'{table.at("between")}."{one.field}"', one.message) for one in misfits if one]
    return (ask, tuple(bounds)) if len(bounds) == len(given) else (None, ())


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) < float("inf")


def _asked(plan: Plan, table: Table, paths: tuple[str, ...]) -> DriveEvaluator | None:
    try:
        return evaluator(plan.drive, paths, plan.ask, known=plan.known, device=plan.device)
    except InputError as error:
        table.follow("", error)
        return None


def _named(table: Table, named: Any, ask: DriveEvaluator) -> None:
    try:
        check_names(named, ask.answers)
    except InputError as error:
        table.follow("", error)
