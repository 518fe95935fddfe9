"""A recording: what sensors measured on a running drive, in SI, with the channel that tells how it turned."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from cardan.errors import Problem, check, refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.texts import _
from cardan.units import nearest

QUANTITIES = {
    "acceleration": "acceleration", "velocity": "speed", "displacement": "length", "angle": "angle",
    "angular_speed": "angular_speed", "torque": "torque", "pulses": "", "other": "",
}  # fmt: skip
"""What a channel can measure -> its dimension in `cardan.units.DIMENSIONS`; empty for what has none."""

DIRECTIONS = ("x", "y", "z", "radial", "axial", "torsion", "")

LARGEST = 1e30  # numbers beyond this are no measurement, in any unit
TURNING = ("pulses", "angular_speed", "angle")  # quantities that tell how a shaft turns


def _real(values: ArrayLike) -> Array:
    """Return values as an array of real numbers, or refuse complex numbers, words and rows of two lengths."""
    try:
        found = np.asarray(values)
    except ValueError:
        found = np.asarray(None)
    if found.dtype.kind not in "biuf":
        raise refuse("values", _("one row of real numbers is needed"), "inconsistent")
    return found.astype(float, copy=False)


@dataclass(frozen=True, eq=False, kw_only=True)
class Channel:
    """What one sensor measured, at even steps of time.

    Attributes
    ----------
    name : str
        As in the file.
    quantity : str
        One of `QUANTITIES`: acceleration [m/s²], velocity [m/s], displacement [m], angle [rad], angular_speed [rad/s],
        torque [N·m], pulses or other [as read].
    values : array (n,)
        In SI, all finite.
    rate : float [Hz]
        Values a second.
    start : float [s]
        Time of the first value.
    place : str
        Key path of the part of the drive that it sits on, ``supports[1]`` or ``shafts[1]``; empty where not known.
    direction : str
        x, y, z, radial, axial, torsion, or empty.
    unit : str
        As read.
    trust : float
        From 0 to 1: 1 for a sound channel, less by what was doubtful in it, as clipping or gaps.
    """

    name: str
    quantity: str = "acceleration"
    values: Array
    rate: float
    start: float = 0.0
    place: str = ""
    direction: str = ""
    unit: str = ""
    trust: float = 1.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "values", _real(self.values))
        check(self._problems())

    def _problems(self) -> Iterator[Problem]:
        if self.quantity not in QUANTITIES:
            text = _("{value} is none of {choices}")
            text = text.format(value=repr(self.quantity), choices=", ".join(QUANTITIES))
            yield Problem("quantity", text, "out_of_range")
        if self.direction not in DIRECTIONS:
            text = _("{value} is none of {choices}")
            text = text.format(value=repr(self.direction), choices=", ".join(DIRECTIONS[:-1]))
            yield Problem("direction", text, "out_of_range")
        if not 0.0 < self.rate < math.inf:
            text = _("{value:.6g} given; a finite number of values a second above 0 is needed")
            yield Problem("rate", text.format(value=self.rate), "not_positive")
        if not math.isfinite(self.start):
            yield Problem("start", _("is not finite"), "not_finite")
        if not 0.0 <= self.trust <= 1.0:
            yield Problem("trust", _("{value:.6g} is not from 0 to 1").format(value=self.trust), "out_of_range")
        if self.values.ndim != 1 or self.values.size == 0:
            text = _("one row of numbers is needed; shape {shape} given")
            yield Problem("values", text.format(shape=self.values.shape), "empty")
        elif not np.all(np.isfinite(self.values)):
            yield Problem("values", _("not all numbers are finite; fill the gaps first"), "not_finite")
        elif float(np.max(np.abs(self.values))) > LARGEST:
            text = _("holds numbers beyond {limit:g}: nothing measures that").format(limit=LARGEST)
            yield Problem("values", text, "out_of_range")

    @property
    def time(self) -> Array:
        """Time of every value, array (n,) [s]."""
        return self.start + np.arange(self.values.size) / self.rate

    @property
    def duration(self) -> float:
        """How long it lasts [s]: the steps times their length."""
        return float(self.values.size - 1) / self.rate


@dataclass(frozen=True, eq=False, kw_only=True)
class Signal:
    """A recording: its channels, which of them tells how the shaft turned, and what was doubtful in it.

    Attributes
    ----------
    name : str
        Name of the file or of the recording.
    channels : tuple of Channel
        At least one; each with its own rate.
    tacho : int, optional
        Place among the channels of the pulses of a tacho or key-phasor, the speed, or the angle of the shaft.
    pulses_per_turn : float
        Pulses of the tacho in a turn of the shaft; for a speed or an angle, turns of the sensor in a turn of the shaft.
    cautions : tuple of str
        What was doubtful: one sentence each, with the name of the channel.
    """

    name: str = ""
    channels: tuple[Channel, ...]
    tacho: int | None = None
    pulses_per_turn: float = 1.0
    cautions: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        check(self._problems())

    def _problems(self) -> Iterator[Problem]:
        if not self.channels:
            yield Problem("channels", _("a recording needs one channel or more"), "empty")
        if not 0.0 < self.pulses_per_turn < math.inf:
            text = _("{value:.6g} given; a finite number above 0 is needed")
            yield Problem("pulses_per_turn", text.format(value=self.pulses_per_turn), "not_positive")
        if self.tacho is None:
            return
        if not 0 <= self.tacho < len(self.channels):
            text = _("there is no channel {number}; the recording has {count}")
            yield Problem("tacho", text.format(number=self.tacho, count=len(self.channels)), "out_of_range")
        elif self.channels[self.tacho].quantity not in TURNING:
            text = _("channel {name} measures {quantity}; one of {choices} is needed")
            chosen = self.channels[self.tacho]
            text = text.format(name=chosen.name, quantity=chosen.quantity, choices=", ".join(TURNING))
            yield Problem("tacho", text, "inconsistent")

    @property
    def measured(self) -> tuple[Channel, ...]:
        """Channels of what shakes: all but the tacho and other pulses."""
        rest = (one for k, one in enumerate(self.channels) if k != self.tacho)
        return tuple(one for one in rest if one.quantity != "pulses")

    @property
    def duration(self) -> float:
        """How long it lasts [s]: that of its shortest channel."""
        return min(one.duration for one in self.channels)

    @property
    def trust(self) -> float:
        """From 0 to 1: that of its worst channel; dead ones say nothing, and 0 is left where all are."""
        return min((one.trust for one in self.channels if one.trust > 0.0), default=0.0)

    def channel(self, name: str) -> Channel:
        """Return the channel of a name.

        Parameters
        ----------
        name : str
            As in the file.

        Returns
        -------
        Channel

        Raises
        ------
        InputError
            There is none; with the nearest name.
        """
        for one in self.channels:
            if one.name == name:
                return one
        names = [one.name for one in self.channels]
        near = nearest(name, names)
        text = _("there is no channel {name}; there are {names}").format(name=repr(name), names=", ".join(names))
        if near is not None:
            text = _("there is no channel {name}; did you mean {near}?").format(name=repr(name), near=near)
        raise refuse("channel", text, "out_of_range")


# Who watches work of several parts: told how far the whole of it is, and heard when he wants it to stop.

Progress: TypeAlias = Callable[[float], object]  # told the share done; may answer "stop"


class Watch:
    """Tells how far the parts of some work are together; it can be handed on as the progress of the part at work.

    progress: who is told; he may answer "stop".
    parts: how many parts there are, taken for equal; stopped: whether the answer was "stop" once.
    """

    def __init__(self, progress: Progress | None, parts: int) -> None:
        self.stopped = False
        self._progress = progress
        self._parts = max(parts, 1)
        self._done = 0

    def __call__(self, share: float) -> str | None:
        """Tell how far the part at work is; return "stop" once that was the answer."""
        if self._progress is not None and not self.stopped:
            self.stopped = self._progress(min(1.0, (self._done + share) / self._parts)) == "stop"
        return "stop" if self.stopped else None

    def next(self) -> None:
        """Begin the next part."""
        self._done += 1
        self(0.0)
