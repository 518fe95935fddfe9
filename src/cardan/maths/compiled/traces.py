"""Kernel: output angle, speed ratio and acceleration of many chains over many positions, each written once."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit, types

from .approximations import arctangent, argument_right
from .lanes import BYTES, INPUT, LANES, OUTPUT, SOURCES, address, compiled, fence, step
from .pairs import BLOCK, pair_block, room

MILD = 0.14
"""Largest τ² for which the lead stays below π/8, the range of the short arctangent (sin²(π/8) = 0.1464)."""

_SHARED = 5


def per_chain(ar: Any, ai: Any, br: Any, bi: Any) -> tuple[Any, Any, Any, Any, Any]:
    """Return what all positions of a chain share: 1/\\|a\\|², 4\\|a\\|², q = b̄/ā and the lead at the start."""
    size = ar * ar + ai * ai
    share = 1.0 / size
    along, across = (br * ar + bi * ai) * share, (br * ai - bi * ar) * share
    return share, 4.0 * size, along, across, argument_right(across, 1.0 + along)


def _ratio(c: Any, s: Any, share: Any, along: Any, across: Any) -> tuple[Any, Any, Any, Any]:
    """Return x and y of x + iy = 1 + q e^(2iφ), the ratio and y/x, with one division."""
    x = 1.0 + along * c - across * s
    y = along * s + across * c
    square = x * x + y * y
    inverse = 1.0 / (x * square)
    return x, y, share * (x * inverse), y * (square * inverse)


def mild(
    c: Any, s: Any, angle: Any, share: Any, along: Any, across: Any, begin: Any, acceleration: Any, pull: Any
) -> tuple[Any, Any, Any]:
    """Return output angle, ratio and acceleration where the lead stays below π/8."""
    _x, y, ratio, tangent = _ratio(c, s, share, along, across)
    return angle + (begin - arctangent(tangent)), ratio, ratio * (acceleration + pull * (y * ratio))


def steep(
    c: Any, s: Any, angle: Any, share: Any, along: Any, across: Any, begin: Any, acceleration: Any, pull: Any
) -> tuple[Any, Any, Any]:
    """Return output angle, ratio and acceleration for any bend."""
    x, y, ratio, _tangent = _ratio(c, s, share, along, across)
    return angle + (begin - argument_right(y, x)), ratio, ratio * (acceleration + pull * (y * ratio))


_per_chain = step(per_chain)
_line_past = step(lambda angle, ratio, rate: (angle, ratio, rate), past_caches=True)
_mild, _steep = step(mild), step(steep)
_mild_past, _steep_past = step(mild, past_caches=True), step(steep, past_caches=True)


def position_arrays(angle: Any) -> tuple[Any, Any, Any]:
    """Return cos 2φ, sin 2φ and φ with the room behind them that whole lanes need.

    >>> position_arrays(np.asarray([0.0]))[0].size
    9
    """
    table = np.zeros((3, angle.size + LANES))
    table[:, : angle.size] = np.cos(2.0 * angle), np.sin(2.0 * angle), angle
    return table[0], table[1], table[2]


@njit(nogil=True)
def _copied(lanes: Any, count: int, place: int, out_angle: Any, out_ratio: Any, out_rate: Any) -> None:
    """Write ``count`` numbers of each result from three lanes, where a whole line cannot be written."""
    for k in range(count):
        out_angle[place + k] = lanes[k]
        out_ratio[place + k] = lanes[LANES + k]
        out_rate[place + k] = lanes[2 * LANES + k]


def _build(sources: int) -> Any:
    @compiled(
        *(INPUT[2], INPUT[2], INPUT[2], INPUT[1], INPUT[1], INPUT[1]),
        *(INPUT[1], INPUT[1], INPUT[1], types.intp, types.intp, types.intp),
        *(OUTPUT, OUTPUT, OUTPUT),
    )
    def kernel(
        joint_angle: Any,
        plane_twist: Any,
        yoke_angle: Any,
        start_phase: Any,
        speed: Any,
        acceleration: Any,
        cosine: Any,
        sine: Any,
        angle: Any,
        positions: int,
        first: int,
        last: int,
        out_angle: Any,
        out_ratio: Any,
        out_rate: Any,
    ) -> None:
        _sources = sources  # part of the key on disk
        scratch, shared = room(joint_angle.shape[1]), np.empty(_SHARED * BLOCK)
        edge, line = np.empty(3 * LANES), np.empty(3 * LANES)
        at, to, wide = address(scratch), address(shared), 8 * BLOCK
        at_edge, at_line = address(edge), address(line)
        edges = (at_edge, at_edge + BYTES, at_edge + 2 * BYTES)
        lines = (at_line, at_line + BYTES, at_line + 2 * BYTES)
        at_cosine, at_sine, at_angle = address(cosine), address(sine), address(angle)
        to_angle, to_ratio, to_rate = address(out_angle), address(out_ratio), address(out_rate)
        past = (to_ratio - to_angle) % BYTES == 0 and (to_rate - to_angle) % BYTES == 0 and positions >= LANES
        for row in range(first, last):
            lane = (row - first) % BLOCK
            if lane == 0:
                count = min(BLOCK, last - row)
                pair_block(joint_angle, plane_twist, yoke_angle, start_phase, row, count, scratch)
                for group in range((count + LANES - 1) // LANES):
                    a, p = at + BYTES * group, to + BYTES * group
                    _per_chain(
                        (a, a + wide, a + 2 * wide, a + 3 * wide),
                        (),
                        (p, p + wide, p + 2 * wide, p + 3 * wide, p + 4 * wide),
                    )
            along, across = shared[2 * BLOCK + lane], shared[3 * BLOCK + lane]
            small = along * along + across * across <= MILD
            pull = shared[BLOCK + lane] * speed[row] * speed[row]
            numbers = (shared[lane], along, across, shared[4 * BLOCK + lane], acceleration[row], pull)
            place = positions * row
            skew = 8 * place
            head = ((BYTES - (to_angle + skew) % BYTES) % BYTES) // 8 if past else 0
            whole = (positions - head) // LANES
            rest = positions - head - LANES * whole
            if head:  # the line begun by the row before
                load = (at_cosine, at_sine, at_angle)
                if small:
                    _mild(load, numbers, edges)
                else:
                    _steep(load, numbers, edges)
                if row == first:
                    _copied(edge, head, place, out_angle, out_ratio, out_rate)
                else:
                    for k in range(head):
                        line[LANES - head + k] = edge[k]
                        line[2 * LANES - head + k] = edge[LANES + k]
                        line[3 * LANES - head + k] = edge[2 * LANES + k]
                    go = skew + 8 * head - BYTES
                    _line_past(lines, (), (to_angle + go, to_ratio + go, to_rate + go))
            for k in range(whole):
                go = 8 * head + BYTES * k
                load = (at_cosine + go, at_sine + go, at_angle + go)
                store = (to_angle + skew + go, to_ratio + skew + go, to_rate + skew + go)
                if past and small:
                    _mild_past(load, numbers, store)
                elif past:
                    _steep_past(load, numbers, store)
                elif small:
                    _mild(load, numbers, store)
                else:
                    _steep(load, numbers, store)
            if rest:
                go = 8 * (positions - rest)
                load = (at_cosine + go, at_sine + go, at_angle + go)
                if small:
                    _mild(load, numbers, lines)
                else:
                    _steep(load, numbers, lines)
                if not past or row == last - 1:
                    _copied(line, rest, place + positions - rest, out_angle, out_ratio, out_rate)
        fence()

    return kernel


kernel = _build(SOURCES)
