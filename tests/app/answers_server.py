"""A page with the answers and the verdicts of an example alone, and buttons for edits: ``... PORT FOLDER``."""

from __future__ import annotations

import sys
from pathlib import Path

from nicegui import app, ui

from cardan.app import page
from cardan.app.parts.answers import Answers
from cardan.app.parts.diagnosis import Diagnosis
from cardan.app.parts.verdicts import Verdicts
from cardan.app.state.document import Workspace
from cardan.app.state.jobs import Jobs
from cardan.app.state.recordings import DIAGNOSIS, close_all
from cardan.app.state.session import Choices, Session
from cardan.figures.figure import Figure
from cardan.io import example_text
from cardan.io.edit import edit
from cardan.report.block import Page

jobs = Jobs(1)


@ui.page("/")
def shown(example: str = "truck-power-unit", language: str = "en", theme: str = "light") -> None:
    session = Session(Workspace(Path(sys.argv[2])), Choices(language=language))
    session.open(example_text(example))
    page.dress()
    ui.dark_mode(theme == "dark")
    ui.query("body").classes("cardan")
    path = ui.label("").props("id=selected")
    taken = ui.label("").props("id=taken")

    def take(thing: Figure | Page) -> None:
        taken.set_text(thing.name)

    session.listen("selection", lambda: path.set_text(session.selected))
    edits = {
        "turn": lambda: session.change(lambda text: edit(text, {"shafts[1].yoke_angle_deg": 33.0})),
        "break": lambda: session.rewrite(session.document.text + "\nfoo = 1\n"),
        "undo": session.undo,
        "inch": lambda: session.choose(units={"length": "in"}, decimal=","),
    }
    with ui.row():
        for name, made in edits.items():
            ui.button(name, on_click=made).props(f"id={name}")
    with session.speaking(), ui.element("main").classes("desk").style("height: 640px"):
        with ui.element("section").classes("pane answers").style("grid-row: 1 / 3"):
            answers = Answers(session, jobs, export=take)
            answers.add(DIAGNOSIS, "Diagnosis", lambda: Diagnosis(session, jobs, take))
        with ui.element("section").classes("pane verdicts"):
            Verdicts(session, jobs, compare=lambda: taken.set_text("compare"))


if __name__ == "__main__":
    app.on_shutdown(jobs.close)
    app.on_shutdown(close_all)
    page.serve_files(app)
    ui.run(port=int(sys.argv[1]), reload=False, show=False, show_welcome_message=False, reconnect_timeout=60)
