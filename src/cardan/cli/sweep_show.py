"""``cardan sweep show``: the results of a sweep."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from cardan.texts import _, plural
from cardan.units import thousands

from .options import AsCsv, AsJson, Plot

if TYPE_CHECKING:
    from .answer import Answer, Cell, Remark, Table
    from .sweep_asked import Asked

KINDS = ("lines", "pareto", "map", "histogram", "tornado")

SHOWN = 12
"""Rows that stand in the terminal."""

WIDEST = 8
"""Columns of rows that stand in the terminal; all are in CSV and JSON."""

LISTED = 10_000
"""Rows that JSON holds."""


def sweep_show(
    results: Annotated[
        Path,
        typer.Argument(metavar="RESULTS", help=_("Folder that a sweep was run into."), show_default=False),
    ],
    best: Annotated[
        str | None,
        typer.Option(
            "--best", metavar="GOAL", help=_('The best points by a goal: "min irregularity".'), show_default=False
        ),
    ] = None,
    pareto: Annotated[
        list[str] | None,
        typer.Option(
            "--pareto",
            metavar="GOAL",
            help=_("The points of which none is better in all goals; give two goals or more, each by --pareto."),
            show_default=False,
        ),
    ] = None,
    limit: Annotated[
        list[str] | None,
        typer.Option(
            "--limit",
            metavar="LIMIT",
            help=_('What a point has to keep: "bend_deg[1] <= 12"; may be repeated.'),
            show_default=False,
        ),
    ] = None,
    where: Annotated[
        str,
        typer.Option(
            "--where", metavar="SQL", help=_("Only points that fulfil a condition in SQL."), show_default=False
        ),
    ] = "",
    query: Annotated[
        str | None,
        typer.Option(
            "--query",
            metavar="SQL",
            help=_("Answer a SELECT of the table sweep instead; nothing is changed by it."),
            show_default=False,
        ),
    ] = None,
    count: Annotated[int, typer.Option("--count", metavar="N", min=1, help=_("How many of the best points."))] = SHOWN,
    kind: Annotated[
        list[str] | None,
        typer.Option(
            "--kind",
            metavar="KIND",
            help=_("What --plot draws: lines, pareto, map, histogram or tornado; may be repeated; else what suits."),
            show_default=False,
        ),
    ] = None,
    of: Annotated[
        str | None,
        typer.Option(
            "--of", metavar="COLUMN", help=_("The answer that is drawn; the first by default."), show_default=False
        ),
    ] = None,
    over: Annotated[
        list[str] | None,
        typer.Option(
            "--over",
            metavar="COLUMN",
            help=_("The two fields of a map; the first two that hold numbers by default."),
            show_default=False,
        ),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            "--export",
            metavar="PATH",
            help=_("Write the points told to PATH: .csv, .parquet or .xlsx."),
            show_default=False,
        ),
    ] = None,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Look at the table of a sweep: the best points, pictures, exports."""
    from .show import check_common, show

    check_common(json=json, csv=csv, plot=plot)
    kinds = tuple(kind or ())
    _check(best, pareto, query, kinds, out)

    from cardan.batch.search.goals import goal_of, limit_of
    from cardan.batch.table.results import results as read

    from .sweep_asked import Asked

    asked = Asked(
        results=read(results),
        path=results,
        goals=tuple(goal_of(text) for text in ([best] if best else pareto or ())),
        limits=tuple(limit_of(text) for text in limit or ()),
        where=where,
        count=count,
        query=query or "",
        of=of or "",
        over=tuple(over or ()),
        kinds=kinds,
    )
    asked.check()
    exported = None if out is None else (out, asked.export(out))
    return show(_answer(asked, exported), json=json, csv=csv, plot=plot)


def _check(
    best: str | None, pareto: Sequence[str] | None, query: str | None, kinds: Sequence[str], out: Path | None
) -> None:
    """Refuse options that are none or contradict each other, before any work is done."""
    from cardan.errors import Problem, check

    problems = []
    for one in kinds:
        if one not in KINDS:
            text = _("{value} is none of {choices}")
            problems.append(Problem("--kind", text.format(value=repr(one), choices=", ".join(KINDS))))
    given = [name for name, value in (("--best", best), ("--pareto", pareto), ("--query", query)) if value]
    if len(given) > 1:
        problems.append(Problem(given[1], _("choose one of {options}").format(options=", ".join(given))))
    if pareto is not None and 0 < len(pareto) < 2:
        problems.append(Problem("--pareto", _("needs two goals or more; one is for --best")))
    check(problems)
    if out is not None:
        from .output import check_target

        check_target(out, "--export")


def _answer(asked: Asked, exported: tuple[Path, int] | None) -> Answer:
    from .answer import Answer

    missing = asked.results.sweep.missing
    return Answer(
        sentence=_sentence(asked),
        tone="warning" if missing else "plain",
        tables=lambda: list(_tables(asked)),
        remarks=tuple(_remarks(asked, exported)),
        content=lambda: _content(asked, exported),
        csv=lambda: _whole(asked),
        figure=asked.figures,
    )


def _sentence(asked: Asked) -> str:
    from .answer import significant

    name = asked.name
    if asked.query:
        text = plural("{name}: {count} row answers this.", "{name}: {count} rows answer this.", asked.length)
        return text.format(name=name, count=thousands(asked.length))
    all_points = asked.results.count(asked.where)
    if not asked.goals:
        answer = asked.answer
        if answer is None or not all_points:
            return _("{name}: {count} points.").format(name=name, count=thousands(all_points))
        span = asked.spans[answer.name]
        if span["most"] != span["most"]:
            return _("{name}: {count} points, none of them answered.").format(name=name, count=thousands(all_points))
        text = _("{name}: {count} points; {answer} lies between {low} and {high}.")
        return text.format(
            name=name,
            count=thousands(all_points),
            answer=_called(asked, answer.name),
            low=significant(_told(span["least"], asked.results.units[answer.name])),
            high=_with_unit(asked, answer.name, span["most"]),
        )
    if not asked.length:
        return _("{name}: none of {count} points was answered and keeps the limits.").format(
            name=name, count=thousands(all_points)
        )
    if len(asked.goals) > 1:
        text = _("{name}: {chosen} of {count} points are Pareto-optimal: none is better in all goals.")
        return text.format(name=name, count=thousands(all_points), chosen=thousands(asked.length))
    goal = asked.goals[0]
    text = _("{name}: the best of {count} points has {answer} {value}.")
    value = float(asked.rows[goal.name][0])
    return text.format(
        name=name,
        count=thousands(all_points),
        answer=_called(asked, goal.name),
        value=_with_unit(asked, goal.name, value),
    )


def _called(asked: Asked, name: str) -> str:
    """Return what a column is called: by its meaning where it has one of its own."""
    column = asked.results.column(name)
    return _(column.text) if column.role == "answer" and column.text and "[" not in name else name


def _with_unit(asked: Asked, name: str, value: float) -> str:
    from cardan.units import label

    from .answer import significant

    unit = asked.results.units[name]
    printed = label(unit) if unit else ""
    return f"{significant(_told(value, unit))}{'' if printed in ('', '°', '′') else ' '}{printed}"


def _told(value: Any, unit: str) -> Any:
    """Return a value as the terminal tells it: a number without a unit that is nothing but rounding is 0."""
    from cardan.maths.ties import tidied

    return tidied(value) if isinstance(value, float) and not unit else value


def _tables(asked: Asked) -> Iterator[Table]:
    from .answer import Column, Table

    if asked.query or asked.goals:
        yield _rows(asked)
        return
    columns = (
        Column(key="column", heading=_("column"), left=True),
        Column(key="unit", heading=_("unit"), left=True),
        Column(key="least", heading=_("least"), form="5"),
        Column(key="mean", heading=_("mean"), form="5"),
        Column(key="most", heading=_("greatest"), form="5"),
        Column(key="unknown", heading=_("none"), form=".0f"),
    )
    units = asked.results.units
    rows: list[list[Cell]] = [
        [
            name,
            _printed(units[name]),
            *(_told(span[key], units[name]) for key in ("least", "mean", "most")),
            span["unknown"],
        ]
        for name, span in asked.spans.items()
    ]
    yield Table(columns=columns, rows=rows)


def _rows(asked: Asked) -> Table:
    """Return the rows chosen, as many as a terminal shows."""
    from .answer import Column, Table

    units = asked.results.units
    names = asked.shown(WIDEST)
    columns = tuple(
        Column(
            key=name,
            heading=_called(asked, name) if name in units and len(_called(asked, name)) < 24 else name,
            unit=_printed(units.get(name, "")),
            form="5",
            left=asked.rows[name].dtype.kind in "OU",
        )
        for name in names
    )
    lists = [[_told(one, units.get(name, "")) for one in asked.rows[name][:SHOWN].tolist()] for name in names]
    return Table(columns=columns, rows=[list(row) for row in zip(*lists, strict=True)], fixed=0)


def _printed(unit: str) -> str:
    from cardan.units import label

    return label(unit) if unit else ""


def _remarks(asked: Asked, exported: tuple[Path, int] | None) -> Iterator[Remark]:
    from .answer import Remark

    shown = asked.shown(WIDEST) if asked.query or asked.goals else ()
    if (asked.query or asked.goals) and asked.length > SHOWN:
        text = _("The first {count} of {all} rows are shown; --csv and --export give all.")
        yield Remark(text=text.format(count=SHOWN, all=thousands(asked.length)))
    if shown and len(shown) < len(asked.rows):
        more = len(asked.rows) - len(shown)
        text = plural(
            "{count} further column is in --csv, --json and --export.",
            "{count} further columns are in --csv, --json and --export.",
            more,
        )
        yield Remark(text=text.format(count=more))
    for one in asked.results.sweep.missing[:3]:
        text = _("Missing: rows {start} to {stop}: {why}")
        yield Remark(
            text=text.format(start=thousands(one.start), stop=thousands(one.stop - 1), why=one.why), tone="warning"
        )
    if exported is not None:
        text = plural("{count} row written: {path}", "{count} rows written: {path}", exported[1])
        yield Remark(text=text.format(count=thousands(exported[1]), path=exported[0]))
    answer = asked.answer
    if not asked.goals and not asked.query and answer is not None:
        command = ("cardan", "sweep", "show", str(asked.path), "--best", f"min {answer.name}")
        yield Remark(text=_("For the best points:"), command=command, tone="next")


def _content(asked: Asked, exported: tuple[Path, int] | None) -> dict[str, Any]:
    results = asked.results
    chosen: dict[str, Any] = {}
    if asked.query or asked.goals:
        chosen = {
            "rows": {name: column[:LISTED].tolist() for name, column in asked.rows.items()},
            "count": asked.length,
        }
    else:
        chosen = {"spans": asked.spans, "count": results.count(asked.where)}
    return {
        "question": "sweep show",
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


def _whole(asked: Asked) -> Table:
    """Return the rows told as a table for CSV; those of the whole table are read piece by piece."""
    from .answer import Column, Table

    if asked.query or asked.goals:
        lists = [column.tolist() for column in asked.rows.values()]
        rows: Any = zip(*lists, strict=True)
        return Table(columns=tuple(Column(key=name) for name in asked.rows), rows=rows)
    names = [column.name for column in asked.results.columns]
    return Table(columns=tuple(Column(key=name) for name in names), rows=asked.streamed())  # type: ignore[arg-type]
