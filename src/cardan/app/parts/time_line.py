"""The time of a moving drive: a line to drag and to play, which view, curves and headline follow."""

from __future__ import annotations

import time

from nicegui import ui

from cardan.answers.quantity import Quantity
from cardan.answers.reader import reader
from cardan.app.state.session import Session
from cardan.report.verdict_list import moving_span
from cardan.texts import _

from .widgets import Timer

STEP = 0.08  # seconds between two instants that are played
LONGEST = 20.0  # seconds that a movement is played in at most; shorter ones take their own time
STEPS = 400  # places of the line

MOVED = "window.cardanTime={0};dispatchEvent(new CustomEvent('cardan-time',{{detail:{{time:{0}}}}}))"
"""Tells the curves over time where the drive stands."""

WANTED = """if (!window.cardanWanted) {
  window.cardanWanted = true;
  addEventListener('cardan-go-to-time', ({ detail }) =>
    document.querySelector('.bar.time')?.dispatchEvent(new CustomEvent('wanted', { detail: detail.time })));
}"""
"""Passes on to which time somebody pressed on a curve, to the line that stands on the page now."""


class TimeLine:
    """The line, shown for drives that move."""

    def __init__(self, session: Session) -> None:
        self.session = session
        self._first = self._last = 0.0
        self._began: tuple[float, float] | None = None  # when playing began, and at which instant
        with ui.element("div").classes("bar time").props(f'role=group aria-label="{_("movement")}"') as self.body:
            self._play = ui.button(icon="play_arrow", on_click=self._played)
            told = _("play or hold the movement")
            self._play.props(f'flat dense round aria-label="{told}" title="{told}" data-mark="play-movement"')
            self._line = ui.slider(min=0, max=STEPS, step=1, value=0, on_change=lambda: self._dragged())
            self._line.props(f'dense aria-label="{_("time of the movement")}" data-mark="time"').classes("line")
            self._line.props["loopback"] = False  # it stands where it is dragged to, whatever comes back later
            self._said = ui.label().classes("instant").props('data-mark="instant"')
            rest = ui.button(_("as drawn"), on_click=lambda: self.session.stand(None))
            rest.props('flat dense no-caps size=sm data-mark="as-drawn"')
        ui.run_javascript(WANTED)
        self.body.on("wanted", lambda event: self._wanted(float(event.args["detail"])), ["detail"])
        Timer(session, self.body, STEP, self._tick, once=False)
        session.listen("drive", self._follow)
        session.listen("choices", self._show)
        session.listen("instant", self._show)
        self._follow()

    def _follow(self) -> None:
        """Follow an edit of the movements."""
        drive = self.session.drive
        self._first, self._last = moving_span(drive) if drive is not None else (0.0, 0.0)
        self.body.set_visibility(self._last > self._first)
        instant = self.session.instant
        if instant is not None and not self._first <= instant <= self._last:
            self._hold()
            self.session.stand(None)
        self._show()

    def _played(self) -> None:
        """Play from where it stands, or hold it there."""
        if self._began is not None:
            self._hold()
            return
        instant = self.session.instant
        self._began = time.monotonic(), self._first if instant is None else instant
        self._play.set_icon("pause")

    def _hold(self) -> None:
        self._began = None
        self._play.set_icon("play_arrow")

    def _tick(self) -> None:
        """Go on while it plays, round and round."""
        if self._began is None:
            return
        began, start = self._began
        span = self._last - self._first
        passed = (time.monotonic() - began) * max(1.0, span / LONGEST)
        self.session.stand(self._first + (start - self._first + passed) % span)

    def _dragged(self) -> None:
        """Stand where the line was dragged to; the line moves while it plays as well."""
        if abs(float(self._line.value) - self._place()) >= 1.0:
            self._wanted(self._first + (self._last - self._first) * float(self._line.value) / STEPS)

    def _wanted(self, instant: float) -> None:
        self._hold()
        self.session.stand(min(max(instant, self._first), self._last))

    def _place(self) -> float:
        """Return where on the line the drive stands."""
        instant, span = self.session.instant, self._last - self._first
        return 0.0 if instant is None or not span else round(STEPS * (instant - self._first) / span)

    def _show(self) -> None:
        """Show where it stands, here and on the curves."""
        instant = self.session.instant
        if instant is None:
            self._hold()
        self._line.set_value(self._place())
        with self.session.speaking():
            end, now = (Quantity(one, "time", 3).told(reader()) for one in (self._last, instant or 0.0))
            text = _("as drawn; the movement takes {span}") if instant is None else _("t = {time} of {span}")
            self._said.set_text(text.format(time=now, span=end))
        with self.body:
            ui.run_javascript(MOVED.format("null" if instant is None else repr(instant)))
