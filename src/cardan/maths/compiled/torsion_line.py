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
    """A torque on a place."""

    kind: int
    place: int
    numbers: Array  # (k, b): as the kind says, for each drive
    # times, values (m,): table over time, the same for all drives
    times: Array = field(default_factory=lambda: np.zeros(0))
    values: Array = field(default_factory=lambda: np.zeros(0))  # (m,)


_BY_DRIVE = frozenset(
    ("mass", "ground", "tau", "cosine", "sine", "ahead", "inertia", "stiffness", "damping", "rest", "half")
)


@dataclass(frozen=True, eq=False, kw_only=True)
class Line:
    """Many drives of one build, each array's last axis the drives; places are coordinates, then followers."""

    mass: Array  # (R, b) [kg m²]: own inertia of every coordinate
    ground: Array  # (R + K, b) [N·m·s/rad]: damping to ground of every place
    turning: tuple[int, ...]  # coordinate that turns each follower
    # tau, cosine, sine, ahead, inertia (K, b): of each follower: τ, cos 2ψ, sin 2ψ, lead at the start [rad] and inertia
    # [kg m²]
    tau: Array
    cosine: Array  # (K, b)
    sine: Array  # (K, b)
    ahead: Array  # (K, b)
    inertia: Array  # (K, b)
    ends: tuple[tuple[int, int], ...]  # places that each element joins
    # stiffness, damping, rest, half (E, b) [N·m/rad, N·m·s/rad, rad, rad]: of every element; half is half its play
    stiffness: Array
    damping: Array  # (E, b) [N·m·s/rad]
    rest: Array  # (E, b) [rad]
    half: Array  # (E, b) [rad]
    loads: tuple[Load, ...]
    forced: bool  # whether the first coordinate is forced

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
    """Where drives are, each array's last axis the drives; stepping changes it in place."""

    q: Array  # (R, b) [rad]
    v: Array  # (R, b) [rad/s]
    work: Array  # (b,) [J]: what loads have brought and dampers taken
    alive: Array  # (b,): 1 while a drive keeps within bounds, then 0
    ended: Array  # (b,) [s]: how long it did
    before: Array  # before, rate (X, b): curves of the extremes at the step before, and their slopes
    rate: Array  # (X, b)
    high: Array  # high, low, high_time, low_time (X, b): extremes and when they were
    low: Array  # (X, b)
    high_time: Array  # (X, b)
    low_time: Array  # (X, b)
    length: float = 0.0  # [s]: length of the step before; 0 at the beginning


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
