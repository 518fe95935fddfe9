"""Joints that pass the turn on evenly at any joint angle, whatever they look like inside."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from cardan.maths.arrays import Array
from cardan.maths.kernel import mobius
from cardan.texts import mark
from cardan.units import quantity

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

    plunge_out: float | None = quantity(
        "length", None, doc="how far it may be pulled out from where it is drawn; with it the joint plunges", low=0.0
    )
    plunge_in: float | None = quantity(
        "length", None, doc="how far it may be pushed in from where it is drawn; with it the joint plunges", low=0.0
    )

    @property
    def slides(self) -> bool:  # type: ignore[override]
        """Whether it plunges: it says how far it may."""
        return self.plunge_out is not None or self.plunge_in is not None

    def pair(self, joint_angle: Array) -> mobius.Pair:
        """Return the identity."""
        return mobius.turn(0.0 * joint_angle)
