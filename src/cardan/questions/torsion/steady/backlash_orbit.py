"""Steady running of one drive with backlash: smooth pieces between contacts."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property

import numpy as np

from cardan.maths.arrays import Array
from cardan.maths.curves.waves import series_at
from cardan.maths.periodic.harmonics import Linearised, Status
from cardan.maths.periodic.switching_orbit import Pieces, Shooting, periodic_pieces
from cardan.questions.torsion.model.torsional_balance import linearised, places
from cardan.questions.torsion.model.torsional_batch import Turning
from cardan.questions.torsion.model.torsional_model import TorsionalModel

from .steady_start import at_rest

STEP = 0.25
"""First step of the joint angles on the way from a straight drive, as a share of them."""

TRIALS = 6
"""Steps tried."""

WIDE = 0.8
"""Largest phase in a step of drives without play: what swings fast in them is hardly excited."""

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
    loose = bool(np.any(turning.model.backlash > 0.0))
    search = _Search(turning, method or (Shooting() if loose else Shooting(reach=WIDE)))
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
