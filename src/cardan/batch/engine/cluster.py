"""Chunks on a Dask cluster: one of this machine, or one that is reached by the address of its scheduler.

Dask does again what a dead worker had. What the loss of a scheduler takes along, we do again: we hold every chunk that
is not done, and no more of them are given away than the workers have in hand.
"""

from __future__ import annotations

import itertools
import logging
import multiprocessing
import os
import pickle
import signal
import sys
import tempfile
import time
import uuid
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import CancelledError
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from functools import lru_cache
from queue import Empty, SimpleQueue
from typing import Any, TypeVar

from cardan.batch.work import Chunk
from cardan.errors import InputError, refuse
from cardan.later import later
from cardan.maths.compiled.method import processors
from cardan.texts import _, language, mark, speaking
from cardan.version import VERSION

from .engines import OFTEN, Done, EngineLostError, Heard, deaf, died, reason, stillborn

T = TypeVar("T")

AHEAD = 2
"""Chunks that are given away for each thread of a worker: one that it works on, and one so that it need not wait."""

LOOK = 1.0  # seconds between two looks at how many workers there are
TRY = 2.0  # seconds that a scheduler has to answer a single question
GONE = ("cancelled", "lost")  # what Dask calls work that it will not give back
FIRST = 10.0  # seconds that a scheduler has to answer at first


@dataclass(frozen=True, kw_only=True, slots=True)
class Cluster:
    """Workers of ``dask.distributed``.

    Parameters
    ----------
    scheduler : str, optional
        Address of a running scheduler, ``tcp://host:8786``; by default a cluster on this machine is started, and
        ended with the iterator.
    workers : int, optional
        How many workers the cluster on this machine has, one thread each; by default one for each processor.
    patience : float [s]
        How long to wait for a scheduler that is gone, and for a first worker where there is none.
    shared : bool
        Whether the workers of ``scheduler`` see the same files, so that each may write its own chunks; else their rows
        are sent here.
    """

    scheduler: str | None = None
    workers: int | None = None
    patience: float = 300.0
    shared: bool = False

    def __post_init__(self) -> None:
        if self.workers is not None and self.scheduler is not None:
            raise refuse("workers", _("a cluster that is running has the workers that it has"), "inconsistent")
        if self.workers is not None and self.workers < 1:
            raise refuse("workers", _("{count} is not at least 1").format(count=self.workers), "out_of_range")

    @property
    def writes(self) -> bool:
        """Whether the workers see the files of this machine."""
        return self.scheduler is None or self.shared

    def run(
        self, task: Callable[[Chunk], T], chunks: Iterable[Chunk], *, heard: Heard | None = None
    ) -> Generator[Done[T], None, None]:
        """Work on chunks.

        Raises
        ------
        InputError
            No scheduler answers at the address, or its workers run another version.
        EngineLostError
            Scheduler or workers are gone and do not come back.
        MissingExtraError
            ``dask.distributed`` is not installed.
        """
        library()
        with _quiet(), ExitStack() as stack:
            address = self.scheduler or stack.enter_context(local_cluster(self.workers or processors()))
            link = stack.enter_context(_Link(address, self.patience, heard or (lambda: None)))
            yield from _worked(link, task, iter(chunks))


def _worked(link: _Link, task: Callable[[Chunk], T], waiting: Iterator[Chunk]) -> Generator[Done[T], None, None]:
    """Give chunks away and take what comes back, until all are done or nobody wants them any more.

    Chunks over which workers died are tried once more at the end, each alone: then it is known which one kills.
    """
    told = pickle.dumps((task, language(), VERSION))
    again: deque[Chunk] = deque()
    suspects: deque[Chunk] = deque()
    alone: Chunk | None = None
    out: dict[Any, tuple[Chunk, Any]] = {}
    ready: SimpleQueue[Any] = SimpleQueue()
    link.connect()
    while True:
        if not link.up():
            again.extend(chunk for chunk, _future in out.values())
            out.clear()
            ready = SimpleQueue()
            link.connect(again=True)
            if link.stopped:
                return
        while len(out) < AHEAD * max(1, link.threads()):
            chunk = again.popleft() if again else next(waiting, None)
            if chunk is None and not out and suspects:
                chunk = alone = suspects.popleft()
            if chunk is None:
                break
            future = link.give(told, chunk)
            if future is None:
                again.append(chunk)
                break
            out[future.key] = (chunk, future)
            future.add_done_callback(lambda one, ready=ready: ready.put(one.key))
        if not out and not again:
            return
        if link.stop():
            return
        for key in _those(ready):
            chunk, future = out[key]
            try:
                done = link.taken(chunk, future)
            except _KilledError as killed:
                done = Done(chunk, failure=died(killed.deaths))
                if chunk is not alone:  # whatever a dead worker had in hand is blamed for its death
                    del out[key]
                    suspects.append(chunk)
                    continue
            if done is not None:
                del out[key]
                yield done
            elif future.status in GONE and link.up():  # somebody else has cancelled it
                del out[key]
                again.append(chunk)
            elif link.up():
                future.add_done_callback(lambda one, ready=ready: ready.put(one.key))


def _those(ready: SimpleQueue[Any]) -> Iterator[Any]:
    """Yield what is ready now, waiting a little for the first."""
    with suppress(Empty):
        yield ready.get(timeout=OFTEN)
        while True:
            yield ready.get_nowait()


class _KilledError(Exception):
    """Workers died over a chunk, or over its neighbour."""

    def __init__(self, deaths: int) -> None:
        self.deaths = deaths
        super().__init__(deaths)


class _Link:
    """The line to a scheduler."""

    def __init__(self, address: str, patience: float, heard: Heard) -> None:
        self.address, self.patience, self.heard = address, patience, heard
        self.client: Any = None
        self.stopped = False
        self._threads, self._looked = 0, float("-inf")
        self._alone: float | None = None
        self._keys = (f"cardan-{uuid.uuid4().hex}-{count}" for count in itertools.count())

    def __enter__(self) -> _Link:
        return self

    def __exit__(self, *_what: object) -> None:
        self._close()

    def _close(self) -> None:
        if self.client is not None:
            with suppress(Exception):  # whatever it is, it is over
                self.client.close(timeout=TRY)
        self.client = None

    def stop(self) -> bool:
        """Whether to stop."""
        self.stopped = self.stopped or self.heard() == "stop"
        return self.stopped

    def up(self) -> bool:
        """Whether the line holds."""
        return self.client is not None and self.client.status == "running"

    def connect(self, *, again: bool = False) -> None:
        """Reach the scheduler; one that was there before may take a while to come back."""
        self._close()
        end = time.monotonic() + (self.patience if again else 0.0)
        while not self.stop():
            try:
                self.client = library().Client(self.address, timeout=TRY if again else FIRST, set_as_default=False)
                self._like_us()
                self._alone, self._looked = None, float("-inf")
                return
            except (OSError, ValueError, TypeError, ImportError) as error:
                self._close()
                if not again:
                    raise refuse("scheduler", _nobody(self.address, error)) from None
                if time.monotonic() >= end:
                    raise EngineLostError(_lost(self.address, self.patience)) from None
            except InputError as error:
                if not again:
                    raise
                raise EngineLostError(reason(error)) from None
            time.sleep(OFTEN)

    def _like_us(self) -> None:
        """Refuse workers that would compute something else."""
        ask = "(__import__('sys').version_info[:2], __import__('cardan').__version__)"
        here = (sys.version_info[:2], VERSION)
        found = self.client.run(eval, ask, on_error="return") if self.client is not None else {}
        odd = {where: told for where, told in found.items() if told != here}
        if odd:
            where, told = next(iter(odd.items()))
            raise refuse("scheduler", _odd(str(where), told, here), "inconsistent")

    def threads(self) -> int:
        """Return how many threads the workers have, as of a moment ago."""
        now = time.monotonic()
        if now - self._looked >= LOOK and self.client is not None and self.up():
            with suppress(Exception):  # a scheduler that is busy or gone tells nothing; the line will show which
                self._threads = sum(self.client.sync(self.client.scheduler.ncores, callback_timeout=TRY).values())
                self._alone = None if self._threads else self._alone or now
            self._looked = time.monotonic()
        if self._alone is not None and now - self._alone > self.patience:
            text = _("the scheduler {address} has had no worker for {seconds:g} s")
            raise EngineLostError(text.format(address=self.address, seconds=self.patience))
        return self._threads

    def give(self, told: bytes, chunk: Chunk) -> Any:
        """Give a chunk away; None where the line breaks."""
        try:
            if self.client is None:
                return None
            return self.client.submit(_work, told, chunk, key=next(self._keys), pure=False)
        except Exception:  # the client is closed
            return None

    def taken(self, chunk: Chunk, future: Any) -> Done[Any] | None:
        """Return what became of a chunk; None where it has to be waited for once more, or done again."""
        if future.status in GONE or future.status == "pending":
            return None
        try:
            value, failure = future.result(timeout=self.patience)
        except library().KilledWorker as error:
            raise _KilledError(int(getattr(error, "allowed_failures", 0)) + 1) from None
        except (CancelledError, TimeoutError, OSError):
            return None
        except Exception as error:  # what went wrong there is not for us to know beforehand
            return None if not self.up() else Done(chunk, failure=reason(error))
        return Done(chunk, value, failure)


@lru_cache(maxsize=4)
def _read(told: bytes) -> Any:
    return pickle.loads(told)


def _work(told: bytes, chunk: Chunk) -> tuple[Any, str | None]:
    """Work on a chunk; runs on a worker."""
    try:
        task, code, version = _read(told)
        if version != VERSION:
            return None, _odd("", (sys.version_info[:2], VERSION), (sys.version_info[:2], version))
        with speaking(code):
            return task(chunk), None
    except Exception as error:  # the other chunks are still worth having
        return None, reason(error)


def _nobody(address: str, error: Exception) -> str:
    told = str(error).strip()
    if isinstance(error, OSError):  # what Dask says then is long, and says no more
        return _("no Dask scheduler answers at {address}").format(address=address)
    return _("{address} is not the address of a Dask scheduler: {why}").format(
        address=address, why=told.splitlines()[0]
    )


def _lost(address: str, patience: float) -> str:
    return _("the scheduler {address} is gone and did not come back within {seconds:g} s").format(
        address=address, seconds=patience
    )


def _odd(where: str, told: Any, here: tuple[tuple[int, ...], str]) -> str:
    """Return how a worker differs from us."""
    ours = _named(here)
    if isinstance(told, BaseException):
        return _("worker {where} cannot run cardan: {why}").format(where=where, why=reason(told))
    return _("worker {where} has {theirs}, here is {ours}: both have to be the same").format(
        where=where, theirs=_named(told), ours=ours
    )


def _named(facts: tuple[tuple[int, ...], str]) -> str:
    return f"cardan {facts[1]}, Python {'.'.join(map(str, facts[0]))}"


@contextmanager
def _quiet() -> Iterator[None]:
    """Keep Dask from telling what we tell."""
    names = ("distributed", "tornado", "asyncio")
    before = {name: logging.getLogger(name).level for name in names}
    for name in names:
        logging.getLogger(name).setLevel(logging.CRITICAL)
    try:
        yield
    finally:
        for name, level in before.items():
            logging.getLogger(name).setLevel(level)


# A Dask cluster of this machine: started for one sweep, and ended with it whatever happens.

PART = 5.0  # seconds that a cluster of ours has to end


library = later("distributed", mark("a cluster needs dask.distributed: pip install 'cardan[cluster]'"))
"""``dask.distributed``."""


@contextmanager
def local_cluster(workers: int) -> Iterator[str]:
    """Start a cluster on this machine that nobody else can reach, and end it afterwards."""
    if getattr(multiprocessing.current_process(), "_inheriting", False):
        raise RuntimeError(stillborn(""))  # a script without a guard, which a worker of ours imports as it begins
    with tempfile.TemporaryDirectory(prefix="cardan-") as folder:
        try:
            with deaf():  # threads that start workers, now or later, inherit it
                cluster = library().LocalCluster(
                    n_workers=workers,
                    threads_per_worker=1,
                    processes=True,
                    host="127.0.0.1",
                    scheduler_port=0,
                    dashboard_address="127.0.0.1:0",
                    worker_dashboard_address="127.0.0.1:0",
                    scheduler_kwargs={"dashboard": False},
                    local_directory=folder,
                    silence_logs=logging.CRITICAL,
                )
        except RuntimeError:  # its processes ended before they began
            raise EngineLostError(stillborn("")) from None
        try:
            yield str(cluster.scheduler_address)
        finally:
            _end(cluster)


def _end(cluster: Any) -> None:
    """End a cluster of ours at once: a chunk that is worked on is worth nothing any more."""
    for _attempt in range(2):  # one may just have been about to be started
        for nanny in list(cluster.workers.values()):
            nanny.auto_restart = False
            if nanny.pid:
                with suppress(ProcessLookupError):
                    os.kill(nanny.pid, getattr(signal, "SIGKILL", signal.SIGTERM))
        try:
            cluster.close(timeout=PART)
        except TimeoutError:
            continue
        return
