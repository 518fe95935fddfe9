"""From a drive or a mechanism to the text of its file: preferred units, defaults left out, every number exact."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import is_dataclass
from typing import Any

from cardan.drive.drive import Drive
from cardan.drive.joints import Joint
from cardan.drive.keys import NAMED, Field, exact_in_unit, fields_of, in_unit
from cardan.drive.machine import MachineTorque
from cardan.drive.movement import Movement
from cardan.drive.shaft import Shaft
from cardan.mechanism.mechanism import Mechanism
from cardan.units import DIMENSIONS


def tree_of(thing: Drive | Mechanism) -> dict[str, Any]:
    """Return a drive, or a mechanism, as the nested tables of its file."""
    return {"format": thing.format, **_table(thing)}


def written(value: float, dimension: str) -> tuple[str, float]:
    """Return unit and number that stand for a value in SI exactly, the shortest in the preferred unit if there is one.

    Examples
    --------
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
    if isinstance(thing, Movement | MachineTorque) or (isinstance(thing, Joint) and thing.kind != "hooke"):
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


def toml_text(tree: Mapping[str, Any]) -> str:
    """Return nested tables as TOML: values first, then tables, then lists of tables."""
    lines: list[str] = []
    _emit(tree, "", lines)
    return "\n".join(lines).strip() + "\n"


def _emit(table: Mapping[str, Any], path: str, lines: list[str]) -> None:
    for key, value in table.items():
        if isinstance(value, Mapping) and not path and key in ("input", "output"):
            lines += [f"{key}.{inner} = {_toml(item)}" for inner, item in value.items()]
        elif not path and isinstance(value, str) and "\n" in value:
            lines.append(f"{_key(key)} = {_paragraphs(value)}")
        elif path or not (isinstance(value, Mapping) or _is_tables(value)):
            lines.append(f"{_key(key)} = {_toml(value)}")
    if path:
        return
    for key, value in table.items():
        if isinstance(value, Mapping) and key not in ("input", "output"):
            lines += ["", f"[{key}]"]
            _emit(value, key, lines)
        elif _is_tables(value):
            for item in value:
                lines += ["", f"[[{key}]]"]
                _emit(item, key, lines)


def _is_tables(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and isinstance(value[0], Mapping)


def _toml(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, list):
        return "[" + ", ".join(_toml(item) for item in value) + "]"
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(key)} = {_toml(item)}" for key, item in value.items()) + " }"
    return repr(whole(value))


def whole(value: Any) -> Any:
    """Return a whole number without a point, all else as it is."""
    return int(value) if isinstance(value, float) and value.is_integer() and abs(value) < 1e15 else value


def _paragraphs(text: str) -> str:
    """Return a text of several lines as one that a reader of the file sees as such."""
    body = "\n".join(_toml(line)[1:-1] for line in text.split("\n"))
    return f'"""\n{body}"""'


def _key(key: str) -> str:
    plain = key and all(c.isascii() and (c.isalnum() or c in "_-") for c in key)
    return key if plain else json.dumps(key, ensure_ascii=False)
