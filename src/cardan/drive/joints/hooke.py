"""The cross-and-yokes joint."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from cardan.maths.arrays import Array
from cardan.maths.kernel import frames, mobius
from cardan.texts import mark

from .common.inner import Stance
from .joint import EXACT, Joint


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
    place_sizes: ClassVar[tuple[str, ...]] = ("s1", "a1", "a2", "a3")
    stays: ClassVar[str] = mark("its cross slides along its journals and makes up for what is off")
    refusals: ClassVar[Mapping[str, str]] = {}

    def pair(self, joint_angle: Array) -> mobius.Pair:
        """Return the joint's Möbius map, see `cardan.maths.kernel.mobius`."""
        return mobius.hooke(joint_angle)

    def placing(self) -> tuple[str, ...]:
        """Return the errors of length within it, where its bearings hold the cross along its journals."""
        return () if self.cross is not None and self.cross.slides else self.place_sizes

    def head(self, stance: Stance, off: Mapping[str, Any] = EXACT) -> Array:
        """Return where its driven shaft starts: off by what closes the loop of its axes but for slides of the cross.

        s_1 z_1 + a_1 x_2 + a_2 x_3 + a_3 x_4, z_2 and z_3 against the marks; Kozhevnikov & Perfil'ev (1978), eq. 171.
        """
        if not off:
            return stance.centre
        u, v = stance.driving, stance.driven
        before, after = stance.before + 0.0 * u, stance.after + 0.0 * u
        ways = before, frames.cross(u, before), frames.cross(u, v), frames.cross(after, v)
        moved = [np.asarray(off[name])[..., None] * way for name, way in zip(self.place_sizes, ways, strict=True)]
        return stance.centre + np.sum(np.stack(np.broadcast_arrays(*moved)), axis=0)
