"""Steady vibration of a torsional line with straight joints under a torque of one frequency: linear, at many speeds."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.maths.arrays import Array, ArrayLike

from .torsional_model import TorsionalModel


@dataclass(frozen=True, eq=False, kw_only=True)
class StraightWaves:
    """Vibration x e^(iωt) of a straight line."""

    angle: Array  # (..., N) [rad], complex: of every station
    torque: Array  # (..., E) [N·m], complex: of every element


def straight_waves(model: TorsionalModel, station: int, torque: ArrayLike, omega: ArrayLike) -> StraightWaves:
    """Return how a line vibrates under a harmonic torque on one station, all joints straight and all backlash closed.

    model (...): where its input speed is forced, the first station stands still; station: on which the torque acts.
    torque (...) [N·m], complex: its amplitude and phase; omega (...) [rad/s]: its frequency, not 0.
    Returns StraightWaves: not finite at a natural frequency without damping.
    (K + iωC - ω²M) x = f with complex stiffness c(1 + iη) + iωb of the elements and damping iωb_g against the housing.
    """
    w = np.asarray(omega, dtype=float)[..., None]
    carried = model.stiffness * (1.0 + 1j * model.loss_factor) + 1j * w * model.damping
    own = 1j * w * model.ground_damping - w**2 * model.inertia
    outer = np.broadcast_shapes(carried.shape[:-1], own.shape[:-1], np.shape(torque))
    rank, first = model.coordinates, 0 if model.free else 1
    matrix = np.zeros((*outer, rank, rank), dtype=complex)
    for k, r in enumerate(model.coordinate):
        matrix[..., r, r] += own[..., k]
    for e, (one, two) in enumerate(model.elements):
        a, b = model.coordinate[one], model.coordinate[two]
        for r, s, sign in ((a, a, 1.0), (b, b, 1.0), (a, b, -1.0), (b, a, -1.0)):
            matrix[..., r, s] += sign * carried[..., e]
    load = np.zeros((*outer, rank, 1), dtype=complex)
    load[..., model.coordinate[station], 0] = torque
    moved = np.zeros((*outer, rank), dtype=complex)
    with np.errstate(all="ignore"):
        try:
            moved[..., first:] = np.linalg.solve(matrix[..., first:, first:], load[..., first:, :])[..., 0]
        except np.linalg.LinAlgError:
            moved[..., first:] = np.inf
    angle = moved[..., list(model.coordinate)]
    heads, tails = [a for a, _b in model.elements], [b for _a, b in model.elements]
    return StraightWaves(angle=angle, torque=carried * (angle[..., heads] - angle[..., tails]))
