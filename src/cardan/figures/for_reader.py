"""Figures for whoever looks: axes in the reader's units, and every text written out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from cardan.answers.quantity import Text, told
from cardan.answers.reader import Reader
from cardan.maths.arrays import Array
from cardan.units import DIMENSIONS

from .axes import decades, steps, written
from .figure import Axis, Band, Bars, Cells, Curve, Figure, Mesh, Note, Panel, Rule, Series, Shape


@dataclass(frozen=True, kw_only=True)
class _Scale:
    """How many of the new units one of the old ones is, along both axes of a panel."""

    x: float = 1.0
    y: float = 1.0


def for_reader(figure: Figure, reader: Reader) -> Figure:
    """Return a figure as a reader sees it: the same curves over axes in other units, texts as plain words.

    figure: as a question makes it; reader: units and decimal sign.
    """
    return replace(
        figure,
        title=told(figure.title, reader),
        sentence=told(figure.sentence, reader),
        source=told(figure.source, reader),
        rows=tuple(
            replace(row, panels=tuple(_panel(panel, figure.panels, reader) for panel in row.panels))
            for row in figure.rows
        ),
    )


def ratio(dimension: str, unit: str, reader: Reader) -> float:
    """Return how many of the reader's units one of these is."""
    if not dimension:
        return 1.0
    own, factor = reader.unit(dimension, unit)
    return 1.0 if own == unit else DIMENSIONS[dimension][unit] / factor


def _panel(panel: Panel, every: Sequence[Panel], reader: Reader) -> Panel:
    along = panel.x if panel.x.dimension or panel.x.label else _shared(panel.x, every)
    scale = _Scale(x=ratio(along.dimension, along.unit, reader), y=ratio(panel.y.dimension, panel.y.unit, reader))
    own = ratio(panel.dimension, panel.unit, reader)
    if own != 1.0 and not panel.x.dimension and not panel.y.dimension and not panel.bare:
        lying = any(isinstance(one, Bars) and one.lying for one in panel.series)
        scale = _Scale(x=own, y=own) if panel.view else _Scale(x=own) if lying else _Scale(x=scale.x, y=own)
    return replace(
        panel,
        title=told(panel.title, reader),
        unit=_printed(panel, reader),
        dimension="",
        x=_axis(panel.x, scale.x, reader),
        y=_axis(panel.y, scale.y, reader),
        series=tuple(_series(one, scale, reader) for one in panel.series),
    )


def _shared(axis: Axis, every: Sequence[Panel]) -> Axis:
    """Return the labelled axis of the same range that an axis without a label goes on."""
    alike = (one.x for one in every if one.x.dimension and (one.x.low, one.x.high) == (axis.low, axis.high))
    return next(alike, axis)


def _axis(old: Axis, scale: float, reader: Reader) -> Axis:
    label, texts = told(old.label, reader), tuple(told(one, reader) for one in old.texts)
    low, high, ticks = old.low * scale, old.high * scale, tuple(one * scale for one in old.ticks)
    numeric = texts == _plainly(old.ticks, old.log)
    if numeric:  # round numbers in the new unit
        if scale != 1.0:
            ticks = decades(low, high) if old.log else steps(low, high, max(len(old.ticks) - 1, 3))
            texts = _plainly(ticks, old.log)
        texts = tuple(reader.signed(one) for one in texts)
    elif old.ticks and not any(texts):  # marks without words: where they stand along the axis that names them
        if scale != 1.0:
            ticks = decades(low, high) if old.log else steps(low, high, max(len(old.ticks) - 1, 3))
        texts = ("",) * len(ticks)
    made = replace(old, label=label, unit=_printed(old, reader), dimension="", low=low, high=high)
    return replace(made, ticks=ticks, texts=texts, numeric=numeric, scale=old.scale * scale)


def _printed(what: Axis | Panel, reader: Reader) -> str:
    """Return a unit as it stands behind a label."""
    return reader.label(what.dimension, what.unit) if what.dimension else what.unit


def _plainly(ticks: Sequence[float], log: bool) -> tuple[str, ...]:
    """Return ticks as they are written where nobody says otherwise."""
    return (tuple(written([one])[0] for one in ticks) if log else written(ticks)) if ticks else ()


def _series(one: Series, scale: _Scale, reader: Reader) -> Series:
    """Return a series with its places in the reader's units and its texts in words."""

    def text(old: Text) -> str:
        return told(old, reader)

    if isinstance(one, Curve):
        z = None if one.z is None else _times(one.z, scale.x)
        x, y = _times(one.x, scale.x), _times(one.y, scale.y)
        return replace(one, x=x, y=y, z=z, label=text(one.label), text=text(one.text))
    if isinstance(one, Shape):
        return replace(one, x=_times(one.x, scale.x), y=_times(one.y, scale.y), label=text(one.label))
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
            texts=tuple(text(part) for part in one.texts),
            label=text(one.label),
        )
    if isinstance(one, Mesh):
        return replace(one, corners=_times(one.corners, scale.x), text=text(one.text))
    if isinstance(one, Note):
        z = None if one.z is None else one.z * scale.x
        return replace(one, x=one.x * scale.x, y=one.y * scale.y, z=z, text=text(one.text))
    if isinstance(one, Cells):  # what they are worth stands on no axis of the panel: it stays
        return replace(one, x=_times(one.x, scale.x), y=_times(one.y, scale.y))
    own = scale.x if one.upright else scale.y
    if isinstance(one, Rule):
        return replace(one, value=one.value * own, text=text(one.text))
    assert isinstance(one, Band)
    return replace(one, low=one.low * own, high=one.high * own, text=text(one.text))


def _times(values: Array, scale: float) -> Array:
    return values if scale == 1.0 else np.asarray(values, dtype=float) * scale
