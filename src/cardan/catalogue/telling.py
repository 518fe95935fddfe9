"""Rows as a catalogue file has them and in the language spoken here, and the keys that a row can have."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import is_dataclass, replace
from types import MappingProxyType
from typing import Any, NamedTuple, TypeVar

from cardan.drive.fields.keys import NAMED
from cardan.reading.fields import fields_of
from cardan.texts import _

from .rows import TABLES, Row

R = TypeVar("R", bound=Row)

SENTENCES = ("source", "note", "name", "family", "treatment", "lubricant", "fault", "inspection", "repair")
"""Fields of rows that people read and no program compares."""

WORDS = ("parts", "uses")
"""Fields of rows with a list of such words; rows keep them as they are, for they are compared."""


USUAL: Mapping[str, str] = MappingProxyType({})
"""No other units than those we write."""


class RowKey(NamedTuple):
    """A key of a row."""

    key: str
    """With its unit; inside an inner table after a point."""
    needed: bool
    meaning: str
    dimension: str = ""
    """Of its unit; empty where it has none."""


def row_keys(table: str) -> Iterator[RowKey]:
    """Yield the keys that a row of a table can have, those of inner tables after their own.

    table: one of `TABLES`.

    >>> [one.key for one in row_keys("balance_grades")]
    ['id', 'source', 'confidence', 'note', 'speed_m_s']
    """
    yield from _of_class(TABLES[table], "")


def _of_class(cls: Any, before: str) -> Iterator[RowKey]:
    for one in fields_of(cls).values():
        yield RowKey(before + one.spelling, one.required, _(one.key.doc), one.key.dimension or "")
        if is_dataclass(one.type) and one.type not in NAMED:
            yield from _of_class(one.type, f"{before}{one.spelling}.")


def told(row: R) -> R:
    """Return a row with its sentences in the language spoken here; those of a user's file stay as they are.

    >>> from cardan.catalogue import catalogue
    >>> told(catalogue().tables["faults"]["F37"]).repair
    'replace the shaft'
    """
    own = {name: getattr(row, name, "") for name in SENTENCES}
    said = {name: _(text) for name, text in own.items() if text}
    return row if all(said[name] == own[name] for name in said) else replace(row, **said)


def row_tree(row: Any, units: Mapping[str, str] = USUAL) -> dict[str, Any]:
    """Return a row as a catalogue file has it: keys with units, nothing that is not said.

    units: dimension -> unit, where it is not the usual one.
    """
    found: dict[str, Any] = {}
    for name, one in fields_of(type(row)).items():
        value = getattr(row, name)
        if value is None or value in ((), ""):
            continue
        if is_dataclass(value) and not isinstance(value, type):
            named = getattr(value, NAMED[type(value)]) if type(value) in NAMED else ""
            found[one.spelling] = named or row_tree(value, units)
        else:
            dimension = one.key.dimension or ""
            spelling = f"{name}_{units[dimension]}" if dimension in units else one.spelling
            found[spelling] = _in_unit(value, one.spellings[spelling])
    return found


def row_flat(row: Row, units: Mapping[str, str] = USUAL) -> dict[str, Any]:
    """Return a row with its inner tables spread out, as ``rating.torque_Nm``; lists as text.

    units: as of `row_tree`.
    """
    return dict(_spread(row_tree(row, units), ""))


def _spread(tree: Mapping[str, Any], before: str) -> Iterator[tuple[str, Any]]:
    for key, value in tree.items():
        if isinstance(value, Mapping):
            yield from _spread(value, f"{before}{key}.")
        else:
            said = _ if key in WORDS else _said
            yield before + key, ", ".join(map(said, value)) if isinstance(value, list) else value


def _said(value: Any) -> str:
    return f"{value:.10g}" if isinstance(value, float) else str(value)


def _in_unit(value: Any, factor: float) -> Any:
    if isinstance(value, tuple):
        return [_in_unit(item, factor) for item in value]
    if isinstance(value, float):
        return float(f"{value / factor:.12g}")
    return value
