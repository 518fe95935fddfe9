"""The left side of the page: the drive file as a form, as its geometry, as text."""

from __future__ import annotations

from nicegui import ui

from cardan.app.state.session import Session
from cardan.texts import _

from .centres import Centres
from .form import Form
from .source import Source


class Editor:
    """The drive file, in three ways that stay in step."""

    def __init__(self, session: Session) -> None:
        self.session = session
        with ui.tabs().props("dense no-caps inline-label align=left narrow-indicator").classes("ways") as tabs:
            form = ui.tab("form", label=_("Form")).props('data-mark="way-form"')
            lies = ui.tab("geometry", label=_("Geometry")).props('data-mark="way-geometry"')
            text = ui.tab("file", label=_("File")).props('data-mark="way-file"')
        self.problems = ui.element("div").classes("problems").props("role=status").props('data-mark="problems"')
        with ui.tab_panels(tabs, value=form, animated=False, keep_alive=True).classes("way"):
            with ui.tab_panel(form):
                Form(session)
            with ui.tab_panel(lies):
                Centres(session)
            with ui.tab_panel(text):
                Source(session)
        self._judge()
        session.listen("text", self._judge)

    def _judge(self) -> None:
        """Say what is wrong with the file, whatever way is open."""
        found = self.session.document.problems
        self.problems.clear()
        self.problems.set_visibility(bool(found))
        with self.problems:
            for problem in found[:4]:
                ui.label(str(problem)).classes("wrong")
            if len(found) > 4:
                ui.label(_("and {count} more").format(count=len(found) - 4)).classes("wrong")
