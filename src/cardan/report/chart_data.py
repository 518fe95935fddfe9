"""The sheet beside a page that holds the numbers of its charts: a column for each quantity, headed with its unit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from cardan.io.book import put
from cardan.maths.arrays import Array

from .looks import Looks

HEAD = 4
"""Rows above the numbers: figure, panel, name, unit."""

WIDTH = 13
"""Of a column, in letters."""


@dataclass(frozen=True, kw_only=True)
class Place:
    """A column of numbers on a sheet.

    Parameters
    ----------
    sheet : str
        Name of the sheet.
    column, count : int
        Where it is, and how many values it has.
    """

    sheet: str
    column: int
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

    Parameters
    ----------
    sheet : worksheet
        An empty one.
    looks : Looks
        Formats of the workbook.
    """

    def __init__(self, sheet: Any, looks: Looks) -> None:
        self.sheet = sheet
        self._looks = looks
        self._column = 0
        self._known: dict[tuple[str, bytes], Place] = {}
        sheet.freeze_panes(HEAD, 0)
        sheet.repeat_rows(0, HEAD - 1)
        sheet.set_row_pixels(HEAD - 2, 64)

    def begin(self, figure: str, panel: str) -> list[Any]:
        """Begin the columns of a panel and return the cell with its heading."""
        if self._column:
            self.sheet.set_column(self._column, self._column, 2)
            self._column += 1
        self._known.clear()
        put(self.sheet, 0, self._column, figure, self._looks(bold=True))
        put(self.sheet, 1, self._column, panel, self._looks(color="muted"))
        return [self.sheet.get_name(), 1, self._column]

    def numbers(self, name: str, unit: str, values: Array | Sequence[float]) -> Place:
        """Write a column of numbers, or find it where this panel has the same one already."""
        array = np.atleast_1d(np.asarray(values, dtype=float))
        key = (name, array.tobytes())
        if key not in self._known:
            finite = [value if np.isfinite(value) else None for value in array.tolist()]
            self._known[key] = self._written(name, unit, finite, left=False)
        return self._known[key]

    def words(self, name: str, values: Sequence[str]) -> Place:
        """Write a column of words."""
        return self._written(name, "", values, left=True)

    def _written(self, name: str, unit: str, values: Sequence[object], *, left: bool) -> Place:
        column, align = self._column, "left" if left else "right"
        apart: dict[str, Any] = {"indent": 1} if left else {}
        head = self._looks(bold=True, text_wrap=True, align=align, valign="bottom", **apart)
        put(self.sheet, HEAD - 2, column, name, head)
        put(
            self.sheet, HEAD - 1, column, f"[{unit}]" if unit else "", self._looks(color="muted", bottom=1, align=align)
        )
        for row, value in enumerate(values, start=HEAD):
            put(self.sheet, row, column, value, self._looks(**apart) if left else None)
        widest = max(map(len, map(str, values)), default=0) if left else 0
        self.sheet.set_column(column, column, min(max(WIDTH, widest), 48))
        self._column += 1
        return Place(sheet=self.sheet.get_name(), column=column, count=len(values))
