"""How columns of a sweep are called on axes, and how their values are written."""

from __future__ import annotations

from typing import Any

import numpy as np

from cardan.answers.numbers import significant
from cardan.batch.work import Column
from cardan.figures.axes import axis, written
from cardan.figures.figure import Axis
from cardan.maths.arrays import Array
from cardan.maths.ties import NOTHING, tidied
from cardan.texts import _
from cardan.units import label, thousands

LONG = 34
"""Letters of a name on an axis."""


def name_of(column: Column) -> str:
    """Return what a column is called: an answer by its meaning, what stands in the file by its path.

    >>> name_of(Column(name="alpha_eq_deg", unit="deg", role="answer", text="equivalent angle"))
    'equivalent angle'
    >>> name_of(Column(name="joints[1].centre_mm[2]", unit="mm", role="point", text="joint centre"))
    'joints[1].centre_mm[2]'
    """
    if column.role == "answer" and column.text and "[" not in column.name:
        return shortened(_(column.text))
    return shortened(column.name)


def shortened(text: str, most: int = LONG) -> str:
    """Return a text that is not too long: of words the first, of a path the last.

    >>> shortened("shafts[1].spline.mean_diameter_mm", 20), shortened("speed_fluctuation of the output", 20)
    ('…ne.mean_diameter_mm', 'speed_fluctuation o…')
    """
    if len(text) <= most:
        return text
    return text[: most - 1].rstrip() + "…" if " " in text else "…" + text[1 - most :]


def unit_of(column: Column) -> str:
    """Return the printed unit of a column, empty for a plain number."""
    return label(column.unit) if column.unit else ""


def title_of(column: Column) -> str:
    """Return what a column is called, with its unit where the name has none: paths have theirs.

    >>> title_of(Column(name="alpha_eq_deg", unit="deg", role="answer", text="equivalent angle"))
    'equivalent angle [°]'
    """
    unit = unit_of(column) if column.role == "answer" else ""
    return f"{name_of(column)} [{unit}]" if unit else name_of(column)


def amount(column: Column, value: Any, digits: int = 3) -> str:
    """Return a value with its unit.

    >>> amount(Column(name="alpha_eq_deg", unit="deg", role="answer", text=""), 1.25)
    '1.25°'
    """
    if isinstance(value, str) or value is None:
        return value or "–"
    unit = unit_of(column)
    told = float(value) if unit else tidied(float(value))
    return f"{significant(told, digits)}{'' if unit in ('', '°', '′') else ' '}{unit}"


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
    """Return a number of points with thin grouping.

    >>> counted(100000)
    '100\u202f000'
    """
    return thousands(count)
