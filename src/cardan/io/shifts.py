"""CSV files that a drive file names: shifts of its points, and torques over time."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator, Sequence
from pathlib import Path

from cardan.drive.drive import Drive
from cardan.drive.duty import History
from cardan.drive.joints.joint import Point
from cardan.drive.machine import TorqueHistory
from cardan.drive.movement import Table
from cardan.errors import InputError, Problem, check, refuse
from cardan.files import refusal, write_text
from cardan.texts import _, mark
from cardan.units import DIMENSIONS

MIN_ROWS = 4  # a twice differentiable spline needs so many rows


def read_shifts(path: Path) -> tuple[tuple[float, ...], tuple[Point, ...]]:
    """Return times [s] and shifts [m] of a CSV file with the columns time, x, y, z, each with its unit."""
    rows = read_rows(path, (("time", "time"), *((word, "length") for word in "xyz")), least=MIN_ROWS)
    return tuple(row[0] for row in rows), tuple((x, y, z) for _time, x, y, z in rows)


def read_torques(path: Path) -> tuple[tuple[float, ...], tuple[float, ...], tuple[float, ...]]:
    """Return times [s], torques [N·m] and speeds [rad/s] of a CSV file with the columns time, torque and maybe speed.

    Each with its unit in the title; without a column of speeds these are empty.
    """
    rows = read_rows(path, (("time", "time"), ("torque", "torque")), least=2, besides=(("speed", "angular_speed"),))
    times, torques, *more = zip(*rows, strict=True)
    return times, torques, more[0] if more else ()


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
    return read_torques(path) == (thing.times, thing.torques, thing.speeds)


def _text(thing: Table | TorqueHistory | History) -> str:
    """Return the rows of a thing as CSV."""
    if isinstance(thing, Table):
        rows: list[tuple[float, ...]] = [(t, *shift) for t, shift in zip(thing.times, thing.shifts, strict=True)]
        head = "time_s,x_m,y_m,z_m\n"
    else:
        columns = [thing.times, thing.torques, *([thing.speeds] if thing.speeds else [])]
        rows = list(zip(*columns, strict=True))
        head = "time_s,torque_Nm,speed_rad_s\n" if thing.speeds else "time_s,torque_Nm\n"
    return head + "".join(",".join(map(repr, row)) + "\n" for row in rows)


# CSV files of measured or computed values over time, with the unit of every column in its title.

MAX_BYTES = 100_000_000  # larger files are refused; no more of them is read

NUMBERS = ("", mark("a number"), mark("two numbers"), mark("three numbers"), mark("four numbers"))


def read_rows(
    path: Path,
    columns: Sequence[tuple[str, str]],
    *,
    least: int,
    besides: Sequence[tuple[str, str]] = (),
    rising: bool = True,
) -> list[tuple[float, ...]]:
    """Return the rows of a CSV file in SI.

    columns: word and dimension of every column wanted; its title is the word with a unit.
    besides: those that are read too where they are there, behind the others.
    rising: whether the first are times, which must rise.
    """
    try:
        with path.open("rb") as stream:
            content = stream.read(MAX_BYTES + 1)
        if len(content) > MAX_BYTES:
            limit = MAX_BYTES // 10**6
            raise refuse(str(path.name), _("is larger than {limit} MB; take fewer rows").format(limit=limit))
        rows = list(csv.reader(content.decode("utf-8-sig").splitlines()))
    except csv.Error as error:
        raise refuse(str(path.name), _("is not CSV: {why}").format(why=error)) from None
    except OSError as error:
        raise refuse(str(path.name), _("cannot be read: {why}").format(why=refusal(error))) from None
    except UnicodeDecodeError:
        raise refuse(str(path.name), _("is not UTF-8 text")) from None
    if not rows:
        raise refuse(str(path.name), _("is empty"))
    titles = {title.strip() for title in rows[0]}
    columns = (*columns, *(one for one in besides if titles & _spellings(*one).keys()))
    places = _places(rows[0], columns, path.name)
    problems: list[Problem] = []
    found: list[tuple[float, ...]] = []
    for line, row in enumerate(rows[1:], start=2):
        if not any(cell.strip() for cell in row):
            continue
        try:
            values = tuple(float(row[column]) * factor for column, factor in places)
        except (ValueError, IndexError):
            text = _("line {line} is not {numbers}")
            problems.append(Problem(path.name, text.format(line=line, numbers=_(NUMBERS[len(columns)]))))
            continue
        if not all(math.isfinite(v) for v in values):
            problems.append(Problem(path.name, _("line {line} has a number that is not finite").format(line=line)))
        elif rising and found and values[0] <= found[-1][0]:
            problems.append(Problem(path.name, _("line {line}: the times do not rise").format(line=line)))
        else:
            found.append(values)
    check(problems)
    if len(found) < least:
        text = _("has {given} rows; at least {wanted} are needed")
        raise refuse(path.name, text.format(given=len(found), wanted=least))
    return found


def _spellings(word: str, dimension: str) -> dict[str, float]:
    """Return the titles that a column may have, each with the factor of its unit to SI."""
    return {f"{word}_{unit}": factor for unit, factor in DIMENSIONS[dimension].items()}


def _places(header: list[str], columns: Sequence[tuple[str, str]], name: str) -> list[tuple[int, float]]:
    """Return place and factor to SI of every column wanted."""
    titles = [title.strip() for title in header]
    found: list[tuple[int, float]] = []
    problems: list[Problem] = []
    for word, dimension in columns:
        spellings = _spellings(word, dimension)
        column = next((k for k, title in enumerate(titles) if title in spellings), None)
        if column is None:
            wanted = _(" or ").join(spellings)
            problems.append(Problem(name, _("has no column {wanted}").format(wanted=wanted)))
        else:
            found.append((column, spellings[titles[column]]))
    check(problems)
    return found
