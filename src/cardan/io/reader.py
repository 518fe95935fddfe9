"""From the tree of a drive file to a `Drive`, of a mechanism file to a `Mechanism`."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import is_dataclass, replace
from difflib import SequenceMatcher
from functools import cache, partial
from pathlib import Path
from typing import Any, get_args

from cardan.drive.accuracy import Cost, Error, Tolerance
from cardan.drive.drive import Drive
from cardan.drive.duty import History
from cardan.drive.fields.keys import KINDS, NAMED, spelled
from cardan.drive.fields.validity import MAX_JOINTS, bound_problems
from cardan.drive.machine import TorqueHistory
from cardan.drive.movement import Table
from cardan.drive.shaft import Shaft
from cardan.errors import InputError, Problem, check, refuse
from cardan.files import Enclosed
from cardan.mechanism.mechanism import Mechanism
from cardan.reading.fields import fields_of, numbers_in, scaled, spellings_of
from cardan.reading.scalar import as_given
from cardan.reading.tree import Form, Place, read_table
from cardan.texts import _
from cardan.units import DIMENSIONS, label, nearest

from .shifts import read_shifts, read_torques
from .shipped import examples_folder, mechanism_names
from .text import describes_mechanism, parsed, text_of

HELPED = 100  # unknown keys of a file that are told the nearest known one, which takes a millisecond each


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
    helped = iter(range(HELPED))
    form = Form(
        spelled=spelled,
        kinds=KINDS,
        named=NAMED,
        unknown=lambda cls, key: (
            (_("unknown key"), "") if next(helped, None) is None else (unknown(cls, key), meant(cls, key))
        ),
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
    """Return a movement, a torque, a history or a joint with what its file holds, all else as it is."""
    drawn_by = getattr(thing, "with_drawing", None)
    if (
        not (isinstance(thing, Table | TorqueHistory | History) or (drawn_by and thing.file))
        or f"{here.path}.file" in here.found.doubtful
    ):
        return thing
    try:
        if drawn_by is not None:
            return drawn_by(mechanism_from(folder, thing.file))
        if isinstance(thing, Table):
            times, shifts = read_shifts(folder / thing.file)
            return replace(thing, times=times, shifts=shifts)
        times, torques, speeds = read_torques(folder / thing.file)
        return replace(thing, times=times, torques=torques, speeds=speeds)
    except InputError as error:
        file = here.key("file")
        at = file if file.path in here.found.spelled else Place(here.found, here.written, file.path)
        for problem in error.problems:
            at.refuse(f"{problem.field} {problem.message}")
        return thing


def mechanism_from(folder: Path | Enclosed, name: str) -> Mechanism:
    """Return the mechanism that a file of a folder describes, or a shipped one by its bare name."""
    where = examples_folder() / "mechanisms" / f"{name}.toml" if name in mechanism_names() else folder / name
    text, form = text_of(where)
    return mechanism_of(text, form=form, name=str(where))


def mechanism_of(text: str, *, form: str, name: str) -> Mechanism:
    """Return the mechanism that a text describes."""
    tree = parsed(text, form, name)
    if not describes_mechanism(tree):
        raise refuse(name, _("describes no mechanism: it names neither a frame nor the links of its joints"))
    mechanism: Mechanism = read_as(Mechanism, tree)
    return mechanism


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


# What to say of a key that a table does not know: the key that was meant, or where it belongs.

OTHER_WORDS = {
    "alpha": "joint_angle", "joint_angle_angle": "joint_angle", "misalignment": "joint_angle",
    "deflection": "joint_angle", "beta": "plane_twist", "twist": "plane_twist", "gamma": "yoke_angle",
    "phasing": "yoke_angle", "clocking": "yoke_angle", "psi": "start_phase", "position": "centre", "center": "centre",
    "rpm": "speed", "omega": "speed", "joint": "joints", "shaft": "shafts",
}  # fmt: skip
"""Words of other texts for our fields."""

CLOSE = 0.8  # two keys so alike are taken for the same before other tables are looked at


def meant(cls: type, key: str) -> str:
    """Return the name of the field that an unknown key most likely meant, or nothing."""
    split = _split(cls, key)
    if split:
        return split[0]
    other = _other_word(cls, key)
    if other:
        return spellings_of(cls)[other][0]
    if _owners(cls, key):
        return ""
    near = _near(cls, key)
    return spellings_of(cls)[near][0] if near else ""


def unknown(cls: type, key: str) -> str:
    """Return what to say of a key that the table of a class does not know."""
    split = _split(cls, key)
    if split:
        name, word, unit = split
        dimension = fields_of(cls)[name].key.dimension
        if dimension is None:
            return _("takes no unit: write {name}").format(name=word)
        choices = _(" or ").join(f"{word}_{unit}" for unit in DIMENSIONS[dimension])
        if not unit:
            return _("needs a unit: write {choices}").format(choices=choices)
        return _("{unit} is not a unit of this field: write {choices}").format(unit=label(unit), choices=choices)
    other = _other_word(cls, key)
    near = other or _near(cls, key, cutoff=CLOSE)
    if _of_a_kind(cls) and not near:
        return _listed(cls)
    owners = [] if other else _owners(cls, key)
    if owners:
        text = _("unknown here; it belongs to {owners}").format(owners=_(" or ").join(owners))
        return text + (_("; the nearest known here is {near}").format(near=near) if near else "")
    near = near or _near(cls, key)
    if near:
        return _("unknown key; the nearest known one is {near}").format(near=near)
    return _listed(cls)


def _listed(cls: type) -> str:
    """Return that a key is unknown, with all that are known."""
    known = ", ".join(one.spelling for one in fields_of(cls).values())
    return _("unknown key; known here: {known}").format(known=known)


def _of_a_kind(cls: type) -> bool:
    """Tell whether a table is one of errors, tolerances or costs that the kind of a joint has of its own."""
    return cls.__base__ in (Error, Tolerance, Cost)


def _split(cls: type, key: str) -> tuple[str, str, str] | None:
    """Return field, word and unit if a key is a field of the class with a wrong unit or none."""
    words = {word: name for name, one in fields_of(cls).items() for word in (name, one.key.mirror) if word}
    if key in words:
        return words[key], key, ""
    for word in sorted(words, key=len, reverse=True):
        unit = key.removeprefix(f"{word}_")
        if unit != key and any(unit in units for units in DIMENSIONS.values()):
            return words[word], word, unit
    return None


def _other_word(cls: type, key: str) -> str:
    """Return our key for one that uses a word of other texts, in the same unit where it has one."""
    for word, name in OTHER_WORDS.items():
        if name in fields_of(cls) and (key == word or key.startswith(f"{word}_")):
            same = name + key[len(word) :]
            return same if same in spellings_of(cls) else fields_of(cls)[name].spelling
    return ""


def _near(cls: type, key: str, cutoff: float = 0.0) -> str:
    """Return the known key most like an unknown one; letter case does not count."""
    lower = {known.lower(): known for known in spellings_of(cls)}
    near = nearest(key.lower(), lower)
    if near is None or SequenceMatcher(None, key.lower(), near).ratio() < cutoff:
        return ""
    return lower[near]


def _owners(cls: type, key: str) -> list[str]:
    """Return the tables that know a key, as a file names them: first those of the same sort."""
    if _of_a_kind(cls) or cls not in {other for _title, other in tables()}:
        return []  # what a kind can have, or of a file that is no drive
    return [title for title, other in tables() if other is not cls and not _of_a_kind(other) and _knows(other, key)]


def _knows(cls: type, key: str) -> bool:
    return key in spellings_of(cls) or key in fields_of(cls)


def tables() -> tuple[tuple[str, type], ...]:
    """Return every table of a drive file: how the file names it, and its class."""
    return _all_tables(_("the head of the file, above its first table"))


@cache
def _all_tables(head: str) -> tuple[tuple[str, type], ...]:
    return ((head, Drive), *list(_tables(Drive, ""))[1:])


def _tables(cls: Any, title: str) -> Iterator[tuple[str, Any]]:
    yield title, cls
    for one in fields_of(cls).values():
        inner = next((part for part in (one.type, *get_args(one.type)) if is_dataclass(part)), None)
        if inner is None:
            continue
        many = bool(get_args(one.type))
        name = f"{title} {one.name}" if title else f"[[{one.name}]]" if many else f"[{one.name}]"
        if inner not in KINDS:
            yield from _tables(inner, name)
            continue
        kinds, default = KINDS[inner]
        for kind, variant in kinds.items():
            alone = kind == default and len(kinds) == 1
            yield from _tables(variant, name if alone else f"{name} kind = {kind!r}")
