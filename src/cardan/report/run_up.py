"""What the torques do while the speed of the duty rises or falls: every resonance on the way is passed."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.machine import RunUp
from cardan.errors import InputError
from cardan.figures.wording import significant
from cardan.maths.ties import foremost
from cardan.questions.torsion.model.machine_torques import turns_freely
from cardan.questions.torsion.model.torsion import TorsionModes, torsion_modes
from cardan.questions.torsion.transient.figure import transient_figure
from cardan.questions.torsion.transient.fixed_steps import FixedStep
from cardan.questions.torsion.transient.torsion_transient import AFTER, Transient, transient
from cardan.texts import _
from cardan.units import rpm

from .balance import checks, refused
from .block import Block, Cell, Column, Page, Picture, Table, Words, key, number, words
from .lacking import of_run_up
from .subject import Progress, Subject

SMOOTH, STRIKING = 20.0, 600.0
"""Steps in a period of the fastest swing, and in drives with play: contacts fall somewhere within a step."""

MOST = 3e6
"""Steps that a report waits for."""

ACROSS, SAMPLES = 20.0, (1501, 4001)
"""Samples of the curves: in a swing of order 2 at the highest speed, fewest and most in all."""

ORDER = 4.0
"""Highest order of the joints that counts."""

ENERGY = 1e-4
"""Share of the largest energy or work that the account of energy may miss: contacts fall into steps."""


def running_up(on: Subject, progress: Progress | None = None) -> Page | None:
    """Return the page of a run-up; None where the duty has none, or the file no torsional line.

    Parameters
    ----------
    on : Subject
        The drive.
    progress : function, optional
        Called with the share done; answering "stop" ends the work.
    """
    drive, course = on.drive, on.drive.duty.run_up
    if course is None or of_run_up(drive) or turns_freely(drive, drive.duty):
        return None
    title = _("Running up")
    try:
        modes = torsion_modes(drive)
        steps = _steps(modes, course)
        found = None if steps > MOST else _followed(drive, course, progress, play=_plays(modes))
    except InputError as error:
        return refused("run-up", title, error)
    if found is None:
        text = _("It would take {count} steps to follow; ask for it: cardan torsion simulate.")
        said = text.format(count=significant(steps, 2))
        return Page(name="run-up", title=title, answer=said, blocks=[*_passed(modes, course)])
    alarms = list(_alarms(found))
    blocks: list[Block] = [*alarms, Picture(figure=transient_figure(found)), _torques(found, course)]
    blocks += [*_passed(modes, course), _checks(found)]
    return Page(
        name="run-up",
        title=title,
        answer=_answer(found, course),
        blocks=blocks,
        keys=[key(_("largest torque while running up"), abs(_largest(found)[1]), "N·m")],
        alarms=alarms,
    )


def _plays(modes: TorsionModes) -> bool:
    return bool(np.any(modes.train.model.backlash > 0.0))


def _steps(modes: TorsionModes, course: RunUp) -> float:
    """Return how many steps the run-up takes, about."""
    fastest = max(float(np.max(modes.omega, initial=0.0)), ORDER * max(abs(course.start), abs(course.end)))
    each = STRIKING if _plays(modes) else SMOOTH
    return (1.0 + AFTER) * course.duration * fastest / (2.0 * math.pi) * each


def _followed(drive: Drive, course: RunUp, progress: Progress | None, *, play: bool) -> Transient:
    swings = 2.0 * max(abs(course.start), abs(course.end)) / (2.0 * math.pi) * course.duration
    samples = int(min(max(ACROSS * swings, SAMPLES[0]), SAMPLES[1]))
    return transient(drive, times=samples, method=FixedStep(per_period=STRIKING if play else SMOOTH), progress=progress)


def _speed_at(course: RunUp, time: float) -> float:
    """Return the input speed at a moment [rad/s]."""
    return course.start + (course.end - course.start) * min(time / course.duration, 1.0)


def _largest(found: Transient) -> tuple[int, float, float]:
    """Return the element that carries most, its torque with its sign [N·m], and when [s]."""
    ends = found.motion.extremes
    low, high = np.nan_to_num(ends.torque_low), np.nan_to_num(ends.torque_high)
    e = int(foremost(np.maximum(np.abs(low), np.abs(high))))
    if abs(high[e]) >= abs(low[e]):
        return e, float(high[e]), float(ends.torque_high_time[e])
    return e, float(low[e]), float(ends.torque_low_time[e])


def _answer(found: Transient, course: RunUp) -> str:
    e, torque, time = _largest(found)
    text = _(
        "While the input goes from {start} to {end} rpm in {span} s, the torque in {name} reaches {torque} N·m, at "
        "{speed} rpm."
    )
    return text.format(
        start=significant(course.start / rpm, 3) if course.start else "0",
        end=significant(course.end / rpm, 3) if course.end else "0",
        span=significant(course.duration, 3),
        name=found.train.element_names[e],
        torque=significant(torque),
        speed=significant(_speed_at(course, time) / rpm, 3),
    )


def _alarms(found: Transient) -> Iterator[Words]:
    """Yield what the reader must not overlook."""
    ends, model = found.motion.extremes, found.train.model
    if not found.complete:
        text = _("The run-up could be followed for {span} s only.")
        yield Words(text=text.format(span=significant(float(found.motion.ended), 3)), tone="failed")
    for e in np.flatnonzero((ends.torque_low < 0.0) & (ends.torque_high > 0.0) & (model.backlash > 0.0)):
        text = _("While running up the torque in {name} changes its sign: its play is passed through and strikes.")
        yield Words(text=text.format(name=found.train.element_names[e]), tone="warning")


def _torques(found: Transient, course: RunUp) -> Table:
    ends = found.motion.extremes
    rows: list[list[Cell]] = []
    for e, name in enumerate(found.train.element_names):
        row = [words(name)]
        for torque, time in ((ends.torque_high, ends.torque_high_time), (ends.torque_low, ends.torque_low_time)):
            value, at = float(torque[e]), float(time[e])
            row += [number(significant(value), value), number(significant(at, 3), at)]
            row.append(number(significant(_speed_at(course, at) / rpm, 3), _speed_at(course, at) / rpm))
        rows.append(row)
    return Table(
        title=_("Torques while running up"),
        columns=(
            Column(heading=_("in"), left=True),
            Column(heading=_("highest"), unit="N·m"),
            Column(heading=_("at"), unit="s"),
            Column(heading=_("at input"), unit="rpm"),
            Column(heading=_("lowest"), unit="N·m"),
            Column(heading=_("at"), unit="s"),
            Column(heading=_("at input"), unit="rpm"),
        ),
        rows=rows,
        note=_("It starts with untwisted shafts: the torque of the duty comes on at once, and some of this is that."),
    )


def _passed(modes: TorsionModes, course: RunUp) -> Iterator[Table]:
    """Yield the resonances on the way, where there are any."""
    rate = (course.end - course.start) / course.duration
    met = [
        ((speed - course.start) / rate, speed, one)
        for one in modes.crossings
        for speed in (one.speed, -one.speed)
        if min(course.start, course.end) <= speed <= max(course.start, course.end)
    ]
    if not met:
        return
    rows = [
        [
            number(significant(time, 3), time),
            number(significant(speed / rpm, 3), speed / rpm),
            number(f"{one.order:g}", one.order),
            words(one.cause),
            words(str(one.mode)),
        ]
        for time, speed, one in sorted(met, key=lambda row: row[0])
    ]
    yield Table(
        title=_("Resonances on the way"),
        columns=(
            Column(heading=_("after"), unit="s"),
            Column(heading=_("at input"), unit="rpm"),
            Column(heading=_("order")),
            Column(heading=_("of"), left=True),
            Column(heading=_("meets mode")),
        ),
        rows=rows,
        note=_("The torque peaks behind a resonance; the faster that is passed, the lower."),
    )


def _checks(found: Transient) -> Table:
    how = _("energy and work of the run-up, over the largest")
    return checks([(_("account of energy"), how, float(found.motion.imbalance), ENERGY)])
