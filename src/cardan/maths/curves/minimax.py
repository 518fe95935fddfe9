"""The place at which the largest of many curves is smallest."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
import scipy

from cardan.maths.arrays import Array

Curves: TypeAlias = Callable[[Array], Array]
"""From places (D, v) in the unit box to values (D, K), finite; each row may be asked many at a time."""

STEP = 1e-4
"""Step of the difference quotients, share of the box."""

ROUNDS = 40
"""Steps of the local search at most."""


GAIN = 1e-4
"""Share by which a place must be better to be worth a step."""

IDLE = 6
"""Places in a row that are not, after which the local search ends: at a corner of the curves it would go on."""


class _EndedError(Exception):
    """Nothing more is to be gained."""


@dataclass(frozen=True, eq=False, kw_only=True)
class LeastPeak:
    """Where the largest of many curves is smallest."""

    place: Array  # (v,): in the unit box
    peak: float  # largest value there
    evaluations: int  # places asked for
    converged: bool  # whether the search ended by itself


def least_peak(curves: Curves, start: Array) -> LeastPeak:
    """Return the place in the unit box near a start at which the largest of many smooth curves is smallest.

    curves: values at places; start (v,).
    min t under t ≥ f_k(x) for all k, by sequential quadratic programming; slopes by differences, asked all at once.

    Two parabolas, highest where they cross:

    >>> found = least_peak(lambda x: np.stack([(x[:, 0] - 0.1) ** 2, (x[:, 0] - 0.7) ** 2], axis=-1), np.asarray([0.9]))
    >>> found.place, round(found.peak, 6)
    (array([0.4]), 0.09)
    """
    asked = idle = 0
    last: dict[bytes, tuple[Array, Array]] = {}
    best, least = np.clip(start, 0.0, 1.0), np.inf

    def known(z: Array) -> tuple[Array, Array]:
        nonlocal asked, idle, best, least
        x = np.clip(z[:-1], 0.0, 1.0)
        key = x.tobytes()
        if key not in last:
            step = np.where(x > 0.5, -STEP, STEP)
            values = curves(np.concatenate([x[None], x + np.diag(step)]))
            asked += len(values)
            peak = float(np.max(values[0]))
            idle = 0 if peak < least * (1.0 - GAIN) else idle + 1
            if peak < least:
                best, least = x, peak
            if idle > IDLE:
                raise _EndedError
            last.clear()
            last[key] = values[0], ((values[1:] - values[0]) / step[:, None]).T
        return last[key]

    size = float(np.max(known(np.append(best, 0.0))[0])) or 1.0

    def room(z: Array) -> Array:
        return z[-1] - known(z)[0] / size

    def slope(z: Array) -> Array:
        joint_angle = known(z)[1]
        return np.column_stack([-joint_angle / size, np.ones(len(joint_angle))])

    count = len(start)
    solve: Any = scipy.optimize.minimize
    try:
        ended = solve(
            lambda z: float(z[-1]),
            np.append(best, 1.0),
            jac=lambda z: np.append(np.zeros(count), 1.0),
            method="SLSQP",
            bounds=[(0.0, 1.0)] * count + [(None, None)],
            constraints=[{"type": "ineq", "fun": room, "jac": slope}],
            options={"maxiter": ROUNDS, "ftol": 1e-5},
        )
        converged = bool(ended.success)
    except _EndedError:
        converged = True
    return LeastPeak(place=best, peak=least, evaluations=asked, converged=converged)
