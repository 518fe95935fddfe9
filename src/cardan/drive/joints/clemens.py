"""The Clemens coupling: hinged arms that meet, each end on a circle; other couplings with circular profiles alike."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from cardan.drive.shapes.ring import ring
from cardan.errors import Problem
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames, mobius
from cardan.maths.kernel.meshes import Surface, ball, joined, placed, revolved
from cardan.texts import _, mark
from cardan.units import plain, quantity

from .common.inner import InnerPair, touching
from .common.site import Site
from .common.stance import Stance
from .joint import REFUSALS, Joint
from .laws import profile_coupling


@dataclass(frozen=True, kw_only=True, slots=True)
class Profile:
    """Circular profile of a coupling in the meridian plane of its shaft: the path of an arm's end."""

    axial: float = quantity("length", doc="centre of the circle, along its own shaft from the joint centre")
    radial: float = quantity("length", doc="centre of the circle, from the axis of its shaft")
    radius: float = quantity("length", doc="radius of the circle: length of the arm", above=0.0)


@dataclass(frozen=True, kw_only=True, slots=True)
class Clemens(Joint):
    """Clemens coupling, or another one with circular profiles: even where both profiles are alike."""

    kind: ClassVar[str] = "clemens"
    title: ClassVar[str] = mark("Clemens")
    types: ClassVar[tuple[str, ...]] = ("clemens",)
    steepest: ClassVar[float] = 0.5 * math.pi
    refusals: ClassVar[Mapping[str, str]] = {
        **REFUSALS,
        "forces": mark("its arms touch beside the axes, so that its shafts take forces besides the couple"),
    }

    driving: Profile | None = plain(None, doc="profile of the driving shaft; without it the coupling counts as even")
    driven: Profile | None = plain(None, doc="profile of the driven shaft; as that of the driving one when not given")

    def own_problems(self) -> Iterator[Problem]:
        """Yield a driven profile without a driving one."""
        if self.driven is not None and self.driving is None:
            yield Problem("driving", _("missing; it goes with {other}").format(other="driven"), "missing")

    def pair(self, joint_angle: Array) -> mobius.Pair | None:
        """Return the identity for profiles alike, else None."""
        even = self.driven is None or self.driven == self.driving
        return mobius.turn(0.0 * joint_angle) if even else None

    def deviation(self, angle: Array, joint_angle: Array) -> tuple[Array, Array, Array]:
        """Return the law of the contact of both profiles."""
        if self.driving is None or self.driven is None:
            return 0.0 * angle, 1.0 + 0.0 * angle, 0.0 * angle
        one, other = (
            profile_coupling.Circle(axial=side.axial, radial=side.radial, radius=side.radius)
            for side in (self.driving, self.driven)
        )
        return profile_coupling.course(angle, joint_angle, one, other)

    def inner(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield the contact of its arms."""
        return touching(stance)

    def solid(self, site: Site) -> None:
        """Add its hubs and its hinged arms, which meet in the bisecting plane."""
        stance, radius = site.stance, site.size.radius
        tan = np.tan(0.5 * stance.joint_angle)
        marks, axes = (stance.driving, stance.driven), (stance.before, stance.after)
        for side, mark_, axis in zip(site.sides, marks, axes, strict=True):
            profile = self.driving if side.driving or self.driven is None else self.driven
            axial, radial, arm = 1.0 * radius, 0.3 * radius, 1.2 * radius
            if profile is not None:
                axial, radial, arm = profile.axial, profile.radial, profile.radius
            reach = max(side.reach, 1.15 * axial)
            wide = max(1.25 * radial, 0.3 * arm)
            hub = revolved(
                [(0.9 * axial, 0.0), (0.9 * axial, 0.8 * wide), (0.94 * axial, wide), (1.08 * axial, wide),
                 (reach, side.body), (reach, 0.0)], 24,
            )  # fmt: skip
            site.add_to(side, side.yoke, site.said(_("hub of {joint}")), hub)
            away = (-1.0 if side.driving else 1.0) * axis
            inward = frames.cross(stance.normal, axis)
            for j in range(3):
                spread = np.full(len(mark_), j * 2.0 * np.pi / 3.0)
                way = frames.rotate(mark_, np.broadcast_to(axis, mark_.shape), spread)
                slope = (way @ inward) * tan
                half = (slope * axial + radial) / (1.0 + slope**2)
                left = half**2 - (axial**2 + radial**2 - arm**2) / (1.0 + slope**2)
                height = half + np.sqrt(np.maximum(left, 0.0))
                hinge = stance.centre + axial * away + radial * way
                tip = stance.centre + (slope * height)[:, None] * away + height[:, None] * way
                along = frames.unit(tip - hinge)
                across = frames.unit(frames.cross(np.broadcast_to(away, way.shape), way))
                own = site.stage.track(hinge, along, frames.cross(across, along), across)
                said = site.said(_("arm of {joint}"))
                site.stage.add("arm", side.number, site.path, said, own, _link(arm), role=side.role, shade=0.2)


def _link(length: float) -> Surface:
    """Return an arm along x with an eye at its hinge and a knob at its end."""
    thin = 0.075 * length
    bar = revolved([(0.0, 0.0), (0.0, thin), (length, 0.8 * thin), (length, 0.0)], 12)
    eye = placed(
        ring(0.5 * thin, 1.7 * thin, 2.4 * thin, 16), np.asarray([(0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)])
    )
    return joined(bar, eye, placed(ball(1.3 * thin, 12), None, (length, 0.0, 0.0)))
