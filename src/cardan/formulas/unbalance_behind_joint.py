"""Which forces does an unbalance behind a joint make? The shaft turns unevenly, so it shakes with odd orders."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from cardan.errors import Problem, check
from cardan.maths.arrays import Array, ArrayLike
from cardan.texts import _


@dataclass(frozen=True, eq=False, kw_only=True)
class UnbalanceBehindJoint:
    """Force of an unbalance on a shaft that a Hooke joint drives, in the plane across that shaft."""

    joint_angle: Array  # (...) [rad]: α of the joint, or of the one that the joints before the shaft are equal to
    phase: Array  # (...) [rad]: ψ, angle of the driving yoke from the plane of the shafts where φ_1 is 0
    order: Array  # (N,) of int: n by the turns of the input, odd; negative ones run backward
    # (..., N), complex: over m e Ω²: force = m e Ω² Σ F_n e^(inφ_1), the unbalance along the first axis at φ_1 = 0, Ω
    # the input speed
    force: Array
    # (...): what the squares of the vector's orders, those given and the next ones, miss of their sum, 1
    residual: Array

    @property
    def size(self) -> Array:
        """Amplitudes of the orders over m e Ω², array (..., N)."""
        return np.abs(self.force)


def unbalance_behind_joint(joint_angle: ArrayLike, phase: ArrayLike = 0.0, *, reach: int = 9) -> UnbalanceBehindJoint:
    """Return the orders of the force of an unbalance behind a Hooke joint.

    Parameters
    ----------
    joint_angle : array (...) [rad]
        α in [0, π/2).
    phase : array (...) [rad]
        ψ.
    reach : int
        Orders from -reach to reach.

    Returns
    -------
    UnbalanceBehindJoint

    Raises
    ------
    InputError
        A joint angle out of range.

    Notes
    -----
    Force -m e Ω² d²e^(iφ_2)/dφ_1² at an even input speed: F_n = n² E_n with E_n of
    `root_of_joint.vector_orders`, exact. To first order τ = tan²(α/2): 9τ/2 at three times forward, τ/2
    backward.

    Examples
    --------
    >>> from cardan.units import deg
    >>> found = unbalance_behind_joint(20 * deg, reach=3)
    >>> found.order, found.size.round(5)
    (array([-3, -1,  1,  3]), array([0.00109, 0.01555, 0.99976, 0.13986]))
    """
    alpha, psi = np.broadcast_arrays(np.asarray(joint_angle, dtype=float), np.asarray(phase, dtype=float))
    problems = []
    if not np.all((alpha >= 0.0) & (alpha < 0.5 * np.pi)):
        problems.append(Problem("joint_angle", _("needs to be at least 0 and below 90°"), "out_of_range"))
    if not np.all(np.isfinite(psi)):
        problems.append(Problem("phase", _("needs to be finite"), "not_finite"))
    if reach < 1:
        problems.append(Problem("reach", _("needs to be at least 1"), "out_of_range"))
    check(problems)
    tau = np.tan(0.5 * alpha) ** 2
    order = np.arange(-reach, reach + 1)
    order = order[order % 2 == 1]
    angle_error = np.arctan2(tau * np.sin(2.0 * psi), 1.0 - tau * np.cos(2.0 * psi))  # T(ψ) - ψ
    turned = np.exp(1j * (order * psi[..., None] - (psi + angle_error)[..., None]))
    more = vector_orders(tau, np.arange(-2 * reach - 41, 2 * reach + 42))
    return UnbalanceBehindJoint(
        joint_angle=alpha,
        phase=psi,
        order=order,
        force=order**2 * vector_orders(tau, order) * turned,
        residual=np.abs(np.sum(more**2, axis=-1) - 1.0),
    )


# A unit vector that turns with the output of a Hooke joint: its Fourier sum over the input angle, in closed form.
#
# The joint maps w = e^(2iθ) to w' = (w - τ)/(1 - τw); the vector is e^(iθ') = √w', a root of that map.


def vector_orders(tau: ArrayLike, order: ArrayLike) -> Array:
    """Return the coefficients E_n of e^(iθ') = Σ E_n e^(inθ).

    tau (...): τ = tan²(α/2) in [0, 1).
    order (N,) of int: n; even ones are nought.
    Returns (..., N): real; θ counts from the plane of the shafts. Their squares add up to 1.
    e^(iθ') = e^(iθ) (1 - τ/w)^(1/2) (1 - τw)^(-1/2), the product of two binomial series; with n = 1 + 2p

    E_n = (1/2)_p/p! τ^p F(-1/2, p + 1/2; p + 1; τ²) for p ≥ 0,

    E_n = (-1/2)_q/q! τ^q F(q - 1/2, 1/2; q + 1; τ²) for q = -p > 0.
    """
    t = np.asarray(tau, dtype=float)
    found = np.zeros((*t.shape, len(np.atleast_1d(order))))
    for k, n in enumerate(np.atleast_1d(order)):
        p = (int(n) - 1) // 2
        if n % 2 == 0:
            continue
        if p >= 0:
            found[..., k] = _rising(0.5, p) * t**p * scipy.special.hyp2f1(-0.5, p + 0.5, p + 1.0, t * t)
        else:
            q = -p
            found[..., k] = _rising(-0.5, q) * t**q * scipy.special.hyp2f1(q - 0.5, 0.5, q + 1.0, t * t)
    return found


def _rising(start: float, count: int) -> float:
    """Return start (start + 1) … (start + count - 1)/count!."""
    steps = np.arange(count)
    return float(np.prod((start + steps) / (steps + 1.0)))
