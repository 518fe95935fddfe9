"""Half-cardans: couplings without swing axes, rigid or elastic."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from cardan.drive.shapes import ACROSS, bolt_ring, ring
from cardan.errors import Problem
from cardan.maths.arrays import Array, ArrayLike, floats, namespace, unit_complex
from cardan.maths.kernel import frames, mobius
from cardan.maths.kernel.meshes import Surface, joined, placed, plate, revolved, toothed
from cardan.texts import _, mark
from cardan.units import plain, quantity

from .common import laws as shared_turn
from .common.inner import DRIVEN, DRIVING, InnerPair, Stance, bending, crossed
from .common.site import Site, about
from .joint import CROSS_ONLY, REFUSALS, Inside, Joint, Strain, both_or_none

SHARED = 61
"""Places between two pairs of contacts at which it is looked how they share a torque."""


@dataclass(frozen=True, kw_only=True, slots=True)
class HalfCardan(Joint):
    """Rigid half joint, a square bell or a gear: the pair of faces that carries turns as a Hooke joint."""

    kind: ClassVar[str] = "half_cardan"
    title: ClassVar[str] = mark("half joint")
    types: ClassVar[tuple[str, ...]] = ("half_bell", "half_gear", "gear_crowned_modern")
    foreign: ClassVar[frozenset[str]] = CROSS_ONLY - {"friction"}
    rubbing: ClassVar[tuple[str, ...]] = ("face_radius",)
    crossed: ClassVar[bool] = True
    fixed: ClassVar[bool] = True
    slides: ClassVar[bool] = True
    steepest: ClassVar[float] = math.radians(5.0)

    pairs: int = plain(2, doc="pairs of opposite faces or teeth; between two of them there must be play", low=1)

    face_radius: float | None = quantity("length", None, doc="distance of faces or teeth from the axis", above=0.0)
    pair_stiffness: float | None = quantity(
        "turning_stiffness",
        None,
        doc="stiffness of one pair of faces or teeth against turning, by which pairs share the torque; without it one "
        "pair carries all",
        above=0.0,
    )

    def own_problems(self) -> Iterator[Problem]:
        """Yield a stiffness of teeth without their radius."""
        if self.pair_stiffness is not None:
            yield from both_or_none(self, "face_radius", "pair_stiffness")

    def loaded(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield its faces, where it is given how far from the axis they are."""
        for pair in self.mechanism(stance) if self.face_radius is not None else ():
            yield replace(pair, told=pair.type == "R" and self.pair_stiffness is None)

    def shared(self, joint_angle: float, torque: float) -> Iterator[Strain]:
        """Yield the force on the faces that carry most and least, where it is given how stiff they are."""
        if self.pair_stiffness is not None and self.face_radius is not None:
            angle = np.linspace(0.0, math.pi / self.pairs, SHARED)
            force = shares(angle, joint_angle, self.pairs, torque / self.pair_stiffness)
            force *= self.pair_stiffness / (2.0 * self.face_radius)
            name = mark("faces or teeth, sharing by their stiffness")
            yield Strain(name=name, force=float(np.max(force)), least=float(np.min(force)), count=self.pairs)

    def pair(self, joint_angle: Array) -> mobius.Pair:
        """Return the map of one pair of faces, that of a Hooke joint."""
        return mobius.hooke(joint_angle)

    def mechanism(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield its slide, and the pair of faces that carries as the cross that turns alike."""
        part = mark("middle of joint {number}")
        at = stance.centre
        slide = mark("slide of joint {number}")
        yield InnerPair(name=slide, type="P", links=(DRIVING, part), point=at, axis=stance.before)
        for pin in crossed(stance, journal=2.0 * (self.face_radius or 0.0), span=2.0 * (self.face_radius or math.inf)):
            yield replace(pin, links=(part, pin.links[1]) if pin.links[0] == DRIVING else pin.links)

    @property
    def repeated(self) -> int:
        """The pairs of faces beyond the first: each could carry alone."""
        return self.pairs - 1

    def inside(self, joint_angle: float) -> Iterator[Inside]:
        """Yield the play that it needs."""
        text = _("play that its pairs of faces need to turn at this joint angle")
        yield Inside(key="play", meaning=text, value=float(play(joint_angle, self.pairs)))

    def solid(self, site: Site) -> None:
        """Add its toothed head and the sleeve round it."""
        one, two = site.sides
        corners = 2 * self.pairs
        head = 0.72 * site.size.radius
        if corners <= 8:
            step = np.pi / corners
            turn = np.repeat(np.arange(corners) * (2.0 * np.pi / corners), 2) + np.tile((-0.3, 0.3), corners) * step
            flat = head * np.stack((np.cos(turn), np.sin(turn)), axis=-1)
        else:
            flat = toothed(0.9 * head, head, min(corners, 48))
        block = placed(plate(flat, -0.42 * head, 0.42 * head, bevel=0.08 * head), ACROSS)
        stem = 0.55 * head
        neck = revolved(
            [(0.0, 0.0), (0.0, stem), (0.75 * one.reach, stem), (one.reach, one.body), (one.reach, 0.0)], 24
        )
        site.add_to(one, "driving yoke", site.said(_("head of {joint}")), joined(block, neck))
        hole = 1.04 * flat
        outline = 1.34 * head * hole / np.linalg.norm(hole, axis=-1, keepdims=True)
        bell = placed(plate(outline, -0.5 * head, 0.75 * head, hole), ACROSS)
        floor = 0.7 * head
        end = max(two.reach, floor + 0.6 * head)
        hub = revolved(
            [(floor, 0.0), (floor, 1.34 * head), (floor + 0.3 * head, 1.3 * head), (floor + 0.5 * head, two.body),
             (end, two.body), (end, 0.0)], 32,
        )  # fmt: skip
        site.add_to(two, "driven yoke", site.said(_("sleeve of {joint}")), joined(bell, hub))


@dataclass(frozen=True, kw_only=True, slots=True)
class ElasticHalfCardan(Joint):
    """Flexible coupling, of rubber or with a disc: uniform on average over its links, and soft against turning."""

    kind: ClassVar[str] = "elastic_half_cardan"
    title: ClassVar[str] = mark("flexible coupling")
    types: ClassVar[tuple[str, ...]] = (
        "el_disc", "el_link", "el_bush", "el_hexagon", "el_tyre_split", "el_tyre_solid", "el_petal3", "el_petal8",
        "el_circular_teeth", "el_balls", "disc_pack_modern",
    )  # fmt: skip
    fixed: ClassVar[bool] = True
    loose: ClassVar[bool] = True
    steepest: ClassVar[float] = math.radians(10.0)
    refusals: ClassVar[Mapping[str, str]] = {
        **REFUSALS,
        "losses": mark("its links give instead of rubbing; what they damp belongs to torsional vibration"),
    }

    pairs: int | None = plain(
        None, doc="pairs of opposite links that share the torque; without it the joint counts as uniform", low=2
    )
    stiffness: float | None = quantity("turning_stiffness", None, doc="stiffness against turning", above=0.0)
    damping: float = quantity("turning_damping", 0.0, doc="damping against turning", low=0.0)
    max_windup: float | None = quantity("angle", None, doc="largest angle of twist under torque", above=0.0)
    bending_stiffness: float | None = quantity(
        "turning_stiffness", None, doc="stiffness against the joint angle", above=0.0
    )
    axial_stiffness: float | None = quantity("stiffness", None, doc="stiffness along the shafts", above=0.0)
    lateral_stiffness: float | None = quantity("stiffness", None, doc="stiffness across the shafts", above=0.0)
    axial_shift: float | None = quantity(
        "length", None, doc="by how much both shafts stand farther apart than without load, negative where closer"
    )
    lateral_shift: float | None = quantity("length", None, doc="by how much both shafts miss each other", low=0.0)
    lateral_direction: float = quantity(
        "angle",
        0.0,
        doc="where the driven shaft is shifted to, about the driving one: from the side to which the joint bends",
    )

    def pair(self, joint_angle: Array) -> mobius.Pair | None:
        """Return the identity, None where the links are counted."""
        return mobius.turn(0.0 * joint_angle) if self.pairs is None else None

    def deviation(self, angle: Array, joint_angle: Array) -> tuple[Array, Array, Array]:
        """Return the mean of what the pairs of links ask for; `cardan.drive.joints.half_cardan`."""
        if self.pairs is None:
            return mobius.course(mobius.turn(0.0 * joint_angle), unit_complex(2.0 * angle))
        tau = mobius.tau(mobius.hooke(joint_angle))
        return shared_turn.course(angle, tau, self.pairs)

    def mechanism(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield what its links leave free, ways in all directions and bending, as one that turns uniformly."""
        link, ways = DRIVING, (stance.before, frames.cross(stance.normal, stance.before), stance.normal)
        for k, way in enumerate(ways, 1):
            part = mark("part {count} of the disc of joint {number}")
            name = mark("give {count} of joint {number}")
            yield InnerPair(name=name, type="P", links=(link, part), point=stance.centre, axis=way, count=k)
            link = part.replace("{count}", str(k))
        for one in bending(stance):
            yield replace(one, links=(link, DRIVEN))

    @property
    def twist_spring(self) -> tuple[float, float] | None:
        """Its stiffness and damping against turning, where its stiffness is given."""
        return None if self.stiffness is None else (self.stiffness, self.damping)

    def own_problems(self) -> Iterator[Problem]:
        """Yield a shift without the stiffness against it."""
        for shift, against in (("axial_shift", "axial_stiffness"), ("lateral_shift", "lateral_stiffness")):
            if getattr(self, shift) is not None:
                yield from both_or_none(self, against, shift)

    def strained(self, joint_angle: float) -> Iterator[Strain]:
        """Yield the couple against its joint angle and the forces against shifts: stiffness times way."""
        if self.bending_stiffness is not None:
            yield Strain(name=mark("couple against the joint angle"), couple=self.bending_stiffness * joint_angle)
        if self.axial_stiffness is not None and self.axial_shift:
            yield Strain(name=mark("force along the shafts"), force=self.axial_stiffness * abs(self.axial_shift))
        if self.lateral_stiffness is not None and self.lateral_shift:
            yield Strain(name=mark("force across the shafts"), force=self.lateral_stiffness * self.lateral_shift)

    @property
    def bend_spring(self) -> float:
        """Its stiffness against the joint angle, where it is given."""
        return self.bending_stiffness or 0.0

    def sprung(self, joint_angle: Array) -> Array | None:
        """Return its forces against both shifts, along the middle of both shafts and across the driving one."""
        axial = -(self.axial_stiffness or 0.0) * (self.axial_shift or 0.0)
        lateral = -(self.lateral_stiffness or 0.0) * (self.lateral_shift or 0.0)
        if not axial and not lateral:
            return None
        half, way = 0.5 * joint_angle, self.lateral_direction
        aside = lateral * math.cos(way) + axial * np.sin(half)
        return np.stack((axial * np.cos(half), aside, lateral * math.sin(way) + 0.0 * half), axis=-1)

    def inside(self, joint_angle: float) -> Iterator[Inside]:
        """Yield how its links are strained."""
        if self.pairs is not None:
            text = _("angle by which its links are strained against each other")
            yield Inside(key="strain", meaning=text, value=float(play(joint_angle, self.pairs)))

    def solid(self, site: Site) -> None:
        """Add its two arms and the disc between them."""
        stance = site.stance
        count = 3 if self.pairs is None else self.pairs
        far, thick = 0.95 * site.size.radius, 0.34 * site.size.radius
        low = 0.62 * thick
        for side in site.sides:
            end = max(side.reach, low + thick)
            hub = revolved(
                [(low, 0.0), (low, 0.4 * far), (low + 0.5 * thick, 0.42 * far), (low + 0.8 * thick, 0.36 * far),
                 (end, side.body), (end, 0.0)], 24,
            )  # fmt: skip
            offset = 0.0 if side.driving else np.pi / count
            arms = [about(_flange_arm(far, low, 0.42 * thick), offset + j * 2.0 * np.pi / count) for j in range(count)]
            site.add_to(side, side.yoke, site.said(_("flange of {joint}")), joined(hub, *arms))
        own = site.along(stance.centre, stance.middle, stance.halving(stance.theta))
        shape = ring(0.52 * far, 1.22 * far, 1.1 * thick, 40)
        heads = bolt_ring(2 * count, 0.88 * far, 0.11 * far, -0.66 * thick, 0.66 * thick)
        text = site.said(_("elastic disc of {joint}"))
        site.add("disc", text, own, shape, role="ink", metal=False)
        site.add("disc", text, own, heads, shade=0.3)


def _flange_arm(far: float, low: float, thick: float) -> Surface:
    """Return one arm of a flange along y, its eye at a distance."""
    turn = np.linspace(-0.5 * np.pi, 0.5 * np.pi, 9)
    eye = 0.2 * far
    tip = np.stack((0.88 * far + eye * np.cos(turn), eye * np.sin(turn)), axis=-1)
    outline = np.concatenate((tip, [(0.0, 0.3 * far), (0.0, -0.3 * far)]))
    return placed(plate(outline, low, low + thick, bevel=0.12 * thick), ACROSS)


# Half-cardans: couplings without swing axes, rigid (bell, gear) or elastic (discs, bushes, tyres).
#
# Each pair of opposite contacts is a Hooke joint of its own: the face across one diameter of one half stays at right
# angles to the diameter of the other half. N pairs stand at π/N from each other and ask for N different outputs at
# once. Rigid pairs can have only one of them, the others need play; elastic ones share, and turn by the mean, which is
# even but for the order 2N of the turn.


def demands(angle: ArrayLike, joint_angle: ArrayLike, pairs: int) -> Array:
    """Return how far ahead each pair of contacts alone would have the output run.

    angle (...) [rad]: input angle φ1; joint_angle (...) [rad]: bend α in [0, π/2); pairs: pairs of opposite contacts N.
    Returns (..., N) [rad].
    The law of the Hooke joint at φ1 + kπ/N.
    """
    phi, alpha = floats(angle, joint_angle)
    xp = namespace(phi, alpha)
    turned = phi[..., None] + xp.arange(pairs, dtype=xp.float64) * (math.pi / pairs)
    return mobius.angle_error(mobius.hooke(alpha[..., None]), unit_complex(2.0 * turned))


def deviation(angle: ArrayLike, joint_angle: ArrayLike, pairs: int) -> Array:
    """Return how far the output runs ahead where equal elastic pairs share the torque: the mean of `demands`.

    angle (...) [rad]: input angle φ1; joint_angle (...) [rad]: bend α in [0, π/2).
    pairs: pairs of opposite contacts N; one is a Hooke joint.
    Returns (...) [rad].
    -arg(1 - τ^N w^N)/N with τ = tan²(α/2), w = e^(2iφ1): of the series Σ τ^k sin(2kφ)/k of the Hooke joint, the mean
    over N places keeps the orders k = N, 2N ... alone; at most arcsin(τ^N)/N.
    """
    phi, alpha = floats(angle, joint_angle)
    return shared_turn.course(phi, _tau(alpha), pairs)[0]


def ratio(angle: ArrayLike, joint_angle: ArrayLike, pairs: int) -> Array:
    """Return the speed ratio where equal elastic pairs share the torque. The derivative of `deviation` + φ1."""
    phi, alpha = floats(angle, joint_angle)
    return shared_turn.course(phi, _tau(alpha), pairs)[1]


def shares(angle: ArrayLike, joint_angle: ArrayLike, pairs: int, windup: ArrayLike) -> Array:
    """Return by how much each pair of contacts is deflected where pairs as stiff as each other share a torque.

    angle (...) [rad]: input angle φ1; joint_angle (...) [rad]: bend α in [0, π/2); pairs: pairs of opposite contacts N.
    windup (...) [rad]: the torque over the stiffness of one pair, by how much it would alone be deflected.
    Returns (..., N) [rad], nought where a pair does not touch; their sum is the windup.
    The output stays at ψ behind the pairs that touch, whose `demands` δ_k are ahead of it: Σ max(0, δ_k - ψ) = T/c. Of
    the m farthest ahead alone it would stand at (Σ δ_k - T/c)/m; ψ is the farthest of these for any m, since pairs that
    are missing, and those that pull, both leave it behind. Play lets the other flanks go.
    """
    phi, alpha, wound = floats(angle, joint_angle, windup)
    xp = namespace(phi, alpha, wound)
    ahead = demands(phi, alpha, pairs)
    sums = -xp.cumulative_sum(xp.sort(-ahead, axis=-1), axis=-1)
    behind = xp.max((sums - wound[..., None]) / xp.arange(1, pairs + 1, dtype=xp.float64), axis=-1)
    return xp.maximum(ahead - behind[..., None], 0.0 * ahead)


def _tau(joint_angle: Array) -> Array:
    return namespace(joint_angle).tan(0.5 * joint_angle) ** 2


def play(joint_angle: ArrayLike, pairs: int) -> Array:
    """Return the play that a rigid half joint needs between its pairs to turn at a bend.

    joint_angle (...) [rad]: bend α in [0, π/2); pairs: pairs of opposite contacts N.
    Returns (...) [rad]: greatest difference of two of `demands` over a turn; for more than two pairs a bound that many
    pairs come to.
    Two pairs differ most at 45°, by 2 arctan τ = arctan(½ sin α tan α); any number at most by twice the greatest lead,
    2 arcsin τ, τ = tan²(α/2).
    """
    (alpha,) = floats(joint_angle)
    xp = namespace(alpha)
    if pairs == 1:
        return 0.0 * alpha
    tau = _tau(alpha)
    return 2.0 * (xp.atan(tau) if pairs == 2 else xp.asin(tau))
