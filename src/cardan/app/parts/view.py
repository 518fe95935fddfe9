"""The drive in space, turning: what plays it, what is shown with it."""

from __future__ import annotations

from nicegui import ui

from cardan.app.state.session import Session


class View:
    """The view in space with its controls."""

    def __init__(self, session: Session) -> None:
        ui.label("3-D")
