"""Cells of a report as numbers with a format that shows what the cell says."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from .block import Cell, Column

WRITTEN = re.compile(
    r"(?P<before>[≤≥<>≈±]?)\s*(?P<sign>[+−-]?)(?P<whole>0|[1-9][\d\u202f]*)(?P<part>[.,]\d+)?(?:·10(?P<power>[⁻⁰¹²³⁴-⁹]+))?"
)
"""A number as people read it."""

POWERS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")


@dataclass(frozen=True, kw_only=True)
class Amount:
    """A number and how it is to be shown.

    Parameters
    ----------
    value : float
        In full precision where the report has it.
    form : str
        Number format of spreadsheets.
    """

    value: float
    form: str


def amount(cell: Cell, column: Column) -> Amount | None:
    """Return the number of a cell; None where it holds words.

    Parameters
    ----------
    cell : Cell
        The cell.
    column : Column
        Its column: what stands to the left there is words, unless it says its number in full.

    Examples
    --------
    >>> numbers = Column(heading="limit")
    >>> amount(Cell(text="≤ 1\u202f234.5", full="1234.5432"), numbers)
    Amount(value=1234.5432, form='"≤ "#,##0.0')
    >>> amount(Cell(text="−2.0·10⁻¹³"), numbers)
    Amount(value=-2e-13, form='0.0E+00')
    >>> amount(Cell(text="–"), numbers)
    """
    if cell.amount is not None:
        return Amount(value=cell.amount, form=cell.form)
    found = WRITTEN.fullmatch(cell.text)
    full = _number(cell.full)
    if full is None:
        if column.left or found is None:
            return None
        full = _read(found)
    return Amount(value=full, form=_form(found, cell.sign, negative=full < 0.0))


def _number(full: str) -> float | None:
    try:
        value = float(full)
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def read(text: str) -> float | None:
    """Return the number that a text is, with a point or a comma; None where it is none.

    Examples
    --------
    >>> read("−1\u202f234,5"), read("2·10⁻⁷"), read("1 … 2")
    (-1234.5, 2e-07, None)
    """
    found = WRITTEN.fullmatch(text)
    return None if found is None else _read(found)


def _read(found: re.Match[str]) -> float:
    sign = found["sign"].replace("−", "-")
    whole = found["whole"].replace("\u202f", "")
    power = (found["power"] or "0").translate(POWERS)
    part = (found["part"] or "").replace(",", ".")
    return float(f"{sign}{whole}{part}e{power}")


def _form(found: re.Match[str] | None, sign: str, *, negative: bool) -> str:
    """Return the format that shows as many digits as were written, with what stood before them."""
    before = f"{sign} " if sign else ""
    if found is None:
        return f'"{before}"General' if before else "General"
    before += f"{found['before']} " if found["before"] else ""
    parts = "0" * (len(found["part"] or ".") - 1)
    point = f".{parts}" if parts else ""
    body = f"0{point}"
    if found["power"]:
        body += "E+00"
    elif "\u202f" in found["whole"]:
        body = f"#,##{body}"
    form = f'"{before}"{body}' if before else body
    if found["sign"] == "+":
        return f"+{form};-{form};{form}"
    return f"{form};{form}" if negative and not found["sign"] else form  # a nought without a minus
