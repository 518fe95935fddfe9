"""The page: the drive in the middle, its file on the left, its verdicts on the right, the answers below."""

from __future__ import annotations

import json
import logging
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any
from urllib.parse import quote, unquote, urlencode

from anyio import EndOfStream
from nicegui import ui
from nicegui.client import ClientConnectionTimeout
from starlette.requests import ClientDisconnect
from starlette.responses import Response

from cardan.catalogue.completion import sized
from cardan.drive.bodies.solids import solids
from cardan.errors import InputError
from cardan.figures.drive import space_figure
from cardan.figures.render_svg import inline_svg
from cardan.io import example, example_names, example_text, starter
from cardan.io.examples import USES, about, template
from cardan.report.block import capital
from cardan.texts import _, visible

from .parts import widgets as toasts
from .parts.answers import Answers, MechanismPages
from .parts.diagnosis import Diagnosis
from .parts.download import Exports
from .parts.editor import Editor, Source
from .parts.header import Header
from .parts.sweep import Sweep
from .parts.verdicts import Verdicts
from .parts.view import View
from .parts.widgets import Apart, Live, Timer, escaped
from .state.jobs import Jobs
from .state.kept import Kept
from .state.recordings import DIAGNOSIS
from .state.session import Session
from .state.work import SWEEP

# Keys for all of the page: undo, redo, save.

PRESSED = """if (!window.cardanKeys) {
  window.cardanKeys = true;
  addEventListener('keydown', (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
    const writing = event.target.closest('input:not([data-spun]), select, textarea, [contenteditable=true]');
    const letter = (/^[a-z]$/i.test(event.key) ? event.key : event.code.replace('Key', '')).toLowerCase();
    if (letter === 's') {
      event.preventDefault();
      if (event.repeat) return;
      const field = document.activeElement; // that tells what was written in it once it is left
      field.blur();
      field.focus({ preventScroll: true });
      setTimeout(() => emitEvent('cardan-key', 'save'));
    } else if ((letter === 'z' || letter === 'y') && !writing) {
      event.preventDefault();
      const what = letter === 'y' || event.shiftKey ? 'redo' : 'undo';
      setTimeout(() => emitEvent('cardan-key', what)); // behind the last step of a number that was on the move
    }
  });
}"""
"""Tells which key was pressed: by its letter, or by its place where letters of another script are written."""


class Keys:
    """Listens to ctrl Z, ctrl shift Z, ctrl Y and ctrl S; inside a text the browser's own undo goes first.

    It belongs to the window: parts of the page that are built anew do not bring another one.
    """

    def __init__(self, session: Session, save: Callable[[], None]) -> None:
        self.session = session
        self.save = save
        ui.on("cardan-key", lambda event: self._pressed(str(event.args)))
        ui.run_javascript(PRESSED)

    def _pressed(self, what: str) -> None:
        if what != "save":
            (self.session.redo if what == "redo" else self.session.undo)()
        elif not self.session.empty:
            self.save()


# An empty start: examples with pictures, the files of the folder, a new drive.

FIRST = ("truck-printed-angles", "car-propshaft", "two-piece-rear-drive", "pto-drive", "mill-spindle", "truck-supports")
"""Examples shown first."""

LAST = 8  # files of the folder that are offered, the one changed last first


class Start:
    """What the user sees before a drive is open."""

    def __init__(self, session: Session) -> None:
        self.session = session
        with ui.element("main").classes("start").props("id=main"):
            ui.label(_("Which drive?")).classes("title").props("role=heading aria-level=1")
            with ui.row().classes("choices"):
                ui.button(_("New drive"), icon="add", on_click=lambda: session.open(starter(), saved=False)).props(
                    "no-caps unelevated"
                ).props('data-mark="new"')
            files = session.workspace.names()[:LAST]
            if files:
                self._choices(
                    _("Last files"), "description", {name: visible(name) for name in files}, self._open, "file"
                )
            uses = {use: capital(_(title)) for use, title in USES.items()}
            self._choices(_("Start from"), "note_add", uses, self._begin, "template")
            ui.label(_("Examples")).classes("head").props("role=heading aria-level=2")
            with ui.element("div").classes("cards"):
                for card in cards():
                    self._card(*card)

    def _choices(
        self, title: str, icon: str, named: Mapping[str, str], chosen: Callable[[str], object], mark: str
    ) -> None:
        """Offer things to begin with, one button each."""
        ui.label(title).classes("head").props("role=heading aria-level=2")
        with ui.row().classes("choices"):
            for name, said in named.items():
                button = ui.button(said, icon=icon, on_click=lambda name=name: chosen(name))
                button.props(f'no-caps outline data-mark="{mark}-{escaped(name)}"')

    def _begin(self, use: str) -> None:
        """Begin with the drive of a use."""
        with self.session.speaking():
            self.session.open(template(use, ""), saved=False)

    def _card(self, name: str, title: str, count: int) -> None:
        with ui.element("button").classes("card").props(f'data-mark="example-{name}"') as card:
            ui.element("img").props(f'src="/cardan-examples/{name}.svg" loading=lazy alt=""')
            ui.label(_(title)).classes("head")
            ui.label(about(name)).classes("about")
            ui.label(_("joints: {count}").format(count=count)).classes("hint")
        card.on("click", lambda: open_example(self.session, name))

    def _open(self, name: str) -> None:
        with self.session.speaking():
            try:
                self.session.open(self.session.workspace.read(name), name)
            except InputError as error:
                toasts.refused(error)


STATIC = Path(__file__).parent / "static"

ICON = STATIC / "icon.svg"

__all__ = ["CHOSEN", "ICON", "Apart", "build", "dress", "kept_choices", "open_example", "serve_files", "stored"]

CHOSEN = "cardan_choices"  # cookie with the choices of a user

YEAR = 365 * 24 * 3600

LATER = 0.08  # seconds by which the form, the text and the view in space follow the curves and the verdicts


def serve_files(app: Any) -> None:
    """Serve style and pictures of the page."""
    app.add_static_files("/cardan", STATIC)

    app.add_api_route("/cardan-examples/{name}.svg", _picture)


# What is raised where a browser leaves before it was answered, by itself or as the reason of what is told.
GONE = (ConnectionError, ClientDisconnect, ClientConnectionTimeout, EndOfStream)


def worth_telling(record: logging.LogRecord) -> bool:
    """Tell whether a record of the log is worth it: not that an address leads nowhere, nor that a browser is gone."""
    error = record.exc_info[1] if record.exc_info else record.msg
    why = getattr(error, "__cause__", None)
    return not isinstance(error, GONE) and not isinstance(why, GONE) and not record.getMessage().endswith(" not found")


def _picture(name: str) -> Any:
    """Answer with the picture of a shipped example."""
    text = example_picture(name)
    head = {"Cache-Control": "max-age=86400"}
    return Response(text, 200 if text else 404, head, media_type="image/svg+xml")


@cache
def cards() -> tuple[tuple[str, str, int], ...]:
    """Return the shipped examples in the order in which they are offered: name, what they are called, joints."""
    names = (*FIRST, *(one for one in example_names() if one not in FIRST))
    drives = {name: example(name) for name in names}
    return tuple((name, drive.name or name, len(drive.joints)) for name, drive in drives.items())


@cache
def example_picture(name: str) -> str:
    """Return the picture of a shipped example as SVG; nothing where there is none of that name."""
    if name not in example_names():
        return ""
    drive = example(name)
    return inline_svg(space_figure(drive, solids(sized(drive)), name="sketch", named=False))


def kept_choices(cookies: Mapping[str, str]) -> Mapping[str, Any]:
    """Return the choices that the browser kept; none where they make no sense."""
    try:
        kept = json.loads(unquote(cookies.get(CHOSEN, "{}")))
    except (ValueError, RecursionError):
        return {}
    return kept if isinstance(kept, dict) else {}


def open_example(session: Session, name: str) -> None:
    """Open a shipped example as a new file."""
    session.open(example_text(name), saved=False, example=name)


# What the browser keeps of a window in the storage of its tab, the address that names what is open, and the question
# before something is lost. A page that lost its server is not asked: what it shows is kept there.

KEEPING = """window.cardanKeep = (address, losing) => {
  window.cardanLosing = losing;
  if (location.pathname + location.search !== address) history.replaceState(history.state, '', address);
};
window.cardanStore = (kept) => {
  try { sessionStorage.setItem('cardan-kept', kept); } catch { sessionStorage.removeItem('cardan-kept'); }
};
addEventListener('beforeunload', (event) => {
  if (window.cardanLosing && document.getElementById('popup')?.ariaHidden !== 'false') event.preventDefault();
});"""

STORED = "return sessionStorage.getItem('cardan-kept') ?? ''"

STORE = 0.5  # seconds without a change after which the browser keeps it


async def stored() -> str:
    """Return what the browser kept of this window; nothing where it does not say."""
    try:
        return str(await ui.run_javascript(STORED, timeout=5.0))
    except TimeoutError:
        return ""


class Keeping:
    """Has server and browser keep what a window works on.

    keep: keeps it on the server; body: part of the page that stays.
    """

    def __init__(self, session: Session, keep: Callable[[Kept], None], body: ui.element) -> None:
        self.session, self._keep, self._body = session, keep, body
        self._told: tuple[str, bool] | None = None
        self._due: Timer | None = None
        ui.run_javascript(KEEPING)
        session.listen("file", self.follow, lasting=True)
        session.listen("variants", self.follow, lasting=True)

    def follow(self) -> None:
        """Keep it as it is now."""
        session = self.session
        kept = session.kept()
        what, name = ("file", "") if session.empty else kept.place
        if not session.empty:
            self._keep(kept)
        now = (f"/?{urlencode({what: name})}", session.losing)
        if now != self._told:
            self._told = now
            ui.run_javascript(f"cardanKeep({json.dumps(now[0])}, {json.dumps(now[1])})")
        if self._due is not None:
            self._due.cancel()
        self._due = Timer(session, self._body, STORE, lambda: self._store(kept), once=True)

    def _store(self, kept: Kept) -> None:
        ui.run_javascript(f"cardanStore({json.dumps(kept.packed())})")


def dress() -> None:
    """Give the page its looks, before anything stands on it."""
    for name in ("app", "answers", "variants"):
        ui.add_head_html(f'<link rel="stylesheet" href="/cardan/{name}.css">')
    for name in ("desk", "numbers"):
        ui.add_head_html(f'<script type="module" src="/cardan/{name}.js"></script>')


def build(session: Session, jobs: Jobs, keep: Callable[[Kept], None]) -> None:
    """Build the page of one window. jobs: where long answers are made; keep: keeps what the window works on."""
    ui.colors(primary="#1f4e8c", positive="#1b7f4b", negative="#b3261e", warning="#9a5b00")
    dark = ui.dark_mode({"auto": None, "light": False, "dark": True}[session.choices.theme])
    ui.query("body").classes("cardan")
    _frame().tag = "div"  # Quasar's would be the main part, which the page has of its own
    _tell_browser(session)

    def chosen() -> None:
        dark.value = {"auto": None, "light": False, "dark": True}[session.choices.theme]
        kept = quote(json.dumps(session.choices.kept()))
        ui.run_javascript(f"document.cookie='{CHOSEN}={kept}; path=/; max-age={YEAR}; samesite=strict'")

    ui.context.client.on_delete(session.recordings.close)
    ui.context.client.on_delete(lambda: jobs.leave(session))
    session.listen("choices", chosen, lasting=True)
    whole = ui.element("div").classes("page")
    keeping = Keeping(session, keep, whole)
    heads: list[Header] = []

    def filled() -> None:
        with session.speaking(), whole:
            whole.clear()
            session.forget_parts()
            _tell_browser(session)
            heads[:] = [_parts(session, jobs)]
            keeping.follow()

    def later(what: Callable[[], None]) -> None:
        Timer(session, whole, LATER, what, once=True)

    session.rebuild = filled
    session.later = later
    filled()
    Keys(session, lambda: heads[0].save())

    def dimmed(event: Any) -> None:
        session.dark = bool(event.args)
        session.tell("choices")

    ui.on("cardan-dark", dimmed)
    ui.run_javascript(
        "const dim=matchMedia('(prefers-color-scheme: dark)');if(dim.matches)emitEvent('cardan-dark',true);"
        "dim.addEventListener('change',()=>emitEvent('cardan-dark',dim.matches))"
    )
    if session.notice:
        ui.notify(session.notice, type="negative", timeout=0, close_button=_("Close"))


def _frame() -> ui.element:
    """Return what NiceGUI puts a page into."""
    slot = ui.context.client.content.parent_slot
    assert slot is not None
    slot.parent.update()
    return slot.parent


def _tell_browser(session: Session) -> None:
    """Tell the browser in which language the page is."""
    ui.run_javascript(f"document.documentElement.lang='{session.choices.language}'")


def _parts(session: Session, jobs: Jobs) -> Header:
    head = Header(session, jobs)
    if session.empty:
        Start(session)
        return head
    jobs.start()
    jobs.leave(session)  # what an older page of the same window was waiting for
    if session.document.of_mechanism:
        with ui.element("main").classes("desk of-mechanism").props("id=main"):
            with _pane("file", _("Mechanism file")):
                Source(session)
            _edge("--file", _("width of the drive file"), 23)
            with _pane("answers", _("Answers")):
                MechanismPages(session, jobs, Exports(session, jobs))
        return head
    with ui.element("main").classes("desk").props("id=main"):
        with _pane("file", _("Drive file")):
            Editor(session)
        _edge("--file", _("width of the drive file"), 23)
        with _pane("view", _("The drive turning")):
            head.report.snapshot = View(session, jobs).scene.snapshot
        _edge("--view", _("height of the view"), 46)
        _edge("--verdicts", _("width of the verdicts"), 20)
        with _pane("verdicts", _("Verdicts")):
            Verdicts(session, jobs, compare=head.variants.compare)
        with _pane("answers", _("Answers")):
            export = Exports(session, jobs)
            answers = Answers(session, jobs, export=export)
            answers.add(SWEEP, _("Sweep"), lambda: Sweep(session, jobs, export))
            answers.add(DIAGNOSIS, _("Diagnosis"), lambda: Diagnosis(session, jobs, export))
    return head


@contextmanager
def _pane(name: str, title: str) -> Iterator[None]:
    """Build a pane of the desk around what is built within, with its heading and the button that enlarges it."""
    with ui.element("section").classes(f"pane {name}").props(f'aria-labelledby="pane-{name}"'):
        Live(escaped(title), tag="h2").classes("unseen").props(f'id="pane-{name}"')
        told = _("enlarge {pane}").format(pane=title)
        enlarge = ui.button(icon="open_in_full").props(f'flat dense size=sm aria-label="{told}" title="{told}"')
        enlarge.props(f'aria-pressed=false data-mark="enlarge-{name}"').classes("enlarge")
        yield


def _edge(share: str, title: str, usual: int) -> None:
    """Build the edge between two panes.

    share: property of the desk's style that it moves; usual: what that is at first, in per cent.
    """
    lies = "horizontal" if share == "--view" else "vertical"
    edge = ui.element("div").classes(f"edge {share[2:]}-edge").props(f'role=separator tabindex=0 data-share="{share}"')
    edge.props(f'aria-orientation={lies} aria-label="{title}" aria-valuenow={usual} aria-valuemin=12 aria-valuemax=70')
