"""Reductions: what is told of all points of a sweep, or of each group of them, without keeping their rows."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol, TypeAlias

import numpy as np

from cardan.batch.points.axes import Axis, Points
from cardan.batch.search.goals import Limit, limit_of
from cardan.batch.work import FEASIBLE, STATUS, Column, Rows, State, Status
from cardan.errors import Problem, check, refuse
from cardan.maths.arrays import Array
from cardan.texts import _
from cardan.units import nearest

from . import summaries
from .summaries import BINS as MOST_BINS

BINS = 50  # bins of a histogram when none are asked for


@dataclass(frozen=True, kw_only=True)
class Reduce:
    """What is to be told of a column, as a plan says it."""

    kind: str  # one of `KINDS`
    of: str = ""  # column; for ``count`` and ``share`` empty
    by: tuple[str, ...] = ()  # axes, by their names or by a field of theirs: one answer for each of their places
    where: tuple[Limit, ...] = ()  # rows that count; those without an answer never do
    percent: float = 50.0
    bins: int = BINS
    # low, high: of a histogram; without them it has bins of a power of two that cover all numbers
    low: float | None = None
    high: float | None = None
    name: str = ""  # among the results; made of the rest when empty

    @property
    def label(self) -> str:
        """Name among the results."""
        if self.name:
            return self.name
        words = [f"p{self.percent:g}" if self.kind == "percentile" else self.kind]
        limits = " and ".join(str(one) for one in self.where)
        words += [self.of, f"where {limits}" if limits else ""] if self.of else [limits]
        return " ".join(word for word in words if word) + (" by " + ", ".join(self.by) if self.by else "")

    def told(self) -> dict[str, Any]:
        """Return it as the table of a plan file."""
        found: dict[str, Any] = {"kind": self.kind}
        found |= {"of": self.of} if self.of else {}
        found |= {"by": list(self.by)} if self.by else {}
        found |= {"where": [str(one) for one in self.where]} if self.where else {}
        if self.kind == "percentile":
            found["percent"] = self.percent
        if self.kind == "histogram":
            found |= {"bins": self.bins} | {
                k: getattr(self, k) for k in ("low", "high") if getattr(self, k) is not None
            }
        return found | ({"name": self.name} if self.name else {})


# Kinds of reductions: what each has seen of the rows, and what it tells of them.

Value: TypeAlias = dict[str, Any]  # what is told of one group: ``value`` and what belongs to it


@dataclass(frozen=True, eq=False, kw_only=True)
class Part:
    """Answered rows that a reduction looks at."""

    # (n,): of the column, where it has values and the conditions are kept; of a kind without a column, whether they are
    values: Array
    rows: Array  # (n,) of int: numbers of these rows
    groups: Array | None  # (n,) of int: group of each; None where there is one group


class Kind(Protocol):
    """One kind of reduction."""

    columned: bool
    """Whether it is of a column, and not of a condition alone."""

    def empty(self, what: Reduce, count: int) -> State:
        """Return the state of so many groups that have seen nothing."""

    def add(self, what: Reduce, state: State, part: Part) -> State:
        """Return the state that has also seen a part."""

    def merge(self, what: Reduce, one: State, other: State) -> State:
        """Return the state that has seen what either has seen."""

    def value(self, what: Reduce, state: State, group: int, point: Callable[[int], Value]) -> Value:
        """Return what is told of a group; ``point`` gives the point of a row."""


@dataclass(frozen=True)
class Extreme:
    """The greatest or smallest value, with its point or without."""

    largest: bool
    pointed: bool
    columned = True

    def empty(self, what: Reduce, count: int) -> State:
        """Return the state of so many groups that have seen nothing."""
        return summaries.extreme_empty(count)

    def add(self, what: Reduce, state: State, part: Part) -> State:
        """Return the state that has also seen a part."""
        return summaries.extreme_add(state, part.values, part.rows, part.groups, largest=self.largest)

    def merge(self, what: Reduce, one: State, other: State) -> State:
        """Return the state that has seen what either has seen."""
        return summaries.extreme_merge(one, other, largest=self.largest)

    def value(self, what: Reduce, state: State, group: int, point: Callable[[int], Value]) -> Value:
        """Return the value of a group."""
        best, row = state["best"][group], state["row"][group]
        return (
            {"value": best, "row": row, "point": point(row)} if self.pointed and best is not None else {"value": best}
        )


@dataclass(frozen=True)
class Moment:
    """Mean or standard deviation."""

    spread: bool
    columned = True

    def empty(self, what: Reduce, count: int) -> State:
        """Return the state of so many groups that have seen nothing."""
        return summaries.moment_empty(count)

    def add(self, what: Reduce, state: State, part: Part) -> State:
        """Return the state that has also seen a part."""
        return summaries.moment_add(state, part.values, part.groups)

    def merge(self, what: Reduce, one: State, other: State) -> State:
        """Return the state that has seen what either has seen."""
        return summaries.moment_merge(one, other)

    def value(self, what: Reduce, state: State, group: int, point: Callable[[int], Value]) -> Value:
        """Return the value of a group."""
        n = state["n"][group]
        if self.spread:
            square = state["square"][group]
            known = n > 1 and not math.isnan(square)
            return {"value": math.sqrt(square / (n - 1)) if known else None, "rows": n}
        return {"value": state["mean"][group] if n else None, "rows": n}


@dataclass(frozen=True)
class Count:
    """How many rows keep the conditions, or which share of those answered."""

    share: bool
    columned = False

    def empty(self, what: Reduce, count: int) -> State:
        """Return the state of so many groups that have seen nothing."""
        return summaries.count_empty(count)

    def add(self, what: Reduce, state: State, part: Part) -> State:
        """Return the state that has also seen a part."""
        return summaries.count_add(state, part.values, part.groups)

    def merge(self, what: Reduce, one: State, other: State) -> State:
        """Return the state that has seen what either has seen."""
        return summaries.count_merge(one, other)

    def value(self, what: Reduce, state: State, group: int, point: Callable[[int], Value]) -> Value:
        """Return the value of a group."""
        n, of = state["n"][group], state["of"][group]
        return {"value": (n / of if of else None) if self.share else n, "rows": of}


@dataclass(frozen=True)
class Rank:
    """A percentile."""

    columned = True

    def empty(self, what: Reduce, count: int) -> State:
        """Return the state of so many groups that have seen nothing."""
        return summaries.rank_empty(count)

    def add(self, what: Reduce, state: State, part: Part) -> State:
        """Return the state that has also seen a part."""
        return summaries.rank_add(state, part.values, part.groups)

    def merge(self, what: Reduce, one: State, other: State) -> State:
        """Return the state that has seen what either has seen."""
        return summaries.rank_merge(one, other)

    def value(self, what: Reduce, state: State, group: int, point: Callable[[int], Value]) -> Value:
        """Return the value of a group."""
        found, bound = summaries.rank_result(state[group], what.percent / 100.0)
        return {"value": None if math.isnan(found) else found, "bound": bound}


@dataclass(frozen=True)
class Histogram:
    """How many values lie where: between given ends, or in bins of a power of two that cover all."""

    columned = True

    def empty(self, what: Reduce, count: int) -> State:
        """Return the state of so many groups that have seen nothing."""
        return summaries.rank_empty(count) if what.low is None else summaries.histogram_empty(count, what.bins)

    def add(self, what: Reduce, state: State, part: Part) -> State:
        """Return the state that has also seen a part."""
        if what.low is None or what.high is None:
            return summaries.rank_add(state, part.values, part.groups)
        return summaries.histogram_add(state, part.values, part.groups, low=what.low, high=what.high)

    def merge(self, what: Reduce, one: State, other: State) -> State:
        """Return the state that has seen what either has seen."""
        return summaries.rank_merge(one, other) if what.low is None else summaries.histogram_merge(one, other)

    def value(self, what: Reduce, state: State, group: int, point: Callable[[int], Value]) -> Value:
        """Return the value of a group."""
        if what.low is not None and what.high is not None:
            edges = np.linspace(what.low, what.high, what.bins + 1).tolist()
            counts = state["counts"][group]
            return {"edges": edges, "counts": counts, "below": state["below"][group], "above": state["above"][group]}
        seen = state[group]
        ends = {"below": seen["least"], "above": seen["most"]}
        raw = [np.asarray(seen["kept"], dtype=float)] if seen["kept"] else []
        if not raw and seen["exponent"] is None:
            return {"edges": [], "counts": [], **ends}
        exponent, first, counts = summaries.binned(raw, [] if raw else [seen], what.bins)
        edges = [(first + j) * math.ldexp(1.0, exponent) for j in range(len(counts) + 1)]
        return {"edges": edges, "counts": counts, **ends}


KINDS: dict[str, Kind] = {
    "max": Extreme(largest=True, pointed=False),
    "min": Extreme(largest=False, pointed=False),
    "argmax": Extreme(largest=True, pointed=True),
    "argmin": Extreme(largest=False, pointed=True),
    "mean": Moment(spread=False),
    "std": Moment(spread=True),
    "percentile": Rank(),
    "histogram": Histogram(),
    "count": Count(share=False),
    "share": Count(share=True),
}
"""Name of a kind in a plan -> kind."""


GROUPS = 10_000  # more groups than this are refused: a table of the rows is what is wanted then


_PERCENT = re.compile(r"p(\d+(?:\.\d+)?)\s+(.*)")


def reduce_of(text: str) -> Reduce:
    """Return the reduction that a text tells.

    text: ``max speed_fluctuation_percent``, ``p99 alpha_eq_deg by duty.speed_rpm``, ``share life_h >= 5000 by make``.
    """
    whole, _word, by = text.strip().partition(" by ")
    groups = tuple(one.strip() for one in by.split(",") if one.strip())
    percent = _PERCENT.fullmatch(whole)
    if percent:
        return Reduce(kind="percentile", percent=float(percent[1]), of=percent[2].strip(), by=groups)
    kind, _space, rest = whole.partition(" ")
    if kind not in KINDS or kind == "percentile" or not rest.strip():
        message = _(
            "not a reduction: {text}; write “max speed_fluctuation_percent”, “p95 life_h by supplier” or “share x <= 2”"
        )
        raise refuse("reduce", message.format(text=repr(text)))
    if not KINDS[kind].columned:
        limits = tuple(limit_of(one) for one in rest.split(" and "))
        return Reduce(kind=kind, where=limits, by=groups)
    return Reduce(kind=kind, of=rest.strip(), by=groups)


@dataclass(frozen=True, kw_only=True)
class Told:
    """A reduction at work on the rows of a sweep; a `cardan.batch.work.Reduction`."""

    what: Reduce
    points: Points  # the points of the sweep
    axes: tuple[int, ...] = ()  # axes by which rows are grouped, by their numbers
    unit: str = ""  # of the column
    count: int = field(init=False, default=1)

    def __post_init__(self) -> None:
        object.__setattr__(self, "count", math.prod(self.points.axes[k].size for k in self.axes))

    @property
    def name(self) -> str:
        """Name among the results."""
        return self.what.label

    def empty(self) -> State:
        """Return the state that has seen nothing."""
        return self._kind.empty(self.what, self.count)

    def add(self, state: State, rows: Rows, start: int) -> State:
        """Return the state that has also seen rows ``start`` and following."""
        held = rows[STATUS] == 0
        count = len(held)
        kept = held if not self.what.where else np.ones(count, dtype=bool)
        for limit in self.what.where:
            kept = kept & (limit.excess(rows) <= 0.0)
        if self._kind.columned:
            values = np.asarray(rows[self.what.of], dtype=float)
            held = held & kept & ~np.isnan(values)
        else:
            values = kept
        numbers, groups = np.arange(start, start + count), self._groups(start, count)
        if not held.all():
            values, numbers, groups = values[held], numbers[held], None if groups is None else groups[held]
        return self._kind.add(self.what, state, Part(values=values, rows=numbers, groups=groups))

    def merge(self, one: State, other: State) -> State:
        """Return the state that has seen what either has seen."""
        return self._kind.merge(self.what, one, other)

    def result(self, state: State) -> dict[str, Any]:
        """Return what is told: kind, column and unit, and the value, or groups with a value each.

        A value is a mapping: ``value``, with ``point`` and ``row`` of an argmax, with ``bound`` of a percentile, or
        ``edges``, ``counts``, ``below`` and ``above`` of a histogram; None where nothing was seen.
        """
        what = self.what
        head: dict[str, Any] = {"kind": what.kind, "of": what.of, "unit": self.unit}
        if what.kind == "percentile":
            head["percent"] = what.percent
        values = [self._kind.value(what, state, k, self._point) for k in range(self.count)]
        if not self.axes:
            return {**head, **values[0]}
        return {**head, "by": list(what.by), "groups": [self._group(k) for k in range(self.count)], "values": values}

    @property
    def _kind(self) -> Kind:
        return KINDS[self.what.kind]

    def _groups(self, start: int, count: int) -> Array | None:
        """Return the group of each row, None where there is one."""
        if not self.axes:
            return None
        places = self.points.places(start, start + count)
        found: Array = np.zeros(count, dtype=np.int64)
        for k in self.axes:
            found = found * self.points.axes[k].size + places[k]
        return found

    def _group(self, number: int) -> dict[str, Any]:
        """Return the values of the fields that a group has in common."""
        found: dict[str, Any] = {}
        for k in reversed(self.axes):
            number, place = divmod(number, self.points.axes[k].size)
            values = self.points.axes[k].values(np.asarray([place]))
            found = {name: one[0].item() for name, one in values.items()} | found
        return found

    def _point(self, row: int) -> dict[str, Any]:
        return {name: one[0].item() for name, one in self.points.values(row, row + 1).items()}


@dataclass(frozen=True, kw_only=True)
class States:
    """How many points are answered, make no drive, have no answer, keep the constraints; told of every sweep."""

    name: str = "points"

    def empty(self) -> State:
        """Return the state that has seen nothing."""
        return {"states": [0] * len(Status), "first": [-1] * len(Status), "feasible": None}

    def add(self, state: State, rows: Rows, start: int) -> State:
        """Return the state that has also seen rows ``start`` and following."""
        status = np.asarray(rows[STATUS])
        counts = [int(np.count_nonzero(status == one)) for one in Status]
        first = [start + int(np.argmax(status == one)) if n else -1 for one, n in zip(Status, counts, strict=True)]
        kept = int(np.count_nonzero(rows[FEASIBLE])) if FEASIBLE in rows else None
        return self.merge(state, {"states": counts, "first": first, "feasible": kept})

    def merge(self, one: State, other: State) -> State:
        """Return the state that has seen what either has seen."""
        first = [max(a, b) if min(a, b) < 0 else min(a, b) for a, b in zip(one["first"], other["first"], strict=True)]
        known = [part["feasible"] for part in (one, other) if part["feasible"] is not None]
        return {
            "states": [a + b for a, b in zip(one["states"], other["states"], strict=True)],
            "first": first,
            "feasible": sum(known) if known else None,
        }

    def result(self, state: State) -> dict[str, Any]:
        """Return the counts, and the first row of each kind that is not answered."""
        told = {one.name.lower(): n for one, n in zip(Status, state["states"], strict=True)}
        first = {one.name.lower(): row for one, row in zip(Status, state["first"], strict=True) if one and row >= 0}
        feasible = {} if state["feasible"] is None else {"feasible": state["feasible"]}
        return {"kind": "points", **told, **feasible, "first": first}


def at_work(reduce: Sequence[Reduce], points: Points, columns: Sequence[Column]) -> tuple[Told, ...]:
    """Return reductions for the rows of a sweep."""
    units = {one.name: one.unit for one in columns}
    problems: list[Problem] = []
    found: list[Told] = []
    for k, one in enumerate(reduce):
        path = f"reduce[{k}]"
        problems += _problems(one, path, units)
        axes: list[int] = []
        for group in one.by:
            place = _axis(points.axes, group)
            if place is None:
                known = ", ".join(axis.name for axis in points.axes)
                text = _("{name} does not vary; what varies: {known}")
                problems.append(Problem(f"{path}.by", text.format(name=repr(group), known=known)))
            elif place not in axes:
                axes.append(place)
        if math.prod(points.axes[a].size for a in axes) > GROUPS:
            text = _("more than {limit} groups; keep the rows instead")
            problems.append(Problem(f"{path}.by", text.format(limit=GROUPS)))
        elif one.label in [other.name for other in found]:
            problems.append(Problem(f"{path}.name", _("{name} is told twice").format(name=repr(one.label))))
        else:
            found.append(Told(what=one, points=points, axes=tuple(axes), unit=units.get(one.of, "")))
    check(problems)
    return tuple(found)


def _axis(axes: Sequence[Axis], name: str) -> int | None:
    return next((k for k, axis in enumerate(axes) if name == axis.name or name in axis.fields), None)


def _problems(one: Reduce, path: str, units: dict[str, str]) -> Iterator[Problem]:
    if one.kind not in KINDS:
        text = _("{value} is none of {choices}")
        yield Problem(f"{path}.kind", text.format(value=repr(one.kind), choices=", ".join(KINDS)))
        return
    wanted = [("of", one.of)] if KINDS[one.kind].columned else []
    for key, name in [*wanted, *(("where", limit.name) for limit in one.where)]:
        if name not in units:
            close = nearest(name, units)
            text = (
                _("there is no such column; the nearest is {near}")
                if close
                else _("there is no such column; known: {all}")
            )
            yield Problem(f"{path}.{key}", f"{name}: " + text.format(near=close, all=", ".join(units)))
    if not KINDS[one.kind].columned and not one.where:
        yield Problem(f"{path}.where", _("missing; a condition such as “speed_fluctuation_percent <= 2”"))
    if not 0.0 <= one.percent <= 100.0:
        yield Problem(f"{path}.percent", _("{value} does not lie between 0 and 100").format(value=one.percent))
    if not 1 <= one.bins <= MOST_BINS:
        text = _("{value} does not lie between {low} and {high}")
        yield Problem(f"{path}.bins", text.format(value=one.bins, low=1, high=MOST_BINS))
    if (one.low is None) != (one.high is None):
        yield Problem(f"{path}.low", _("a histogram has both ends or none"))
    elif one.low is not None and one.high is not None and not one.low < one.high:
        yield Problem(f"{path}.high", _("{high} is not above {low}").format(high=one.high, low=one.low))
