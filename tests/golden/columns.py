"""What an answer in JSON holds of numbers: columns by path, whatever its order and however its tables are turned.

A path joins the keys that lead to a number by dots and counts no rows: ``joints.bend_deg`` holds the bends of all
joints in order, whether ``joints`` is a list of objects or an object of lists. Truths count as 1 and 0, ``null`` as
nan, ``"∞"`` as infinite. What stands beside a ``unit`` (``{"value": 3, "unit": "deg"}``) is taken to SI at once; a unit
at the end of a key by `in_si`, when columns are compared.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from cardan.units import DIMENSIONS

Columns = dict[str, list[float]]

KEPT = 40
"""A longer column is thinned to at most so many values, and to its sum and length."""

WORDS = {"∞": math.inf, "inf": math.inf, "-∞": -math.inf, "-inf": -math.inf}

NO_UNITS = {"min"}
"""Units that mean something else at the end of a key: ``ratio_min``."""

UNITS = {
    unit: (dimension, size)
    for dimension, units in reversed(DIMENSIONS.items())
    for unit, size in units.items()
    if unit not in NO_UNITS
}

BARE = {"first", "first_range", "total", "total_range"}
"""Keys whose numbers have no unit, whatever the column above them has."""

BESIDE = {"value", "values", "limit", "now", "change", "edges", "bound"}
"""Keys whose numbers are in the unit that a key ``unit`` beside them names."""


def columns(content: Any) -> Columns:
    """Return all numbers of an answer by path.

    Examples
    --------
    >>> columns({"joints": [{"bend_deg": 3, "name": "a"}, {"bend_deg": None}], "life_h": "∞", "even": True})
    {'joints.bend_deg': [3.0, nan], 'life_h': [inf], 'even': [1.0]}
    >>> columns({"joints": {"name": ["a", "b"], "bend_deg": [3, None]}})
    {'joints.bend_deg': [3.0, nan]}
    >>> columns([{"value": 2, "unit": "kNm"}, {"value": 3, "unit": ""}])
    {'value': [2000.0, 3.0]}
    """
    found: Columns = {}
    for path, value in _leaves("", content, 1.0):
        found.setdefault(path, []).append(value)
    return {path: values for path, values in found.items() if not all(map(math.isnan, values))}


def _leaves(path: str, content: Any, size: float) -> Iterator[tuple[str, float]]:
    if isinstance(content, Mapping):
        unit = content.get("unit")
        for key, value in content.items():
            below = f"{path}.{key}" if path else str(key)
            if key not in BESIDE or not unit:
                yield from _leaves(below, value, size)
            elif isinstance(unit, list) and isinstance(value, list):
                for one, beside in zip(value, unit, strict=False):
                    yield from _leaves(below, one, _size(beside))
            else:
                yield from _leaves(below, value, _size(unit))
    elif isinstance(content, Sequence) and not isinstance(content, str):
        for value in content:
            yield from _leaves(path, value, size)
    elif content is None:
        yield path, math.nan
    elif isinstance(content, str):
        if content in WORDS:
            yield path, WORDS[content]
    else:
        yield path, float(content) * size


def _size(unit: Any) -> float:
    return UNITS[unit][1] if isinstance(unit, str) and unit in UNITS else 1.0


def without_unit(path: str) -> tuple[str, str, float]:
    """Return a path without the unit of its last key that has one, its dimension and how many SI units it is.

    Examples
    --------
    >>> without_unit("joints.iso_h")
    ('joints.iso', 'time', 3600.0)
    >>> without_unit("peaks_kNm.mean")
    ('peaks.mean', 'torque', 1000.0)
    >>> without_unit("ratio_min")
    ('ratio_min', '', 1.0)
    """
    keys = path.split(".")
    for k in range(len(keys) - 1, -1, -1):
        if keys[k] in BARE:
            break
        if " " in keys[k]:  # a reduction, ``max life_h``: a unit stands beside its value
            continue
        words = keys[k].split("_")
        for start in range(1, len(words)):
            unit = "_".join(words[start:])
            if unit in UNITS:
                keys[k] = "_".join(words[:start])
                return ".".join(keys), *UNITS[unit]
    return path, "", 1.0


def in_si(stored: Any, size: float) -> Any:
    """Return a column, whole or thinned, with its values in SI."""
    if isinstance(stored, list):
        return [number(one) * size for one in stored]
    return stored | {"sum": stored["sum"] * abs(size), "values": [number(one) * size for one in stored["values"]]}


def number(stored: Any) -> float:
    """Return a stored value, in which JSON's words stand for what is not a number."""
    return math.nan if stored is None else WORDS[stored] if isinstance(stored, str) else float(stored)


def thinned(values: list[float]) -> Any:
    """Return a column as it is stored: whole where it is short, else every so manieth value, length and sum.

    Examples
    --------
    >>> thinned([1.0, 2.5])
    [1, 2.5]
    >>> found = thinned([float(k) for k in range(100)])
    >>> found["length"], found["sum"], found["every"], found["values"][:3]
    (100, 4950.0, 3, [0, 3, 6])
    """
    if len(values) <= KEPT:
        return [_short(one) for one in values]
    every = -(-len(values) // KEPT)
    total = math.fsum(abs(one) for one in values if math.isfinite(one))
    return {"length": len(values), "sum": total, "every": every, "values": [_short(one) for one in values[::every]]}


def _short(value: float) -> Any:
    if math.isnan(value):
        return None
    if math.isinf(value):
        return "∞" if value > 0 else "-∞"
    return int(value) if value.is_integer() and abs(value) < 1e15 else value
