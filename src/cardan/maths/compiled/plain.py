"""What the kernels compute, as array expressions: their reference, and what serves without numba."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.maths.arrays import Array, namespace
from cardan.maths.kernel import mobius

from . import torsion_forms as forms
from .torsion_forms import PLACES, SPEED_WEIGHTS, STAGES, end, stage
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


# What the kernels compute, as array expressions: their reference, and what serves where numba is missing.


def traces(pair: mobius.Pair, angle: Array, speed: Array, acceleration: Array, w: Array) -> tuple[Array, Array, Array]:
    """Return output angle, speed ratio and output acceleration of chains over the input angle.

    pair (...): Möbius pair of each chain; angle (p,) [rad]: input angle φ; speed (...) [rad/s]: ω_1.
    acceleration (...) [rad/s²]: ε_1; w (p,), complex: e^(2iφ), shared by all chains.
    Returns output_angle, ratio, acceleration (..., p).
    """
    a, b = (part[..., None] for part in pair)
    begin = mobius.angle_error((a, b), 1.0 + 0.0 * w[:1])
    angle_error, ratio, slope = mobius.course((a, b), w)
    return angle + (angle_error - begin), ratio, acceleration[..., None] * ratio + speed[..., None] ** 2 * slope


def extremes(pair: mobius.Pair) -> tuple[Array, Array, Array, Array, Array, Array]:
    """Return what a chain reaches over a turn, without positions.

    pair (...): Möbius pair of each chain.
    Returns speed_fluctuation, tau, joint_angle, phase, ratio_max, max_acceleration (...): δ, τ, α_eq [rad], ψ_eq in
    [0, π] [rad], i_max, max |ε|/ω_1².
    δ = 4 |a||b|, τ = |b|/|a|, α_eq = 2 atan √τ, i_max = (|a| + |b|)² = 1/c. The acceleration is
    that of Book Table 4 with sin² α_eq = δ c, which loses nothing for small joint angles, nor, by 1-x and 1-k x without
    differences, for steep ones.
    """
    a, b = pair
    xp = namespace(a)
    far, near = xp.abs(a), xp.abs(b)
    speed_fluctuation = 4.0 * far * near
    tau = near / far
    ratio_max = (far + near) ** 2
    phase = mobius.phase(pair)
    c = 1.0 / ratio_max
    square = speed_fluctuation * c
    size = 1.0 + c * c
    k = square / size
    root = xp.sqrt(1.0 + 8.0 * k * k)
    x, short = 4.0 * k / (1.0 + root), 4.0 * c * c / (size * (1.0 + 2.0 * k + root))
    steepest = 4.0 * c * square * xp.sqrt(short * (1.0 + x)) / (2.0 * c * c + size * k * short) ** 2
    return (
        speed_fluctuation,
        tau,
        2.0 * xp.atan(xp.sqrt(tau)),
        xp.where(phase < 0.0, phase + xp.pi, phase),
        ratio_max,
        steepest,
    )
