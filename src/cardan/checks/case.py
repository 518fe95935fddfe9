"""A way in which a drive runs, and what that asks of its joints and shafts: torques and couples over a turn."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from cardan.analysis.motion import motion
from cardan.drive.chain import Chain
from cardan.maths import mobius
from cardan.maths.arrays import Array

LOOK = 72
"""Positions in half a turn at which couples are looked at, before a parabola is laid through the largest."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Case:
    """Steady running at a torque and a speed, without masses and friction; leading axes (...) are those of the drives.

    Attributes
    ----------
    name : str
        What to call it; empty for the duty itself.
    torque : float or array (...) or None [N·m]
        Size of the torque.
    speed : float or array (...) or None [rad/s]
        Size of the input speed.
    share : float or array (...)
        Share of the whole time.
    block : bool
        Whether it is part of a duty cycle.
    chain : Chain
        Kinematic half of the drives.
    torque_at : str
        At which end the torque is given.
    """

    chain: Chain
    name: str = ""
    torque: Array | float | None = None
    speed: Array | float | None = None
    share: Array | float = 1.0
    block: bool = False
    torque_at: str = "output"

    @cached_property
    def bend(self) -> Array:
        """Bend of every joint, array (..., n) [rad]."""
        return self.chain.bend

    @cached_property
    def swing(self) -> Array:
        """Equivalent bend between each shaft and the end where the torque is given, array (..., n+1) [rad].

        Notes
        -----
        A chain of joints turns like one joint; so the torque of a shaft swings between M cos α and M/cos α.
        """
        chain, n = self.chain, self.chain.joints
        straight = np.zeros(chain.bend.shape[:-1])
        if self.torque_at == "input":
            return np.stack([straight, *(mobius.bend(pair) for pair in chain.products())], axis=-1)
        return np.stack([*(mobius.bend(self.between(i, n)) for i in range(n)), straight], axis=-1)

    def between(self, first: int, last: int) -> mobius.Pair:
        """Return the Möbius pair of the joints from ``first`` on, counted from 0, up to before ``last``."""
        part = mobius.partial_products(self.chain.bend[..., first:last], self.chain.turn_before[..., first:last])
        return part[-1]

    @cached_property
    def shaft_torque(self) -> tuple[Array, Array]:
        """Least and largest torque of every shaft over a turn, two arrays (..., n+1) [N·m]."""
        torque = self._torque[..., None]
        return torque * np.cos(self.swing), torque / np.cos(self.swing)

    @property
    def joint_torque(self) -> Array:
        """Largest torque over a turn on either side of every joint, array (..., n) [N·m]."""
        high = self.shaft_torque[1]
        found: Array = np.maximum(high[..., :-1], high[..., 1:])
        return found

    @property
    def couple(self) -> Array:
        """Largest couple across every cross over a turn, array (..., n) [N·m]; over the span it loads a journal."""
        return self._torque[..., None] * self._unit[0]

    @property
    def bending(self) -> tuple[Array, Array]:
        """Largest secondary couple of every joint on its driving and on its driven shaft, arrays (..., n) [N·m]."""
        torque = self._torque[..., None]
        return torque * self._unit[1], torque * self._unit[2]

    @property
    def end_bending(self) -> Array:
        """Largest secondary couple at either end of every shaft, array (..., n+1) [N·m]."""
        driving, driven = self.bending
        nothing = 0.0 * driving[..., :1]
        found: Array = np.maximum(
            np.concatenate((nothing, driven), axis=-1), np.concatenate((driving, nothing), axis=-1)
        )
        return found

    @property
    def mises_moment(self) -> Array:
        """Largest √(4 M_b² + 3 T²) at either end of every shaft, array (..., n+1) [N·m]; von Mises over 1/W_t."""
        torque = self._torque[..., None]
        driving, driven = torque * self._unit[3], torque * self._unit[4]
        nothing = 0.0 * driving[..., :1]
        found: Array = np.maximum(
            np.concatenate((nothing, driven), axis=-1), np.concatenate((driving, nothing), axis=-1)
        )
        return found

    @property
    def end_moment(self) -> Array:
        """Largest √(T² + M_b²) at either end of every shaft, array (..., n+1) [N·m]: the couple of the cross there."""
        couple = self.couple
        nothing = 0.0 * couple[..., :1]
        found: Array = np.maximum(
            np.concatenate((nothing, couple), axis=-1), np.concatenate((couple, nothing), axis=-1)
        )
        return found

    @property
    def _torque(self) -> Array:
        return np.asarray(self.torque, dtype=float)

    @cached_property
    def _unit(self) -> tuple[Array, ...]:
        """What a torque of 1 makes at every joint, arrays (..., n): couple, secondary couples, moments of von Mises."""
        found = motion(self.chain, np.linspace(0.0, math.pi, LOOK, endpoint=False))
        ratio, theta = found.shaft_ratio, found.joint_angle
        given = ratio[..., -1:, :] if self.torque_at == "output" else ratio[..., :1, :]
        passing = given / ratio
        driving, driven = passing[..., :-1, :], passing[..., 1:, :]
        tangent, sine = np.tan(self.bend)[..., None], np.sin(self.bend)[..., None]
        lean = np.sqrt(1.0 + (tangent * np.sin(theta)) ** 2)
        return (
            peak(driving * lean),
            peak(driving * tangent * np.abs(np.sin(theta))),
            peak(driving * lean * sine * np.abs(np.cos(theta))),
            peak(driving * np.sqrt(4.0 * lean**2 - 1.0)),
            peak(np.sqrt(4.0 * (driving * lean) ** 2 - driven**2)),
        )


def largest(values: Sequence[Array | float]) -> Array:
    """Return the largest of arrays (...), place by place."""
    found: Array = np.max(np.stack(np.broadcast_arrays(*(np.asarray(one, dtype=float) for one in values))), axis=0)
    return found


def peak(values: Array) -> Array:
    """Return the largest values of periodic curves, by a parabola through the largest samples.

    Parameters
    ----------
    values : array (..., p)
        At evenly spaced places of a period.

    Returns
    -------
    array (...)

    Examples
    --------
    >>> round(float(peak(2.0 + np.cos(np.arange(72) * 2 * np.pi / 72 + 0.03))), 7)
    3.0
    """
    at = np.argmax(values, axis=-1)[..., None]
    count = values.shape[-1]
    top = np.take_along_axis(values, at, axis=-1)[..., 0]
    left = np.take_along_axis(values, (at - 1) % count, axis=-1)[..., 0]
    right = np.take_along_axis(values, (at + 1) % count, axis=-1)[..., 0]
    curved = 2.0 * top - left - right
    safe = np.where(curved > 0.0, curved, 1.0)
    found: Array = top + np.where(curved > 0.0, (right - left) ** 2 / (8.0 * safe), 0.0)
    return found
