"""What a question about a drive is: one folder, one entry in the register `cardan.register.QUESTIONS`.

The module that a question names holds, by these names:

``lacking(drive)``
    Paths that the drive file lacks for it, see `Lacking`.
``ask(drive, **choices)``
    The result, frozen and in SI.
``answer(drive, result)``
    What there is to say of it, an `Answer`.

and, where there is need, ``otherwise(drive)``, why nothing can be told although nothing is missing, or the paths that
it needs all the same,
``brief(drive, result)``, its answer with key figures, sentence and tone alone where the rest takes long,
``over_movement(drive)``, its key figures over the instants of a movement as arrays, and ``COLUMNS``, what a sweep may
ask of it: each a `cardan.answers.sweepable.SweepQuestion`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from cardan.errors import Problem, check, refuse
from cardan.texts import _

if TYPE_CHECKING:
    from .answer import Answer
    from .sweepable import SweepQuestion

Drive: TypeAlias = Any
"""A `cardan.drive.drive.Drive`, which stands above what is said of it."""

Gathering: TypeAlias = Literal["worst", "mean", "sum", "each"]
"""How answers are gathered over conditions: the largest, the mean by share of the time, the sum of shares of damage, or
each by itself."""

Aspect: TypeAlias = Literal["pose", "movement", "case", "error"]
"""What makes a condition of its own: a pose, a movement, one of several load cases, a measured error of a joint."""

Lacking: TypeAlias = tuple[tuple[str, ...], ...]
"""Paths of the drive file that are missing; of each inner tuple any one would do. Empty where nothing is missing."""


@dataclass(frozen=True, kw_only=True)
class Place:
    """Where the page of a question stands in the report: in its main part, aside with ``--full`` alone, or nowhere.

    Of a page in the main part the figures, tables and remarks that are marked ``aside`` are told with ``--full`` alone.
    """

    part: Literal["main", "aside", "nowhere"] = "main"
    calm: bool = False  # whether it stands aside while all is good: few ask for it then
    beside: str = ""  # question that tells the same of more: where that has a page, this one stands aside
    order: int = 0  # before the others where it is less, behind them where it is more; alike as in the register


MAIN, ASIDE, NOWHERE = Place(), Place(part="aside"), Place(part="nowhere")


@dataclass(frozen=True, kw_only=True)
class Question:
    """An entry of the register: light, so that help costs nothing; its module is imported when it is asked."""

    name: str  # of command, page, tab and module: ``life``
    module: str  # where it is answered: ``cardan.questions.life.answer``
    title: str  # heading of its page, marked for translation
    group: str  # heading of the tab it stands on, marked for translation
    help: str = ""  # what it answers, marked for translation
    gathers: Gathering = "each"  # how it gathers over conditions
    # of what it gathers by itself; over all else that a drive has `cardan.questions.gathering` asks it
    gathered: tuple[Aspect, ...] = ()
    # what its answer does not depend on: why, in a sentence marked for translation
    without: Mapping[Aspect, str] = field(default_factory=dict, compare=False)
    quick: bool = True  # whether its answer is there at once; the others are worth a process of their own
    place: Place = MAIN  # where the report has its page
    # whether it is told of the heaviest load case where the duty itself gives no torque, although it misses none
    loaded: bool = False
    # what ``ask`` takes beside the drive, of ``known`` (a catalogue), ``progress`` and what a user may choose
    takes: tuple[str, ...] = ()
    mechanism: str = ""  # where it is answered of a mechanism file, as ``module``; empty where it is of drives alone
    command: str = ""  # command that asks it, its words parted by blanks; the name of the question by default
    examples: tuple[str, ...] = ()  # lines below the help of the command
    aliases: tuple[str, ...] = ()  # other names of the command, which no help lists
    # heading of the command in the help of a group of commands, marked for translation; `group` by default
    panel: str = ""

    @property
    def home(self) -> ModuleType:
        """The module that answers it."""
        return import_module(self.module)

    @property
    def of_mechanism(self) -> Question:
        """The same question, asked of a mechanism."""
        return replace(self, module=self.mechanism)

    @property
    def columns(self) -> tuple[SweepQuestion, ...]:
        """What a sweep may ask of it."""
        return tuple(map(self._asking, getattr(self.home, "COLUMNS", ())))

    def _asking(self, one: SweepQuestion) -> SweepQuestion:
        """Return the same, asking the question where it wants its result."""
        told = one.of_result
        return one if told is None else replace(one, of_one=lambda drive: told(self.result(drive)))

    def lacking(self, drive: Drive) -> Lacking:
        """Return what a drive file lacks for it."""
        found: Lacking = self.home.lacking(drive)
        return found

    def otherwise(self, drive: Drive) -> str | Lacking:
        """Return why nothing can be told although nothing is missing, or what is needed all the same."""
        found: str | Lacking = self.home.otherwise(drive)
        return found

    def ask(self, drive: Drive, **given: Any) -> Any:
        """Return its result, None where nothing can be told.

        Parameters
        ----------
        drive : Drive
            What is asked about.
        **given
            What there is to give; the question takes what it wants.
        """
        return self.home.ask(drive, **{name: given[name] for name in self.takes if given.get(name) is not None})

    def result(self, drive: Drive) -> Any:
        """Return its result where there is one.

        Raises
        ------
        InputError
            What the drive lacks for it, or why nothing can be told.
        """
        self._check(self.lacking(drive))
        found = self.ask(drive)
        if found is None:
            why = self.otherwise(drive)
            if isinstance(why, str):
                raise refuse(self.name, why)
            self._check(why)
        return found

    def _check(self, lacking: Lacking) -> None:
        """Refuse what is missing."""
        needed = _("missing; the question {name} needs it").format(name=self.name)
        check(Problem(_(" or ").join(some), needed, "missing") for some in lacking)

    def answer(self, drive: Drive, result: Any) -> Answer:
        """Return what there is to say of its result."""
        found: Answer = self.home.answer(drive, result)
        return found

    def brief(self, drive: Drive, result: Any) -> Answer:
        """Return its key figures, sentence and tone, as other conditions need them; the rest may be missing."""
        found: Answer = getattr(self.home, "brief", self.home.answer)(drive, result)
        return found


def absent(*conditions: tuple[bool | str, ...]) -> Lacking:
    """Return the paths of the conditions that are not met: whether it is met, then what would meet it.

    Examples
    --------
    >>> absent((False, "duty.torque"), (True, "supports"))
    (('duty.torque',),)
    """
    return tuple(tuple(map(str, paths)) for met, *paths in conditions if not met and paths)


def all_of(paths: Sequence[str]) -> Lacking:
    """Return paths all of which are missing, each once."""
    return tuple((path,) for path in dict.fromkeys(paths))
