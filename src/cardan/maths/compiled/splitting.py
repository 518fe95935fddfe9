"""Mathieu's equation over half a period by a splitting of sixth order; the same lines on arrays and in a kernel.

The potential a - 2q cos 2z is even about 0 and about π/2, so the course over half a period gives the trace over a whole
one. A step of Blanes and Moan takes eleven drifts u += h a_i v and kicks v -= h b_i (a - 2q cos 2z) u; it keeps areas,
so the error shows in the exponents as a small shift of a, never as damping.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from cardan.maths.arrays import Array

DRIFT = (0.123229775946271, 0.290553797799558, -0.127049212625417, -0.246331761062075, 0.357208872795928)
KICK = (0.0414649985182624, 0.198128671918067, -0.0400061921041533, 0.0752539843015807, -0.0115113874206879)
"""Coefficients of S. Blanes and P. C. Moan, J. Comput. Appl. Math. 142 (2002) 313, order 6, 11 stages; the middle ones
follow from the sums."""

DRIFTS = 6
"""Different drifts of a step."""

STAGES = 11
NUMBERS = 2 * STAGES
"""Numbers of the kicks of a step: two for each."""

KICKS = 12
"""Numbers of the first kicks, where a step is cut in two."""


def _coefficients() -> tuple[tuple[float, ...], tuple[float, ...]]:
    drift = (*DRIFT, 1.0 - 2.0 * sum(DRIFT))
    kick = (*KICK, 0.5 - sum(KICK))
    return (*drift, *drift[-2::-1]), (*kick, *kick[::-1])


def plan(steps: int) -> Array:
    """Return the numbers of a course over [0, π/2] in equal steps.

    Returns (`DRIFTS` + `NUMBERS` × steps + 2,): the drifts of a step; for each step k and k cos 2z of its kicks, the
    last kick of a step joined to the first of the next one; the same of the last kick.
    """
    h = 0.5 * math.pi / steps
    drift, kick = _coefficients()
    place = h * np.concatenate(([0.0], np.cumsum(drift)))
    z = h * np.arange(steps)[:, None] + place[None, :-1]
    size = np.tile(h * np.asarray(kick[:-1]), (steps, 1))
    size[1:, 0] *= 2.0
    kicks = np.stack((size, size * np.cos(2.0 * z)), axis=-1)
    end = h * kick[-1]
    return np.concatenate((h * np.asarray(drift[:DRIFTS]), kicks.ravel(), [end, -end]))


def course(a: Any, q: Any, state: tuple[Any, ...], drifts: Sequence[Any], kicks: Sequence[Any]) -> tuple[Any, ...]:
    """Take two solutions of u'' + (a - 2q cos 2z) u = 0 through kicks, each followed by a drift.

    state (u_1, u_1', u_2, u_2').
    drifts: of a whole step, the first six; without any the kicks stand alone.
    kicks: k and k cos 2z in turns.
    """
    u1, v1, u2, v2 = state
    twice = q + q
    for i in range(len(kicks) // 2):
        k = a * kicks[2 * i] - twice * kicks[2 * i + 1]
        v1, v2 = v1 - k * u1, v2 - k * u2
        if len(drifts):
            by = drifts[min(i, STAGES - 1 - i)]
            u1, u2 = u1 + v1 * by, u2 + v2 * by
    return u1, v1, u2, v2


def turned(u1: Any, v1: Any, u2: Any, v2: Any) -> Any:
    """Return half the trace over a period from the two solutions at its middle: cos πβ = u_1 u_2' + u_1' u_2."""
    return u1 * v2 + v1 * u2
