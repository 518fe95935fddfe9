"""Steady vibration of a torsional line with straight joints under a torque of one frequency: linear, at many speeds."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.maths.arrays import Array, ArrayLike

from .torsional_model import TorsionalModel


@dataclass(frozen=True, eq=False, kw_only=True)
class StraightWaves:
    """Vibration x e^(iωt) of a straight line.

    Attributes
    ----------
    angle : complex array (..., N) [rad]
        Of every station.
    torque : complex array (..., E) [N·m]
        Of every element.
    """

    angle: Array
    torque: Array


def straight_waves(model: TorsionalModel, station: int, torque: ArrayLike, omega: ArrayLike) -> StraightWaves:
    """Return how a line vibrates under a harmonic torque on one station, all joints straight and all backlash closed.

    Parameters
    ----------
    model : TorsionalModel (...)
        Where its input speed is forced, the first station stands still.
    station : int
        On which the torque acts.
    torque : complex array (...) [N·m]
        Its amplitude and phase.
    omega : array (...) [rad/s]
        Its frequency, not 0.

    Returns
    -------
    StraightWaves
        Not finite at a natural frequency without damping.

    Notes
    -----
    (K + iωC - ω²M) x = f with complex stiffness c(1 + iη) + iωb of the elements and damping iωb_g against the housing.

    Examples
    --------
    >>> from .torsional_model import torsional_line
    >>> line = torsional_line([[1.5, 0.05, 0.8]], stiffness=[[8000.0, 4000.0]], loss_factor=[[0.02, 0.05]])
    >>> np.abs(straight_waves(line, 0, 1.0, 60.0).torque)
    array([1.17886063, 1.1584548 ])
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
