"""Inputs and outputs under keys with units: what each is called, means, and may be."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from typing import Any, Literal, TypeAlias

from cardan.texts import _
from cardan.units import DIMENSIONS, Key, factor

Kind: TypeAlias = Literal["numbers", "whole", "table", "word", "flag", "rows", "record"]

REQUIRED: Any = object()  # default of an input that must be given
RIGHT = 0.5 * math.pi  # a right angle
BY_UNIT = "by unit"  # in place of a dimension: the first one that has the unit in the key


@dataclass(frozen=True, kw_only=True, slots=True)
class Given:
    """One input of a calculation."""

    key: str  # as in the reference cases, unit included; any other unit of its dimension is read as well
    meaning: Key  # sentence, dimension and allowed range in SI
    # numbers in ``axes``; whole numbers in ``axes``; a table from whole numbers to numbers; one of the key's choices,
    # or a list of them where ``axes`` is (1,); true or false; a list of tables with the keys of ``columns``, or one
    # such table
    kind: Kind = "numbers"
    axes: tuple[int, ...] = (0,)  # how deep the lists may be nested; 0 is a bare number
    width: int | None = None  # length of the innermost lists, where it is fixed
    default: Any = REQUIRED  # value in SI where the input is not given; `REQUIRED` where it must be
    columns: tuple[Given, ...] = ()  # keys of each table of rows
    # word under ``kind`` -> further keys of a table of rows of that kind; empty where all tables are alike
    kinds: Mapping[str, tuple[Given, ...]] = field(default_factory=dict, hash=False)
    entries: bool = False  # whether what is wrong with one number of a list is told under its own place: ``key[2]``

    @property
    def name(self) -> str:
        """Key without its unit."""
        return without_unit(self.key, self.meaning.dimension)

    @property
    def doc(self) -> str:
        """What it means."""
        return _(self.meaning.doc)

    @property
    def required(self) -> bool:
        """Whether it must be given."""
        return self.default is REQUIRED

    @property
    def shape(self) -> str:
        """What form the value has, in words."""
        if self.kind == "table":
            return _("table from shaft number to value")
        if self.kind == "flag":
            return _("true or false")
        if self.kind == "rows":
            keys = [", ".join(column.key for column in self.columns)]
            keys += [f"{kind}: {', '.join(column.key for column in more)}" for kind, more in self.kinds.items()]
            return _("list of tables with {keys}").format(keys="; ".join(keys))
        if self.kind == "record":
            return _("table with {keys}").format(keys=", ".join(column.key for column in self.columns))
        if self.kind == "word" and not self.meaning.choices:
            return _("name")
        if self.kind == "word":
            text = _("one of {choices}") if self.axes == (0,) else _("list of some of {choices}")
            return text.format(choices=", ".join(self.meaning.choices))
        wide = "" if self.width is None else f" × {self.width}"
        names = {
            0: _("number") if self.kind == "numbers" else _("whole number"),
            1: _("list") + wide,
            2: _("list of lists") + wide,
        }
        return _(" or ").join(names[axis] for axis in self.axes)


@dataclass(frozen=True, kw_only=True, slots=True)
class Gives:
    """One output of a calculation."""

    key: str  # as in the reference cases, unit included
    doc: str  # what it means
    dimension: str | None = None  # a key of `cardan.units.DIMENSIONS`
    unit: str = ""  # unit the value is given in; "" without a dimension
    of: str = ""  # name of the value in what the formula found, where it has names

    @property
    def factor(self) -> float:
        """How many SI units one unit of the output is."""
        return factor(self.dimension, self.unit) if self.dimension else 1.0


def given(
    key: str,
    doc: str,
    dimension: str | None = BY_UNIT,
    *,
    kind: Kind = "numbers",
    axes: int | tuple[int, ...] = 0,
    width: int | None = None,
    default: Any = REQUIRED,
    entries: bool = False,
    **limits: Any,
) -> Given:
    """Declare an input; its dimension is that of the unit in its key, ``limits`` are those of `Key`, in SI."""
    meaning = Key(doc, _dimension(key) if dimension == BY_UNIT else dimension, **limits)
    axes = axes if isinstance(axes, tuple) else (axes,)
    return Given(key=key, meaning=meaning, kind=kind, axes=axes, width=width, default=default, entries=entries)


def positive(key: str, doc: str, dimension: str | None = BY_UNIT, **options: Any) -> Given:
    """Declare an input above zero."""
    return given(key, doc, dimension, above=0.0, **options)


def at_least_zero(key: str, doc: str, dimension: str | None = BY_UNIT, **options: Any) -> Given:
    """Declare an input that is not negative."""
    return given(key, doc, dimension, low=0.0, **options)


def joint_angle(key: str, doc: str, **options: Any) -> Given:
    """Declare an input that is the angle of a joint: at least 0, less than 90°."""
    return given(key, doc, low=0.0, below=RIGHT, **options)


def vector(key: str, doc: str, **options: Any) -> Given:
    """Declare an input with three components."""
    return given(key, doc, axes=1, width=3, **options)


def whole(key: str, doc: str, **options: Any) -> Given:
    """Declare an input that is a whole number."""
    return given(key, doc, None, kind="whole", **options)


def word(key: str, doc: str, *choices: str, **options: Any) -> Given:
    """Declare an input that is one of some words, or any word."""
    return given(key, doc, None, kind="word", choices=choices, **options)


def flag(key: str, doc: str, *, default: Any = False) -> Given:
    """Declare an input that is true or false."""
    return given(key, doc, None, kind="flag", default=default)


def rows(
    key: str, doc: str, *columns: Given, default: Any = REQUIRED, kinds: Mapping[str, tuple[Given, ...]] | None = None
) -> Given:
    """Declare an input that is a list of tables, each with the keys of ``columns`` and those of its ``kind``."""
    if kinds:
        columns += (word("kind", "of which kind", *kinds),)
    return Given(key=key, meaning=Key(doc), kind="rows", columns=columns, default=default, kinds=kinds or {})


def record(key: str, doc: str, *columns: Given, default: Any = REQUIRED) -> Given:
    """Declare an input that is one table with the keys of ``columns``."""
    return Given(key=key, meaning=Key(doc), kind="record", columns=columns, default=default)


def gives(key: str, doc: str, dimension: str | None = BY_UNIT) -> Gives:
    """Declare an output, ``"key"`` or ``"key = name of it in what the formula found"``; its unit is in the key."""
    key, _equals, of = key.partition(" = ")
    dimension = _dimension(key) if dimension == BY_UNIT else dimension
    return Gives(key=key, doc=doc, dimension=dimension, unit=unit_of(key, dimension), of=of)


LEAST = "min"  # a word of keys that is not the unit of its name

_UNITS = {unit: name for name, units in reversed(DIMENSIONS.items()) for unit in units if unit != LEAST}
"""Unit -> the first dimension that has it."""


@cache
def _dimension(key: str) -> str | None:
    """Return the first dimension that has the unit in a key: the one it ends in, else one amid it."""
    found = [unit for unit in _UNITS if key.endswith(f"_{unit}")] or [unit for unit in _UNITS if f"_{unit}_" in key]
    return _UNITS[max(found, key=len)] if found else None


def without_unit(key: str, dimension: str | None) -> str:
    """Return a key without its unit: the one it ends in, else one amid it."""
    unit = unit_of(key, dimension)
    return f"{key}_".replace(f"_{unit}_", "_").removesuffix("_") if unit else key


def unit_of(key: str, dimension: str | None) -> str:
    """Return the unit in a key, the longest it ends in, else the longest amid it; empty where there is none."""
    units = sorted(DIMENSIONS[dimension], key=len, reverse=True) if dimension else []
    last = [unit for unit in units if key.endswith(f"_{unit}")]
    return next(iter(last + [unit for unit in units if f"_{unit}_" in key]), "")
