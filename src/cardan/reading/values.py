"""Inputs with unit keys, read into SI, and everything that is wrong with them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

import numpy as np

from cardan.errors import Problem
from cardan.texts import _
from cardan.units import factor

from .given import Given, unit_of, without_unit
from .scalar import Wrong, scalar, unknown_key

TYPES = {"word": str, "flag": bool, "whole": int}  # kind of an input -> type of its scalars; all others hold numbers


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

    def wrong(self, name: str, message: str, code: str = "", **parts: Any) -> Problem:
        """Return what is wrong with a value, under its key; the parts stand in the message."""
        return Problem(self.key(name), message.format(**parts) if parts else message, code)

    def miscounted(self, wanted: int, *names: str, axis: int = -1, code: str = "") -> Iterator[Problem]:
        """Yield the lists that have not as many values as wanted; those not given are no matter."""
        for name in names:
            value = self.get(name)
            count = wanted if value is None or np.ndim(value) == 0 else np.shape(value)[axis]
            if count != wanted:
                text = _("{given} values given, {wanted} needed")
                yield self.wrong(name, text, code, given=count, wanted=wanted)

    def missing(self, why: str, *names: str, code: str = "") -> Iterator[Problem]:
        """Yield what is not given of that which another key, or a word, needs."""
        for name in names:
            if name in self and self[name] is None:
                yield self.wrong(name, _("missing; {other} needs it"), code, other=why)

    def single(self, name: str, axis: int = -1) -> Callable[[Any], Any]:
        """Return what takes an axis away from an array, or those of a result, where one value was given, no list."""
        if np.ndim(self[name]):
            return lambda found: found
        return lambda found: np.take(found, 0, axis) if isinstance(found, np.ndarray) else _Single(found, axis)

    def of(self, *names: str, **others: str) -> dict[str, Any]:
        """Return some of the values as arguments of a function: under their names, and under others."""
        return {name: self[name] for name in names} | {argument: self[name] for argument, name in others.items()}

    def but(self, **changed: Any) -> Values:
        """Return these values with some of them changed."""
        return Values(self | changed, self.spelled)


@dataclass(frozen=True, slots=True)
class _Single:
    """A result whose arrays have lost an axis."""

    found: Any
    axis: int

    def __getattr__(self, name: str) -> Any:
        value = getattr(self.found, name)
        return None if value is None else np.take(value, 0, self.axis)


def read(takes: tuple[Given, ...], inputs: Mapping[str, Any], before: str = "") -> tuple[Values, list[Problem]]:
    """Return the values in SI by name, and what is wrong with them one by one.

    inputs: key with unit -> value; before: path of the table that they stand in, with its dot.
    """
    found, keys, problems = _sort(takes, inputs, before)
    values: dict[str, Any] = {}
    spelled = {name: before + key for name, key in keys.items()}
    for item in takes:
        if item.name not in found:
            if item.required:
                problems.append(Problem(before + item.key, _("missing: {doc}").format(doc=item.doc), "missing"))
            else:
                values[item.name] = item.default
            continue
        value, at = found[item.name], spelled[item.name]
        if item.columns:
            made, wrong = _tables(item, value, at)
            inner = enumerate(made) if item.kind == "rows" else [(None, made)]
            places = [(f"{item.name}." if k is None else f"{item.name}[{k}].", one) for k, one in inner]
            spelled |= {start + name: key for start, one in places for name, key in one.spelled.items()}
        else:
            made, wrong = _value(item, value, at, unit_of(keys[item.name], item.meaning.dimension))
        problems += wrong
        if not wrong:
            values[item.name] = made
    return Values(values, spelled), problems


def _sort(
    takes: tuple[Given, ...], inputs: Mapping[str, Any], before: str
) -> tuple[dict[str, Any], dict[str, str], list[Problem]]:
    """Find the input each given key belongs to."""
    own = {item.key: item for item in takes}
    keys = {item.name: item.key for item in takes}
    found: dict[str, Any] = {}
    problems: list[Problem] = []
    for key, value in inputs.items():
        item = own.get(key) or next((one for one in takes if _in_other_unit(key, one)), None)
        if item is None:
            problems.append(Problem(before + key, unknown_key(key, own), "unknown_key"))
        elif item.name in found:
            text = _("{other} gives the same already").format(other=keys[item.name])
            problems.append(Problem(before + key, text, "inconsistent"))
        elif value is not None or item.required:
            found[item.name] = value.tolist() if isinstance(value, np.ndarray | np.generic) else value
            keys[item.name] = key
    return found, keys, problems


def _in_other_unit(key: str, item: Given) -> bool:
    dimension = item.meaning.dimension
    return bool(unit_of(key, dimension)) and without_unit(key, dimension) == item.name


def _tables(item: Given, value: Any, at: str) -> tuple[Any, list[Problem]]:
    """Return the values of a table, or of each of a list of them, and what is wrong with them."""
    if item.kind == "record":
        return (
            read(item.columns, value, f"{at}.") if isinstance(value, Mapping) else (Values(), [_form(item, value, at)])
        )
    if not isinstance(value, list | tuple) or not all(isinstance(row, Mapping) for row in value):
        return [], [_form(item, value, at)]
    read_rows = [read(*_of_kind(item, row), f"{at}[{k}].") for k, row in enumerate(value)]
    return [values for values, _wrong in read_rows], [problem for _values, wrong in read_rows for problem in wrong]


def _of_kind(item: Given, row: Mapping[str, Any]) -> tuple[tuple[Given, ...], Mapping[str, Any]]:
    """Return the keys of a row, and those given of which something can be said."""
    more = item.kinds.get(str(row.get("kind")), ())
    if item.kinds and not more:  # which other keys it needs cannot be said
        row = {name: one for name, one in row.items() if name == "kind" or _sort(item.columns, {name: 0}, "")[0]}
    return item.columns + more, row


def _value(item: Given, value: Any, at: str, unit: str) -> tuple[Any, list[Problem]]:
    """Return an input in SI, and what is wrong with it by itself."""
    if value is None:
        return None, [Problem(at, _("missing: {doc}").format(doc=item.doc), "missing")]
    scale = factor(item.meaning.dimension, unit) if item.meaning.dimension else 1.0
    if item.kind == "table":
        if not isinstance(value, Mapping):
            return None, [_form(item, value, at)]
        text = _("{name} is not a shaft number")
        names = [name for name in value if not str(name).isdecimal()]
        problems = [Problem(f"{at}.{name}", text.format(name=repr(name))) for name in names]
        problems += [one for name, entry in value.items() for one in _wrong(item, entry, f"{at}.{name}", scale, unit)]
        return (None if problems else {int(name): entry * scale for name, entry in value.items()}), problems
    depth, lists = _depth(value), item.kind in ("numbers", "whole")
    if (lists or item.axes != (0,)) and (depth not in item.axes or (item.width is None and not _even(value))):
        return None, [_form(item, value, at)]
    problems = list(_entry_problems(item, value, at, scale, unit))
    if problems or not lists:
        return value, problems
    if depth:
        return np.asarray(value, dtype=int if item.kind == "whole" else float) * (1 if scale == 1.0 else scale), []
    return (int(value) if item.kind == "whole" else value * scale), []


def _entry_problems(item: Given, value: Any, at: str, scale: float, unit: str) -> Iterator[Problem]:
    """Yield what is wrong with the entries of a value, of each row of fixed length the first."""
    nested = isinstance(value, list | tuple) and item.axes != (0,)
    if item.width is None:
        own = nested and (item.entries or item.kind == "word") and _depth(value) == 1
        for k, entry in enumerate(_flat(value) if nested else [value]):
            yield from _wrong(item, entry, f"{at}[{k}]" if own else at, scale, unit)
        return
    for k, row in enumerate(value if _depth(value) == 2 else [value]):
        here = f"{at}[{k}]" if _depth(value) == 2 else at
        if len(row) == item.width:
            yield from [one for entry in row for one in _wrong(item, entry, here, scale, unit)][:1]
        else:
            text = _("{value} has {count} numbers, {width} needed")
            yield Problem(here, text.format(value=_short(row), count=len(row), width=item.width))


def _wrong(item: Given, entry: Any, at: str, scale: float, unit: str) -> Iterator[Problem]:
    """Yield what is wrong with one number, word or flag."""
    if item.kind == "whole" and isinstance(entry, float) and entry.is_integer():
        entry = int(entry)
    found = scalar(TYPES.get(item.kind, float), entry, item.meaning, scale, unit)
    if isinstance(found, Wrong):
        yield Problem(at, found.message, found.code)


def _form(item: Given, value: Any, at: str) -> Problem:
    return Problem(at, _("{value} is not a {shape}").format(value=_short(value), shape=item.shape))


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
    for entry in value:
        yield from _flat(entry) if isinstance(entry, list | tuple) else (entry,)


def _short(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."
