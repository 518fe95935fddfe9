"""What designs of a sweep found: whom the spread is owed to, where limits begin to be broken, how a search went."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cardan.answers.reader import significant
from cardan.batch.search.boundary import Boundary
from cardan.batch.search.optimise import Optimum
from cardan.batch.search.pareto import ParetoSet
from cardan.batch.search.sobol import OneAtATime, Sensitivity
from cardan.batch.table.views import Ranks
from cardan.batch.work import Column
from cardan.figures.axes import axis
from cardan.figures.figure import Axis, Bars, Curve, Figure, Panel, Row, Rule, Series
from cardan.maths.arrays import Array
from cardan.texts import _, plural

from .sweep import amount, axis_of, counted, name_of, pareto_figure, title_of

BARS = 14  # fields with a bar of their own, the weightiest
DOTS = 4000  # evaluated places that are drawn at most


def sensitivity_figures(found: Sensitivity) -> tuple[Figure, ...]:
    """Return a figure for each answer: the share of its variance that each field brings about."""
    return tuple(sensitivity_figure(found, k) for k in range(len(found.answers)))


def sensitivity_figure(found: Sensitivity, answer: int = 0) -> Figure:
    """Return the shares of the variance of one answer, the greatest field first, with their ranges."""
    order = found.ranked(answer)[:BARS][::-1]  # the greatest stands on top
    at = np.arange(len(order), dtype=float)
    total, first = (np.nan_to_num(one[answer][list(order)]) for one in (found.total, found.first))
    series: list[Series] = [
        Bars(at=at + 0.2, size=np.maximum(total, 0.0), lying=True, thick=0.36, roles=("accent",), label=_("in all")),
        Bars(at=at - 0.2, size=np.maximum(first, 0.0), lying=True, thick=0.36, roles=("cross",), label=_("alone")),
    ]
    for ranges, shift in ((found.total_range, 0.2), (found.first_range, -0.2)):
        for place, k in zip(at, order, strict=True):
            low, high = ranges[answer, k]
            if np.isfinite(low):
                series.append(Curve(x=np.asarray([low, high]), y=np.full(2, place + shift), role="ink", width=1.2))
    highest = max(1.0, float(np.max(np.nan_to_num(found.total_range[answer]), initial=0.0)))
    column = found.answers[answer]
    x = axis(_("share of the variance"), "", [], include=(0.0, highest), margin=0.02, count=6)
    panel = Panel(series=tuple(series), x=x, y=_fields(found.fields, order), title=" ")
    return Figure(
        name=f"sensitivity-{answer + 1}",
        title=_("Shares of the variance: {name}").format(name=name_of(column)),
        sentence=_owed(found, answer),
        source=_("Sobol' indices of {samples} samples; lines: where they lie with {share} %").format(
            samples=counted(found.samples), share=significant(100.0 * found.confidence, 2)
        ),
        rows=(Row(panels=(panel,), height=0.34 * max(len(order), 2) + 0.2),),
    )


def _fields(fields: Sequence[Column], order: Sequence[int]) -> Axis:
    ticks = tuple(float(k) for k in range(len(order)))
    return Axis(
        low=-0.6, high=len(order) - 0.4, ticks=ticks, texts=tuple(name_of(fields[k]) for k in order), grid=False
    )


def _owed(found: Sensitivity, answer: int) -> str:
    column = found.answers[answer]
    if not np.any(np.isfinite(found.total[answer])):
        return _("The answer does not vary.")
    first, *rest = found.ranked(answer)
    share = found.total[answer]
    mean, deviation = float(found.mean[answer]), float(found.deviation[answer])
    text = _("{name} is {mean} ± {deviation}: {share} % of its variance is due to {field}")
    said = text.format(
        name=name_of(column),
        mean=amount(column, mean if abs(mean) > 1e-6 * deviation else 0.0),
        deviation=amount(column, deviation),
        share=f"{100.0 * float(share[first]):.0f}",
        field=name_of(found.fields[first]),
    )
    said = said[:1].upper() + said[1:]
    if rest and share[rest[0]] > 0.05:
        more = _(", {share} % to {field}")
        said += more.format(share=f"{100.0 * float(share[rest[0]]):.0f}", field=name_of(found.fields[rest[0]]))
    return said + "."


def one_at_a_time_figures(found: OneAtATime) -> tuple[Figure, ...]:
    """Return a figure for each answer: how far each field alone moves it."""
    return tuple(one_at_a_time_figure(found, k) for k in range(len(found.answers)))


def one_at_a_time_figure(found: OneAtATime, answer: int = 0) -> Figure:
    """Return how far one answer moves when one field at a time goes from end to end, the farthest on top."""
    column = found.answers[answer]
    low, high, here = found.at_low[answer], found.at_high[answer], float(found.middle[answer])
    size = np.nan_to_num(np.abs(high - low))
    order = np.argsort(-size, kind="stable")[:BARS][::-1]
    at = np.arange(len(order), dtype=float)
    known = [np.where(np.isfinite(one[order]), one[order], here) for one in (low, high)]
    texts = [[amount(found.fields[k], float(ends[k])) for k in order] for ends in (found.low, found.high)]
    series: list[Series] = [
        Bars(at=at, size=known[0], base=here, lying=True, roles=("cross",), label=_("at its low end")),
        Bars(at=at, size=known[1], base=here, lying=True, roles=("accent",), label=_("at its high end")),
        Rule(value=here, upright=True, role="ink", dash="solid", text=_("as it is")),
    ]
    fields = _fields(found.fields, order.tolist())
    named = tuple(f"{name} ({a} … {b})" for name, a, b in zip(fields.texts, *texts, strict=True))
    y = Axis(low=fields.low, high=fields.high, ticks=fields.ticks, texts=named, grid=False)
    panel = Panel(
        series=tuple(series), x=axis(title_of(column), "", known, include=(here,), margin=0.08, count=6), y=y, title=" "
    )
    most = int(order[-1]) if len(order) else 0
    text = _("{field} moves it farthest, from {low} to {high}.")
    return Figure(
        name=f"swings-{answer + 1}",
        title=_("One field at a time: {name}").format(name=name_of(column)),
        sentence=text.format(
            field=name_of(found.fields[most]),
            low=amount(column, float(low[most])),
            high=amount(column, float(high[most])),
        ),
        source=_("all other fields as they are"),
        rows=(Row(panels=(panel,), height=0.3 * max(len(order), 2) + 0.2),),
    )


def ranks_figure(found: Ranks) -> Figure:
    """Return how an answer rises and falls with each field, the weightiest on top."""
    order = list(range(len(found.fields)))[:BARS][::-1]
    at = np.arange(len(order), dtype=float)
    weight = found.correlation[order]
    bars = Bars(at=at, size=weight, lying=True, roles=tuple("accent" if w > 0.0 else "cross" for w in weight))
    series = (bars, Rule(value=0.0, upright=True, role="ink", dash="solid"))
    x = axis(_("rank correlation: 1 rises always, −1 falls always"), "", [], include=(-1.0, 1.0), margin=0.02, count=8)
    panel = Panel(series=series, x=x, y=_fields(found.fields, order), title=" ")
    said = _("No field that varies goes with it.")
    if order:
        weightiest = name_of(found.fields[0])
        text = (
            _("It rises most steadily with {field}.") if weight[-1] > 0.0 else _("It falls most steadily with {field}.")
        )
        said = text.format(field=weightiest)
    return Figure(
        name="ranks",
        title=_("What it goes with: {name}").format(name=name_of(found.answer)),
        sentence=said,
        source=_("rank correlations (Spearman) of {count} points").format(count=counted(found.points)),
        rows=(Row(panels=(panel,), height=0.3 * max(len(order), 2) + 0.2),),
        legend=False,
    )


def boundary_figure(found: Boundary) -> Figure:
    """Return the lines at which limits begin to be broken, with the places that were evaluated."""
    step = max(1, -(-len(found.places) // DOTS))
    places, kept = found.places[::step], found.kept[::step]
    series: list[Series] = [
        Curve(x=places[~kept, 0], y=places[~kept, 1], role="faint", width=0.0, marker=2.4, label=_("broken")),
        Curve(x=places[kept, 0], y=places[kept, 1], role="good", width=0.0, marker=2.0, label=_("kept")),
    ]
    for k, line in enumerate(found.lines):
        label = _("boundary") if k == 0 else ""
        series.append(Curve(x=line[:, 0], y=line[:, 1], role="accent", width=1.8, label=label))
    across, up = found.fields
    box = [np.asarray(one) for one in found.bounds]
    panel = Panel(
        series=tuple(series), x=axis_of(across, box[0], margin=0.0, count=8), y=axis_of(up, box[1], margin=0.0)
    )
    text = plural(
        "{count} line parts where {limits} holds from where it does not.",
        "{count} lines part where {limits} holds from where it does not.",
        len(found.lines),
    )
    said = text.format(count=len(found.lines), limits=_(" and ").join(str(limit) for limit in found.limits))
    if not found.lines:
        said = _("The limits are kept everywhere.") if np.all(found.kept) else _("The limits are kept nowhere.")
    return Figure(
        name="boundary",
        title=_("Where the limits are kept"),
        sentence=said,
        source=_("{evaluations} points evaluated; a grid as fine has {grid}").format(
            evaluations=counted(found.evaluations), grid=counted(found.grid)
        ),
        rows=(Row(panels=(panel,), height=3.6),),
    )


def pareto_set_figure(found: ParetoSet) -> Figure:
    """Return the points of a search between two goals."""
    return pareto_figure((*found.fields, *found.answers), found.goals, found.values)


def optimum_figure(found: Optimum) -> Figure:
    """Return how the best value became better with the points evaluated."""
    column = next(one for one in found.answers if one.name == found.goal.name)
    asked, best = found.history.T if len(found.history) else (np.empty(0), np.empty(0))
    x: Array = np.append(np.repeat(asked, 2)[1:], found.evaluations) if len(asked) else asked
    y: Array = np.repeat(best, 2) if len(asked) else best
    panel = Panel(
        series=(Curve(x=x, y=y, role="accent"),),
        x=axis(_("points evaluated"), "", [x], include=(0.0,), margin=0.02, count=8),
        y=axis(title_of(column), "", [best]),
    )
    said = _("No point keeps the limits.")
    if len(asked):
        text = _("The best is {value} at {point}.")
        point = ", ".join(
            f"{name_of(one)} = {significant(float(value), 4)}"
            for one, value in zip(found.fields, found.point, strict=True)
        )
        value = "≈ 0" if abs(found.value) <= found.uncertainty else amount(column, found.value, 4)
        said = text.format(value=value, point=point)
    source = str(found.goal) + "".join(f"; {limit}" for limit in found.limits)
    rows = (Row(panels=(panel,), height=2.0),)
    return Figure(name="search", title=_("How the search went"), sentence=said, source=source, rows=rows, legend=False)
