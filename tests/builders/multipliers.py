"""Torsional drives the long way: an angle for every station, and a multiplier for every joint that binds two of them.

Nothing here is shared with the program: the law of the joint is that of the tangents, its derivatives are written by
hand, and the accelerations come from one linear system with the constraints differentiated twice.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from scipy.integrate import solve_ivp


def law(theta: float, joint_angle: float) -> tuple[float, float, float]:
    """Return T, T' and T'' of tan T = tan θ/cos α."""
    turns = round(theta / np.pi)
    whole = np.arctan(np.tan(theta) / np.cos(joint_angle)) + np.pi * turns
    below = 1.0 - np.sin(joint_angle) ** 2 * np.cos(theta) ** 2
    first = np.cos(joint_angle) / below
    return whole, first, -np.cos(joint_angle) * np.sin(joint_angle) ** 2 * np.sin(2.0 * theta) / below**2


@dataclass
class Chain:
    """Shafts as lists of stations; every station has inertia."""

    inertia: list[list[float]]
    stiffness: list[list[float]]
    damping: list[list[float]]
    joint_angle: list[float]
    phase: list[float]
    gap: list[list[float]] | None = None
    ground: list[list[float]] | None = None
    torques: list[tuple[int, Callable[[float, float, float], float]]] = field(default_factory=list)
    input_speed: float | None = None

    def __post_init__(self) -> None:
        counts = [len(one) for one in self.inertia]
        starts = np.concatenate(([0], np.cumsum(counts)))
        self.mass = np.concatenate(self.inertia)
        self.springs = [
            (starts[i] + k, starts[i] + k + 1, c, self.damping[i][k], self.gap[i][k] if self.gap else 0.0)
            for i, shaft in enumerate(self.stiffness)
            for k, c in enumerate(shaft)
        ]
        self.drag = np.concatenate(self.ground) if self.ground else np.zeros(len(self.mass))
        self.pairs = [(starts[i + 1] - 1, starts[i + 1]) for i in range(len(counts) - 1)]

    def torque(self, e: int, angle: np.ndarray, speed: np.ndarray) -> float:
        """Return the torque of an element."""
        a, b, c, d, gap = self.springs[e]
        x = angle[a] - angle[b]
        over = x - np.clip(x, -0.5 * gap, 0.5 * gap)
        return c * over + (d * (speed[a] - speed[b]) if gap == 0.0 or over else 0.0)

    def acceleration(self, time: float, angle: np.ndarray, speed: np.ndarray) -> np.ndarray:
        """Return the accelerations of all stations."""
        n = len(self.mass)
        acting = -self.drag * speed
        for e, (a, b, *_rest) in enumerate(self.springs):
            t = self.torque(e, angle, speed)
            acting[a] -= t
            acting[b] += t
        for k, of in self.torques:
            acting[k] += of(time, angle[k], speed[k])
        rows, right = [], []
        for (a, b), joint_angle, phase in zip(self.pairs, self.joint_angle, self.phase, strict=True):
            _whole, first, second = law(angle[a] + phase, joint_angle)
            row = np.zeros(n)
            row[b], row[a] = 1.0, -first
            rows.append(row)
            right.append(second * speed[a] ** 2)
        if self.input_speed is not None:
            row = np.zeros(n)
            row[0] = 1.0
            rows.append(row)
            right.append(0.0)
        m = len(rows)
        system = np.zeros((n + m, n + m))
        system[:n, :n] = np.diag(self.mass)
        system[:n, n:], system[n:, :n] = np.transpose(rows).reshape(n, m), np.reshape(rows, (m, n))
        return np.linalg.solve(system, np.concatenate((acting, right)))[:n]

    def start(self, angle: dict[int, float], speed: float) -> np.ndarray:
        """Return angles and speeds of all stations from those that have coordinates of their own."""
        q, v = np.zeros(len(self.mass)), np.full(len(self.mass), speed)
        for k, value in angle.items():
            q[k] = value
        for (a, b), joint_angle, phase in zip(self.pairs, self.joint_angle, self.phase, strict=True):
            q[b] = law(q[a] + phase, joint_angle)[0] - law(phase, joint_angle)[0]
            v[b] = law(q[a] + phase, joint_angle)[1] * v[a]
        return np.concatenate((q, v))

    def follow(
        self, span: float, *, angle: dict[int, float] | None = None, speed: float = 0.0, step: float = np.inf
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return angles, speeds and element torques at the end."""
        n = len(self.mass)

        def slope(time: float, y: np.ndarray) -> np.ndarray:
            return np.concatenate((y[n:], self.acceleration(time, y[:n], y[n:])))

        start = self.start(angle or {}, self.input_speed if self.input_speed is not None else speed)
        found = solve_ivp(slope, (0.0, span), start, method="DOP853", rtol=1e-11, atol=1e-11, max_step=step)
        end = found.y[:, -1]
        return end[:n], end[n:], np.asarray([self.torque(e, end[:n], end[n:]) for e in range(len(self.springs))])
