"""Every question that can be asked about a drive by itself: the pages of the report, one by one."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, TypeAlias, cast

from cardan.answers.question import Question
from cardan.answers.reader import reader
from cardan.catalogue import Catalogue
from cardan.drive.drive import Drive
from cardan.drive.models.laws import unmapped
from cardan.errors import InputError
from cardan.register import QUESTIONS
from cardan.texts import _

from .balance import refused
from .block import Page
from .followed import asked_by_laws
from .lacking import Lacking, told
from .page import page
from .subject import Progress, Subject

Choices: TypeAlias = Mapping[str, Any]
"""What the user chose beside the drive."""


@dataclass(frozen=True, kw_only=True)
class Answer:
    """A question that can be asked by itself.

    Parameters
    ----------
    title : function
        What it is called, in the language spoken.
    page : function
        From a drive, who watches the work, and what the user chose to the page; None where nothing can be told.
    lacking : function
        What the drive file lacks for it.
    otherwise : function
        Why nothing can be told although nothing is missing.
    quick : bool
        Whether it is there at once; the others are worth a process of their own.
    """

    title: Callable[[], str]
    page: Callable[[Subject, Progress | None, Choices], Page | None]
    lacking: Callable[[Subject], Lacking]
    otherwise: Callable[[Subject], str]
    quick: bool = True


def subject(drive: Drive, *, known: Catalogue | None = None) -> Subject:
    """Return a drive to be asked about.

    Parameters
    ----------
    drive : Drive
        The drive, of joints of any kinds.
    known : Catalogue, optional
        Norms, types and sizes that it is judged by; the shipped ones when not given.
    """
    if unmapped(drive.joints):
        # What the pages ask for it has under the same names.
        return cast(Subject, replace(asked_by_laws(drive, None), known=known))
    return Subject(drive=drive, known=known)


def answered(name: str, on: Subject, progress: Progress | None = None, choices: Choices | None = None) -> Page:
    """Return the answer to one question about a drive; where there is none, a page that says what it lacks.

    Parameters
    ----------
    name : str
        One of `ANSWERS`.
    on : Subject
        The drive, as of `subject`.
    progress : function, optional
        Called with the share done; answering "stop" ends the work.
    choices : mapping of str to value, optional
        What the user chose: of "selection" the number of the ``joint``.

    Examples
    --------
    >>> from cardan.units import deg
    >>> answered("motion", subject(Drive.from_angles([20 * deg, 20 * deg]))).title
    'Motion'
    >>> answered("losses", subject(Drive.from_angles([20 * deg]))).answer[:46]
    'This answer needs more in the drive file: duty'
    """
    return page_of(QUESTIONS[NAMES.get(name, name)], on, progress, choices or {})


NAMES = {"limits": "check"}
"""Name of a page -> name of its question, where these differ."""


def page_of(question: Question, on: Subject, progress: Progress | None, choices: Choices) -> Page:
    """Return the page of a question of the register; what it lacks or why it refuses, where it has no answer."""
    title = _(question.title)
    missing = question.lacking(on.drive)
    if missing:
        return Page(name=question.name, title=title, answer=told(missing), blocks=())
    try:
        result = question.ask(on.drive, known=on.known, progress=progress, **choices)
    except InputError as error:
        return refused(question.name, title, error)
    if result is None:
        return Page(name=question.name, title=title, answer=question.home.otherwise(on.drive), blocks=())
    return page(question.answer(on.drive, result), reader())


GROUPS: tuple[tuple[Callable[[], str], tuple[str, ...]], ...] = (
    (lambda: _("Motion"), ("motion", "articulation", "classical")),
    (lambda: _("Phasing"), ("phasing",)),
    (lambda: _("Forces"), ("forces",)),
    (lambda: _("Losses"), ("losses",)),
    (lambda: _("Accuracy"), ("accuracy",)),
    (lambda: _("Torsion"), ("torsion", "orders", "stability", "run-up")),
    (lambda: _("Bending"), ("bending",)),
    (lambda: _("Life"), ("life",)),
    (lambda: _("Strength"), ("strength",)),
    (lambda: _("Limits"), ("limits",)),
    (lambda: _("Mobility"), ("mobility", "assembly")),
    (lambda: _("Selection"), ("selection",)),
)
"""Questions that belong together, with what they are called together."""


def _registered(name: str) -> Answer:
    """Return a question of the register as an answer among the others."""
    question = QUESTIONS[NAMES.get(name, name)]
    return Answer(
        title=lambda: _(question.title),
        page=lambda on, progress, choices: page_of(question, on, progress, choices),
        lacking=lambda on: question.lacking(on.drive),
        otherwise=lambda on: str(question.home.otherwise(on.drive)),
        quick=question.quick,
    )


ANSWERS: dict[str, Answer] = {name: _registered(name) for _title, names in GROUPS for name in names}
"""Every question by its name, in the order in which one asks them."""
