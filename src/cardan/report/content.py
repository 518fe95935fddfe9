"""What a report says, made once for every form that it is written in."""

from __future__ import annotations

import datetime
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from cardan.answers.answer import Answer
from cardan.answers.quantity import Joined
from cardan.answers.question import Question
from cardan.answers.reader import reader, reading
from cardan.book import answer as classical
from cardan.catalogue import Catalogue
from cardan.checks.verdict_table import BY, MISSING
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.errors import InputError
from cardan.figures import Figure
from cardan.figures.drive import space_figure
from cardan.files import Enclosed
from cardan.questions.gathering import gather, principal
from cardan.questions.motion import answer as motion
from cardan.questions.motion import articulation_answer as articulation
from cardan.questions.phases import answer as yokes
from cardan.register import QUESTIONS
from cardan.texts import _
from cardan.version import VERSION

from .answers import (
    changes_by_laws,
    found_page,
    judgement_by_laws,
    method_by_laws,
    refused,
    warnings_by_laws,
)
from .block import Block, Page, Picture, Points, Table, Words, key_figures, key_table, page, untold
from .description import description
from .method import method
from .subject import Subject, asked
from .summary import changes, judgement, warnings
from .title_block import Head, Noting, logo_of, rows
from .verdicts import Judged, judged


def today() -> str:
    """Return the day, as in 2026-01-31, the same everywhere."""
    return datetime.datetime.now(tz=datetime.UTC).date().isoformat()


@dataclass(frozen=True, eq=False, kw_only=True)
class Content:
    """A report before it is written."""

    title: str  # name of the drive
    note: str  # what its file says about it
    version: str  # version of cardan that calculated it
    date: str  # day of the report, as in 2026-01-31
    head: Head  # client, drawing, author, logo, units
    judgement: Words  # the sentence the reader came for
    warnings: tuple[Words, ...]  # what the reader must not overlook
    lights: Table | None  # the verdicts that matter most; None where nothing was judged
    remedies: Table | None  # the changes that help most against failed verdicts; None where nothing fails
    sketch: Figure  # the drive in space
    figures: Table  # key figures with their limits
    changes: Table | Words  # changes that make the output more even
    pages: tuple[Page, ...]  # what follows the summary, in order
    kind: str = ""  # what it is a report of, where that is no drive
    appendix: tuple[Page, ...] = ()  # what few ask for, at the end; empty where it was not asked for


@dataclass(frozen=True, eq=False, kw_only=True)
class Excerpt:
    """A page of a report by itself."""

    title: str  # name of the drive; that of the page where it has none
    page: Page
    note: str = ""  # below the title
    kind: str = ""  # what it is a report of, where that is no drive
    version: str = VERSION  # version of cardan that calculated it
    date: str = field(default_factory=today)  # day of the excerpt, as in 2026-01-31


def content(
    drive: Drive,
    duty: Duty | None = None,
    *,
    source_text: str | None = None,
    full: bool = False,
    progress: Callable[[float], object] | None = None,
    known: Catalogue | None = None,
    folder: str | Path | Enclosed = ".",
) -> Content:
    """Return what the report of a drive says.

    drive: the drive; duty: what it does; None takes the drive's own duty.
    source_text: text of the drive file, shown in the appendix.
    full: with the appendix: phase polygon, classical approximations, method and evidence, the drive file.
    progress: called with the share done; answering "stop" leaves out what is still to be calculated.
    known: norms, types and sizes that it is judged by; the shipped ones when not given.
    folder: where the logo is looked for.
    """
    logo, who = logo_of(drive.report, folder), Noting(units=reader().units, decimal=reader().decimal)
    with reading(who):
        on = replace(asked(drive, duty, progress), known=known)
        limits = judged(on) if on.complete else Judged()
        said = _said(on, limits)
        front = [one for one in said.pages if not _calm(one)]
        if full:
            aside = [one for one in said.pages if _calm(one)]
            said = replace(said, appendix=(*aside, *_appendix(on, limits, source_text)))
        said = replace(said, pages=tuple(_told_once(front)))
    return replace(said, head=Head(rows=tuple(rows(drive.report)), units=who.line(), logo=logo))


def _said(on: Subject, limits: Judged) -> Content:
    """Return what a report says, without its head and its appendix."""
    pages: list[Page] = [description(on), moved(on.drive), phased(on), *_articulated(on)]
    pages += loaded(on, judged=limits.page is not None)
    if limits.page is not None:
        pages.append(limits.page)
    keys = key_figures([*(one.keys for one in pages), limits.keys])
    return Content(
        title=on.drive.name or _("Universal-joint drive"),
        note=on.drive.note,
        version=VERSION,
        date=today(),
        head=Head(),
        judgement=(judgement_by_laws if on.by_laws else judgement)(on, pages),
        warnings=tuple((warnings_by_laws if on.by_laws else warnings)(on, pages)),
        lights=limits.lights,
        remedies=limits.changes,
        sketch=space_figure(on.drive, on.seen, name="sketch"),
        figures=key_table(untold(keys, limits.urgent)),
        changes=changes_by_laws(on) if on.by_laws else changes(on),
        pages=tuple(pages),
    )


def moved(drive: Drive) -> Page:
    """Return the page of the motion: joints have their angles on the page before, shafts theirs in a table."""
    said = gather(QUESTIONS["motion"], drive, motion.answer(drive, motion.ask(drive)))
    drawn = [one for one in said.figures() if one.name != "speed_fluctuation"]
    tables = [one for one in said.tables if one.name != "joints"]
    return page(replace(said, tables=tables, figures=lambda: drawn), reader())


def phased(on: Subject) -> Page:
    """Return the page of the yokes, without their polygon; where joints turn by own laws mostly why there is none."""
    try:
        said = yokes.answer(on.drive, on.phasing)
    except InputError as error:
        if not on.by_laws:
            raise
        return replace(refused("phasing", _("Phasing of the yokes"), error), alarms=())
    said = gather(QUESTIONS["phasing"], on.drive, said)
    drawn = [one for one in said.figures() if one.name != yokes.POLYGON]
    remarks = [one for one in said.remarks if one.code != yokes.POLYGON]
    return page(replace(said, remarks=remarks, figures=lambda: drawn), reader())


def _appendix(on: Subject, limits: Judged, source_text: str | None) -> Iterator[Page]:
    """Yield what few ask for: parts alone, checks not run, polygon of yokes, classical formulas, method, file."""
    for question in _asked(on):
        said = found_page(question, on) if _within(question, on) else None
        if said is not None:
            yield said
    if limits.missing is not None:
        yield limits.missing
    if not on.by_laws:
        drawn = [
            Picture(figure=one) for one in yokes.answer(on.drive, on.phasing).figures() if one.name == yokes.POLYGON
        ]
        proof = Joined(yokes.proof(on.drive, on.phasing), between=" ")
        yield Page(name=yokes.POLYGON, title=_("Phase polygon"), answer=proof, blocks=drawn)
    seen = classical.ask(on.drive)
    if seen is not None and classical.differ(seen):
        yield page(gather(QUESTIONS["classical"], on.drive, classical.answer(on.drive, seen)), reader())
    yield (method_by_laws if on.by_laws else method)(on, source_text)


def _articulated(on: Subject) -> Iterator[Page]:
    """Yield the page of the movement, if any; what it warns of stands on the first page."""
    if on.by_laws:
        return
    if on.moving is not None:
        said = gather(QUESTIONS["articulation"], on.drive, articulation.answer(on.drive, on.moving))
        calm = [one for one in said.remarks if one.tone not in ("failed", "warning")]
        yield page(replace(said, remarks=calm), reader())
    if on.unmoved is not None:
        yield refused("articulation", _("Articulation"), on.unmoved)


# The parts of the report about a drive under load and as made: each only where the drive file says enough.


def loaded(on: Subject, *, judged: bool) -> Iterator[Page]:
    """Yield the parts that the drive file asks for; none once the reader stopped the work.

    judged: a page of checks follows, which tells all verdicts.
    """
    shorter = _without_verdicts if judged else None
    for question in _asked(on) if on.complete else ():
        if not _within(question, on):
            page = found_page(question, on, shorter=shorter)
            if page is not None:
                yield page


def _asked(on: Subject) -> Iterator[Question]:
    """Yield the questions with a page of the report for which the drive file says enough."""
    for question in QUESTIONS.values():
        if question.report and not question.apart and not question.lacking(principal(question, on.drive)):
            yield question


def _calm(page: Page) -> bool:
    """Tell whether few ask for a page, for all is good."""
    return page.tone == "good" and page.name in QUESTIONS and QUESTIONS[page.name].calm


def _within(question: Question, on: Subject) -> bool:
    """Tell whether the page of another question tells the same of more."""
    return bool(question.within) and not QUESTIONS[question.within].lacking(principal(question, on.drive))


def _without_verdicts(said: Answer) -> Answer:
    """Return an answer without its verdicts, in tables and figures: the page of checks tells them."""
    judged = [one for one in said.tables if any(column.key == BY for column in one.columns)]
    if not judged:
        return said
    tables = [one for one in said.tables if one not in judged and one.name != MISSING]
    return replace(said, tables=tables, figures=lambda: [one for one in said.figures() if one.name != said.name])


def _told_once(pages: Sequence[Page]) -> Iterator[Page]:
    """Yield pages; what is to be minded of several, or is of the drive, is told on the first of them."""
    told: set[str] = set()
    for one in pages:
        blocks: list[Block] = []
        for block in one.blocks:
            if isinstance(block, Points):
                items = _new(block.items, told)
                blocks += [replace(block, items=items)] if items else []
            elif not isinstance(block, Words) or not block.once or _new([block.text], told):
                blocks.append(block)
        yield replace(one, blocks=blocks)


def _new(items: Sequence[str], told: set[str]) -> list[str]:
    """Return the items that were not told yet, which are then."""
    found = [one for one in items if one not in told]
    told.update(found)
    return found
