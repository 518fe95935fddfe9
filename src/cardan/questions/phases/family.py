"""The best member of a family of synchronous settings, where a closed form names none.

More than two free yokes leave (their number - 2) choices at closure. The search starts from closed polygons spread over
the whole family, follows the goal along the closure, and puts the end exactly onto it.
"""

from __future__ import annotations

import numpy as np
import scipy

from cardan.maths.arrays import Array
from cardan.maths.kernel import mobius

from .blocks import Blocks
from .goal import Choice, Goal
from .setting import turned, with_yokes

SAMPLES = 1024
"""Members looked at before the search."""

STARTS = 4
"""Best members from which it starts."""

SHUT = 1e-14
"""A setting found by search counts as synchronous below this speed fluctuation."""

MOST_SEARCHED = 40
"""With more free yokes than this the best member looked at is taken as it is."""


def best_member(figure: Blocks, choice: Choice, goal: Goal, known: Array) -> Array:
    """Return the yoke angles (n-1,) [rad] of the synchronous setting that is best by a goal.

    figure: polygon of the free yokes; it can be closed.
    known (s, n-1) [rad]: members worth starting from.
    """
    beside = onto_closure(figure, choice, figure.yoke_angle)
    closed = beside[None] if _leftover(choice, beside) < SHUT else known[:0]
    rows = np.concatenate((known, closed, figure.members(SAMPLES)))
    cost = goal.cost(choice, rows)
    best = rows[int(np.argmin(cost))]
    if len(figure.free) > MOST_SEARCHED:
        return best
    least = float(np.min(cost))
    for start in distinct(rows[np.argsort(cost, kind="stable")], STARTS):
        found = onto_closure(figure, choice, _followed(figure, choice, goal, start))
        value = float(goal.cost(choice, found))
        if value < least - 1e-12 and _leftover(choice, found) < SHUT:
            best, least = found, value
    return best


def distinct(rows: Array, count: int) -> list[Array]:
    """Return the first ``count`` rows that differ from each other by some degrees modulo π."""
    kept: list[Array] = []
    for row in rows:
        if all(np.abs(np.sin(row - other)).max() > 0.1 for other in kept):
            kept.append(row)
            if len(kept) == count:
                break
    return kept


def onto_closure(figure: Blocks, choice: Choice, yoke_angle: Array) -> Array:
    """Return the nearest closed setting by Newton's method."""
    free = list(figure.free)
    best, left = yoke_angle, _leftover(choice, yoke_angle)
    for _ in range(8):
        (_a, b), _da, db = turned(with_yokes(choice.chain, best))
        slope = np.stack((db.real[free], db.imag[free]))
        step = np.linalg.lstsq(slope, -np.asarray([b.real, b.imag]), rcond=1e-9)[0]
        moved = best.copy()
        moved[free] += step
        now = _leftover(choice, moved)
        if now >= left:
            break
        best, left = moved, now
    return best


def _leftover(choice: Choice, yoke_angle: Array) -> float:
    return float(mobius.speed_fluctuation(with_yokes(choice.chain, yoke_angle).products()[-1]))


def _followed(figure: Blocks, choice: Choice, goal: Goal, start: Array) -> Array:
    """Follow the goal along the closure (sequential quadratic programming)."""
    free = list(figure.free)
    near = start[free]

    def whole(x: Array) -> Array:
        rows = np.repeat(start[None], x.size // len(free), axis=0).reshape(*x.shape[:-1], len(start))
        rows[..., free] = x
        return rows

    def gap(x: Array) -> Array:
        (_a, b), _da, _db = turned(with_yokes(choice.chain, whole(x)))
        return np.asarray([b.real, b.imag])

    def gap_slope(x: Array) -> Array:
        _pair, _da, db = turned(with_yokes(choice.chain, whole(x)))
        return np.stack((db.real[free], db.imag[free]))

    h = 1e-6
    both = h * np.concatenate((np.eye(len(free)), -np.eye(len(free))))
    for blur in goal.blurs:

        def cost(x: Array, blur: float = blur) -> float:
            return float(goal.cost(choice, whole(x), blur=blur))

        def slope(x: Array, blur: float = blur) -> Array:
            up, down = np.split(goal.cost(choice, whole(x + both), blur=blur), 2)
            return (up - down) / (2.0 * h)

        near = scipy.optimize.minimize(
            cost,
            near,
            jac=slope,
            method="SLSQP",
            constraints=[{"type": "eq", "fun": gap, "jac": gap_slope}],
            options={"maxiter": 60, "ftol": 1e-11},
        ).x
    return whole(near)
