"""The Tracta joint."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from cardan.drive.shapes.yoke import ACROSS
from cardan.errors import Problem
from cardan.maths.arrays import Array
from cardan.maths.kernel import mobius
from cardan.maths.kernel.meshes import ball, circle, placed, plate
from cardan.texts import _, mark
from cardan.units import quantity

from .common import drawn
from .common.inside import Inside, missed
from .common.site import Site
from .joint import Joint, both_or_none
from .laws import tracta as law


@dataclass(frozen=True, kw_only=True, slots=True)
class Tracta(Joint):
    """Tracta joint: two forks and a grooved tongue between them; even where both forks are alike."""

    kind: ClassVar[str] = "tracta"
    title: ClassVar[str] = mark("Tracta")
    types: ClassVar[tuple[str, ...]] = ("tracta",)
    fixed: ClassVar[bool] = True
    steepest: ClassVar[float] = math.radians(50.0)

    driving_distance: float | None = quantity(
        "length", None, doc="from the joint centre to the middle of the groove of the driving fork", above=0.0
    )
    driven_distance: float | None = quantity(
        "length", None, doc="from the joint centre to the middle of the groove of the driven fork", above=0.0
    )

    def own_problems(self) -> Iterator[Problem]:
        """Yield a distance that stands alone."""
        yield from both_or_none(self, "driving_distance", "driven_distance")

    def pair(self, joint_angle: Array) -> mobius.Pair:
        """Return the map of the joint, the identity where both distances are equal."""
        if self.driving_distance is None or self.driven_distance is None:
            return mobius.turn(0.0 * joint_angle)
        return law.pair(joint_angle, self.driving_distance, self.driven_distance)

    def inside(self, joint_angle: float) -> Iterator[Inside]:
        """Yield how far its tongue misses the plane that halves the bend."""
        if self.driving_distance is not None and self.driven_distance is not None:
            yield missed(float(law.tilt(joint_angle, self.driving_distance, self.driven_distance)))

    def solid(self, site: Site) -> None:
        """Add its two forks and the slotted halves between them."""
        size, stance = site.size, site.stance
        tip = -0.3 * size.radius
        drawn.yoke(site, site.driving, size, bore=False, tip=tip)
        drawn.yoke(site, site.driven, size, bore=False, tip=tip, quarter=True)
        own = site.along(stance.centre, stance.middle, stance.halving(stance.theta))
        inner = 0.96 * (size.radius - 0.5 * size.ear)
        halves = (placed(ball(inner, 22, 0.06, 1.0), None), placed(ball(inner, 22, -1.0, -0.06), None))
        tongue = plate(circle(0.86 * inner, 24), -0.3 * inner, 0.3 * inner)
        text = site.said(_("tongue of {joint}, in the bisecting plane"))
        site.add("tongue", text, own, *halves, placed(tongue, ACROSS), shade=0.2)
