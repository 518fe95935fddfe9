"""Reports and exports, made in the background and given to the browser."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from functools import partial
from typing import Any, TypeAlias

from nicegui import ui

from cardan.app.state import work as papers
from cardan.app.state.jobs import Jobs
from cardan.app.state.question import Question
from cardan.app.state.session import Session
from cardan.figures.figure import Figure
from cardan.io import dumps
from cardan.report.block import Page
from cardan.report.render.exports import Exported, kinds
from cardan.texts import _

from . import widgets as toasts
from .widgets import asking, drop_down, menu_item

# A paper on its way: how far it is, a button to stop it, and what becomes of it.

LOOK = 0.2  # seconds between two looks


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
            self._bar.props["aria-label"] = title
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


Snapshot: TypeAlias = Callable[[], Awaitable[bytes]]


def _forms() -> dict[papers.Form, str]:
    """Return the forms of a report with what they are called."""
    return {
        "html": _("Report as a web page (HTML)"),
        "interactive": _("The same with figures to turn and measure"),
        "pdf": _("Report to print (PDF)"),
        "xlsx": _("Report as a workbook (XLSX)"),
        "json": _("Report as data (JSON)"),
    }


def _kinds() -> dict[str, str]:
    """Return the kinds of file of a part with what they are called."""
    return {
        "png": _("picture (PNG)"),
        "svg": _("drawing (SVG)"),
        "pdf": _("to print (PDF)"),
        "html": _("web page (HTML)"),
        "xlsx": _("workbook (XLSX)"),
        "csv": _("table (CSV)"),
        "json": _("data (JSON)"),
    }


class ReportMenu:
    """The menu of reports and exports.

    jobs: where reports are made.
    snapshot: gives a picture of the view in space; the page sets it.
    """

    def __init__(self, session: Session, jobs: Jobs) -> None:
        self.session = session
        self._jobs = jobs
        self.snapshot: Snapshot | None = None
        with drop_down(_("Report"), "report-menu"):
            for form, title in _forms().items():
                menu_item(title, partial(self.report, form), f"report-{form}")
            ui.separator()
            menu_item(_("Drive file (TOML)"), self.toml, "drive-toml")
            menu_item(_("Drive as data (JSON)"), self.json, "drive-json")
            menu_item(_("What the view shows (PNG)"), self.picture, "view-png")

    def report(self, form: papers.Form) -> None:
        """Make the report of the drive in a form and give it to the browser."""
        with self.session.speaking():
            question = papers.of_report(self.session, form)
            if question is None:
                _no_drive()
                return
            if not self.session.document.valid:
                ui.notify(_("The report tells of the last drive without mistakes."), type="warning", position="top")
            Making(self.session, self._jobs, question, _forms()[form], given)

    def toml(self) -> None:
        """Give the drive file to the browser as it stands."""
        ui.download.content(self.session.document.text, f"{self._name()}.toml", "application/toml")

    def json(self) -> None:
        """Give the drive to the browser as JSON."""
        with self.session.speaking():
            thing = self.session.document.mechanism or self.session.drive
            if thing is None:
                _no_drive()
                return
            text = dumps(thing, form="json")
            ui.download.content(text, f"{self._name()}.json", "application/json")

    async def picture(self) -> None:
        """Give the browser a picture of what the view in space shows."""
        if self.snapshot is None:
            with self.session.speaking():
                toasts.refused(_("There is no view in space here; each figure can be saved beside it."))
            return
        try:
            seen = await self.snapshot()
        except TimeoutError:
            with self.session.speaking():
                toasts.refused(_("The view gave no picture; try again."))
            return
        ui.download.content(seen, f"{self._name()}.png", "image/png")

    def _name(self) -> str:
        drive = self.session.document.mechanism or self.session.drive
        return self.session.name.removesuffix(".toml") or papers.safe(drive.name if drive else "")


class Exports:
    """Takes figures and pages away: asks for the kind of file, makes it, gives it to the browser.

    session: about whose drive they are; jobs: where they are made.
    """

    def __init__(self, session: Session, jobs: Jobs) -> None:
        self.session = session
        self._jobs = jobs

    def __call__(self, thing: Figure | Page) -> None:
        """Ask in which kind of file to export a figure or a page."""
        with self.session.speaking(), asking("export", names="dialog exports") as dialog:
            title = _("Save the figure as") if isinstance(thing, Figure) else _("Save the page as")
            ui.label(title).classes("head")
            ui.label(thing.title).classes("hint")
            known = _kinds()
            for kind in kinds(thing):
                button = ui.button(known[kind], on_click=lambda kind=kind: self._chosen(dialog, thing, kind))
                button.props(f'flat no-caps align=left data-mark="as-{kind}"')
            ui.button(_("Close"), on_click=dialog.close).props("flat no-caps")

    def _chosen(self, dialog: ui.dialog, thing: Figure | Page, kind: str) -> None:
        dialog.close()
        with self.session.speaking():
            question = papers.asked_for(self.session, papers.PART, thing=thing, kind=kind)
            if question is not None:
                Making(self.session, self._jobs, question, _kinds()[kind], given)


def given(made: Exported) -> None:
    """Give a file to the browser."""
    ui.download.content(made.content, made.name, made.media_type)


def _no_drive() -> None:
    toasts.refused(_("There is no drive without mistakes yet."))
