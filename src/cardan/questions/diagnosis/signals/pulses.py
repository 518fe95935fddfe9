"""Pulses of a tacho, a key-phasor or a tooth wheel: when they came, which are missing, which are none."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from cardan.errors import refuse
from cardan.maths.arrays import Array
from cardan.texts import _

from .signal import Channel

HYSTERESIS = 0.2
"""Share of the height of the pulses that a value must fall below and rise above to count; noise stays within it."""

RARE = 2e-4
"""Share of the values beyond which a level is a spike, not one of the pulses."""

EXTRA, MISSING = 0.6, 1.6
"""A time between pulses is too short or too long beside those around it."""

AROUND = 4
"""Times between pulses to each side that tell what one should be."""

GRID = 0.35
"""How far from a whole number of pulses a gap may end for the pulses in it to be counted."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Pulses:
    """Times of the pulses, counted as if none were missing."""

    time: Array  # (m,) [s]: of the pulses that are there
    count: Array  # (m,): number of each, from 0; missing ones leave a gap
    missing: int  # missing, extra: pulses that did not come, and pulses left out because they came between two others
    extra: int
    level: float  # where the edges were timed, in the unit of the channel
    doubtful: float  # share of the turning that rests on pulses counted over a gap


def edges(channel: Channel, *, level: float | None = None, hysteresis: float | None = None) -> tuple[Array, float]:
    """Return the times at which a channel rises through a level, and the level.

    channel: pulses, or anything that goes up and down with the shaft.
    level: midway between the two heights of the channel when not given, spikes left aside.
    hysteresis: height about the level that has to be passed as a whole; 0.2 of the height of the pulses when not given.
    Returns (array (m,) [s], float): interpolated between the two values about the level.
    """
    values = channel.values
    low, high = np.quantile(values, [RARE, 1.0 - RARE])
    if not high > low:
        low, high = np.min(values), np.max(values)
    middle = 0.5 * float(low + high) if level is None else level
    width = HYSTERESIS * float(high - low) if hysteresis is None else hysteresis
    state = np.where(values > middle + 0.5 * width, 1, np.where(values < middle - 0.5 * width, -1, 0))
    place = np.arange(values.size)
    known = np.maximum.accumulate(np.where(state != 0, place, 0))
    held = state[known]
    rise = np.flatnonzero((held[1:] == 1) & (held[:-1] == -1)) + 1
    below = np.maximum.accumulate(np.where(values <= middle, place, 0))[rise]
    step = values[below + 1] - values[below]
    inside = np.where(step > 0.0, (middle - values[below]) / np.where(step > 0.0, step, 1.0), 0.0)
    return channel.start + (below + inside) / channel.rate, middle


def counted(channel: Channel, *, level: float | None = None, hysteresis: float | None = None) -> Pulses:
    """Return the pulses of a channel, without those that are none and counted over those that did not come.

    level, hysteresis: as in `edges`.
    The speed of a shaft changes little from pulse to pulse, so the time between two is compared with the median of
    the four before and the four after it. One below 0.6 of it ends in a pulse that is none: that one is left out whose
    loss makes the times more even. One of 1.6 and more holds pulses that did not come; as many as the speeds before and
    after make of it, if that is within 0.35 of a whole number. At both ends of the record nothing is counted over.
    """
    times, middle = edges(channel, level=level, hysteresis=hysteresis)
    if times.size < 4:
        text = _("has {count} pulses; at least 4 are needed")
        raise refuse(channel.name, text.format(count=times.size), "empty")
    times, extra = _without_extra(times)
    between = np.diff(times)
    expected = _around(between)
    long = between > MISSING * expected
    long[[0, -1]] = False
    pulses = np.ones(between.size, dtype=int)
    doubtful = 0.0
    for k in np.flatnonzero(long):
        before, after = expected[max(k - 1, 0)], expected[min(k + 1, between.size - 1)]
        ratio = 0.5 * between[k] * (1.0 / before + 1.0 / after)
        pulses[k] = max(1, round(float(ratio)))
        clear = abs(ratio - pulses[k]) <= GRID and pulses[k] <= 2 * AROUND
        doubtful += float(between[k]) * (0.5 if clear else 4.0)
    count = np.concatenate([[0], np.cumsum(pulses)])
    lasting = float(times[-1] - times[0])
    return Pulses(
        time=times,
        count=count,
        missing=int(np.sum(pulses - 1)),
        extra=extra,
        level=middle,
        doubtful=min(1.0, doubtful / lasting + extra / times.size),
    )


def _around(between: Array) -> Array:
    """Return what each time between pulses should be: the median of those to both sides of it."""
    padded = np.pad(between, AROUND, mode="reflect" if between.size > AROUND else "edge")
    windows = sliding_window_view(padded, 2 * AROUND + 1)
    return np.asarray(np.median(np.delete(windows, AROUND, axis=1), axis=1))


def _without_extra(times: Array) -> tuple[Array, int]:
    """Return the pulses without those that came between two others, and how many those were."""
    extra = 0
    while times.size > 4:
        between = np.diff(times)
        expected = _around(between)
        short = between < EXTRA * expected
        # A run-up has short times after long ones; only a pair that sums up to one turn holds a pulse that is none.
        found = []
        for k in np.flatnonzero(short).tolist():
            for pulse in (k, k + 1):
                if 0 < pulse < times.size - 1:
                    joined = times[pulse + 1] - times[pulse - 1]
                    found.append((abs(joined / expected[k] - 1.0), pulse))
        found = [one for one in found if one[0] < GRID]
        if not found:
            break
        gone: list[int] = []
        for _off, pulse in sorted(found):
            if all(abs(pulse - other) > 1 for other in gone):
                gone.append(pulse)
        times = np.delete(times, gone)
        extra += len(gone)
    return times, extra
