"""Fields of the drive model as keys of a file: the one list that reader, writer, schema, paths and reference share."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import is_dataclass
from itertools import islice, tee
from typing import Any, get_args

from cardan.drive.described import Described
from cardan.drive.duty import History
from cardan.drive.joints import DEFAULT, JOINTS, Joint
from cardan.drive.machine import LAWS, MachineTorque
from cardan.drive.material import Material
from cardan.drive.movement import MOVEMENTS, Movement
from cardan.drive.shaft import Ply, Shaft
from cardan.reading.fields import Field, exact_in_unit, fields_of, in_unit
from cardan.units import DIMENSIONS

KINDS: dict[type, tuple[Mapping[str, type], str | None]] = {
    Joint: (JOINTS, DEFAULT),
    Movement: (MOVEMENTS, None),
    MachineTorque: (LAWS, None),
}
"""Base class -> its kinds by the value of the key ``kind``, and the default kind."""

NAMED: dict[type, str] = {Material: "grade", Ply: "grade", History: "file"}
"""Class of a table that may be given by a name alone -> field that holds the name."""


def spelled(path: str, root: Any = Described) -> str:
    """Return the path of a field of a file that describes a ``root`` as we write it, with the unit we prefer."""
    steps = []
    for step, one in _along(path, root):
        if one is None:
            return path
        steps.append(one.spelling + step[len(step.partition("[")[0]) :])
    return ".".join(steps)


USUAL = {"life": "h", "hours": "h", "distance": "km", "wheelbase": "m", "wheel_radius": "m", "engine_power": "kW"}
"""Fields that people give in another unit than most of their dimension."""


def key_of(bare: str) -> str:
    """Return the key of a path as a drawing or a data sheet has it: lives in hours, distances run in kilometres."""
    path = spelled(bare)
    unit = USUAL.get(bare.rpartition(".")[2])
    return path if unit is None else f"{bare}_{unit}"


def in_a_joint(drive: Described, key: str, inner: str = "") -> tuple[str, ...]:
    """Return the path of a key in the first joint that can have it; none where no joint of the drive can."""
    able = (k for k, joint in enumerate(drive.joints) if key in fields_of(type(joint)))
    return tuple(f"joints[{k}].{key}{inner}" for k in islice(able, 1))


def meant(path: str, root: Any = Described) -> str:
    """Return what a field means that a path without unit leads to, not translated; empty where it leads nowhere."""
    found = [one for _step, one in _along(path, root)]
    return found[-1].key.doc if found[-1] is not None else ""


def _along(path: str, root: Any) -> Iterator[tuple[str, Field | None]]:
    """Yield the steps of a path and the field each leads to, of the first kind that has it; None where it has none.

    Kinds are looked at one by one, so that those behind it need not be loaded.
    """
    classes: Iterable[Any] = [root]
    for step in path.split("."):
        here, there = tee(_named(step.partition("[")[0], classes))
        yield step, next(here, None)
        classes = (inner for one in there for inner in _classes(one.type))


def _named(name: str, classes: Iterable[Any]) -> Iterator[Field]:
    """Yield the fields of a name that classes have."""
    return (fields_of(cls)[name] for cls in classes if name in fields_of(cls))


def _classes(hint: Any) -> Iterator[Any]:
    """Yield the classes of the tables that a type holds, every kind of them."""
    for part in (hint, *get_args(hint)):
        if is_dataclass(part):
            yield from KINDS[part][0].values() if part in KINDS else (part,)


# A drive, or a mechanism, as the nested tables of its file: preferred units, defaults left out, every number exact.


def tree_of(thing: Any) -> dict[str, Any]:
    """Return a drive, or a mechanism, as the nested tables of its file."""
    return {"format": thing.format, **_table(thing)}


def written(value: float, dimension: str) -> tuple[str, float]:
    """Return unit and number that stand for a value in SI exactly, the shortest in the preferred unit if any."""
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
