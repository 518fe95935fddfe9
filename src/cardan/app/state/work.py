"""A question about a drive, and its answer: what the pages of the app show, made here or in a process of its own."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, Literal, TypeAlias

from cardan.answers.reader import reading
from cardan.catalogue import Catalogue
from cardan.drive.drive import Drive
from cardan.errors import refuse
from cardan.figures import Figure
from cardan.files import Enclosed
from cardan.io import dumps
from cardan.io.drive_file import known_to
from cardan.report.answers import answered, subject
from cardan.report.block import Page
from cardan.report.compare import Variant, compared
from cardan.report.content import content
from cardan.report.recorded import Recorded
from cardan.report.render.exports import Exported, exported
from cardan.report.render.renderer import renderer_for
from cardan.report.verdict_list import Light, lights, with_remedies
from cardan.texts import _, speaking

from . import recordings
from .question import Progress, Question, asked
from .session import Session

Result: TypeAlias = Page | tuple[Light, ...] | Exported | Recorded


VERDICTS, REMEDIES = "verdicts", "remedies"
"""Questions beside those of the register: the verdicts, and the same with what cures them."""


def result(question: Question, progress: Progress | None = None) -> Result:
    """Return the answer to a question, in its language."""
    with speaking(question.language), reading(question.reader):
        known = known_to(question.drive, Enclosed(question.folder)) if question.drive.settings.catalogues else None
        if question.name in (REPORT, PART, COMPARE):
            return made(question, known, progress)
        if question.name == recordings.DIAGNOSIS:
            return recordings.heard(question.drive, question.choices["recording"], known, progress)
        on = subject(question.drive, known=known)
        if question.name == VERDICTS:
            return lights(on)
        if question.name == REMEDIES:
            return with_remedies(on, progress)
        return answered(question.name, on, progress, question.choices)


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
    drive = session.drive
    if drive is None:
        return None
    source = session.document.text if session.document.valid else dumps(drive)
    return asked_for(session, REPORT, form=form, source=source)


def made(question: Question, known: Catalogue | None, progress: Progress | None = None) -> Exported | Page:
    """Return the paper that a question asks for, in the language spoken.

    question: of `asked_for`; known: norms, types and sizes that the drive is judged by.
    """
    how = dict(question.choices)
    if question.name == REPORT:
        return _report(question, how, known, progress)
    if question.name == PART:
        return _part(question.drive, how)
    if question.name == COMPARE:
        variants = [Variant(name=name, drive=drive, known=known) for name, drive in how["variants"]]
        return compared(variants, progress)
    raise refuse("question", _("{name} is not a question").format(name=question.name))


def _report(question: Question, how: dict[str, Any], known: Catalogue | None, progress: Progress | None) -> Exported:
    form = how["form"]
    suffix = "html" if form == "interactive" else form
    write = None if form == "json" else renderer_for(Path(f"{_('report')}.{suffix}"), interactive=form == "interactive")
    folder = Enclosed(question.folder)
    said = content(
        question.drive, source_text=how["source"], full=True, known=known, folder=folder, progress=_most(progress)
    )
    if write is None or form != "interactive":
        return exported(said, suffix, title="")
    return Exported(content=write(said), media_type="text/html; charset=utf-8", name=f"{safe(said.title)}.html")


def _part(drive: Drive, how: dict[str, Any]) -> Exported:
    thing: Page | Figure = how["thing"]
    kind: str = how["kind"]
    return exported(thing, kind, title=drive.name)


def _most(progress: Progress | None) -> Callable[[float], object] | None:
    """Return what is told of the work before it is written down."""
    return None if progress is None else lambda share: progress(0.9 * share)


def safe(name: str, otherwise: str = "drive") -> str:
    """Return a name that every file system takes."""
    return re.sub(r"[\W_]+", "-", name).strip("-")[:60].strip("-") or otherwise
