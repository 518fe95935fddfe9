"""A channel at even angles of its shaft, cut into windows of whole turns."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from cardan.errors import Problem, refuse
from cardan.maths.arrays import Array
from cardan.maths.curves.resampling import read_slowly
from cardan.texts import _

from .rotation import LEAST_TURNS, Rotation
from .signal import Channel
from .watching import Progress

HIGHEST = 10.0
"""Order up to which spectra reach."""

TURNS = 16
"""Turns in a window."""

BLOCK = 1 << 20
"""Points that are transformed at once; bounds the memory."""

OVERLAP = 0.75
"""Share of a window that the next one shares with it."""

POINTS_AN_ORDER = 4
"""Points in the period of the highest order, which `read_slowly` asks for."""

MOST_POINTS = 2e7
"""Points at even angles; more would not fit the memory with all that is made of them."""

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
    channel: Channel,
    rotation: Rotation,
    *,
    highest: float = HIGHEST,
    progress: Progress | None = None,
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
