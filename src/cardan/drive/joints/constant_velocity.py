"""Joints that pass the turn on evenly at any bend, whatever they look like inside."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from cardan.maths.arrays import Array
from cardan.maths.kernel import mobius

from .joint import CROSS_ONLY, Joint


@dataclass(frozen=True, kw_only=True, slots=True)
class ConstantVelocity(Joint):
    """Ideal constant-velocity joint: the driven shaft turns as evenly as the driving one."""

    kind: ClassVar[str] = "constant_velocity"
    fixed: ClassVar[bool] = True
    foreign: ClassVar[frozenset[str]] = CROSS_ONLY

    def pair(self, bend: Array) -> mobius.Pair:
        """Return the identity."""
        return mobius.turn(0.0 * bend)
