"""Which absorber, damper or pendulum calms a drive, on which station, and how is it to be tuned?"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.station import Station
from cardan.errors import Problem, check
from cardan.formulas.absorbers import den_hartog, h_infinity, viscous_optimum
from cardan.formulas.pendulum import tuned_length
from cardan.maths.arrays import Array
from cardan.questions.torsion.model.torsional_balance import places
from cardan.questions.torsion.model.torsional_model import TorsionalModel
from cardan.questions.torsion.model.torsional_modes import StraightModes, straight_modes
from cardan.questions.torsion.stability.proved_speeds import ProvedSpeeds
from cardan.questions.torsion.stability.torsion_stability import proved_in_band
from cardan.questions.torsion.steady.alternating_torque import TorqueSwings, exactly, exactly_where_high
from cardan.questions.torsion.steady.torsion_response import Progress
from cardan.questions.torsion.steady.two_frequencies import extreme, grouped, motions, sampled
from cardan.texts import _

from .absorber_search import Host, Setting, Settings, Task, highest, host_named, hosts, rounded
from .band import (
    LeastSwing,
    Lines,
    Stopped,
    Watch,
    Watched,
    about_peaks,
    band_speeds,
    check_swings,
    element_problems,
    excited,
    fine_speeds,
    lines,
    unstable_speeds,
    wanted_band,
)

# What a drive does over a band of speeds without an absorber, by its closed form, and in its best setting.

SAMPLES = 96
"""Angles of a period at which the swing of an absorber is read off."""


class Curves:
    """What a drive does over the band without an absorber, with the closed form, and with the best setting."""

    def __init__(self, task: Task, best: Setting, band: tuple[float, float], watch: Progress) -> None:
        bare = lines([task.drive], task.middle)
        (first, _at), (last, element) = task.line(task.closed_form), task.line(best)
        serves = task.speed if task.kind == "tuned" else []
        self.task = task
        rough = np.unique(np.append(fine_speeds(band, (bare, last)), serves))
        closer = [rough]
        for k, line in enumerate((bare, first, last)):
            found = exactly_where_high(line.swings(rough[None]), 1, task.elements)
            closer.append(about_peaks(rough, np.max(found.swing[:, task.elements], axis=-1)))
            watch(0.1 * (k + 1))
        self.speed = np.unique(np.concatenate(closer))
        runs, exact = [], []
        for k, line in enumerate((bare, first, last)):
            found, known = exactly(line.swings(self.speed[None]))
            runs.append(found)
            exact.append(bool(np.all(known)))
            watch(0.3 + 0.1 * (k + 1))
        self.before, self.closed, self.after = (one.swing[:, bare.elements] for one in runs)
        self.torque = runs[2].swing[:, element]
        self.twist, self.heat = self._swing(runs[2], last, element, best)
        judged = [unstable_speeds(one, line.omega, self.speed) for one, line in ((runs[0], bare), (runs[2], last))]
        self.unstable = tuple(speeds for speeds, _together in judged)
        self.exact, self.together = all(exact), all(together for _speeds, together in judged)
        watch(1.0)

    def peaked(self, setting: Setting, swing: Array) -> Setting:
        """Return a setting with its peak; where it serves one speed, that of this speed."""
        rows = np.isin(self.speed, self.task.speed) if self.task.kind == "tuned" else slice(None)
        peak, speed, element = highest(swing[rows], self.speed[rows], self.task.elements)
        return replace(setting, peak=peak, peak_speed=speed, peak_element=element)

    def _swing(self, found: TorqueSwings, line: Lines, element: int, setting: Setting) -> tuple[Array, Array]:
        """Return how far the absorber swings against its station, and what its damper turns to heat, arrays (s,)."""
        orbit, rows = found.orbit, np.arange(found.orbit.count)
        q, rate, _acceleration = orbit.of(rows, orbit.period * np.arange(SAMPLES) / SAMPLES)
        twist, slip = _against(orbit.drives(rows), q, rate, element)
        alone = (np.max(twist, axis=-1), np.min(twist, axis=-1), np.mean(slip**2, axis=-1))
        high, low, square = (one.copy() for one in alone)
        for base, group in grouped(found.loose):
            for some, motion in motions(orbit, base, group, rows):
                here = np.arange(len(some))
                shape, q, rate = sampled(motion.turning, motion.torus)
                twist, slip = _against(motion.turning.drives(here), q, rate, element)
                table, known = twist.reshape(len(some), 1, *shape), motion.bands.found
                own = (extreme(table, 1.0)[:, 0], extreme(table, -1.0)[:, 0], np.mean(slip**2, axis=-1))
                for whole, value, before in zip((high, low, square), own, alone, strict=True):
                    whole[some[known]] += (value - before[some])[known]
        swing = 0.5 * (high - low)
        if setting.arm is not None:
            swing = swing * (self.task.radius + setting.arm) / setting.arm
        return swing, setting.damping * square


def _against(drives: TorsionalModel, q: Array, rate: Array, element: int) -> tuple[Array, Array]:
    """Return the angle of the tail of an element against its host, and its rate, arrays (b, S)."""
    place = places(drives, q)
    host, tail = drives.elements[element]
    speed = place.first * rate[..., list(drives.coordinate)]
    return place.angle[..., tail] - place.angle[..., host], speed[..., tail] - speed[..., host]


RATIO = 0.1
"""Inertia of an absorber over that of the mode where none is given."""

SAME = 1e-9
"""Inertias of a mode at two stations that differ by no more than this share are the same."""

WIDE = 0.3
"""Half the band about the resonance, as a share of its speed, where the duty gives none."""

COUNT = 25
"""Evenly spread speeds of the search."""

EXPECTED = 40
"""Settings that a search takes for each unknown, about."""

WATCHED = (0.05, 0.75)
"""Shares of the work when the search begins and ends."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Absorber:
    """An absorber, damper or pendulum for a drive, and what it does.

    Attributes
    ----------
    kind : str
        Of `KINDS`.
    drive : Drive
        The drive with it, in its best setting.
    table : int
        Number of the `[[stations]]` that carries it, from 0.
    host : Host
        The station.
    hosts : tuple of h Host
        All stations it could hang on.
    modal_inertia : array (h,) [kg·m²]
        Inertia of the mode at each of these for unit angle there; infinite where it stands still.
    mode : int
        That is suppressed, from 1.
    omega : float [rad/s]
        ω_0, its natural frequency.
    order : float
        Order of the shaft that excites it.
    closed_form, best : Setting
        By the formula for one mode, and by the exact response of the whole drive.
    bare : Setting
        Nothing: its peak.
    elements : tuple of E str
        Names of the elements of the drive.
    judged : tuple of int
        Those whose torque was made small, from 0.
    speed : array (s,) [rad/s]
        Of the input.
    before, closed, after : arrays (s, E) [N·m]
        Swing of the torque of every element: without, by the closed form, in the best setting.
    torque, twist, heat : arrays (s,) [N·m, rad, W]
        In the best setting: swing of the torque in the absorber, swing of its angle against its station (of a pendulum
        about its pivot), power that its damper turns to heat.
    unstable_before, unstable_after : arrays (k,) [rad/s]
        Speeds, of those looked at, at which a small disturbance grows.
    exact, together : bool
        Whether torques and stability count orders that do not repeat within two turns by the motion with them at all
        speeds looked at; torques do so to first order elsewhere, and stability does not.
    proof : ProvedSpeeds or None
        Where in the band the drive with it is unstable, and whether that is proved to be all; None for a single speed.
    tuned_speed : float or None [rad/s]
        The one speed an absorber without damping is set for.
    evaluations : int
        Drives whose exact response the search asked for.
    converged : bool
        Whether the search ended by itself.
    cancelled : bool
        Whether it was stopped; the best so far stands here.
    play : bool
        Whether the drive has play: it counts as closed here.
    assumed : tuple of str
        Paths of what the drive does not say.
    """

    kind: str
    drive: Drive
    table: int
    host: Host
    hosts: tuple[Host, ...]
    modal_inertia: Array
    mode: int
    omega: float
    order: float
    closed_form: Setting
    best: Setting
    bare: Setting
    elements: tuple[str, ...]
    judged: tuple[int, ...]
    speed: Array
    before: Array
    closed: Array
    after: Array
    torque: Array
    twist: Array
    heat: Array
    unstable_before: Array
    unstable_after: Array
    tuned_speed: float | None
    evaluations: int
    converged: bool
    cancelled: bool
    play: bool
    assumed: tuple[str, ...]
    exact: bool = True
    together: bool = True
    proof: ProvedSpeeds | None = None

    @property
    def inertia_ratio(self) -> float:
        """α_J: its inertia over that of the mode at the station."""
        return self.best.inertia / float(self.modal_inertia[self.host.station])

    @property
    def reduction(self) -> float:
        """Peak with it over the peak without."""
        return self.best.peak / self.bare.peak

    @property
    def station(self) -> Station:
        """The `[[stations]]` that carries it."""
        return self.drive.stations[self.table]

    def frequency_ratio(self, setting: Setting) -> float:
        """Return f of a setting: its natural frequency over ω_0; of a pendulum its order over that to be absorbed."""
        if setting.arm is not None:
            assert self.station.pendulum is not None
            return float(np.sqrt(self.station.pendulum.radius / setting.arm)) / self.order
        return float(np.sqrt(setting.stiffness / setting.inertia)) / self.omega

    def damping_ratio(self, setting: Setting) -> float:
        """Return ξ = b/(2 J_a ω_0) of a setting."""
        return setting.damping / (2.0 * setting.inertia * self.omega)


def absorber(
    drive: Drive,
    duty: Duty | None = None,
    *,
    kind: str = "h_infinity",
    inertia: float | None = None,
    inertia_ratio: float | None = None,
    radius: float | None = None,
    count: int = 1,
    station: str | int | None = None,
    mode: int | None = None,
    order: float | None = None,
    speeds: tuple[float, float] | None = None,
    elements: Sequence[int] | None = None,
    progress: Progress | None = None,
) -> Absorber:
    """Return an absorber, damper or pendulum that makes the largest swing of a torque as small as it can.

    Parameters
    ----------
    drive : Drive
        With bodies or inertias and stiffnesses of its shafts, or `[[stations]]`, and some damping.
    duty : Duty, optional
        What it does; that of the drive by default.
    kind : str
        Of `KINDS`.
    inertia : float, optional [kg·m²]
        Of the absorber; of pendulums m (R + l)² of all together.
    inertia_ratio : float, optional
        The same over the inertia of the mode at the station; a tenth where neither is given.
    radius, count : float [m], int
        Of pendulums: distance of their pivots from the axis, and how many there are.
    station : str or int, optional
        Name of the station, or its number from 1 along the power flow; where the mode moves most by default.
    mode : int, optional
        Mode to suppress, from 1; by default the one whose resonance in the band is strongest.
    order : float, optional
        Order of the shaft that excites it; by default the one that does so most.
    speeds : (float, float), optional [rad/s]
        Band of input speeds; that of the duty by default, else about the resonance.
    elements : sequence of int, optional
        Elements of the drive whose torque is judged, from 0; all by default.
    progress : function, optional
        Told the share done; when it answers "stop" the best so far is returned as cancelled.

    Returns
    -------
    Absorber

    Raises
    ------
    InputError
        What the model misses, each with the key to add; a kind, mode or station that is not there; an inertia that is
        not positive; a pendulum without radius; a torque that runs in time.

    See Also
    --------
    optimise_torsion, torsion_response

    Notes
    -----
    Closed form: the mode reduced to the station has the inertia Σ J u²/u_s² there, and Book (250), (252) or the H∞
    optimum of Nishihara and Asami set the absorber, J_a (ν Ω)² its spring where it serves one speed, l = R/ν² a
    pendulum. From there the largest swing of any torque over the band is made smallest on the exact equations of the
    whole drive with the absorber as one more station: sequential quadratic programming on all speeds and elements at
    once.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from cardan import Drive, absorber
    >>> from cardan.parts import Duty, Shaft, Station
    >>> tube = Shaft(number=1, stiffness=4000.0, damping=1.0)
    >>> drive = replace(Drive.from_angles([0.35]), shafts=(tube,),
    ...     stations=(Station(shaft=2, name="pump", inertia=0.4),), duty=Duty(torque=60.0, speed_range=(35.0, 70.0)))
    >>> found = absorber(drive, inertia_ratio=0.15)
    >>> found.host.name, found.order, bool(found.best.peak < found.closed_form.peak < 0.35 * found.bare.peak)
    ('pump', 2.0, True)
    """
    asked = replace(drive, duty=drive.duty if duty is None else duty)
    check(problems(kind, inertia, inertia_ratio, radius, count, mode, order))
    band = wanted_band(asked.duty, speeds)
    single = None if band is None or band[0] < band[1] else band[0]
    rough = lines([asked], 1.0 if band is None else 0.5 * (band[0] + band[1]))
    modes = straight_modes(rough.trains[0].model, speed=rough.speed)
    check([*mode_problems(modes, mode), *element_problems(rough, elements)])
    judged = rough.elements if elements is None else np.asarray(elements, dtype=int)
    number, nu = meeting(rough, modes, mode, order, None if single is not None else band, single)
    omega = float(modes.omega[number])
    if band is None or single is not None:
        middle = omega / nu
        tuned = (single,) if kind == "tuned" and single is not None else ()
        band = min((1.0 - WIDE) * middle, *tuned, middle), max((1.0 + WIDE) * middle, *tuned, middle)
    bare = lines([asked], 0.5 * (band[0] + band[1]))
    found = hosts(asked, bare.trains[0])
    with np.errstate(divide="ignore"):
        modal = 1.0 / modes.shape[number][: len(found)] ** 2
    near = [one for one in found if modal[one.station] <= np.min(modal) * (1.0 + SAME)]
    loosest = next((one for one in near if one.table is not None), near[0])  # a station of the file before a yoke
    host = loosest if station is None else host_named(found, station)
    check(still(host, modal))
    own = (RATIO if inertia_ratio is None else inertia_ratio) * float(modal[host.station])
    own = rounded(own if inertia is None else inertia)
    watch = Watch(progress)
    searched = band_speeds(*band, bare.omega, excited(asked, asked.duty), count=COUNT)[0]
    start = bare.swings(searched[None])
    watch.share(WATCHED[0])
    worst, at, _element = highest(start.swing, searched, judged)
    check_swings(worst)
    serves = served(kind, asked.duty, band, single, at)
    task = Task(
        drive=asked,
        host=host,
        kind=kind,
        closed_form=closed_form(kind, own, own / float(modal[host.station]), omega, nu, serves, radius, bare.speed),
        speed=searched if serves is None else np.asarray([serves]),
        middle=bare.speed,
        elements=judged,
        radius=radius or 0.0,
        count=count,
    )
    if serves is None:  # what it adds are resonances of its own
        both = np.concatenate([bare.omega, task.line(task.closed_form)[0].omega], axis=-1)
        speed = band_speeds(*band, both, excited(asked, asked.duty), count=COUNT)[0]
        task = replace(task, speed=speed)

    def closer(place: Array) -> Array:
        return fine_speeds(band, (bare, task.line(task.setting(place))[0]))

    settings = Settings(task, worst)
    expected = len(settings.start) + EXPECTED * len(task.ranges)
    watched = Watched(progress=watch.part(*WATCHED), expected=expected)
    search = LeastSwing(settings.swings, task.speed, closer if serves is None else None, watched)
    with contextlib.suppress(Stopped):
        search.run(settings.start)
    search.best = search.best if search.best.size else np.full(len(task.ranges), 0.5)
    best = task.setting(search.best)
    curves = Curves(task, best, band, watch.part(WATCHED[1], 1.0))
    if curves.peaked(task.closed_form, curves.closed).peak < curves.peaked(best, curves.after).peak:
        best = task.closed_form  # by less than the search looks at
        curves = Curves(task, best, band, watch.part(1.0, 1.0))
    better, table = task.with_it(best)
    return Absorber(
        kind=kind,
        drive=better,
        table=table,
        host=host,
        hosts=found,
        modal_inertia=modal,
        mode=number + 1,
        omega=omega,
        order=nu,
        closed_form=curves.peaked(task.closed_form, curves.closed),
        best=curves.peaked(best, curves.after),
        bare=curves.peaked(Setting(inertia=0.0, stiffness=0.0, damping=0.0), curves.before),
        elements=bare.element_names,
        judged=tuple(int(k) for k in judged),
        speed=curves.speed,
        before=curves.before,
        closed=curves.closed,
        after=curves.after,
        torque=curves.torque,
        twist=curves.twist,
        heat=curves.heat,
        unstable_before=curves.unstable[0],
        unstable_after=curves.unstable[1],
        exact=curves.exact,
        together=curves.together,
        tuned_speed=serves,
        evaluations=search.asked,
        converged=search.converged,
        cancelled=watch.stopped,
        play=bare.play,
        assumed=bare.trains[0].assumed,
        proof=proved_in_band(better, float(curves.speed[0]), float(curves.speed[-1])),
    )


# What an absorber is to do and how it begins: which mode and order it is for, what is refused, the closed forms.

KINDS = ("h_infinity", "den_hartog", "viscous", "tuned", "pendulum")
"""Smallest peak, by fixed points, damper without spring, absorber without damping for one speed, pendulums."""


def problems(
    kind: str,
    inertia: float | None,
    ratio: float | None,
    radius: float | None,
    count: int,
    mode: int | None,
    order: float | None,
) -> Iterator[Problem]:
    """Yield what is wrong with what is asked for."""
    if kind not in KINDS:
        yield Problem("kind", _("{given} given; one of {known}").format(given=repr(kind), known=", ".join(KINDS)))
    if inertia is not None and ratio is not None:
        yield Problem("inertia_ratio", _("the inertia itself is given already"))
    for name, value in (("inertia", inertia), ("inertia_ratio", ratio), ("radius", radius), ("order", order)):
        if value is not None and not (np.isfinite(value) and value > 0.0):
            yield Problem(name, _("{value:.6g} given; more than 0 is needed").format(value=value))
    if kind == "pendulum" and radius is None:
        yield Problem("radius", _("missing; the distance of the pivots from the axis of the shaft"))
    if count < 1:
        yield Problem("count", _("{given} given; at least 1").format(given=count))
    if kind in KINDS and kind != "pendulum":
        for name, given in (("radius", radius is not None), ("count", count > 1)):
            if given:
                yield Problem(name, _("counts only with pendulums"))
    if mode is not None and mode < 1:
        yield Problem("mode", _("{given} given; modes count from 1").format(given=mode))


def mode_problems(modes: StraightModes, mode: int | None) -> Iterator[Problem]:
    """Yield a mode that the drive does not have."""
    if mode is not None and mode > len(modes.omega):
        text = _("{given} given; the drive has {count}")
        yield Problem("mode", text.format(given=mode, count=len(modes.omega)))


def still(host: Host, modal: Array) -> list[Problem]:
    """Return a problem where a station stands still in the mode."""
    if np.isfinite(modal[host.station]) and modal[host.station] < 1e9 * np.min(modal):
        return []
    return [Problem("station", _("{name} stands still in this mode; nothing there reaches it").format(name=host.name))]


def meeting(
    found: Lines,
    modes: StraightModes,
    mode: int | None,
    order: float | None,
    band: tuple[float, float] | None,
    near: float | None,
) -> tuple[int, float]:
    """Return mode from 0 and order of the strongest resonance in a band; the slowest, or the nearest, without one."""
    drive = found.drives[0]
    known = excited(drive, drive.duty) if order is None else (order,)
    pairs = [(m, nu) for m in range(len(modes.omega)) for nu in known if mode in (None, m + 1)]
    speed = np.asarray([modes.omega[m] / nu for m, nu in pairs])
    if band is None:
        return pairs[int(np.argmin(np.abs(speed - near)))] if near is not None else min(pairs, key=lambda one: one[0])
    inside = np.flatnonzero((speed >= band[0]) & (speed <= band[1]))
    if not inside.size:
        return pairs[int(np.argmin(np.maximum(band[0] - speed, speed - band[1])))]
    swing = found.swings(speed[inside][None]).swing
    strength = np.max(np.where(np.isfinite(swing), swing, np.inf), axis=-1)
    return pairs[int(inside[int(np.argmax(strength))])]


def served(kind: str, duty: Duty, band: tuple[float, float], single: float | None, peak: float) -> float | None:
    """Return the one speed that an absorber without damping serves; None for the others."""
    if kind != "tuned":
        return None
    own = single if single is not None else None if duty.speed is None else abs(duty.speed)
    return own if own is not None and band[0] <= own <= band[1] else peak


def closed_form(
    kind: str,
    inertia: float,
    ratio: float,
    omega: float,
    order: float,
    serves: float | None,
    radius: float | None,
    middle: float,
) -> Setting:
    """Return the setting by the formula for one mode."""
    if kind == "pendulum":
        assert radius is not None
        arm = rounded(float(tuned_length(radius, order)))
        return Setting(inertia=inertia, stiffness=inertia * middle**2 * radius / arm, damping=0.0, arm=arm)
    if serves is not None:
        return Setting(inertia=inertia, stiffness=rounded(inertia * (order * serves) ** 2), damping=0.0)
    tuning = {"h_infinity": h_infinity, "den_hartog": den_hartog, "viscous": viscous_optimum}[kind](ratio)
    _own, spring, damper = (float(one) for one in tuning.sized(inertia / ratio, omega))
    return Setting(inertia=inertia, stiffness=rounded(spring), damping=rounded(damper))
