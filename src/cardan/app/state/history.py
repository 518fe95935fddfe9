"""Undo and redo: every text that the drive file was."""

from __future__ import annotations

from dataclasses import dataclass

DEPTH = 200
"""Steps kept."""

ROOM = 20_000_000
"""Characters kept at most, of long files fewer steps."""


@dataclass(frozen=True, slots=True)
class History:
    """The texts before and after the present one."""

    before: tuple[str, ...] = ()
    behind: tuple[str, ...] = ()

    def after(self, text: str) -> History:
        """Return the history once ``text`` gave way to a new one; what was undone is forgotten."""
        steps = (*self.before, text)[-DEPTH:]
        while len(steps) > 1 and sum(map(len, steps)) > ROOM:
            steps = steps[1:]
        return History(steps, ())

    def undone(self, text: str) -> tuple[str, History]:
        """Return the text before ``text``, and the history there; the text itself where there is none before."""
        if not self.before:
            return text, self
        return self.before[-1], History(self.before[:-1], (text, *self.behind))

    def redone(self, text: str) -> tuple[str, History]:
        """Return the text that was undone last, and the history there; the text itself where there is none."""
        if not self.behind:
            return text, self
        return self.behind[0], History((*self.before, text), self.behind[1:])
