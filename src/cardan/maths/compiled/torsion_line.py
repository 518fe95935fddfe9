"""Torsional lines as arrays and numbers, ready to be stepped through time: many drives of one build."""

from __future__ import annotations

from dataclasses import dataclass, field, fields, replace

import numpy as np

from cardan.maths.arrays import Array

CONSTANT, FALLING, KLOSS, SWINGING, SPEEDS, HISTORY = range(6)
"""Kinds of loads; their numbers: value; M0, slope; 1/ω_sync, M_p, s_p; a, order, phase; value, then place and bend of
every point of a table over the speed; none, a table over time."""

SPEED_LIMIT = 1e5
"""A drive that turns faster [rad/s] has left all bounds."""

TWIST_LIMIT = 1e3
"""So has one whose elements are twisted further [rad]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Load:
    """A torque on a place.

    Attributes
    ----------
    kind : int
    place : int
    numbers : array (k, b)
        As the kind says, for each drive.
    times, values : array (m,)
        Table over time, the same for all drives.
    """

    kind: int
    place: int
    numbers: Array
    times: Array = field(default_factory=lambda: np.zeros(0))
    values: Array = field(default_factory=lambda: np.zeros(0))


_BY_DRIVE = frozenset(
    ("mass", "ground", "tau", "cosine", "sine", "ahead", "inertia", "stiffness", "damping", "rest", "half")
)


@dataclass(frozen=True, eq=False, kw_only=True)
class Line:
    """Many drives of one build, each array's last axis the drives; places are coordinates, then followers.

    Attributes
    ----------
    mass : array (R, b) [kg m²]
        Own inertia of every coordinate.
    ground : array (R + K, b) [N·m·s/rad]
        Damping to ground of every place.
    turning : tuple of K int
        Coordinate that turns each follower.
    tau, cosine, sine, ahead, inertia : array (K, b)
        Of each follower: τ, cos 2ψ, sin 2ψ, lead at the start [rad] and inertia [kg m²].
    ends : tuple of E (int, int)
        Places that each element joins.
    stiffness, damping, rest, half : array (E, b) [N·m/rad, N·m·s/rad, rad, rad]
        Of every element; half is half its play.
    loads : tuple of Load
    forced : bool
        Whether the first coordinate is forced.
    """

    mass: Array
    ground: Array
    turning: tuple[int, ...]
    tau: Array
    cosine: Array
    sine: Array
    ahead: Array
    inertia: Array
    ends: tuple[tuple[int, int], ...]
    stiffness: Array
    damping: Array
    rest: Array
    half: Array
    loads: tuple[Load, ...]
    forced: bool

    @property
    def coordinates(self) -> int:
        """R."""
        return len(self.mass)

    @property
    def places(self) -> int:
        """R + K."""
        return len(self.mass) + len(self.turning)

    @property
    def quantities(self) -> int:
        """Number of curves whose extremes are kept: torques of the elements, speeds of the places."""
        return len(self.ends) + self.places

    def part(self, drives: slice) -> Line:
        """Return some of the drives alone."""
        own = {one.name: getattr(self, one.name)[:, drives] for one in fields(self) if one.name in _BY_DRIVE}
        loads = tuple(replace(load, numbers=load.numbers[:, drives]) for load in self.loads)
        return replace(self, loads=loads, **own)

    def active(self) -> tuple[bool, ...]:
        """Tell which followers move the drive: those with inertia, damper, element or load."""
        met = {place for pair in self.ends for place in pair} | {load.place for load in self.loads}
        r = self.coordinates
        return tuple(
            r + k in met or bool(np.any(self.inertia[k] > 0.0) or np.any(self.ground[r + k] > 0.0))
            for k in range(len(self.turning))
        )


@dataclass(eq=False, kw_only=True)
class State:
    """Where drives are, each array's last axis the drives; stepping changes it in place.

    Attributes
    ----------
    q, v : array (R, b) [rad, rad/s]
    work : array (b,) [J]
        What loads have brought and dampers taken.
    alive : array (b,)
        1 while a drive keeps within bounds, then 0.
    ended : array (b,) [s]
        How long it did.
    before, rate : array (X, b)
        Curves of the extremes at the step before, and their slopes.
    high, low, high_time, low_time : array (X, b)
        Extremes and when they were.
    length : float [s]
        Length of the step before; 0 at the beginning.
    """

    q: Array
    v: Array
    work: Array
    alive: Array
    ended: Array
    before: Array
    rate: Array
    high: Array
    low: Array
    high_time: Array
    low_time: Array
    length: float = 0.0


def begin(line: Line, q: Array, v: Array) -> State:
    """Return the state of drives at angles and speeds (R, b)."""
    count, drives = line.quantities, q.shape[-1]
    nothing = np.zeros((count, drives))
    return State(
        q=np.array(q, dtype=float),
        v=np.array(v, dtype=float),
        work=np.zeros(drives),
        alive=np.ones(drives),
        ended=np.zeros(drives),
        before=nothing.copy(),
        rate=nothing.copy(),
        high=nothing - np.inf,
        low=nothing + np.inf,
        high_time=nothing.copy(),
        low_time=nothing.copy(),
    )
