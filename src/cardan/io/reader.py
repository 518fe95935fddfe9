"""From the tree of a drive file to a `Drive`, of a mechanism file to a `Mechanism`."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from cardan.drive.drive import Drive
from cardan.drive.duty import History
from cardan.drive.fields.duty_validity import bound_problems
from cardan.drive.fields.keys import KINDS, NAMED, spelled
from cardan.drive.fields.validity import MAX_JOINTS
from cardan.drive.machine import TorqueHistory
from cardan.drive.movement import Table
from cardan.drive.shaft import Shaft
from cardan.errors import InputError, Problem, check, refuse
from cardan.files import Enclosed
from cardan.reading.fields import numbers_in, scaled
from cardan.reading.scalar import as_given
from cardan.reading.tree import Form, Place, read_table
from cardan.texts import _

from .hints import meant, unknown
from .shifts import read_shifts, read_torques


def drive_from_tree(tree: Mapping[str, Any], *, folder: Path | Enclosed = Path(".")) -> Drive:
    """Return the drive a file describes.

    tree: the file as nested tables; folder: where the CSV files that it names are looked for.
    """
    joints = tree.get("joints")
    if isinstance(joints, list) and len(joints) > MAX_JOINTS:
        raise refuse("joints", _("{n} joints given; the limit is {limit}").format(n=len(joints), limit=MAX_JOINTS))
    drive: Drive = read_as(Drive, tree, folder=folder)
    check(bound_problems(drive))
    return drive


def read_as(root: Any, tree: Mapping[str, Any], *, folder: Path | Enclosed = Path(".")) -> Any:
    """Return the drive, or other thing of a class with the keys of a file, that a tree describes.

    tree: the file as nested tables; folder: where the CSV files that it names are looked for.
    """
    form = Form(
        spelled=spelled,
        kinds=KINDS,
        named=NAMED,
        unknown=lambda cls, key: (unknown(cls, key), meant(cls, key)),
        own={"set": _changes},
        finished=partial(_with_rows, folder),
        index=_index,
    )
    thing, problems = read_table(root, {key: value for key, value in tree.items() if key != "format"}, form)
    check([*_format(root, tree), *problems])
    return thing


def _format(root: Any, tree: Mapping[str, Any]) -> list[Problem]:
    given = tree.get("format")
    if given == root.format and not isinstance(given, bool):
        return []
    text = _("{given} is not known; this version reads format = {format}")
    if "format" not in tree:
        text = _("missing; write format = {format} at the top")
    return [Problem("format", text.format(given=as_given(given), format=root.format))]


def _index(cls: Any, table: Any, k: int) -> int:
    """Return the index of a table in paths: of a shaft its number less one, wherever it stands in the file."""
    number = table.get("number") if cls is Shaft and isinstance(table, Mapping) else None
    return number - 1 if isinstance(number, int) and not isinstance(number, bool) and number >= 1 else k


def _with_rows(folder: Path | Enclosed, thing: Any, here: Place) -> Any:
    """Return a movement, a torque or a history with the rows of its CSV file, all else as it is."""
    if not isinstance(thing, Table | TorqueHistory | History) or f"{here.path}.file" in here.found.doubtful:
        return thing
    try:
        if isinstance(thing, Table):
            times, shifts = read_shifts(folder / thing.file)
            return replace(thing, times=times, shifts=shifts)
        times, torques = read_torques(folder / thing.file)
        return replace(thing, times=times, torques=torques)
    except InputError as error:
        file = here.key("file")
        at = file if file.path in here.found.spelled else Place(here.found, here.written, file.path)
        for problem in error.problems:
            at.refuse(f"{problem.field} {problem.message}")
        return thing


def _changes(value: Any, here: Place) -> Any:
    """Return the changes of a pose; paths and values are checked against the drive later."""
    if not isinstance(value, Mapping):
        message = _('must be a table of paths, {{ "joints[0].centre_mm" = [0, 0, 0] }}, not {given}')
        here.refuse(message.format(given=as_given(value)))
        return ()
    changes = []
    for key, item in value.items():
        if isinstance(item, Mapping):
            message = _("{key}: write the path in quotes, {example} = value")
            here.refuse(message.format(key=key, example='"' + _flattened(str(key), item) + '"'))
        elif not all(math.isfinite(x) for x in numbers_in(item)):
            Place(here.found, f"{here.written}: {key}", here.path).refuse(_("has a value that is not finite"))
        else:
            changes.append((str(key), scaled(item, 1.0)))
    return tuple(changes)


def _flattened(key: str, table: Mapping[str, Any]) -> str:
    """Return what an unquoted path of a pose was meant to be: its steps joined by dots."""
    for inner, item in table.items():
        return _flattened(f"{key}.{inner}", item) if isinstance(item, Mapping) else f"{key}.{inner}"
    return key
