"""``cardan catalogue``: what the catalogue knows, where it is from, and whether a file of rows is right."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cardan.answers.answer import Answer
from cardan.catalogue.answer import (
    answer,
    answer_of_file,
    answer_of_keys,
    answer_of_row,
    answer_of_search,
    answer_of_table,
)
from cardan.catalogue.catalogue import Catalogue, found, with_files
from cardan.catalogue.catalogue import catalogue as shipped
from cardan.catalogue.rows import TABLES, Grade, Row
from cardan.cli.shared.failure import about
from cardan.cli.shared.options import argument, flag, option
from cardan.cli.shared.output import check_common
from cardan.cli.shared.source import AsCsv, AsJson, MoreRows
from cardan.cli.shared.tell import tell
from cardan.errors import InputError, refuse
from cardan.texts import _
from cardan.units import nearest


def catalogue(
    table: Annotated[str | None, argument("[TABLE]", _("A table, or a word to look for in all of them."))] = None,
    row: Annotated[
        str | None, argument("[ID]", _("A row of the table by any of its names, or a word in its rows."))
    ] = None,
    checked: Annotated[
        Path | None,
        option("--check", "FILE", _("Check your own catalogue file (TOML, CSV, XLSX), every problem at once.")),
    ] = None,
    keys: Annotated[bool, flag("--keys", _("List the keys that a row of the table can have."))] = False,
    more: MoreRows = None,
    json: AsJson = False,
    csv: AsCsv = False,
) -> int:
    """Show the tables of the catalogue, their rows, and each row with its source and how sure it is."""
    check_common(json=json, csv=csv)
    return tell(_asked(table, row, checked, tuple(more or ()), keys=keys), json=json, csv=csv)


def _asked(table: str | None, row: str | None, checked: Path | None, files: tuple[Path, ...], *, keys: bool) -> Answer:
    """Return what was asked for."""
    if checked is not None:
        return answer_of_file(checked, _right(checked))
    known = with_files(shipped(), files) if files else shipped()
    if table is None:
        return answer(known)
    if table not in TABLES and not keys:
        hits = found(known, f"{table} {row or ''}")
        if hits:
            return answer_of_search(known, f"{table} {row or ''}".strip(), hits)
    name = _named(table)
    if keys:
        return answer_of_keys(name)
    if row is None:
        return answer_of_table(known, name)
    hits = {} if row in known.table(name, TABLES[name]) or TABLES[name] is Grade else found(known, row, name)
    return answer_of_search(known, row, hits) if hits else answer_of_row(known, name, _row(known, name, row))


def _named(table: str) -> str:
    """Return the name of a table, or refuse with the nearest."""
    if table in TABLES:
        return table
    near = nearest(table, TABLES)
    text = _("{table} is not a table; the tables are {known}").format(table=repr(table), known=", ".join(TABLES))
    raise refuse("TABLE", text + (_("; the nearest is {near}").format(near=near) if near else ""))


def _row(known: Catalogue, name: str, wanted: str) -> Row:
    """Return a row of a table, a material by any of its names, or refuse with the nearest."""
    rows = known.table(name, TABLES[name])
    if TABLES[name] is Grade:
        return known.grade(wanted, field="ID")
    if wanted in rows:
        return rows[wanted]
    near = nearest(wanted, rows)
    text = _("{name} is not in {table}").format(name=repr(wanted), table=name)
    raise refuse("ID", text + (_("; the nearest is {near}").format(near=near) if near else ""))


def _right(path: Path) -> Catalogue:
    """Return the rows of a file, or refuse with everything that is wrong with them."""
    with about(str(path)):
        try:
            return with_files(Catalogue(tables={}), [path])
        except InputError as error:
            raise error.renamed(lambda field: field.removeprefix(f"{path}: ").removeprefix(f"{path}.")) from error
