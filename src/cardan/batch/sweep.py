"""From one drive to a hundred million: what varies, what is asked, and where it is worked on."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from cardan.batch.table.reductions import Reduce
from cardan.catalogue import Catalogue, shortened
from cardan.drive.drive import Drive
from cardan.drive.fields.keys import tree_of
from cardan.errors import InputError, Problem, check
from cardan.maths.arrays import Array
from cardan.maths.compiled.method import share
from cardan.mechanism.mechanism import Mechanism
from cardan.texts import _
from cardan.version import VERSION

from .answering.asking import STATUS_COLUMN, Device, DriveEvaluator, evaluator
from .engine.engines import Engine, InProcess
from .engine.running import Keeping
from .engine.running import run as run_plan
from .points.axes import Axis, Points, TableAxis
from .points.fields import TEXT_FEASIBLE, spread_out
from .search.goals import Limit, check_names, excess, limit_of
from .table.reductions import States, at_work, reduce_of
from .table.swept import Sweep
from .work import FEASIBLE, STATUS, Column, Reduction, Rows, State, Status


def sweep(
    drive: Drive | Mechanism,
    vary: Mapping[str, Any] | Sequence[Axis],
    ask: Sequence[str],
    *,
    reduce: Sequence[str | Reduce] = (),
    constraints: Sequence[str | Limit] = (),
    engine: Engine = InProcess(),  # noqa: B008 - frozen
    into: str | Path | None = None,
    rows: Keeping = "kept",
    known: Catalogue | None = None,
    device: Device = "cpu",
    chunk: int | None = None,
    progress: Callable[[float], object] | None = None,
) -> Sweep:
    """Ask questions of a drive at every point of a sweep.

    Parameters
    ----------
    drive : Drive or Mechanism
    vary : mapping of str to sequence, or sequence of Axis
        Path with unit, as in the drive file, -> its values; or axes: `GridAxis`, `TableAxis`, `SampledAxis`. Every
        combination is a point.
    ask : sequence of str
        Names of questions: ``"speed_fluctuation"``, ``"life"``.
    reduce : sequence of str or Reduce
        What to tell of all points: ``"max speed_fluctuation_percent by duty.speed_rpm"``.
    constraints : sequence of str or Limit
        What a point has to keep to be feasible: ``"speed_fluctuation_percent <= 2"``.
    engine : InProcess, Processes or Cluster
        Where it is worked on; the rows are the same.
    into : path, optional
        Folder for the table. A sweep into a folder where it was begun goes on.
    rows : {"kept", "none"}
        Whether the table is kept, or the reductions alone.
    known : Catalogue, optional
        Where sizes and grades are looked up; the shipped one when not given.
    device : {"cpu", "gpu"}
        What computes motion; the GPU answers nothing else.
    chunk : int, optional
        Rows worked on at a time; measured by default.
    progress : function, optional
        Told the share done; when it answers "stop", the sweep ends as cancelled and keeps what is done.

    Returns
    -------
    Sweep
        table() : arrays (points,) by column; reductions; status and what is missing.

    Raises
    ------
    InputError
        All that is wrong with the sweep, at once; a folder that cannot be used.
    MissingExtraError
        A folder, a cluster or the GPU needs a library that is not installed.

    See Also
    --------
    results, read_sweep

    Notes
    -----
    A point that makes no drive, or has no answer, holds nan and says so by its status; `cardan.batch.sweep.work_of`
    makes the same work without running it, and tells by ``why`` what stands in its way.

    Examples
    --------
    >>> from cardan import Drive
    >>> from cardan.sweeps import sweep
    >>> pair = Drive.from_angles([0.3, 0.3])
    >>> angles = {"joints[1].joint_angle_deg": [10.0, 17.2, 95.0]}
    >>> found = sweep(pair, angles, ["speed_fluctuation"], reduce=["min speed_fluctuation_percent"])
    >>> found.table()["speed_fluctuation_percent"], found.table()["status"]
    (array([6.07749983, 0.01216928,        nan]), array([0, 0, 1], dtype=int8))
    """
    work = work_of(drive, vary, ask, reduce=reduce, constraints=constraints, known=known, device=device)
    return run_plan(work, engine=engine, into=into, rows=rows, chunk=chunk, progress=progress)


# A sweep as a whole: points, questions, constraints and reductions, put together as work that any engine can do.

BLOCK = 2**13
"""Points that are answered at a time: their arrays stay in the caches, in memory that is not given back each time."""

GATHERED = 2**16  # points that are summed up at a time

RUNS = 8
"""Runs of blocks that are summed up apart, whatever the number of processors, so that sums round alike anywhere."""


@dataclass(frozen=True, kw_only=True)
class SweepWork:
    """A whole sweep; a `cardan.batch.work.Work`."""

    ask: DriveEvaluator  # questions, and the drive in which fields vary
    points: Points
    limits: tuple[Limit, ...] = ()  # what a point has to keep to be feasible
    reduce: tuple[Reduce, ...] = ()
    title: str = ""  # what to call it
    reductions: tuple[Reduction, ...] = field(init=False, default=())

    def __post_init__(self) -> None:
        told = at_work(self.reduce, self.points, self.columns)
        object.__setattr__(self, "reductions", (States(), *told))

    @property
    def size(self) -> int:
        """How many points there are."""
        return self.points.size

    @cached_property
    def columns(self) -> tuple[Column, ...]:
        """Columns of the table: what varies, answers, status, and whether all constraints are kept."""
        by_path = {spot.path: spot.column for spot in self.ask.spots}
        said = {name: Column(name=name, unit="", role="point", text=name) for name in self.points.fields}
        points = tuple(by_path.get(name, said[name]) for name in self.points.fields)
        kept = Column(name=FEASIBLE, unit="", role="status", text=TEXT_FEASIBLE)
        return (*points, *self.ask.answers, STATUS_COLUMN, *([kept] if self.limits else []))

    @cached_property
    def name(self) -> str:
        """Hash of all that decides rows and summaries, the version of the program among it."""
        told = {
            **self.provenance,
            "columns": [one.name for one in self.columns],
            "whole drive": repr(self.ask.drive),
            "catalogue": repr(self.ask.known),
        }
        return hashlib.sha256(json.dumps(told, sort_keys=True).encode()).hexdigest()

    @cached_property
    def provenance(self) -> Mapping[str, Any]:
        """What the rows come from: version, drive, axes with their seeds, questions, units."""
        drive = self.ask.drive
        return {
            "program": "cardan",
            "version": VERSION,
            "title": self.title,
            "drive": tree_of(drive if isinstance(drive, Mechanism) else shortened(drive, self.ask.known)),
            "vary": [axis.told() for axis in self.points.axes],
            "ask": list(self.ask.questions),
            "constraints": [str(one) for one in self.limits],
            "reduce": [one.told() for one in self.reduce],
            "units": {one.name: one.unit for one in self.columns},
            "device": self.ask.device,
        }

    def evaluate(self, start: int, stop: int) -> Rows:
        """Return rows ``start`` to ``stop``."""
        if not self.ask.fast or stop - start <= BLOCK or self.ask.device == "gpu":
            return self._rows(start, stop)
        whole = self._room(stop - start)
        blocks = -(-(stop - start) // BLOCK)
        share(lambda first, last: self._fill(whole, start, start + first * BLOCK, start + last * BLOCK), blocks)
        return whole

    def reduced(self, start: int, stop: int) -> list[State]:
        """Return the states of the reductions over rows ``start`` to ``stop``, which are not kept.

        No more than `GATHERED` rows are held for each processor.
        """
        if not self.ask.fast or self.ask.device == "gpu":
            rows = self._rows(start, stop)
            return [one.add(one.empty(), rows, start) for one in self.reductions]
        parts = -(-(stop - start) // GATHERED)
        runs = min(parts, RUNS)
        states: list[list[State]] = [[] for _k in range(runs)]

        def work(first: int, last: int) -> None:
            room = self._room(min(GATHERED, stop - start))
            for run in range(first, last):
                seen = [one.empty() for one in self.reductions]
                for part in range(parts * run // runs, parts * (run + 1) // runs):
                    at, end = start + part * GATHERED, min(start + (part + 1) * GATHERED, stop)
                    self._fill(room, at, at, end)
                    rows = {name: values[: end - at] for name, values in room.items()}
                    seen = [one.add(state, rows, at) for one, state in zip(self.reductions, seen, strict=True)]
                states[run] = seen

        share(work, runs)
        whole = states[0]
        for more in states[1:]:
            whole = [one.merge(a, b) for one, a, b in zip(self.reductions, whole, more, strict=True)]
        return whole

    def _room(self, count: int) -> Rows:
        """Return empty arrays for so many rows."""
        return {name: np.empty(count, dtype=values.dtype) for name, values in self._rows(0, 0).items()}

    def _fill(self, room: Rows, origin: int, start: int, stop: int) -> None:
        """Put rows ``start`` to ``stop`` into arrays that begin with row ``origin`` and may end before the last."""
        end = min(stop, self.size, origin + next(len(values) for values in room.values()))
        for at in range(start, end, BLOCK):
            for name, values in self._rows(at, min(at + BLOCK, end)).items():
                room[name][at - origin : at - origin + len(values)] = values

    def why(self, row: int) -> tuple[Problem, ...]:
        """Return what stands in the way of a point's answers; nothing where it is answered."""
        values = {name: column[0] for name, column in self.points.values(row, row + 1).items()}
        return self.ask.at(values)[2]

    def _rows(self, start: int, stop: int) -> Rows:
        values: dict[str, Array] = self.points.values(start, stop)
        rows: Rows = {**values, **self.ask.rows(values, stop - start)}
        if self.limits:
            kept = excess(self.limits, rows, stop - start) <= 0.0
            rows[FEASIBLE] = kept & (rows[STATUS] == int(Status.ANSWERED))
        return {column.name: rows[column.name] for column in self.columns}


def work_of(
    drive: Drive | Mechanism,
    vary: Mapping[str, Any] | Sequence[Axis],
    ask: Sequence[str],
    *,
    reduce: Sequence[str | Reduce] = (),
    constraints: Sequence[str | Limit] = (),
    known: Catalogue | None = None,
    device: Device = "cpu",
    title: str = "",
) -> SweepWork:
    """Return a sweep as work for an engine.

    vary: path with unit -> list of values; or axes: `GridAxis`, `TableAxis`, `SampledAxis`. Every point of their
    product is one.
    ask: names of questions, see `questions`; reduce: ``"max life_h by duty.speed_rpm"`` and the like.
    constraints: ``"speed_fluctuation_percent <= 2"``: what a point has to keep to be feasible.
    known: where sizes and grades are looked up.
    """
    problems: list[Problem] = []
    axes: list[Axis] = []
    limits: list[Limit] = []
    reduces: list[Reduce] = []
    for path, values in vary.items() if isinstance(vary, Mapping) else ():
        _collect(problems, axes, lambda path=path, values=values: listed(drive, path, values))
    axes += [] if isinstance(vary, Mapping) else vary
    for limit in constraints:
        _collect(problems, limits, lambda one=limit: limit_of(one) if isinstance(one, str) else one)
    for one in reduce:
        _collect(problems, reduces, lambda one=one: reduce_of(one) if isinstance(one, str) else one)
    points = Points(axes=())
    try:
        points = Points(axes=tuple(axes))
    except InputError as error:
        problems += error.problems
    facts = {name for axis in axes for name in axis.facts}
    paths = [name for axis in axes for name in axis.fields if name not in facts]
    try:
        asked = evaluator(drive, paths, ask, known=known, device=device, size=points.size)
        problems += [] if problems else _misfits(asked, points)
        if not problems:
            bare = SweepWork(ask=asked, points=points)
            check_names(limits, bare.columns)
            with_limits = SweepWork(ask=asked, points=points, limits=tuple(limits))
            problems += _twins(with_limits)
            problems += _words(with_limits, reduces)
            at_work(reduces, points, with_limits.columns)
    except InputError as error:
        problems += error.problems
    check(problems)
    return SweepWork(ask=asked, points=points, limits=tuple(limits), reduce=tuple(reduces), title=title or drive.name)


def _misfits(asked: DriveEvaluator, points: Points) -> Iterator[Problem]:
    """Yield fields that are given words where they hold numbers, and the like."""
    first = points.values(0, 1)
    found = (spot.problem(first[spot.path]) for spot in asked.spots)
    yield from (one for one in found if one is not None)


def _twins(work: SweepWork) -> Iterator[Problem]:
    """Yield names that two columns have, however they are written: a fact may be called like an answer."""
    seen: set[str] = set()
    for column in work.columns:
        if column.name.casefold() in seen:
            yield Problem(column.name, _("another column has this name already"))
        seen.add(column.name.casefold())


def _words(work: SweepWork, reduces: Sequence[Reduce]) -> Iterator[Problem]:
    """Yield constraints on columns of words, and reductions of them."""
    first = work.points.values(0, 1)
    words = {name for name, values in first.items() if values.dtype.kind == "U"}
    named = [(f"constraints: {one}", one.name) for one in work.limits]
    for k, one in enumerate(reduces):
        named += [(f"reduce[{k}]", one.of), *((f"reduce[{k}]", limit.name) for limit in one.where)]
    for path, name in named:
        if name in words:
            yield Problem(path, _("{name} holds no numbers").format(name=name))


def _collect(problems: list[Problem], into: list[Any], make: Any) -> None:
    try:
        into.append(make())
    except InputError as error:
        problems += error.problems


def listed(drive: Drive | Mechanism, path: str, values: Any) -> TableAxis:
    """Return the axis of a path with a list of values; a path of a list of numbers takes lists of them."""
    if hasattr(values, "at"):
        check([Problem(path, _("a distribution says how points are drawn; put it into Drawn(distributions=…)"))])
    given = values.tolist() if hasattr(values, "tolist") else values
    if not isinstance(given, Sequence) or isinstance(given, str):
        check([Problem(path, _("a list of values is needed"))])
    fields, rows = spread_out(path, list(given))
    return TableAxis(fields=fields, rows=tuple(rows), name=path)
