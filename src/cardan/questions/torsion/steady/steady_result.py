"""What is known of steady running: torques and speeds by orders, extremes, and how well the equations hold."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.curves.extremes import extremes, sampled_series
from cardan.maths.periodic.harmonics import Status
from cardan.maths.periodic.switching_orbit import Pieces
from cardan.questions.torsion.model.torsional_balance import balance, element_torques, places, power
from cardan.questions.torsion.model.torsional_model import TorsionalModel

from .orbit import Backlashed, Orbit


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


# Orders, extremes and residuals of periodic motion: from Fourier sums, and from smooth pieces between contacts.

CHUNK = 256
"""Drives looked at at once."""

INSIDE = 16
"""Places of a step of collocation at which extremes are looked for."""

ROUNDS = 3
"""Times that these get closer."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Found:
    """What is read off motions, drives in one axis."""

    # torque, speed, drive (B, E | N | 1, K+1), complex: coefficients of element torques, station speeds and the torque
    # that the input needs
    torque: Array
    speed: Array  # (B, E | N | 1, K+1), complex
    drive: Array  # (B, E | N | 1, K+1), complex
    lowest: Array  # (B, E) [N·m]
    highest: Array  # (B, E) [N·m]
    residual: Array  # (B,)
    power_residual: Array  # (B,)


@dataclass(frozen=True, eq=False, kw_only=True)
class _Curves:
    """Curves of drives at moments: torque (b, p, E), speed (b, p, N), the others (b, p)."""

    torque: Array
    speed: Array
    drive: Array
    left: Array
    brought: Array
    outer: Array


def _curves(drives: TorsionalModel, motion: tuple[Array, Array, Array], force: Array) -> _Curves:
    q, rate, _acceleration = motion
    left = balance(drives, *motion)
    given, lost = power(drives, q, rate)
    if drives.free:
        left[..., 0] -= force
        drive = force + 0.0 * given
    else:
        drive = left[..., 0]
        left = left[..., 1:]
    return _Curves(
        torque=element_torques(drives, q, rate),
        speed=places(drives, q).first * rate[..., list(drives.coordinate)],
        drive=drive,
        left=np.max(np.abs(left), axis=-1, initial=0.0),
        brought=given + drive * rate[..., 0] - lost,
        outer=np.abs(given) / np.mean(np.abs(rate[..., 0]), axis=-1, keepdims=True),
    )


def read_off(orbit: Orbit, count: int) -> Found:
    """Return orders 0 … ``count`` of the base, extremes and residuals of motions. orbit (...); count: K."""
    harmonics = orbit.coefficient.shape[-1]
    samples = max(8 * (harmonics + 1), 2 * count + 2)
    angle = orbit.period * np.arange(samples) / samples
    parts = [
        _sampled(orbit, np.arange(first, min(first + CHUNK, orbit.count)), angle, count)
        for first in range(0, orbit.count, CHUNK)
    ]
    found = Found(**{one.name: np.concatenate([getattr(p, one.name) for p in parts]) for one in fields(Found)})
    for row, pieces in orbit.pieces.items():
        alone = _of_pieces(orbit, row, pieces, count)
        for one in fields(Found):
            getattr(found, one.name)[row] = getattr(alone, one.name)[0]
    return found


def _sampled(orbit: Orbit, rows: Array, angle: Array, count: int) -> Found:
    curves = _curves(orbit.drives(rows), orbit.of(rows, angle), orbit.force.reshape(-1)[rows][:, None])
    omega = np.abs(orbit.speed.reshape(-1)[rows])
    largest = np.maximum(np.max(np.abs(curves.torque), axis=(1, 2), initial=0.0), np.max(curves.outer, axis=1))
    largest = np.where(largest > 0.0, largest, 1.0)
    torque = sampled_series(curves.torque.swapaxes(1, 2))
    lowest, highest = extremes(torque)
    return Found(
        torque=torque[..., : count + 1],
        speed=sampled_series(curves.speed.swapaxes(1, 2))[..., : count + 1],
        drive=sampled_series(curves.drive[:, None])[..., : count + 1],
        lowest=lowest,
        highest=highest,
        residual=np.max(curves.left, axis=1) / largest,
        power_residual=np.abs(np.mean(curves.brought, axis=1)) / (largest * omega),
    )


def _of_pieces(orbit: Orbit, row: int, pieces: Pieces, count: int) -> Found:
    """Return the same of one motion in pieces: integrals by the points of its steps, which end at every contact."""
    switching = Backlashed(orbit.turning.part(np.asarray([row])))
    held = switching.held(pieces.sides)
    time, weight, x, v, a = pieces.points
    force = np.asarray(pieces.force)

    def curves(when: Array, x: Array, v: Array, a: Array) -> _Curves:
        return _curves(held, switching.motion(pieces.omega * when, x, v, a), force)

    here = curves(time, x, v, a)
    turn = np.exp(-1j * pieces.omega * time[..., None] * np.arange(count + 1)) * weight[..., None] * 2.0
    turn[..., 0] *= 0.5
    turn /= pieces.duration

    def orders(values: Array) -> Array:
        return np.einsum("nsk,nsc->ck", turn, values)[None]

    lowest, highest = _ends(pieces, switching, held)
    n = len(pieces.inner)
    middle = np.repeat(np.arange(n), 6)
    since = np.tile((np.arange(6) + 0.5) / 6, n) * np.diff(pieces.time)[middle]
    between = (one.reshape(n, 6, -1) for one in pieces.inside(middle, since))
    check = curves((pieces.time[middle] + since).reshape(n, 6), *between)
    largest = max(float(np.max(np.abs(here.torque), initial=0.0)), float(np.max(here.outer))) or 1.0
    missed = abs(float(np.sum(weight * here.brought))) / pieces.duration
    return Found(
        torque=orders(here.torque),
        speed=orders(here.speed),
        drive=orders(here.drive[..., None]),
        lowest=lowest[None],
        highest=highest[None],
        residual=np.asarray([np.max(check.left) / largest]),
        power_residual=np.asarray([missed / (largest * abs(float(switching.turning.speed[0])))]),
    )


def _ends(pieces: Pieces, switching: Backlashed, held: TorsionalModel) -> tuple[Array, Array]:
    """Return the lowest and highest torque of every element (E,); a jump at a contact counts with both its ends."""
    n = len(pieces.inner)
    length = np.diff(pieces.time)

    def torques(step: Array, share: Array) -> Array:
        """Return torques at shares (b, p) of steps (b,), array (b, p, E)."""
        flat = np.repeat(step, share.shape[-1])
        since = (share * length[step][:, None]).ravel()
        x, v, a = (one.reshape(*share.shape, -1) for one in pieces.inside(flat, since))
        when = (pieces.time[flat] + since).reshape(share.shape)
        chosen = switching.held(pieces.sides[step])
        q, rate, _acceleration = switching.motion(pieces.omega * when, x, v, a)
        return element_torques(chosen, q, rate)

    grid = np.broadcast_to(np.linspace(0.0, 1.0, INSIDE + 1), (n, INSIDE + 1))
    values = torques(np.arange(n), grid)
    found = []
    for side in (-1.0, 1.0):
        ends = []
        for e in range(values.shape[-1]):
            step, place = np.unravel_index(int(np.argmax(side * values[..., e])), values.shape[:2])
            best, centre, width = side * values[step, place, e], grid[step, place], 1.0 / INSIDE
            for _round in range(ROUNDS):
                share = np.clip(centre + width * np.linspace(-1.0, 1.0, 2 * INSIDE + 1), 0.0, 1.0)
                closer = side * torques(np.asarray([step]), share[None])[0, :, e]
                k = int(np.argmax(closer))
                best, centre, width = max(best, closer[k]), share[k], width / INSIDE
            ends.append(side * best)
        found.append(np.asarray(ends))
    return found[0], found[1]
