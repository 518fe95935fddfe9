"""Orders of a signal: how much of it comes once, twice or n times a turn of the shaft, at which speed.

A channel is read at even angles of the shaft, so that what follows the shaft stands still in the spectrum however the
speed changes.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from cardan.errors import Problem, check, refuse
from cardan.maths.arrays import Array
from cardan.maths.curves.resampling import read_slowly
from cardan.texts import _

from .rotation import LEAST_TURNS, Rotation
from .signal import Channel, Progress

# A channel at even angles of its shaft, cut into windows of whole turns.

HIGHEST = 10.0  # order up to which spectra reach
TURNS = 16  # turns in a window
BLOCK = 1 << 20  # points that are transformed at once; bounds the memory
OVERLAP = 0.75  # share of a window that the next one shares with it
POINTS_AN_ORDER = 4  # points in the period of the highest order, which `read_slowly` asks for
MOST_POINTS = 2e7  # points at even angles; more would not fit the memory with all that is made of them

WINDOWS = {"hann": (0.5, 0.5), "flattop": (0.21557895, 0.41663158, 0.277263158, 0.083578947, 0.006947368)}
"""Window -> weights of its cosines. A flat top reads amplitudes between two lines to 0.1 %, but is twice as wide."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Turned:
    """A channel at even angles of the shaft."""

    values: Array  # (n,): in the unit of the channel
    angle: Array  # (n,) [rad]: of the shaft
    time: Array  # (n,) [s]: when it stood there
    per_turn: int  # points in a turn


def turned(
    channel: Channel, rotation: Rotation, *, highest: float = HIGHEST, progress: Progress | None = None
) -> Turned:
    """Return a channel at even angles of the shaft, filtered so that nothing folds onto the orders asked for.

    channel: at even steps of time; rotation: of the shaft, over at least a part of the channel.
    highest: order up to which it is to be right.
    progress: told the share done; when it answers "stop" what was read so far counts.
    Returns Turned: within 10⁻⁴ of the amplitude for orders up to the highest one, where the channel itself holds them.
    Four points in the period of the highest order; each is read by a windowed sinc from the channel halved in rate as
    often as its own distance to the next one in time allows: see `cardan.maths.curves.resampling`.
    """
    begin = max(float(rotation.time[0]), channel.start)
    end = min(float(rotation.time[-1]), channel.start + channel.duration)
    per_turn = 4 * math.ceil(POINTS_AN_ORDER * highest / 4)
    step = 2.0 * math.pi / per_turn
    if rotation.turns * per_turn > MOST_POINTS:
        text = _("{turns:.3g} turns with {points} points each are too many: cut the recording, or ask for lower orders")
        raise refuse(channel.name, text.format(turns=rotation.turns, points=per_turn), "out_of_range")
    ends = rotation.angle_at(np.asarray([begin, end])) / step
    place = np.arange(math.ceil(ends[0] - 1e-9), math.floor(ends[1] + 1e-9) + 1) if end > begin else np.zeros(0)
    if place.size < LEAST_TURNS * per_turn:
        text = _("shares {given:.3g} turns with the turning of the shaft; at least {wanted:g} are needed")
        raise refuse(channel.name, text.format(given=place.size / per_turn, wanted=LEAST_TURNS), "out_of_range")
    angle = step * place
    time = rotation.time_at(angle)
    distance = np.gradient(time) * channel.rate
    values = read_slowly(channel.values, (time - channel.start) * channel.rate, distance, progress=progress)
    if values.size < LEAST_TURNS * per_turn:
        text = _("was stopped after {given:.3g} turns; at least {wanted:g} are needed")
        raise refuse(channel.name, text.format(given=values.size / per_turn, wanted=LEAST_TURNS), "out_of_range")
    return Turned(values=values, angle=angle[: values.size], time=time[: values.size], per_turn=per_turn)


def refused(highest: float, turns: int, window: str) -> list[Problem]:
    """Return what is wrong with the options of a spectrum."""
    found = []
    if not 0.0 < highest <= 1000.0:
        text = _("{value:.6g} given; an order above 0 and up to 1000 is needed")
        found.append(Problem("highest", text.format(value=highest), "out_of_range"))
    if turns < 2:
        found.append(Problem("turns", _("{value} given; at least 2 are needed").format(value=turns), "out_of_range"))
    if window not in WINDOWS:
        text = _("{value} is none of {choices}").format(value=repr(window), choices=", ".join(WINDOWS))
        found.append(Problem("window", text, "out_of_range"))
    return found


def window_shape(count: int, window: str) -> Array:
    """Return a window that repeats with its length."""
    place = 2.0 * np.pi * np.arange(count) / count
    weights = WINDOWS[window]
    return np.asarray(sum((-1) ** k * w * np.cos(k * place) for k, w in enumerate(weights)))


def line_width(window: str) -> float:
    """Return how many lines a single order fills: the noise bandwidth of a window."""
    shape = window_shape(1024, window)
    return float(1024 * np.sum(shape**2) / np.sum(shape) ** 2)


def starts(read: Turned, used: int) -> Array:
    """Return where windows begin: evenly spread from the first point to the last whole window."""
    length = used * read.per_turn
    room = read.values.size - length
    count = 1 + math.ceil(room / ((1.0 - OVERLAP) * length))
    return np.unique(np.linspace(0, room, count).round().astype(int))


def cut(read: Turned, turns: int) -> tuple[int, Array, Array, Array]:
    """Return the turns in a window, and where the windows begin, their middle times [s] and mean speeds [rad/s]."""
    used = min(turns, read.values.size // read.per_turn)
    length = used * read.per_turn
    begins = starts(read, used)
    last = np.minimum(begins + length, read.time.size - 1)
    speed = (read.angle[last] - read.angle[begins]) / (read.time[last] - read.time[begins])
    return used, begins, read.time[begins + length // 2], speed


def windows_of(read: Turned, used: int, begins: Array) -> Iterator[tuple[slice, Array]]:
    """Yield the windows (b, n), some of them at a time, each time with which ones they are."""
    length = used * read.per_turn
    count = max(1, BLOCK // length)
    for first in range(0, begins.size, count):
        some = slice(first, first + count)
        yield some, read.values[begins[some, None] + np.arange(length)]


def lines_of(read: Turned, used: int, begins: Array, window: str) -> Iterator[tuple[slice, Array]]:
    """Yield the lines of the windows (b, k), with phases against angle 0, likewise."""
    shape = window_shape(used * read.per_turn, window)
    for some, rows in windows_of(read, used, begins):
        lines = np.fft.rfft(rows * shape, axis=1) * (2.0 / np.sum(shape))
        lines[:, 0] *= 0.5
        order = np.arange(lines.shape[1]) / used
        yield some, lines * np.exp(-1j * np.outer(read.angle[begins[some]], order))


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
    >>> from cardan.recordings import Channel, order_spectrum
    >>> import numpy as np
    >>> from cardan.recordings import Signal, estimate_rotation
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
        # the running median over two orders, which lines do not lift
        floor=np.asarray(scipy.ndimage.median_filter(amplitude, size=2 * used + 1, mode="nearest")),
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
    >>> from cardan.recordings import Channel, order_map
    >>> import numpy as np
    >>> from cardan.recordings import Rotation
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


# Amplitude and phase of some orders of a signal while the speed changes.


@dataclass(frozen=True, eq=False, kw_only=True)
class TrackedOrders:
    """Amplitude and phase of some orders while the speed changed.

    Attributes
    ----------
    name, quantity : str
        Of the channel.
    orders : tuple of float
        Those followed.
    time : array (w,) [s]
        Middle of each window.
    speed : array (w,) [rad/s]
        Mean speed in it.
    value : complex array (o, w)
        ``|v| cos(order·angle + arg v)``: peak amplitude, and phase against the mark on the shaft.
    residual : array (w,)
        Root of the mean square of what is left beside these orders.
    turns : int
        In a window.
    phased : bool
        Whether phases mean something.
    confidence : float
        From 0 to 1.
    """

    name: str
    quantity: str
    orders: tuple[float, ...]
    time: Array
    speed: Array
    value: Array
    residual: Array
    turns: int
    phased: bool
    confidence: float

    @property
    def amplitude(self) -> Array:
        """Peak amplitudes, array (o, w)."""
        return np.abs(self.value)

    @property
    def phase(self) -> Array:
        """Phases, array (o, w) [rad], in (−π, π]."""
        return np.angle(self.value)


def tracked_orders(
    channel: Channel,
    rotation: Rotation,
    orders: Sequence[float] = (1.0, 2.0, 3.0, 4.0),
    *,
    turns: int = TURNS,
    progress: Progress | None = None,
) -> TrackedOrders:
    """Return amplitude and phase of some orders over the speed.

    Parameters
    ----------
    channel : Channel
        What shakes.
    rotation : Rotation
        How the shaft turned.
    orders : sequence of float
        Those to follow, whole or not.
    turns : int
        In a window; four windows in the length of one.
    progress : function, optional
        Told the share done; when it answers "stop" the orders are followed as far as the channel was read.

    Returns
    -------
    TrackedOrders

    Raises
    ------
    InputError
        Too few turns, or orders nearer to each other than two lines.

    See Also
    --------
    order_map, order_spectrum

    Notes
    -----
    In every window all orders are fitted together by weighted least squares (Hann's window), so that they do not leak
    into each other and need not be whole; the mean is fitted as well.

    Examples
    --------
    >>> from cardan.recordings import Channel, tracked_orders
    >>> import numpy as np
    >>> from cardan.recordings import Rotation
    >>> time = np.arange(20000) / 4000
    >>> angle = 2 * np.pi * (8 * time + 3 * time**2)
    >>> shaking = Channel(name="front", rate=4000.0, values=np.cos(angle) + 0.2 * np.sin(1.35 * angle))
    >>> found = tracked_orders(shaking, Rotation(time=time[::100], angle=angle[::100]), [1.0, 1.35])
    >>> print(np.round(np.median(found.amplitude, axis=1), 3), np.round(np.median(found.phase, axis=1), 3))
    [1.  0.2] [ 0.    -1.571]
    """
    wanted = np.asarray(orders, dtype=float)
    highest = float(np.max(wanted, initial=1.0))
    check(refused(highest, turns, "hann"))
    read = turned(channel, rotation, highest=highest, progress=progress)
    used, begins, time, speed = cut(read, turns)
    every = np.sort(np.concatenate([[0.0], wanted]))
    if wanted.size == 0 or float(np.min(np.diff(every))) < 1.5 / used:
        text = _("orders must lie {least:.3g} apart, and be above that, to be told apart in {turns} turns")
        raise refuse("orders", text.format(least=1.5 / used, turns=used), "out_of_range")
    length = used * read.per_turn
    angle = (np.arange(length) - 0.5 * length) * (2.0 * math.pi / read.per_turn)
    weight = np.sqrt(window_shape(length, "hann"))
    waves = np.concatenate(
        [np.ones((angle.size, 1)), np.cos(np.outer(angle, wanted)), np.sin(np.outer(angle, wanted))], axis=1
    )
    fit = np.linalg.pinv(weight[:, None] * waves).T * weight[:, None]
    solution, residual = np.empty((begins.size, waves.shape[1])), np.empty(begins.size)
    for some, rows in windows_of(read, used, begins):
        solution[some] = rows @ fit
        left = rows - solution[some] @ waves.T
        residual[some] = np.sqrt(np.sum((weight * left) ** 2, axis=1) / np.sum(weight**2))
    local = solution[:, 1 : wanted.size + 1] - 1j * solution[:, wanted.size + 1 :]
    middle = read.angle[0] + (2.0 * math.pi / read.per_turn) * (begins + 0.5 * length)
    return TrackedOrders(
        name=channel.name,
        quantity=channel.quantity,
        orders=tuple(float(one) for one in wanted),
        time=time,
        speed=speed,
        value=(local * np.exp(-1j * np.outer(middle, wanted))).T,
        residual=residual,
        turns=used,
        phased=rotation.phased,
        confidence=rotation.confidence * channel.trust,
    )
