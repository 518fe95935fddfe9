"""The Rzeppa joint: balls in grooves, kept in a plane by a lever or by the grooves themselves."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from cardan.errors import Problem
from cardan.maths.arrays import Array, ArrayLike, floats, namespace
from cardan.maths.kernel import frames, mobius
from cardan.texts import _, mark
from cardan.units import plain, quantity

from .common import laws as shared_turn
from .common import laws as tilted_plane
from .common import site as drawn
from .common.inner import DRIVEN, DRIVING, InnerPair, Stance, centred
from .common.site import Site
from .joint import CROSS_ONLY, NO_BEARING, REFUSALS, Inside, Joint, both_or_none
from .weiss import (
    ball_centre,
    ball_places,
    balls_inside,
    groove_contact,
    groove_course,
    groove_inside,
    groove_mechanism,
    groove_stuck,
)

LEVER = ("lever_b", "lever_c")
GROOVES = ("driving_offset", "driven_offset", "groove_radius")
SMALL = 1e-4  # [rad]: step of a turn over which speeds of balls are taken, right to some 1e-9 of them


@dataclass(frozen=True, kw_only=True, slots=True)
class Rzeppa(Joint):
    """Rzeppa joint: even where its balls lie in the bisecting plane, nearly even where lever or grooves miss it."""

    kind: ClassVar[str] = "rzeppa"
    title: ClassVar[str] = mark("Rzeppa")
    types: ClassVar[tuple[str, ...]] = ("rzeppa_lever", "rzeppa_offset", "rzeppa_fixed_modern", "plunging_ball_modern")
    foreign: ClassVar[frozenset[str]] = CROSS_ONLY - {"friction"}
    rubbing: ClassVar[tuple[str, ...]] = GROOVES
    pressed: ClassVar[tuple[str, ...]] = (*GROOVES, "ball_diameter", "groove_conformity", "pressure_angle")
    refusals: ClassVar[Mapping[str, str]] = {**REFUSALS, "life": NO_BEARING}
    stays: ClassVar[str] = mark(
        "both races hold the centre by the spheres of its cage; lever and grooves move cage and balls alone"
    )
    fixed: ClassVar[bool] = True
    law_sizes: ClassVar[tuple[str, ...]] = (*LEVER, *GROOVES)
    steepest: ClassVar[float] = math.radians(47.0)

    balls: int = plain(6, doc="number of balls, all of which carry", low=3)
    lever_b: float | None = plain(None, doc="arm of the lever beyond the cage over that before it, b/a", above=0.0)
    lever_c: float | None = plain(
        None, doc="distance of the lever's fixed end from the joint centre over its arm before the cage, c/a", above=0.0
    )
    driving_offset: float | None = quantity(
        "length", None, doc="from the joint centre to the centre of the grooves on the driving shaft", above=0.0
    )
    driven_offset: float | None = quantity(
        "length", None, doc="from the joint centre to the centre of the grooves on the driven shaft", above=0.0
    )
    groove_radius: float | None = quantity("length", None, doc="radius of the grooves' middle line", above=0.0)
    ball_diameter: float | None = quantity("length", None, doc="diameter of the balls", above=0.0)
    groove_conformity: float | None = plain(
        None, doc="radius of the section of a groove over the diameter of the balls", above=0.5
    )
    cage_outer_diameter: float | None = quantity(
        "length", None, doc="diameter of the sphere in which the bell centres the cage", above=0.0
    )
    cage_inner_diameter: float | None = quantity(
        "length", None, doc="diameter of the sphere on which the cage sits on the inner race", above=0.0
    )
    pressure_angle: float | None = quantity(
        "angle",
        None,
        doc="angle of the normal of contact of a ball with the middle of its groove",
        above=0.0,
        below=math.pi / 2,
    )

    def own_problems(self) -> Iterator[Problem]:
        """Yield a lever or grooves that are half given, and both at once."""
        yield from both_or_none(self, *LEVER)
        yield from both_or_none(self, *GROOVES)
        yield from both_or_none(self, "cage_outer_diameter", "cage_inner_diameter")
        if self.lever_b is not None and self.groove_radius is not None:
            yield Problem("lever_b", _("the offset grooves place the balls already"), "inconsistent")

    def pair(self, joint_angle: Array) -> mobius.Pair | None:
        """Return the identity where nothing is said or the offsets are equal, else None."""
        even = self.lever_b is None and self.driving_offset == self.driven_offset
        return mobius.turn(0.0 * joint_angle) if even else None

    def deviation(self, angle: Array, joint_angle: Array) -> tuple[Array, Array, Array]:
        """Return the mean of what the balls ask for."""
        if self.lever_b is not None and self.lever_c is not None:
            tilt = plane_error(joint_angle, self.lever_b, self.lever_c)
            return shared_turn.course(angle, tilted_plane.tau(joint_angle, tilt), shared_turn.places(self.balls))
        return groove_course(
            angle, joint_angle, self.driving_offset, self.driven_offset, self.groove_radius, self.balls
        )

    def stuck(self, joint_angle: float) -> str:
        """Return where its grooves do not meet."""
        said = Joint.stuck(self, joint_angle)
        return groove_stuck(said, joint_angle, self.driving_offset, self.driven_offset, self.groove_radius)

    @property
    def alike(self) -> int:
        """Its balls."""
        return self.balls

    def fitting(self) -> Rzeppa:
        """Return it with grooves alike, at the mean of both offsets, in which all balls fit at once."""
        if self.driving_offset is None or self.driven_offset is None or self.driving_offset == self.driven_offset:
            return self
        mean = 0.5 * (self.driving_offset + self.driven_offset)
        return replace(self, driving_offset=mean, driven_offset=mean)

    def mechanism(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield its grooves with the balls; what holds as much where the grooves are not given."""
        if self.driving_offset is None or self.driven_offset is None or self.groove_radius is None:
            return Joint.mechanism(self, stance)
        # both grooves press on a ball at the pressure angle: harder than it passes on
        press = 1.0 if self.pressure_angle is None else 1.0 / math.sin(self.pressure_angle)
        sizes = self.driving_offset, self.driven_offset, self.groove_radius
        return groove_mechanism(stance, *sizes, self.balls, press=press)

    def loaded(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield the contacts of its balls with bell, inner race and cage, where all balls fit at once."""
        sizes = self.driving_offset, self.groove_radius, self.pressure_angle
        if None not in sizes and self.driven_offset == self.driving_offset:
            yield from _contacts(self, stance)

    def centring(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield its cage, which both races centre, as far as its grooves are given."""
        if self.groove_radius is not None:
            yield centred(mark("cage of joint {number}"), stance)

    @property
    def repeated(self) -> int:
        """The balls beyond the first: each could carry alone."""
        return self.balls - 1

    def inside(self, joint_angle: float) -> Iterator[Inside]:
        """Yield what its balls do beside turning."""
        if self.lever_b is not None and self.lever_c is not None:
            tilt = float(plane_error(joint_angle, self.lever_b, self.lever_c))
            yield from balls_inside(tilt, tilted_plane.deviation(ball_places(self.balls), joint_angle, tilt))
        else:
            yield from groove_inside(
                joint_angle, self.driving_offset, self.driven_offset, self.groove_radius, self.balls
            )

    @property
    def own_span(self) -> float | None:
        """Distance of opposite balls, with their grooves [m]."""
        return 2.3 * self.groove_radius if self.groove_radius is not None else None

    def solid(self, site: Site) -> None:
        """Add bell, inner race, cage and balls."""
        drawn.bell_and_balls(site, count=self.balls, groove=self.groove_radius)


# What its balls carry. A ball touches the groove of the bell, that of the inner race and the window of the cage. Both
# grooves press on it at the pressure angle from the middle of the groove; what the two forces leave, as the grooves
# lean against each other, pushes it along the axis of the cage. Bell and inner race hold the cage by its spheres.
# The normals depend on each other, as offset grooves are alike, so these contacts do not tell how fast it slides: the
# balls go as their grooves lead them, and the cage turns evenly about the normal of their plane.


def _contacts(joint: Rzeppa, stance: Stance) -> Iterator[InnerPair]:
    """Yield the contacts of the balls, the bell on the driving shaft; grooves offset alike.

    A groove about a point A presses with N (± sin δ e × r̂ ∓ cos δ m), δ the pressure angle, e the axis of its shaft, r̂
    the way out from it to the ball and m = (ball - A)/R: a ball that passes on the torque T_k needs N = T_k/(r sin δ),
    and both grooves press alike on it. Straight, the cage holds N cos δ · 2c/R of it, c the offset: balance of forces.
    """
    offset, radius = joint.driving_offset or 0.0, joint.groove_radius or 0.0
    steep, flat = math.sin(joint.pressure_angle or 0.0), math.cos(joint.pressure_angle or 0.0)
    u, before, after = stance.driving, stance.before + 0.0 * stance.driving, stance.after + 0.0 * stance.driving
    ball, cage = mark("ball {count} of joint {number}"), mark("cage of joint {number}")
    names = mark("bell groove of ball {count}"), mark("inner groove of ball {count}")
    window = mark("cage window of ball {count}")
    size = joint.ball_diameter or 0.0
    touching = [
        groove_contact(
            joint.ball_diameter, joint.groove_conformity, bent=side * flat / (radius + 0.5 * side * flat * size)
        )
        for side in (1.0, -1.0)
    ]
    for k in range(joint.balls):
        turn = k * 2.0 * np.pi / joint.balls
        way = frames.rotate(u, before, np.full(u.shape[:-1], turn))
        along, out = ball_centre(stance.theta + turn, stance.joint_angle, offset, offset, radius)
        at = stance.centre - along[..., None] * before + out[..., None] * way
        rows = []
        for axis, centre in ((before, stance.centre - offset * before), (after, stance.centre + offset * after)):
            aside = at - stance.centre
            beyond = frames.unit(aside - frames.dot(aside, axis)[..., None] * axis)
            rows.append(steep * frames.cross(axis, beyond) - flat * (at - centre) / radius)
        shift = _shift(joint, stance, turn, way)
        slip = frames.norm(shift - frames.cross(stance.middle + 0.0 * at, at - stance.centre))
        for name, links, normal, contact, fast in (
            (names[0], (DRIVING, ball), rows[0], touching[0], 0.0),
            (names[1], (ball, DRIVEN), rows[1], touching[1], 0.0),
            (window, (cage, ball), stance.middle + 0.0 * way, None, slip),
        ):
            yield InnerPair(
                name=name, type="PT", links=links, point=at, axis=normal, count=k + 1, contact=contact, slip=fast
            )
    swung = 2.0 * np.sin(0.25 * stance.joint_angle)  # of the cage against either shaft, which stands α/2 aside
    for name, links, sphere in (
        (mark("cage in the bell"), (DRIVING, cage), joint.cage_outer_diameter),
        (mark("cage on the inner race"), (cage, DRIVEN), joint.cage_inner_diameter),
    ):
        fast = 0.5 * (sphere or 0.0) * swung
        yield InnerPair(name=name, type="S", links=links, point=stance.centre, axis=stance.middle, slip=fast)


def _shift(joint: Rzeppa, stance: Stance, turn: float, way: Array) -> Array:
    """Return how fast the centre of a ball moves over the speed of the driving shaft, array (..., 3) [m]."""
    offset, radius = joint.driving_offset or 0.0, joint.groove_radius or 0.0
    near = [
        ball_centre(stance.theta + turn + side * SMALL, stance.joint_angle, offset, offset, radius)
        for side in (1.0, 0.0, -1.0)
    ]
    along, out = ((near[0][k] - near[2][k]) / (2.0 * SMALL) for k in (0, 1))
    about = frames.cross(stance.before + 0.0 * way, way)
    found: Array = -along[..., None] * stance.before + out[..., None] * way + near[1][1][..., None] * about
    return found


# The lever that holds the cage of a Rzeppa joint in the bisecting plane, exactly at one angle and nearly beside it.
#
# Its ball ends A and B run on the axes of the two shafts: A slides along its axis, B stays at OB = c. The cage hangs on
# the point C between them, AC = a, CB = b. All lengths are given as shares of a.


def _projection(joint_angle: Array, b: Array, c: Array) -> Array:
    """Return √((a + b)² - c² sin²α)/a, nan where the lever cannot reach the axis of A."""
    xp = namespace(joint_angle, b, c)
    aside = c * xp.sin(joint_angle)
    rest = (1.0 + b - aside) * (1.0 + b + aside)
    return xp.sqrt(xp.where((rest > 0.0) & (b > 0.0) & (c > 0.0), rest, xp.nan))


def cage_tilt(joint_angle: ArrayLike, b: ArrayLike, c: ArrayLike) -> Array:
    """Return the angle of the cage's normal from the axis of A.

    joint_angle (...) [rad]: α_12 in [0, π/2), angle between the shafts; b, c (...): b/a and c/a, positive.
    Returns (...) [rad]: α_2; nan where the lever does not reach, c sin α_12 ≥ a + b.
    tan α_2 = a c sin α_12/[c(a + b) cos α_12 + b √((a + b)² - c² sin²α_12)], Book (13).

    >>> from cardan.units import deg
    >>> print(cage_tilt(20 * deg, 0.35, 0.7) / deg)
    10.03450243
    """
    alpha, near, far = floats(joint_angle, b, c)
    xp = namespace(alpha, near, far)
    root = _projection(alpha, near, far)
    return xp.atan2(far * xp.sin(alpha), far * (1.0 + near) * xp.cos(alpha) + near * root)


def plane_error(joint_angle: ArrayLike, b: ArrayLike, c: ArrayLike) -> Array:
    """Return by how much the cage misses the bisecting plane, α_2 - α_12/2.

    joint_angle (...) [rad]: α_12 in [0, π/2); b, c (...): b/a and c/a, positive.
    Returns (...) [rad]: the tilt η of `laws.tilted_plane`, shaft 1 being that of A; nan where the lever does not
    reach.
    The tangent of the difference, its numerator reduced: sin(α/2) {c - b (c cos α + √((1 + b)² - c² sin²α))}, and the
    braces as (1 - b) c - b (1 + b) + b c [2 sin²(α/2) + c sin²α/(1 + b + √…)], so that digits are lost to the
    error itself only.
    """
    alpha, near, far = floats(joint_angle, b, c)
    xp = namespace(alpha, near, far)
    root = _projection(alpha, near, far)
    sine, half, middle = xp.sin(alpha), xp.sin(0.5 * alpha), xp.cos(0.5 * alpha)
    along = far * (1.0 + near) * xp.cos(alpha) + near * root
    gap = (1.0 - near) * far - near * (1.0 + near)
    gap = gap + near * far * (2.0 * half * half + far * sine * sine / (1.0 + near + root))
    return xp.atan2(half * gap, along * middle + far * sine * half)


def even_length(joint_angle: ArrayLike, b: ArrayLike) -> Array:
    """Return c/a with which the cage bisects the angle of the shafts exactly, at one bend.

    joint_angle (...) [rad]: α_12 in [0, π/2); b (...): b/a.
    Returns (...): nan where there is none: b cos α_12 ≥ a.
    (b/a)(1 + b/a)/√(1 + (b/a)² - 2 (b/a) cos α), the root of Book (15), (16). These are squared: where b cos α > a
    their root belongs to a lever that has A beyond the joint.
    """
    alpha, near = floats(joint_angle, b)
    xp = namespace(alpha, near)
    there = (near > 0.0) & (near * xp.cos(alpha) < 1.0)
    half = xp.sin(0.5 * alpha)
    square = xp.where(there, (1.0 - near) ** 2 + 4.0 * near * half * half, xp.nan)
    return near * (1.0 + near) / xp.sqrt(square)
