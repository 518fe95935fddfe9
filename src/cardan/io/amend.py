"""Changing a drive file that need not be right: one key at a time, the rest left as it is written.

`cardan.io.edit` changes values of a sound drive and refuses what would break it. Whoever works on a file for a while
passes through states that are not sound; here only the text must be TOML and the path one of a drive file.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, MutableMapping
from contextlib import contextmanager
from typing import Any, TypeAlias, get_args, get_origin

import tomlkit

from cardan.drive.drive import Drive
from cardan.drive.fields.keys import KINDS, NAMED
from cardan.errors import refuse
from cardan.reading.fields import fields_of, spellings_of
from cardan.reading.limits import check_text
from cardan.texts import _

from .edit import plain, removed, shaft_table

Step: TypeAlias = str | int

_WORD = re.compile(r"([A-Za-z_][A-Za-z0-9_]*)((?:\[\d+\])*)$")


def amend(text: str, values: Mapping[str, Any]) -> str:
    """Return a drive file with other values, whether or not it describes a drive.

    values: path of a key -> what to write there, in the unit of the key; None takes the key out, or the whole table
    that the path leads to. ``shafts[1]`` is shaft number 2. Other spellings of the same field go.
    Returns: the new text; comments and layout of everything else stay.
    Raises InputError: the text is no TOML, or a path is none of a drive file.
    """
    document = parsed(text)
    for path, value in values.items():
        with tables_only(path):
            _amended(document, path, value)
    return tomlkit.dumps(document)


def _amended(document: Any, path: str, value: Any) -> None:
    *steps, last = steps_of(path)
    if value is None:
        _take(document, (*steps, last))
        return
    if not isinstance(last, str):
        raise refuse(path, _("leads to a place in a list, not to a key"))
    known = spellings_of(kind_at(document, steps))
    if last not in known and last != "kind":
        raise refuse(path, _("is not a key of a drive file"))
    _put(document, steps, last, known, value)


def insert(text: str, path: str, values: Mapping[str, Any]) -> str:
    """Return a drive file with a further table in a list of tables.

    path: where it is to stand, ``supports[2]``; the tables from there on move back.
    """
    document = parsed(text)
    *steps, name, place = steps_of(path)
    with tables_only(path):
        holder = held_at(document, steps)
        if name not in holder:
            inline = isinstance(holder, tomlkit.items.InlineTable | tomlkit.items.Array)
            if holder is document and len(document):
                document.add(tomlkit.nl())
            holder[name] = tomlkit.array() if inline else tomlkit.aot()
        tables = holder[name]
        new: Any = tomlkit.inline_table() if isinstance(tables, tomlkit.items.Array) else tomlkit.table()
        for key, value in values.items():
            new[key] = plain(value)
        tables.insert(min(int(place), len(tables)), new)
    return tomlkit.dumps(document)


@contextmanager
def tables_only(path: str) -> Iterator[None]:
    """Refuse a change that finds something else where a drive file has tables, or nothing."""
    try:
        yield
    except (AttributeError, IndexError, KeyError, TypeError):
        raise refuse(path, _("is not a table of a drive file")) from None


def parsed(text: str) -> Any:
    """Return the document that a text is."""
    check_text(text, "file")
    try:
        return tomlkit.parse(text)
    except (ValueError, RecursionError) as error:  # of the parser, of Python for thousands of digits, too deep
        raise refuse("file", _("is not TOML: {why}").format(why=error)) from None


def steps_of(path: str) -> tuple[Step, ...]:
    """Return the keys and places that a path goes through."""
    steps: list[Step] = []
    for word in path.split("."):
        match = _WORD.fullmatch(word)
        if match is None:
            raise refuse(path, _("{word} is not a step of a path").format(word=repr(word)))
        steps += [match[1], *(int(k) for k in re.findall(r"\d+", match[2]))]
    return tuple(steps)


def kind_at(document: Any, steps: tuple[Step, ...] | list[Step]) -> Any:
    """Return the class of the drive model that the table at some steps describes."""
    cls: Any = Drive
    for k, step in enumerate(steps):
        if isinstance(step, int):
            continue
        known = spellings_of(cls)
        if step not in known:
            raise refuse(".".join(str(one) for one in steps), _("is not a table of a drive file"))
        cls = fields_of(cls)[known[step][0]].type
        if get_origin(cls) is tuple:
            cls = get_args(cls)[0]
        if cls in KINDS:
            kinds, default = KINDS[cls]
            given = _value_at(document, [*steps[: k + 1], *steps[k + 1 : k + 2]], "kind", default)
            cls = kinds.get(given, cls) if isinstance(given, str) else cls
    return cls


def held_at(document: Any, steps: tuple[Step, ...] | list[Step]) -> Any:
    """Return the table that steps lead to, made where the file does not have it yet."""
    table = document
    for k, step in enumerate(steps):
        if isinstance(step, int):
            table = shaft_table(table, step + 1) if steps[k - 1] == "shafts" else table[step]
        elif step in table and not isinstance(table[step], str):
            table = table[step]
        else:
            follows = steps[k + 1 : k + 2]
            inline = isinstance(table, tomlkit.items.InlineTable) or isinstance(steps[k - 1] if k else "", int)
            name = table.get(step)
            new: Any = tomlkit.aot() if follows and isinstance(follows[0], int) else None
            new = new if new is not None else tomlkit.inline_table() if inline else tomlkit.table()
            if isinstance(name, str):
                new[_named_key(document, steps[: k + 1])] = name
            if table is document and not inline and len(document):
                document.add(tomlkit.nl())
            table[step] = new
            table = table[step]
    return table


def _named_key(document: Any, steps: tuple[Step, ...] | list[Step]) -> str:
    """Return the key for which a name alone may stand in place of a table."""
    return NAMED[kind_at(document, steps)]


def _value_at(document: Any, steps: list[Step], key: str, default: Any) -> Any:
    """Return a value of a file without making anything."""
    here = document
    for k, step in enumerate(steps):
        if isinstance(step, int) and steps[k - 1] == "shafts":
            here = next((one for one in here if one.get("number") == step + 1), {})
        elif isinstance(step, int):
            here = here[step] if isinstance(here, list) and step < len(here) else {}
        else:
            here = here.get(step, {}) if isinstance(here, Mapping) else {}
    return here.get(key, default) if isinstance(here, Mapping) else default


def _put(document: Any, steps: list[Step], key: str, known: Mapping[str, tuple[str, float]], value: Any) -> None:
    table = held_at(document, steps)
    others = [one for one in known if key in known and known[one][0] == known[key][0] and one != key and one in table]
    comment = "".join(removed(table, one) for one in others)
    kept = comment or (str(table[key].trivia.comment).lstrip("# ") if key in table else "")
    table[key] = dict(value) if isinstance(value, Mapping) else plain(value)
    if kept and hasattr(table[key], "comment"):
        table[key].comment(kept)


def _take(document: Any, steps: tuple[Step, ...]) -> None:
    """Take a key, a table or an entry of a list out; nothing where it is not there."""
    here: Any = document
    for k in range(len(steps) - 1):
        here = _inner(here, steps, k)
        if here is None:
            return
    last = steps[-1]
    if isinstance(last, int):
        if steps[-2] == "shafts":
            places = [k for k, one in enumerate(here) if one.get("number") == last + 1]
        else:
            places = [last] if last < len(here) else []
        for place in places:
            del here[place]
        if not len(here):
            _take(document, steps[:-1])
    elif last in here:
        del here[last]


def _inner(here: Any, steps: tuple[Step, ...], k: int) -> Any:
    step = steps[k]
    if isinstance(step, str):
        return here.get(step)
    if k and steps[k - 1] == "shafts":
        return next((one for one in here if one.get("number") == step + 1), None)
    return here[step] if step < len(here) else None


# Adding, removing and moving joints in a drive file: what follows in the chain keeps its numbers right.

_PLACE = re.compile(r"\b(joints|shafts)\[(\d+)\]")

Moved = Callable[[int], int | None]  # index before -> index behind; None for what goes


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
    """Return a drive file without a joint; the shaft behind it goes with it."""
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
