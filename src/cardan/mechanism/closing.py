"""Loops closed at many positions at once: where every link stands once some of them are put somewhere.

A link stands where its displacement from the position drawn puts it. The axis of a pair goes with its first link, its
point and second axis with the second. Rolling contacts hold no place: what they hold `turning` follows.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cardan.maths.arrays import Array
from cardan.maths.kernel import frames, screws
from cardan.texts import _

from .mechanism import Pair

ROUNDS = 40
"""Most steps of Newton's method; where loops close a few do."""

RESTS = 1e-13
"""Step, lengths over the size of the mechanism, at which a closure is complete; rounding is a hundredth of it."""

CLOSED = 1e-9
"""Misfit, lengths over the size, up to which loops count as closed: far above rounding, far below any real gap."""

ROUNDED = 1e-4
"""Gap, lengths over the size, below which numbers with few digits may be what opens loops that are held too often."""

LONGEST = 0.3
"""Longest step taken, lengths over the size."""

DAMPING = 1e-12
"""Share of the largest square that keeps motions which nothing holds, a rod about its axis, where they are."""

LEFT = 1e-7
"""Share of the largest singular value below which one is nought: far above rounding, far below any real one."""


class Linkage:
    """Links and pairs as arrays, lengths over the size about the middle."""

    def __init__(self, joints: Sequence[Pair], ends: Sequence[tuple[str, str]] = ()) -> None:
        """Take pairs, and the links that they join where these have other names."""
        named = [pair.links for pair in joints] if not ends else list(ends)
        self.joints = tuple(joints)
        self.links = tuple(dict.fromkeys(link for two in named for link in two))
        self.first, self.second = (np.asarray([self.links.index(two[k]) for two in named]) for k in (0, 1))
        points = np.asarray([pair.point for pair in joints], dtype=float)
        self.middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
        self.size = float(np.max(frames.norm(points - self.middle))) or 1.0
        self.point = (points - self.middle) / self.size
        off = np.asarray([pair.misalignment for pair in joints], dtype=float) / self.size
        self.frame = np.stack([_frame(pair) for pair in joints])  # (m, 3, 3): its axis and two across it, a row each
        turn = np.asarray([pair.misalignment_turn for pair in joints], dtype=float)
        turned = screws.exponential(np.concatenate((turn, 0.0 * turn), axis=-1), np.ones(len(turn)))[:, :3, :3]
        self.own_point, self.own_frame = self.point + off, self.frame @ np.swapaxes(turned, -1, -2)
        given = [frames.unit(np.asarray(pair.axis2 or pair.axis or (0.0, 0.0, 1.0), dtype=float)) for pair in joints]
        self.own_second = (turned @ np.stack(given)[..., None])[..., 0]
        self.angle = frames.dot(self.frame[:, 0], np.stack(given))  # cosine between both axes, kept where there are two
        self.turning = np.asarray([bool(pair.kind.turns) for pair in joints])
        self.both = np.asarray([pair.kind.turns == "both" for pair in joints])
        self.pitch = np.asarray([pair.pitch or 0.0 for pair in joints]) / self.size
        rows = [(j, k) for j, pair in enumerate(joints) for k in _held(pair)]
        self.row_pair, self.row_way = (np.asarray([row[k] for row in rows], dtype=int) for k in (0, 1))

    def drawn(self, *shape: int) -> Array:
        """Return displacements of all links where they are drawn, array (*shape, n, 4, 4)."""
        return np.broadcast_to(np.eye(4), (*shape, len(self.links), 4, 4)).copy()

    def settled(self, poses: Array, moving: Sequence[int], tied: tuple[int, int] | None = None) -> tuple[Array, Array]:
        """Return where links stand whose loops close.

        poses (..., n, 4, 4): displacement of every link, of the moving ones a guess; moving: which may move.
        tied: a link that goes with a moving one as if it were one with it.
        Returns poses, and the misfit of each pair (..., m, 2): gap over the size, and lean [rad].
        Newton's method; of the motions that nothing holds the smallest.
        """
        here = self.scaled(poses, 1.0)
        if not len(moving):
            return poses, self._misfit(self.rows(here)[1])
        here[..., :3, :3] = _rigid(here[..., :3, :3])
        for _round in range(ROUNDS):
            slope, rest = self.slopes(here, moving, tied)
            turned = np.swapaxes(slope, -1, -2)
            square = turned @ slope
            most = np.max(np.abs(np.diagonal(square, axis1=-2, axis2=-1)), axis=-1)
            damped = square + (DAMPING * most)[..., None, None] * np.eye(square.shape[-1])
            step = -np.linalg.solve(damped, turned @ rest[..., None])[..., 0]
            step = step / np.maximum(1.0, np.max(np.abs(step), axis=-1, keepdims=True) / LONGEST)
            self.step(here, step, moving, tied)
            if np.max(np.abs(step)) < RESTS:
                break
        here[..., :3, :3] = _rigid(here[..., :3, :3])
        return self.scaled(here, -1.0), self._misfit(self.rows(here)[1])

    def slopes(self, poses: Array, moving: Sequence[int], tied: tuple[int, int] | None) -> tuple[Array, Array]:
        """Return how twists of the moving links change what the pairs miss, (..., s, 6n), and what they miss (..., s).

        poses: scaled; tied: as `settled` has it.
        """
        matrix, rest = self.matrix(poses)
        if tied is not None:
            matrix[..., tied[1], :] += matrix[..., tied[0], :]
        return np.reshape(matrix[..., list(moving), :], (*rest.shape, -1)), rest

    def step(self, poses: Array, step: Array, moving: Sequence[int], tied: tuple[int, int] | None) -> None:
        """Step scaled poses (..., n, 4, 4) of the moving links, and of one tied, by twists (..., 6n), in place."""
        twist = np.reshape(step, (*step.shape[:-1], len(moving), 6))
        steps = screws.exponential(twist, np.ones(twist.shape[:-1]))
        poses[..., list(moving), :, :] = steps @ poses[..., list(moving), :, :]
        if tied is not None:
            poses[..., tied[0], :, :] = steps[..., list(moving).index(tied[1]), :, :] @ poses[..., tied[0], :, :]

    def motions(self, poses: Array, moving: Sequence[int]) -> Array:
        """Return the small motions that the pairs leave, array (w, moving, 6): twists, lengths over the size."""
        matrix = self.matrix(self.scaled(poses, 1.0))[0][..., list(moving), :]
        _left, size, right = np.linalg.svd(np.reshape(matrix, (matrix.shape[-3], -1)))
        return np.reshape(right[int(np.sum(size > LEFT * size[0])) :], (-1, len(moving), 6))

    def placed(self, poses: Array) -> tuple[Array, Array, Array]:
        """Return point [m], axis and second axis of every pair where they stand, arrays (..., m, 3)."""
        turn, shift = poses[..., :3, :3], poses[..., :3, 3]
        own = self.own_point * self.size + self.middle
        point = _turned(turn[..., self.second, :, :], own) + shift[..., self.second, :]
        axis = _turned(turn[..., self.first, :, :], self.frame[:, 0])
        return point, axis, _turned(turn[..., self.second, :, :], self.own_second)

    def scaled(self, poses: Array, way: float) -> Array:
        """Return displacements with lengths over the size about the middle, or back again (``way`` -1)."""
        out = np.array(poses)
        swept = (poses[..., :3, :3] @ self.middle) - self.middle
        shift = poses[..., :3, 3]
        out[..., :3, 3] = (shift + swept) / self.size if way > 0.0 else shift * self.size - swept
        return out

    def rows(self, poses: Array) -> tuple[Array, Array]:
        """Return what each pair holds, wrenches about the middle (..., s, 6), and how far it is from that (..., s)."""
        turn, shift = poses[..., :3, :3], poses[..., :3, 3]
        one, other = turn[..., self.first, :, :], turn[..., self.second, :, :]
        ways = self.frame @ np.swapaxes(one, -1, -2)
        own = self.own_frame @ np.swapaxes(other, -1, -2)
        point = _turned(other, self.own_point) + shift[..., self.second, :]
        gap = point - _turned(one, self.point) - shift[..., self.first, :]
        leans = frames.cross(ways, own)
        lean = np.where(self.turning[:, None], leans[..., 0, :], 0.5 * np.sum(leans, axis=-2))
        second = _turned(other, self.own_second)
        across = frames.cross(ways[..., 0, :], second)
        size = np.where(self.both, frames.norm(across), 1.0)[..., None]
        about = np.array(ways)
        about[..., 0, :] = np.where(self.both[:, None], across / size, ways[..., 0, :])
        miss = (self.angle - frames.dot(ways[..., 0, :], second)) / size[..., 0]
        leaned = (ways @ lean[..., None])[..., 0]
        leaned[..., 0] = np.where(self.both, miss, leaned[..., 0])
        pulls = np.concatenate((frames.cross(point[..., None, :] + 0.0 * ways, ways), ways), axis=-1)
        pulls[..., 0, :3] -= self.pitch[:, None] * ways[..., 0, :]
        wrench = np.concatenate((pulls, np.concatenate((about, 0.0 * about), axis=-1)), axis=-2)
        apart = (ways @ gap[..., None])[..., 0]
        apart[..., 0] -= self._screwed(apart[..., 0], ways, own)
        rest = np.concatenate((apart, leaned), axis=-1)
        return wrench[..., self.row_pair, self.row_way, :], rest[..., self.row_pair, self.row_way]

    def _screwed(self, along: Array, ways: Array, own: Array) -> Array:
        """Return how far helical pairs are screwed (..., m): of the threads a turn apart the nearest to what they are.

        along (..., m): how far they slid; ways, own (..., m, 3, 3): frames of the pair on its first and second link.
        """
        if not np.any(self.pitch):
            return 0.0 * along
        turned = np.arctan2(frames.dot(own[..., 1, :], ways[..., 2, :]), frames.dot(own[..., 1, :], ways[..., 1, :]))
        lead = 2.0 * np.pi * np.where(self.pitch, self.pitch, 1.0)
        near = self.pitch * turned
        return near + np.where(self.pitch, lead * np.round((along - near) / lead), 0.0)

    def matrix(self, poses: Array) -> tuple[Array, Array]:
        """Return how twists of the links change what the pairs miss, (..., s, n, 6), and what they miss (..., s)."""
        wrench, rest = self.rows(poses)
        rows = np.arange(len(self.row_pair))
        matrix = np.zeros((*wrench.shape[:-1], len(self.links), 6))
        matrix[..., rows, self.second[self.row_pair], :] += wrench
        matrix[..., rows, self.first[self.row_pair], :] -= wrench
        return matrix, rest

    def _misfit(self, rest: Array) -> Array:
        """Return gap and lean of each pair, array (..., m, 2)."""
        found = np.zeros((*rest.shape[:-1], len(self.joints), 2))
        for j in range(len(self.joints)):
            for k, part in enumerate((self.row_way < 3, self.row_way >= 3)):
                found[..., j, k] = np.max(np.abs(rest[..., part & (self.row_pair == j)]), axis=-1, initial=0.0)
        return np.where(np.isfinite(found), found, np.inf)


def open_by(misfit: Array) -> tuple[float, float]:
    """Return the largest gap, over the size, and lean [rad] of pairs (m, 2); what rounding leaves is none."""
    gap, lean = (float(one) if one > CLOSED else 0.0 for one in np.max(misfit, axis=0))
    return gap, lean


def by_rounding(gap: float) -> str:
    """Return what to do about a gap, lengths over the size, that rounded numbers may make; nothing of a larger one."""
    if gap > ROUNDED:
        return ""
    return _("; if its numbers are rounded, tell how much, rounding_mm: what is held more than once closes no better")


def _frame(pair: Pair) -> Array:
    """Return the axis of a pair and two across it, array (3, 3)."""
    aside = frames.perpendicular(pair.along)
    return np.stack((pair.along, aside, frames.cross(pair.along, aside)))


def _held(pair: Pair) -> list[int]:
    """Return which of three forces and three couples in the frame of a pair it holds, as `held` of kinetostatics."""
    if pair.kind.rolls:
        return []
    if pair.kind.screw:
        return [0, 1, 2, 4, 5]
    forces = {"": (0, 1, 2), "axis": (1, 2), "across": (0,)}[pair.kind.slides]
    couples = {"": (3, 4, 5), "axis": (4, 5), "both": (3,), "all": ()}[pair.kind.turns]
    return [*forces, *couples]


def _rigid(turn: Array) -> Array:
    """Return turns (..., 3, 3) without what rounding strains them: by products link after link that would grow.

    A link longer by 10⁻¹⁴ turns by 10⁻¹¹ near a change point, and its speed is off by 10⁻⁸.
    """
    return 1.5 * turn - 0.5 * turn @ np.swapaxes(turn, -1, -2) @ turn


def _turned(turn: Array, vector: Array) -> Array:
    return (turn @ vector[..., None])[..., 0]


def turn_about(point: Array, axis: Array, angle: Array) -> Array:
    """Return displacements (..., 4, 4) that turn about an axis through a point (3,) by angles (...) [rad]."""
    return moved_along(screws.rotation(np.asarray(axis, dtype=float), np.asarray(point, dtype=float)), angle)


def moved_along(twist: Array, amount: Array) -> Array:
    """Return displacements (..., 4, 4) along a twist (6,) by amounts (...)."""
    return screws.exponential(np.broadcast_to(twist, (*np.shape(amount), 6)), np.asarray(amount, dtype=float))
