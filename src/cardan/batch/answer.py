"""What there is to say of a sweep: how many points are answered, its reductions, what is missing and how to go on."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from cardan.answers.answer import Answer, Column, Remark, Table
from cardan.answers.quantity import Joined, Quantity, Text, say
from cardan.figures.figure import Figure
from cardan.mechanism.mechanism import Mechanism
from cardan.questions.gathering import has
from cardan.texts import _, plural

from .answering.questions import asked
from .figures.sweep import curve_figure, heat_figure
from .search.answer import quantity, shown
from .show_answer import counted, missing_rows, stored
from .sweep import SweepWork
from .table.swept import Sweep
from .work import Column as Field

SHOWN = 12  # rows of a table that are shown where no reduction is asked for
GROUPS = 24  # groups of a reduction that are shown


def answer(
    work: SweepWork, found: Sweep, plan: Path, *, keeps: bool, of: Sequence[str] = (), rows: int = SHOWN
) -> Answer:
    """Return what there is to say of a sweep.

    keeps: whether its table is there; of: answers that are drawn, the first by default; rows: of the table, shown.
    """
    counts = found.reductions.get("points", {})
    answered = int(counts.get("answered", 0))
    failed = "warning" if found.status == "cancelled" else "failed"
    return Answer(
        name="sweep",
        title=_("Sweep"),
        sentence=_sentence(found, counts, answered),
        tone=failed if found.missing else "plain" if answered else "warning",  # type: ignore[arg-type]
        tables=tuple(_tables(found, keeps, rows)),
        figures=lambda: tuple(drawn(work, found, of)) if keeps else (),
        remarks=tuple(_remarks(work, found, plan, keeps)),
        facts=_facts(found, plan, keeps),
        full=lambda: _whole(found),
        code=0 if found.status == "done" else 1,
    )


def _whole(found: Sweep) -> Iterator[Table]:
    """Yield the rows of the table piece by piece."""
    for _start, part in found.parts():
        yield stored({one.name: part[one.name] for one in found.columns})


def _sentence(found: Sweep, counts: Mapping[str, Any], answered: int) -> Text:
    done = found.size - sum(one.stop - one.start for one in found.missing)
    if found.missing:
        text = _("{done} of {all} points are done, {answered} answered.")
    elif answered == done:
        text = _("all {all} points are answered.")
    else:
        text = _("of {all} points {answered} are answered.")
    said = say(text, done=counted(done), all=counted(found.size), answered=counted(answered))
    if "feasible" not in counts:
        return said
    more = say(_("{count} of them keep every constraint."), count=counted(int(counts["feasible"])))
    return Joined([said, more], between=" ")


def over(work: SweepWork) -> tuple[Field, ...]:
    """Return the fields of a sweep that can be drawn: of a grid over one or two; none of all others."""
    axes = work.points.axes
    alone = all(len(axis.fields) == 1 and not axis.facts for axis in axes)
    return work.columns[: len(axes)] if alone and len(axes) in (1, 2) else ()


def drawn(work: SweepWork, found: Sweep, of: Sequence[str] = ()) -> Iterator[Figure]:
    """Yield the figures of a sweep over one or two fields: answers as curves, or as maps.

    of: names of answers, the first by default.
    """
    fields, answers = over(work), {one.name: one for one in work.ask.answers}
    rows = found.table() if fields and not found.missing else {}
    for name in of or list(answers)[:1] if rows else ():
        if len(fields) == 1:
            yield curve_figure(fields[0], answers[name], rows[fields[0].name], rows[name])
            continue
        up, across = ((one, *np.unique(rows[one.name], return_inverse=True)) for one in fields)
        cells = np.full((len(up[1]), len(across[1])), np.nan)
        cells[up[2], across[2]] = rows[name]
        yield heat_figure(across[0], up[0], answers[name], across[1], up[1], cells)


def _tables(found: Sweep, keeps: bool, rows: int) -> Iterator[Table]:
    told = {name: one for name, one in found.reductions.items() if one.get("kind") not in ("points", None)}
    single = {name: one for name, one in told.items() if "groups" not in one and one["kind"] != "histogram"}
    if single:
        yield Table(
            columns=(
                Column(key="", heading=_("over all points"), values=list(single), left=True),
                Column(key="", heading=_("value"), values=[_value(one, one.get("value")) for one in single.values()]),
                Column(key="", heading=_("where"), values=list(map(_where, single.values())), left=True, wrap=True),
            )
        )
    for name, one in told.items():
        if "groups" in one and one["kind"] != "histogram":
            yield _grouped(name, one)
        elif one["kind"] == "histogram" and "groups" not in one:
            yield _histogram(name, one)
    if not told and keeps:
        yield _rows(found, rows)


def _value(one: Mapping[str, Any], value: Any, digits: int = 5) -> Any:
    """Return a value of a reduction, told with its unit."""
    return quantity(_field(one), float(value), digits) if isinstance(value, int | float) else value


def _field(one: Mapping[str, Any]) -> Field:
    return Field(name="value", unit=one.get("unit") or "", role="answer", text="")


def _where(one: Mapping[str, Any]) -> Text:
    """Return what stands beside a value: its point, or how far it may be off."""
    if "point" in one:
        return Joined([say("{key} = {value}", key=key, value=_short(value)) for key, value in one["point"].items()])
    if one.get("bound"):
        return say(_("within {bound}"), bound=_value(one, float(one["bound"]), 2))
    return ""


def _short(value: Any) -> Any:
    return Quantity(value, digits=6, trim=True) if isinstance(value, float) else str(value)


def _grouped(name: str, one: Mapping[str, Any]) -> Table:
    pairs = list(zip(one["groups"], one["values"], strict=True))
    few = pairs[:GROUPS]
    text = _("{name}: the first {count} of {all}")
    title = name if len(pairs) <= GROUPS else text.format(name=name, count=GROUPS, all=len(pairs))
    keys = list(one["groups"][0])
    return Table(
        title=title,
        columns=(
            *(
                Column(key="", heading=key, values=[group[key] for group, _one in few], digits=6, trim=True)
                for key in keys
            ),
            shown(_field(one), [value.get("value") for _group, value in few], heading=_("value")),
        ),
    )


def _histogram(name: str, one: Mapping[str, Any]) -> Table:
    edges = [float(edge) for edge in one["edges"]]
    count = min(len(edges) - 1, len(one["counts"]))
    return Table(
        title=name,
        columns=(
            shown(_field(one), edges[:count], heading=_("from")),
            shown(_field(one), edges[1 : count + 1], heading=_("to")),
            Column(key="", heading=_("points"), values=[int(value) for value in one["counts"][:count]]),
        ),
        fixed=2,
    )


def _rows(found: Sweep, most: int) -> Table:
    """Return the first rows of the table."""
    values: dict[str, list[Any]] = {one.name: [] for one in found.columns}
    count = 0
    for _start, part in found.parts():
        for name, held in values.items():
            held.extend(np.asarray(part[name])[: most - count].tolist())
        count = len(next(iter(values.values()), ()))
        if count >= most:
            break
    return Table(columns=[shown(one, values[one.name], heading=one.name) for one in found.columns], fixed=0)


def _remarks(work: SweepWork, found: Sweep, plan: Path, keeps: bool) -> Iterator[Remark]:
    counts = found.reductions.get("points", {})
    for key, row in counts.get("first", {}).items():
        n = int(counts[key])
        text = plural(
            "{count} point has a question without an answer, row {row}: {why}",
            "{count} points have a question without an answer, the first of them in row {row}: {why}",
            n,
        )
        if key == "no_drive":
            text = plural(
                "{count} point makes no drive, row {row}: {why}",
                "{count} points make no drive, the first of them in row {row}: {why}",
                n,
            )
            if isinstance(work.ask.drive, Mechanism):
                text = plural(
                    "{count} point makes no mechanism, row {row}: {why}",
                    "{count} points make no mechanism, the first of them in row {row}: {why}",
                    n,
                )
        why = "; ".join(str(one) for one in work.why(int(row))[:3])
        yield Remark(text=say(text, count=counted(n), row=int(row), why=why), tone="warning")
    yield from _as_drawn(work)
    yield from missing_rows(found.missing)
    if len(found.missing) > 3:
        more = len(found.missing) - 3
        text = plural("Missing: {count} further stretch of rows.", "Missing: {count} further stretches of rows.", more)
        yield Remark(text=say(text, count=more))
    if found.damaged:
        yield Remark(text=_("Made again, because damaged: {names}").format(names=", ".join(found.damaged[:5])))
    if found.missing and found.folder is not None:
        command = ("cardan", "sweep", _plan(plan), "--into", _near(found.folder), "--resume")
        yield Remark(text=_("To go on:"), command=command, tone="next")
    elif found.folder is not None and keeps:
        yield Remark(text=_("To look at it:"), command=("cardan", "sweep", "show", _near(found.folder)), tone="next")
    elif found.folder is None:
        keeping = ("cardan", "sweep", _plan(plan), "--into", plan.stem)
        yield Remark(text=_("No table was kept; to keep one:"), command=keeping, tone="next")


def _as_drawn(work: SweepWork) -> Iterator[Remark]:
    """Yield which columns are of the drive as drawn, and what of it does not count there."""
    drive, left = work.ask.drive, dict[tuple[str, ...], list[str]]()
    if isinstance(drive, Mechanism):
        return
    there = [aspect for aspect, one in has(drive).items() if one]
    for question in asked(work.ask.questions):
        without = tuple(aspect for aspect in there if aspect not in question.counts)
        left.setdefault(without, []).extend(one.name for one in question.columns(drive))
    words: dict[str, str] = {
        "pose": _("poses"),
        "movement": _("movements"),
        "case": _("load cases"),
        "error": _("errors of the joints as made"),
    }
    for aspects, columns in left.items():
        if aspects:
            text = _("{columns}: of the drive as drawn at its duty; {what} do not count there.")
            said = say(text, columns=", ".join(columns), what=", ".join(words[one] for one in aspects))
            yield Remark(text=said, code="as_drawn")


def _near(folder: Path) -> str:
    """Return a folder as it is written from here."""
    here = Path.cwd()
    return str(folder.relative_to(here) if folder.is_relative_to(here) and folder != here else folder)


def _plan(file: Path) -> str:
    """Return a plan as it is written on the command line."""
    return f"./{file}" if str(file) == "show" else str(file)


def _facts(found: Sweep, plan: Path, keeps: bool) -> dict[str, Any]:
    held = keeps and found.folder is None
    return {
        "plan": str(plan),
        "points": found.size,
        "status": found.status,
        "missing": [{"start": one.start, "stop": one.stop, "why": one.why} for one in found.missing],
        "folder": None if found.folder is None else str(found.folder),
        "columns": [{"name": one.name, "unit": one.unit, "role": one.role} for one in found.columns],
        "reductions": dict(found.reductions),
        "provenance": dict(found.provenance),
        **({"table": {name: values.tolist() for name, values in found.table().items()}} if held else {}),
    }
