"""Pictures of recordings: a run-up through a resonance, in time and over orders."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from cardan.recordings import Channel, Rotation, order_map

from .kit import ACCENT, INK, PALE, page

RATE, SECONDS, NATURAL = 4000.0, 16.0, 60.0


def run_up() -> tuple[Channel, Rotation]:
    """Return a run-up whose order 2 passes a resonance, with noise and a hum of 150 Hz."""
    time = np.arange(int(RATE * SECONDS)) / RATE
    angle = 2 * np.pi * (10 * time + time**2)
    ratio = 2 * (10 + 2 * time) / NATURAL
    joint = ratio**2 / (1 - ratio**2 + 0.1j * ratio)
    values = np.real(joint * np.exp(2j * angle)) + ((10 + 2 * time) / 30) ** 2 * np.cos(angle)
    values += 0.8 * np.cos(2 * np.pi * 150 * time) + np.random.default_rng(3).normal(scale=0.4, size=time.size)
    return Channel(name="front", values=values, rate=RATE), Rotation(time=time[::40], angle=angle[::40])


def spectra() -> Figure:
    """Draw the spectrum of the whole run over frequency, and the map over order and speed."""
    figure, axes = page(9.0, 3.6, 1, 2)
    front, shaft = run_up()
    power = np.abs(np.fft.rfft(front.values * np.hanning(front.values.size))) * 4 / front.values.size
    axes[0].plot(np.fft.rfftfreq(front.values.size, 1 / RATE), power, color=ACCENT, lw=0.7)
    axes[0].set_xlim(0, 200)
    axes[0].set_ylim(0, None)
    axes[0].set_xlabel("frequency [Hz]")
    axes[0].set_ylabel("amplitude [m/s²]")
    axes[0].set_title("over frequency: smeared", size=11)
    found = order_map(front, shaft, highest=6.0)
    speed = found.speed * 30 / np.pi
    axes[1].pcolormesh(found.order, speed, np.sqrt(found.amplitude), cmap="Blues", shading="nearest", rasterized=True)
    axes[1].plot(60 * NATURAL / speed, speed, color=INK, ls="--", lw=1.0)
    axes[1].plot(60 * 150.0 / speed, speed, color=PALE, ls=":", lw=1.4)
    axes[1].set_xlim(0, 6)
    axes[1].set_xlabel("order: times a turn")
    axes[1].set_ylabel("speed [rpm]")
    axes[1].set_title("over order and speed: each where it belongs", size=11)
    return figure


PICTURES = {"recording-orders": spectra}
