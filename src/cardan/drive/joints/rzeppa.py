"""The Rzeppa joint: balls in grooves, kept in a plane by a lever or by the grooves themselves."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from cardan.errors import Problem
from cardan.maths.arrays import Array
from cardan.maths.kernel import mobius
from cardan.texts import _, mark
from cardan.units import plain, quantity

from .common import drawn
from .common.inside import Inside
from .common.site import Site
from .joint import Joint, both_or_none
from .laws import pilot_lever, shared_turn, tilted_plane
from .weiss import ball_places, balls_inside, groove_course, groove_inside

LEVER = ("lever_b", "lever_c")
GROOVES = ("driving_offset", "driven_offset", "groove_radius")


@dataclass(frozen=True, kw_only=True, slots=True)
class Rzeppa(Joint):
    """Rzeppa joint: even where its balls lie in the bisecting plane, nearly even where lever or grooves miss it."""

    kind: ClassVar[str] = "rzeppa"
    title: ClassVar[str] = mark("Rzeppa")
    types: ClassVar[tuple[str, ...]] = (
        "rzeppa_lever",
        "rzeppa_offset",
        "rzeppa_fixed_modern",
        "plunging_ball_modern",
    )
    fixed: ClassVar[bool] = True
    steepest: ClassVar[float] = math.radians(47.0)

    balls: int = plain(6, doc="number of balls, all of which carry", low=3)
    lever_b: float | None = plain(None, doc="arm of the lever beyond the cage over that before it, b/a", above=0.0)
    lever_c: float | None = plain(
        None, doc="distance of the lever's fixed end from the joint centre over its arm before the cage, c/a", above=0.0
    )
    driving_offset: float | None = quantity(
        "length", None, doc="from the joint centre to the centre of the grooves on the driving shaft", above=0.0
    )
    driven_offset: float | None = quantity(
        "length", None, doc="from the joint centre to the centre of the grooves on the driven shaft", above=0.0
    )
    groove_radius: float | None = quantity("length", None, doc="radius of the grooves' middle line", above=0.0)

    def own_problems(self) -> Iterator[Problem]:
        """Yield a lever or grooves that are half given, and both at once."""
        yield from both_or_none(self, *LEVER)
        yield from both_or_none(self, *GROOVES)
        if self.lever_b is not None and self.groove_radius is not None:
            yield Problem("lever_b", _("the offset grooves place the balls already"), "inconsistent")

    def pair(self, joint_angle: Array) -> mobius.Pair | None:
        """Return the identity where nothing is said or the offsets are equal, else None."""
        even = self.lever_b is None and self.driving_offset == self.driven_offset
        return mobius.turn(0.0 * joint_angle) if even else None

    def deviation(self, angle: Array, joint_angle: Array) -> tuple[Array, Array, Array]:
        """Return the mean of what the balls ask for."""
        if self.lever_b is not None and self.lever_c is not None:
            tilt = pilot_lever.plane_error(joint_angle, self.lever_b, self.lever_c)
            return shared_turn.course(angle, tilted_plane.tau(joint_angle, tilt), shared_turn.places(self.balls))
        return groove_course(
            angle, joint_angle, self.driving_offset, self.driven_offset, self.groove_radius, self.balls
        )

    def inside(self, joint_angle: float) -> Iterator[Inside]:
        """Yield what its balls do beside turning."""
        if self.lever_b is not None and self.lever_c is not None:
            tilt = float(pilot_lever.plane_error(joint_angle, self.lever_b, self.lever_c))
            yield from balls_inside(tilt, tilted_plane.deviation(ball_places(self.balls), joint_angle, tilt))
        else:
            yield from groove_inside(
                joint_angle, self.driving_offset, self.driven_offset, self.groove_radius, self.balls
            )

    @property
    def own_span(self) -> float | None:
        """Distance of opposite balls, with their grooves [m]."""
        return 2.3 * self.groove_radius if self.groove_radius is not None else None

    def solid(self, site: Site) -> None:
        """Add bell, inner race, cage and balls."""
        drawn.bell_and_balls(site, count=self.balls, groove=self.groove_radius)
