"""Pages, tables and figures as plain data: for programs as JSON, for spreadsheets as CSV."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Sequence
from itertools import zip_longest
from typing import Any

import numpy as np

from cardan.figures.figure import Bars, Curve, Figure, Mesh, Panel, Shape
from cardan.figures.legend import called
from cardan.io.formats.json import plain
from cardan.report.block import Block, Cell, Page, Picture, Table
from cardan.report.content import Content
from cardan.texts import _

BEGINNINGS = ("=", "+", "-", "@", "\t", "\r")
"""Words that begin so would be calculated by a spreadsheet that opens the file."""

ABOVE = ("judgement", "warnings", "lights", "remedies", "figures", "changes")
"""Parts of a report before its pages."""


def content_data(content: Content) -> dict[str, Any]:
    """Return a report as dicts, lists, numbers and words."""
    said: dict[str, Any] = {"title": content.title, "note": content.note, "version": content.version}
    said["date"] = content.date
    for name in ABOVE:
        part = getattr(content, name)
        said[name] = [block_data(one) for one in part] if isinstance(part, tuple) else part and block_data(part)
    return {**said, "pages": [page_data(page) for page in content.pages]}


def page_data(page: Page) -> dict[str, Any]:
    """Return a page as dicts, lists, numbers and words.

    >>> page_data(Page(name="motion", title="Motion", answer="It turns evenly.", blocks=[]))
    {'name': 'motion', 'title': 'Motion', 'answer': 'It turns evenly.', 'blocks': []}
    """
    return {
        "name": page.name,
        "title": page.title,
        "answer": page.answer,
        "blocks": [block_data(block) for block in page.blocks],
    }


def block_data(block: Block) -> dict[str, Any]:
    """Return a block with its kind: table, words, points, listing or picture."""
    if isinstance(block, Table):
        return table_data(block)
    if isinstance(block, Picture):
        return figure_data(block.figure)
    return {"kind": type(block).__name__.lower(), **plain(block)}


def table_data(table: Table) -> dict[str, Any]:
    """Return a table: every cell with its text, its number in full where it is one, and its tone."""
    return {
        "kind": "table",
        "title": table.title,
        "note": table.note,
        "columns": [{"heading": one.heading, "unit": one.unit} for one in table.columns],
        "rows": [[_cell(cell) for cell in row] for row in table.rows],
    }


def _cell(cell: Cell) -> dict[str, Any]:
    return {"text": cell.text, "value": cell.amount, "tone": cell.tone}


def figure_data(figure: Figure) -> dict[str, Any]:
    """Return a figure: its words, and of every panel the axes with their units and the series; no bodies in space."""
    return {
        "kind": "picture",
        "name": figure.name,
        "title": figure.title,
        "sentence": figure.sentence,
        "source": figure.source,
        "panels": [
            {
                "title": panel.title,
                "x": plain(panel.x),
                "y": plain(panel.y),
                "series": [
                    {"kind": type(one).__name__.lower(), **plain(one)}
                    for one in panel.series
                    if not isinstance(one, Mesh)
                ],
            }
            for panel in figure.panels
        ],
    }


def csv_of(tables: Sequence[Table]) -> str:
    """Return tables as one CSV: each under its title, a free line between them, numbers in full precision.

    >>> from cardan.report.block import Column, number, words
    >>> columns = (Column(heading="what", left=True), Column(heading="stroke", unit="mm"))
    >>> print(csv_of([Table(title="Splines", columns=columns, rows=[[words("=1+1"), number("1.23", 1.2345)]])]))
    Splines
    what,stroke [mm]
    '=1+1,1.2345
    <BLANKLINE>
    """
    return _csv(
        [
            table.title,
            [_named(column.heading, column.unit) for column in table.columns],
            [[_value(cell) for cell in row] for row in table.rows],
        ]
        for table in tables
    )


def _value(cell: Cell) -> float | str:
    return cell.text if cell.amount is None else cell.amount


def figure_csv(figure: Figure) -> str:
    """Return the curves and bars of a figure as one CSV: the columns of each panel under its heading."""
    return _csv(_section(figure, panel) for panel in figure.panels if drawn_from(panel))


def drawn_from(panel: Panel) -> bool:
    """Tell whether a panel has curves, bars or areas that a table can hold."""
    return any(isinstance(one, Curve | Bars | Shape) for one in panel.series)


def _section(figure: Figure, panel: Panel) -> list[Any]:
    columns: dict[tuple[str, bytes], list[Any]] = {}
    panel = called(figure, panel)
    for name, values in (column for one in panel.series for column in _columns(panel, one)):
        columns.setdefault((name, str(values).encode()), values)
    names = [name for name, _values in columns]
    return [panel.heading or figure.title, names, list(zip_longest(*columns.values(), fillvalue=""))]


def _columns(panel: Panel, one: object) -> Iterator[tuple[str, list[Any]]]:
    if isinstance(one, Curve | Shape):
        yield _named(panel.x.label or "x", panel.x.unit), _numbers(one.x)
        name = one.label or (one.text if isinstance(one, Curve) else "") or panel.y.label or "y"
        yield _named(name, panel.y.unit), _numbers(one.y)
        if isinstance(one, Curve) and one.z is not None:
            yield "z", _numbers(one.z)
    elif isinstance(one, Bars):
        upon, along = (panel.y, panel.x) if one.lying else (panel.x, panel.y)
        ticks = np.asarray(upon.ticks, dtype=float)
        if len(upon.texts):
            yield upon.label or _("what"), [upon.texts[int(np.argmin(np.abs(ticks - float(at))))] for at in one.at]
        else:
            yield _named(upon.label or "x", upon.unit), _numbers(one.at)
        yield _named(one.label or along.label or panel.heading, along.unit), _numbers(one.size)


def _named(name: str, unit: str) -> str:
    return f"{name} [{unit}]" if unit else name


def _numbers(values: Any) -> list[Any]:
    return [value if np.isfinite(value) else "" for value in np.asarray(values, dtype=float).tolist()]


def _csv(sections: Any) -> str:
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    for count, (title, heads, rows) in enumerate(sections):
        if count:
            writer.writerow([])
        if title:
            writer.writerow([_safe(title)])
        writer.writerow([_safe(head) for head in heads])
        writer.writerows([_safe(value) for value in row] for row in rows)
    return stream.getvalue()


def _safe(value: float | str) -> str:
    """Return a cell of a CSV; words that a spreadsheet would calculate begin with an apostrophe."""
    if isinstance(value, str):
        return f"'{value}" if value.startswith(BEGINNINGS) else value
    return repr(float(value))
