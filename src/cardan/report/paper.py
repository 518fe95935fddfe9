"""A sheet of a workbook written from top to bottom like a page: words across it, tables, charts and pictures."""

from __future__ import annotations

import io
import textwrap
from collections.abc import Sequence
from itertools import accumulate
from typing import Any

from cardan.figures import Figure
from cardan.figures.page import laid_out
from cardan.io.book import put, words

from .amounts import amount
from .block import Block, Cell, Column, Listing, Picture, Points, Table, Words
from .chart_data import ChartData
from .charts import charts, split
from .looks import Looks

NARROW, WIDE = 9, 44
"""Letters of the narrowest column and of the widest."""

ACROSS = 118
"""Letters of a line of words, and of a page that has no wider table."""

MOST = 170
"""Letters of a page up to which words go all the way across its tables."""

LETTER, MARGIN, LINE = 7, 5, 20
"""Pixels of a digit, of the margin of a cell, and of a line of words."""

DENSE = 1.12
"""Letters in the width of a digit, at the least."""

PAPER = (10.69 * 96.0, 6.6 * 96.0)
"""Pixels of a printed page within its margins, in natural size."""

INCH, DPI = 100.0, 150.0
"""Pixels of a sheet, and of a picture, for an inch of print."""

WIDEST_CHART = 900.0
"""Pixels."""


HEAD: dict[str, Any] = {"bold": True, "text_wrap": True, "valign": "bottom", "bottom": 1, "bg_color": "#eef1f5"}
"""Looks of the heading of a column."""


class Paper:
    """Writes blocks below each other.

    Parameters
    ----------
    book : workbook
    sheet : worksheet
        An empty one.
    looks : Looks
        Formats of the workbook.
    tables : sequence of Table
        All that will stand on it: they settle how wide its columns are.
    data : ChartData, optional
        Takes the numbers of its charts.
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

    def _keep(self, pixels: float) -> None:
        """Begin a new page of print where what follows has no room on this one."""
        if self._below > 6 * LINE and self._below + pixels > self._page:
            self._breaks.append(self.row)
            self._below = 0.0

    def _next(self, pixels: float = LINE) -> None:
        """Go to the next row."""
        self.row += 1
        self._below = (self._below + pixels) if self._below + pixels <= self._page else pixels

    def head(self, title: str, answer: str) -> None:
        """Write what stands still at the top: the title and the answer."""
        self._title = title
        self.line(title, bold=True, font_size=16, color="accent")
        if answer:
            self.line(answer, font_size=12, color="ink")
        self._sheet.freeze_panes(self.row, 0)
        self.space()

    def line(self, text: str, *, link: str = "", **how: Any) -> None:
        """Write words across the page, as many lines high as they need.

        Parameters
        ----------
        text : str
            The words.
        link : str
            Name of the sheet that they lead to.
        **how
            Properties of their format.
        """
        form = self._looks(text_wrap=True, **how)
        size = float(how.get("font_size", 11))
        high = float(LINE * _lines(text, self._letters * 11.0 / size)) * max(1.0, size / 11.0) + 4.0
        self._sheet.merge_range(self.row, 0, self.row, self._span - 1, "", form)
        if link:
            place = "internal:'" + link.replace("'", "''") + "'!A1"
            self._sheet.write_url(self.row, 0, place, form, words(text))
        else:
            put(self._sheet, self.row, 0, text, form)
        self._sheet.set_row_pixels(self.row, min(545.0, high))
        self._next(high)

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
            self._heading(block.title)
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

    def _heading(self, text: str) -> None:
        """Write a heading, unless it is that of the sheet."""
        if text and text != self._title:
            put(self._sheet, self.row, 0, text, self._looks(bold=True, font_size=12, color="ink"))
            self._next()

    def _words(self, block: Words) -> None:
        if block.tone != "plain":
            self.line(f"{block.sign}  {block.text}", tone=block.tone)
            return
        self._heading(block.title)
        self.line(block.text)

    def _table(self, table: Table) -> None:
        heads = [_lines(headed(column), width) for column, width in zip(table.columns, self._widths, strict=False)]
        rows = [self._lines_of(row) for row in table.rows]
        whole = LINE * (3 + max(heads) + sum(rows))
        self._keep(whole if whole < self._page else LINE * 6)
        self._heading(table.title)
        for k, column in enumerate(table.columns):
            put(self._sheet, self.row, k, headed(column), self._looks(**HEAD, **_side(k, column)))
        self._sheet.set_row_pixels(self.row, LINE * max(heads) + 2)
        self._next(LINE * max(heads))
        for row, lines in zip(table.rows, rows, strict=True):
            for k, (column, cell) in enumerate(zip(table.columns, row, strict=True)):
                self._cell(k, column, cell)
            if lines > 1:
                self._sheet.set_row_pixels(self.row, LINE * lines + 1)
            self._next(LINE * lines)
        if table.note:
            self.line(table.note, font_size=9, color="muted")

    def _lines_of(self, row: Sequence[Cell]) -> int:
        return max(_lines(cell.text, width - 2) for cell, width in zip(row, self._widths, strict=False))

    def _cell(self, k: int, column: Column, cell: Cell) -> None:
        chip = {"left": 5, "left_color": cell.chip} if cell.chip else {}
        how: dict[str, Any] = {**_side(k, column), "valign": "vcenter", "bottom": 4, "bottom_color": "#d5dae2", **chip}
        found = amount(cell, column)
        if found is not None:
            look = self._looks(tone=cell.tone, num_format=found.form, **how)
            put(self._sheet, self.row, k, found.value, look)
        else:
            text = f"{cell.sign} {cell.text}".strip()
            put(self._sheet, self.row, k, text, self._looks(tone=cell.tone, text_wrap=True, **how))

    def _picture(self, figure: Figure) -> None:
        native, others = split(figure)
        room = self._page - 8 * LINE
        drawings = []
        if self._data is not None:
            drawings = list(charts(self._book, self._data, figure, native, (WIDEST_CHART, room)))
        first = drawings[0][0].height if drawings else INCH * laid_out(figure, words=False).height
        self._keep(first + 6 * LINE)
        self._heading(figure.title)
        for k, drawn in enumerate(drawings):
            if k:
                self._keep(max(one.height for one in drawn) + 3 * LINE)
            left = 0.0
            for one in drawn:
                one.chart.set_size({"width": one.width, "height": one.height})
                told = {"description": words(f"{figure.title}. {figure.sentence}"), "object_position": 2}
                self._sheet.insert_chart(self.row, 0, one.chart, {"x_offset": left, "y_offset": 4, **told})
                left += one.width
            self._down(max(one.height for one in drawn))
        if others is not None:
            self.image(others, keep=bool(drawings))
        self.line(figure.sentence)
        self.line(figure.source, font_size=9, color="muted")

    def image(self, figure: Figure, *, keep: bool = True) -> None:
        """Insert a picture of a figure, without its words; ``keep`` it from being cut in print."""
        from cardan.figures.render_matplotlib import render

        page = laid_out(figure, words=False)
        inch = min(INCH, (self._page - 8 * LINE) / page.height)
        if keep:
            self._keep(inch * page.height + LINE)
        stream = io.BytesIO()
        render(figure, stream, "png", dpi=DPI, words=False)
        options = {
            "image_data": stream,
            "x_scale": inch / 96.0,
            "y_scale": inch / 96.0,
            "y_offset": 4,
            "object_position": 2,
            "description": words(f"{figure.title}. {figure.sentence}"),
        }
        self._sheet.insert_image(self.row, 0, f"{figure.name}.png", options)
        self._down(inch * page.height)

    def _down(self, pixels: float) -> None:
        """Go below what is so high."""
        for _row in range(int((pixels + 4.0) // LINE) + 2):
            self._next()


def headed(column: Column) -> str:
    """Return the heading of a column with its unit."""
    return f"{column.heading} [{column.unit}]" if column.unit else column.heading


def _side(k: int, column: Column) -> dict[str, Any]:
    """Return where words and numbers stand in their cells: words away from the numbers before them."""
    return {"align": "left", "indent": int(k > 0)} if column.left else {"align": "right"}


def _lines(text: str, digits: float) -> int:
    letters = max(1, int(DENSE * digits))
    return sum(max(1, len(textwrap.wrap(part, letters))) for part in text.splitlines() or [""])


def _widths(tables: Sequence[Table]) -> list[int]:
    """Return how wide columns have to be for tables below each other, and for words across them."""
    found: list[int] = []
    for table in tables:
        for k, column in enumerate(table.columns):
            need = max((len(word) for word in headed(column).split()), default=0) + 1
            for row in table.rows:
                need = max(need, len(row[k].text) + 2 * bool(row[k].sign))
            if len(found) == k:
                found.append(NARROW)
            found[k] = max(found[k], min(need + 2, WIDE))
    while sum(found) < ACROSS:
        found.append(NARROW)
    return found
