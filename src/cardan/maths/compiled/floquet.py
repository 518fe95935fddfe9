"""Kernel: periodic motion and monodromy matrix of drives with joints, eight at a time.

The motion by harmonic balance, the matrix by collocation, as in `periodic.harmonics` and `periodic.floquet`; the
matrices are factored without pivots, and a drive whose Newton steps do not come to rest is left to the plain form.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit, types

from .drive_moment import SIZES, fill, moment_at
from .lanes import BYTES, LANES, OUTPUT, SOURCES, address, compiled, step

# Kernel functions: systems made of blocks, eight at a time, factored without pivots.


def _add_scaled(to: Any, part: Any, number: Any) -> tuple[Any]:
    return (to + part * number,)


def _subtract_product(to: Any, one: Any, other: Any) -> tuple[Any]:
    return (to - one * other,)


def _add_four(a: Any, b: Any, c: Any, d: Any, p: Any, q: Any, r: Any, s: Any, number: Any) -> tuple[Any, ...]:
    return a + p * number, b + q * number, c + r * number, d + s * number


def _less_four(a: Any, b: Any, c: Any, d: Any, one: Any, p: Any, q: Any, r: Any, s: Any) -> tuple[Any, ...]:
    return a - one * p, b - one * q, c - one * r, d - one * s


def _inverse(one: Any) -> tuple[Any]:
    return (1.0 / one,)


def _times(one: Any, other: Any) -> tuple[Any]:
    return (one * other,)


add, _less = step(_add_scaled), step(_subtract_product)
_add_four_of, _less_four_of = step(_add_four), step(_less_four)
_inverse_of, _times_of = step(_inverse), step(_times)


@njit(nogil=True, error_model="numpy")
def add_row(to: int, part: int, count: int, number: float) -> None:
    """Add a row times a number."""
    for _four in range(count // 4):
        a, b, c = to + BYTES, to + 2 * BYTES, to + 3 * BYTES
        _add_four_of((to, a, b, c, part, part + BYTES, part + 2 * BYTES, part + 3 * BYTES), (number,), (to, a, b, c))
        to, part = to + 4 * BYTES, part + 4 * BYTES
    for _one in range(count % 4):
        add((to, part), (number,), (to,))
        to, part = to + BYTES, part + BYTES


@njit(nogil=True, error_model="numpy")
def less_row(to: int, factor: int, part: int, count: int) -> None:
    """Subtract a row times what stands at ``factor``."""
    for _four in range(count // 4):
        a, b, c = to + BYTES, to + 2 * BYTES, to + 3 * BYTES
        _less_four_of((to, a, b, c, factor, part, part + BYTES, part + 2 * BYTES, part + 3 * BYTES), (), (to, a, b, c))
        to, part = to + 4 * BYTES, part + 4 * BYTES
    for _one in range(count % 4):
        _less((to, factor, part), (), (to,))
        to, part = to + BYTES, part + BYTES


@njit(nogil=True, error_model="numpy")
def factor(matrix: int, inverse: int, size: int, wide: int, coupled: Any, start: int, rank: int) -> None:
    """Factor matrices in place, blocks of ``size``: a block that stays zero is left alone. No pivots are sought."""
    for k in range(wide):
        block = k // size
        pivot = matrix + BYTES * (k * wide + k)
        _inverse_of((pivot,), (), (inverse + BYTES * k,))
        for i in range(k + 1, wide):
            if not coupled[start + (i // size) * rank + block]:
                continue
            share = matrix + BYTES * (i * wide + k)
            _times_of((share, inverse + BYTES * k), (), (share,))
            for other in range(block, rank):
                if not coupled[start + block * rank + other]:
                    continue
                j = max(k + 1, other * size)
                to, part = matrix + BYTES * (i * wide + j), matrix + BYTES * (k * wide + j)
                less_row(to, share, part, (other + 1) * size - j)


@njit(nogil=True, error_model="numpy")
def solve(
    matrix: int, inverse: int, right: int, columns: int, size: int, wide: int, coupled: Any, start: int, rank: int
) -> None:
    """Solve for right sides (wide, columns) in place."""
    for i in range(wide):
        for block in range(i // size + 1):
            if not coupled[start + (i // size) * rank + block]:
                continue
            for k in range(block * size, min((block + 1) * size, i)):
                to, part = right + BYTES * i * columns, right + BYTES * k * columns
                less_row(to, matrix + BYTES * (i * wide + k), part, columns)
    for i in range(wide - 1, -1, -1):
        for block in range(i // size, rank):
            if not coupled[start + (i // size) * rank + block]:
                continue
            for k in range(max(block * size, i + 1), (block + 1) * size):
                to, part = right + BYTES * i * columns, right + BYTES * k * columns
                less_row(to, matrix + BYTES * (i * wide + k), part, columns)
        for c in range(columns):
            to = right + BYTES * (i * columns + c)
            _times_of((to, inverse + BYTES * i), (), (to,))


LEAP = 0.3
"""Longest way of a coordinate in one Newton step [rad]."""

ENOUGH = 1e-5
"""Newton step, over the motion, whose square is rounding: the last one."""


def _inner(stiffness: Any, damping: Any, mass: Any, omega: Any, value: Any, rate: Any, joint_angle: Any) -> tuple[Any]:
    return (stiffness * value + omega * (damping * rate + omega * (mass * joint_angle)),)


def _same(one: Any) -> tuple[Any]:
    return (one,)


def _stage(stiffness: Any, damping: Any, h: Any, once: Any, twice: Any) -> tuple[Any]:
    return (h * (damping * once + h * (stiffness * twice)),)


def _push(to: Any, stiffness: Any, damping: Any, x: Any, v: Any, h: Any, c: Any) -> tuple[Any]:
    return (to - (stiffness * (x + c * h * v) + damping * v),)


def _end(x: Any, v: Any, once: Any, twice: Any, h: Any) -> tuple[Any, Any]:
    return x + h * (v + h * twice), v + h * once


def _sum2(once: Any, twice: Any, part: Any, b1: Any, b2: Any) -> tuple[Any, Any]:
    return once + part * b1, twice + part * b2


_inner_of, _copy, _stage_of = step(_inner), step(_same), step(_stage)
_push_of, _end_of, _sum2_of = step(_push), step(_end), step(_sum2)


@njit(nogil=True, error_model="numpy")
def _balanced(
    plan: Any, own: Any, work: Any, room: Any, table: Any, back: Any, phases: Any, free: bool, most: int
) -> float:
    """Find the motions by harmonic balance; return the largest last step over the motion of any lane."""
    stations, rank, first, pairs, n = plan[0], plan[1], plan[2], plan[6], plan[8]
    elements, torques = plan[3], plan[5]
    pair_of = SIZES + 3 * stations + 2 * elements + 3 * torques
    coupled = pair_of + rank * rank
    omega = address(own) + BYTES * (plan[7] - 1)
    w = address(work)
    moment = rank * n + 3 * rank + 8 * stations
    mass, left = w + BYTES * moment, w + BYTES * (moment + rank)
    force = moment + 2 * rank + 2 * pairs
    inner = w + BYTES * (force + 1)
    samples = phases.size
    blocks = rank - first
    wide = blocks * n
    m = address(room)
    right = m + BYTES * wide * wide
    inverse = right + BYTES * wide
    kept, held = inverse + BYTES * wide, rank + 2 * pairs
    last = np.inf
    for _round in range(most):
        fill(room, 0, wide * wide + wide, 0.0)
        for s in range(samples):
            moment_at(plan, own, work, table, s * 3 * n, phases[s])
            for r in range(first, rank):
                for i in range(n):
                    to = right + BYTES * ((r - first) * n + i)
                    add((to, left + BYTES * r), (back[i * samples + s],), (to,))
            for k in range(rank + 2 * pairs):  # masses, then damping and stiffness behind the balances
                part = mass + BYTES * (k if k < rank else k + rank)
                _copy((part,), (), (kept + BYTES * (s * held + k),))
        for r in range(first, rank):
            for q in range(first, rank):
                pair = plan[pair_of + r * rank + q]
                if pair < 0:
                    continue
                for s in range(samples):  # a block at a time stays in the nearest cache
                    at = kept + BYTES * s * held
                    d = at + BYTES * (rank + pair)
                    for j in range(n):
                        t = s * 3 * n + j
                        heavy = table[t + 2 * n] if r == q else 0.0
                        _inner_of(
                            (d + BYTES * pairs, d, at + BYTES * r, omega),
                            (table[t], table[t + n], heavy),
                            (inner + BYTES * j,),
                        )
                    for i in range(n):
                        row = m + BYTES * (((r - first) * n + i) * wide + (q - first) * n)
                        add_row(row, inner, n, back[i * samples + s])
        if free:  # the mean of the first coordinate gives way to the force on it
            for lane in range(LANES):
                room[LANES * wide * wide + lane] -= work[LANES * force + lane]
                for i in range(wide):
                    room[LANES * i * wide + lane] = -1.0 if i == 0 else 0.0
        factor(m, inverse, n, wide, plan, coupled, blocks)
        solve(m, inverse, right, 1, n, wide, plan, coupled, blocks)
        last = 0.0
        for lane in range(LANES):
            largest, size = 0.0, 0.0
            for i in range(wide):
                move, now = abs(room[LANES * (wide * wide + i) + lane]), abs(work[LANES * (first * n + i) + lane])
                if not (free and i == 0):
                    largest = move if not move <= largest else largest  # a nan stays
                size = max(size, now)
            share = LEAP / largest if largest > LEAP else 1.0
            for i in range(wide):
                move = share * room[LANES * (wide * wide + i) + lane]
                if free and i == 0:
                    work[LANES * force + lane] -= move
                else:
                    work[LANES * (first * n + i) + lane] -= move
            relative = largest / (size + 1e-4)
            own[LANES * plan[7] + lane] = relative
            last = relative if not relative <= last else last
        if last <= ENOUGH:
            break
    return last


@njit(nogil=True, error_model="numpy")
def _mapped(
    plan: Any, own: Any, work: Any, room: Any, nodes: Any, begin: int, steps: int, scheme: Any, turn: float
) -> None:
    """Write the monodromy matrices to the beginning of ``room``: collocation, step by step."""
    stations, rank, first, pairs, n = plan[0], plan[1], plan[2], plan[6], plan[8]
    elements, torques = plan[3], plan[5]
    pair_of = SIZES + 3 * stations + 2 * elements + 3 * torques
    coupled = pair_of + rank * rank
    w, o = address(work), address(own)
    moment = rank * n + 3 * rank + 8 * stations
    mass = w + BYTES * moment
    damping = mass + BYTES * 2 * rank
    stiffness = damping + BYTES * pairs
    blocks = rank - first
    states = 2 * blocks
    stages = int(scheme[0])
    wide = blocks * stages
    h = o + BYTES * (plan[7] + 1)
    state = address(room)
    matrix = state + BYTES * states * states
    right = matrix + BYTES * wide * wide
    inverse = right + BYTES * wide * states
    sums = inverse + BYTES * wide
    fill(room, 0, states * states, 0.0)
    for i in range(states):
        fill(room, i * states + i, 1, 1.0)
    for lane in range(LANES):
        own[LANES * (plan[7] + 1) + lane] = turn / (own[LANES * (plan[7] - 2) + lane] * steps)
    points, once, twice = 1, 1 + stages, 1 + stages + (stages + 1) * stages
    for k in range(steps):
        fill(room, states * states, wide * wide + wide * states, 0.0)
        for i in range(stages):
            node = begin + k * stages + i
            moment_at(plan, own, work, nodes, node * (3 * n + 1) + 1, nodes[node * (3 * n + 1)])
            for r in range(blocks):
                row = r * stages + i
                for q in range(blocks):
                    pair = plan[pair_of + (r + first) * rank + q + first]
                    if pair < 0:
                        continue
                    d = BYTES * pair
                    for j in range(stages):
                        _stage_of(
                            (stiffness + d, damping + d, h),
                            (scheme[once + i * stages + j], scheme[twice + i * stages + j]),
                            (matrix + BYTES * (row * wide + q * stages + j),),
                        )
                    for c in range(states):
                        to = right + BYTES * (row * states + c)
                        _push_of(
                            (
                                *(to, stiffness + d, damping + d, state + BYTES * (q * states + c)),
                                *(state + BYTES * ((blocks + q) * states + c), h),
                            ),
                            (scheme[points + i],),
                            (to,),
                        )
                to = matrix + BYTES * (row * wide + row)
                add((to, mass + BYTES * (r + first)), (1.0,), (to,))
        factor(matrix, inverse, stages, wide, plan, coupled, blocks)
        solve(matrix, inverse, right, states, stages, wide, plan, coupled, blocks)
        for r in range(blocks):
            for c in range(states):
                fill(room, states * states + wide * wide + wide * states + wide, 2, 0.0)
                for j in range(stages):
                    _sum2_of(
                        (sums, sums + BYTES, right + BYTES * ((r * stages + j) * states + c)),
                        (scheme[once + stages * stages + j], scheme[twice + stages * stages + j]),
                        (sums, sums + BYTES),
                    )
                x, v = state + BYTES * (r * states + c), state + BYTES * ((blocks + r) * states + c)
                _end_of((x, v, sums, sums + BYTES, h), (), (x, v))


_REAL = types.float64[::1]


def _build(sources: int) -> Any:
    @compiled(
        *(types.intp[::1], _REAL, _REAL, _REAL, _REAL, _REAL, _REAL, types.intp[::1], types.intp[::1]),
        *(types.float64, types.boolean, types.intp, types.intp, types.intp, OUTPUT, OUTPUT, OUTPUT),
    )
    def kernel(
        plan: Any,
        drives: Any,
        table: Any,
        back: Any,
        phases: Any,
        nodes: Any,
        scheme: Any,
        begins: Any,
        counts: Any,
        turn: float,
        free: bool,
        most: int,
        first: int,
        last: int,
        known: Any,
        matrix: Any,
        moved: Any,
    ) -> None:
        _sources = sources  # part of the key on disk
        stations, rank, forced, pairs, width, n = plan[0], plan[1], plan[2], plan[6], plan[7], plan[8]
        blocks, stages = rank - forced, int(scheme[0])
        states, wide = 2 * blocks, blocks * max(n, stages)
        own = np.zeros(LANES * (width + 2))
        work = np.zeros(LANES * (rank * n + 3 * rank + 8 * stations + 2 * rank + 2 * pairs + 1 + n))
        moments = phases.size * (rank + 2 * pairs)
        room = np.zeros(LANES * (states * states + wide * wide + wide * max(states, 1) + wide + 2 + moments))
        force = rank * n + 3 * rank + 8 * stations + 2 * rank + 2 * pairs
        total = blocks * n + 1
        for group in range(first, last):
            begin = LANES * group
            for lane in range(LANES):
                for k in range(width):
                    own[LANES * k + lane] = drives[(begin + lane) * width + k]
                for k in range(blocks * n):
                    work[LANES * (forced * n + k) + lane] = known[(begin + lane) * total + k]
                work[LANES * force + lane] = known[(begin + lane) * total + blocks * n]
            _balanced(plan, own, work, room, table, back, phases, free, most)
            for lane in range(LANES):
                for k in range(blocks * n):
                    known[(begin + lane) * total + k] = work[LANES * (forced * n + k) + lane]
                known[(begin + lane) * total + blocks * n] = work[LANES * force + lane]
                moved[begin + lane] = own[LANES * width + lane]
            for k in range(LANES * plan[3]):  # disturbances are damped by numbers of their own
                own[LANES * (2 * stations + plan[3]) + k] = own[LANES * (width - 2 - plan[3]) + k]
            _mapped(plan, own, work, room, nodes, begins[group], counts[group], scheme, turn)
            for lane in range(LANES):
                for k in range(states * states):
                    matrix[(begin + lane) * states * states + k] = room[LANES * k + lane]

    return kernel


kernel = _build(SOURCES)
