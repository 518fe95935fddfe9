"""A process that works on one question after the other, and the end of the line that leads to it."""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from multiprocessing.connection import Connection
from typing import Any, TypeAlias

from cardan.errors import CardanError
from cardan.later import later
from cardan.texts import _, speaking

from .question import Progress

resource = later("resource")
Made: TypeAlias = "Callable[[Any, Progress], Any]"  # what answers a `Question` or makes an `Edit`; picklable
MEMORY = 4 * 10**9  # bytes that a process may take
OFTEN = 0.1  # seconds between two words on how far the work is


@dataclass(frozen=True, slots=True)
class Share:
    """How far the work is."""

    share: float


@dataclass(frozen=True, slots=True)
class Done:
    """What came out."""

    result: Any


@dataclass(frozen=True, slots=True)
class Failed:
    """What went wrong; `own` where nobody but us is to blame."""

    text: str
    own: bool


class Worker:
    """A process and the line to it; it is started at once and lives until it is ended."""

    def __init__(self, made: Made) -> None:
        context = multiprocessing.get_context("spawn")
        self.line, far = context.Pipe()
        self.process = context.Process(target=_serve, args=(far, made), daemon=True, name="cardan-worker")
        self.process.start()
        far.close()

    def ask(self, question: Any) -> None:
        """Send a question."""
        self.line.send(question)

    def stop(self) -> None:
        """Ask it to give up what it works on."""
        self.line.send("stop")

    def heard(self, timeout: float) -> Share | Done | Failed | None:
        """Return what it says within a time; None where it says nothing."""
        return self.line.recv() if self.line.poll(timeout) else None

    def end(self) -> None:
        """End it, whatever it does."""
        self.process.kill()
        self.process.join()
        self.process.close()
        self.line.close()


def _serve(line: Connection, made: Made) -> None:
    """Answer questions until the line is closed."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # ctrl-C is for the server, which ends us
    threading.Thread(target=_die_with_parent, daemon=True).start()
    if os.name == "posix":
        kind = resource().RLIMIT_DATA
        _soft, hard = resource().getrlimit(kind)
        resource().setrlimit(kind, (MEMORY if hard < 0 else min(MEMORY, hard), hard))
    if hasattr(os, "nice"):
        os.nice(5)  # pages come first
    while True:
        try:
            question = line.recv()
        except (EOFError, OSError):
            return
        if question != "stop":  # one that came too late is for nobody
            answer = _answer(line, made, question)
            try:
                line.send(answer)
            except OSError:
                return
            except Exception as error:  # what came out cannot be sent
                line.send(_own(error))


def _answer(line: Connection, made: Made, question: Any) -> Done | Failed:
    told = time.monotonic()
    stopped = False

    def progress(share: float) -> str | None:
        nonlocal told, stopped
        stopped = stopped or (line.poll() and line.recv() == "stop")
        now = time.monotonic()
        if now - told >= OFTEN:
            told = now
            line.send(Share(min(max(float(share), 0.0), 1.0)))
        return "stop" if stopped else None

    try:
        return Done(made(question, progress))
    except CardanError as error:
        return Failed(str(error), own=False)
    except MemoryError:
        with speaking(question.language):
            said = _("This needs more than {size} GB of memory and was given up. Nothing else is lost.")
            return Failed(said.format(size=MEMORY // 10**9), own=False)
    except Exception as error:  # whatever it is, the app goes on and says so
        return _own(error)


def _own(error: Exception) -> Failed:
    return Failed(f"{type(error).__name__}: {error}", own=True)


def _die_with_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
