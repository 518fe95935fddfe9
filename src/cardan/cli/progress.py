"""A bar for work that lasts: it appears on stderr after two seconds, in a terminal only."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

PATIENCE = 2.0
"""Seconds before the bar appears."""


@contextmanager
def watching(what: str) -> Iterator[Callable[[float], None]]:
    """Give the function that long work tells its share done.

    Parameters
    ----------
    what : str
        What is being done, beside the bar.
    """
    start = time.monotonic()
    shown: list[Any] = []

    def progress(share: float) -> None:
        if not shown:
            if time.monotonic() - start < PATIENCE or not sys.stderr.isatty():
                return
            shown.extend(_begin(what))
        bar, task = shown
        bar.update(task, completed=min(max(share, 0.0), 1.0))

    try:
        yield progress
    finally:
        if shown:
            shown[0].stop()


def _begin(what: str) -> tuple[Any, Any]:
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

    columns = (TextColumn("{task.description}"), BarColumn(), TaskProgressColumn(), TimeRemainingColumn())
    bar = Progress(*columns, console=Console(stderr=True), transient=True)
    bar.start()
    return bar, bar.add_task(what, total=1.0)
