"""What starts, clutches and load steps each cost of the fatigue life of the shafts, and which run-up costs least."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from cardan.checks.design import Design, design
from cardan.checks.event_loads import event_name, followed
from cardan.drive.drive import Drive
from cardan.drive.machine import Event, RunUp
from cardan.drive.torsional_layout import has_torsion

from .section import sections
from .shaft_life import STRENGTHS, start_damage

RAMPS = (0.25, 0.5, 1.0, 2.0, 4.0)
"""Times of run-ups that are compared, over that of the duty."""


@dataclass(frozen=True, kw_only=True)
class EventDamage:
    """What one event costs the shaft that it tires most."""

    name: str  # what to call it
    count: float  # how often it happens in the life asked for
    duration: float  # [s]: of the change of speed, of the torque of the clutch or of the load
    shaft: int  # number of the shaft
    torque: float  # [N·m]: largest in it
    damage: float  # share of its fatigue life that one event takes

    @property
    def share(self) -> float:
        """Share of the fatigue life that all events of this sort take."""
        return self.count * self.damage


def event_damages(drive: Drive) -> tuple[EventDamage, ...]:
    """Return what every event of a duty costs; those that cannot be followed are left out, see `events_lost`."""
    subject = design(drive)
    found = (_damage(subject, one, float(np.max(count))) for _k, one, count in subject.events)
    return tuple(one for one in found if one is not None)


def events_lost(drive: Drive) -> tuple[tuple[str, str], ...]:
    """Return the events of a duty that cannot be followed, each with why."""
    subject = design(drive)
    every = [(one, followed(subject.drive, one)) for _k, one, _count in subject.events] if has_torsion(drive) else []
    return tuple(
        (event_name(one), "; ".join(dict.fromkeys(map(str, found)))) for one, found in every if isinstance(found, tuple)
    )


def ramp_damages(drive: Drive) -> tuple[EventDamage, ...]:
    """Return what one start costs with run-ups of several times; empty where the duty counts no starts."""
    subject, course = design(drive), drive.duty.run_up
    if course is None or drive.duty.starts is None:
        return ()
    starts = drive.duty.starts
    ramps = (replace(course, duration=factor * course.duration) for factor in RAMPS)
    found = (_damage(subject, ramp, starts) for ramp in ramps)
    return tuple(one for one in found if one is not None)


def cheapest(ramps: tuple[EventDamage, ...]) -> int:
    """Return which run-up costs least: by its damage, then by its largest torque."""
    return min(range(len(ramps)), key=lambda k: (ramps[k].damage, ramps[k].torque))


def _damage(subject: Design, event: Event | RunUp | None, count: float) -> EventDamage | None:
    courses = followed(subject.drive, event) if has_torsion(subject.drive) else ()
    if isinstance(courses, tuple):
        return None
    course = event if event is not None else subject.duty.run_up
    assert course is not None
    rows = [
        EventDamage(
            name=event_name(event),
            count=count,
            duration=course.duration,
            shaft=k + 1,
            torque=one.largest,
            damage=float(np.max(start_damage(subject, k, event))),
        )
        for k, one in courses.items()
        if _judged(subject, k)
    ]
    return max(rows, key=lambda one: (one.damage, one.torque), default=None)


def _judged(subject: Design, k: int) -> bool:
    """Tell whether the fatigue of a shaft, counted from 0, can be told."""
    found = list(sections(subject, k))
    strengths = [section.of_material(name) for section in found for name in STRENGTHS]
    return bool(found) and subject.drive.shafts[k].layup is None and not subject.missing(*strengths)
