"""The tripod joint."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from cardan.maths.arrays import Array
from cardan.maths.kernel import mobius
from cardan.units import quantity

from .joint import CROSS_ONLY, Joint


@dataclass(frozen=True, kw_only=True, slots=True)
class Tripod(Joint):
    """Tripod joint: three rollers in straight tracks; even, while its spider runs round a circle thrice a turn."""

    kind: ClassVar[str] = "tripod"
    foreign: ClassVar[frozenset[str]] = CROSS_ONLY
    steepest: ClassVar[float] = math.radians(26.0)

    track_radius: float | None = quantity(
        "length", None, doc="distance of the tracks from their shaft's axis", above=0.0
    )

    def pair(self, bend: Array) -> mobius.Pair:
        """Return the identity, exact while the spider's shaft keeps its direction."""
        return mobius.turn(0.0 * bend)
