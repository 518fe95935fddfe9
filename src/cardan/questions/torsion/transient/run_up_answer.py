"""What there is to say of a run-up: the largest torques, and every resonance that is passed on the way."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from cardan.answers.answer import Answer, Column, KeyFigure, Remark, Table
from cardan.answers.quantity import Quantity, Text, say
from cardan.answers.question import Lacking, absent
from cardan.answers.sweepable import OutputColumn, SweepQuestion
from cardan.drive.drive import Drive
from cardan.drive.machine import RunUp
from cardan.errors import refuse
from cardan.later import later
from cardan.questions.assumed import yokes_estimated
from cardan.questions.torsion.model.answer import lacking as lacking_modes
from cardan.questions.torsion.model.answer import left_out, torques_left_out
from cardan.questions.torsion.model.excitation import forced_run_up
from cardan.questions.torsion.model.torsion import TorsionModes, torsion_modes
from cardan.texts import _, mark

from .answer import element_table, everything, facts, largest, remarks, speed_at
from .fixed_steps import FixedStep
from .torsion_transient import AFTER, Transient, transient

drawn = later("cardan.questions.torsion.transient.figure")

# A run-up of the duty followed in time, in steps of one length, unless that takes too long.

SMOOTH, STRIKING = 20.0, 600.0
"""Steps in a period of the fastest vibration, and in drives with backlash: contacts fall somewhere within a step."""

MOST, MOST_FREE = 3e6, 2e5
"""Steps that are waited for, and of drives with pendulums, which are not compiled."""

ACROSS, SAMPLES = 20.0, (1501, 4001)
"""Samples of the curves: in a period of order 2 at the highest speed, fewest and most in all."""

ORDER = 4.0
"""Highest order of the joints that counts."""


@dataclass(frozen=True, eq=False, kw_only=True)
class FollowedRunUp:
    """A run-up with the resonances on its way."""

    course: RunUp  # how the speed of the input goes
    modes: TorsionModes  # what it passes
    steps: float  # how many steps it takes, about
    motion: Transient | None  # torques and speeds in time; None where that takes too many steps


def follow(drive: Drive, course: RunUp, *, progress: Callable[[float], object] | None = None) -> FollowedRunUp:
    """Return a run-up of a drive, followed in time where that does not take too long.

    drive: with this run-up in its duty; course: how the speed of its input goes.
    """
    modes = torsion_modes(drive)
    each = STRIKING if np.any(modes.train.model.backlash > 0.0) else SMOOTH
    top = max(abs(course.start), abs(course.end))
    fastest = max(float(np.max(modes.omega, initial=0.0)), ORDER * top)
    steps = (1.0 + AFTER) * course.duration * fastest / (2.0 * math.pi) * each
    free = bool(modes.train.pendulums or modes.train.springs or modes.train.model.sums is not None)
    if steps > (MOST_FREE if free else MOST):
        return FollowedRunUp(course=course, modes=modes, steps=steps, motion=None)
    samples = int(min(max(ACROSS * 2.0 * top / (2.0 * math.pi) * course.duration, SAMPLES[0]), SAMPLES[1]))
    method = None if free else FixedStep(per_period=each)
    motion = transient(drive, times=samples, method=method, progress=progress)
    return FollowedRunUp(course=course, modes=modes, steps=steps, motion=motion)


__all__ = ["COLUMNS", "answer", "ask", "lacking", "otherwise"]


def lacking(drive: Drive) -> Lacking:
    """Return what the drive file lacks for a run-up."""
    return (*lacking_modes(drive), *absent((drive.duty.run_up is not None, "duty.run_up")))


def otherwise(_drive: Drive) -> str:
    """Return why there is nothing to tell although nothing is missing."""
    return _("Torques turn its input freely; a run-up at a steady rate forces a speed on it.")


def ask(drive: Drive, *, progress: Callable[[float], object] | None = None) -> FollowedRunUp | None:
    """Return the run-up of the duty, None where torques turn the input freely."""
    course = forced_run_up(drive, drive.duty)
    return None if course is None else follow(drive, course, progress=progress)


def answer(drive: Drive, result: FollowedRunUp) -> Answer:
    """Return what there is to say of the run-up of a drive."""
    passed = tuple(_passed(result))
    title, motion, estimated = _("Run-up"), result.motion, tuple(yokes_estimated(drive))
    if motion is None:
        text = _("it would take {count} steps to follow; cardan torsion simulate does it.")
        count = Quantity(result.steps, digits=2)
        return Answer(name="run-up", title=title, sentence=say(text, count=count), tables=passed, remarks=estimated)
    alarms = tuple(_alarms(motion))
    e, torque, _time = largest(motion)
    key = KeyFigure(
        name="run_up_torque",
        title=_("largest torque during run-up"),
        value=Quantity(abs(torque), "torque"),
        place=motion.train.elements[e],
        better="",
    )
    return Answer(
        name="run-up",
        title=title,
        sentence=_sentence(result, motion),
        tone="warning" if alarms else "plain",
        figures=lambda: drawn().transient_figures(motion),
        tables=(element_table(motion, result.course), *passed),
        remarks=(*alarms, *remarks(motion), *torques_left_out(drive), *left_out(drive), *estimated),
        keys=(key,),
        facts=facts(motion),
        full=lambda: everything(motion),
    )


def _speed(value: float) -> Quantity:
    return Quantity(value, "angular_speed", 3)


def _sentence(result: FollowedRunUp, motion: Transient) -> Text:
    e, torque, time = largest(motion)
    text = _(
        "while the input goes from {start:bare} to {end} in {span}, the torque in {element} reaches {torque} at "
        "{speed}."
    )
    return say(
        text,
        start=_speed(result.course.start),
        end=_speed(result.course.end),
        span=Quantity(result.course.duration, "time", 3),
        element=motion.train.elements[e],
        torque=Quantity(torque, "torque"),
        speed=_speed(float(speed_at(result.course, time))),
    )


def _alarms(motion: Transient) -> Iterator[Remark]:
    """Yield what must not be overlooked."""
    ends, model = motion.motion.extremes, motion.train.model
    if not motion.complete:
        text = _("The run-up could be followed for {span} only.")
        ended = Quantity(float(motion.motion.ended), "time", 3)
        yield Remark(text=say(text, span=ended), tone="failed", alarm=True)
    for e in np.flatnonzero((ends.torque_low < 0.0) & (ends.torque_high > 0.0) & (model.backlash > 0.0)):
        text = _("During the run-up the torque in {element} changes its sign: its backlash is crossed with impacts.")
        yield Remark(text=say(text, element=motion.train.elements[int(e)]), tone="warning", alarm=True)


def _passed(result: FollowedRunUp) -> Iterator[Table]:
    """Yield the resonances on the way, where there are any."""
    course = result.course
    low, high = sorted((course.start, course.end))
    rate = (course.end - course.start) / course.duration
    met = [
        ((speed - course.start) / rate, speed, one)
        for one in result.modes.crossings
        for speed in (one.speed, -one.speed)
        if low <= speed <= high
    ]
    if not met:
        return
    met.sort(key=lambda row: row[0])
    crossings = [one for _time, _speed, one in met]
    yield Table(
        name="resonances",
        title=_("Resonances on the way"),
        columns=(
            Column(key="time", heading=_("after"), values=[one[0] for one in met], dimension="time", digits=3),
            Column(
                key="speed", heading=_("input at"), values=[one[1] for one in met], dimension="angular_speed", digits=3
            ),
            Column(key="order", heading=_("order"), values=[Quantity(one.order, trim=True) for one in crossings]),
            Column(key="cause", heading=_("excited by"), values=[one.cause for one in crossings], left=True),
            Column(key="mode", heading=_("mode"), values=[one.mode for one in crossings]),
        ),
        note=_("The torque peaks behind a resonance; the faster that is passed, the lower the peak."),
    )


def _column_values(found: FollowedRunUp) -> tuple[float]:
    if found.motion is None:
        raise refuse("duty.run_up", _("the run-up takes too many steps to follow"))
    return (abs(largest(found.motion)[1]),)


COLUMNS = (
    SweepQuestion(
        name="run-up",
        doc=mark("largest torque during the run-up of the duty"),
        told=(OutputColumn.of("run_up_torque_Nm", mark("largest torque during run-up")),),
        of_result=_column_values,
    ),
)
"""What a sweep may ask of a run-up."""
