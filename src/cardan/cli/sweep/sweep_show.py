"""``cardan sweep show``: the results of a sweep."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

from cardan.batch.search.goals import goal_of, limit_of
from cardan.batch.show_answer import SHOWN, Asked, answer
from cardan.batch.table.results import results as read
from cardan.cli.shared.options import argument, option
from cardan.cli.shared.output import check_common, check_target
from cardan.cli.shared.source import AsCsv, AsJson, Plot
from cardan.cli.shared.tell import tell
from cardan.errors import Problem, check
from cardan.io.sweep_export import export
from cardan.texts import _

KINDS = ("lines", "pareto", "map", "histogram", "tornado")


def sweep_show(
    results: Annotated[Path, argument("RESULTS", _("Folder that a sweep was run into."))],
    best: Annotated[
        str | None, option("--best", "GOAL", _('The best points by a goal: "min speed_fluctuation_percent".'))
    ] = None,
    pareto: Annotated[
        list[str] | None,
        option(
            "--pareto",
            "GOAL",
            _("The points of which none is better in all goals; give two goals or more, each by --pareto."),
        ),
    ] = None,
    limit: Annotated[
        list[str] | None,
        option("--limit", "LIMIT", _('What a point has to keep: "joint_angle_deg[1] <= 12"; may be repeated.')),
    ] = None,
    where: Annotated[str, option("--where", "SQL", _("Only points that fulfil a condition in SQL."))] = "",
    query: Annotated[
        str | None, option("--query", "SQL", _("Answer a SELECT of the table sweep instead; nothing is changed by it."))
    ] = None,
    count: Annotated[int, option("--count", "N", _("How many of the best points."), min=1)] = SHOWN,
    kind: Annotated[
        list[str] | None,
        option(
            "--kind",
            "KIND",
            _("What --plot draws: lines, pareto, map, histogram or tornado; may be repeated; else what suits."),
        ),
    ] = None,
    of: Annotated[str | None, option("--of", "COLUMN", _("The answer that is drawn; the first by default."))] = None,
    over: Annotated[
        list[str] | None,
        option("--over", "COLUMN", _("The two fields of a map; the first two that hold numbers by default.")),
    ] = None,
    out: Annotated[
        Path | None, option("--export", "PATH", _("Write the points told to PATH: .csv, .parquet or .xlsx."))
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
