"""What a small disturbance of steady running is multiplied by over a period; turning as a whole apart from it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.maths.arrays import Array
from cardan.maths.periodic.floquet import Coefficients, monodromy, without_direction
from cardan.questions.torsion.model.torsional_balance import slopes
from cardan.questions.torsion.model.torsional_model import TorsionalModel

from .backlash_orbit import Backlashed
from .orbit import Orbit

CHUNK = 64
"""Drives whose periods are integrated at once."""

REAL = 2e-3
"""Imaginary part, over the modulus, up to which a multiplier is real: two of 1 are apart by the root of their error."""

FADED = 20.0
"""What has died out by e to this power over a period leaves no digits to check."""


def multipliers_of(orbit: Orbit, rows: Array) -> tuple[Array, Array, Array]:
    """Return the multipliers of motions, how many were left out of free drives, and the residual of their product.

    orbit (...); rows (b,) of int: which drives, counted through the leading axes.
    Returns values (b, m), complex: the largest first; nan at the end where one is left out; removed (b,) of int;
    residual (b,): ln of their product less the integral of the damping; nan where that says nothing.
    """
    coefficients, duration = linear_motion(orbit, rows), orbit.time.reshape(-1)[rows]
    matrix = monodromy(coefficients, duration)
    residual = _liouville(coefficients, duration, matrix)
    mass, damping, _stiffness = coefficients(np.linspace(0.0, 1.0, 5))
    heavy = np.any(mass != 0.0, axis=(0, 1))
    values, removed = _values(orbit, rows, matrix, heavy)
    return _without_last(values, _unmoved(damping, heavy)), removed, residual


def multipliers_in_pieces(orbit: Orbit, row: int) -> tuple[Array, Array, Array]:
    """Return the same of one motion in pieces; its residual is nan.

    orbit (...); row: which drive, one of those in pieces.
    """
    pieces, alone = orbit.pieces[row], np.asarray([row])
    values, removed = _values(orbit, alone, pieces.monodromy[None], pieces.heavy)
    if not pieces.heavy.all():
        switching = Backlashed(orbit.turning.part(alone))
        time, _weight, x, v, a = (one[:, :1] for one in pieces.points)
        damping = switching.at(pieces.sides, pieces.omega * time, x, v, a)[0].damping
        values = _without_last(values, _unmoved(damping.swapaxes(0, 1), pieces.heavy))
    return values, removed, np.full(1, np.nan)


def linear_motion(orbit: Orbit, rows: Array) -> Coefficients:
    """Return mass, damping and stiffness of the free coordinates about motions, over the share of their period.

    orbit (...); rows (b,) of int: which drives, counted through the leading axes.
    """
    drives, backward = orbit.drives(rows), (orbit.speed.reshape(-1)[rows] < 0.0)[:, None, None]
    first = 0 if drives.free else 1

    def coefficients(share: Array) -> tuple[Array, Array, Array]:
        motion = orbit.of(rows, share * orbit.period)
        if np.any(backward):  # the phase runs backwards where the shaft does
            back = orbit.of(rows, -share * orbit.period)
            motion = tuple(np.where(backward, b, a) for a, b in zip(motion, back, strict=True))
        found = slopes(drives, *motion)
        return found.mass[..., first:], found.damping[..., first:, first:], found.stiffness[..., first:, first:]

    return coefficients


def _values(orbit: Orbit, rows: Array, matrix: Array, heavy: Array) -> tuple[Array, Array]:
    """Return the multipliers of monodromy matrices about motions, and how many were left out of free drives."""
    if not orbit.model.free:
        return values_of(matrix)
    _q, rate, acceleration = (one[:, 0] for one in orbit.of(rows, [0.0]))
    tangent = np.concatenate([rate, acceleration[:, heavy]], axis=-1)
    return values_of(matrix, Turns.of(orbit.drives(rows), orbit.speed.reshape(-1)[rows], tangent))


def _unmoved(damping: Array, heavy: Array) -> Array:
    """Return how many coordinates have neither inertia nor damper: they follow the others at once, array (b,).

    damping (b, p, R, R): at moments of the motion; a damper that lets go at any of them holds nothing back over a
    period.
    heavy (R,) of bool.
    """
    light = np.flatnonzero(~heavy)
    if not light.size:
        return np.zeros(len(damping), dtype=int)
    rank = np.linalg.matrix_rank(damping[..., light[:, None], light])
    found: Array = light.size - np.min(rank, axis=-1)
    return found


def _without_last(values: Array, count: Array) -> Array:
    """Return multipliers (b, m), the largest first, without so many of the smallest."""
    last = np.sum(np.isfinite(values), axis=-1) - count
    return np.where(np.arange(values.shape[-1]) < last[:, None], values, np.nan)


@dataclass(frozen=True, eq=False, kw_only=True)
class Turns:
    """What turns free drives as a whole."""

    tangent: Array  # (b, m): disturbances by a shift in time
    drifts: Array  # (b,) of bool: whether any speed is as good as any other

    @classmethod
    def of(cls, drives: TorsionalModel, speed: Array, tangent: Array) -> Turns:
        """Return what turns drives (b,), their torques ready for moments in a second axis, at speeds (b,) [rad/s]."""
        return cls(tangent=tangent, drifts=drifting(drives, speed))

    def part(self, rows: slice) -> Turns:
        """Return that of some of the drives."""
        return Turns(tangent=self.tangent[rows], drifts=self.drifts[rows])


def values_of(matrix: Array, turns: Turns | None = None) -> tuple[Array, Array]:
    """Return the multipliers of monodromy matrices, the largest first, and how many were left out of free drives.

    matrix (b, m, m).
    turns: of free drives: a shift in time is left out, and where any speed is as good as any other the drift to one
    too.
    """
    removed = np.zeros(len(matrix), dtype=int)
    if turns is None:
        values: Array = np.linalg.eigvals(matrix)
    else:
        values = np.linalg.eigvals(without_direction(matrix, turns.tangent)).astype(complex)
        values[turns.drifts, :-1] = vibrating(values[turns.drifts], 1)
        values[turns.drifts, -1] = np.nan
        removed += 1 + turns.drifts
    size = np.where(np.isfinite(values), np.abs(values), -1.0)
    return np.take_along_axis(values, np.argsort(-size, axis=-1, kind="stable"), axis=-1), removed


def drifting(drives: TorsionalModel, speed: Array) -> Array:
    """Tell which free drives may turn at any speed: no drag and no torque of theirs changes with it, array (b,).

    drives (b,): with torques ready for moments in a second axis; speed (b,) [rad/s].
    """
    governed = np.any(drives.ground_damping != 0.0, axis=-1)
    here = speed[:, None]
    for torque in drives.torques:
        governed = governed | np.any(torque.law.at(np.zeros(()), 0.0 * here, here)[2] != 0.0, axis=-1)
    return ~governed


def vibrating(values: Array, count: int) -> Array:
    """Return the multipliers of free drives without those of turning as a whole, array (b, m-count), in no order.

    values (b, m).
    count: how many to leave out: one, the drift to another speed, where a shift in time is left out already, else two.
    Left out are the real ones nearest to 1. Amid a resonance a drift and vibration are one: what grows there beside
    them is judged.
    """
    far = np.where(np.abs(values.imag) <= REAL * np.abs(values), np.abs(values - 1.0), 1.0 + np.abs(values))
    found: Array = np.take_along_axis(values, np.argsort(far, axis=-1, kind="stable")[:, count:], axis=-1)
    return found


def _liouville(coefficients: Coefficients, duration: Array, matrix: Array) -> Array:
    """Return ln det of the monodromy matrix plus the integral of tr C/M; nan where that says nothing.

    So where a coordinate has no mass, and where what is left of a disturbance is smaller than rounding.
    """
    share = (np.arange(128) + 0.5) / 128
    mass, damping, _stiffness = coefficients(share)
    if np.any(mass == 0.0):
        return np.full(len(duration), np.nan)
    lost = np.mean(np.einsum("bprr,bpr->bp", damping, 1.0 / mass), axis=-1) * duration
    with np.errstate(divide="ignore"):
        return np.where(lost < FADED, np.linalg.slogdet(matrix)[1] + lost, np.nan)
