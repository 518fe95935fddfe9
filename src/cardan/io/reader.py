"""From the tree of a drive file to a `Drive`: every problem of the file at once, each on the path the user wrote."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, is_dataclass
from typing import Any, get_args, get_origin

from cardan.drive.drive import Drive
from cardan.drive.joints import JOINTS, Joint
from cardan.drive.keys import Field, fields_of, numbers_in, scaled, spellings_of
from cardan.drive.movement import MOVEMENTS, Movement
from cardan.drive.pose import Pose
from cardan.drive.shaft import Shaft
from cardan.drive.validity import MAX_JOINTS, allowed, movement_problems, shaft_problems
from cardan.errors import InputError, Problem, check
from cardan.texts import _
from cardan.units import DIMENSIONS, label, nearest

KINDS: dict[type, tuple[Mapping[str, type], str | None]] = {Joint: (JOINTS, "hooke"), Movement: (MOVEMENTS, None)}
"""Base class -> its kinds by the value of the key ``kind``, and the default kind."""

PARTS: tuple[Any, ...] = tuple(
    {Drive, *JOINTS.values(), *MOVEMENTS.values(), Pose, Shaft}
    | {one.type for cls in (Drive, Shaft) for one in fields_of(cls).values() if is_dataclass(one.type)}
)

_GEOMETRY = ("centre", "bend", "side_slope", "plan_slope", "point")
_MISSING = object()


@dataclass(slots=True)
class Findings:
    """What a reading brings to light.

    Attributes
    ----------
    problems : list of Problem
        With paths as written in the file.
    spelled : dict
        Path in Python -> path as written.
    doubtful : set of str
        Paths in Python of fields that were refused: what follows from them is not reported again.
    partial : dict
        Path in Python -> the good items of a list that has bad ones.
    """

    problems: list[Problem] = field(default_factory=list)
    spelled: dict[str, str] = field(default_factory=dict)
    doubtful: set[str] = field(default_factory=set)
    partial: dict[str, tuple[Any, ...]] = field(default_factory=dict)

    def refuse(self, written: str, message: str, path: str = "") -> None:
        """Note a problem at the path as written, and that the field at ``path`` is not to be trusted."""
        self.problems.append(Problem(written, message))
        if path:
            self.doubtful.add(path)


def drive_from_tree(tree: Mapping[str, Any]) -> Drive:
    """Return the drive a file describes.

    Parameters
    ----------
    tree : mapping
        The file as nested tables.

    Raises
    ------
    InputError
        Everything that is wrong with it.
    """
    found = Findings()
    _format(tree, found)
    _too_long(tree)
    values = _values(Drive, {key: value for key, value in tree.items() if key != "format"}, "", "", found)
    if found.problems and (values is None or any(p.rsplit(".", 1)[-1] in _GEOMETRY for p in found.doubtful)):
        _check_parts(tree, values or {}, found)
        raise InputError(found.problems)
    try:
        drive = Drive(**(values or {}))
    except InputError as error:
        for problem in error.problems:
            if problem.field not in found.doubtful:
                found.problems.append(Problem(_as_written(problem.field, found), problem.message))
        drive = None
    check(found.problems)
    assert drive is not None
    return drive


def _check_parts(tree: Mapping[str, Any], values: Mapping[str, Any], found: Findings) -> None:
    """Note what is wrong with shafts and movements of a drive whose geometry is not to be trusted."""
    joints = tree.get("joints")
    if not isinstance(joints, list) or not joints:
        return
    shafts = values.get("shafts", found.partial.get("shafts", ()))
    movements = values.get("movements", ())
    for problem in (*shaft_problems(shafts, len(joints)), *movement_problems(movements, len(joints))):
        if problem.field not in found.doubtful:
            found.problems.append(Problem(_as_written(problem.field, found), problem.message))


def _format(tree: Mapping[str, Any], found: Findings) -> None:
    given = tree.get("format", _MISSING)
    if given is _MISSING:
        found.refuse("format", _("missing; write format = {format} at the top").format(format=Drive.format))
    elif isinstance(given, bool) or given != Drive.format:
        found.refuse(
            "format",
            _("{given} is not known; this version reads format = {format}").format(
                given=repr(given), format=Drive.format
            ),
        )


def _too_long(tree: Mapping[str, Any]) -> None:
    joints = tree.get("joints")
    if isinstance(joints, list) and len(joints) > MAX_JOINTS:
        message = _("{n} joints given; the limit is {limit}").format(n=len(joints), limit=MAX_JOINTS)
        raise InputError([Problem("joints", message)])


def _as_written(path: str, found: Findings) -> str:
    """Return the path of a field as the file spells it, or as we would."""
    if path in found.spelled:
        return found.spelled[path]
    parent, _dot, last = path.rpartition(".")
    stem, _bracket, rest = last.partition("[")
    if rest and f"{parent}.{stem}" in found.spelled:
        return f"{found.spelled[f'{parent}.{stem}']}[{rest}"
    for cls in PARTS:
        if stem in fields_of(cls) and fields_of(cls)[stem].key.dimension is not None:
            return f"{parent}{_dot}{fields_of(cls)[stem].spelling}{_bracket}{rest}"
    return path


def _values(cls: type, table: Any, written: str, path: str, found: Findings) -> dict[str, Any] | None:
    """Return the arguments of a class from a table; None when a required one is missing or wrong."""
    if not isinstance(table, Mapping):
        found.refuse(written, _("must be a table, not {given}").format(given=_shown(table)), path)
        return None
    known = spellings_of(cls)
    used: dict[str, str] = {}
    values: dict[str, Any] = {}
    whole = True
    for key, value in table.items():
        here = f"{written}.{key}" if written else str(key)
        if key not in known:
            found.refuse(here, _unknown(cls, str(key)), _doubted(cls, str(key), path))
            continue
        name, factor = known[key]
        one = fields_of(cls)[name]
        there = f"{path}.{name}" if path else name
        if name in used:
            found.refuse(here, _("{other} gives the same already").format(other=used[name]), there)
            continue
        used[name] = key
        found.spelled[there] = here
        read = _value(one, one.type, value, factor, here, there, found)
        if read is not _MISSING:
            values[name] = read
        elif one.required:
            whole = False
    for name, one in fields_of(cls).items():
        there = f"{path}.{name}" if path else name
        if one.required and name not in used and there not in found.doubtful:
            whole = False
            here = f"{written}.{one.spelling}" if written else one.spelling
            found.refuse(here, _("missing: {doc}").format(doc=one.key.doc), there)
    return values if whole else None


def _value(one: Field, kind: Any, value: Any, factor: float, written: str, path: str, found: Findings) -> Any:
    """Return a value in SI as the field's type wants it, or `_MISSING` after noting what is wrong."""
    if one.name == "set" and get_origin(kind) is tuple:
        return _changes(value, written, path, found)
    if get_origin(kind) is tuple:
        return _list(one, get_args(kind), value, factor, written, path, found)
    if kind in KINDS:
        return _kind(kind, value, written, path, found)
    if is_dataclass(kind):
        values = _values(kind, value, written, path, found)  # type: ignore[arg-type]
        return _MISSING if values is None else kind(**values)  # type: ignore[operator]
    return _scalar(one, kind, value, factor, written, path, found)


def _scalar(one: Field, kind: Any, value: Any, factor: float, written: str, path: str, found: Findings) -> Any:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    fits = {float: number, int: number and isinstance(value, int), bool: isinstance(value, bool)}.get(
        kind, isinstance(value, str)
    )
    wanted = {float: _("a number"), int: _("a whole number"), bool: _("true or false")}.get(kind, _("a text"))
    if not fits:
        found.refuse(written, _("must be {wanted}, not {given}").format(wanted=wanted, given=_shown(value)), path)
        return _MISSING
    if kind is float or kind is int:
        try:
            result = value if kind is int else float(value) * factor
        except OverflowError:
            result = math.inf
        if not one.key.allows(result):
            message = _("{value} is not allowed; allowed is {allowed}")
            found.refuse(written, message.format(value=_shown(value), allowed=allowed(one.key)), path)
            return _MISSING
        return result
    if one.key.choices and value not in one.key.choices:
        choices = ", ".join(one.key.choices)
        found.refuse(written, _("{value} is none of {choices}").format(value=_shown(value), choices=choices), path)
        return _MISSING
    return value


def _list(one: Field, parts: Any, value: Any, factor: float, written: str, path: str, found: Findings) -> Any:
    if not isinstance(value, list):
        wanted = _("tables") if _holds_tables(parts[0]) else _("a list")
        found.refuse(written, _("must be {wanted}, not {given}").format(wanted=wanted, given=_shown(value)), path)
        return _MISSING
    endless = len(parts) == 2 and parts[1] is Ellipsis
    if not endless and len(value) != len(parts):
        message = _("has {given} entries; {wanted} are needed").format(given=len(value), wanted=len(parts))
        found.refuse(written, message, path)
        return _MISSING
    items = []
    for k, item in enumerate(value):
        part = parts[0] if endless else parts[k]
        place = f"[{_shaft_index(item, k)}]" if part is Shaft else f"[{k}]"
        items.append(_value(one, part, item, factor, written + place, path + place, found))
    if any(item is _MISSING for item in items):
        found.doubtful.add(path)
        found.partial[path] = tuple(item for item in items if item is not _MISSING)
        return _MISSING
    return tuple(items)


def _shaft_index(item: Any, k: int) -> int:
    """Return the index of a shaft in paths: its number less one, wherever it stands in the file."""
    number = item.get("number") if isinstance(item, Mapping) else None
    return number - 1 if isinstance(number, int) and not isinstance(number, bool) and number >= 1 else k


def _kind(base: type, value: Any, written: str, path: str, found: Findings) -> Any:
    kinds, default = KINDS[base]
    if not isinstance(value, Mapping):
        found.refuse(written, _("must be a table, not {given}").format(given=_shown(value)), path)
        return _MISSING
    name = value.get("kind", default)
    if name is None:
        found.refuse(f"{written}.kind", _("missing; one of {kinds}").format(kinds=", ".join(kinds)), path)
        return _MISSING
    if not isinstance(name, str) or name not in kinds:
        message = _("{given} is none of {kinds}").format(given=_shown(name), kinds=", ".join(kinds))
        found.refuse(f"{written}.kind", message, path)
        return _MISSING
    rest = {key: item for key, item in value.items() if key != "kind"}
    values = _values(kinds[name], rest, written, path, found)
    return _MISSING if values is None else kinds[name](**values)


def _changes(value: Any, written: str, path: str, found: Findings) -> Any:
    """Return the changes of a pose; the paths themselves are checked against the drive later."""
    if not isinstance(value, Mapping):
        found.refuse(written, _("must be a table of paths, not {given}").format(given=_shown(value)), path)
        return _MISSING
    if not all(math.isfinite(x) for item in value.values() for x in numbers_in(item)):
        found.refuse(written, _("has a value that is not finite"), path)
        return _MISSING
    return tuple((str(key), scaled(item, 1.0)) for key, item in value.items())


def _holds_tables(part: Any) -> bool:
    return part in KINDS or is_dataclass(part)


def _shown(value: Any) -> str:
    """Return a value as the user wrote it, shortened."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Mapping):
        return _("a table")
    if isinstance(value, list):
        return _("a list")
    text = repr(value)
    return text if len(text) <= 40 else text[:37] + "..."


def _doubted(cls: type, key: str, path: str) -> str:
    """Return the path of the field that an unknown key most likely meant, so that it is not also reported missing."""
    for name in sorted(fields_of(cls), key=len, reverse=True):
        one = fields_of(cls)[name]
        if key == name or key == one.key.mirror or (key.startswith(f"{name}_") and one.key.dimension is not None):
            return f"{path}.{name}" if path else name
    near = nearest(key, spellings_of(cls))
    name = spellings_of(cls)[near][0] if near else ""
    return (f"{path}.{name}" if path else name) if name else ""


def _unknown(cls: type, key: str) -> str:
    """Return what to say of a key that a table does not know."""
    known = fields_of(cls)
    for name, one in known.items():
        for word in (name, one.key.mirror):
            if not word or one.key.dimension is None:
                continue
            units = DIMENSIONS[one.key.dimension]
            choices = _(" or ").join(f"{word}_{unit}" for unit in units)
            if key == word:
                return _("needs a unit: write {choices}").format(choices=choices)
            end = key.removeprefix(f"{word}_")
            if end != key and any(end in others for others in DIMENSIONS.values()):
                return _("{unit} is no unit of this field: write {choices}").format(unit=label(end), choices=choices)
    for name in known:
        end = key.removeprefix(f"{name}_")
        if known[name].key.dimension is None and end != key and any(end in units for units in DIMENSIONS.values()):
            return _("takes no unit: write {name}").format(name=name)
    near = nearest(key, spellings_of(cls))
    if near:
        return _("unknown key; the nearest known one is {near}").format(near=near)
    owners = [part for part in PARTS if part is not cls and key in spellings_of(part)]
    if owners:
        return _("unknown here; it belongs to {owners}").format(owners=_(" or ").join(_table_name(o) for o in owners))
    listed = ", ".join(one.spelling for one in known.values())
    return _("unknown key; known here: {known}").format(known=listed)


def _table_name(cls: type) -> str:
    """Return how a file names the table of a class."""
    if issubclass(cls, Joint):
        return "[[joints]]"
    if issubclass(cls, Movement):
        return f"[[movements]] kind = {cls.kind!r}"
    if cls is Drive:
        return _("the head of the file")
    for owner in (Drive, Shaft):
        for one in fields_of(owner).values():
            if one.type is cls:
                return f"[{one.name}]" if owner is Drive else f"[[shafts]] {one.name}"
            if cls in get_args(one.type):
                return f"[[{one.name}]]"
    return cls.__name__.lower()
