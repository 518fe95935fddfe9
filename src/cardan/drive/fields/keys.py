"""Fields of the drive model as keys of a file: the one list that reader, writer, schema, paths and reference share."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import is_dataclass
from itertools import islice
from typing import Any, get_args

from cardan.drive.described import Described
from cardan.drive.duty import History
from cardan.drive.joints import DEFAULT, JOINTS, Joint
from cardan.drive.machine import LAWS, MachineTorque
from cardan.drive.material import Material
from cardan.drive.movement import MOVEMENTS, Movement
from cardan.reading.fields import Field, fields_of

KINDS: dict[type, tuple[Mapping[str, type], str | None]] = {
    Joint: (JOINTS, DEFAULT),
    Movement: (MOVEMENTS, None),
    MachineTorque: (LAWS, None),
}
"""Base class -> its kinds by the value of the key ``kind``, and the default kind."""

NAMED: dict[type, str] = {Material: "grade", History: "file"}
"""Class of a table that may be given by a name alone -> field that holds the name."""


def spelled(path: str, root: Any = Described) -> str:
    """Return the path of a field of a file that describes a ``root`` as we write it, with the unit we prefer."""
    steps = []
    for step, fields_here in _along(path, root):
        if not fields_here:
            return path
        steps.append(fields_here[0].spelling + step[len(step.partition("[")[0]) :])
    return ".".join(steps)


USUAL = {"life": "h", "hours": "h", "distance": "km", "wheelbase": "m", "wheel_radius": "m"}
"""Fields that people give in another unit than most of their dimension."""


def key_of(bare: str) -> str:
    """Return the key of a path as a drawing or a data sheet has it: lives in hours, distances run in kilometres."""
    path = spelled(bare)
    unit = USUAL.get(bare.rpartition(".")[2])
    return path if unit is None else f"{bare}_{unit}"


def in_a_joint(drive: Described, key: str, inner: str = "") -> tuple[str, ...]:
    """Return the path of a key in the first joint that can have it; none where no joint of the drive can.

    >>> from cardan.drive.drive import Drive
    >>> in_a_joint(Drive.from_angles([0.3]), "friction"), in_a_joint(Drive.from_angles([0.3]), "cross", ".span")
    (('joints[0].friction',), ('joints[0].cross.span',))
    """
    able = (k for k, joint in enumerate(drive.joints) if key in fields_of(type(joint)))
    return tuple(f"joints[{k}].{key}{inner}" for k in islice(able, 1))


def meant(path: str, root: Any = Described) -> str:
    """Return what a field means that a path without unit leads to, not translated; empty where it leads nowhere."""
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
