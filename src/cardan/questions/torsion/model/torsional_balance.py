"""Exact equations of the torsional model: where its stations are, the balance of its torques, and their slopes.

For every coordinate r, with F the angle of a station as a function of its coordinate and τ the sum of the torques on
it,

    (Σ J F'²) q̈ + (Σ J F' F'') q̇² = Σ F' τ                                                               (Lagrange)

the sums over the stations that the coordinate turns. A pendulum on an arm l at radius R of its station has an angle θ
of its own and couples the two by its kinetic energy m R l cos(θ - F) θ̇ Ḟ (`TorsionalModel.hinges`). Leading axes of
coordinates are those of the drives, then any of positions or times; an array of the model is widened to them.
"""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass

import numpy as np

from cardan.maths.arrays import Array, namespace, stacked, unit_complex

from .torsional_model import TorsionalModel


@dataclass(frozen=True, eq=False, kw_only=True)
class Places:
    """Angles of the stations over their coordinates: F and its first three derivatives, arrays (..., N)."""

    angle: Array
    first: Array
    second: Array
    third: Array


@dataclass(frozen=True, eq=False, kw_only=True)
class Slopes:
    """Linearised balance M q̈ + C q̇ + K q: mass array (..., R), damping and stiffness arrays (..., R, R)."""

    mass: Array
    damping: Array
    stiffness: Array
    coupled: Array | None = None  # (..., R, R): inertia between coordinates, of pendulums with their own angle


def joint_law(angle: Array, joint_angle: Array, sums: Array | None = None) -> tuple[Array, Array, Array, Array]:
    """Return T and its first three derivatives of a Hooke joint, its angle counted from the plane of its shafts.

    angle (...) [rad]: θ of the driving yoke; joint_angle (...) [rad]: α.
    sums (..., K), complex [rad]: c_k of what a joint turns beside that by a law of its own, Re Σ c_k e^(ikθ).
    Returns tuple of arrays (...): T, T', T'', T''': T = θ + arg(1 - τ e^(-2iθ)) unwrapped, τ = tan²(α/2), T' = cos
    α/(1 - sin²α cos²θ); with what is beside it.
    """
    xp = namespace(angle, joint_angle)
    twice_sin, twice_cos = xp.sin(2.0 * angle), xp.cos(2.0 * angle)
    cosine, square = xp.cos(joint_angle), xp.sin(joint_angle) ** 2
    whole = angle + _ahead(twice_sin, twice_cos, joint_angle)
    below = 1.0 / (1.0 - 0.5 * square * (1.0 + twice_cos))
    first = cosine * below
    second = -first * square * twice_sin * below
    third = 2.0 * first * square * below * (square * twice_sin**2 * below - twice_cos)
    if sums is None:
        return whole, first, second, third
    more = _summed(angle, sums)
    return whole + more[0], first + more[1], second + more[2], third + more[3]


def _ahead(twice_sin: Array, twice_cos: Array, joint_angle: Array) -> Array:
    """Return by how much T of `joint_law` is ahead of θ, by sine and cosine of 2θ."""
    xp = namespace(twice_sin, joint_angle)
    tau = xp.tan(0.5 * joint_angle) ** 2
    return xp.atan2(tau * twice_sin, 1.0 - tau * twice_cos)


def _turned(angle: Array, joint_angle: Array, sums: Array | None) -> Array:
    """Return T of `joint_law` alone."""
    xp = namespace(angle, joint_angle)
    whole = angle + _ahead(xp.sin(2.0 * angle), xp.cos(2.0 * angle), joint_angle)
    return whole if sums is None else whole + _summed(angle, sums)[0]


def _summed(angle: Array, sums: Array) -> list[Array]:
    """Return Re Σ c_k e^(ikθ) and its first three derivatives, arrays (...), by Horner's scheme."""
    xp = namespace(angle, sums)
    turn = unit_complex(angle)
    found = [0.0 * turn for _order in range(4)]
    for k in reversed(range(sums.shape[-1])):
        for order in range(4):
            found[order] = found[order] * turn + (1j * k) ** order * sums[..., k]
    return [xp.real(one) for one in found]


def places(model: TorsionalModel, q: Array) -> Places:
    """Return the angles of the stations and their derivatives by their coordinates.

    q (..., R) [rad].
    Chain rule behind a joint: F = T(f+ψ) - T(ψ), F' = T' f', F'' = T'' f'² + T' f'',
    F''' = T''' f'³ + 3 T'' f' f'' + T' f'''.
    """
    xp = namespace(q)
    found: list[tuple[Array, Array, Array, Array]] = []
    one = xp.ones_like(q[..., 0])
    nothing = xp.zeros_like(one)
    own = model.own_laws
    for k, source in enumerate(model.driven):
        if source is None:
            found.append((q[..., model.coordinate[k]], one, nothing, nothing))
            continue
        f, f1, f2, f3 = found[source[0]]
        joint_angle, phase = _wide(model.joint_angle[..., source[1]], one), _wide(model.phase[..., source[1]], one)
        sums = None if own is None else _each(own[..., source[1]], one)
        t, t1, t2, t3 = joint_law(f + phase, joint_angle, sums)
        start = _turned(phase, joint_angle, sums)
        found.append((t - start, t1 * f1, t2 * f1**2 + t1 * f2, t3 * f1**3 + 3.0 * t2 * f1 * f2 + t1 * f3))
    angle, first, second, third = (beside([each[i] for each in found]) for i in range(4))
    return Places(angle=angle, first=first, second=second, third=third)


def even_rates(model: TorsionalModel, q: Array) -> Array:
    """Return the speeds of the coordinates over that of the first one while no shaft twists, array (..., R).

    q (..., R) [rad]: every shaft turns as one with the driven yoke of the joint before it.
    """
    first = places(model, q).first
    before = {b: a for a, b in (*model.elements, *model.hinges)}
    speed = [0.0 * first[..., 0] + 1.0 for _k in model.driven]
    for k, source in enumerate(model.driven):
        if source is not None:  # F' counts from its coordinate, which turns as the station that owns it
            speed[k] = first[..., k] * speed[model.owner[model.coordinate[k]]]
        elif k in before:
            speed[k] = speed[before[k]]
    return beside([speed[k] for k in model.owner])


def beside(values: list[Array]) -> Array:
    """Return arrays (...) beside each other (..., k), each in one piece of memory: they are worked on one by one."""
    xp = namespace(*values)
    whole = stacked(values, xp)
    return xp.permute_dims(whole, (*range(1, whole.ndim), 0))


def square(rows: list[list[Array]]) -> Array:
    """Return rows of arrays (...) as matrices (..., R, R), each entry in one piece of memory."""
    xp = namespace(*rows[0])
    whole = stacked([one for row in rows for one in row], xp)
    whole = xp.reshape(whole, (len(rows), len(rows), *whole.shape[1:]))
    return xp.permute_dims(whole, (*range(2, whole.ndim), 0, 1))


def _wide(values: Array, like: Array) -> Array:
    """Return values (lead) with axes of length 1 behind them, so that they spread over ``like`` (lead, rest)."""
    return values.reshape(values.shape + (1,) * (like.ndim - values.ndim)) if values.ndim else values


def _each(values: Array, like: Array) -> Array:
    """Return values (lead, k) as (lead, 1…, k) beside ``like`` (lead, rest)."""
    missing = like.ndim - (values.ndim - 1)
    return values.reshape(values.shape[:-1] + (1,) * missing + values.shape[-1:]) if values.ndim > 1 else values


def _speeds(model: TorsionalModel, place: Places, rate: Array) -> Array:
    """Return the speeds of the stations, array (..., N)."""
    return place.first * rate[..., list(model.coordinate)]


def _twist(model: TorsionalModel, values: Array) -> Array:
    """Return value at A minus value at B of each element, array (..., E)."""
    heads, tails = [a for a, _b in model.elements], [b for _a, b in model.elements]
    return values[..., heads] - values[..., tails]


def _contact(model: TorsionalModel, twist: Array, like: Array) -> tuple[Array, Array]:
    """Return elastic twist of the elements and 1 where they touch."""
    xp = namespace(twist)
    if model.rest is not None:
        twist = twist - _each(model.rest, like)
    half = 0.5 * _each(model.backlash, like)
    over = xp.where(twist > half, twist - half, xp.where(twist < -half, twist + half, 0.0 * twist))
    touching = xp.where((xp.abs(twist) > half) | (half == 0.0), 1.0, 0.0)
    return over, touching


@dataclass(frozen=True, eq=False, kw_only=True)
class _Hinge:
    """A pendulum at a moment: its pivot turns by F, itself by θ; arrays (...)."""

    pivot: int  # stations
    tip: int
    coupling: Array  # m R l
    own: Array  # m l²
    cosine: Array  # of the swing θ - F
    sine: Array
    fast: Array  # Ḟ
    swift: Array  # θ̇


def _hinges(model: TorsionalModel, place: Places, speed: Array) -> list[_Hinge]:
    """Return the pendulums with their own angle."""
    if model.coupling is None:
        return []
    xp, like = namespace(place.angle), place.angle[..., 0]
    found = []
    for k, (h, p) in enumerate(model.hinges):
        swing = place.angle[..., p] - place.angle[..., h]
        found.append(
            _Hinge(
                pivot=h,
                tip=p,
                coupling=_wide(model.coupling[..., k], like),
                own=_wide(model.inertia[..., p], like),
                cosine=xp.cos(swing),
                sine=xp.sin(swing),
                fast=speed[..., h],
                swift=speed[..., p],
            )
        )
    return found


def _hinge_torques(model: TorsionalModel, place: Places, rate: Array, acceleration: Array) -> Array:
    """Return what the coupling of pendulums adds to the left side of the balance, array (..., R).

    With the swing φ = θ - F it is m R l (θ̈ cos φ - θ̇² sin φ) F' of the pivot and m R l (F̈ cos φ + Ḟ² sin φ) of θ.
    """
    xp = namespace(rate)
    left = [0.0 * rate[..., r] for r in range(model.coordinates)]
    for one in _hinges(model, place, _speeds(model, place, rate)):
        r, o, lever = model.coordinate[one.pivot], model.coordinate[one.tip], place.first[..., one.pivot]
        turning = lever * acceleration[..., r] + place.second[..., one.pivot] * rate[..., r] ** 2
        swinging = acceleration[..., o] * one.cosine - one.swift**2 * one.sine
        left[r] = left[r] + lever * one.coupling * swinging
        left[o] = left[o] + one.coupling * (turning * one.cosine + one.fast**2 * one.sine)
    return xp.stack(left, axis=-1)


def element_torques(model: TorsionalModel, q: Array, rate: Array, time: Array = 0.0) -> Array:
    """Return the torque of every element, positive when it carries power from A to B.

    q, rate (..., R) [rad, rad/s]; time (...) [s], of which only pendulums with their own angle ask.
    Returns (..., E) [N·m]: t = c x_e + b (Ḟ_A - Ḟ_B); of a pendulum what its pivot takes with its stop,
    m R² F̈ + m R l (θ̈ cos φ - θ̇² sin φ).
    """
    xp = namespace(q)
    place = places(model, q)
    speed = _speeds(model, place, rate)
    carried, _spring, _damper = _carried(model, place, speed, q[..., 0])
    if not model.hinges:
        return carried
    change = accelerations(model, q, rate, time)
    parts = [carried[..., e] for e in range(len(model.elements))]
    for one in _hinges(model, place, speed):
        e, r = model.elements.index((one.pivot, one.tip)), model.coordinate[one.pivot]
        turning = place.first[..., one.pivot] * change[..., r] + place.second[..., one.pivot] * rate[..., r] ** 2
        swinging = change[..., model.coordinate[one.tip]] * one.cosine - one.swift**2 * one.sine
        parts[e] = parts[e] + one.coupling**2 / one.own * turning + one.coupling * swinging
    return xp.stack(parts, axis=-1)


def _carried(model: TorsionalModel, place: Places, speed: Array, like: Array) -> tuple[Array, Array, Array]:
    """Return the torques of the elements and their slopes by the twist and by its speed, arrays (..., E)."""
    twist, turning = _twist(model, place.angle), _twist(model, speed)
    over, touching = _contact(model, twist, like)
    spring, damper = _each(model.stiffness, like) * touching, _each(model.damping, like) * touching
    found = _each(model.stiffness, like) * over + damper * turning
    if model.special:
        tables, rubbing = _springs(model, twist), _rubbing(model, turning, like)
        found, spring, damper = found + tables[0] + rubbing[0], spring + tables[1], damper + rubbing[1]
    return found, spring, damper


def spring_torque(table: tuple[tuple[float, ...], tuple[float, ...]], twist: float) -> tuple[float, float]:
    """Return torque [N·m] and stiffness [N·m/rad] of a spring by its table at a twist [rad]."""
    twists, torques = table
    k = min(max(bisect_right(twists, twist) - 1, 0), len(twists) - 2)
    slope = (torques[k + 1] - torques[k]) / (twists[k + 1] - twists[k])
    return torques[k] + slope * (twist - twists[k]), slope


def _springs(model: TorsionalModel, twist: Array) -> tuple[Array, Array, Array]:
    """Return torque, stiffness and energy of springs by their tables, arrays (..., E); 0 for all others."""
    xp = namespace(twist)
    found = np.zeros((3, *twist.shape))
    for e, table in enumerate(model.tables):
        if table is not None:
            found[:, ..., e] = _by_table(table, np.asarray(twist[..., e]))
    return xp.asarray(found[0]), xp.asarray(found[1]), xp.asarray(found[2])


def _by_table(table: tuple[tuple[float, ...], tuple[float, ...]], twist: Array) -> Array:
    """Return torque, stiffness and energy of a spring by its table, array (3, ...): its work from the twist 0 on."""
    twists, torques = np.asarray(table)
    slope = np.diff(torques) / np.diff(twists)
    work = np.append(0.0, np.cumsum(0.5 * (torques[1:] + torques[:-1]) * np.diff(twists)))

    def at(x: Array) -> tuple[Array, Array, Array]:
        k = np.clip(np.searchsorted(twists, x, side="right") - 1, 0, len(slope) - 1)
        torque = torques[k] + slope[k] * (x - twists[k])
        return torque, slope[k], work[k] + 0.5 * (torques[k] + torque) * (x - twists[k])

    torque, stiffness, energy = at(twist)
    return np.stack([torque, stiffness, energy - at(np.zeros(()))[2]])


def _rubbing(model: TorsionalModel, turning: Array, like: Array) -> tuple[Array, Array]:
    """Return torque of dry friction and its slope by the speed of the twist, arrays (..., E)."""
    if model.friction is None or model.creep is None:
        return 0.0 * turning, 0.0 * turning
    xp = namespace(turning)
    size, band = _each(model.friction, like), _each(model.creep, like)
    share = turning / band
    inside = xp.where(xp.abs(share) < 1.0, 1.0, 0.0)
    return size * xp.clip(share, -1.0, 1.0), size / band * inside


def _acting(
    model: TorsionalModel, place: Places, speed: Array, time: Array
) -> tuple[Array, Array, Array, Array, Array]:
    """Return the torque on every station and the slopes of the outer ones by angle and speed, arrays (..., N).

    Returns the slopes of the elements too, by their twist and by its speed, arrays (..., E).
    """
    xp = namespace(place.angle)
    like = place.angle[..., 0]
    force, spring, damper = _carried(model, place, speed, like)
    total = [-_wide(model.ground_damping[..., k], like) * speed[..., k] for k in range(len(model.driven))]
    by_angle, by_speed = ([xp.zeros_like(like)] * len(model.driven) for _slope in range(2))
    for e, (a, b) in enumerate(model.elements):
        total[a] = total[a] - force[..., e]
        total[b] = total[b] + force[..., e]
    for torque in model.torques:
        k = torque.station
        value, along, across = torque.law.at(time, place.angle[..., k], speed[..., k])
        total[k], by_angle[k], by_speed[k] = total[k] + value, by_angle[k] + along, by_speed[k] + across
    return beside(total), beside(by_angle), beside(by_speed), spring, damper


def gathered(model: TorsionalModel, values: Array) -> Array:
    """Return the sums over the stations of each coordinate, array (..., R)."""
    sums = [values[..., k] for k in model.owner]
    for k, r in enumerate(model.coordinate):
        if k != model.owner[r]:
            sums[r] = sums[r] + values[..., k]
    return beside(sums)


def balance(model: TorsionalModel, q: Array, rate: Array, acceleration: Array, time: Array = 0.0) -> Array:
    """Return left minus right side of the equations of motion; zero where they hold.

    q, rate, acceleration (..., R) [rad, rad/s, rad/s²], time (...) [s].
    Returns (..., R) [N·m]: of a coordinate whose speed is forced it is the torque that forces it.
    """
    place = places(model, q)
    acting, *_slopes = _acting(model, place, _speeds(model, place, rate), time)
    inertia = _each(model.inertia, q[..., 0])
    left = (
        gathered(model, inertia * place.first**2) * acceleration
        + gathered(model, inertia * place.first * place.second) * rate**2
        - gathered(model, place.first * acting)
    )
    return left + _hinge_torques(model, place, rate, acceleration) if model.hinges else left


def accelerations(model: TorsionalModel, q: Array, rate: Array, time: Array = 0.0) -> Array:
    """Return the accelerations of the coordinates; that of a forced one is the one forced on it.

    q, rate (..., R) [rad, rad/s]; time (...) [s].
    Returns (..., R) [rad/s²]: 0 of a coordinate without inertia.
    """
    xp = namespace(q)
    place = places(model, q)
    speed = _speeds(model, place, rate)
    acting, *_slopes = _acting(model, place, speed, time)
    inertia = _each(model.inertia, q[..., 0])
    force = gathered(model, place.first * acting) - gathered(model, inertia * place.first * place.second) * rate**2
    mass = gathered(model, inertia * place.first**2)
    hinges = _hinges(model, place, speed)
    if hinges:
        forces, masses = ([one[..., r] for r in range(model.coordinates)] for one in (force, mass))
        for one in hinges:  # θ̈ taken out of the balance of the pivot
            r, o, lever = model.coordinate[one.pivot], model.coordinate[one.tip], place.first[..., one.pivot]
            pull = one.coupling * one.cosine / one.own
            rest = forces[o] - one.coupling * one.sine * one.fast**2
            bent = place.second[..., one.pivot] * rate[..., r] ** 2
            thrown = one.coupling * (one.sine * one.swift**2 + one.cosine * pull * bent)
            forces[r] = forces[r] + lever * (thrown - pull * rest)
            masses[r] = masses[r] - lever**2 * one.coupling * one.cosine * pull
        force, mass = xp.stack(forces, axis=-1), xp.stack(masses, axis=-1)
    found = force / xp.where(mass > 0.0, mass, xp.inf)
    if not model.free:
        forced = 0.0 * found[..., :1]
        if model.input_motion is not None:
            forced = forced + xp.asarray(model.input_motion.at(time)[2])[..., None]
        found = xp.concat([forced, found[..., 1:]], axis=-1)
    if hinges:
        parts = [found[..., r] for r in range(model.coordinates)]
        for one in hinges:
            r, o = model.coordinate[one.pivot], model.coordinate[one.tip]
            turning = place.first[..., one.pivot] * parts[r] + place.second[..., one.pivot] * rate[..., r] ** 2
            drawn = one.coupling * (turning * one.cosine + one.fast**2 * one.sine)
            parts[o] = (force[..., o] - drawn) / one.own
        found = xp.stack(parts, axis=-1)
    return found


def slopes(model: TorsionalModel, q: Array, rate: Array, acceleration: Array, time: Array = 0.0) -> Slopes:
    """Return the balance linearised about a motion: M δq̈ + C δq̇ + K δq.

    q, rate, acceleration (..., R) [rad, rad/s, rad/s²], time (...) [s].
    Returns Slopes: with all coordinates, a forced one too; leave out its row and column for the rest.
    The term F'' τ holds the torque that the drive carries: a parametric stiffness that the book leaves out.
    """
    return linearised(model, q, rate, acceleration, time)[1]


def linearised(
    model: TorsionalModel, q: Array, rate: Array, acceleration: Array, time: Array = 0.0
) -> tuple[Array, Slopes]:
    """Return `balance` and `slopes` of a motion in one go.

    q, rate, acceleration (..., R) [rad, rad/s, rad/s²], time (...) [s].
    Returns (..., R) [N·m].
    """
    xp = namespace(q)
    like = q[..., 0]
    place = places(model, q)
    wide = list(model.coordinate)
    speed = _speeds(model, place, rate)
    acting, along, across, spring, damper = _acting(model, place, speed, time)
    inertia, ground = _each(model.inertia, like), _each(model.ground_damping, like)
    own, own_rate = rate[..., wide], acceleration[..., wide]
    f1, f2, f3 = place.first, place.second, place.third
    mass, turning = gathered(model, inertia * f1**2), gathered(model, inertia * f1 * f2)
    left = mass * acceleration + turning * rate**2 - gathered(model, f1 * acting)
    damping = 2.0 * rate * turning + gathered(model, f1**2 * (ground - across))
    stiffness = gathered(
        model,
        2.0 * inertia * f1 * f2 * own_rate
        + inertia * (f2**2 + f1 * f3) * own**2
        - f2 * acting
        + f1 * f2 * own * (ground - across)
        - f1**2 * along,
    )
    rank = model.coordinates
    nothing = xp.zeros_like(like)
    c = [[damping[..., r] if r == s else nothing for s in range(rank)] for r in range(rank)]
    k = [[stiffness[..., r] if r == s else nothing for s in range(rank)] for r in range(rank)]
    curving = f2 * own
    for e, (a, b) in enumerate(model.elements):
        ends = (
            (model.coordinate[a], f1[..., a], curving[..., a]),
            (model.coordinate[b], -f1[..., b], -curving[..., b]),
        )
        for r, g, _h in ends:
            damped, sprung = damper[..., e] * g, spring[..., e] * g
            for s, along_g, along_h in ends:
                c[r][s] = c[r][s] + damped * along_g
                k[r][s] = k[r][s] + sprung * along_g + damped * along_h
    coupled = None
    if model.hinges:
        left = left + _hinge_torques(model, place, rate, acceleration)
        coupled = _hinge_slopes(model, place, rate, acceleration, c, k)
    return left, Slopes(
        mass=mass,
        coupled=coupled,
        damping=square(c),
        stiffness=square(k),
    )


def _hinge_slopes(
    model: TorsionalModel, place: Places, rate: Array, acceleration: Array, c: list[list[Array]], k: list[list[Array]]
) -> Array:
    """Add the slopes of `_hinge_torques` by speeds and angles to c and k; return those by accelerations (..., R, R)."""
    xp = namespace(rate)
    rank = model.coordinates
    m = [[0.0 * rate[..., 0] for _s in range(rank)] for _r in range(rank)]
    for one in _hinges(model, place, _speeds(model, place, rate)):
        h, r, o, g = one.pivot, model.coordinate[one.pivot], model.coordinate[one.tip], one.coupling
        f1, f2, f3, v = place.first[..., h], place.second[..., h], place.third[..., h], rate[..., r]
        bend, turn = acceleration[..., o], f1 * acceleration[..., r] + f2 * v**2
        swinging = bend * one.cosine - one.swift**2 * one.sine
        by_swing = -bend * one.sine - one.swift**2 * one.cosine
        by_own = -turn * one.sine + one.fast**2 * one.cosine
        m[r][o] = m[r][o] + g * f1 * one.cosine
        m[o][r] = m[o][r] + g * f1 * one.cosine
        c[r][o] = c[r][o] - 2.0 * g * f1 * one.swift * one.sine
        c[o][r] = c[o][r] + 2.0 * g * v * (f2 * one.cosine + f1**2 * one.sine)
        k[r][o] = k[r][o] + g * f1 * by_swing
        k[r][r] = k[r][r] + g * (f2 * swinging - f1**2 * by_swing)
        k[o][o] = k[o][o] + g * by_own
        turned = (f2 * acceleration[..., r] + f3 * v**2) * one.cosine + 2.0 * f1 * f2 * v**2 * one.sine
        k[o][r] = k[o][r] + g * (turned - f1 * by_own)
    return xp.stack([xp.stack(row, axis=-1) for row in m], axis=-2)


def joint_torques(model: TorsionalModel, q: Array, rate: Array, acceleration: Array) -> tuple[Array, Array]:
    """Return the torques that enter every joint from its driving and leave it into its driven shaft.

    q, rate, acceleration (..., R) [rad, rad/s, rad/s²]; every station has the number of its shaft.
    Returns entering, leaving (..., n) [N·m]: from the output on, what a driven yoke passes on is what the stations of
    its shaft take, Σ J F̈ - Σ τ, and what enters the joint behind them; a joint has no losses, M_1 = M_2 T'.
    """
    xp = namespace(q)
    place = places(model, q)
    wide = list(model.coordinate)
    acting, *_slopes = _acting(model, place, _speeds(model, place, rate), 0.0)
    inertia = _each(model.inertia, q[..., 0])
    left = inertia * (place.first * acceleration[..., wide] + place.second * rate[..., wide] ** 2) - acting
    entering: list[Array] = []
    leaving: list[Array] = []
    behind = 0.0 * q[..., 0]
    for k, source in reversed(list(enumerate(model.driven))):
        if source is None:
            continue
        passed = behind + sum(left[..., j] for j, shaft in enumerate(model.shaft) if shaft == model.shaft[k])
        behind = passed * place.first[..., k] / place.first[..., source[0]]
        entering.insert(0, behind)
        leaving.insert(0, passed)
    if not entering:
        nothing = xp.zeros((*q.shape[:-1], 0))
        return nothing, nothing
    return xp.stack(entering, axis=-1), xp.stack(leaving, axis=-1)


def energy(model: TorsionalModel, q: Array, rate: Array) -> Array:
    """Return Σ ½ J Ḟ² + Σ ½ c x_e², and m R l cos(θ - F) Ḟ θ̇ of pendulums, array (...) [J]."""
    xp = namespace(q)
    like = q[..., 0]
    place = places(model, q)
    over, _touching = _contact(model, _twist(model, place.angle), like)
    speed = _speeds(model, place, rate)
    kinetic = xp.sum(_each(model.inertia, like) * speed**2, axis=-1)
    for one in _hinges(model, place, speed):
        kinetic = kinetic + 2.0 * one.coupling * one.cosine * one.fast * one.swift
    stored = 0.5 * xp.sum(_each(model.stiffness, like) * over**2, axis=-1)
    if model.special:
        stored = stored + xp.sum(_springs(model, _twist(model, place.angle))[2], axis=-1)
    return 0.5 * kinetic + stored


def power(model: TorsionalModel, q: Array, rate: Array, time: Array = 0.0) -> tuple[Array, Array]:
    """Return the power of the outer torques and what the dampers take, arrays (...) [W].

    The power of a forced speed is not in the first: it is the balance of its coordinate times that speed.
    """
    xp = namespace(q)
    like = q[..., 0]
    place = places(model, q)
    speed = _speeds(model, place, rate)
    _over, touching = _contact(model, _twist(model, place.angle), like)
    lost = xp.sum(_each(model.ground_damping, like) * speed**2, axis=-1) + xp.sum(
        _each(model.damping, like) * touching * _twist(model, speed) ** 2, axis=-1
    )
    if model.special:
        turning = _twist(model, speed)
        lost = lost + xp.sum(_rubbing(model, turning, like)[0] * turning, axis=-1)
    given = xp.zeros_like(like)
    for torque in model.torques:
        given = (
            given
            + torque.law.at(time, place.angle[..., torque.station], speed[..., torque.station])[0]
            * speed[..., torque.station]
        )
    return given, lost
