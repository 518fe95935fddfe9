"""What acts on the stations of a torsional model: laws of torques, and motions forced on the first."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol, TypeAlias

import numpy as np

from cardan.errors import Problem, check
from cardan.maths.arrays import Array, namespace
from cardan.texts import _

# Motions that are forced on the first station of a drive: angle, speed and acceleration over time.


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


# Laws of the torques that act on stations: how large at a time, an angle and a speed, and their slopes.

Slopes: TypeAlias = tuple[Array, Array, Array]
"""Torque [N·m], its derivative by the angle [N·m/rad] and by the speed [N·m·s/rad]."""


class Law(Protocol):
    """How a torque depends on time, on the angle of its station and on its speed; positive with the rotation."""

    def at(self, time: Array, angle: Array, speed: Array) -> Slopes:
        """Return torque, slope by angle and slope by speed at times, angles and speeds of one shape."""

    @property
    def order(self) -> float | None:
        """Swings in one turn of the station; 0 where it does not depend on the angle, None where it runs in time."""


@dataclass(frozen=True, kw_only=True)
class Constant:
    """Constant torque: `value` [N·m]."""

    value: Array

    order = 0.0

    def at(self, time: Array, angle: Array, speed: Array) -> Slopes:
        """Return the same torque everywhere."""
        nothing = 0.0 * angle
        return self.value + nothing, nothing, nothing


@dataclass(frozen=True, kw_only=True)
class Swinging:
    """Harmonic torque a sin(order·F + phase), F the angle of its station."""

    amplitude: Array  # (...) [N·m]
    frequency: float  # swings in one turn of the station
    phase: Array = 0.0  # (...) [rad]: phase of the sine at the start position

    @property
    def order(self) -> float:
        """Swings in one turn of the station."""
        return self.frequency

    def at(self, time: Array, angle: Array, speed: Array) -> Slopes:
        """Return a sin(order·F + phase)."""
        xp = namespace(angle)
        inside = self.frequency * angle + self.phase
        return self.amplitude * xp.sin(inside), self.amplitude * self.frequency * xp.cos(inside), 0.0 * angle


@dataclass(frozen=True, kw_only=True)
class Falling:
    """Torque that falls with the speed: M0 - slope·Ḟ; a load that rises with the speed has M0 ≤ 0."""

    standstill: Array  # (...) [N·m]: M0
    slope: Array  # (...) [N·m·s/rad]

    order = 0.0

    def at(self, time: Array, angle: Array, speed: Array) -> Slopes:
        """Return M0 - slope·Ḟ."""
        nothing = 0.0 * angle
        return self.standstill - self.slope * speed, nothing, nothing - self.slope


@dataclass(frozen=True, kw_only=True)
class SpeedTable:
    """Torque read off a table over the speed, straight between its points, held beyond its ends."""

    speeds: Array  # (k,) [rad/s]: rising
    torques: Array  # (k,) [N·m]

    order = 0.0

    def at(self, time: Array, angle: Array, speed: Array) -> Slopes:
        """Return what the table says at the speed."""
        value, slope = _read(self.speeds, self.torques, speed)
        return value, 0.0 * angle, slope


@dataclass(frozen=True, kw_only=True)
class History:
    """Torque over time, straight between its points, held beyond its ends."""

    times: Array  # (k,) [s]: rising
    torques: Array  # (k,) [N·m]

    order = None

    def at(self, time: Array, angle: Array, speed: Array) -> Slopes:
        """Return what the table says at the time."""
        value, _slope = _read(self.times, self.torques, time + 0.0 * angle)
        return value, 0.0 * angle, 0.0 * angle


@dataclass(frozen=True, kw_only=True)
class Asynchronous:
    """Asynchronous motor by Kloss: M = 2 M_p s s_p/(s² + s_p²) with the slip s = 1 - Ḟ/ω_sync."""

    synchronous_speed: Array  # (...) [rad/s]: ω_sync
    pullout_torque: Array  # (...) [N·m]: M_p
    pullout_slip: Array  # (...): s_p

    order = 0.0

    def at(self, time: Array, angle: Array, speed: Array) -> Slopes:
        """Return the torque at the slip of the speed."""
        slip = 1.0 - speed / self.synchronous_speed
        square = slip * slip + self.pullout_slip**2
        scale = 2.0 * self.pullout_torque * self.pullout_slip
        by_slip = scale * (self.pullout_slip**2 - slip * slip) / square**2
        return scale * slip / square, 0.0 * angle, -by_slip / self.synchronous_speed


def _read(places: Array, values: Array, where: Array) -> tuple[Array, Array]:
    """Return value and slope of a table at places."""
    left = np.clip(np.searchsorted(places, where, side="right") - 1, 0, max(len(places) - 2, 0))
    if len(places) == 1:
        return values[0] + 0.0 * where, 0.0 * where
    slope = (values[left + 1] - values[left]) / (places[left + 1] - places[left])
    inside = (where >= places[0]) & (where < places[-1])
    return np.interp(where, places, values), np.where(inside, slope, 0.0)


def base_period(orders: tuple[float, ...]) -> float | None:
    """Return the shortest of π, 2π and 4π of shaft angle that all orders allow [rad]; None where none does.

    >>> [round(base_period(orders) / math.pi) for orders in ((), (2.0,), (3.0,), (1.5, 4.0))]
    [1, 1, 2, 4]
    >>> base_period((6.8,)) is None
    True
    """
    for turns in (0.5, 1.0, 2.0):
        if all(abs(order * turns - round(order * turns)) <= 1e-9 * max(1.0, order) for order in orders):
            return 2.0 * math.pi * turns
    return None
