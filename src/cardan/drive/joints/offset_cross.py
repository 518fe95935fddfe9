"""The cross joint whose two axes do not meet."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from cardan.answers.quantity import say
from cardan.drive.shapes.support import bearing, bracket, floor_frame
from cardan.errors import Problem
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames, mobius
from cardan.maths.kernel.meshes import ball, placed
from cardan.texts import _, mark
from cardan.units import quantity

from .common import drawn
from .common.inner import InnerPair, crossed
from .common.inside import Inside
from .common.site import Site
from .common.stance import Stance
from .joint import REFUSALS, Joint
from .laws import offset_cross as law


@dataclass(frozen=True, kw_only=True, slots=True)
class OffsetCross(Joint):
    """Cross joint with its pins a distance apart: it turns as Hooke's, and its driven shaft wobbles twice a turn."""

    kind: ClassVar[str] = "offset_cross"
    title: ClassVar[str] = mark("offset cross")
    types: ClassVar[tuple[str, ...]] = ("hooke_offset_cross",)
    crossed: ClassVar[bool] = True
    refusals: ClassVar[Mapping[str, str]] = {
        **REFUSALS,
        "forces": mark("its driven shaft wobbles, so that its shafts take forces besides the couple"),
    }

    offset: float = quantity("length", doc="distance of both pin axes, along their common perpendicular", low=0.0)
    reach: float = quantity(
        "length", doc="from the pin on the driving shaft to the sliding ball that holds the driven shaft", above=0.0
    )

    def own_problems(self) -> Iterator[Problem]:
        """Yield a support within the cross."""
        if self.reach <= self.offset:
            yield Problem("reach", _("is not more than the offset of the pins"), "inconsistent")

    def pair(self, joint_angle: Array) -> mobius.Pair:
        """Return the map of the turn about the line from the joint centre to the ball: Hooke's, for any offset."""
        return mobius.hooke(joint_angle)

    def inside(self, joint_angle: float) -> Iterator[Inside]:
        """Yield the wobble of its driven shaft."""
        text = _("half angle of the cone on which the driven shaft wobbles, twice a turn")
        yield Inside(key="wobble", meaning=text, value=float(law.wobble(joint_angle, self.offset, self.reach)))

    def inner(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield both pins, a distance apart."""
        return crossed(stance, offset=self.offset)

    def shaft_behind(self, stance: Stance) -> tuple[Array, Array]:
        """Return the driven pin and the line from it to the sliding ball."""
        pin = stance.centre + self.offset * frames.cross(stance.driving, stance.driven)
        held = stance.centre + self.reach * stance.after
        return pin, frames.unit(held - pin)

    def solid(self, site: Site) -> None:
        """Add its cross, and the sliding ball that holds its driven shaft."""
        text = _("cross of {joint}: its pins stand {offset} apart")
        apart = say(text, joint=site.name, offset=drawn.length_text(self.offset))
        drawn.yokes_and_cross(site, offset=self.offset, text=apart)
        there = site.stance.centre + self.reach * site.stance.after
        frame = floor_frame(site.stance.after, np.asarray(site.gravity))
        radius = site.driven.thickest
        said = _("sliding ball that holds shaft {number}").format(number=site.driven.number)
        for part, shape, role, shade in (
            ("ball", ball(1.5 * radius, 24, -0.8, 0.8), "cross", 0.2),
            ("support", bearing(1.2 * radius, wide=False), "cross", 0.2),
            ("support", bracket(1.2 * radius, soft=False, wide=False, axial=False), "muted", 0.0),
        ):
            where = f"{site.path}.reach"
            site.stage.add(part, site.number, where, said, 0, placed(shape, frame, there), role=role, shade=shade)
