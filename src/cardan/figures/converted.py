"""Figures in the units and with the decimal sign that a reader likes."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from cardan.maths.arrays import Array
from cardan.units import spoken

from .axes import steps, written
from .conversion import ALONE, Conversion
from .figure import Axis, Band, Bars, Cells, Curve, Figure, Mesh, Note, Panel, Rule, Series, Shape

HEADED = re.compile(r"\[([^\[\]]+)\]\s*$")
"""The unit at the end of a panel's heading."""

PLAIN = re.compile(r"[−+±]?[\d\u202f.]+(?:·10[⁻⁰¹²³⁴-⁹]+)?")
"""Nothing but a number."""


@dataclass(frozen=True, kw_only=True)
class _Scale:
    """How many of the new units one of the old ones is, along both axes of a panel."""

    x: float = 1.0
    y: float = 1.0
    notes: float = 1.0


def converted(figure: Figure, how: Conversion) -> Figure:
    """Return a figure in other units: the same curves, with other numbers along them.

    Parameters
    ----------
    figure : Figure
        In the usual units.
    how : Conversion
        The units and the decimal sign of a choice.

    Examples
    --------
    >>> from cardan.figures.axes import axis
    >>> from cardan.figures.figure import Row
    >>> panel = Panel(series=(Rule(value=25.4),), y=axis("way", "mm", include=(0.0, 50.8)))
    >>> shown = Figure(name="way", title="Way", sentence="It slides 25.4 mm.", source="", rows=(Row(panels=(panel,)),))
    >>> inches = converted(shown, Conversion(units={"length": "in"}))
    >>> inches.sentence, inches.panels[0].series[0].value, inches.panels[0].y.unit
    ('It slides 1.000 in.', 1.0, 'in')
    """
    if how.idle:
        return figure
    shared = {(one.x.low, one.x.high): one.x.unit for one in figure.panels if one.x.unit}
    rows = tuple(replace(row, panels=tuple(_panel(panel, shared, how) for panel in row.panels)) for row in figure.rows)
    return replace(
        figure,
        title=how.sentence(figure.title),
        sentence=how.sentence(figure.sentence),
        source=how.sentence(figure.source),
        rows=rows,
    )


def _panel(panel: Panel, shared: dict[tuple[float, float], str], how: Conversion) -> Panel:
    over = "" if panel.x.label else shared.get((panel.x.low, panel.x.high), "")
    (x_unit, x), (y_unit, y) = how.unit(spoken(panel.x.unit)), how.unit(spoken(panel.y.unit))
    if not panel.x.unit and over:
        x = how.unit(spoken(over))[1]
    headed = HEADED.search(panel.title)
    ratio = how.unit(headed[1])[1] if headed else 1.0
    if ratio != 1.0 and not panel.x.unit and not panel.y.unit and not panel.bare:
        lying = any(isinstance(one, Bars) and one.lying for one in panel.series)
        x, y = (ratio, ratio) if panel.view else (ratio, y) if lying else (x, ratio)
    scale = _Scale(x=x, y=y, notes=ratio if panel.bare else 1.0)
    return replace(
        panel,
        title=how.sentence(panel.title),
        x=_axis(panel.x, x_unit, x, how),
        y=_axis(panel.y, y_unit, y, how),
        series=tuple(_series(one, scale, how) for one in panel.series),
    )


def _axis(old: Axis, unit: str, ratio: float, how: Conversion) -> Axis:
    label = how.sentence(old.label)
    if ratio == 1.0:
        return replace(old, label=label, texts=_texts(old.texts, 1.0, how))
    low, high = old.low * ratio, old.high * ratio
    if not old.ticks or any(text and not PLAIN.fullmatch(text) for text in old.texts):
        ticks = tuple(one * ratio for one in old.ticks)
        return replace(old, label=label, unit=unit, low=low, high=high, ticks=ticks, texts=_texts(old.texts, 1.0, how))
    ticks = _decades(low, high) if old.log else steps(low, high, max(len(old.ticks) - 1, 3))
    texts = written(ticks) if any(old.texts) else ("",) * len(ticks)
    return replace(
        old, label=label, unit=unit, low=low, high=high, ticks=ticks, texts=tuple(how.signed(one) for one in texts)
    )


def _decades(low: float, high: float) -> tuple[float, ...]:
    """Return round values along a logarithmic axis: powers of ten, with steps of 2 and 5 where these are few."""
    first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
    powers = [10.0**k for k in range(first, last + 1) if low <= 10.0**k <= high]
    if len(powers) >= 3:
        return tuple(powers[:: math.ceil(len(powers) / 6)])
    return tuple(m * 10.0**k for k in range(first, last + 1) for m in (1, 2, 5) if low <= m * 10.0**k <= high)


def _texts(texts: Sequence[str], ratio: float, how: Conversion) -> tuple[str, ...]:
    return tuple(how.number(one, ratio) if PLAIN.fullmatch(one) else how.sentence(one) for one in texts)


def _series(one: Series, scale: _Scale, how: Conversion) -> Series:
    if isinstance(one, Curve):
        z = None if one.z is None else _times(one.z, scale.x)
        return replace(
            one,
            x=_times(one.x, scale.x),
            y=_times(one.y, scale.y),
            z=z,
            label=how.sentence(one.label),
            text=how.sentence(one.text),
        )
    if isinstance(one, Shape):
        return replace(one, x=_times(one.x, scale.x), y=_times(one.y, scale.y), label=how.sentence(one.label))
    if isinstance(one, Bars):
        along, across = (scale.x, scale.y) if one.lying else (scale.y, scale.x)
        return replace(
            one,
            at=_times(one.at, across),
            size=_times(one.size, along),
            least=one.least * along,
            most=one.most * along,
            base=one.base * along,
            thick=one.thick * across,
            texts=_texts(one.texts, along, how),
            label=how.sentence(one.label),
        )
    if isinstance(one, Mesh):
        return replace(one, corners=_times(one.corners, scale.x), text=how.sentence(one.text))
    if isinstance(one, Note):
        bare = scale.notes != 1.0 and ALONE.fullmatch(one.text)
        text = how.number(one.text, scale.notes) if bare else how.sentence(one.text)
        z = None if one.z is None else one.z * scale.x
        return replace(one, x=one.x * scale.x, y=one.y * scale.y, z=z, text=text)
    if isinstance(one, Cells):  # what they are worth stands on no axis of the panel: it stays
        return replace(one, x=_times(one.x, scale.x), y=_times(one.y, scale.y))
    ratio = scale.x if one.upright else scale.y
    if isinstance(one, Rule):
        return replace(one, value=one.value * ratio, text=how.sentence(one.text))
    assert isinstance(one, Band)
    return replace(one, low=one.low * ratio, high=one.high * ratio, text=how.sentence(one.text))


def _times(values: Array, ratio: float) -> Array:
    return values if ratio == 1.0 else np.asarray(values, dtype=float) * ratio
