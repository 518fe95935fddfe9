"""How joint centres and ends move in time: one class for each kind, and its name in `MOVEMENTS`.

A movement carries the points it names, ``"joints[1]"``, ``"input"`` or ``"output"``; several movements of one drive are
applied one after the other, each to where the ones before left the points.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar

from cardan.drive.joints.joint import Point
from cardan.errors import Problem
from cardan.texts import _
from cardan.units import plain, quantity


@dataclass(frozen=True, kw_only=True, slots=True)
class Movement:
    """What every kind has: the points it moves."""

    kind: ClassVar[str]

    name: str = plain("", doc="name of the movement")
    moves: tuple[str, ...] = plain(doc='points moved: "input", "joints[0]", "joints[1]" …, "output"')

    def problems(self) -> Iterator[Problem]:
        """Yield what contradicts itself in this movement, each with its field; ranges are checked elsewhere."""
        yield from ()


@dataclass(frozen=True, kw_only=True, slots=True)
class Oscillation(Movement):
    """A movement that swings as a sine of time."""

    frequency: float = quantity("frequency", doc="frequency of the oscillation", above=0.0)
    phase: float = quantity("angle", 0.0, doc="phase of the sine at time zero")


@dataclass(frozen=True, kw_only=True, slots=True)
class Hitch(Oscillation):
    """Articulation about a pin, as between tractor and trailer: yaw about z, pitch about the y axis yawed with it.

    By the right-hand rule: a positive yaw turns the points to the left of the power flow (x), a positive pitch down.
    """

    kind: ClassVar[str] = "hitch"

    pivot: Point = quantity("length", doc="hitch pin")
    yaw: float = quantity("angle", 0.0, doc="amplitude of the yaw angle")
    pitch: float = quantity("angle", 0.0, doc="amplitude of the pitch angle")
    pitch_phase: float = quantity("angle", 0.0, doc="phase of the pitch angle ahead of the yaw angle")


@dataclass(frozen=True, kw_only=True, slots=True)
class Arm(Oscillation):
    """Turning about a fixed axis: trailing arm, torque tube, leaf spring as an equivalent arm."""

    kind: ClassVar[str] = "arm"

    pivot: Point = quantity("length", doc="a point of the axis")
    axis: Point = plain(doc="direction of the axis")
    amplitude: float = quantity("angle", doc="amplitude of the turn")


@dataclass(frozen=True, kw_only=True, slots=True)
class Parallel(Oscillation):
    """Parallel guidance: the first moved point turns on an arm, the others shift by the same way without turning."""

    kind: ClassVar[str] = "parallel"

    pivot: Point = quantity("length", doc="pivot of the arm that guides the first moved point")
    axis: Point = plain(doc="direction of the arm's axis")
    amplitude: float = quantity("angle", doc="amplitude of the arm's turn")


@dataclass(frozen=True, kw_only=True, slots=True)
class Harmonic(Oscillation):
    """Harmonic shift along a line."""

    kind: ClassVar[str] = "harmonic"

    amplitude: Point = quantity("length", doc="amplitude [x, y, z]")


@dataclass(frozen=True, kw_only=True, slots=True)
class Body(Oscillation):
    """Bounce, roll, pitch and yaw of a body that carries the points.

    Roll about the body's x axis, then pitch about y, then yaw about z (the turns of vehicle dynamics, ISO 8855), about
    the pivot; then the shift.
    """

    kind: ClassVar[str] = "body"

    pivot: Point = quantity("length", doc="point of the body about which it turns")
    amplitude: Point = quantity("length", (0.0, 0.0, 0.0), doc="amplitude of the shift [x, y, z]")
    roll: float = quantity("angle", 0.0, doc="amplitude of the roll angle")
    pitch: float = quantity("angle", 0.0, doc="amplitude of the pitch angle")
    yaw: float = quantity("angle", 0.0, doc="amplitude of the yaw angle")
    roll_phase: float = quantity("angle", 0.0, doc="phase of the roll ahead of the shift")
    pitch_phase: float = quantity("angle", 0.0, doc="phase of the pitch ahead of the shift")
    yaw_phase: float = quantity("angle", 0.0, doc="phase of the yaw ahead of the shift")


@dataclass(frozen=True, kw_only=True, slots=True)
class Table(Movement):
    """Measured or computed shifts from a CSV file, interpolated by a twice differentiable spline."""

    kind: ClassVar[str] = "table"

    file: str = plain(doc="CSV file beside the drive file: time_s, then x_mm, y_mm, z_mm of the shift")
    times: tuple[float, ...] = ()
    shifts: tuple[Point, ...] = ()

    def problems(self) -> Iterator[Problem]:
        """Yield what is wrong with the rows of the table, once they are read."""
        if len(self.times) != len(self.shifts):
            yield Problem(
                "shifts", _("{shifts} rows for {times} times").format(shifts=len(self.shifts), times=len(self.times))
            )
        if len(self.times) == 1:
            yield Problem("file", _("one row only; a table needs at least two"))
        for row, (time, shift) in enumerate(zip(self.times, self.shifts, strict=False), start=1):
            if not all(math.isfinite(x) for x in (time, *shift)):
                yield Problem("file", _("row {row} holds something that is not a finite number").format(row=row))
                return
        for row, (one, two) in enumerate(pairwise(self.times), start=2):
            if two <= one:
                yield Problem(
                    "file", _("row {row}: its time {time} s is not after the row before").format(row=row, time=two)
                )
                return


@dataclass(frozen=True, kw_only=True, slots=True)
class Spectrum:
    """One-sided power spectral density, as a polygon."""

    frequency: tuple[float, ...] = quantity("frequency", doc="frequencies, rising", low=0.0)
    density: tuple[float, ...] = plain(doc="relative density at these frequencies; scaled to `deviation`", low=0.0)

    def problems(self) -> Iterator[Problem]:
        """Yield what keeps the polygon from being a spectrum."""
        if len(self.frequency) < 2:
            yield Problem("spectrum.frequency", _("a spectrum needs at least two frequencies"))
        if len(self.frequency) != len(self.density):
            text = _("{given} values given for {wanted} frequencies")
            yield Problem("spectrum.density", text.format(given=len(self.density), wanted=len(self.frequency)))
        if any(two <= one for one, two in pairwise(self.frequency)):
            yield Problem("spectrum.frequency", _("the frequencies must rise from one to the next"))
        if not any(self.density):
            yield Problem("spectrum.density", _("all values are zero; the movement would have no size"))


@dataclass(frozen=True, kw_only=True, slots=True)
class Random(Movement):
    """Stationary normal shift along a line, one seeded sample path."""

    kind: ClassVar[str] = "random"

    axis: Point = plain(doc="direction of the shift")
    deviation: float = quantity("length", doc="standard deviation of the shift", above=0.0)
    spectrum: Spectrum = plain(doc="how the shift is spread over frequencies")
    seed: int = plain(0, doc="seed of the sample path", low=0)
    duration: float = quantity("time", doc="time span of the sample path", above=0.0)

    def problems(self) -> Iterator[Problem]:
        """Yield what is wrong with the spectrum."""
        yield from self.spectrum.problems()


MOVEMENTS: dict[str, type[Movement]] = {
    kind.kind: kind for kind in (Hitch, Arm, Parallel, Harmonic, Body, Table, Random)
}
"""Value of the file key ``kind`` -> class."""
