"""Fields of a dataclass as keys of a file: the one list that reader, writer, schema, paths and reference share."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator
from dataclasses import MISSING, dataclass, fields
from functools import cache
from types import UnionType
from typing import Any, ClassVar, Protocol, Union, get_args, get_origin

from cardan.units import DIMENSIONS, KEY, Key, preferred

WORD_OR_FLAG: Any = bool | str  # type of a field that is true, false or one of its words


@dataclass(frozen=True, slots=True)
class Field:
    """A field that may stand in a file."""

    name: str  # its name in Python
    key: Key  # what it means
    type: Any  # what it holds, without None
    required: bool  # whether it must be given
    default: Any  # value when it is not given; None when required

    @property
    def spellings(self) -> dict[str, float]:
        """Keys under which a file may give this field, each with its factor to SI; the preferred one first."""
        if self.key.dimension is None:
            units = {"": 1.0}
        else:
            units = {f"_{unit}": factor for unit, factor in DIMENSIONS[self.key.dimension].items()}
        plain = {self.name + end: factor for end, factor in units.items()}
        mirrored = {self.key.mirror + end: -factor for end, factor in units.items()} if self.key.mirror else {}
        return plain | mirrored

    @property
    def spelling(self) -> str:
        """The key we write."""
        return self.name if self.key.dimension is None else f"{self.name}_{preferred(self.key.dimension)}"

    def unit(self, spelling: str) -> str:
        """Return the unit at the end of one of the spellings, empty where there is none."""
        if self.key.dimension is None:
            return ""
        word = self.name if spelling.startswith(f"{self.name}_") else self.key.mirror
        return spelling.removeprefix(f"{word}_")


class Keyed(Protocol):
    """What a file describes, a drive or a mechanism: a dataclass whose fields are its keys."""

    __dataclass_fields__: ClassVar[dict[str, Any]]


def fields_of(cls: Any) -> dict[str, Field]:
    """Return the fields of a class of the drive model that may stand in a file, by their names in Python."""
    return _fields_of(cls)


@cache
def _fields_of(cls: Any) -> dict[str, Field]:
    hints = _hints(cls) | (cls.tables() if hasattr(cls, "tables") else {})
    foreign: frozenset[str] = getattr(cls, "foreign", frozenset())
    return {
        one.name: Field(
            name=one.name,
            key=one.metadata[KEY],
            type=_without_none(hints[one.name]),
            required=one.default is MISSING,
            default=None if one.default is MISSING else one.default,
        )
        for one in fields(cls)
        if KEY in one.metadata and one.name not in foreign
    }


def _hints(cls: Any) -> dict[str, Any]:
    """Return the types of the annotations of a class, as `typing.get_type_hints` does at ten times the cost."""
    return {
        name: _type_of(kind, base.__module__) if isinstance(kind, str) else kind
        for base in reversed(cls.__mro__)
        for name, kind in vars(base).get("__annotations__", {}).items()
    }


@cache
def _type_of(annotation: str, module: str) -> Any:
    """Return what an annotation means in a module."""
    return eval(annotation, vars(sys.modules[module]))


def spellings_of(cls: Any) -> dict[str, tuple[str, float]]:
    """Return every key a file may use for a class: key -> (name of the field, factor to SI)."""
    return _spellings_of(cls)


@cache
def _spellings_of(cls: Any) -> dict[str, tuple[str, float]]:
    return {
        spelling: (field.name, factor)
        for field in fields_of(cls).values()
        for spelling, factor in field.spellings.items()
    }


def in_unit(value: float, factor: float) -> float:
    """Return an SI value in a unit, as the shortest decimal that gives the value back, the nearest one if none does."""
    found = exact_in_unit(value, factor)
    return value / factor if found is None else found


def exact_in_unit(value: float, factor: float) -> float | None:
    """Return the shortest decimal whose product with ``factor`` is ``value`` to the last bit, or None."""
    near = value / factor
    candidates = [float(f"{near:.{digits}g}") for digits in range(1, 18)]
    candidates += [math.nextafter(near, math.inf), math.nextafter(near, -math.inf)]
    return next((one for one in candidates if one * factor == value), None)


def scaled(value: Any, factor: float) -> Any:
    """Return a number, or nested tuples of numbers, times a factor; words and flags as they are."""
    if isinstance(value, tuple | list):
        return tuple(scaled(item, factor) for item in value)
    if factor == 1.0 or isinstance(value, bool | str) or value is None:
        return value
    return value * factor


def numbers_in(value: Any) -> Iterator[float]:
    """Yield every number of nested lists."""
    if isinstance(value, tuple | list):
        for item in value:
            yield from numbers_in(item)
    elif isinstance(value, int | float) and not isinstance(value, bool):
        yield float(value)


def _without_none(hint: Any) -> Any:
    if get_origin(hint) in (Union, UnionType):
        kinds = [one for one in get_args(hint) if one is not type(None)]
        return kinds[0] if len(kinds) == 1 else hint
    return hint
