"""Recordings of which every order is known."""

import numpy as np

from cardan.questions.diagnosis.signals.signal import Channel, Signal


def angle_of(time, first, rate=0.0):
    """Return the angle of a shaft [rad] that turns ``first`` times a second and speeds up by ``rate`` a second."""
    return 2 * np.pi * (first * time + 0.5 * rate * time**2)


def shaking(angle, orders):
    """Return the sum of ``amplitude cos(order angle + phase)`` over {order: (amplitude, phase)}."""
    return sum((a * np.cos(n * angle + p) for n, (a, p) in orders.items()), np.zeros(angle.size))


def recorded(orders, *, first=10.0, gain=2.0, seconds=6.0, rate=4000.0, noise=0.0, seed=0, tacho=True):
    """Return a run-up with a tacho whose pulse rises at angle 0, and its channel ``front``."""
    time = np.arange(int(seconds * rate)) / rate
    angle = angle_of(time, first, gain)
    values = shaking(angle, orders) + np.random.default_rng(seed).normal(scale=noise or 1e-300, size=time.size)
    front = Channel(name="front", values=values, rate=rate)
    if not tacho:
        return Signal(channels=(front,))
    return Signal(channels=(Channel(name="tacho", quantity="pulses", values=np.sin(angle), rate=rate), front), tacho=0)
