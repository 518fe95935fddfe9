"""How a shaft turned while it was recorded: its angle and speed over time, from what the recording has of them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from cardan.errors import refuse
from cardan.maths.arrays import Array
from cardan.texts import _
from cardan.units import rpm

from .ridge import ridge
from .rotation import LEAST_TURNS, Rotation
from .signal import Channel, Progress, Signal

MOST_TURNS = 1e7  # no recording has more: 10 000 rpm for half a day
FASTEST = 1e6 * rpm  # no shaft of a drive turns faster
SAMPLES_A_PULSE = 4.0  # values between pulses below which their times are guesses
KNOTS = 8  # knots of the angle in a turn, about, where there are more pulses; their times are sharp to a sample at best
SLOW = 0.02  # share of the greatest speed below which a shaft counts as standing


def estimate_rotation(
    signal: Signal,
    *,
    speed_range: tuple[float, float] | None = None,
    order: float | None = None,
    level: float | None = None,
    hysteresis: float | None = None,
    progress: Progress | None = None,
) -> Rotation:
    """Return how the shaft turned while a signal was recorded.

    Parameters
    ----------
    signal : Signal
        With the pulses, the speed or the angle of the shaft; without them the speed is sought in what shakes.
    speed_range : (float, float) [rad/s], optional
        Least and greatest speed of the shaft, as far as they are known.
    order : float, optional
        Order of the strongest vibration, for a signal without a tacho.
    level, hysteresis : float, optional
        Where the pulses are timed, see `cardan.questions.diagnosis.signals.turning.edges`.
    progress : function, optional
        Told the share done of a search without a tacho, see `cardan.questions.diagnosis.signals.ridge.ridge`.

    Returns
    -------
    Rotation

    Raises
    ------
    InputError
        Too few pulses or turns, or a shaft that stands.

    See Also
    --------
    torsional_vibration, order_spectrum

    Examples
    --------
    >>> from cardan.recordings import Channel, Signal, estimate_rotation
    >>> import numpy as np
    >>> time = np.arange(8000) / 2000
    >>> pulses = np.cos(2 * np.pi * (10 * time + 2 * time**2))
    >>> tacho = Channel(name="tacho", quantity="pulses", rate=2000.0, values=pulses)
    >>> found = estimate_rotation(Signal(channels=(tacho,), tacho=0))
    >>> print(f"{found.turns:.0f} turns, {found.speed_at(2.0) / (2 * np.pi):.1f} 1/s at 2 s")
    71 turns, 18.0 1/s at 2 s
    """
    if signal.tacho is None:
        return ridge(signal.measured, speed_range=speed_range, order=order, progress=progress)
    tacho = signal.channels[signal.tacho]
    if tacho.quantity == "pulses":
        found = _from_pulses(tacho, signal.pulses_per_turn, level, hysteresis)
    else:
        found = _from_speed(tacho, signal.pulses_per_turn)
    if found.turns < LEAST_TURNS:
        text = _("holds {given:.3g} turns of the shaft; at least {wanted:g} are needed")
        raise refuse(tacho.name, text.format(given=found.turns, wanted=LEAST_TURNS), "out_of_range")
    if found.turns > MOST_TURNS:
        text = _("makes {given:.3g} turns; more than {most:g} are not a recording: its unit or rate is wrong")
        raise refuse(tacho.name, text.format(given=found.turns, most=MOST_TURNS), "out_of_range")
    if found.mean_speed > FASTEST:
        text = _("makes {given:.3g} rpm; no shaft turns so fast: its unit, its rate or the pulses per turn are wrong")
        raise refuse(tacho.name, text.format(given=found.mean_speed / rpm), "out_of_range")
    return _judged(found, tacho, signal.measured, speed_range)


def _from_pulses(tacho: Channel, per_turn: float, level: float | None, hysteresis: float | None) -> Rotation:
    found = counted(tacho, level=level, hysteresis=hysteresis)
    cautions = []
    if found.missing or found.extra:
        text = _("{name}: {missing} pulses did not come and {extra} were none; the turns are counted over them.")
        cautions.append(text.format(name=tacho.name, missing=found.missing, extra=found.extra))
    spacing = float(np.min(np.diff(found.time) / np.diff(found.count))) * tacho.rate
    confidence = max(0.05, 1.0 - 2.0 * found.doubtful)
    if spacing < SAMPLES_A_PULSE:
        text = _("{name}: only {count} values between pulses; it was sampled too slowly to time them.")
        cautions.append(text.format(name=tacho.name, count=f"{spacing:.1f}"))
        confidence *= 0.3
    every = max(1, int(per_turn / KNOTS))
    kept = found.count % every == 0
    angle = 2.0 * math.pi * found.count[kept] / per_turn
    return Rotation(time=found.time[kept], angle=angle, confidence=confidence, cautions=tuple(cautions))


def _from_speed(tacho: Channel, per_turn: float) -> Rotation:
    """Return the rotation of a channel of the speed or of the angle; either way round."""
    cautions: tuple[str, ...] = ()
    confidence = 1.0
    if tacho.quantity == "angle":
        angle = np.unwrap(tacho.values) / per_turn
        angle = angle if angle[-1] >= angle[0] else -angle
    else:
        speed = tacho.values / per_turn
        speed = speed if np.mean(speed) >= 0.0 else -speed
        steps = 0.5 * (speed[1:] + speed[:-1]) / tacho.rate
        angle = np.concatenate([[0.0], np.cumsum(steps)])
    step = np.diff(angle)
    slow = step <= SLOW * float(np.max(step, initial=0.0))
    if np.any(slow):
        kept = _longest(~slow)
        text = _("{name}: the shaft stands or turns back for {share:.0f} % of the recording; that part is left out.")
        cautions = (text.format(name=tacho.name, share=100.0 * (1.0 - (kept[1] - kept[0]) / step.size)),)
        confidence = 0.7
        angle, time = angle[kept[0] : kept[1] + 1], tacho.time[kept[0] : kept[1] + 1]
    else:
        time = tacho.time
    if angle.size < 2:
        raise refuse(tacho.name, _("the shaft stands"), "empty")
    source = "angle" if tacho.quantity == "angle" else "speed"
    phased = tacho.quantity == "angle"
    return Rotation(time=time, angle=angle, source=source, confidence=confidence, phased=phased, cautions=cautions)


def _longest(good: Array) -> tuple[int, int]:
    """Return begin and end of the longest run that is good."""
    change = np.flatnonzero(np.diff(np.concatenate([[0], good.astype(int), [0]])))
    if change.size == 0:
        return 0, 0
    begins, ends = change[::2], change[1::2]
    k = int(np.argmax(ends - begins))
    return int(begins[k]), int(ends[k])


def _judged(
    found: Rotation, tacho: Channel, others: Sequence[Channel], speed_range: tuple[float, float] | None
) -> Rotation:
    """Return a rotation with what speaks against it: jumps of the speed, other lengths, speeds out of range."""
    cautions = list(found.cautions)
    confidence = found.confidence * tacho.trust
    uneven = _jumps(found)
    if uneven > 0.0:
        text = _("{name}: the speed jumps by more than a shaft can in {share:.0f} % of the turns.")
        cautions.append(text.format(name=tacho.name, share=100.0 * uneven))
        confidence *= 1.0 - min(0.9, 2.0 * uneven)
    for other in others:
        if abs(other.duration - tacho.duration) > 0.02 * tacho.duration + 2.0 / min(other.rate, tacho.rate):
            text = _("{name} lasts {one:.4g} s and {other} {two:.4g} s: one of them has a wrong sampling rate.")
            text = text.format(name=tacho.name, one=tacho.duration, other=other.name, two=other.duration)
            cautions.append(text)
            confidence *= 0.3
            break
    low, high = found.speeds
    if speed_range is not None and not (0.95 * speed_range[0] <= high and low <= 1.05 * speed_range[1]):
        text = _(
            "{name}: {low:.4g} to {high:.4g} rpm lie outside of the speeds of the drive; sampling rate or pulses per "
            "turn are wrong, or it is another shaft."
        )
        cautions.append(text.format(name=tacho.name, low=low / rpm, high=high / rpm))
        confidence *= 0.3
    return Rotation(
        time=found.time,
        angle=found.angle,
        source=found.source,
        confidence=confidence,
        phased=found.phased,
        cautions=tuple(cautions),
    )


def _jumps(found: Rotation) -> float:
    """Return the share of turns at which the mean speed leaves that of its neighbours by more than a fifth."""
    marks = np.arange(found.angle[0], found.angle[-1], 2.0 * math.pi)
    lasting = np.diff(found.time_at(marks))
    if lasting.size < 5:
        return 0.0
    around = 0.5 * (lasting[2:] + lasting[:-2])
    return float(np.mean(np.abs(lasting[1:-1] / around - 1.0) > 0.2))


# Pulses of a tacho, a key-phasor or a tooth wheel: when they came, which are missing, which are none.

HYSTERESIS = 0.2
"""Share of the height of the pulses that a value must fall below and rise above to count; noise stays within it."""

RARE = 2e-4  # share of the values beyond which a level is a spike, not one of the pulses
EXTRA, MISSING = 0.6, 1.6  # a time between pulses is too short or too long beside those around it
AROUND = 4  # times between pulses to each side that tell what one should be
GRID = 0.35  # how far from a whole number of pulses a gap may end for the pulses in it to be counted


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
