"""The tab of the sweep: keys of the drive vary, results are asked at every point, drawn, listed and taken along."""

from __future__ import annotations

import asyncio
from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import Any

from nicegui import background_tasks, events, ui

from cardan.app.state.form import numbers_in
from cardan.app.state.jobs import Jobs
from cardan.app.state.session import Session
from cardan.app.state.work import SWEEP, safe
from cardan.errors import InputError
from cardan.report.block import Picture
from cardan.report.swept import KEYS, MOST, STEPS, Swept, Varied, choices, usual
from cardan.texts import _, speaking

from . import widgets
from .answers import Sheet
from .blocks import Export

PLAN = "sweep.toml"  # name of the plan file
TABLE = "sweep.csv"


class Sweep(Sheet):
    """A sweep over keys of the drive.

    session: whose drive and sweep it is; jobs: where it is made; export: takes a figure or the page along.
    """

    def __init__(self, session: Session, jobs: Jobs, export: Export | None) -> None:
        super().__init__(SWEEP, session, jobs, export)
        self._found: Swept | None = None
        self._drawn = ""
        with self.body:
            self._varied = ui.element("div").classes("recording")
            with ui.element("div").classes("recording") as told:
                self._ask = ui.select({}, multiple=True, label=_("results asked for"))
                self._ask.props('dense options-dense outlined use-chips data-mark="sweep-ask"').classes(
                    "choice results"
                )
                self._ask.on_value_change(lambda event: self._say(ask=tuple(event.value or ())))
                run = ui.button(_("Calculate"), icon="play_arrow", on_click=self.run)
                run.props('unelevated dense no-caps data-mark="sweep-run"')
                plan = ui.button(_("Plan file"), icon="download", on_click=self._plan).props("flat dense no-caps")
                plan.props('data-mark="sweep-plan"')
                self._table = ui.button(_("Table (CSV)"), icon="download", on_click=self._csv)
                self._table.props('flat dense no-caps data-mark="sweep-table"').set_visibility(False)
                self._shown = ui.select({}, label=_("chart of")).classes("choice results")
                self._shown.props('dense options-dense outlined data-mark="sweep-chart"').set_visibility(False)
                self._shown.on_value_change(lambda event: self._draw(str(event.value or "")))
                text = _("At most {most} points here; cardan sweep runs more from the plan file, on many machines too.")
                ui.label(text.format(most=MOST)).classes("hint wide")
        self._known: tuple[str, ...] = ()
        self._varied.move(target_index=0)
        told.move(target_index=1)
        self._offer_keys_to_vary()
        background_tasks.create(self._offer_results(), name="what a sweep may ask")

    @property
    def quick(self) -> bool:
        """Never: it is a process of its own."""
        return False

    def wake(self) -> None:
        """Wait for the user to ask: what he wants is not known before."""
        if set(self._known) != set(self._numbers()):
            self._offer_keys_to_vary()
        if self.job is not None:
            super().wake()

    def follow(self) -> None:
        """Follow an edit once a sweep was asked for."""
        if self.job is not None:
            super().follow()

    def run(self) -> None:
        """Make the sweep, or say what is wrong with it."""
        with self.session.speaking():
            try:
                self.session.sweep.axes()
            except InputError as error:
                widgets.refused(error)
                return
            self.begin()

    def begin(self) -> None:
        """Answer now."""
        self._choices = {"wanted": self.session.sweep}
        super().begin()

    def _say(self, **changes: Any) -> None:
        self.session.sweep = replace(self.session.sweep, **changes)

    async def _offer_results(self) -> None:
        language = self.session.choices.language

        def known() -> Mapping[str, str]:
            with speaking(language):
                return choices()

        found = await asyncio.to_thread(known)
        if not self.body.is_deleted:
            self._ask.set_options(dict(found), value=list(self.session.sweep.ask))

    def _numbers(self) -> tuple[str, ...]:
        return tuple(numbers_in(self.session.document.tree or {}))

    def _offer_keys_to_vary(self) -> None:
        """Show what varies, and how another key does."""
        self._varied.clear()
        self._known = self._numbers()
        vary = self._vary
        with self._varied:
            for k in range(len(vary)):
                with ui.element("div").classes("line").props(f'data-mark="sweep-vary-{k}"'):
                    self._key(k)
                    if len(vary) > 1:
                        out = ui.button(icon="close", on_click=partial(self._drop, k)).props("flat dense round size=sm")
                        out.props(f'aria-label="{_("take out")} {k + 1}"')
            if len(vary) < KEYS:
                more = ui.button(_("another key"), icon="add", on_click=self._add)
                more.props('flat dense no-caps size=sm data-mark="sweep-more"')

    @property
    def _vary(self) -> tuple[Varied, ...]:
        """What varies; to begin with a key that is not named yet."""
        return self.session.sweep.vary or (("", None, None, STEPS),)

    def _key(self, k: int) -> None:
        """Ask which key varies, between which values."""
        key, *values = self._vary[k]
        options = list(dict.fromkeys([*self._known, *filter(None, [key])]))
        chosen = ui.select(options, value=key or None, label=_("key that varies"), with_input=True)
        chosen.props('dense options-dense outlined new-value-mode="add-unique"').classes("choice results")
        fields = []
        for place, (title, value) in enumerate(zip((_("from"), _("to"), _("values")), values, strict=True), start=1):
            field = ui.number(title, value=value).classes("choice narrow")
            field.props(f'dense outlined aria-label="{title} {k + 1}"')
            field.on_value_change(lambda event, place=place: self._set(k, place, event.value))
            fields.append(field)

        def choose(event: events.ValueChangeEventArguments[Any]) -> None:
            self._set(k, 0, str(event.value or ""))
            drive = self.session.drive
            about = usual(drive, str(event.value)) if event.value and drive is not None else None
            for field, value in zip(fields, about or (), strict=False):
                if field.value is None:
                    field.value = value

        chosen.on_value_change(choose)

    def _set(self, k: int, place: int, value: Any) -> None:
        """Take what was written of a key: its name, the first and the last value, how many."""
        changed: Any = list(self._vary[k])
        changed[place] = round(value) if place == len(changed) - 1 and value is not None else value
        self._say(vary=(*self._vary[:k], tuple(changed), *self._vary[k + 1 :]))

    def _add(self) -> None:
        self._all((*self._vary, ("", None, None, STEPS)))

    def _drop(self, k: int) -> None:
        self._all((*self._vary[:k], *self._vary[k + 1 :]))

    def _all(self, vary: tuple[Varied, ...]) -> None:
        with self.session.speaking():
            self._say(vary=vary)
            self._offer_keys_to_vary()

    def _show(self, page: Any) -> None:
        found: Swept = page
        self._found = found
        self._progress.hide()
        self.view.element.classes(remove="stale")
        first = self._drawn if self._drawn in found.figures else next(iter(found.figures), "")
        self._table.set_visibility(True)
        self._shown.set_visibility(len(found.figures) > 1)
        self._shown.set_options({name: found.titles[name] for name in found.figures}, value=first or None)
        self._draw(first)

    def _draw(self, name: str) -> None:
        """Draw an answer."""
        if self._found is None:
            return
        self._drawn = name
        figure = self._found.figures.get(name)
        pictures = [] if figure is None else [Picture(figure=figure)]
        with self.session.speaking():
            self.view.show(replace(self._found.page, blocks=[*pictures, *self._found.page.blocks]))

    def _csv(self) -> None:
        if self._found is not None:
            ui.download.content(self._found.table, TABLE, "text/csv; charset=utf-8")

    def _plan(self) -> None:
        session = self.session
        drive = session.name or f"{safe(session.drive.name if session.drive else '')}.toml"
        with session.speaking():
            try:
                text = session.sweep.plan(drive)
            except InputError as error:
                widgets.refused(error)
                return
            ui.download.content(text, PLAN, "application/toml")
            widgets.done(_("The plan names {file}: keep the drive file beside it.").format(file=drive))
