"""Timers of a part of the page."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from inspect import isawaitable

from nicegui import background_tasks, ui

from cardan.app.state.session import Session


class Timer:
    """Calls a function after a while, in the user's language; it ends with the part it belongs to.

    seconds: until it calls, and from call to call.
    what: what it calls; it may be awaited.
    once: whether it calls a single time.
    Unlike NiceGUI's timer it is no element: the browser hears nothing of it.
    """

    def __init__(
        self, session: Session, body: ui.element, seconds: float, what: Callable[[], object], *, once: bool
    ) -> None:
        self._session = session
        self._body = body
        self._seconds = seconds
        self._what = what
        self._once = once
        self._task = background_tasks.create(self._run(), name="timer of a part of the page")

    def cancel(self) -> None:
        """Call no more."""
        self._task.cancel()

    async def _run(self) -> None:
        while True:
            await asyncio.sleep(self._seconds)
            if self._body.is_deleted:
                return
            with self._body, self._session.speaking():
                called = self._what()
                if isawaitable(called):
                    await called
            if self._once:
                return
