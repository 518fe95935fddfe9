"""Orders at the sensors of a drive, as accelerations and as forces on the housings, and what noise leaves of them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from cardan.errors import InputError, refuse
from cardan.maths.arrays import Array
from cardan.questions.diagnosis.signals.rotation import Rotation
from cardan.texts import _

from .drive_model import DriveModel
from .expected import Expected
from .signals.orders import TrackedOrders, tracked_orders
from .signals.signal import Channel, Signal, Watch

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
