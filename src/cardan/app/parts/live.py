"""HTML that is changed by a message of its own: what follows an edit at once does not wait for the rest of the page."""

from __future__ import annotations

from html import escape

from nicegui.element import Element


class Live(Element, component="live.js"):
    """A piece of the page whose content changes with every edit.

    An update of an element has the browser look through the whole page; a message to it changes what it shows and
    nothing else.
    """

    def __init__(self, html: str = "") -> None:
        super().__init__()
        self._props["html"] = html

    @property
    def html(self) -> str:
        """What it shows."""
        return str(self._props["html"])

    def show(self, html: str) -> None:
        """Show other HTML."""
        if html != self.html:
            with self._props.suspend_updates():
                self._props["html"] = html
            self.run_method("show", html)

    def say(self, text: str) -> None:
        """Show plain words."""
        self.show(escape(text))
