"""Up to which torque the limits of a drive are kept where a use of them is no power of its torque."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from cardan.checks.verdict import Verdict
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.formulas.joint_rating import POWER
from cardan.maths.ties import foremost
from cardan.questions.life.life import life

from .joints import bearing_life

LITTLE = 0.02
"""Share of a rating by which torsional vibration must move it for the rating to be sought."""

BARE = 1e-6
"""Least factor on all torques that is looked at: there nothing but the joints makes a drive vibrate."""

LOOKS, NEAR = 4, 0.05
"""Times that a drive is looked at on the way to its rating, and the share of itself by which that moves at last."""

ROUNDS, RESTS = 8, 1e-11
"""Times that a torque for a life is bettered at most, three are usual; change of the torque at which this ends."""


def scaled(duty: Duty, factor: float) -> Duty:
    """Return a duty with all its torques times a factor.

    >>> scaled(Duty(torque=100.0), 1.5).torque
    150.0
    """
    history = duty.torque_history
    return replace(
        duty,
        torque=None if duty.torque is None else factor * duty.torque,
        harmonics=tuple(replace(one, torque=factor * one.torque) for one in duty.harmonics),
        blocks=tuple(replace(one, torque=factor * one.torque) for one in duty.blocks),
        cases=tuple(replace(one, torque=factor * one.torque) for one in duty.cases),
        events=tuple(
            replace(one, torque=factor * one.torque) if one.kind == "load_step" else one for one in duty.events
        ),
        torque_history=None
        if history is None
        else replace(history, torques=tuple(factor * one for one in history.torques)),
    )


def lasting_as_long(drive: Drive, duty: Duty, verdicts: Sequence[Verdict]) -> tuple[Verdict, ...]:
    """Return verdicts, those on the lives of joints with the factors by which the torques may grow for the life asked.

    Masses count in a life, so that it is not quite a power of the torque: of the joint that fails first the factor is
    bettered until it rests, that of the others is left at the power.
    """
    found = bearing_life.lives(drive)
    if isinstance(found, tuple) or duty.life is None:
        return tuple(verdicts)
    with np.errstate(divide="ignore"):
        factors = (found / duty.life) ** (1.0 / POWER)
    first = int(foremost(factors, least=True)) if not np.all(np.isnan(factors)) else -1
    for _round in range(ROUNDS if first >= 0 and math.isfinite(factors[first]) else 0):
        now = life(drive, scaled(duty, factors[first]), method="iso").of("iso")[first]
        step = float((now / duty.life) ** (1.0 / POWER))
        factors[first] *= step
        if abs(step - 1.0) < RESTS:
            break
    return tuple(
        replace(one, factor=float(factors[one.number - 1])) if one.check == "bearing_life" and one.run else one
        for one in verdicts
    )


def rated(
    verdicts: tuple[Verdict, ...], resting: Sequence[Verdict], at: Callable[[float], Sequence[Verdict]]
) -> tuple[Verdict, ...]:
    """Return verdicts with the factors on all torques of the duty at which their limits are reached.

    resting: the verdicts without torsional vibration; at: those with all torques times a factor, none where not known.
    Joints shake a line whatever it carries, so that a use does not grow with the torque. The limit reached first is
    sought: at first as if the vibration stayed as it is, then along the chord of what was found. A limit that is passed
    without load is reached at no torque.
    """
    loads = {_key(one): load for one in verdicts if math.isfinite(load := _load(one))}
    without = {_key(one): _load(one) for one in resting}
    points = {key: [(1.0, load)] for key, load in loads.items()}
    staying = {key: [(0.0, load - without.get(key, 0.0)), (1.0, load)] for key, load in loads.items()}
    binding = [_key(one) for one in verdicts if not one.advice and _key(one) in loads]
    factor, grown = (min((_reached(one[key]) for key in binding), default=math.inf) for one in (staying, points))
    if not math.isfinite(grown) or abs(factor - grown) <= LITTLE * grown:
        return verdicts
    for _look in range(LOOKS):
        factor = max(factor, BARE)
        now = {_key(one): _load(one) for one in at(factor)}
        if not now:
            return verdicts
        for key in points.keys() & now.keys():
            points[key] = sorted([*points[key], (factor, now[key])])
        last, factor = factor, min(_reached(points[key]) for key in binding)
        if abs(factor - last) <= NEAR * last:
            break
    return tuple(replace(one, factor=_reached(points[_key(one)])) if _key(one) in points else one for one in verdicts)


def _key(one: Verdict) -> tuple[str, str, bool]:
    return one.check, one.subject, one.advice


def _load(one: Verdict) -> float:
    """Return what a verdict uses of its limit, as a share of the torque that would use it up in statics."""
    if not one.run or one.power == 0.0:
        return math.nan
    grown = float(one.torque_factor)
    return 1.0 / grown if grown > 0.0 else math.nan


def _reached(points: Sequence[tuple[float, float]]) -> float:
    """Return the factor at which a limit is reached; 0 where it is without load.

    points: factors on all torques, rising, and what they use of it; by the chord between those next to the limit, from
    zero where there is one alone.

    >>> _reached([(1e-6, 0.5), (1.0, 1.5)]), _reached([(1e-6, 1.2), (1.0, 1.5)]), _reached([(1.0, 0.5), (2.0, 0.75)])
    (0.5000005, 0.0, 3.0)
    """
    below, above = ([one for one in points if (one[1] > 1.0) == over] for over in (False, True))
    (low, one), (high, other) = (below[-1], above[0]) if below and above else (points[0], points[-1])
    if other > one:
        return max(low + (high - low) * (1.0 - one) / (other - one), 0.0)
    return 0.0 if above and len(points) > 1 else high / other if other > 0.0 else math.inf
