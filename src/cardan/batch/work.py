"""What a sweep is to those that run it and to those that read its results: columns, work, reductions."""

from __future__ import annotations

import hashlib
import math
import time
import tracemalloc
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import IntEnum
from typing import Any, Literal, Protocol, TypeAlias, overload, runtime_checkable

from cardan.maths.arrays import Array

Role: TypeAlias = Literal["point", "answer", "status"]
"""What a column holds: where the point lies, what was answered there, how that went."""

Rows: TypeAlias = dict[str, Array]  # rows of a table: one array (n,) for each column, by its name, in the column's unit

State: TypeAlias = Any
"""What a reduction has seen so far: lists, numbers, texts and None, nothing else, so that JSON holds it exactly."""


class Status(IntEnum):
    """How the answering of a point went; the column ``status`` holds the number."""

    ANSWERED = 0
    NO_DRIVE = 1
    """The values of the point make no drive: a joint angle of 90° or more, a range that is left."""
    NO_ANSWER = 2
    """The drive exists; a question has no answer there."""


STATUS = "status"  # name of the column with the `Status` of each point

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

    def empty(self) -> State:
        """Return the state that has seen nothing."""

    def add(self, state: State, rows: Rows, start: int) -> State:
        """Return the state that has also seen rows ``start`` and following."""

    def merge(self, one: State, other: State) -> State:
        """Return the state that has seen what either has seen."""

    def result(self, state: State) -> Any:
        """Return what the summary tells: numbers, texts and lists and mappings of them."""


@runtime_checkable
class Work(Protocol):
    """A whole sweep: pure, and picklable into a new process; the same rows come out anywhere."""

    @property
    def name(self) -> str:
        """Hash of all that decides the rows, the version of the program among it."""

    @property
    def size(self) -> int:
        """How many points there are."""

    @property
    def columns(self) -> tuple[Column, ...]:
        """Columns of the table, in order."""

    @property
    def reductions(self) -> tuple[Reduction, ...]:
        """Summaries that are wanted."""

    @property
    def provenance(self) -> Mapping[str, Any]:
        """What the rows come from, as JSON can hold it: version, drive, axes, questions, units, seeds."""

    def evaluate(self, start: int, stop: int) -> Rows:
        """Return rows ``start`` to ``stop``; a point without an answer has nan there and says why by its status."""


# Pieces of a sweep: idempotent, named by what they hold, of a size that pays and fits.

TARGET = 0.5  # seconds that a chunk should take: long against handing it over, short against being stopped or killed
ROOM = 2**28  # bytes that the making of one chunk may take
MOST = 20_000  # how many chunks a sweep is cut into at most, as far as `ROOM` lets it: each is a file
ENOUGH = 0.05  # seconds that a trial has to last to be believed

SMALL = 64
"""A sweep of so few points that take long has each in a chunk of its own: trying others would be half the work."""

UNKNOWN = 256  # rows of a chunk where none could be evaluated to see how long they take


@dataclass(frozen=True, slots=True)
class Chunk:
    """Rows ``start`` to ``stop`` of a sweep."""

    index: int  # which chunk it is
    start: int  # start, stop: its rows
    stop: int
    name: str  # where it begins, and a hash of the sweep and of its rows: the same name means the same content

    @property
    def size(self) -> int:
        """How many rows it holds."""
        return self.stop - self.start


@dataclass(frozen=True, slots=True)
class Chunks(Sequence[Chunk]):
    """All chunks of a sweep, each made when it is asked for: millions of them take no memory."""

    work: str  # name of the sweep
    size: int  # how many points it has
    rows: int  # how many rows a chunk has; the last one may have fewer

    def __len__(self) -> int:
        return -(-self.size // self.rows)

    def __iter__(self) -> Iterator[Chunk]:
        return (self[k] for k in range(len(self)))

    @overload
    def __getitem__(self, index: int) -> Chunk: ...

    @overload
    def __getitem__(self, index: slice) -> Sequence[Chunk]: ...

    def __getitem__(self, index: int | slice) -> Chunk | Sequence[Chunk]:
        if isinstance(index, slice):
            return [self[k] for k in range(*index.indices(len(self)))]
        k = index + len(self) if index < 0 else index
        if not 0 <= k < len(self):
            raise IndexError(index)
        start, stop = k * self.rows, min((k + 1) * self.rows, self.size)
        digest = hashlib.sha256(f"{self.work}\n{start}\n{stop}".encode()).hexdigest()
        return Chunk(k, start, stop, f"{start:012d}-{digest[:16]}")


def made(work: Work, start: int, stop: int, *, keeps: bool) -> tuple[Rows | None, list[State]]:
    """Return rows ``start`` to ``stop``, and what each reduction has seen in them.

    keeps: whether the rows are wanted; without them, a work with a method ``reduced`` sums up without holding them.
    """
    reduced = getattr(work, "reduced", None)
    if not keeps and reduced is not None:
        return None, list(reduced(start, stop))
    rows = work.evaluate(start, stop)
    states = [one.add(one.empty(), rows, start) for one in work.reductions]
    return rows if keeps else None, states


def chunks_of(work: Work, rows: int | None = None, *, keeps: bool = True) -> Chunks:
    """Return the chunks of a sweep. rows: rows of a chunk; measured by `rows_for` by default."""
    return Chunks(work.name, work.size, rows if rows is not None else rows_for(work, keeps=keeps))


def rows_for(work: Work, *, keeps: bool = True, target: float = TARGET, room: int = ROOM) -> int:
    """Return how many rows make a chunk that takes about ``target`` seconds and at most ``room`` bytes, measured.

    work: the sweep; a few rows from its middle are evaluated.
    keeps: whether rows are kept; target [s]: time a chunk should take.
    room: bytes that its making may take, working space included.
    Returns: a power of two, so that small differences of the clock seldom change it; at least 1.
    Memory is the slope of the traced peak between one row and many: what is allocated once does not count a row. Rows
    that cannot be evaluated tell nothing; their chunks will say why.
    """
    if not work.size:
        return 1
    try:
        rows = _measured(work, keeps, target, room)
    except Exception:
        rows = max(float(UNKNOWN), work.size / MOST)
    return int(2 ** max(0, round(math.log2(max(rows, 1.0)))))


def _measured(work: Work, keeps: bool, target: float, room: int) -> float:
    first = _seconds(work, keeps, 1)  # with what is loaded or compiled at first, which is no cost of a row
    if first * work.size <= target:
        return 2.0 * work.size
    if first >= ENOUGH and work.size <= SMALL:
        return 1.0
    count, seconds = 1, _seconds(work, keeps, 1)
    while seconds < min(ENOUGH, target) and count < work.size:
        count = min(work.size, count * (8 if seconds < 0.2 * ENOUGH else 2))
        seconds = _seconds(work, keeps, count)
    rows = max(count * target / max(seconds, 1e-9), work.size / MOST)
    if rows > 1.5 and work.size > 1:
        count = max(count, 2)
        slope = (_peak(work, keeps, count) - _peak(work, keeps, 1)) / (count - 1)
        rows = min(rows, room / max(slope, 1.0))
    return rows


def _seen(work: Work, keeps: bool, count: int) -> None:
    start = (work.size - count) // 2
    made(work, start, start + count, keeps=keeps)


def _seconds(work: Work, keeps: bool, count: int) -> float:
    begin = time.perf_counter()
    _seen(work, keeps, count)
    return time.perf_counter() - begin


def _peak(work: Work, keeps: bool, count: int) -> int:
    ours = not tracemalloc.is_tracing()
    if ours:
        tracemalloc.start(1)
    try:
        tracemalloc.reset_peak()
        before = tracemalloc.get_traced_memory()[0]
        _seen(work, keeps, count)
        return tracemalloc.get_traced_memory()[1] - before
    finally:
        if ours:
            tracemalloc.stop()
