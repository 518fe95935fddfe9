"""The yardstick of pure arithmetic: multiply-adds on numbers that stay in registers, by all processors."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import types

from cardan.maths.compiled.lanes import BYTES, LANES, OUTPUT, address, compiled, step
from cardan.maths.compiled.method import share

CHAINS, ROUNDS = 4, 60
"""Independent groups of lanes, enough to hide how long one multiply-add takes; multiply-adds of each in one go."""


def _chains(by: Any, one: Any, two: Any, three: Any, four: Any) -> tuple[Any, ...]:
    found = (one, two, three, four)
    for _round in range(ROUNDS):
        found = tuple(x * by + by for x in found)
    return found


_chains_of = step(_chains)


@compiled(OUTPUT, types.intp)
def _run(room: Any, count: int) -> None:
    p = address(room)
    one, two, three, four, five = p, p + BYTES, p + 2 * BYTES, p + 3 * BYTES, p + 4 * BYTES
    for _go in range(count):
        _chains_of((one, two, three, four, five), (), (two, three, four, five))


def multiply_adds(millions: int) -> int:
    """Do at least so many millions of multiply-adds and return how many they were."""
    each = CHAINS * LANES * ROUNDS
    count = -(-millions * 10**6 // each)
    share(lambda first, last: _run(np.full((CHAINS + 1) * LANES, 0.5), last - first), count, least=1000)
    return count * each
