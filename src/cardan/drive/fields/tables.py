"""A drive, or a mechanism, as the nested tables of its file: preferred units, defaults left out, every number exact."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import is_dataclass
from typing import Any

from cardan.drive.shaft import Shaft
from cardan.reading.fields import Field, exact_in_unit, fields_of, in_unit
from cardan.units import DIMENSIONS

from .keys import KINDS, NAMED


def tree_of(thing: Any) -> dict[str, Any]:
    """Return a drive, or a mechanism, as the nested tables of its file."""
    return {"format": thing.format, **_table(thing)}


def written(value: float, dimension: str) -> tuple[str, float]:
    """Return unit and number that stand for a value in SI exactly, the shortest in the preferred unit if there is one.

    >>> written(0.3490658503988659, "angle")
    ('deg', 20.0)
    """
    for unit, factor in DIMENSIONS[dimension].items():
        number = exact_in_unit(value, factor)
        if number is not None:
            return unit, number
    unit, factor = next(iter(DIMENSIONS[dimension].items()))  # pragma: no cover - every dimension has its SI unit
    return unit, in_unit(value, factor)


def _table(thing: Any) -> dict[str, Any]:
    table: dict[str, Any] = {}
    if any(
        isinstance(thing, base) and type(thing) is not kinds.get(usual or "") for base, (kinds, usual) in KINDS.items()
    ):
        table["kind"] = thing.kind
    for one in fields_of(type(thing)).values():
        value = getattr(thing, one.name)
        if not one.required and value == one.default:
            continue
        table.update(_entry(one, value))
    return table


def _entry(one: Field, value: Any) -> Iterator[tuple[str, Any]]:
    if one.name == "shafts":
        kept = [shaft for shaft in value if shaft != Shaft(number=shaft.number)]
        if kept:
            yield one.name, [_table(shaft) for shaft in kept]
    elif one.name == "set":
        yield one.name, {path: _listed(item) for path, item in value}
    elif is_dataclass(value):
        yield one.name, _name_alone(value) or _table(value)
    elif isinstance(value, tuple) and value and is_dataclass(value[0]):
        yield one.name, [_table(item) for item in value]
    elif one.key.dimension is None:
        yield one.name, _listed(value)
    else:
        yield _in_units(one, value)


def _name_alone(thing: Any) -> str:
    """Return the name of a thing that says nothing else, empty where it says more."""
    cls = type(thing)
    if cls not in NAMED:
        return ""
    name: str = getattr(thing, NAMED[cls])
    bare = cls(**{NAMED[cls]: name})
    return name if all(getattr(thing, one) == getattr(bare, one) for one in fields_of(cls)) else ""


def _in_units(one: Field, value: Any) -> tuple[str, Any]:
    """Return key and number(s): all numbers of a list in the first unit in which each is exact."""
    assert one.key.dimension is not None
    for unit, factor in DIMENSIONS[one.key.dimension].items():
        numbers = _mapped(value, factor)
        if numbers is not None:
            return f"{one.name}_{unit}", numbers
    unit, number = written(value, one.key.dimension)
    return f"{one.name}_{unit}", number


def _mapped(value: Any, factor: float) -> Any:
    if isinstance(value, tuple):
        items = [_mapped(item, factor) for item in value]
        return None if any(item is None for item in items) else items
    return exact_in_unit(value, factor)


def _listed(value: Any) -> Any:
    return [_listed(item) for item in value] if isinstance(value, tuple | list) else value
