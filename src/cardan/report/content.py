"""What a report says, made once for every form that it is written in."""

from __future__ import annotations

import datetime
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from cardan.answers.question import Question
from cardan.answers.reader import reader, reading
from cardan.book import answer as classical
from cardan.catalogue import Catalogue
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.errors import InputError
from cardan.figures.drive import space_figure
from cardan.figures.figure import Figure
from cardan.files import Enclosed
from cardan.questions.gathering import gather, principal
from cardan.questions.motion import answer as motion
from cardan.questions.motion import articulation_answer as articulation
from cardan.questions.phases import answer as yokes
from cardan.register import QUESTIONS
from cardan.texts import _
from cardan.version import VERSION

from .answers import changes_by_laws, found_page, judgement_by_laws, method_by_laws, refused, warnings_by_laws
from .block import Block, Page, Points, Table, Words, key_figures, key_table, page, untold
from .description import description
from .look import Line, Look, pieces
from .method import method
from .subject import Subject, asked
from .summary import changes, judgement, warnings
from .title_block import Head, given, logo_of, noting, rows
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
    look: Look = field(default_factory=Look)  # colours, type, paper, words at head and foot

    def words_for(self, line: Line) -> list[list[tuple[str, str]]]:
        """Return the words at the head or the foot of every page in pieces, see `pieces`: left, middle and right."""
        said = {"date": self.date, **self.head.given, "title": self.title, "version": self.version}
        return [list(pieces(part, said)) for part in (line.left, line.middle, line.right)]


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
    look: Look | None = None,
) -> Content:
    """Return what the report of a drive says.

    drive: the drive; duty: what it does; None takes the drive's own duty.
    source_text: text of the drive file, shown in the appendix.
    full: with the appendix: phase polygon, classical approximations, method and evidence, the drive file.
    progress: called with the share done; answering "stop" leaves out what is still to be calculated.
    known: norms, types and sizes that it is judged by; the shipped ones when not given.
    folder: where the logo is looked for.
    look: colours, type, paper, words at head and foot, as of `cardan.report.look.look_of`.
    """
    look = look or Look()
    logo, who = logo_of(drive.report, folder) or look.picture, noting(reader())
    with reading(who):
        on = replace(asked(drive, duty, progress), known=known)
        limits = judged(on, whole=full) if on.complete else Judged()
        said = _said(on, limits, source_text, full=full)
    head = Head(rows=tuple(rows(drive.report)), units=who.line(), logo=logo, given=given(drive.report))
    return replace(said, head=head, look=look)


def _said(on: Subject, limits: Judged, source_text: str | None, *, full: bool) -> Content:
    """Return what a report says, without its head."""
    main, aside = placed(on)
    told = [description(on), *pages_of(on, main, limits, whole=full)]
    calm = [one for one in told if one.tone == "good" and one.name in QUESTIONS and QUESTIONS[one.name].place.calm]
    keys = key_figures([*(one.keys for one in told), limits.keys])
    behind = (*calm, *pages_of(on, aside, limits), *_appendix(on, limits, source_text)) if full else ()
    first = tuple((warnings_by_laws if on.by_laws else warnings)(on, told))
    return Content(
        title=on.drive.name or _("Universal-joint drive"),
        note=on.drive.note,
        version=VERSION,
        date=today(),
        head=Head(),
        judgement=(judgement_by_laws if on.by_laws else judgement)(on, told),
        warnings=first,
        lights=limits.lights,
        remedies=limits.changes,
        sketch=space_figure(on.drive, on.seen, name="sketch"),
        figures=key_table(untold(keys, limits.urgent)),
        changes=changes_by_laws(on) if on.by_laws else changes(on),
        pages=tuple(_told_once([one for one in told if one not in calm], {one.text for one in first})),
        appendix=behind,
    )


def placed(on: Subject) -> tuple[list[Question], list[Question]]:
    """Return the questions for which the drive file says enough: those of the main part, and those that stand aside."""
    some = {name: one for name, one in QUESTIONS.items() if one.place.part != "nowhere"}
    found = {name: one for name, one in some.items() if not one.lacking(principal(one, on.drive))}
    order = sorted(found.values(), key=lambda one: one.place.order)
    aside = [one for one in order if one.place.part == "aside" or one.place.beside in found]
    return [one for one in order if one.place.part == "main" and one not in aside], aside


def pages_of(on: Subject, questions: Sequence[Question], limits: Judged, *, whole: bool = True) -> Iterator[Page]:
    """Yield the pages of questions; once the reader stopped the work those alone whose answer is there already."""
    for question in questions:
        if question.name == "check":
            made = limits.page
        elif question.name in OWN:
            made = OWN[question.name](on, whole)
        else:
            made = found_page(question, on, whole=whole) if on.complete else None
        if made is not None:
            yield made


# Questions that the first page has asked already, or of which the report tells less.


def moved(on: Subject, whole: bool = True) -> Page:
    """Return the page of the motion of the drive as drawn."""
    said = gather(QUESTIONS["motion"], on.drive, motion.answer(on.drive, motion.ask(on.drive)))
    return page(said, reader(), whole=whole)


def phased(on: Subject, whole: bool = True) -> Page:
    """Return the page of the yokes; where joints turn by own laws mostly why there is none."""
    try:
        said = gather(QUESTIONS["phasing"], on.drive, yokes.answer(on.drive, on.phasing))
    except InputError as error:
        if not on.by_laws:
            raise
        return replace(refused("phasing", _("Phasing of the yokes"), error), alarms=())
    return page(said, reader(), whole=whole)


def articulated(on: Subject, whole: bool = True) -> Page | None:
    """Return the page of the movement, if any; what it warns of stands on the first page."""
    if on.by_laws or on.moved is None:
        return None
    if isinstance(on.moved, InputError):
        return refused("articulation", _("Articulation"), on.moved)
    said = gather(QUESTIONS["articulation"], on.drive, articulation.answer(on.drive, on.moved))
    calm = [one for one in said.remarks if one.tone not in ("failed", "warning")]
    return page(replace(said, remarks=calm), reader(), whole=whole)


def compared(on: Subject, whole: bool = True) -> Page | None:
    """Return the page of the classical approximations, where they say something else than the exact motion."""
    seen = classical.ask(on.drive)
    if seen is None or not classical.differ(seen):
        return None
    return page(gather(QUESTIONS["classical"], on.drive, classical.answer(on.drive, seen)), reader(), whole=whole)


OWN: dict[str, Callable[[Subject, bool], Page | None]] = {
    "motion": moved,
    "phasing": phased,
    "articulation": articulated,
    "classical": compared,
}


def _appendix(on: Subject, limits: Judged, source_text: str | None) -> Iterator[Page]:
    """Yield what stands behind the questions of an appendix: checks not run, method and evidence, the drive file."""
    if limits.missing is not None:
        yield limits.missing
    yield (method_by_laws if on.by_laws else method)(on, source_text)


def _told_once(pages: Sequence[Page], told: set[str]) -> Iterator[Page]:
    """Yield pages; sentences that several of them say, below tables as well, are told on the first of them.

    told: what the summary says, to which is added.
    """
    for one in pages:
        blocks: list[Block] = []
        for block in one.blocks:
            if isinstance(block, Points):
                items = _new(block.items, told)
                blocks += [replace(block, items=items)] if items else []
            elif isinstance(block, Table):
                blocks.append(replace(block, note="".join(_new([block.note], told))))
            elif not isinstance(block, Words) or _new([block.text], told):
                blocks.append(block)
        yield replace(one, blocks=blocks)


def _new(items: Sequence[str], told: set[str]) -> list[str]:
    """Return the items that were not told yet, which are then."""
    found = [one for one in items if one not in told]
    told.update(found)
    return found
