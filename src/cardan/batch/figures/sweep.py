"""The points of a sweep on paper: each as a line across all columns, or as a dot between goals."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from cardan.batch.search.goals import Goal
from cardan.batch.work import Column, Rows
from cardan.figures.figure import Axis, Curve, Figure, Note, Panel, Row, Series
from cardan.maths.arrays import Array
from cardan.texts import _, plural

from .words import amount, axis_of, counted, ends, levels, name_of, shortened, title_of

FINER = (0.4, 0.65, 0.8, 0.9, 0.96, 1.0)
"""Shares of the lines below each shade, from the worst to the best: few are dark."""

CLASSES = len(FINER)
"""Shades of lines and dots."""

BEST = 0.1
"""Share of the points that is called the best."""

MOST_COLUMNS = 9
"""Columns that a figure of lines has room for."""


LETTERS = 240
"""Letters of the names in three lines across the figure, about; those at the ends have half the room."""


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
    panel = Panel(
        series=tuple(series),
        x=Axis(low=-0.12, high=max(len(shown) - 1, 1) + 0.12, grid=False),
        y=Axis(low=-0.09, high=1.36, grid=False),
        bare=True,
    )
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

    columns: those of the goals at least.
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
    return Figure(
        name="pareto",
        title=_("Pareto front"),
        sentence=_choice(across, up, goals, x, y),
        source=told,
        rows=(Row(panels=(panel,), height=3.4),),
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
