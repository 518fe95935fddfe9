"""The points of a sweep on paper: lines across columns, dots between goals, maps, how often a value occurs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from cardan.answers.reader import reader, significant
from cardan.batch.search.goals import Goal
from cardan.batch.work import Column, Rows
from cardan.figures.axes import axis, written
from cardan.figures.figure import Axis, Bars, Cells, Curve, Figure, Note, Panel, Row, Rule, Series
from cardan.maths.arrays import Array
from cardan.maths.ties import NOTHING, foremost, tidied
from cardan.texts import _, plural
from cardan.units import label, thousands

FINER = (0.4, 0.65, 0.8, 0.9, 0.96, 1.0)
"""Shares of the lines below each shade, from the worst to the best: few are dark."""

CLASSES = len(FINER)  # shades of lines and dots
BEST = 0.1  # share of the points that is called the best
MOST_COLUMNS = 9  # columns that a figure of lines has room for


LETTERS = 240  # letters of the names in three lines across the figure, about; those at the ends have half the room


def parallel_figure(
    columns: Sequence[Column], rows: Rows, *, goal: Goal | None = None, total: int | None = None
) -> Figure:
    """Return every point as a line across its columns, the darker the better it meets a goal.

    columns: from the left; those beyond `MOST_COLUMNS` are left out.
    rows, mapping of str to array (n,): points, all of the table or some drawn from it.
    goal: by which lines are shaded and drawn one over the other; total: points of the whole table.
    """
    shown = list(columns[:MOST_COLUMNS])
    count = len(rows[shown[0].name]) if shown else 0
    table = [levels(rows[column.name]) for column in shown]
    places = np.stack([_spread(values) for values, _words in table], axis=1) if shown else np.empty((0, 0))
    series: list[Series] = []
    for role, chosen, width in _shaded(rows, goal, count):
        lines = np.full((len(chosen), len(shown) + 1), np.nan)
        lines[:, :-1] = places[chosen]
        across = np.tile([*range(len(shown)), np.nan], len(chosen))
        series.append(Curve(x=across, y=lines.ravel(), role=role, width=width))
    for k, (column, (values, words)) in enumerate(zip(shown, table, strict=True)):
        series.append(Curve(x=np.full(2, float(k)), y=np.asarray([0.0, 1.0]), role="ink", width=0.9))
        series += _scale_notes(k, column, values, words, len(shown))
    x = Axis(low=-0.12, high=max(len(shown) - 1, 1) + 0.12, grid=False)
    panel = Panel(series=tuple(series), x=x, y=Axis(low=-0.09, high=1.36, grid=False), bare=True)
    text = plural("{count} point", "{count} points", count)
    if total is not None and total > count:
        text = plural("{count} of {total} points", "{count} of {total} points", count)
    source = text.format(count=counted(count), total=counted(total or count)) + (
        "; " + _("the darker a line, the smaller {goal}").format(goal=_named(shown, goal.name))
        if goal and not goal.largest
        else "; " + _("the darker a line, the greater {goal}").format(goal=_named(shown, goal.name))
        if goal
        else ""
    )
    return Figure(
        name="sweep-lines",
        title=_("Every point as a line"),
        sentence=_narrowest(shown, table, rows, goal),
        source=source,
        rows=(Row(panels=(panel,), height=3.6),),
        legend=False,
    )


def _shaded(rows: Rows, goal: Goal | None, count: int) -> list[tuple[str, Array, float]]:
    """Return colour, rows and width of lines, the worst first."""
    if goal is None or not count:
        return [("scale 0.5", np.arange(count), 0.6)]
    cost = goal.cost(rows)
    known = np.flatnonzero(np.isfinite(cost))
    order = known[np.argsort(-cost[known], kind="stable")]
    parts = np.split(order, np.rint(np.asarray(FINER[:-1]) * len(order)).astype(int))
    unknown = np.flatnonzero(~np.isfinite(cost))
    found = [("faint", unknown, 0.5)] if len(unknown) else []
    for k, part in enumerate(parts):
        share = (k + 0.7) / CLASSES
        found.append((f"scale {share:.3f}", part, 0.5 + 0.7 * (k / (CLASSES - 1)) ** 3))
    return [one for one in found if len(one[1])]


def _spread(values: Array) -> Array:
    """Return values between 0, their least, and 1, their greatest; the middle where they are all one."""
    known = values[np.isfinite(values)]
    low, high = (float(np.min(known)), float(np.max(known))) if known.size else (0.0, 0.0)
    found: Array = (values - low) / (high - low) if high > low else np.where(np.isfinite(values), 0.5, np.nan)
    return found


def _scale_notes(k: int, column: Column, values: Array, words: Sequence[str], count: int) -> list[Series]:
    """Return name, unit and ends of an upright axis; names stand in lines in turn."""
    side = "left" if k == 0 else "right" if k + 1 == count else "centre"
    level = 1.13 + 0.09 * (k % (3 if count > 4 else 2))
    name = shortened(title_of(column), max(14, LETTERS // count))
    notes: list[Series] = [Note(text=name, x=float(k), y=level, side=side, size=7.6, bold=True)]  # type: ignore[arg-type]
    if words and len(words) < 8:
        at = np.linspace(0.0, 1.0, len(words)) if len(words) > 1 else [0.5]
        return notes + [
            Note(text=word, x=float(k), y=float(place), side="left", size=7.2, shift=(4.0, 0.0))
            for word, place in zip(words, at, strict=True)
        ]
    low, high = (words[0], words[-1]) if words else ends(values)
    return [
        *notes,
        Note(text=low, x=float(k), y=-0.05, size=7.2, role="muted", side=side),  # type: ignore[arg-type]
        Note(text=high, x=float(k), y=1.05, size=7.2, role="muted", side=side),  # type: ignore[arg-type]
    ]


def _narrowest(
    shown: Sequence[Column], table: Sequence[tuple[Array, tuple[str, ...]]], rows: Rows, goal: Goal | None
) -> str:
    """Return what the best points have in common."""
    if goal is None:
        return _("Each line is a point: where lines bunch, points are alike.")
    cost = goal.cost(rows)
    known = np.flatnonzero(np.isfinite(cost))
    if len(known) < 2.0 / BEST:
        return _("Each line is a point; the darkest lines meet the goal best.")
    best = known[np.argsort(cost[known], kind="stable")[: max(2, int(BEST * len(known)))]]
    found = []
    for column, (values, words) in zip(shown, table, strict=True):
        whole, part = values[np.isfinite(values)], values[best]
        if words or column.role != "point" or not whole.size or not np.ptp(whole):
            continue
        found.append((float(np.ptp(part) / np.ptp(whole)), column, float(np.min(part)), float(np.max(part))))
    if not found or min(found, key=lambda one: one[0])[0] > 0.9:
        return _("The best tenth of the points lies all over the fields.")
    _share, column, low, high = min(found, key=lambda one: one[0])
    text = _("The best tenth of the points has {name} between {low} and {high}.")
    return text.format(name=name_of(column), low=amount(column, low), high=amount(column, high))


def _named(columns: Sequence[Column], name: str) -> str:
    return next((name_of(column) for column in columns if column.name == name), name)


def pareto_figure(columns: Sequence[Column], goals: Sequence[Goal], front: Rows, others: Rows | None = None) -> Figure:
    """Return points by two goals, those that none beats in ink; a third goal shades them.

    goals: two or more; the first runs across, the second upwards, the third is the shade.
    front, mapping of str to array (n,): the rows that none beats.
    others, mapping of str to array (m,): other rows, drawn pale.
    """
    by = {column.name: column for column in columns}
    across, up = (by[goal.name] for goal in goals[:2])
    x, y = (np.asarray(front[goal.name], dtype=float) for goal in goals[:2])
    series: list[Series] = []
    if others is not None:
        pale = [np.asarray(others[goal.name], dtype=float) for goal in goals[:2]]
        label = _("other points")
        series.append(Curve(x=pale[0], y=pale[1], role="faint", width=0.0, marker=3.0, label=label))
    label = _("none is better in both") if len(goals) == 2 else _("none is better in all goals")
    if len(goals) == 2 and len(x):
        series.append(_staircase(x, y, goals))
        series.append(Curve(x=x, y=y, role="accent", width=0.0, marker=5.0, label=label))
    elif len(x):
        shade = _spread(goals[2].cost(front))
        for k in range(CLASSES):
            part = (shade >= k / CLASSES) & ((shade < (k + 1) / CLASSES) | (k + 1 == CLASSES))
            if np.any(part):
                role = f"scale {1.0 - 0.75 * (k + 0.3) / CLASSES:.3f}"
                series.append(Curve(x=x[part], y=y[part], role=role, width=0.0, marker=5.0))
    both = [x, y] if others is None else [np.concatenate([x, pale[0]]), np.concatenate([y, pale[1]])]
    panel = Panel(series=tuple(series), x=axis_of(across, both[0], count=7), y=axis_of(up, both[1]))
    told = _("each point is a choice; {goals}").format(goals=", ".join(_goal(by, goal) for goal in goals))
    if len(goals) > 2:
        told += "; " + _("the darker a dot, the better by {goal}").format(goal=name_of(by[goals[2].name]))
    rows = (Row(panels=(panel,), height=3.4),)
    return Figure(
        name="pareto", title=_("Pareto front"), sentence=_choice(across, up, goals, x, y), source=told, rows=rows
    )


def _goal(by: Mapping[str, Column], goal: Goal) -> str:
    text = _("{name} as great as can be") if goal.largest else _("{name} as small as can be")
    return text.format(name=name_of(by[goal.name]))


def _staircase(x: Array, y: Array, goals: Sequence[Goal]) -> Curve:
    """Return the line between what can be had and what cannot."""
    order = np.argsort(goals[0].cost({goals[0].name: x}), kind="stable")
    x, y = x[order], y[order]
    steps_x, steps_y = np.repeat(x, 2)[1:], np.repeat(y, 2)[:-1]
    return Curve(x=steps_x, y=steps_y, role="accent", width=1.0)


def _choice(across: Column, up: Column, goals: Sequence[Goal], x: Array, y: Array) -> str:
    if not len(x):
        return _("No point keeps the limits.")
    one, two = (int(np.argmin(goal.cost({goal.name: v}))) for goal, v in zip(goals[:2], (x, y), strict=True))
    text = plural(
        "{count} choice, from {name} {first} with {other} {second} to {name} {third} with {other} {fourth}.",
        "{count} choices, from {name} {first} with {other} {second} to {name} {third} with {other} {fourth}.",
        len(x),
    )
    if len(x) == 1:
        text = _("One choice: {name} {first}, {other} {second}.")
    return text.format(
        count=counted(len(x)),
        name=name_of(across),
        other=name_of(up),
        first=amount(across, float(x[one])),
        second=amount(up, float(y[one])),
        third=amount(across, float(x[two])),
        fourth=amount(up, float(y[two])),
    )


# How columns of a sweep are called on axes, and how their values are written.

LONG = 34  # letters of a name on an axis


def name_of(column: Column) -> str:
    """Return what a column is called: an answer by its meaning, what stands in the file by its path."""
    if column.role == "answer" and column.text and "[" not in column.name:
        return shortened(_(column.text))
    return shortened(column.name)


def shortened(text: str, most: int = LONG) -> str:
    """Return a text that is not too long: of words the first, of a path the last."""
    if len(text) <= most:
        return text
    return text[: most - 1].rstrip() + "…" if " " in text else "…" + text[1 - most :]


def unit_of(column: Column) -> str:
    """Return the printed unit of a column, empty for a plain number."""
    return label(column.unit) if column.unit else ""


def title_of(column: Column) -> str:
    """Return what a column is called, with its unit where the name has none: paths have theirs."""
    unit = unit_of(column) if column.role == "answer" else ""
    return f"{name_of(column)} [{unit}]" if unit else name_of(column)


def amount(column: Column, value: Any, digits: int = 3) -> str:
    """Return a value with its unit."""
    if isinstance(value, str) or value is None:
        return value or "–"
    unit = unit_of(column)
    told = float(value) if unit else tidied(float(value))
    return f"{reader().number(told, digits)}{'' if unit in ('', '°', '′') else ' '}{unit}"


def levels(values: Array) -> tuple[Array, tuple[str, ...]]:
    """Return values as numbers, and the words that stand for 0, 1, 2 … where they are words."""
    column = np.asarray(values)
    if column.dtype.kind in "fiub":
        return column.astype(float), ()
    words, place = np.unique(column.astype(str), return_inverse=True)
    return place.astype(float), tuple(shortened(str(word), 18) for word in words)


def axis_of(column: Column, values: Array, *, margin: float = 0.05, count: int = 5) -> Axis:
    """Return the axis of a column: round ticks, or its words.

    values (n,); margin: share of the range left free at both ends; count: about how many ticks.
    """
    numbers, words = levels(values)
    if words:
        places = tuple(float(k) for k in range(len(words)))
        return Axis(label=name_of(column), low=-0.5, high=len(words) - 0.5, ticks=places, texts=words)
    return axis(title_of(column), "", [numbers], margin=margin, count=count)


def ends(values: Array) -> tuple[str, str]:
    """Return the least and the greatest of values, as short as tells them apart."""
    known = values[np.isfinite(values)]
    if not known.size:
        return "–", "–"
    low, high = float(np.min(known)), float(np.max(known))
    if abs(low) < NOTHING * high:
        low = 0.0
    told = written((low, high)) if high > low else (significant(low, 4),) * 2
    if max(map(len, told)) > 7:
        told = significant(low, 3), significant(high, 3)
    return told[0], told[1]


def counted(count: int) -> str:
    """Return a number of points with thin grouping."""
    return thousands(count)


# The answers of a sweep on paper: over one field as a curve, over two as a map, or how often each value occurs.

DOTS = 60  # points that a curve marks each with a dot


def curve_figure(across: Column, value: Column, x: Array, y: Array) -> Figure:
    """Return a column over one field as a curve through its points.

    x, y (n,): values in the order of the points; where y is nan the curve has a gap.
    """
    numbers, words = levels(x)
    order = np.argsort(numbers, kind="stable")
    dots = 4.0 if len(x) <= DOTS or words else 0.0
    curve = Curve(x=numbers[order], y=y[order], role="accent", marker=dots)
    panel = Panel(series=(curve,), x=axis_of(across, x, margin=0.02, count=8), y=axis_of(value, y))
    return Figure(
        name="sweep-curve",
        title=_("{value} over {across}").format(value=_capital(name_of(value)), across=name_of(across)),
        sentence=_ends_sentence(across, value, x, y),
        source=_("one dot for each point") if dots else _("a curve through all points"),
        rows=(Row(panels=(panel,), height=2.8),),
        legend=False,
    )


def _ends_sentence(across: Column, value: Column, x: Array, y: Array) -> str:
    if not np.any(np.isfinite(y)):
        return _("No point has an answer.")
    y = _rounded_off(y)
    least, most = (int(foremost(y, least=least)) for least in (True, False))
    if least == most:
        return _("It is {value} at every point.").format(value=amount(value, float(y[least])))
    text = _("Least is {low} at {low_x}, greatest {high} at {high_x}.")
    return text.format(
        low=amount(value, float(y[least])),
        low_x=amount(across, x[least].item()),
        high=amount(value, float(y[most])),
        high_x=amount(across, x[most].item()),
    )


WIDE = 0.02  # width of a bar of colours beside a map, a share of the map's


def heat_figure(
    across: Column, up: Column, value: Column, x: Array, y: Array, values: Array, *, how: str = ""
) -> Figure:
    """Return a column over two fields as a map, the darker the greater.

    x, y (m,), (k,): middles of the columns and rows of the map, rising, or words; values (k, m): nan leaves a hole.
    how: what was made of points that share a cell: a word for the sentence below.
    """
    places = [levels(one)[0] for one in (x, y)]
    known = values[np.isfinite(values)]
    low, high = (float(np.min(known)), float(np.max(known))) if known.size else (0.0, 1.0)
    cells = Cells(x=_edges(places[0]), y=_edges(places[1]), values=values, low=low, high=high)
    shades = np.linspace(low, high, 65) if high > low else np.asarray([low - 0.5, low + 0.5])
    middle = 0.5 * (shades[1:] + shades[:-1])
    bar = Cells(x=np.asarray([0.0, 1.0]), y=shades, values=middle[:, None], low=low, high=high)
    panels = (
        Panel(series=(cells,), x=_fitted(across, x, cells.x), y=_fitted(up, y, cells.y), title=title_of(up)),
        Panel(
            series=(bar,),
            x=Axis(low=0.0, high=1.0, grid=False),
            y=axis(title_of(value), "", [shades], margin=0.0, count=6),
            title=unit_of(value) or " ",
        ),
    )
    return Figure(
        name="sweep-map",
        title=_("{value} over {up} and {across}").format(
            value=_capital(name_of(value)), up=name_of(up), across=name_of(across)
        ),
        sentence=_extremes_sentence(across, up, value, x, y, values),
        source=how or _("one cell for each point"),
        rows=(Row(panels=panels, height=3.4, widths=(1.0, WIDE)),),
        legend=False,
    )


def _rounded_off(values: Array) -> Array:
    """Return values, those that are nothing but rounding beside the largest as 0."""
    return np.where(np.abs(values) < NOTHING * np.nanmax(np.abs(values)), 0.0, values)


def _extremes_sentence(across: Column, up: Column, value: Column, x: Array, y: Array, values: Array) -> str:
    if not np.any(np.isfinite(values)):
        return _("No point has an answer.")
    values = _rounded_off(values)
    least, most = (
        np.unravel_index(int(foremost(values.ravel(), least=least)), values.shape) for least in (True, False)
    )
    if least == most:
        return _("It is {value} at every point.").format(value=amount(value, float(values[least])))
    text = _("Least is {low} at {low_x} and {low_y}, greatest {high} at {high_x} and {high_y}.")

    def at(column: Column, where: Array, k: int) -> str:
        one = where[k]
        return str(one) if np.asarray(where).dtype.kind not in "fiub" else amount(column, float(one))

    return text.format(
        low=amount(value, float(values[least])),
        low_x=at(across, x, int(least[1])),
        low_y=at(up, y, int(least[0])),
        high=amount(value, float(values[most])),
        high_x=at(across, x, int(most[1])),
        high_y=at(up, y, int(most[0])),
    )


def _edges(middles: Array) -> Array:
    """Return the edges between middles, and beyond the first and the last."""
    if len(middles) < 2:
        return np.asarray([middles[0] - 0.5, middles[0] + 0.5]) if len(middles) else np.asarray([0.0, 1.0])
    between = 0.5 * (middles[1:] + middles[:-1])
    first, last = 2.0 * middles[0] - between[0], 2.0 * middles[-1] - between[-1]
    return np.concatenate([[first], between, [last]])


def _fitted(column: Column, values: Array, edges: Array) -> Axis:
    """Return the axis of a column from edge to edge."""
    found = axis_of(column, values, margin=0.0, count=7)
    low, high = float(edges[0]), float(edges[-1])
    kept = [k for k, tick in enumerate(found.ticks) if low <= tick <= high]
    ticks = tuple(found.ticks[k] for k in kept)
    texts = tuple(found.texts[k] for k in kept)
    return Axis(label=found.label, unit=found.unit, low=low, high=high, ticks=ticks, texts=texts, grid=False)


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:] if "[" not in text and "." not in text else text


def histogram_figure(
    column: Column, edges: Array, counts: Array, *, marks: Mapping[str, float] | None = None, unknown: int = 0
) -> Figure:
    """Return how often values of a column occur.

    column: what is counted; edges (m + 1,): between the bars; counts (m,): points in each.
    marks: word -> value ruled in: a mean, a limit; unknown: points without an answer.
    """
    middle = 0.5 * (edges[1:] + edges[:-1])
    bars = Bars(at=middle, size=np.asarray(counts, dtype=float), thick=float(0.94 * (edges[1] - edges[0])))
    rules = [Rule(value=value, upright=True, text=text, role="ink") for text, value in (marks or {}).items()]
    total = int(np.sum(counts))
    y = axis(_("Points"), "", [counts], include=(0.0,), margin=0.12)
    panel = Panel(series=(bars, *rules), x=axis(title_of(column), "", [edges], margin=0.0, count=8), y=y)
    peak = int(np.argmax(counts))
    text = _("Most points, {share} % of {total}, lie between {low} and {high}.")
    share = reader().number(100.0 * float(counts[peak]) / max(total, 1), 3)
    high = amount(column, float(edges[peak + 1]))
    said = text.format(share=share, total=counted(total), low=amount(column, float(edges[peak])), high=high)
    source = _("all points with an answer")
    if unknown:
        source = plural("{count} point has no answer", "{count} points have no answer", unknown).format(
            count=counted(unknown)
        )
    return Figure(
        name="sweep-histogram",
        title=_("How often: {name}").format(name=name_of(column)),
        sentence=said if total else _("No point has an answer."),
        source=source,
        rows=(Row(panels=(panel,), height=2.4),),
        legend=False,
    )
