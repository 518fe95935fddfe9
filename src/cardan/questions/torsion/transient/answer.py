"""What there is to say of torsional motion in time: how far torques and speeds go, and what to mind."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from cardan.answers.answer import FILE, Answer, Column, Remark, Table, Tone, closely
from cardan.answers.quantity import Joined, Quantity, Text, say
from cardan.drive.drive import Drive
from cardan.drive.machine import RunUp, TorqueHistory
from cardan.later import later
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost
from cardan.questions.assumed import yokes_estimated
from cardan.questions.torsion.model.answer import assumptions, left_out, torques_left_out
from cardan.questions.torsion.model.excitation import forced_run_up
from cardan.questions.torsion.model.torsional_modes import main_order
from cardan.texts import _

from .simulation import Status
from .torsion_transient import Transient

drawn = later("cardan.questions.torsion.transient.figure")

__all__ = ["answer"]

ENERGY = 1e-4
"""Share of the largest energy or work that the account of energy may miss: contacts fall into steps."""


def answer(drive: Drive, result: Transient) -> Answer:
    """Return what there is to say of the torsional motion of a drive in time."""
    tone, said = _sentence(result)
    return Answer(
        name="torsion-simulate",
        title=_("Torques and speeds in time"),
        sentence=said,
        tone=tone,
        figures=lambda: drawn().transient_figures(result),
        tables=(element_table(result, forced_run_up(drive, drive.duty)), _station_table(result)),
        remarks=(
            *_unforced(drive),
            *remarks(result),
            *torques_left_out(drive),
            *left_out(drive),
            *_unread(drive),
            *yokes_estimated(drive),
            *_next(drive, result),
        ),
        facts=facts(result),
        full=lambda: everything(result),
        code=1 if tone == "failed" else 0,
    )


def largest(found: Transient) -> tuple[int, float, float]:
    """Return the element that carries most, its torque with its sign [N·m], and when [s]."""
    ends = found.motion.extremes
    low, high = np.nan_to_num(ends.torque_low), np.nan_to_num(ends.torque_high)
    e = int(foremost(np.maximum(np.abs(low), np.abs(high))))
    if abs(high[e]) >= abs(low[e]):
        return e, float(high[e]), float(ends.torque_high_time[e])
    return e, float(low[e]), float(ends.torque_low_time[e])


def _sentence(found: Transient) -> tuple[Tone, Text]:
    e, peak, time = largest(found)
    first = say(
        _("within {span} the torque in {element} reaches {peak}, after {time}"),
        span=_time(found.motion.ended),
        element=found.train.elements[e],
        peak=Quantity(peak, "torque"),
        time=_time(time),
    )
    ends = {
        Status.DIVERGED: _("then the motion diverged."),
        Status.SNAPPED: _("then the torque snapped a joint without inertia through."),
        Status.STALLED: _("then no step was short enough."),
    }
    status = Status(int(found.motion.status))
    if status in ends:
        return "failed", Joined([first, ends[status]], between="; ")
    if striking(found).any():
        text = _("torques change their sign, so that backlash is crossed with impacts.")
        return "warning", Joined([first, text], between="; ")
    return "plain", Joined([first, "."], between="")


def striking(found: Transient) -> Array:
    """Return which elements have a torque that changes its sign in a line with backlash, array of bool (E,)."""
    ends = found.motion.extremes
    reversed_ = (ends.torque_low < 0.0) & (ends.torque_high > 0.0) & np.any(found.train.model.backlash > 0.0)
    reversed_[list(found.train.pendulums)] = False
    return reversed_


def _time(value: Any) -> Quantity:
    return Quantity(float(value), "time", 3)


def speed_at(course: RunUp, time: Any) -> Array:
    """Return the input speed of a run-up at moments [rad/s]."""
    return course.start + (course.end - course.start) * np.minimum(np.asarray(time) / course.duration, 1.0)


def element_table(found: Transient, course: RunUp | None) -> Table:
    """Return lowest and highest torque of every element, when, and in a run-up at which speed of the input."""
    ends = found.motion.extremes
    columns = [Column(key="name", heading=_("element"), values=list(found.train.elements), left=True)]
    for key, heading, torque, time in (
        ("min", _("lowest"), ends.torque_low, ends.torque_low_time),
        ("max", _("highest"), ends.torque_high, ends.torque_high_time),
    ):
        columns.append(Column(key=key, heading=heading, values=torque, dimension="torque"))
        columns.append(Column(key=f"{key}_at", heading=_("after"), values=time, dimension="time", digits=3))
        if course is not None:
            at = speed_at(course, time)
            heading = _("input at")
            columns.append(
                Column(key=f"{key}_input_speed", heading=heading, values=at, dimension="angular_speed", digits=3)
            )
    return Table(name="elements", title=_("Lowest and highest torques"), records=True, columns=columns)


def _station_table(found: Transient) -> Table:
    ends = found.motion.extremes
    named = (
        ("min", _("lowest"), ends.speed_low),
        ("max", _("highest"), ends.speed_high),
        ("end", _("at the end"), found.motion.speed[-1]),
    )
    return Table(
        name="stations",
        title=_("Lowest and highest speeds"),
        records=True,
        columns=(
            Column(key="name", heading=_("station"), values=list(found.train.station_names), left=True),
            *(
                Column(key=key, heading=heading, values=values, dimension="angular_speed")
                for key, heading, values in named
            ),
        ),
    )


def remarks(found: Transient) -> Iterator[Remark]:
    """Yield what is to be minded of a motion in time."""
    motion = found.motion
    if int(motion.status) == Status.CANCELLED:
        text = _("Warning: stopped after {ended}; what was done is shown.")
        yield Remark(text=say(text, ended=_time(motion.ended)), tone="warning")
    for hang in found.hangs:
        text = _(
            "Warning: from {start:bare} to {end} the speed hangs at {speed} although the motor could raise it by "
            "{could}: vibration takes {power} (Sommerfeld effect)."
        )
        said = say(
            text,
            start=_time(hang.start),
            end=_time(hang.end),
            speed=Quantity(hang.speed, "angular_speed", 3),
            could=Quantity(hang.could, "angular_acceleration", 3),
            power=Quantity(hang.power, "power", 3, unit="kW"),
        )
        yield Remark(text=said, tone="warning")
    if found.start == "even":
        text = _(
            "It starts from untwisted shafts that turn as rigid ones would: all torques come on at once, which adds "
            "to the peaks."
        )
        yield Remark(text=text)
    yield from _pendulums(found)
    if np.any(found.train.model.loss_factor):
        text = _("Structural damping counts as viscous, equal at order {order} of the highest speed.")
        yield Remark(text=say(text, order=Quantity(main_order(found.train.model), trim=True)))
    yield from assumptions(found.train, wide=True, sprung=True)
    yield _checked(found)


def _unforced(drive: Drive) -> Iterator[Remark]:
    """Yield that a run-up is not followed where torques turn the input freely."""
    course = drive.duty.run_up
    if course is not None and forced_run_up(drive, drive.duty) is None:
        text = _(
            "Warning: the run-up is not followed but for the {speed} that it starts at: torques turn the input freely, "
            "and they alone decide its speed."
        )
        yield Remark(text=say(text, speed=Quantity(course.start, "angular_speed")), tone="warning")


def _unread(drive: Drive) -> Iterator[Remark]:
    """Yield speeds that were measured beside a torque."""
    for law in (drive.duty.motor, drive.duty.load, *drive.duty.torques):
        if isinstance(law, TorqueHistory) and law.speeds:
            text = _("The speeds in {file} are not followed: only its torque acts.")
            yield Remark(text=text.format(file=law.file))


def _pendulums(found: Transient) -> Iterator[Remark]:
    """Yield how far pendulums swing, and whether they meet their stops."""
    train = found.train
    for e, hung, swing in zip(train.pendulums, train.hung, found.swings, strict=True):
        name, wide = train.elements[e], Quantity(swing, "angle", 3)
        if hung.stop_angle is None:
            text = _("The {name} oscillates by up to ±{angle}.")
            if swing > 0.5 * np.pi:
                text = _("Warning: the {name} oscillates by up to ±{angle}: give it stops (stop_angle).")
            tone: Tone = "warning" if swing > 0.5 * np.pi else "plain"
            yield Remark(text=say(text, name=name, angle=wide), tone=tone)
        elif swing > hung.stop_angle:
            text = _("Warning: the {name} hits its stops at ±{stop}.")
            yield Remark(text=say(text, name=name, stop=Quantity(hung.stop_angle, "angle", 3)), tone="warning")
        else:
            text = _("The {name} oscillates by up to ±{angle} and stays clear of its stops at ±{stop}.")
            yield Remark(text=say(text, name=name, angle=wide, stop=Quantity(hung.stop_angle, "angle", 3)))
    if train.pendulums and found.start == "settled":
        yield Remark(text=_("The steady motion that it starts from is that of small oscillations of the pendulums."))


def _next(drive: Drive, found: Transient) -> Iterator[Remark]:
    """Yield what to ask next."""
    if found.start == "even" and drive.duty.run_up is None:
        settled = ("cardan", "torsion", "simulate", FILE, "--settled")
        yield Remark(text=_("From the steady motion instead:"), command=settled, tone="next")
    decays = ("cardan", "torsion", "stability", FILE)
    yield Remark(text=_("Whether such vibration decays:"), command=decays, tone="next")


def _checked(found: Transient) -> Remark:
    """Return how closely the account of energy closes."""
    motion, left = found.motion, float(found.motion.imbalance)
    known = {"explicit": _("explicit"), "implicit": _("implicit"), "fixed steps": _("of one length")}
    text = _("Checked: the account of energy closes {closely} ({steps} steps, {method}).")
    poor = not left <= ENERGY
    if poor:
        text = _("Warning: the account of energy closes only {closely} ({steps} steps, {method}).")
    steps, method = Quantity(float(motion.steps), digits=9, trim=True), known.get(motion.method, motion.method)
    said = say(text, closely=closely(left), steps=steps, method=method)
    return Remark(text=said, tone="warning" if poor else "plain", aside=not poor)


def everything(found: Transient) -> Table:
    """Return torques and speeds, one moment a row."""
    motion = found.motion
    columns = [Column(key="time", values=motion.times, dimension="time")]
    columns += [
        Column(key=f"element_{e}_torque", values=one, dimension="torque") for e, one in enumerate(motion.torque.T, 1)
    ]
    columns += [
        Column(key=f"station_{k}_speed", values=one, dimension="angular_speed")
        for k, one in enumerate(motion.speed.T, 1)
    ]
    columns += [
        Column(key=f"station_{k}_angle", values=one, dimension="angle") for k, one in enumerate(motion.angle.T, 1)
    ]
    if motion.input_torque is not None:
        columns.append(Column(key="input_torque", values=motion.input_torque, dimension="torque"))
    columns.append(Column(key="energy", values=motion.energy, dimension="work"))
    return Table(name="curves", columns=columns)


def facts(found: Transient) -> dict[str, Any]:
    """Return what else a program is told of a motion in time."""
    return {
        "start": found.start,
        "complete": found.complete,
        "ended": Quantity(float(found.motion.ended), "time"),
        "hangs": [
            {
                "from": Quantity(hang.start, "time"),
                "to": Quantity(hang.end, "time"),
                "speed": Quantity(hang.speed, "angular_speed"),
                "possible_acceleration": Quantity(hang.could, "angular_acceleration"),
                "power": Quantity(hang.power, "power"),
            }
            for hang in found.hangs
        ],
        "energy_imbalance": found.motion.imbalance,
        "steps": found.motion.steps,
        "method": found.motion.method,
        "assumed": found.train.assumed,
    }
