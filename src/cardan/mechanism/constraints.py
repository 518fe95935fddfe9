"""What the joints of a mechanism forbid and what they leave, as matrices of screws: two formulations of one truth."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from cardan.maths.arrays import Array
from cardan.maths.kernel import frames, screws

from .mechanism import Mechanism, freedoms

FRAME = -1
"""Index of the frame among the links."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Constraints:
    """A mechanism as screws, about the middle of its joints, lengths over its size."""

    links: int  # number of moving links n
    ends: tuple[tuple[int, int], ...]  # the two links of each joint, counted from 0; `FRAME` is the frame
    freedoms: tuple[Array, ...]  # tuple of array (f, 6): what each joint leaves, the second link against the first
    middle: Array  # (3,) [m]: about which moments are taken
    size: float  # [m]: length that counts as one

    @property
    def wrenches(self) -> tuple[Array, ...]:
        """What each joint holds, orthonormal, arrays (s, 6)."""
        return tuple(screws.reciprocal(twists) for twists in self.freedoms)

    def matrix(self) -> Array:
        """Return the rows w·(t_b - t_a) of every wrench that a joint holds, array (Σs, 6n).

        Its null space are the small motions, the null space of its transpose are states of reactions that balance each
        other; spec structure, "True mobility and redundant constraints".
        """
        rows = []
        for (a, b), held in zip(self.ends, self.wrenches, strict=True):
            block = np.zeros((len(held), 6 * self.links))
            for link, sign in ((a, -1.0), (b, 1.0)):
                if link != FRAME:
                    block[:, 6 * link : 6 * link + 6] += sign * held
            rows.append(block)
        return np.concatenate(rows)

    def holding(self, links: Sequence[int]) -> Array:
        """Return rows that hold links fast, array (6 times their number, 6n)."""
        rows = np.zeros((6 * len(links), 6 * self.links))
        for k, link in enumerate(links):
            rows[6 * k : 6 * k + 6, 6 * link : 6 * link + 6] = np.eye(6)
        return rows

    def loop_matrix(self) -> Array:
        """Return the freedoms around every loop, array (6k, Σf): the other formulation.

        Around a loop the relative twists of the joints add up to nought. Loops: every joint that is not of the spanning
        tree, closed through it. Its null space are the joint speeds.
        """
        starts = np.cumsum([0, *(len(twists) for twists in self.freedoms)])
        tree = spanning_tree(self.links, self.ends)
        rows = []
        for j, (a, b) in enumerate(self.ends):
            if j in tree.parent_joint:
                continue
            block = np.zeros((6, int(starts[-1])))
            block[:, starts[j] : starts[j + 1]] = self.freedoms[j].T
            for end, sign in ((a, 1.0), (b, -1.0)):
                for k, along in tree.path(end):
                    block[:, starts[k] : starts[k + 1]] += sign * along * self.freedoms[k].T
            rows.append(block)
        return np.concatenate(rows) if rows else np.zeros((0, int(starts[-1])))

    def with_freedom(self, joint: int, twists: Array) -> Constraints:
        """Return the same with further freedoms (m, 6) at a joint."""
        more = screws.independent(np.concatenate((self.freedoms[joint], twists)))
        changed = (*self.freedoms[:joint], more, *self.freedoms[joint + 1 :])
        return replace(self, freedoms=changed)

    def place(self, point: Array) -> Array:
        """Return where a point (..., 3) [m] lies, in sizes from the middle."""
        return (np.asarray(point, dtype=float) - self.middle) / self.size


def constraints(mechanism: Mechanism) -> Constraints:
    """Return a mechanism as screws."""
    points = np.asarray([pair.point for pair in mechanism.joints], dtype=float)
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    size = float(np.max(frames.norm(points - middle)))
    size = max(size, *(abs(pair.pitch or 0.0) for pair in mechanism.joints)) or 1.0
    number = {link: k for k, link in enumerate(mechanism.links)} | {mechanism.frame: FRAME}
    twists = []
    for pair, point in zip(mechanism.joints, points, strict=True):
        second = None if pair.axis2 is None else frames.unit(np.asarray(pair.axis2, dtype=float))
        one = freedoms(pair.kind, (point - middle) / size, pair.along, second, (pair.pitch or 0.0) / size)
        twists.append(one if pair.kind.screw else screws.independent(one))
    return Constraints(
        links=len(mechanism.links),
        ends=tuple((number[a], number[b]) for a, b in (pair.links for pair in mechanism.joints)),
        freedoms=tuple(twists),
        middle=middle,
        size=size,
    )


@dataclass(frozen=True, kw_only=True, slots=True)
class Tree:
    """Which joint each link hangs on, seen from the frame."""

    parent_joint: tuple[int, ...]  # of each link, the joint on the way to the frame
    parent: tuple[int, ...]  # of each link, the link next on the way to the frame
    order: tuple[int, ...]  # the links, each behind its parent
    along: tuple[float, ...]  # of each link, +1 where its joint names it second, -1 where first

    def path(self, link: int) -> list[tuple[int, float]]:
        """Return the joints from a link down to the frame, each with the sense in which it is passed."""
        steps = []
        while link != FRAME:
            steps.append((self.parent_joint[link], self.along[link]))
            link = self.parent[link]
        return steps


def spanning_tree(links: int, ends: Sequence[tuple[int, int]]) -> Tree:
    """Return the tree that reaches every link, always by the first joint of the list that can."""
    joint, parent, along = [FRAME] * links, [FRAME] * links, [1.0] * links
    reached = {FRAME}
    order: list[int] = []
    while len(order) < links:
        k, near, far, sense = next(
            (k, near, far, sense)
            for k, (a, b) in enumerate(ends)
            for near, far, sense in ((a, b, 1.0), (b, a, -1.0))
            if near in reached and far not in reached
        )
        reached.add(far)
        order.append(far)
        joint[far], parent[far], along[far] = k, near, sense
    return Tree(parent_joint=tuple(joint), parent=tuple(parent), order=tuple(order), along=tuple(along))
