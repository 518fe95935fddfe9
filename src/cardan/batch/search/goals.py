"""What a choice among points is to achieve and to keep: goals and limits on columns, written as texts."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from time import perf_counter
from typing import Protocol, TypeAlias, runtime_checkable

import numpy as np

from cardan.batch.work import STATUS, Column, Rows
from cardan.errors import Problem, check, refuse
from cardan.maths.arrays import Array
from cardan.texts import _
from cardan.units import nearest

_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_NAME = r"[A-Za-z_][\w.\[\]]*"
_GOAL = re.compile(rf"(min|max)\s+({_NAME})")
_LIMIT = re.compile(rf"(?:({_NUMBER})\s*<=?\s*)?({_NAME})\s*(<=?|>=?)\s*({_NUMBER})")


@runtime_checkable
class Evaluator(Protocol):
    """Answers the same questions at any points of the same fields."""

    @property
    def points(self) -> tuple[Column, ...]:
        """One column for each field, in the order of the points."""

    @property
    def answers(self) -> tuple[Column, ...]:
        """Columns of the answers."""

    def __call__(self, points: Array) -> Rows:
        """Return the answers at points (N, d), in the units of their columns, nan with a ``status`` where none is."""


@dataclass(frozen=True, kw_only=True)
class Goal:
    """A column that is to be as small or as great as it can be.

    Attributes
    ----------
    name : str
        Of the column.
    largest : bool
        Whether it is to be great.
    """

    name: str
    largest: bool = False

    def __str__(self) -> str:
        return f"{'max' if self.largest else 'min'} {self.name}"

    def cost(self, rows: Rows) -> Array:
        """Return what is to be small, array (n,)."""
        values = np.asarray(rows[self.name], dtype=float)
        return -values if self.largest else values


@dataclass(frozen=True, kw_only=True)
class Limit:
    """A range that a column is to keep.

    Attributes
    ----------
    name : str
        Of the column.
    low, high : float
        Ends of the range, in the unit of the column; both belong to it.
    """

    name: str
    low: float = -math.inf
    high: float = math.inf

    def __str__(self) -> str:
        low, high = _exact(self.low), _exact(self.high)
        if math.isinf(self.low):
            return f"{self.name} <= {high}"
        return f"{self.name} >= {low}" if math.isinf(self.high) else f"{low} <= {self.name} <= {high}"

    def excess(self, rows: Rows) -> Array:
        """Return how far values lie beyond the range, a share of the end passed: array (n,), negative within.

        Where that end is 0, in the unit of the column.
        """
        values = np.asarray(rows[self.name], dtype=float)
        found = np.full(values.shape, -math.inf)
        for end, sign in ((self.high, 1.0), (self.low, -1.0)):
            if math.isfinite(end):
                found = np.maximum(found, sign * (values - end) / (abs(end) or 1.0))
        return np.where(np.isnan(values), math.nan, found)


def excess(limits: Sequence[Limit], rows: Rows, count: int) -> Array:
    """Return the worst excess over several limits, array (n,): positive where one is broken, nan where one is unknown.

    limits: None of them are always kept; rows, mapping of str to array (n,).
    """
    found = np.full(count, -math.inf)
    for limit in limits:
        found = np.maximum(found, limit.excess(rows))
    return found


def goal_of(text: str) -> Goal:
    """Return the goal that a text tells."""
    found = _GOAL.fullmatch(text.strip())
    if found is None:
        raise refuse(
            "goals",
            _("not a goal: {text}; write “min speed_fluctuation_percent” or “max life_h”").format(text=repr(text)),
        )
    return Goal(name=found[2], largest=found[1] == "max")


def limit_of(text: str) -> Limit:
    """Return the limit that a text tells."""
    found = _LIMIT.fullmatch(text.strip())
    if found is None or (found[1] and found[3].startswith(">")):
        message = _("not a limit: {text}; write “speed_fluctuation_percent <= 2”, “life_h >= 5000” or “1 <= x <= 2”")
        raise refuse("limits", message.format(text=repr(text)))
    low, high = (float(found[1]) if found[1] else -math.inf), float(found[4])
    if found[3].startswith(">"):
        low, high = high, math.inf
    if low > high:
        raise refuse("limits", _("{text}: no number is so small and so great").format(text=repr(text)), "inconsistent")
    return Limit(name=found[2], low=low, high=high)


def _exact(value: float) -> str:
    """Return a number as short as it can be told without loss."""
    short = f"{value:g}"
    return short if float(short) == value else repr(value)


def check_names(named: Iterable[Goal | Limit | str], columns: Iterable[Column]) -> None:
    """Refuse columns, and goals and limits on columns, that are not there, all at once."""
    known = [column.name for column in columns]
    problems = []
    for one in named:
        name = one if isinstance(one, str) else one.name
        if name in known:
            continue
        close = nearest(name, known)
        text = (
            _("there is no such column; the nearest is {near}") if close else _("there is no such column; known: {all}")
        )
        field = "columns" if isinstance(one, str) else "goals" if isinstance(one, Goal) else "limits"
        problems.append(Problem(f"{field}: {one}", text.format(near=close, all=", ".join(known)), "unknown_key"))
    check(problems)


# Many points asked piece by piece: progress is told, work can be stopped, memory stays bounded.

Progress: TypeAlias = Callable[[float], object]  # told the share done; when it answers "stop", the work ends
FIRST, MOST = 16, 2**16  # points of the first piece and of the largest
SECONDS = 0.25  # how long a piece takes, about


class StoppedError(Exception):
    """The user has enough."""


def tell(progress: Progress | None, share: float) -> None:
    """Tell the share done."""
    if progress is not None and progress(min(share, 1.0)) == "stop":
        raise StoppedError


def answered(
    ask: Evaluator,
    points: Array,
    names: Sequence[str],
    progress: Progress | None = None,
    *,
    begin: float = 0.0,
    end: float = 1.0,
) -> Rows | None:
    """Return answers at points, or None where the work was stopped.

    points (N, d): in the units of the fields; names: columns wanted beside the status.
    """
    count = len(points)
    kept: dict[str, list[Array]] = {name: [np.empty(0)] for name in (*names, STATUS)}
    place, size = 0, FIRST
    while place < count:
        start = perf_counter()
        rows = ask(points[place : place + size])
        place = min(place + size, count)
        for name, parts in kept.items():
            parts.append(np.asarray(rows[name], dtype=float))
        if progress is not None and progress(begin + (end - begin) * place / count) == "stop" and place < count:
            return None
        rate = size / max(perf_counter() - start, 1e-6)
        size = int(min(max(SECONDS * rate, 1.0), 8.0 * size, MOST))
    return {name: np.concatenate(parts) for name, parts in kept.items()}
