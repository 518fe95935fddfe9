"""The left side of the page: the drive file as a form, as its geometry, as text."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any

from nicegui import events, ui
from nicegui.element import Element

from cardan.app.state.form import Entry, geometry_form, parts, section
from cardan.app.state.session import Session
from cardan.io.amend import amend
from cardan.texts import _
from cardan.units import DIMENSIONS

from .form import Form, KeyField, attempt
from .widgets import Timer, first


class Editor:
    """The drive file, in three ways that stay in step."""

    def __init__(self, session: Session) -> None:
        self.session = session
        with ui.tabs().props("dense no-caps inline-label align=left narrow-indicator").classes("ways") as tabs:
            form = ui.tab("form", label=_("Form")).props('data-mark="way-form"')
            lies = ui.tab("geometry", label=_("Geometry")).props('data-mark="way-geometry"')
            text = ui.tab("file", label=_("File")).props('data-mark="way-file"')
        self.problems = ui.element("div").classes("problems").props("role=status").props('data-mark="problems"')
        with ui.tab_panels(tabs, value=form, animated=False, keep_alive=True).classes("way"):
            with ui.tab_panel(form):
                Form(session)
            with ui.tab_panel(lies):
                centres = Centres(session)
            with ui.tab_panel(text):
                Source(session)
        tabs.on_value_change(lambda event: centres.wake() if event.value == "geometry" else None)
        self._judge()
        session.listen("text", self._judge)

    def _judge(self) -> None:
        """Say what is wrong with the file, whatever way is open."""
        found = self.session.document.problems
        self.problems.clear()
        self.problems.set_visibility(bool(found))
        with self.problems:
            for problem in found[:4]:
                ui.label(str(problem)).classes("wrong")
            if len(found) > 4:
                ui.label(_("and {count} more").format(count=len(found) - 4)).classes("wrong")


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
        self.text.classes("source").props('data-mark="source"').props(f'aria-label="{_("text of the drive file")}"')
        self.problems = ui.element("div").classes("problems").props("role=status")
        self._judge()
        session.listen("text", self._follow)
        session.listen("choices", self._theme)

    def _typed(self) -> None:
        if self._silent:
            return
        if self._due is not None:
            self._due.cancel()
        self._due = Timer(self.session, self.text, QUIET, self._read, once=True)

    def _read(self) -> None:
        self._due = None
        if self.text.value == self._lines():
            return
        ends = "\r\n" if "\r\n" in self.session.document.text else "\n"
        self._silent = True
        try:
            self.session.rewrite(self.text.value.replace("\n", ends))
        finally:
            self._silent = False

    def _lines(self) -> str:
        """Return the text with the one end of a line that the browser counts."""
        return self.session.document.text.replace("\r\n", "\n")

    def _follow(self) -> None:
        if not self._silent and self.text.value != self._lines():
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
            self._build(found)
            self._shape = shape
        for _title, entry in found:
            self.fields[entry.key()].show(entry)
        self._draw()

    def _build(self, found: list[tuple[str, Entry]]) -> None:
        self.fields = {}
        self.body.clear()
        with self.body:
            before = ""
            for title, entry in found:
                if title != before:
                    ui.label(title).classes("of")
                before = title
                self.fields[entry.key()] = KeyField(self.session, entry, removable=False)

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
        tree = self.session.document.tree or {}
        entry = next((one for _title, one in _geometry(tree) if one.path == path and one.size == 3), None)
        if entry is None or not _sound(at):
            return
        share = DIMENSIONS["length"]["mm"] / entry.units[entry.unit]
        value = [float(f"{float(x) * share:.9g}") for x in at]
        gesture = f"drag {path}"
        attempt(self.session, partial(amend, values={entry.key(): value}), gesture=gesture)
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


def _points(tree: Mapping[str, Any], drive: Any) -> list[dict[str, Any]]:
    """Return the points of a drive given by points, as the views show them; none for another form."""
    if drive.form != "points" or drive.input.point is None or drive.output.point is None:
        return []
    mm = DIMENSIONS["length"]["mm"]
    ends = {"input": drive.input.point, "output": drive.output.point}
    inner = {f"joints[{k}]": joint.centre for k, joint in enumerate(drive.joints)}
    rows = {"input": ends["input"], **inner, "output": ends["output"]}
    names = {path: title for path, title in parts(tree)}
    return [
        {
            "path": path,
            "name": names.get(path, path),
            "short": path[7:-1] and str(int(path[7:-1]) + 1) if path in inner else "",
            "at": [round(x / mm, 6) for x in at],
            "end": path in ends,
        }
        for path, at in rows.items()
        if at is not None
    ]
