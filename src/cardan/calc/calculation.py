"""What a calculation is: a named question with unit keys, read and answered in SI by the function below it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, TypeAlias

import numpy as np

from cardan.drive.validity import in_range, out_of_range, shown
from cardan.errors import InputError, Problem, check
from cardan.texts import _
from cardan.units import DIMENSIONS, Key, factor, nearest

Values: TypeAlias = dict[str, Any]
"""Name without unit -> value in SI."""

PYTHON = {
    "bend": ("alpha",),
    "plane_twist": ("beta", "beta2"),
    "yoke_angle": ("gamma", "gamma2"),
    "angle": ("phi1",),
    "deviation": ("alpha_std",),
    "times": ("t",),
    "shafts": ("spline_teeth",),
}
"""What the functions call an input -> its names here, where they differ."""

Kind: TypeAlias = Literal["numbers", "whole", "table", "word", "flag", "rows"]

REQUIRED: Any = object()
"""Default of an input that must be given."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Given:
    """One input of a calculation.

    Attributes
    ----------
    key : str
        As in the reference cases, unit included; any other unit of its dimension is read as well.
    meaning : Key
        Sentence, dimension and allowed range in SI.
    kind : "numbers", "whole", "table", "word", "flag" or "rows"
        Numbers in ``axes``; whole numbers in ``axes``; a table from whole numbers to numbers; one of the key's choices,
        or a list of them where ``axes`` is (1,); true or false; a list of tables with the keys of ``columns``.
    axes : tuple of int
        How deep the lists may be nested; 0 is a bare number.
    width : int or None
        Length of the innermost lists, where it is fixed.
    default : object
        Value in SI where the input is not given; `REQUIRED` where it must be.
    columns : tuple of Given
        Keys of each table of rows.
    kinds : mapping
        Word under ``kind`` -> further keys of a table of rows of that kind; empty where all tables are alike.
    entries : bool
        Whether what is wrong with one number of a list is told under its own place: ``key[2]``.
    """

    key: str
    meaning: Key
    kind: Kind = "numbers"
    axes: tuple[int, ...] = (0,)
    width: int | None = None
    default: Any = REQUIRED
    columns: tuple[Given, ...] = ()
    kinds: Mapping[str, tuple[Given, ...]] = field(default_factory=dict, hash=False)
    entries: bool = False

    @property
    def name(self) -> str:
        """Key without its unit."""
        return without_unit(self.key, self.meaning.dimension)

    @property
    def doc(self) -> str:
        """What it means."""
        return self.meaning.doc

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
    """One output of a calculation.

    Attributes
    ----------
    key : str
        As in the reference cases, unit included.
    doc : str
        What it means.
    dimension : str or None
        A key of `cardan.units.DIMENSIONS`.
    unit : str
        Unit the value is given in; "" without a dimension.
    """

    key: str
    doc: str
    dimension: str | None = None
    unit: str = ""

    @property
    def factor(self) -> float:
        """How many SI units one unit of the output is."""
        return factor(self.dimension, self.unit) if self.dimension else 1.0


def given(
    key: str,
    doc: str,
    dimension: str | None = None,
    *,
    kind: Kind = "numbers",
    axes: tuple[int, ...] = (0,),
    width: int | None = None,
    default: Any = REQUIRED,
    entries: bool = False,
    **limits: Any,
) -> Given:
    """Declare an input; ``limits`` are those of `cardan.units.Key`, in SI."""
    meaning = Key(doc, dimension, **limits)
    return Given(key=key, meaning=meaning, kind=kind, axes=axes, width=width, default=default, entries=entries)


def rows(
    key: str,
    doc: str,
    *columns: Given,
    default: Any = REQUIRED,
    kinds: Mapping[str, tuple[Given, ...]] | None = None,
) -> Given:
    """Declare an input that is a list of tables, each with the keys of ``columns`` and those of its ``kind``."""
    more = {} if kinds is None else dict(kinds)
    if more:
        columns += (given("kind", _("of which kind"), kind="word", choices=tuple(more)),)
    return Given(key=key, meaning=Key(doc), kind="rows", columns=columns, default=default, kinds=more)


def gives(key: str, doc: str, dimension: str | None = None) -> Gives:
    """Declare an output; its unit is read off the key."""
    if dimension is None:
        return Gives(key=key, doc=doc)
    units = [unit for unit in DIMENSIONS[dimension] if f"_{unit}_" in f"{key}_"]
    return Gives(key=key, doc=doc, dimension=dimension, unit=max(units, key=len))


def without_unit(key: str, dimension: str | None) -> str:
    """Return a key without its unit: the one it ends in, else one amid it.

    Examples
    --------
    >>> without_unit("alpha_deg", "angle"), without_unit("delta_min", None), without_unit("tol_mm_a1", "length")
    ('alpha', 'delta_min', 'tol_a1')
    """
    unit = _unit_of(key, dimension)
    return f"{key}_".replace(f"_{unit}_", "_").removesuffix("_") if unit else key


def _unit_of(key: str, dimension: str | None) -> str:
    """Return the unit in a key, the longest it ends in, else the longest amid it; empty where there is none."""
    units = sorted(DIMENSIONS[dimension], key=len, reverse=True) if dimension else []
    last = [unit for unit in units if key.endswith(f"_{unit}")]
    return next(iter(last + [unit for unit in units if f"_{unit}_" in key]), "")


@dataclass(frozen=True, kw_only=True, slots=True)
class Calculation:
    """A named question: which keys it takes, which it gives, and the function that answers in SI.

    Attributes
    ----------
    name : str
        Name of the capability.
    doc : str
        What it computes, one sentence.
    source : str
        Where the method stands.
    takes : tuple of Given
        Inputs.
    returns : tuple of Gives
        Outputs that may occur.
    answer : function
        From values in SI by name to outputs in SI by key; outputs that are None are left out.
    check : function
        Yields what is wrong with values taken together; sees only inputs that are right by themselves.
    """

    name: str
    doc: str
    source: str
    takes: tuple[Given, ...]
    returns: tuple[Gives, ...]
    answer: Callable[[Values], Values]
    check: Callable[[Values, Callable[[str], str]], Iterable[Problem]] = lambda _values, _key: ()

    def __call__(self, inputs: Mapping[str, Any]) -> Values:
        """Return the outputs for inputs with unit keys.

        Raises
        ------
        InputError
            With everything that is wrong, each problem under the key as it was given.
        """
        values, keys = self.read(inputs)
        try:
            found = self.answer(values)
        except InputError as error:
            raise error.renamed(lambda field: _named(field, keys)) from None
        known = {output.key: output for output in self.returns}
        return {key: _plain(value, known[key].factor) for key, value in found.items() if value is not None}

    def read(self, inputs: Mapping[str, Any]) -> tuple[Values, dict[str, str]]:
        """Return the values in SI by name, and under which key each was given."""
        values, keys, problems = _read(self.takes, inputs)
        problems += self.check(values, lambda name: keys[name])
        check(problems)
        return values, keys


def _read(
    takes: tuple[Given, ...], inputs: Mapping[str, Any], before: str = ""
) -> tuple[Values, dict[str, str], list[Problem]]:
    """Return the values in SI by name, under which key each was given, and what is wrong with them one by one."""
    found, keys, problems = _sort(takes, inputs, before)
    values: Values = {}
    for item in takes:
        if item.name not in found:
            if item.required:
                problems.append(Problem(before + item.key, _("missing: {doc}").format(doc=item.doc)))
            else:
                values[item.name] = item.default
            continue
        key = keys[item.name]
        if item.kind == "rows":
            wrong, value, inner = _rows(item, found[item.name], before + key)
            keys |= {item.name + place: name for place, name in inner.items()}
        else:
            wrong, value = list(_problems(item, found[item.name], key)), None
            wrong = [Problem(before + problem.field, problem.message) for problem in wrong]
        problems += wrong
        if not wrong:
            values[item.name] = value if item.kind == "rows" else _si(item, found[item.name], key)
    return values, keys, problems


def _sort(
    takes: tuple[Given, ...], inputs: Mapping[str, Any], before: str
) -> tuple[Values, dict[str, str], list[Problem]]:
    """Find the input each given key belongs to."""
    own = {item.key: item for item in takes}
    keys = {item.name: item.key for item in takes}
    found: Values = {}
    problems: list[Problem] = []
    for key, value in inputs.items():
        item = own.get(key) or _in_other_unit(key, takes)
        if item is None:
            problems.append(Problem(before + key, _unknown(key, own)))
        elif item.name in found:
            problems.append(Problem(before + key, _("given twice, also as {other}").format(other=keys[item.name])))
        elif value is not None or item.required:
            found[item.name] = value.tolist() if isinstance(value, np.ndarray | np.generic) else value
            keys[item.name] = key
    return found, keys, problems


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
        values, own, wrong = _read(takes, given, f"{key}[{k}].")
        problems += wrong
        tables.append(values)
        keys |= {f"[{k}].{name}": f"{key}[{k}].{given_as}" for name, given_as in own.items()}
    return problems, tables, keys


def _unknown(key: str, known: Iterable[str]) -> str:
    near = nearest(key, known)
    if near:
        return _("unknown key; did you mean {near}?").format(near=near)
    return _("unknown key; the keys are {keys}").format(keys=", ".join(sorted(known)) or _("none"))


def _in_other_unit(key: str, takes: tuple[Given, ...]) -> Given | None:
    for item in takes:
        dimension = item.meaning.dimension
        if dimension and _unit_of(key, dimension) and without_unit(key, dimension) == item.name:
            return item
    return None


def _factor(item: Given, key: str) -> float:
    dimension = item.meaning.dimension
    return factor(dimension, _unit_of(key, dimension)) if dimension else 1.0


def _problems(item: Given, value: Any, key: str) -> Iterator[Problem]:
    """Yield what is wrong with one input by itself."""
    if item.kind == "flag":
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
            yield Problem(key, _("{value} is no table from shaft number to value").format(value=repr(value)))
            return
        for name, entry in value.items():
            if not str(name).isdecimal():
                yield Problem(f"{key}.{name}", _("{name} is no shaft number").format(name=repr(name)))
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
        yield Problem(key, text.format(value=_short(value), choices=", ".join(item.meaning.choices)) + hint)


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
        yield Problem(field, _("{value} is no number").format(value=repr(entry)))
        return
    value = _scaled(entry, _factor(item, key))
    if not math.isfinite(value):
        yield Problem(field, _("{value} is not finite").format(value=_short(entry)))
    elif item.kind == "whole" and entry != int(entry):
        yield Problem(field, _("{value} is not a whole number").format(value=entry))
    elif not in_range(item.meaning, value):
        yield Problem(field, out_of_range(shown(value, item.meaning), item.meaning, value))


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


def _named(field: str, keys: Mapping[str, str]) -> str:
    """Return a field named in Python as the key it was given under."""
    inside = [name for name in keys if "." in name and (field == name or field.startswith(f"{name}["))]
    if inside:
        return keys[inside[0]] + field.removeprefix(inside[0])
    name, bracket, rest = field.partition("[")
    own = [keys[one] for one in (name, *PYTHON.get(name, ())) if one in keys]
    return (own[0] if own else name) + bracket + rest


def _plain(value: Any, scale: float) -> Any:
    """Return arrays in SI as nested lists of numbers in the output's unit; what is undefined as None."""
    if isinstance(value, dict):
        return {name: _plain(entry, scale) for name, entry in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(entry, scale) for entry in value]
    if isinstance(value, np.ndarray | np.generic):
        return _plain(value.tolist(), scale)
    if isinstance(value, bool | str) or value is None:
        return value
    if isinstance(value, int):
        return value if scale == 1.0 else value / scale
    return None if math.isnan(value) else float(value) / scale
