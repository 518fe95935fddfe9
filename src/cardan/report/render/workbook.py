"""The report as a workbook: a sheet a page, charts of the spreadsheet's own, and the numbers they are drawn from."""

from __future__ import annotations

import datetime
import io
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from cardan.io.workbook.book import MOST_LETTERS, opened, put, sheet_name, unstretched, words
from cardan.io.workbook.chart_data import CODE, ChartData, Looks
from cardan.io.workbook.charts import split
from cardan.report.block import Listing, Page, Picture, Table
from cardan.report.content import Content, Excerpt
from cardan.report.look import HEAD, Line, Look
from cardan.texts import _

from .sheet import LINE, Paper
from .typeset import pixels_of

SKETCH = 260.0  # pixels of the drive on the first page, from top to bottom
HEADER = 90  # letters of the drive's name above a printed page


def written(content: Content) -> bytes:
    """Return a report as a workbook."""
    stream = io.BytesIO()
    book = opened(stream, title=content.title, made=datetime.date.fromisoformat(content.date))
    foot = f"cardan {content.version} · {content.date}"
    sheets = Sheets(book, content.title, foot, content)
    summary = sheets.new(_("Summary"))
    names = [sheets.page(page) for page in (*content.pages, *content.appendix)]
    _summary(Paper(book, summary, sheets.looks, _tables_of(content)), content, names)
    sheets.fill(summary.get_name())
    book.close()
    return unstretched(stream.getvalue())


def excerpt(part: Excerpt) -> bytes:
    """Return a page of a report as a workbook."""
    stream = io.BytesIO()
    book = opened(stream, title=part.title or part.page.title, made=datetime.date.fromisoformat(part.date))
    sheets = Sheets(book, part.title, f"cardan {part.version} · {part.date}")
    sheets.page(part.page)
    sheets.fill()
    book.close()
    return unstretched(stream.getvalue())


class Sheets:
    """The sheets of a workbook: pages first, files as they stand next, the numbers of charts last.

    title: above every printed page; foot: below it.
    """

    def __init__(self, book: Any, title: str, foot: str, content: Content | None = None) -> None:
        look = Look() if content is None else content.look
        self.looks = Looks(book, look.colours.changed())
        self._book, self._title, self._foot = book, title, foot
        self._letter = look.paper == "us-letter"
        self._own_head = "" if content is None or look.head == HEAD else _line(content.words_for(look.head))
        self._own_foot = "" if content is None or look.foot == Line() else _line(content.words_for(look.foot))
        self._taken: set[str] = set()
        self._pages: list[tuple[Page, Any]] = []

    def new(self, title: str, *, ending: str = "", colour: str = "") -> Any:
        """Return an empty sheet, ready to be printed."""
        sheet = self._book.add_worksheet(sheet_name(title, self._taken, ending=ending))
        sheet.set_landscape()
        sheet.set_paper(1 if self._letter else 9)
        sheet.fit_to_pages(1, 0)
        sheet.ignore_errors({"number_stored_as_text": "A1:XFD1048576"})  # numbers of shafts, lines of a file
        sheet.set_margins(left=0.5, right=0.5, top=0.75, bottom=0.75)
        sheet.set_header(self._own_head or f"&L {_printed(self._title)}&R {_printed(title)}{_printed(ending)}")
        sheet.set_footer(self._own_foot or f"&L {_printed(self._foot)}&R&P / &N")
        if colour:
            sheet.set_tab_color(colour)
        return sheet

    def page(self, page: Page) -> str:
        """Make the sheet of a page, and return its name; `fill` writes it."""
        sheet = self.new(page.title)
        self._pages.append((page, sheet))
        name: str = sheet.get_name()
        return name

    def fill(self, *home: str) -> None:
        """Write all pages, with the sheets that they need; they lead back to the sheets named."""
        for page, _sheet in self._pages:
            for listing in (one for one in page.blocks if isinstance(one, Listing)):
                _listed(self.new(listing.title), listing, self.looks)
        for page, sheet in self._pages:
            native = any(split(one.figure)[0] for one in page.blocks if isinstance(one, Picture))
            data = None
            if native:
                ending = " " + _("data")
                data = ChartData(self.new(page.title, ending=ending, colour="#9aa3b2"), self.looks, sheet.get_name())
            tables = [one for one in page.blocks if isinstance(one, Table)]
            paper = Paper(self._book, sheet, self.looks, tables, data)
            paper.head(page.title, page.answer, (*home, *((data.sheet.get_name(),) if data else ())))
            for block in page.blocks:
                paper.block(block)
            paper.close()
            if data is not None:
                data.close()


def _tables_of(content: Content) -> list[Table]:
    every = (content.lights, content.remedies, content.figures, content.changes)
    return [one for one in every if isinstance(one, Table)]


def _summary(paper: Paper, content: Content, names: Sequence[str]) -> None:
    """Write the first page: the judgement, what must not be overlooked, limits, changes, key figures, contents."""
    paper.head(content.title, content.note)
    paper.line(f"cardan {content.version} · {content.date}", font_size=9, color="muted")
    if content.head.logo is not None:
        paper.logo(pixels_of(content.head.logo), _("Logo"))
    for name, told in content.head.rows:
        paper.line(f"{name}: {told}")
    if content.head.units:
        paper.line(content.head.units, font_size=9, color="muted")
    paper.remark(content.judgement)
    for one in content.warnings:
        paper.remark(one)
    paper.space()
    for block in (content.lights, content.remedies):
        if block is not None:
            paper.block(block)
    paper.image(content.sketch, most=SKETCH)
    paper.space()
    figures = content.figures
    paper.block(figures if figures.title else replace(figures, title=_("Key figures")))
    paper.block(content.changes)
    paper.keep(1.5 * LINE * (1 + len(names)))
    paper.heading(_("Contents"))
    for k, (page, name) in enumerate(zip((*content.pages, *content.appendix), names, strict=True)):
        if k == len(content.pages):
            paper.heading(_("Appendix"))
        paper.entry(page.title, page.answer, name)
    paper.close()


def _listed(sheet: Any, listing: Listing, looks: Looks) -> None:
    """Write a text line by line, each in a cell."""
    look = looks(font_name=CODE, font_size=10)
    put(sheet, 0, 0, listing.title, looks(bold=True, font_size=16, color="accent"))
    sheet.freeze_panes(1, 0)
    sheet.set_column(0, 0, 120)
    row = 1
    for line in listing.text.splitlines():
        for start in range(0, len(line) or 1, MOST_LETTERS):
            put(sheet, row, 0, line[start : start + MOST_LETTERS], look)
            row += 1


def _line(parts: Sequence[Sequence[tuple[str, str]]]) -> str:
    """Return words at head or foot of a printed sheet: left, middle and right, with the numbers of pages."""
    codes = {"page": "&P", "pages": "&N"}
    said = ("".join(codes.get(kind) or _printed(words) for kind, words in pieces) for pieces in parts)
    return "".join(f"&{side} {one}" for side, one in zip("LCR", said, strict=True) if one)


def _printed(text: str) -> str:
    """Return words for the head or the foot of a printed page, where & begins a command."""
    return words(text)[:HEADER].replace("&", "&&")
