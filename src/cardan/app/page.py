"""The page: the drive in the middle, its file on the left, its verdicts on the right, the answers below."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import Any
from urllib.parse import quote, unquote

from nicegui import ui
from starlette.responses import Response

from cardan.drive.bodies.solids import solids
from cardan.figures.drive import space_figure
from cardan.figures.render_svg import inline_svg
from cardan.io import example, example_names, example_text
from cardan.texts import _

from .parts.answers import Answers
from .parts.diagnosis import Diagnosis
from .parts.download import Exports
from .parts.editor import Editor
from .parts.header import Header
from .parts.keys import Keys
from .parts.start import Start
from .parts.timers import Timer
from .parts.verdicts import Verdicts
from .parts.view import View
from .state.jobs import Jobs
from .state.recordings import DIAGNOSIS
from .state.session import Session

STATIC = Path(__file__).parent / "static"

ICON = STATIC / "icon.svg"

CHOSEN = "cardan_choices"
"""Cookie with the choices of a user."""

YEAR = 365 * 24 * 3600

LATER = 0.08
"""Seconds by which the form, the text and the view in space follow the curves and the verdicts."""


def serve_files(app: Any) -> None:
    """Serve style and pictures of the page."""
    app.add_static_files("/cardan", STATIC)

    app.add_api_route("/cardan-examples/{name}.svg", _picture)


def _picture(name: str) -> Any:
    """Answer with the picture of a shipped example."""
    text = example_picture(name)
    head = {"Cache-Control": "max-age=86400"}
    return Response(text, 200 if text else 404, head, media_type="image/svg+xml")


@cache
def example_picture(name: str) -> str:
    """Return the picture of a shipped example as SVG; nothing where there is none of that name."""
    if name not in example_names():
        return ""
    drive = example(name)
    return inline_svg(space_figure(drive, solids(drive), name="sketch"))


def kept_choices(cookies: Mapping[str, str]) -> Mapping[str, Any]:
    """Return the choices that the browser kept; none where they make no sense."""
    try:
        kept = json.loads(unquote(cookies.get(CHOSEN, "{}")))
    except ValueError:
        return {}
    return kept if isinstance(kept, dict) else {}


def open_example(session: Session, name: str) -> None:
    """Open a shipped example as a new file.

    Raises InputError: there is no such example.
    """
    session.open(example_text(name), saved=False)


def build(session: Session, jobs: Jobs) -> None:
    """Build the page of one window.

    jobs: where long answers are made.
    """
    ui.add_head_html('<link rel="stylesheet" href="/cardan/app.css">')
    ui.colors(primary="#1f4e8c", positive="#1b7f4b", negative="#b3261e", warning="#9a5b00")
    dark = ui.dark_mode({"auto": None, "light": False, "dark": True}[session.choices.theme])
    ui.query("body").classes("cardan")
    _tell_browser(session)

    def chosen() -> None:
        dark.value = {"auto": None, "light": False, "dark": True}[session.choices.theme]
        kept = quote(json.dumps(session.choices.kept()))
        ui.run_javascript(f"document.cookie='{CHOSEN}={kept}; path=/; max-age={YEAR}; samesite=strict'")

    ui.context.client.on_delete(session.recordings.close)
    session.listen("choices", chosen, lasting=True)
    whole = ui.element("div").classes("page")

    def filled() -> None:
        with session.speaking(), whole:
            whole.clear()
            session.forget_parts()
            _tell_browser(session)
            _parts(session, jobs)

    def later(what: Callable[[], None]) -> None:
        Timer(session, whole, LATER, what, once=True)

    session.rebuild = filled
    session.later = later
    filled()
    Keys(session)

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


def _tell_browser(session: Session) -> None:
    """Tell the browser in which language the page is."""
    ui.run_javascript(f"document.documentElement.lang='{session.choices.language}'")


def _parts(session: Session, jobs: Jobs) -> None:
    head = Header(session, jobs)
    if session.empty:
        Start(session)
        return
    with ui.element("main").classes("desk"):
        with ui.element("section").classes("pane file").props(f'aria-label="{_("Drive file")}"'):
            Editor(session)
        with ui.element("section").classes("pane view").props(f'aria-label="{_("The drive turning")}"'):
            head.report.snapshot = View(session).scene.snapshot
        with ui.element("section").classes("pane answers").props(f'aria-label="{_("Answers")}"'):
            export = Exports(session, jobs)
            answers = Answers(session, jobs, export=export)
            answers.add(DIAGNOSIS, _("Diagnosis"), lambda: Diagnosis(session, jobs, export))
        with ui.element("section").classes("pane verdicts").props(f'aria-label="{_("Verdicts")}"'):
            Verdicts(session, jobs, compare=head.variants.compare)
