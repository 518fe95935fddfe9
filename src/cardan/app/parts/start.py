"""An empty start: examples with pictures, the files of the folder, a new drive."""

from __future__ import annotations

from nicegui import ui

from cardan.app.state.session import Session
from cardan.errors import InputError
from cardan.io import example, example_names, example_text, starter
from cardan.texts import _

from . import toasts

FIRST = ("truck-printed-angles", "car-propshaft", "two-piece-rear-drive", "pto-drive", "mill-spindle", "truck-supports")
"""Examples shown first."""


class Start:
    """What the user sees before a drive is open.

    session: what the user will work on.
    """

    def __init__(self, session: Session) -> None:
        self.session = session
        with ui.element("main").classes("start"):
            ui.label(_("Which drive?")).classes("title").props("role=heading aria-level=1")
            with ui.row().classes("choices"):
                ui.button(_("New drive"), icon="add", on_click=lambda: session.open(starter(), saved=False)).props(
                    "no-caps unelevated"
                ).props('data-mark="new"')
                for name in session.workspace.names()[:6]:
                    ui.button(name, icon="description", on_click=lambda name=name: self._open(name)).props(
                        "no-caps outline"
                    )
            ui.label(_("Examples")).classes("head").props("role=heading aria-level=2")
            with ui.element("div").classes("cards"):
                for name in (*FIRST, *(one for one in example_names() if one not in FIRST)):
                    self._card(name)

    def _card(self, name: str) -> None:
        drive = example(name)
        with ui.element("button").classes("card").props(f'data-mark="example-{name}"') as card:
            ui.element("img").props(f'src="/cardan-examples/{name}.svg" loading=lazy alt=""')
            ui.label(drive.name or name).classes("head")
            count = len(drive.joints)
            ui.label(_("joints: {count}").format(count=count)).classes("hint")
        card.on("click", lambda: self.session.open(example_text(name), saved=False))

    def _open(self, name: str) -> None:
        with self.session.speaking():
            try:
                self.session.open(self.session.workspace.read(name), name)
            except InputError as error:
                toasts.refused(error)
