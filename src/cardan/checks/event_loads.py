"""Starts, clutches and load steps of a duty followed in time: cycles of the torques, and largest loads."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from cardan.drive.conditions import LoadCase, under
from cardan.drive.drive import Drive
from cardan.drive.machine import Event, RunUp
from cardan.errors import InputError, Problem
from cardan.later import later
from cardan.questions.forces.turn_loads import TurnLoads, case_loads
from cardan.questions.life.rainflow import Cycles, rainflow
from cardan.texts import _, language

from .load_case import Vibration

transient = later("cardan.questions.torsion.transient.torsion_transient")
"""How events go on in time: few drives say any."""

CLASSES = (200, 50)
"""Classes of range and of mean into which more different cycles than these have are sorted."""

SLOPE = 6.0
"""Exponent by which the range of a class damages as much as the cycles in it, whose ranges differ by half a percent."""


def sorted_into_classes(cycles: Cycles) -> Cycles:
    """Return equal cycles as one, and very many different ones in classes that damage as much."""
    most = max(float(np.max(cycles.range, initial=0.0)), 1e-300)
    for fine in (1e-9, None):
        steps = (most * fine, most * fine) if fine else (most / CLASSES[0], most / CLASSES[1])
        keys = np.round(np.stack((cycles.range / steps[0], np.abs(cycles.mean) / steps[1]), axis=-1))
        _classes, where = np.unique(keys, axis=0, return_inverse=True)
        where = where.reshape(-1)
        if np.max(where, initial=-1) < CLASSES[0] * 2:
            break
    count = np.bincount(where, cycles.count)
    power, mean = (
        np.bincount(where, cycles.count * one) / count for one in ((cycles.range / most) ** SLOPE, np.abs(cycles.mean))
    )
    first = np.unique(where, return_index=True)[1]
    return Cycles(
        range=most * power ** (1.0 / SLOPE), mean=mean, count=count, start=cycles.start[first], end=cycles.end[first]
    )


@dataclass(frozen=True, eq=False, kw_only=True)
class Course:
    """Torque of a shaft over an event."""

    cycles: Cycles
    largest: float  # [N·m]: its largest size


def plays(drive: Drive) -> bool:
    """Tell whether joints or splines have backlash: in starts and events it counts as closed."""
    splines = any(shaft.spline is not None and shaft.spline.backlash > 0.0 for shaft in drive.shafts)
    return splines or any(joint.backlash > 0.0 for joint in drive.joints)


def followed(drive: Drive, event: Event | RunUp | None = None) -> dict[int, Course] | tuple[Problem, ...]:
    """Return the torque of every shaft that can twist over one event; or why it cannot be followed.

    event: a run-up is one in place of that of the duty, which counts when nothing is given.
    """
    return _followed(replace(drive, poses=()) if drive.poses else drive, event, language())


@lru_cache(maxsize=32)
def _followed(drive: Drive, event: Event | RunUp | None, _language: str) -> dict[int, Course] | tuple[Problem, ...]:
    """Return the same; why not is told in a language."""
    if isinstance(event, RunUp):
        drive = replace(drive, duty=replace(drive.duty, run_up=event))
    try:
        known = transient()
        torque, shafts = known.event_torque(drive, event) if isinstance(event, Event) else known.run_up_torque(drive)
    except InputError as error:
        return error.problems
    if not np.all(np.isfinite(torque)):
        path = "duty.events" if isinstance(event, Event) else "duty.run_up"
        return (Problem(path, _("its torques could not be followed to the end")),)
    found = {}
    for k in shafts:
        own = torque[:, [e for e, shaft in enumerate(shafts) if shaft == k]]
        widest = own[:, np.argmax(np.ptp(own, axis=0))]
        begun = np.roll(widest, -int(np.argmax(widest)))  # it comes again and again: all cycles close, ASTM E1049 5.4.5
        cycles = sorted_into_classes(rainflow(np.append(begun, begun[0])))
        found[k] = Course(cycles=cycles, largest=float(np.max(np.abs(own))))
    return found


def event_vibration(drive: Drive, case: LoadCase, event: Event | None) -> Vibration | None:
    """Return what the largest torques of an event add to the loads of a way of running; None if it is not followed.

    event: the run-up of the duty when not given.
    Secondary couples go with the torque. A shaft that cannot twist takes that of the nearest one that can, by the
    ratio of both without vibration.
    """
    courses = followed(drive, event)
    if isinstance(courses, tuple) or not courses:
        return None
    run, plain = under(drive, case), replace(case, joint_angle=None)
    without, unit = case_loads(run, plain), case_loads(run, replace(plain, torque=1.0, harmonics=()))
    nearest = [min(courses, key=lambda own: (abs(own - k), own)) for k in range(len(run.shafts))]
    grown = np.asarray([courses[k].largest / unit.torque[k] for k in nearest])
    at_joints = np.maximum(grown[:-1], grown[1:])
    shafts = ("low", "high", "mises")
    most = {name: (grown if name in shafts else at_joints) * values for name, values in vars(unit).items()}
    return Vibration(
        speed=np.asarray([abs(case.speed or 0.0)]),
        low=most["low"][None],
        high=most["high"][None],
        more=TurnLoads(**{name: values - getattr(without, name) for name, values in most.items()}),
        without=without.torque,
    )


def event_name(event: Event | RunUp | None) -> str:
    """Return what to call an event."""
    if not isinstance(event, Event):
        return _("run-up")
    return event.name or {"clutch": _("closing of the clutch"), "load_step": _("load step")}[event.kind]
