"""The tab of the diagnosis: a recording is sent or opened, its channels are told, and its causes are shown."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

from nicegui import events, ui

from cardan.app.state.jobs import Jobs
from cardan.app.state.recordings import DIAGNOSIS, MAX_RECORDING
from cardan.app.state.session import Session
from cardan.errors import InputError
from cardan.io import recording_names
from cardan.report.recorded import SUFFIXES, WAYS, Recorded, Sensor
from cardan.texts import _

from . import widgets
from .answers import Sheet
from .blocks import Export, PageView
from .widgets import drop_down, menu_item, sending

MOST_PULSES = 10_000  # pulses that a tacho gives in a turn at most


class Diagnosis(Sheet):
    """What a recording of the drive tells.

    session: whose drive and recording it is about; jobs: where it is made; export: takes a figure or the page along.
    """

    def __init__(self, session: Session, jobs: Jobs, export: Export | None) -> None:
        super().__init__(DIAGNOSIS, session, jobs, export)
        self._export = export
        self._sensors: tuple[Sensor, ...] = ()
        self._tacho = ""
        self._unfolded = False
        with self.body:
            self._source = ui.element("div").classes("recording")
            self._channels = ui.element("div").classes("recording")
        self._source.move(target_index=0)
        self._channels.move(target_index=1)
        self._offer_recordings()
        self._offer_channels()

    @property
    def quick(self) -> bool:
        """Never: it is a process of its own."""
        return False

    def begin(self) -> None:
        """Answer now, where there is a recording."""
        opened = self.session.recordings.opened
        if opened is None:
            return
        self._choices = {"recording": opened}
        super().begin()

    def _offer_recordings(self) -> None:
        """Show what is open, and how another one is opened."""
        opened = self.session.recordings.opened
        self._source.clear()
        with self._source:
            _button(_("Send a recording …"), "upload", self.send).props('data-mark="recording-send"')
            with drop_down(_("Open a recording"), "recording-open", icon="folder_open"):
                recordings = self.session.recordings
                for name in recordings.names():
                    menu_item(name, partial(self._open, partial(recordings.open, name)))
                ui.item_label(_("Examples, of the drive truck-supports")).props("header")
                for name in recording_names():
                    menu_item(name, partial(self._open, partial(recordings.open_example, name)), f"recording-{name}")
            said = opened.name if opened is not None else ""
            ui.label(said).classes("head").props('role=status data-mark="recording-name"')
            if opened is None:
                text = _(
                    "A recording of the running drive tells what may be wrong with it: vibration at its bearings, best "
                    "with a tacho, over a run-up and at two torques. Files: {known}, at most {size} MB."
                )
                hint = text.format(known=", ".join(SUFFIXES), size=MAX_RECORDING // 10**6)
                ui.label(hint).classes("hint wide").props('data-mark="recording-hint"')

    def send(self) -> None:
        """Take a recording from the user's disk."""

        async def taken(event: events.UploadEventArguments) -> Callable[[], None]:
            name = event.file.name
            place = self.session.recordings.room(name)
            await event.file.save(place)
            return lambda: self._sent(name, place)

        with self.session.speaking():
            title = _("A recording, at most {size} MB").format(size=MAX_RECORDING // 10**6)
            sending("send-recording", title, taken, upload="recording-upload", suffixes=SUFFIXES, most=MAX_RECORDING)

    def _sent(self, name: str, place: Path) -> None:
        if not self.body.is_deleted:
            with self.body:
                self._open(lambda: self.session.recordings.take(name, place))

    def _open(self, opening: Callable[[], None]) -> None:
        with self.session.speaking():
            try:
                opening()
            except InputError as error:
                widgets.refused(error)
                return
            self._sensors, self._tacho = (), ""
            self.view.element.delete()  # what it shows is of another recording
            with self.body:
                self.view = PageView(self._export)
            self._offer_recordings()
            self._offer_channels()
            self.begin()

    def _say(self, **changes: Any) -> None:
        """Say more of the recording, and ask again."""
        with self.session.speaking():
            self.session.recordings.say(**changes)
            self.begin()

    def _show(self, page: Any) -> None:
        found: Recorded = page
        self._progress.hide()
        self.view.element.classes(remove="stale")
        if self.about is None or self.session.recordings.opened is None:
            return
        if (found.sensors, found.tacho) != (self._sensors, self._tacho):
            self._sensors, self._tacho = found.sensors, found.tacho
            self._offer_channels()
        self.view.show(found.page)

    def _offer_channels(self) -> None:
        """Ask for what the file does not tell."""
        self._channels.clear()
        opened = self.session.recordings.opened
        if opened is None:
            return
        said = opened.said
        with self._channels:
            if self._sensors:
                turning = {one.name: one.name for one in self._sensors if one.turns}
                options = turning if self._tacho else {"": _("none was found"), **turning}
                tacho = ui.select(options, value=self._tacho, label=_("tells the speed"))
                tacho.props('dense options-dense outlined data-mark="tacho"').classes("choice")
                tacho.on_value_change(lambda event: self._say(tacho=event.value or None))
                shaking = [one.name for one in self._sensors if one.shakes]
                channels = {"": _("the loudest"), **{one: one for one in shaking}}
                shown = ui.select(
                    channels, value=said.channel if said.channel in channels else "", label=_("orders shown of")
                )
                shown.props('dense options-dense outlined data-mark="shown-channel"').classes("choice")
                shown.on_value_change(lambda event: self._say(channel=event.value or None))
            pulses = ui.number(_("pulses per turn"), value=said.pulses_per_turn, min=0, max=MOST_PULSES)
            pulses.props('dense outlined debounce=600 data-mark="pulses"').classes("choice narrow")
            pulses.on_value_change(lambda event: self._say(pulses_per_turn=float(event.value or 1.0)))
            more = ui.expansion(_("What the file does not tell"), value=self._unfolded, on_value_change=self._fold)
            more.classes("wide").props('dense data-mark="recording-more"')
            with more, ui.element("div").classes("recording"):
                self._more()

    def _fold(self, event: events.ValueChangeEventArguments[Any]) -> None:
        self._unfolded = bool(event.value)

    def _more(self) -> None:
        opened, drive = self.session.recordings.opened, self.session.drive
        if opened is None or drive is None:
            return
        said = opened.said
        fields: list[tuple[ui.input | ui.number, Callable[[Any], dict[str, Any]]]] = [
            (
                ui.input(_("titles of all channels, in order"), value=", ".join(said.titles))
                .classes("wide")
                .props('placeholder="tacho, acceleration_supports[0]_z_m_s2, acceleration_supports[1]_z_m_s2"'),
                lambda value: {"titles": tuple(one.strip() for one in str(value or "").split(",") if one.strip())},
            ),
            (
                ui.number(_("rate [Hz]"), value=said.rate, min=0).classes("choice narrow"),
                lambda value: {"rate": value or None},
            ),
            (
                ui.number(_("full scale of a WAV file"), value=said.full_scale, min=0).classes("choice narrow"),
                lambda value: {"full_scale": value or None},
            ),
        ]
        for field, told in fields:
            field.props("dense outlined")
            field.on("change", lambda field=field, told=told: self._say(**told(field.value)))
        fields[0][0].props('data-mark="titles"')
        parts = [f"supports[{k}]" for k in range(len(drive.supports))]
        parts += [f"shafts[{k}]" for k in range(len(drive.shafts))]
        for one in self._sensors:
            if one.shakes:
                self._place(one, parts)

    def _place(self, one: Sensor, parts: list[str]) -> None:
        """Ask where a sensor sits and looks."""
        with ui.element("div").classes("line"):
            ui.label(one.name).classes("name")
            known = dict.fromkeys(["", *parts, one.place])
            where = ui.select({part: part or "–" for part in known}, value=one.place, label=_("sits on"))
            way = ui.select({part: part or "–" for part in ("", *WAYS)}, value=one.direction, label=_("looks"))
            for field in (where, way):
                field.props("dense options-dense outlined").classes("choice narrow")
                field.on_value_change(lambda: self._moved(one.name, where.value, way.value))

    def _moved(self, name: str, place: str, way: str) -> None:
        opened = self.session.recordings.opened
        if opened is not None:
            rest = tuple(said for said in opened.said.places if said[0] != name)
            self._say(places=(*rest, (name, place, way)))


def _button(text: str, icon: str, act: Callable[[], object]) -> ui.button:
    return ui.button(text, icon=icon, on_click=act).props("flat dense no-caps")
