"""From the tree of a drive file to a `Drive`: every problem of the file at once, each on the path the user wrote."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, is_dataclass, replace
from pathlib import Path
from typing import Any, get_args, get_origin

from cardan.drive.drive import Drive
from cardan.drive.duty import History
from cardan.drive.fields.duty_validity import bound_problems
from cardan.drive.fields.keys import (
    KINDS,
    NAMED,
    WORD_OR_FLAG,
    Field,
    fields_of,
    numbers_in,
    scaled,
    spelled,
    spellings_of,
)
from cardan.drive.fields.ranges import in_range, out_of_range
from cardan.drive.fields.validity import MAX_JOINTS
from cardan.drive.machine import TorqueHistory
from cardan.drive.movement import Table
from cardan.drive.shaft import Shaft
from cardan.errors import InputError, Problem, check
from cardan.files import Enclosed
from cardan.texts import _
from cardan.units import nearest

from .hints import meant, unknown
from .shifts import read_shifts, read_torques

_MISSING = object()


@dataclass(slots=True)
class Findings:
    """What a reading brings to light.

    A field that was refused gets a placeholder that keeps the drive in its form, so that the rest of the file can
    still be judged as a drive; what is then said about the placeholder is left out.

    Attributes
    ----------
    folder : Path or Enclosed
        Where files named by the drive file are.
    problems : list of Problem
        With paths as written in the file.
    spelled : dict
        Path in Python -> path as written.
    doubtful : set of str
        Paths in Python of fields that were refused.
    root : type
        What the file describes.
    """

    folder: Path | Enclosed
    problems: list[Problem] = field(default_factory=list)
    spelled: dict[str, str] = field(default_factory=dict)
    doubtful: set[str] = field(default_factory=set)
    root: Any = Drive

    def refuse(self, written: str, message: str, path: str = "") -> None:
        """Note a problem at the path as written, and that the field at ``path`` is not to be trusted."""
        self.problems.append(Problem(written, message))
        if path:
            self.doubtful.add(path)

    def follow(self, problem: Problem) -> None:
        """Note a problem of the drive as a whole, unless it only follows from another one."""
        path = problem.field
        if not any(_within(path, other) or _within(other, path) for other in self.doubtful):
            self.problems.append(Problem(self.as_written(path), problem.message))

    def as_written(self, path: str) -> str:
        """Return the path of a field as the file spells it, or as we would."""
        whole, rest = path, ""
        while whole:
            if whole in self.spelled:
                return self.spelled[whole] + rest
            if not whole.endswith("]"):
                break
            whole = whole[: whole.rindex("[")]
            rest = path[len(whole) :]
        return spelled(path, self.root)


def _within(path: str, other: str) -> bool:
    """Tell whether a path is another one or leads further into it."""
    return path == other or (path.startswith(other) and path[len(other)] in ".[")


def drive_from_tree(tree: Mapping[str, Any], *, folder: Path | Enclosed = Path(".")) -> Drive:
    """Return the drive a file describes.

    Parameters
    ----------
    tree : mapping
        The file as nested tables.
    folder : Path or Enclosed
        Where the CSV files that it names are looked for.

    Raises
    ------
    InputError
        Everything that is wrong with it.
    """
    _too_long(tree)
    drive: Drive = read_as(Drive, tree, folder=folder)
    check(bound_problems(drive))
    return drive


def read_as(root: Any, tree: Mapping[str, Any], *, folder: Path | Enclosed = Path(".")) -> Any:
    """Return the drive, or other thing of a class with the keys of a file, that a tree describes.

    Parameters
    ----------
    root : type
        Class of what the file describes.
    tree : mapping
        The file as nested tables.
    folder : Path or Enclosed
        Where the CSV files that it names are looked for.

    Raises
    ------
    InputError
        Everything that is wrong with it.
    """
    found = Findings(folder, root=root)
    _format(tree, found)
    values = _values(root, {key: value for key, value in tree.items() if key != "format"}, "", "", found)
    thing = None
    try:
        thing = root(**values)
    except InputError as error:
        for problem in error.problems:
            found.follow(problem)
        if not found.problems:  # pragma: no cover - a problem of a placeholder has its own in the file
            raise
    check(found.problems)
    return thing


def _format(tree: Mapping[str, Any], found: Findings) -> None:
    given = tree.get("format", _MISSING)
    if given is _MISSING:
        text = _("missing; write format = {format} at the top").format(format=found.root.format)
        found.refuse("format", text)
    elif isinstance(given, bool) or given != found.root.format:
        message = _("{given} is not known; this version reads format = {format}")
        found.refuse("format", message.format(given=_shown(given), format=found.root.format))


def _too_long(tree: Mapping[str, Any]) -> None:
    joints = tree.get("joints")
    if isinstance(joints, list) and len(joints) > MAX_JOINTS:
        message = _("{n} joints given; the limit is {limit}").format(n=len(joints), limit=MAX_JOINTS)
        raise InputError([Problem("joints", message)])


def _values(cls: type, table: Mapping[str, Any], written: str, path: str, found: Findings) -> dict[str, Any]:
    """Return the arguments of a class from a table, placeholders where the table has nothing fit."""
    known = spellings_of(cls)
    used: dict[str, str] = {}
    values: dict[str, Any] = {}
    for key, value in table.items():
        here = f"{written}.{key}" if written else str(key)
        if key not in known:
            _note_unknown(cls, str(key), here, path, found)
            continue
        name, factor = known[key]
        one = fields_of(cls)[name]
        there = f"{path}.{name}" if path else name
        if name in used:
            found.refuse(here, _("{other} gives the same already").format(other=used[name]), there)
            continue
        used[name] = key
        found.spelled[there] = here
        values[name] = _value(one, one.type, value, key, factor, here, there, found)
    for name, one in fields_of(cls).items():
        there = f"{path}.{name}" if path else name
        if name in used:
            continue
        if there in found.doubtful:
            values[name] = _blank(one.type)
        elif one.required:
            here = f"{written}.{one.spelling}" if written else one.spelling
            found.refuse(here, _("missing: {doc}").format(doc=_(one.key.doc)), there)
            values[name] = _blank(one.type)
    return values


def _note_unknown(cls: type, key: str, here: str, path: str, found: Findings) -> None:
    name = meant(cls, key)
    found.refuse(here, unknown(cls, key), (f"{path}.{name}" if path else name) if name else "")


def _value(one: Field, kind: Any, value: Any, key: str, factor: float, written: str, path: str, found: Findings) -> Any:
    """Return a value in SI as the field's type wants it, or a placeholder after noting what is wrong."""
    if one.name == "set" and get_origin(kind) is tuple:
        return _changes(value, written, path, found)
    if get_origin(kind) is tuple:
        return _list(one, kind, value, key, factor, written, path, found)
    if kind in KINDS:
        return _kind(kind, value, written, path, found)
    if is_dataclass(kind):
        if kind in NAMED and isinstance(value, str):
            thing = kind(**{NAMED[kind]: value})
            return _with_rows(thing, written, path, found) if kind is History else thing
        if not _is_table(value, written, path, found):
            return _blank(kind)
        thing = kind(**_values(kind, value, written, path, found))  # type: ignore[arg-type, operator]
        return _with_rows(thing, f"{written}.file", path, found) if kind is History else thing
    return _scalar(one, kind, value, key, factor, written, path, found)


def _scalar(
    one: Field, kind: Any, value: Any, key: str, factor: float, written: str, path: str, found: Findings
) -> Any:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    fits = {
        float: number,
        int: number and isinstance(value, int),
        bool: isinstance(value, bool),
        WORD_OR_FLAG: isinstance(value, bool | str),
    }.get(kind, isinstance(value, str))
    wanted = {
        float: _("a number"),
        int: _("a whole number"),
        bool: _("true or false"),
        WORD_OR_FLAG: _("true, false or a word"),
    }.get(kind, _("a text"))
    message = ""
    if not fits:
        message = _("must be {wanted}, not {given}").format(wanted=wanted, given=_shown(value))
    elif kind is float or kind is int:
        try:
            result = float(value) * factor + 0.0
        except OverflowError:
            result = math.inf
        if in_range(one.key, result):
            return value if kind is int else result
        message = out_of_range(_shown(value), one.key, result, one.unit(key), mirrored=factor < 0)
    elif kind is str and not value.isprintable() and any("\ud800" <= c <= "\udfff" for c in value):
        message = _("holds half a character (a lone surrogate), which no file can keep")
    elif one.key.choices and isinstance(value, str) and value not in one.key.choices:
        message = _("{value} is none of {choices}").format(value=_shown(value), choices=", ".join(one.key.choices))
    if not message:
        return value
    found.refuse(written, message, path)
    return _blank(kind)


def _list(one: Field, kind: Any, value: Any, key: str, factor: float, written: str, path: str, found: Findings) -> Any:
    parts = get_args(kind)
    tables = _holds_tables(parts[0])
    if not isinstance(value, list):
        wanted = _("tables, each under [[{key}]]").format(key=key) if tables else _("a list")
        found.refuse(written, _("must be {wanted}, not {given}").format(wanted=wanted, given=_shown(value)), path)
        return _blank(kind)
    endless = len(parts) == 2 and parts[1] is Ellipsis
    if not endless and len(value) != len(parts):
        message = _("has {given} entries; {wanted} are needed").format(given=len(value), wanted=len(parts))
        found.refuse(written, message, path)
        return _blank(kind)
    items = []
    for k, item in enumerate(value):
        part = parts[0] if endless else parts[k]
        place = f"[{_shaft_index(item, k)}]" if part is Shaft else f"[{k}]"
        read = _value(one, part, item, key, factor, written + place, path + place, found)
        if part is not Shaft or f"{path}{place}.number" not in found.doubtful:
            items.append(read)
    return tuple(items)


def _shaft_index(item: Any, k: int) -> int:
    """Return the index of a shaft in paths: its number less one, wherever it stands in the file."""
    number = item.get("number") if isinstance(item, Mapping) else None
    return number - 1 if isinstance(number, int) and not isinstance(number, bool) and number >= 1 else k


def _kind(base: Any, value: Any, written: str, path: str, found: Findings) -> Any:
    """Return a joint, movement or torque of the class that its ``kind`` names; of the base class if it names none."""
    kinds, default = KINDS[base]
    if not _is_table(value, written, path, found):
        return _blank(base)
    name = value.get("kind", default)
    rest = {key: item for key, item in value.items() if key != "kind"}
    if isinstance(name, str) and name in kinds:
        thing = kinds[name](**_values(kinds[name], rest, written, path, found))
        held = isinstance(thing, Table | TorqueHistory)
        return _with_rows(thing, f"{written}.file", path, found) if held else thing
    if name is None:
        message = _("missing; one of {kinds}").format(kinds=", ".join(kinds))
    else:
        near = nearest(name, kinds) if isinstance(name, str) else None
        message = _("{given} is none of {kinds}").format(given=_shown(name), kinds=", ".join(kinds))
        message += _("; the nearest is {near}").format(near=near) if near else ""
    found.refuse(f"{written}.kind", message, f"{path}.kind")
    owned = {key: item for key, item in rest.items() if key in spellings_of(base)}
    for key in rest:
        if not any(key in spellings_of(kind) for kind in (base, *kinds.values())):
            _note_unknown(base, str(key), f"{written}.{key}", path, found)
    return base(**_values(base, owned, written, path, found))


def _with_rows(thing: Any, written: str, path: str, found: Findings) -> Any:
    """Return a movement, a torque or a history with the rows of its CSV file, whose key is ``written``."""
    if f"{path}.file" in found.doubtful:
        return thing
    try:
        if isinstance(thing, TorqueHistory | History):
            times, torques = read_torques(found.folder / thing.file)
            return replace(thing, times=times, torques=torques)
        times, shifts = read_shifts(found.folder / thing.file)
        return replace(thing, times=times, shifts=shifts)
    except InputError as error:
        for problem in error.problems:
            found.refuse(written, f"{problem.field} {problem.message}", f"{path}.file")
        return thing


def _changes(value: Any, written: str, path: str, found: Findings) -> Any:
    """Return the changes of a pose; paths and values are checked against the drive later."""
    if not isinstance(value, Mapping):
        message = _('must be a table of paths, {{ "joints[0].centre_mm" = [0, 0, 0] }}, not {given}')
        found.refuse(written, message.format(given=_shown(value)), path)
        return ()
    changes = []
    for key, item in value.items():
        if isinstance(item, Mapping):
            message = _("{key}: write the path in quotes, {example} = value")
            example = '"' + _flattened(str(key), item) + '"'
            found.refuse(written, message.format(key=key, example=example), path)
        elif not all(math.isfinite(x) for x in numbers_in(item)):
            found.refuse(f"{written}: {key}", _("has a value that is not finite"), path)
        else:
            changes.append((str(key), scaled(item, 1.0)))
    return tuple(changes)


def _flattened(key: str, table: Mapping[str, Any]) -> str:
    """Return what an unquoted path of a pose was meant to be: its steps joined by dots."""
    for inner, item in table.items():
        return _flattened(f"{key}.{inner}", item) if isinstance(item, Mapping) else f"{key}.{inner}"
    return key


def _blank(kind: Any) -> Any:
    """Return a placeholder that keeps the shape of a type: nan for numbers, blanks in tables."""
    if get_origin(kind) is tuple:
        parts = get_args(kind)
        return () if parts[-1] is Ellipsis else tuple(_blank(part) for part in parts)
    if kind in KINDS or is_dataclass(kind):
        return kind(**{name: _blank(one.type) for name, one in fields_of(kind).items() if one.required})
    return {float: math.nan, int: 1, bool: False, WORD_OR_FLAG: False}.get(kind, "")


def _is_table(value: Any, written: str, path: str, found: Findings) -> bool:
    if isinstance(value, Mapping):
        return True
    found.refuse(written, _("must be a table, not {given}").format(given=_shown(value)), path)
    return False


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
    if value is None:
        return "null"
    text = repr(value) if isinstance(value, str | int | float) else str(value)
    return text if len(text) <= 40 else text[:37] + "..."
