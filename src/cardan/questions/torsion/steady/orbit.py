"""Periodic motion of torsional models, at any angle of the shaft."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.curves.waves import series_at
from cardan.maths.periodic.switching_orbit import Pieces
from cardan.questions.torsion.model.torsional_batch import Turning, chosen
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
