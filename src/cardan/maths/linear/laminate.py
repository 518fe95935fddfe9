"""Stiffness of a laminate in its plane."""

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


def _turned(ply: PlyStiffness, angle: float) -> Array:
    """Return the stiffness Q̄ of a ply turned by an angle, for strains (ε_x, ε_y, γ_xy)."""
    below = 1.0 - ply.poisson**2 * ply.across / ply.along
    q = np.asarray(
        [
            [ply.along / below, ply.poisson * ply.across / below, 0.0],
            [ply.poisson * ply.across / below, ply.across / below, 0.0],
            [0.0, 0.0, ply.shear],
        ]
    )
    c, s = np.cos(angle), np.sin(angle)
    strain = np.asarray([[c * c, s * s, s * c], [s * s, c * c, -s * c], [-2.0 * s * c, 2.0 * s * c, c * c - s * s]])
    return strain.T @ q @ strain
