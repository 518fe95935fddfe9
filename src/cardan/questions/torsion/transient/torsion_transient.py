"""How do torques and speeds of a drive run in time: load steps, torque histories, running up, from even or settled."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.machine import Event, TorqueHistory
from cardan.errors import Problem, check, refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.questions.torsion.model.excitation import forced_run_up
from cardan.questions.torsion.model.inputs import Constant, History, Law, SpeedCourse, SpeedTable, Swinging
from cardan.questions.torsion.model.torsional_balance import even_rates, gathered, places
from cardan.questions.torsion.model.torsional_model import Torque, TorsionalModel
from cardan.questions.torsion.model.torsional_modes import main_order, straight_modes
from cardan.questions.torsion.model.torsional_train import TorsionalTrain, in_full, in_time, sprung, torsional_train
from cardan.questions.torsion.steady.steady import periodic_response
from cardan.questions.torsion.steady.torsion_response import parted
from cardan.texts import _

from .fixed_steps import FixedStep
from .simulation import Progress, Simulation, Status
from .time_integration import own_rates
from .transient import Adaptive, Method, simulate

Start: TypeAlias = Literal["even", "settled"]

TURNS = 20.0
"""Turns that are simulated where nothing says how long."""

SWINGS = 15.0
"""Swings of the slowest mode that are simulated at least."""

MANY = 1_000
"""Steps that errors ask for from which steps of one length, compiled, are the quicker way."""

RADIANS = 2.0
"""Of the fastest swing that lives on, in a step that errors ask for."""

SMOOTH = 20.0
"""Steps in a period of the fastest swing: extremes are then read off to some millionths."""

FOLLOWED = 1_000_000
"""Turns or swings of the slowest mode that are followed at most: hours of work."""

PEAKS, LONGEST = 40.0, 5000.0
"""Samples and steps in a period of a run-up whose cycles are counted, and the periods that are followed."""

AFTER = 0.2
"""Share of a run-up that is simulated behind it."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Transient:
    """Torsional motion of a drive in time.

    Attributes
    ----------
    train : TorsionalTrain
        The model, and where its stations are.
    motion : Simulation
        Angles and speeds of the stations, torques of the elements, extremes, account of energy.
    start : str
        "even" from untwisted shafts that turn as rigid ones would, so that all torques come on at once; "settled" from
        the steady motion.
    """

    train: TorsionalTrain
    motion: Simulation
    start: Start

    @property
    def hangs(self) -> tuple[Sommerfeld, ...]:
        """Where a motor hung on a resonance: its speed stopped rising while power was there."""
        return sommerfeld(self.train.model, self.motion)

    @property
    def swings(self) -> tuple[float, ...]:
        """Largest swing of the pendulums on each station about their radius, of the samples [rad]."""
        hung = (self.train.model.elements[e] for e in self.train.pendulums)
        angle = self.motion.angle
        return tuple(float(np.nanmax(np.abs(angle[:, tip] - angle[:, pivot]))) for pivot, tip in hung)

    @property
    def complete(self) -> bool:
        """Whether the simulation reached its end."""
        return int(self.motion.status) == Status.DONE


def transient(
    drive: Drive,
    duty: Duty | None = None,
    *,
    span: float | None = None,
    times: int | ArrayLike = 2001,
    start: Start = "even",
    method: Method | None = None,
    pieces: int = 1,
    step: Law | None = None,
    progress: Progress | None = None,
) -> Transient:
    """Return how torques and speeds of a drive run in time.

    Parameters
    ----------
    drive : Drive
        With bodies or inertias and stiffnesses of its shafts, or `[[stations]]`.
    duty : Duty, optional
        What it does; that of the drive by default. A run-up takes the place of its speed; where torques turn the input
        freely, only the speed that it starts at does.
    span : float, optional [s]
        How long; to behind the run-up or the end of the longest history, else some turns.
    times : int or array (t,) [s]
        How many samples, or when.
    start : {"even", "settled"}
        From untwisted shafts that turn as rigid ones would, so that all torques come on at once, or from the steady
        motion.
    method : Adaptive or FixedStep, optional
        How to integrate; adaptive by default, but fixed steps where a drive without play swings fast to the end, as
        one without damping does.
    pieces : int
        Into how many equal stretches the body between two stations is divided.
    step : Law, optional
        Torque that comes on the output beside those of the duty, after a settled start too.
    progress : function, optional
        Told the share done; when it answers "stop", what is done is kept.

    Returns
    -------
    Transient

    Raises
    ------
    InputError
        What the model misses, each with the key to add; a settled start where nothing is steady; a span of more turns
        than anyone waits for.

    See Also
    --------
    torsion_response, torsion_modes

    Notes
    -----
    Exact equations of motion, see `transient.simulate`, pendulums with an angle of their own and their stops;
    structural damping counts as viscous, equal at the order of the highest speed at which the joints swing most, 2 of
    cross joints. Where nothing drives a free input, a constant torque does that equals what resists at the start.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from cardan import Drive, transient
    >>> from cardan.parts import Duty, Shaft, Station
    >>> drive = replace(Drive.from_angles([0.2]), shafts=(Shaft(number=1, stiffness=4000.0, damping=2.0),),
    ...     stations=(Station(shaft=2, inertia=0.4),))
    >>> found = transient(drive, Duty(speed=50.0, torque=100.0), span=0.5)
    >>> found.complete, bool(found.motion.imbalance < 1e-9)
    (True, True)
    """
    chosen = drive.duty if duty is None else duty
    first, fastest = _speeds(chosen)
    train = torsional_train(drive, chosen, speed=first or fastest, pieces=pieces)
    if not train.model.elements:
        text = _("missing; every shaft counts as rigid, so nothing vibrates: give a body of known length, or stiffness")
        raise refuse("shafts[0].stiffness", text)
    model = in_time(in_full(train, fastest), main_order(train.model) * abs(fastest or 1.0))
    forced = forced_run_up(drive, chosen)
    if not model.free and forced is None and chosen.speed is None:
        raise refuse("duty.speed", _("missing; torsional vibration needs it"), "missing")
    if forced is not None:
        course = SpeedCourse(times=(0.0, forced.duration), speeds=(forced.start, forced.end))
        model = replace(model, input_speed=None, input_motion=course)
    elif not model.free:
        model = replace(model, input_speed=np.asarray(first))
    angle: Array | None = None
    rate: Array = first * even_rates(model, np.zeros(model.coordinates))
    if start == "settled":
        check(_unsettled(chosen, model))
        swing = main_order(train.model) * abs(fastest or 1.0)
        small = model if not train.pendulums else sprung(in_time(train.model, swing), train, first)
        steady = periodic_response(small, speed=first)
        if not bool(steady.found):
            raise refuse("start", _("no steady motion was found to start from; start even"))
        angle, rate = (one[0, 0] for one in steady.orbit.of(np.asarray([0]), [0.0])[:2])
        if train.pendulums:
            angle, rate = _swung(train, angle, rate)
        if model.free:
            model = _held(model, float(steady.orbit.force))
    elif model.free and first and not _pushed(model):
        model, train = _held(model, _resisting(model, first)), replace(train, assumed=(*train.assumed, "duty.motor"))
    if step is not None:
        model = replace(model, torques=(*model.torques, Torque(station=train.line[-1], law=step)))
    length = _span(chosen, model, fastest) if span is None else span
    check(_endless(model, fastest, length))
    how = _method(model, rate, length) if method is None else method
    motion = simulate(model, span=length, times=times, angle=angle, speed=rate, method=how, progress=progress)
    return Transient(train=train, motion=motion, start=start)


def run_up_torque(drive: Drive) -> tuple[Array, tuple[int, ...]]:
    """Return the torque of every element in a run-up as the duty has it, (t, E) [N·m], and the shafts of the elements.

    Backlash counts as closed; `PEAKS` samples a period of the fastest vibration, so that no peak is missed by much.
    Raises InputError: what the model misses, a run-up too long to be followed, or an input that torques turn freely.
    """
    closed, course = _closed(drive), forced_run_up(drive, drive.duty)
    if drive.duty.run_up is None:
        raise refuse("duty.run_up", _("missing; duty.starts counts run-ups"), "missing")
    if course is None:
        text = _("not followed: torques turn the input freely; a run-up needs a uniform one (duty.input)")
        raise refuse("duty.run_up", text)
    train = torsional_train(closed, speed=max(course.start, course.end, key=abs))
    top = 2.0 * max(abs(course.start), abs(course.end))
    swings = max(_slowest(train.model), top) * (1.0 + AFTER) * course.duration / (2.0 * np.pi)
    if swings > LONGEST:
        text = _("the run-up takes {oscillations:.0f} oscillations; at most {most:.0f} are followed")
        raise refuse("duty.run_up.duration", text.format(oscillations=swings, most=LONGEST), "too_large")
    found = transient(closed, times=max(int(PEAKS * swings), 501), method=_steps(in_full(train, top)))
    return found.motion.torque, tuple(found.train.model.shaft[a] for a, _b in found.train.model.elements)


def _closed(drive: Drive) -> Drive:
    """Return a drive without backlash."""
    joints = tuple(replace(one, backlash=0.0) if one.backlash else one for one in drive.joints)
    shafts = tuple(
        replace(one, spline=replace(one.spline, backlash=0.0)) if one.spline is not None else one
        for one in drive.shafts
    )
    return replace(drive, joints=joints, shafts=shafts)


SLIP = 0.005
"""Share of the speed about which a load that rubs changes its sense."""

TIGHT = 1e-9
"""Share by which the slip of a clutch, or the torque on it, is past its bound."""

FEW = 200
"""Samples over which steps of their own length are quicker than compiled ones."""

SWITCHES = 400
"""Changes between slipping and sticking that are followed."""


def event_torque(drive: Drive, event: Event) -> tuple[Array, tuple[int, ...]]:
    """Return the torque of every element while something happens, (t, E) [N·m], and the shafts of the elements.

    Backlash counts as closed; `PEAKS` samples a period of the slowest vibration or of order 2, the faster of the two.
    A load step comes on the drive as it runs steadily. A clutch closes on a drive that turns freely at `start`, with
    what resists as dry friction, which turns nothing back; the other side of the clutch keeps the speed of the duty.
    Raises InputError: what the model misses, a clutch that slips without end, or an event too long to be followed.
    """
    closed = replace(_closed(drive), duty=replace(drive.duty, run_up=None, starts=None, events=()))
    duty = closed.duty
    speed, load = duty.speed or 0.0, duty.torque or 0.0
    if event.kind == "load_step":
        train = torsional_train(closed, speed=speed)
        span, count = _length(train.model, event.duration, speed)
        more = load - event.torque
        law: Law = Constant(value=more)
        if event.duration:
            law = History(times=np.asarray([0.0, event.duration]), torques=np.asarray([0.0, more]))
        found = transient(closed, span=span, times=count, start="settled", step=law).motion
        return found.torque, tuple(train.model.shaft[a] for a, _b in train.model.elements)
    train = torsional_train(closed, replace(duty, input="uniform", engine=None, motor=None), speed=speed)
    model = in_time(in_full(train, speed), main_order(train.model) * abs(speed))
    band, sense = SLIP * abs(speed), np.sign(speed)
    torques, resisting = [], 0.0
    for one in model.torques:
        if isinstance(one.law, Constant) and float(one.law.value) * sense < 0.0:
            resisting += abs(float(one.law.value))
            rubbing = np.asarray([abs(float(one.law.value)), -abs(float(one.law.value))])
            torques.append(replace(one, law=SpeedTable(speeds=np.asarray([-band, band]), torques=rubbing)))
        else:
            torques.append(one)
    if not event.torque > resisting:
        text = _("{given:.6g} N·m given; the clutch slips without end unless it passes on more than {least:.6g} N·m")
        raise refuse("duty.events.torque", text.format(given=event.torque, least=resisting), "too_small")
    until = max(event.duration, 1e-6)
    slipping = until + float(np.sum(model.inertia)) * abs(abs(speed) - event.start) / (event.torque - resisting)
    span, count = _length(train.model, slipping, speed)
    model = replace(model, input_speed=None, torques=tuple(torques))
    capacity = np.asarray([0.0, until]), np.asarray([0.0, event.torque])
    found = _closing(model, capacity, speed, span, np.linspace(0.0, span, count), sense * event.start)
    return found, tuple(model.shaft[a] for a, _b in model.elements)


def _closing(
    model: TorsionalModel, capacity: tuple[Array, Array], speed: float, span: float, times: Array, start: float
) -> Array:
    """Return the torque of every element while a clutch closes, (t, E) [N·m].

    model: its input free; capacity: times [s] and torques [N·m]; speed [rad/s]: of the other side of the clutch.
    times (t,) [s]: from 0; start [rad/s]: of the drive.
    Coulomb: it slips until both sides turn alike, holds the input at that speed as long as this takes no more torque
    than it passes on, and slips again where it would take more.
    """
    now, angle, rate = 0.0, np.zeros(model.coordinates), start * even_rates(model, np.zeros(model.coordinates))
    stuck, way = False, float(np.sign(speed - start) or 1.0)
    parts: list[Array] = []
    for _switch in range(SWITCHES):
        pulled = Torque(station=0, law=History(times=capacity[0], torques=way * capacity[1]))
        held = replace(model, input_speed=np.asarray(speed))
        run = held if stuck else replace(model, torques=(*model.torques, pulled))
        if stuck:
            rate[0] = speed
        how = _steps(run)
        here = np.append(now, times[times > now])
        found = simulate(run, span=(now, span), times=here, angle=angle, speed=rate, method=how)
        if stuck:
            assert found.input_torque is not None
            past = np.abs(found.input_torque) - np.interp(here, *capacity) * (1.0 + TIGHT)
        else:
            past = way * (found.rate[:, 0] - speed) - TIGHT * abs(speed)
            past[0] = min(past[0], -TIGHT)
        k = int(np.argmax(past > 0.0))
        if not past[k] > 0.0:
            return np.concatenate((*parts, found.torque[0 if not parts else 1 :]))
        if k:
            end = here[k - 1] + (here[k] - here[k - 1]) * past[k - 1] / (past[k - 1] - past[k])
            kept = here[(here > now) & (here < end)]
            if end > now:
                near = Adaptive() if k < FEW else how
                cut = simulate(run, span=(now, end), times=[now, *kept, end], angle=angle, speed=rate, method=near)
                parts.append(cut.torque[0 if not parts else 1 : -1])
                now, angle, rate = float(end), cut.coordinate[-1], cut.rate[-1].copy()
        if stuck:
            assert found.input_torque is not None
            way = float(np.sign(found.input_torque[k]))
        stuck = not stuck
    raise refuse("duty.events", _("a clutch slips and sticks without end"), "unsettled")


def _length(model: TorsionalModel, changing: float, speed: float) -> tuple[float, int]:
    """Return how long an event is followed [s], until what it stirs up has faded, and how many samples it takes."""
    slowest = _slowest(model)
    rate = max(slowest, 2.0 * abs(speed))
    span = changing + (SWINGS * 2.0 * np.pi / slowest if slowest else 0.0)
    swings = rate * span / (2.0 * np.pi)
    if swings > LONGEST:
        text = _("the event takes {oscillations:.0f} oscillations; at most {most:.0f} are followed")
        raise refuse("duty.events.duration", text.format(oscillations=swings, most=LONGEST), "too_large")
    return span, max(int(PEAKS * swings), 501)


def _swung(train: TorsionalTrain, angle: Array, rate: Array) -> tuple[Array, Array]:
    """Return angles and speeds of the coordinates with pendulums turned by θ: their swing is u (R + l)/l.

    u is the twist of the absorber by which steady answers replace a small swing.
    """
    place = places(train.model, angle)
    speed = place.first * rate[list(train.model.coordinate)]
    angle, rate = angle.copy(), rate.copy()
    for e, hung in zip(train.pendulums, train.hung, strict=True):
        pivot, tip = train.model.elements[e]
        own, wide = train.model.coordinate[tip], 1.0 + hung.radius / hung.length
        angle[own] = place.angle[pivot] + wide * (place.angle[tip] - place.angle[pivot])
        rate[own] = speed[pivot] + wide * (speed[tip] - speed[pivot])
    return angle, rate


def _held(model: TorsionalModel, force: float) -> TorsionalModel:
    """Return a drive with a constant torque on its input."""
    return replace(model, torques=(*model.torques, Torque(station=0, law=Constant(value=force))))


def _pushed(model: TorsionalModel) -> bool:
    """Tell whether anything but a swinging torque acts on the input."""
    return any(torque.station == 0 and not isinstance(torque.law, Swinging) for torque in model.torques)


def _resisting(model: TorsionalModel, speed: float) -> float:
    """Return the torque on the input that what resists takes at the start [N·m]."""
    taken = float(np.sum(model.ground_damping)) * speed
    for torque in model.torques:
        if not isinstance(torque.law, Swinging):
            taken -= float(torque.law.at(np.asarray(0.0), np.asarray(0.0), np.asarray(speed))[0])
    return taken


def _speeds(duty: Duty) -> tuple[float, float]:
    """Return the speed at the start and the highest one meant."""
    if duty.run_up is not None:
        ends = duty.run_up.start, duty.run_up.end
        return ends[0], max(ends, key=abs)
    return duty.speed or 0.0, duty.speed or 0.0


def _unsettled(duty: Duty, model: TorsionalModel) -> Iterator[Problem]:
    """Yield what keeps a drive from running steadily."""
    if duty.run_up is not None:
        yield Problem("duty.run_up", _("its speed changes; a settled start needs a steady speed"))
    if duty.speed is None:
        yield Problem("duty.speed", _("missing; a settled start needs it"), "missing")
    if any(torque.law.order is None for torque in model.torques):
        yield Problem("duty", _("a torque runs in time; a settled start needs torques that follow angle or speed"))
    elif parted(model)[1]:
        yield Problem("duty", _("orders of the torques do not repeat within two turns; start even"))


def _method(model: TorsionalModel, rate: Array, span: float) -> Method:
    """Return the quicker way to follow a drive."""
    free = np.arange(model.coordinates)[0 if model.free else 1 :]
    if isinstance(_steps(model), Adaptive) or np.any(model.backlash > 0.0) or not span > 0.0:
        return Adaptive()
    rates = np.broadcast_to(rate, (model.coordinates,))
    _fastest, living = own_rates(model, free, np.zeros(model.coordinates), rates, 0.0, span)
    return FixedStep(per_period=SMOOTH) if float(living) * span > RADIANS * MANY else Adaptive()


def _steps(model: TorsionalModel) -> Method:
    """Return steps of one length, compiled, where a drive without play bears them."""
    free = np.arange(model.coordinates)[0 if model.free else 1 :]
    light = np.any(gathered(model, model.inertia)[free] == 0.0)
    return Adaptive() if light or not model.steppable else FixedStep(per_period=PEAKS)


def _span(duty: Duty, model: TorsionalModel, fastest: float) -> float:
    """Return how long to simulate where nothing says it [s]."""
    found = 0.0 if duty.run_up is None else (1.0 + AFTER) * duty.run_up.duration
    for machine in (duty.motor, duty.load, *duty.torques):
        if isinstance(machine, TorqueHistory):
            found = max(found, machine.times[-1])
    if not found:
        slowest = _slowest(model)
        swing = 2.0 * np.pi / slowest if slowest else 0.0
        found = max(TURNS * 2.0 * np.pi / abs(fastest) if fastest else 1.0, SWINGS * swing)
    return found


def _slowest(model: TorsionalModel) -> float:
    """Return the lowest natural frequency of the stretched drive, 0 where nothing swings [rad/s]."""
    bare = replace(model, torques=(), input_speed=None if model.free else np.asarray(0.0), input_motion=None)
    omega = straight_modes(bare).omega
    return float(omega[0]) if len(omega) else 0.0


def _endless(model: TorsionalModel, fastest: float, length: float) -> Iterator[Problem]:
    """Yield a span of more turns or swings than can be followed."""
    rate = max(abs(fastest), _slowest(model))
    turns = rate * length / (2.0 * np.pi)
    if turns > FOLLOWED:
        text = _(
            "{span:.6g} s are {turns:,.0f} turns or oscillations; at most {most:,} are followed, {longest:.3g} s here"
        )
        longest = FOLLOWED * 2.0 * np.pi / rate
        yield Problem("span", text.format(span=length, turns=turns, most=FOLLOWED, longest=longest), "too_large")


# Does a motor hang on a resonance? Speed that stops rising while power is there: the Sommerfeld effect.

AVERAGED_TURNS = 4.0
"""Turns of a window: speeds are means over them, whole periods of joints and engines."""

STANDING = 0.1
"""A drive that speeds up by less than this share of what it could hangs."""

MATTERS = 0.05
"""Share of its speed that a drive could have gained meanwhile, for its hanging to be told."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Sommerfeld:
    """A stretch of time in which the speed did not rise although torque was left over."""

    start: float  # [s]
    end: float  # [s]
    speed: float  # [rad/s]: mean speed of the first station meanwhile
    could: float  # [rad/s²]: mean acceleration that the torques would give the same drive if it did not swing
    did: float  # [rad/s²]
    power: float  # [W]: mean power that went into swinging


def sommerfeld(model: TorsionalModel, found: Simulation) -> tuple[Sommerfeld, ...]:
    """Return where a drive that torques turn hung on a resonance.

    model: one drive, as it was simulated; found: with some samples in every turn.
    Returns: empty where it passed all resonances, and where its speed is forced.
    Near half a natural frequency the joints swing the drive, and its dampers take the power that would raise the
    speed: the torque that is left, M(Ω) - Σ b_g Ω over Σ J, is compared with the rise of the mean speed over turns.
    """
    if not model.free or np.ndim(found.status):
        return ()
    good = np.isfinite(found.coordinate[:, 0])
    times, angle = found.times[good], np.abs(found.coordinate[good, 0] - found.coordinate[0, 0])
    angle = np.maximum.accumulate(angle) if len(angle) else angle
    count = int(angle[-1] / (2.0 * np.pi * AVERAGED_TURNS)) if len(angle) else 0
    if count < 3:
        return ()
    edges = np.interp(2.0 * np.pi * AVERAGED_TURNS * np.arange(count + 1), angle, times)
    sense = np.sign(found.coordinate[good, 0][-1] - found.coordinate[0, 0])
    speed = 2.0 * np.pi * AVERAGED_TURNS / np.diff(edges)
    middle = 0.5 * (edges[1:] + edges[:-1])
    did = np.diff(speed) / np.diff(middle)
    between = 0.5 * (middle[1:] + middle[:-1])
    mean = 0.5 * (speed[1:] + speed[:-1])
    inertia = float(np.sum(model.inertia))
    could = sense * _torque(model, between, sense * mean) / inertia
    stuck = (could > 0.0) & (did < STANDING * could)
    hangs = []
    for first, last in _stretches(stuck):
        part = slice(first, last)
        length = middle[last] - middle[first]
        gain = float(np.mean(could[part]))
        if gain * length > MATTERS * float(np.mean(mean[part])):
            rise = float(np.mean(did[part]))
            hangs.append(
                Sommerfeld(
                    start=float(middle[first]),
                    end=float(middle[last]),
                    speed=float(sense * np.mean(mean[part])),
                    could=gain,
                    did=rise,
                    power=(gain - rise) * inertia * float(np.mean(mean[part])),
                )
            )
    return tuple(hangs)


def _torque(model: TorsionalModel, time: Array, speed: Array) -> Array:
    """Return the sum of the torques on a drive that turns evenly, swinging ones left out."""
    total = -np.sum(model.ground_damping) * speed
    for torque in model.torques:
        if torque.law.order is None or torque.law.order == 0.0:
            total = total + torque.law.at(time, 0.0 * speed, speed)[0]
    return total


def _stretches(flags: Array) -> list[tuple[int, int]]:
    """Return first and last index of each run of true flags, the last one past its end."""
    edges = np.diff(np.concatenate(([0], flags.astype(int), [0])))
    return list(zip(np.flatnonzero(edges == 1).tolist(), np.flatnonzero(edges == -1).tolist(), strict=True))
