"""Tables as they are printed for one reader: every cell in words, beside the number it shows.

This is what the renderers write: terminal, HTML, PDF, workbook, app. Nothing reads a number out of the words again.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from cardan.texts import _
from cardan.units import spoken

from . import answer
from .answer import Depth, Tone
from .quantity import Quantity, told
from .reader import Reader, spreadsheet

SIGNS: dict[Tone, str] = {"plain": "○", "good": "✓", "warning": "▲", "failed": "✖", "next": "→"}
"""Every tone by a sign too, never by colour alone."""

SHOWN: dict[Depth, tuple[Depth, ...]] = {
    "brief": ("brief",),
    "full": ("brief", "full"),
    "data": ("brief", "full", "data"),
}
"""How deep a renderer goes -> which parts it shows."""


@dataclass(frozen=True, kw_only=True)
class Cell:
    """A cell as it is printed."""

    text: str
    tone: Tone = "plain"  # how good that is
    full: str = ""  # the number in full precision, for whoever points at it
    chip: str = ""  # colour of a chip before the text
    # the same in Typst's notation of mathematics, where it is an equation; never anything a user wrote
    formula: str = ""
    amount: float | None = None  # the number it shows, in the unit it is shown in
    form: str = ""  # number format of spreadsheets

    @property
    def sign(self) -> str:
        """Sign of the tone; none for plain words."""
        return "" if self.tone == "plain" else SIGNS[self.tone]


@dataclass(frozen=True, kw_only=True)
class Column:
    """The head of a column as it is printed: heading and unit, both in the language spoken here."""

    heading: str
    unit: str = ""
    left: bool = False
    wrap: bool = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "unit", spoken(self.unit))


@dataclass(frozen=True, kw_only=True)
class Table:
    """A table as it is printed, with a line of words above it and one below."""

    columns: Sequence[Column]
    rows: Sequence[Sequence[Cell]]
    title: str = ""
    note: str = ""
    fixed: int = 1


def printed(table: answer.Table, reader: Reader, depth: Depth = "full") -> Table:
    """Return a table as a reader sees it. table: quantities in SI; reader: units and decimal sign."""
    columns = [one for one in table.columns if one.depth in SHOWN[depth]]
    cells = [[cell(value, column, reader) for value in column.listed] for column in columns]
    rows = [list(row) for row in zip(*cells, strict=True)]
    if table.tones:
        rows = [[replace(row[0], tone=tone), *row[1:]] for row, tone in zip(rows, table.tones, strict=True)]
    return Table(
        columns=[
            Column(heading=told(one.heading, reader), unit=one.label(reader), left=one.words, wrap=one.wrap)
            for one in columns
        ],
        rows=rows,
        title=table.title,
        note=told(table.note, reader),
        fixed=table.fixed,
    )


def cell(value: answer.Value, column: answer.Column, reader: Reader) -> Cell:
    """Return one value as it is printed in a column."""
    if isinstance(value, answer.Cell):
        bare = isinstance(value.value, Quantity) and not value.unit
        inner = number(value.value, reader, unit=False) if bare else cell(value.value, column, reader)
        return Cell(
            text=value.before + inner.text + value.after,
            tone=value.tone,
            full=inner.full,
            chip=value.chip,
            formula=value.formula,
            amount=inner.amount,
            form=framed(inner.form, value.before, value.after),
        )
    if value is None:
        return Cell(text="–")
    if isinstance(value, bool | np.bool_):
        return Cell(text=_("yes") if value else _("no"))
    if isinstance(value, int | np.integer):
        return Cell(text=str(value).replace("-", "−"), full=str(value), amount=float(value), form="0")
    if isinstance(value, float | np.floating):
        return number(column.quantity(float(value)), reader, unit=False)
    if isinstance(value, Quantity):
        return number(value, reader, unit=value.dimension != column.dimension)
    return Cell(text=told(value, reader))


def number(quantity: Quantity, reader: Reader, *, unit: bool = True) -> Cell:
    """Return a quantity as a cell, with its unit behind it where no column names it."""
    shown = quantity.shown(reader)
    amount = float(quantity.number(reader))
    if not math.isfinite(amount):
        return Cell(text=shown.number)
    decimals = reader.decimals(quantity.decimals, quantity.dimension, quantity.unit)
    form = spreadsheet(amount, quantity.digits, decimals)
    if unit and shown.unit:
        form += f'" {shown.unit}"'
    return Cell(text=str(shown) if unit else shown.number, full=repr(amount), amount=amount, form=form)


def framed(form: str, before: str, after: str = "") -> str:
    """Return a number format of spreadsheets with signs around the number."""
    return "".join((f'"{before}"' if before else "", form, f'"{after}"' if after else "")) if form else ""
