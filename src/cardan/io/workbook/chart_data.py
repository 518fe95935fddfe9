"""The sheet beside a page that holds the numbers of its charts: a column for each quantity, headed with its unit."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from cardan.answers.answer import Tone
from cardan.answers.palette import colour, mixed
from cardan.io.workbook.book import leads_to, put
from cardan.maths.arrays import Array
from cardan.texts import _

# Formats of a workbook, each made once.

PALE = 0.86  # share of white in the colour behind a tone
CODE = "Consolas"  # font of text as it stands in a file


class Looks:
    """Formats by their properties, those of XlsxWriter.

    book: where they are made; colours: those of roles that are not the usual ones.
    """

    def __init__(self, book: Any, colours: Mapping[str, str] | None = None) -> None:
        self._book, self._colours = book, colours or {}
        self._made: dict[tuple[tuple[str, object], ...], Any] = {}

    def __call__(self, *, color: str = "", tone: Tone = "plain", **properties: Any) -> Any:
        """Return the format with these properties.

        color: role of the letters' colour, see `cardan.answers.palette`.
        tone: how good what it shows is: paper and letters have its colour; **properties: properties of XlsxWriter.
        """
        wanted = {"valign": "top", **properties}
        if color:
            wanted["font_color"] = self._colours.get(color) or colour(color)
        if tone != "plain":
            wanted |= {"bg_color": mixed(colour(tone), "#ffffff", PALE), "font_color": colour(tone)}
        key = tuple(sorted(wanted.items()))
        if key not in self._made:
            self._made[key] = self._book.add_format(wanted)
        return self._made[key]


HEAD = 6  # rows above the numbers: title, what stands here, figure, panel, name, unit
WIDTH = 13  # of a column, in letters
PRINTED = 60  # rows of numbers that are printed; more are for the spreadsheet alone
BESIDE = 16  # columns that are printed
DIGITS = 6  # of the largest number of a column


@dataclass(frozen=True, kw_only=True)
class Place:
    """A column of numbers on a sheet."""

    sheet: str  # name of the sheet
    column: int  # column, count: where it is, and how many values it has
    count: int

    @property
    def name(self) -> list[Any]:
        """Cell with its name."""
        return [self.sheet, HEAD - 2, self.column]

    @property
    def values(self) -> list[Any]:
        """Range of its values."""
        return [self.sheet, HEAD, self.column, HEAD + max(self.count, 1) - 1, self.column]


class ChartData:
    """Writes columns from left to right, those of a panel side by side.

    sheet: an empty one; looks: formats of the workbook; page: name of the sheet that has the charts.
    """

    def __init__(self, sheet: Any, looks: Looks, page: str) -> None:
        self.sheet = sheet
        self._looks = looks
        self._column = self._begun = 0
        self._aside = ""
        self._known: dict[tuple[str, bytes], Place] = {}
        sheet.freeze_panes(HEAD, 0)
        sheet.set_row_pixels(HEAD - 2, 64)
        put(sheet, 0, 0, sheet.get_name(), looks(bold=True, font_size=16, color="accent"))
        self._page, self._rows = page, 0

    def close(self) -> None:
        """Say what stands here; numbers that would fill pages are not printed."""
        told = _("Numbers of the charts on the sheet {name}.")
        if self._rows <= PRINTED and self._column <= BESIDE:
            self.sheet.fit_to_pages(1, 1)
        else:
            self.sheet.print_area(0, 0, 1, 9)
            told = _(
                "Numbers of the charts on the sheet {name}, too many to be printed: clear the print area if you want "
                "them."
            )
        leads_to(self.sheet, 1, 0, told.format(name=self._page), self._page, self._looks(color="muted"))

    def begin(self, figure: str, panel: str) -> list[Any]:
        """Begin the columns of a panel and return the cell with its heading."""
        if self._column:
            self.sheet.set_column(self._column, self._column, 2)
            self._column += 1
        self._known.clear()
        self._aside, self._begun = "", self._column
        put(self.sheet, HEAD - 4, self._column, figure, self._looks(bold=True))
        put(self.sheet, HEAD - 3, self._column, panel, self._looks(color="muted"))
        return [self.sheet.get_name(), HEAD - 3, self._column]

    def aside(self, words: str) -> None:
        """Begin what the chart of the panel needs besides its numbers, at the next column that is written."""
        self._aside = words

    def numbers(self, name: str, unit: str, values: Array | Sequence[float], *, told: str = "") -> Place:
        """Write a column of numbers, or find it where this panel has the same one already.

        values (n,); told: what else tells them from others of that name.
        """
        array = np.atleast_1d(np.asarray(values, dtype=float))
        key = (name, array.tobytes())
        if key not in self._known:
            finite = [value if np.isfinite(value) else None for value in array.tolist()]
            self._known[key] = self._written(name, unit, finite, left=False)
            if told not in ("", name) and self._begun < self._known[key].column:
                look = self._looks(color="muted", text_wrap=True, align="right")
                put(self.sheet, HEAD - 3, self._known[key].column, told, look)
        return self._known[key]

    def words(self, name: str, values: Sequence[str]) -> Place:
        """Write a column of words."""
        return self._written(name, "", values, left=True)

    def _written(self, name: str, unit: str, values: Sequence[object], *, left: bool) -> Place:
        if self._aside:
            self.sheet.set_column(self._column, self._column, 2)
            self._column += 1
            put(self.sheet, HEAD - 3, self._column, self._aside, self._looks(color="muted", italic=True))
            self._aside = ""
        column, align = self._column, "left" if left else "right"
        apart: dict[str, Any] = {"indent": 2} if left else {}
        head = self._looks(bold=True, text_wrap=True, align=align, valign="bottom", **apart)
        put(self.sheet, HEAD - 2, column, name, head)
        put(
            self.sheet, HEAD - 1, column, f"[{unit}]" if unit else "", self._looks(color="muted", bottom=1, align=align)
        )
        look = self._looks(**apart) if left else self._looks(num_format=digits([v for v in values if v is not None]))
        for row, value in enumerate(values, start=HEAD):
            put(self.sheet, row, column, value, None if value is None else look)  # a blank with looks would count as 0
        self._rows = max(self._rows, len(values))
        widest = max(map(len, map(str, values)), default=0) if left else 0
        self.sheet.set_column(column, column, min(max(WIDTH, widest), 48))
        self._column += 1
        return Place(sheet=self.sheet.get_name(), column=column, count=len(values))


def digits(values: Sequence[Any]) -> str:
    """Return the number format of a column: as many digits as its largest number has, none that are always nought."""
    sizes = np.abs(np.asarray(values, dtype=float))
    top = float(np.max(sizes, initial=0.0))
    if not top:
        return "0"
    power = math.floor(math.log10(top))
    small = not -4 <= power <= 9
    parts = DIGITS - 1 if small else max(0, DIGITS - 1 - power)
    scaled = sizes / 10.0**power if small else sizes
    least = next(
        k
        for k in range(parts + 1)
        if k == parts or np.allclose(np.round(scaled, k), scaled, rtol=0.0, atol=1e-12 * max(1.0, top))
    )
    form = "0." + "0" * least if least else "0"
    return f"{form}E+00" if small else form
