"""Kernel function: what eight drives with joints do at one moment of their motion."""

from __future__ import annotations

from typing import Any

from numba import njit

from .drive_steps import asynchronous, constant, couple, element, falling, gather, joint, speed, swinging
from .lanes import BYTES, LANES, address, step

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
    of the elements; ψ, lead at ψ, τ, cos α, sin²α of each joint; three numbers of each torque; speed, base frequency.
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
    even = values + BYTES * 3 * torques
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
