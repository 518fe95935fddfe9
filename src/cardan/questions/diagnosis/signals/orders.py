"""Orders of a signal: how much of it comes once, twice or n times a turn of the shaft, at which speed.

A channel is read at even angles of the shaft, so that what follows the shaft stands still in the spectrum however the
speed changes.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import scipy

from cardan.errors import check
from cardan.maths.arrays import Array

from .order_windows import HIGHEST, TURNS, cut, line_width, lines_of, refused, turned
from .rotation import Rotation
from .signal import Channel
from .watching import Progress


@dataclass(frozen=True, eq=False, kw_only=True)
class OrderSpectrum:
    """Amplitudes of a channel over the orders of a shaft, averaged over the recording.

    Attributes
    ----------
    name, quantity : str
        Of the channel.
    order : array (k,)
        Multiples of the speed of the shaft.
    amplitude : array (k,)
        Root of the mean square over the windows, as amplitude of a cosine: its peak, not its effective value.
    coherent : complex array (k,)
        Mean over the windows of what keeps its phase to the shaft: a cosine ``|c| cos(order·angle + arg c)``; for whole
        orders, and meaningful where the rotation is phased.
    floor : array (k,)
        What noise leaves at each order: the running median of the amplitude.
    resolution : float
        Width of a line: orders nearer than this are one.
    window : str
        ``hann`` or ``flattop``.
    turns : int
        In a window.
    windows : int
        How many were averaged.
    speeds : (float, float) [rad/s]
        Between which the shaft turned.
    confidence : float
        From 0 to 1: that of the rotation and of the channel.
    """

    name: str
    quantity: str
    order: Array
    amplitude: Array
    coherent: Array
    floor: Array
    resolution: float
    window: str
    turns: int
    windows: int
    speeds: tuple[float, float]
    confidence: float

    def at(self, order: float) -> float:
        """Return the amplitude of an order: the highest line within half the resolution of it."""
        near = np.abs(self.order - order) <= 0.5 * self.resolution + 1e-9
        return float(np.max(self.amplitude[near])) if np.any(near) else math.nan

    def peaks(self, *, count: int = 8, above: float = 3.0) -> tuple[tuple[float, float], ...]:
        """Return order and amplitude of the highest lines, those that stand out of the noise.

        Parameters
        ----------
        count : int
            At most so many.
        above : float
            Times the floor that a line has to reach.

        Returns
        -------
        tuple of (float, float)
            Highest first. Orders are interpolated between lines.
        """
        level = self.amplitude
        inner = np.arange(1, level.size - 1)
        tops = inner[(level[inner] > level[inner - 1]) & (level[inner] >= level[inner + 1])]
        tops = tops[(level[tops] > above * self.floor[tops]) & (self.order[tops] > self.resolution)]
        found: list[tuple[float, float]] = []
        for k in sorted(tops.tolist(), key=lambda k: -level[k]):
            left, middle, right = np.log(np.maximum(level[k - 1 : k + 2], 1e-300))
            bow = left - 2.0 * middle + right
            shift = 0.5 * (left - right) / bow if bow < 0.0 else 0.0
            order = float(self.order[k] + shift * (self.order[1] - self.order[0]))
            if all(abs(order - one) > self.resolution for one, _size in found):
                found.append((order, float(level[k])))
        return tuple(found[:count])


@dataclass(frozen=True, eq=False, kw_only=True)
class OrderMap:
    """Amplitudes over orders and speed: a line for each window of some turns.

    Attributes
    ----------
    name, quantity : str
        Of the channel.
    time : array (w,) [s]
        Middle of each window.
    speed : array (w,) [rad/s]
        Mean speed in it.
    order : array (k,)
        Multiples of the speed.
    amplitude : array (w, k)
        Peak amplitudes.
    resolution : float
        Width of a line.
    turns : int
        In a window.
    confidence : float
        From 0 to 1.
    """

    name: str
    quantity: str
    time: Array
    speed: Array
    order: Array
    amplitude: Array
    resolution: float
    turns: int
    confidence: float


def order_spectrum(
    channel: Channel,
    rotation: Rotation,
    *,
    highest: float = HIGHEST,
    turns: int = TURNS,
    window: str = "hann",
    progress: Progress | None = None,
) -> OrderSpectrum:
    """Return the amplitudes of a channel over the orders of a shaft.

    Parameters
    ----------
    channel : Channel
        What shakes.
    rotation : Rotation
        How the shaft turned.
    highest : float
        Highest order.
    turns : int
        In a window; fewer where the recording has not so many. Lines lie 1/turns apart.
    window : str
        ``hann`` tells near orders apart; ``flattop`` reads amplitudes of any order to 0.1 %.
    progress : function, optional
        Told the share done; when it answers "stop" the spectrum is that of what was read so far.

    Returns
    -------
    OrderSpectrum

    Raises
    ------
    InputError
        Too few turns, or a bad option.

    See Also
    --------
    order_map, tracked_orders, estimate_rotation

    Examples
    --------
    >>> import numpy as np
    >>> from cardan.questions.diagnosis.signals.signal import Signal
    >>> from cardan.questions.diagnosis.signals.turning import estimate_rotation
    >>> time = np.arange(20000) / 4000
    >>> angle = 2 * np.pi * (8 * time + 3 * time**2)
    >>> tacho = Channel(name="tacho", quantity="pulses", rate=4000.0, values=np.sin(angle))
    >>> shaking = Channel(name="front", rate=4000.0, values=0.5 * np.cos(2 * angle + 1.0))
    >>> found = order_spectrum(shaking, estimate_rotation(Signal(channels=(tacho, shaking), tacho=0)))
    >>> print(f"{found.at(2.0):.4f}, {np.angle(found.coherent[found.order == 2.0])[0]:.4f} rad")
    0.5000, 1.0000 rad
    """
    check(refused(highest, turns, window))
    read = turned(channel, rotation, highest=highest, progress=progress)
    used, begins, _time, _speed = cut(read, turns)
    count = _kept(highest, used, read.per_turn)
    power, mean = np.zeros(count), np.zeros(count, dtype=complex)
    for _some, lines in lines_of(read, used, begins, window):
        power += np.sum(np.abs(lines[:, :count]) ** 2, axis=0)
        mean += np.sum(lines[:, :count], axis=0)
    amplitude = np.sqrt(power / begins.size)
    order = np.arange(count) / used
    return OrderSpectrum(
        name=channel.name,
        quantity=channel.quantity,
        order=order,
        amplitude=amplitude,
        coherent=mean / begins.size,
        floor=_floor(amplitude, used),
        resolution=line_width(window) / used,
        window=window,
        turns=used,
        windows=begins.size,
        speeds=rotation.speeds,
        confidence=rotation.confidence * channel.trust,
    )


def order_map(
    channel: Channel,
    rotation: Rotation,
    *,
    highest: float = HIGHEST,
    turns: int = TURNS,
    window: str = "hann",
    progress: Progress | None = None,
) -> OrderMap:
    """Return the amplitudes of a channel over the orders of a shaft and its speed, as in a run-up.

    Parameters
    ----------
    channel : Channel
        What shakes.
    rotation : Rotation
        How the shaft turned.
    highest : float
        Highest order.
    turns : int
        In a window; a line of the map for each, four in the length of one.
    window : str
        As in `order_spectrum`.
    progress : function, optional
        Told the share done; when it answers "stop" the map ends where the channel was read to.

    Returns
    -------
    OrderMap

    Raises
    ------
    InputError
        Too few turns, or a bad option.

    See Also
    --------
    order_spectrum, tracked_orders

    Examples
    --------
    >>> import numpy as np
    >>> from cardan.questions.diagnosis.signals.rotation import Rotation
    >>> time = np.arange(20000) / 4000
    >>> angle = 2 * np.pi * (8 * time + 3 * time**2)
    >>> shaking = Channel(name="front", rate=4000.0, values=np.cos(2 * angle) + np.cos(300 * time))
    >>> found = order_map(shaking, Rotation(time=time[::100], angle=angle[::100]))
    >>> line = found.amplitude[:, found.order == 2.0][:, 0]
    >>> print(f"{found.speed[0]:.0f} rad/s: {line[0]:.2f}, {found.speed[-1]:.0f} rad/s: {line[-1]:.2f}")
    75 rad/s: 1.00, 230 rad/s: 1.00
    """
    check(refused(highest, turns, window))
    read = turned(channel, rotation, highest=highest, progress=progress)
    used, begins, time, speed = cut(read, turns)
    count = _kept(highest, used, read.per_turn)
    amplitude = np.empty((begins.size, count))
    for some, lines in lines_of(read, used, begins, window):
        amplitude[some] = np.abs(lines[:, :count])
    return OrderMap(
        name=channel.name,
        quantity=channel.quantity,
        time=time,
        speed=speed,
        order=np.arange(count) / used,
        amplitude=amplitude,
        resolution=line_width(window) / used,
        turns=used,
        confidence=rotation.confidence * channel.trust,
    )


def _kept(highest: float, used: int, per_turn: int) -> int:
    """Return how many lines reach up to an order."""
    return min(math.floor(highest * used + 1e-6), used * per_turn // 2) + 1


def _floor(amplitude: Array, turns: int) -> Array:
    """Return the running median over two orders, which lines do not lift."""
    return np.asarray(scipy.ndimage.median_filter(amplitude, size=2 * turns + 1, mode="nearest"))
