"""Periodic motion of torsional models: where its search begins, any angle of the shaft, and backlash."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.curves.extremes import series_at
from cardan.maths.periodic.harmonics import Linearised, Status
from cardan.maths.periodic.switching_orbit import Pieces, Shooting, periodic_pieces
from cardan.questions.torsion.model.torsional_balance import linearised, places
from cardan.questions.torsion.model.torsional_layouts import Turning, chosen
from cardan.questions.torsion.model.torsional_model import TorsionalModel


@dataclass(frozen=True, eq=False, kw_only=True)
class Orbit:
    """How every coordinate moves over a period; leading axes (...) are those of the drives."""

    model: TorsionalModel  # the drives; their axes spread over (...)
    speed: Array  # (...) [rad/s]: Ω of the input, or mean speed of free drives
    period: float  # [rad]: shaft angle of a period
    # (..., R, H+1), complex: c_k of what each coordinate is off even rotation, q = φ + Re Σ c_k e^(2πikφ/period), φ =
    # Ωt; nan where no motion was found
    coefficient: Array
    # (...) [N·m]: constant torque on the first station of free drives that keeps the mean speed; 0 where the speed is
    # forced
    force: Array
    # motions found by shooting, exact at contacts, by their drive counted through the leading axes. They hold there
    # instead of the Fourier sum, which is then but their lower harmonics.
    pieces: Mapping[int, Pieces] = field(default_factory=dict)

    @property
    def angle_error(self) -> tuple[int, ...]:
        """Leading axes."""
        return np.shape(self.speed)

    @property
    def count(self) -> int:
        """Number of drives."""
        return math.prod(self.angle_error)

    @property
    def time(self) -> Array:
        """Duration of a period, array (...) [s]."""
        return self.period / np.abs(self.speed)

    @cached_property
    def turning(self) -> Turning:
        """The drives as oscillators."""
        return Turning(self.model, self.angle_error, self.speed.reshape(-1), self.period)

    def drives(self, rows: Array) -> TorsionalModel:
        """Return some of the drives, counted through the leading axes, in one axis."""
        return chosen(self.model, self.angle_error, rows)

    def at(self, angle: ArrayLike) -> tuple[Array, Array, Array]:
        """Return q, q̇ and q̈, arrays (..., p, R), at shaft angles φ (p,) [rad]."""
        found = self.of(np.arange(self.count), angle)
        q, rate, acceleration = (one.reshape(*self.angle_error, *one.shape[1:]) for one in found)
        return q, rate, acceleration

    def of(self, rows: Array, angle: ArrayLike) -> tuple[Array, Array, Array]:
        """Return the same of some of the drives, counted through the leading axes, arrays (b, p, R)."""
        places = np.asarray(angle, dtype=float)
        scale = 2.0 * np.pi / self.period
        x, rate, joint_angle = series_at(
            self.coefficient.reshape(self.count, *self.coefficient.shape[-2:])[rows], places * scale
        )
        omega = self.speed.reshape(-1)[rows][:, None, None] * scale
        first = 0 if self.model.free else 1
        for k in range(len(rows) if self.pieces else 0):
            if int(rows[k]) in self.pieces:
                found = self.pieces[int(rows[k])].at(places * scale)
                x[k, :, first:], rate[k, :, first:], joint_angle[k, :, first:] = found
        even = self.speed.reshape(-1)[rows][:, None, None]
        return places[:, None] + x, even + omega * rate, omega**2 * joint_angle


# Steady running of one drive with backlash: smooth pieces between contacts.

STEP = 0.25
"""First step of the joint angles on the way from a straight drive, as a share of them."""

TRIALS = 6
"""Steps tried."""

WIDE = 0.8
"""Largest phase in a step of drives without play: what swings fast in them is hardly excited."""

NEXT = Shooting(work=20_000)
"""How the motion next to one that repeats in time is found: that takes some hundreds of this work."""

SLACKS = (1.0, 0.5, 0.2, 0.05, 0.0)
"""Shares of its damping that an element keeps amid its play, on the way to none."""


class Backlashed:
    """One drive as an oscillator that switches; see `cardan.maths.periodic.switching_orbit.Switching`.

    turning: with one drive.
    slack: share of its damping that an element keeps amid its play; 0 by the equations.
    """

    def __init__(self, turning: Turning, slack: float = 0.0) -> None:
        self.turning, self.slack = turning, slack
        self.model: TorsionalModel = turning.drives(np.zeros(1, dtype=int))
        self.first = turning.first
        self.scale = turning.period / (2.0 * np.pi)

    @cached_property
    def play(self) -> Array:
        """Half the backlash of every element [rad]."""
        found: Array = 0.5 * self.model.backlash[0]
        return found

    @cached_property
    def heavy(self) -> Array:
        """Which free coordinates turn some inertia."""
        inertia = np.zeros(self.model.coordinates)
        np.add.at(inertia, list(self.model.coordinate), self.model.inertia[0])
        return inertia[self.first :] > 0.0

    @cached_property
    def fastest(self) -> float:
        """Bound of the natural frequencies, all backlash closed [rad/s]."""
        phase = np.linspace(0.0, 2.0 * np.pi, 33)
        still = np.zeros((1, len(phase), self.turning.coordinates))
        sides = np.ones((1, len(self.play)), dtype=int)
        found, _by = self.at(sides, phase[None], still, still, still)
        mass = np.where(self.heavy, found.mass, np.inf)
        spring = np.sqrt(np.max(np.sum(np.abs(found.stiffness), axis=-1) / mass))
        damper = np.max(np.sum(np.abs(found.damping), axis=-1) / mass)
        return float(max(spring, 0.5 * damper, 4.0 * abs(self.turning.frequency[0])))

    def held(self, sides: Array) -> TorsionalModel:
        """Return the drives without backlash that move alike while the elements stay on their sides (n, E)."""
        model, touching = self.model, np.abs(sides).astype(float)
        rest = 0.0 if model.rest is None else model.rest
        return replace(
            model,
            stiffness=model.stiffness * touching,
            damping=model.damping * (touching + self.slack * (1.0 - touching)),
            backlash=0.0 * touching,
            rest=rest + sides * self.play,
        )

    def at(self, sides: Array, phase: Array, x: Array, v: Array, a: Array) -> tuple[Linearised, Array]:
        """Return the balance of steps at phases and its slopes; elements amid their play carry nothing."""
        left, by = linearised(self.held(sides), *self.motion(phase, x, v, a))
        k = self.first
        found = Linearised(
            balance=left[..., k:],
            mass=by.mass[..., k:],
            damping=by.damping[..., k:, k:],
            stiffness=by.stiffness[..., k:, k:],
        )
        return found, self.scale * np.sum(by.stiffness, axis=-1)[..., k:]

    def twist(self, phase: Array, x: Array) -> tuple[Array, Array, Array]:
        """Return the twists of the elements, off their rest, and their slopes."""
        q, _rate, _acceleration = self.motion(phase[None], x[None], 0.0 * x[None], 0.0 * x[None])
        place = places(self.model, q)
        angle, first = place.angle[0], place.first[0]
        heads, tails = [a for a, _b in self.model.elements], [b for _a, b in self.model.elements]
        by = np.zeros((len(phase), len(heads), self.model.coordinates))
        for e, (a, b) in enumerate(self.model.elements):
            by[:, e, self.model.coordinate[a]] += first[:, a]
            by[:, e, self.model.coordinate[b]] -= first[:, b]
        rest = 0.0 if self.model.rest is None else self.model.rest
        return angle[:, heads] - angle[:, tails] - rest, by[..., self.first :], self.scale * np.sum(by, axis=-1)

    def motion(self, phase: Array, x: Array, v: Array, a: Array) -> tuple[Array, Array, Array]:
        """Return q, q̇ and q̈ of all coordinates from what is off even rotation."""
        if self.first:
            x, v, a = (np.concatenate([np.zeros((*one.shape[:-1], 1)), one], axis=-1) for one in (x, v, a))
        return (self.scale * phase)[..., None] + x, self.turning.speed[0] + v, a


def pieces_of(
    turning: Turning, start: Array | None = None, force: float = 0.0, *, method: Shooting | None = None
) -> Pieces | None:
    """Return the steady running of one drive by shooting, or None.

    turning: with one drive; start (R, H+1), complex: Fourier sum near the motion, from which its contacts are read off.
    force [N·m]: constant torque on the first station with it.
    Without a start, or where that leads nowhere, the joint angles grow from 0: the straight drive rests under its mean
    torques, and each motion begins the search for the next.
    """
    search = _Search(turning, method or usual(turning))
    if start is not None and np.isfinite(start).all():
        curve = search.near(_Sum(start, force))
        if curve is not None:
            return curve
    walk: _Sum | Pieces = _Sum(at_rest(turning)[0], 0.0)
    share, step = 0.0, STEP
    for _trial in range(TRIALS):
        if search.spent:
            break
        trial = min(share + step, 1.0)
        part = Turning(turning.model, turning.angle_error, turning.speed, turning.period, np.asarray([trial]))
        found = search.at(part, walk)
        if found is not None:
            share, step, walk = trial, 1.5 * step, found
            if share == 1.0:
                return found
        else:
            step *= 0.5
    return None


def usual(turning: Turning) -> Shooting:
    """Return how the motion of one drive is searched by shooting where nobody says."""
    return Shooting() if bool(np.any(turning.model.backlash > 0.0)) else Shooting(reach=WIDE)


def pieces_near(turning: Turning, start: Array) -> Pieces | None:
    """Return the steady running of one drive next to a Fourier sum (R, H+1) by shooting, or None."""
    return _Search(turning, NEXT).near(_Sum(start, 0.0))


class _Search:
    """Tries to find the motion of one drive, within the work that all of them may take."""

    def __init__(self, turning: Turning, how: Shooting) -> None:
        self.turning, self.how = turning, how

    @property
    def spent(self) -> bool:
        """Whether no work is left."""
        return self.how.work <= 0

    def at(self, turning: Turning, start: _Sum | Pieces, slack: float = 0.0) -> Pieces | None:
        """Return the motion that shooting finds, or None."""
        omega, free = float(turning.frequency[0]), turning.model.free
        found = periodic_pieces(Backlashed(turning, slack), omega, start, free=free, method=self.how)
        self.how = replace(self.how, work=0 if found is None else max(self.how.work - found.work, 0))
        return found if found is not None and found.status == Status.CONVERGED else None

    def near(self, start: _Sum) -> Pieces | None:
        """Return the motion near a sum, if need be by way of dampers that act amid the play as well, or None."""
        found = self.at(self.turning, start)
        if found is not None or not np.any(self.turning.model.backlash > 0.0):
            return found
        curve: _Sum | Pieces = start
        for slack in SLACKS:
            found = None if self.spent else self.at(self.turning, curve, slack)
            if found is None:
                return None
            curve = found
        return found


class _Sum:
    """A Fourier sum to begin with."""

    def __init__(self, coefficient: Array, force: float) -> None:
        self.coefficient, self.force = coefficient, force

    def at(self, phase: Array) -> tuple[Array, Array, Array]:
        """Return x and its derivatives by the phase."""
        return series_at(self.coefficient, phase)


# Where the search for steady running begins: the twist that the mean torques leave in straight joints.

SAMPLES = 16
"""Angles over which torques are averaged."""


def straight_stiffness(drives: TorsionalModel) -> Array:
    """Return the stiffness of drives between their coordinates, all joints straight, array (b, R, R) [N·m/rad]."""
    found = np.zeros((len(drives.stiffness), drives.coordinates, drives.coordinates))
    for e, (first, last) in enumerate(drives.elements):
        a, b = drives.coordinate[first], drives.coordinate[last]
        for r, s, sign in ((a, a, 1.0), (b, b, 1.0), (a, b, -1.0), (b, a, -1.0)):
            found[:, r, s] += sign * drives.stiffness[:, e]
    return found


def straight_frequencies(drives: TorsionalModel) -> Array:
    """Return the natural frequencies of drives, all joints straight and all backlash closed, array (b, m) [rad/s].

    drives (b,).
    Returns: rising; of a free drive the first is 0, its turning as a whole.
    """
    mass = np.zeros((len(drives.inertia), drives.coordinates))
    for k, r in enumerate(drives.coordinate):
        mass[:, r] += drives.inertia[:, k]
    first = 0 if drives.free else 1
    mass, stiffness = mass[:, first:], straight_stiffness(drives)[:, first:, first:]
    heavy = np.any(mass > 0.0, axis=0)
    inner = stiffness[:, heavy][:, :, heavy]
    if not heavy.all():
        across = stiffness[:, heavy][:, :, ~heavy]
        inner = inner - across @ np.linalg.solve(stiffness[:, ~heavy][:, :, ~heavy], across.swapaxes(-1, -2))
    root = np.sqrt(mass[:, heavy])
    values = np.linalg.eigvalsh(inner / (root[:, :, None] * root[:, None, :]))
    found: Array = np.sqrt(np.maximum(values, 0.0))
    if drives.free and found.shape[-1]:
        found[:, 0] = 0.0
    return found


def at_rest(turning: Turning) -> Array:
    """Return the twist of every coordinate under mean torques, all joints straight, array (B, R, 1), complex.

    Each element with backlash lies on the side that its torque pushes it to; one without torque lies amid it.
    """
    rows = np.arange(len(turning.speed))
    drives = turning.drives(rows)
    speed = turning.speed[:, None]
    angle = turning.period * np.arange(SAMPLES) / SAMPLES + 0.0 * speed
    load = np.zeros((len(rows), drives.coordinates))
    for torque in drives.torques:
        value = np.mean(torque.law.at(0.0, angle, speed + 0.0 * angle)[0], axis=-1)
        load[:, drives.coordinate[torque.station]] += value
    for k, r in enumerate(drives.coordinate):
        load[:, r] -= drives.ground_damping[:, k] * turning.speed
    ends = [(drives.coordinate[a], drives.coordinate[b]) for a, b in drives.elements]
    if drives.rest is not None:
        for e, (a, b) in enumerate(ends):
            load[:, a] += drives.stiffness[:, e] * drives.rest[:, e]
            load[:, b] -= drives.stiffness[:, e] * drives.rest[:, e]
    stiffness = straight_stiffness(drives)
    inner = stiffness[:, 1:, 1:]
    found = np.zeros((len(rows), drives.coordinates))
    if inner.shape[-1]:
        found[:, 1:] = np.linalg.solve(inner, load[:, 1:, None])[..., 0]
        if np.any(drives.backlash > 0.0):
            rest = np.zeros_like(drives.backlash) if drives.rest is None else drives.rest
            for e, (a, b) in enumerate(ends):
                push = (
                    0.5
                    * drives.backlash[:, e]
                    * np.sign(found[:, a] - found[:, b] - rest[:, e])
                    * drives.stiffness[:, e]
                )
                load[:, a] += push
                load[:, b] -= push
            found[:, 1:] = np.linalg.solve(inner, load[:, 1:, None])[..., 0]
    return found[:, turning.first :, None].astype(complex)
