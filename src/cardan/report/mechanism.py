"""The report of a mechanism: every question of the register that a mechanism file answers, each as a page."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from cardan.answers.reader import reader, reading
from cardan.drive.settings import TitleBlock
from cardan.errors import InputError
from cardan.files import Enclosed
from cardan.mechanism.mechanism import PAIRS, Mechanism
from cardan.questions.mechanism.figure import space_figure
from cardan.questions.mechanism.motion import MechanismMotion
from cardan.questions.mobility.figure import graph_figure
from cardan.questions.mobility.mobility import mobility
from cardan.register import QUESTIONS
from cardan.texts import _
from cardan.version import VERSION

from .answers import refused
from .block import Block, Cell, Column, Listing, Page, Table, Tone, Words, key_figures, key_table, page
from .content import Content, today
from .look import Look
from .title_block import Head, given, logo_of, noting, rows


def content(
    mechanism: Mechanism,
    head: TitleBlock,
    *,
    source_text: str | None = None,
    full: bool = False,
    folder: str | Path | Enclosed = ".",
    look: Look | None = None,
) -> Content:
    """Return what the report of a mechanism says.

    head: client, drawing, author, logo; source_text: text of its file, shown in the appendix; full: with the appendix.
    folder: where the logo is looked for; look: colours, type, paper, words at head and foot.
    """
    look = look or Look()
    logo, who = logo_of(head, folder) or look.picture, noting(reader())
    with reading(who):
        said = _said(mechanism, whole=full)
        if full and source_text is not None:
            answer = _("Calculated by cardan {version}.").format(version=VERSION)
            listing: list[Block] = [Listing(title=_("Input file"), text=source_text)]
            last = Page(name="method", title=_("Method and evidence"), answer=answer, blocks=listing)
            said = replace(said, appendix=(last,))
    block = Head(rows=tuple(rows(head)), units=who.line(), logo=logo, given=given(head))
    return replace(said, head=block, look=look)


def _said(mechanism: Mechanism, *, whole: bool) -> Content:
    motion: MechanismMotion | None = None
    pages = [_described(mechanism)]
    for question in QUESTIONS.values():
        if not question.mechanism:
            continue
        asked = question.of_mechanism
        if asked.lacking(mechanism):
            continue
        try:
            found = asked.ask(mechanism)
        except InputError as error:
            pages.append(refused(question.name, _(question.title), error))
            continue
        if isinstance(found, MechanismMotion):
            motion = found
        if found is not None:
            pages.append(page(asked.answer(mechanism, found), reader(), whole=whole))
    told = next((one for one in pages[1:] if not one.alarms), pages[-1])
    alarms = [alarm for one in pages for alarm in one.alarms]
    tones = {one.tone for one in alarms} | {one.tone for one in pages}
    tone: Tone = "failed" if "failed" in tones else "warning" if alarms else "good"
    sketch = graph_figure(mobility(mechanism)) if motion is None else space_figure(motion)
    return Content(
        title=mechanism.name or _("Mechanism"),
        note=mechanism.note,
        version=VERSION,
        date=today(),
        head=Head(),
        kind=_("Mechanism report"),
        judgement=Words(text=told.answer, tone=tone),
        warnings=tuple(alarms),
        lights=None,
        remedies=None,
        sketch=sketch,
        figures=key_table(key_figures([one.keys for one in pages])),
        changes=Words(text=next((one.answer for one in pages if one.name == "mobility"), "")),
        pages=tuple(_without(one, sketch.name) for one in pages),
    )


def _without(one: Page, sketch: str) -> Page:
    """Return a page without the figure that stands on the first one."""
    kept = [block for block in one.blocks if getattr(getattr(block, "figure", None), "name", "") != sketch]
    return replace(one, blocks=kept)


def _described(mechanism: Mechanism) -> Page:
    """Return the page of links and joints."""
    answer = _("{links} moving links and {joints} joints; {frame} is at rest.").format(
        links=len(mechanism.links), joints=len(mechanism.joints), frame=mechanism.frame
    )
    return Page(name="description", title=_("Description"), answer=answer, blocks=list(_tables(mechanism)))


def _tables(mechanism: Mechanism) -> Iterator[Block]:
    who = reader()
    unit, factor = who.label("length"), who.unit("length", "")[1]

    def place(values: tuple[float, ...], over: float) -> Cell:
        return Cell(text="; ".join(who.number(one / over, 5, trim=True) for one in values))

    heads = (_("joint"), _("kind"), _("first link"), _("second link"))
    columns = [Column(heading=one, left=True) for one in heads]
    columns += [Column(heading=_("point"), unit=unit), Column(heading=_("axis"))]
    yield Table(
        columns=tuple(columns),
        rows=[
            [
                *(Cell(text=one) for one in (pair.id, _(PAIRS[pair.type].name), *pair.links)),
                place(pair.point, factor),
                Cell(text="–") if pair.axis is None else place(tuple(pair.along.tolist()), 1.0),
            ]
            for pair in mechanism.joints
        ],
    )
