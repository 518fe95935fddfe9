"""Long recordings: orders, speed without a tacho and diagnosis, beside one transform of a channel as a whole."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan import example
from cardan.recordings import Channel, Signal, diagnose, estimate_rotation, order_map

from .harness import Figure, fastest

RATE = 25600.0
"""Values a second [Hz]."""


def running_up(seconds: float, channels: int = 2) -> Signal:
    """Return a recording of a shaft that runs up from 20 to 50 turns a second, with its tacho."""
    rng = np.random.default_rng(1)
    time = np.arange(int(seconds * RATE)) / RATE
    angle = 2.0 * np.pi * np.cumsum(20.0 + 30.0 * np.minimum(time / (0.8 * time[-1]), 1.0)) / RATE
    rows = [Channel(name="tacho", quantity="pulses", values=np.exp(20.0 * (np.cos(angle) - 1.0)), rate=RATE)]
    for k in range(channels):
        values = np.cos(angle) + 0.4 * np.cos(2.0 * angle) + 0.5 * rng.normal(size=time.size)
        place = f"supports[{2 * k}]"
        rows.append(Channel(name=f"front {k}", values=values, rate=RATE, place=place, direction="radial"))
    return Signal(channels=tuple(rows), tacho=0)


def figures(quick: bool) -> Iterator[Figure]:
    seconds = 6.0 if quick else 600.0
    signal, drive = running_up(seconds), example("truck-supports")
    without = Signal(channels=signal.channels[1:])
    shaft, front = estimate_rotation(signal), signal.channels[1]
    yardstick = "one transform of a channel"
    best = fastest(
        {
            yardstick: lambda: np.fft.rfft(front.values),
            "turning by a tacho": lambda: estimate_rotation(signal),
            "order map of a channel": lambda: order_map(front, shaft),
            "turning without a tacho, by two channels": lambda: estimate_rotation(without, speed_range=(100.0, 350.0)),
            "diagnosis of two channels": lambda: diagnose(signal, drive),
        },
        rounds=1 if quick else 2,
    )
    of = best.pop(yardstick)
    for name, taken in best.items():
        yield Figure(
            bench=f"{name}, {seconds:g} s at {RATE / 1e3:g} kHz",
            value=taken,
            unit="s",
            yardstick=f"{yardstick}: {of:.3g} s",
            ratio=taken / of,
        )
