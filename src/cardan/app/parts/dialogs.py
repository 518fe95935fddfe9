"""Dialogs that belong to the window, not to the part that asked for them: they stay when that part is built anew."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Iterable, Iterator
from contextlib import contextmanager

from nicegui import events, ui

from cardan.texts import _

from . import toasts


@contextmanager
def asking(mark: str, *, names: str = "", role: str = "dialog", whole: bool = False) -> Iterator[ui.dialog]:
    """Open a dialog with what is built within; it goes once it is closed.

    names: classes of its look; role: what it is for readers of the screen.
    """
    with ui.context.client.content:
        dialog = ui.dialog().props("maximized" if whole else "")
        with dialog, ui.card().classes(names or "dialog").props(f'role={role} data-mark="{mark}"'):
            yield dialog
        dialog.on("hide", dialog.delete)
        dialog.open()


def sending(
    mark: str,
    title: str,
    taken: Callable[[events.UploadEventArguments], Awaitable[Callable[[], object]]],
    *,
    upload: str,
    suffixes: Iterable[str],
    most: int,
) -> None:
    """Ask for a file from the user's disk.

    mark, upload: what tests call the dialog, and the field within it.
    taken: takes the file in, and returns what is done with it once the dialog is closed.
    suffixes: ends of names that are offered; most: bytes that a file may have.
    """
    larger = _("The file is larger than {size} MB.").format(size=most // 10**6)
    with asking(mark) as dialog:

        async def came(event: events.UploadEventArguments) -> None:
            then = await taken(event)
            dialog.close()
            then()

        ui.label(title).classes("head")
        ui.upload(
            on_upload=came, on_rejected=lambda: toasts.refused(larger), max_file_size=most, auto_upload=True
        ).props(f'accept={",".join(suffixes)} flat bordered data-mark="{upload}"')
        ui.button(_("Close"), on_click=dialog.close).props("flat no-caps")
