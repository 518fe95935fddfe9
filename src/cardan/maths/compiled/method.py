"""How a large job is computed: compiled or as array expressions."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cache
from math import prod
from typing import TypeAlias

import numpy as np

from cardan.errors import MissingExtraError, Problem, check, refuse
from cardan.later import later
from cardan.maths.arrays import Array
from cardan.texts import _

lanes = later("cardan.maths.compiled.lanes")


@dataclass(frozen=True, kw_only=True, slots=True)
class Plain:
    """Array expressions, by the library of the caller's arrays."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Compiled:
    """The numba kernel; NumPy arrays only.

    Parameters
    ----------
    threads : int, optional
        All processors this process may use by default; 1 where many processes share a machine.
    """

    threads: int | None = None

    def __post_init__(self) -> None:
        if self.threads is not None and self.threads < 1:
            raise refuse("threads", _("{given} given; at least one is needed").format(given=self.threads))


Method: TypeAlias = Plain | Compiled


@cache
def has_numba() -> bool:
    """Tell whether the kernels can be built here; imports numba."""
    try:
        lanes()
    except ImportError:
        return False
    return True


def chosen(method: Method | None, xp: object, large: bool) -> Method:
    """Return the method to use: the caller's, or the compiled one for large jobs on NumPy arrays.

    The choice depends on the job alone, not on what ran before, so that the same call gives the same bits.

    >>> chosen(None, np, large=False)
    Plain()
    """
    if isinstance(method, Compiled) and xp is np and not has_numba():
        raise MissingExtraError(_("the compiled method needs numba: pip install numba"))
    if method is not None:
        return method if xp is np else Plain()
    return Compiled() if large and xp is np and has_numba() else Plain()


# Arrays to write results to: fresh ones, or those of an earlier call.

LINE = 8
"""Numbers in a cache line; writing past the caches goes by whole lines."""


def buffers(names: Sequence[str], shape: tuple[int, ...], out: object | None = None) -> tuple[Array, ...]:
    """Return an array of 64-bit floats for each name.

    names: names of the results.
    out: holds arrays under the same names that are to be used; fresh ones otherwise, which begin at whole cache lines.

    >>> [array.shape for array in buffers(["ratio", "angle"], (2, 3))]
    [(2, 3), (2, 3)]
    """
    if out is None:
        size = prod(shape)
        stride = size + -size % LINE
        block = np.empty(len(names) * stride + LINE)
        skew = -(block.ctypes.data // 8) % LINE
        return tuple(block[skew + k * stride :][:size].reshape(shape) for k in range(len(names)))
    given = {name: getattr(out, name) for name in names}
    check(
        Problem(f"out.{name}", _("needs to be a writeable array of 64-bit floats of shape {shape}").format(shape=shape))
        for name, array in given.items()
        if not _fits(array, shape)
    )
    arrays = tuple(given.values())
    if any(np.may_share_memory(one, two) for k, one in enumerate(arrays) for two in arrays[k + 1 :]):
        raise refuse("out", _("its arrays overlap"))
    return arrays


def _fits(array: object, shape: tuple[int, ...]) -> bool:
    return (
        isinstance(array, np.ndarray)
        and array.shape == shape
        and array.dtype == np.float64
        and array.flags.c_contiguous
        and array.flags.aligned
        and array.flags.writeable
    )


# Rows of a batch shared out among threads.

PARTS = 8
"""Pieces for each thread, so that a thread that was held up leaves work to the others."""


LIMITS = ("NUMBA_NUM_THREADS", "OMP_NUM_THREADS")
"""Variables of the environment that say how many threads a process may have; a cluster gives its workers one."""


def available() -> int:
    """Return how many threads this process may use: one for each processor, or as `LIMITS` say."""
    said = (os.environ.get(name, "") for name in LIMITS)
    return min([processors(), *(int(text) for text in said if text.isdecimal() and int(text) > 0)])


def processors() -> int:
    """Return how many processors this process may use."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:  # not every system can say
        return os.cpu_count() or 1


def share(work: Callable[[int, int], None], rows: int, *, threads: int | None = None, least: int = 1) -> None:
    """Call ``work(first, last)`` for pieces that together are ``range(rows)``.

    work: must release the interpreter lock to gain anything; threads: all available processors by default.
    least: smallest piece worth a thread.
    """
    count = min(threads or available(), max(1, rows // least))
    if count == 1:
        work(0, rows)
        return
    pieces = min(count * PARTS, max(1, rows // least))
    ends = [rows * k // pieces for k in range(pieces + 1)]
    with ThreadPoolExecutor(count) as pool:
        list(pool.map(work, ends[:-1], ends[1:]))
