"""A drive as plain vectors: axes, cross arms, right angles; no phases, no matrices, no formula of the package.

Vectors are tuples of three components. A component may be a float, a NumPy array (many input angles at once) or an
mpmath number (many digits); ``lib`` is the library that knows sin, cos, sqrt and atan2 of it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

Vector = tuple[Any, Any, Any]


def dot(a: Vector, b: Vector) -> Any:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def scaled(a: Vector, k: Any) -> Vector:
    return (k * a[0], k * a[1], k * a[2])


def plus(a: Vector, b: Vector) -> Vector:
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def unit(a: Vector, lib: Any = np) -> Vector:
    return scaled(a, 1 / lib.sqrt(dot(a, a)))


def turned(a: Vector, axis: Vector, angle: Any, lib: Any = np) -> Vector:
    """Turn a vector about a unit axis by the right-hand rule."""
    c, s = lib.cos(angle), lib.sin(angle)
    return plus(plus(scaled(a, c), scaled(cross(axis, a), s)), scaled(axis, (1 - c) * dot(axis, a)))


@dataclass(frozen=True)
class VectorModel:
    """Shaft axes along the power flow, yoke angles of shafts 2 to n, and the driving arm of joint 1 at the start."""

    axes: tuple[Vector, ...]
    yoke_angles: tuple[Any, ...]
    arm: Vector
    lib: Any = np

    @classmethod
    def from_points(
        cls, points: Sequence[Sequence[Any]], yoke_angles: Sequence[Any] = (), start_phase: Any = 0, lib: Any = np
    ) -> VectorModel:
        axes = tuple(unit((b[0] - a[0], b[1] - a[1], b[2] - a[2]), lib) for a, b in pairwise(points))
        normal = unit(cross(axes[0], axes[1]), lib)
        return cls._starting(axes, normal, yoke_angles, start_phase, lib)

    @classmethod
    def from_angles(
        cls,
        joint_angles: Sequence[Any],
        plane_twists: Sequence[Any] = (),
        yoke_angles: Sequence[Any] = (),
        start_phase: Any = 0,
        lib: Any = np,
    ) -> VectorModel:
        """Lay the axes out by turning the plane's normal about the shaft, then the shaft about the normal."""
        zero = joint_angles[0] * 0
        axis: Vector = (zero + 1, zero, zero)
        first: Vector = (zero, zero + 1, zero)
        normal, axes = first, [axis]
        for k, joint_angle in enumerate(joint_angles):
            if k:
                normal = turned(normal, axis, plane_twists[k - 1], lib)
            axis = turned(axis, normal, joint_angle, lib)
            axes.append(axis)
        return cls._starting(tuple(axes), first, yoke_angles, start_phase, lib)

    @classmethod
    def _starting(
        cls, axes: tuple[Vector, ...], normal: Vector, yoke_angles: Sequence[Any], start_phase: Any, lib: Any
    ) -> VectorModel:
        given = tuple(yoke_angles) or (0,) * (len(axes) - 2)
        arm = turned(cross(normal, axes[0]), axes[0], start_phase, lib)
        return cls(axes, given, arm, lib)

    def arms(self, angle: Any) -> tuple[list[Vector], list[Vector]]:
        """Return the driving and the driven cross arm of every joint at an input angle from the start."""
        u = turned(self.arm, self.axes[0], angle, self.lib)
        driving, driven = [u], []
        for k, axis in enumerate(self.axes[1:]):
            v = unit(cross(axis, u), self.lib)
            driven.append(v)
            if k < len(self.yoke_angles):
                u = turned(v, axis, -self.yoke_angles[k], self.lib)
                driving.append(u)
        return driving, driven

    def angles(self, angle: Any) -> list[Any]:
        """Return the turn of every shaft from the start, each within half a turn of the input's.

        Without arrays the input angle should itself be below half a turn; arrays are followed by `continuous`.
        """
        zero, now = self.arms(0 * angle)[1], self.arms(angle)[1]
        return [angle] + [
            self.lib.atan2(dot(axis, cross(a, b)), dot(a, b))
            for axis, a, b in zip(self.axes[1:], zero, now, strict=True)
        ]

    def continuous(self, angle: np.ndarray) -> np.ndarray:
        """Return the continuous turn of every shaft over input angles that rise finely and contain zero."""
        rows = np.stack([np.unwrap(np.broadcast_to(row, angle.shape)) for row in self.angles(angle)])
        rows[0] = angle
        at_zero = int(np.argmin(np.abs(angle)))
        return rows - rows[:, at_zero, None]

    def ratios(self, angle: Any) -> list[Any]:
        """Return the speed of every shaft over that of the input."""
        driving, _driven = self.arms(angle)
        found = [1 + 0 * angle]
        for u, before, after in zip(driving, self.axes[:-1], self.axes[1:], strict=True):
            across = cross(after, u)
            found.append(found[-1] * dot(before, after) / dot(across, across))
        return found

    def speed_fluctuation(self, count: int = 1440) -> float:
        """Return largest minus smallest output ratio, from samples with a parabola through each extreme one.

        With 1440 samples of a turn the parabola misses a smooth extreme by less than 1e-9 for joint angles to 60°.
        """
        ratio = self.ratios(np.arange(count) * (2 * np.pi / count))[-1]
        ratio = np.broadcast_to(ratio, (count,))

        def extreme(values: np.ndarray) -> float:
            k = int(np.argmax(values))
            left, mid, right = values[k - 1], values[k], values[(k + 1) % count]
            curve = left - 2 * mid + right
            return float(mid if curve == 0 else mid - (right - left) ** 2 / (8 * curve))

        return extreme(ratio) + extreme(-ratio)
