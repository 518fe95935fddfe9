"""The classical joint-after-joint recurrence in any number of digits: Book (17)-(22), (32), (33), (38), no matrices."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import mpmath as mp

DIGITS = 40


def driven(theta: Any, joint_angle: Any) -> Any:
    """Return the driven angle of a joint, unwrapped."""
    c, cos, sin = mp.cos(joint_angle), mp.cos(theta), mp.sin(theta)
    return theta + mp.atan2((1 - c) * sin * cos, c * cos**2 + sin**2)


def output(
    joint_angle: Sequence[float],
    plane_twist: Sequence[float],
    yoke_angle: Sequence[float],
    start_phase: float,
    angle: float,
    speed: float = 1.0,
    acceleration: float = 0.0,
) -> tuple[float, float, float]:
    """Return output angle, speed ratio and acceleration of a chain; every number is taken as exactly given."""
    with mp.workdps(DIGITS):
        turns = [mp.mpf(0)] + [mp.pi / 2 - mp.mpf(g) - mp.mpf(b) for g, b in zip(yoke_angle, plane_twist, strict=True)]
        at, rest = mp.mpf(start_phase) + mp.mpf(angle), mp.mpf(start_phase)
        omega, epsilon = mp.mpf(speed), mp.mpf(acceleration)
        for alpha, turn in zip(map(mp.mpf, joint_angle), turns, strict=True):
            at, rest = at + turn, rest + turn
            c, s = mp.cos(alpha), mp.sin(alpha)
            ratio = c / (1 - (s * mp.cos(at)) ** 2)
            epsilon = ratio * epsilon - ratio**2 * omega**2 * s * mp.tan(alpha) * mp.sin(2 * at)
            omega *= ratio
            at, rest = driven(at, alpha), driven(rest, alpha)
        return float(at - rest), float(omega / mp.mpf(speed)), float(epsilon)


def largest_ratio(joint_angle: Sequence[float], plane_twist: Sequence[float], yoke_angle: Sequence[float]) -> Any:
    """Return the largest speed ratio of a chain, a number of many digits.

    Notes
    -----
    The larger root x of x + 1/x = trace(WᵀW) with W = D_n Rot(μ_n) … D_1, D_i = diag(√c_i, 1/√c_i).
    """
    with mp.workdps(DIGITS):
        whole = mp.eye(2)
        for i, alpha in enumerate(map(mp.mpf, joint_angle)):
            mu = mp.pi / 2 - mp.mpf(yoke_angle[i - 1]) - mp.mpf(plane_twist[i - 1]) if i else mp.mpf(0)
            root = mp.sqrt(mp.cos(alpha))
            turned = mp.matrix([[mp.cos(mu), -mp.sin(mu)], [mp.sin(mu), mp.cos(mu)]])
            whole = mp.matrix([[root, 0], [0, 1 / root]]) * turned * whole
        half = sum(whole[i, j] ** 2 for i in range(2) for j in range(2)) / 2
        return half + mp.sqrt(half**2 - 1)
