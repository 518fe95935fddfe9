"""Torsional vibration along a movement, and what it costs the shafts whose strength is told."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from cardan.checks.design import Design, design
from cardan.checks.moving import at_points
from cardan.checks.strength.section import sections
from cardan.checks.strength.shaft_life import STRENGTHS, of_loads
from cardan.drive.drive import Drive
from cardan.maths.arrays import Array
from cardan.questions.torsion.road.answer import COLUMNS, answer, lacking
from cardan.questions.torsion.road.road import RoadTorsion, ShaftDamage, road_torsion

__all__ = ["COLUMNS", "answer", "ask", "lacking"]


def ask(drive: Drive, *, progress: Callable[[float], object] | None = None) -> RoadTorsion:
    """Return the torsional vibration of a drive along its movements, with the damage of its shafts.

    progress: told the share done; when it answers "stop", an integration in time ends with what is done.
    """
    found = road_torsion(drive, progress=progress)
    return replace(found, damage=shaft_damages(drive, found))


def shaft_damages(drive: Drive, found: RoadTorsion) -> tuple[ShaftDamage, ...]:
    """Return what torsional vibration along a movement costs the shafts whose strength is told.

    Every turn is a cycle of the torques of its instant, with the secondary couples that go with the larger of them.
    """
    subject = design(replace(drive, poses=()))
    if not subject.loaded or not found.places.found.any():
        return ()
    plain = at_points(subject, found.places.points).loaded[0]
    with np.errstate(divide="ignore", invalid="ignore"):
        bent = np.nan_to_num(np.asarray(plain.end_bending) / np.asarray(plain.shaft_torque), posinf=0.0)
    model, line = found.train.model, set(found.line)
    every = []
    for k in range(len(drive.shafts)):
        own = [e for e, (a, _b) in enumerate(model.elements) if model.shaft[a] == k and e in line]
        if own and _told(subject, k):
            low, high = np.min(found.places.low[:, own], axis=-1), np.max(found.places.high[:, own], axis=-1)
            every.append(ShaftDamage(shaft=k + 1, rate=_rate(subject, k, found, low, high, bent[..., k])))
    return tuple(every)


def _told(subject: Design, k: int) -> bool:
    """Tell whether the fatigue of a shaft, counted from 0, can be told."""
    found = list(sections(subject, k))
    strengths = [section.of_material(name) for section in found for name in STRENGTHS]
    return bool(found) and subject.drive.shafts[k].layup is None and not subject.missing(*strengths)


def _rate(subject: Design, k: int, found: RoadTorsion, low: Array, high: Array, bent: Array) -> float:
    """Return the damage a second of the worst stretch of a shaft, its torques (t,) as they are at every place."""
    swing, mean = 0.5 * (high - low), 0.5 * np.abs(high + low)
    rates = []
    for section in sections(subject, k):
        loads = of_loads(subject, k, section, mean, swing, bent * (mean + swing), spread=True)
        rates.append(float(found.places.averaged(1.0 / np.maximum(loads.cycles, 1.0))))
    return max(rates) * abs(found.speed) / (2.0 * math.pi)
