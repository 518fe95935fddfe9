"""How a shaft turned, found in what shakes: the line of a spectrogram that goes on and on.

Without a tacho nobody knows for certain which order the strongest line is. So the answer states its confidence, and by
which factors it may be off.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy
from numpy.lib.stride_tricks import sliding_window_view

from cardan.errors import refuse
from cardan.maths.arrays import Array
from cardan.maths.curves.resampling import halved
from cardan.texts import _
from cardan.units import rpm

from .rotation import LEAST_TURNS, Rotation
from .signal import Channel, Progress, Watch

BAND = (1.5, 250.0)  # turns a second between which a shaft is sought where nothing is known of it [Hz]
FASTEST = 2.0  # order up to which the strongest line is sought
WINDOWS = (0.25, 0.5, 1.0, 2.0, 4.0)  # lengths of a window of the spectrogram that are tried [s]
HOPS = 4  # steps of the spectrogram in the length of a window
AROUND = 16  # lines to each side whose median a line is put over
BLOCK = 1 << 20  # values that are transformed at once; bounds the memory
SHORTER = 0.9  # share of the longest channel that one may last and be sought in together with it
JUMP = 4  # lines that the ridge may change by from step to step
STIFF = 0.5  # what a change by one line costs, in nepers of power

SURE, NOISE = 4.0, 2.2
"""Mean height of a ridge over what is around it [nepers of power]: surely a tone; what chance makes in noise."""

STEADY, WAVERING = 0.3, 0.6
"""Change of a ridge from window to window, straight courses apart [nepers of power]: a tone's; about that of noise."""

PRIOR = {1.0: 0.50, 2.0: 0.35, 3.0: 0.08, 4.0: 0.07}
"""Belief, before looking, that the strongest line of a shaft drive is this order."""

BETWEEN = {2: (0.5, 1.5, 2.5), 3: (1 / 3, 2 / 3, 4 / 3, 5 / 3), 4: (0.25, 0.75, 1.25, 1.75)}
"""Divisor -> multiples of the line at which there should be something if the line is an order with this divisor."""

SEEN, UNSEEN = 0.5, 0.1  # chance that one of these stands out if it belongs to the shaft, and if it does not


@dataclass(frozen=True, eq=False, kw_only=True)
class _Map:
    """Power, its logarithm over that around it, steps in time by lines of frequency; the first row it is made of."""

    level: Array
    time: Array
    frequency: Array
    window: float
    power: Array
    row: Array
    rate: float


@dataclass(frozen=True, eq=False, kw_only=True)
class _Path:
    map: _Map
    frequency: Array
    height: float


def ridge(
    channels: Sequence[Channel],
    *,
    speed_range: tuple[float, float] | None = None,
    order: float | None = None,
    progress: Progress | None = None,
) -> Rotation:
    """Return how a shaft turned, from the strongest line of what shakes.

    channels: what shakes; those that share the rate of the first one are looked at together.
    speed_range [rad/s]: least and greatest speed of the shaft. The narrower, the surer.
    order: order of the strongest line, where it is known.
    progress: told the share done; when it answers "stop" lengths of the window not yet tried are left out, all but the
    first.
    Returns Rotation: with its confidence and with the factors by which it may be off; phases mean nothing.

    In a spectrogram every line is put over the median of its neighbours; the path with the greatest sum of logarithms,
    less a toll for every change, is the ridge (dynamic programming, as Viterbi's). Of several windows the one with the
    highest ridge counts. The angle then follows the phase of the vibration along the ridge. Which order the ridge is,
    is weighed by whether there is anything at its halves, thirds and quarters. A ridge whose power wavers from window
    to window is a resonance that noise excites, not a shaft, and is not believed.
    """
    usable = [one for one in channels if one.quantity not in ("pulses", "angle") and np.ptp(one.values) > 0.0]
    if not usable:
        raise refuse("tacho", _("there is neither a tacho nor a channel in which the speed could be sought"), "missing")
    together = _alike(usable)
    low, high = (one / (2.0 * math.pi) for one in speed_range) if speed_range else BAND
    low, high = min(low, high), min(max(low, high), 0.4 * together[0].rate)
    low = max(low, 2.0 * LEAST_TURNS / max(together[0].duration, 1e-9))
    if not low < high:
        text = _(
            "lasts {given:.3g} s with {rate:.6g} values a second; that is too little to find a speed without a tacho"
        )
        raise refuse(together[0].name, text.format(given=together[0].duration, rate=together[0].rate), "out_of_range")
    found, factor = _strongest(together, low, high, order, progress)
    shares = _shares(found, low if speed_range else BAND[0], high, order, factor)
    best = max(shares, key=lambda one: shares[one])
    trust = min(one.trust for one in together)
    steady = float(np.clip((WAVERING - _wavering(found)) / (WAVERING - STEADY), 0.0, 1.0))
    tone = steady * float(np.clip((found.height - NOISE) / (SURE - NOISE), 0.0, 1.0))
    time, angle = _angle(together[0], found)
    turns = float(angle[-1] - angle[0]) / (2.0 * math.pi * best)
    if turns < LEAST_TURNS:
        text = _("holds {given:.3g} turns of the shaft; at least {wanted:g} are needed")
        raise refuse(together[0].name, text.format(given=turns, wanted=LEAST_TURNS), "out_of_range")
    return Rotation(
        time=time,
        angle=angle / best,
        source="ridge",
        confidence=max(0.02, 0.9 * tone * shares[best] * trust),
        phased=False,
        order=best,
        alternatives=tuple(
            (best / one, share) for one, share in sorted(shares.items(), key=lambda row: -row[1]) if one != best
        ),
        cautions=_told(found, best, shares, tone, steady),
    )


def _alike(usable: Sequence[Channel]) -> list[Channel]:
    """Return the channels with the rate and the start of the first one, but much shorter ones, cut to one length."""
    alike = [one for one in usable if one.rate == usable[0].rate and one.start == usable[0].start]
    longest = max(one.values.size for one in alike)
    alike = [one for one in alike if one.values.size >= SHORTER * longest]
    shortest = min(one.values.size for one in alike)
    return [one if one.values.size == shortest else replace(one, values=one.values[:shortest]) for one in alike]


def _told(found: _Path, best: float, shares: dict[float, float], tone: float, steady: float) -> tuple[str, ...]:
    low, high = float(np.min(found.frequency)), float(np.max(found.frequency))
    text = _(
        "There is no tacho; the speed, {low:.4g} to {high:.4g} rpm, is that of the strongest line as order {order:g}."
    )
    told = [text.format(low=2 * math.pi * low / best / rpm, high=2 * math.pi * high / best / rpm, order=best)]
    if shares[best] < 0.9:
        others = ", ".join(f"{best / one:.3g}" for one, share in shares.items() if one != best and share > 0.02)
        text = _("The line may be another order: the true speed may be {factors} times as high.")
        told.append(text.format(factors=others))
    if steady < 0.5 and found.height > NOISE:
        told.append(
            _("The line wavers as a resonance does that noise excites: it may have nothing to do with the shaft.")
        )
    elif tone < 0.3:
        told.append(_("The line hardly stands out of the noise: the speed is a guess."))
    return tuple(told)


def _strongest(
    channels: Sequence[Channel], low: float, high: float, order: float | None, progress: Progress | None
) -> tuple[_Path, tuple[float, float]]:
    """Return the highest ridge over all windows, and the band it was sought in [Hz]."""
    bands = [(order * low, order * high)] if order else [(low, FASTEST * high)]
    if not order and high < 1.9 * low:
        bands = [(low, high), (2.0 * low, 2.0 * high)]
    top = min(max(band[1] for band in bands) * 2.6, 0.5 * channels[0].rate)
    rows, rate = [one.values for one in channels], channels[0].rate
    while rate > 4.0 * top and rows[0].size > 512:
        rows, rate = [halved(row) for row in rows], 0.5 * rate
    found: list[tuple[_Path, tuple[float, float]]] = []
    lasting = channels[0].duration
    lengths = [one for one in WINDOWS if one * low >= 1.5 and one <= lasting / 4.0] or [min(lasting / 4.0, 1.0)]
    watch = Watch(progress, len(lengths))
    for length in lengths:
        drawn = _drawn(rows, rate, length, watch)
        for band in bands:
            path = _viterbi(drawn, band)
            if path is not None:
                found.append((path, band))
        watch.next()
        if watch.stopped and found:
            break
    if not found:
        raise refuse(channels[0].name, _("is too short to find a speed without a tacho"), "out_of_range")
    # A long window lifts a steady tone by its length alone; what counts is the height over chance, the same for all.
    return max(found, key=lambda one: one[0].height)


def _drawn(rows: Sequence[Array], rate: float, length: float, watch: Watch) -> _Map:
    """Return the spectrogram of the channels together, every line over the median around it."""
    count = max(16, round(length * rate))
    hop = max(1, count // HOPS)
    begins = np.arange(math.ceil(count // 2 / hop) * hop - count // 2, rows[0].size - count + 1, hop)
    level: Array = 0.0
    total: Array = 0.0
    for k, row in enumerate(rows):
        power = _powers(row - np.mean(row), begins, count)
        around = _around(power)
        around = np.maximum(around, 1e-12 * np.max(power, initial=1e-300))
        level = level + np.log(np.maximum(power / around, 1e-3))
        total = total + power / np.mean(around)
        watch(0.8 * (k + 1) / len(rows))
    return _Map(
        level=np.asarray(level) / math.sqrt(len(rows)),
        time=(begins + count // 2) / rate,
        frequency=np.fft.rfftfreq(2 * count, 1.0 / rate),
        window=length,
        power=np.asarray(total),
        row=rows[0],
        rate=rate,
    )


def _powers(row: Array, begins: Array, count: int) -> Array:
    """Return the power spectra of windows of a row, padded to twice their length; in blocks, to bound the memory."""
    shape, place = scipy.signal.windows.hann(count, sym=False), np.arange(count)
    found = np.empty((begins.size, count + 1))
    block = max(1, BLOCK // count)
    for first in range(0, begins.size, block):
        some = begins[first : first + block]
        found[first : first + block] = np.abs(np.fft.rfft(row[some[:, None] + place] * shape, 2 * count, axis=1)) ** 2
    return found


def _around(power: Array) -> Array:
    """Return the median about each line of each spectrum; all spectra in one row, which is what is fast."""
    room = min(AROUND, power.shape[1])
    wide = np.pad(power, ((0, 0), (room, room)), mode="symmetric")
    found = scipy.ndimage.median_filter(wide.ravel(), size=2 * AROUND + 1, mode="reflect").reshape(wide.shape)
    return np.asarray(found[:, room:-room])


def _viterbi(drawn: _Map, band: tuple[float, float]) -> _Path | None:
    """Return the path through a band with the greatest sum, less the toll of its changes."""
    inside = (drawn.frequency >= band[0]) & (drawn.frequency <= band[1])
    level, lines = drawn.level[:, inside], drawn.frequency[inside]
    steps, count = level.shape
    if steps < 3 or count < 3:
        return None
    shifts = np.arange(-JUMP, JUMP + 1)
    toll, own = STIFF * np.abs(shifts)[:, None], np.arange(count)
    came = np.zeros((steps, count), dtype=np.int8)
    padded = np.full(count + 2 * JUMP, -np.inf)
    best, reached = padded[JUMP:-JUMP], sliding_window_view(padded, count)
    best[:] = level[0]
    for k in range(1, steps):
        choices = reached - toll
        pick = np.argmax(choices, axis=0)
        came[k] = shifts[pick]
        best[:] = choices[pick, own] + level[k]
    path = np.empty(steps, dtype=int)
    path[-1] = int(np.argmax(best))
    for k in range(steps - 1, 0, -1):
        path[k - 1] = path[k] + came[k, path[k]]
    row = np.arange(steps)
    inner = np.clip(path, 1, count - 2)
    left, middle, right = level[row, inner - 1], level[row, inner], level[row, inner + 1]
    bow = left - 2.0 * middle + right
    shift = np.clip(np.where(bow < 0.0, 0.5 * (left - right) / np.where(bow < 0.0, bow, -1.0), 0.0), -0.5, 0.5)
    frequency = lines[inner] + shift * (lines[1] - lines[0])
    return _Path(map=drawn, frequency=frequency, height=float(np.mean(level[row, path])))


def _wavering(found: _Path) -> float:
    """Return by how much the logarithm of the power changes from window to window along a ridge, bends alone counted.

    A tone, also one that grows as it nears a resonance, changes little; a resonance that noise excites does by about 1,
    as the ratio of two independent powers.
    """
    step = found.map.frequency[1] - found.map.frequency[0]
    place = np.clip(np.rint(found.frequency / step).astype(int), 1, found.map.frequency.size - 2)
    row = np.arange(place.size)
    power = found.map.power[row, place - 1] + found.map.power[row, place] + found.map.power[row, place + 1]
    level = np.log(np.maximum(power, 1e-300))
    joint_angles = [
        float(np.median(np.abs(level[: -2 * lag] - 2.0 * level[lag:-lag] + level[2 * lag :]))) / math.sqrt(3.0)
        for lag in (HOPS, 2 * HOPS)
        if level.size > 2 * lag + 2
    ]
    return sum(joint_angles) / len(joint_angles) if joint_angles else WAVERING


def _shares(
    found: _Path, low: float, high: float, order: float | None, band: tuple[float, float]
) -> dict[float, float]:
    """Return order of the ridge -> probability."""
    if order is not None:
        return {order: 1.0}
    middle = float(np.median(found.frequency))
    seen = {divisor: _seen(found, multiples) for divisor, multiples in BETWEEN.items()}
    weights: dict[float, float] = {}
    for one, prior in PRIOR.items():
        if not 0.95 * low <= middle / one <= 1.05 * high:
            continue
        weight = prior
        for divisor, there in seen.items():
            belongs = one % divisor == 0 or (divisor == 2 and one == 4.0)
            chance = SEEN if belongs else UNSEEN
            weight *= chance if there else 1.0 - chance
        weights[one] = weight
    if not weights:
        weights = {1.0: 1.0}
    total = sum(weights.values())
    return {one: weight / total for one, weight in weights.items()}


def _seen(found: _Path, multiples: Sequence[float]) -> bool:
    """Tell whether there is a line along any of these multiples of the ridge."""
    level, lines = found.map.level, found.map.frequency
    width = lines[1] - lines[0]
    for multiple in multiples:
        place = np.rint(multiple * found.frequency / width).astype(int)
        good = (place >= 2) & (place < lines.size - 2)
        if np.count_nonzero(good) < 0.5 * place.size:
            continue
        rows = np.flatnonzero(good)
        beside = np.asarray([level[rows, place[good] + k] for k in (-1, 0, 1)])
        if float(np.mean(np.max(beside, axis=0))) > 0.5 * (NOISE + SURE) - 1.0:
            return True
    return False


def _angle(channel: Channel, found: _Path) -> tuple[Array, Array]:
    """Return times and angle of the ridge's own order, sharpened by the phase of the vibration along it."""
    smooth = scipy.ndimage.gaussian_filter1d(found.frequency, 1.0, mode="nearest")
    begin, end = channel.start, channel.start + channel.duration
    time = np.arange(begin, end, 0.5 * float(found.map.time[1] - found.map.time[0]))
    local = np.interp(time, begin + found.map.time, smooth)
    angle = np.concatenate([[0.0], np.cumsum(math.pi * (local[1:] + local[:-1]) * np.diff(time))])
    if found.height < SURE:
        return time, angle
    row, rate = found.map.row, found.map.rate
    turned = (row - np.mean(row)) * np.exp(-1j * np.interp(begin + np.arange(row.size) / rate, time, angle))
    sigma = 0.25 * found.map.window * rate
    reach = np.arange(-math.ceil(4.0 * sigma), math.ceil(4.0 * sigma) + 1)
    calm = scipy.signal.oaconvolve(turned, np.exp(-0.5 * (reach / sigma) ** 2), mode="same")
    at = np.clip(np.rint((time - begin) * rate).astype(int), 0, row.size - 1)
    sharp = angle + np.unwrap(np.angle(calm[at]))
    return (time, sharp) if float(np.min(np.diff(sharp))) > 0.0 else (time, angle)
