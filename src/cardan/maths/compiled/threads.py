"""Rows of a batch shared out among threads."""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

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
