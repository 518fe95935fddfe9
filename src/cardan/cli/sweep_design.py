"""``cardan sweep PLAN --design``: designs that choose their points themselves."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cardan.texts import _
from cardan.units import thousands

if TYPE_CHECKING:
    from cardan.batch.search.boundary import Boundary
    from cardan.batch.search.optimise import Optimum
    from cardan.batch.search.pareto import ParetoSet
    from cardan.batch.search.sobol import Sensitivity
    from cardan.batch.work import Column
    from cardan.io.plan_file import Plan

    from .answer import Answer, Cell, Remark, Table

SHOWN = 12
"""Points of a choice that stand in the terminal."""


def designed(read: Plan, file: Path, name: str, *, json: bool, csv: bool, plot: Path | None) -> int:
    """Run a design of a plan and tell what it found.

    Parameters
    ----------
    read : Plan
        The plan.
    file : Path
        Its file.
    name : str
        Table of the design.
    json, csv : bool
        ``--json`` and ``--csv``.
    plot : Path or None
        ``--plot``.
    """
    from cardan.batch.search.boundary import Boundary
    from cardan.batch.search.optimise import Optimum
    from cardan.batch.search.pareto import ParetoSet
    from cardan.io.plan_designs import design_of

    from .failure import about
    from .show import show
    from .torsion_parts import ended, keeping

    with about(str(file)):
        design = design_of(read, name)
    with keeping(_("choosing points")) as progress, about(str(file)):
        found = design.run(progress)
    title = read.title or read.drive.name or file.stem
    if isinstance(found, Optimum):
        answer = _optimum(found, title)
    elif isinstance(found, ParetoSet):
        answer = _choice(found, title)
    elif isinstance(found, Boundary):
        answer = _boundary(found, title)
    else:
        answer = _owing(found, title)
    return ended(show(answer, json=json, csv=csv, plot=plot), progress)


def _drawn(found: Any) -> Any:
    from cardan.figures import for_result

    return for_result(found)


def _stopped(status: str) -> Iterator[Remark]:
    from .answer import Remark

    if status == "cancelled":
        yield Remark(text=_("Stopped: this is what was found until then."), tone="warning")


def _head(column: Column) -> tuple[str, str]:
    """Return heading and unit of a column."""
    from cardan.units import label

    told = column.role == "answer" and column.text and "[" not in column.name
    return (_(column.text) if told else column.name), (label(column.unit) if column.unit else "")


def _value(column: Column, value: float) -> str:
    from cardan.units import label

    from .answer import significant

    printed = label(column.unit) if column.unit else ""
    return f"{significant(value)}{'' if printed in ('', '°', '′') else ' '}{printed}"


def _optimum(found: Optimum, title: str) -> Answer:
    from .answer import Answer, Column, Table

    goal = next(column for column in found.answers if column.name == found.goal.name)
    rows: list[list[Cell]] = []
    for column, value in zip(found.fields, found.point.tolist(), strict=True):
        rows.append([*_head(column), value])
    for column in found.answers:
        if column.name in found.values:
            rows.append([*_head(column), found.values[column.name]])
    columns = (
        Column(key="name", heading=_("at the best point"), left=True),
        Column(key="unit", heading=_("unit"), left=True),
        Column(key="value", heading=_("value"), form="6"),
    )
    table = Table(columns=columns, rows=rows)
    nought = abs(found.value) <= found.uncertainty
    told = [[*row[:2], "≈ 0"] if nought and row[:2] == [*_head(goal)] else row for row in rows]
    if found.feasible and found.values:
        text = _("{name}: {goal} comes to {value} with {count} points asked.")
        if nought:
            text = _("{name}: {goal} comes to nought, as closely as {count} points asked can tell.")
        said = text.format(
            name=title, goal=str(found.goal), value=_value(goal, found.value), count=thousands(found.evaluations)
        )
    else:
        said = _("{name}: none of {count} points asked keeps the limits.").format(
            name=title, count=thousands(found.evaluations)
        )
    return Answer(
        sentence=said,
        tone="plain" if found.status == "converged" else "warning",
        tables=lambda: [Table(columns=columns, rows=told)] if found.values else [],
        remarks=tuple(_told_optimum(found)),
        content=lambda: {
            "question": "search",
            "status": found.status,
            "goal": str(found.goal),
            "limits": [str(limit) for limit in found.limits],
            "point": {column.name: value for column, value in zip(found.fields, found.point.tolist(), strict=True)},
            "values": dict(found.values),
            "excess": found.excess,
            "evaluations": found.evaluations,
            "history": found.history.tolist(),
        },
        csv=lambda: table,
        figure=lambda: _drawn(found),
        code=0 if found.status in ("converged", "not converged") else 1,
    )


def _told_optimum(found: Optimum) -> Iterator[Remark]:
    from .answer import Remark, percent

    yield from _stopped(found.status)
    if found.status == "converged":
        yield Remark(text=_("The search has converged."), tone="good")
    elif found.status == "not converged":
        yield Remark(text=_("The search has not converged: a better point may be near."), tone="warning")
    elif found.status == "nothing found" and found.values:
        text = _("The point told breaks the limits least, by {share}.")
        yield Remark(text=text.format(share=percent(found.excess)), tone="warning")


def _choice(found: ParetoSet, title: str) -> Answer:
    from .answer import Answer, Column, Remark, Table

    columns = [*(next(c for c in found.answers if c.name == goal.name) for goal in found.goals), *found.fields]
    lists = [found.values[goal.name].tolist() for goal in found.goals] + found.points.T.tolist()
    others = [column for column in found.answers if column not in columns]
    every = [*columns, *others]
    whole = [*lists, *(found.values[column.name].tolist() for column in others)]
    count = len(found.points)

    def table(chosen: list[Any], values: list[list[Any]], most: int | None) -> Table:
        step = max(1, -(-count // most)) if most else 1
        told = tuple(Column(key=c.name, heading=_head(c)[0], unit=_head(c)[1], form="5") for c in chosen)
        return Table(columns=told, rows=[list(row) for row in zip(*values, strict=True)][::step], fixed=0)

    text = _("{name}: {count} points of {all} asked are a choice, none better in all goals.")
    remarks = [*_stopped(found.status)]
    if count > SHOWN:
        remarks.append(Remark(text=_("Some of them are shown; --csv and --json give all.")))
    return Answer(
        sentence=text.format(name=title, count=thousands(count), all=thousands(found.evaluations)),
        tone="plain" if found.status == "done" else "warning",
        tables=lambda: [table(columns, lists, SHOWN)] if count else [],
        remarks=tuple(remarks),
        content=lambda: {
            "question": "search",
            "status": found.status,
            "goals": [str(goal) for goal in found.goals],
            "limits": [str(limit) for limit in found.limits],
            "points": {column.name: values for column, values in zip(every, whole, strict=True)},
            "evaluations": found.evaluations,
        },
        csv=lambda: table(every, whole, None),
        figure=lambda: _drawn(found),
        code=0 if found.status == "done" else 1,
    )


def _owing(found: Sensitivity, title: str) -> Answer:
    from .answer import Answer, Column, Remark, Table, percent

    headings = (
        ("alone", _("alone"), found.first),
        ("in_all", _("in all"), found.total),
        ("low", _("in all, from"), found.total_range[..., 0]),
        ("high", _("to"), found.total_range[..., 1]),
    )

    def table(k: int, column: Any) -> Table:
        return Table(
            title=_("{name}: shares of the variance").format(name=_head(column)[0]),
            columns=(
                Column(key="field", heading=_("field"), left=True),
                *(Column(key=key, heading=heading, form=".3f") for key, heading, _values in headings),
            ),
            rows=[
                [found.fields[i].name, *(float(values[k][i]) for _key, _heading, values in headings)]
                for i in found.ranked(k)
            ],
        )

    def rows() -> Table:
        columns = (
            Column(key="answer", left=True),
            Column(key="field", left=True),
            *(Column(key=key) for key, _heading, _values in headings),
        )
        told: list[list[Cell]] = [
            [answer.name, field.name, *(float(values[k][i]) for _key, _heading, values in headings)]
            for k, answer in enumerate(found.answers)
            for i, field in enumerate(found.fields)
        ]
        return Table(columns=columns, rows=told)

    remarks = [*_stopped(found.status)]
    if found.left_out:
        text = _("{count} of {all} samples have a point without an answer and are left out.")
        all_samples = found.samples + found.left_out
        remarks.append(
            Remark(text=text.format(count=thousands(found.left_out), all=thousands(all_samples)), tone="warning")
        )
    said = _("{name}: stopped before the shares were known.").format(name=title)
    if found.status == "done":
        first = found.ranked(0)[0]
        share = float(found.total[0][first])
        text = _("{name}: {answer} is {mean} ± {deviation}; {share} of its variance goes with {field}.")
        said = text.format(
            name=title,
            answer=_head(found.answers[0])[0],
            mean=_value(found.answers[0], float(found.mean[0])),
            deviation=_value(found.answers[0], float(found.deviation[0])),
            share=percent(share) if share == share else "–",
            field=found.fields[first].name,
        )
    return Answer(
        sentence=said,
        tone="plain" if found.status == "done" else "warning",
        tables=lambda: [table(k, column) for k, column in enumerate(found.answers)] if found.samples else [],
        remarks=tuple(remarks),
        content=lambda: {
            "question": "sensitivity",
            "status": found.status,
            "fields": [column.name for column in found.fields],
            "answers": {
                column.name: {
                    "first": found.first[k].tolist(),
                    "first_range": found.first_range[k].tolist(),
                    "total": found.total[k].tolist(),
                    "total_range": found.total_range[k].tolist(),
                    "mean": float(found.mean[k]),
                    "deviation": float(found.deviation[k]),
                }
                for k, column in enumerate(found.answers)
            },
            "confidence": found.confidence,
            "samples": found.samples,
            "left_out": found.left_out,
            "evaluations": found.evaluations,
        },
        csv=rows,
        figure=lambda: _drawn(found),
        code=0 if found.status == "done" else 1,
    )


def _boundary(found: Boundary, title: str) -> Answer:
    from cardan.texts import plural

    from .answer import Answer, Column, Table

    names = [column.name for column in found.fields]
    text = plural(
        "{name}: {count} line bounds where {limits}.",
        "{name}: {count} lines bound where {limits}.",
        len(found.lines),
    )
    said = text.format(
        name=title,
        count=len(found.lines),
        limits=_(" and ").join(str(limit) for limit in found.limits),
    )
    if not found.lines:
        kept = bool(found.kept.all())
        said = (
            _("{name}: the limits are kept everywhere.") if kept else _("{name}: the limits are kept nowhere.")
        ).format(name=title)
    columns = (
        Column(key="line", heading=_("line")),
        Column(key="points", heading=_("points")),
        *(
            Column(key=f"{end}_{k}", heading=f"{name} {word}", form="5")
            for k, name in enumerate(names)
            for end, word in (("from", _("from")), ("to", _("to")))
        ),
    )
    rows: list[list[Cell]] = [
        [
            n,
            len(line),
            *(float(end) for k in (0, 1) for end in (line[:, k].min(), line[:, k].max())),
        ]
        for n, line in enumerate(found.lines, start=1)
    ]
    return Answer(
        sentence=said,
        tone="plain" if found.status == "done" else "warning",
        tables=lambda: [Table(columns=columns, rows=rows[:SHOWN])] if rows else [],
        remarks=tuple(_spared(found)),
        content=lambda: {
            "question": "boundary",
            "status": found.status,
            "fields": names,
            "limits": [str(limit) for limit in found.limits],
            "lines": [line.tolist() for line in found.lines],
            "evaluations": found.evaluations,
            "grid": found.grid,
        },
        csv=lambda: Table(
            columns=(Column(key="line"), *(Column(key=name) for name in names)),
            rows=[[n, *point] for n, line in enumerate(found.lines, start=1) for point in line.tolist()],
        ),
        figure=lambda: _drawn(found),
        code=0 if found.status == "done" else 1,
    )


def _spared(found: Boundary) -> Iterator[Remark]:
    from .answer import Remark

    yield from _stopped(found.status)
    text = _("{count} points were asked; a grid as fine has {grid}.")
    yield Remark(text=text.format(count=thousands(found.evaluations), grid=thousands(found.grid)))
