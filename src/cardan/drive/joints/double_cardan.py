"""Two Hooke joints close together, with a device that shares the joint angle between them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from cardan.drive.shapes.yoke import caps, cross_body, fork
from cardan.maths.arrays import Array, namespace
from cardan.maths.kernel import frames, mobius
from cardan.maths.kernel.meshes import ball, placed, revolved
from cardan.texts import _, mark
from cardan.units import plain

from .common import drawn
from .common.inside import Inside
from .common.site import BACK, Site
from .joint import Joint
from .laws import double_cardan as law


@dataclass(frozen=True, kw_only=True, slots=True)
class DoubleCardan(Joint):
    """Double Hooke joint, its inner yokes in one plane, centred by a ball on one shaft or by an exact device."""

    kind: ClassVar[str] = "double_cardan"
    title: ClassVar[str] = mark("double cardan")
    types: ClassVar[tuple[str, ...]] = (
        "double_centred",
        "double_frame",
    )
    fixed: ClassVar[bool] = True
    steepest: ClassVar[float] = 0.5 * math.pi

    centring_ratio: float | None = plain(
        None,
        doc="distance of the centring ball from the joint centre on its own shaft, over the distance of both centres; "
        "without it the device halves the joint angle exactly",
        above=0.0,
        below=1.0,
    )
    ball_on: str = plain(
        "driving", doc="shaft that carries the centring ball: driving or driven", choices=("driving", "driven")
    )

    def pair(self, joint_angle: Array) -> mobius.Pair:
        """Return the map of both joints together."""
        if self.centring_ratio is None:
            return mobius.turn(0.0 * joint_angle)
        xp = namespace(joint_angle)
        pair = law.pair(joint_angle, xp.asarray(self.centring_ratio, dtype=xp.float64))
        return pair if self.ball_on == "driving" else mobius.inverse(pair)

    def inside(self, joint_angle: float) -> Iterator[Inside]:
        """Yield how it shares its joint angle, and the way of its ball."""
        ratio = self.centring_ratio
        if ratio is None:
            return
        joint_angles = law.split(joint_angle, ratio)
        first, second = joint_angles if self.ball_on == "driving" else joint_angles[::-1]
        yield Inside(
            key="driving_joint_angle", meaning=_("joint angle of the joint on the driving side"), value=float(first)
        )
        yield Inside(
            key="driven_joint_angle", meaning=_("joint angle of the joint on the driven side"), value=float(second)
        )
        text = _("way of the ball along the other shaft, over the distance of both joint centres")
        way = float(law.slide(joint_angle, ratio) - law.slide(0.0, ratio))
        yield Inside(key="ball_way", meaning=text, value=way, dimension=None)

    def half_length(self, apart: float) -> float:
        """Return how far either cross stands off the centre [m]."""
        return apart

    def solid(self, site: Site) -> None:
        """Add two crosses, the piece between them and what centres it."""
        stance = site.stance
        size = replace(site.size, cavity=min(site.size.cavity, 0.72 * site.apart))
        before, behind = self._spread(stance.joint_angle, 2.0 * site.apart)
        one, two = stance.centre - before * stance.before, stance.centre + behind * stance.after
        between = frames.unit(two - one)
        u = stance.driving
        inner = frames.unit(frames.cross(np.broadcast_to(between, u.shape), u))
        outer = frames.unit(frames.cross(np.broadcast_to(stance.after, u.shape), inner))
        drawn.yoke(site, site.driving, size, away=before)
        drawn.yoke(site, site.driven, size, away=behind)
        half = 0.5 * float(np.linalg.norm(two - one))
        track = site.along(0.5 * (one + two), between, inner)
        made = fork(size.radius, size.ear, size.lug, size.cap, min(size.cavity, 0.75 * half), half, 0.75 * size.radius)
        bearings = caps(size.radius, size.ear, size.cap)
        ways = ((None, (-half, 0.0, 0.0)), (BACK, (half, 0.0, 0.0)))
        text = site.said(_("middle piece of {joint}"))
        site.add("middle yoke", text, track, *(placed(made, *way) for way in ways), shade=0.15)
        said = _("bearings of joint {number}").format(number=site.number)
        site.add("bearing cap", said, track, *(placed(bearings, *way) for way in ways), shade=0.35)
        shape = cross_body(size.radius, size.ear, size.journal)
        for at, first, second in ((one, u, inner), (two, inner, outer)):
            own = site.stage.track(at, first, second, frames.cross(first, second))
            site.add("cross", drawn.cross_text(site, size), own, shape)
        side, away = (site.driving, before) if self.ball_on == "driving" else (site.driven, behind)
        stem, far = 0.2 * size.radius, away + size.cavity
        rod = placed(revolved([(0.0, 0.0), (0.0, stem), (far, stem), (far, 0.0)], 14), side.turn)
        text = site.said(_("ball that centres {joint}"))
        site.add("centring", text, side.track, rod, ball(0.34 * size.radius, 18), shade=0.45)

    def _spread(self, joint_angle: float, apart: float) -> tuple[float, float]:
        """Return how far both crosses stand from where the shafts meet [m]; ``apart`` is their distance."""
        if self.centring_ratio is None:
            half = 0.5 * apart / math.cos(0.5 * joint_angle)
            return half, half
        fixed = self.centring_ratio * apart
        free = float(law.slide(joint_angle, self.centring_ratio)) * apart
        return (fixed, free) if self.ball_on == "driving" else (free, fixed)
