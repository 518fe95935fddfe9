"""CSV files of measured or computed shifts."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterable
from pathlib import Path

from cardan.drive.joints.joint import Point
from cardan.drive.movement import Movement, Table
from cardan.errors import InputError, Problem, check, refuse
from cardan.files import write_text
from cardan.texts import _
from cardan.units import DIMENSIONS

MAX_BYTES = 100_000_000
"""Larger files are refused; no more of them is read."""

MIN_ROWS = 4
"""A twice differentiable spline needs so many rows."""


def read_shifts(path: Path) -> tuple[tuple[float, ...], tuple[Point, ...]]:
    """Return times [s] and shifts [m] of a CSV file with the columns time, x, y, z, each with its unit.

    Raises
    ------
    InputError
        The file cannot be read, a column is missing, a row is not four finite numbers, times do not rise.
    """
    try:
        with path.open("rb") as stream:
            content = stream.read(MAX_BYTES + 1)
        if len(content) > MAX_BYTES:
            limit = MAX_BYTES // 10**6
            raise refuse(str(path.name), _("is larger than {limit} MB; take fewer rows").format(limit=limit))
        rows = list(csv.reader(content.decode("utf-8-sig").splitlines()))
    except csv.Error as error:
        raise refuse(str(path.name), _("is no CSV: {why}").format(why=error)) from None
    except OSError as error:
        raise refuse(str(path.name), _("cannot be read: {why}").format(why=error.strerror or error)) from None
    except UnicodeDecodeError:
        raise refuse(str(path.name), _("is not UTF-8 text")) from None
    if not rows:
        raise refuse(str(path.name), _("is empty"))
    places = _columns(rows[0], path.name)
    problems: list[Problem] = []
    times: list[float] = []
    shifts: list[Point] = []
    for line, row in enumerate(rows[1:], start=2):
        if not any(cell.strip() for cell in row):
            continue
        try:
            t, x, y, z = (float(row[column]) * factor for column, factor in places)
        except (ValueError, IndexError):
            problems.append(Problem(path.name, _("line {line} is not four numbers").format(line=line)))
            continue
        if not all(math.isfinite(v) for v in (t, x, y, z)):
            problems.append(Problem(path.name, _("line {line} has a number that is not finite").format(line=line)))
        elif times and t <= times[-1]:
            problems.append(Problem(path.name, _("line {line}: the times do not rise").format(line=line)))
        else:
            times.append(t)
            shifts.append((x, y, z))
    check(problems)
    if len(times) < MIN_ROWS:
        raise refuse(
            path.name, _("has {given} rows; at least {wanted} are needed").format(given=len(times), wanted=MIN_ROWS)
        )
    return tuple(times), tuple(shifts)


def keep_shifts(movements: Iterable[Movement], folder: Path) -> None:
    """Write the rows of table movements to the files they name, unless these hold them already.

    Raises
    ------
    InputError
        A file there holds other rows, or cannot be written; nothing has been written then.
    """
    missing: dict[Path, str] = {}
    problems: list[Problem] = []
    for k, movement in enumerate(movements):
        if not isinstance(movement, Table) or not movement.times:
            continue
        path = folder / movement.file
        if not path.exists():
            rows = ((t, *shift) for t, shift in zip(movement.times, movement.shifts, strict=True))
            missing[path] = "time_s,x_m,y_m,z_m\n" + "".join(",".join(map(repr, row)) + "\n" for row in rows)
            continue
        try:
            same = read_shifts(path) == (movement.times, movement.shifts)
        except InputError:
            same = False
        if not same:
            message = _("{path} stands there already and holds something else").format(path=path)
            problems.append(Problem(f"movements[{k}].file", message))
    check(problems)
    for path, text in missing.items():
        write_text(path, text)


def _columns(header: list[str], name: str) -> list[tuple[int, float]]:
    """Return column and factor to SI of time, x, y and z."""
    titles = [title.strip() for title in header]
    found: list[tuple[int, float]] = []
    problems: list[Problem] = []
    for word, dimension in (("time", "time"), ("x", "length"), ("y", "length"), ("z", "length")):
        spellings = {f"{word}_{unit}": factor for unit, factor in DIMENSIONS[dimension].items()}
        column = next((k for k, title in enumerate(titles) if title in spellings), None)
        if column is None:
            wanted = _(" or ").join(spellings)
            problems.append(Problem(name, _("has no column {wanted}").format(wanted=wanted)))
        else:
            found.append((column, spellings[titles[column]]))
    check(problems)
    return found
