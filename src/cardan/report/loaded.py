"""The parts of the report about a drive under load and as made: each only where the drive file says enough."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from cardan.answers.question import Question
from cardan.answers.reader import reader
from cardan.errors import InputError
from cardan.register import QUESTIONS
from cardan.texts import _

from .balance import refused
from .block import Page
from .page import page as page_for
from .run_up import running_up
from .subject import Subject
from .torsion import twisting

PAGES: dict[str, Callable[[Subject], Page | None]] = {
    "forces": lambda _on: None,
    "losses": lambda _on: None,
    "strength": lambda _on: None,
    "life": lambda _on: None,
    "accuracy": lambda _on: None,
    "mobility": lambda _on: None,
    "assembly": lambda _on: None,
    "torsion": twisting,
    "run-up": running_up,
    "bending": lambda _on: None,
    "rotor": lambda _on: None,
    "balance": lambda _on: None,
}
"""What makes each part, in the order of the report; None where the drive file does not ask for it."""


def loaded(on: Subject) -> Iterator[Page]:
    """Yield the parts that the drive file asks for; none once the reader stopped the work."""
    for name, made in PAGES.items() if on.complete else ():
        question = QUESTIONS[name]
        page = _asked(question, on) if question.ready else made(on)
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
