"""What an answer lacks in the drive file, as fields to fill in with a value such as others have."""

from __future__ import annotations

from functools import partial

from nicegui import ui
from nicegui.element import Element

from cardan.answers.question import Lacking
from cardan.app.state.form import Entry, section
from cardan.app.state.session import Session
from cardan.drive.fields.keys import key_of
from cardan.drive.fields.wording import counted
from cardan.io.amend import insert
from cardan.io.keys import file_keys, written_in_examples
from cardan.texts import _
from cardan.units import label

from .form import NEW, KeyField, apply, attempt


class Offer:
    """The keys that an answer needs: of each several that would do, the first that is a single value, and the rest."""

    def __init__(self, session: Session) -> None:
        self.session = session
        self._rows: dict[tuple[str, ...], Element] = {}
        with ui.element("div").classes("offer").props('data-mark="offer"') as self.body:
            ui.label(_("Give what is missing here; it goes into the drive file.")).classes("head")
        self.body.set_visibility(False)

    def show(self, lacking: Lacking) -> None:
        """Offer what is lacking now; what somebody is writing in stays as it is."""
        self.body.set_visibility(bool(lacking))
        for group in [one for one in self._rows if one not in lacking]:
            self._rows.pop(group).delete()
        with self.body, self.session.speaking():
            for group in lacking:
                if group not in self._rows:
                    with ui.element("div").classes("keys") as self._rows[group]:
                        self._row(group)

    def _row(self, group: tuple[str, ...]) -> None:
        entries = {path: self._entry(path) for path in group}
        single = [path for path, one in entries.items() if one is not None and one.sort not in ("table", "tables")]
        chosen = next(iter(single), group[0])
        entry = entries[chosen]
        if entry is not None and chosen in single:
            field = KeyField(self.session, entry, removable=False)
            like = _like(chosen, entry.unit)
            if like and hasattr(field.widget, "_props"):
                field.widget.props["placeholder"] = like
        else:
            title = _("add {key}").format(key=counted(key_of(chosen)))
            button = ui.button(title, icon="add", on_click=lambda: self._begin(chosen))
            button.props(f'outline dense no-caps size=sm data-mark="add-{chosen}"')
        others = [counted(key_of(path)) for path in group if path != chosen]
        if others:
            ui.label(_("or {keys}").format(keys=_(" or ").join(others))).classes("hint")

    def _entry(self, path: str) -> Entry | None:
        table, _dot, name = path.rpartition(".")
        tree = self.session.document.tree
        if tree is None or not table:
            return None
        return next((one for one in section(tree, table).entries if one.name == name), None)

    def _begin(self, path: str) -> None:
        """Begin a table of the file."""
        if path in NEW:
            attempt(self.session, partial(insert, path=f"{path}[0]", values=NEW[path]))
            self.session.select(f"{path}[0]")
        else:
            apply(self.session, {path: {}})
            self.session.select(path.rpartition(".")[0])


def _like(path: str, beside: str) -> str:
    """Return a value that a shipped example gives the key of a path, with its unit where another one stands beside."""
    for key in file_keys(path)[:1]:
        name, _sign, value = written_in_examples(key).partition(" = ")
        unit = next((unit for unit in key.units if name.endswith(f"_{unit}")), "")
        return (
            _("such as {value}").format(value=f"{value} {'' if unit == beside else label(unit)}".strip())
            if value
            else ""
        )
    return ""
