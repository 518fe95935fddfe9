"""A bar for work that lasts: it appears on stderr after two seconds, in a terminal only."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

PATIENCE = 2.0
"""Seconds before the bar appears."""


@contextmanager
def watching(what: str) -> Iterator[Callable[[float], None]]:
    """Give the function that long work tells its share done; until it does, the bar only shows that work goes on.

    Parameters
    ----------
    what : str
        What is being done, beside the bar.
    """
    if not sys.stderr.isatty():
        yield lambda _share: None
        return
    from threading import Lock, Timer

    bar = _Bar(what)
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

    def __init__(self, what: str) -> None:
        self.what = what
        self.share: float | None = None
        self.shown: Any = None
        self.task: Any = None
        self.ended = False

    def tell(self, share: float) -> None:
        self.share = min(max(float(share), 0.0), 1.0)
        if self.shown is not None:
            self.shown.update(self.task, completed=self.share, total=1.0)

    def begin(self) -> None:
        from rich.console import Console
        from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeElapsedColumn

        if self.ended:
            return
        columns = (TextColumn("{task.description}"), BarColumn(), TaskProgressColumn(), TimeElapsedColumn())
        shown = Progress(*columns, console=Console(file=sys.stderr), transient=True)
        shown.start()
        self.task = shown.add_task(self.what, total=None)
        self.shown = shown
        if self.share is not None:
            self.tell(self.share)

    def end(self) -> None:
        self.ended = True
        if self.shown is not None:
            self.shown.stop()
