"""Sweeps for tests of engines and stores: light, pure, and in trouble at a row where a test wants them to be."""

import hashlib
import os
import signal
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from cardan.batch.work import Column


@dataclass(frozen=True)
class Total:
    """A sum in floating point: it tells in which order it was added up."""

    name: str = "total"
    of: str = "y"

    def empty(self):
        return [0, 0.0]

    def add(self, state, rows, start):
        return [state[0] + len(rows[self.of]), state[1] + float(np.sum(rows[self.of]))]

    def merge(self, one, other):
        return [one[0] + other[0], one[1] + other[1]]

    def result(self, state):
        return {"count": state[0], "sum": state[1]}


@dataclass(frozen=True)
class Largest:
    """Value and row of the largest."""

    name: str = "largest"
    of: str = "y"

    def empty(self):
        return [None, None]

    def add(self, state, rows, start):
        k = int(np.nanargmax(rows[self.of]))
        return self.merge(state, [float(rows[self.of][k]), start + k])

    def merge(self, one, other):
        if one[0] is None or other[0] is None:
            return other if one[0] is None else one
        return one if one[0] >= other[0] else other

    def result(self, state):
        return {"value": state[0], "row": state[1]}


@dataclass(frozen=True)
class Trouble:
    """What happens when a row is evaluated.

    Attributes
    ----------
    kind : str
        ``kill`` and ``raise``; ``slow`` sleeps for ``seconds`` in every chunk.
    row : int
        Where.
    marks : str
        A folder in which each time leaves a mark; after ``times`` of them there is no trouble any more.
    """

    kind: str = ""
    row: int = -1
    marks: str = ""
    times: int = 1
    seconds: float = 0.0

    def strike(self, start, stop):
        if self.kind == "slow":
            time.sleep(self.seconds)
        if self.kind not in ("kill", "raise") or not start <= self.row < stop:
            return
        if self.marks:
            struck = len(list(Path(self.marks).iterdir()))
            if struck >= self.times:
                return
            (Path(self.marks) / f"{struck}-{os.getpid()}").touch()
        if self.kind == "kill":
            os.kill(os.getpid(), signal.SIGKILL)
        raise ValueError("row of trouble")


@dataclass(frozen=True)
class Numbers:
    """Rows k, y = a function of k with digits in every place, a word, and nan in some rows."""

    size: int = 100
    seed: int = 1
    reductions: tuple = (Total(), Largest())
    trouble: Trouble = field(default=Trouble())

    columns = (
        Column(name="k", unit="", role="point", text="number"),
        Column(name="y_deg", unit="deg", role="answer", text="a wild function"),
        Column(name="y", unit="", role="answer", text="another"),
        Column(name="word", unit="", role="answer", text="a word"),
        Column(name="good", unit="", role="answer", text="whether it is"),
        Column(name="status", unit="", role="status", text="how it went"),
    )

    @property
    def name(self):
        return hashlib.sha256(f"numbers {self.size} {self.seed}".encode()).hexdigest()

    @property
    def provenance(self):
        return {"version": "test", "vary": {"k": self.size}, "seed": self.seed, "drive": "name = 'ö'\n"}

    def evaluate(self, start, stop):
        self.trouble.strike(start, stop)
        k = np.arange(start, stop)
        y = np.sin(k * 12.9898 + self.seed) * 43758.5453
        bad = k % 7 == 3
        return {
            "k": k,
            "y_deg": np.where(bad, np.nan, y),
            "y": y,
            "word": np.asarray([f"w{n % 3}" for n in k]),
            "good": k % 2 == 0,
            "status": bad.astype(np.int8),
        }


@dataclass(frozen=True)
class Summed(Numbers):
    """Numbers that are summed up without being held."""

    def evaluate(self, start, stop):
        raise AssertionError("nobody keeps rows")

    def reduced(self, start, stop):
        rows = Numbers.evaluate(self, start, stop)
        return [one.add(one.empty(), rows, start) for one in self.reductions]


def size_of(chunk):
    """Return the rows of a chunk."""
    return chunk.stop - chunk.start


@dataclass(frozen=True)
class Rowwise:
    """A task of an engine: the rows of a chunk, or its trouble."""

    trouble: Trouble = Trouble()

    def __call__(self, chunk):
        self.trouble.strike(chunk.start, chunk.stop)
        return list(range(chunk.start, chunk.stop))


def threads_and_process(chunk):
    """Return how many threads the kernels of a worker have, and its number."""
    from cardan.maths.compiled.method import available

    return available(), os.getpid()


def unsendable(chunk):
    """Return what cannot be sent."""
    return lambda: None


def lasting(chunk):
    """Work for a minute."""
    time.sleep(60.0)


class Unreadable:
    """A task that cannot be read in another process."""

    def __reduce__(self):
        return _broken, ()

    def __call__(self, chunk):
        return None


def _broken():
    raise ImportError("no module named 'tools'")
