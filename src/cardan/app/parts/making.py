"""A paper on its way: how far it is, a button to stop it, and what becomes of it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from nicegui import ui

from cardan.app.state.jobs import Jobs
from cardan.app.state.question import Question
from cardan.app.state.session import Session
from cardan.texts import _

from .dialogs import asking

LOOK = 0.2
"""Seconds between two looks."""


class Making:
    """A dialog that follows a job until it ends; who closes it stops the job.

    jobs: where it is made; title: what is made, for the reader; done: takes what came out.
    """

    def __init__(
        self, session: Session, jobs: Jobs, question: Question, title: str, done: Callable[[Any], object]
    ) -> None:
        self.session = session
        self._jobs = jobs
        self._done = done
        self.job = jobs.ask(question, session)
        self._client = ui.context.client
        with asking("making", names="dialog making") as self.dialog:
            ui.label(title).classes("head")
            self._bar = ui.linear_progress(value=0.0, show_value=False).props("instant-feedback rounded size=6px")
            self._said = ui.label(_("It is being made …")).props("role=status")
            with ui.row().classes("ends"):
                self._stop = ui.button(_("Cancel"), on_click=self.dialog.close).props("flat no-caps autofocus")
                self._stop.props('data-mark="making-cancel"')
            self._timer = ui.timer(LOOK, self._look)
        self.dialog.on("hide", self._gone)
        self._look()

    def _look(self) -> None:
        """See how far it is."""
        job = self.job
        with self.session.speaking():
            if not job.finished:
                known = job.share > 0.0
                self._bar.props(**{"remove" if known else "add": "indeterminate"})
                self._bar.set_value(job.share)
                self._said.text = self._left()
                return
            self._timer.cancel()
            if job.state == "done":
                self.dialog.close()
                with self._client.content:
                    self._done(job.result)
            elif job.state == "failed":
                self._bar.set_visibility(False)
                self._said.text = job.message
                self._said.classes("wrong").props('role=alert data-mark="making-failed"')
                self._stop.text = _("Close")
            else:
                self.dialog.close()

    def _left(self) -> str:
        left = self.job.left
        if self.job.state == "waiting":
            return _("It waits for other work.")
        if left is None:
            return _("It is being made …")
        return _("about {count} s left").format(count=max(1, round(left)))

    def _gone(self) -> None:
        self._timer.cancel()
        if not self.job.finished:
            self._jobs.cancel(self.job)
