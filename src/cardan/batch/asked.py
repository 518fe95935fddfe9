"""What ``cardan sweep show`` was asked: the rows that are told, and the pictures that suit them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from cardan.batch.figures.designs import ranks_figure
from cardan.batch.figures.map import heat_figure, histogram_figure
from cardan.batch.figures.sweep import parallel_figure, pareto_figure
from cardan.batch.search.goals import Goal, Limit, check_names
from cardan.batch.table.results import TABLE, Results
from cardan.batch.table.sql import quoted
from cardan.batch.table.views import histogram_of, map_of, ranks_of
from cardan.batch.work import Column, Rows
from cardan.errors import refuse
from cardan.texts import _

DRAWN = 500
"""Points that are drawn as lines."""

DOTTED = 3000
"""Points that are drawn as dots."""

FEW = 160
"""Values of a field that make a map of its own grid."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Asked:
    """What is wanted of a table."""

    results: Results
    path: Path  # its folder
    goals: tuple[Goal, ...]  # one for the best points, more for a choice; none for the whole table
    limits: tuple[Limit, ...]
    where: str  # condition in SQL
    count: int  # points of the best
    query: str  # a question in SQL instead
    of: str  # the answer that is drawn
    over: tuple[str, ...]  # the fields of a map
    kinds: tuple[str, ...]  # what is drawn

    def check(self) -> None:
        """Refuse names that are no columns, all at once."""
        check_names([*self.goals, *self.limits, *([self.of] if self.of else []), *self.over], self.results.columns)
        if self.over and len(self.over) != 2:
            raise refuse("--over", _("a map lies over two fields; {given} given").format(given=len(self.over)))
        if "pareto" in self.kinds and len(self.goals) < 2:
            raise refuse("--kind", _("pareto needs two goals or more, each by --pareto"))

    @property
    def name(self) -> str:
        """What the sweep is called."""
        return str(self.results.provenance.get("title") or self.path.name)

    @cached_property
    def answer(self) -> Column | None:
        """The answer that is told and drawn."""
        wanted = self.of or (self.goals[0].name if self.goals else "")
        if wanted:
            return self.results.column(wanted)
        return next((column for column in self.results.numbers if column.role == "answer"), None)

    @cached_property
    def rows(self) -> Rows:
        """The rows chosen by a question or by goals."""
        if self.query:
            return self.results.query(self.query)
        if len(self.goals) > 1:
            return self.results.pareto(self.goals, limits=self.limits, where=self.where)
        return self.results.best(self.goals[0], limits=self.limits, where=self.where, count=self.count)

    @cached_property
    def length(self) -> int:
        """How many rows were chosen."""
        return len(next(iter(self.rows.values()), ()))

    @cached_property
    def spans(self) -> dict[str, dict[str, float]]:
        """Least, mean and greatest of all columns of numbers."""
        return self.results.spans(where=self.where)

    def shown(self, most: int) -> tuple[str, ...]:
        """Return the columns of chosen rows that a terminal has room for: the goals first, what varies, the answers."""
        if self.query:
            return tuple(self.rows)[:most]
        varied = [column.name for column in self.results.columns if column.role == "point" and self._varies(column)]
        answers = [column.name for column in self.results.columns if column.role == "answer"]
        wanted = dict.fromkeys([*(goal.name for goal in self.goals), *varied, *answers])
        return tuple(wanted)[:most]

    def _varies(self, column: Column) -> bool:
        if column.name not in self.spans:
            return True
        return self.spans[column.name]["least"] < self.spans[column.name]["most"]

    def figures(self) -> tuple[Any, ...]:
        """Return the pictures wanted, or those that suit the table."""
        drawn = {
            "lines": self._lines,
            "pareto": self._pareto,
            "map": self._map,
            "histogram": self._histogram,
            "tornado": self._tornado,
        }
        return tuple(drawn[kind]() for kind in self.kinds or self._suiting())

    def _suiting(self) -> tuple[str, ...]:
        """Return the pictures that suit the table."""
        if len(self.goals) > 1:
            return ("pareto", "lines")
        fields = self._fields()
        grid = len(fields) == 2 and all(self._distinct(name) <= FEW for name in fields)
        return ("map", "histogram") if grid else ("lines", "tornado")

    def _fields(self) -> tuple[str, ...]:
        """Return the fields of numbers that vary."""
        points = (column for column in self.results.numbers if column.role == "point")
        return tuple(column.name for column in points if self._varies(column))

    def _distinct(self, name: str) -> int:
        return int(self.results.query(f"SELECT count(DISTINCT {quoted(name)}) AS n FROM {TABLE}")["n"][0])

    def _drawn(self) -> str:
        if self.answer is None:
            raise refuse("--plot", _("the table has no answer that is a number"))
        return self.answer.name

    def _lines(self) -> Any:
        name = self._drawn()
        goal = self.goals[0] if self.goals and not self.of else Goal(name=name)
        columns = [
            column
            for column in self.results.columns
            if (column.role == "point" and self._varies(column)) or column.role == "answer"
        ]
        columns.sort(key=lambda column: (column.role != "point", column.name != name))
        rows = self.results.sample([column.name for column in columns], DRAWN, where=self.where)
        return parallel_figure(columns, rows, goal=goal, total=self.results.count(self.where))

    def _pareto(self) -> Any:
        names = [goal.name for goal in self.goals]
        others = self.results.sample(names, DOTTED, where=self.where)
        return pareto_figure(self.results.columns, self.goals, self.rows, others)

    def _map(self) -> Any:
        over = self.over or self._fields()[:2]
        if len(over) < 2:
            raise refuse("--kind", _("a map needs two fields that vary; name them by --over"))
        found = map_of(self.results, over[0], over[1], self._drawn(), where=self.where)
        cells = found.values.size
        how = _("mean of the points of a cell") if found.points > cells else ""
        return heat_figure(found.across, found.up, found.value, found.x, found.y, found.values, how=how)

    def _histogram(self) -> Any:
        found = histogram_of(self.results, self._drawn(), where=self.where)
        marks = {_("mean"): found.mean} if found.mean == found.mean else {}
        return histogram_figure(found.column, found.edges, found.counts, marks=marks, unknown=found.unknown)

    def _tornado(self) -> Any:
        return ranks_figure(ranks_of(self.results, self._drawn(), where=self.where))
