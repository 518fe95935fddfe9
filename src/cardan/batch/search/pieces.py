"""Many points asked piece by piece: progress is told, work can be stopped, memory stays bounded."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from time import perf_counter
from typing import TypeAlias

import numpy as np

from cardan.batch.work import STATUS, Rows
from cardan.maths.arrays import Array

from .goals import Evaluator

Progress: TypeAlias = Callable[[float], object]
"""Told the share done; when it answers "stop", the work ends."""

FIRST, MOST = 16, 2**16
"""Points of the first piece and of the largest."""

SECONDS = 0.25
"""How long a piece takes, about."""


class StoppedError(Exception):
    """The user has enough."""


def tell(progress: Progress | None, share: float) -> None:
    """Tell the share done."""
    if progress is not None and progress(min(share, 1.0)) == "stop":
        raise StoppedError


def answered(
    ask: Evaluator,
    points: Array,
    names: Sequence[str],
    progress: Progress | None = None,
    *,
    begin: float = 0.0,
    end: float = 1.0,
) -> Rows | None:
    """Return answers at points, or None where the work was stopped.

    points (N, d): in the units of the fields; names: columns wanted beside the status.
    begin, end: share of the whole work that is done before and after.
    """
    count = len(points)
    kept: dict[str, list[Array]] = {name: [np.empty(0)] for name in (*names, STATUS)}
    place, size = 0, FIRST
    while place < count:
        start = perf_counter()
        rows = ask(points[place : place + size])
        place = min(place + size, count)
        for name, parts in kept.items():
            parts.append(np.asarray(rows[name], dtype=float))
        if progress is not None and progress(begin + (end - begin) * place / count) == "stop" and place < count:
            return None
        rate = size / max(perf_counter() - start, 1e-6)
        size = int(min(max(SECONDS * rate, 1.0), 8.0 * size, MOST))
    return {name: np.concatenate(parts) for name, parts in kept.items()}
