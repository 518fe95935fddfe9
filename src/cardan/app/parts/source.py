"""The drive file as text, both ways in step with everything else."""

from __future__ import annotations

from typing import Any

from nicegui import ui

from cardan.app.state.session import Session
from cardan.texts import _

from .timers import Timer

QUIET = 0.4
"""Seconds without a key after which the text is read."""


class Source:
    """The text of the file, with what is wrong with it below.

    session: whose file it shows and changes.
    """

    def __init__(self, session: Session) -> None:
        self.session = session
        self._silent = False
        self._due: Timer | None = None
        self.text: Any = ui.codemirror(self._lines(), language="TOML", on_change=self._typed)
        self._theme()
        self.text.classes("source").props('data-mark="source"').props(f'aria-label="{_("text of the drive file")}"')
        self.problems = ui.element("div").classes("problems").props("role=status")
        self._judge()
        session.listen("text", self._follow)
        session.listen("choices", self._theme)

    def _typed(self) -> None:
        if self._silent:
            return
        if self._due is not None:
            self._due.cancel()
        self._due = Timer(self.session, self.text, QUIET, self._read, once=True)

    def _read(self) -> None:
        self._due = None
        if self.text.value == self._lines():
            return
        ends = "\r\n" if "\r\n" in self.session.document.text else "\n"
        self._silent = True
        try:
            self.session.rewrite(self.text.value.replace("\n", ends))
        finally:
            self._silent = False

    def _lines(self) -> str:
        """Return the text with the one end of a line that the browser counts."""
        return self.session.document.text.replace("\r\n", "\n")

    def _follow(self) -> None:
        if not self._silent and self.text.value != self._lines():
            self._silent = True
            self.text.value = self._lines()
            self._silent = False
        self._judge()

    def _theme(self) -> None:
        theme = self.session.choices.theme
        dark = theme == "dark" or (theme == "auto" and self.session.dark)
        self.text.theme = "vscodeDark" if dark else "vscodeLight"

    def _judge(self) -> None:
        self.problems.clear()
        with self.problems:
            for problem in self.session.document.problems:
                ui.label(str(problem)).classes("wrong")
