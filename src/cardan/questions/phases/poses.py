"""One set of yoke angles for several poses of a drive.

A drive that is synchronous in one pose is not so in another. The yokes are the same in all: sought are those with the
smallest speed fluctuation in the worst pose, and those with the smallest mean over the poses by their share of time.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import scipy

from cardan.drive.models.chain import Chain
from cardan.maths.arrays import Array
from cardan.questions.motion.equivalence import equivalent_joint

from .family import distinct
from .setting import turned, with_yokes
from .spline_pitch import TIE, steps

EVERY = 1 << 14
"""Up to so many settings on teeth are looked at in every pose."""

SAMPLES = 2048
"""Settings looked at before the search."""

STARTS = 5
"""Best settings from which it starts."""

BLURS = (1e-3, 1e-5, 1e-8)
"""Rounding of the corner that δ has where it vanishes, share of the best δ looked at, in turn."""

OPTIONS: Any = {"maxiter": 200, "ftol": 1e-12}
"""For the search (SLSQP); its function values are of order one."""

Progress = Callable[[float], object]


def stacked(poses: Sequence[Chain]) -> Chain:
    """Return the drive in its poses as one batch (p, n)."""
    return Chain(
        joint_angle=np.stack([pose.joint_angle for pose in poses]),
        plane_twist=np.stack([pose.plane_twist for pose in poses]),
        yoke_angle=np.stack([pose.yoke_angle for pose in poses]),
        start_phase=np.stack([np.asarray(pose.start_phase) for pose in poses]),
    )


def speed_fluctuations(poses: Chain, yoke_angle: Array) -> Array:
    """Return δ of yoke settings (..., n-1) [rad] in every pose, array (..., p)."""
    return equivalent_joint(with_yokes(poses, _each(poses, yoke_angle))).speed_fluctuation


def _each(poses: Chain, yoke_angle: Array) -> Array:
    shape = (*yoke_angle.shape[:-1], poses.joint_angle.shape[0], yoke_angle.shape[-1])
    return np.broadcast_to(yoke_angle[..., None, :], shape)


def best_for_poses(
    poses: Chain,
    share: Array,
    yoke_angle: Array,
    free: Sequence[int],
    known: Array,
    progress: Progress | None = None,
) -> tuple[Array, Array, bool]:
    """Return the settings with the least worst and with the least mean speed_fluctuation over the poses.

    poses (p, n): the drive in its poses; share (p,): shares of time, summing to one.
    yoke_angle (n-1,) [rad]: held and present yoke angles; free: indices of the free ones.
    known (s, n-1) [rad]: settings worth starting from, such as those that are synchronous in one pose.
    Returns worst, mean (n-1,) [rad]: yoke angles for the least worst and the least mean speed_fluctuation; complete:
    False when stopped.
    """
    if not free:
        return yoke_angle, yoke_angle, True
    rows = np.concatenate((yoke_angle[None], known, np.repeat(yoke_angle[None], SAMPLES, axis=0)))
    rows[-SAMPLES:, list(free)] = np.random.default_rng(len(free)).uniform(0.0, np.pi, (SAMPLES, len(free)))
    uneven = speed_fluctuations(poses, rows)
    answers: list[Array] = []
    total = 2 * STARTS
    for number, (judge, search) in enumerate(((_worst, _min_max), (_mean, _least_mean))):
        cost = judge(uneven, share)
        best, least = rows[int(np.argmin(cost))], float(np.min(cost))
        for k, start in enumerate(distinct(rows[np.argsort(cost, kind="stable")], STARTS)):
            if progress is not None and progress((number * STARTS + k) / total) == "stop":
                answers.append(best)
                return answers[0], answers[-1], False
            found = search(poses, share, start, list(free), max(least, 1e-9))
            value = float(judge(speed_fluctuations(poses, found), share))
            if value < least:
                best, least = found, value
        answers.append(best)
    return answers[0], answers[1], True


def best_on_teeth(poses: Chain, share: Array, yoke_angle: Array, teeth: Mapping[int, int], found: Array) -> Array:
    """Return the settings that splines allow with the least worst and the least mean speed_fluctuation over the poses.

    poses (p, n): the drive in its poses; share (p,): shares of time, summing to one.
    yoke_angle (n-1,) [rad]: present yoke angles, from which the teeth count.
    teeth: index 0 … n-2 of a yoke angle -> teeth of the spline there.
    found (2, n-1) [rad]: the best without teeth, whose other yoke angles are kept.
    Returns (2, n-1) [rad]: of all settings where there are at most `EVERY`, else of those a tooth beside the best
    without teeth.
    """
    every = math.prod(steps(z) for z in teeth.values()) <= EVERY
    rows = []
    for judge, base in zip((_worst, _mean), found, strict=True):
        places = []
        for k, z in sorted(teeth.items()):
            pitch = np.pi / steps(z)
            near = round(float(base[k] - yoke_angle[k]) / pitch)
            places.append(yoke_angle[k] + pitch * (np.arange(steps(z)) if every else near + np.arange(-1, 2)))
        grid = np.stack([one.ravel() for one in np.meshgrid(*places, indexing="ij")], axis=-1)
        some = np.repeat(base[None], len(grid), axis=0)
        some[:, sorted(teeth)] = grid
        cost = judge(speed_fluctuations(poses, some), share)
        away = np.sum(np.abs(np.sin(some - yoke_angle)), axis=-1)
        alike = np.flatnonzero(cost <= np.min(cost) + TIE)
        rows.append(some[alike[int(np.argmin(np.round(away[alike], 9)))]])
    return np.stack(rows)


def _worst(uneven: Array, share: Array) -> Array:
    return np.max(uneven, axis=-1)


def _mean(uneven: Array, share: Array) -> Array:
    return np.sum(share * uneven, axis=-1)


def _squares(poses: Chain, yoke_angle: Array, free: list[int]) -> tuple[Array, Array]:
    """Return |b|² of each pose (p,) and its derivatives by the free yokes (p, f); δ² = 16 |b|² (1 + |b|²)."""
    (_a, b), _da, db = turned(with_yokes(poses, _each(poses, yoke_angle)))
    return np.abs(b) ** 2, 2.0 * np.real(np.conj(b)[:, None] * db[:, free])


def _put(start: Array, free: list[int], x: Array) -> Array:
    moved = start.copy()
    moved[free] = x
    return moved


def _min_max(poses: Chain, share: Array, start: Array, free: list[int], scale: float) -> Array:
    """Minimise t with |b|² ≤ t in every pose."""
    unit = (0.25 * scale) ** 2

    def room(z: Array) -> Array:
        return z[-1] - _squares(poses, _put(start, free, z[:-1]), free)[0] / unit

    def room_slope(z: Array) -> Array:
        slope = _squares(poses, _put(start, free, z[:-1]), free)[1]
        return np.column_stack((-slope / unit, np.ones(len(slope))))

    top = float(np.max(_squares(poses, start, free)[0])) / unit
    pick = np.append(np.zeros(len(free)), 1.0)

    def top_of(z: Array) -> float:
        return float(z[-1])

    def rise(z: Array) -> Array:
        return pick

    kept: Any = {"type": "ineq", "fun": room, "jac": room_slope}
    found = scipy.optimize.minimize(
        top_of,
        np.append(start[free], top),
        jac=rise,
        method="SLSQP",
        constraints=kept,
        options=OPTIONS,
    ).x
    return _put(start, free, found[:-1])


def _least_mean(poses: Chain, share: Array, start: Array, free: list[int], scale: float) -> Array:
    """Minimise Σ share δ with rounded corners."""
    near = start[free]
    for blur in BLURS:

        def mean(x: Array, blur: float = blur) -> tuple[float, Array]:
            square, slope = _squares(poses, _put(start, free, x), free)
            uneven = np.sqrt(16.0 * square * (1.0 + square) + (blur * scale) ** 2)
            each = share * 8.0 * (1.0 + 2.0 * square) / uneven
            return float(np.sum(share * uneven)) / scale, np.sum(each[:, None] * slope, axis=0) / scale

        near = scipy.optimize.minimize(mean, near, jac=True, method="SLSQP", options=OPTIONS).x
    return _put(start, free, near)
