"""A question about a drive, and its answer: what the pages of the app show, made here or in a process of its own."""

from __future__ import annotations

import re
from collections import OrderedDict
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any, Literal, TypeAlias

from cardan import Verdict, check
from cardan.answers.answer import Answer
from cardan.answers.reader import reading
from cardan.catalogue import Catalogue, known_to
from cardan.drive.drive import Drive
from cardan.drive.settings import TitleBlock
from cardan.errors import CardanError, refuse
from cardan.files import Enclosed
from cardan.io import dumps
from cardan.mechanisms import Mechanism
from cardan.register import QUESTIONS
from cardan.report.answers import answered, subject
from cardan.report.block import Page, Picture
from cardan.report.compare import Variant, compared
from cardan.report.content import Content, content
from cardan.report.mechanism import content as of_mechanism
from cardan.report.recorded import Recorded
from cardan.report.render.exports import Exported, exported
from cardan.report.render.renderer import renderer_for
from cardan.report.subject import Subject
from cardan.report.swept import Swept, swept
from cardan.report.verdict_list import Headline, Light, headline, lights, with_remedies
from cardan.scene.scene import Scene, scene
from cardan.texts import _, speaking

from . import recordings
from .document import Document, Edit
from .question import Progress, Question, asked
from .session import Session

Drawn: TypeAlias = tuple[Scene, dict[str, Any]]  # a drive in space, and the same as the browser draws it
Judged: TypeAlias = tuple[Headline, tuple[Light, ...]]  # the number that stands first, and the verdicts
Result: TypeAlias = (
    Page | tuple[Page, ...] | Judged | tuple[Light, ...] | Exported | Recorded | Swept | Drawn | Document
)


VERDICTS, REMEDIES, SCENE, SWEEP, MECHANISM = "verdicts", "remedies", "scene", "sweep", "mechanism"
"""Questions beside those of the register: the verdicts, the same with what cures them, the drive in space, a sweep, all
that there is to say of a mechanism."""

RETOLD = 6  # long answers that a process keeps
SOON = 60.0  # seconds that may be spent on what is quick but for heavy files
EDIT = 20.0  # seconds that may be spent on reading a heavy file


def result(question: Question | Edit, progress: Progress | None = None) -> Result:
    """Return the answer to a question, in its language, or the document behind an edit."""
    if isinstance(question, Edit):
        with speaking(question.language):
            return question.made()
    with speaking(question.language), reading(question.reader):
        if isinstance(question.drive, Mechanism):
            return _of_mechanism(question, question.drive)
        known = known_to(question.drive, Enclosed(question.folder)) if question.drive.settings.catalogues else None
        if question.name in (REPORT, PART, COMPARE):
            return made(question, known, progress)
        if question.name == recordings.DIAGNOSIS:
            return recordings.heard(question.drive, question.choices["recording"], known, progress)
        if question.name == SWEEP:
            return swept(question.drive, question.choices["wanted"], known=known, progress=progress)
        on = subject(question.drive, known=known)
        if question.name == VERDICTS:
            shown = lights(on, **question.choices)
            return headline(on, shown), shown
        if question.name == SCENE:
            return drawn(question.drive, **question.choices)
        if question.name == REMEDIES:
            return with_remedies(on, progress)
        return _told(question, on, progress)


def _of_mechanism(question: Question, mechanism: Mechanism) -> Result:
    """Return the pages about a mechanism, its report, or a part of it."""
    how = dict(question.choices)
    if question.name == PART:
        return exported(how["thing"], how["kind"], title=mechanism.name)
    whole = question.name == REPORT
    said = of_mechanism(mechanism, TitleBlock(), source_text=how.get("source"), full=whole)
    if whole:
        return _written(said, how["form"])
    first = said.pages[0]
    return (replace(first, blocks=[Picture(figure=said.sketch), *first.blocks]), *said.pages[1:])


_answers: OrderedDict[str, dict[str, Answer]] = OrderedDict()
"""What a process calculated last, to be told in other units without calculating it again."""


def _told(question: Question, on: Subject, progress: Progress | None) -> Page:
    """Return an answer; one that took long is kept."""
    if QUESTIONS[question.name].quick:
        return answered(question.name, on, progress, question.choices)
    stopped = False

    def followed(share: float) -> object:
        nonlocal stopped
        said = progress(share) if progress is not None else None
        stopped = stopped or said == "stop"
        return said

    matter = question.matter
    kept = _answers.setdefault(matter, {})
    _answers.move_to_end(matter)
    while len(_answers) > RETOLD:
        _answers.popitem(last=False)
    page = answered(question.name, on, followed, question.choices, kept)
    if stopped:  # it may be half an answer
        _answers.pop(matter, None)
    return page


def drawn(
    drive: Drive,
    *,
    pose: int | None = None,
    instant: float | None = None,
    used: bool = False,
    forces: bool = False,
    modes: bool = False,
) -> Drawn:
    """Return a drive in space.

    instant: where its movements have brought it [s]; used, forces, modes: with utilisations, forces, mode shapes.
    """
    verdicts = _verdicts(drive) if used else ()
    found = scene(drive, verdicts=verdicts, pose=pose, time=instant, with_forces=forces, with_modes=modes)
    return found, found.described()


@lru_cache(maxsize=8)
def _verdicts(drive: Drive) -> tuple[Verdict, ...]:
    """Return the verdicts on a drive that is drawn at many instants; none where it cannot be judged."""
    with suppress(CardanError):
        return check(drive)
    return ()


# Reports and exports as answers to questions: made in a process of their own, as bytes with a name.

Form: TypeAlias = Literal["html", "interactive", "pdf", "xlsx", "json"]

REPORT, PART, COMPARE = "report", "part", "compare"
"""Questions answered here: a whole report, a figure or page as a file, variants side by side."""


def asked_for(session: Session, name: str, **choices: Any) -> Question | None:
    """Return the question for a paper about the drive that a user works on; None while there is none.

    name: one of `REPORT`, `PART` and `COMPARE`.
    **choices: of a report its ``form``; of a part the ``thing`` and its ``kind``; of a comparison the ``variants``,
    names and drives.
    """
    return asked(session, name, **choices)


def of_report(session: Session, form: Form) -> Question | None:
    """Return the question for a report in a form."""
    drive, document = session.drive, session.document
    if document.valid or drive is None:
        return asked_for(session, REPORT, form=form, source=document.text)
    return asked_for(session, REPORT, form=form, source=dumps(drive))


def made(question: Question, known: Catalogue | None, progress: Progress | None = None) -> Exported | Page:
    """Return the paper that a question asks for, in the language spoken.

    question: of `asked_for`; known: norms, types and sizes that the drive is judged by.
    """
    how = dict(question.choices)
    if question.name == REPORT:
        return _report(question, how, known, progress)
    if question.name == PART:
        return exported(how["thing"], how["kind"], title=question.drive.name)
    if question.name == COMPARE:
        variants = [Variant(name=name, drive=drive, known=known) for name, drive in how["variants"]]
        return compared(variants, progress)
    raise refuse("question", _("{name} is not a question").format(name=question.name))


def _report(question: Question, how: dict[str, Any], known: Catalogue | None, progress: Progress | None) -> Exported:
    assert isinstance(question.drive, Drive)
    folder = Enclosed(question.folder)
    said = content(
        question.drive, source_text=how["source"], full=True, known=known, folder=folder, progress=_most(progress)
    )
    return _written(said, how["form"])


def _written(said: Content, form: Form) -> Exported:
    """Return a report in a form."""
    suffix = "html" if form == "interactive" else form
    write = None if form == "json" else renderer_for(Path(f"{_('report')}.{suffix}"), interactive=form == "interactive")
    if write is None or form != "interactive":
        return exported(said, suffix, title="")
    return Exported(content=write(said), media_type="text/html; charset=utf-8", name=f"{safe(said.title)}.html")


def _most(progress: Progress | None) -> Callable[[float], object] | None:
    """Return what is told of the work before it is written down."""
    return None if progress is None else lambda share: progress(0.9 * share)


def safe(name: str, otherwise: str = "drive") -> str:
    """Return a name that every file system takes."""
    return re.sub(r"[\W_]+", "-", name).strip("-")[:60].strip("-") or otherwise
