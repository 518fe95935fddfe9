"""What can be wrong with an input, told all at once.

Every error a user can cause is an `InputError`: a list of problems, each with the field it is about. Nothing
below the command line prints or exits.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

CODES = (
    "missing",
    "not_finite",
    "not_positive",
    "negative",
    "out_of_range",
    "inconsistent",
    "singular",
    "empty",
    "unknown_key",
    "unknown_kind",
)
"""What can be wrong with an input, in one word."""


@dataclass(frozen=True, slots=True)
class Problem:
    """One thing that is wrong."""

    # path of the field, ``joints[1].centre`` in Python, ``joints[1].centre_mm`` in a file. Indices count from 0.
    field: str
    message: str  # what was given and what is allowed, in one sentence
    code: str = ""  # one of `CODES`, for programs; empty where none of them fits
    paste: str = ""  # tables that would mend it, as they stand in a drive file; empty where there are none

    def __str__(self) -> str:
        return f"{self.field}: {self.message}" if self.field else self.message


class CardanError(Exception):
    """Root of everything cardan raises on purpose."""


class InputError(CardanError):
    """One or more problems with what the user gave, all of them.

    Parameters
    ----------
    problems : iterable of Problem
        At least one.
    where : array of bool, optional
        In a batch, the mask of the drives concerned.

    Examples
    --------
    >>> from cardan import InputError
    >>> from cardan.errors import Problem
    >>> print(InputError([Problem("joints[0].joint_angle", "94° is not below 90°")]))
    joints[0].joint_angle: 94° is not below 90°
    """

    def __init__(self, problems: Iterable[Problem], *, where: Any = None) -> None:
        self.problems = tuple(problems)
        self.where = where
        super().__init__("\n".join(str(problem) for problem in self.problems))

    @property
    def field(self) -> str:
        """Path of the first problem."""
        return self.problems[0].field

    def __reduce__(self) -> Any:
        """Keep problems and mask when the error crosses to another process."""
        return _rebuilt, (type(self), self.problems, self.where)

    def renamed(self, name: Any) -> InputError:
        """Return the same problems with their fields passed through ``name``."""
        return type(self)([replace(p, field=name(p.field)) for p in self.problems], where=self.where)


def _rebuilt(kind: type[InputError], problems: Iterable[Problem], where: Any) -> InputError:
    return kind(problems, where=where)


class JointAngleLimitError(InputError):
    """A joint angle is 90 degrees or more: no universal joint turns there."""


class MissingExtraError(CardanError):
    """An optional library is not installed; the message names the extra to install."""


def refuse(field: str, message: str, code: str = "") -> InputError:
    """Return an `InputError` with a single problem."""
    return InputError([Problem(field, message, code)])


def check(problems: Iterable[Problem]) -> None:
    """Raise `InputError` if there is any problem."""
    found = tuple(problems)
    if found:
        raise InputError(found)
