"""CSV files of measured or computed values over time, with the unit of every column in its title."""

from __future__ import annotations

import csv
import math
from collections.abc import Sequence
from pathlib import Path

from cardan.errors import Problem, check, refuse
from cardan.files import refusal
from cardan.texts import _, mark
from cardan.units import DIMENSIONS

MAX_BYTES = 100_000_000
"""Larger files are refused; no more of them is read."""

NUMBERS = ("", mark("a number"), mark("two numbers"), mark("three numbers"), mark("four numbers"))


def read_rows(path: Path, columns: Sequence[tuple[str, str]], *, least: int) -> list[tuple[float, ...]]:
    """Return the rows of a CSV file in SI.

    columns: word and dimension of every column wanted, the times first; its title is the word with a unit.
    least: rows needed.
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
        elif found and values[0] <= found[-1][0]:
            problems.append(Problem(path.name, _("line {line}: the times do not rise").format(line=line)))
        else:
            found.append(values)
    check(problems)
    if len(found) < least:
        text = _("has {given} rows; at least {wanted} are needed")
        raise refuse(path.name, text.format(given=len(found), wanted=least))
    return found


def _places(header: list[str], columns: Sequence[tuple[str, str]], name: str) -> list[tuple[int, float]]:
    """Return place and factor to SI of every column wanted."""
    titles = [title.strip() for title in header]
    found: list[tuple[int, float]] = []
    problems: list[Problem] = []
    for word, dimension in columns:
        spellings = {f"{word}_{unit}": factor for unit, factor in DIMENSIONS[dimension].items()}
        column = next((k for k, title in enumerate(titles) if title in spellings), None)
        if column is None:
            wanted = _(" or ").join(spellings)
            problems.append(Problem(name, _("has no column {wanted}").format(wanted=wanted)))
        else:
            found.append((column, spellings[titles[column]]))
    check(problems)
    return found
