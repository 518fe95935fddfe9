"""Kernel: periodic motion and monodromy matrix of drives with joints, eight at a time.

The motion by harmonic balance, the matrix by collocation, as in `cardan.maths.periodic` and `cardan.maths.floquet`; the
matrices are factored without pivots, and a drive whose Newton steps do not come to rest is left to the plain form.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit, types

from cardan.maths.arrays import namespace

from .drive_steps import asynchronous, constant, couple, element, falling, gather, joint, speed, swinging
from .lanes import BYTES, LANES, OUTPUT, SOURCES, address, compiled, step

LEAP = 0.3
"""Longest way of a coordinate in one Newton step [rad]."""

ENOUGH = 3e-6
"""Newton step, over the motion, whose square is rounding: the last one."""


def _wave(x: Any, v: Any, a: Any, u: Any, value: Any, rate: Any, bend: Any) -> tuple[Any, Any, Any]:
    return x + u * value, v + u * rate, a + u * bend


def _moving(v: Any, a: Any, omega: Any, even: Any) -> tuple[Any, Any]:
    return even + omega * v, omega * omega * a


def _inner(stiffness: Any, damping: Any, mass: Any, omega: Any, value: Any, rate: Any, bend: Any) -> tuple[Any]:
    return (stiffness * value + omega * (damping * rate + omega * (mass * bend)),)


def _add_scaled(to: Any, part: Any, number: Any) -> tuple[Any]:
    return (to + part * number,)


def _subtract_product(to: Any, one: Any, other: Any) -> tuple[Any]:
    return (to - one * other,)


def _add_four(a: Any, b: Any, c: Any, d: Any, p: Any, q: Any, r: Any, s: Any, number: Any) -> tuple[Any, ...]:
    return a + p * number, b + q * number, c + r * number, d + s * number


def _less_four(a: Any, b: Any, c: Any, d: Any, one: Any, p: Any, q: Any, r: Any, s: Any) -> tuple[Any, ...]:
    return a - one * p, b - one * q, c - one * r, d - one * s


def _same(one: Any) -> tuple[Any]:
    return (one,)


def _inverse(one: Any) -> tuple[Any]:
    return (1.0 / one,)


def _times(one: Any, other: Any) -> tuple[Any]:
    return (one * other,)


def _stage(stiffness: Any, damping: Any, h: Any, once: Any, twice: Any) -> tuple[Any]:
    return (h * (damping * once + h * (stiffness * twice)),)


def _push(to: Any, stiffness: Any, damping: Any, x: Any, v: Any, h: Any, c: Any) -> tuple[Any]:
    return (to - (stiffness * (x + c * h * v) + damping * v),)


def _end(x: Any, v: Any, once: Any, twice: Any, h: Any) -> tuple[Any, Any]:
    return x + h * (v + h * twice), v + h * once


def _largest(to: Any, part: Any) -> tuple[Any]:
    xp = namespace(to)
    size = xp.abs(part)
    return (xp.where(size > to, size, to),)


def _sum2(once: Any, twice: Any, part: Any, b1: Any, b2: Any) -> tuple[Any, Any]:
    return once + part * b1, twice + part * b2


_joint, _element, _speed, _constant = step(joint), step(element), step(speed), step(constant)
_falling, _swinging, _asynchronous = step(falling), step(swinging), step(asynchronous)
_gather, _couple = step(gather), step(couple)
_wave_of, _moving_of, _inner_of, _add = step(_wave), step(_moving), step(_inner), step(_add_scaled)
_less, _inverse_of, _times_of, _stage_of = step(_subtract_product), step(_inverse), step(_times), step(_stage)
_push_of, _end_of, _largest_of, _sum2_of = step(_push), step(_end), step(_largest), step(_sum2)

_add_four_of, _less_four_of, _copy = step(_add_four), step(_less_four), step(_same)

SIZES = 9
"""Numbers in the plan before its lists: stations, coordinates, first free one, elements, joints, torques, pairs,
numbers of a drive, harmonics n."""

CONSTANT, FALLING, SWINGING, ASYNCHRONOUS = range(4)
"""Kinds of torques, in the plan."""


@njit(nogil=True, inline="always")
def _fill(array: Any, first: int, count: int, value: float) -> None:
    for k in range(LANES * first, LANES * (first + count)):
        array[k] = value


@njit(nogil=True, error_model="numpy")
def _moment(plan: Any, own: Any, work: Any, table: Any, at: int, phi: float) -> None:
    """Write mass, balance, damping and stiffness at a moment; see `_places` for where everything lies."""
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
    rate, bend = x + BYTES * rank, x + BYTES * 2 * rank
    ahead = x + BYTES * 3 * rank
    line = BYTES * stations
    f1, f2, f3 = ahead + line, ahead + 2 * line, ahead + 3 * line
    turning, on, along, across = ahead + 4 * line, ahead + 5 * line, ahead + 6 * line, ahead + 7 * line
    mass = ahead + 8 * line
    left, damping = mass + BYTES * rank, mass + BYTES * 2 * rank
    stiffness = damping + BYTES * pairs
    _fill(work, rank * n, 3 * rank, 0.0)
    _fill(work, rank * n + 3 * rank + 6 * stations, 2 * stations + 2 * rank + 2 * pairs, 0.0)
    for r in range(rank):
        p = BYTES * r
        if r >= first:
            for k in range(n):
                _wave_of(
                    (x + p, rate + p, bend + p, u + BYTES * (r * n + k)),
                    (table[at + k], table[at + n + k], table[at + 2 * n + k]),
                    (x + p, rate + p, bend + p),
                )
        _moving_of((rate + p, bend + p, omega, even), (), (rate + p, bend + p))
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
                *(on + p, along + p, across + p, ground + p, rate + q, bend + q),
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


@njit(nogil=True, error_model="numpy")
def _add_row(to: int, part: int, count: int, number: float) -> None:
    """Add a row times a number."""
    for _four in range(count // 4):
        a, b, c = to + BYTES, to + 2 * BYTES, to + 3 * BYTES
        _add_four_of((to, a, b, c, part, part + BYTES, part + 2 * BYTES, part + 3 * BYTES), (number,), (to, a, b, c))
        to, part = to + 4 * BYTES, part + 4 * BYTES
    for _one in range(count % 4):
        _add((to, part), (number,), (to,))
        to, part = to + BYTES, part + BYTES


@njit(nogil=True, error_model="numpy")
def _less_row(to: int, factor: int, part: int, count: int) -> None:
    """Subtract a row times what stands at ``factor``."""
    for _four in range(count // 4):
        a, b, c = to + BYTES, to + 2 * BYTES, to + 3 * BYTES
        _less_four_of((to, a, b, c, factor, part, part + BYTES, part + 2 * BYTES, part + 3 * BYTES), (), (to, a, b, c))
        to, part = to + 4 * BYTES, part + 4 * BYTES
    for _one in range(count % 4):
        _less((to, factor, part), (), (to,))
        to, part = to + BYTES, part + BYTES


@njit(nogil=True, error_model="numpy")
def _factor(matrix: int, inverse: int, size: int, wide: int, coupled: Any, start: int, rank: int) -> None:
    """Factor matrices in place, blocks of ``size``: a block that stays zero is left alone. No pivots are sought."""
    for k in range(wide):
        block = k // size
        pivot = matrix + BYTES * (k * wide + k)
        _inverse_of((pivot,), (), (inverse + BYTES * k,))
        for i in range(k + 1, wide):
            if not coupled[start + (i // size) * rank + block]:
                continue
            factor = matrix + BYTES * (i * wide + k)
            _times_of((factor, inverse + BYTES * k), (), (factor,))
            for other in range(block, rank):
                if not coupled[start + block * rank + other]:
                    continue
                j = max(k + 1, other * size)
                to, part = matrix + BYTES * (i * wide + j), matrix + BYTES * (k * wide + j)
                _less_row(to, factor, part, (other + 1) * size - j)


@njit(nogil=True, error_model="numpy")
def _solve(
    matrix: int, inverse: int, right: int, columns: int, size: int, wide: int, coupled: Any, start: int, rank: int
) -> None:
    """Solve for right sides (wide, columns) in place."""
    for i in range(wide):
        for block in range(i // size + 1):
            if not coupled[start + (i // size) * rank + block]:
                continue
            for k in range(block * size, min((block + 1) * size, i)):
                to, part = right + BYTES * i * columns, right + BYTES * k * columns
                _less_row(to, matrix + BYTES * (i * wide + k), part, columns)
    for i in range(wide - 1, -1, -1):
        for block in range(i // size, rank):
            if not coupled[start + (i // size) * rank + block]:
                continue
            for k in range(max(block * size, i + 1), (block + 1) * size):
                to, part = right + BYTES * i * columns, right + BYTES * k * columns
                _less_row(to, matrix + BYTES * (i * wide + k), part, columns)
        for c in range(columns):
            to = right + BYTES * (i * columns + c)
            _times_of((to, inverse + BYTES * i), (), (to,))


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
        _fill(room, 0, wide * wide + wide, 0.0)
        for s in range(samples):
            _moment(plan, own, work, table, s * 3 * n, phases[s])
            for r in range(first, rank):
                for i in range(n):
                    to = right + BYTES * ((r - first) * n + i)
                    _add((to, left + BYTES * r), (back[i * samples + s],), (to,))
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
                        _add_row(row, inner, n, back[i * samples + s])
        if free:  # the mean of the first coordinate gives way to the force on it
            for lane in range(LANES):
                room[LANES * wide * wide + lane] -= work[LANES * force + lane]
                for i in range(wide):
                    room[LANES * i * wide + lane] = -1.0 if i == 0 else 0.0
        _factor(m, inverse, n, wide, plan, coupled, blocks)
        _solve(m, inverse, right, 1, n, wide, plan, coupled, blocks)
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
    _fill(room, 0, states * states, 0.0)
    for i in range(states):
        _fill(room, i * states + i, 1, 1.0)
    for lane in range(LANES):
        own[LANES * (plan[7] + 1) + lane] = turn / (own[LANES * (plan[7] - 2) + lane] * steps)
    points, once, twice = 1, 1 + stages, 1 + stages + (stages + 1) * stages
    for k in range(steps):
        _fill(room, states * states, wide * wide + wide * states, 0.0)
        for i in range(stages):
            node = begin + k * stages + i
            _moment(plan, own, work, nodes, node * (3 * n + 1) + 1, nodes[node * (3 * n + 1)])
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
                _add((to, mass + BYTES * (r + first)), (1.0,), (to,))
        _factor(matrix, inverse, stages, wide, plan, coupled, blocks)
        _solve(matrix, inverse, right, states, stages, wide, plan, coupled, blocks)
        for r in range(blocks):
            for c in range(states):
                _fill(room, states * states + wide * wide + wide * states + wide, 2, 0.0)
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
            _mapped(plan, own, work, room, nodes, begins[group], counts[group], scheme, turn)
            for lane in range(LANES):
                for k in range(states * states):
                    matrix[(begin + lane) * states * states + k] = room[LANES * k + lane]

    return kernel


kernel = _build(SOURCES)
