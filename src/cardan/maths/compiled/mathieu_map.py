"""Kernel: half the trace of Mathieu's equation over a period, 64 points at a time."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import types

from .lanes import BYTES, INPUT, LANES, OUTPUT, SOURCES, address, compiled, step
from .splitting import DRIFTS, KICKS, NUMBERS, course, turned

BLOCK = 64
"""Points whose numbers stay in the nearest cache."""

STATES = 4


def _one_step(a: Any, q: Any, u1: Any, v1: Any, u2: Any, v2: Any, *numbers: Any) -> tuple[Any, ...]:
    """Take two solutions one step on; ``numbers`` are those of the drifts, then of the kicks."""
    return course(a, q, (u1, v1, u2, v2), numbers[:DRIFTS], numbers[DRIFTS:])


def _last(a: Any, q: Any, u1: Any, v1: Any, u2: Any, v2: Any, kick: Any, wave: Any) -> tuple[Any]:
    """Take the last kick and return half the trace."""
    return (turned(*course(a, q, (u1, v1, u2, v2), (), (kick, wave))),)


_one_step_of, _last_of = step(_one_step), step(_last)


def _build(sources: int) -> Any:
    @compiled(
        *(INPUT[2], INPUT[2], OUTPUT, types.intp[::1], types.intp[::1], types.float64, types.intp, types.intp), OUTPUT
    )
    def kernel(
        a: Any, q: Any, table: Any, ladder: Any, places: Any, reach: float, first: int, last: int, out: Any
    ) -> None:
        _sources = sources  # part of the key on disk
        columns = a.shape[1]
        own, state, edge = np.empty(2 * BLOCK), np.empty(STATES * BLOCK), np.empty(LANES)
        at_own, at_state, at_edge, to = address(own), address(state), address(edge), address(out)
        wide = 8 * BLOCK
        for row in range(first, last):
            for begin in range(0, columns, BLOCK):
                count = min(BLOCK, columns - begin)
                most = 0.0
                for lane in range(BLOCK):
                    column = begin + min(lane, count - 1)
                    own[lane] = a[row, column]
                    own[BLOCK + lane] = q[row, column]
                    most = max(most, abs(own[lane]) + 2.0 * abs(own[BLOCK + lane]))
                    state[lane] = 1.0
                    state[BLOCK + lane] = 0.0
                    state[2 * BLOCK + lane] = 0.0
                    state[3 * BLOCK + lane] = 1.0
                rung = 0
                while ladder[rung] * reach < np.sqrt(most):
                    rung += 1
                groups = (count + LANES - 1) // LANES
                t = places[rung]
                d = (table[t], table[t + 1], table[t + 2], table[t + 3], table[t + 4], table[t + 5])
                t += DRIFTS
                for _stage in range(ladder[rung]):
                    one = (table[t], table[t + 1], table[t + 2], table[t + 3], table[t + 4], table[t + 5])
                    two = (table[t + 6], table[t + 7], table[t + 8], table[t + 9], table[t + 10], table[t + 11])
                    t += KICKS
                    three = (table[t], table[t + 1], table[t + 2], table[t + 3], table[t + 4], table[t + 5])
                    four = (table[t + 6], table[t + 7], table[t + 8], table[t + 9])
                    t += NUMBERS - KICKS
                    for group in range(groups):
                        p, s = at_own + BYTES * group, at_state + BYTES * group
                        to_state = (s, s + wide, s + 2 * wide, s + 3 * wide)
                        _one_step_of((p, p + wide, *to_state), (*d, *one, *two, *three, *four), to_state)
                end = (table[t], table[t + 1])
                for group in range(groups):
                    p, s = at_own + BYTES * group, at_state + BYTES * group
                    load = (p, p + wide, s, s + wide, s + 2 * wide, s + 3 * wide)
                    place = row * columns + begin + LANES * group
                    if count - LANES * group >= LANES:
                        _last_of(load, end, (to + 8 * place,))
                    else:
                        _last_of(load, end, (at_edge,))
                        for lane in range(count - LANES * group):
                            out[place + lane] = edge[lane]

    return kernel


kernel = _build(SOURCES)
