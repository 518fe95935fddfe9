"""What is known of steady running: torques and speeds by orders, extremes, and how well the equations hold."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.periodic.harmonics import Status
from cardan.questions.torsion.model.torsional_balance import element_torques, places
from cardan.questions.torsion.model.torsional_model import TorsionalModel

from .orbit import Orbit


@dataclass(frozen=True, eq=False, kw_only=True)
class Orders:
    """Curves over the shaft angle by their orders: x = mean + Σ amplitude_ν cos(νφ + phase_ν)."""

    mean: Array  # (..., c): of every curve
    amplitude: Array  # amplitude, phase (..., c, K) [as the curve, rad]: of every order
    phase: Array  # (..., c, K) [rad]


@dataclass(frozen=True, eq=False, kw_only=True)
class Traces:
    """Curves over the shaft angle."""

    angle: Array  # (p,) [rad]: φ = Ωt
    station_angle: Array  # (..., p, N) [rad]
    station_speed: Array  # (..., p, N) [rad/s]
    torque: Array  # (..., p, E) [N·m]: of the elements


@dataclass(frozen=True, eq=False, kw_only=True)
class SteadyResponse:
    """Steady running of torsional models; leading axes (...) are those of the drives and speeds."""

    orbit: Orbit  # the motion itself
    order: Array  # (K,): orders of the shaft: multiples of 2π over the period
    torque: Orders  # (..., E) [N·m]: of the elements
    torque_lowest: Array  # torque_lowest, torque_highest (..., E) [N·m]: True extremes over a period
    torque_highest: Array  # (..., E) [N·m]
    station_speed: Orders  # (..., N) [rad/s]
    # (..., 1) [N·m]: what the input needs on the first station, beside the torques of the model: to turn at exactly its
    # speed, or, where the drive is free, the constant torque that keeps the mean speed
    drive_torque: Orders
    status: Array  # (...) of int: `cardan.maths.periodic.harmonics.Status`; results are nan where no motion was found
    # (...): by how much the equations of motion fail to hold, at moments between those the solution was made from, over
    # the largest torque
    residual: Array
    power_residual: Array  # (...): what the power balance of a period misses, over the power that flows
    # (...) of bool: whether small disturbances die out; `run_stability.floquet` says more. None where it was not asked.
    stable: Array | None = None

    @property
    def model(self) -> TorsionalModel:
        """The drives."""
        return self.orbit.model

    @property
    def speed(self) -> Array:
        """Ω of the input or mean speed, array (...) [rad/s]."""
        return self.orbit.speed

    @property
    def period(self) -> float:
        """Shaft angle of a period [rad]."""
        return self.orbit.period

    @property
    def peak_to_peak(self) -> Array:
        """Highest less lowest torque of every element, array (..., E) [N·m]."""
        return self.torque_highest - self.torque_lowest

    @property
    def angle_amplitude(self) -> Array:
        """Amplitude of every station's angle about even rotation, array (..., N, K) [rad]."""
        return self.station_speed.amplitude / np.abs(self.speed[..., None, None] * self.order)

    @property
    def found(self) -> Array:
        """Whether a motion was found, array of bool (...)."""
        return (self.status == Status.CONVERGED) | (self.status == Status.COARSE)

    def at(self, angle: ArrayLike) -> Traces:
        """Return the curves at shaft angles φ (p,) [rad]."""
        where = np.asarray(angle, dtype=float)
        q, rate, _acceleration = self.orbit.of(np.arange(self.orbit.count), where)
        drives = self.orbit.drives(np.arange(self.orbit.count))
        place = places(drives, q)
        speed = place.first * rate[..., list(drives.coordinate)]
        angles, speeds, torques = (
            one.reshape(*self.orbit.angle_error, *one.shape[1:])
            for one in (place.angle, speed, element_torques(drives, q, rate))
        )
        return Traces(angle=where, station_angle=angles, station_speed=speeds, torque=torques)
