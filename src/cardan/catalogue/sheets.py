"""Rows of a user's catalogue from spreadsheets: a CSV file or a sheet is a table, its head has the keys."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterable, Iterator, Sequence
from contextlib import closing
from dataclasses import is_dataclass
from pathlib import Path
from typing import Any, get_args, get_origin
from zipfile import BadZipFile

from cardan.drive.fields.keys import NAMED
from cardan.errors import refuse
from cardan.later import later
from cardan.reading.fields import fields_of
from cardan.reading.limits import check_size
from cardan.texts import _, mark

from .rows import TABLES

openpyxl = later("openpyxl", mark("a catalogue from a workbook needs openpyxl: pip install 'cardan[xlsx]'"))

WORDS = {"true": True, "yes": True, "false": False, "no": False}


def tree_of(path: Path) -> dict[str, list[dict[str, Any]]]:
    """Return the tables of a CSV file, whose name ends with that of its table, or of a workbook, whose sheets have it.

    A key of an inner table stands in the head after a point, ``rating.torque_Nm``; parts of a list are parted by ``;``
    or by a comma and a blank.
    """
    check_size(path.stat().st_size, str(path))
    if path.suffix.lower() == ".csv":
        text = path.read_text(encoding="utf-8-sig")
        head = text.partition("\n")[0]
        dialect: Any = _Semicolons if head.count(";") > head.count(",") else csv.excel
        table = next((name for name in sorted(TABLES, key=len, reverse=True) if path.stem.endswith(name)), "")
        if not table:
            said = _(
                "unknown table; a CSV file is called after its own, as acme-joint_sizes.csv; the tables are {known}"
            )
            raise refuse("", said.format(known=", ".join(TABLES)))
        return {table: _rows(table, csv.reader(text.splitlines(), dialect))}
    try:
        book = openpyxl().load_workbook(path, read_only=True, data_only=True)
    except (KeyError, ValueError, BadZipFile) as error:
        raise refuse("", _("cannot be read as a workbook: {why}").format(why=error)) from None
    with closing(book):
        return {sheet.title: _rows(sheet.title, sheet.iter_rows(values_only=True)) for sheet in book.worksheets}


class _Semicolons(csv.excel):
    """CSV as spreadsheets write it where the comma is the decimal sign."""

    delimiter = ";"


def _rows(table: str, lines: Iterable[Sequence[Any]]) -> list[dict[str, Any]]:
    """Return the rows of a table as a catalogue file has them."""
    every = iter(lines)
    head = [str(one or "").strip() for one in next(every, ())]
    types = dict(_types(TABLES[table], "")) if table in TABLES else {}
    rows = []
    for line in every:
        row: dict[str, Any] = {}
        for key, cell in zip(head, line, strict=False):
            if not key or cell is None or (isinstance(cell, str) and not cell.strip()):
                continue
            *outer, last = key.split(".")
            inner = row
            for name in outer:
                inner = inner.setdefault(name, {})
            inner[last] = _value(cell, types.get(key))
        if row:
            rows.append(row)
    return rows


def _types(cls: Any, before: str) -> Iterator[tuple[str, Any]]:
    """Yield what each key of a row holds, those of inner tables after a point."""
    for one in fields_of(cls).values():
        yield from ((before + spelling, one.type) for spelling in one.spellings)
        if is_dataclass(one.type) and one.type not in NAMED:
            yield from _types(one.type, f"{before}{one.spelling}.")


def _value(cell: Any, wanted: Any) -> Any:
    """Return what a cell holds: words stay words, numbers may have a decimal comma; what does not fit stays."""
    if get_origin(wanted) is tuple:
        parts = re.split(";|, ", cell) if isinstance(cell, str) else [cell]
        return [_value(part, get_args(wanted)[0]) for part in parts]
    if not isinstance(cell, str):
        return f"{cell:g}" if wanted is str and isinstance(cell, float) else str(cell) if wanted is str else cell
    word = cell.strip()
    if wanted is bool or (wanted is not float and word.casefold() in ("true", "false")):
        return WORDS.get(word.casefold(), word)
    if wanted is str:
        return word
    try:
        number = float(word.replace(",", "."))
    except ValueError:
        return word
    return int(number) if wanted is int and number.is_integer() else number
