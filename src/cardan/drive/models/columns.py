"""Joint angles and plane twists of polylines of which few coordinates vary: by coordinate, not drive by drive.

What is the same in all of them is a number, not an array, and costs nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce
from itertools import pairwise
from typing import Any, TypeAlias

import numpy as np

from cardan.maths.arrays import Array

from .geometry import STRAIGHT, polyline

Number: TypeAlias = "Array | float"
"""The same in all drives, or an array (n,)."""

Vector: TypeAlias = tuple[Number, Number, Number]


@dataclass(frozen=True, eq=False, kw_only=True)
class Columns:
    """Many polylines, a number or an array (n,) for each joint or shaft."""

    joint_angle: tuple[Number, ...]  # α_1 … α_n [rad]
    plane_twist: tuple[Number, ...]  # β_2 … β_n [rad]
    length: tuple[Number, ...]  # of shafts 1 to n+1 [m]


def columns(points: Sequence[Vector], count: int) -> Columns:
    """Return bends, plane twists and lengths of polylines, as `cardan.drive.models.geometry.polyline` does.

    points, sequence of n+2 triples of float or array (count,) [m]: point of the input axis, joint centres, point of the
    output axis.
    Drives with a straight joint, whose plane is that of a neighbour, go through `polyline` itself, each by itself, so
    that what comes out for a drive does not depend on those beside it.
    """
    with np.errstate(all="ignore"):  # points that coincide have no direction, straight joints no plane
        return _columns(points, count)


def _columns(points: Sequence[Vector], count: int) -> Columns:
    steps = [_minus(b, a) for a, b in pairwise(points)]
    length = [_norm(step) for step in steps]
    axis = [_over(step, size) for step, size in zip(steps, length, strict=True)]
    across = [_cross(a, b) for a, b in pairwise(axis)]
    sine = [_norm(one) for one in across]
    cosine = [_dot(a, b) for a, b in pairwise(axis)]
    joint_angle: list[Number] = [np.arctan2(s, c) for s, c in zip(sine, cosine, strict=True)]
    normal = [_over(one, size) for one, size in zip(across, sine, strict=True)]
    twist: list[Number] = [
        np.arctan2(_dot(along, _cross(a, b)), _dot(a, b))
        for along, (a, b) in zip(axis[1:-1], pairwise(normal), strict=True)
    ]
    straight = reduce(np.logical_or, (one <= STRAIGHT for one in sine))
    rows = np.flatnonzero(np.broadcast_to(straight, (count,)))
    if rows.size:
        whole = np.stack([_rows(value, rows) for point in points for value in point], axis=-1)
        exact = polyline(whole.reshape(rows.size, len(points), 3))
        joint_angle = [_put(one, rows, exact.joint_angle[:, k], count) for k, one in enumerate(joint_angle)]
        twist = [_put(one, rows, exact.plane_twist[:, k], count) for k, one in enumerate(twist)]
    return Columns(joint_angle=tuple(joint_angle), plane_twist=tuple(twist), length=tuple(length))


def table(values: Sequence[Number], count: int) -> Array:
    """Return numbers and arrays (count,) as the columns of one array (count, k)."""
    found = np.empty((count, len(values)))
    for k, one in enumerate(values):
        found[:, k] = one
    return found


def _rows(value: Number, rows: Array) -> Array:
    return np.asarray(value)[rows] if np.ndim(value) else np.full(rows.size, value)


def _put(values: Number, rows: Array, exact: Array, count: int) -> Array:
    found = np.array(np.broadcast_to(values, (count,)))
    found[rows] = exact
    return found


def _minus(a: Vector, b: Vector) -> Vector:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def _dot(a: Vector, b: Vector) -> Any:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: Vector, b: Vector) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def _norm(a: Vector) -> Any:
    return np.sqrt(_dot(a, a))


def _over(a: Vector, size: Number) -> Vector:
    share = np.divide(1.0, size)
    return a[0] * share, a[1] * share, a[2] * share
