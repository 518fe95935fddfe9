"""The top of the page: which file, undo and redo, variants, reports, how the user likes to see things."""

from __future__ import annotations

from collections.abc import Callable

from nicegui import events, ui

from cardan.app.state.jobs import Jobs
from cardan.app.state.session import Session
from cardan.app.state.workspace import MAX_UPLOAD
from cardan.errors import InputError
from cardan.io import starter
from cardan.texts import _

from . import toasts
from .dialogs import asking, sending
from .download import ReportMenu
from .menus import drop_down
from .settings import SettingsMenu
from .variants import VariantsMenu


class Header:
    """The top of the page.

    jobs: where reports are made.
    """

    def __init__(self, session: Session, jobs: Jobs) -> None:
        self.session = session
        with ui.element("header").classes("top"):
            ui.link("cardan", "/").classes("brand")
            self.name = ui.label().classes("name").props('data-mark="file-name"').props("role=status")
            ui.element("div").classes("gap")
            if not session.empty:
                self.undo = _button("undo", _("Undo (ctrl Z)"), session.undo)
                self.redo = _button("redo", _("Redo (ctrl shift Z)"), session.redo)
                self.variants = VariantsMenu(session, jobs)
                self.report = ReportMenu(session, jobs)
            self._files()
            SettingsMenu(session)
        self._follow()
        session.listen("file", self._follow)

    def _follow(self) -> None:
        session = self.session
        if session.empty:
            self.name.set_text("")
            return
        state = _("saved") if session.saved else _("not saved")
        self.name.set_text(f"{session.name or _('new drive')} {'●' if not session.saved else '○'} {state}")
        self.undo.set_enabled(bool(session.history.before))
        self.redo.set_enabled(bool(session.history.behind))

    def _files(self) -> None:
        with drop_down(_("File"), "file-menu"):
            ui.item(_("New"), on_click=lambda: self._leave(lambda: self.session.open(starter(), saved=False)))
            ui.item(_("Open …"), on_click=lambda: self.open()).props('data-mark="file-open"')
            ui.item(_("Send a file …"), on_click=lambda: self.send()).props('data-mark="file-send"')
            if not self.session.empty:
                ui.item(_("Save"), on_click=lambda: self.save()).props('data-mark="file-save"')
                ui.item(_("Save as …"), on_click=lambda: self.save_as()).props('data-mark="file-save-as"')
                ui.item(_("Download"), on_click=lambda: self.download()).props('data-mark="file-download"')
            ui.item(_("Examples"), on_click=lambda: self._leave(lambda: self.session.open("")))

    def _leave(self, then: Callable[[], None]) -> None:
        """Do what leaves the present file, after a question where it is not saved."""
        if self.session.empty or self.session.saved or not self.session.history.before:
            then()
            return
        with self.session.speaking(), asking("leave-file") as dialog:
            ui.label(_("The drive is not saved. Leave it?"))
            with ui.row().classes("ends"):
                ui.button(_("Stay"), on_click=dialog.close).props("flat no-caps")
                ui.button(_("Leave"), on_click=lambda: self._after(dialog, then)).props("no-caps color=negative").props(
                    'data-mark="leave"'
                )

    def open(self) -> None:
        """Offer the files of the workspace."""
        with self.session.speaking(), asking("open-file") as dialog:
            ui.label(_("Files of the folder, the newest first")).classes("head")
            names = self.session.workspace.names()
            if not names:
                ui.label(_("There is no drive file yet.")).classes("hint")
            with ui.element("div").classes("files"):
                for name in names:
                    button = ui.button(name, on_click=lambda name=name: self._after(dialog, lambda: self._take(name)))
                    button.props("flat no-caps align=left").classes("file")
            ui.button(_("Close"), on_click=dialog.close).props("flat no-caps")

    def _after(self, dialog: ui.dialog, then: Callable[[], None]) -> None:
        """Close a dialog and go on."""
        dialog.close()
        with self.session.speaking():
            then()

    def _take(self, name: str) -> None:
        self._leave(lambda: self._read(name))

    def _read(self, name: str) -> None:
        self._try(lambda: self.session.open(self.session.workspace.read(name), name))

    def send(self) -> None:
        """Take a file from the user's disk."""

        async def taken(event: events.UploadEventArguments) -> Callable[[], None]:
            content = await event.file.read()
            return lambda: self._sent(event.file.name, content)

        with self.session.speaking():
            title = _("A drive file, at most {size} MB").format(size=MAX_UPLOAD // 10**6)
            sending("send-file", title, taken, upload="upload", suffixes=(".toml", ".json"), most=MAX_UPLOAD)

    def _sent(self, name: str, content: bytes) -> None:
        with self.session.speaking():
            self._leave(lambda: self._receive(name, content))

    def _receive(self, name: str, content: bytes) -> None:
        self._try(lambda: self.session.take(name, content))

    def save(self) -> None:
        """Write the file; ask for a name first where it has none."""
        if not self.session.name:
            self.save_as()
        elif self._try(self.session.save):
            toasts.done(_("{name} is saved.").format(name=self.session.name))

    def save_as(self) -> None:
        """Ask for a name and write the file."""
        with self.session.speaking(), asking("save-file-as") as dialog:
            name = ui.input(_("name"), value=self.session.name or "drive.toml").props("autofocus outlined dense")

            def named() -> None:
                if self._try(lambda: self.session.save(name.value.strip())):
                    dialog.close()

            name.on("keydown.enter", named)
            with ui.row().classes("ends"):
                ui.button(_("Close"), on_click=dialog.close).props("flat no-caps")
                ui.button(_("Save"), on_click=named).props("no-caps").props('data-mark="save-named"')

    def download(self) -> None:
        """Give the file to the browser."""
        ui.download.content(self.session.document.text, self.session.name or "drive.toml", "application/toml")

    def _try(self, act: Callable[[], None]) -> bool:
        with self.session.speaking():
            try:
                act()
            except InputError as error:
                toasts.refused(error)
                return False
        return True


def _button(icon: str, title: str, act: Callable[[], None]) -> ui.button:
    button = ui.button(icon=icon, on_click=act).props(f'flat dense round aria-label="{title}" data-mark="{icon}"')
    button.tooltip(title)
    return button
