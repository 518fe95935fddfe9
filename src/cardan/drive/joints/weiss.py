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
from cardan.maths.kernel.meshes import ball, placed
from cardan.texts import _, mark
from cardan.units import deg, plain, quantity

from .common import drawn
from .common.inside import Inside, missed
from .common.site import Site
from .joint import Joint, both_or_none
from .laws import offset_grooves, smooth_law


def groove_course(
    angle: Array, joint_angle: Array, first: float | None, second: float | None, radius: float | None, balls: int
) -> tuple[Array, Array, Array]:
    """Return the mean of what balls in offset grooves ask for; even where both offsets are equal.

    angle (...) [rad]: θ of the first ball; joint_angle () [rad]: α.
    first, second, radius [m]: offsets of the groove centres and radius of the grooves.
    balls: balls at equal angles that carry.
    """
    if first is None or second is None or radius is None or first == second:
        return 0.0 * angle, 1.0 + 0.0 * angle, 0.0 * angle
    places = np.arange(balls) * (2.0 * np.pi / balls)

    def angle_error(theta: Array) -> Array:
        each: Array = offset_grooves.deviation(theta[:, None] + places, joint_angle, first, second, radius)
        return np.mean(each, axis=-1)

    return smooth_law.course(angle, angle_error)


def balls_inside(tilt: float, angle_errors: Array) -> Iterator[Inside]:
    """Yield by how much the plane of the balls misses the middle, and what they ask for among themselves.

    tilt [rad]; angle_errors (p, k) [rad]: what each of k balls asks for, over a turn.
    """
    yield missed(tilt)
    text = _("play that its balls need, or strain between them")
    yield Inside(key="ball_spread", meaning=text, value=float(np.max(np.ptp(angle_errors, axis=-1))))


def groove_inside(
    joint_angle: float, first: float | None, second: float | None, radius: float | None, balls: int
) -> Iterator[Inside]:
    """Yield what balls in offset grooves do beside turning; nothing where the grooves are not given."""
    if first is None or second is None or radius is None:
        return
    angle_errors = offset_grooves.deviation(ball_places(balls), joint_angle, first, second, radius)
    yield from balls_inside(float(offset_grooves.plane_tilt(joint_angle, first, second)), angle_errors)


def ball_places(balls: int) -> Array:
    """Return the angles of balls over a turn, array (360, k) [rad]."""
    return np.arange(360)[:, None] * deg + np.arange(balls) * (2.0 * np.pi / balls)


@dataclass(frozen=True, kw_only=True, slots=True)
class Weiss(Joint):
    """Weiss joint: balls where curved grooves cross; even where the grooves of both shafts are offset alike."""

    kind: ClassVar[str] = "weiss"
    title: ClassVar[str] = mark("Weiss")
    types: ClassVar[tuple[str, ...]] = (
        "weiss_curved",
        "weiss_straight",
    )
    fixed: ClassVar[bool] = True
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

    def pair(self, joint_angle: Array) -> mobius.Pair | None:
        """Return the identity where the offsets are equal or not given, else None."""
        return mobius.turn(0.0 * joint_angle) if self.driving_offset == self.driven_offset else None

    def deviation(self, angle: Array, joint_angle: Array) -> tuple[Array, Array, Array]:
        """Return the mean of what the carrying balls ask for."""
        return groove_course(
            angle, joint_angle, self.driving_offset, self.driven_offset, self.groove_radius, self.balls
        )

    def inside(self, joint_angle: float) -> Iterator[Inside]:
        """Yield what its balls do beside turning."""
        yield from groove_inside(joint_angle, self.driving_offset, self.driven_offset, self.groove_radius, self.balls)

    @property
    def own_span(self) -> float | None:
        """Distance of opposite balls, with their grooves [m]."""
        return 2.3 * self.groove_radius if self.groove_radius is not None else None

    def solid(self, site: Site) -> None:
        """Add its two claws and the balls where their grooves cross."""
        size, stance = site.size, site.stance
        tip = -0.5 * size.radius
        drawn.yoke(site, site.driving, size, bore=False, tip=tip)
        drawn.yoke(site, site.driven, size, bore=False, tip=tip, quarter=True)
        groove = self.groove_radius or 0.72 * size.radius
        theta, said = stance.theta, site.said(_("ball of {joint}"))
        for j in range(4):
            own = drawn.across_halving(site, theta + (j + 0.5) * 0.5 * np.pi)
            shape = placed(ball(0.32 * groove, 18), None, (0.94 * groove, 0.0, 0.0))
            site.add("ball", said, own, shape, shade=0.55)
        own = site.along(stance.centre, stance.middle, stance.halving(theta))
        site.add("ball", said, own, ball(0.28 * groove, 18), shade=0.4)
