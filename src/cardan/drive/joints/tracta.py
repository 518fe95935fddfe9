"""The Tracta joint."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from cardan.errors import Problem
from cardan.maths.arrays import Array
from cardan.maths.kernel import mobius
from cardan.units import quantity

from .joint import CROSS_ONLY, Joint, both_or_none
from .laws import tracta


@dataclass(frozen=True, kw_only=True, slots=True)
class Tracta(Joint):
    """Tracta joint: two forks and a grooved tongue between them; even where both forks are alike."""

    kind: ClassVar[str] = "tracta"
    fixed: ClassVar[bool] = True
    foreign: ClassVar[frozenset[str]] = CROSS_ONLY
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

    def pair(self, bend: Array) -> mobius.Pair:
        """Return the map of the joint, the identity where both distances are equal."""
        if self.driving_distance is None or self.driven_distance is None:
            return mobius.turn(0.0 * bend)
        return tracta.pair(bend, self.driving_distance, self.driven_distance)
