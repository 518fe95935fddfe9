"""A bar for work that lasts: it appears on stderr after two seconds, in a terminal only."""

from __future__ import annotations

import signal
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Lock, Timer
from typing import Any

from cardan.later import later
from cardan.texts import _
from cardan.units import thousands

PATIENCE = 2.0  # seconds before the bar appears

console, bars = later("rich.console"), later("rich.progress")


@contextmanager
def watching(what: str, *, count: int = 0) -> Iterator[Callable[[float], None]]:
    """Give the function that long work tells its share done; until it does, the bar only shows that work goes on.

    count: points of the whole work, where points a second and the time left are to be told.
    """
    if not sys.stderr.isatty():
        yield lambda _share: None
        return
    bar = _Bar(what, count)
    lock = Lock()

    def begin() -> None:
        with lock:
            bar.begin()

    timer = Timer(PATIENCE, begin)
    timer.daemon = True
    timer.start()
    try:
        yield bar.tell
    finally:
        timer.cancel()
        with lock:
            bar.end()


class _Bar:
    """The share done so far, and the bar once it stands."""

    def __init__(self, what: str, count: int = 0) -> None:
        self.what = what
        self.count = count
        self.share: float | None = None
        self.first: tuple[float, float] | None = None
        self.shown: Any = None
        self.task: Any = None
        self.ended = False

    def tell(self, share: float) -> None:
        self.share = min(max(float(share), 0.0), 1.0)
        now = time.monotonic()
        self.first = self.first or (self.share, now)
        if self.shown is not None:
            told = pace(self.share - self.first[0], 1.0 - self.share, now - self.first[1], self.count)
            self.shown.update(self.task, completed=self.share, total=1.0, pace=told)

    def begin(self) -> None:
        if self.ended:
            return
        made = bars()
        telling = (made.TextColumn("{task.fields[pace]}"),) if self.count else ()
        columns = (
            made.TextColumn("{task.description}"),
            made.BarColumn(),
            made.TaskProgressColumn(),
            made.TimeElapsedColumn(),
            *telling,
        )
        shown = made.Progress(*columns, console=console().Console(file=sys.stderr), transient=True)
        shown.start()
        self.task = shown.add_task(self.what, total=None, pace="")
        self.shown = shown
        if self.share is not None:
            self.tell(self.share)

    def end(self) -> None:
        self.ended = True
        if self.shown is not None:
            self.shown.stop()


def pace(done: float, left: float, seconds: float, count: int) -> str:
    """Return how fast work goes and how long it will last, empty as long as nothing is known.

    done, left: share done in these seconds, and share still to be done; count: points of the whole work.
    """
    if not count or done <= 0.0 or seconds <= 0.0:
        return ""
    rate, rest = done * count / seconds, round(left * seconds / done)
    clock = f"{rest // 3600}:{rest // 60 % 60:02d}:{rest % 60:02d}" if rest >= 3600 else f"{rest // 60}:{rest % 60:02d}"
    shown = thousands(rate) if rate >= 10.0 else f"{rate:.2g}"
    return _("{rate} points/s, {time} left").format(rate=shown, time=clock)


@contextmanager
def keeping(what: str, *, count: int = 0) -> Iterator[Callable[[float], object]]:
    """Give the function that long work tells its share done; ctrl-C makes it answer "stop", so that its part is kept.

    A second ctrl-C ends the command at once. The function has an attribute ``stopped``.
    count: points of the whole work, where points a second and the time left are to be told.
    """

    class Telling:
        stopped = False

        def __call__(self, share: float) -> object:
            tell(share)
            return "stop" if self.stopped else None

    telling = Telling()

    def interrupt(_number: int, _frame: object) -> None:
        if telling.stopped:
            raise KeyboardInterrupt
        telling.stopped = True

    with watching(what, count=count) as tell:
        try:
            before = signal.signal(signal.SIGINT, interrupt)
        except ValueError:  # not in the main thread: nobody interrupts there
            yield telling
            return
        try:
            yield telling
        finally:
            signal.signal(signal.SIGINT, before)


def ended(code: int, telling: Any) -> int:
    """Return the exit code of a command; one that was stopped ends with 130 and what it has said."""
    if telling.stopped:
        raise SystemExit(130)
    return code
