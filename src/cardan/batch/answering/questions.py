"""What can be asked of every point of a sweep: one entry a question."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from cardan.batch.work import Column
from cardan.drive.drive import Drive
from cardan.errors import Problem, check
from cardan.maths.arrays import Array
from cardan.texts import _
from cardan.units import DIMENSIONS, nearest

from .many import Many


@dataclass(frozen=True, kw_only=True)
class Told:
    """One number of an answer.

    Attributes
    ----------
    name : str
        Its column in the table, with its unit at the end.
    dimension : str
        Key of `cardan.units.DIMENSIONS`; empty for a plain number.
    unit : str
        Unit of the column.
    text : str
        What it is, to be translated where it is shown.
    """

    name: str
    dimension: str = ""
    unit: str = ""
    text: str

    @property
    def factor(self) -> float:
        """SI units in one unit of the column."""
        return DIMENSIONS[self.dimension][self.unit] if self.dimension else 1.0

    @property
    def column(self) -> Column:
        """Its column."""
        return Column(name=self.name, unit=self.unit, role="answer", text=self.text)


OfMany: TypeAlias = Callable[[Many], Sequence[Array]]
"""Answers of many drives at once, in SI, one array (n,) for each number told."""

OfOne: TypeAlias = Callable[[Drive], Sequence[float]]
"""Answers of one drive, in SI; an `InputError` where it has none."""


@dataclass(frozen=True, kw_only=True)
class Question:
    """Something to ask of a drive.

    Attributes
    ----------
    name : str
        Its name in a plan.
    doc : str
        One sentence on what it answers, to be translated where it is shown.
    told : function
        Drive -> the numbers of the answer; the drive is the one in which fields vary.
    of_many : function or None
        For questions that motion alone decides; these are asked of all drives at once.
    of_one : function or None
        For all others.
    needs_speed : bool
        Whether a drive without a speed has no answer.
    """

    name: str
    doc: str
    told: Callable[[Drive], tuple[Told, ...]]
    of_many: OfMany | None = None
    of_one: OfOne | None = None
    needs_speed: bool = False


def questions() -> dict[str, Question]:
    """Return every question by its name.

    Examples
    --------
    >>> list(questions())[:3]
    ['speed_fluctuation', 'alpha_eq', 'ratio']
    """
    from .drive_questions import DRIVE
    from .motion_questions import MOTION

    return {one.name: one for one in (*MOTION, *DRIVE)}


def asked(names: Sequence[str]) -> tuple[Question, ...]:
    """Return questions by their names.

    Raises
    ------
    InputError
        Every name that is no question, with the nearest that is; a name given twice.

    Examples
    --------
    >>> [one.name for one in asked(["speed_fluctuation", "life"])]
    ['speed_fluctuation', 'life']
    """
    known = questions()
    problems = [] if names else [Problem("ask", _("nothing is asked"))]
    for k, name in enumerate(names):
        if name not in known:
            near = nearest(name, known)
            text = _("unknown question {name}; the questions are {known}")
            said = text.format(name=repr(name), known=", ".join(known))
            problems.append(Problem("ask", said + (_("; the nearest is {near}").format(near=near) if near else "")))
        elif name in names[:k]:
            problems.append(Problem("ask", _("{name} is asked twice").format(name=name)))
    check(problems)
    return tuple(known[name] for name in names)
