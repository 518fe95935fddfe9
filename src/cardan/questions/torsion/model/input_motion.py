"""Motions that are forced on the first station of a drive: angle, speed and acceleration over time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from cardan.errors import Problem, check
from cardan.maths.arrays import Array
from cardan.texts import _


class InputMotion(Protocol):
    """How the first station turns, whatever torque that takes."""

    @property
    def breaks(self) -> tuple[float, ...]:
        """Times at which the acceleration jumps [s], rising."""

    def at(self, time: Array) -> tuple[Array, Array, Array]:
        """Return angle [rad], speed [rad/s] and acceleration [rad/s²] at times of any shape."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Uniform:
    """One speed all the time."""

    speed: float  # [rad/s]
    angle: float = 0.0  # [rad]: at time 0

    @property
    def breaks(self) -> tuple[float, ...]:
        """Return no times."""
        return ()

    def at(self, time: Array) -> tuple[Array, Array, Array]:
        """Return angle, speed and acceleration."""
        return self.angle + self.speed * time, self.speed + 0.0 * time, 0.0 * time


@dataclass(frozen=True, kw_only=True, slots=True)
class SpeedCourse:
    """Speed that runs straight from point to point and is held before the first and after the last."""

    times: tuple[float, ...]  # [s]: rising
    speeds: tuple[float, ...]  # [rad/s]: one for each time
    angle: float = 0.0  # [rad]: at the first of the times

    def __post_init__(self) -> None:
        problems = []
        if not self.times or not all(one < two for one, two in zip(self.times, self.times[1:], strict=False)):
            problems.append(Problem("times", _("need to rise, and at least one is needed")))
        if len(self.speeds) != len(self.times):
            text = _("{given} values given, {wanted} needed, one for each of {other}")
            problems.append(
                Problem("speeds", text.format(given=len(self.speeds), wanted=len(self.times), other="times"))
            )
        problems += [
            Problem(f"{name}[{k}]", _("{value} is not finite").format(value=value))
            for name, values in (("times", self.times), ("speeds", self.speeds))
            for k, value in enumerate(values)
            if not np.isfinite(value)
        ]
        check(problems)

    @property
    def breaks(self) -> tuple[float, ...]:
        """Return the times."""
        return self.times

    def at(self, time: Array) -> tuple[Array, Array, Array]:
        """Return angle, speed and acceleration; at one of the times the acceleration after it."""
        when, speed = np.asarray(self.times), np.asarray(self.speeds)
        slope = np.append(np.diff(speed) / np.diff(when), 0.0) if len(when) > 1 else np.zeros(1)
        piece = np.diff(when) * 0.5 * (speed[1:] + speed[:-1])
        whole = self.angle + np.append(0.0, np.cumsum(piece))
        k = np.clip(np.searchsorted(when, time, side="right") - 1, 0, len(when) - 1)
        after = np.asarray(time) - when[k]
        rate = np.where(after < 0.0, 0.0, slope[k])  # before the first time the first speed is held
        return whole[k] + (speed[k] + 0.5 * rate * after) * after, speed[k] + rate * after, rate
