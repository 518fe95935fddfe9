"""Kernel: the output errors of many chains with errors of their own over the same positions, reduced on the spot."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit, types

from cardan.maths.arrays import namespace

from .approximations import arctangent, cosine, sine
from .lanes import BYTES, LANES, OUTPUT, SOURCES, address, compiled, step

SEATS = 5
"""Errors of a joint: phase, then α_1 … α_4."""

SHARED = 9
"""Numbers of a position: cos θ_1, sin θ_1, cosine and sine of the perfect output, the centre, cos φ, sin φ, cos 2φ,
sin 2φ."""

SIZES = 4
"""Results of a sample: sizes of mean, first and second order, and the change over the turn."""

_LINK = 7
_STATE = 7


def link(phase: Any, e1: Any, e2: Any, e3: Any, e4: Any, cb: Any, sb: Any) -> tuple[Any, ...]:
    """Return what all positions of a joint share: cosine and sine of its phase, then the parts of A, B and C.

    α_1, α_2, α_3 are right angles but for their errors, α_4 is the joint angle but for its own; see
    `cardan.maths.kernel.loops.fourth_angle`.
    """
    c1, s1, c2, c3, s3 = -sine(e1), cosine(e1), -sine(e2), -sine(e3), cosine(e3)
    c, s = cosine(e4), sine(e4)
    c4, s4 = cb * c - sb * s, sb * c + cb * s
    return cosine(phase), sine(phase), s3 * s1, s3 * c1 * s4, s3 * s1 * c4, c2 - c3 * c1 * c4, c3 * s1 * s4


def _turned(along: Any, across: Any, c: Any, s: Any) -> tuple[Any, Any]:
    return along * c - across * s, along * s + across * c


def _loop(along: Any, across: Any, a: Any, p: Any, q: Any, f: Any, g: Any) -> tuple[Any, Any, Any]:
    """Return cos θ' and sin θ', both times A² + B², and that."""
    xp = namespace(along)
    y, x, z = a * across, -(p + q * along), f + g * along
    square = y * y + x * x
    root = xp.sqrt(square - z * z)
    return y * z - x * root, x * z + y * root, square


def onward(
    along: Any, across: Any, cd: Any, sd: Any, a: Any, p: Any, q: Any, f: Any, g: Any, cm: Any, sm: Any
) -> tuple[Any, Any]:
    """Return the direction of the next driving yoke, turned on by μ, given that of a joint's own."""
    along, across, square = _loop(*_turned(along, across, cd, sd), a, p, q, f, g)
    inverse = 1.0 / square
    return _turned(along * inverse, across * inverse, cm, sm)


def ended(along: Any, across: Any, link_of: tuple[Any, ...], ci: Any, si: Any, centre: Any) -> Any:
    """Return by how much the last driven yoke is ahead of the perfect one, less the centre; below 22°."""
    cd, sd, *parts = link_of
    along, across, _square = _loop(*_turned(along, across, cd, sd), *parts)
    return arctangent((across * ci - along * si) / (along * ci + across * si)) - centre


def reduced(*given: Any) -> tuple[Any, ...]:
    """Return sums over positions of a sample, its extremes, and sums over the samples of each of the positions.

    Given are the errors at some positions, the seven sums and extremes so far, two sums of each position so far, and
    the four numbers of the orders at each.
    """
    count = (len(given) - _STATE) // 7
    offs, state, sums, basis = (
        given[:count],
        list(given[count : count + _STATE]),
        given[count + _STATE : 3 * count + _STATE],
        given[3 * count + _STATE :],
    )
    xp = namespace(offs[0])
    for k, off in enumerate(offs):
        state[0] = state[0] + off
        for wave in range(4):
            state[1 + wave] = state[1 + wave] + off * basis[4 * k + wave]
        state[5] = xp.where(off > state[5], off, state[5])
        state[6] = xp.where(off < state[6], off, state[6])
    return (*state, *(add for k, off in enumerate(offs) for add in (sums[2 * k] + off, sums[2 * k + 1] + off * off)))


def _first(
    cd: Any, sd: Any, a: Any, p: Any, q: Any, f: Any, g: Any, c: Any, s: Any, cm: Any, sm: Any
) -> tuple[Any, Any]:
    return onward(c, s, cd, sd, a, p, q, f, g, cm, sm)


def _only(*given: Any) -> tuple[Any]:
    """Take one joint alone, from the position to the error."""
    link_of, (c, s, ci, si, centre) = given[:_LINK], given[_LINK:]
    return (ended(c, s, link_of, ci, si, centre),)


def _last(along: Any, across: Any, *given: Any) -> tuple[Any]:
    """Take the last joint, from the direction of its driving yoke to the error."""
    link_of, (ci, si, centre) = given[:_LINK], given[_LINK:]
    return (ended(along, across, link_of, ci, si, centre),)


def finished(
    total: Any, c1: Any, s1: Any, c2: Any, s2: Any, most: Any, least: Any, share: Any
) -> tuple[Any, Any, Any, Any]:
    """Return the sizes of mean and first two orders, and the change."""
    xp = namespace(total)
    double = 2.0 * share
    first, second = xp.sqrt(c1 * c1 + s1 * s1), xp.sqrt(c2 * c2 + s2 * s2)
    return xp.abs(total) * share, first * double, second * double, most - least


_link_of, _first_of, _onward_of = step(link), step(_first), step(onward)
_only_of, _last_of, _finished_of, _reduced_of = step(_only), step(_last), step(finished), step(reduced)


@njit(nogil=True)
def _begin(state: Any) -> None:
    for k in range(_STATE * LANES):
        state[k] = 0.0
    for lane in range(LANES):
        state[5 * LANES + lane] = -np.inf
        state[6 * LANES + lane] = np.inf


def _build(sources: int) -> Any:
    @compiled(
        *(OUTPUT, OUTPUT, types.intp[::1], OUTPUT, OUTPUT, OUTPUT, types.intp, types.intp, types.intp, types.intp),
        *(OUTPUT, OUTPUT, OUTPUT),
    )
    def kernel(
        errors: Any,
        known: Any,
        slot: Any,
        joint_angle: Any,
        between: Any,
        table: Any,
        count: int,
        kept: int,
        first: int,
        last: int,
        sums: Any,
        sizes: Any,
        keep: Any,
    ) -> None:
        _sources = sources  # part of the key on disk
        joints, positions = joint_angle.size // 2, table.size // SHARED
        own, links, state = np.empty(SEATS * LANES), np.empty(_LINK * LANES * joints), np.empty(_STATE * LANES)
        way, rest = np.empty(2 * LANES), np.empty(positions * LANES)
        at_own, at_links, at_state, at_way = address(own), address(links), address(state), address(way)
        to_keep, to_sums, to_sizes, to_rest = address(keep), address(sums), address(sizes), address(rest)
        direction = (at_way, at_way + BYTES)
        running = (
            *(at_state, at_state + BYTES, at_state + 2 * BYTES, at_state + 3 * BYTES, at_state + 4 * BYTES),
            *(at_state + 5 * BYTES, at_state + 6 * BYTES),
        )
        for group in range(first, last):
            begin = group * LANES
            for j in range(joints):
                for seat in range(SEATS):
                    row = SEATS * j + seat
                    for lane in range(LANES):
                        own[seat * LANES + lane] = known[row]
                    if slot[row] >= 0:
                        for lane in range(LANES):
                            own[seat * LANES + lane] += errors[slot[row] * count + begin + lane]
                p = at_links + j * _LINK * BYTES
                _link_of(
                    (at_own, at_own + BYTES, at_own + 2 * BYTES, at_own + 3 * BYTES, at_own + 4 * BYTES),
                    (joint_angle[2 * j], joint_angle[2 * j + 1]),
                    (p, p + BYTES, p + 2 * BYTES, p + 3 * BYTES, p + 4 * BYTES, p + 5 * BYTES, p + 6 * BYTES),
                )
            _begin(state)
            start, stride = (to_keep + 8 * begin, 8 * kept) if begin < kept else (to_rest, BYTES)
            for k in range(positions):
                t = SHARED * k
                p = at_links
                one = (p, p + BYTES, p + 2 * BYTES, p + 3 * BYTES, p + 4 * BYTES, p + 5 * BYTES, p + 6 * BYTES)
                perfect = (table[t + 2], table[t + 3], table[t + 4])
                out = (start + stride * k,)
                if joints == 1:
                    _only_of(one, (table[t], table[t + 1], *perfect), out)
                    continue
                _first_of(one, (table[t], table[t + 1], between[0], between[1]), direction)
                for j in range(1, joints):
                    p = at_links + j * _LINK * BYTES
                    one = (p, p + BYTES, p + 2 * BYTES, p + 3 * BYTES, p + 4 * BYTES, p + 5 * BYTES, p + 6 * BYTES)
                    if j < joints - 1:
                        _onward_of((*direction, *one), (between[2 * j], between[2 * j + 1]), direction)
                    else:
                        _last_of((*direction, *one), perfect, out)
            whole = positions - positions % 4
            for k in range(0, whole, 4):
                o, h, t = start + stride * k, to_sums + 2 * BYTES * k, SHARED * k + 5
                here = (
                    h,
                    h + BYTES,
                    h + 2 * BYTES,
                    h + 3 * BYTES,
                    h + 4 * BYTES,
                    h + 5 * BYTES,
                    h + 6 * BYTES,
                    h + 7 * BYTES,
                )
                one_basis = (table[t], table[t + 1], table[t + 2], table[t + 3])
                t += SHARED
                two_basis = (table[t], table[t + 1], table[t + 2], table[t + 3])
                t += SHARED
                three_basis = (table[t], table[t + 1], table[t + 2], table[t + 3])
                t += SHARED
                four_basis = (table[t], table[t + 1], table[t + 2], table[t + 3])
                _reduced_of(
                    (o, o + stride, o + 2 * stride, o + 3 * stride, *running, *here),
                    (*one_basis, *two_basis, *three_basis, *four_basis),
                    (*running, *here),
                )
            for k in range(whole, positions):
                h, t = to_sums + 2 * BYTES * k, SHARED * k + 5
                basis = (table[t], table[t + 1], table[t + 2], table[t + 3])
                _reduced_of((start + stride * k, *running, h, h + BYTES), basis, (*running, h, h + BYTES))
            to = to_sizes + 8 * begin
            wide = 8 * count
            _finished_of(running, (1.0 / positions,), (to, to + wide, to + 2 * wide, to + 3 * wide))

    return kernel


kernel = _build(SOURCES)
