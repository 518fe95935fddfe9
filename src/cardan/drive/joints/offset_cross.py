"""The cross joint whose two axes do not meet."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from cardan.errors import Problem
from cardan.maths.arrays import Array
from cardan.maths.kernel import mobius
from cardan.texts import _
from cardan.units import quantity

from .joint import CROSS_ONLY, Joint


@dataclass(frozen=True, kw_only=True, slots=True)
class OffsetCross(Joint):
    """Cross joint with its pins a distance apart: it turns as Hooke's, and its driven shaft wobbles twice a turn."""

    kind: ClassVar[str] = "offset_cross"
    foreign: ClassVar[frozenset[str]] = CROSS_ONLY
    crossed: ClassVar[bool] = True

    offset: float = quantity("length", doc="distance of both pin axes, along their common perpendicular", low=0.0)
    reach: float = quantity(
        "length", doc="from the pin on the driving shaft to the sliding ball that holds the driven shaft", above=0.0
    )

    def own_problems(self) -> Iterator[Problem]:
        """Yield a support within the cross."""
        if self.reach <= self.offset:
            yield Problem("reach", _("is not more than the offset of the pins"), "inconsistent")

    def pair(self, bend: Array) -> mobius.Pair:
        """Return the map of the turn about the line from the joint centre to the ball: Hooke's, for any offset."""
        return mobius.hooke(bend)
