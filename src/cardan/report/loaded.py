"""The parts of the report about a drive under load and as made: each only where the drive file says enough."""

from __future__ import annotations

from collections.abc import Iterator

from cardan.answers.question import Question
from cardan.answers.reader import reader
from cardan.errors import InputError
from cardan.register import QUESTIONS
from cardan.texts import _

from .balance import refused
from .block import Page
from .page import page as page_for
from .subject import Subject

PAGES = (
    "forces",
    "losses",
    "strength",
    "life",
    "accuracy",
    "mobility",
    "assembly",
    "torsion",
    "orders",
    "stability",
    "run-up",
    "bending",
    "rotor",
    "balance",
)
"""The questions whose answers are parts, in the order of the report."""


def loaded(on: Subject) -> Iterator[Page]:
    """Yield the parts that the drive file asks for; none once the reader stopped the work."""
    for name in PAGES if on.complete else ():
        page = _asked(QUESTIONS[name], on)
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
