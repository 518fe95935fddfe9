"""Keys for all of the page: undo, redo, save."""

from __future__ import annotations

from nicegui import ui

from cardan.app.state.session import Session
from cardan.errors import InputError
from cardan.texts import _

from . import toasts

PRESSED = """if (!window.cardanKeys) {
  window.cardanKeys = true;
  addEventListener('keydown', (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
    const writing = event.target.closest('input, select, textarea, [contenteditable=true]');
    const letter = (/^[a-z]$/i.test(event.key) ? event.key : event.code.replace('Key', '')).toLowerCase();
    if (letter === 's') {
      event.preventDefault();
      if (!event.repeat) emitEvent('cardan-key', 'save');
    } else if ((letter === 'z' || letter === 'y') && !writing) {
      event.preventDefault();
      emitEvent('cardan-key', letter === 'y' || event.shiftKey ? 'redo' : 'undo');
    }
  });
}"""
"""Tells which key was pressed: by its letter, or by its place where letters of another script are written."""


class Keys:
    """Listens to ctrl Z, ctrl shift Z, ctrl Y and ctrl S; inside a text the browser's own undo goes first.

    It belongs to the window: parts of the page that are built anew do not bring another one.
    """

    def __init__(self, session: Session) -> None:
        self.session = session
        ui.on("cardan-key", lambda event: self._pressed(str(event.args)))
        ui.run_javascript(PRESSED)

    def _pressed(self, what: str) -> None:
        if what == "save":
            self._save()
        elif what == "redo":
            self.session.redo()
        else:
            self.session.undo()

    def _save(self) -> None:
        if self.session.empty:
            return
        with self.session.speaking():
            try:
                self.session.save(self.session.name or "drive.toml")
                toasts.done(_("{name} is saved.").format(name=self.session.name))
            except InputError as error:
                toasts.refused(error)
