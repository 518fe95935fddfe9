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
    """Curves over the shaft angle by their orders: x = mean + Σ amplitude_ν cos(νφ + phase_ν).

    Attributes
    ----------
    mean : array (..., c)
        Of every curve.
    amplitude, phase : arrays (..., c, K) [as the curve, rad]
        Of every order.
    """

    mean: Array
    amplitude: Array
    phase: Array


@dataclass(frozen=True, eq=False, kw_only=True)
class Traces:
    """Curves over the shaft angle.

    Attributes
    ----------
    angle : array (p,) [rad]
        φ = Ωt.
    station_angle, station_speed : arrays (..., p, N) [rad, rad/s]
    torque : array (..., p, E) [N·m]
        Of the elements.
    """

    angle: Array
    station_angle: Array
    station_speed: Array
    torque: Array


@dataclass(frozen=True, eq=False, kw_only=True)
class SteadyResponse:
    """Steady running of torsional models; leading axes (...) are those of the drives and speeds.

    Attributes
    ----------
    orbit : Orbit
        The motion itself.
    order : array (K,)
        Orders of the shaft: multiples of 2π over the period.
    torque : Orders (..., E) [N·m]
        Of the elements.
    torque_lowest, torque_highest : arrays (..., E) [N·m]
        True extremes over a period.
    station_speed : Orders (..., N) [rad/s]
    drive_torque : Orders (..., 1) [N·m]
        What the input needs on the first station, beside the torques of the model: to turn at exactly its speed, or,
        where the drive is free, the constant torque that keeps the mean speed.
    status : array of int (...)
        `cardan.maths.periodic.harmonics.Status`; results are nan where no motion was found.
    residual : array (...)
        By how much the equations of motion fail to hold, at moments between those the solution was made from, over
        the largest torque.
    power_residual : array (...)
        What the power balance of a period misses, over the power that flows.
    stable : array of bool (...) or None
        Whether small disturbances die out; `run_stability.floquet` says more. None where it was not asked.
    """

    orbit: Orbit
    order: Array
    torque: Orders
    torque_lowest: Array
    torque_highest: Array
    station_speed: Orders
    drive_torque: Orders
    status: Array
    residual: Array
    power_residual: Array
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
