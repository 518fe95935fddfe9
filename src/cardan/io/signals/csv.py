"""Recordings as CSV: a column of times and one for each channel, with the unit in its title."""

from __future__ import annotations

import csv
import io
from array import array
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from cardan.errors import InputError, Problem, check, refuse
from cardan.maths.arrays import Array
from cardan.questions.diagnosis.signals.quality import evened
from cardan.questions.diagnosis.signals.signal import Signal
from cardan.texts import _

from .columns import Asked, Column, Raw, content, meaning, title_of

suffix = ".csv"

MAX_BYTES = 200_000_000  # larger files are refused; no more of them is read
CHUNK = 50_000  # lines read at once
PREAMBLE = 60  # lines above the titles that a logger writes at most
PRINTED = bytes([9, 10, 12, 13, *range(32, 256)])  # bytes of text
TOLD = 5  # lines of which it is told what is wrong with them


def read(path: Path, asked: Asked) -> Raw:
    """Return the channels of a CSV file."""
    name = path.name
    text = _decoded(content(path, name, MAX_BYTES), name)
    lines, numbers = [], array("L")
    for k, one in enumerate(text.splitlines(), start=1):
        if one.strip() and not one.lstrip().startswith("#"):
            lines.append(one)
            numbers.append(k)
    if not lines:
        raise refuse(name, _("is empty"), "empty")
    first, begin, mark, titles = _headed(lines)
    cautions = []
    if first:
        text = _("{name}: its titles were taken from line {line}; what stands above them was left out.")
        cautions.append(text.format(name=name, line=numbers[first]))
    if all(_is_number(one) for one in titles):
        if not isinstance(asked.titles, Sequence) or len(asked.titles) != len(titles):
            text = _("begins with numbers: the first line is to hold titles, as time_s and acceleration_m_s2")
            raise refuse(name, text, "missing")
        titles, begin = list(asked.titles), 0
    table, told = _table(name, lines[begin:], mark, len(titles), asked, numbers[begin:])
    return _timed(name, titles, table, [*cautions, *told], asked)


def _decoded(found: bytes, name: str) -> str:
    """Return the text of a file: UTF-8, UTF-16 with its mark, or the Windows code page that older loggers write."""
    try:
        return found.decode("utf-16" if found.startswith((b"\xff\xfe", b"\xfe\xff")) else "utf-8-sig")
    except UnicodeDecodeError:
        pass
    try:
        if found.translate(None, delete=PRINTED) == b"":
            return found.decode("cp1252")
    except UnicodeDecodeError:
        pass
    raise refuse(name, _("is not UTF-8 text"))


def _headed(lines: Sequence[str]) -> tuple[int, int, str, list[str]]:
    """Return the place of the line of titles, where the numbers begin, the mark between cells and the titles.

    The titles are the first line when the second one goes with it; else the first of the lines below that has as many
    cells, more than one, as a line of numbers after it. A line of units between them is joined to the titles.
    """
    for k in range(min(len(lines) - 1, PREAMBLE)):
        mark = _mark(lines[k])
        titles, *after = (_cells(one, mark) for one in lines[k : k + 3])
        if all(_is_number(one) for one in titles):
            break
        if k and (len(titles) < 2 or any(_is_number(one) for one in titles)):
            continue
        if len(after[0]) == len(titles) and _has_numbers(after[0], mark):
            return k, k + 1, mark, titles
        alike = len(after) == 2 and len(after[0]) == len(after[1]) == len(titles)
        if alike and _has_numbers(after[1], mark) and not any(_is_number(one) for one in after[0]):
            units = [one.strip("[]() ") for one in after[0]]
            return k, k + 2, mark, [f"{a} [{b}]" if b else a for a, b in zip(titles, units, strict=True)]
    mark = _mark(lines[0])
    return 0, 1, mark, _cells(lines[0], mark)


def _mark(line: str) -> str:
    return ";" if ";" in line else "\t" if "\t" in line else ","


def _cells(line: str, mark: str) -> list[str]:
    return [one.strip() for one in next(csv.reader([line], delimiter=mark))]


def _has_numbers(cells: Sequence[str], mark: str) -> bool:
    found = [_is_number(one.replace(",", ".") if mark != "," else one) for one in cells]
    return found[0] or 2 * sum(found) > len(found)


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True


def _table(
    name: str, lines: list[str], mark: str, wide: int, asked: Asked, numbers: Sequence[int]
) -> tuple[Array, list[str]]:
    """Return the numbers of all lines (n, c), nan for what is none."""
    parts: list[Array] = []
    cautions: list[str] = []
    broken: list[int] = []
    for first in range(0, len(lines), CHUNK):
        some = lines[first : first + CHUNK]
        if mark != ",":
            some = [one.replace(",", ".") for one in some]
        try:
            part = np.loadtxt(some, delimiter=mark, ndmin=2)
            if part.shape[1] != wide:
                raise ValueError
        except ValueError:
            part, bad = _by_cells(some, mark, wide)
            broken += [first + k for k in bad]
        parts.append(part)
        if asked.progress is not None and asked.progress(min(1.0, (first + CHUNK) / len(lines))) == "stop":
            cautions.append(_("Reading was stopped: this is the first part of {name}.").format(name=name))
            break
    if broken == [len(lines) - 1]:
        cautions.append(_("The last line of {name} is cut off; it was left out.").format(name=name))
    elif broken:
        text = _("line {line} has not {count} cells as the titles")
        told = [Problem(name, text.format(line=numbers[k], count=wide), "inconsistent") for k in broken[:TOLD]]
        if len(broken) > TOLD:
            told.append(Problem(name, _("and {count} lines more").format(count=len(broken) - TOLD), "inconsistent"))
        check(told)
    return np.concatenate(parts) if parts else np.zeros((0, wide)), cautions


def _by_cells(lines: list[str], mark: str, wide: int) -> tuple[Array, list[int]]:
    """Return the numbers of lines of which some hold none, and the places of lines with too few or too many cells."""
    rows, bad = [], []
    for k, cells in enumerate(csv.reader(lines, delimiter=mark)):
        if len(cells) != wide:
            bad.append(k)
            continue
        rows.append([float(cell) if _is_number(cell) else np.nan for cell in cells])
    return np.asarray(rows, dtype=float).reshape(len(rows), wide), bad


def _timed(name: str, titles: list[str], table: Array, cautions: list[str], asked: Asked) -> Raw:
    """Return the columns with their rate, from the times or as asked."""
    table = np.where(np.isfinite(table), table, np.nan)
    at = next((k for k, one in enumerate(titles) if _is_time(one)), None)
    others = [k for k in range(len(titles)) if k != at]
    if not others:
        raise refuse(name, _("has no channel beside the times"), "empty")
    if table.shape[0] < 2:
        text = _("has {given} rows; at least {wanted} are needed")
        raise refuse(name, text.format(given=table.shape[0], wanted=2), "empty")
    rows = table[:, others].T
    if at is None:
        if asked.rate is None:
            raise refuse(name, _("has no column of times (time_s): give the rate of its values"), "missing")
        rate, start, trust = asked.rate, 0.0, 1.0
    else:
        times = table[:, at] * meaning(titles[at]).factor
        known = np.isfinite(times)
        if not np.all(known):
            text = _("{count} lines of {name} have no time; they were left out.")
            cautions.append(text.format(count=int(np.sum(~known)), name=name))
            times, rows = times[known], rows[:, known]
        if times.size < 2:
            raise refuse(name, _("has no times"), "empty")
        back = np.flatnonzero(np.diff(times) <= 0.0)
        if back.size:
            text = _("the times do not rise in {count} places, first at row {row}")
            raise refuse(name, text.format(count=back.size, row=int(back[0]) + 2), "inconsistent")
        rate, start, rows, told, trust = evened(times, rows)
        cautions += [f"{name}: {one}" for one in told]
        if asked.rate is not None and abs(asked.rate / rate - 1.0) > 0.01:
            text = _("{name}: its times make {found:.6g} values a second, not {given:.6g}; the times were kept.")
            cautions.append(text.format(name=name, found=rate, given=asked.rate))
            trust *= 0.5
    columns = [
        Column(title=titles[k], values=row, rate=rate, start=start, trust=trust)
        for k, row in zip(others, rows, strict=True)
    ]
    return Raw(columns=columns, cautions=tuple(cautions))


def _is_time(title: str) -> bool:
    try:
        return meaning(title).quantity == "time"
    except InputError:
        return title.lower().startswith("time")


def content_of(signal: Signal) -> bytes:
    """Return a recording as the bytes of a CSV file, in SI."""
    first = signal.channels[0]
    check(unlike(signal))
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(["time_s", *(title_of(c.name, c.quantity, c.place, c.direction) for c in signal.channels)])
    rows = np.stack([first.time, *(one.values for one in signal.channels)], axis=1)
    np.savetxt(stream, rows, fmt=["%.12g"] + ["%.10g"] * len(signal.channels), delimiter=",")
    return stream.getvalue().encode("utf-8")


def unlike(signal: Signal) -> Iterator[Problem]:
    """Yield the channels of a recording that have other times than the first one."""
    first = signal.channels[0]
    for k, one in enumerate(signal.channels):
        if (one.rate, one.start, one.values.size) != (first.rate, first.start, first.values.size):
            text = _("{name} has not the times of {first}; they do not fit into one table")
            yield Problem(f"channels[{k}]", text.format(name=one.name, first=first.name), "inconsistent")
