"""Who looks at an answer: the units and the decimal sign that this reader is used to."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field

from cardan.errors import InputError, Problem
from cardan.texts import _
from cardan.units import DIMENSIONS, label, nearest, preferred

from .numbers import fixed, significant, trimmed


@dataclass(frozen=True, kw_only=True)
class Reader:
    """Units and decimal sign of whoever looks; the usual ones where nothing is said."""

    # dimension -> unit, as in the keys of a drive file: ``{"length": "in"}``
    units: Mapping[str, str] = field(default_factory=dict)
    decimal: str = "."  # sign between whole and part: ``"."`` or ``","``

    def __post_init__(self) -> None:
        problems = [*_unknown(self.units)]
        if self.decimal not in (".", ","):
            text = _("{sign} is neither a point nor a comma")
            problems.append(Problem("--decimal", text.format(sign=repr(self.decimal))))
        if problems:
            raise InputError(problems)

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
        return number.replace(".", self.decimal)

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


USUAL = Reader()
"""Usual units, decimal point."""

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


def chosen(given: Sequence[str], decimal: str = ".") -> Reader:
    """Return the reader that options describe.

    given: each ``dimension=unit``, such as ``length=in``; decimal: sign between whole and part.

    >>> chosen(["length=in"], ",").units
    {'length': 'in'}
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
