"""What a page of the report is made of: words, tables, pictures, written out for who reads here.

Only data; the template gives it its looks. Texts may hold quantities: they are told in the units of the reader, see
`cardan.answers.reader.reading`, as soon as they stand on a page.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from cardan.answers import answer
from cardan.answers.answer import Depth, Listing, Tone
from cardan.answers.printed import SIGNS, Cell, Column, Table, printed
from cardan.answers.quantity import told
from cardan.answers.reader import reader
from cardan.figures import Figure
from cardan.figures.for_reader import for_reader
from cardan.texts import _

Text: TypeAlias = Any
"""A `cardan.answers.quantity.Text` where a page is made, a str on the page."""


def shown(text: Text) -> str:
    """Return a text as who reads here is told it."""
    return told(text, reader())


def table(given: answer.Table, depth: Depth = "full") -> Table:
    """Return a table as who reads here sees it."""
    return printed(given, reader(), depth)


@dataclass(frozen=True, kw_only=True)
class Words:
    """A paragraph; with a tone, a boxed remark."""

    text: Text
    tone: Tone = "plain"
    title: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "text", shown(self.text))

    @property
    def sign(self) -> str:
        """Sign of the tone."""
        return SIGNS[self.tone]


@dataclass(frozen=True, kw_only=True)
class Points:
    """A list of short remarks."""

    title: str
    items: Sequence[Text]

    def __post_init__(self) -> None:
        object.__setattr__(self, "items", [shown(one) for one in self.items])


@dataclass(frozen=True, eq=False, kw_only=True)
class Picture:
    """A figure of the report, its texts in words."""

    figure: Figure

    def __post_init__(self) -> None:
        object.__setattr__(self, "figure", for_reader(self.figure, reader()))


Block: TypeAlias = Table | Words | Points | Listing | Picture


@dataclass(frozen=True, eq=False, kw_only=True)
class Page:
    """A numbered part of the report."""

    name: str  # for links
    title: str  # heading
    answer: Text  # what it comes to, in a sentence
    blocks: Sequence[Block]  # from the top
    keys: Sequence[Any] = ()  # what of it stands on the first page
    alarms: Sequence[Words] = ()  # what of it the reader of the first page must not overlook

    def __post_init__(self) -> None:
        object.__setattr__(self, "answer", shown(self.answer))


__all__ = ["SIGNS", "Block", "Cell", "Column", "Listing", "Page", "Picture", "Points", "Table", "Tone", "Words"]


def words(text: str, tone: Tone = "plain") -> Cell:
    """Return a cell of words."""
    return Cell(text=text, tone=tone)


def number(text: str, value: float | None = None, tone: Tone = "plain") -> Cell:
    """Return a cell with a number, and the same in full precision."""
    if value is None or not math.isfinite(value):
        return Cell(text=text, tone=tone)
    return Cell(text=text, tone=tone, full=repr(float(value)), amount=float(value), form="General")


def verdict_columns() -> tuple[Column, ...]:
    """Return the columns of a table of figures with their limits."""
    return (
        Column(heading=_("what"), left=True),
        Column(heading=_("value")),
        Column(heading="", left=True),
        Column(heading=_("limit")),
        Column(heading=_("utilisation")),
        Column(heading=_("verdict"), left=True),
    )
