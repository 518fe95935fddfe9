"""The answers under the view: one tab for each question; quick ones follow every edit, long ones in the background."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from functools import partial
from math import inf
from typing import Any

from nicegui import background_tasks, ui

from cardan.app.state.jobs import Job, Jobs, own_fault
from cardan.app.state.question import Question, asked
from cardan.app.state.session import Session
from cardan.app.state.work import MECHANISM, SOON, result
from cardan.drive.drive import Drive
from cardan.errors import CardanError, InputError
from cardan.io.edit import edit
from cardan.register import QUESTIONS, groups
from cardan.report.answers import subject
from cardan.report.block import Page
from cardan.report.verdict_list import Applicable, settings
from cardan.texts import _, speaking

from . import widgets
from .blocks import Export, PageView
from .offer import Offer
from .widgets import Timer

AT_ONCE = ("motion",)  # answers so quick that they are made while the edit is worked on
QUIET = 0.4  # seconds without an edit after which a long answer is begun
LOOK = 0.15  # seconds between two looks at how far a long answer is


class Answers:
    """The tabs with the answers.

    jobs: where long answers are made.
    export: takes a figure or a page along; no buttons for it when not given.
    """

    def __init__(self, session: Session, jobs: Jobs, *, export: Export | None = None) -> None:
        self.session = session
        self.sheets: dict[str, Sheet] = {}  # those that were looked at: a sheet is built once it is
        tabs = groups()
        self._marked: dict[str, ui.tab] = {}
        with ui.element("div").classes("asked"):
            self._tabs = ui.tabs(on_change=lambda event: self.open(str(event.value))).props(
                "dense no-caps align=left breakpoint=0 outside-arrows mobile-arrows"
            )
            with self._tabs:
                for title, names in tabs.items():
                    self._marked[title] = ui.tab(names[0], label=_(title)).props(f'data-mark="tab-{names[0]}"')
        self._bodies = ui.element("div").classes("sheets")
        self._made: dict[str, Callable[[], Sheet]] = {
            name: partial(Sheet, name, session, jobs, export) for name in QUESTIONS
        }
        self._groups: dict[str, ui.toggle] = {}
        with self._bodies:
            for names in tabs.values():
                if len(names) > 1:
                    self._groups[names[0]] = self._toggle(names)
        self.shown = next(iter(QUESTIONS))
        self._within = {names[0]: names[0] for names in tabs.values()}
        self._tabs.set_value(self.shown)
        self._show()
        session.listen("drive", self._follow, first=True)
        self._mark()
        session.listen("drive", self._mark)
        session.listen("text", self._judge)
        session.listen("choices", self._anew)

    def add(self, name: str, title: str, made: Callable[[], Sheet]) -> None:
        """Add a tab, behind the others, for an answer of a kind of its own.

        name, title: what it is called here and on the page; made: builds its sheet.
        """
        with self._tabs:
            ui.tab(name, label=title).props(f'data-mark="tab-{name}"')
        self._made[name] = made
        self._within[name] = name

    def open(self, group: str) -> None:
        """Open a tab."""
        if group in self._within:
            self._switch(self._within[group])

    def _toggle(self, names: tuple[str, ...]) -> ui.toggle:
        titles = {name: _(QUESTIONS[name].title) for name in names}
        made = ui.toggle(titles, value=names[0], on_change=lambda event: self._inner(names[0], str(event.value)))
        return made.props("dense no-caps flat size=sm").classes("inner").props(f'data-mark="inner-{names[0]}"')

    def _inner(self, group: str, name: str) -> None:
        self._within[group] = name
        self._switch(name)

    def _switch(self, name: str) -> None:
        if name != self.shown:
            self.shown = name
            with self.session.speaking():
                self._show()

    def _show(self) -> None:
        for group, toggle in self._groups.items():
            toggle.set_visibility(self._within[group] == self.shown)
        if self.shown not in self.sheets:
            with self._bodies:
                self.sheets[self.shown] = self._made[self.shown]()
        for name, sheet in self.sheets.items():
            sheet.body.set_visibility(name == self.shown)
            if name != self.shown:
                sheet.rest()
        self.sheets[self.shown].wake()

    def _follow(self) -> None:
        self.sheets[self.shown].follow()

    def _mark(self) -> None:
        """Mark the tabs on which nothing can be answered yet, beside the page's own work: some count a mobility."""
        drive = self.session.drive
        if drive is not None:
            background_tasks.create(self._marked_beside(drive), name="tabs that lack keys")

    async def _marked_beside(self, drive: Drive) -> None:
        bare = await asyncio.to_thread(_bare, drive)
        if drive is not self.session.drive or self._bodies.is_deleted:
            return
        with self._bodies, self.session.speaking():
            told = _("the drive file lacks keys for this")
            for title, tab in self._marked.items():
                tab.classes(**{"add" if title in bare else "remove": "bare"})
                tab.props(f'title="{told}"' if title in bare else "", remove="" if title in bare else "title")

    def _judge(self) -> None:
        self._bodies.classes(**{"remove" if self.session.document.valid else "add": "unsound"})

    def _anew(self) -> None:
        for sheet in self.sheets.values():
            sheet.about = None
        self._follow()


def _bare(drive: Drive) -> set[str]:
    """Return the headings of the tabs on which nothing can be answered for want of keys."""
    return {title for title, names in groups().items() if all(QUESTIONS[name].lacking(drive) for name in names)}


class Sheet:
    """One answer. name: which of `cardan.register.QUESTIONS`; jobs: where it is made if it takes long."""

    def __init__(self, name: str, session: Session, jobs: Jobs, export: Export | None) -> None:
        self.name = name
        self.session = session
        self.about: Drive | None = None
        self.job: Job | None = None
        self._jobs = jobs
        self._asked = 0
        self._choices: dict[str, Any] = {}
        self._settings: tuple[Applicable, ...] = ()
        self._due: Timer | None = None
        self._watch: Timer | None = None
        with ui.element("div").classes("sheet").props(f'data-mark="sheet-{name}"') as self.body:
            self._progress = Progress(self.cancel, self.begin)
            if name == "selection":
                self._joints = ui.select({0: _("all joints")}, value=0, label=_("joint"), on_change=self._chosen)
                self._joints.props("dense options-dense outlined").classes("choice").props('data-mark="choice-joint"')
            self.view = PageView(export, self._pressed)
            self._offer_keys = Offer(session)

    @property
    def quick(self) -> bool:
        """Whether it is there at once."""
        return QUESTIONS[self.name].quick and not self.session.heavy

    def wake(self) -> None:
        """Come up to date: it is looked at now."""
        if self.about is not self.session.drive:
            self.begin()

    def follow(self) -> None:
        """Follow an edit; a long answer waits until the user is quiet."""
        if self.quick:
            self.begin()
            return
        self._stale()
        self._hold()
        self._jobs_end()
        self._due = Timer(self.session, self.body, QUIET, self.begin, once=True)

    def rest(self) -> None:
        """Nobody looks: begin nothing, and give up what is not done."""
        self._hold()
        if self.job is not None and not self.job.finished:
            self.about = None
            self._jobs_end()

    def begin(self) -> None:
        """Answer now."""
        question = asked(self.session, self.name, **self._choices)
        if question is None:
            return
        assert isinstance(question.drive, Drive)  # a mechanism has a desk of its own
        self._hold()
        self._asked += 1
        self.about = question.drive
        if self.name == "selection":
            self._offer(question.drive)
        if self.name in AT_ONCE and self.quick:
            self._made(question, self._asked, _answer(question))
        elif self.quick:
            self._stale()
            background_tasks.create(self._beside(question, self._asked), name=f"answer {self.name}")
        else:
            self._stale()
            limit = SOON if self.name in QUESTIONS and QUESTIONS[self.name].quick else inf
            self.job = self._jobs.ask(question, self.session, limit=limit)
            if self.job.finished:
                self._look()
            else:
                self._progress.show(self.job)
                self._watch = Timer(self.session, self.body, LOOK, self._look, once=False)

    def cancel(self) -> None:
        """Give up a long answer."""
        self._jobs_end()
        self._look()

    async def _beside(self, question: Question, number: int) -> None:
        """Answer beside the page's own work."""
        found = await asyncio.to_thread(_answer, question)
        if not self.body.is_deleted:
            with self.body:
                self._made(question, number, found)

    def _made(self, question: Question, number: int, found: tuple[Page, tuple[Applicable, ...]] | str) -> None:
        if number != self._asked:
            return  # a newer question is on its way
        with speaking(question.language):
            if isinstance(found, str):
                self._progress.fail(found)
                return
            page, self._settings = found
            self._show(page)

    def _look(self) -> None:
        """See how far the long answer is."""
        job = self.job
        if job is None:
            return
        with self.body, speaking(job.question.language):
            if not job.finished and not job.unwanted:
                self._progress.show(job)
                return
            self._end_watch()
            if job.state == "done":
                self._settings = ()
                self._show(job.result)
                if self.name == "phasing":
                    background_tasks.create(self._beside(job.question, self._asked), name="settings of the yokes")
            elif job.state == "failed":
                self._progress.fail(job.message)
            elif job.question.drive is self.session.drive and self.about is job.question.drive:
                self._progress.stopped()

    def _show(self, page: Page) -> None:
        self._progress.hide()
        self.view.element.classes(remove="stale")
        self.view.show(page, {one.label: _("apply") for one in self._settings if one.values})
        self._offer_keys.show(page.lacking)

    def _pressed(self, label: str) -> None:
        """Put a setting of the yokes into the file."""
        chosen = next((one for one in self._settings if one.label == label), None)
        if chosen is not None:
            applied(self.session, chosen)

    def _chosen(self) -> None:
        number = int(self._joints.value or 0)
        self._choices = {"joint": number} if number else {}
        with self.session.speaking():
            self.begin()

    def _offer(self, drive: Drive) -> None:
        """Offer the joints that there are."""
        options = {0: _("all joints"), **{k: f"{k} {one.name}".strip() for k, one in enumerate(drive.joints, start=1)}}
        if options != self._joints.options:
            if self._joints.value not in options:
                self._choices = {}
            self._joints.set_options(options, value=self._joints.value if self._joints.value in options else 0)

    def _stale(self) -> None:
        self.view.element.classes(add="stale")

    def _hold(self) -> None:
        if self._due is not None:
            self._due.cancel()
            self._due = None
        self._end_watch()

    def _end_watch(self) -> None:
        if self._watch is not None:
            self._watch.cancel()
            self._watch = None

    def _jobs_end(self) -> None:
        if self.job is not None and not self.job.finished:
            self._jobs.cancel(self.job)


class Progress:
    """How far a long answer is, and the buttons to stop it or to begin again."""

    def __init__(self, cancel: Callable[[], object], begin: Callable[[], object]) -> None:
        self.body = ui.element("div").classes("progress").props("role=group")
        with self.body, ui.element("div").classes("box"):
            self._bar = ui.linear_progress(value=0.0, show_value=False).props("instant-feedback rounded size=6px")
            self._bar.props(f'aria-label="{_("progress of the calculation")}"')
            self._said = ui.label()
            self._stop = (
                ui.button(_("cancel"), on_click=cancel).props("flat dense no-caps size=sm").props('data-mark="cancel"')
            )
            self._again = (
                ui.button(_("calculate it"), on_click=begin)
                .props("flat dense no-caps size=sm")
                .props('data-mark="again"')
            )
        self.hide()

    def show(self, job: Job) -> None:
        """Show how far a job is."""
        self._set(bar=True, stop=True, again=False, failed=False)
        if job.share > 0.0:
            self._bar.props(remove="indeterminate")
            self._bar.set_value(job.share)
        else:
            self._bar.props(add="indeterminate")
        self._said.text = _told(job)

    def stopped(self) -> None:
        """Show that it was given up."""
        self._set(bar=False, stop=False, again=True, failed=False)
        self._said.text = _("Stopped; what stands below is older.")

    def fail(self, message: str) -> None:
        """Show why it failed."""
        self._set(bar=False, stop=False, again=True, failed=True)
        self._said.text = message

    def hide(self) -> None:
        """Show nothing."""
        self.body.set_visibility(False)

    def _set(self, *, bar: bool, stop: bool, again: bool, failed: bool) -> None:
        self.body.set_visibility(True)
        self.body.classes(**{"add" if bar else "remove": "over"})  # what is passing moves nothing on the page
        self._bar.set_visibility(bar)
        self._stop.set_visibility(stop)
        self._again.set_visibility(again)
        self._said.classes(**{"add" if failed else "remove": "wrong"})


# What there is to say of a mechanism file: all pages of its report.


class MechanismPages:
    """All pages about a mechanism, one below the other; made in the background, since a turn of it is followed.

    jobs: where they are made; export: takes a figure or a page along.
    """

    def __init__(self, session: Session, jobs: Jobs, export: Export) -> None:
        self.session = session
        self._jobs = jobs
        self._export = export
        self._job: Job | None = None
        self._due: Timer | None = None
        self._watch: Timer | None = None
        self._views: dict[str, PageView] = {}
        with ui.element("div").classes("sheets"), ui.element("div").classes("sheet") as self.body:
            ui.label(
                _("A mechanism file: verdicts and sweeps of the app are of drives; cardan sweep takes both.")
            ).classes("hint").props('data-mark="of-mechanism"')
            self._progress = Progress(self._cancel, self._begin)
            self._wrong = ui.label().classes("wrong").props('role=status data-mark="mechanism-wrong"')
            self._wrong.set_visibility(False)
            self._pages = ui.element("div")
        session.listen("text", self._follow)
        session.listen("choices", self._begin)
        self._begin()

    def _follow(self) -> None:
        """Follow an edit once the user is quiet."""
        if self._due is not None:
            self._due.cancel()
        self._due = Timer(self.session, self.body, QUIET, self._begin, once=True)

    def _begin(self) -> None:
        question = asked(self.session, MECHANISM)
        problems = self.session.document.problems
        self._wrong.set_visibility(bool(problems))
        self._wrong.set_text("; ".join(widgets.first(problems, 4)))
        self._pages.classes(**{"add" if problems else "remove": "stale"})
        if question is None:
            return
        self._job = self._jobs.ask(question, self.session)
        if self._job.finished:
            self._look()
        elif self._watch is None:
            self._progress.show(self._job)
            self._watch = Timer(self.session, self.body, LOOK, self._look, once=False)

    def _look(self) -> None:
        """See how far it is."""
        job = self._job
        if job is None:
            return
        if not job.finished:
            self._progress.show(job)
            return
        if self._watch is not None:
            self._watch.cancel()
            self._watch = None
        if job.state == "done":
            self._progress.hide()
            self._show(job)
        elif job.state == "failed":
            self._progress.fail(job.message)
        else:
            self._progress.stopped()

    def _show(self, job: Job) -> None:
        pages = {page.name: page for page in job.result}
        if [*pages] != [*self._views]:
            self._pages.clear()
            with self._pages:
                self._views = {}
                for name, page in pages.items():
                    ui.label(page.title).classes("head").props("role=heading aria-level=3")
                    self._views[name] = PageView(self._export)
        for name, page in pages.items():
            self._views[name].show(page)

    def _cancel(self) -> None:
        if self._job is not None:
            self._jobs.cancel(self._job)
            self._look()


def applied(session: Session, change: Applicable) -> None:
    """Put a change into the file of a session, and say so, or why not."""
    try:
        session.change(partial(edit, values=change.values, folder=session.workspace.enclosed))
    except InputError as error:
        widgets.refused(error)
    else:
        widgets.done(", ".join(filter(None, [_("{change}: applied").format(change=change.label), change.effect])))


def _answer(question: Question) -> tuple[Page, tuple[Applicable, ...]] | str:
    """Return a quick answer with what can be applied of it, or why there is none."""
    try:
        page = result(question)
        assert isinstance(page, Page)
        if question.name != "phasing":
            return page, ()
        assert isinstance(question.drive, Drive)
        with speaking(question.language):
            return page, settings(subject(question.drive))
    except CardanError as error:
        return str(error)
    except Exception as error:  # whatever it is, the page goes on and says so
        return own_fault(question.language, f"{type(error).__name__}: {error}")


def _told(job: Job) -> str:
    if job.state == "waiting":
        return _("Waiting for its turn …")
    left = job.left
    if left is None:
        return _("Calculating …")
    if left < 60.0:
        return _("Calculating, about {count} s left").format(count=max(1, round(left)))
    return _("Calculating, about {count} min left").format(count=round(left / 60.0))
