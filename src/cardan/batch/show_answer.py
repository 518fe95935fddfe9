"""What there is to say of the table of a sweep: its spans, the best points, a choice, an answer to SQL."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from cardan.answers.answer import Answer, Column, Remark, Table
from cardan.answers.quantity import Quantity, Text, say
from cardan.texts import _, plural

from .asked import Asked
from .search.answer import called, quantity, shown

SHOWN = 12
"""Rows that people are shown."""

WIDEST = 8
"""Columns of rows that people are shown; all are in CSV and JSON."""

LISTED = 10_000
"""Rows that JSON holds."""

LONG = 24
"""Letters of a heading at most; a column with more is called by its name in the table."""


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
        else {
            "rows": {name: column[:LISTED].tolist() for name, column in asked.rows.items()},
            "count": asked.length,
        }
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
