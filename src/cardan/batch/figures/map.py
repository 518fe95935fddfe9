"""The answers of a sweep on paper: over two fields as a map, or how often each value occurs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from cardan.answers.numbers import significant
from cardan.batch.work import Column
from cardan.figures.axes import axis
from cardan.figures.figure import Axis, Bars, Cells, Curve, Figure, Panel, Row, Rule, Series
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost
from cardan.texts import _, plural

from .words import amount, axis_of, counted, levels, name_of, title_of, unit_of

WIDE = 0.02
"""Width of a bar of colours beside a map, a share of the map's."""


def heat_figure(
    across: Column,
    up: Column,
    value: Column,
    x: Array,
    y: Array,
    values: Array,
    *,
    how: str = "",
    lines: Sequence[Array] = (),
) -> Figure:
    """Return a column over two fields as a map, the darker the greater.

    across, up, value: what runs to the right and upwards, and what is shown.
    x, y (m,), (k,): middles of the columns and rows of the map, rising, or words; values (k, m): nan leaves a hole.
    how: what was made of points that share a cell: a word for the sentence below.
    lines, sequence of array (p, 2): lines over the map: boundaries.
    """
    places = [levels(one)[0] for one in (x, y)]
    known = values[np.isfinite(values)]
    low, high = (float(np.min(known)), float(np.max(known))) if known.size else (0.0, 1.0)
    cells = Cells(x=_edges(places[0]), y=_edges(places[1]), values=values, low=low, high=high)
    series: list[Series] = [cells, *(Curve(x=one[:, 0], y=one[:, 1], role="ink", width=1.2) for one in lines)]
    shades = np.linspace(low, high, 65) if high > low else np.asarray([low - 0.5, low + 0.5])
    middle = 0.5 * (shades[1:] + shades[:-1])
    bar = Cells(x=np.asarray([0.0, 1.0]), y=shades, values=middle[:, None], low=low, high=high)
    panels = (
        Panel(series=tuple(series), x=_fitted(across, x, cells.x), y=_fitted(up, y, cells.y), title=title_of(up)),
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


def _extremes_sentence(across: Column, up: Column, value: Column, x: Array, y: Array, values: Array) -> str:
    if not np.any(np.isfinite(values)):
        return _("No point has an answer.")
    least, most = (
        np.unravel_index(int(foremost(values.ravel(), least=least)), values.shape) for least in (True, False)
    )
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
    return Axis(
        label=found.label,
        unit=found.unit,
        low=low,
        high=high,
        ticks=tuple(found.ticks[k] for k in kept),
        texts=tuple(found.texts[k] for k in kept),
        grid=False,
    )


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
    panel = Panel(
        series=(bars, *rules),
        x=axis(title_of(column), "", [edges], margin=0.0, count=8),
        y=axis(_("Points"), "", [counts], include=(0.0,), margin=0.12),
    )
    peak = int(np.argmax(counts))
    text = _("Most points, {share} % of {total}, lie between {low} and {high}.")
    said = text.format(
        share=significant(100.0 * float(counts[peak]) / max(total, 1), 3),
        total=counted(total),
        low=amount(column, float(edges[peak])),
        high=amount(column, float(edges[peak + 1])),
    )
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
