"""Spreadsheets in memory: numbers stay numbers, words stay words, and every sheet has a name that it may have."""

from __future__ import annotations

import datetime
import io
import math
import re
import zipfile
from typing import IO, Any

from cardan.later import later
from cardan.texts import mark

xlsxwriter = later("xlsxwriter", mark("a workbook needs XlsxWriter: pip install 'cardan[xlsx]'"))

MOST_ROWS = 1_048_576  # rows of a sheet
MOST_LETTERS = 32_767  # letters of a cell
NAME_LETTERS = 31  # letters of a sheet's name

UNREADABLE = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\ud800-\udfff\ufeff\ufffe\uffff]")
"""Marks of control and halves of letters: no such file may hold them."""

PICTURE = re.compile(
    r'<xdr:twoCellAnchor editAs="oneCell">(<xdr:from>(?:(?!</xdr:from>).)*</xdr:from>)'
    r"<xdr:to>(?:(?!</xdr:to>).)*</xdr:to>"
    r'(<xdr:pic>(?:(?!</xdr:pic>).)*?<a:ext (cx="[0-9]+" cy="[0-9]+")/>(?:(?!</xdr:pic>).)*</xdr:pic><xdr:clientData/>)'
    r"</xdr:twoCellAnchor>",
    re.DOTALL,
)
"""Place of a picture that reaches from one cell to another, in a sheet's drawing."""

LONGEST_TITLE = 250  # letters of a title among the properties

QUIET = {"in_memory": True, "strings_to_formulas": False, "strings_to_urls": False, "strings_to_numbers": False}
"""Words that look like a formula, an address or a number are words."""


def opened(stream: IO[bytes], *, title: str, made: datetime.date | None = None) -> Any:
    """Return an empty workbook that is written to a stream when it is closed.

    The same content gives the same bytes: nothing tells who made it on which machine.
    stream: where it goes; title: among its properties.
    made: among its properties; 2000-01-01 when not given.
    """
    day = made or datetime.date(2000, 1, 1)
    book = xlsxwriter().Workbook(stream, QUIET)
    book.set_properties(
        {"title": words(title)[:LONGEST_TITLE], "created": datetime.datetime(day.year, day.month, day.day)}
    )
    return book


def unstretched(data: bytes) -> bytes:
    """Return a workbook whose pictures have a size of their own instead of reaching to a cell.

    How wide a column of so many letters is differs from spreadsheet to spreadsheet: a picture that ends in a cell is
    stretched, and its circles are ellipses.
    """
    stream = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as old, zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as new:
        for one in old.infolist():
            part = old.read(one)
            if one.filename.startswith("xl/drawings/drawing"):
                part = PICTURE.sub(r"<xdr:oneCellAnchor>\1<xdr:ext \3/>\2</xdr:oneCellAnchor>", part.decode()).encode()
            new.writestr(one, part)
    return stream.getvalue()


def put(sheet: Any, row: int, column: int, value: object, form: Any = None) -> None:
    """Write a value into a cell: what is not finite as a sign, nothing as an empty cell. row, column: from 0."""
    if hasattr(value, "item"):
        value = value.item()
    if isinstance(value, bool):
        sheet.write_boolean(row, column, value, form)
    elif isinstance(value, int | float) and math.isfinite(value):
        sheet.write_number(row, column, value, form)
    elif isinstance(value, float):
        sign = "" if math.isnan(value) else "∞" if value > 0 else "−∞"
        put(sheet, row, column, sign, form)
    elif value is None or value == "":
        sheet.write_blank(row, column, None, form)
    else:
        sheet.write_string(row, column, words(str(value)), form)


def leads_to(sheet: Any, row: int, column: int, text: str, other: str, form: Any) -> None:
    """Write words that lead to another sheet.

    sheet: where they stand; row, column: from 0; other: name of the sheet that they lead to.
    """
    sheet.write_url(row, column, "internal:'" + other.replace("'", "''") + "'!A1", form, words(text))


def words(text: str) -> str:
    """Return a text as a cell can hold it: cut to its length, without marks of control and halves of letters.

    >>> words("=1+1"), words("a\\x0bb"), len(words("a" * 40_000))
    ('=1+1', 'a\ufffdb', 32767)
    """
    whole = UNREADABLE.sub("\ufffd", text)
    if len(whole) <= MOST_LETTERS:
        return whole
    return whole[: MOST_LETTERS - 1] + "…"


def sheet_name(wanted: str, taken: set[str], *, ending: str = "") -> str:
    """Return a name that a sheet may have and no other has, and take it.

    taken: names of the other sheets, in small letters; the new one is added.
    """
    plain = " ".join(re.sub(r"[\[\]:*?/\\\x00-\x1f]", " ", words(wanted)).split()).strip("' ") or "-"
    count, name = 1, ""
    while not name or name.lower() in taken or name.lower() == "history":
        tail = ending if count == 1 else f"{ending} {count}"
        room = NAME_LETTERS - _units(tail)
        kept = plain
        while _units(kept) > room:
            kept = kept[:-1]
        name, count = f"{kept.rstrip()}{tail}", count + 1
    taken.add(name.lower())
    return name


def _units(text: str) -> int:
    """Return the length of a text as spreadsheets count it."""
    return len(text.encode("utf-16-le")) // 2
