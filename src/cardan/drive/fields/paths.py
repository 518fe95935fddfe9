"""Paths to the fields of a drive, with units: ``joints[1].centre_mm[2]``, ``shafts[1].yoke_angle_deg``.

Indices count from 0; ``shafts[1]`` is shaft number 2. The same paths serve poses, the command line and sweeps.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from copy import copy
from dataclasses import dataclass, is_dataclass, replace
from typing import Any, TypeVar, get_args, get_origin

from cardan.drive.described import Described
from cardan.errors import InputError, Problem, check
from cardan.reading.fields import Field, Keyed, fields_of, in_unit, spellings_of
from cardan.reading.scalar import SCALARS, Wrong, as_given, scalar
from cardan.texts import _
from cardan.units import DIMENSIONS, nearest

from .keys import spelled

D = TypeVar("D", bound=Keyed)  # a drive, checked or not, or a mechanism
P = TypeVar("P", bound=Described)

_STEP = re.compile(r"([A-Za-z_][A-Za-z0-9_]*)((?:\[\d+\])*)$")


@dataclass(frozen=True, slots=True)
class Place:
    """Where a path leads."""

    steps: tuple[str | int, ...]  # field names and indices from the drive to the value
    field: Field  # the field that holds it
    factor: float  # from the path's unit to SI
    inside: int  # how many of the last steps lead into the field's own numbers
    spelling: str  # how the path spells the field


def place(drive: Keyed, path: str) -> Place:
    """Return where a path leads in a drive or a mechanism."""
    here: Any = drive
    steps: list[str | int] = []
    words = path.split(".")
    for depth, word in enumerate(words):
        match = _STEP.fullmatch(word)
        if match is None:
            raise _lost(path, _("{word} is not a step of a path").format(word=repr(word)))
        name, indices = match[1], [int(k) for k in re.findall(r"\d+", match[2])]
        if not is_dataclass(here):
            raise _lost(path, _("it leads beyond a value"))
        known = spellings_of(type(here))
        if name not in known:
            raise _unknown(path, words[:depth], name, known)
        field_name, factor = known[name]
        field = fields_of(type(here))[field_name]
        steps.append(field_name)
        here = _held(here, field)
        for k in indices:
            if not isinstance(here, tuple) or k >= len(here):
                raise _lost(path, _no_index(here, k))
            steps.append(k)
            here = here[k]
        if depth == len(words) - 1 and not _tables(here, field):
            return Place(tuple(steps), field, factor, len(indices), name)
    raise _lost(path, _("it leads to a whole table, not to a value"))


def read(drive: Keyed, path: str) -> Any:
    """Return the value a path leads to, in the path's unit."""
    there = place(drive, path)
    here: Any = drive
    for step in there.steps:
        here = here[step] if isinstance(step, int) else _held(here, fields_of(type(here))[step])
    return _in_unit(here, there.factor)


def _in_unit(value: Any, factor: float) -> Any:
    if isinstance(value, tuple):
        return tuple(_in_unit(item, factor) for item in value)
    return in_unit(value, factor) if isinstance(value, float) else value


def _held(owner: Any, field: Field) -> Any:
    """Return what a field holds; a table that is not there yet is an empty one, where it can be."""
    value = getattr(owner, field.name)
    if value is None and is_dataclass(field.type) and not any(one.required for one in fields_of(field.type).values()):
        return field.type()  # type: ignore[operator]
    return value


def with_values(drive: D, values: Mapping[str, Any]) -> D:
    """Return the drive with other values, each given by its path in the path's unit.

    drive: the drive to start from.
    values: path -> number, list of numbers, flag or word; None where a key is to be left out.
    Returns: checked as a whole, after all changes.
    Raises InputError: every path that leads nowhere and every value that does not fit.

    >>> from cardan import Drive
    >>> drive = Drive.from_angles([0.1, 0.2])
    >>> with_values(drive, {"shafts[1].yoke_angle_deg": 90}).shafts[1].yoke_angle
    1.5707963267948966
    """
    tops = _with_tops(drive, values)
    try:
        return replace(drive, **tops)
    except InputError as error:
        given = {bare_path(drive, path): path for path in values}
        raise error.renamed(lambda field: _as_given(field, given)) from None


def _with_tops(drive: Keyed, values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the fields of a drive with other values put in."""
    problems: list[Problem] = []
    tops = {name: getattr(drive, name) for name in fields_of(type(drive))}
    for path, value in values.items():
        try:
            there = place(drive, path)
            inner = _fitting(there, value, path)
            top = str(there.steps[0])
            tops[top] = _changed(tops[top], there.steps[1:], inner)
        except InputError as error:
            problems += error.problems
    check(problems)
    return tops


def bare_path(drive: Keyed, path: str) -> str:
    """Return a path as Python writes it, without its unit."""
    words = (f"[{step}]" if isinstance(step, int) else f".{step}" for step in place(drive, path).steps)
    return "".join(words).removeprefix(".")


def _as_given(field: str, given: Mapping[str, str]) -> str:
    """Return the path of a field as the caller spelled it, or as we would."""
    for bare, path in given.items():
        if field == bare:
            return path
        if field.startswith(f"{bare}["):
            return path + field[len(bare) :]
    return spelled(field)


def pose_drives(drive: P) -> tuple[P, ...]:
    """Return the drive in each of its poses, without poses of its own."""
    bare = replace(drive, poses=()) if drive.poses else drive
    return tuple(with_values(bare, dict(pose.set)) for pose in drive.poses)


def pose_problems(drive: Described, *, whole: bool) -> Iterator[Problem]:
    """Yield what is wrong with the poses of a drive."""
    bare = copy(drive)
    object.__setattr__(bare, "poses", ())
    object.__setattr__(bare, "shafts", drive.all_shafts())
    for k, pose in enumerate(drive.poses):
        try:
            if whole:
                with_values(bare, dict(pose.set))
            else:
                _with_tops(bare, dict(pose.set))
        except InputError as error:
            for problem in error.problems:
                yield Problem(f"poses[{k}].set: {problem.field}", problem.message)


def _fitting(there: Place, value: Any, path: str) -> Any:
    """Return a value in SI if it has the shape of what stands there and lies in its range."""
    kind = there.field.type
    for _step in range(there.inside):
        kind = get_args(kind)[0]
    if value is None and not there.inside and not there.field.required:
        return there.field.default
    if there.steps[-1] == "file":
        raise _lost(path, _("names a file that is read with the drive; change it in the drive file"))
    return _shaped(kind, value, there, path)


def _shaped(kind: Any, value: Any, there: Place, path: str) -> Any:
    if get_origin(kind) is tuple:
        parts = get_args(kind)
        items = value.tolist() if hasattr(value, "tolist") else value
        if not isinstance(items, list | tuple):
            raise _lost(path, _("must be {wanted}, not {given}").format(wanted=_("a list"), given=as_given(value)))
        endless = parts[-1] is Ellipsis
        if not endless and len(items) != len(parts):
            message = _("{given} values given, {wanted} needed").format(given=len(items), wanted=len(parts))
            raise _lost(path, message)
        return tuple(_shaped(parts[0], item, there, f"{path}[{k}]") for k, item in enumerate(items))
    if kind not in SCALARS:
        return value
    found = scalar(kind, value, there.field.key, there.factor, there.field.unit(there.spelling))
    if isinstance(found, Wrong):
        raise _lost(path, found.message, found.code)
    return found


def _changed(here: Any, steps: tuple[str | int, ...], value: Any) -> Any:
    if not steps:
        return value
    step, rest = steps[0], steps[1:]
    if isinstance(step, int):
        return (*here[:step], _changed(here[step], rest, value), *here[step + 1 :])
    return replace(here, **{step: _changed(_held(here, fields_of(type(here))[step]), rest, value)})


def _tables(value: Any, field: Field) -> bool:
    """Tell whether a path has led to a table, or a list of them, and not to a value."""
    if is_dataclass(value) or field.name == "set":
        return True
    return isinstance(value, tuple) and any(is_dataclass(part) for part in get_args(field.type))


def _no_index(here: Any, k: int) -> str:
    if not isinstance(here, tuple):
        return _("there is no index {k}; this is not a list").format(k=k)
    if not here:
        return _("there is no index {k}; the list is empty").format(k=k)
    return _("there is no index {k}: they count from 0, and the last one is {last}").format(k=k, last=len(here) - 1)


def _lost(path: str, message: str, code: str = "") -> InputError:
    return InputError([Problem(path, message, code)])


def _unknown(path: str, before: list[str], name: str, known: Mapping[str, Any]) -> InputError:
    all_units = {unit for units in DIMENSIONS.values() for unit in units}
    spellings = [spelling for spelling in known if spelling.removeprefix(f"{name}_") in all_units]
    if spellings:
        return _lost(path, _("needs a unit: write {choices}").format(choices=_(" or ").join(spellings)))
    close = nearest(name, known)
    stem = ".".join([*before, close]) if close else ""
    if close:
        return _lost(path, _("there is no such field; the nearest is {near}").format(near=stem))
    return _lost(path, _("there is no such field; known here: {known}").format(known=", ".join(_first(known))))


def _first(known: Mapping[str, tuple[str, float]]) -> Iterator[str]:
    seen: set[str] = set()
    for spelling, (name, _factor) in known.items():
        if name not in seen:
            seen.add(name)
            yield spelling
