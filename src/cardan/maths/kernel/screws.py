"""Twists, wrenches and their ranks: which small motions a system of constraints leaves, and which of these repeat.

A twist is (ω; v): how fast a body turns, and how fast its point at the origin moves. A wrench is (m; f): moment about
the origin, and force. Their product ω·m + v·f is a power. Both are the last axis (6) of an array.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.maths.arrays import Array, abreast

from . import frames

RANK = 1e-8
"""Singular values below this share of the largest count as nought."""

GAP = 1e3
"""A rank is certain where its last singular value is at least so many times the next one, and the tolerance."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Rank:
    """Rank of a matrix."""

    value: int  # how many singular values count
    # the least of these over the largest of the others; infinite where the others are exactly nought or none is left
    gap: float
    least: float  # the least of these over the largest of all

    @property
    def certain(self) -> bool:
        """Whether the singular values fall into two groups that lie far apart, and from the tolerance between them."""
        return self.gap >= GAP and self.least >= GAP * RANK


NOTHING = Rank(value=0, gap=np.inf, least=1.0)
"""Rank of a matrix of noughts."""


def rotation(axis: Array, point: Array) -> Array:
    """Return the twist of turning about an axis through a point: (a; p × a), array (..., 6)."""
    return np.concatenate((axis, frames.cross(np.broadcast_to(point, np.shape(axis)), axis)), axis=-1)


def translation(axis: Array) -> Array:
    """Return the twist of sliding along an axis: (0; a), array (..., 6)."""
    return np.concatenate((np.zeros_like(axis), axis), axis=-1)


def bracket(one: Array, other: Array) -> Array:
    """Return how fast a twist (..., 6) changes that goes with a body of another twist: their Lie bracket."""
    turn = frames.cross(one[..., :3], other[..., :3])
    move = frames.cross(one[..., :3], other[..., 3:]) + frames.cross(one[..., 3:], other[..., :3])
    return np.concatenate((turn, move), axis=-1)


def independent(twists: Array) -> Array:
    """Return an orthonormal basis of what twists (m, 6) span, array (rank, 6)."""
    if not len(twists):
        return np.zeros((0, 6))
    _left, size, right = np.linalg.svd(twists)
    return right[: int(np.sum(size > RANK * size[0]))]


def reciprocal(twists: Array) -> Array:
    """Return the wrenches that do no work on any of some twists, orthonormal, array (6 - rank, 6).

    twists (f, 6): freedoms of a pair.
    """
    if not len(twists):
        return np.eye(6)
    _left, size, right = np.linalg.svd(twists)
    return right[int(np.sum(size > RANK * size[0])) :]


def rank(matrix: Array) -> Rank:
    """Return the rank of a matrix (m, n) and how certain it is.

    Singular values above `RANK` times the largest count.
    """
    if not min(matrix.shape):
        return NOTHING
    return _rank_of(np.linalg.svd(matrix, compute_uv=False))


def _rank_of(size: Array) -> Rank:
    if not size[0] > 0.0:
        return NOTHING
    value = int(np.sum(size > RANK * size[0]))
    sharp = value == len(size) or size[value] == 0.0
    gap = np.inf if sharp else float(size[value - 1] / size[value])
    return Rank(value=value, gap=gap, least=float(size[value - 1] / size[0]))


def null_spaces(matrix: Array) -> tuple[Rank, Array, Array]:
    """Return rank, left and right null space of a matrix (m, n), the spaces orthonormal.

    Returns left (m - rank, m): combinations of the rows that vanish; right (n - rank, n): vectors that all rows leave
    free.
    """
    m, n = matrix.shape
    if not min(m, n):
        return NOTHING, np.eye(m), np.eye(n)
    left, size, right = np.linalg.svd(matrix)
    found = _rank_of(size)
    return found, left[:, found.value :].T, right[found.value :]


def hat(vector: Array) -> Array:
    """Return the matrices (..., 3, 3) that multiply as vector products: hat(a) b = a × b."""
    x, y, z = vector[..., 0], vector[..., 1], vector[..., 2]
    none = np.zeros_like(x)
    return abreast((none, -z, y, z, none, -x, -y, x, none), np).reshape(*x.shape, 3, 3)


def exponential(twist: Array, amount: Array) -> Array:
    """Return the displacements (..., 4, 4) after moving along twists (..., 6) by amounts (...).

    Rodrigues' formula with the unit of the turning part; a twist that does not turn slides.
    """
    turning, moving = twist[..., :3], twist[..., 3:]
    speed = frames.norm(turning)
    turns = speed > 0.0
    size = np.where(turns, speed, 1.0)
    axis = turning / size[..., None]
    angle = speed * amount
    sine, versine = np.sin(angle)[..., None, None], (2.0 * np.sin(0.5 * angle) ** 2)[..., None, None]
    cross = hat(axis)
    square = cross @ cross
    linear = moving / size[..., None]
    unit = np.eye(3)
    spread = (angle[..., None, None] * unit) + versine * cross + (angle[..., None, None] - sine) * square
    along = np.where(turns[..., None], (spread @ linear[..., None])[..., 0], moving * np.asarray(amount)[..., None])
    out = np.zeros((*angle.shape, 4, 4))
    out[..., :3, :3] = unit + sine * cross + versine * square
    out[..., :3, 3] = along
    out[..., 3, 3] = 1.0
    return out


def inverse(displacement: Array) -> Array:
    """Return the displacement (..., 4, 4) back."""
    turn = np.swapaxes(displacement[..., :3, :3], -1, -2)
    out = np.zeros_like(displacement)
    out[..., :3, :3] = turn
    out[..., :3, 3] = -(turn @ displacement[..., :3, 3, None])[..., 0]
    out[..., 3, 3] = 1.0
    return out


def moved(displacement: Array, twist: Array) -> Array:
    """Return twists (..., 6) that were carried along by displacements (..., 4, 4)."""
    turn, shift = displacement[..., :3, :3], displacement[..., :3, 3]
    turning = (turn @ twist[..., :3, None])[..., 0]
    moving = (turn @ twist[..., 3:, None])[..., 0] + frames.cross(shift, turning)
    return np.concatenate((turning, moving), axis=-1)


def turned_by(displacement: Array) -> Array:
    """Return axis times angle of the turn in displacements (..., 4, 4), array (..., 3) [rad]."""
    turn = displacement[..., :3, :3]
    odd = 0.5 * np.stack(
        (turn[..., 2, 1] - turn[..., 1, 2], turn[..., 0, 2] - turn[..., 2, 0], turn[..., 1, 0] - turn[..., 0, 1]), -1
    )
    sine = frames.norm(odd)
    angle = np.atan2(sine, 0.5 * (np.trace(turn, axis1=-2, axis2=-1) - 1.0))
    small = sine < 1e-9
    return odd * np.where(small, 1.0, angle / np.where(small, 1.0, sine))[..., None]
