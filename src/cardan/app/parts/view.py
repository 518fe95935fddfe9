"""The drive in space, turning: what plays it, what is shown with it, and the time line of one that moves."""

from __future__ import annotations

import asyncio
import math
import time
from collections.abc import Callable
from typing import Any, cast

from nicegui import background_tasks, run, ui

from cardan.answers.quantity import Quantity
from cardan.answers.reader import reader
from cardan.app.scene.element import SceneView
from cardan.app.state.jobs import Jobs, own_fault
from cardan.app.state.question import asked
from cardan.app.state.session import Session
from cardan.app.state.work import SCENE, Drawn, drawn
from cardan.app.state.work import SOON as SOONER
from cardan.drive.drive import Drive
from cardan.errors import CardanError
from cardan.report.verdict_list import moving_span
from cardan.scene.scene import Scene
from cardan.texts import _

from .widgets import Timer, drop_down

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


TURNING = -1  # in place of the index of a mode shape: the drive turns
LOADED = ("forces", "couples")  # groups that need the forces of the drive
SLOW = 0.35  # share of the way from the slowest to the fastest picture, on a page just opened
QUIET = 0.35  # seconds without an edit after which utilisations, forces and mode shapes are calculated anew
LOOK = 0.05  # seconds between two looks whether a heavy file is drawn
SOON = 0.02  # seconds by which the view follows the form

FOLLOWING = (
    "if(!window.cardanPhi){window.cardanPhi=true;let last=0;addEventListener('cardan-angle',e=>{"
    "const now=performance.now();if(now-last<60)return;last=now;"
    "const turned=Math.round(e.detail.angle*180/Math.PI)%360;"
    "for(const one of document.querySelectorAll('.phi'))one.textContent='φ = '+turned+'°'})}"
)
"""Lets the browser write the angle it shows, without asking the server."""

WHOLE = (
    "(event) => document.fullscreenElement ? document.exitFullscreen() "
    ": event.target.closest('.pane').requestFullscreen()"
)
"""Fills the whole screen with a pane, or gives the screen back."""


def _tool(icon: str, title: str, mark: str, act: Callable[[], object] | None = None) -> ui.button:
    """Return a small button of the bar."""
    button = ui.button(icon=icon, on_click=(lambda: act()) if act else None)
    return button.props(f'flat dense size=sm aria-label="{title}" title="{title}" data-mark="{mark}"')


def _pressed(button: ui.button, *, on: bool) -> None:
    """Show of a button whether what it switches is on."""
    button.props(f"aria-pressed={'true' if on else 'false'}").classes(**{"add" if on else "remove": "on"})


class View:
    """The view in space with its controls. jobs: where heavy files are drawn."""

    def __init__(self, session: Session, jobs: Jobs) -> None:
        self.session = session
        self._jobs = jobs
        self.shown: Scene | None = None
        self.on: set[str] | None = None
        self.mode: int | None = None  # None until mode shapes were asked for
        self.pose: int | None = None
        self._measures = False
        self._switched_on: dict[str, tuple[str, str]] = {}
        self._waiting: Timer | None = None
        self._next: Timer | None = None
        self._moving = self._moved = False
        tools = ui.element("div").classes("tools").props(f'role=toolbar aria-label="{_("what is shown")}"')
        with ui.element("div").classes("stage") as self.stage:
            self.scene = SceneView(on_touched=session.select, on_playing=self._played, on_measured=self._measured)
            self.scene.classes("scene").props('data-mark="scene"')
            self.told = ui.label("").classes("told").props("role=status")
        with tools:
            self._tools()
        self._bar()
        TimeLine(session)
        ui.run_javascript(FOLLOWING)
        self._theme()
        self._follow()
        session.listen("drive", self._soon)
        session.listen("instant", self._stand)
        session.listen("selection", lambda: self.scene.select(session.selected or None))
        session.listen("choices", self._theme)
        session.listen("choices", self._soon)

    def _tools(self) -> None:
        looks = {"iso": _("in space"), "side": _("side"), "plan": _("plan"), "front": _("front")}
        for name, title in looks.items():
            button = ui.button(title, on_click=lambda name=name: self.scene.view(name))
            button.props("flat dense no-caps size=sm").props(f'data-mark="look-{name}"')
        _tool("fit_screen", _("show all of it (F)"), "fit", self.scene.fit)
        with drop_down(_("show"), "show", role="dialog", closes=False):
            self.switches = ui.element("div").classes("switches")
        colours = {"shaft": _("by shaft"), "utilisation": _("by utilisation")}
        ui.select(colours, value="shaft", on_change=lambda event: self.scene.colour_by(event.value)).props(
            f'dense options-dense borderless aria-label="{_("colour")}" title="{_("colour")}"'
        ).props('data-mark="colour"')
        told = f'aria-label="{_("pose")}" title="{_("pose")}" data-mark="pose"'
        self.poses = ui.select({None: ""}, value=None, on_change=lambda event: self._posed(event.value))
        self.poses.props(f"dense options-dense borderless {told}")
        self._cutter = _tool("content_cut", _("section along the drive"), "section", self._cut)
        self._place = ui.slider(min=-1, max=1, step=0.02, value=0, on_change=lambda: self._section()).classes("speed")
        self._place.props(f'dense aria-label="{_("place of the section")}" data-mark="section-place"')
        self._place.set_visibility(False)
        self._ruler = _tool("straighten", _("measure between two points"), "measure", self._measure)
        whole = _tool("fullscreen", _("fill the whole screen"), "whole-screen")
        whole.on("click", js_handler=WHOLE)

    def _cut(self) -> None:
        """Cut the drive, or make it whole again."""
        on = not self._place.visible
        _pressed(self._cutter, on=on)
        self._place.set_visibility(on)
        self._section()

    def _section(self) -> None:
        self.scene.section(float(self._place.value) if self._place.visible else None)

    def _measure(self) -> None:
        """Measure between points, or touch parts again."""
        self._measures = not self._measures
        _pressed(self._ruler, on=self._measures)
        self.scene.measure(self._measures)
        self.told.set_text(_("Touch two points of the drive.") if self._measures else "")

    def _measured(self, points: list[float]) -> None:
        """Tell the distance of two points [m], and what they lie apart along x, y and z."""
        apart = [end - start for start, end in zip(points[:3], points[3:], strict=True)]
        with self.session.speaking():
            far, x, y, z = (Quantity(one, "length", 4).told(reader()) for one in (math.hypot(*apart), *apart))
            self.told.set_text(_("distance {far}; Δx {x}, Δy {y}, Δz {z}").format(far=far, x=x, y=y, z=z))

    def _bar(self) -> None:
        with ui.element("div").classes("bar"):
            self.play = ui.button(icon="pause", on_click=lambda: self._play(not self.scene.playing))
            self.play.props(f'flat dense round aria-label="{_("turn or hold the drive")}"').props('data-mark="play"')
            ui.slider(min=0, max=1, step=0.01, value=SLOW, on_change=lambda event: self._speed(event.value)).props(
                f'dense aria-label="{_("speed of the picture")}" data-mark="speed"'
            ).classes("speed")
            self.rate = ui.label().classes("rate").props('data-mark="rate"')
            self._speed(SLOW)
            ui.label("φ = 0°").classes("phi")
            self.shapes = ui.select(
                {TURNING: _("turning")}, value=TURNING, on_change=lambda event: self._chosen(event.value)
            )
            told = _("turning or swinging")
            self.shapes.props(f'dense options-dense borderless aria-label="{told}" title="{told}" data-mark="shapes"')
            ask = ui.button(_("mode shapes"), on_click=self._ask_modes).props("flat dense no-caps size=sm")
            ask.props('data-mark="mode-shapes"')

    def _offer_poses(self, drive: Drive) -> None:
        names: dict[int | None, str] = {None: _("as drawn"), **{k: pose.name for k, pose in enumerate(drive.poses)}}
        self.pose = self.pose if self.pose in names else None
        if names != self.poses.options:
            self.poses.set_options(names, value=self.pose)
        self.poses.set_visibility(bool(drive.poses))

    def _soon(self) -> None:
        """Follow once the form has been sent, and once for several changes in a row."""
        if self._next is None:
            self._next = self._timer(SOON, self._follow)

    def _timer(self, seconds: float, what: Callable[[], object]) -> Timer:
        return Timer(self.session, self.stage, seconds, what, once=True)

    def _follow(self) -> None:
        """Show the drive as it is now; what takes longer follows once the user is quiet."""
        drive, self._next = self.session.drive, None
        if drive is None:
            return
        with self.session.speaking():
            self._offer_poses(drive)
            loaded = bool(self.on and self.on.intersection(LOADED))
            found = None if self.session.heavy else self._attempted(drive, forces=loaded)
            if found is not None:
                self._show(found)
        if self._waiting is not None:
            self._waiting.cancel()
        self._waiting = self._timer(QUIET, self._complete)

    def _attempted(self, drive: Drive, **more: bool) -> Drawn | None:
        """Return the scene; where there is none, say why."""
        try:
            return drawn(drive, pose=self.pose, instant=self.session.instant, **more)
        except CardanError as error:
            self.told.set_text(str(error))
        except Exception as error:  # whatever it is, the page goes on and says so
            self.told.set_text(own_fault(self.session.choices.language, f"{type(error).__name__}: {error}"))
        return None

    async def _complete(self) -> None:
        """Add utilisations, forces and mode shapes, away from the page's own work."""
        drive = self.session.drive
        if drive is None:
            return
        modes = self.mode is not None

        def made() -> Drawn | None:
            with self.session.speaking():
                return self._attempted(drive, used=True, forces=True, modes=modes)

        if self.session.heavy:
            found = await self._elsewhere(used=True, forces=True, modes=modes)
        else:
            found = await run.io_bound(made)
        if found is not None and drive is self.session.drive and not self.stage.is_deleted:
            with self.session.speaking():
                self._show(found)

    def _stand(self) -> None:
        """Show the drive where its movements have brought it; of instants that follow quickly the newest."""
        self._moved = True
        if not self._moving:
            self._moving = True
            background_tasks.create(self._follow_instants(), name="instants of a movement")

    async def _follow_instants(self) -> None:
        try:
            while self._moved and not self.stage.is_deleted:
                self._moved = False
                with self.stage:
                    await self._complete()
        finally:
            self._moving = False

    async def _elsewhere(self, **more: bool) -> Drawn | None:
        """Return the scene of a heavy file, made in a process of its own; where there is none, say why."""
        question = asked(self.session, SCENE, pose=self.pose, instant=self.session.instant, **more)
        assert question is not None
        job = self._jobs.ask(question, self.session, limit=SOONER)
        while not job.finished:
            await asyncio.sleep(LOOK)
        if job.state == "failed" and not self.stage.is_deleted:
            self.told.set_text(job.message)
        return cast("Drawn | None", job.result)

    def _show(self, drawn: Drawn) -> None:
        found, described = drawn
        self.shown = found
        if self.on is None:
            self.on = {group.name for group in found.groups if group.on}
        self.scene.show(described)
        self.scene.groups(self.on)
        self._switches(found)
        self._shapes(found)

    def _switches(self, found: Scene) -> None:
        assert self.on is not None
        titles = {group.name: (group.title, group.text) for group in found.groups}
        asked = {"forces": _("forces"), "couples": _("secondary couples")}
        titles |= {name: (title, found.missing.get(name, "")) for name, title in asked.items() if name not in titles}
        if titles == self._switched_on:
            return
        self._switched_on = titles
        self.switches.clear()
        with self.switches:
            for name, (title, text) in titles.items():
                switch = ui.checkbox(title, value=name in self.on)
                switch.on_value_change(lambda event, name=name: self._switched(name, event.value))
                switch.props("dense").props(f'data-mark="group-{name}"')
                if text:
                    ui.label(text).classes("hint")

    def _switched(self, name: str, on: bool) -> None:
        assert self.on is not None
        self.on = self.on | {name} if on else self.on - {name}
        self.scene.groups(self.on)

    def _ask_modes(self) -> None:
        self.mode = 0 if self.mode in (None, TURNING) else self.mode
        self._timer(0.01, self._complete)

    def _shapes(self, found: Scene) -> None:
        """Offer the mode shapes of a scene; those of a drive just edited are still to come."""
        if found.modes:
            names = {TURNING: _("turning"), **{k: mode.name for k, mode in enumerate(found.modes)}}
            self.mode = self.mode if self.mode in names else TURNING
            self.shapes.set_options(names, value=self.mode)
        self._swing()

    def _chosen(self, mode: int) -> None:
        if self.shown is not None and self.shown.modes:
            self.mode = mode
            self._swing()

    def _swing(self) -> None:
        """Let the scene swing or turn as was chosen, and say what is seen or why nothing is."""
        found = self.shown
        if found is None:
            return
        swings = self.mode is not None and 0 <= self.mode < len(found.modes)
        self.scene.mode(self.mode if swings else None)
        lacking = found.missing.get("modes", "") if self.mode is not None and not found.modes else ""
        self.told.set_text(found.modes[self.mode].text if swings and self.mode is not None else lacking)

    def _posed(self, pose: Any) -> None:
        if pose != self.pose:
            self.pose = pose
            self._follow()

    def _play(self, on: bool) -> None:
        self.scene.play(on)
        self._played(on)

    def _played(self, on: bool) -> None:
        self.play.set_icon("pause" if on else "play_arrow")

    def _speed(self, share: float) -> None:
        """Turn slow or fast: from half a turn a minute to a turn a second, evenly by ear and eye."""
        turns = 0.5 * 120.0**share
        self.scene.speed(turns)
        with self.session.speaking():
            self.rate.set_text(Quantity(turns * math.tau / 60.0, "angular_speed", 3, unit="rpm").told(reader()))

    def _theme(self) -> None:
        theme = self.session.choices.theme
        self.scene.theme("dark" if theme == "dark" or (theme == "auto" and self.session.dark) else "light")
