"""Pages, figures and whole reports in the units and with the decimal sign that a reader likes.

What is made in the usual units is converted as it is shown: tables with the unit of a column or of a row, figures with
their axes, sentences where a number stands before its unit. Files as they stand, keys and versions stay.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TypeVar, cast

from cardan.answers.quantity import TOUCHING
from cardan.drive.drive import Drive
from cardan.figures import Figure
from cardan.figures.conversion import KEY, Conversion, names_of
from cardan.figures.converted import PLAIN, converted
from cardan.texts import _
from cardan.units import spoken

from .amounts import amount
from .block import Block, Cell, Column, Listing, Page, Picture, Points, Table, Words, verdict_columns
from .content import Content

COMMA = re.compile(r"(\d),(\d)")
"""A decimal comma."""

Shown = TypeVar("Shown", Page, Figure, Content, Table, Words)


def in_choice(shown: Shown, units: Mapping[str, str], decimal: str = ".", *, names: Iterable[str] = ()) -> Shown:
    """Return a page, a figure, a table, a remark or a whole report in the units of a choice.

    Call it in the language that the page was made in, and on the page as it was made: it converts from the usual units.
    What is to be written as a workbook or as CSV keeps its point: ``decimal="."``.

    Parameters
    ----------
    shown : Page, Figure, Content, Table or Words
        As the report makes it.
    units : mapping of str to str
        Dimension -> unit, as in the keys of a drive file: ``{"length": "in"}``; all others stay.
    decimal : str
        Sign between whole and part: ``"."`` or ``","``.
    names : iterable of str
        Names that a user wrote, see `names_in`: they stay as they are within sentences.

    Returns
    -------
    same type
        The same object where there is nothing to change.

    Raises
    ------
    InputError
        There is no such dimension or unit, or the sign is none.

    Examples
    --------
    >>> in_choice(Words(text="It slides 25.4 mm."), {"length": "in"}, ",").text
    'It slides 1,000 in.'
    """
    how = Conversion(units=dict(units), decimal=decimal, names=names_of(names))
    if how.idle:
        return shown
    return cast(Shown, _chosen(shown, how))


def _chosen(shown: Page | Figure | Content | Table | Words, how: Conversion) -> object:
    if isinstance(shown, Page):
        return _page(shown, how)
    if isinstance(shown, Figure):
        return converted(shown, how)
    if isinstance(shown, Table):
        return _table(shown, how)
    if isinstance(shown, Words):
        return _words(shown, how)
    return _content(shown, how)


def with_points(page: Page) -> Page:
    """Return a page whose numbers in tables have a point again, for files that other programs read.

    Examples
    --------
    >>> table = Table(columns=[], rows=[[Cell(text="≤ 1,5")]])
    >>> with_points(Page(name="x", title="", answer="", blocks=[table])).blocks[0].rows[0][0].text
    '≤ 1.5'
    """
    return replace(page, blocks=[_pointed(one) if isinstance(one, Table) else one for one in page.blocks])


def _pointed(table: Table) -> Table:
    def cell(one: Cell) -> Cell:
        return one if any(letter.isalpha() for letter in one.text) else replace(one, text=COMMA.sub(r"\1.\2", one.text))

    return replace(table, rows=[[cell(one) for one in row] for row in table.rows])


def names_in(drive: Drive) -> tuple[str, ...]:
    """Return the names that the user gave to a drive and its parts.

    Examples
    --------
    >>> from cardan.units import deg
    >>> names_in(Drive.from_angles([20 * deg], name="Pump 300 mm"))
    ('Pump 300 mm',)
    """
    parts = (*drive.shafts, *drive.joints, *drive.supports, *drive.stations)
    return tuple(dict.fromkeys(name for name in (drive.name, *(getattr(one, "name", "") for one in parts)) if name))


def _content(old: Content, how: Conversion) -> Content:
    changes = _table(old.changes, how) if isinstance(old.changes, Table) else _words(old.changes, how)
    return replace(
        old,
        judgement=_words(old.judgement, how),
        warnings=tuple(_words(one, how) for one in old.warnings),
        lights=None if old.lights is None else _table(old.lights, how),
        cures=None if old.cures is None else _table(old.cures, how),
        sketch=converted(old.sketch, how),
        figures=_table(old.figures, how),
        changes=changes,
        pages=tuple(_page(one, how) for one in old.pages),
    )


def _page(old: Page, how: Conversion) -> Page:
    return replace(
        old,
        title=how.sentence(old.title),
        answer=how.sentence(old.answer),
        blocks=tuple(_block(one, how) for one in old.blocks),
        keys=tuple(_row(row, verdict_columns(), how) for row in old.keys),
        alarms=tuple(_words(one, how) for one in old.alarms),
    )


def _block(old: Block, how: Conversion) -> Block:
    if isinstance(old, Table):
        return _table(old, how)
    if isinstance(old, Words):
        return _words(old, how)
    if isinstance(old, Points):
        return replace(old, title=how.sentence(old.title), items=tuple(how.sentence(one) for one in old.items))
    if isinstance(old, Listing):
        return old
    assert isinstance(old, Picture)
    return replace(old, figure=converted(old.figure, how))


def _words(old: Words, how: Conversion) -> Words:
    return replace(old, text=how.sentence(old.text), title=how.sentence(old.title))


def _table(old: Table, how: Conversion) -> Table:
    columns = tuple(replace(one, heading=how.sentence(one.heading), unit=how.unit(one.unit)[0]) for one in old.columns)
    rows = tuple(_row(row, old.columns, how) for row in old.rows)
    return replace(old, columns=columns, rows=rows, title=how.sentence(old.title), note=how.sentence(old.note))


def _row(row: Sequence[Cell], columns: Sequence[Column], how: Conversion) -> list[Cell]:
    """Return a row: its numbers in the units of their columns, or of the cell that names one for the whole row."""
    if any(KEY.fullmatch(one.text) for one in row):
        return list(row)  # what stands in a file, in the units of its keys
    named = next((one.text for one, column in zip(row, columns, strict=False) if _names_unit(one, column, how)), "")
    shared = how.unit(named)[1]
    cells = []
    for cell, column in zip(row, columns, strict=False):
        if cell.formula:
            cells.append(cell)
        elif named and cell.text == named and _names_unit(cell, column, how):
            cells.append(replace(cell, text=how.unit(named)[0]))
        else:
            own = column.unit or column.heading == _("utilisation")
            cells.append(_cell(cell, column, how.unit(column.unit)[1] if own else shared, how))
    return cells


def _names_unit(cell: Cell, column: Column, how: Conversion) -> bool:
    return not column.unit and not cell.full and spoken(cell.text) in how.labels


def _cell(cell: Cell, column: Column, ratio: float, how: Conversion) -> Cell:
    found = amount(cell, column)
    full = float(cell.full) if found is not None and cell.full else None
    if found is not None or (ratio != 1.0 and not column.left and PLAIN.search(cell.text)):
        wide = cell.full if full is None or ratio == 1.0 else repr(full * ratio)
        bare = found is not None or ratio != 1.0
        if bare and not any(one.isalpha() or one in TOUCHING for one in cell.text):
            return replace(cell, text=how.number(cell.text, ratio, full if ratio != 1.0 else None), full=wide)
        return replace(cell, text=how.sentence(cell.text), full=wide)
    return replace(cell, text=how.sentence(cell.text))
