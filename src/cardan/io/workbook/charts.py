"""Charts of a spreadsheet from the panels of figures that lie in the plane; the others are pictures."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from cardan.answers import palette
from cardan.figures.figure import Axis, Band, Bars, Curve, Figure, Note, Panel, Row, Rule, Series, Shape, called
from cardan.io.workbook.book import words
from cardan.texts import _

from .chart_data import ChartData, Place

DASHES = {"solid": "solid", "dashed": "dash", "dotted": "round_dot", "dashdot": "dash_dot"}

OUTLINE = 8  # shapes with at most so many corners are marks that a chart draws as lines
INCH = 104.0  # pixels of a chart for an inch of print
AROUND = 84.0  # pixels above and below the frame of a chart: its title, axis and legend
BAR = 16.0  # pixels of a chart for each of its lying bars: its name has to have room

SIZES = ((12, 9, 17.0), (30, 8, 12.5), (math.inf, 7, 11.0))
"""Up to how many bars their names have which size, and the pixels that one needs at the least."""

LONG = 36  # letters of a name of a bar that has room in one line at the usual size
TRACK = palette.mixed(palette.colour("muted"), "#ffffff", 0.82)  # colour behind lying bars, up to their limit
LABELS: dict[tuple[str, str], str] = {("centre", "top"): "below", ("left", ""): "right", ("right", ""): "left"}


@dataclass(frozen=True, eq=False, kw_only=True)
class Drawn:
    """A chart and its size in pixels; ``least`` is the height below which it lacks room for what it names."""

    chart: Any
    width: float
    height: float
    least: float


def split(figure: Figure) -> tuple[tuple[Row, ...], Figure | None]:
    """Return the rows of a figure's panels that are charts, and the figure of the others, None where there is none."""
    kept = tuple(row for row in (_only(row, charts=True) for row in figure.rows) if row.panels)
    others = tuple(row for row in (_only(row, charts=False) for row in figure.rows) if row.panels)
    return kept, replace(figure, rows=others) if any(panel.series for row in others for panel in row.panels) else None


def _only(row: Row, *, charts: bool) -> Row:
    widths = row.widths or (1.0,) * len(row.panels)
    chosen = [pair for pair in zip(row.panels, widths, strict=True) if is_chart(pair[0]) == charts]
    return replace(row, panels=tuple(panel for panel, _wide in chosen), widths=tuple(wide for _panel, wide in chosen))


def is_chart(panel: Panel) -> bool:
    """Tell whether a panel is drawn as a chart: curves or bars in the plane, and marks that a chart has too."""
    if panel.view is not None or panel.bare:
        return False
    return _of_bars(panel) if any(isinstance(one, Bars) for one in panel.series) else _of_curves(panel)


def _of_curves(panel: Panel) -> bool:
    marks = (one for one in panel.series if isinstance(one, Shape))
    return (
        all(isinstance(one, Curve | Rule | Note | Band | Shape) for one in panel.series)
        and any(isinstance(one, Curve) and np.size(one.x) > 1 for one in panel.series)
        and all(not one.label and len(one.x) <= OUTLINE for one in marks)
        and all(axis.log or axis.numeric or not any(axis.texts) for axis in (panel.x, panel.y))
    )


def _of_bars(panel: Panel) -> bool:
    bars = [one for one in panel.series if isinstance(one, Bars)]
    lying = bars[0].lying
    if any(one.lying != lying for one in bars) or not (panel.y if lying else panel.x).texts:
        return False
    rest = [one for one in panel.series if not isinstance(one, Bars)]
    return not rest or (lying and len(rest) == 1 and _limit(rest[0]) is not None)


def _limit(one: Series) -> float | None:
    """Return where an upright line stands; None where this is none."""
    if isinstance(one, Rule) and one.upright:
        return float(one.value)
    if isinstance(one, Curve) and len(one.x) == 2 and one.x[0] == one.x[1]:
        return float(one.x[0])
    return None


def charts(
    book: Any, data: ChartData, figure: Figure, rows: Sequence[Row], room: tuple[float, float]
) -> Iterator[list[Drawn]]:
    """Yield the charts of each row of panels.

    data: takes their numbers; rows: those that `split` keeps.
    room: pixels of a row across, and at most from top to bottom.
    """
    for row in rows:
        drawn = []
        for panel, share in zip(row.panels, row.widths, strict=True):
            panel = called(figure, panel)
            below = [one.x for one in figure.panels if (one.x.low, one.x.high) == (panel.x.low, panel.x.high)]
            named = next((axis for axis in (panel.x, *below) if axis.title), panel.x)
            made = _chart(book, data, figure, replace(panel, x=replace(named, grid=panel.x.grid)))
            wide = room[0] * share / sum(row.widths)
            high = max(INCH * row.height, BAR * _lying(panel)) + AROUND
            least = min(_size(panel.y.texts)[1] * _lying(panel) + AROUND, room[1])
            drawn.append(Drawn(chart=made, width=wide, height=min(high, room[1]), least=least))
        yield drawn


def _lying(panel: Panel) -> int:
    """Return how many lying bars stand one above the other."""
    return len(panel.y.ticks) if any(isinstance(one, Bars) and one.lying for one in panel.series) else 0


def _size(names: Sequence[str]) -> tuple[int, float]:
    """Return the size of the names of bars, and the pixels that one needs at the least.

    Among many bars a spreadsheet leaves out every other name where one of them would take two lines.
    """
    size, pixels = next((size, pixels) for most, size, pixels in SIZES if len(names) <= most)
    return (min(size, 7) if size < 9 and max(map(len, names)) > LONG else size), pixels


def _chart(book: Any, data: ChartData, figure: Figure, panel: Panel) -> Any:
    title = panel.title or panel.y.label or figure.title
    heading = data.begin(figure.title, title[:1].upper() + title[1:])
    bars = [one for one in panel.series if isinstance(one, Bars)]
    chart = _bar_chart(book, data, panel, bars) if bars else _curve_chart(book, data, panel)
    font = {"size": 11, "bold": True, "color": palette.colour("ink")}
    chart.set_title({"name": heading, "name_font": font, "overlay": False})
    chart.set_chartarea({"border": {"color": palette.colour("faint")}})
    chart.set_plotarea({"fill": {"none": True}})
    chart.show_blanks_as("gap")
    return chart


def _curve_chart(book: Any, data: ChartData, panel: Panel) -> Any:
    panel = replace(panel, x=snug(panel.x, spread(panel, upright=False)), y=snug(panel.y, spread(panel, upright=True)))
    chart = book.add_chart({"type": "scatter", "subtype": "straight"})
    curves = [one for one in panel.series if isinstance(one, Curve)]
    told = [k for k, one in enumerate(curves) if one.label or one.text] or [*range(len(curves))]
    several = _("curve {number}")
    drawn = {k: _curve(data, panel, curves[k], several.format(number=k + 1) if k else panel.y.label) for k in told}
    data.aside(_("Lines and marks beside the curves"))
    drawn |= {k: _curve(data, panel, one, _("line")) for k, one in enumerate(curves) if k not in drawn}
    marks = [mark for one in panel.series for mark in _mark(data, panel, one)]
    for one in (*marks, *(drawn[k] for k in range(len(curves)))):
        chart.add_series(one)
    named_before = {one.label: k for k, one in reversed([*enumerate(curves, start=len(marks))])}
    unnamed = [k for k, one in enumerate(curves, start=len(marks)) if not one.label or named_before[one.label] != k]
    _legend(chart, len(marks) + len(curves), [*range(len(marks)), *unnamed])
    chart.set_x_axis(axis_of(panel.x))
    chart.set_y_axis(axis_of(panel.y))
    return chart


def _legend(chart: Any, count: int, unnamed: Sequence[int]) -> None:
    """List the series of a chart that have names, where there are any."""
    if len(unnamed) == count:
        chart.set_legend({"none": True})
    else:
        chart.set_legend({"position": "bottom", "font": SMALL, "delete_series": list(unnamed)})


def _curve(data: ChartData, panel: Panel, one: Curve, otherwise: str) -> dict[str, Any]:
    """Return the series of a curve, called by its name or otherwise."""
    tint = palette.colour(one.role)
    line = {"color": tint, "width": one.width, "dash_type": DASHES[one.dash]} if one.width else {"none": True}
    size = max(2, round(one.marker))
    dot = {"type": "circle", "size": size, "fill": {"color": tint}, "border": {"none": True}}
    x = data.numbers(panel.x.label or "x", panel.x.unit, one.x)
    y = data.numbers(one.label or one.text or otherwise or _("line"), panel.y.unit, one.y, told=one.text)
    return _series(x, y, line=line, marker=dot if one.marker else {"type": "none"})


def _series(x: Place, y: Place, **how: Any) -> dict[str, Any]:
    return {"name": y.name, "categories": x.values, "values": y.values, **how}


def _mark(data: ChartData, panel: Panel, one: Series) -> Iterator[dict[str, Any]]:
    """Yield the series that draws a line across the panel, a range, a word or the outline of a mark."""
    x, y = panel.x, panel.y
    if isinstance(one, Rule):
        along, across = (y, x) if one.upright else (x, y)
        ends = np.asarray([reach(along)[0], at_share(along, 0.94), reach(along)[1]])
        at = np.full(3, one.value)
        points: tuple[Any, Any] = (at, ends) if one.upright else (ends, at)
        line = {"color": palette.colour(one.role), "width": one.width, "dash_type": DASHES[one.dash]}
        where = "right" if one.upright else "above"
        labels = _labels([None, one.text, None], one.role, where)
        yield _line(data, panel, one.text or across.label or _("line"), points, line, labels)
    elif isinstance(one, Band | Shape):
        points = _outline(panel, one)
        line = {"color": palette.colour(one.role), "width": 0.75, "dash_type": "solid", "transparency": 40}
        text = one.text if isinstance(one, Band) else one.label
        yield _line(data, panel, text or _("range"), points, line, _labels([text], one.role, "above"))
    elif isinstance(one, Note):
        points = (np.asarray([one.x]), np.asarray([one.y]))
        where = LABELS.get((one.side, ""), LABELS.get((one.side, one.level), "above"))
        yield _line(data, panel, one.text, points, {"none": True}, _labels([one.text], one.role, where))


def _line(
    data: ChartData, panel: Panel, name: str, points: Sequence[Any], line: dict[str, Any], labels: dict[str, Any]
) -> dict[str, Any]:
    x = data.numbers(panel.x.label or "x", panel.x.unit, points[0])
    y = data.numbers(name, panel.y.unit, points[1])
    return _series(x, y, line=line, marker={"type": "none"}, **labels)


def _outline(panel: Panel, one: Band | Shape) -> tuple[Any, Any]:
    if isinstance(one, Shape):
        return np.asarray([*one.x, one.x[0]]), np.asarray([*one.y, one.y[0]])
    low, high = reach(panel.y if one.upright else panel.x)
    along = np.asarray([low, high, high, low, low])
    across = np.asarray([one.low, one.low, one.high, one.high, one.low])
    return (across, along) if one.upright else (along, across)


def _labels(texts: Sequence[str | None], role: str, where: str) -> dict[str, Any]:
    """Return the words at the points of a series; none where all are empty."""
    if not any(texts):
        return {}
    custom = [{"value": plain(text)} if text else {"delete": True} for text in texts]
    font = {"size": 8, "color": palette.colour(role)}
    return {"data_labels": {"value": True, "position": where, "font": font, "custom": custom}}


def _bar_chart(book: Any, data: ChartData, panel: Panel, bars: Sequence[Bars]) -> Any:
    lying = bars[0].lying
    upon, along = (panel.y, panel.x) if lying else (panel.x, panel.y)
    order = sorted(range(len(upon.ticks)), key=lambda k: upon.ticks[k], reverse=lying)
    names = [upon.texts[k] for k in order]
    chart = book.add_chart({"type": "bar" if lying else "column"})
    kinds = data.words(upon.label or _("what"), names)
    limit = next((_limit(one) for one in panel.series if not isinstance(one, Bars)), None)
    alone = along.log and len(bars) == 1 and not bars[0].label  # words at the outer end of bars below 1 are at its foot
    gap = max(60, 300 // max(1, len(order))) if not lying else 60
    if limit is not None:
        kept = data.numbers(_("limit"), along.unit, np.full(len(names), limit))
        chart.add_series(_series(kinds, kept, fill={"color": TRACK}, border={"none": True}, gap=gap, overlap=100))
    for one in bars:
        found = _at_ticks(one, upon)
        ends = [float(one.ends[found[k]]) if k in found else math.nan for k in order]
        sizes = [float(one.size[found[k]]) if k in found else math.nan for k in order]
        texts = [one.texts[found[k]] if k in found and one.texts else None for k in order]
        heading = one.label or along.label or panel.heading
        place = data.numbers(heading, along.unit, sizes)
        if any(size != end for size, end in zip(sizes, ends, strict=True) if math.isfinite(end)):
            place = data.numbers(_("as drawn"), along.unit, ends)
        if one.texts:
            data.words(_("as written"), [text or "" for text in texts])
        tints = [palette.colour(one.roles[found[k] % len(one.roles)]) if k in found else None for k in order]
        points = [{"fill": {"color": tint}} if tint else None for tint in tints]
        at_end = {} if alone else _labels(texts, "ink", "outside_end")
        first = next((tint for tint in tints if tint), palette.colour("accent"))
        chart.add_series(_series(kinds, place, fill={"color": first}, points=points, gap=gap, **at_end))
        if alone and any(texts):
            above = book.add_chart({"type": "line"})
            above.add_series(_series(kinds, place, line={"none": True}, **_labels(texts, "ink", "above")))
            chart.combine(above)
    unnamed = [k for k, one in enumerate(bars) if not one.label and limit is None]
    count = len(bars)
    if limit is not None:
        count += 1
        beyond = [size > limit for size in sizes]
        if any(beyond):  # once more before the bars, as an outline: those beyond it hide the track behind them
            data.aside(_("Lines and marks beside the curves"))
            once_more = data.numbers(_("limit"), along.unit, [limit if one else math.nan for one in beyond])
            line = {"color": palette.colour("faint"), "width": 1.25}
            chart.add_series(_series(kinds, once_more, fill={"none": True}, border=line, gap=gap))
            count, unnamed = count + 1, [count]
    _legend(chart, count, unnamed)
    font = {**SMALL, "size": _size(names)[0]}
    kinds_axis = {**named(upon), "num_font": font, "interval_unit": 1, "major_tick_mark": "none", "text_axis": True}
    if lying:
        values = axis_of(along if along.title else replace(along, label=panel.heading))
        chart.set_x_axis(values | {"label_position": "next_to"})
        chart.set_y_axis({**kinds_axis, "reverse": True, "crossing": "max"})
    else:
        values = axis_of(along)
        chart.set_x_axis(kinds_axis)
        chart.set_y_axis(values | ({"crossing": values["min"]} if along.log else {}))
    return chart


def _at_ticks(one: Bars, upon: Axis) -> dict[int, int]:
    """Return which bar stands at which tick."""
    ticks = np.asarray(upon.ticks, dtype=float)
    return {int(np.argmin(np.abs(ticks - float(at)))): k for k, at in enumerate(one.at)}


# Axes of the charts of a spreadsheet from those of a panel.

SMALL = {"size": 9, "color": palette.colour("muted")}  # letters at an axis and in a legend


def axis_of(axis: Axis) -> dict[str, Any]:
    """Return the properties of an axis of numbers, those of XlsxWriter."""
    low, high = reach(axis)
    grid = {"visible": axis.grid, "line": {"color": palette.colour("grid"), "width": 0.75}}
    found = {
        **named(axis),
        "min": low,
        "max": high,
        "num_font": SMALL,
        "num_format": _decades(low, high) if axis.log else _digits(axis),
        "major_gridlines": grid,
        "line": {"color": palette.colour("faint")},
        "major_tick_mark": "none",
        "label_position": "low" if axis.texts else "none",
    }
    step = _step(axis)
    return found | ({"log_base": 10} if axis.log else {"major_unit": _plain(step)} if step else {})


def named(axis: Axis) -> dict[str, Any]:
    """Return the words at an axis; none where it has none."""
    return {"name": plain(axis.title), "name_font": {**SMALL, "bold": False}} if axis.title else {}


def _digits(axis: Axis) -> str:
    """Return the number format of the texts at the ticks."""
    if any("·10" in text for text in axis.texts):
        return "0E+00"
    parts = max((len(text.replace(",", ".").partition(".")[2]) for text in axis.texts), default=0)
    return "#,##0" + ("." + "0" * parts if parts else "")


def _decades(low: float, high: float) -> str:
    """Return the number format of powers of ten: in full, all of them, where none is long."""
    return "0E+00" if low < 1e-3 or high > 1e6 else "General" if low < 1.0 else "#,##0"


def _step(axis: Axis) -> float:
    """Return the way from tick to tick; 0 where they do not stand evenly."""
    if len(axis.ticks) < 2:
        return 0.0
    steps = np.diff(np.asarray(axis.ticks, dtype=float))
    even = float(steps[0])
    return even if np.allclose(steps, even, rtol=1e-6) else 0.0


def reach(axis: Axis) -> tuple[float, float]:
    """Return the range of an axis, from a value where a tick can stand: a chart counts them from there."""
    if axis.log:
        return 10.0 ** math.floor(math.log10(axis.low) + 1e-9), 10.0 ** math.ceil(math.log10(axis.high) - 1e-9)
    step = _step(axis)
    low = axis.low
    if step:
        low = axis.ticks[0] - (step if axis.low < axis.ticks[0] - 1e-9 * step else 0.0)
    return _plain(low), _plain(axis.high)


def _plain(value: float) -> float:
    """Return a value without the last digits that come from rounding."""
    return float(f"{value:.12g}")


def at_share(axis: Axis, share: float) -> float:
    """Return the value that stands at a share of the length of an axis.

    share: from 0 at its beginning to 1 at its end.
    """
    low, high = reach(axis)
    return float(low * (high / low) ** share) if axis.log else low + share * (high - low)


def spread(panel: Panel, *, upright: bool) -> tuple[float, float]:
    """Return the least and the greatest value of what is drawn, along an axis.

    panel: with curves, rules and shapes; upright: along the axis that points up.
    """
    found = [np.asarray(one.y if upright else one.x) for one in panel.series if isinstance(one, Curve | Shape)]
    rules = [np.asarray([one.value]) for one in panel.series if isinstance(one, Rule) and one.upright != upright]
    values = np.concatenate([one.ravel().astype(float) for one in (*found, *rules)])
    values = values[np.isfinite(values)]
    return (float(values.min()), float(values.max())) if values.size else (-math.inf, math.inf)


def snug(axis: Axis, drawn: tuple[float, float]) -> Axis:
    """Return an axis without the margins beyond its ticks where nothing is drawn: a chart would begin a tick lower."""
    way = _step(axis)
    if axis.log or not way:
        return axis
    low = axis.ticks[0] if drawn[0] >= axis.ticks[0] - 1e-6 * way else axis.low
    high = axis.ticks[-1] if drawn[1] <= axis.ticks[-1] + 1e-6 * way else axis.high
    return replace(axis, low=low, high=high)


def plain(text: str) -> str:
    """Return words for a place of a chart that takes formulas too, so that they are none."""
    text = words(text)
    text = text.replace("!", "！") if re.match(r"^=?[^!]+!\$?[A-Z]+\$?\d+", text) else text
    return f"\u200b{text}" if text.startswith("=") else text
