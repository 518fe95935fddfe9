"""The cross-and-yokes joint."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from cardan.maths.arrays import Array
from cardan.maths.kernel import mobius

from .joint import Joint


@dataclass(frozen=True, kw_only=True, slots=True)
class Hooke(Joint):
    """Universal joint of Hooke: two yokes held at right angles by a cross."""

    kind: ClassVar[str] = "hooke"
    fixed: ClassVar[bool] = True
    crossed: ClassVar[bool] = True

    def pair(self, bend: Array) -> mobius.Pair:
        """Return the joint's Möbius map, see `cardan.maths.kernel.mobius`."""
        return mobius.hooke(bend)
