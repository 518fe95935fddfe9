"""Single pages, tables and figures of a report as files: bytes, what a browser calls them, and a name."""

from __future__ import annotations

import csv
import io
import json
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias

from cardan.errors import refuse
from cardan.figures import SUFFIXES, drawn
from cardan.figures.columns import drawn_from, named, section
from cardan.figures.figure import Figure, Mesh
from cardan.files import write_bytes
from cardan.io.formats.json import plain
from cardan.report.block import Block, Cell, Page, Picture, Table
from cardan.report.content import Content, Excerpt
from cardan.texts import _

from .renderer import form_of

Thing: TypeAlias = Content | Page | Table | Figure

MEDIA = {
    "html": "text/html; charset=utf-8",
    "pdf": "application/pdf",
    "xlsx": "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet",
    "csv": "text/csv; charset=utf-8",
    "json": "application/json",
    "svg": "image/svg+xml",
    "png": "image/png",
}
"""Kind of file -> what a browser calls it."""

LONGEST = 80  # letters of a name


@dataclass(frozen=True, kw_only=True)
class Exported:
    """A file that is not written yet."""

    content: bytes
    media_type: str  # as in `MEDIA`
    name: str  # its name, with its ending


def kinds(thing: Thing) -> tuple[str, ...]:
    """Return the kinds of file that a thing can be exported as."""
    if isinstance(thing, Content):
        return ("html", "pdf", "xlsx", "json")
    if isinstance(thing, Figure):
        table = ("csv",) if any(map(drawn_from, thing.panels)) else ()
        return ("svg", "png", "pdf", "html", "xlsx", *table, "json")
    if isinstance(thing, Table):
        return ("xlsx", "csv", "json")
    table = ("csv",) if any(isinstance(block, Table) for block in thing.blocks) else ()
    return ("html", "pdf", "xlsx", *table, "json")


def exported(thing: Thing, kind: str, *, title: str = "") -> Exported:
    """Return a page, a table, a figure or a whole report as a file.

    thing: what to export.
    kind: one of `kinds`: CSV and JSON hold numbers in full precision; a CSV begins with the mark of UTF-8, which
    spreadsheets look for, and has the tables of a page below each other, each under its title.
    title: name of the drive, above a page and in the name of the file.
    Raises InputError: there is no such kind of it.
    Raises MissingExtraError: what writes it is not installed.

    >>> from cardan.report.block import Column, number
    >>> table = Table(title="Strokes", columns=[Column(heading="stroke", unit="mm")], rows=[[number("1.23", 1.2345)]])
    >>> made = exported(table, "csv", title="hitch")
    >>> made.name, made.content.decode("utf-8-sig").split()
    ('hitch-Strokes.csv', ['Strokes', 'stroke', '[mm]', '1.2345'])
    """
    known = kinds(thing)
    if kind not in known:
        raise refuse("kind", _("{kind} is none of {known}").format(kind=kind, known=", ".join(known)))
    return Exported(content=_bytes(thing, kind, title), media_type=MEDIA[kind], name=_name(thing, kind, title))


def export(thing: Thing, path: Path | str, *, title: str = "") -> Path:
    """Write a page, a table, a figure or a whole report into a file, whole or not at all.

    path: its ending says how, see `exported`; title: name of the drive, above a page.
    """
    place = Path(path)
    write_bytes(place, exported(thing, place.suffix.lower().lstrip("."), title=title).content)
    return place


def _bytes(thing: Thing, kind: str, title: str) -> bytes:
    if kind == "json":
        return (json.dumps(_data(thing), ensure_ascii=False, indent=2, allow_nan=False) + "\n").encode()
    if kind == "csv":
        return _csv(thing).encode("utf-8-sig")
    if isinstance(thing, Figure) and f".{kind}" in SUFFIXES:
        return drawn(thing, f".{kind}")
    form = form_of(Path(f"report.{kind}"))
    if isinstance(thing, Content):
        return form.written(thing)
    return form.excerpt(Excerpt(title=title, page=_page(thing)))


def _data(thing: Thing) -> object:
    if isinstance(thing, Content):
        return content_data(thing)
    if isinstance(thing, Page):
        return page_data(thing)
    return figure_data(thing) if isinstance(thing, Figure) else block_data(thing)


def _csv(thing: Thing) -> str:
    if isinstance(thing, Figure):
        return figure_csv(thing)
    assert not isinstance(thing, Content)  # see kinds
    return csv_of([block for block in _page(thing).blocks if isinstance(block, Table)])


def _page(thing: Page | Table | Figure) -> Page:
    """Return the page that shows nothing but this."""
    if isinstance(thing, Page):
        return thing
    block = Picture(figure=thing) if isinstance(thing, Figure) else thing
    name = thing.name if isinstance(thing, Figure) else "table"
    return Page(name=name, title=thing.title or _("Table"), answer="", blocks=[block])


def _name(thing: Thing, kind: str, title: str) -> str:
    """Return a name that every file system takes: letters of any language, figures, hyphens."""
    own = thing.title if isinstance(thing, Content | Table) else thing.name
    parts = (re.sub(r"[\W_]+", "-", part).strip("-") for part in (title, own))
    return f"{'-'.join(part for part in parts if part)[:LONGEST].strip('-') or 'cardan'}.{kind}"


# Pages, tables and figures as plain data: for programs as JSON, for spreadsheets as CSV.

BEGINNINGS = ("=", "+", "-", "@", "\t", "\r")
"""Words that begin so would be calculated by a spreadsheet that opens the file."""

ABOVE = ("judgement", "warnings", "lights", "remedies", "figures", "changes")  # parts of a report before its pages


def content_data(content: Content) -> dict[str, Any]:
    """Return a report as dicts, lists, numbers and words."""
    said: dict[str, Any] = {"title": content.title, "note": content.note, "version": content.version}
    said["date"] = content.date
    said["head"] = {"rows": dict(content.head.rows), "units": content.head.units}
    for name in ABOVE:
        part = getattr(content, name)
        said[name] = [block_data(one) for one in part] if isinstance(part, tuple) else part and block_data(part)
    for name in ("pages", "appendix"):
        said[name] = [page_data(page) for page in getattr(content, name)]
    return said


def page_data(page: Page) -> dict[str, Any]:
    """Return a page as dicts, lists, numbers and words."""
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
    return _plain_csv(
        [
            table.title,
            [named(column.heading, column.unit) for column in table.columns],
            [[_value(cell) for cell in row] for row in table.rows],
        ]
        for table in tables
    )


def _value(cell: Cell) -> float | str:
    return cell.text if cell.amount is None else cell.amount


def figure_csv(figure: Figure) -> str:
    """Return the curves and bars of a figure as one CSV: the columns of each panel under its heading."""
    return _plain_csv(section(figure, panel) for panel in figure.panels if drawn_from(panel))


def _plain_csv(sections: Any) -> str:
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
