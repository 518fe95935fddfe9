"""One key of the drive file as a field to fill in."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from nicegui import ui

from cardan.app.state.form import LONG, Entry, converted, problems_of, shown, written
from cardan.app.state.session import Session
from cardan.errors import InputError
from cardan.io.amend import amend
from cardan.texts import _
from cardan.units import label

from . import toasts

AXES = ("x", "y", "z")

TYPED = "(value) => emit(value?.target ? value.target.value : value)"
"""Sends what was typed with the event itself, so that no other message has to come before it."""


class Triple:
    """Three numbers beside each other, of a point or a direction.

    value: the three, with blanks between; typed: called with all three once one of them changed.
    """

    def __init__(self, value: str, told: str, typed: Callable[[str], None]) -> None:
        self._typed = typed
        with ui.element("div").classes("triple"):
            self._inputs = [
                ui.input(prefix=axis, value=part).props(f'dense outlined aria-label="{told} {axis}"')
                for axis, part in zip(AXES, self._parts(value), strict=True)
            ]
        for place, one in enumerate(self._inputs):
            one.on("change", lambda event, place=place: self._changed(place, str(event.args)), js_handler=TYPED)

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

    def _changed(self, place: int, part: str) -> None:
        parts = ["".join(str(one.value or "").split()) for one in self._inputs]
        parts[place] = "".join(part.split())
        if all(parts):
            self._typed(" ".join(parts))

    @staticmethod
    def _parts(text: str) -> list[str]:
        return [*text.split(), "", "", ""][:3]


class KeyField:
    """A key: its name, what stands there, its unit, what is wrong with it.

    removable: show what takes the key out of the file.
    """

    def __init__(self, session: Session, entry: Entry, *, removable: bool = True) -> None:
        self.session = session
        self.entry = entry
        self._silent = False
        with ui.element("div").classes("key").props(f'data-mark="key-{entry.key()}"') as self.row:
            with ui.element("div").classes("line"):
                name = ui.label(entry.name.replace("_", " ")).classes("name")
                name.tooltip(entry.doc)
                self.widget = self._widget()
                self._unit()
                if removable and not entry.required:
                    out = ui.button(icon="close", on_click=self.remove).props("flat dense round size=xs")
                    out.props(f'aria-label="{_("take out")} {entry.name}"')
            ui.label(entry.doc).classes("hint")
            self.wrong = ui.label("").classes("wrong").props("role=alert")
        self.judge()

    def show(self, entry: Entry) -> None:
        """Show what stands there now, without moving anything."""
        self.entry = entry
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
            return Triple(shown(entry), f"{entry.name} {label(entry.unit)}", self._typed)
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
        widget.on("change", lambda event: self._typed(event.args), js_handler=TYPED)
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

    def _typed(self, value: Any) -> None:
        if self._silent:
            return
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
    attempt(session, lambda text: amend(text, values))


def attempt(session: Session, change: Callable[[str], str], *, gesture: str = "") -> None:
    """Change the file; say why where it cannot be."""
    try:
        session.change(change, gesture=gesture)
    except InputError as error:
        toasts.refused(error)
