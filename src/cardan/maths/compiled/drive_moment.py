"""Kernel function: what eight drives with joints do at one moment of their motion."""

from __future__ import annotations

from typing import Any

from numba import njit

from .approximations import argument_right, cosine, sine, within_half_turn
from .lanes import BYTES, LANES, address, step

# What eight drives with joints do at one moment: formulas of the balance of torques and of its slopes.
#
# As in `model.torsional_balance`, one station, element or torque at a time. Angles are held as what they are
# ahead of the even rotation φ. Written on the array-API standard; a kernel applies them to registers.


def joint(
    ahead: Any, f1: Any, f2: Any, f3: Any, psi: Any, start: Any, tau: Any, cos: Any, square: Any, phi: Any
) -> tuple[Any, Any, Any, Any]:
    """Return angle ahead of φ and its three derivatives of a driven yoke, from those of its driving yoke.

    ``psi`` and ``start`` are the phase of the joint and the lead of the driven yoke there, ``tau`` tan²(α/2), ``cos``
    and ``square`` cos α and sin²α.
    """
    turn = within_half_turn(ahead + psi + phi)
    s, c = sine(turn), cosine(turn)
    s2, c2 = 2.0 * s * c, 1.0 - 2.0 * s * s
    angle_error = argument_right(tau * s2, 1.0 - tau * c2)
    below = 1.0 / (1.0 - square * c * c)
    t1 = cos * below
    bent = square * below
    t2 = -(t1 * bent * s2)
    t3 = 2.0 * t1 * bent * (bent * s2 * s2 - c2)
    return (
        ahead + angle_error - start,
        t1 * f1,
        t2 * f1 * f1 + t1 * f2,
        t3 * f1 * f1 * f1 + 3.0 * t2 * f1 * f2 + t1 * f3,
    )


def element(
    ahead_a: Any, ahead_b: Any, speed_a: Any, speed_b: Any, rest: Any, c: Any, b: Any, on_a: Any, on_b: Any
) -> tuple[Any, Any]:
    """Return the torques on both stations of an element with its own added."""
    torque = c * (ahead_a - ahead_b - rest) + b * (speed_a - speed_b)
    return on_a - torque, on_b + torque


def speed(f1: Any, rate: Any, ground: Any) -> tuple[Any, Any]:
    """Return the speed of a station, and the torque of its damping to the ground."""
    found = f1 * rate
    return found, -(ground * found)


def constant(on: Any, value: Any) -> tuple[Any]:
    """Return the torque on a station with a constant one added."""
    return (on + value,)


def falling(on: Any, across: Any, turning: Any, standstill: Any, slope: Any) -> tuple[Any, Any]:
    """Return torque and slope by speed with those of M0 - slope·Ḟ added."""
    return on + (standstill - slope * turning), across - slope


def swinging(on: Any, along: Any, ahead: Any, amplitude: Any, phase: Any, half_order: Any, phi: Any) -> tuple[Any, Any]:
    """Return torque and slope by angle with those of a sin(order·F + phase) added."""
    half = within_half_turn(half_order * (ahead + phi) + 0.5 * phase)
    s, c = sine(half), cosine(half)
    return on + amplitude * (2.0 * s * c), along + 2.0 * half_order * amplitude * (1.0 - 2.0 * s * s)


def asynchronous(
    on: Any, across: Any, turning: Any, synchronous: Any, pullout: Any, joint_angle: Any
) -> tuple[Any, Any]:
    """Return torque and slope by speed with those of Kloss's formula added; ``joint_angle`` is the pull-out slip."""
    slip = 1.0 - turning / synchronous
    size = slip * slip + joint_angle * joint_angle
    scale = 2.0 * pullout * joint_angle / size
    return on + scale * slip, across - scale * (joint_angle * joint_angle - slip * slip) / (size * synchronous)


def gather(
    mass: Any,
    left: Any,
    damping: Any,
    stiffness: Any,
    inertia: Any,
    f1: Any,
    f2: Any,
    f3: Any,
    on: Any,
    along: Any,
    across: Any,
    ground: Any,
    rate: Any,
    joint_angle: Any,
) -> tuple[Any, Any, Any, Any]:
    """Return mass, balance, damping and stiffness of a coordinate with those of one station added."""
    heavy, drag = inertia * f1, ground - across
    swing = heavy * f2 * rate
    return (
        mass + heavy * f1,
        left + heavy * f1 * joint_angle + swing * rate - f1 * on,
        damping + 2.0 * swing + f1 * f1 * drag,
        stiffness
        + 2.0 * heavy * f2 * joint_angle
        + inertia * (f2 * f2 + f1 * f3) * rate * rate
        - f2 * on
        + f1 * f2 * rate * drag
        - f1 * f1 * along,
    )


def couple(
    damping: Any, stiffness: Any, first: Any, other: Any, other_joint_angle: Any, rate: Any, c: Any, b: Any, sign: Any
) -> tuple[Any, Any]:
    """Return damping and stiffness between two coordinates with those of an element added; ``sign`` is -1 across it."""
    lever = sign * first
    return damping + b * lever * other, stiffness + lever * (c * other + b * other_joint_angle * rate)


SIZES = 9
"""Numbers in the plan before its lists: stations, coordinates, first free one, elements, joints, torques, pairs,
numbers of a drive, harmonics n."""

CONSTANT, FALLING, SWINGING, ASYNCHRONOUS = range(4)
"""Kinds of torques, in the plan."""


def _wave(x: Any, v: Any, a: Any, u: Any, value: Any, rate: Any, joint_angle: Any) -> tuple[Any, Any, Any]:
    return x + u * value, v + u * rate, a + u * joint_angle


def _moving(v: Any, a: Any, omega: Any, even: Any) -> tuple[Any, Any]:
    return even + omega * v, omega * omega * a


_joint, _element, _speed, _constant = step(joint), step(element), step(speed), step(constant)
_falling, _swinging, _asynchronous = step(falling), step(swinging), step(asynchronous)
_gather, _couple, _wave_of, _moving_of = step(gather), step(couple), step(_wave), step(_moving)


@njit(nogil=True, inline="always")
def fill(array: Any, first: int, count: int, value: float) -> None:
    """Set ``count`` numbers of eight lanes."""
    for k in range(LANES * first, LANES * (first + count)):
        array[k] = value


@njit(nogil=True, error_model="numpy")
def moment_at(plan: Any, own: Any, work: Any, table: Any, at: int, phi: float) -> None:
    """Write mass, balance, damping and stiffness of eight drives at a moment.

    Every number is eight lanes wide. ``own``: inertia and ground damping of the stations; stiffness, damping and rest
    of the elements; ψ, lead at ψ, τ, cos α, sin²α of each joint; three numbers of each torque; the damping of the
    elements that disturbances meet; speed, base frequency.
    ``work``: harmonics of the coordinates; x, ẋ, ẍ of all; eight rows of the stations; mass and balance of the
    coordinates; damping and stiffness of the pairs. ``table[at:]``: the harmonics and their two derivatives there.
    """
    stations, rank, first, elements, joints, torques, pairs, _width, n = (
        plan[0], plan[1], plan[2], plan[3], plan[4], plan[5], plan[6], plan[7], plan[8]
    )  # fmt: skip
    source, by_joint, of = SIZES, SIZES + stations, SIZES + 2 * stations
    heads = SIZES + 3 * stations
    where = heads + 2 * elements
    pair_of = where + 3 * torques
    o, w = address(own), address(work)
    inertia, ground = o, o + BYTES * stations
    c, b = ground + BYTES * stations, ground + BYTES * (stations + elements)
    rest = b + BYTES * elements
    psi = rest + BYTES * elements
    values = psi + BYTES * 5 * joints
    even = values + BYTES * (3 * torques + elements)
    omega = even + BYTES
    u = w
    x = u + BYTES * rank * n
    rate, joint_angle = x + BYTES * rank, x + BYTES * 2 * rank
    ahead = x + BYTES * 3 * rank
    line = BYTES * stations
    f1, f2, f3 = ahead + line, ahead + 2 * line, ahead + 3 * line
    turning, on, along, across = ahead + 4 * line, ahead + 5 * line, ahead + 6 * line, ahead + 7 * line
    mass = ahead + 8 * line
    left, damping = mass + BYTES * rank, mass + BYTES * 2 * rank
    stiffness = damping + BYTES * pairs
    fill(work, rank * n, 3 * rank, 0.0)
    fill(work, rank * n + 3 * rank + 6 * stations, 2 * stations + 2 * rank + 2 * pairs, 0.0)
    for r in range(rank):
        p = BYTES * r
        if r >= first:
            for k in range(n):
                _wave_of(
                    (x + p, rate + p, joint_angle + p, u + BYTES * (r * n + k)),
                    (table[at + k], table[at + n + k], table[at + 2 * n + k]),
                    (x + p, rate + p, joint_angle + p),
                )
        _moving_of((rate + p, joint_angle + p, omega, even), (), (rate + p, joint_angle + p))
    for k in range(stations):
        p = BYTES * k
        r = plan[of + k]
        if plan[source + k] < 0:
            for lane in range(LANES):
                base = LANES * (rank * n + 3 * rank + k) + lane
                work[base] = work[LANES * (rank * n + r) + lane]
                work[base + LANES * stations] = 1.0
                work[base + 2 * LANES * stations] = 0.0
                work[base + 3 * LANES * stations] = 0.0
        else:
            s, j = BYTES * plan[source + k], psi + BYTES * 5 * plan[by_joint + k]
            _joint(
                (ahead + s, f1 + s, f2 + s, f3 + s, j, j + BYTES, j + 2 * BYTES, j + 3 * BYTES, j + 4 * BYTES),
                (phi,),
                (ahead + p, f1 + p, f2 + p, f3 + p),
            )
        _speed((f1 + p, rate + BYTES * r, ground + p), (), (turning + p, on + p))
    for e in range(elements):
        p, i, k = BYTES * e, BYTES * plan[heads + 2 * e], BYTES * plan[heads + 2 * e + 1]
        _element(
            (ahead + i, ahead + k, turning + i, turning + k, rest + p, c + p, b + p, on + i, on + k),
            (),
            (on + i, on + k),
        )
    for t in range(torques):
        p, kind, v = BYTES * plan[where + 3 * t], plan[where + 3 * t + 1], values + BYTES * 3 * t
        if kind == CONSTANT:
            _constant((on + p, v), (), (on + p,))
        elif kind == FALLING:
            _falling((on + p, across + p, turning + p, v, v + BYTES), (), (on + p, across + p))
        elif kind == SWINGING:
            _swinging((on + p, along + p, ahead + p, v, v + BYTES, v + 2 * BYTES), (phi,), (on + p, along + p))
        else:
            _asynchronous((on + p, across + p, turning + p, v, v + BYTES, v + 2 * BYTES), (), (on + p, across + p))
    for k in range(stations):
        r, p = plan[of + k], BYTES * k
        if r < first:
            continue
        q, d = BYTES * r, BYTES * plan[pair_of + r * rank + r]
        _gather(
            (
                *(mass + q, left + q, damping + d, stiffness + d, inertia + p, f1 + p, f2 + p, f3 + p),
                *(on + p, along + p, across + p, ground + p, rate + q, joint_angle + q),
            ),
            (),
            (mass + q, left + q, damping + d, stiffness + d),
        )
    for e in range(elements):
        for one in range(2):
            k = plan[heads + 2 * e + one]
            r = plan[of + k]
            for other in range(2):
                m = plan[heads + 2 * e + other]
                s = plan[of + m]
                if r < first or s < first:
                    continue
                d = BYTES * plan[pair_of + r * rank + s]
                _couple(
                    (
                        *(damping + d, stiffness + d, f1 + BYTES * k, f1 + BYTES * m, f2 + BYTES * m),
                        *(rate + BYTES * s, c + BYTES * e, b + BYTES * e),
                    ),
                    (1.0 if one == other else -1.0,),
                    (damping + d, stiffness + d),
                )
