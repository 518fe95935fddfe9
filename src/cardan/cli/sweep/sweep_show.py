"""``cardan sweep show``: the results of a sweep."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from cardan.batch.search.goals import goal_of, limit_of
from cardan.batch.show_answer import SHOWN, Asked, answer
from cardan.batch.table.results import results as read
from cardan.cli.shared.output import check_common, check_target
from cardan.cli.shared.source import AsCsv, AsJson, Plot
from cardan.cli.shared.tell import tell
from cardan.errors import Problem, check
from cardan.io.sweep_export import export
from cardan.texts import _

KINDS = ("lines", "pareto", "map", "histogram", "tornado")


def sweep_show(
    results: Annotated[
        Path, typer.Argument(metavar="RESULTS", help=_("Folder that a sweep was run into."), show_default=False)
    ],
    best: Annotated[
        str | None,
        typer.Option(
            "--best", metavar="GOAL", help=_('The best points by a goal: "min speed_fluctuation".'), show_default=False
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
            help=_('What a point has to keep: "joint_angle_deg[1] <= 12"; may be repeated.'),
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
    check_common(json=json, csv=csv, plot=plot)
    kinds = tuple(kind or ())
    _check(best, pareto, query, kinds, out)

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
    exported = None
    if out is not None:
        chosen = asked.rows if asked.query or asked.goals else None
        exported = (out, export(asked.results, out, rows=chosen, where=asked.where))
    return tell(answer(asked, exported), name=asked.name, json=json, csv=csv, plot=plot)


def _check(
    best: str | None, pareto: Sequence[str] | None, query: str | None, kinds: Sequence[str], out: Path | None
) -> None:
    """Refuse options that are none or contradict each other, before any work is done."""
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
        check_target(out, "--export")
