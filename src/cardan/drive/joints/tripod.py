"""The tripod joint."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np

from cardan.drive.shapes import ACROSS
from cardan.errors import Problem
from cardan.maths.arrays import Array, ArrayLike, floats, namespace
from cardan.maths.kernel import frames, mobius
from cardan.maths.kernel.meshes import Surface, ball, joined, placed, plate, revolved
from cardan.texts import _, mark
from cardan.units import quantity

from .common.inner import DRIVEN, DRIVING, Contact, InnerPair, Stance
from .common.site import Side, Site, about
from .joint import CROSS_ONLY, EXACT, Inside, Joint


@dataclass(frozen=True, kw_only=True, slots=True)
class Tripod(Joint):
    """Tripod joint: three rollers in straight tracks; uniform, while its spider runs round a circle thrice a turn."""

    kind: ClassVar[str] = "tripod"
    title: ClassVar[str] = mark("tripod")
    types: ClassVar[tuple[str, ...]] = ("tripod_plunging",)
    foreign: ClassVar[frozenset[str]] = CROSS_ONLY - {"friction"}
    rubbing: ClassVar[tuple[str, ...]] = ("track_radius",)
    pressed: ClassVar[tuple[str, ...]] = ("track_radius", "roller_diameter", "roller_crown", "track_section")
    static_pressure: ClassVar[float] = 4000e6
    rated: ClassVar[tuple[str, ...]] = ("track_radius", "roller_diameter", "bearing_capacity")
    fixed: ClassVar[bool] = True
    slides: ClassVar[bool] = True
    place_sizes: ClassVar[tuple[str, ...]] = ("track_radius", "pivot")
    steepest: ClassVar[float] = math.radians(26.0)

    track_radius: float | None = quantity(
        "length", None, doc="distance of the tracks from their shaft's axis", above=0.0
    )

    roller_diameter: float | None = quantity("length", None, doc="outer diameter of the rollers", above=0.0)
    roller_crown: float | None = quantity(
        "length", None, doc="radius of the profile of a roller, along its arm", above=0.0
    )
    track_section: float | None = quantity(
        "length", None, doc="radius of the section of a track, larger than that of the rollers", above=0.0
    )

    bearing_capacity: float | None = quantity(
        "force", None, doc="dynamic load rating of the bearing of one roller", above=0.0
    )

    pivot: float | None = quantity(
        "length", None, doc="distance of the joint at the far end of its shaft, which pivots there", above=0.0
    )

    plunge_out: float | None = quantity(
        "length", None, doc="how far it may be pulled out from where it is drawn", low=0.0
    )
    plunge_in: float | None = quantity(
        "length", None, doc="how far it may be pushed in from where it is drawn", low=0.0
    )

    def own_problems(self) -> Iterator[Problem]:
        """Yield a track narrower than its roller."""
        if self.track_section is not None and self.track_section <= (self.roller_crown or 0.0):
            yield Problem("track_section", _("is not more than roller_crown: the roller would not fit"), "inconsistent")

    def pair(self, joint_angle: Array) -> mobius.Pair:
        """Return the identity, exact while the spider's shaft keeps its direction."""
        return mobius.turn(0.0 * joint_angle)

    def inside(self, joint_angle: float) -> Iterator[Inside]:
        """Yield the circle of its spider."""
        if self.track_radius is not None:
            text = _("radius of the circle that the spider runs round three times a turn")
            value = float(orbit_radius(joint_angle, self.track_radius))
            yield Inside(key="orbit", meaning=text, value=value, dimension="length")
            if self.pivot is not None:
                own = joint_angle, self.track_radius, self.pivot
                text = _("angle by which its shaft nutates about the joint at its far end")
                yield Inside(key="nutation", meaning=text, value=float(shaft_tilt(*own)))
                text = _("angle error of 3rd order, ±, because its shaft pivots there")
                yield Inside(key="pivot_error", meaning=text, value=float(pivot_error(*own)))

    @property
    def alike(self) -> int:
        """Its three arms."""
        return 3

    def mechanism(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield its three tracks and the arms on which its rollers slide; nothing but a slide without its size."""
        if self.track_radius is None:
            yield from Joint.mechanism(self, stance)
            return
        for k, (way, at) in enumerate(self._rollers(stance), 1):
            link, track = mark("roller {count} of joint {number}"), mark("track {count} of joint {number}")
            arm, ahead = mark("arm {count} of joint {number}"), stance.before + 0.0 * way
            yield InnerPair(name=track, type="P", links=(DRIVING, link), point=at, axis=ahead, count=k, rubs=True)
            yield InnerPair(name=arm, type="SG", links=(DRIVEN, link), point=at, axis=way, count=k, rubs=True)

    def loaded(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield the same, each track with the contact of its roller."""
        sizes = self.roller_diameter, self.roller_crown, self.track_section
        touching = None
        if sizes[0] is not None and sizes[1] is not None and sizes[2] is not None:
            touching = Contact(across=1.0 / sizes[1] - 1.0 / sizes[2], along=2.0 / sizes[0])
        for pair in self.mechanism(stance) if self.track_radius is not None else ():
            own = pair.type == "P"
            rolls = 0.5 * (self.roller_diameter or 0.0) if own else 0.0
            yield replace(pair, told=own, contact=touching if own else None, rolls=rolls)

    def _rollers(self, stance: Stance, track: float | None = None) -> Iterator[tuple[Array, Array]]:
        """Yield the direction of each arm and the middle of its roller, arrays (..., 3)."""
        track = self.track_radius if track is None else track
        b, arm, theta = stance.after, stance.driven, stance.theta
        centre = replace(self, track_radius=track).head(stance)
        for j in range(3):
            angle = j * 2.0 * np.pi / 3.0
            way = frames.rotate(arm, np.broadcast_to(b, arm.shape), np.full(arm.shape[:-1], angle))
            far = np.asarray(roller_reach(theta + angle, stance.joint_angle, track or 0.0))
            yield way, centre + far[..., None] * way

    @property
    def wobbles(self) -> bool:
        """Whether it is known how far its spider orbits."""
        return self.track_radius is not None

    @property
    def felt_beyond(self) -> bool:
        """Whether it is said where its shaft pivots, and how far it wobbles there."""
        return self.wobbles and self.pivot is not None

    def head(self, stance: Stance, off: Mapping[str, Any] = EXACT) -> Array:
        """Return the centre of its spider, which moves in its own plane."""
        radius = (self.track_radius or 0.0) + off.get("track_radius", 0.0)
        x, y = spider_centre(stance.theta, stance.joint_angle, radius)
        up = frames.cross(stance.normal, stance.after)
        found: Array = stance.centre + x[..., None] * up + y[..., None] * stance.normal
        return found

    def held(self, length: float | None, off: Mapping[str, Any] = EXACT) -> float | Array | None:
        """Return where its shaft pivots."""
        return length if self.pivot is None else self.pivot + off.get("pivot", 0.0)

    @property
    def own_span(self) -> float | None:
        """Distance of opposite tracks, with their rollers [m]."""
        return 2.4 * self.track_radius if self.track_radius is not None else None

    def solid(self, site: Site) -> None:
        """Add housing, spider and rollers; its spider runs round three times a turn."""
        stance, (one, two) = site.stance, site.sides
        track = self.track_radius or 0.8 * site.size.radius
        joint_angle, b = stance.joint_angle, stance.after
        site.add_to(one, "housing", site.said(_("housing of {joint}")), _tulip(track, one, joint_angle))
        centre = replace(self, track_radius=track).head(stance)
        arm = stance.driven
        own = site.along(centre, b, arm)
        text = site.said(_("spider of {joint}"))
        site.stage.add("spider", two.number, site.path, text, own, _spider(track, joint_angle), role=two.role)
        thin = 0.34 * track
        stub = revolved([(0.1 * track, 0.0), (0.1 * track, thin), (two.reach, thin), (two.reach, 0.0)], 20)
        site.add_to(two, "driven yoke", text, stub)
        roller = placed(ball(0.36 * track, 18, -0.62, 0.62))
        for way, at in self._rollers(stance, track):
            moved = site.along(at, way, frames.cross(np.broadcast_to(b, way.shape), way))
            site.add("roller", site.said(_("roller of {joint}")), moved, roller, shade=0.5)


def _tulip(track: float, side: Side, joint_angle: float) -> Surface:
    """Return the housing of a tripod joint: three lobes round the tracks, open toward the spider."""
    turn = np.arange(60) * (2.0 * np.pi / 60)
    off = np.abs((turn + np.pi / 3.0) % (2.0 * np.pi / 3.0) - np.pi / 3.0)
    roller, thick = 0.4 * track, 0.2 * track
    inside = np.sqrt(np.maximum(roller**2 - (track * np.sin(off)) ** 2, 0.0)) + track * np.cos(off)
    hole = np.where(track * np.sin(off) < 0.96 * roller, inside, 0.78 * track)
    outer = np.maximum(hole + thick, 1.12 * track)
    way = np.stack((np.cos(turn), np.sin(turn)), axis=-1)
    mouth = -(0.08 * track + track * np.tan(joint_angle))
    floor = max(0.55 * track + 1.1 * track * np.tan(joint_angle), 0.7 * track)
    shell = placed(plate(outer[:, None] * way, mouth, floor, hole[:, None] * way, 0.06 * track), ACROSS)
    lid = placed(plate(outer[:, None] * way, floor - 0.1 * track, floor + 0.3 * track, bevel=0.08 * track), ACROSS)
    reach, body = max(side.reach, floor + 0.5 * track), side.body
    low = floor + 0.2 * track
    hub = revolved([(low, 0.0), (low, 0.8 * track), (low + 0.2 * track, body), (reach, body), (reach, 0.0)], 28)
    return joined(shell, lid, hub)


def _spider(track: float, joint_angle: float) -> Surface:
    hub = revolved(
        [(-0.3 * track, 0.0), (-0.3 * track, 0.44 * track), (0.3 * track, 0.44 * track), (0.3 * track, 0.0)], 22
    )
    far = (1.0 + 2.0 * (1.0 / np.cos(joint_angle) - 1.0)) * 1.24 * track
    arm = revolved([(0.0, 0.0), (0.0, 0.22 * track), (far, 0.22 * track), (far, 0.0)], 14)
    arms = [about(placed(arm, np.roll(np.eye(3), -1, axis=0)), j * 2.0 * np.pi / 3.0) for j in range(3)]
    return joined(hub, *arms)


# The tripod joint: three rollers on a spider run in three straight tracks of a housing, parallel to its axis.
#
# The tracks pierce the plane of the spider on an ellipse. Written as a complex number in that plane, x along its line
# of greatest slope, track k is R_A e^(iφ_k) + R_B e^(-iφ_k), R_A, R_B = R (1/cos α ± 1)/2, and the three rollers meet
# on lines 120° apart exactly for the angle ψ = φ and the centre P = -R_B e^(3iφ).


def orbit_radius(joint_angle: ArrayLike, radius: ArrayLike) -> Array:
    """Return the radius of the circle that the centre of the spider runs round three times a turn.

    joint_angle (...) [rad]: α in [0, π/2); radius (...) [m]: R, distance of the tracks from the axis of the housing.
    Returns (...) [m]: R_B = R (1/cos α - 1)/2, without a difference of near numbers.
    """
    alpha, size = floats(joint_angle, radius)
    xp = namespace(alpha, size)
    return size * xp.sin(0.5 * alpha) ** 2 / xp.cos(alpha)


def spider_centre(angle: ArrayLike, joint_angle: ArrayLike, radius: ArrayLike) -> tuple[Array, Array]:
    """Return the centre of the spider in its plane, from the axis of the housing.

    angle (...) [rad]: φ of the housing: of its first track from the line of greatest slope of the spider's plane.
    joint_angle (...) [rad]: α in [0, π/2); radius (...) [m]: R.
    Returns x, y (...) [m]: along the line of greatest slope and across it: -R_B cos 3φ, -R_B sin 3φ.
    """
    phi, alpha, size = floats(angle, joint_angle, radius)
    xp = namespace(phi, alpha, size)
    orbit = orbit_radius(alpha, size)
    return -orbit * xp.cos(3.0 * phi), -orbit * xp.sin(3.0 * phi)


def roller_reach(angle: ArrayLike, joint_angle: ArrayLike, radius: ArrayLike) -> Array:
    """Return the distance of a roller from the centre of the spider, along its arm.

    angle (...) [rad]: φ of the roller's own track; joint_angle (...) [rad]: α in [0, π/2); radius (...) [m]: R.
    Returns (...) [m]: R_A + 2 R_B cos 2φ: each roller slides 4 R_B on its arm, twice a turn.
    """
    phi, alpha, size = floats(angle, joint_angle, radius)
    xp = namespace(phi, alpha, size)
    orbit = orbit_radius(alpha, size)
    return size + orbit + 2.0 * orbit * xp.cos(2.0 * phi)


def track_travel(angle: ArrayLike, joint_angle: ArrayLike, radius: ArrayLike) -> Array:
    """Return how far along its track a roller stands from the middle.

    angle (...) [rad]: φ of the roller's own track; joint_angle (...) [rad]: α in [0, π/2); radius (...) [m]: R.
    Returns (...) [m]: R tan α cos φ.
    """
    phi, alpha, size = floats(angle, joint_angle, radius)
    xp = namespace(phi, alpha, size)
    return size * xp.tan(alpha) * xp.cos(phi)


def shaft_tilt(joint_angle: ArrayLike, radius: ArrayLike, length: ArrayLike) -> Array:
    """Return by how much a shaft that ends in a fixed joint nutates as the spider orbits, for a long shaft.

    joint_angle (...) [rad]: α in [0, π/2).
    radius, length (...) [m]: R, and L from the spider to the other joint of its shaft.
    Returns (...) [rad]: R_B/L. The angle ψ = φ is exact for a shaft that keeps its direction; `pivot_error` is what
    the tilt makes of it.
    """
    alpha, size, far = floats(joint_angle, radius, length)
    return orbit_radius(alpha, size) / far


def pivot_error(joint_angle: ArrayLike, radius: ArrayLike, length: ArrayLike) -> Array:
    """Return by how much the angle of a shaft that pivots on a far joint errs, three times a turn.

    joint_angle (...) [rad]: α in [0, π/2).
    radius, length (...) [m]: R, and L from the spider to the other joint of its shaft.
    Returns (...) [rad]: amplitude (R_B/L) tan(α/2): ψ - φ = (R_B/L) tan(α/2) sin 3φ, φ from where the
    spider's plane rises toward the far joint. An axis that leans by a small ε
    across the plane of the joint turns that plane by ε/sin α about one shaft and by ε cos α/sin α about the other.

    >>> print(f"{math.degrees(float(pivot_error(math.radians(20), 0.02, 0.3))):.4f}°")
    0.0216°
    """
    alpha = floats(joint_angle)[0]
    return shaft_tilt(joint_angle, radius, length) * namespace(alpha).tan(0.5 * alpha)
