"""Torsional lines in time by array expressions: the reference of the kernel, and what serves where numba is missing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.maths.arrays import Array

from . import torsion_forms as forms
from .eighth_order import PLACES, SPEED_WEIGHTS, STAGES, end, stage
from .torsion_line import (
    CONSTANT,
    FALLING,
    HISTORY,
    KLOSS,
    SPEED_LIMIT,
    SPEEDS,
    SWINGING,
    TWIST_LIMIT,
    Line,
    Load,
    State,
)


class Block:
    """Drives of a line on their way through time, as `cardan.maths.compiled.torsion_block.Block`."""

    def __init__(self, line: Line, state: State) -> None:
        self.line, self.held = line, state

    def advance(
        self, time: float, steps: int, h: float, motion: tuple[Array, Array, Array] | None, *, last: bool
    ) -> None:
        """Take steps of one length."""
        with np.errstate(all="ignore"):
            advance(self.line, self.held, time, steps, h, motion, last=last)

    def now(self) -> tuple[Array, Array, Array]:
        """Return angles, speeds (R, b) and work (b,)."""
        return self.held.q, self.held.v, self.held.work

    def state(self) -> State:
        """Return where the drives are."""
        return self.held


@dataclass(frozen=True, eq=False, kw_only=True)
class Moment:
    """What acts at a moment: accelerations (R, b), power (b,), twists (E, b), curves and their slopes (X, b)."""

    acceleration: Array
    power: Array
    twist: list[Array]
    curve: Array
    slope: Array


def moment(line: Line, q: Array, v: Array, time: float, acceleration: Array | None) -> Moment:
    """Return what acts on drives at angles and speeds (R, b).

    q, v (R, b), time [s]; acceleration (b,): of the first coordinate, where it is forced.
    """
    mild = bool(np.all(line.tau <= forms.MILD))
    follow = forms.follower if mild else forms.steep_follower
    count = line.coordinates
    angle, speed, first, second = list(q), list(v), [1.0 + 0.0 * one for one in q], [0.0 * one for one in q]
    mass = [one + 0.0 * v[0] for one in line.mass]
    power = 0.0 * v[0]
    torque = []
    for r in range(count):
        force, power = forms.drag(v[r], line.ground[r], 0.0 * v[r], power)
        torque.append(force)
    for k, r in enumerate(line.turning):
        law = (line.tau[k], line.cosine[k], line.sine[k], line.ahead[k])
        waves = forms.waves(q[r])
        x, u, f1 = follow(*waves, q[r], v[r], *law)
        f2 = forms.swelling(*waves, *law[:3], f1)
        angle.append(x)
        speed.append(u)
        first.append(f1)
        second.append(f2)
        mass[r], torque[r] = forms.weight(f1, f2, v[r], line.inertia[k], mass[r], torque[r])
        force, power = forms.drag(u, line.ground[count + k], 0.0 * u, power)
        torque.append(force)
    carried = []
    for e, (a, b) in enumerate(line.ends):
        t, torque[a], torque[b], power = forms.loose_element(
            *(angle[a], angle[b], speed[a], speed[b], line.stiffness[e], line.damping[e], line.rest[e]),
            *(torque[a], torque[b], power, line.half[e]),
        )
        carried.append(t)
    for load in line.loads:
        p = load.place
        torque[p], power = _loaded(load, time, angle[p], speed[p], torque[p], power)
    for k, r in enumerate(line.turning):
        torque[r] = torque[r] + first[count + k] * torque[count + k]
    found = [torque[r] / mass[r] for r in range(count)]
    if acceleration is not None:
        found[0] = acceleration + 0.0 * found[0]
        power = forms.reaction(mass[0], found[0], torque[0], speed[0], power)
    owners = [*range(count), *line.turning]
    rates = [forms.follower_rate(first[p], second[p], v[r], found[r]) for p, r in enumerate(owners)]
    slopes = [
        forms.element_rate(
            *(speed[a], speed[b], rates[a], rates[b], line.stiffness[e], line.damping[e]),
            forms.touch(angle[a], angle[b], line.rest[e], line.half[e]),
        )
        for e, (a, b) in enumerate(line.ends)
    ]
    return Moment(
        acceleration=np.stack(found),
        power=power,
        twist=[angle[a] - angle[b] for a, b in line.ends],
        curve=np.stack([*carried, *speed]),
        slope=np.stack([*slopes, *rates]),
    )


def _loaded(load: Load, time: float, angle: Array, speed: Array, torque: Array, power: Array) -> tuple[Array, Array]:
    n = load.numbers
    if load.kind == CONSTANT:
        return forms.constant(n[0], speed, torque, power)
    if load.kind == FALLING:
        return forms.falling(n[0], n[1], speed, torque, power)
    if load.kind == KLOSS:
        return forms.kloss(n[0], n[1], n[2], speed, torque, power)
    if load.kind == SWINGING:
        return forms.swinging(n[0], n[1], n[2], angle, speed, torque, power)
    if load.kind == SPEEDS:
        value = n[0]
        for k in range(1, len(n), 2):
            value = forms.hinge(value, speed, n[k], n[k + 1])
        return forms.constant(value, speed, torque, power)
    assert load.kind == HISTORY
    return forms.constant(np.interp(time, load.times, load.values), speed, torque, power)


def advance(
    line: Line,
    state: State,
    time: float,
    steps: int,
    h: float,
    motion: tuple[Array, Array, Array] | None,
    *,
    last: bool,
) -> None:
    """Take steps of one length.

    state: changed in place; time [s]: where it stands; h [s].
    motion (array (b,), array (b,), array (b,)): angle, speed and acceleration forced on the first coordinate, at
    ``time``.
    last: whether to look for extremes at the end as well.
    """

    def placed(now: float, q: Array, v: Array) -> tuple[Array, Array]:
        if motion is None:
            return q, v
        angle, speed = forms.forced(now, *motion)
        return np.concatenate((angle[None], q[1:])), np.concatenate((speed[None], v[1:]))

    forced = None if motion is None else motion[2]
    for n in range(steps + last):
        begin = n * h
        state.q, state.v = placed(begin, state.q, state.v)
        found = moment(line, state.q, state.v, time + begin, forced)
        _noted(line, state, found, time + begin)
        if n == steps:
            break
        state.length = h
        accelerations = [found.acceleration]
        work = SPEED_WEIGHTS[0] * found.power
        for i in range(1, STAGES):
            q, v = stage(i)(state.q, state.v, *accelerations, h)
            now = begin + PLACES[i] * h
            found = moment(line, *placed(now, q, v), time + now, forced)
            accelerations.append(found.acceleration)
            work = work + SPEED_WEIGHTS.get(i, 0.0) * found.power
        state.q, state.v = placed(begin + h, *end(state.q, state.v, *accelerations, h))
        state.work = state.work + h * work


def _noted(line: Line, state: State, found: Moment, time: float) -> None:
    """Keep the extremes and whether the drives are within bounds."""
    for one in state.v:
        state.alive = forms.bounded(one, SPEED_LIMIT, state.alive)
    for one in found.twist:
        state.alive = forms.bounded(one, TWIST_LIMIT, state.alive)
    state.ended = forms.lasted(state.ended, state.alive, time)
    if state.length > 0.0:
        old = (state.before, state.rate, state.high, state.low, state.high_time, state.low_time)
        state.high, state.low, state.high_time, state.low_time = forms.highest(
            found.curve, found.slope, *old, time, state.length
        )
    else:
        state.high, state.low = found.curve, found.curve
        state.high_time, state.low_time = np.full_like(found.curve, time), np.full_like(found.curve, time)
    state.before, state.rate = found.curve, found.slope
