"""Small things about SQL: names in quotes, what is not a number, what a database says when it cannot answer."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import Any

import numpy as np

from cardan.batch.work import Column, Rows
from cardan.errors import refuse
from cardan.later import later
from cardan.maths.arrays import Array
from cardan.texts import _, mark

duckdb = later("duckdb", mark("reading the table of a sweep needs duckdb: pip install 'cardan[sweep]'"))
pyarrow = later("pyarrow")

_PLAIN = re.compile(r"[A-Za-z_]\w*")
_QUOTED = r"'(?:[^']|'')*'|\"(?:[^\"]|\"\")*\""


def quoted(name: str) -> str:
    """Return a name as SQL takes it whatever signs it has.

    >>> quoted("joints[1].centre_mm[2]")
    '"joints[1].centre_mm[2]"'
    """
    return '"' + name.replace('"', '""') + '"'


def sql_names(sql: str, columns: Sequence[str]) -> str:
    """Return a question with names of columns that SQL would take for more than a name in quotes."""
    odd = sorted((name for name in columns if not _PLAIN.fullmatch(name)), key=len, reverse=True)
    if not odd:
        return sql
    known = "|".join(rf"(?<![\w.\]]){re.escape(name)}(?![\w\[])" for name in odd)
    return re.sub(f"{_QUOTED}|({known})", lambda found: quoted(found[1]) if found[1] else found[0], sql)


def condition(where: str) -> str:
    """Return the clause of a condition, nothing where there is none."""
    return f" WHERE {where}" if where else ""


def cell(column: Column) -> str:
    """Return a column with NULL for nan: SQL would take that for the greatest of all numbers."""
    name = quoted(column.name)
    return f"CASE WHEN isnan({name}) THEN NULL ELSE {name} END AS {name}" if column.role == "answer" else name


def listed(files: Sequence[str]) -> str:
    """Return names of files as a list of words."""
    return "[" + ", ".join("'" + file.replace("'", "''") + "'" for file in files) + "]"


def arrow(rows: Rows) -> Any:
    """Return rows as a table that a database reads."""
    pa = pyarrow()
    return pa.table({name: pa.array(np.asarray(column)) for name, column in rows.items()})


def filled(column: Any) -> Array:
    """Return a column with nan, or None among words, for NULL; dates and lists in words."""
    if column.dtype.kind in "mM":
        column = column.astype(f"{column.dtype.kind}8[us]").astype(object)
    if column.dtype.kind == "O":
        told = np.asarray([*map(_plain, column.tolist()), None], dtype=object)[:-1]  # so that no list becomes a table
        column = np.ma.masked_array(told, np.ma.getmaskarray(column))
    if not np.ma.isMaskedArray(column):
        return np.asarray(column)
    whole: Any = column
    if whole.dtype.kind == "O":
        return np.where(np.ma.getmaskarray(whole), None, whole.data)
    return np.asarray(whole.astype(float).filled(math.nan)) if np.any(whole.mask) else np.asarray(whole.data)


def _plain(value: Any) -> Any:
    """Return a word, a number, or anything else in words."""
    return value if value is None or isinstance(value, str | int | float) else str(value)


def only_select(connection: Any, sql: str) -> Any:
    """Return the one statement that a question is."""
    statements = connection.extract_statements(sql)
    if len(statements) != 1 or statements[0].type != duckdb().StatementType.SELECT:
        raise refuse("query", _("only one SELECT is answered; the table itself is never changed"))
    return statements[0]


def told_error(error: Exception) -> str:
    """Return what the database says, in its own words without the picture of the place."""
    lines = [line.strip() for line in str(error).splitlines() if line.strip() and set(line.strip()) != {"^"}]
    return _("it cannot be answered: {why}").format(why=" ".join(lines[:2]) or type(error).__name__)


def damage(error: Exception) -> str:
    """Return what to do about a file that cannot be read."""
    text = _("a file of it is damaged ({why}); run the sweep again into this folder: what is whole is not done again")
    return text.format(why=str(error).splitlines()[0][:200])
