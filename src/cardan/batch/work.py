"""What a sweep is to those that run it and to those that read its results: columns, work, reductions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import IntEnum
from typing import Any, Literal, Protocol, TypeAlias, runtime_checkable

from cardan.maths.arrays import Array

Role: TypeAlias = Literal["point", "answer", "status"]
"""What a column holds: where the point lies, what was answered there, how that went."""

Rows: TypeAlias = dict[str, Array]
"""Rows of a table: one array (n,) for each column, by its name, in the column's unit."""

State: TypeAlias = Any
"""What a reduction has seen so far: lists, numbers, texts and None, nothing else, so that JSON holds it exactly."""


class Status(IntEnum):
    """How the answering of a point went; the column ``status`` holds the number."""

    ANSWERED = 0
    NO_DRIVE = 1
    """The values of the point make no drive: a joint angle of 90° or more, a range that is left."""
    NO_ANSWER = 2
    """The drive exists; a question has no answer there."""


STATUS = "status"
"""Name of the column with the `Status` of each point."""

FEASIBLE = "feasible"
"""Name of the column that tells whether a point was answered and keeps every constraint; there where any is set."""


@dataclass(frozen=True, kw_only=True)
class Column:
    """One column of the table of a sweep."""

    # name in the table: a path of the drive file (``joints[1].centre_mm[2]``), or the name of a question with its unit
    # at the end (``alpha_eq_deg``)
    name: str
    unit: str  # key of `cardan.units` in which the numbers stand; empty for numbers without a dimension and for words
    role: Role  # what the column holds
    text: str  # what it means, to be translated where it is shown


@runtime_checkable
class Reduction(Protocol):
    """A summary of all rows that is made of summaries of parts: states are added up in any order and merged."""

    @property
    def name(self) -> str:
        """Name among the results of the sweep."""
        ...

    def empty(self) -> State:
        """Return the state that has seen nothing."""
        ...

    def add(self, state: State, rows: Rows, start: int) -> State:
        """Return the state that has also seen rows ``start`` and following."""
        ...

    def merge(self, one: State, other: State) -> State:
        """Return the state that has seen what either has seen."""
        ...

    def result(self, state: State) -> Any:
        """Return what the summary tells: numbers, texts and lists and mappings of them."""
        ...


@runtime_checkable
class Work(Protocol):
    """A whole sweep: pure, and picklable into a new process; the same rows come out anywhere."""

    @property
    def name(self) -> str:
        """Hash of all that decides the rows, the version of the program among it."""
        ...

    @property
    def size(self) -> int:
        """How many points there are."""
        ...

    @property
    def columns(self) -> tuple[Column, ...]:
        """Columns of the table, in order."""
        ...

    @property
    def reductions(self) -> tuple[Reduction, ...]:
        """Summaries that are wanted."""
        ...

    @property
    def provenance(self) -> Mapping[str, Any]:
        """What the rows come from, as JSON can hold it: version, drive, axes, questions, units, seeds."""
        ...

    def evaluate(self, start: int, stop: int) -> Rows:
        """Return rows ``start`` to ``stop``; a point without an answer has nan there and says why by its status."""
        ...
