"""Keys for all of the page: undo, redo, save."""

from __future__ import annotations

from nicegui import events, ui

from cardan.app.state.session import Session
from cardan.errors import InputError
from cardan.texts import _


class Keys:
    """Listens to ctrl Z, ctrl shift Z, ctrl Y and ctrl S; inside a text the browser's own undo goes first.

    Parameters
    ----------
    session : Session
        What the user works on.
    """

    def __init__(self, session: Session) -> None:
        self.session = session
        ui.keyboard(self._pressed, ignore=["input", "select", "textarea"], repeating=False)
        ui.on("cardan-save", self._save)
        ui.run_javascript(
            "if(!window.cardanKeys){window.cardanKeys=true;addEventListener('keydown',e=>{"
            "if((e.ctrlKey||e.metaKey)&&e.key.toLowerCase()==='s'){e.preventDefault();emitEvent('cardan-save')}})}"
        )

    def _pressed(self, event: events.KeyEventArguments) -> None:
        if not event.action.keydown or not (event.modifiers.ctrl or event.modifiers.meta):
            return
        name = event.key.name.lower()
        if name == "y" or (name == "z" and event.modifiers.shift):
            self.session.redo()
        elif name == "z":
            self.session.undo()

    def _save(self) -> None:
        if self.session.empty:
            return
        with self.session.speaking():
            try:
                self.session.save(self.session.name or "drive.toml")
                ui.notify(_("{name} is saved.").format(name=self.session.name), type="positive", position="top")
            except InputError as error:
                ui.notify(str(error), type="negative", position="top")
