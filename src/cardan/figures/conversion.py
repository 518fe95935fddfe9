"""Numbers and sentences in the units and with the decimal sign that a reader likes.

What is shown is written in the usual units (`cardan.units.preferred`). Here a number is brought into another unit with
its digits kept: the step of its last digit never grows, and three digits are left at least.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property

from cardan.errors import refuse
from cardan.texts import _
from cardan.units import DIMENSIONS, LABELS, label, preferred, spoken

from .wording import significant

NUMBER = r"(?<![\w.,])(?:(?P<sign>[±+−-]) ?)?(?P<whole>\d[\d\u202f]*)(?P<part>\.\d+)?(?:·10(?P<power>[⁻⁰¹²³⁴-⁹]+))?"
"""A number as people read it."""

ANY = re.sub(r"\?P<\w+>", "", NUMBER)
"""The same without names."""

RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")

ALONE = re.compile(NUMBER)

JOINED = r"(?: ?(?:…|–|/|×|±|to|and|or|by|до|и|или|на) ?)"
"""What stands between numbers that share the unit behind the last one."""

OF_PART = re.compile(
    r"(?:\d,|\b(?:joints?|shafts?|supports?|modes?|orders?|zones?|settings?|вал\w*|шарнир\w*|опор\w*|форм\w*|поряд\w*|зон\w*))"
    r"\s$",
    re.IGNORECASE,
)
"""What stands before the number of a part, which has no unit: shaft 3 to 90°."""

DECIMAL = re.compile(r"(?<![\w.])(\d[\d\u202f]*)\.(\d+)(?!\d|\.\w)")
"""A number with a point; of 1.2.3 no part is one."""

LISTED = re.compile(r"(\.\d+(?:·10[⁻⁰¹²³⁴-⁹]+)?[°′]?), (?=[−+±-]?\d[\d\u202f]*\.\d)")
"""What parts two numbers of a list that both have a point."""

WORDS = ("in",)
"""Labels of units that are words too: no number of a sentence is read to be in them."""

KEY = re.compile(r"[a-z][a-z0-9_]*(?:\[\d+\])?(?:\.[a-z][A-Za-z0-9_]*(?:\[\d+\])?)+|[a-z0-9]+(?:_[A-Za-z0-9]+)+")
"""A path of the drive file, ``joints[1].centre_mm``."""

DIGITS, WHOLE = 3, 4
"""Fewest digits of a number in another unit, and of one that was whole and may be exact."""


@dataclass(frozen=True, kw_only=True)
class Conversion:
    """From the usual units into those of a reader's choice.

    Parameters
    ----------
    units : mapping of str to str
        Dimension -> unit, as in the keys of a drive file; all others stay.
    decimal : str
        Sign between whole and part: ``"."`` or ``","``.
    names : sequence of str
        Names that a user wrote: they stay as they are within sentences.

    Raises
    ------
    InputError
        There is no such dimension or unit, or the sign is none.

    Examples
    --------
    >>> inches = Conversion(units={"length": "in"})
    >>> inches.sentence("The joints move by up to 15.8 mm; joint 2 bends 12.5°.")
    'The joints move by up to 0.622 in; joint 2 bends 12.5°.'
    >>> Conversion(units={"angle": "rad"}, decimal=",").sentence("shaft 2 to 12.5°")
    'shaft 2 to 0,218 rad'
    """

    units: Mapping[str, str] = field(default_factory=dict)
    decimal: str = "."
    names: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        for dimension, unit in self.units.items():
            if dimension not in DIMENSIONS:
                known = ", ".join(DIMENSIONS)
                raise refuse(
                    "units", _("{name} is no dimension; known are {known}").format(name=dimension, known=known)
                )
            if unit not in DIMENSIONS[dimension]:
                known = ", ".join(DIMENSIONS[dimension])
                raise refuse(f"units.{dimension}", _("{unit} is not one of {known}").format(unit=unit, known=known))
        if self.decimal not in (".", ","):
            raise refuse("decimal", _("{sign} is neither a point nor a comma").format(sign=repr(self.decimal)))

    @property
    def idle(self) -> bool:
        """Whether everything stays as it is."""
        return not self.chosen and self.decimal == "."

    @cached_property
    def chosen(self) -> dict[str, str]:
        """Dimension -> unit, where it is not the usual one."""
        return {one: unit for one, unit in self.units.items() if unit != preferred(one)}

    @cached_property
    def labels(self) -> dict[str, tuple[str, float]]:
        """Printed unit -> the one it becomes, and how many of these it is; only what changes."""
        found: dict[str, tuple[str, float]] = {}
        for dimension, unit in self.chosen.items():
            target = DIMENSIONS[dimension][unit]
            for one, size in DIMENSIONS[dimension].items():
                if one != unit:
                    _add(found, LABELS.get(one, one), label(unit), size / target)
        length = self.chosen.get("length", "")
        if length in ("in", "ft"):
            _add(found, "µm", label(length), 1e-6 / DIMENSIONS["length"][length])
        if length:
            for dimension, time in (("speed", "s"), ("acceleration", "s²")):
                for one, size in DIMENSIONS[dimension].items() if dimension not in self.units else ():
                    told = f"{label(length)}/{label('s')}{time[1:]}"
                    _add(found, LABELS[one], told, size / DIMENSIONS["length"][length])
        return {one: (new, k) for one, (new, k) in found.items() if one != new}

    def unit(self, printed: str) -> tuple[str, float]:
        """Return what a printed unit becomes, and how many of the new ones it is.

        Parameters
        ----------
        printed : str
            A unit, signs before it or a part of it included: ``± N·m``, ``% / °``.

        Examples
        --------
        >>> Conversion(units={"angle": "rad"}).unit("%/°")[0]
        '%/rad'
        """
        if printed in self.labels:
            return self.labels[printed]
        before, sign, last = printed.rpartition(" ")
        if sign and before in ("±", "≤", "≥") and last in self.labels:
            return f"{before} {self.labels[last][0]}", self.labels[last][1]
        over = re.fullmatch(r"(% ?/ ?)(.+)", printed)
        if over and over[2] in self.labels:
            return over[1] + self.labels[over[2]][0], 1.0 / self.labels[over[2]][1]
        return printed, 1.0

    def sentence(self, text: str) -> str:
        """Return a sentence with its numbers and their units converted, number and unit together.

        Parameters
        ----------
        text : str
            Words with numbers; keys of the drive file, versions and the names of `names` stay.
        """
        if not text or self.idle or not any(one.isdigit() or one == "[" for one in text):
            return text
        kept = sorted({*KEY.findall(text), *(name for name in self.names if name and name in text)}, key=len)
        parts = re.split("(" + "|".join(re.escape(one) for one in reversed(kept)) + ")", text) if kept else [text]
        return "".join(part if k % 2 else self._said(part) for k, part in enumerate(parts))

    def number(self, text: str, ratio: float, full: float | None = None) -> str:
        """Return a text of numbers alone in another unit.

        Parameters
        ----------
        text : str
            One number, or several with signs between them: ``≤ 12.5``, ``2.1 … 3.4``.
        ratio : float
            How many of the new units one of the old ones is.
        full : float, optional
            The number in full precision, in the old unit.
        """
        if ratio == 1.0:
            return self.signed(text)
        found = ALONE.findall(text)
        return self.signed(ALONE.sub(lambda one: _scaled(one, ratio, full if len(found) == 1 else None), text))

    def signed(self, text: str) -> str:
        """Return a text with the decimal sign of the choice."""
        if self.decimal == ".":
            return text
        return DECIMAL.sub(rf"\1{self.decimal}\2", LISTED.sub(r"\1; ", text))

    def _said(self, text: str) -> str:
        if self.labels:
            text = self._pattern.sub(self._one, text)
            text = self._bracketed.sub(lambda one: f"[{self.labels[one[1]][0]}]", text)
        return self.signed(text)

    @cached_property
    def _pattern(self) -> re.Pattern[str]:
        known = "|".join(re.escape(one) for one in sorted(self.labels, key=len, reverse=True) if one not in WORDS)
        end = r"(?![\w²³·]|/[^\W\d])"
        return re.compile(
            rf"(?P<run>(?:{ANY}(?:\s?(?:{known}))?{JOINED})*){NUMBER}(?P<space>\s?)(?P<unit>{known}){end}"
        )

    @cached_property
    def _held(self) -> re.Pattern[str]:
        known = "|".join(re.escape(one) for one in sorted(self.labels, key=len, reverse=True))
        return re.compile(rf"{NUMBER}(?:(?P<space>\s?)(?P<unit>{known}))?")

    @cached_property
    def _bracketed(self) -> re.Pattern[str]:
        return re.compile(rf"\[({'|'.join(re.escape(one) for one in sorted(self.labels, key=len, reverse=True))})\]")

    def _one(self, found: re.Match[str]) -> str:
        unit, ratio = self.labels[found["unit"]]
        run = found["run"]
        if run and not OF_PART.search(found.string[: found.start()]):
            run = self._held.sub(lambda one: self._of_run(one, ratio), run)
        return f"{run}{_scaled(found, ratio)}{_space(unit)}{unit}"

    def _of_run(self, found: re.Match[str], ratio: float) -> str:
        """Return a number that shares the unit behind a later one, unless it has its own."""
        if not found["unit"]:
            return _scaled(found, ratio)
        unit, own = self.labels[found["unit"]]
        return f"{_scaled(found, own)}{_space(unit)}{unit}"


def names_of(words: Iterable[str]) -> tuple[str, ...]:
    """Return those of the names that hold digits: only these could be taken for numbers.

    Examples
    --------
    >>> names_of(["gearbox", "tube 300 mm", ""])
    ('tube 300 mm',)
    """
    return tuple(one for one in words if any(letter.isdigit() for letter in one))


def _add(found: dict[str, tuple[str, float]], printed: str, new: str, ratio: float) -> None:
    for one in {printed, spoken(printed)} - {""}:
        found[one] = (new, ratio)


def _space(unit: str) -> str:
    return "" if unit in ("°", "′") else " "


def _scaled(found: re.Match[str], ratio: float, full: float | None = None) -> str:
    """Return the number of a match times a ratio, with no coarser a last digit than it has."""
    sign, whole, part = found["sign"] or "", found["whole"].replace("\u202f", ""), found["part"] or ""
    power = int((found["power"] or "0").translate(RAISED))
    read = float(f"{whole}{part}e{power}")
    value = float(f"{(read if full is None else abs(full)) * ratio:.12g}")  # 25.4 mm are one inch, not next to it
    gap = " " if sign and found.string[found.end("sign")] == " " else ""
    if read == 0.0 or value == 0.0 or not math.isfinite(value):
        return f"{sign}{gap}{whole}{part}"
    step = 10.0 ** (power - max(len(part) - 1, 0)) * ratio
    last, first = math.floor(math.log10(step) + 1e-9), math.floor(math.log10(value) + 1e-9)
    return f"{sign}{gap}{significant(value, max(DIGITS if part else WHOLE, first - last + 1))}"
