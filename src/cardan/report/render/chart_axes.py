"""Axes of the charts of a spreadsheet from those of a panel."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from typing import Any

import numpy as np

from cardan.figures import palette
from cardan.figures.figure import Axis, Curve, Panel, Rule, Shape
from cardan.io.book import words

SMALL = {"size": 9, "color": palette.colour("muted")}
"""Letters at an axis and in a legend."""


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
    """Return the range of an axis, from a value where a tick can stand: a chart counts them from there.

    >>> reach(Axis(low=-0.3, high=4.3, ticks=(0.0, 2.0, 4.0))), reach(Axis(low=4e-5, high=0.03, log=True))
    ((-2.0, 4.3), (1e-05, 0.1))
    """
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
    """Return an axis without the margins beyond its ticks where nothing is drawn: a chart would begin a tick lower.

    drawn: the range of what is drawn along it.

    >>> reach(snug(Axis(low=-0.3, high=4.3, ticks=(0.0, 2.0, 4.0)), (0.0, 4.2)))
    (0.0, 4.3)
    """
    way = _step(axis)
    if axis.log or not way:
        return axis
    low = axis.ticks[0] if drawn[0] >= axis.ticks[0] - 1e-6 * way else axis.low
    high = axis.ticks[-1] if drawn[1] <= axis.ticks[-1] + 1e-6 * way else axis.high
    return replace(axis, low=low, high=high)


def plain(text: str) -> str:
    """Return words for a place of a chart that takes formulas too, so that they are none.

    >>> plain("=A1"), plain("Sheet!A1"), plain("runs")
    ('\u200b=A1', 'Sheet！A1', 'runs')
    """
    text = words(text)
    text = text.replace("!", "！") if re.match(r"^=?[^!]+!\$?[A-Z]+\$?\d+", text) else text
    return f"\u200b{text}" if text.startswith("=") else text
