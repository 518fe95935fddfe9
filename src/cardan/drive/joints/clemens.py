"""The Clemens coupling: hinged arms that meet, each end on a circle; other couplings with circular profiles alike."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from cardan.errors import Problem
from cardan.maths.arrays import Array
from cardan.maths.kernel import mobius
from cardan.texts import _
from cardan.units import plain, quantity

from .joint import CROSS_ONLY, Joint
from .laws import profile_coupling


@dataclass(frozen=True, kw_only=True, slots=True)
class Profile:
    """Circular profile of a coupling in the meridian plane of its shaft: the path of an arm's end."""

    axial: float = quantity("length", doc="centre of the circle, along its own shaft from the joint centre")
    radial: float = quantity("length", doc="centre of the circle, from the axis of its shaft")
    radius: float = quantity("length", doc="radius of the circle: length of the arm", above=0.0)


@dataclass(frozen=True, kw_only=True, slots=True)
class Clemens(Joint):
    """Clemens coupling, or another one with circular profiles: even where both profiles are alike."""

    kind: ClassVar[str] = "clemens"
    foreign: ClassVar[frozenset[str]] = CROSS_ONLY
    steepest: ClassVar[float] = 0.5 * math.pi

    driving: Profile | None = plain(None, doc="profile of the driving shaft; without it the coupling counts as even")
    driven: Profile | None = plain(None, doc="profile of the driven shaft; as that of the driving one when not given")

    def own_problems(self) -> Iterator[Problem]:
        """Yield a driven profile without a driving one."""
        if self.driven is not None and self.driving is None:
            yield Problem("driving", _("missing; it goes with {other}").format(other="driven"), "missing")

    def pair(self, bend: Array) -> mobius.Pair | None:
        """Return the identity for profiles alike, else None."""
        even = self.driven is None or self.driven == self.driving
        return mobius.turn(0.0 * bend) if even else None

    def deviation(self, angle: Array, bend: Array) -> tuple[Array, Array, Array]:
        """Return the law of the contact of both profiles."""
        if self.driving is None or self.driven is None:
            return 0.0 * angle, 1.0 + 0.0 * angle, 0.0 * angle
        one, other = (
            profile_coupling.Circle(axial=side.axial, radial=side.radial, radius=side.radius)
            for side in (self.driving, self.driven)
        )
        return profile_coupling.course(angle, bend, one, other)
