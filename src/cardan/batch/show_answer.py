"""What there is to say of the table of a sweep: its spans, the best points, a choice, an answer to SQL."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from cardan.answers.answer import Answer, Column, Remark, Table
from cardan.answers.quantity import Quantity, Text, say
from cardan.batch.figures.designs import ranks_figure
from cardan.batch.figures.sweep import heat_figure, histogram_figure, parallel_figure, pareto_figure
from cardan.batch.search.goals import Goal, Limit, check_names
from cardan.batch.table.results import TABLE, Results, quoted
from cardan.batch.table.views import histogram_of, map_of, ranks_of
from cardan.errors import refuse
from cardan.texts import _, plural

from .search.answer import called, quantity, shown
from .work import Column as SweepColumn
from .work import Rows

# What ``cardan sweep show`` was asked: the rows that are told, and the pictures that suit them.

DRAWN = 500  # points that are drawn as lines
DOTTED = 3000  # points that are drawn as dots
FEW = 160  # values of a field that make a map of its own grid


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
    def answer(self) -> SweepColumn | None:
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

    def _varies(self, column: SweepColumn) -> bool:
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


SHOWN = 12  # rows that people are shown
WIDEST = 8  # columns of rows that people are shown; all are in CSV and JSON
LISTED = 10_000  # rows that JSON holds
LONG = 24  # letters of a heading at most; a column with more is called by its name in the table


def answer(asked: Asked, exported: tuple[Path, int] | None = None) -> Answer:
    """Return what there is to say of what was asked of a table.

    asked: the table, and what is wanted of it; exported (path, int): where rows were written, and how many.
    """
    return Answer(
        name="sweep show",
        title=_("Results of the sweep"),
        sentence=_sentence(asked),
        tone="warning" if asked.results.sweep.missing else "plain",
        tables=(_rows(asked) if asked.query or asked.goals else _spans(asked),),
        remarks=tuple(_remarks(asked, exported)),
        figures=asked.figures,
        facts=_facts(asked, exported),
        full=lambda: _whole(asked),
    )


def counted(count: int) -> Quantity:
    """Return a number of points."""
    return Quantity(count, decimals=0)


def missing_rows(missing: Any) -> Iterator[Remark]:
    """Yield the first stretches of rows that are missing."""
    text = _("Missing: rows {start} to {stop}: {why}")
    for one in missing[:3]:
        said = say(text, start=counted(one.start), stop=counted(one.stop - 1), why=str(one.why))
        yield Remark(text=said, tone="warning")


def _sentence(asked: Asked) -> Text:
    results = asked.results
    if asked.query:
        text = plural("{count} row answers this.", "{count} rows answer this.", asked.length)
        return say(text, count=counted(asked.length))
    every = results.count(asked.where)
    count = counted(every)
    if not asked.goals:
        column = asked.answer
        if column is None or not every:
            return say(_("{count} points."), count=count)
        span = asked.spans[column.name]
        if span["most"] != span["most"]:
            return say(_("{count} points, none of them answered."), count=count)
        text = _("{count} points; {answer} lies between {low:bare} and {high}.")
        low, high = (quantity(column, span[end]) for end in ("least", "most"))
        return say(text, count=count, answer=called(column), low=low, high=high)
    if not asked.length:
        return say(_("none of {count} points was answered and keeps the limits."), count=count)
    if len(asked.goals) > 1:
        text = _("{chosen} of {count} points are Pareto-optimal: none is better in all goals.")
        return say(text, count=count, chosen=counted(asked.length))
    column = results.column(asked.goals[0].name)
    text = _("the best of {count} points has {answer} {value}.")
    return say(text, count=count, answer=called(column), value=quantity(column, float(asked.rows[column.name][0])))


def _spans(asked: Asked) -> Table:
    """Return least, mean and greatest of all columns."""
    spans = [(asked.results.column(name), span) for name, span in asked.spans.items()]

    def told(end: str) -> list[Quantity]:
        return [quantity(column, span[end], 5) for column, span in spans]

    return Table(
        columns=(
            Column(key="", heading=_("column"), values=[column.name for column, _span in spans], left=True),
            Column(key="", heading=_("least"), values=told("least")),
            Column(key="", heading=_("mean"), values=told("mean")),
            Column(key="", heading=_("greatest"), values=told("most")),
            Column(key="", heading=_("none"), values=[counted(int(span["unknown"])) for _column, span in spans]),
        )
    )


def _rows(asked: Asked) -> Table:
    """Return the rows chosen, as many as people are shown."""
    known = {column.name: column for column in asked.results.columns}
    columns = []
    for name in asked.shown(WIDEST):
        values = asked.rows[name][:SHOWN].tolist()
        if name not in known:
            columns.append(Column(key=name, heading=name, values=values, digits=5))
            continue
        heading = called(known[name]) if len(called(known[name])) < LONG else name
        columns.append(shown(known[name], values, heading=heading))
    return Table(columns=columns, fixed=0)


def _remarks(asked: Asked, exported: tuple[Path, int] | None) -> Iterator[Remark]:
    few = asked.shown(WIDEST) if asked.query or asked.goals else ()
    if (asked.query or asked.goals) and asked.length > SHOWN:
        text = _("The first {count} of {all} rows are shown; --csv and --export give all.")
        yield Remark(text=say(text, count=SHOWN, all=counted(asked.length)))
    if few and len(few) < len(asked.rows):
        more = len(asked.rows) - len(few)
        text = plural(
            "{count} further column is in --csv, --json and --export.",
            "{count} further columns are in --csv, --json and --export.",
            more,
        )
        yield Remark(text=say(text, count=more))
    yield from missing_rows(asked.results.sweep.missing)
    if exported is not None:
        text = plural("{count} row written: {path}", "{count} rows written: {path}", exported[1])
        yield Remark(text=say(text, count=counted(exported[1]), path=str(exported[0])))
    column = asked.answer
    if not asked.goals and not asked.query and column is not None:
        command = ("cardan", "sweep", "show", str(asked.path), "--best", f"min {column.name}")
        yield Remark(text=_("For the best points:"), command=command, tone="next")


def _facts(asked: Asked, exported: tuple[Path, int] | None) -> dict[str, Any]:
    results = asked.results
    chosen: dict[str, Any] = (
        {"spans": asked.spans, "count": results.count(asked.where)}
        if not (asked.query or asked.goals)
        else {"rows": {name: column[:LISTED].tolist() for name, column in asked.rows.items()}, "count": asked.length}
    )
    return {
        "folder": str(asked.path),
        "points": results.sweep.size,
        "status": results.sweep.status,
        "missing": [{"start": one.start, "stop": one.stop, "why": one.why} for one in results.sweep.missing],
        "columns": [
            {"name": one.name, "unit": one.unit, "role": one.role, "text": _(one.text) if one.text else ""}
            for one in results.columns
        ],
        **chosen,
        "reductions": dict(results.sweep.reductions),
        "provenance": dict(results.provenance),
        **({} if exported is None else {"exported": str(exported[0])}),
    }


def _whole(asked: Asked) -> Iterator[Table]:
    """Yield the rows told as they are stored; those of the whole table piece by piece."""
    if asked.query or asked.goals:
        yield stored(asked.rows)
        return
    for piece in asked.results.pieces(where=asked.where):
        yield stored(piece)


def stored(rows: Any) -> Table:
    """Return rows as they are stored, under the names of the table."""
    return Table(columns=[Column(key=name, values=values.tolist()) for name, values in rows.items()])
