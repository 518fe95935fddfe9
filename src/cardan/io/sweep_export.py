"""Tables of sweeps as files for other programs: CSV, Parquet, a workbook with a sheet on what the numbers come from."""

from __future__ import annotations

import io
import json
import os
import secrets
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import numpy as np

from cardan.batch.table.results import Results, duckdb, only_select, pyarrow
from cardan.batch.work import Column, Rows
from cardan.errors import refuse
from cardan.files import refusal, write_bytes
from cardan.io.workbook.book import MOST_ROWS, opened, put, sheet_name
from cardan.texts import _
from cardan.units import label

SUFFIXES = (".csv", ".parquet", ".xlsx")  # kinds of file that `export` writes
WIDEST = 34  # letters of the widest column of a sheet


def export(results: Results, path: str | Path, *, rows: Rows | None = None, where: str = "") -> int:
    """Write the table of a sweep, or rows of it, to a file, whole or not at all.

    path: its suffix says how: one of `SUFFIXES`.
    rows, mapping of str to array (n,): what was chosen from the table; the whole of it by default, streamed and never
    held.
    What has no answer is an empty cell, in Parquet null. The provenance stands in the metadata of Parquet under
    ``cardan`` and on a sheet of its own; CSV has no room for it.
    """
    place = Path(path)
    suffix = place.suffix.lower()
    if suffix not in SUFFIXES:
        known = ", ".join(SUFFIXES)
        raise refuse(str(path), _("{path} should end in one of {known}").format(path=path, known=known))
    if suffix == ".xlsx":
        return _workbook(results, place, rows, where)
    with _whole(place) as temporary:
        return _copied(results, temporary, place, rows, where)


@contextmanager
def _whole(path: Path) -> Iterator[Path]:
    """Give a file beside the one wanted, which takes its name when all is written."""
    temporary = path.resolve().with_name(f".{path.name}.{secrets.token_hex(8)}.part")
    try:
        yield temporary
        os.replace(temporary, path.resolve())
    except OSError as error:
        raise refuse(str(path), _("cannot be written: {why}").format(why=refusal(error))) from None
    finally:
        with suppress(OSError):
            temporary.unlink()


def _copied(results: Results, path: Path, wanted: Path, rows: Rows | None, where: str) -> int:
    """Write a table by the database and return its rows."""
    how = "FORMAT CSV, HEADER"
    if wanted.suffix.lower() == ".parquet":
        about = json.dumps({"columns": results.units, "provenance": dict(results.provenance)}, ensure_ascii=False)
        how = "FORMAT PARQUET, COMPRESSION ZSTD, KV_METADATA {cardan: '" + about.replace("'", "''") + "'}"
    try:
        with results.opened(writes=path) as connection:
            if rows is None:
                source = results.named(results.select(where=where))
                only_select(connection, source)
            else:
                connection.register("chosen", _arrow(rows))
                source = "SELECT * FROM chosen"
            target = str(path).replace("'", "''")
            written = connection.execute(f"COPY ({source}\n) TO '{target}' ({how})").fetchone()
            return int(written[0]) if written else 0
    except duckdb().Error as error:
        text = _("cannot be written: {why}").format(why=str(error).splitlines()[0])
        raise refuse(str(wanted), text) from None


def _arrow(rows: Rows) -> Any:
    """Return rows as a table, with null for what is not a number."""
    pa = pyarrow()
    return pa.table({name: pa.array(np.asarray(column), from_pandas=True) for name, column in rows.items()})


def _workbook(results: Results, path: Path, rows: Rows | None, where: str) -> int:
    """Write a workbook and return the rows of its table."""
    count = results.count(where) if rows is None else len(next(iter(rows.values()), ()))
    if count >= MOST_ROWS:
        text = _("has {rows} rows; a sheet holds {limit}: save it as .csv or .parquet, or choose rows")
        raise refuse(str(path), text.format(rows=count, limit=MOST_ROWS - 1))
    pieces = results.pieces(where=where) if rows is None else iter([rows])
    names = [column.name for column in results.columns] if rows is None else list(rows)
    stream = io.BytesIO()
    book = opened(stream, title=str(results.provenance.get("title") or "sweep"))
    head = book.add_format({"bold": True, "bottom": 1, "text_wrap": True, "valign": "top"})
    taken: set[str] = set()
    sheet = book.add_worksheet(sheet_name(_("sweep"), taken))
    for k, name in enumerate(names):
        put(sheet, 0, k, name, head)
        sheet.set_column(k, k, max(10, min(len(name) + 2, WIDEST)))
    line = 0
    for piece in pieces:
        lists = [np.asarray(piece[name]).tolist() for name in names]
        for row in zip(*lists, strict=True):
            line += 1
            for k, value in enumerate(row):
                put(sheet, line, k, value)
    sheet.freeze_panes(1, 0)
    sheet.autofilter(0, 0, line, max(len(names) - 1, 0))
    about = book.add_worksheet(sheet_name(_("provenance"), taken))
    about.set_column(0, 0, 34)
    about.set_column(1, 3, 24)
    for k, entry in enumerate(_about(results.columns, results.provenance)):
        for column, value in enumerate(entry):
            put(about, k, column, value, head if k == 0 else None)
    book.close()
    write_bytes(path, stream.getvalue())
    return count


def _about(columns: tuple[Column, ...], provenance: Mapping[str, Any]) -> Iterator[tuple[Any, ...]]:
    """Yield what columns mean and what the rows come from."""
    yield _("column"), _("unit"), _("role"), _("meaning")
    for column in columns:
        yield column.name, label(column.unit) if column.unit else "", column.role, _(column.text) if column.text else ""
    yield ()
    yield from _told("", provenance)


def _told(path: str, value: Any) -> Iterator[tuple[str, Any]]:
    """Yield every value of nested tables with its path; lists in one cell."""
    if isinstance(value, Mapping):
        for key, inner in value.items():
            yield from _told(f"{path}.{key}" if path else str(key), inner)
    elif isinstance(value, list | tuple):
        yield path, json.dumps(value, ensure_ascii=False, default=str)
    else:
        yield path, value
