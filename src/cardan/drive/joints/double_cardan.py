"""Two Hooke joints close together, with a device that shares the bend between them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from cardan.maths.arrays import Array, namespace
from cardan.maths.kernel import mobius
from cardan.units import plain

from .joint import CROSS_ONLY, Joint
from .laws import double_cardan


@dataclass(frozen=True, kw_only=True, slots=True)
class DoubleCardan(Joint):
    """Double Hooke joint, its inner yokes in one plane, centred by a ball on one shaft or by an exact device."""

    kind: ClassVar[str] = "double_cardan"
    fixed: ClassVar[bool] = True
    foreign: ClassVar[frozenset[str]] = CROSS_ONLY
    steepest: ClassVar[float] = 0.5 * math.pi

    centring_ratio: float | None = plain(
        None,
        doc="distance of the centring ball from the joint centre on its own shaft, over the distance of both centres; "
        "without it the device halves the bend exactly",
        above=0.0,
        below=1.0,
    )
    ball_on: str = plain(
        "driving", doc="shaft that carries the centring ball: driving or driven", choices=("driving", "driven")
    )

    def pair(self, bend: Array) -> mobius.Pair:
        """Return the map of both joints together."""
        if self.centring_ratio is None:
            return mobius.turn(0.0 * bend)
        xp = namespace(bend)
        pair = double_cardan.pair(bend, xp.asarray(self.centring_ratio, dtype=xp.float64))
        return pair if self.ball_on == "driving" else mobius.inverse(pair)
