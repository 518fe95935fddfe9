"""A drive with some yokes held is a polygon of fewer sides: joints between two free yokes act as one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from cardan.drive.models.chain import Chain
from cardan.maths.arrays import Array
from cardan.maths.kernel import mobius, polygon
from cardan.maths.kernel.mobius import Pair

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

    def closed(self, aims: Sequence[float] | None = None) -> Array:
        """Return every way to fold the polygon over given diagonals: mirror images in pairs, array (s, n-1) [rad].

        The first of a pair has its first bent corner on the negative side. A stretched polygon is given once.
        """
        corners = len(self.free)
        if not corners:
            return self.yoke_angle[None]
        trial = 1.0 - 2.0 * np.eye(corners + 1, corners, k=-1)
        turns = self._turns(trial, aims)
        bent = [k for k in range(corners) if abs(np.sin(turns[k][k + 1] - turns[k][0])) > STRETCHED]
        if len(bent) > MOST_FOLDS:
            plus = np.ones((1, corners))
        else:
            ways = list(product((1.0, -1.0), repeat=max(len(bent) - 1, 0)))
            plus = np.ones((len(ways), corners))
            plus[:, bent[1:]] = ways
        folds = np.stack((-plus, plus), axis=1).reshape(-1, corners) if bent else plus[:1]
        return self.yokes(self._turns(folds, aims))

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

    def _turns(self, folds: Array, aims: Sequence[float] | None) -> list[Array]:
        sides = [(np.asarray(a), np.asarray(b)) for a, b in self.sides]
        columns = [np.ones(len(folds)), *folds.T]
        turns = polygon.close(sides, aims=aims, folds=columns, keep=self.keep).turns
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
