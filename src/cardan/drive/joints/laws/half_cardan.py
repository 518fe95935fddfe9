"""Half-cardans: couplings without swing axes, rigid (bell, gear) or elastic (discs, bushes, tyres).

Each pair of opposite contacts is a Hooke joint of its own: the face across one diameter of one half stays at right
angles to the diameter of the other half. N pairs stand at π/N from each other and ask for N different outputs at once.
Rigid pairs can have only one of them, the others need play; elastic ones share, and turn by the mean, which is even but
for the order 2N of the turn.
"""

from __future__ import annotations

import math

from cardan.maths.arrays import Array, ArrayLike, floats, namespace, unit_complex
from cardan.maths.kernel import mobius

from . import shared_turn


def demands(angle: ArrayLike, joint_angle: ArrayLike, pairs: int) -> Array:
    """Return how far ahead each pair of contacts alone would have the output run.

    angle (...) [rad]: input angle φ1; joint_angle (...) [rad]: bend α in [0, π/2); pairs: pairs of opposite contacts N.
    Returns (..., N) [rad].
    The law of the Hooke joint at φ1 + kπ/N.
    """
    phi, alpha = floats(angle, joint_angle)
    xp = namespace(phi, alpha)
    turned = phi[..., None] + xp.arange(pairs, dtype=xp.float64) * (math.pi / pairs)
    return mobius.angle_error(mobius.hooke(alpha[..., None]), unit_complex(2.0 * turned))


def deviation(angle: ArrayLike, joint_angle: ArrayLike, pairs: int) -> Array:
    """Return how far the output runs ahead where equal elastic pairs share the torque: the mean of `demands`.

    Parameters
    ----------
    angle : array (...) [rad]
        Input angle φ1.
    joint_angle : array (...) [rad]
        Bend α in [0, π/2).
    pairs : int
        Pairs of opposite contacts N; one is a Hooke joint.

    Returns
    -------
    array (...) [rad]

    Notes
    -----
    -arg(1 - τ^N w^N)/N with τ = tan²(α/2), w = e^(2iφ1): of the series Σ τ^k sin(2kφ)/k of the Hooke joint, the mean
    over N places keeps the orders k = N, 2N ... alone; at most arcsin(τ^N)/N.

    Examples
    --------
    >>> print(f"{deviation(math.pi / 8, math.radians(10.0), 2):.2e}")
    2.93e-05
    """
    phi, alpha = floats(angle, joint_angle)
    return shared_turn.course(phi, _tau(alpha), pairs)[0]


def ratio(angle: ArrayLike, joint_angle: ArrayLike, pairs: int) -> Array:
    """Return the speed ratio where equal elastic pairs share the torque.

    The derivative of `deviation` + φ1.
    """
    phi, alpha = floats(angle, joint_angle)
    return shared_turn.course(phi, _tau(alpha), pairs)[1]


def _tau(joint_angle: Array) -> Array:
    return namespace(joint_angle).tan(0.5 * joint_angle) ** 2


def play(joint_angle: ArrayLike, pairs: int) -> Array:
    """Return the play that a rigid half-cardan needs between its pairs to turn at a bend.

    Parameters
    ----------
    joint_angle : array (...) [rad]
        Bend α in [0, π/2).
    pairs : int
        Pairs of opposite contacts N.

    Returns
    -------
    array (...) [rad]
        Greatest difference of two of `demands` over a turn; for more than two pairs a bound that many pairs come to.

    Notes
    -----
    Two pairs differ most at 45°, by 2 arctan τ = arctan(½ sin α tan α); any number at most by twice the greatest lead,
    2 arcsin τ, τ = tan²(α/2).

    Examples
    --------
    >>> print(f"{play(math.radians(5.0), 2):.6f}")
    0.003813
    """
    (alpha,) = floats(joint_angle)
    xp = namespace(alpha)
    if pairs == 1:
        return 0.0 * alpha
    tau = _tau(alpha)
    return 2.0 * (xp.atan(tau) if pairs == 2 else xp.asin(tau))
