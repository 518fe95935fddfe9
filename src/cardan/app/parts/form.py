"""The drive file as a form: its tables one below the other, each with its keys."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

from nicegui import background_tasks, ui

from cardan.app.state.form import LONG, Entry, Section, converted, parts, problems_of, section, shown, tables, written
from cardan.app.state.session import Session
from cardan.errors import InputError
from cardan.io.amend import amend, insert, joint_moved, with_joint, without_joint
from cardan.texts import _
from cardan.units import label

from . import widgets as toasts
from .widgets import drop_down, menu_item

SLICE = 10  # tables that are built at a time
PAUSE = 0.02  # seconds between them

NEW: dict[str, Mapping[str, Any]] = {
    "supports": {"shaft": 1, "position_mm": -100},
    "stations": {"shaft": 1, "inertia_kg_m2": 0.1},
    "movements": {"kind": "harmonic", "moves": ["output"], "amplitude_mm": [0, 0, 10], "frequency_Hz": 1},
    "poses": {"name": "pose", "set": {"joints[0].friction": 0.05}},
}
"""What a new table of a list starts with."""


class Form:
    """The file as a form."""

    def __init__(self, session: Session) -> None:
        self.session = session
        self.tables: dict[str, Table] = {}
        with ui.element("div").classes("form"):
            self.body = ui.element("div")
            self._adders()
        self._paths: tuple[str, ...] = ()
        self._fill()
        session.listen("text", self._follow)
        session.listen("selection", self._selected)

    def _fill(self) -> None:
        tree = self.session.document.tree
        if tree is None:
            return
        opened = {path for path, table in self.tables.items() if table.opened} or {"joints[0]"}
        found = list(parts(tree))
        self._paths = tuple(path for path, _title in found)
        self.tables = {}
        self.body.clear()
        self._build(found[:SLICE], opened)
        if found[SLICE:]:
            background_tasks.create(self._rest(self._paths, found[SLICE:], opened), name="tables of a long form")

    def _build(self, found: Sequence[tuple[str, str]], opened: set[str]) -> None:
        with self.body:
            for path, title in found:
                self.tables[path] = Table(self.session, path, title, opened=path in opened)

    async def _rest(self, paths: tuple[str, ...], found: Sequence[tuple[str, str]], opened: set[str]) -> None:
        """Build the rest of a long form a few tables at a time, so that other windows need not wait for it."""
        for k in range(0, len(found), SLICE):
            await asyncio.sleep(PAUSE)
            if self.body.is_deleted or self._paths is not paths:
                return
            with self.session.speaking():
                self._build(found[k : k + SLICE], opened)
        self._selected()

    def _follow(self) -> None:
        tree = self.session.document.tree
        if tree is None:
            return
        found = dict(parts(tree))
        if tuple(found) != self._paths:
            self._fill()
            return
        for path, table in self.tables.items():
            table.follow(tree, found[path])

    def _selected(self) -> None:
        wanted = self.session.selected
        if not wanted:
            return
        path = next((one for one in (wanted, wanted.partition(".")[0]) if one in self.tables), None)
        if path is not None:
            self.tables[path].open(wanted)

    def _adders(self) -> None:
        with ui.element("div").classes("adders"):
            names = {
                "supports": _("support"),
                "joints": _("joint"),
                "stations": _("station"),
                "movements": _("movement"),
                "poses": _("pose"),
            }
            with drop_down(_("add"), "add", icon="add"):
                for name, title in names.items():
                    add = self._add_joint if name == "joints" else partial(self._add, name)
                    menu_item(title, add, f"add-{name}")

    def _add_joint(self) -> None:
        tree = self.session.document.tree or {}
        at = len(tables(tree, "joints"))
        attempt(self.session, partial(with_joint, at=at))
        self.session.select(f"joints[{at}]")

    def _add(self, name: str) -> None:
        tree = self.session.document.tree or {}
        at = len(tables(tree, name))
        attempt(self.session, partial(insert, path=f"{name}[{at}]", values=NEW[name]))
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
        options = {one.name: f"{one.doc} ({one.name.replace('_', ' ')})" for one in possible}
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
            attempt(self.session, partial(insert, path=f"{entry.key()}[0]", values={}))
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
                act = self._changing(partial(joint_moved, at=at, to=at - 1))
                _tool("arrow_upward", _("earlier in the chain"), act)
                act = self._changing(partial(joint_moved, at=at, to=at + 1))
                _tool("arrow_downward", _("later in the chain"), act)
                _tool("add", _("a joint after this one"), self._changing(partial(with_joint, at=at + 1)))
                _tool("delete", _("take this joint out"), self._changing(partial(without_joint, at=at)))
            elif now.removable:
                _tool("delete", _("take this out"), lambda: apply(self.session, {now.removable: None}))
            if now.removable.endswith("]") and "." in now.removable:
                _tool("add", _("another one"), self._another)

    def _another(self) -> None:
        stem, _bracket, place = self.path[:-1].rpartition("[")
        attempt(self.session, partial(insert, path=f"{stem}[{int(place) + 1}]", values={}))

    def _changing(self, change: Callable[[str], str]) -> Callable[[], None]:
        return lambda: attempt(self.session, change)


def _tool(icon: str, title: str, act: Callable[[], None]) -> None:
    ui.button(icon=icon, on_click=act).props(f'flat dense round size=sm aria-label="{title}" title="{title}"')


def _shape(now: Section) -> tuple[Any, ...]:
    """Return what decides which fields a table has."""
    return (
        now.kind,
        *(
            (one.key(), len(one.value) if one.sort == "tables" and isinstance(one.value, list) else 0)
            for one in now.given
        ),
    )


# One key of the drive file as a field to fill in.

AXES = ("x", "y", "z")

TYPED = "(value) => emit(value?.target ? value.target.value : value)"
"""Sends what was typed with the event itself, so that no other message has to come before it."""

SPUN = "(event) => emit(event.detail)"
"""Sends what a number has come to that is on the move, see static/numbers.js."""

NUMBER = "inputmode=decimal"


class Triple:
    """Three numbers beside each other, of a point or a direction.

    value: the three, with blanks between; typed: called with all three once one of them changed; spun: likewise while
    one is on the move; written: called with every letter.
    """

    def __init__(
        self,
        value: str,
        told: str,
        typed: Callable[[str], None],
        spun: Callable[[str], None],
        written: Callable[[], None],
    ) -> None:
        with ui.element("div").classes("triple"):
            self._inputs = [
                ui.input(prefix=axis, value=part).props(f'dense outlined aria-label="{told} {axis}" {NUMBER}')
                for axis, part in zip(AXES, self._parts(value), strict=True)
            ]
        for place, one in enumerate(self._inputs):
            one.on_value_change(written)
            one.on("change", lambda event, place=place: self._changed(place, str(event.args), typed), js_handler=TYPED)
            one.on("spin", lambda event, place=place: self._changed(place, str(event.args), spun), js_handler=SPUN)

    @property
    def value(self) -> str:
        """The three, with blanks between; empty while any is missing."""
        parts = ["".join(str(one.value or "").split()) for one in self._inputs]
        return " ".join(parts) if all(parts) else ""

    @value.setter
    def value(self, text: str) -> None:
        for one, part in zip(self._inputs, self._parts(text), strict=True):
            if one.value != part:
                one.value = part

    def _changed(self, place: int, part: str, told: Callable[[str], None]) -> None:
        parts = ["".join(str(one.value or "").split()) for one in self._inputs]
        parts[place] = "".join(part.split())
        if all(parts):
            told(" ".join(parts))

    @staticmethod
    def _parts(text: str) -> list[str]:
        return [*text.split(), "", "", ""][:3]


class KeyField:
    """A key: its name, what stands there, its unit, what is wrong with it."""

    def __init__(self, session: Session, entry: Entry, *, removable: bool = True) -> None:
        self.session = session
        self.entry = entry
        self._silent = False
        self._spinning = False
        self._writing = False
        with ui.element("div").classes("key").props(f'data-mark="key-{entry.key()}"') as self.row:
            with ui.element("div").classes("line"):
                name = ui.label(entry.name.replace("_", " ")).classes("name")
                name.props["title"] = entry.doc
                self.widget = self._widget()
                self._unit()
                if removable and not entry.required:
                    out = ui.button(icon="close", on_click=self.remove).props("flat dense round size=xs")
                    out.props(f'aria-label="{_("take out")} {entry.name}"')
            ui.label(entry.doc).classes("hint")
            self.row.on("spun", self._let_go, js_handler="() => emit()")
            self.row.on("focusout", self._left, js_handler="() => emit()")
            self.wrong = ui.label("").classes("wrong").props("role=alert")
        self.judge()

    def show(self, entry: Entry) -> None:
        """Show what stands there now, without moving anything; a hand that writes or moves a number is ahead of it."""
        self.entry = entry
        if self._spinning or self._writing:
            self.judge()
            return
        self._silent = True
        value = self._value()
        if isinstance(self.widget, ui.select) and value is not None and value not in self.widget.options:
            self.widget.set_options([*self.widget.options, value])
        if self.widget.value != value:
            self.widget.value = value
        self._silent = False
        self.judge()

    def judge(self) -> None:
        """Show what is wrong with it."""
        path = f"{self.entry.path}.{self.entry.name}" if self.entry.path else self.entry.name
        found = problems_of(path, self.session.document.problems, self.entry.units)
        self.wrong.set_text(" ".join(found))
        self.wrong.set_visibility(bool(found))
        self.row.classes(add="bad" if found else "", remove="" if found else "bad")

    def remove(self) -> None:
        """Take the key out of the file."""
        apply(self.session, {self.entry.key(): None})

    def _value(self) -> Any:
        if self.entry.sort == "flag":
            return self.entry.default if self.entry.value is None else bool(self.entry.value)
        text = shown(self.entry)
        return (text or None) if self.entry.sort == "choice" else text

    def _widget(self) -> Any:
        entry = self.entry
        told = f'dense outlined aria-label="{entry.name} {label(entry.unit)}"'
        if entry.sort == "point" and entry.size == 3:
            self.row.classes("wide")
            told = f"{entry.name} {label(entry.unit)}"
            return Triple(shown(entry), told, self._typed, self._spun, self._written)
        if entry.sort == "flag":
            return ui.switch(value=bool(self._value()), on_change=lambda event: self._typed(event.value)).props(told)
        if entry.sort == "choice":
            options = list(dict.fromkeys([*entry.choices, *([shown(entry)] if entry.given else [])]))
            chosen = ui.select(options, value=self._value(), on_change=lambda event: self._typed(event.value))
            return chosen.props(told).props(f'title="{entry.name}"')
        if entry.name in LONG:
            widget: Any = ui.textarea(value=shown(entry)).props(f"{told} autogrow")
        else:
            widget = ui.input(value=shown(entry), autocomplete=list(entry.offered) or None).props(told)
        if not entry.given and isinstance(entry.default, int | float | str) and entry.default != "":
            widget.props(f'placeholder="{entry.default}"')
        widget.on_value_change(self._written).on("change", lambda event: self._typed(event.args), js_handler=TYPED)
        if entry.sort in ("number", "whole"):
            widget.props(NUMBER).on("spin", lambda event: self._spun(str(event.args)), js_handler=SPUN)
        return widget

    def _unit(self) -> None:
        entry = self.entry
        if len(entry.units) < 2:
            if entry.unit:
                ui.label(label(entry.unit)).classes("unit")
            return
        options = {unit: label(unit) for unit in entry.units}
        chosen = ui.select(options, value=entry.unit, on_change=lambda event: self._turned(event.value))
        told = f"{_('unit of')} {entry.name}"  # the title is what Quasar passes on to the element with the focus
        chosen.props(f'dense borderless options-dense aria-label="{told}" title="{told}"').classes("unit")

    def _spun(self, text: str) -> None:
        """Take a number that is on the move: all its steps are one of undo."""
        self._spinning = True
        new = written(self.entry, text)
        if new != self.entry.value:
            key = self.entry.key()
            attempt(self.session, partial(amend, values={key: new}), gesture=f"spin {key}")

    def _let_go(self) -> None:
        """End the move: the field follows the file again."""
        self.session.end_gesture()
        self._spinning = self._writing = False
        self.show(self.entry)

    def _written(self) -> None:
        """Note that somebody is writing in it."""
        self._writing = not self._silent

    def _left(self) -> None:
        """End the writing: the field follows the file again."""
        if self._writing:
            self._writing = False
            self.show(self.entry)

    def _typed(self, value: Any) -> None:
        if self._silent:
            return
        self._writing = False
        if self.entry.sort == "flag":
            new: Any = bool(value)
        elif self.entry.sort == "choice" and value in ("true", "false"):
            new = value == "true"
        else:
            new = written(self.entry, str(value or ""))
        if new != self.entry.value:
            apply(self.session, {self.entry.key(): new})

    def _turned(self, unit: str) -> None:
        """Write the same amount in another unit."""
        entry = self.entry
        if unit != entry.unit:
            value = converted(entry, unit) if entry.given else None
            if value is not None:
                apply(self.session, {entry.key(unit): value})


def apply(session: Session, values: dict[str, Any]) -> None:
    """Change keys of the file; say why where it cannot be."""
    attempt(session, partial(amend, values=values))


def attempt(session: Session, change: Callable[[str], str], *, gesture: str = "") -> None:
    """Change the file; say why where it cannot be."""
    with session.speaking():
        try:
            session.change(change, gesture=gesture)
        except InputError as error:
            toasts.refused(error)
