"""What a movement makes of the joints of a drive, or of many that differ in where their joints are."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache, partial

import numpy as np

from cardan.answers.quantity import Quantity, Text, say
from cardan.drive.joints import Joint
from cardan.drive.models.geometry import geometry_from_points
from cardan.drive.models.kinematics_model import Chain, turning
from cardan.drive.movement import Movement
from cardan.maths.arrays import Array
from cardan.maths.curves.extremes import highest, tops, turning_points
from cardan.maths.kernel import frames
from cardan.questions.motion.length import slipping
from cardan.questions.motion.moving_chain import moving_shafts
from cardan.questions.motion.moving_points import default_times, moving_points
from cardan.texts import _

FEW = 40
"""Up to so many drives are looked at at all instants of a movement."""

INSTANTS = 41
"""Instants at which each of more drives is looked at, at most: enough for what swings a few times."""

TOGETHER = 50_000
"""Drives times instants looked at together."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Moved:
    """Answers over a movement: the largest, and of one drive when that is."""

    most: Array  # (..., k)
    times: Array | None = None  # (k,) [s]; None for many drives

    def when(self, k: int = 0) -> Text:
        """Return when one of the answers is largest, in words."""
        if self.times is None:
            return _("while the drive moves")
        return say(_("while the drive moves, at {time}"), time=Quantity(float(self.times[k]), "time", 3, trim=True))


def largest_joint_angles(points: Array, movements: Sequence[Movement]) -> Moved:
    """Return the largest joint angle of every joint over a movement, arrays (..., n) [rad].

    points (..., n+2, 3) [m]: points of the axis as drawn.
    Where a movement carries points is an affine function of where they are.
    """
    return _largest(lambda _part, moved: _joint_angles(moved)[0], points, movements)


def largest_of(
    ask: Callable[[Chain], Array],
    kinematic: Chain,
    points: Array,
    movements: Sequence[Movement],
    joints: Sequence[Joint],
    *,
    mean: bool = False,
) -> Moved:
    """Return the largest or the mean answer over a movement, as if it stood at each instant, arrays (..., k).

    ask: from kinematic halves (m, t) to answers (m, t, k).
    kinematic (..., n): with the yoke angles and the start phase; points (..., n+2, 3) [m]: points of the axis as drawn.
    mean: take the mean over the time instead of the largest.
    Returns: infinite where a joint bends 90° or more at an instant.
    """
    outer, count = points.shape[:-2], kinematic.joints - 1
    yokes = np.broadcast_to(kinematic.yoke_angle, (*outer, count)).reshape(math.prod(outer), 1, count)
    phase = np.broadcast_to(kinematic.start_phase, outer).reshape(-1, 1)

    def answers(part: slice, moved: Array) -> Array:
        possible = np.all(_joint_angles(moved)[1] > 1e-15, axis=-1)
        straight = np.arange(moved.shape[-2])[:, None] * np.asarray((1.0, 0.0, 0.0))
        frozen = geometry_from_points(np.where(possible[..., None, None], moved, straight))
        turned = Chain(
            joint_angle=frozen.joint_angle,
            plane_twist=frozen.plane_twist,
            yoke_angle=yokes[part],
            start_phase=phase[part],
        )
        found: Array = np.where(possible[..., None], ask(turning(turned, joints)), np.inf)
        return found

    if not mean:
        return _largest(answers, points, movements)
    every = [answers(part, moved) for part, moved in _moved(points, movements)]
    means = [np.mean(0.5 * (one[:, 1:] + one[:, :-1]), axis=-2) for one in every]
    return Moved(most=np.concatenate(means).reshape(*outer, -1))


def _largest(ask: Callable[[slice, Array], Array], points: Array, movements: Sequence[Movement]) -> Moved:
    """Return the largest answers over a movement: between the instants too, of one drive to rounding.

    ask: from which of the drives and their points (m, t, n+2, 3) to answers (m, t, k).
    Of more drives than `FEW` the tops of parabolas through neighbouring instants count.
    """
    outer, times = points.shape[:-2], default_times(movements)
    rows = points.reshape(-1, *points.shape[-2:])
    if len(rows) <= FEW:

        def curves(row: int, at: Array) -> Array:
            return ask(slice(row, row + 1), moving_points(rows[row], movements, at)[0][None])[0].T

        each = [highest(partial(curves, row), times, curves(row, times)) for row in range(len(rows))]
        most = np.stack([most for _places, most in each]).reshape(*outer, -1)
        return Moved(most=most, times=each[0][0] if len(rows) == 1 else None)
    found = [np.max(tops(np.swapaxes(ask(*one), -1, -2)), axis=-1) for one in _moved(points, movements)]
    return Moved(most=np.concatenate(found).reshape(*outer, -1))


def extreme_lengths(
    points: Array, movements: Sequence[Movement], rest: Array, ends: Sequence[int] = ()
) -> tuple[Array, Array]:
    """Return the least and the greatest length of every shaft over the instants of a movement, arrays (..., n+1) [m].

    points (..., n+2, 3) [m]: points of the axis as drawn; rest (..., n+1) [m], ends: lengths at which splines of end
    shafts hold the shafts beside them, and which do, see `slipping`.
    Up to `FEW` different drives exactly, as `motion.articulation` has them; of more the parabola through the
    extreme instant and its neighbours.
    """
    count = points.shape[-2]
    outer = np.broadcast_shapes(points.shape[:-2], rest.shape[:-1])
    points, held = np.broadcast_to(points, (*outer, count, 3)), np.broadcast_to(rest, (*outer, count - 1))
    held = held.reshape(-1, count - 1)
    flat, back = np.unique(np.hstack((points.reshape(-1, 3 * count), held)), axis=0, return_inverse=True)
    rows, held = flat[:, : 3 * count].reshape(-1, count, 3), flat[:, 3 * count :]
    if rows.shape[0] > FEW:
        lengths = [lengths_at(moved, held[part, None], ends) for part, moved in _moved(rows, movements)]
        low, high = (
            sign * np.concatenate([np.max(tops(sign * np.swapaxes(one, -1, -2)), axis=-1) for one in lengths])
            for sign in (-1.0, 1.0)
        )
    else:
        found = np.stack([_extremes(row, movements, own, ends) for row, own in zip(rows, held, strict=True)])
        low, high = found[..., 0], found[..., 1]
    shape = (*outer, count - 1)
    return low[back.ravel()].reshape(shape), high[back.ravel()].reshape(shape)


def lengths_at(points: Array, rest: Array, ends: Sequence[int]) -> Array:
    """Return the lengths of shafts between points (..., n+2, 3), array (..., n+1) [m]; rest, ends: of `slipping`."""
    if not ends:
        return frames.norm(np.diff(points, axis=-2))
    return slipping(moving_shafts((points, 0.0 * points, 0.0 * points)), rest, ends).length


def _extremes(points: Array, movements: Sequence[Movement], rest: Array, ends: Sequence[int]) -> Array:
    """Return least and greatest length of every shaft of one drive, array (n+1, 2) [m]; nan where its ends meet."""
    times = default_times(movements)
    with np.errstate(divide="ignore", invalid="ignore"):
        shafts = slipping(moving_shafts(moving_points(points, movements, times)), rest, ends)
    found = np.full((points.shape[0] - 1, 2), np.nan)
    for k, row in enumerate(found):
        good = np.isfinite(shafts.length_acceleration[:, k])
        if np.any(good):
            parts = (shafts.length, shafts.length_rate, shafts.length_acceleration)
            values = turning_points((times[good], *(part[good, k] for part in parts)))[1]
            row[:] = np.min(values), np.max(values)
    return found


def _moved(points: Array, movements: Sequence[Movement]) -> Iterator[tuple[slice, Array]]:
    """Yield which of the drives, one after another, and their points at the instants of a movement (m, t, n+2, 3)."""
    count = points.shape[-2]
    rows = points.reshape(-1, count, 3)
    times = default_times(movements)
    if rows.shape[0] == 1:
        yield slice(0, 1), moving_points(rows[0], movements, times)[0][None]
        return
    every = -(-times.size // INSTANTS) if rows.shape[0] > FEW else 1
    still, slopes = _carried(tuple(movements), count, tuple(times[::every].tolist()))
    size = still.size // (3 * count)
    step = max(1, TOGETHER // size)
    for first in range(0, rows.shape[0], step):
        part = slice(first, first + step)
        yield part, (rows[part].reshape(-1, 3 * count) @ slopes + still).reshape(-1, size, count, 3)


def moving_rows(points: Array, movements: Sequence[Movement], times: Array) -> Array:
    """Return the points of drives at instants, array (..., t, n+2, 3) [m].

    points (..., n+2, 3) [m]: as drawn; times (t,) [s].
    Where a joint bends 90° or more, those as drawn.
    """
    outer, count = points.shape[:-2], points.shape[-2]
    if not outer:
        moved = moving_points(points, movements, times)[0]
    else:
        still, slopes = _carried(tuple(movements), count, tuple(times.tolist()))
        moved = (points.reshape(*outer, 3 * count) @ slopes + still).reshape(*outer, times.size, count, 3)
    possible = np.all(_joint_angles(moved)[1] > 1e-15, axis=-1)
    found: Array = np.where(possible[..., None, None], moved, points[..., None, :, :])
    return found


@lru_cache(maxsize=8)
def _carried(movements: tuple[Movement, ...], count: int, instants: tuple[float, ...]) -> tuple[Array, Array]:
    """Return where movements carry points at the origin (k,), and how that goes with each coordinate (3(n+2), k)."""
    times = np.asarray(instants)
    still = moving_points(np.zeros((count, 3)), movements, times)[0].ravel()
    units = np.eye(3 * count).reshape(3 * count, count, 3)
    return still, np.stack([moving_points(unit, movements, times)[0].ravel() - still for unit in units])


def _joint_angles(points: Array) -> tuple[Array, Array]:
    """Return the joint angles of points (..., n+2, 3) and their cosines, arrays (..., n); one may be 90° and more."""
    along = np.diff(points, axis=-2)
    length = frames.norm(along)
    axis = along / np.where(length > 0.0, length, 1.0)[..., None]
    before, after = axis[..., :-1, :], axis[..., 1:, :]
    cosine = frames.dot(before, after)
    return np.arctan2(frames.norm(frames.cross(before, after)), cosine), cosine
