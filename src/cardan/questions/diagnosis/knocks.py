"""Knocks of loose parts: noise far above the orders that swells once or twice a turn."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
import scipy

from cardan.errors import InputError
from cardan.maths.arrays import Array
from cardan.questions.diagnosis.signals.rotation import Rotation

from .levels import TURNS
from .signals.order_tracks import TrackedOrders, tracked_orders
from .signals.signal import Channel, Signal
from .signals.watching import Watch


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
