"""What a recording of a drive shows, in figures that mean something: levels, exponents, what the torque changes, peaks.

Each is a logarithm or a plain ratio, so that a calibration can weigh them; nan where the recording cannot tell.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

import numpy as np
import scipy

from cardan.drive.drive import Drive
from cardan.errors import InputError, refuse
from cardan.maths.arrays import Array
from cardan.questions.diagnosis.signals.rotation import LEAST_TURNS, Rotation
from cardan.texts import _
from cardan.units import rpm

from .drive_model import DriveModel, plant
from .expected import Expected, expected_orders
from .signals.orders import TrackedOrders, tracked_orders
from .signals.signal import Channel, Progress, Signal, Watch
from .signals.turning import estimate_rotation

ORDERS = (0.5, 1.0, 1.5, 2.0, 3.0, 4.0)

PROBES = (0.75, 1.25, 1.75, 2.5, 3.5)
"""Orders that no fault has: what is there is noise, at about the frequency of the orders beside them."""

POWERS = {"acceleration": 0, "velocity": 1, "displacement": 2}
"""Quantity -> power of the angular speed that makes an acceleration of it."""

AXIAL = ("axial", "x")  # directions along the shaft

TURNS = 16

CLEAR = 2.5  # times what noise leaves that an order has to reach to count as seen

LITTLE = {0.5: -1.0, 1.5: -1.0, 3.0: -1.0, 4.0: -1.0}
"""Level below which an order of faults alone says no more, so that a quiet recording and a noisy one say the same."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Track:
    """Orders at a sensor as acceleration (o, w), their noise (o,) for one window, and the housing it sits on."""

    kind: str
    mass: float
    value: Array
    noise: Array
    found: TrackedOrders


def looks_across(channel: Channel) -> bool:
    """Tell whether a channel is of a live sensor that shakes across the shaft, or may."""
    return _shakes(channel) and channel.direction not in AXIAL


def _shakes(channel: Channel) -> bool:
    dead = channel.trust == 0.0 or np.ptp(channel.values) == 0.0
    return channel.quantity in POWERS and channel.direction != "torsion" and not dead


def accelerations(
    signal: Signal, shaft: Rotation, base: DriveModel, watch: Watch | None = None
) -> tuple[list[Track], list[Track]]:
    """Return the orders at the radial and at the axial sensors; those of the first radial one, whoever says stop."""
    radial: list[Track] = []
    axial: list[Track] = []
    for channel in signal.measured:
        if watch is not None:
            watch.next()
        if not _shakes(channel):
            continue
        if watch is not None and watch.stopped and radial:
            break
        try:
            found = tracked_orders(channel, shaft, (*ORDERS, *PROBES), turns=TURNS)
        except InputError:
            continue
        value = found.value * (np.asarray(found.orders)[:, None] * found.speed) ** POWERS[channel.quantity]
        house = base.housing_at(channel.place) or base.housings[-1]
        probes = np.sqrt(np.median(np.abs(value[len(ORDERS) :]) ** 2, axis=1) / math.log(2.0))
        noise = np.exp(np.interp(np.log(ORDERS), np.log(PROBES), np.log(np.maximum(probes, 1e-300))))
        track = Track(kind=house.kind, mass=house.mass, value=value[: len(ORDERS)], noise=noise, found=found)
        (axial if channel.direction in AXIAL else radial).append(track)
    same = [one for one in radial if one.value.shape == radial[0].value.shape]
    return same, [one for one in axial if same and one.value.shape == same[0].value.shape]


def no_vibration(signal: Signal, shaft: Rotation) -> InputError:
    """Return why a recording tells nothing: what a channel of vibration says, or what there is instead of one."""
    for one in signal.measured:
        if looks_across(one):
            try:
                tracked_orders(one, shaft, ORDERS, turns=TURNS)
            except InputError as error:
                return error
    text = _("the recording has no channel of vibration across the shaft; it has {channels}")
    there = ", ".join(f"{one.name} ({one.quantity.replace('_', ' ')})" for one in signal.channels)
    told = (text.format(channels=there), *(one.rstrip(".") for one in signal.cautions))
    return refuse("signal", "; ".join(told), "missing")


def mean_of(track: Track, order: float, which: Array) -> tuple[float, complex]:
    """Return amplitude, no less than noise leaves, and mean of an order over windows; together where phases mean."""
    k = ORDERS.index(order)
    chosen = track.value[k, which]
    if chosen.size == 0:
        return math.nan, complex(math.nan)
    mean = complex(np.mean(chosen)) if track.found.phased else complex(np.sqrt(np.mean(np.abs(chosen) ** 2)))
    return max(abs(mean), floor_of(track, order, which)), mean


def floor_of(track: Track, order: float, which: Array) -> float:
    """Return what noise leaves of an order in the mean over windows, of which four share a length."""
    count = max(1.0, float(np.sum(which)) / 3.0) if track.found.phased else 1.0
    return float(track.noise[ORDERS.index(order)]) / math.sqrt(count)


def force_on(tracks: list[Track], order: float, which: Array) -> float:
    """Return the amplitude of the forces on all housings together."""
    return math.hypot(*(one.mass * mean_of(one, order, which)[0] for one in tracks))


def stands_out(tracks: list[Track], order: float, which: Array) -> bool:
    """Tell whether an order rises over the noise at any housing."""
    return any(mean_of(one, order, which)[0] > CLEAR * floor_of(one, order, which) for one in tracks)


def level_of(tracks: list[Track], order: float, which: Array, usual: float) -> float:
    """Return the logarithm of an order over what is usual; what noise hides counts as not above it, or as little."""
    value = math.log10(force_on(tracks, order, which) / usual)
    if not stands_out(tracks, order, which):
        return LITTLE.get(order, min(value, 0.0))
    return max(value, LITTLE.get(order, -math.inf))


def healthy_force(healthy: Expected, tracks: list[Track], order: float, speed: float, torque: float) -> float:
    """Return the same of the drive in order."""
    total = 0.0
    for one in tracks:
        lines = (line for line in healthy.orders if line.order == order and line.direction == "radial")
        size = sum(abs(healthy.value(line, speed, torque)) ** 2 for line in lines if line.kind == one.kind)
        total += one.mass**2 * float(size)
    return math.sqrt(total) or math.nan


NAMES = (
    "order_1", "order_2", "order_2_unloaded", "order_3", "order_4", "half_orders", "at_centre", "torque_on_1",
    "turned_by_torque", "torque_on_2", "power_of_1", "steep_at_top", "power_of_2", "peak_of_2", "peak_of_3",
    "at_third", "axial_share", "knocks_1", "knocks_2", "uneven",
)  # fmt: skip
"""Names of the features, in the order of the calibration."""

SAME_SPEED = 0.04  # share of the speed within which windows count as held at it
DIFFERENT = 0.3  # share of the largest torque by which two holds must differ to tell what the torque does
NEAR_THIRD = 0.05  # share of a third of the critical speed within which a peak of order 3 counts as its
STOPPED = 0.5  # share of the confidence that is left where not all channels were looked at
FAINT = 1e-5  # share of order 1 below which an order is rounding, not vibration
BINS = 14  # of speed in a run-up


@dataclass(frozen=True, eq=False, kw_only=True)
class Features:
    """What a recording shows."""

    value: Array  # (f,): by `NAMES`; nan where it cannot be told
    speed: tuple[float, float]  # [rad/s]: between which the shaft turned
    held: float  # [rad/s]: speed that it was held at longest
    peak_2: float  # peak_2, peak_3 [rad/s]: speeds at which orders 2 and 3 are largest
    peak_3: float  # [rad/s]
    critical: float  # [rad/s]: lowest bending critical speed as computed; nan where not known
    confidence: float  # from 0 to 1: that of the recording and of its rotation, less by what it cannot tell
    cautions: tuple[str, ...]  # what was doubtful
    rotation: Rotation  # how the shaft turned

    def __getitem__(self, name: str) -> float:
        """Return the feature of a name."""
        return float(self.value[NAMES.index(name)])


@lru_cache(maxsize=16)
def _known(drive: Drive) -> tuple[DriveModel, Expected]:
    return plant(drive), expected_orders(drive)


def features(
    signal: Signal, drive: Drive, *, speed_range: tuple[float, float] | None = None, progress: Progress | None = None
) -> Features:
    """Return what a recording of a drive shows, in figures.

    signal: with one channel of vibration at least; better with a tacho, two torques and a run-up.
    speed_range [rad/s]: between which the shaft turned, for a recording without a tacho; the duty of the drive
    otherwise.
    progress: told the share done; when it answers "stop" channels not yet looked at are left out, and a caution says
    so.

    Levels are decadic logarithms of the amplitude at the held speed over that of the drive in order, all radial sensors
    together by the forces on their housings; exponents are slopes of log amplitude over log speed; nothing counts below
    what noise leaves in an average of as many windows.
    """
    base, healthy = _known(drive)
    watch = Watch(progress, 1 + 2 * len(signal.measured))
    speeds = speed_range or (None if signal.tacho is not None else base.speed)
    shaft = estimate_rotation(signal, speed_range=speeds, progress=watch)
    radial, axial = accelerations(signal, shaft, base, watch)
    if not radial:
        raise no_vibration(signal, shaft)
    first = radial[0].found
    torque, told = _torque(signal, first.time, base.torque)
    held = _held(first)
    still = np.abs(first.speed / held - 1.0) < SAME_SPEED
    high, low = _groups(torque, still, told, base.torque)
    out = dict.fromkeys(NAMES, math.nan)
    _levels(out, radial, healthy, base, held, torque, high, low)
    peaks = _over_speed(out, radial, first, torque, told, base)
    _sideways(out, radial, axial, high)
    out["knocks_1"], out["knocks_2"] = knocks(signal, shaft, first, low if low.any() else high, watch)
    _uneven(out, signal, shaft, base)
    stopped = watch.stopped
    watch(1.0)
    value = np.asarray([out[name] for name in NAMES])
    known = float(np.mean(np.isfinite(value)))
    misfits = (*doubts(signal, shaft, base), *silent(radial, high, low))
    return Features(
        value=value,
        speed=shaft.speeds,
        held=held,
        peak_2=peaks[0],
        peak_3=peaks[1],
        critical=base.critical,
        confidence=signal.trust
        * shaft.confidence
        * (0.3 + 0.7 * known)
        * (STOPPED if stopped else 1.0)
        * math.prod(share for _text, share in misfits),
        cautions=(
            *signal.cautions,
            *shaft.cautions,
            *(text for text, _share in misfits),
            *_unknown(out, told, low),
            *((_("It was stopped before all channels were looked at."),) if stopped else ()),
        ),
        rotation=shaft,
    )


def _unknown(out: dict[str, float], told: bool, low: Array) -> list[str]:
    found = []
    if not told or not low.any():
        found.append(_("The recording has no two torques at one speed: what the torque changes is not known."))
    if math.isnan(out["peak_of_2"]):
        found.append(_("The speed hardly changes: how the vibration grows with speed is not known."))
    if math.isnan(out["axial_share"]):
        found.append(_("There is no axial sensor: a bent shaft is hard to tell from an unbalance."))
    if math.isnan(out["uneven"]):
        found.append(_("The speed of the output was not recorded: how uniformly it turns is not known."))
    return found


def _torque(signal: Signal, time: Array, usual: float) -> tuple[Array, bool]:
    """Return the torque of every window, and whether it was measured."""
    at = next((one for one in signal.channels if one.quantity == "torque" and one.trust > 0.0), None)
    if at is None:
        return np.full(time.size, usual), False
    found = np.interp(time, at.time, running(at.values, 0.25 * at.rate, ends="reflect"))
    return (found if np.max(found) >= -np.min(found) else -found), True  # which way a sensor counts is its own


def _held(found: TrackedOrders) -> float:
    """Return the speed in whose neighbourhood it ran longest; the fastest of equals."""
    lasting = np.gradient(found.time) if found.time.size > 1 else np.ones(1)
    order = np.argsort(found.speed)
    sorted_speed, total = found.speed[order], np.concatenate([[0.0], np.cumsum(lasting[order])])
    last, first = (np.searchsorted(sorted_speed, (1.0 + one) * found.speed) for one in (SAME_SPEED, -SAME_SPEED))
    weight = total[last] - total[first]
    return float(found.speed[int(np.argmax(np.round(weight, 1) + 1e-6 * found.speed / np.max(found.speed)))])


def _groups(torque: Array, still: Array, told: bool, usual: float) -> tuple[Array, Array]:
    """Return which windows at the held speed have much torque, and which little or the other way."""
    nothing = np.zeros_like(still)
    if not told or not still.any():
        return still, nothing
    most, least = float(np.max(torque[still])), float(np.min(torque[still]))
    if most - least < DIFFERENT * max(abs(most), abs(least), 0.1 * usual):
        return still, nothing
    room = 0.1 * (most - least)
    return still & (torque > most - room), still & (torque < least + room)


def _levels(
    out: dict[str, float],
    radial: list[Track],
    healthy: Expected,
    base: DriveModel,
    held: float,
    torque: Array,
    high: Array,
    low: Array,
) -> None:
    """Fill in the levels at the held speed, and what the torque changes in them."""
    if not high.any():
        return
    much = float(np.mean(torque[high]))
    one = healthy_force(healthy, radial, 1.0, held, much)
    two = healthy_force(healthy, radial, 2.0, held, max(abs(much), 0.1 * base.torque))
    out["order_1"] = level_of(radial, 1.0, high, one)
    out["order_2"] = level_of(radial, 2.0, high, two)
    out["order_3"] = level_of(radial, 3.0, high, one)
    out["order_4"] = level_of(radial, 4.0, high, two)
    out["half_orders"] = max(level_of(radial, 0.5, high, one), level_of(radial, 1.5, high, one))
    centre = [track for track in radial if track.kind == "centre"]
    rest = [track for track in radial if track.kind != "centre"]
    if centre and rest and stands_out(centre, 3.0, high):
        out["at_centre"] = math.log10(force_on(centre, 3.0, high) / force_on(rest, 3.0, high))
    if not low.any():
        return
    out["order_2_unloaded"] = level_of(radial, 2.0, low, two)
    if stands_out(radial, 2.0, high):
        out["torque_on_2"] = math.log10(force_on(radial, 2.0, high) / force_on(radial, 2.0, low))
    if not (stands_out(radial, 1.0, high) or stands_out(radial, 1.0, low)):
        return
    out["torque_on_1"] = math.log10(force_on(radial, 1.0, high) / force_on(radial, 1.0, low))
    if radial[0].found.phased:
        apart = sum(track.mass * abs(mean_of(track, 1.0, high)[1] - mean_of(track, 1.0, low)[1]) for track in radial)
        whole = sum(track.mass * (mean_of(track, 1.0, high)[0] + mean_of(track, 1.0, low)[0]) for track in radial)
        out["turned_by_torque"] = apart / whole


def _over_speed(
    out: dict[str, float], radial: list[Track], first: TrackedOrders, torque: Array, told: bool, base: DriveModel
) -> tuple[float, float]:
    """Fill in exponents and peaks over the speed; return the speeds of the peaks of orders 2 and 3."""
    slowest, fastest = float(np.min(first.speed)), float(np.max(first.speed))
    if fastest < 1.6 * slowest:
        return math.nan, math.nan
    moving = np.ones(first.speed.size, dtype=bool)
    if told:
        off = np.abs(first.speed / _held(first) - 1.0) > SAME_SPEED
        usual = float(np.median(torque[off])) if off.any() else float(np.median(torque))
        moving = np.abs(torque - usual) < 0.15 * max(abs(usual), 0.3 * base.torque)
    edges = np.geomspace(slowest, fastest * 1.0001, BINS + 1)
    number = np.digitize(first.speed, edges) - 1
    curve = {}
    for order in (1.0, 2.0, 3.0):
        k = ORDERS.index(order)
        power = sum((one.mass * np.abs(one.value[k])) ** 2 for one in radial)
        level = np.sqrt(power)
        groups = [level[moving & (number == b)] for b in range(BINS)]
        curve[order] = np.asarray([np.median(one) if one.size else np.nan for one in groups])
        curve[-order] = level
        noise = math.sqrt(sum((one.mass * float(one.noise[k])) ** 2 for one in radial))
        curve[order][curve[order] < 1.5 * noise] = np.nan
    speed = np.sqrt(edges[1:] * edges[:-1])
    lower = speed < 0.75 * fastest
    out["power_of_1"] = _slope(speed[lower], curve[1.0][lower])
    out["power_of_2"] = _slope(speed[lower], curve[2.0][lower])
    upper = moving & (first.speed > 0.7 * fastest)
    if np.isfinite(curve[1.0][-1]):
        out["steep_at_top"] = _slope(first.speed[upper], curve[-1.0][upper])
    at = []
    for order in (2.0, 3.0):
        inside = moving & (first.speed > 1.15 * slowest)
        level = curve[-order][inside]
        if level.size < 4:
            at.append(math.nan)
            continue
        if np.median(level) > FAINT * np.median(curve[-1.0][inside]):
            out[f"peak_of_{order:.0f}"] = math.log10(float(np.percentile(level, 98)) / float(np.median(level)))
        at.append(float(first.speed[inside][int(np.argmax(level))]))
    near = np.abs(3.0 * first.speed / base.critical - 1.0) < NEAR_THIRD
    rest = np.abs(3.0 * first.speed / base.critical - 1.0) > 3.0 * NEAR_THIRD
    if np.sum(moving & near) > 1 and np.any(moving & rest):
        level = np.maximum(curve[-3.0], FAINT * np.median(curve[-1.0]) + 1e-300)
        out["at_third"] = math.log10(float(np.max(level[moving & near])) / float(np.median(level[moving & rest])))
    return at[0], at[1]


def _slope(speed: Array, level: Array) -> float:
    good = np.isfinite(level) & (level > 0.0)
    if np.sum(good) < 4:
        return math.nan
    x, y = np.log(speed[good]), np.log(level[good])
    return float(np.polyfit(x, y, 1)[0]) if float(np.ptp(x)) > 0.05 else math.nan


def _sideways(out: dict[str, float], radial: list[Track], axial: list[Track], high: Array) -> None:
    """Fill in how much of order 1 goes along the shaft, at the end where most does."""
    if not high.any():
        return
    across = {one.kind: one for one in radial}
    shares = [
        (one.mass * mean_of(one, 1.0, high)[0], mean_of(one, 1.0, high)[0] / mean_of(across[one.kind], 1.0, high)[0])
        for one in axial
        if one.kind in across and stands_out([one, across[one.kind]], 1.0, high)
    ]
    if shares:
        out["axial_share"] = math.log10(max(shares)[1])


def _uneven(out: dict[str, float], signal: Signal, shaft: Rotation, base: DriveModel) -> None:
    """Fill in how unevenly the output turns, over what the joints make and a small tolerance of their yokes."""
    usual = base.uneven + 0.03 * math.tan(0.5 * float(np.max(base.joint_angle))) ** 2
    for k, channel in enumerate(signal.channels):
        if k == signal.tacho or channel.quantity not in ("angle", "angular_speed") or usual <= 0.0:
            continue
        if shaft.turns < LEAST_TURNS:
            continue
        found = tracked_orders(channel, shaft, (1.0, 2.0), turns=TURNS)
        angle = found.value[1]
        if channel.quantity == "angular_speed":
            angle = angle / (2.0 * found.speed)
        size = abs(np.mean(angle)) if found.phased else float(np.median(np.abs(angle)))
        out["uneven"] = math.log10(max(size, 1e-9) / usual)


# What does not fit between a recording and the drive that it is said to be of: speeds and places.

TOO_FAST = 1.15  # times the top speed of the drive that a recording may reach
TOO_SLOW = 0.5  # share of the least speed of the drive that a recording should reach

APART = 0.03
"""Share by which the mean speed of the output may differ from that of the shaft: over whole turns joints make none."""

MISFIT, FAR, PLACELESS, SIZELESS = 0.3, 0.6, 0.8, 0.6
"""What is left of the confidence: where two speeds contradict each other, where the recording lies outside of the
running of the drive, where a sensor does not say its place, where the drive does not say what its sizes follow from."""

SILENT = 0.4  # share of the confidence that is left where order 1, which every shaft has, does not rise over the noise


def doubts(signal: Signal, shaft: Rotation, base: DriveModel) -> Iterator[tuple[str, float]]:
    """Yield what does not fit, each with the share of confidence that it leaves."""
    yield from _speeds(shaft, base)
    yield from _other_speeds(signal, shaft)
    if base.assumed:
        text = _("The drive does not say {names}; the sizes to be expected are assumed.")
        decide = any(one == "duty.torque" or one.endswith(".mass") for one in base.assumed)
        yield text.format(names=", ".join(base.assumed)), SIZELESS if decide else 1.0
    shaking = [one for one in signal.measured if one.quantity in ("acceleration", "velocity", "displacement")]
    lost = [one for one in shaking if base.housing_at(one.place) is None]
    if lost:
        text = _("It is not known where {names} sits; it counts as sitting at the output; known places are {places}.")
        names = ", ".join(f"{one.name} ({one.place})" if one.place else one.name for one in lost)
        places = ", ".join(one.place for one in base.housings)
        yield text.format(names=names, places=places), PLACELESS


def _speeds(shaft: Rotation, base: DriveModel) -> Iterator[tuple[str, float]]:
    """Yield a speed that the drive does not have."""
    if "duty.speed" in base.assumed:
        return
    high, (low, top) = shaft.speeds[1], base.speed
    if high > TOO_FAST * top:
        text = _(
            "The shaft turned up to {high:.4g} rpm; the drive runs up to {top:.4g} rpm: the sampling rate, the pulses "
            "per turn or the drive file are wrong."
        )
        yield text.format(high=high / rpm, top=top / rpm), MISFIT
    elif high < TOO_SLOW * low:
        text = _(
            "The shaft turned up to {high:.4g} rpm only; the drive runs from {low:.4g} rpm: the recording is far from "
            "its running, or the sampling rate or the pulses per turn are wrong."
        )
        yield text.format(high=high / rpm, low=low / rpm), FAR


def _other_speeds(signal: Signal, shaft: Rotation) -> Iterator[tuple[str, float]]:
    """Yield channels of a speed that turn otherwise than the shaft."""
    for k, one in enumerate(signal.channels):
        if k == signal.tacho or one.quantity != "angular_speed":
            continue
        inside = (one.time >= shaft.time[0]) & (one.time <= shaft.time[-1])
        if not np.any(inside):
            continue
        mean = float(np.mean(shaft.speed_at(one.time[inside])))
        other = abs(float(np.mean(one.values[inside])))
        if abs(other / mean - 1.0) > APART:
            text = _(
                "{name} turns at {other:.4g} rpm on average and the shaft at {mean:.4g} rpm: the sampling rate, the "
                "pulses per turn or a unit is wrong, or it is another shaft."
            )
            yield text.format(name=one.name, other=other / rpm, mean=mean / rpm), MISFIT


def silent(radial: list[Track], high: Array, low: Array) -> list[tuple[str, float]]:
    """Return the doubt of a recording in which not all follows the shaft, with the share of confidence it leaves."""
    one, two = (stands_out(radial, order, high) for order in (1.0, 2.0))
    if one or not high.any() or (low.any() and stands_out(radial, 1.0, low)):
        return []
    if two:
        text = _("Order 2 rises over the noise and order 1 does not: the pulses per turn may be twice the true ones.")
    else:
        text = _("Neither order 1 nor order 2 of the shaft rises over the noise: faults may hide in it.")
    return [(text, SILENT)]


# Knocks of loose parts: noise far above the orders that swells once or twice a turn.


def knocks(signal: Signal, shaft: Rotation, first: TrackedOrders, which: Array, watch: Watch) -> tuple[float, float]:
    """Return how much of the noise comes once and twice a turn: orders of the squared high-passed signal.

    first: orders of one channel, whose windows count; which (w,) of bool: windows that are looked at.
    watch: told of every channel; channels after a stop are left out.
    Returns: shares of the mean; nan where no channel tells.
    """
    best = {1.0: math.nan, 2.0: math.nan}
    for channel in signal.measured:
        watch.next()
        if watch.stopped:
            break
        dead = channel.trust == 0.0 or np.ptp(channel.values) == 0.0
        if dead or channel.quantity != "acceleration" or channel.direction in ("axial", "x") or not which.any():
            continue
        cut = max(6.0 * float(np.max(first.speed)) / (2.0 * math.pi), 0.1 * channel.rate)
        if cut > 0.4 * channel.rate or channel.values.size < 100:
            continue
        rough = (
            scipy.signal.sosfiltfilt(scipy.signal.butter(4, cut, "high", fs=channel.rate, output="sos"), channel.values)
            ** 2
        )
        try:
            found = tracked_orders(
                Channel(name=channel.name, quantity="other", values=rough, rate=channel.rate, start=channel.start),
                shaft,
                (1.0, 2.0),
                turns=TURNS,
            )
        except InputError:
            continue
        if found.time.size != which.size:
            continue
        mean = np.mean(np.interp(found.time[which], channel.time, running(rough, 0.5 * channel.rate)))
        for k, order in enumerate((1.0, 2.0)):
            chosen = found.value[k, which]
            size = abs(np.mean(chosen)) if found.phased else float(np.median(np.abs(chosen)))
            best[order] = float(np.fmax(best[order], size / max(float(mean), 1e-300)))
    return best[1.0], best[2.0]


def running(values: Array, width: float, *, ends: Literal["constant", "reflect"] = "constant") -> Array:
    """Return the running mean over a width, as if there were nothing beyond the ends, or with its ``reflect``ion."""
    return np.asarray(scipy.ndimage.uniform_filter1d(values, max(1, int(width)), mode=ends))
