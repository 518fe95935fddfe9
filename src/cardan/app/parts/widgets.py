"""Small things that every part uses: dialogs, menus, messages, timers, HTML changed by a message of its own."""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import Awaitable, Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from html import escape
from inspect import isawaitable

from nicegui import background_tasks, events, ui
from nicegui.element import Element

from cardan.app.state.document import Change as TextChange
from cardan.app.state.document import Document, Edit
from cardan.app.state.jobs import Jobs
from cardan.app.state.session import Session, Step
from cardan.app.state.work import EDIT
from cardan.drive.fields.wording import counted
from cardan.errors import InputError, Problem
from cardan.texts import _, visible


def escaped(text: str) -> str:
    """Return a text for HTML, marks that turn its direction spelled out."""
    return escape("\n".join(map(visible, text.expandtabs(4).splitlines())))


MOST = 50  # problems of a file that are shown


def first(problems: Sequence[Problem], most: int = MOST) -> list[str]:
    """Return the first problems of a file in words, places as the page counts them, and how many more there are."""
    more = len(problems) - most
    told = [str(replace(one, field=counted(one.field))) for one in problems[:most]]
    return [*told, *([_("and {count} more").format(count=more)] if more > 0 else [])]


# HTML that is changed by a message of its own: what follows an edit at once does not wait for the rest of the page.


class Live(Element, component="live.js"):
    """A piece of the page whose content changes with every edit.

    An update of an element has the browser look through the whole page; a message to it changes what it shows and
    nothing else.
    """

    def __init__(self, html: str = "", *, tag: str = "div") -> None:
        super().__init__()
        self._props.update(html=html, tag=tag)

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
        self.show(escaped(text))


# Timers of a part of the page, and edits that take longer.

GLANCE = 0.01  # seconds between two looks whether an edit is made


class Timer:
    """Calls a function after a while, in the user's language; it ends with the part it belongs to.

    seconds: until it calls, and from call to call.
    what: what it calls; it may be awaited.
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


class Apart:
    """Makes steps of a session in a process of its own, one after the other; where one cannot be made, says why."""

    def __init__(self, session: Session, jobs: Jobs) -> None:
        self._session, self._jobs = session, jobs
        self._client = ui.context.client
        self._steps: deque[tuple[int, Step]] = deque()
        self.busy = False
        self._client.on_delete(lambda: jobs.leave(self))

    def __call__(self, step: Step) -> None:
        """Make a step once those before it are made."""
        self._steps.append((self._session.opened, step))
        if not self.busy:
            self.busy = True
            background_tasks.create(self._work(), name="edits of a heavy file")

    async def _work(self) -> None:
        try:
            while self._steps and not self._client.is_deleted:
                opened, step = self._steps.popleft()
                if opened == self._session.opened:
                    await self._made(opened, *step())
        finally:
            self.busy = False

    async def _made(self, opened: int, how: TextChange, then: Callable[[Document], None]) -> None:
        session = self._session
        folder, language = session.workspace.folder, session.choices.language
        edit = Edit(text=session.document.text, change=how, folder=folder, language=language)
        job = self._jobs.ask(edit, self, limit=EDIT)
        while not job.finished:
            await asyncio.sleep(GLANCE)
        if self._client.is_deleted or opened != session.opened:
            return
        with self._client, session.speaking():
            if job.state == "done":
                then(job.result)
            elif job.state == "failed":
                refused(job.message)


# Dialogs that belong to the window, not to the part that asked for them: they stay when that part is built anew.


@contextmanager
def asking(mark: str, *, names: str = "", role: str = "dialog", whole: bool = False) -> Iterator[ui.dialog]:
    """Open a dialog with what is built within, named by its first words; it goes once it is closed.

    names: classes of its look; role: what it is for readers of the screen.
    """
    with ui.context.client.content:
        dialog = ui.dialog().props("maximized" if whole else "").props(f"role={role}")
        with dialog, ui.card().classes(names or "dialog").props(f'data-mark="{mark}"') as card:
            yield dialog
        dialog.props["aria-label"] = next(one.text for one in card.descendants() if isinstance(one, ui.label))
        dialog.on("hide", dialog.delete)
        dialog.open()


CHOOSE = (
    '<q-btn flat no-caps icon="upload_file" class="full-width" label="{}" @click="props.pickFiles"></q-btn>'
    '<div class="unseen" aria-hidden="true"><q-uploader-add-trigger></q-uploader-add-trigger></div>'
)
"""What a file is chosen by: Quasar's own button has its field within, which has no name."""


def sending(
    mark: str,
    title: str,
    taken: Callable[[events.UploadEventArguments], Awaitable[Callable[[], object]]],
    *,
    upload: str,
    suffixes: Iterable[str],
    most: int,
) -> None:
    """Ask for a file from the user's disk.

    suffixes: ends of names that are offered; most: bytes that a file may have.
    """
    larger = _("The file is larger than {size} MB.").format(size=most // 10**6)
    with asking(mark) as dialog:

        async def came(event: events.UploadEventArguments) -> None:
            then = await taken(event)
            dialog.close()
            then()

        ui.label(title).classes("head")
        took = ui.upload(on_upload=came, on_rejected=lambda: refused(larger), max_file_size=most, auto_upload=True)
        took.props(f'accept={",".join(suffixes)} flat bordered data-mark="{upload}"')
        took.add_slot("header", CHOOSE.format(escaped(_("Choose a file, or drop it here"))))
        ui.button(_("Close"), on_click=dialog.close).props("flat no-caps")


# What the page tells in passing.

READ = 8000  # milliseconds that leave time to read several lines


def refused(why: InputError | str) -> None:
    """Tell why something was not done, all reasons at once."""
    told = why if isinstance(why, str) else "\n".join(first(why.problems))
    ui.notify(told, type="negative", position="top", multi_line=True, timeout=READ)


def done(what: str) -> None:
    """Tell that something was done."""
    ui.notify(what, type="positive", position="top")


# Menus that the browser opens and closes by itself.
#
# NiceGUI's own menus have the server say back whether they are open: on a busy server the answer to a click comes after
# the next one, and closes a menu the user has just opened, or opens one that was closed.


def drop_down(title: str, mark: str, *, icon: str = "", role: str = "menu", closes: bool = True) -> ui.element:
    """Return the menu below a button; what is built within it stands in the menu.

    icon: name of the icon before the title, none if empty.
    role: ``menu`` of `menu_item`s, ``dialog`` of other things; closes: after anything in it was pressed.
    """
    with ui.element("q-btn").props("flat dense no-caps color=primary icon-right=arrow_drop_down") as button:
        button.props(f'data-mark="{mark}"' + (f" icon={icon}" if icon else ""))
        button.props["label"] = title
        menu = ui.element("q-menu").props(f"role={role}{' auto-close' if closes else ''}")
    menu.props["aria-label"] = title
    return menu


def menu_item(title: str, what: Callable[[], object], mark: str = "") -> None:
    """Add an act to a menu."""
    ui.item(title, on_click=lambda: what()).props(f'role=menuitem data-mark="{mark}"')


def pop_up(title: str) -> ui.element:
    """Return a menu that opens when what it stands in is clicked, and stays while its content is used."""
    return ui.element("q-menu").props(f'max-height=80vh role=dialog aria-label="{title}"')
