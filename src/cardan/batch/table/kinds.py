"""Kinds of reductions: what each has seen of the rows, and what it tells of them."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol, TypeAlias

import numpy as np

from cardan.batch.work import State
from cardan.maths.arrays import Array

from . import summaries
from .reduction import Reduce

Value: TypeAlias = dict[str, Any]
"""What is told of one group: ``value`` and what belongs to it."""


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
        ...

    def add(self, what: Reduce, state: State, part: Part) -> State:
        """Return the state that has also seen a part."""
        ...

    def merge(self, what: Reduce, one: State, other: State) -> State:
        """Return the state that has seen what either has seen."""
        ...

    def value(self, what: Reduce, state: State, group: int, point: Callable[[int], Value]) -> Value:
        """Return what is told of a group; ``point`` gives the point of a row."""
        ...


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
