"""The 3-D view as an element of the page.

Python describes a scene (``cardan.scene.scene``) and says what to show of it; the browser draws, turns the drive
between the frames it was given and tells what was touched. Everything asked for is kept here, so a page that is
loaded again, or a part of it that was taken away and comes back, shows the same.
"""

from __future__ import annotations

import json
from array import array
from base64 import b64decode, b64encode
from collections.abc import Callable, Iterable, Mapping
from hashlib import blake2b
from math import tau
from typing import Any, Literal

import nicegui.elements.scene  # noqa: F401  registers the three.js that NiceGUI ships, as "nicegui-scene"
from nicegui.element import Element

from cardan.texts import _

PIECE = 400_000  # characters of a picture in one message; a message of a megabyte would break the connection

Message = dict[str, Any]


class SceneView(Element, component="cardan_scene.js", esm={"cardan-scene": "js"}):
    """Three-dimensional view of a drive that turns.

    on_touched: called with the key path of a body that was touched, such as ``joints[1]``; empty for none.
    on_measured: called with the two points [m] between which something is to be measured, six numbers.
    on_angle: called with the input angle [rad] while the drive turns, at most ten times a second.
    on_playing: called with true or false when turning starts or stops, the space key in the browser included.
    Parts of the page that follow the angle without the server listen to the event ``cardan-angle`` of the window,
    with ``detail.angle``, and send ``cardan-go-to`` with ``detail.angle`` to turn the drive.
    """

    def __init__(
        self,
        *,
        on_touched: Callable[[str], object] | None = None,
        on_angle: Callable[[float], object] | None = None,
        on_playing: Callable[[bool], object] | None = None,
        on_measured: Callable[[list[float]], object] | None = None,
    ) -> None:
        super().__init__()
        self._props["texts"] = {
            "label": _(
                "Three-dimensional view of the drive. Arrow keys turn the view, plus and minus zoom, space starts and "
                "stops, 1 to 4 choose a standard view, F shows all of it, Escape takes the mark away."
            ),
            "sides": {
                "plan": _("plan"),
                "below": _("below"),
                "side": _("side"),
                "far": _("far side"),
                "front": _("front"),
                "back": _("back"),
            },
            "no_webgl": _("This browser cannot draw in three dimensions (WebGL is not available)."),
            "lost": _("The graphics card has been taken away for a moment; the view will come back."),
        }
        self.playing = True
        self.drawn: bool | None = None
        self._ready = False
        self._scene: Mapping[str, Any] | None = None
        self._there: frozenset[str] = frozenset()
        self._asked: dict[str, Any] = {"play": True}
        self._on_playing = on_playing
        self.on("ready", lambda event: self._restore(bool(event.args)))
        self.on("lacking", lambda: self._send_scene(whole=True))
        self.on("playing", lambda event: self._heard_playing(bool(event.args)))
        if on_touched is not None:
            self.on("touched", lambda event: on_touched(str(event.args)))
        if on_angle is not None:
            self.on("angle", lambda event: on_angle(float(event.args)))
        if on_measured is not None:
            self.on("measured", lambda event: on_measured([float(one) for one in event.args]))

    def show(self, scene: Mapping[str, Any]) -> None:
        """Show a scene, as ``Scene.described()`` gives it; the camera stays where the user has it."""
        self._scene = scene
        self._send_scene()

    def groups(self, on: Iterable[str]) -> None:
        """Show the lines, planes, names and arrows of these groups, and hide the others."""
        self._ask("groups", sorted(on))

    def mode(self, index: int | None) -> None:
        """Swing in a mode shape of the scene; None turns the drive again."""
        self._ask("mode", index)

    def play(self, on: bool) -> None:
        """Turn the drive, or hold it. A page opens turning, unless its user asks the system for reduced motion."""
        self.playing = on
        self._ask("play", on)

    def speed(self, turns: float) -> None:
        """Turn this many times a minute on the screen, 6 unless told: slow motion."""
        self._ask("speed", turns)

    def go_to(self, angle: float) -> None:
        """Turn the input to an angle [rad]."""
        self._ask("goTo", angle % tau)

    def view(self, name: str) -> None:
        """Look from a side: ``iso``, ``side``, ``plan``, ``front``, or along ``axis of shafts[1]``."""
        self._ask("look", name)

    def fit(self) -> None:
        """See all of it, from where it is looked at now."""
        self.run_method("fit")

    def section(self, place: float | None) -> None:
        """Cut it along its length, from -1, nearest to who looks, to 1; None makes it whole again."""
        self._ask("section", place)

    def measure(self, on: bool) -> None:
        """Measure between points that are touched, or touch parts again."""
        self._ask("measure", on)

    def projection(self, kind: Literal["perspective", "orthographic"] | None) -> None:
        """Draw with or without perspective; None takes what suits the view."""
        self._ask("projection", kind)

    def theme(self, name: Literal["light", "dark"]) -> None:
        """Draw on a light or a dark background."""
        self._ask("theme", name)

    def colour_by(self, what: Literal["shaft", "utilisation"]) -> None:
        """Colour the parts by the shaft they belong to or by how much of their limit is used."""
        self._ask("colourBy", what)

    def select(self, path: str | None) -> None:
        """Mark the parts that belong to a key path of the drive file; None marks nothing."""
        self._ask("select", path)

    async def snapshot(self) -> bytes:
        """Return what is seen as a PNG, with its labels, at twice the size on the screen."""
        length = await self.run_method("snapshot", timeout=20)
        pieces = [
            await self.run_method("snapshotPart", start, PIECE, timeout=20) for start in range(0, length or 0, PIECE)
        ]
        return b64decode("".join(pieces))

    def _ask(self, name: str, value: Any) -> None:
        self._asked[name] = value
        if self._ready:
            self.run_method(name, value)

    def _restore(self, drawn: bool) -> None:
        """Tell a browser that has just begun all that was asked for."""
        self._ready = True
        self.drawn = drawn
        asked = {**self._asked, "play": self.playing}
        for name in ("theme", "look", "projection"):  # before the scene, so that its first picture is right
            if name in asked:
                self.run_method(name, asked.pop(name))
        self._send_scene(whole=True)
        for name, value in asked.items():
            self.run_method(name, *((value, True) if name == "play" else (value,)))

    def _send_scene(self, *, whole: bool = False) -> None:
        if self._scene is None or not self._ready:
            return
        message, there = packed(self._scene, frozenset() if whole else self._there)
        self._there = there
        self.run_method("show", json.dumps(message, ensure_ascii=False, separators=(",", ":")))

    def _heard_playing(self, playing: bool) -> None:
        self.playing = playing
        if self._on_playing is not None:
            self._on_playing(playing)


def packed(scene: Mapping[str, Any], there: frozenset[str] = frozenset()) -> tuple[Message, frozenset[str]]:
    """Return a scene as it is sent, and the names of its meshes.

    scene: as ``Scene.described()`` gives it.
    there: meshes the browser has already; they are named, not sent.
    Returns message: long lists of numbers as base 64 of their bytes; each mesh once, under a name made from its
    content; meshes: all names that the scene uses.
    """
    meshes: dict[str, Message] = {}
    used: set[str] = set()
    bodies = []
    for body in scene["bodies"]:
        positions = array("f", body["positions"]).tobytes()
        indices = array("I", body["indices"]).tobytes()
        content = blake2b(positions, digest_size=12)
        content.update(indices)
        name = content.hexdigest() + ("s" if body["smooth"] else "f")
        used.add(name)
        if name not in there:
            meshes[name] = {"positions": b64encode(positions).decode(), "indices": b64encode(indices).decode()}
        bodies.append({**{k: v for k, v in body.items() if k not in {"positions", "indices"}}, "mesh": name})
    tracks = [{"origin": track["origin"], "turn": _bytes(track["turn"])} for track in scene["tracks"]]
    modes = [
        {
            **mode,
            "turns": {track: _bytes(turn) for track, turn in mode["turns"].items()},
            "curves": [{**curve, "points": _bytes(curve["points"])} for curve in mode["curves"]],
        }
        for mode in scene["modes"]
    ]
    return {**scene, "bodies": bodies, "tracks": tracks, "modes": modes, "meshes": meshes}, frozenset(used)


def _bytes(numbers: Iterable[float]) -> str:
    return b64encode(array("f", numbers).tobytes()).decode()
