"""The left side of the page: the drive file as a form, as its geometry, as text."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any

from nicegui import background_tasks, events, ui
from nicegui.element import Element

from cardan.app.state.form import Entry, geometry_form, parts, section
from cardan.app.state.session import Session
from cardan.drive.drive import Drive
from cardan.drive.fields.paths import read
from cardan.drive.joints.joint import Point
from cardan.drive.models.geometry import movable, with_point
from cardan.errors import CardanError
from cardan.io.amend import amend
from cardan.texts import _
from cardan.units import DIMENSIONS

from .form import PAUSE, SLICE, Form, KeyField, attempt
from .widgets import Timer, first, refused


class Editor:
    """The drive file, in three ways that stay in step."""

    def __init__(self, session: Session) -> None:
        self.session = session
        with (
            ui.tabs()
            .props("dense no-caps inline-label align=left breakpoint=0 narrow-indicator")
            .classes("ways") as tabs
        ):
            form = ui.tab("form", label=_("Form")).props('data-mark="way-form"')
            lies = ui.tab("geometry", label=_("Geometry")).props('data-mark="way-geometry"')
            text = ui.tab("file", label=_("File")).props('data-mark="way-file"')
        self.problems = ui.element("div").classes("problems").props("role=status").props('data-mark="problems"')
        with ui.tab_panels(tabs, value=form, animated=False, keep_alive=True).classes("way") as ways:
            with ui.tab_panel(form):
                Form(session)
            with ui.tab_panel(lies):
                centres = Centres(session)
            with ui.tab_panel(text):
                Source(session)
        ways.props["data-explore"] = _("explore with a slider")
        tabs.on_value_change(lambda event: centres.wake() if event.value == "geometry" else None)
        self._judge()
        session.listen("text", self._judge)
        session.listen("text", self._follow, first=True)

    def _follow(self) -> None:
        """Tell a hand that moves something that it is followed: it sends the newest place then, and none between."""
        if self.session.moving:
            ui.run_javascript("dispatchEvent(new Event('cardan-followed'))")

    def _judge(self) -> None:
        """Say what is wrong with the file, whatever way is open."""
        found = self.session.document.problems
        self.problems.clear()
        self.problems.set_visibility(bool(found))
        with self.problems:
            for told in first(found, 4):
                ui.label(told).classes("wrong")


# The drive file as text, both ways in step with everything else.

QUIET = 0.4  # seconds without a key after which the text is read


class Source:
    """The text of the file, with what is wrong with it below."""

    def __init__(self, session: Session) -> None:
        self.session = session
        self._silent = False
        self._due: Timer | None = None
        self.text: Any = ui.codemirror(self._lines(), language="TOML", on_change=self._typed)
        self._theme()
        self.text.on("focusout", self._read, js_handler="() => emit()")
        self.text.classes("source").props('data-mark="source"').props(f'aria-label="{_("text of the drive file")}"')
        self.problems = ui.element("div").classes("problems").props("role=status")
        self._judge()
        session.listen("text", self._follow)
        session.listen("choices", self._theme)

    def _typed(self) -> None:
        if not self._silent:
            self._wait()

    def _wait(self) -> None:
        if self._due is not None:
            self._due.cancel()
        self._due = Timer(self.session, self.text, QUIET, self._quiet, once=True)

    def _quiet(self) -> None:
        """Read the text, once what was read before is worked on no more."""
        if self.session.apart is not None and self.session.apart.busy:
            self._wait()
        else:
            self._read()

    def _read(self) -> None:
        """Take what was written: after a while without a key, and at once where the writer leaves the text."""
        waiting, self._due = self._due, None
        if waiting is not None:
            waiting.cancel()
        if self.text.value == self._lines():
            return
        ends = "\r\n" if "\r\n" in self.session.document.text else "\n"
        with self.session.speaking():
            self.session.rewrite(self.text.value.replace("\n", ends))

    def _lines(self) -> str:
        """Return the text with the one end of a line that the browser counts."""
        return self.session.document.text.replace("\r\n", "\n")

    def _follow(self) -> None:
        """Show the file as it is now; who writes on is ahead of it."""
        if self._due is None and self.text.value != self._lines():
            self._silent = True
            self.text.value = self._lines()
            self._silent = False
        self._judge()

    def _theme(self) -> None:
        theme = self.session.choices.theme
        dark = theme == "dark" or (theme == "auto" and self.session.dark)
        self.text.theme = "vscodeDark" if dark else "vscodeLight"

    def _judge(self) -> None:
        self.problems.clear()
        with self.problems:
            for told in first(self.session.document.problems):
                ui.label(told).classes("wrong")


# Where the drive lies: its points as a table, and in plan and side view to be dragged.

SPECK = 1e-7  # of a number, in the unit of the file, by which it is still the same


COLUMNS = {
    "points": {"input": ("point",), "joints": ("centre",), "shafts": (), "output": ("point",)},
    "angles": {"input": (), "joints": ("joint_angle", "plane_twist"), "shafts": ("length", "yoke_angle"), "output": ()},
    "slopes": {"input": (), "joints": (), "shafts": ("length", "side_slope", "plan_slope", "yoke_angle"), "output": ()},
}
"""Form of the geometry -> the keys of each table that give it."""


class DragViews(Element, component="drag.js"):
    """Plan and side view whose points can be dragged."""

    def __init__(self, titles: tuple[str, str]) -> None:
        super().__init__()
        self._props.update(points=[], selected="", titles=list(titles))

    def show(self, points: list[dict[str, Any]], selected: str) -> None:
        """Show points: path, name, short, at [mm], end."""
        self._props.update(points=points, selected=selected)
        self.update()


class Centres:
    """The geometry as a table, and the views to drag it in; it is built when it is looked at first."""

    def __init__(self, session: Session) -> None:
        self.session = session
        self.fields: dict[str, KeyField] = {}
        self._shape: tuple[str, ...] = ()
        self._awake = False
        self.views = DragViews((_("Side view"), _("Plan")))
        self.views.on("moving", lambda event: self._moved(event, last=False))
        self.views.on("moved", lambda event: self._moved(event, last=True))
        self.views.on("touched", lambda event: session.select(event.args["path"]))
        self.hint = ui.label(_("Drag a point or move it with the arrow keys: 1 mm, with shift 10 mm.")).classes("hint")
        self.body = ui.element("div").classes("centres")
        session.listen("text", self._follow)
        session.listen("selection", self._draw)

    def wake(self) -> None:
        """Come up to date: it is looked at now."""
        if not self._awake:
            self._awake = True
            with self.session.speaking():
                self._follow()

    def _follow(self) -> None:
        tree = self.session.document.tree
        if tree is None or not self._awake:
            return
        found = list(_geometry(tree))
        shape = tuple(entry.key() for _title, entry in found)
        if shape != self._shape:
            self._shape = shape
            self.fields = {}
            self.body.clear()
            self._build(found[:SLICE])
            if found[SLICE:]:
                background_tasks.create(self._rest(shape, found), name="numbers of a long geometry")
        for _title, entry in found:
            if entry.key() in self.fields:
                self.fields[entry.key()].show(entry)
        self._draw()

    def _build(self, found: list[tuple[str, Entry]], before: str = "") -> None:
        with self.body:
            for title, entry in found:
                if title != before:
                    ui.label(title).classes("of")
                before = title
                self.fields[entry.key()] = KeyField(self.session, entry, removable=False)

    async def _rest(self, shape: tuple[str, ...], found: list[tuple[str, Entry]]) -> None:
        """Build the rest of a long table a few numbers at a time, so that other windows need not wait for it."""
        for k in range(SLICE, len(found), SLICE):
            await asyncio.sleep(PAUSE)
            if self.body.is_deleted or self._shape is not shape:
                return
            with self.session.speaking():
                self._build(found[k : k + SLICE], found[k - 1][0])

    def _draw(self) -> None:
        if not self._awake:
            return
        drive = self.session.drive
        points = [] if drive is None else list(_points(self.session.document.tree or {}, drive))
        self.views.set_visibility(bool(points))
        self.hint.set_visibility(bool(points))
        self.views.show(points, self.session.selected)

    def _moved(self, event: events.GenericEventArguments, *, last: bool) -> None:
        path, at = event.args["path"], event.args["at"]
        drive, tree = self.session.drive, self.session.document.tree or {}
        if drive is None or not _sound(at):
            return
        x, y, z = (float(one) * DIMENSIONS["length"]["mm"] for one in at)
        try:
            values = dict(_changed(tree, drive, path, (x, y, z)))
        except CardanError as error:
            if last:
                refused(str(error))
            return
        gesture = f"drag {path}"
        attempt(self.session, partial(amend, values=values), gesture=gesture)
        if last:
            self.session.end_gesture()


def _sound(at: Any) -> bool:
    return isinstance(at, list) and len(at) == 3 and all(isinstance(x, int | float) and abs(x) < 1e9 for x in at)


def _geometry(tree: Mapping[str, Any]) -> list[tuple[str, Entry]]:
    """Return the keys that say where the drive lies, each with the title of its table."""
    wanted = COLUMNS[geometry_form(tree) or "points"]
    found: list[tuple[str, Entry]] = []
    for path, title in parts(tree):
        names = wanted.get(path.partition("[")[0], ())
        if names:
            entries = {one.name: one for one in section(tree, path).entries}
            found += [(title, entries[name]) for name in names if name in entries]
    return found


def _changed(tree: Mapping[str, Any], drive: Drive, path: str, at: Point) -> Iterator[tuple[str, Any]]:
    """Yield the keys that put a point of a drive elsewhere [m], as the file spells them, with their values then."""
    entries = [one for _title, one in _geometry(tree)]
    if drive.form == "points":  # also where that makes no drive: the file says why
        entry = next(one for one in entries if one.path == path)
        yield entry.key(), [float(f"{x / entry.units[entry.unit]:.9g}") for x in at]
        return
    after = with_point(drive, path, at)
    for entry in entries:
        old, new = (float(read(one, entry.key()) or 0.0) for one in (drive, after))
        if abs(new - old) > SPECK:
            yield entry.key(), round(new, 6)


def _points(tree: Mapping[str, Any], drive: Drive) -> list[dict[str, Any]]:
    """Return the points of a drive as the views show them, with whether they can be put elsewhere."""
    mm = DIMENSIONS["length"]["mm"]
    names = {path: title for path, title in parts(tree)}
    return [
        {
            "path": path,
            "name": names.get(path, path),
            "short": str(int(path[7:-1]) + 1) if path.startswith("joints[") else "",
            "at": [round(x / mm, 6) for x in at],
            "end": not path.startswith("joints["),
            "fixed": not free,
        }
        for path, (at, free) in movable(drive).items()
    ]
