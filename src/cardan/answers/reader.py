"""Who looks at an answer: the units and the decimal sign that this reader is used to."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from typing import Literal, TypeAlias

from cardan.errors import InputError, Problem
from cardan.texts import _, language
from cardan.units import DIMENSIONS, label, nearest, preferred, thousands

# Numbers as people read them: significant digits, a true minus, thin groups of thousands, powers of ten.

COMMA = ("ru",)  # languages whose decimal sign is the comma
THIN = "\u202f"  # narrow blank within numbers


def significant(value: float, digits: int = 4) -> str:
    """Return a number with so many significant digits, a true minus and thin grouping.

    Returns: "–" for what is not a number, a power of ten for what is very small or large.

    >>> significant(1.0, 5), significant(0.9999999, 5)  # the last digit is of the number as it is rounded
    ('1.0000', '1.0000')
    """
    if not math.isfinite(value):
        return "–" if math.isnan(value) else "∞" if value > 0.0 else "−∞"
    if value == 0.0:
        return "0"
    size = _size(value, digits)
    if not -5 <= size < 9:
        mantissa, _sign, power = f"{value:.{digits - 1}e}".partition("e")
        return f"{mantissa}·10{raised(int(power))}".replace("-", "−")
    return thousands(value, max(0, digits - 1 - size)).replace("-", "−")


def fixed(value: float, decimals: int = 2) -> str:
    """Return a number with so many decimals, never "-0"."""
    if not math.isfinite(value):
        return significant(value)
    return f"{value:z,.{decimals}f}".replace(",", THIN).replace("-", "−")


def trimmed(text: str) -> str:
    """Return a number in words without zeros at the end of its decimals; whole numbers keep theirs."""
    return text.rstrip("0").rstrip(".") if "." in text and "·" not in text else text


def raised(number: int) -> str:
    """Return a whole number in raised digits."""
    return str(number).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def half_turn(angle: float) -> float:
    """Return an angle [°] in (-90, 90]: yokes and planes are lines, not arrows."""
    return 90.0 - (90.0 - angle) % 180.0


def spreadsheet(value: float, digits: int = 4, decimals: int | None = None) -> str:
    """Return the number format of spreadsheets that shows as many digits as `significant` or `fixed`."""
    if decimals is None:
        size = _size(value, digits) if value else 0
        if not -5 <= size < 9:
            return f"0{_point(digits - 1)}E+00"
        decimals = 0 if value == 0.0 else max(0, digits - 1 - size)
    return f"{'#,##0' if abs(value) >= 1000.0 else '0'}{_point(decimals)}"


def _size(value: float, digits: int) -> int:
    """Return the power of ten of a number that is rounded to so many digits."""
    return int(f"{value:.{digits - 1}e}".partition("e")[2])


def _point(decimals: int) -> str:
    return "." + "0" * decimals if decimals > 0 else ""


Keys: TypeAlias = Literal["file", "page", "meaning"]
"""As they stand in the file, counted from 0; as a page counts, from 1; by what they mean, to who writes no file."""


@dataclass(frozen=True, kw_only=True)
class Reader:
    """Units and decimal sign of whoever looks; the usual ones where nothing is said."""

    # dimension -> unit, as in the keys of a drive file: ``{"length": "in"}``
    units: Mapping[str, str] = field(default_factory=dict)
    decimal: str = ""  # sign between whole and part, ``"."`` or ``","``; empty for that of the language
    keys: Keys = "file"  # how keys of a file are told

    def __post_init__(self) -> None:
        problems = [*_unknown(self.units)]
        if self.decimal not in ("", ".", ","):
            text = _("{sign} is neither a point nor a comma")
            problems.append(Problem("--decimal", text.format(sign=repr(self.decimal))))
        if problems:
            raise InputError(problems)

    @property
    def sign(self) -> str:
        """Sign between whole and part."""
        return self.decimal or ("," if language() in COMMA else ".")

    def unit(self, dimension: str, usual: str = "") -> tuple[str, float]:
        """Return the unit of a dimension and its factor to SI; ``usual`` where the reader chose none."""
        unit = self.units.get(dimension) or usual or preferred(dimension)
        return unit, DIMENSIONS[dimension][unit]

    def label(self, dimension: str, usual: str = "") -> str:
        """Return the unit of a dimension as it is printed; nothing where there is none."""
        return label(self.unit(dimension, usual)[0]) if dimension else ""

    def number(self, value: float, digits: int = 4, decimals: int | None = None, *, trim: bool = False) -> str:
        """Return a number in words: so many significant digits, or so many decimals."""
        text = significant(value, digits) if decimals is None else fixed(value, decimals)
        return self.signed(trimmed(text) if trim else text)

    def signed(self, number: str) -> str:
        """Return a number in words with the decimal sign of this reader."""
        return number.replace(".", self.sign)

    def decimals(self, decimals: int | None, dimension: str, usual: str = "") -> int | None:
        """Return how many decimals another unit needs so that the last digit is worth no more than it was."""
        if decimals is None or not dimension:
            return decimals
        base, own = usual or preferred(dimension), self.unit(dimension, usual)
        if own[0] == base:
            return decimals
        return max(0, math.ceil(decimals - math.log10(DIMENSIONS[dimension][base] / own[1]) - 1e-9))


def _unknown(units: Mapping[str, str]) -> Iterator[Problem]:
    """Yield what is no dimension or no unit of it."""
    for dimension, unit in units.items():
        known = DIMENSIONS.get(dimension, {})
        if not known:
            near = nearest(dimension, DIMENSIONS)
            text = _("unknown dimension {dimension}; dimensions are {known}")
            said = text.format(dimension=repr(dimension), known=", ".join(DIMENSIONS))
        elif unit not in known:
            near = nearest(unit, known)
            text = _("unknown unit {unit} of {dimension}; known are {known}")
            said = text.format(unit=repr(unit), dimension=dimension, known=", ".join(known))
        else:
            continue
        yield Problem("--unit", said + (_(" - did you mean {near}?").format(near=near) if near else ""))


USUAL = Reader()  # usual units, decimal sign of the language

_reading: ContextVar[Reader] = ContextVar("cardan_reader", default=USUAL)


def reader() -> Reader:
    """Return who reads here: in this thread or task, the usual reader by default."""
    return _reading.get()


@contextmanager
def reading(who: Reader) -> Iterator[None]:
    """Let a reader read within, and the one before afterwards."""
    before = _reading.set(who)
    try:
        yield
    finally:
        _reading.reset(before)


def chosen(given: Sequence[str], decimal: str = "") -> Reader:
    """Return the reader that options describe.

    given: each ``dimension=unit``, such as ``length=in``; decimal: sign between whole and part.
    """
    units: dict[str, str] = {}
    problems = []
    for one in given:
        dimension, sign, unit = one.partition("=")
        if sign:
            units[dimension] = unit
        else:
            text = _("{text} is not dimension=unit, such as length=in; dimensions are {known}")
            problems.append(Problem("--unit", text.format(text=one, known=", ".join(DIMENSIONS))))
    try:
        found = Reader(units=units, decimal=decimal)
    except InputError as error:
        raise InputError([*problems, *error.problems]) from error
    if problems:
        raise InputError(problems)
    return found
