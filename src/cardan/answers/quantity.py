"""Quantities in SI and sentences with places for them: written for a reader when they are shown, never before."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeAlias

from cardan.texts import _

from .reader import THIN, Reader

ROUNDING = 1e-13  # a share below this is nothing but rounding
TOUCHING = ("°", "′", "″")  # units that stand right behind their number


@dataclass(frozen=True, kw_only=True)
class Shown:
    """A number and its unit as they are printed."""

    number: str
    unit: str = ""

    def __str__(self) -> str:
        if not self.unit or self.number == "–":
            return self.number
        if self.unit in TOUCHING:
            gap = THIN if "·" in self.number else ""  # 10⁻⁷° would be read as a power of ⁻⁷⁰
            return f"{self.number}{gap}{self.unit}"
        return f"{self.number} {self.unit}"

    def __format__(self, form: str) -> str:
        """Return all of it, or what a place asks for: ``{low:bare}`` the number, ``{low:unit}`` the unit."""
        return {"": str(self), "bare": self.number, "unit": self.unit}[form]


@dataclass(frozen=True)
class Quantity:
    """A number in SI, or an array of them for a program, with its dimension and with how exactly it is told.

    >>> Quantity(0.0125, "length").told(Reader())
    '12.50 mm'
    >>> Quantity(0.0254, "length").told(Reader(units={"length": "in"}, decimal=","))
    '1,000 in'
    >>> Quantity(0.3, "angle", decimals=2).told(Reader())
    '17.19°'
    >>> Quantity(25000.0, most=1000.0).told(Reader())
    '> 1\u202f000'
    """

    value: Any  # in SI
    dimension: str = ""  # a key of `cardan.units.DIMENSIONS`; empty for counts and ratios
    digits: int = 4  # significant digits
    decimals: int | None = None  # decimals in the usual unit, instead of significant digits
    unit: str = ""  # the usual unit of this quantity, where it is not the first of its dimension
    most: float = math.inf  # what is beyond this is told as "> most"; in SI
    trim: bool = False  # without zeros at the end of the decimals: for what was given, as in a file

    def shown(self, reader: Reader) -> Shown:
        """Return number and unit as a reader sees them."""
        if not self.dimension:
            return Shown(number=self._number(float(self.value), reader, 1.0))
        factor = reader.unit(self.dimension, self.unit)[1]
        return Shown(
            number=self._number(float(self.value), reader, factor), unit=reader.label(self.dimension, self.unit)
        )

    def _number(self, value: float, reader: Reader, factor: float) -> str:
        if value > self.most:
            return f"> {reader.number(self.most / factor, trim=True)}"
        if self.dimension == "share" and abs(value) < ROUNDING:
            value = 0.0
        decimals = reader.decimals(self.decimals, self.dimension, self.unit)
        return reader.number(value / factor, self.digits, decimals, trim=self.trim)

    def told(self, reader: Reader) -> str:
        """Return number and unit in words."""
        return str(self.shown(reader))

    def key(self, name: str, reader: Reader) -> str:
        """Return a name for programs with the unit behind it: ``torque_Nm``."""
        return f"{name}_{reader.unit(self.dimension, self.unit)[0]}" if self.dimension else name

    def number(self, reader: Reader) -> Any:
        """Return the value in the reader's unit, in full precision."""
        factor = reader.unit(self.dimension, self.unit)[1] if self.dimension else 1.0
        return self.value if factor == 1.0 or self.value is None else _over(self.value, factor)


def _over(value: Any, factor: float) -> Any:
    """Return a number, an array or a list of numbers over a factor."""
    return [_over(one, factor) for one in value] if isinstance(value, list | tuple) else value / factor


@dataclass(frozen=True)
class Unit:
    """The unit of a dimension as it stands in keys, for programs that are told it beside a number."""

    dimension: str
    usual: str = ""

    def told(self, reader: Reader) -> str:
        """Return the reader's unit; nothing where there is no dimension."""
        return reader.unit(self.dimension, self.usual)[0] if self.dimension else ""


@dataclass(frozen=True)
class Written:
    """What those who write a file are told, as a key of it, and what those who read a report are told in its place.

    >>> Written("shafts[1].yoke_angle_deg", "shaft 2: yoke angle").told(Reader())
    'shafts[1].yoke_angle_deg'
    >>> Written("shafts[1].yoke_angle_deg", "shaft 2: yoke angle").told(Reader(keys="meaning"))
    'shaft 2: yoke angle'
    """

    key: str
    name: Text
    page: str | None = None  # the key where parts are counted as a page counts; as the file has it when not given

    def told(self, reader: Reader) -> str:
        """Return one of both for a reader."""
        if reader.keys == "meaning":
            return told(self.name, reader)
        return self.key if self.page is None or reader.keys == "file" else self.page


@dataclass(frozen=True)
class Say:
    """A sentence in the language spoken where it was made, with named places that are filled when it is shown.

    A place takes a quantity (``{force}``; ``{force:bare}`` its number alone, ``{force:unit}`` its unit alone), another
    sentence, a key of a file, a word or a whole number.
    """

    text: str
    values: Mapping[str, Any] = field(default_factory=dict)

    def told(self, reader: Reader) -> str:
        """Return the sentence for a reader."""
        return self.text.format(**{name: _place(value, reader) for name, value in self.values.items()})


@dataclass(frozen=True)
class Joined:
    """Several texts in a row."""

    parts: Sequence[Text]  # what is told one after the other; the empty ones are left out
    between: str = ", "  # between, last: what stands between them, and before the last one where that is another word
    last: str = ""

    def told(self, reader: Reader) -> str:
        """Return the texts for a reader; a list of decimal commas is parted by semicolons."""
        every = [text for text in (told(part, reader) for part in self.parts) if text]
        numbers = any(isinstance(part, Quantity) for part in self.parts)
        between = "; " if self.between == ", " and reader.sign == "," and numbers else self.between
        if self.last and len(every) > 1:
            return between.join(every[:-1]) + self.last + every[-1]
        return between.join(every)


Text: TypeAlias = str | Say | Joined | Quantity | Unit | Written
"""Anything that is told: words as they stand, or what is written for a reader when it is shown."""


def say(text: str, **values: Any) -> Say:
    """Return a sentence; see `Say`."""
    return Say(text, values)


def told(text: Text, reader: Reader) -> str:
    """Return a text for a reader."""
    return text if isinstance(text, str) else text.told(reader)


def numbered(number: int, name: str = "") -> str:
    """Return the number of a part with its name, as a sentence has it."""
    return f"{number} ({name})" if name else str(number)


def listed(numbers: Sequence[int]) -> str:
    """Return numbers of parts, a run of more than two as a range."""
    if len(numbers) > 2 and numbers[-1] - numbers[0] == len(numbers) - 1:
        return _("{first} to {last}").format(first=numbers[0], last=numbers[-1])
    return ", ".join(str(one) for one in numbers)


def _place(value: Any, reader: Reader) -> Any:
    """Return what fills a place of a sentence."""
    if isinstance(value, Quantity):
        return value.shown(reader)
    if isinstance(value, Say | Joined | Written):
        return value.told(reader)
    if isinstance(value, float):
        raise TypeError(f"a number in a sentence is a Quantity: {value!r}")
    return value
