"""Paths to the fields of a drive, with units: ``joints[1].centre_mm[2]``, ``shafts[1].yoke_angle_deg``.

Indices count from 0; ``shafts[1]`` is shaft number 2. The same paths serve poses, the command line and sweeps.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, is_dataclass, replace
from typing import Any, get_origin

from cardan.errors import InputError, Problem, check
from cardan.texts import _
from cardan.units import nearest

from .drive import Drive
from .keys import Field, fields_of, numbers_in, scaled, spellings_of

_STEP = re.compile(r"([A-Za-z_][A-Za-z0-9_]*)((?:\[\d+\])*)$")


@dataclass(frozen=True, slots=True)
class Place:
    """Where a path leads.

    Attributes
    ----------
    steps : tuple of str or int
        Field names and indices from the drive to the value.
    field : Field
        The field that holds it.
    factor : float
        From the path's unit to SI.
    inside : int
        How many of the last steps lead into the field's own numbers.
    """

    steps: tuple[str | int, ...]
    field: Field
    factor: float
    inside: int


def place(drive: Drive, path: str) -> Place:
    """Return where a path leads in a drive.

    Raises
    ------
    InputError
        The path leads nowhere; the message names the nearest one that does.
    """
    here: Any = drive
    steps: list[str | int] = []
    words = path.split(".")
    for depth, word in enumerate(words):
        match = _STEP.fullmatch(word)
        if match is None:
            raise _lost(path, _("{word} is no step of a path").format(word=repr(word)))
        name, indices = match[1], [int(k) for k in re.findall(r"\d+", match[2])]
        if not is_dataclass(here):
            raise _lost(path, _("it leads beyond a value"))
        known = spellings_of(type(here))
        if name not in known:
            raise _unknown(path, words[:depth], name, known)
        field_name, factor = known[name]
        field = fields_of(type(here))[field_name]
        steps.append(field_name)
        here = getattr(here, field_name)
        for k in indices:
            if not isinstance(here, tuple) or k >= len(here):
                raise _lost(path, _("there is no index {k}").format(k=k))
            steps.append(k)
            here = here[k]
        if depth == len(words) - 1 and not is_dataclass(here) and not _tables(here):
            return Place(tuple(steps), field, factor, len(indices))
    raise _lost(path, _("it leads to a whole table, not to a value"))


def read(drive: Drive, path: str) -> Any:
    """Return the value a path leads to, in the path's unit.

    Examples
    --------
    >>> drive = Drive.from_points([(0, 0, 0), (0.3, 0, 0), (1, 0.1, 0)])
    >>> read(drive, "joints[0].centre_mm[0]")
    300.0
    """
    there = place(drive, path)
    here: Any = drive
    for step in there.steps:
        here = here[step] if isinstance(step, int) else getattr(here, step)
    return scaled(here, 1.0 / there.factor)


def with_values(drive: Drive, values: Mapping[str, Any]) -> Drive:
    """Return the drive with other values, each given by its path in the path's unit.

    Parameters
    ----------
    drive : Drive
        The drive to start from.
    values : mapping of str to value
        Path -> number, list of numbers, flag or word.

    Returns
    -------
    Drive
        Checked as a whole, after all changes.

    Raises
    ------
    InputError
        Every path that leads nowhere and every value that does not fit.

    Examples
    --------
    >>> drive = Drive.from_angles([0.1, 0.2])
    >>> with_values(drive, {"shafts[1].yoke_angle_deg": 90}).shafts[1].yoke_angle
    1.5707963267948966
    """
    problems: list[Problem] = []
    tops = {name: getattr(drive, name) for name in fields_of(Drive)}
    for path, value in values.items():
        try:
            there = place(drive, path)
            inner = _fitting(there, value, path)
            top = str(there.steps[0])
            tops[top] = _changed(tops[top], there.steps[1:], inner)
        except InputError as error:
            problems += error.problems
    check(problems)
    return replace(drive, **tops)


def pose_drives(drive: Drive) -> tuple[Drive, ...]:
    """Return the drive in each of its poses, without poses of its own.

    Raises
    ------
    InputError
        A pose changes what is not there, or makes no drive; the path names the pose.
    """
    drives: list[Drive] = []
    problems: list[Problem] = []
    bare = replace(drive, poses=())
    for k, pose in enumerate(drive.poses):
        try:
            drives.append(with_values(bare, dict(pose.set)))
        except InputError as error:
            problems += [Problem(f"poses[{k}].set: {one.field}", one.message) for one in error.problems]
    check(problems)
    return tuple(drives)


def _fitting(there: Place, value: Any, path: str) -> Any:
    """Return a value in SI if it has the shape of what stands there."""
    wants_words = there.field.type in (str, bool)
    if wants_words:
        if not isinstance(value, there.field.type):
            raise _lost(path, _("{value} is no {kind}").format(value=repr(value), kind=there.field.type.__name__))
        return value
    flat = list(numbers_in(value))
    is_list = isinstance(value, Sequence) and not isinstance(value, str)
    wants_list = get_origin(there.field.type) is tuple and not there.inside
    if (not flat and value != []) or is_list != wants_list or (there.field.type is int and not isinstance(value, int)):
        raise _lost(path, _("{value} does not fit this field").format(value=repr(value)))
    return value if there.field.type is int else scaled(scaled(value, 1.0), there.factor)


def _changed(here: Any, steps: tuple[str | int, ...], value: Any) -> Any:
    if not steps:
        return value
    step, rest = steps[0], steps[1:]
    if isinstance(step, int):
        return (*here[:step], _changed(here[step], rest, value), *here[step + 1 :])
    return replace(here, **{step: _changed(getattr(here, step), rest, value)})


def _tables(value: Any) -> bool:
    return isinstance(value, tuple) and bool(value) and is_dataclass(value[0])


def _lost(path: str, message: str) -> InputError:
    return InputError([Problem(path, message)])


def _unknown(path: str, before: list[str], name: str, known: Mapping[str, Any]) -> InputError:
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
