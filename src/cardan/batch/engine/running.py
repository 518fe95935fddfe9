"""Running a sweep: chunks through an engine, into a folder or into memory, their summaries put together in order."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Collection, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, TypeAlias

from cardan.batch.table.store import Folder, Store, opened
from cardan.batch.table.swept import Ending, Missing, Sweep, ranges, read_sweep
from cardan.batch.work import Chunk, Chunks, Reduction, Rows, State, Work, chunks_of, made, rows_for
from cardan.errors import refuse
from cardan.files import refusal
from cardan.texts import _

from .engines import Engine, EngineLostError, InProcess, heeded, reason

__all__ = ["Sweep", "read_sweep", "run"]

Keeping: TypeAlias = Literal["kept", "none"]

HELD = 2**30  # bytes of a table that may be held in memory
NUMBER = 8  # bytes of a number
OFTEN = 0.1  # seconds between two words on how far a sweep is


def run(
    work: Work,
    *,
    engine: Engine = InProcess(),  # noqa: B008 - frozen
    into: str | Path | None = None,
    rows: Keeping = "kept",
    chunk: int | None = None,
    progress: Callable[[float], object] | None = None,
) -> Sweep:
    """Run a sweep, or what is missing of it.

    engine: where its chunks are worked on.
    into: folder for the table. Chunks that are there and whole are not done again, so a run that was ended goes on.
    rows: whether the table is kept; without it only the reductions are.
    chunk: rows of a chunk; measured by default. A folder keeps to those it was begun with.
    progress: called often with the share of rows done; may answer "stop".
    Returns Sweep: the same one, bit for bit, on whatever engine and after however many interruptions, for the same
    chunks.
    Summaries are merged in the order of the chunks, as JSON holds them, whatever order the chunks are ready in.
    """
    keeps = rows == "kept"
    if into is not None:
        heard = _Told(work.size, progress)
        cut = (lambda: chunk) if chunk is not None else (lambda: rows_for(work, keeps=keeps))
        with opened(Path(into), work, keeps=keeps, cut=cut, heard=lambda: heard(0)) as store:
            return _Running(work, engine, store.chunks, store=store, keeps=keeps, told=heard).result()
    if keeps and work.size * len(work.columns) * NUMBER > HELD:
        text = _("a table of {count} points is too large to be held: keep it in a folder, or keep no rows")
        raise refuse("rows", text.format(count=work.size), "out_of_range")
    return _Running(
        work, engine, chunks_of(work, chunk, keeps=keeps), keeps=keeps, told=_Told(work.size, progress)
    ).result()


@dataclass(frozen=True, kw_only=True)
class Made:
    """What a worker made of a chunk."""

    states: str  # states of the reductions, as JSON
    rows: Rows | None = None  # dict of str to array (n,),: the rows, where they are not written there
    refused: str = ""  # why they could not be written there


@dataclass(frozen=True, kw_only=True)
class Making:
    """What a worker does with a chunk: evaluates it, sums it up, and writes it or sends it."""

    work: Work  # the sweep
    keeps: bool  # whether rows are kept; without them the work sums up as it goes, where it can
    folder: Folder | None = None  # where to write; None where rows are sent

    def __call__(self, chunk: Chunk) -> Made:
        """Return what a chunk holds."""
        rows, states = made(self.work, chunk.start, chunk.stop, keeps=self.keeps)
        told = json.dumps(states)
        if self.folder is None:
            return Made(states=told, rows=rows)
        if not self.folder.seen():
            return Made(states=told, refused=_("a worker does not see the folder {path}").format(path=self.folder.path))
        try:
            self.folder.put(chunk, rows, json.loads(told))
        except OSError as error:
            return Made(states=told, refused=_refused(self.folder, error))
        return Made(states=told)


def _refused(folder: Folder, error: OSError) -> str:
    return _("{path} cannot be written: {why}").format(path=folder.path, why=refusal(error))


class _Told:
    """Tells how far a sweep is, `OFTEN` and no oftener, and remembers that it is to stop."""

    def __init__(self, size: int, progress: Callable[[float], object] | None) -> None:
        self._size = max(size, 1)
        self._progress = progress
        self._last = float("-inf")
        self.stopped = False
        self.interrupted: Callable[[], None] = lambda: None  # raises what ctrl-C raised and nobody passed on

    def __call__(self, rows: int, *, now: bool = False) -> str | None:
        self.interrupted()
        at = time.monotonic()
        if self._progress is not None and (now or at - self._last >= OFTEN):
            self._last = at
            self.stopped = self._progress(rows / self._size) == "stop" or self.stopped
        return "stop" if self.stopped else None


class _Merged:
    """States of all chunks, put together in their order whatever order they come in."""

    def __init__(
        self, reductions: Sequence[Reduction], before: Collection[int], stored: Callable[[int], list[State]]
    ) -> None:
        self._reductions = reductions
        self._before, self._stored = before, stored
        self._states: list[State] = [one.empty() for one in reductions]
        self._ahead: dict[int, list[State] | None] = {}
        self._next = 0

    def take(self, index: int, states: list[State] | None) -> None:
        """Take the states of a chunk, None where it failed."""
        self._ahead[index] = states
        while self._next in self._ahead or self._next in self._before:
            self._add()

    def results(self, count: int) -> dict[str, Any]:
        """Return what the summaries tell of all that came, of ``count`` chunks at most."""
        while self._next < count:
            self._add()
        return {one.name: one.result(state) for one, state in zip(self._reductions, self._states, strict=True)}

    def _add(self) -> None:
        """Add the next chunk, if there is anything of it."""
        index, self._next = self._next, self._next + 1
        states = self._stored(index) if index in self._before else self._ahead.pop(index, None)
        if states is not None:
            both = zip(self._reductions, self._states, states, strict=True)
            self._states = [one.merge(before, more) for one, before, more in both]


class _Running:
    """One run of a sweep."""

    def __init__(
        self, work: Work, engine: Engine, chunks: Chunks, *, keeps: bool, told: _Told, store: Store | None = None
    ) -> None:
        self.work, self.engine, self.chunks, self.store, self.keeps = work, engine, chunks, store, keeps
        self.told = told
        self.done: set[int] = set() if store is None else set(store.done)
        self.rows = sum(chunks[k].size for k in self.done)
        self.failed: dict[int, str] = {}
        self.held: dict[int, Rows] = {}
        self.merged = _Merged(work.reductions, frozenset(self.done), self._stored)

    def _stored(self, index: int) -> list[State]:
        """Return the states of a chunk of an earlier run."""
        return [] if self.store is None else self.store.folder.states(self.chunks[index])

    def result(self) -> Sweep:
        """Run, and return what came out."""
        try:
            with heeded() as self.told.interrupted:
                why = self._run()
        except KeyboardInterrupt:
            self._sweep("cancelled", _("it was stopped"))  # the folder says how far it is
            raise
        if self.told.stopped and len(self.done) < len(self.chunks):
            return self._sweep("cancelled", _("it was stopped"))
        return self._sweep("done" if len(self.done) == len(self.chunks) else "incomplete", why)

    def _run(self) -> str:
        """Do all that is to be done; return why the rest of it is not."""
        if self.told(self.rows, now=True) == "stop" or len(self.done) == len(self.chunks):
            return ""
        folder = self.store.folder if self.store is not None and self.engine.writes else None
        task = Making(work=self.work, keeps=self.keeps, folder=folder)
        todo = (chunk for chunk in self.chunks if chunk.index not in self.done)
        try:
            with closing(self.engine.run(task, todo, heard=lambda: self.told(self.rows))) as running:
                for one in running:
                    if one.value is None:
                        self.failed[one.chunk.index] = one.failure or ""
                        self.merged.take(one.chunk.index, None)
                    elif refused := self._take(one.chunk, one.value, folder is not None):
                        return refused
                    if self.told(self.rows, now=len(self.done) == len(self.chunks)) == "stop":
                        break
        except EngineLostError as error:
            return reason(error)
        return ""

    def _take(self, chunk: Chunk, got: Made, here: bool) -> str:
        """Take what was made of a chunk; return why it cannot be kept."""
        if got.refused:
            return got.refused
        states: list[State] = json.loads(got.states)
        if self.store is not None and not here:
            try:
                self.store.folder.put(chunk, got.rows, states)
            except OSError as error:
                return _refused(self.store.folder, error)
        elif got.rows is not None:
            self.held[chunk.index] = got.rows
        self.merged.take(chunk.index, states)
        self.done.add(chunk.index)
        self.rows += chunk.size
        return ""

    def _sweep(self, status: Ending, why: str) -> Sweep:
        missing = ranges(
            Missing(chunk.start, chunk.stop, self.failed.get(chunk.index) or why)
            for chunk in self.chunks
            if chunk.index not in self.done
        )
        reductions = self.merged.results(len(self.chunks))
        if self.store is not None:
            self.store.keep({"status": status, "missing": missing, "reductions": reductions})
        return Sweep(
            columns=tuple(self.work.columns),
            size=self.work.size,
            status=status,
            missing=missing,
            reductions=reductions,
            provenance=self.work.provenance,
            folder=None if self.store is None else self.store.folder.path,
            damaged=() if self.store is None else self.store.damaged,
            held=tuple((self.chunks[k].start, self.held[k]) for k in sorted(self.held)),
        )
