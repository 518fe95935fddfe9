"""The Weiss joint: balls between circular grooves, without a cage."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from cardan.errors import Problem
from cardan.maths.arrays import Array
from cardan.maths.kernel import mobius
from cardan.units import plain, quantity

from .joint import CROSS_ONLY, Joint, both_or_none
from .laws import offset_grooves, smooth_law


def groove_course(
    angle: Array, bend: Array, first: float | None, second: float | None, radius: float | None, balls: int
) -> tuple[Array, Array, Array]:
    """Return the mean of what balls in offset grooves ask for; even where both offsets are equal.

    Parameters
    ----------
    angle : array (...) [rad]
        θ of the first ball.
    bend : float or array () [rad]
        α.
    first, second, radius : float [m]
        Offsets of the groove centres and radius of the grooves.
    balls : int
        Balls at equal angles that carry.
    """
    if first is None or second is None or radius is None or first == second:
        return 0.0 * angle, 1.0 + 0.0 * angle, 0.0 * angle
    places = np.arange(balls) * (2.0 * np.pi / balls)

    def lead(theta: Array) -> Array:
        each: Array = offset_grooves.deviation(theta[:, None] + places, bend, first, second, radius)
        return np.mean(each, axis=-1)

    return smooth_law.course(angle, lead)


@dataclass(frozen=True, kw_only=True, slots=True)
class Weiss(Joint):
    """Weiss joint: balls where curved grooves cross; even where the grooves of both shafts are offset alike."""

    kind: ClassVar[str] = "weiss"
    fixed: ClassVar[bool] = True
    foreign: ClassVar[frozenset[str]] = CROSS_ONLY
    steepest: ClassVar[float] = math.radians(40.0)

    balls: int = plain(2, doc="number of balls that carry in one sense of turning", low=1)
    driving_offset: float | None = quantity(
        "length", None, doc="from the joint centre to the centre of the grooves on the driving shaft", above=0.0
    )
    driven_offset: float | None = quantity(
        "length", None, doc="from the joint centre to the centre of the grooves on the driven shaft", above=0.0
    )
    groove_radius: float | None = quantity("length", None, doc="radius of the grooves' middle line", above=0.0)

    def own_problems(self) -> Iterator[Problem]:
        """Yield grooves that are half given."""
        yield from both_or_none(self, "driving_offset", "driven_offset", "groove_radius")

    def pair(self, bend: Array) -> mobius.Pair | None:
        """Return the identity where the offsets are equal or not given, else None."""
        return mobius.turn(0.0 * bend) if self.driving_offset == self.driven_offset else None

    def deviation(self, angle: Array, bend: Array) -> tuple[Array, Array, Array]:
        """Return the mean of what the carrying balls ask for."""
        return groove_course(angle, bend, self.driving_offset, self.driven_offset, self.groove_radius, self.balls)
