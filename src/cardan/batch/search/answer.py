"""What there is to say of designs of a sweep: a search, a choice, shares of the variance, a boundary."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

from cardan.answers.answer import Answer, Column, Remark, Table
from cardan.answers.quantity import Joined, Quantity, Text, say
from cardan.batch.work import Column as Field
from cardan.figures import for_result
from cardan.maths.ties import tidied
from cardan.texts import _, plural
from cardan.units import dimension_of, factor

from .boundary import Boundary
from .optimise import Optimum
from .pareto import ParetoSet
from .sobol import Sensitivity

SHOWN = 12  # points of a choice that people are shown


def answer(found: Optimum | ParetoSet | Sensitivity | Boundary) -> Answer:
    """Return what there is to say of what a design found."""
    if isinstance(found, Optimum):
        return answer_of_optimum(found)
    if isinstance(found, ParetoSet):
        return answer_of_choice(found)
    return answer_of_boundary(found) if isinstance(found, Boundary) else answer_of_sensitivity(found)


def quantity(column: Field, value: float, digits: int = 4) -> Quantity:
    """Return a value of a column, told in the unit of the column unless the reader chose another.

    value: in its unit; digits: significant digits.
    """
    dimension = dimension_of(column.unit)
    size = factor(dimension, column.unit) if dimension else 1.0
    told = float(value) * size if dimension else tidied(float(value))
    return Quantity(told, dimension, digits, unit=column.unit if dimension else "")


def called(column: Field) -> str:
    """Return what a column is called: by its meaning where it has one of its own."""
    return _(column.text) if column.role == "answer" and column.text and "[" not in column.name else column.name


def shown(column: Field, values: Sequence[Any], digits: int = 5, *, heading: str = "") -> Column:
    """Return a column of a sweep for people: its values in the unit of the reader."""
    dimension = dimension_of(column.unit)
    size = factor(dimension, column.unit) if dimension else 1.0
    told = [(one * size if dimension else tidied(one)) if isinstance(one, float) else one for one in values]
    unit = column.unit if dimension else ""
    return Column(
        key=column.name, heading=heading or called(column), values=told, dimension=dimension, unit=unit, digits=digits
    )


def answer_of_optimum(found: Optimum) -> Answer:
    """Return what there is to say of a search for the best point."""
    goal = next(column for column in found.answers if column.name == found.goal.name)
    rows = list(zip(found.fields, found.point.tolist(), strict=True))
    rows += [(column, found.values[column.name]) for column in found.answers if column.name in found.values]
    count = Quantity(found.evaluations, decimals=0)
    sentence = say(_("none of {count} evaluated points keeps the limits."), count=count)
    vanishes = abs(found.value) <= found.uncertainty
    if found.feasible and found.values:
        text = _("{goal} is {value}, with {count} points evaluated.")
        if vanishes:
            text = _("{goal} is zero, as closely as {count} evaluated points can tell.")
        sentence = say(text, goal=str(found.goal), value=quantity(goal, found.value), count=count)
    table = Table(
        columns=(
            Column(key="", heading=_("at the best point"), values=[called(column) for column, _value in rows]),
            Column(
                key="",
                heading=_("value"),
                values=["≈ 0" if vanishes and column is goal else quantity(column, value, 6) for column, value in rows],
            ),
        )
    )
    return Answer(
        name="search",
        title=_("Search"),
        sentence=sentence,
        tone="plain" if found.status == "converged" else "warning",
        tables=(table,) if found.values else (),
        remarks=tuple(_told_optimum(found)),
        figures=lambda: for_result(found),
        facts={
            "status": found.status,
            "goal": str(found.goal),
            "limits": [str(limit) for limit in found.limits],
            "point": {column.name: value for column, value in zip(found.fields, found.point.tolist(), strict=True)},
            "values": dict(found.values),
            "excess": found.excess,
            "evaluations": found.evaluations,
            "history": found.history.tolist(),
        },
        full=lambda: Table(
            columns=(
                Column(key="name", values=[column.name for column, _value in rows]),
                Column(key="unit", values=[column.unit for column, _value in rows]),
                Column(key="value", values=[value for _column, value in rows]),
            )
        ),
        code=0 if found.status in ("converged", "not converged") else 1,
    )


def _stopped(status: str) -> Iterator[Remark]:
    if status == "cancelled":
        yield Remark(text=_("Stopped: this is what was found until then."), tone="warning")


def _told_optimum(found: Optimum) -> Iterator[Remark]:
    yield from _stopped(found.status)
    if found.status == "converged":
        yield Remark(text=_("The search has converged."), tone="good")
    elif found.status == "not converged":
        yield Remark(text=_("The search has not converged: a better point may be near."), tone="warning")
    elif found.status == "nothing found" and found.values:
        text = _("The point told breaks the limits least, by {share}.")
        yield Remark(text=say(text, share=Quantity(found.excess, "share")), tone="warning")


def answer_of_choice(found: ParetoSet) -> Answer:
    """Return what there is to say of points of which none is better in all goals."""
    goals = [next(column for column in found.answers if column.name == goal.name) for goal in found.goals]
    columns = [*goals, *found.fields]
    lists = [found.values[goal.name].tolist() for goal in found.goals] + found.points.T.tolist()
    others = [column for column in found.answers if column not in columns]
    every = [*columns, *others]
    whole = [*lists, *(found.values[column.name].tolist() for column in others)]
    count = len(found.points)
    step = max(1, -(-count // SHOWN))
    few = Table(columns=[shown(c, values[::step]) for c, values in zip(columns, lists, strict=True)], fixed=0)
    some = [Remark(text=_("Some of them are shown; --csv and --json give all."))] if count > SHOWN else []
    return Answer(
        name="search",
        title=_("Search"),
        sentence=say(
            _("{count} of {all} evaluated points are Pareto-optimal: none is better in all goals."),
            count=Quantity(count, decimals=0),
            all=Quantity(found.evaluations, decimals=0),
        ),
        tone="plain" if found.status == "done" else "warning",
        tables=(few,) if count else (),
        remarks=(*_stopped(found.status), *some),
        figures=lambda: for_result(found),
        facts={
            "status": found.status,
            "goals": [str(goal) for goal in found.goals],
            "limits": [str(limit) for limit in found.limits],
            "points": {column.name: values for column, values in zip(every, whole, strict=True)},
            "evaluations": found.evaluations,
        },
        full=lambda: Table(columns=[Column(key=c.name, values=v) for c, v in zip(every, whole, strict=True)]),
        code=0 if found.status == "done" else 1,
    )


def answer_of_sensitivity(found: Sensitivity) -> Answer:
    """Return what there is to say of the shares of the variance."""
    headings = (
        ("alone", _("alone"), found.first),
        ("in_all", _("in all"), found.total),
        ("low", _("in all, from"), found.total_range[..., 0]),
        ("high", _("to"), found.total_range[..., 1]),
    )

    def table(k: int, column: Field) -> Table:
        ranked = found.ranked(k)
        return Table(
            title=_("{name}: shares of the variance").format(name=called(column)),
            columns=(
                Column(key="", heading=_("field"), values=[found.fields[i].name for i in ranked], left=True),
                *(
                    Column(key="", heading=heading, values=[float(values[k][i]) for i in ranked], decimals=3)
                    for _key, heading, values in headings
                ),
            ),
        )

    pairs = [(k, i) for k in range(len(found.answers)) for i in range(len(found.fields))]
    left_out = []
    if found.left_out:
        text = _("{count} of {all} samples have a point without an answer and are left out.")
        number, every = (Quantity(one, decimals=0) for one in (found.left_out, found.samples + found.left_out))
        left_out.append(Remark(text=say(text, count=number, all=every), tone="warning"))
    return Answer(
        name="sensitivity",
        title=_("Sensitivity"),
        sentence=_shares(found),
        tone="plain" if found.status == "done" else "warning",
        tables=tuple(table(k, column) for k, column in enumerate(found.answers)) if found.samples else (),
        remarks=(*_stopped(found.status), *left_out),
        figures=lambda: for_result(found),
        facts={
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
        full=lambda: Table(
            columns=(
                Column(key="answer", values=[found.answers[k].name for k, _i in pairs]),
                Column(key="field", values=[found.fields[i].name for _k, i in pairs]),
                *(Column(key=key, values=[float(values[k][i]) for k, i in pairs]) for key, _head, values in headings),
            )
        ),
        code=0 if found.status == "done" else 1,
    )


def _shares(found: Sensitivity) -> Text:
    if found.status != "done":
        return _("stopped before the shares were known.")
    first = found.ranked(0)[0]
    return say(
        _("{answer} is {mean} ± {deviation}; {share} of its variance is due to {field}."),
        answer=called(found.answers[0]),
        mean=quantity(found.answers[0], float(found.mean[0])),
        deviation=quantity(found.answers[0], float(found.deviation[0])),
        share=Quantity(float(found.total[0][first]), "share"),
        field=found.fields[first].name,
    )


def answer_of_boundary(found: Boundary) -> Answer:
    """Return what there is to say of the lines at which limits begin to be broken."""
    names = [column.name for column in found.fields]
    limits = Joined([str(limit) for limit in found.limits], between=_(" and "))
    text = plural("{count} line bounds where {limits}.", "{count} lines bound where {limits}.", len(found.lines))
    sentence: Text = say(text, count=len(found.lines), limits=limits)
    if not found.lines:
        kept = bool(found.kept.all())
        sentence = _("the limits are kept everywhere.") if kept else _("the limits are kept nowhere.")
    lines = found.lines[:SHOWN]
    ends = [
        replace(shown(field, [float(end(line[:, k])) for line in lines]), heading=f"{field.name} {word}")
        for k, field in enumerate(found.fields)
        for end, word in ((min, _("from")), (max, _("to")))
    ]
    points = [(n, *point) for n, line in enumerate(found.lines, start=1) for point in line.tolist()]
    table = Table(
        columns=(
            Column(key="", heading=_("line"), values=list(range(1, len(lines) + 1))),
            Column(key="", heading=_("points"), values=[len(line) for line in lines]),
            *ends,
        )
    )
    text = _("{count} points were evaluated; a grid as fine has {grid}.")
    spared = say(text, count=Quantity(found.evaluations, decimals=0), grid=Quantity(found.grid, decimals=0))
    return Answer(
        name="boundary",
        title=_("Boundary"),
        sentence=sentence,
        tone="plain" if found.status == "done" else "warning",
        tables=(table,) if found.lines else (),
        remarks=(*_stopped(found.status), Remark(text=spared)),
        figures=lambda: for_result(found),
        facts={
            "status": found.status,
            "fields": names,
            "limits": [str(limit) for limit in found.limits],
            "lines": [line.tolist() for line in found.lines],
            "evaluations": found.evaluations,
            "grid": found.grid,
        },
        full=lambda: Table(
            columns=(
                Column(key="line", values=[one[0] for one in points]),
                *(Column(key=name, values=[one[k] for one in points]) for k, name in enumerate(names, start=1)),
            )
        ),
        code=0 if found.status == "done" else 1,
    )
