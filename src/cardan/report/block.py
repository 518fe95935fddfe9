"""What a page of the report is made of: words, tables, pictures, written out for who reads here.

Only data; the template gives it its looks. Texts may hold quantities: they are told in the units of the reader, see
`cardan.answers.reader.reading`, as soon as they stand on a page.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

from cardan.answers import answer
from cardan.answers.answer import Answer, Depth, KeyFigure, Listing, Tone
from cardan.answers.printed import SHOWN, SIGNS, Cell, Column, Table, framed, printed
from cardan.answers.printed import number as printed_number
from cardan.answers.quantity import Quantity, say, told
from cardan.answers.question import Lacking
from cardan.answers.reader import Reader, reader
from cardan.figures.figure import Figure
from cardan.figures.for_reader import for_reader
from cardan.texts import _

Text: TypeAlias = Any  # a `cardan.answers.quantity.Text` where a page is made, a str on the page


def shown(text: Text) -> str:
    """Return a text as who reads here is told it."""
    return told(text, reader())


def table(given: answer.Table, depth: Depth = "full") -> Table:
    """Return a table as who reads here sees it."""
    return printed(_filled(given), reader(), depth)


def _filled(given: answer.Table) -> answer.Table:
    """Return a table without the columns that hold nothing."""
    columns = [one for one in given.columns if not len(one.values) or not all(map(_nothing, one.listed))]
    return replace(given, columns=columns)


def _nothing(value: answer.Value) -> bool:
    own = answer.bare(value)
    return own is None or (isinstance(own, float) and math.isnan(own))


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
    tone: Tone = "plain"  # how good it is
    keys: Sequence[Any] = ()  # what of it stands on the first page
    alarms: Sequence[Words] = ()  # what of it the reader of the first page must not overlook
    lacking: Lacking = ()  # what the drive file lacks, where it tells nothing for want of keys

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


# An answer as a page of the report, for one reader: HTML, PDF, workbook and app show it.

SAME = 1e-6  # numbers that differ by less of them are one and the same
MOST = 1000.0  # a limit that is exceeded more often is told as exceeded beyond that


def page(answer: Answer, reader: Reader, depth: Depth = "full", *, whole: bool = True) -> Page:
    """Return an answer as a page: its figures, its tables, what to mind; whole with what stands aside."""
    return Page(
        name=answer.name,
        title=answer.title,
        answer=capital(told(answer.sentence, reader)),
        blocks=list(_blocks(answer, reader, depth, whole)),
        tone=answer.tone,
        keys=answer.keys,
        alarms=[Words(text=told(one.text, reader), tone=one.tone) for one in answer.remarks if one.alarm],
    )


def _blocks(answer: Answer, reader: Reader, depth: Depth, whole: bool) -> Iterator[Block]:
    shown = SHOWN[depth]
    remarks = [one for one in _of(answer.remarks, whole) if one.depth in shown and one.tone != "next"]
    yield from (Words(text=told(one.text, reader), tone=one.tone) for one in remarks if one.tone == "failed")
    yield from (Picture(figure=one) for one in _of(answer.figures(), whole))
    yield from (printed(_filled(one), reader, depth) for one in _of(answer.tables, whole) if one.depth in shown)
    yield from (Words(text=told(one.text, reader)) for one in remarks if one.tone in ("plain", "good"))
    minded = [told(one.text, reader) for one in remarks if one.tone == "warning"]
    if minded:
        yield Points(title=_("To mind"), items=list(dict.fromkeys(minded)))
    yield from (one for one in answer.listings if one.depth in shown)


def _of(parts: Iterable[Any], whole: bool) -> list[Any]:
    """Return parts of an answer, without those that stand aside where it is not told whole."""
    return [one for one in parts if whole or not one.aside]


def key_figures(told: Iterable[Sequence[KeyFigure]]) -> list[KeyFigure]:
    """Return the key figures of the first page, by which drives are compared.

    told: those of each answer. Of a name that several tell the worst counts, as of a drive that moves; of equal ones
    the last, which knows more, where the first stood.
    """
    found: dict[str, list[KeyFigure]] = {}
    for keys in told:
        for name in dict.fromkeys(one.name for one in keys):
            new, old = [one for one in keys if one.name == name], found.get(name, [])
            if not (len(old) == len(new) == 1 and _worse(old[0], new[0])):
                found[name] = new
    return [one for keys in found.values() for one in keys]


def _worse(one: KeyFigure, other: KeyFigure) -> bool:
    """Tell whether a key figure is worse than another one of its name."""
    if not one.better or one.value.dimension != other.value.dimension:
        return False
    mine, theirs = float(one.value.value), float(other.value.value)
    return (mine > theirs) == (one.better == "less") and not math.isclose(mine, theirs, rel_tol=SAME)


def untold(keys: Sequence[KeyFigure], limits: Sequence[KeyFigure]) -> list[KeyFigure]:
    """Return the key figures that neither a verdict of the table of limits nor the figure they repeat tells already."""
    return [
        key
        for key in keys
        if not any(key.check == one.name.partition(" ")[0] and _same(key, one) for one in limits if key.check)
        and not any(key.repeats == one.name and _same(key, one) for one in keys)
    ]


def _same(one: KeyFigure, other: KeyFigure) -> bool:
    """Tell whether two figures are the same number of the same dimension."""
    own, told = one.value, other.value
    return own.dimension == told.dimension and math.isclose(own.value, told.value, rel_tol=SAME)


def key_table(keys: Sequence[KeyFigure]) -> Table:
    """Return key figures as a table: what, value, unit, limit, utilisation, verdict."""
    return Table(columns=verdict_columns(), rows=[row(one, reader()) for one in keys])


def row(key: KeyFigure, reader: Reader) -> list[Cell]:
    """Return the row of a key figure: what, value, unit, limit, utilisation, verdict."""
    value = printed_number(key.value, reader, unit=False)
    limit, used = Cell(text="–"), Cell(text="–")
    if key.limit is not None and key.utilisation is not None:
        bound = printed_number(key.limit, reader, unit=False)
        sign = "≤ " if key.better != "more" else "≥ " if key.limit.value else "> "
        limit = Cell(text=sign + bound.text, full=bound.full, amount=bound.amount, form=framed(bound.form, sign))
        if key.beyond is not None:
            limit = Cell(text=told(say(_("≤ {low:bare} or ≥ {high:bare}"), low=key.limit, high=key.beyond), reader))
        used = printed_number(Quantity(key.utilisation, decimals=2, most=MOST), reader, unit=False)
    unit = reader.label(key.value.dimension, key.value.unit)
    verdict = Cell(text=key.verdict, tone=key.tone if key.verdict else "plain")
    return [Cell(text=told(key.called, reader)), value, Cell(text=unit), limit, used, verdict]


def capital(text: str) -> str:
    """Return a sentence that begins with a capital letter."""
    return text[:1].upper() + text[1:]
