"""Stiffness of a laminate in its plane, and the stresses of its plies."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from cardan.maths.arrays import Array, ArrayLike


class PlyStiffness(NamedTuple):
    """Moduli of a ply in its own axes [Pa] and Poisson's ratio ν_12."""

    along: float
    across: float
    shear: float
    poisson: float


def laminate_moduli(angles: ArrayLike, thickness: ArrayLike, ply: PlyStiffness) -> tuple[float, float, float]:
    """Return E_x, E_y and G_xy of a laminate [Pa].

    angles (k,) [rad]: of the plies, from the x axis to their fibres; thickness (k,) [m].
    Membrane stiffness Ā = Σ t Q̄(θ)/Σ t; E_x = 1/(Ā⁻¹)_11, E_y = 1/(Ā⁻¹)_22, G_xy = 1/(Ā⁻¹)_66: an unsymmetrical stack
    is held flat, as in a closed tube.

    >>> ply = PlyStiffness(135e9, 10e9, 5e9, 0.3)
    >>> [round(one / 1e9, 3) for one in laminate_moduli(np.radians([0, 45, -45, 90]), np.ones(4), ply)]
    [52.401, 52.401, 19.992]
    """
    weight = np.asarray(thickness, dtype=float)
    whole = np.sum([t * _turned(ply, a) for t, a in zip(weight, np.asarray(angles), strict=True)], axis=0)
    soft = np.linalg.inv(whole / np.sum(weight))
    return float(1.0 / soft[0, 0]), float(1.0 / soft[1, 1]), float(1.0 / soft[2, 2])


def ply_stresses(angles: ArrayLike, thickness: ArrayLike, ply: PlyStiffness) -> Array:
    """Return the stresses of the plies of a laminate by the forces in its plane, array (k, 3, 3) [1/m].

    angles (k,) [rad], thickness (k,) [m]: as of `laminate_moduli`.
    Along the fibres, across them and in shear of each ply, σ_1, σ_2, τ_12, by a unit of N_x, N_y and N_xy [N/m]:
    strains of the laminate held flat, ε = (Σ t Q̄)⁻¹ N, turned into the axes of the ply.

    >>> ply = PlyStiffness(135e9, 10e9, 5e9, 0.3)
    >>> shear = ply_stresses(np.radians([45, -45]), [1e-3, 1e-3], ply)[:, :, 2]
    >>> print(shear.round(1))
    [[ 949.6  -50.4    0. ]
     [-949.6   50.4    0. ]]
    """
    sizes = np.asarray(thickness, dtype=float)
    turns = np.asarray(angles, dtype=float)
    whole = np.sum([t * _turned(ply, a) for t, a in zip(sizes, turns, strict=True)], axis=0)
    strains = np.linalg.inv(whole)
    return np.stack([_own(ply) @ _strain(a) @ strains for a in turns])


def _turned(ply: PlyStiffness, angle: float) -> Array:
    """Return the stiffness Q̄ of a ply turned by an angle, for strains (ε_x, ε_y, γ_xy)."""
    found: Array = _strain(angle).T @ _own(ply) @ _strain(angle)
    return found


def _own(ply: PlyStiffness) -> Array:
    """Return the stiffness Q of a ply in its own axes."""
    below = 1.0 - ply.poisson**2 * ply.across / ply.along
    return np.asarray(
        [
            [ply.along / below, ply.poisson * ply.across / below, 0.0],
            [ply.poisson * ply.across / below, ply.across / below, 0.0],
            [0.0, 0.0, ply.shear],
        ]
    )


def _strain(angle: float) -> Array:
    """Return what turns strains of the laminate into the axes of a ply."""
    c, s = np.cos(angle), np.sin(angle)
    return np.asarray([[c * c, s * s, s * c], [s * s, c * c, -s * c], [-2.0 * s * c, 2.0 * s * c, c * c - s * s]])
