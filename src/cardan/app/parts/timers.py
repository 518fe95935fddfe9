"""Timers of a part of the page."""

from __future__ import annotations

from collections.abc import Callable

from nicegui import ui

from cardan.app.state.session import Session


def timer(session: Session, body: ui.element, seconds: float, what: Callable[[], object], *, once: bool) -> ui.timer:
    """Return a timer that speaks the user's language and goes with the part it belongs to.

    Parameters
    ----------
    session : Session
        Whose language it is.
    body : Element
        What it belongs to.
    seconds : float
        Until it calls, and from call to call.
    what : function
        What it calls.
    once : bool
        Whether it calls a single time.
    """

    def spoken() -> None:
        with session.speaking():
            what()

    with body:
        return ui.timer(seconds, spoken, once=once)
