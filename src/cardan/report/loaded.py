"""The parts of the report about a drive under load and as made: each only where the drive file says enough."""

from __future__ import annotations

from collections.abc import Iterator

from cardan.answers.question import Question
from cardan.answers.reader import reader
from cardan.errors import InputError
from cardan.register import QUESTIONS
from cardan.texts import _

from .block import Page
from .lacking import refused
from .page import page as page_for
from .subject import Subject

OWN = ("motion", "classical", "articulation", "phasing", "check")
"""Questions whose pages have places of their own in the report."""


def loaded(on: Subject) -> Iterator[Page]:
    """Yield the parts that the drive file asks for; none once the reader stopped the work."""
    asked = (one for one in QUESTIONS.values() if one.report and one.name not in OWN)
    for question in asked if on.complete else ():
        page = _asked(question, on)
        if page is not None:
            yield page


def _asked(question: Question, on: Subject) -> Page | None:
    """Return the page of a question, None where the drive file does not ask it or nothing is to be told."""
    if question.lacking(on.drive):
        return None
    try:
        result = question.ask(on.drive, known=on.known)
    except InputError as error:
        return refused(question.name, _(question.title), error)
    return None if result is None else page_for(question.answer(on.drive, result), reader())
