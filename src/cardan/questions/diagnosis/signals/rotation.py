"""How a shaft turned while it was recorded: its angle and speed over time."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
import scipy

from cardan.maths.arrays import Array, ArrayLike

LEAST_TURNS = 3.0  # a recording of fewer turns tells nothing of orders


@dataclass(frozen=True, eq=False, kw_only=True)
class Rotation:
    """Angle of a shaft over time, from knots between which it turns smoothly.

    Attributes
    ----------
    time : array (m,) [s]
        Of the knots, rising.
    angle : array (m,) [rad]
        Of the shaft there, rising; 0 is a pulse of the tacho where there is one.
    source : str
        Where it comes from: ``pulses``, ``speed``, ``angle`` or ``ridge``.
    confidence : float
        From 0 to 1: how far the speed can be relied on.
    phased : bool
        Whether angle 0 is a mark on the shaft, so that phases mean something; not so from a speed or a ridge.
    order : float
        Order that the ridge was taken for; 1 otherwise.
    alternatives : tuple of (float, float)
        Factors by which the true speed may differ from this one, with the probability of each; empty where pulses
        or a speed leave no choice.
    cautions : tuple of str
        What was doubtful.
    """

    time: Array
    angle: Array
    source: str = "pulses"
    confidence: float = 1.0
    phased: bool = True
    order: float = 1.0
    alternatives: tuple[tuple[float, float], ...] = ()
    cautions: tuple[str, ...] = field(default=())

    @cached_property
    def _forward(self) -> Any:
        return _smooth(self.time, self.angle)

    @cached_property
    def _backward(self) -> Any:
        return _smooth(self.angle, self.time)

    @property
    def turns(self) -> float:
        """Turns between the first and the last knot."""
        return float(self.angle[-1] - self.angle[0]) / (2.0 * math.pi)

    @property
    def speeds(self) -> tuple[float, float]:
        """Least and greatest speed, each over a whole turn [rad/s]."""
        lasting = np.diff(self.time_at(np.arange(self.angle[0], self.angle[-1] + 1e-9, 2.0 * math.pi)))
        if lasting.size == 0:
            return self.mean_speed, self.mean_speed
        return 2.0 * math.pi / float(np.max(lasting)), 2.0 * math.pi / float(np.min(lasting))

    @property
    def mean_speed(self) -> float:
        """Angle over time [rad/s]."""
        return float((self.angle[-1] - self.angle[0]) / (self.time[-1] - self.time[0]))

    def angle_at(self, time: ArrayLike) -> Array:
        """Return the angle at times, array (k,) [rad]; beyond the knots it goes on as at the last one."""
        return _carried_on(self._forward, self.time, np.asarray(time, dtype=float))

    def time_at(self, angle: ArrayLike) -> Array:
        """Return the times at angles, array (k,) [s]."""
        return _carried_on(self._backward, self.angle, np.asarray(angle, dtype=float))

    def speed_at(self, time: ArrayLike) -> Array:
        """Return the speed at times, array (k,) [rad/s]."""
        inside = np.clip(np.asarray(time, dtype=float), self.time[0], self.time[-1])
        return np.asarray(self._forward(inside, 1))


def _smooth(x: Array, y: Array) -> Any:
    """Return a curve through rising points: a cubic spline, or a monotone one where that would turn back."""
    if x.size < 3:
        return scipy.interpolate.CubicSpline(x, y, bc_type="natural")
    curve = scipy.interpolate.CubicSpline(x, y)
    between = 0.5 * (x[1:] + x[:-1])
    slopes = np.concatenate([curve(x, 1), curve(between, 1)])
    return curve if float(np.min(slopes)) > 0.0 else scipy.interpolate.PchipInterpolator(x, y)


def _carried_on(curve: Any, knots: Array, at: Array) -> Array:
    """Return a curve, beyond its ends straight on."""
    inside = np.clip(at, knots[0], knots[-1])
    slope = np.where(at < knots[0], curve(knots[0], 1), curve(knots[-1], 1))
    return np.asarray(curve(inside) + slope * (at - inside))
