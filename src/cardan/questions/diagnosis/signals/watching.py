"""Who watches work of several parts: told how far the whole of it is, and heard when he wants it to stop."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

Progress: TypeAlias = Callable[[float], object]
"""Told the share done; may answer "stop"."""


class Watch:
    """Tells how far the parts of some work are together; it can be handed on as the progress of the part at work.

    progress: who is told; he may answer "stop".
    parts: how many parts there are, taken for equal; stopped: whether the answer was "stop" once.

    >>> told = []
    >>> watch = Watch(told.append, 4)
    >>> watch(0.5), watch.next(), watch(0.5), told
    (None, None, None, [0.125, 0.25, 0.375])
    """

    def __init__(self, progress: Progress | None, parts: int) -> None:
        self.stopped = False
        self._progress = progress
        self._parts = max(parts, 1)
        self._done = 0

    def __call__(self, share: float) -> str | None:
        """Tell how far the part at work is; return "stop" once that was the answer."""
        if self._progress is not None and not self.stopped:
            self.stopped = self._progress(min(1.0, (self._done + share) / self._parts)) == "stop"
        return "stop" if self.stopped else None

    def next(self) -> None:
        """Begin the next part."""
        self._done += 1
        self(0.0)
