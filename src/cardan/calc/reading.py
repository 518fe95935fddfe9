"""Inputs with unit keys, read into SI, and everything that is wrong with them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from types import MappingProxyType
from typing import Any

import numpy as np

from cardan.drive.fields.ranges import in_range, out_of_range, range_code, shown
from cardan.errors import Problem
from cardan.texts import _
from cardan.units import factor, nearest

from .keys import Given, unit_of, without_unit


class Values(dict[str, Any]):
    """Values in SI by name without unit, as attributes too, with the key under which each was given."""

    spelled: dict[str, str]

    def __init__(self, values: Mapping[str, Any] = MappingProxyType({}), spelled: Mapping[str, str] | None = None):
        super().__init__(values)
        object.__setattr__(self, "spelled", dict(spelled or {}))

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(name) from None

    def key(self, name: str) -> str:
        """Return the key under which a value was given, or would be; with its path where it stands in a table."""
        return self.spelled[name]

    def wrong(self, name: str, message: str, code: str = "") -> Problem:
        """Return what is wrong with a value, under its key."""
        return Problem(self.key(name), message, code)

    def but(self, **changed: Any) -> Values:
        """Return these values with some of them changed."""
        return Values(self | changed, self.spelled)


def read(takes: tuple[Given, ...], inputs: Mapping[str, Any], before: str = "") -> tuple[Values, list[Problem]]:
    """Return the values in SI by name, and what is wrong with them one by one."""
    found, keys, problems = _sort(takes, inputs, before)
    values: dict[str, Any] = {}
    places: dict[str, str] = {}
    for item in takes:
        if item.name not in found:
            if item.required:
                problems.append(Problem(before + item.key, _("missing: {doc}").format(doc=item.doc), "missing"))
            else:
                values[item.name] = item.default
            continue
        key = keys[item.name]
        if item.columns:
            wrong, value, inner = _inner(item, found[item.name], before + key)
            places |= {item.name + place: name for place, name in inner.items()}
        else:
            wrong, value = list(_problems(item, found[item.name], key)), None
            wrong = [Problem(before + problem.field, problem.message, problem.code) for problem in wrong]
        problems += wrong
        if not wrong:
            values[item.name] = value if item.columns else _si(item, found[item.name], key)
    return Values(values, {name: before + key for name, key in keys.items()} | places), problems


def _sort(
    takes: tuple[Given, ...], inputs: Mapping[str, Any], before: str
) -> tuple[dict[str, Any], dict[str, str], list[Problem]]:
    """Find the input each given key belongs to."""
    own = {item.key: item for item in takes}
    keys = {item.name: item.key for item in takes}
    found: dict[str, Any] = {}
    problems: list[Problem] = []
    for key, value in inputs.items():
        item = own.get(key) or _in_other_unit(key, takes)
        if item is None:
            problems.append(Problem(before + key, _unknown(key, own), "unknown_key"))
        elif item.name in found:
            text = _("given twice, also as {other}").format(other=keys[item.name])
            problems.append(Problem(before + key, text, "inconsistent"))
        elif value is not None or item.required:
            found[item.name] = value.tolist() if isinstance(value, np.ndarray | np.generic) else value
            keys[item.name] = key
    return found, keys, problems


def _inner(item: Given, value: Any, key: str) -> tuple[list[Problem], Any, dict[str, str]]:
    """Return what is wrong with tables, the tables in SI by name, and each key by its place and name."""
    if item.kind == "rows":
        return _rows(item, value, key)
    if not isinstance(value, Mapping):
        return [Problem(key, _("{value} is not a {shape}").format(value=_short(value), shape=item.shape))], {}, {}
    values, wrong = read(item.columns, value, f"{key}.")
    return wrong, values, {f".{name}": given_as for name, given_as in values.spelled.items()}


def _rows(item: Given, value: Any, key: str) -> tuple[list[Problem], list[Values], dict[str, str]]:
    """Return what is wrong with a list of tables, the tables in SI by name, and each key by its place and name."""
    if not isinstance(value, list | tuple) or not all(isinstance(row, Mapping) for row in value):
        return [Problem(key, _("{value} is not a {shape}").format(value=_short(value), shape=item.shape))], [], {}
    problems: list[Problem] = []
    tables: list[Values] = []
    keys: dict[str, str] = {}
    for k, row in enumerate(value):
        takes, given = item.columns, row
        if item.kinds:
            takes += item.kinds.get(str(row.get("kind")), ())
            if takes == item.columns:  # which other keys it needs cannot be said
                given = {name: entry for name, entry in row.items() if name == "kind" or _sort(takes, {name: 0}, "")[0]}
        values, wrong = read(takes, given, f"{key}[{k}].")
        problems += wrong
        tables.append(values)
        keys |= {f"[{k}].{name}": given_as for name, given_as in values.spelled.items()}
    return problems, tables, keys


def _unknown(key: str, known: Iterable[str]) -> str:
    near = nearest(key, known)
    if near:
        return _("unknown key; did you mean {near}?").format(near=near)
    return _("unknown key; the keys are {keys}").format(keys=", ".join(sorted(known)) or _("none"))


def _in_other_unit(key: str, takes: tuple[Given, ...]) -> Given | None:
    for item in takes:
        dimension = item.meaning.dimension
        if dimension and unit_of(key, dimension) and without_unit(key, dimension) == item.name:
            return item
    return None


def _factor(item: Given, key: str) -> float:
    dimension = item.meaning.dimension
    return factor(dimension, unit_of(key, dimension)) if dimension else 1.0


def _problems(item: Given, value: Any, key: str) -> Iterator[Problem]:
    """Yield what is wrong with one input by itself."""
    if value is None:
        yield Problem(key, _("missing: {doc}").format(doc=item.doc), "missing")
    elif item.kind == "flag":
        if not isinstance(value, bool):
            yield Problem(key, _("{value} is neither true nor false").format(value=_short(value)))
    elif item.kind == "word" and item.axes == (0,):
        yield from _word(item, value, key)
    elif item.kind == "word":
        if not isinstance(value, list | tuple):
            yield Problem(key, _("{value} is not a {shape}").format(value=_short(value), shape=item.shape))
            return
        for k, word in enumerate(value):
            yield from _word(item, word, f"{key}[{k}]")
    elif item.kind == "table":
        if not isinstance(value, Mapping):
            yield Problem(key, _("{value} is not a table from shaft number to value").format(value=repr(value)))
            return
        for name, entry in value.items():
            if not str(name).isdecimal():
                yield Problem(f"{key}.{name}", _("{name} is not a shaft number").format(name=repr(name)))
            yield from _number(item, entry, f"{key}.{name}", key)
    else:
        yield from _array(item, value, key)


def _word(item: Given, value: Any, key: str) -> Iterator[Problem]:
    if not item.meaning.choices:
        if not isinstance(value, str):
            yield Problem(key, _("{value} is not a {shape}").format(value=_short(value), shape=item.shape))
    elif value not in item.meaning.choices:
        near = nearest(str(value), item.meaning.choices)
        hint = _("; did you mean {near}?").format(near=near) if near else ""
        text = _("{value} is none of {choices}")
        choices = ", ".join(item.meaning.choices)
        yield Problem(key, text.format(value=_short(value), choices=choices) + hint, "out_of_range")


def _array(item: Given, value: Any, key: str) -> Iterator[Problem]:
    depth = _depth(value)
    if depth not in item.axes or (item.width is None and not _even(value)):
        yield Problem(key, _("{value} is not a {shape}").format(value=_short(value), shape=item.shape))
    elif item.width is None:
        for k, entry in enumerate(_flat(value)):
            yield from _number(item, entry, f"{key}[{k}]" if item.entries and depth == 1 else key, key)
    else:
        rows = [(key, value)] if depth == 1 else [(f"{key}[{k}]", row) for k, row in enumerate(value)]
        for field, row in rows:
            if len(row) == item.width:
                yield from list(entry for part in row for entry in _number(item, part, field, key))[:1]
            else:
                text = _("{value} has {count} numbers, {width} needed")
                yield Problem(field, text.format(value=_short(row), count=len(row), width=item.width))


def _number(item: Given, entry: Any, field: str, key: str) -> Iterator[Problem]:
    if isinstance(entry, bool) or not isinstance(entry, int | float):
        yield Problem(field, _("{value} is not a number").format(value=repr(entry)))
        return
    value = _scaled(entry, _factor(item, key))
    if not math.isfinite(value):
        yield Problem(field, _("{value} is not finite").format(value=_short(entry)), "not_finite")
    elif item.kind == "whole" and entry != int(entry):
        yield Problem(field, _("{value} is not a whole number").format(value=entry), "out_of_range")
    elif not in_range(item.meaning, value):
        text = out_of_range(shown(value, item.meaning), item.meaning, value)
        yield Problem(field, text, range_code(item.meaning, value))


def _scaled(entry: float, scale: float) -> float:
    """Return a number in SI, infinite where it is a whole number that no float can hold."""
    try:
        return float(entry) * scale
    except OverflowError:
        return math.inf


def _depth(value: Any) -> int | None:
    """Return how deep lists are nested, None where entries differ in it."""
    if not isinstance(value, list | tuple):
        return 0
    inner = {_depth(entry) for entry in value} or {0}
    below = inner.pop()
    return None if inner or below is None else 1 + below


def _even(value: Any) -> bool:
    """Tell whether the lists at one depth, at most two, have the same length."""
    return not isinstance(value, list | tuple) or len({len(row) for row in value if isinstance(row, list | tuple)}) < 2


def _flat(value: Any) -> Iterator[Any]:
    if isinstance(value, list | tuple):
        for entry in value:
            yield from _flat(entry)
    else:
        yield value


def _short(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


def _si(item: Given, value: Any, key: str) -> Any:
    if item.kind in ("word", "flag"):
        return value
    scale = _factor(item, key)
    if item.kind == "table":
        return {int(name): entry * scale for name, entry in value.items()}
    if isinstance(value, list | tuple):
        return np.asarray(value, dtype=int if item.kind == "whole" else float) * (1 if scale == 1.0 else scale)
    return int(value) if item.kind == "whole" else value * scale
