"""The cross-and-yokes joint."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from cardan.maths.arrays import Array
from cardan.maths.kernel import mobius
from cardan.texts import mark

from .joint import Joint


@dataclass(frozen=True, kw_only=True, slots=True)
class Hooke(Joint):
    """Universal joint of Hooke: two yokes held at right angles by a cross."""

    kind: ClassVar[str] = "hooke"
    title: ClassVar[str] = mark("Hooke")
    beside: ClassVar[str] = "double_cardan"
    types: ClassVar[tuple[str, ...]] = (
        "light", "medium", "heavy", "super_heavy", "rubber_bush_cross", "hooke_bolt_cross", "instrument_ring_tip",
        "instrument_ball_disc", "mill_rolling",
    )  # fmt: skip
    foreign: ClassVar[frozenset[str]] = frozenset()
    fixed: ClassVar[bool] = True
    crossed: ClassVar[bool] = True
    single_cross: ClassVar[bool] = True
    refusals: ClassVar[Mapping[str, str]] = {}

    def pair(self, joint_angle: Array) -> mobius.Pair:
        """Return the joint's Möbius map, see `cardan.maths.kernel.mobius`."""
        return mobius.hooke(joint_angle)
