"""Every question that can be asked about a drive by itself: the pages of the report, one by one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, TypeAlias, cast

from cardan.answers.question import Question
from cardan.answers.reader import reader
from cardan.catalogue import Catalogue
from cardan.drive.drive import Drive
from cardan.drive.models.laws import unmapped
from cardan.errors import InputError
from cardan.questions.gathering import gather, principal
from cardan.register import QUESTIONS
from cardan.texts import _

from .block import Page
from .followed import asked_by_laws
from .lacking import refused, told
from .page import page
from .subject import Progress, Subject

Choices: TypeAlias = Mapping[str, Any]
"""What the user chose beside the drive."""


def subject(drive: Drive, *, known: Catalogue | None = None) -> Subject:
    """Return a drive to be asked about.

    drive: the drive, of joints of any kinds.
    known: norms, types and sizes that it is judged by; the shipped ones when not given.
    """
    if unmapped(drive.joints):
        # What the pages ask for it has under the same names.
        return cast(Subject, replace(asked_by_laws(drive, None), known=known))
    return Subject(drive=drive, known=known)


def answered(name: str, on: Subject, progress: Progress | None = None, choices: Choices | None = None) -> Page:
    """Return the answer to one question about a drive; where there is none, a page that says what it lacks.

    name: one of `cardan.register.QUESTIONS`; on: the drive, as of `subject`.
    choices: what the user chose: of "selection" the number of the ``joint``.
    """
    return page_of(QUESTIONS[name], on, progress, choices or {})


def page_of(question: Question, on: Subject, progress: Progress | None, choices: Choices) -> Page:
    """Return the page of a question of the register; what it lacks or why it refuses, where it has no answer."""
    title = _(question.title)
    drive = principal(question, on.drive)
    missing = question.lacking(drive)
    if missing:
        return Page(name=question.name, title=title, answer=told(missing), blocks=())
    return found_page(question, on, progress, choices) or Page(
        name=question.name, title=title, answer=question.home.otherwise(on.drive), blocks=()
    )


def found_page(
    question: Question, on: Subject, progress: Progress | None = None, choices: Choices | None = None
) -> Page | None:
    """Return the page of a question about a drive that has what it needs; None where nothing can be told."""
    drive = principal(question, on.drive)
    try:
        result = question.ask(drive, known=on.known, progress=progress, **(choices or {}))
    except InputError as error:
        return refused(question.name, _(question.title), error)
    return None if result is None else page(gather(question, on.drive, question.answer(drive, result)), reader())
