"""The best member of a family of synchronous settings, where a closed form names none.

More than two free yokes leave (their number - 2) choices at closure. The search starts from closed polygons spread over
the whole family, follows the goal along the closure, and puts the end exactly onto it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
import scipy

from cardan.drive.models.kinematics_model import Chain
from cardan.maths.arrays import Array
from cardan.maths.kernel import mobius, polygon
from cardan.maths.kernel.mobius import Pair

from .setting import Choice, Goal, turned, with_yokes

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


# A drive with some yokes held is a polygon of fewer sides: joints between two free yokes act as one.

MOST_FOLDS = 8
"""Polygons with more bent corners are folded one way and its mirror only, not in every way."""

STRETCHED = 1e-6
"""Below this angle [rad] between its two folds a corner is stretched; rounding of 1e-16 shows here as its root."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Blocks:
    """Sides of the polygon that the free yokes can bend."""

    sides: list[Pair]  # one joint, or several with the held yokes between them
    free: tuple[int, ...]  # index 0 … n-2 of the yoke angle between one side and the next
    joints: tuple[tuple[int, ...], ...]  # joints of each side, counted from 0
    between: Array  # (n-1,) [rad]: π/2 - β of each shaft, so that γ = between - μ
    yoke_angle: Array  # (n-1,) [rad]: held angles, and present ones where free

    @property
    def lengths(self) -> list[float]:
        """Hyperbolic length of each side."""
        return [mobius.length(side) for side in self.sides]

    @property
    def keep(self) -> list[float]:
        """Present turns at the free yokes [rad]."""
        return [float(self.between[k] - self.yoke_angle[k]) for k in self.free]

    def yokes(self, turns: Sequence[Array]) -> Array:
        """Return all yoke angles for turns at the free ones, array (..., n-1) [rad]."""
        shape = np.broadcast_shapes(*(np.shape(turn) for turn in turns)) if turns else ()
        whole = np.array(np.broadcast_to(self.yoke_angle, (*shape, len(self.yoke_angle))))
        for k, turn in zip(self.free, turns, strict=True):
            whole[..., k] = self.between[k] - turn
        return whole

    def closed(self, aims: Sequence[float] | None = None, *, end: float | None = None) -> Array:
        """Return every way to fold the polygon over given diagonals: mirror images in pairs, array (s, n-1) [rad].

        end: how far from its start it ends, as near as it can when not given.
        The first of a pair has its first bent corner on the negative side. A stretched polygon is given once.
        """
        corners = len(self.free)
        if not corners:
            return self.yoke_angle[None]
        trial = 1.0 - 2.0 * np.eye(corners + 1, corners, k=-1)
        turns = self._turns(trial, aims, end)
        bent = [k for k in range(corners) if abs(np.sin(turns[k][k + 1] - turns[k][0])) > STRETCHED]
        if len(bent) > MOST_FOLDS:
            plus = np.ones((1, corners))
        else:
            ways = list(product((1.0, -1.0), repeat=max(len(bent) - 1, 0)))
            plus = np.ones((len(ways), corners))
            plus[:, bent[1:]] = ways
        folds = np.stack((-plus, plus), axis=1).reshape(-1, corners) if bent else plus[:1]
        return self.yokes(self._turns(folds, aims, end))

    def mirrored(self, yoke_angle: Array) -> Array:
        """Return the yoke angles (n-1,) [rad] of the polygon's mirror image, which ends as far from its start."""
        here = there = self.sides[0]
        turns = []
        for k, (side, held) in enumerate(zip(self.sides[1:], self.keep, strict=True)):
            index = self.free[k]
            turn = float(self.between[index] - yoke_angle[index])
            loose = min(mobius.length(here), mobius.length(side)) < polygon.POINT
            back = held if loose else -turn - _lean(here, side) - _lean(there, side)
            turns.append(np.asarray(back))
            here = mobius.compose(mobius.compose(side, mobius.turn(turn)), here)
            there = mobius.compose(mobius.compose(side, mobius.turn(back)), there)
        return self.yokes(turns)

    def members(self, count: int) -> Array:
        """Return closed polygons spread over all that there are, array (count, n-1) [rad]; the same every time."""
        random = np.random.default_rng(count)
        aims = [np.asarray(self.lengths[0])]
        for low, high in polygon.windows(self.lengths, 0.0)[1:]:
            aims.append(random.uniform(low, high, count))
        folds = [np.ones(count), *random.choice((-1.0, 1.0), (len(self.free), count))]
        sides = [(np.asarray(a), np.asarray(b)) for a, b in self.sides]
        turns = polygon.close(sides, aims=aims, folds=folds, keep=self.keep).turns
        return self.yokes([np.broadcast_to(turn, (count,)) for turn in turns])

    def _turns(self, folds: Array, aims: Sequence[float] | None, end: float | None) -> list[Array]:
        sides = [(np.asarray(a), np.asarray(b)) for a, b in self.sides]
        columns = [np.ones(len(folds)), *folds.T]
        turns = polygon.close(sides, end=end, aims=aims, folds=columns, keep=self.keep).turns
        return [np.broadcast_to(turn, (len(folds),)) for turn in turns]


def _lean(so_far: Pair, side: Pair) -> float:
    """Return arg(a b c d*)/2: what the turn before a side is counted from."""
    (a, b), (c, d) = so_far, side
    return 0.5 * float(np.angle(a * b * c * np.conj(d)))


def blocks(chain: Chain, yoke_angle: Array, free: Sequence[int]) -> Blocks:
    """Return the polygon of a drive whose yokes other than ``free`` are held.

    yoke_angle (n-1,) [rad]: held and present yoke angles; free: indices 0 … n-2 of the free ones, ascending.
    """
    between = 0.5 * np.pi - chain.plane_twist
    sides: list[Pair] = []
    joints: list[tuple[int, ...]] = []
    for i, joint_angle in enumerate(chain.joint_angle.tolist()):
        joint = mobius.hooke(joint_angle)
        if i == 0 or i - 1 in free:
            sides.append(joint)
            joints.append((i,))
            continue
        held = mobius.turn(float(between[i - 1] - yoke_angle[i - 1]))
        sides[-1] = mobius.compose(joint, mobius.compose(held, sides[-1]))
        joints[-1] = (*joints[-1], i)
    return Blocks(sides=sides, free=tuple(free), joints=tuple(joints), between=between, yoke_angle=yoke_angle)
