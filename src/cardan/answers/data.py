"""Answers for programs: one tree of plain values for JSON, rows for CSV; keys carry the units of the reader."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np

from .answer import Answer, Column, Table, bare, words_of
from .quantity import Quantity, told
from .reader import Reader

BUFFER = 1 << 16  # letters of CSV that are written at once


def data(answer: Answer, reader: Reader) -> dict[str, Any]:
    """Return an answer as mappings, lists and numbers in full precision.

    reader: whose units the keys carry; the decimal sign is for people.
    Returns: sentence, facts, tables under their names, remarks.
    """
    whole = answer.full() if answer.full else ()
    tables = [*answer.tables, *([whole] if isinstance(whole, Table) else ())]
    return {
        "question": answer.name,
        "answer": told(answer.sentence, reader),
        **tree(answer.facts, reader),
        **{table.name: of_table(table, reader) for table in tables if table.name},
        "remarks": [
            {"text": told(one.text, reader), "tone": one.tone, **({"code": one.code} if one.code else {})}
            for one in answer.remarks
            if one.tone != "next"
        ],
    }


def tree(facts: Mapping[str, Any], reader: Reader) -> dict[str, Any]:
    """Return facts with the unit of every quantity behind its key."""
    found = {}
    for key, value in facts.items():
        own = isinstance(value, Quantity)
        found[value.key(key, reader) if own else key] = value.number(reader) if own else _value(value, reader)
    return found


def of_table(table: Table, reader: Reader) -> Any:
    """Return a table as a list of rows where it holds records, else as lists of numbers by column."""
    columns = {column.name(reader): _numbers(column, reader) for column in table.columns if column.key}
    if not table.records:
        return columns
    return [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)]


def _value(value: Any, reader: Reader) -> Any:
    if isinstance(value, Mapping):
        return tree(value, reader)
    if isinstance(value, list | tuple):
        return [_value(one, reader) for one in value]
    return value.number(reader) if isinstance(value, Quantity) else words_of(value, reader)


def _numbers(column: Column, reader: Reader) -> list[Any]:
    """Return the values of a column in the reader's unit."""
    factor = reader.unit(column.dimension, column.unit)[1] if column.dimension else 1.0
    return [_number(bare(one), factor, reader) for one in column.listed]


def _number(value: Any, factor: float, reader: Reader) -> Any:
    if isinstance(value, Quantity):
        return value.number(reader)
    if isinstance(value, float | np.floating):
        return float(value) / factor
    if isinstance(value, list | tuple):
        return [_number(one, factor, reader) for one in value]
    return words_of(value, reader)


def as_csv(table: Table | Iterable[Table], reader: Reader) -> Iterator[str]:
    """Yield the lines of a table, or of one in pieces, as CSV: in full precision and with decimal points."""
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    for place, piece in enumerate((table,) if isinstance(table, Table) else table):
        columns = [column for column in piece.columns if column.key]
        if not place:
            writer.writerow([column.name(reader) for column in columns])
        for row in zip(*(_numbers(column, reader) for column in columns), strict=True):
            writer.writerow(["" if value is None or value != value else value for value in row])
            if buffer.tell() > BUFFER:
                yield buffer.getvalue()
                buffer.seek(0)
                buffer.truncate()
    yield buffer.getvalue()


def as_json(content: Any) -> str:
    """Return JSON in full precision, lists of numbers on one line."""
    return _indented(simple(content), "")


def _indented(value: Any, margin: str) -> str:
    inner = margin + "  "
    if isinstance(value, dict) and value:
        pairs = [f"{json.dumps(key, ensure_ascii=False)}: {_indented(one, inner)}" for key, one in value.items()]
        ends, parts = "{}", pairs
    elif isinstance(value, list) and any(isinstance(item, dict | list) for item in value):
        ends, parts = "[]", [_indented(item, inner) for item in value]
    else:
        return json.dumps(value, ensure_ascii=False, allow_nan=False)
    return ends[0] + "\n" + ",\n".join(inner + part for part in parts) + "\n" + margin + ends[1]


def simple(value: Any) -> Any:
    """Return arrays, tuples and numbers as what JSON knows; what is not a number is null, what is endless "∞"."""
    if isinstance(value, dict):
        return {str(key): simple(item) for key, item in value.items()}
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, list | tuple):
        return [simple(item) for item in value]
    if isinstance(value, complex):
        return [simple(value.real), simple(value.imag)]
    if isinstance(value, float) and not math.isfinite(value):
        return None if math.isnan(value) else "∞" if value > 0.0 else "-∞"
    if value is None or isinstance(value, str | bool | int | float):
        return value
    return str(value)
