"""Values at any times from values at even steps, without echoes of what is too fast for the new steps.

Reading a record at fewer points than it was taken with folds its fast parts onto slow ones, unless they are filtered
out before. Where the new points lie at even angles of a shaft that speeds up, how much is too fast changes along the
record: every point is read from the one of several records, each half as dense as the one before, that holds enough.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache

import numpy as np
import scipy

from cardan.maths.arrays import Array

TAPS = 24
"""Values to each side that an interpolated one is made of."""

BETA = 9.0
"""Of the Kaiser windows: what is cut is below 1e-4 of what was there."""

BLOCK = 1 << 16
"""Points read at once; bounds the memory."""

PHASES = 2048
"""Places between two values at which the weights are kept; a straight line between them is right to 10⁻⁶."""

HALVING = 129
"""Coefficients of the low-pass before every other value is left out."""


@cache
def _half_band() -> Array:
    return scipy.signal.firwin(HALVING, 0.5, window=("kaiser", BETA))


@cache
def _sinc_table() -> Array:
    """Return the weights of the values about a place, a row for each of `PHASES` places and the next value."""
    away = np.arange(PHASES + 1)[:, None] / PHASES - np.arange(1 - TAPS, TAPS + 1)
    window = np.i0(BETA * np.sqrt(np.clip(1.0 - (away / TAPS) ** 2, 0.0, None)))
    weight = np.sinc(away) * window
    return np.asarray(weight / np.sum(weight, axis=1, keepdims=True))


def halved(values: Array) -> Array:
    """Return every other value of a record after a low-pass without delay.

    values (n,): at even steps.
    Returns (⌈n/2⌉,): from the first value on. Kept to 4·10⁻⁵ are the lower 0.9 of what its rate can hold; what it
    cannot is folded into the last tenth alone. The first and last sixty values come from what the record would be
    beyond its ends.
    """
    middle = HALVING // 2
    padded = _continued(values, min(middle, values.size - 1))
    whole = scipy.signal.oaconvolve(padded, _half_band(), mode="same")
    first = (padded.size - values.size) // 2
    return whole[first : first + values.size : 2]


def _continued(values: Array, count: int) -> Array:
    """Return a record with ``count`` values more at both ends, turned about its end values: no step, no kink."""
    if count < 1:
        return values
    head = 2.0 * values[0] - values[count:0:-1]
    tail = 2.0 * values[-1] - values[-2 : -count - 2 : -1]
    return np.concatenate([head, values, tail])


def _padded(values: Array) -> Array:
    """Return a record with as many values beyond its ends as interpolation reaches."""
    count = min(TAPS, values.size - 1)
    padded = _continued(values, count)
    return np.pad(padded, TAPS - count, mode="edge") if count < TAPS else padded


def _read(padded: Array, place: Array) -> Array:
    """Return a record with its ends padded at a block of places."""
    steps, table = np.arange(1 - TAPS, TAPS + 1), _sinc_table()
    whole = np.clip(np.floor(place).astype(int), 0, padded.size - 2 * TAPS - 1)
    fine = (place - whole) * PHASES
    row = np.clip(fine.astype(int), 0, PHASES - 1)
    weight = table[row] + (fine - row)[:, None] * (table[row + 1] - table[row])
    return np.asarray(np.einsum("ij,ij->i", weight, padded[whole[:, None] + steps + TAPS]))


def read_slowly(
    values: Array, place: Array, step: Array, *, progress: Callable[[float], object] | None = None
) -> Array:
    """Return a record at points that may lie farther apart than its values, filtered before.

    values (n,): at even steps, n at least 2; place (m,): where: 0 is the first value.
    step (m,): distance of the points there, in steps of the record.
    progress: told the share done; when it answers "stop" the points read so far are returned.
    Returns (m,): right for what has 4 points or more in a period, whatever else the record holds.

    A point is read from the record halved j times, with the least j for which a step of the halved record is at least
    0.7 of the distance of the points. What the points hold below a quarter of their rate is then below 0.7 of half
    the rate of that record, and what could fold onto it was filtered out.
    """
    need = np.log2(np.maximum(0.7 * step, 1e-9))
    deepest = max(0, int(math.log2(max(values.size / (2 * HALVING), 1.0))))
    level = np.clip(np.ceil(need - 1e-9).astype(int), 0, deepest)
    used = set(np.unique(level).tolist())
    rows = {}
    row = values
    for j in range(max(used, default=0) + 1):
        row = halved(row) if j else row
        if j in used:
            rows[j] = _padded(row)
    found = np.empty(place.size)
    for first in range(0, place.size, BLOCK):
        last = min(first + BLOCK, place.size)
        for j in np.unique(level[first:last]).tolist():
            mine = first + np.flatnonzero(level[first:last] == j)
            found[mine] = _read(rows[j], place[mine] / 2.0**j)
        if progress is not None and progress(last / place.size) == "stop":
            return found[:last]
    return found
