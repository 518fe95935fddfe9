"""The cross joint whose two axes do not meet."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from cardan.answers.quantity import say
from cardan.drive.shapes import bearing, bracket, floor_frame
from cardan.errors import Problem
from cardan.maths.arrays import Array, ArrayLike, floats, namespace, unit_complex
from cardan.maths.kernel import frames, mobius
from cardan.maths.kernel.meshes import ball, placed
from cardan.texts import _, mark
from cardan.units import plain, quantity

from .common import site as drawn
from .common.inner import DRIVEN, FRAME, InnerPair, Stance, carried, crossed
from .common.site import Site
from .joint import CROSS_ONLY, EXACT, Inside, Joint, both_or_none


@dataclass(frozen=True, kw_only=True, slots=True)
class OffsetCross(Joint):
    """Cross joint with its pins a distance apart: it turns as Hooke's, and its driven shaft wobbles twice a turn."""

    kind: ClassVar[str] = "offset_cross"
    title: ClassVar[str] = mark("offset cross")
    types: ClassVar[tuple[str, ...]] = ("hooke_offset_cross",)
    foreign: ClassVar[frozenset[str]] = CROSS_ONLY - {"friction"}
    rubbing: ClassVar[tuple[str, ...]] = ("journal_span", "journal_diameter")
    place_sizes: ClassVar[tuple[str, ...]] = ("offset", "reach")
    crossed: ClassVar[bool] = True
    fixed: ClassVar[bool] = True

    offset: float = quantity("length", doc="distance of both pin axes, along their common perpendicular", low=0.0)
    reach: float = quantity(
        "length", doc="from the pin on the driving shaft to the sliding ball that holds the driven shaft", above=0.0
    )

    journal_span: float | None = quantity(
        "length", None, doc="distance between the middles of opposite bearings of either pin", above=0.0
    )
    journal_diameter: float | None = quantity("length", None, doc="diameter of the pins", above=0.0)

    pin_side: str = plain(
        "near",
        doc="where the driven pin lies: near, toward the ball, or far, away from it",
        choices=("near", "far"),
    )

    def own_problems(self) -> Iterator[Problem]:
        """Yield a support within the cross."""
        if self.reach <= self.offset:
            yield Problem("reach", _("is not more than the offset of the pins"), "inconsistent")
        yield from both_or_none(self, "journal_span", "journal_diameter")

    def pair(self, joint_angle: Array) -> mobius.Pair:
        """Return the map of the turn about the line from the joint centre to the ball: Hooke's, for any offset."""
        return mobius.hooke(joint_angle)

    def inside(self, joint_angle: float) -> Iterator[Inside]:
        """Yield the wobble of its driven shaft."""
        text = _("half angle of the cone on which the driven shaft wobbles, twice a turn")
        yield Inside(key="wobble", meaning=text, value=float(wobble(joint_angle, self.offset, self.reach)))

    def mechanism(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield both pins, a distance apart."""
        journal, span = self.journal_diameter or 0.0, self.journal_span or math.inf
        return crossed(stance, offset=self._aside, journal=journal, span=span)

    def loaded(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield the same, where the sizes of its pins are given."""
        if self.journal_span is not None:
            yield from self.mechanism(stance)

    def carried(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield the bearing of its driving shaft, and the sliding ball that holds the driven one."""
        yield next(iter(carried(stance)))
        ball, held = stance.centre + self.reach * stance.after, (DRIVEN, FRAME)
        along = self.shaft_behind(stance)[1]
        yield InnerPair(name=mark("sliding ball of joint {number}"), type="SG", links=held, point=ball, axis=along)

    def shaft_behind(self, stance: Stance) -> tuple[Array, Array]:
        """Return the driven pin and the line from it to the sliding ball."""
        pin = self.head(stance)
        held = stance.centre + self.reach * stance.after
        return pin, frames.unit(held - pin)

    @property
    def _aside(self) -> float:
        """Offset of the driven pin along the vector product of both pins, which leans toward the ball [m]."""
        return self.offset if self.pin_side == "near" else -self.offset

    @property
    def wobbles(self) -> bool:
        """Whether its pins stand apart."""
        return self.offset > 0.0

    def head(self, stance: Stance, off: Mapping[str, Any] = EXACT) -> Array:
        """Return where its driven pin meets the driven shaft."""
        aside = np.asarray(self._aside + math.copysign(1.0, self._aside) * off.get("offset", 0.0))
        found: Array = stance.centre + aside[..., None] * frames.cross(stance.driving, stance.driven)
        return found

    def held(self, length: float | None, off: Mapping[str, Any] = EXACT) -> float | Array:
        """Return where its sliding ball stands."""
        return self.reach + off.get("reach", 0.0)

    @property
    def ball(self) -> float:
        """Its reach."""
        return self.reach

    def solid(self, site: Site) -> None:
        """Add its cross, and the sliding ball that holds its driven shaft."""
        text = _("cross of {joint}: its pins stand {offset} apart")
        apart = say(text, joint=site.name, offset=drawn.length_text(self.offset))
        drawn.yokes_and_cross(site, offset=self._aside, text=apart)
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


# Cardan joint whose cross axes do not meet: the shaft turns by Hooke's law and wobbles twice a turn.
#
# Pin 1 stands on shaft 1 at O, pin 2 at the distance e along the common perpendicular of both pins. The output shaft
# meets pin 2 at Q and slides through a sphere S at |OS| = L; the joint angle α is the angle of shaft 1 with OS,
# whatever the supports do. Pin 2 is always at right angles to OS, so that the turn about OS is that of a Hooke joint,
# exactly.


def deviation(angle: ArrayLike, joint_angle: ArrayLike) -> Array:
    """Return how far the output yoke runs ahead of the input, φ2 - φ1; the law of the Hooke joint, for any offset.

    angle (...) [rad]: input angle φ1, of pin 1 from the plane of shaft 1 and OS.
    joint_angle (...) [rad]: bend α in [0, π/2).
    """
    phi, alpha = floats(angle, joint_angle)
    return mobius.angle_error(mobius.hooke(alpha), unit_complex(2.0 * phi))


def output_angle(angle: ArrayLike, joint_angle: ArrayLike) -> Array:
    """Return the output angle φ2 in (-π, π], arctan2(sin φ1, cos α cos φ1); see `deviation`."""
    phi, alpha = floats(angle, joint_angle)
    xp = namespace(phi, alpha)
    return xp.atan2(xp.sin(phi), xp.cos(alpha) * xp.cos(phi))


def _across(angle: Array, joint_angle: Array) -> tuple[Array, Array]:
    """Return what of the common perpendicular stands across and along OS, sin α |cos φ1| and the root of the rest."""
    xp = namespace(angle, joint_angle)
    across = xp.sin(joint_angle) * xp.abs(xp.cos(angle))
    return across, xp.sqrt(1.0 - across * across)


def tilt(angle: ArrayLike, joint_angle: ArrayLike, offset: ArrayLike, reach: ArrayLike, side: ArrayLike = 1.0) -> Array:
    """Return the angle ε of the output shaft with OS, about pin 2.

    angle (...) [rad]: input angle φ1; joint_angle (...) [rad]: bend α in [0, π/2).
    offset (...) [m]: distance e of the cross axes, not negative.
    reach (...) [m]: distance L of the support from pin 1, above e.
    side (...): +1 where pin 2 lies toward the support, -1 where it lies away from it.
    Returns (...) [rad].
    tan ε = e sin α |cos φ1|/(L - σ e √(1 - sin² α cos² φ1)), spec: joint with crossed axes; from the point
    Q = O + σ e c, c the common perpendicular of the pins, of which OS has √(1 - sin² α cos² φ1).
    """
    phi, alpha, e, far, sign = floats(angle, joint_angle, offset, reach, side)
    across, along = _across(phi, alpha)
    return namespace(phi, alpha, e, far).atan2(e * across, far - sign * e * along)


def span(angle: ArrayLike, joint_angle: ArrayLike, offset: ArrayLike, reach: ArrayLike, side: ArrayLike = 1.0) -> Array:
    """Return the length |QS| of the output shaft from pin 2 to its support; arguments as those of `tilt`.

    √(L² + e² - 2 L e σ √(1 - sin² α cos² φ1)).
    """
    phi, alpha, e, far, sign = floats(angle, joint_angle, offset, reach, side)
    across, along = _across(phi, alpha)
    return namespace(phi, alpha, e, far).sqrt((e * across) ** 2 + (far - sign * e * along) ** 2)


def wobble(joint_angle: ArrayLike, offset: ArrayLike, reach: ArrayLike) -> Array:
    """Return half the angle of the cone on which the output shaft wobbles, twice a turn, to first order in e/L.

    e sin α/(2L): Q runs on a circle of diameter e sin α, once in half a turn of the input.
    """
    alpha, e, far = floats(joint_angle, offset, reach)
    return 0.5 * e * namespace(alpha, e).sin(alpha) / far


def shaking_force(joint_angle: ArrayLike, offset: ArrayLike, mass: ArrayLike, speed: ArrayLike) -> Array:
    """Return the inertia force of a mass that runs with Q, at twice the speed of the shaft.

    joint_angle (...) [rad]: bend α; offset (...) [m]: distance e of the cross axes; mass (...) [kg]: mass at the
    joint.
    speed (...) [rad/s]: input speed ω.
    Returns (...) [N].
    m (e sin α/2) (2ω)², to first order in e/L.
    """
    alpha, e, m, omega = floats(joint_angle, offset, mass, speed)
    return 0.5 * m * e * namespace(alpha, e).sin(alpha) * (2.0 * omega) ** 2
