"""Integration of a channel in time, and its cepstrum."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
import scipy

from cardan.errors import Problem, check, refuse
from cardan.maths.arrays import Array
from cardan.texts import _

from .orders import turned
from .rotation import Rotation
from .signal import Channel

NEXT = {"acceleration": "velocity", "velocity": "displacement", "angular_speed": "angle"}
"""Quantity -> its integral over time."""

LEAST_VALUES = 16  # a cepstrum of fewer values says nothing
FLOOR = 1e-6  # share of the highest power below which a line counts as this much; a logarithm needs something


@dataclass(frozen=True, eq=False, kw_only=True)
class Cepstrum:
    """Families of evenly spaced lines, each as one peak.

    Attributes
    ----------
    name : str
        Of the channel.
    lag : array (n,)
        In turns of the shaft, or in seconds where there is no rotation: lines every s orders make a peak at 1/s turns.
    value : array (n,)
        Real cepstrum of the power, in nepers.
    unit : str
        ``turn`` or ``s``.
    """

    name: str
    lag: Array
    value: Array
    unit: str

    def peak(self, low: float, high: float) -> tuple[float, float]:
        """Return lag and height of the highest value between two lags."""
        inside = np.flatnonzero((self.lag >= low) & (self.lag <= high))
        if inside.size == 0:
            return math.nan, math.nan
        k = int(inside[np.argmax(self.value[inside])])
        return float(self.lag[k]), float(self.value[k])


def integrate(channel: Channel, *, low: float) -> Channel:
    """Return a channel integrated over time: acceleration to velocity, velocity to displacement, speed to angle.

    Parameters
    ----------
    channel : Channel
        Of acceleration, velocity or angular speed.
    low : float [Hz]
        What is slower is cut off: integrated noise and drift would grow beyond all vibration.

    Returns
    -------
    Channel
        Of the integral, without its mean. What is within a period or two of ``low`` from the ends is worth little.

    Raises
    ------
    InputError
        There is no integral of its quantity, or the cut is not between 0 and half the rate.

    See Also
    --------
    order_spectrum, orbit

    Notes
    -----
    Every line of the spectrum is divided by iω and by 1 + (low/f)⁸: 1e-3 of the amplitude is lost at 2.4 times ``low``,
    half of it at ``low``. The record is mirrored at its ends, so that no step is integrated.

    Examples
    --------
    >>> import numpy as np
    >>> from cardan.recordings import Channel, integrate
    >>> time = np.arange(4000) / 1000
    >>> shaking = Channel(name="front", values=np.cos(2 * np.pi * 20 * time), rate=1000.0)
    >>> moving = integrate(integrate(shaking, low=5.0), low=5.0)
    >>> print(moving.quantity, f"{np.max(moving.values[1000:3000]) * (2 * np.pi * 20) ** 2:.4f}")
    displacement 1.0000
    """
    problems = []
    if channel.quantity not in NEXT:
        text = _("{name} measures {quantity}; only {known} are integrated")
        text = text.format(name=channel.name, quantity=channel.quantity, known=", ".join(NEXT))
        problems.append(Problem("channel", text, "out_of_range"))
    if not 0.0 < low < 0.5 * channel.rate:
        text = _("{value:.6g} Hz given; a frequency above 0 and below {limit:.6g} Hz is needed")
        problems.append(Problem("low", text.format(value=low, limit=0.5 * channel.rate), "out_of_range"))
    check(problems)
    values = channel.values - np.mean(channel.values)
    count = values.size
    begin = count - 1
    whole = np.pad(values, (begin, scipy.fft.next_fast_len(3 * count) - 2 * count + 1), mode="symmetric")
    whole = whole - np.mean(whole)
    frequency = np.fft.rfftfreq(whole.size, 1.0 / channel.rate)
    factor = np.zeros(frequency.size, dtype=complex)
    factor[1:] = 1.0 / (2j * math.pi * frequency[1:] * (1.0 + (low / frequency[1:]) ** 8))
    found = np.fft.irfft(np.fft.rfft(whole) * factor, whole.size)
    return replace(channel, quantity=NEXT[channel.quantity], values=found[begin : begin + count], unit="")


def cepstrum(channel: Channel, rotation: Rotation | None = None, *, highest: float = 50.0) -> Cepstrum:
    """Return the cepstrum of a channel: where lines stand in rows, as sidebands do, it has one peak for the row.

    Parameters
    ----------
    channel : Channel
        What shakes.
    rotation : Rotation, optional
        How the shaft turned; the cepstrum is then that of the orders.
    highest : float
        Highest order that counts.

    Returns
    -------
    Cepstrum

    Raises
    ------
    InputError
        Too few turns or values.

    See Also
    --------
    order_spectrum

    Notes
    -----
    The inverse transform of the logarithm of the power spectrum, the latter with Hann's window.

    Examples
    --------
    >>> import numpy as np
    >>> from cardan.recordings import Channel, cepstrum
    >>> time = np.arange(20000) / 4000
    >>> knocking = Channel(name="front", rate=4000.0, values=np.exp(-((time * 10) % 1.0) * 60) * np.cos(3000 * time))
    >>> lag, height = cepstrum(knocking).peak(0.03, 0.15)
    >>> print(f"a knock every {lag:.3f} s")
    a knock every 0.100 s
    """
    if rotation is None:
        values, step, unit = channel.values, 1.0 / channel.rate, "s"
    else:
        read = turned(channel, rotation, highest=highest)
        values, step, unit = read.values, 1.0 / read.per_turn, "turn"
    if values.size < LEAST_VALUES:
        text = _("has {given} values; at least {wanted} are needed").format(given=values.size, wanted=LEAST_VALUES)
        raise refuse(channel.name, text, "empty")
    window = np.hanning(values.size)
    power = np.abs(np.fft.rfft((values - np.mean(values)) * window)) ** 2
    power = np.maximum(power, FLOOR * np.max(power, initial=1e-300))
    found = np.fft.irfft(np.log(power))
    half = found.size // 2
    return Cepstrum(name=channel.name, lag=step * np.arange(half), value=found[:half], unit=unit)
