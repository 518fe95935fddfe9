"""Kernel: the Möbius pairs of 64 chains at a time; what `cardan.maths.kernel.mobius.partial_products` ends with."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numba import njit

from cardan.maths.arrays import namespace

from .approximations import LARGEST_ANGLE, cosine, joint_angle_cosine, sine, within_half_turn
from .lanes import BYTES, LANES, address, step

BLOCK = 64
"""Chains whose numbers stay in the nearest cache."""

STATE = 4 * BLOCK
"""Numbers of the pairs of a block: real and imaginary parts of a, then of b, a row of `BLOCK` each."""

_RIGHT = 0.5 * math.pi


@njit(nogil=True)
def room(joints: int) -> Any:
    """Return the numbers `pair_block` works in; the first `STATE` of them are its result."""
    return np.empty(STATE + 2 * BLOCK * joints)


def joint(joint_angle: Any, turn: Any, ar: Any, ai: Any, br: Any, bi: Any) -> tuple[Any, Any, Any, Any]:
    """Return the pair of a chain and one more joint.

    (cos²(α/2), -sin²(α/2))/√cos α, with sin²(α/2) = sin²α/(2(1 + cos α)), after a turn by μ.
    """
    xp = namespace(joint_angle)
    mu = within_half_turn(turn)
    c, s = cosine(mu), sine(mu)
    ar, ai = ar * c - ai * s, ar * s + ai * c
    br, bi = br * c - bi * s, br * s + bi * c
    cos, sin = joint_angle_cosine(joint_angle), sine(joint_angle)
    share = 0.5 / ((1.0 + cos) * xp.sqrt(cos))
    p, q = (1.0 + cos) * (1.0 + cos) * share, sin * sin * share
    return p * ar - q * br, p * ai + q * bi, p * br - q * ar, p * bi + q * ai


_joint = step(joint)


@njit(nogil=True, error_model="numpy")
def pair_block(
    joint_angle: Any, plane_twist: Any, yoke_angle: Any, start_phase: Any, first: int, count: int, scratch: Any
) -> None:
    """Put the pairs of chains ``first`` to ``first + count`` at the head of ``scratch``; part of other kernels.

    Unused lanes of the block hold the last chain.
    """
    joints = joint_angle.shape[1]
    for lane in range(BLOCK):
        row = first + min(lane, count - 1)
        for i in range(joints):
            mu = start_phase[row] if i == 0 else _RIGHT - yoke_angle[row, i - 1] - plane_twist[row, i - 1]
            if abs(mu) > LARGEST_ANGLE:
                mu = math.atan2(math.sin(mu), math.cos(mu))
            scratch[STATE + 2 * BLOCK * i + lane] = joint_angle[row, i]
            scratch[STATE + 2 * BLOCK * i + BLOCK + lane] = mu
        scratch[lane] = 1.0
        for part in range(1, 4):
            scratch[part * BLOCK + lane] = 0.0
    begin = address(scratch)
    for group in range((count + LANES - 1) // LANES):
        ar = begin + BYTES * group
        ai = ar + 8 * BLOCK
        br = ai + 8 * BLOCK
        bi = br + 8 * BLOCK
        state = (ar, ai, br, bi)
        for i in range(joints):
            angles = ar + 8 * (STATE + 2 * BLOCK * i)
            _joint((angles, angles + 8 * BLOCK, ar, ai, br, bi), (), state)
