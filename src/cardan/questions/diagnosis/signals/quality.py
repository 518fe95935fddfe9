"""Is a recording sound? Gaps filled, clipping, overflow and dead channels told, with how far each can be trusted."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.maths.arrays import Array
from cardan.texts import _, plural

from .signal import LARGEST

CLIPPED = 3.0  # times as many values at the very top as just below it: no vibration does that
NEXT = 2e-3  # share of the range that counts as just below the top
WRAP = 0.9  # share of the range that a value jumps by when a number has overflown
UNEVEN = 0.02  # share of a step by which times may differ from even ones
GAP = 1.5  # steps from which on values are missing between two times
STILL = 0.1  # share of the recording over which a vibration may stay at one value to the last digit
LOST = 0.5  # share of the values that may be missing; beyond it a channel says nothing


@dataclass(frozen=True, eq=False, kw_only=True)
class CleanChannel:
    """Values of a channel, made whole."""

    values: Array  # (n,): all finite; gaps are bridged by straight lines
    trust: float  # from 0 to 1
    cautions: tuple[str, ...]  # what was doubtful


def sound(name: str, values: Array, *, swings: bool = True, steady: bool = False) -> CleanChannel | None:
    """Return the values of a channel with its gaps filled and what is doubtful in them, None where it holds nothing.

    values (n,): as read; nan where there is none.
    swings: whether it is a vibration, which has no flat tops; pulses, speeds and angles may.
    steady: whether it may stay at a value other than 0, as a speed does.
    Clipped is a channel of which three times as many values lie at the very top, or bottom, as in the 0.2 % of its
    range beside it (1.5 steps of a coarse converter), in two or more flats: near its peak a vibration lingers, but not
    like that. Overflown is one that jumps by 90 % of its range, twice or more, and would be smooth without these jumps.
    """
    values = np.asarray(values, dtype=float)
    missing = ~(np.abs(values) <= LARGEST)
    share = float(np.mean(missing)) if values.size else 1.0
    if share > LOST:
        return None
    trust, told = 1.0, []
    if share > 0.0:
        place = np.arange(values.size)
        values = np.interp(place, place[~missing], values[~missing])
        text = _("{name}: {count} of its values are missing or no numbers ({share:.2g} %); they were bridged.")
        told.append(text.format(name=name, count=int(np.sum(missing)), share=100.0 * share))
        trust *= max(0.1, 1.0 - 4.0 * share)
    if np.ptp(values) == 0.0 and not (steady and values[0] != 0.0):
        told.append(_("{name}: constant; the sensor may be dead or not connected.").format(name=name))
        return CleanChannel(values=values, trust=0.0, cautions=tuple(told))
    wrapped = _wrapped(values)
    if wrapped:
        text = _("{name}: jumps through its whole range {count} times; its numbers have overflown.")
        told.append(text.format(name=name, count=wrapped))
        trust *= 0.1
    still = _still(values) if swings else 0.0
    if still > STILL:
        text = _("{name}: stays at one value for {share:.0f} % of the recording; its cable may be loose.")
        told.append(text.format(name=name, share=100.0 * still))
        trust *= max(0.1, 1.0 - 2.0 * still)
    flat = _flat(values) if swings and still <= STILL else 0.0
    if flat > 0.0 and not wrapped:
        text = _("{name}: clipped at its limits, {share} % of its values; peaks are cut and orders made up.")
        told.append(text.format(name=name, share=f"{100.0 * flat:.0f}" if flat > 0.1 else f"{100.0 * flat:.2g}"))
        trust *= max(0.2, 1.0 - 10.0 * flat)
    return CleanChannel(values=values, trust=trust, cautions=tuple(told))


def _still(values: Array) -> float:
    """Return the share of the longest stretch in which every value is the one before it."""
    change = np.flatnonzero(np.diff(values))
    ends = np.concatenate([[-1], change, [values.size - 1]])
    return float(np.max(np.diff(ends)) / values.size)


def _flat(values: Array) -> float:
    """Return the share of values that are cut off, 0 where none is."""
    span = float(np.ptp(values))
    levels = np.unique(values[:: max(1, values.size // 200_000)])
    steps = np.diff(levels)
    steps = steps[steps > 1e-9 * span]
    coarse = float(np.min(steps)) if steps.size else span
    beside = max(NEXT * span, 1.5 * coarse)
    cut = 0
    for one in (values, -values):
        top = float(np.max(one))
        high = one >= top - 1e-6 * span
        near = (one >= top - beside) & ~high
        runs = int(np.sum(high[1:] & high[:-1] & ~np.concatenate([[False], high[:-2]])))
        count = int(np.sum(high))
        if runs >= 2 and count >= 6 and count > CLIPPED * int(np.sum(near)):
            cut += count
    return cut / int(values.size)


def _wrapped(values: Array) -> int:
    """Return how often a value jumps through the whole range as a number does that overflows."""
    step, span = np.diff(values), float(np.ptp(values))
    jumps = np.abs(step) > WRAP * span
    count = int(np.sum(jumps))
    if count < 2 or step.size < 8:
        return 0
    rest = float(np.quantile(np.abs(step[~jumps]), 0.99)) if np.any(~jumps) else span
    healed = float(np.median(np.abs(np.abs(step[jumps]) - span)))
    middle = 0.5 * (float(np.max(values)) + float(np.min(values)))
    square = float(np.mean(np.abs(values - middle) > 0.45 * span)) > 0.6
    return count if not square and rest < 0.35 * span and healed < 0.5 * rest + 0.05 * span else 0


def evened(times: Array, rows: Array) -> tuple[float, float, Array, tuple[str, ...], float]:
    """Return rate, start, values at even steps, cautions and trust of values at times that may be uneven.

    times (n,) [s]: rising, n at least 2.
    rows (c, n): values of all channels; nan where there are none.
    Returns (float [Hz], float [s], array (c, m), tuple of str, float): gaps in time are nan.
    """
    step = float(np.median(np.diff(times)))
    start, lasting = float(times[0]), float(times[-1] - times[0])
    gaps = np.diff(times) > GAP * step
    if not np.any(gaps):  # the mean step is sharper than the median of rounded times
        step = lasting / (times.size - 1)
    even = start + step * np.arange(round(lasting / step) + 1)
    told: list[str] = []
    trust = 1.0
    off = np.abs(times - start - step * np.rint((times - start) / step))
    rounding = 10.0 * np.finfo(float).eps * max(abs(start), lasting) + _rounding(times)
    jitter = float(np.quantile(off, 0.99))
    if jitter <= max(UNEVEN * step, rounding) and not np.any(gaps) and even.size == times.size:
        return 1.0 / step, start, rows, (), 1.0
    found = np.stack([np.interp(even, times, row) for row in rows])
    if np.any(gaps):
        hole = np.zeros(even.size, dtype=bool)
        for begin, end in zip(times[:-1][gaps], times[1:][gaps], strict=True):
            hole |= (even > begin + 0.5 * step) & (even < end - 0.5 * step)
        found[:, hole] = np.nan
        share = float(np.mean(hole))
        count = int(np.sum(gaps))
        text = plural(
            "the times have {count} gap, {share:.2g} % of the recording; it was bridged.",
            "the times have {count} gaps, {share:.2g} % of the recording; they were bridged.",
            count,
        )
        told.append(text.format(count=count, share=100.0 * float(np.sum(np.diff(times)[gaps] - step)) / lasting))
        trust *= max(0.1, 1.0 - 2.0 * share)
    if jitter > max(UNEVEN * step, rounding):
        text = _("the time steps differ by {share:.2g} % of a step; values were put at equal ones by straight lines.")
        told.append(text.format(share=100.0 * jitter / step))
        trust *= max(0.2, 1.0 - 2.0 * jitter / step)
    return 1.0 / step, start, found, tuple(told), trust


def _rounding(times: Array) -> float:
    """Return by how much times written with few digits, and the first of them, are off: half of the last digit each."""
    for digits in range(12):
        if np.allclose(times, np.round(times, digits), rtol=0.0, atol=1e-12):
            return 1.02 * 10.0**-digits
    return 0.0
