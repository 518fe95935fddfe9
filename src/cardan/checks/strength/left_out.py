"""What the stresses of a drive leave out: torsional vibration, friction, masses, weights and axial forces."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

from cardan.drive.drive import Drive
from cardan.errors import InputError
from cardan.questions.forces.forces import forces
from cardan.questions.torsion.steady.run_stability import Verdict
from cardan.questions.torsion.steady.torsion_response import TorsionResponse, torsion_response

from .omitted import Journal, LeftOut, Vibration
from .strength import Strength

LITTLE = 1.02
"""Times the torque counted up to which torsional vibration is not worth a word."""

SLIGHT = 0.005
"""Share by which all forces together must raise the load of a journal to be told."""


@lru_cache(maxsize=16)
def steady_torsion(drive: Drive) -> TorsionResponse | None:
    """Return how a drive vibrates in torsion at the speed of its duty; None where it names none."""
    return None if drive.duty.speed is None else torsion_response(drive)


def left_out(drive: Drive, found: Strength) -> LeftOut:
    """Return what the stresses of a drive leave out."""
    supported = drive.duty.torque is not None and bool(drive.supports)
    return LeftOut(
        vibration=_vibration(drive, found),
        journal=_journal(drive, found) if supported else None,
        supported=supported,
        runs_up=drive.duty.run_up is not None,
    )


def _vibration(drive: Drive, found: Strength) -> Vibration | None:
    """Return what torsional vibration adds; None where it adds little or is not known.

    The torque of a steady motion that grows is none that the drive keeps, so none is told of it.
    """
    if not drive.stations and all(shaft.stiffness is None for shaft in drive.shafts):
        return None
    try:
        runs = steady_torsion(drive)
    except InputError:
        return None
    if runs is None or not bool(runs.steady.found):
        return None
    speed = abs(float(runs.speed))
    if int(runs.floquet.verdict) == Verdict.UNSTABLE:
        return Vibration(speed=speed, stable=False)
    most = np.maximum(np.abs(runs.torque_lowest), np.abs(runs.torque_highest))
    model = runs.train.model
    plain = np.asarray(
        [np.max([case.shaft_torque[model.shaft[a]] for case in found.cases]) for a, _b in model.elements]
    )
    own = [e for e, (_a, b) in enumerate(model.elements) if runs.train.hangs[b] is None and plain[e] > 0.0]
    if not own:
        return None
    e = max(own, key=lambda one: float(most[one] / plain[one]))
    more = float(most[e] / plain[e])
    if more <= LITTLE:
        return None
    name = runs.train.element_names[e]
    return Vibration(speed=speed, stable=True, name=name, torque=float(most[e]), factor=more)


def _journal(drive: Drive, found: Strength) -> Journal | None:
    """Return the journal whose load all forces together raise most; None if unknown or by little."""
    if found.cases[0].name:
        return None
    try:
        every = forces(drive)
    except InputError:
        return None
    ways = (every,) if every.reverse is None else (every, every.reverse)
    load = np.max([np.max(np.asarray(one.journals.size), axis=(-1, -2)) for one in ways], axis=0)
    couple = found.cases[0].couple
    span = np.asarray([one.couple / one.journal_force if one.journal_force > 0.0 else math.nan for one in found.joints])
    more = load * span / np.where(couple > 0.0, couple, math.nan) - 1.0
    if not np.any(np.isfinite(more)):
        return None
    i = int(np.nanargmax(more))
    return Journal(joint=i + 1, load=float(load[i]), more=float(more[i])) if more[i] > SLIGHT else None
