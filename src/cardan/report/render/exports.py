"""Single pages, tables and figures of a report as files: bytes, what a browser calls them, and a name."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

from cardan.errors import refuse
from cardan.figures import SUFFIXES, Figure, drawn
from cardan.files import write_bytes
from cardan.report.block import Page, Picture, Table
from cardan.report.content import Content, Excerpt
from cardan.texts import _

from .plain import block_data, content_data, csv_of, drawn_from, figure_csv, figure_data, page_data
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

LONGEST = 80
"""Letters of a name."""


@dataclass(frozen=True, kw_only=True)
class Exported:
    """A file that is not written yet."""

    content: bytes
    media_type: str  # as in `MEDIA`
    name: str  # its name, with its ending


def kinds(thing: Thing) -> tuple[str, ...]:
    """Return the kinds of file that a thing can be exported as.

    thing: a whole report, a page of it, a table or a figure.
    """
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

    Parameters
    ----------
    thing : Content, Page, Table or Figure
        What to export.
    kind : str
        One of `kinds`: CSV and JSON hold numbers in full precision; a CSV begins with the mark of UTF-8, which
        spreadsheets look for, and has the tables of a page below each other, each under its title.
    title : str
        Name of the drive, above a page and in the name of the file.

    Raises
    ------
    InputError
        There is no such kind of it.
    MissingExtraError
        What writes it is not installed.

    Examples
    --------
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
    Raises InputError: there is no such kind of it, or the file cannot be written.
    Raises MissingExtraError: what writes it is not installed.
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
