"""Dialogs that belong to the window, not to the part that asked for them: they stay when that part is built anew."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from nicegui import ui


@contextmanager
def asking(mark: str, *, names: str = "", role: str = "dialog", whole: bool = False) -> Iterator[ui.dialog]:
    """Open a dialog with what is built within; it goes once it is closed.

    Parameters
    ----------
    mark : str
        What tests call it.
    names : str
        Classes of its look.
    role : str
        What it is for readers of the screen.
    whole : bool
        Over the whole window.
    """
    with ui.context.client.content:
        dialog = ui.dialog().props("maximized" if whole else "")
        with dialog, ui.card().classes(names or "dialog").props(f'role={role} data-mark="{mark}"'):
            yield dialog
        dialog.on("hide", dialog.delete)
        dialog.open()
