"""What an answer is made of: a sentence, key figures, tables of quantities, remarks, figures. Only data, all of it SI.

A renderer writes it: the terminal, JSON, CSV, HTML, PDF, a workbook, the app. How deep a part goes is a mark on it,
not another text: what is ``"brief"`` stands everywhere, what is ``"full"`` in the report and in files, what is
``"data"`` in files alone. What is ``aside`` a client does not ask for: a report tells it with ``--full`` alone.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal, TypeAlias

import numpy as np

from cardan.maths.ties import power_of
from cardan.texts import _

from .quantity import Joined, Quantity, Text, told
from .reader import Reader, raised

Tone: TypeAlias = Literal["plain", "good", "warning", "failed", "next"]  # how good it is; ``"next"`` is a step to take

Depth: TypeAlias = Literal["brief", "full", "data"]

FILE = "FILE"  # in a command to type next: the file that was asked about


@dataclass(frozen=True, kw_only=True)
class Cell:
    """A value of a table that is more than its number: how good it is, a chip of colour before it."""

    value: Any  # in the unit of its column, or with a unit of its own where it is a `Quantity`
    tone: Tone = "plain"  # how good it is
    chip: str = ""  # colour of a chip before it
    # the same in Typst's notation of mathematics, where it is an equation; never anything a user wrote
    formula: str = ""
    before: str = ""  # before, after: signs before and behind it: ``≤ ``, brackets
    after: str = ""
    unit: bool = True  # whether a quantity in another unit than that of the column says so


Value: TypeAlias = float | int | str | bool | Text | Cell | None


@dataclass(frozen=True, kw_only=True)
class Column:
    """A column of a table: its name for programs, its heading for people, its values in SI."""

    key: str  # name in JSON and CSV, without unit: ``joint_angle``; a column without a name is for people alone
    # what stands above it, in the language spoken where it was made; a quantity where it is the place on an axis
    heading: Text = ""
    values: Any  # from the top; numbers in SI
    dimension: str = ""  # dimension, unit: as of `Quantity`
    unit: str = ""
    digits: int = 4  # digits, decimals, most, trim: as of `Quantity`
    decimals: int | None = None
    most: float = float("inf")
    trim: bool = False
    left: bool = False  # align to the left: words. Columns of words are so by themselves.
    wrap: bool = False  # the last column may be prose, broken into lines
    depth: Depth = "brief"  # how deep it goes

    @property
    def listed(self) -> Sequence[Any]:
        """Its values as Python holds them."""
        found: Sequence[Any] = self.values.tolist() if isinstance(self.values, np.ndarray) else self.values
        return found

    def name(self, reader: Reader) -> str:
        """Return the key with its unit."""
        return self.quantity(0.0).key(self.key, reader)

    def label(self, reader: Reader) -> str:
        """Return the unit as it is printed."""
        return reader.label(self.dimension, self.unit)

    def quantity(self, value: float) -> Quantity:
        """Return a value of this column as a quantity."""
        return Quantity(value, self.dimension, self.digits, self.decimals, self.unit, self.most, self.trim)

    @property
    def words(self) -> bool:
        """Whether it holds words and is set to the left."""
        first = next((bare(one) for one in self.values if bare(one) is not None), None)
        return self.left or (not self.dimension and not isinstance(first, bool | int | float | np.number | Quantity))


@dataclass(frozen=True, kw_only=True)
class Table:
    """Quantities side by side."""

    name: str = ""  # for programs; a table without a name stands in no JSON
    title: str = ""  # heading
    columns: Sequence[Column]  # all of one length
    note: Text = ""  # what stands below it
    depth: Depth = "brief"  # how deep it goes
    aside: bool = False  # whether a report tells it with ``--full`` alone
    fixed: int = 1  # so many first columns are repeated where the table is parted
    tones: Sequence[Tone] = ()  # how good each row is; its first cell has that colour
    records: bool = False  # in JSON a list of rows; otherwise one of columns

    def __post_init__(self) -> None:
        lengths = {len(column.values) for column in self.columns}
        if len(lengths) > 1:
            said = ", ".join(f"{column.key} {len(column.values)}" for column in self.columns)
            raise ValueError(f"columns of table {self.name or self.title!r} differ in length: {said}")


@dataclass(frozen=True, kw_only=True)
class Remark:
    """A sentence below the tables: what it means, what to mind, what to do next."""

    text: Text  # the sentence
    tone: Tone = "plain"  # how good it is
    command: tuple[str, ...] = ()  # what to type next, with `FILE` for the file asked about
    code: str = ""  # what it is about, in one word for programs
    depth: Depth = "brief"  # how deep it goes
    aside: bool = False  # whether a report tells it with ``--full`` alone
    alarm: bool = False  # whether the reader of the first page must not overlook it


@dataclass(frozen=True, kw_only=True)
class KeyFigure:
    """A figure by which drives are judged and compared."""

    name: str  # for programs and for comparing
    title: Text  # what it is: the same for every drive
    value: Quantity  # what it comes to
    place: Text = ""  # where, when or in which condition it is so
    # what it is allowed; where that is nothing and more is better, something must be left
    limit: Quantity | None = None
    # the other end of a band that it must leave: no more than the limit, or at least this
    beyond: Quantity | None = None
    # ``"less"`` where the value must not exceed the limit, ``"more"`` where it must not fall below; else empty
    better: Literal["more", "less", ""] = "less"
    verdict: str = ""  # how good that is, in a word
    tone: Tone = "plain"  # how good that is
    used: float | None = None  # share of the limit that is used, where it is not the quotient of value and limit
    check: str = ""  # check that judges it, whose verdict may tell the same
    repeats: str = ""  # figure of another answer that may tell the same

    @property
    def called(self) -> Text:
        """What it is, and where."""
        return Joined([self.title, self.place])

    @property
    def utilisation(self) -> float | None:
        """Share of the limit that is used; None without a limit."""
        if self.limit is None or self.used is not None:
            return self.used
        over, under = (self.limit, self.value) if self.better == "more" else (self.value, self.limit)
        return float(over.value) / float(under.value) if under.value else float("inf") if over.value else 0.0


@dataclass(frozen=True, kw_only=True)
class Listing:
    """Text as it stands in a file."""

    title: str
    text: str
    depth: Depth = "full"


@dataclass(frozen=True, eq=False, kw_only=True)
class Answer:
    """Everything that is said of one question, whoever shows it."""

    name: str  # of the question
    title: str  # heading of its page
    sentence: Text  # what it comes to
    tone: Tone = "plain"  # how good that is
    tables: Sequence[Table] = ()  # tables, remarks, listings: below each other
    remarks: Sequence[Remark] = ()
    listings: Sequence[Listing] = ()
    keys: Sequence[KeyFigure] = ()  # what of it stands on the first page
    figures: Callable[[], Sequence[Any]] = tuple  # makes its figures when they are asked for
    # what else a program is told: a tree of mappings, lists, quantities, words and numbers without a unit. A quantity
    # gets the unit of the reader behind its key.
    facts: Mapping[str, Any] = field(default_factory=dict)
    # makes the table of everything, for CSV and, under its name, for JSON; or the same piece by piece, for CSV alone
    full: Callable[[], Table | Iterable[Table]] | None = None
    code: int = 0  # exit code of the command: 1 where a limit is broken


def heads(heading: str, names: Sequence[str], *, chips: Sequence[str] = ()) -> tuple[Column, ...]:
    """Return the columns that head a table of parts counted from 1: number with name for people, each for programs.

    names: their names, empty where they have none; chips: colours before them.
    """
    numbers = list(range(1, len(names) + 1))
    shown: list[Any] = [f"{number} {name}".strip() for number, name in zip(numbers, names, strict=True)]
    if chips:
        shown = [Cell(value=text, chip=chip) for text, chip in zip(shown, chips, strict=True)]
    return (
        Column(key="", heading=heading, values=shown),
        Column(key="number", values=numbers, depth="data"),
        Column(key="name", values=list(names), depth="data"),
    )


def bare(value: Value) -> Any:
    """Return the value of a cell without its looks."""
    return value.value if isinstance(value, Cell) else value


def words_of(value: Any, reader: Reader) -> Any:
    """Return a text of an answer as words; anything else as it is."""
    return told(value, reader) if hasattr(value, "told") else value


# Checks of an answer on itself, and how closely they hold: digits beyond the power of ten are the processor's.

SHORT = -2  # powers of ten from this on are written out


@dataclass(frozen=True, kw_only=True)
class Checked:
    """One check."""

    what: str  # what, how: what is checked, and how
    how: str
    left: float  # what is left over, relative
    allowed: float  # how much may be

    @property
    def passed(self) -> bool:
        """Whether no more is left than may be."""
        return self.left <= self.allowed


def checks(rows: Sequence[Checked], depth: Depth = "full") -> Table:
    """Return the table of checks; residuals are told to people by their power of ten, to programs in full."""
    tones: list[Tone] = ["good" if one.passed else "failed" for one in rows]
    words = [_("passed") if one.passed else _("failed") for one in rows]
    return Table(
        name="checks",
        title=_("Self-checks"),
        records=True,
        columns=(
            Column(key="what", heading=_("what"), values=[one.what for one in rows]),
            Column(key="how", heading=_("how"), values=[one.how for one in rows]),
            Column(key="", heading=_("residual"), values=[leftover(one.left) for one in rows]),
            Column(key="", heading=_("allowed"), values=[_power(one.allowed) for one in rows]),
            Column(
                key="",
                heading=_("verdict"),
                values=[Cell(value=word, tone=tone) for word, tone in zip(words, tones, strict=True)],
            ),
            Column(key="residual", values=[one.left for one in rows], depth="data"),
            Column(key="allowed", values=[one.allowed for one in rows], depth="data"),
        ),
        depth=depth,
        aside=all(one.passed for one in rows),
    )


def leftover(residual: float) -> str:
    """Return a residual for a cell beside what is allowed: below which power of ten it is, or that it is rounding."""
    if not math.isfinite(residual):
        return "–"
    power = power_of(residual)
    return _("rounding") if power is None else f"< {_ten(power)}"


def closely(residual: float) -> str:
    """Return how closely a check holds, for a sentence."""
    if not math.isfinite(residual):
        return _("not at all")
    power = power_of(residual)
    return _("to rounding") if power is None else _("to {size}").format(size=_ten(power))


def _power(value: float) -> Text:
    power = math.log10(value) if value > 0.0 else 0.0
    round_ten = value and power < SHORT and abs(power - round(power)) < 1e-9
    return _ten(round(power)) if round_ten else Quantity(value, digits=2, trim=True)


def _ten(power: int) -> str:
    return f"{10.0**power:g}" if power >= SHORT else f"10{raised(power)}"
