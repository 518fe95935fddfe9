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
from cardan.questions.torsion.model.machine_torques import turns_freely
from cardan.register import QUESTIONS
from cardan.texts import _

from . import lacking as lacks
from .balance import refused
from .block import Page
from .followed import Followed, asked_by_laws
from .lacking import Lacking, told
from .page import page
from .run_up import running_up
from .subject import Progress, Subject
from .torsion import ordered, stable, swinging

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
    question = QUESTIONS.get(NAMES.get(name, name))
    if question is not None and question.ready:
        return page_of(question, on, progress, choices or {})
    asked = ANSWERS[name]
    missing = asked.lacking(on)
    if missing:
        return Page(name=name, title=asked.title(), answer=told(missing), blocks=())
    try:
        page = asked.page(on, progress, choices or {})
    except InputError as error:
        return refused(name, asked.title(), error)
    return page or Page(name=name, title=asked.title(), answer=asked.otherwise(on), blocks=())


NAMES = {"movement": "articulation", "phases": "phasing", "limits": "check"}
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


def _plain(made: Callable[[Subject], Page | None]) -> Callable[[Subject, Progress | None, Choices], Page | None]:
    return lambda on, _progress, _choices: made(on)


def _watched(
    made: Callable[[Subject, Progress | None], Page | None],
) -> Callable[[Subject, Progress | None, Choices], Page | None]:
    return lambda on, progress, _choices: made(on, progress)


def _of(lacking: Callable[[Drive], Lacking]) -> Callable[[Subject], Lacking]:
    return lambda on: lacking(on.drive)


def _nothing(_on: Subject) -> str:
    return _("There is nothing to be told of this drive.")


def _by_laws(on: object) -> Followed | None:
    return on if isinstance(on, Followed) else None


def _free(on: Subject) -> str:
    if turns_freely(on.drive, on.drive.duty):
        return _("Torques turn its input freely; a run-up at a steady rate forces a speed on it.")
    return _nothing(on)


def _straight(_on: Subject) -> str:
    return _("The joints bend next to nothing: they do not make torsional vibration grow.")


ANSWERS: dict[str, Answer] = {
    "torsion": Answer(
        title=lambda: _("Modes and running"),
        page=_plain(swinging),
        lacking=_of(lacks.of_torsion),
        otherwise=_nothing,
        quick=False,
    ),
    "orders": Answer(
        title=lambda: _("Orders"),
        page=_watched(ordered),
        lacking=_of(lacks.of_orders),
        otherwise=_nothing,
        quick=False,
    ),
    "stability": Answer(
        title=lambda: _("Stability map"),
        page=_watched(stable),
        lacking=_of(lacks.of_stability),
        otherwise=_straight,
        quick=False,
    ),
    "run-up": Answer(
        title=lambda: _("Running up"),
        page=_watched(running_up),
        lacking=_of(lacks.of_run_up),
        otherwise=_free,
        quick=False,
    ),
}
"""Every question by its name, in the order in which one asks them."""

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


ANSWERS = {name: ANSWERS.get(name) or _registered(name) for _title, names in GROUPS for name in names}
