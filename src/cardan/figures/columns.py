"""The curves and bars of a figure as columns of numbers, panel by panel."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import zip_longest
from typing import Any

import numpy as np

from cardan.texts import _

from .figure import Bars, Curve, Figure, Panel, Shape, called


def drawn_from(panel: Panel) -> bool:
    """Tell whether a panel has curves, bars or areas that a table can hold."""
    return any(isinstance(one, Curve | Bars | Shape) for one in panel.series)


def section(figure: Figure, panel: Panel) -> list[Any]:
    """Return what stands above the numbers of a panel, the names of its columns, and its rows."""
    columns: dict[tuple[str, bytes], list[Any]] = {}
    panel = called(figure, panel)
    for name, values in (column for one in panel.series for column in _columns(panel, one)):
        columns.setdefault((name, str(values).encode()), values)
    names = [name for name, _values in columns]
    return [panel.heading or figure.title, names, list(zip_longest(*columns.values(), fillvalue=""))]


def _columns(panel: Panel, one: object) -> Iterator[tuple[str, list[Any]]]:
    if isinstance(one, Curve | Shape):
        yield named(panel.x.label or "x", panel.x.unit), _numbers(one.x)
        name = one.label or (one.text if isinstance(one, Curve) else "") or panel.y.label or "y"
        yield named(name, panel.y.unit), _numbers(one.y)
        if isinstance(one, Curve) and one.z is not None:
            yield "z", _numbers(one.z)
    elif isinstance(one, Bars):
        upon, along = (panel.y, panel.x) if one.lying else (panel.x, panel.y)
        ticks = np.asarray(upon.ticks, dtype=float)
        if len(upon.texts):
            yield upon.label or _("what"), [upon.texts[int(np.argmin(np.abs(ticks - float(at))))] for at in one.at]
        else:
            yield named(upon.label or "x", upon.unit), _numbers(one.at)
        yield named(one.label or along.label or panel.heading, along.unit), _numbers(one.size)


def named(name: str, unit: str) -> str:
    """Return the name of a column with its unit."""
    return f"{name} [{unit}]" if unit else name


def _numbers(values: Any) -> list[Any]:
    return [value if np.isfinite(value) else "" for value in np.asarray(values, dtype=float).tolist()]
