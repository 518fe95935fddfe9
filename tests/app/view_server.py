"""A page with the 3-D view, or two of them, and buttons for all that Python can ask of it: ``... PORT [EXAMPLE]``.

It draws the made-up scene, or a shipped example.
"""

from __future__ import annotations

import base64
import sys
from typing import Any

from nicegui import ui

from cardan.app.scene.element import SceneView
from tests.app import made_up


def scene(*, radius: float = 0.035) -> dict[str, Any]:
    if len(sys.argv) < 3:
        return made_up.scene(radius=radius)
    from cardan import example
    from cardan.scene.scene import scene as drawn

    return drawn(example(sys.argv[2]), with_forces=True, with_modes=True).described()


@ui.page("/")
def one(width: int = 760, height: int = 420) -> None:
    holder = ui.element("div").style(f"width: {width}px; height: {height}px").props("id=holder")
    heard = ui.label("").mark("heard").props("id=heard")
    angle = ui.label("").props("id=angle")
    playing = ui.label("").props("id=playing")

    def make() -> SceneView:
        with holder:
            return SceneView(
                on_touched=heard.set_text,
                on_angle=lambda value: angle.set_text(f"{value:.4f}"),
                on_playing=lambda value: playing.set_text(str(value)),
            ).style("width: 100%; height: 100%")

    view = make()
    view.show(scene())

    async def snapshot() -> None:
        heard.set_text(base64.b64encode((await view.snapshot())[:8]).decode())

    asked = {
        "play": lambda: view.play(True),
        "pause": lambda: view.play(False),
        "fast": lambda: view.speed(60),
        "go": lambda: view.go_to(1.25),
        "hide": lambda: view.groups({"forces", "planes"}),
        "all": lambda: view.groups({"axes", "planes", "names", "forces", "couples"}),
        "dark": lambda: view.theme("dark"),
        "whirl": lambda: view.mode(0),
        "torsion": lambda: view.mode(1),
        "turn": lambda: view.mode(None),
        "side": lambda: view.view("side"),
        "plan": lambda: view.view("plan"),
        "axis": lambda: view.view("axis of shafts[2]"),
        "utilisation": lambda: view.colour_by("utilisation"),
        "select": lambda: view.select("joints[1]"),
        "edit": lambda: view.show(scene(radius=0.06)),
        "move": lambda: holder.clear(),
        "snapshot": snapshot,
    }

    def again() -> None:
        nonlocal view
        view = make()
        view.show(scene())

    with ui.row():
        for name, ask in asked.items():
            ui.button(name, on_click=ask).props(f"id=ask-{name}")
        ui.button("again", on_click=again).props("id=ask-again")


@ui.page("/two")
def two() -> None:
    for radius in (0.035, 0.05):
        with ui.element("div").style("width: 300px; height: 150px"):
            SceneView().style("width: 100%; height: 100%").show(scene(radius=radius))


if __name__ == "__main__":
    ui.run(host="127.0.0.1", port=int(sys.argv[1]), show=False, reload=False, reconnect_timeout=60)
