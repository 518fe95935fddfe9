"""An answer as a page of the report, for one reader: HTML, PDF, workbook and app show it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from cardan.answers.answer import Answer, Depth, KeyFigure
from cardan.answers.printed import SHOWN, Cell, framed, number, printed
from cardan.answers.quantity import Quantity, say, told
from cardan.answers.reader import Reader, reader
from cardan.texts import _

from .block import Block, Page, Picture, Points, Table, Words, verdict_columns

MOST = 1000.0
"""A limit that is exceeded more often is told as exceeded beyond that."""


def page(answer: Answer, reader: Reader, depth: Depth = "full") -> Page:
    """Return an answer as a page: its figures, its tables, what to mind.

    reader: units and decimal sign.
    """
    return Page(
        name=answer.name,
        title=answer.title,
        answer=capital(told(answer.sentence, reader)),
        blocks=list(_blocks(answer, reader, depth)),
        keys=answer.keys,
        alarms=[Words(text=told(one.text, reader), tone=one.tone) for one in answer.remarks if one.alarm],
    )


def _blocks(answer: Answer, reader: Reader, depth: Depth) -> Iterator[Block]:
    shown = SHOWN[depth]
    remarks = [one for one in answer.remarks if one.depth in shown and one.tone != "next"]
    yield from (Words(text=told(one.text, reader), tone=one.tone) for one in remarks if one.tone == "failed")
    yield from (Picture(figure=one) for one in answer.figures())
    yield from (printed(one, reader, depth) for one in answer.tables if one.depth in shown)
    yield from (Words(text=told(one.text, reader)) for one in remarks if one.tone in ("plain", "good"))
    minded = [told(one.text, reader) for one in remarks if one.tone == "warning"]
    if minded:
        yield Points(title=_("To mind"), items=list(dict.fromkeys(minded)))
    yield from (one for one in answer.listings if one.depth in shown)


def key_figures(told: Iterable[Sequence[KeyFigure]]) -> list[KeyFigure]:
    """Return the key figures of the first page, by which drives are compared.

    told: those of each answer. Of a name that several tell the last one counts, which knows more, where the first
    stood.
    """
    found: dict[str, list[KeyFigure]] = {}
    for keys in told:
        found.update({name: [one for one in keys if one.name == name] for name in dict.fromkeys(k.name for k in keys)})
    return [one for keys in found.values() for one in keys]


def key_table(keys: Sequence[KeyFigure]) -> Table:
    """Return key figures as a table: what, value, unit, limit, utilisation, verdict."""
    return Table(columns=verdict_columns(), rows=[row(one, reader()) for one in keys])


def row(key: KeyFigure, reader: Reader) -> list[Cell]:
    """Return the row of a key figure: what, value, unit, limit, utilisation, verdict."""
    value = number(key.value, reader, unit=False)
    limit, used = Cell(text="–"), Cell(text="–")
    if key.limit is not None and key.utilisation is not None:
        bound = number(key.limit, reader, unit=False)
        sign = "≥ " if key.better == "more" else "≤ "
        limit = Cell(text=sign + bound.text, full=bound.full, amount=bound.amount, form=framed(bound.form, sign))
        if key.beyond is not None:
            limit = Cell(text=told(say(_("≤ {low:bare} or ≥ {high:bare}"), low=key.limit, high=key.beyond), reader))
        used = number(Quantity(key.utilisation, decimals=2, most=MOST), reader, unit=False)
    unit = reader.label(key.value.dimension, key.value.unit)
    verdict = Cell(text=key.verdict, tone=key.tone if key.verdict else "plain")
    return [Cell(text=told(key.called, reader)), value, Cell(text=unit), limit, used, verdict]


def capital(text: str) -> str:
    """Return a sentence that begins with a capital letter.

    >>> capital("joint 2 fails first.")
    'Joint 2 fails first.'
    """
    return text[:1].upper() + text[1:]
