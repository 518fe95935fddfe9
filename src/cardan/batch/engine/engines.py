"""Where chunks are worked on: in this process, or in processes beside it.

An engine has one method, ``run(task, chunks)``; it knows nothing of sweeps. What a chunk gives comes out in any order,
chunks that fail among them. Closing the iterator ends everything that the engine started.
"""

from __future__ import annotations

import multiprocessing
import os
import pickle
import signal
import sys
import threading
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from multiprocessing import resource_tracker
from multiprocessing.connection import Connection, wait
from types import FrameType
from typing import Any, Generic, Protocol, TypeVar

from cardan.batch.work import Chunk
from cardan.errors import CardanError, InputError, MissingExtraError, refuse
from cardan.files import refusal
from cardan.maths.compiled.method import processors
from cardan.texts import _, language, plural, speaking

T = TypeVar("T")
T_co = TypeVar("T_co", covariant=True)

Heard = Callable[[], object]  # called often, while waiting too; may answer "stop"
OFTEN = 0.2  # seconds after which an engine that waits asks whether to go on


class EngineLostError(CardanError):
    """An engine cannot go on: its machines are gone. What came out before is good."""


@dataclass(frozen=True, slots=True)
class Done(Generic[T_co]):
    """What became of a chunk."""

    chunk: Chunk
    value: T_co | None = None  # what the task gave; None where it failed
    failure: str | None = None  # why there is nothing


class Engine(Protocol):
    """Anything that works on chunks."""

    @property
    def writes(self) -> bool:
        """Whether its workers see the files of this machine, so that each may write its own."""

    def run(
        self, task: Callable[[Chunk], T], chunks: Iterable[Chunk], *, heard: Heard | None = None
    ) -> Generator[Done[T], None, None]:
        """Work on chunks.

        task: pure, and picklable where the engine has other processes; chunks: taken as they are needed.
        heard: called between chunks, and every `OFTEN` seconds while waiting for one; may answer "stop", which ends the
        iterator.
        Yields Done: as chunks are ready, in any order.
        """


@dataclass(frozen=True, kw_only=True, slots=True)
class InProcess:
    """One chunk after the other, here; the kernels of a chunk use all processors.

    Examples
    --------
    >>> from cardan.backends import InProcess
    >>> from cardan.batch.work import Chunks
    >>> [done.value for done in InProcess().run(lambda chunk: chunk.size, Chunks("a sweep", size=5, rows=2))]
    [2, 2, 1]
    """

    writes = True

    def run(
        self, task: Callable[[Chunk], T], chunks: Iterable[Chunk], *, heard: Heard | None = None
    ) -> Generator[Done[T], None, None]:
        """Work on chunks in their order."""
        for chunk in chunks:
            if heard is not None and heard() == "stop":
                return
            try:
                done = Done(chunk, task(chunk))
            except MissingExtraError:  # no other chunk would fare better
                raise
            except Exception as error:  # the other chunks are still worth having
                done = Done(chunk, failure=reason(error))
            yield done


def reason(error: BaseException) -> str:
    """Return why something failed, in one sentence."""
    if isinstance(error, InputError):
        return "; ".join(str(problem) for problem in error.problems)
    told = " ".join(str(error).split())
    if isinstance(error, CardanError) and told:
        return told
    return f"{type(error).__name__}: {told}" if told else type(error).__name__


@dataclass(frozen=True, kw_only=True, slots=True)
class Processes:
    """Processes of this machine, one thread each.

    A process that is killed loses nothing: its chunk goes to another one. They end with the iterator, and with this
    process, however it ends.

    Parameters
    ----------
    workers : int, optional
        How many processes; by default as many as there are processors.
    retries : int
        How many more times a chunk is tried whose process died: one that always takes its process along must end.
    """

    workers: int | None = None
    retries: int = 2

    writes = True

    def __post_init__(self) -> None:
        if self.workers is not None and self.workers < 1:
            raise refuse("workers", _("{count} is not at least 1").format(count=self.workers), "out_of_range")

    def run(
        self, task: Callable[[Chunk], T], chunks: Iterable[Chunk], *, heard: Heard | None = None
    ) -> Generator[Done[T], None, None]:
        """Work on chunks, as many at once as there are processes.

        Raises
        ------
        EngineLostError
            The processes die before they can begin.
        """
        told = pickle.dumps((task, language()))
        waiting = iter(chunks)
        again: deque[_Held] = deque()
        idle: list[_Worker] = []
        busy: dict[Connection, tuple[_Worker, _Held]] = {}
        most = self.workers or processors()
        unborn = 0
        try:
            while True:
                while len(busy) < most and (held := _next(again, waiting)) is not None:
                    worker = idle.pop() if idle else _Worker(told)
                    worker.give(held.chunk)
                    busy[worker.line] = (worker, held)
                if not busy or (heard is not None and heard() == "stop"):
                    return
                for line in wait(list(busy), timeout=OFTEN):
                    worker, held = busy[line]  # type: ignore[index]
                    answer = worker.heard()
                    if answer == READY:
                        unborn = 0
                        continue
                    del busy[worker.line]
                    if answer is not None:
                        idle.append(worker)
                        yield Done(held.chunk, *answer)
                        continue
                    worker.end()
                    if not worker.ready:
                        unborn += 1
                        again.append(held)
                        if unborn > most + self.retries:
                            raise EngineLostError(stillborn(worker.why))
                    elif held.deaths < self.retries:
                        again.append(_Held(held.chunk, held.deaths + 1))
                    else:
                        yield Done(held.chunk, failure=died(held.deaths + 1))
        finally:
            for worker in [*idle, *(worker for worker, _held in busy.values())]:
                worker.end()


@dataclass(frozen=True, slots=True)
class _Held:
    """A chunk, and how many processes died over it."""

    chunk: Chunk
    deaths: int = 0


def _next(again: deque[_Held], waiting: Iterator[Chunk]) -> _Held | None:
    if again:
        return again.popleft()
    chunk = next(waiting, None)
    return None if chunk is None else _Held(chunk)


def died(count: int) -> str:
    """Return that a chunk took its process along, so many times."""
    return plural(
        "the process that worked on it died {count} time", "the process that worked on it died {count} times", count
    ).format(count=count)


def stillborn(why: str) -> str:
    """Return why no process could begin."""
    if why:
        return _("processes cannot begin: {why}").format(why=why)
    return _(
        "processes end before they begin; a script that starts them does so below if __name__ == '__main__':, so that "
        "they can import it"
    )


READY = "ready"  # what a process says when it has read what is to be done

ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "NUMBA_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
"""Variables of the environment that keep libraries to one thread."""

GRACE = 1.0  # seconds that an idle process has to end by itself


class _Worker:
    """A process and the line to it."""

    def __init__(self, told: bytes) -> None:
        context = multiprocessing.get_context("spawn")
        self.line, far = context.Pipe()
        self.process = context.Process(target=_serve, args=(far,), daemon=True, name="cardan-sweep")
        try:
            with deaf():
                self.process.start()
        except OSError as error:
            raise EngineLostError(_("processes cannot begin: {why}").format(why=refusal(error))) from None
        far.close()
        self.ready, self.why, self.idle = False, "", False
        self._send(told)

    def give(self, chunk: Chunk) -> None:
        """Hand it a chunk; that it is gone is heard later."""
        self.idle = False
        self._send(pickle.dumps(chunk))

    def _send(self, told: bytes) -> None:
        with suppress(OSError):
            self.line.send_bytes(told)

    def heard(self) -> Any:
        """Return what it says, None where it is no more."""
        try:
            answer = self.line.recv()
        except (EOFError, OSError):
            return None
        if answer == READY:
            self.ready = True
        elif not self.ready:
            self.why = answer[1]
            return None
        else:
            self.idle = True
        return answer

    def end(self) -> None:
        """End it: at once where it works."""
        self.line.close()
        if self.idle:
            self.process.join(GRACE)
        self.process.kill()
        self.process.join()
        self.process.close()


@contextmanager
def deaf() -> Iterator[None]:
    """Start processes that ctrl-C does not reach: it is for this one, which ends them."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    resource_tracker.ensure_running()  # the first process would start it, and it lets signals through again
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def heeded() -> Iterator[Callable[[], None]]:
    """Keep ctrl-C from being lost in a destructor, which swallows what is raised in it: what is given raises it again.

    A handler of somebody else stays, and is theirs to make good.
    """
    ours = threading.current_thread() is threading.main_thread()
    if not ours or signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        yield lambda: None
        return
    met: list[int] = []

    def note(number: int, frame: FrameType | None) -> None:
        met.append(number)
        signal.default_int_handler(number, frame)

    def again() -> None:
        if met:
            signal.default_int_handler(met[0], None)

    def told(what: sys.UnraisableHookArgs) -> None:
        if what.exc_type is not KeyboardInterrupt:
            before(what)

    before, sys.unraisablehook = sys.unraisablehook, told
    signal.signal(signal.SIGINT, note)
    try:
        yield again
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)
        sys.unraisablehook = before


def _serve(line: Connection) -> None:
    """Work on chunks until the line is closed."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    os.environ.update(ONE_THREAD)  # before anything that starts threads is imported
    threading.Thread(target=_die_with_parent, daemon=True).start()
    with suppress(EOFError, OSError):
        try:
            task, code = pickle.loads(line.recv_bytes())
        except (EOFError, OSError):
            return
        except Exception as error:
            line.send((None, reason(error)))
            return
        line.send(READY)
        with speaking(code):
            while True:
                line.send_bytes(_answer(task, pickle.loads(line.recv_bytes())))


def _answer(task: Callable[[Chunk], Any], chunk: Chunk) -> bytes:
    try:
        return pickle.dumps((task(chunk), None), protocol=5)
    except Exception as error:  # what came out may not travel either
        return pickle.dumps((None, reason(error)))


def _die_with_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
