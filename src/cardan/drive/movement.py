"""How joint centres and ends move in time: one class for each kind, and its name in `MOVEMENTS`.

A movement carries the points it names, ``"joints[1]"``, ``"input"`` or ``"output"``; several movements of one drive are
applied one after the other, each to where the ones before left the points.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from cardan.drive.joints.joint import Point
from cardan.units import plain, quantity


@dataclass(frozen=True, kw_only=True, slots=True)
class Movement:
    """What every kind has: the points it moves."""

    kind: ClassVar[str]

    name: str = plain("", doc="name of the movement")
    moves: tuple[str, ...] = plain(doc='points moved: "input", "joints[0]", "joints[1]" …, "output"')


@dataclass(frozen=True, kw_only=True, slots=True)
class _Oscillation(Movement):
    """A movement that swings as a sine of time."""

    frequency: float = quantity("frequency", doc="frequency of the swing", above=0.0)
    phase: float = quantity("angle", 0.0, doc="phase of the sine at time zero")


@dataclass(frozen=True, kw_only=True, slots=True)
class Hitch(_Oscillation):
    """Articulation about a pin, as between tractor and trailer: yaw about z, then pitch about y."""

    kind: ClassVar[str] = "hitch"

    pivot: Point = quantity("length", doc="hitch pin")
    yaw: float = quantity("angle", 0.0, doc="amplitude of the yaw angle")
    pitch: float = quantity("angle", 0.0, doc="amplitude of the pitch angle")
    pitch_phase: float = quantity("angle", 0.0, doc="phase of the pitch angle ahead of the yaw angle")


@dataclass(frozen=True, kw_only=True, slots=True)
class Arm(_Oscillation):
    """Turning about a fixed axis: trailing arm, torque tube, leaf spring as an equivalent arm."""

    kind: ClassVar[str] = "arm"

    pivot: Point = quantity("length", doc="a point of the axis")
    axis: Point = plain(doc="direction of the axis")
    amplitude: float = quantity("angle", doc="amplitude of the turn")


@dataclass(frozen=True, kw_only=True, slots=True)
class Parallel(_Oscillation):
    """Parallel guidance: the first moved point swings on an arm, the others shift by the same way without turning."""

    kind: ClassVar[str] = "parallel"

    pivot: Point = quantity("length", doc="pivot of the arm that guides the first moved point")
    axis: Point = plain(doc="direction of the arm's axis")
    amplitude: float = quantity("angle", doc="amplitude of the arm's turn")


@dataclass(frozen=True, kw_only=True, slots=True)
class Harmonic(_Oscillation):
    """Harmonic shift along a line."""

    kind: ClassVar[str] = "harmonic"

    amplitude: Point = quantity("length", doc="amplitude [x, y, z]")


@dataclass(frozen=True, kw_only=True, slots=True)
class Body(_Oscillation):
    """Bounce, roll (about x), pitch (about y) and yaw (about z) of a body that carries the points."""

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


@dataclass(frozen=True, kw_only=True, slots=True)
class Spectrum:
    """One-sided power spectral density, as a polygon."""

    frequency: tuple[float, ...] = quantity("frequency", doc="frequencies, rising", low=0.0)
    density: tuple[float, ...] = plain(doc="relative density at these frequencies; scaled to `deviation`", low=0.0)


@dataclass(frozen=True, kw_only=True, slots=True)
class Random(Movement):
    """Stationary normal shift along a line, one seeded sample path."""

    kind: ClassVar[str] = "random"

    axis: Point = plain(doc="direction of the shift")
    deviation: float = quantity("length", doc="standard deviation of the shift", above=0.0)
    spectrum: Spectrum = plain(doc="how the shift is spread over frequencies")
    seed: int = plain(0, doc="seed of the sample path", low=0)
    duration: float = quantity("time", doc="time span of the sample path", above=0.0)


MOVEMENTS: dict[str, type[Movement]] = {
    kind.kind: kind for kind in (Hitch, Arm, Parallel, Harmonic, Body, Table, Random)
}
"""Value of the file key ``kind`` -> class."""
