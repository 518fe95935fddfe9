"""The drive file as a form: its tables one below the other, each with its keys."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from nicegui import ui

from cardan.app.state.form import Entry, Section, parts, problems_of, section, tables
from cardan.app.state.session import Session
from cardan.io.amend import insert
from cardan.io.restructure import joint_moved, with_joint, without_joint
from cardan.texts import _

from .fields import KeyField, apply, attempt
from .menus import drop_down

NEW: dict[str, Mapping[str, Any]] = {
    "supports": {"shaft": 1, "position_mm": -100},
    "stations": {"shaft": 1, "inertia_kg_m2": 0.1},
    "movements": {"kind": "harmonic", "moves": ["output"], "amplitude_mm": [0, 0, 10], "frequency_Hz": 1},
    "poses": {"name": "pose", "set": {"joints[0].friction": 0.05}},
}
"""What a new table of a list starts with."""


class Form:
    """The file as a form.

    session: whose file it shows and changes.
    """

    def __init__(self, session: Session) -> None:
        self.session = session
        self.tables: dict[str, Table] = {}
        self.body = ui.element("div").classes("form")
        self._paths: tuple[str, ...] = ()
        self._fill()
        session.listen("text", self._follow)
        session.listen("selection", self._selected)

    def _fill(self) -> None:
        tree = self.session.document.tree
        if tree is None:
            return
        opened = {path for path, table in self.tables.items() if table.opened} or {"joints[0]"}
        self.tables = {}
        self.body.clear()
        with self.body:
            for path, title in parts(tree):
                self.tables[path] = Table(self.session, path, title, opened=path in opened)
            self._adders()
        self._paths = tuple(self.tables)

    def _follow(self) -> None:
        tree = self.session.document.tree
        if tree is None:
            return
        found = dict(parts(tree))
        if tuple(found) != self._paths:
            self._fill()
            return
        for path, title in found.items():
            self.tables[path].follow(tree, title)

    def _selected(self) -> None:
        wanted = self.session.selected
        path = next((one for one in (wanted, wanted.partition(".")[0]) if one in self.tables), None)
        if path is not None:
            self.tables[path].open(wanted)

    def _adders(self) -> None:
        with ui.element("div").classes("adders"):
            names = {
                "supports": _("support"),
                "stations": _("station"),
                "movements": _("movement"),
                "poses": _("pose"),
            }
            with drop_down(_("add"), "add", icon="add"):
                ui.item(_("joint"), on_click=lambda: self._add_joint())
                for name, title in names.items():
                    ui.item(title, on_click=lambda name=name: self._add(name))

    def _add_joint(self) -> None:
        tree = self.session.document.tree or {}
        at = len(tables(tree, "joints"))
        attempt(self.session, lambda text: with_joint(text, at))
        self.session.select(f"joints[{at}]")

    def _add(self, name: str) -> None:
        tree = self.session.document.tree or {}
        at = len(tables(tree, name))
        attempt(self.session, lambda text: insert(text, f"{name}[{at}]", NEW[name]))
        self.session.select(f"{name}[{at}]")


class Table:
    """A table of the file, folded until it is opened."""

    def __init__(self, session: Session, path: str, title: str, *, opened: bool = False) -> None:
        self.session, self.path = session, path
        self.fields: dict[str, KeyField | Table] = {}
        self.built = False
        self._shape: tuple[Any, ...] = ()
        self.fold = ui.expansion(title, value=opened, on_value_change=self._opened).classes("table")
        self.fold.props("dense expand-separator switch-toggle-side").props(
            'data-mark="table-' + (path or "drive") + '"'
        )
        with self.fold:
            self.body = ui.element("div").classes("keys")
        if opened:
            self._build()
        self._judge()

    @property
    def opened(self) -> bool:
        """Whether its keys are seen."""
        return bool(self.fold.value)

    def open(self, path: str) -> None:
        """Show its keys and bring one into sight."""
        self.fold.value = True
        inner = next((one for key, one in self.fields.items() if path.startswith(key) and isinstance(one, Table)), None)
        if inner is not None:
            inner.open(path)
        elif not self.fold.is_deleted:
            ui.run_javascript(f"getElement({self.fold.id})?.$el.scrollIntoView({{block:'nearest',behavior:'smooth'}})")

    def follow(self, tree: Mapping[str, Any], title: str) -> None:
        """Show what stands in the file now."""
        if self.fold.text != title:
            self.fold.text = title
        self._judge()
        if not self.built:
            return
        now = section(tree, self.path)
        if _shape(now) != self._shape:
            self._build()
            return
        for entry in now.given:
            held = self.fields.get(entry.key())
            if isinstance(held, KeyField):
                held.show(entry)
        for held in self.fields.values():
            if isinstance(held, Table):
                held.follow(tree, held.fold.text)

    def _judge(self) -> None:
        bad = bool(problems_of(self.path, self.session.document.problems)) if self.path else False
        self.fold.classes(add="bad" if bad else "", remove="" if bad else "bad")

    def _opened(self) -> None:
        if self.opened and not self.built:
            with self.session.speaking():
                self._build()
        if self.opened and self.path:
            self.session.select(self.path)

    def _build(self) -> None:
        tree = self.session.document.tree or {}
        now = section(tree, self.path)
        inner = {key for key, one in self.fields.items() if isinstance(one, Table) and one.opened}
        self.built, self._shape, self.fields = True, _shape(now), {}
        self.body.clear()
        with self.body:
            self._kinds(now)
            for entry in now.given:
                self._entry(entry, inner)
            self._more(now)
            self._tools(now)

    def _entry(self, entry: Entry, inner: set[str]) -> None:
        key = entry.key()
        title = entry.name.replace("_", " ")
        if entry.sort == "tables" and isinstance(entry.value, list):
            for k in range(len(entry.value)):
                path = f"{key}[{k}]"
                self.fields[path] = Table(self.session, path, f"{title} {k + 1}", opened=path in inner)
        elif entry.sort == "table" or (entry.sort == "named" and isinstance(entry.value, Mapping)):
            self.fields[key] = Table(self.session, key, title, opened=key in inner)
        elif entry.sort == "changes":
            ui.label(_("The changes of a pose are written in the file: path = value.")).classes("hint")
        else:
            self.fields[key] = KeyField(self.session, entry)

    def _kinds(self, now: Section) -> None:
        if len(now.kinds) < 2:
            return
        with ui.element("div").classes("line"):
            ui.label(_("kind")).classes("name")
            kinds = list(dict.fromkeys([*now.kinds, now.kind]))  # also one that there is not: the loader says so
            ui.select(kinds, value=now.kind, on_change=lambda event: self._kind(event.value)).props(
                f'dense outlined aria-label="{_("kind")}" title="{_("kind")}"'
            ).props(f'data-mark="kind-{self.path}"')

    def _kind(self, kind: str) -> None:
        apply(self.session, {f"{self.path}.kind": kind})

    def _more(self, now: Section) -> None:
        possible = [one for one in now.possible if one.sort != "changes"]
        if not possible:
            return
        options = {one.name: f"{one.name.replace('_', ' ')} – {one.doc}" for one in possible}
        chosen = ui.select(options, with_input=True, label=_("add a key …"), value=None)
        chosen.props("dense borderless options-dense clearable").classes("more").props(
            'data-mark="more-' + (self.path or "drive") + '"'
        )

        def added() -> None:
            entry = next((one for one in possible if one.name == chosen.value), None)
            if entry is not None:
                with self.session.speaking():
                    self._begin(entry, chosen)

        chosen.on_value_change(added)

    def _begin(self, entry: Entry, before: Any) -> None:
        """Show an empty field for a key, or write a new table."""
        if entry.sort == "tables":
            attempt(self.session, lambda text: insert(text, f"{entry.key()}[0]", {}))
        elif entry.sort == "table":
            apply(self.session, {entry.key(): {}})
        else:
            before.value = None
            with self.body:
                KeyField(self.session, entry).row.move(target_index=before.parent_slot.children.index(before))

    def _tools(self, now: Section) -> None:
        with ui.element("div").classes("tools"):
            if self.path.startswith("joints[") and "." not in self.path:
                at = int(self.path[7:-1])
                _tool(
                    "arrow_upward",
                    _("earlier in the chain"),
                    self._changing(lambda text: joint_moved(text, at, at - 1)),
                )
                _tool(
                    "arrow_downward",
                    _("later in the chain"),
                    self._changing(lambda text: joint_moved(text, at, at + 1)),
                )
                _tool("add", _("a joint after this one"), self._changing(lambda text: with_joint(text, at + 1)))
                _tool("delete", _("take this joint out"), self._changing(lambda text: without_joint(text, at)))
            elif now.removable:
                _tool("delete", _("take this out"), lambda: apply(self.session, {now.removable: None}))
            if now.removable.endswith("]") and "." in now.removable:
                _tool("add", _("another one"), self._another)

    def _another(self) -> None:
        stem, _bracket, place = self.path[:-1].rpartition("[")
        attempt(self.session, lambda text: insert(text, f"{stem}[{int(place) + 1}]", {}))

    def _changing(self, change: Callable[[str], str]) -> Callable[[], None]:
        return lambda: attempt(self.session, change)


def _tool(icon: str, title: str, act: Callable[[], None]) -> None:
    ui.button(icon=icon, on_click=act).props(f'flat dense round size=sm aria-label="{title}"').tooltip(title)


def _shape(now: Section) -> tuple[Any, ...]:
    """Return what decides which fields a table has."""
    return (
        now.kind,
        *(
            (one.key(), len(one.value) if one.sort == "tables" and isinstance(one.value, list) else 0)
            for one in now.given
        ),
    )
