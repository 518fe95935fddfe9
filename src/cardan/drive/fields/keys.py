"""Fields of the drive model as keys of a file: the one list that reader, writer, schema, paths and reference share."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import MISSING, dataclass, fields, is_dataclass
from functools import cache
from itertools import islice
from types import UnionType
from typing import Any, Union, get_args, get_origin, get_type_hints

from cardan.drive.described import Described
from cardan.drive.duty import History
from cardan.drive.joints import DEFAULT, JOINTS, Joint
from cardan.drive.machine import LAWS, MachineTorque
from cardan.drive.material import Material
from cardan.drive.movement import MOVEMENTS, Movement
from cardan.units import DIMENSIONS, KEY, Key, preferred

KINDS: dict[type, tuple[Mapping[str, type], str | None]] = {
    Joint: (JOINTS, DEFAULT),
    Movement: (MOVEMENTS, None),
    MachineTorque: (LAWS, None),
}
"""Base class -> its kinds by the value of the key ``kind``, and the default kind."""

NAMED: dict[type, str] = {Material: "grade", History: "file"}
"""Class of a table that may be given by a name alone -> field that holds the name."""

WORD_OR_FLAG: Any = bool | str
"""Type of a field that is true, false or one of its words."""


@dataclass(frozen=True, slots=True)
class Field:
    """A field that may stand in a file.

    Attributes
    ----------
    name : str
        Its name in Python.
    key : Key
        What it means.
    type : type
        What it holds, without None.
    required : bool
        Whether it must be given.
    default : object
        Value when it is not given; None when required.
    """

    name: str
    key: Key
    type: Any
    required: bool
    default: Any

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


def fields_of(cls: Any) -> dict[str, Field]:
    """Return the fields of a class of the drive model that may stand in a file, by their names in Python.

    Examples
    --------
    >>> from cardan.drive.duty import Duty
    >>> list(fields_of(Duty)["speed"].spellings)
    ['speed_rpm', 'speed_rad_s', 'speed_deg_s']
    """
    return _fields_of(cls)


@cache
def _fields_of(cls: Any) -> dict[str, Field]:
    hints = get_type_hints(cls)
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


def spelled(path: str, root: Any = Described) -> str:
    """Return the path of a field of a file that describes a ``root`` as we write it, with the unit we prefer.

    Examples
    --------
    >>> spelled("joints[1].centre[2]"), spelled("shafts[1].spline.teeth")
    ('joints[1].centre_mm[2]', 'shafts[1].spline.teeth')
    """
    steps = []
    for step, fields_here in _along(path, root):
        if not fields_here:
            return path
        steps.append(fields_here[0].spelling + step[len(step.partition("[")[0]) :])
    return ".".join(steps)


USUAL = {"life": "h", "hours": "h", "distance": "km", "wheelbase": "m", "wheel_radius": "m"}
"""Fields that people give in another unit than most of their dimension."""


def key_of(bare: str) -> str:
    """Return the key of a path as a drawing or a data sheet has it: lives in hours, distances run in kilometres.

    Examples
    --------
    >>> key_of("duty.life"), key_of("shafts[1].outer")
    ('duty.life_h', 'shafts[1].outer_mm')
    """
    path = spelled(bare)
    unit = USUAL.get(bare.rpartition(".")[2])
    return path if unit is None else f"{bare}_{unit}"


def in_a_joint(drive: Described, key: str, inner: str = "") -> tuple[str, ...]:
    """Return the path of a key in the first joint that can have it; none where no joint of the drive can.

    Examples
    --------
    >>> from cardan.drive.drive import Drive
    >>> in_a_joint(Drive.from_angles([0.3]), "friction"), in_a_joint(Drive.from_angles([0.3]), "cross", ".span")
    (('joints[0].friction',), ('joints[0].cross.span',))
    """
    able = (k for k, joint in enumerate(drive.joints) if key in fields_of(type(joint)))
    return tuple(f"joints[{k}].{key}{inner}" for k in islice(able, 1))


def meant(path: str, root: Any = Described) -> str:
    """Return what a field means that a path without unit leads to, not translated; empty where it leads nowhere.

    Examples
    --------
    >>> meant("shafts[1].outer"), meant("shafts[1].spline.tooth_width"), meant("shafts[1].colour")
    ('outer diameter', 'width of a tooth', '')
    """
    found = [fields_here for _step, fields_here in _along(path, root)]
    return found[-1][0].key.doc if all(found) else ""


def _along(path: str, root: Any) -> Iterator[tuple[str, list[Field]]]:
    """Yield the steps of a path and the fields they may lead to; none where they lead nowhere."""
    classes: list[Any] = [root]
    for step in path.split("."):
        name = step.partition("[")[0]
        fields_here = [fields_of(cls)[name] for cls in classes if name in fields_of(cls)]
        yield step, fields_here
        classes = [inner for one in fields_here for inner in _classes(one.type)]


def _classes(hint: Any) -> list[Any]:
    """Return the classes of the tables that a type holds, every kind of them."""
    parts = [part for part in (hint, *get_args(hint)) if is_dataclass(part)]
    return [cls for part in parts for cls in (KINDS[part][0].values() if part in KINDS else [part])]


def in_unit(value: float, factor: float) -> float:
    """Return an SI value in a unit, as the shortest decimal that gives the value back, the nearest one if none does.

    Examples
    --------
    >>> in_unit(0.3490658503988659, 0.017453292519943295), in_unit(0.3, 0.001)
    (20.0, 300.0)
    """
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
