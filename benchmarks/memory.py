"""The yardstick of stored results: writing the same bytes, by all processors, into memory that was touched before."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import types

from cardan.maths.compiled.lanes import BYTES, LANES, OUTPUT, address, compiled, fence, step
from cardan.maths.compiled.method import share

_past = step(lambda number: (number,), past_caches=True)


@compiled(OUTPUT, types.float64, types.intp, types.intp)
def _fill(out: Any, number: float, first: int, last: int) -> None:
    for k in range(first, last):
        out[k] = number


@compiled(OUTPUT, types.float64, types.intp, types.intp)
def _fill_past_caches(out: Any, number: float, first: int, last: int) -> None:
    begin = address(out)
    for k in range(first, last):
        _past((), (number,), (begin + BYTES * k,))
    fence()


def write(out: np.ndarray, number: float) -> None:
    """Write as any program does: each line is read into the caches first."""
    share(lambda first, last: _fill(out, number, first, last), out.size)


def write_past_caches(out: np.ndarray, number: float) -> None:
    """Write whole lines past the caches; ``out`` must begin at one and end with one."""
    share(lambda first, last: _fill_past_caches(out, number, first, last), out.size // LANES)
