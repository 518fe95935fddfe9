"""What the page tells in passing."""

from __future__ import annotations

from nicegui import ui

from cardan.errors import InputError

READ = 8000
"""Milliseconds that leave time to read several lines."""


def refused(why: InputError | str) -> None:
    """Tell why something was not done, all reasons at once."""
    ui.notify(str(why), type="negative", position="top", multi_line=True, timeout=READ)


def done(what: str) -> None:
    """Tell that something was done."""
    ui.notify(what, type="positive", position="top")
