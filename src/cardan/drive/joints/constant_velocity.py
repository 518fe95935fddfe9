"""Joints that pass the turn on evenly at any joint angle, whatever they look like inside."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from cardan.maths.arrays import Array
from cardan.maths.kernel import mobius
from cardan.texts import mark

from .joint import REFUSALS, Joint


@dataclass(frozen=True, kw_only=True, slots=True)
class ConstantVelocity(Joint):
    """Ideal constant-velocity joint: the driven shaft turns as uniformly as the driving one."""

    kind: ClassVar[str] = "constant_velocity"
    title: ClassVar[str] = mark("constant velocity")
    types: ClassVar[tuple[str, ...]] = ("block_double_disc",)
    any_type: ClassVar[bool] = True
    fixed: ClassVar[bool] = True
    refusals: ClassVar[Mapping[str, str]] = {
        **REFUSALS,
        "losses": mark("it is ideal and has no parts that rub; a joint with parts has its own kind"),
    }

    def pair(self, joint_angle: Array) -> mobius.Pair:
        """Return the identity."""
        return mobius.turn(0.0 * joint_angle)
