"""Joints whose links share the torque: each link would turn as a Hooke joint, all together turn by the mean of them."""

from __future__ import annotations

from cardan.maths.arrays import Array, complex_of, namespace, unit_complex
from cardan.maths.kernel import mobius


def course(angle: Array, tau: Array, places: int) -> tuple[Array, Array, Array]:
    """Return how far links at equal angles run ahead together, with two derivatives.

    angle (...) [rad]: θ of the first link, from the plane of the shafts.
    tau (...): τ of the map of a single link, tan θ' = (1 + τ)/(1 - τ) tan θ.
    places: how many different places the links take within half a turn.
    Returns angle_error, ratio, slope (...) [rad, 1, 1/rad]: T - θ, T' and T''.
    A link asks for Σ τ^k sin(2kθ)/k; of the mean over N places only the orders that N divides are left,
    -arg(1 - τ^N e^(2iNθ))/N: the lead of one joint with τ^N, N times as fast and N times smaller.

    One place is a Hooke joint:

    >>> import numpy as np
    >>> angle_error, ratio, _slope = course(np.asarray(0.5), np.tan(0.2) ** 2, 1)
    >>> print(f"{angle_error:.9f} {np.tan(0.5 + angle_error) / np.tan(0.5) * np.cos(0.4):.9f} {ratio:.6f}")
    0.035347562 1.000000000 1.042857
    """
    xp = namespace(angle, tau)
    power = xp.asarray(tau, dtype=xp.float64) ** places
    root = xp.sqrt(1.0 - power * power)
    pair = complex_of(1.0 / root, xp), complex_of(-power / root, xp)
    angle_error, ratio, slope = mobius.course(pair, unit_complex(2.0 * places * angle))
    return angle_error / places, ratio, places * slope


def places(links: int) -> int:
    """Return how many different places links at equal angles take within half a turn: two opposite ones take one.

    >>> places(6), places(3)
    (3, 3)
    """
    return links // 2 if links % 2 == 0 else links
