"""CSV files that a drive file names: shifts of its points, and torques over time."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from cardan.drive.drive import Drive
from cardan.drive.duty import History
from cardan.drive.joints.joint import Point
from cardan.drive.machine import TorqueHistory
from cardan.drive.movement import Table
from cardan.errors import InputError, Problem, check
from cardan.files import write_text
from cardan.texts import _

from .csv_rows import read_rows

MIN_ROWS = 4
"""A twice differentiable spline needs so many rows."""


def read_shifts(path: Path) -> tuple[tuple[float, ...], tuple[Point, ...]]:
    """Return times [s] and shifts [m] of a CSV file with the columns time, x, y, z, each with its unit.

    Raises InputError: the file cannot be read, a column is missing, a row is not four finite numbers, times do not
    rise.
    """
    rows = read_rows(path, (("time", "time"), *((word, "length") for word in "xyz")), least=MIN_ROWS)
    return tuple(row[0] for row in rows), tuple((x, y, z) for _time, x, y, z in rows)


def read_torques(path: Path) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return times [s] and torques [N·m] of a CSV file with the columns time and torque, each with its unit.

    Raises InputError: the file cannot be read, a column is missing, a row is not two finite numbers, times do not rise.
    """
    rows = read_rows(path, (("time", "time"), ("torque", "torque")), least=2)
    return tuple(row[0] for row in rows), tuple(row[1] for row in rows)


def keep_rows(drive: Drive, folder: Path) -> None:
    """Write the rows of table movements and torque histories to the files they name, unless these hold them already."""
    missing: dict[Path, str] = {}
    problems: list[Problem] = []
    for field, thing in _named(drive):
        if not thing.times:
            continue
        path = folder / thing.file
        if not path.exists():
            missing[path] = _text(thing)
            continue
        try:
            same = _rows(thing, path)
        except InputError:
            same = False
        if not same:
            message = _("{path} stands there already and holds something else").format(path=path)
            problems.append(Problem(f"{field}.file", message))
    check(problems)
    for path, text in missing.items():
        write_text(path, text)


def _named(drive: Drive) -> Iterator[tuple[str, Table | TorqueHistory | History]]:
    """Yield what names a file, with its path in the drive."""
    duty = drive.duty
    things = [(f"movements[{k}]", one) for k, one in enumerate(drive.movements)]
    laws = [("duty.motor", duty.motor), ("duty.load", duty.load)]
    laws += [(f"duty.torques[{k}]", one) for k, one in enumerate(duty.torques)]
    for field, thing in (*things, *laws, ("duty.torque_history", duty.torque_history)):
        if isinstance(thing, Table | TorqueHistory | History):
            yield field, thing


def _rows(thing: Table | TorqueHistory | History, path: Path) -> bool:
    """Tell whether a file holds the rows of a thing."""
    if isinstance(thing, Table):
        return read_shifts(path) == (thing.times, thing.shifts)
    return read_torques(path) == (thing.times, thing.torques)


def _text(thing: Table | TorqueHistory | History) -> str:
    """Return the rows of a thing as CSV."""
    if isinstance(thing, Table):
        rows: list[tuple[float, ...]] = [(t, *shift) for t, shift in zip(thing.times, thing.shifts, strict=True)]
        head = "time_s,x_m,y_m,z_m\n"
    else:
        rows = list(zip(thing.times, thing.torques, strict=True))
        head = "time_s,torque_Nm\n"
    return head + "".join(",".join(map(repr, row)) + "\n" for row in rows)
