"""A sheet of a workbook written from top to bottom like a page: words across it, tables, charts and pictures."""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from itertools import accumulate
from typing import Any

from cardan.answers.printed import framed
from cardan.figures import pixels
from cardan.figures.figure import Figure
from cardan.figures.page import laid_out
from cardan.io.workbook.book import leads_to, put, words
from cardan.io.workbook.chart_data import ChartData, Looks
from cardan.io.workbook.charts import Drawn, charts, split
from cardan.report.block import Block, Cell, Column, Listing, Picture, Points, Table, Words

NARROW, SHORT, WIDE = 9, 24, 44  # letters of the narrowest column, of a word or two and of the widest column
ACROSS = 118  # letters of a line of words, and of a page that has no wider table
MOST = 170  # letters of a page up to which words go all the way across its tables

LETTER, MARGIN, LINE = 7, 5, 21
"""Pixels of a digit, of the margin of a cell, and of a line of words: rows of no stated height, as those of 20 pixels
are written, every spreadsheet makes as high as it likes."""

PAPER = (10.69 * 96.0, 6.6 * 96.0)  # pixels of a printed page within its margins, in natural size
INCH, DPI = 100.0, 150.0  # pixels of a sheet, and of a picture, for an inch of print
WIDEST_CHART = 900.0  # Pixels
TOP = 6.0 * LINE  # pixels of a printed page that are no reason to begin another one: a title and what it comes to
HIGHEST_ROW = 545.0  # Pixels
LOGO = (240.0, 64.0)  # pixels across and down that a logo is no larger than
SQUEEZED = 0.72  # share of its height to which a picture or a chart shrinks to stay on a page with what is above it


HEAD: dict[str, Any] = {"bold": True, "text_wrap": True, "valign": "bottom", "bottom": 1, "bg_color": "#eef1f5"}
"""Looks of the heading of a column."""


class Paper:
    """Writes blocks below each other.

    sheet: an empty one; looks: formats of the workbook.
    tables: all that will stand on it: they settle how wide its columns are; data: takes the numbers of its charts.
    """

    def __init__(
        self, book: Any, sheet: Any, looks: Looks, tables: Sequence[Table], data: ChartData | None = None
    ) -> None:
        self._book, self._sheet, self._looks, self._data = book, sheet, looks, data
        self._widths = _widths(tables)
        sums = list(accumulate(self._widths))
        least = next(k for k, total in enumerate(sums, start=1) if total >= ACROSS)
        self._span = len(sums) if sums[-1] <= MOST else least
        self._letters = sums[self._span - 1]
        self.row = 0
        self._title = ""
        for column, width in enumerate(self._widths):
            sheet.set_column(column, column, width)
        sheet.hide_gridlines(2)
        self._page = PAPER[1] * max(1.0, (LETTER * sums[-1] + MARGIN * len(sums)) / PAPER[0])
        self._below = 0.0
        self._breaks: list[int] = []

    @property
    def width(self) -> float:
        """Of a line of words, in pixels."""
        return float(LETTER * self._letters + MARGIN * self._span)

    def close(self) -> None:
        """Tell where printed pages should begin; a spreadsheet that does not ask may cut pictures."""
        self._sheet.set_h_pagebreaks(self._breaks)

    def keep(self, pixels: float) -> None:
        """Begin a new page of print where what follows has no room on this one."""
        if self._below > TOP and self._below + pixels > self._page:
            self._breaks.append(self.row)
            self._below = 0.0

    def _next(self, pixels: float = LINE) -> None:
        """Go to the next row, this one being so high; it begins a printed page where it has no room on the last."""
        self._sheet.set_row_pixels(self.row, pixels)
        if self._below + pixels > self._page:
            self._breaks.append(self.row)
            self._below = 0.0
        self.row += 1
        self._below += pixels

    def _high(self, wanted: float, words: float) -> float:
        """Return how high a picture becomes, with room for words about it: lower if it then stays on this page."""
        room = math.floor(self._page - self._below - words)
        if self._below <= TOP or SQUEEZED * wanted <= room:
            return min(wanted, room)
        return min(wanted, self._page - words)

    def head(self, title: str, answer: str, others: Sequence[str] = ()) -> None:
        """Write what stands still at the top: the title, the answer and what leads to other sheets."""
        self._title = title
        self.line(title, bold=True, font_size=16, color="accent")
        if answer:
            self.line(answer, font_size=12, color="ink")
        for column, name in enumerate(others):
            leads_to(self._sheet, self.row, column, f"→ {name}", name, self._looks(font_size=9, color="accent"))
        if others:
            self._next()
        self._sheet.freeze_panes(self.row, 0)
        if not others:
            self.space()

    def line(self, text: str, **how: Any) -> None:
        """Write words across the page, as many lines high as they need."""
        form = self._looks(text_wrap=True, **how)
        high = self._high_of(text, self._letters, float(how.get("font_size", 11)))
        self._sheet.merge_range(self.row, 0, self.row, self._span - 1, "", form)
        put(self._sheet, self.row, 0, text, form)
        self._next(high)

    def entry(self, title: str, text: str, sheet: str) -> None:
        """Write a line of contents: the title leads to a sheet, words lie beside it."""
        leads_to(self._sheet, self.row, 0, title, sheet, self._looks(color="accent", underline=1, text_wrap=True))
        form = self._looks(text_wrap=True, indent=1)
        if self._span > 2:
            self._sheet.merge_range(self.row, 1, self.row, self._span - 1, "", form)
        put(self._sheet, self.row, 1, text, form)
        first = self._widths[0]
        self._next(max(self._high_of(title, first), self._high_of(text, self._letters - first - 1)))

    @staticmethod
    def _high_of(text: str, letters: float, size: float = 11.0) -> float:
        """Return the height of a row with words across so many letters."""
        count = lines(text, letters * 11.0 / size)
        return min(HIGHEST_ROW, count * LINE * max(1.0, size / 11.0) + (4.0 if count > 1 else 2.0))

    def space(self) -> None:
        """Leave a row free."""
        self._next()

    def block(self, block: Block) -> None:
        """Write a block and leave a row free; a listing has a sheet of its own."""
        if isinstance(block, Table):
            self._table(block)
        elif isinstance(block, Words):
            self._words(block)
        elif isinstance(block, Points):
            self.keep(LINE * 4)
            self.heading(block.title)
            for item in block.items:
                self.line(f"• {item}")
        elif isinstance(block, Picture):
            self._picture(block.figure)
        elif isinstance(block, Listing):
            return
        self.space()

    def remark(self, remark: Words) -> None:
        """Write words in the colour of their tone, with its sign."""
        self.line(f"{remark.sign}  {remark.text}", tone=remark.tone, bold=True)

    def heading(self, text: str) -> None:
        """Write a heading, unless it is that of the sheet."""
        if text and text != self._title:
            put(self._sheet, self.row, 0, text, self._looks(bold=True, font_size=12, color="ink"))
            self._next()

    def _words(self, block: Words) -> None:
        if block.tone != "plain":
            self.line(f"{block.sign}  {block.text}", tone=block.tone)
            return
        self.keep(LINE + self._high_of(block.text, self._letters))
        self.heading(block.title)
        self.line(block.text)

    def _table(self, table: Table) -> None:
        high = LINE * self._lines_of(table, [headed(column) for column in table.columns], 0)
        rows = [LINE * self._lines_of(table, [cell.text for cell in row]) for row in table.rows]
        whole = LINE * 2 + high + sum(rows)
        self.keep(whole if whole < self._page else LINE + high + sum(rows[:3]))
        self.heading(table.title)
        for k, column in enumerate(table.columns):
            self._put(table, k, headed(column), self._looks(**HEAD, **_side(k, column)))
        self._next(high + 2)
        for row, tall in zip(table.rows, rows, strict=True):
            for k, (column, cell) in enumerate(zip(table.columns, row, strict=True)):
                self._cell(table, k, column, cell)
            self._next(tall)
        if table.note:
            self.line(table.note, font_size=9, color="muted")

    def _put(self, table: Table, k: int, value: object, form: Any) -> None:
        """Write into a column of a table; words at its end lie across the columns that it leaves free."""
        if _at_end(table, k) and k < len(self._widths) - 1:
            self._sheet.merge_range(self.row, k, self.row, len(self._widths) - 1, "", form)
        put(self._sheet, self.row, k, value, form)

    def _lines_of(self, table: Table, texts: Sequence[str], indent: int = 1) -> int:
        """Return how many lines high a row of a table has to be."""
        widths = list(self._widths[: len(texts)])
        if _at_end(table, len(texts) - 1):
            widths[-1] = sum(self._widths[len(texts) - 1 :])
        return max(lines(text, width - indent) for text, width in zip(texts, widths, strict=True))

    def _cell(self, table: Table, k: int, column: Column, cell: Cell) -> None:
        chip: dict[str, Any] = {"left": 5, "left_color": cell.chip, "indent": 1} if cell.chip else {}
        how: dict[str, Any] = {**_side(k, column), "valign": "vcenter", "bottom": 4, "bottom_color": "#d5dae2", **chip}
        if cell.amount is not None:
            form = framed(cell.form, f"{cell.sign} " if cell.sign else "")
            look = self._looks(tone=cell.tone, num_format=form, **how)
            put(self._sheet, self.row, k, cell.amount, look)
        else:
            text = f"{cell.sign} {cell.text}".strip()
            self._put(table, k, text, self._looks(tone=cell.tone, text_wrap=True, **how))

    def _picture(self, figure: Figure) -> None:
        native, others = split(figure)
        drawings: list[list[Drawn]] = []
        if self._data is not None:
            drawings = list(charts(self._book, self._data, figure, native, (WIDEST_CHART, self._page - 4 * LINE)))
        heights = [max(one.height for one in drawn) for drawn in drawings]
        wanted = heights[0] if heights else INCH * laid_out(figure, words=False).height
        least = max((one.least for one in drawings[0]), default=0.0) if drawings else 0.0
        filled = self._page - self._below
        about = 4 * LINE if filled - 7 * LINE < least <= filled - 4 * LINE else 7 * LINE  # its words on the next page
        first = self._high(wanted, about)
        self.keep(first + about)
        self.heading(figure.title)
        for k, drawn in enumerate(drawings):
            about = 6 * LINE if k == len(drawings) - 1 else LINE  # words follow the last one
            high = self._high(heights[k], about) if k else first
            self.keep(high + min(about, 3 * LINE))
            left = 0.0
            for one in drawn:
                one.chart.set_size({"width": one.width, "height": high})
                told = {"description": words(figure.spoken), "object_position": 2}
                self._sheet.insert_chart(self.row, 0, one.chart, {"x_offset": left, "y_offset": 4, **told})
                left += one.width
            self._down(high)
        if others is not None:
            self.image(others)
        if figure.sentence:
            self.line(figure.sentence)
        self.line(figure.source, font_size=9, color="muted")

    def image(self, figure: Figure, *, most: float = math.inf) -> None:
        """Insert a picture of a figure, without its words, at most so many pixels high."""
        page = laid_out(figure, words=False)
        high = self._high(min(most, INCH * page.height), 6 * LINE)
        self.keep(high + 3 * LINE)
        stream = io.BytesIO()
        pixels().render(figure, stream, "png", dpi=DPI, words=False)
        scale = high / page.height / 96.0
        options = {
            "image_data": stream,
            "x_scale": scale,
            "y_scale": scale,
            "y_offset": 4,
            "object_position": 2,
            "description": words(figure.spoken),
        }
        self._sheet.insert_image(self.row, 0, f"{figure.name}.png", options)
        self._down(high)

    def logo(self, png: bytes, name: str) -> None:
        """Insert a logo, as high as a few lines."""
        across, down = (int.from_bytes(png[start : start + 4], "big") for start in (16, 20))
        scale = min(LOGO[0] / across, LOGO[1] / down)
        options = {
            "image_data": io.BytesIO(png),
            "x_scale": scale,
            "y_scale": scale,
            "y_offset": 4,
            "object_position": 2,
        }
        self._sheet.insert_image(self.row, 0, "logo.png", {**options, "description": name})
        self._down(scale * down)

    def _down(self, pixels: float) -> None:
        """Go below what is so high."""
        for _row in range(math.ceil((pixels + 10.0) / LINE)):
            self._next()


def headed(column: Column) -> str:
    """Return the heading of a column with its unit, which is not broken."""
    unit = column.unit.replace(" ", "\u00a0")
    return f"{column.heading} [{unit}]" if unit else column.heading


def _side(k: int, column: Column) -> dict[str, Any]:
    """Return where words and numbers stand in their cells: words away from the numbers before them."""
    return {"align": "left", "indent": int(k > 0)} if column.left else {"align": "right"}


def _widths(tables: Sequence[Table]) -> list[int]:
    """Return how wide columns have to be for tables below each other, and for words across them.

    Words at the end of a table lie across the columns that it leaves free; the last one widens where they lack room.
    """
    found: list[int] = []
    for table in tables:
        for k, column in enumerate(table.columns):
            while len(found) <= k:
                found.append(NARROW)
            if not _at_end(table, k):
                found[k] = max(found[k], _need(table, k, column))
    while sum(found) < ACROSS - WIDE:
        found.append(NARROW)
    for table in tables:
        k = len(table.columns) - 1
        if _at_end(table, k):
            found[-1] += max(0, _need(table, k, table.columns[k]) - sum(found[k:]))
    while sum(found) < ACROSS:
        found.append(NARROW)
    return found


def _at_end(table: Table, k: int) -> bool:
    """Tell whether a column is the last one of a table and holds words, more than one or two."""
    return k == len(table.columns) - 1 and table.columns[k].left and _need(table, k, table.columns[k]) > SHORT


def _need(table: Table, k: int, column: Column) -> int:
    """Return the letters that a column needs."""
    heads = max((len(word) for word in headed(column).split(" ")), default=0) + 1
    heads = max(heads, len(headed(column)) // 3 + 1)
    cells = (len(row[k].text) + 2 * bool(row[k].sign) for row in table.rows)
    return min(max(heads, *cells, 0) + 2, WIDE)


# How wide words are in the letters of a spreadsheet, and how many lines they take in a column.

DIGIT = 507.0
"""Width of a digit in the usual letters of spreadsheets (Calibri), thousandths of their size; so are all below."""

BROADEST = 560.0  # width of a letter that is not listed, about: those of other alphabets, bold ones
SPARE = 1.05  # what words may be wider than told: bold letters, other fonts

WIDTHS: dict[str, float] = {
    letter: width
    for width, letters in (
        (230.0, " ijlI'|.,:;\u00a0"),
        (180.0, "\u202f"),
        (310.0, '()[]{}f-!·‧°"²³⁻¹⁰⁴⁵⁶⁷⁸⁹₁₂₃₄₅₆₇₈₉'),
        (345.0, "rt"),
        (395.0, "csz/\\"),
        (430.0, "vxkyJL"),
        (480.0, "aegFEST?"),
        (DIGIT, "0123456789+−=<>≤≥±–_$#~"),
        (530.0, "bdhnopquBPRXKYZC"),
        (630.0, "ADGHNOQUV&"),
        (720.0, "w%@"),
        (860.0, "mMW—✓✖▲○→"),
    )
    for letter in letters
}


def breadth(text: str) -> float:
    """Return how many digits are as wide as a text."""
    return sum(WIDTHS.get(letter, BROADEST) for letter in text) / DIGIT


def lines(text: str, digits: float) -> int:
    """Return how many lines words take in a column as wide as so many digits.

    text: the words, which break at blanks; digits: width of the column.
    """
    room = max(digits, 1.0) / SPARE
    count = 0
    for part in text.splitlines() or [""]:
        count, filled = count + 1, 0.0
        for word in part.split(" "):
            wide = breadth(word)
            if filled and filled + breadth(" ") + wide > room:
                count, filled = count + 1, 0.0
            filled += wide + (breadth(" ") if filled else 0.0)
            if filled > room:  # it is cut where the column ends
                over = math.ceil(filled / room) - 1
                count, filled = count + over, filled - over * room
    return count
