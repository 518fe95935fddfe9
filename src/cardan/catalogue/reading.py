"""From the tables of a catalogue file to rows, every problem at once."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from cardan.drive.fields.keys import NAMED, spelled
from cardan.errors import Problem
from cardan.reading.scalar import nearest_of
from cardan.reading.tree import Form, read_table
from cardan.texts import _

from .rows import TABLES, Row

FORM = Form(spelled=spelled, named=NAMED)


def rows_of(tree: Mapping[str, Any]) -> tuple[dict[str, dict[str, Row]], list[Problem]]:
    """Return the rows of the tables of a file by table and id, and all that is wrong with it."""
    found: dict[str, dict[str, Row]] = {}
    problems: list[Problem] = []
    for name, rows in tree.items():
        if name not in TABLES:
            text = _("unknown table; the tables are {known}").format(known=", ".join(TABLES))
            problems.append(Problem(name, text + nearest_of(name, TABLES)))
        elif not isinstance(rows, list) or not all(isinstance(row, Mapping) for row in rows):
            problems.append(Problem(name, _("must be tables, each under [[{key}]]").format(key=name)))
        else:
            found[name] = {}
            for k, table in enumerate(rows):
                row, wrong = read_table(TABLES[name], table, FORM, f"{name}[{k}]")
                empty = [key for key in ("id", "source") if isinstance(table.get(key), str) and not table[key].strip()]
                wrong += [Problem(f"{name}[{k}].{key}", _("must not be empty")) for key in empty]
                problems += wrong
                if wrong:
                    continue
                if row.id in found[name]:
                    problems.append(Problem(f"{name}[{k}].id", _("{id} stands twice").format(id=row.id)))
                found[name][row.id] = row
    return found, problems
