"""Adding, removing and moving joints in a drive file: what follows in the chain keeps its numbers right."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, MutableMapping
from typing import Any

import tomlkit

from cardan.errors import refuse
from cardan.texts import _

from .amend import parsed, tables_only
from .edit import plain

_PLACE = re.compile(r"\b(joints|shafts)\[(\d+)\]")

Moved = Callable[[int], int | None]
"""Index before -> index behind; None for what goes."""


@tables_only("joints")
def with_joint(text: str, at: int) -> str:
    """Return a drive file with a further joint, halfway between its neighbours.

    at: index that the new joint gets, 0 to n. The shaft that it parts keeps its number before the joint.
    """
    document = parsed(text)
    joints = _joints(document)
    if not 0 <= at <= len(joints):
        raise refuse("joints", _("has no place {at}").format(at=at))
    new = _like_neighbours(document, joints, at)
    _renumber(document, lambda k: k + (k >= at), lambda k: k + (k > at))
    table: Any = tomlkit.inline_table() if isinstance(joints, tomlkit.items.Array) else tomlkit.table()
    for key, value in new.items():
        table[key] = plain(value)
    joints.insert(at, table)
    return tomlkit.dumps(document)


@tables_only("joints")
def without_joint(text: str, at: int) -> str:
    """Return a drive file without a joint; the shaft behind it goes with it.

    at: index of the joint.
    """
    document = parsed(text)
    joints = _joints(document)
    if not 0 <= at < len(joints):
        raise refuse("joints", _("has no place {at}").format(at=at))
    if len(joints) == 1:
        raise refuse("joints", _("a drive keeps at least one joint"))
    _renumber(document, lambda k: None if k == at else k - (k > at), lambda k: None if k == at + 1 else k - (k > at))
    del joints[at]
    return tomlkit.dumps(document)


@tables_only("joints")
def joint_moved(text: str, at: int, to: int) -> str:
    """Return a drive file whose joint stands elsewhere in the chain; centres stay where they are in space.

    Two neighbours change places by everything they are but their centre, bend and plane twist: the line of the drive
    stays, the joints on it change.
    at, to: index of the joint before and behind.
    """
    document = parsed(text)
    joints = _joints(document)
    if not (0 <= at < len(joints) and 0 <= to < len(joints)):
        raise refuse("joints", _("has no place {at}").format(at=to))
    held = [{key: joint[key] for key in joint if _lies(key)} for joint in joints]
    others = [{key: joint[key] for key in joint if not _lies(key)} for joint in joints]
    others.insert(to, others.pop(at))
    for joint, lies, other in zip(joints, held, others, strict=True):
        for key in list(joint):
            del joint[key]
        for key, value in {**other, **lies}.items():
            joint[key] = value
    order = list(range(len(joints)))
    order.insert(to, order.pop(at))
    for pose in document.get("poses", []):
        if isinstance(pose, Mapping):
            _renamed(pose, {"joints": order.index, "shafts": int}, of_place=False)
    return tomlkit.dumps(document)


def _lies(key: str) -> bool:
    """Tell whether a key of a joint says where it lies."""
    return key.startswith(("centre_", "joint_angle_", "plane_twist_", "move_within_"))


def _joints(document: Any) -> Any:
    joints = document.get("joints")
    if not isinstance(joints, list):
        raise refuse("joints", _("missing: the joints in the order of the power flow"))
    return joints


def _like_neighbours(document: Any, joints: Any, at: int) -> dict[str, Any]:
    """Return the geometry of a new joint: halfway between its neighbours, or bent like one of them."""
    before = joints[at - 1] if at else document.get("input", {})
    behind = joints[at] if at < len(joints) else document.get("output", {})
    one, two = _point(before), _point(behind)
    if one and two and one[0] == two[0]:
        return {f"centre_{one[0]}": [round((a + b) / 2, 6) for a, b in zip(one[1], two[1], strict=True)]}
    near = joints[min(at, len(joints) - 1)]
    return {key: near[key] for key in near if key.startswith("joint_angle_")}


def _point(table: Mapping[str, Any]) -> tuple[str, list[float]] | None:
    """Return unit and coordinates of the point that a table gives."""
    for key, value in table.items():
        name, _sign, unit = str(key).partition("_")
        if name in ("centre", "point") and isinstance(value, list) and len(value) == 3:
            return unit, [float(x) for x in value]
    return None


def _renumber(document: Any, joint: Moved, shaft: Moved) -> None:
    """Give everything that names a joint or a shaft its new number; what names one that goes, goes too."""
    shafts = document.get("shafts", [])
    for k in reversed(range(len(shafts))):
        if isinstance(shafts[k].get("number"), int):
            _number(shafts, k, "number", shaft)
    for name in ("supports", "stations"):
        tables = document.get(name, [])
        for k in reversed(range(len(tables))):
            if isinstance(tables[k].get("shaft"), int):
                _number(tables, k, "shaft", shaft)
    for part in ("movements", "poses"):
        for table in document.get(part, []):
            _renamed(table, {"joints": joint, "shafts": shaft})


def _number(tables: Any, k: int, key: str, shaft: Moved) -> None:
    number = shaft(int(tables[k][key]) - 1)
    if number is None:
        del tables[k]
    else:
        tables[k][key] = number + 1


def _renamed(table: Any, moved: Mapping[str, Moved], *, of_place: bool = True) -> None:
    """Rename the paths in a table, its keys and its words; those that say where a joint lies only where asked."""
    for key in list(table):
        value = table[key]
        if isinstance(value, MutableMapping):
            held = [
                (
                    str(path) if not of_place and _lies(str(path).rpartition(".")[2]) else _path(str(path), moved),
                    value[path],
                )
                for path in value
            ]
            if [path for path, _one in held] != list(value):
                for path in list(value):
                    del value[path]
                value.update({path: one for path, one in held if path is not None})
        elif isinstance(value, list) and all(isinstance(one, str) for one in value):
            paths = [_path(str(one), moved) for one in value]
            if paths != [str(one) for one in value]:
                table[key] = [one for one in paths if one is not None]


def _path(path: str, moved: Mapping[str, Moved]) -> str | None:
    match = _PLACE.search(path)
    if match is None:
        return path
    number = moved[match[1]](int(match[2]))
    return None if number is None else f"{path[: match.start(2)]}{number}{path[match.end(2) :]}"
