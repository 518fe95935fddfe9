"""Results as a workbook: the table of the CSV, numbers as numbers."""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from typing import Any

from cardan.errors import refuse
from cardan.io.workbook.book import MOST_ROWS, opened, put, sheet_name
from cardan.texts import _

from .csv import columns_of

suffix = ".xlsx"

WIDEST = 30  # letters of the widest column


def content(result: Any) -> bytes:
    """Return a result as the bytes of a workbook."""
    return table(columns_of(result), type(result).__name__)


def table(columns: Mapping[str, Sequence[Any]], name: str = "table") -> bytes:
    """Return columns as the bytes of a workbook of one sheet, numbers in full precision."""
    count = max(map(len, columns.values()), default=0)
    if count >= MOST_ROWS:
        text = _("has {rows} rows; a sheet holds {limit}: save it as .csv")
        raise refuse("result", text.format(rows=count, limit=MOST_ROWS - 1))
    stream = io.BytesIO()
    book = opened(stream, title=name)
    head = book.add_format({"bold": True, "bottom": 1, "text_wrap": True, "valign": "top"})
    sheet = book.add_worksheet(sheet_name(name, set()))
    for column, heading in enumerate(columns):
        put(sheet, 0, column, heading, head)
        sheet.set_column(column, column, max(10, min(len(heading) + 2, WIDEST)))
    for line, row in enumerate(zip(*columns.values(), strict=True), start=1):
        for column, value in enumerate(row):
            put(sheet, line, column, value)
    sheet.freeze_panes(1, 1)
    sheet.repeat_rows(0)
    sheet.set_landscape()
    sheet.set_paper(9)
    sheet.fit_to_pages(1, 0)
    book.close()
    return stream.getvalue()
