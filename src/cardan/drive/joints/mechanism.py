"""A joint of one's own: any mechanism of links and pairs between two shafts that meet."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from typing import Any, ClassVar

import numpy as np

from cardan.errors import InputError, Problem, check
from cardan.maths.arrays import Array, unit_complex
from cardan.maths.kernel import frames, mobius
from cardan.maths.kernel.meshes import Surface, ball, joined, placed, revolved
from cardan.mechanism.closing import CLOSED, LEFT, Linkage, by_rounding, open_by, turn_about
from cardan.mechanism.mechanism import Mechanism, Pair
from cardan.mechanism.rounding import exactly, fitted
from cardan.texts import _, mark, plural
from cardan.units import deg, mm, plain

from .common import inner
from .common import site as drawn
from .common.inner import DRIVEN, DRIVING, InnerPair, Stance, Tolerated
from .common.laws import faded, waved
from .common.site import Site
from .joint import CROSS_ONLY, EXACT, REFUSALS, SHIFTS, Joint
from .joint import Inside as Measure

PLACES = 64
"""Places of a turn at which the loops are closed one after the other; between them all at once."""

FINE = 256
"""Places at which laws of several joint angles stand beside each other, more where one has harmonics beyond."""

FINEST = 4096
"""Most places at which the law is taken: near the joint angle at which a joint locks it is ever sharper."""

EVEN = 1e-11
"""Leads [rad] below which a joint is uniform: what closing its loops leaves is a tenth of it."""

MAPPED = 1e-9
"""What a law may leave beside tan θ' = κ tan θ [rad] to count as one of that form."""

STEP = 2.0 * deg
"""Step of the joint angle by which loops that are closed all round are followed to another one."""

LEAST = 0.5 * deg
"""Smallest joint angle of a drawing by which the plane of its shafts is known."""

MEET = 1e-6
"""Distance of the shaft axes over the size of the mechanism up to which they meet."""

BEARINGS = {"R": "R", "C": "C", "S": "R", "SG": "C"}
"""Pair that holds a shaft in a mechanism file -> bearing that keeps its axis as much where the joint centres it."""

MOVES = 1e-6
"""Share of a small motion that is none."""

NODES = 8
DEGREE = 1.0 * deg
"""Joint angles through which a polynomial goes, and their step."""

MANY = 2 * NODES
"""More joint angles than these are not all looked at by themselves."""

KEPT = 64
"""Joint angles whose poses are kept."""

LAWS = 1000
"""Joint angles whose laws are kept."""

ASKED = 0.1
"""Joint angle [rad] at which a law is looked at for its form, beside the one drawn."""


@dataclass(frozen=True, kw_only=True, slots=True)
class MechanismJoint(Joint):
    """Mechanism of one's own: links and pairs between the shafts, from a mechanism file."""

    kind: ClassVar[str] = "mechanism"
    title: ClassVar[str] = mark("own mechanism")
    any_type: ClassVar[bool] = True
    foreign: ClassVar[frozenset[str]] = CROSS_ONLY - {"friction"}
    rubbing: ClassVar[tuple[str, ...]] = ("file",)
    steepest: ClassVar[float] = 0.5 * math.pi
    refusals: ClassVar[Mapping[str, str]] = {
        **REFUSALS,
        "tolerance": mark("its mechanism file gives no pair between its shafts a tolerance"),
    }

    file: str = plain("", doc="mechanism file beside the drive file, or a shipped mechanism by its name")
    driving: str = plain("", doc="link of that file that is the driving shaft; its input_link when not given")
    driven: str = plain("", doc="link of that file that is the driven shaft; its output_link when not given")
    drawing: Mechanism | None = field(default=None)  # what its file draws

    def own_problems(self) -> Iterator[Problem]:
        """Yield why its mechanism is no joint between two shafts."""
        if self.drawing is None:
            missing = _("missing; a joint of this kind is told by its mechanism file")
            unread = _("is not read here; give the mechanism by with_drawing")
            yield Problem("file", unread if self.file else missing, "missing")
            return
        try:
            self._inside()
        except InputError as error:
            yield from error.problems

    def inside(self, joint_angle: float) -> Iterator[Measure]:
        """Yield how the numbers of its file were changed so that its loops close, where they are rounded."""
        if self.drawing is not None and self.drawing.rounding is not None:
            found = fitted(self.drawing)
            text = _("largest shift of a pair of its file, whose numbers are rounded, so that the loops close")
            yield Measure(key="drawing_shift", meaning=text, value=found.shift, dimension="length")
            text = _("largest turn of an axis for the same")
            yield Measure(key="drawing_turn", meaning=text, value=found.turn)

    def with_drawing(self, drawing: Mechanism) -> MechanismJoint:
        """Return the joint with what its file draws."""
        return replace(self, drawing=drawing)

    def _inside(self) -> Inside:
        """Return its loops, closed over a turn."""
        assert self.drawing is not None
        return inside_of(self.drawing, self.driving, self.driven)

    @property
    def free_ways(self) -> int:
        """In how many directions its mechanism lets its shafts shift in their centre."""
        return 0 if self.drawing is None else max(0, self._inside().freedom - 2)

    def freed(self, angle: Array, joint_angle: Array) -> Array:
        """Return these directions."""
        if self.free_ways in (0, 3):
            return super(MechanismJoint, self).freed(angle, joint_angle)
        return self._passed(angle, joint_angle)[1]

    @property
    def slides(self) -> bool:  # type: ignore[override]
        """Whether its mechanism lets its shafts slide along each other, and holds more than the turn."""
        return self.drawing is not None and self._inside().slides

    @property
    def loose(self) -> bool:  # type: ignore[override]
        """Whether its mechanism holds nothing but the turn."""
        return self.free_ways == 3

    @property
    def fixed(self) -> bool:  # type: ignore[override]
        """Whether it passes on a couple as it turns, and forces in its centre."""
        return self.drawing is not None and not self.loose and self.told

    @property
    def told(self) -> bool:
        """Whether the couple that it passes on follows from its torque alone."""
        return self.drawing is not None and self._inside().sliding is None

    def refusal(self, question: str) -> str:
        """Return in a sentence why it does not answer a question: friction needs the sizes of all that turns."""
        if question in ("forces", "tolerance") and self.drawing is not None and not self.told:
            return self._inside().carrying()
        frame = self.drawing.frame if self.drawing else ""
        joints = self.drawing.joints if self.drawing else ()
        bare = [one.id for one in joints if not one.rubs and frame not in one.links]
        if question == "losses" and bare:
            text = _("its mechanism file does not say at what diameter and on which bearings {pairs} turns")
            return text.format(pairs=repr(bare[0]))
        return super(MechanismJoint, self).refusal(question)

    @property
    def tolerated(self) -> bool:
        """Whether a pair between its shafts has a tolerance, and it is known what it passes on."""
        frame = self.drawing.frame if self.drawing else ""
        pairs = self.drawing.joints if self.drawing else ()
        return any((one.tolerance or one.tolerance_turn) and frame not in one.links for one in pairs) and self.told

    def head(self, stance: Stance, off: Mapping[str, Any] = EXACT) -> Array:
        """Return where its driven shaft starts, off the centre by what its pairs are off: by `SHIFTS`."""
        if not off:
            return stance.centre
        axes = stance.before, frames.cross(stance.normal, stance.before), stance.normal
        found: Array = stance.centre + sum(
            np.asarray(off.get(key, 0.0))[..., None] * axis for key, axis in zip(SHIFTS, axes, strict=True)
        )
        return found

    def stuck(self, joint_angle: float) -> str:
        """Return which pair opens at which angle."""
        return self._inside().stuck(joint_angle) or super(MechanismJoint, self).stuck(joint_angle)

    def pair(self, joint_angle: Array) -> mobius.Pair | None:
        """Return its map where its law is of the form tan θ' = κ tan θ, else None."""
        if self.drawing is not None and not self._inside().mapped:
            return None
        return self.near_pair(joint_angle)

    def near_pair(self, joint_angle: Array) -> mobius.Pair:
        """Return the map with the second order of its law, the identity where it is uniform."""
        alpha = np.asarray(joint_angle, dtype=float)
        known, place = np.unique(alpha, return_inverse=True)
        every = [steepness(one) for one in self._inside().several(known)] if self.drawing else np.zeros(known.shape)
        tau = np.reshape(np.asarray(every)[np.ravel(place)], alpha.shape)
        root = np.sqrt(1.0 - tau * tau)
        with np.errstate(invalid="ignore"):  # not a number where it does not turn
            return (1.0 + 0.0j) / root, (-1.0 + 0.0j) * tau / root

    def deviation(self, angle: Array, joint_angle: Array) -> tuple[Array, Array, Array]:
        """Return the law that its closed loops follow; not a number where they do not close."""
        if self.drawing is None:
            return 0.0 * angle, 1.0 + 0.0 * angle, 0.0 * angle
        whole = np.broadcast_arrays(np.asarray(angle, dtype=float), np.asarray(joint_angle, dtype=float))
        known, which = np.unique(whole[1], return_inverse=True)
        theta, which = np.ravel(whole[0]), np.ravel(which)
        places = np.split(np.argsort(which, kind="stable"), np.cumsum(np.bincount(which, minlength=len(known)))[:-1])
        found = np.zeros((3, theta.size))
        for here, leads in zip(places, self._inside().several(known), strict=True):
            found[:, here] = waved(theta[here], leads)
        return tuple(np.reshape(found, (3, *whole[0].shape)))

    def mechanism(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield the pairs of its mechanism, where they stand, without the bearings of the shafts."""
        if self.drawing is None:
            yield from super(MechanismJoint, self).mechanism(stance)
            return
        here = self._inside()
        (point, axis, second), turned = here.placed(stance)
        for k, pair in enumerate(here.linkage.joints):
            if k in here.bearings:
                continue
            yield InnerPair(
                name=_inner_name(pair.id),
                type=pair.type,
                links=(here.named(pair.links[0]), here.named(pair.links[1])),
                point=point[..., k, :],
                axis=axis[..., k, :],
                second=second[..., k, :] if pair.kind.needs_second else None,
                rubs=True,
                friction=pair.friction,
                lever=0.5 * (pair.diameter or 0.0),
                spread=pair.bearing_distance or math.inf,
                tolerated=_tolerated(pair, k, turned[..., k, :, :]),
            )

    def loaded(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield all its pairs, where it is known what it passes on."""
        if self.drawing is not None and self.told:
            yield from self.mechanism(stance)

    def push(self, angle: Array, joint_angle: Array) -> Array | None:
        """Return the force that goes with its couple where its shafts can shift."""
        return self._passed(angle, joint_angle)[0] if self.free_ways else None

    def _passed(self, angle: Array, joint_angle: Array) -> tuple[Array, Array]:
        """Return the force that goes with its torque (..., 3) and the directions in which it is free (..., k, 3)."""
        theta, alpha = np.broadcast_arrays(np.asarray(angle, dtype=float), np.asarray(joint_angle, dtype=float))
        push, ways = self._inside().passed(np.ravel(theta), np.ravel(alpha))
        return np.reshape(push, (*theta.shape, 3)), np.reshape(ways, (*theta.shape, *ways.shape[1:]))

    def carried(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield what holds both its shafts: the driven one where it is free, guides along what the joint holds."""
        if self.free_ways not in (1, 2):
            yield from super(MechanismJoint, self).carried(stance)
            return
        theta = stance.theta
        ways = self._passed(theta, np.asarray(stance.joint_angle) + 0.0 * theta)[1]
        basis = np.stack(
            np.broadcast_arrays(stance.before, frames.cross(stance.normal, stance.before), stance.normal), axis=-2
        )
        held = np.linalg.svd(ways)[2][..., self.free_ways :, :] @ basis
        yield from inner.guided(stance, held)

    @property
    def own_span(self) -> float | None:
        """How far its pairs reach around the axis [m]."""
        return None if self.drawing is None else 2.0 * self._inside().radius

    def solid(self, site: Site) -> None:
        """Add its shafts' ends and its links, each as bars between its pairs."""
        if self.drawing is None:
            drawn.bell_and_balls(site)
            return
        here, stance = self._inside(), site.stance
        poses = here.at(stance.theta, np.asarray(stance.joint_angle) + 0.0 * stance.theta)
        turn, shift = here.carried_to(stance, poses)
        thin = 0.06 * here.radius
        for link, pose in enumerate(here.linkage.links):
            if pose in here.grounds:
                continue
            own = site.stage.track(shift[:, link], *(turn[:, link, :, k] for k in range(3)))
            text = _("{link} of {joint}").format(link=pose, joint=site.name)
            role = {here.driving: site.driving.role, here.driven: site.driven.role}.get(pose, "cross")
            shade = 0.0 if pose in (here.driving, here.driven) else 0.12 + 0.5 * (link % 5) / 5.0
            site.add("link", text, own, _link(here, link, thin), role=role, shade=shade)


def _tolerated(pair: Pair, number: int, axes: Array) -> Tolerated | None:
    """Return how far a pair may be off whose second link has turned by axes (..., 3, 3); None where it is not."""
    shift, turn = pair.tolerance or 0.0, pair.tolerance_turn or 0.0
    if not shift and not turn:
        return None
    return Tolerated(name=pair.id, field=f"drawing.joints[{number}]", shift=shift, turn=turn, axes=axes)


def _inner_name(name: str) -> str:
    """Return the name of a pair or link of a file, in which braces mean themselves, with the place of its joint."""
    return _("{link} of joint {number}").replace("{link}", name.replace("{", "{{").replace("}", "}}"))


# The mechanism of a joint: its loops closed over a turn, at any joint angle.


@dataclass(frozen=True, eq=False)
class Inside:
    """The loops of a joint of one's own, in the place and position in which its file draws them."""

    linkage: Linkage
    driving: str
    driven: str
    bearings: tuple[int, int]  # which pairs are those of the driving and of the driven shaft
    grounds: tuple[str, str]  # the frame, on the side of either shaft
    centre: Array  # (3,) [m]: where the shafts meet
    basis: Array  # (3, 3): driving shaft, direction across it toward the driven one, normal of both; a row each
    drawn_angle: float  # [rad]: joint angle of the drawing
    # [rad]: how far the marks from which angles count stand from those in the plane of the shafts as drawn
    start: float = 0.0
    lead: float = 0.0  # [rad]: how far the driven mark runs ahead in the mean, as drawn
    blur: float = 0.0  # [rad]: what the rounding of its numbers may make of a law
    freedom: int = 2  # in how many ways the driven link can move against the driving one, neither in its bearing
    idle: int = 0  # in how many ways inner links can move by themselves
    slides: bool = False  # whether its shafts can slide along each other, and it holds more than the turn
    # [m]: how far the driven shaft slides along its axis as drawn, where it turns or bends only so; None elsewhere
    sliding: float | None = None
    # joint angle -> poses over a turn (p, n, 4, 4), of the drawing and of those at even steps
    known: dict[float, Array] = field(default_factory=dict)
    recent: dict[float, Array] = field(default_factory=dict)  # the same, of those asked last
    laws: dict[float, Array] = field(default_factory=dict)  # joint angle -> leads over a turn (p,) [rad]
    # angles asked last of `passed` -> what it found
    split: dict[bytes, tuple[Array, Array]] = field(default_factory=dict)

    @property
    def moving(self) -> list[int]:
        """Which links follow the driving one."""
        fast = (*self.grounds, self.driving)
        return [k for k, link in enumerate(self.linkage.links) if link not in fast]

    @property
    def radius(self) -> float:
        """How far its pairs reach off the centre, but for its bearings [m]."""
        own = [np.asarray(p.point) for k, p in enumerate(self.linkage.joints) if k not in self.bearings]
        return max(float(frames.norm(one - self.centre)) for one in own) or self.linkage.size

    def named(self, link: str) -> str:
        """Return what a link is called inside a joint."""
        return {self.driving: DRIVING, self.driven: DRIVEN}.get(link) or _inner_name(link)

    def guess(self, poses: Array, theta: Array, joint_angle: Array) -> Array:
        """Return poses with the driving link and the frame of the driven one put where they are to be."""
        index = self.linkage.links.index
        poses = np.array(poses)
        poses[..., index(self.driving), :, :] = turn_about(self.centre, self.basis[0], theta - self.start)
        poses[..., index(self.grounds[1]), :, :] = turn_about(
            self.centre, self.basis[2], joint_angle - self.drawn_angle
        )
        return poses

    def all_round(self) -> tuple[Array, Array]:
        """Return poses at even places of a turn as drawn, one followed from the other, and misfits of the pairs."""
        linkage, alpha = self.linkage, np.asarray(self.drawn_angle)
        rows, misfits = [linkage.drawn()], []
        for k in range(1, PLACES + 1):
            last = rows[-1]
            ahead = last @ np.linalg.inv(rows[-2]) @ last if k > 1 else last
            theta = np.asarray(k * 2.0 * np.pi / PLACES) + self.start
            pose, misfit = linkage.settled(self.guess(ahead, theta, alpha), self.moving)
            rows.append(pose)
            misfits.append(misfit)
            if np.max(misfit) > CLOSED:
                break
        return np.stack(rows), np.stack(misfits)

    def turn(self, joint_angle: float) -> Array:
        """Return poses at `PLACES` even places of a turn at a joint angle [rad], array (p, n, 4, 4); nan if stuck."""
        if joint_angle not in self.recent:
            theta = np.arange(PLACES) * (2.0 * np.pi / PLACES) + self.start
            while len(self.recent) >= KEPT:
                self.recent.pop(next(iter(self.recent)))
            self.recent[joint_angle] = self._followed(self._near(joint_angle), theta, joint_angle)
        return self.recent[joint_angle]

    def _near(self, joint_angle: float) -> Array:
        """Return poses over a turn at a joint angle nearby, led there by even steps from the drawing."""
        theta, poses = np.arange(PLACES) * (2.0 * np.pi / PLACES) + self.start, self.known[self.drawn_angle]
        steps = int((joint_angle - self.drawn_angle) / STEP)
        for k in range(1, abs(steps) + 1):
            alpha = self.drawn_angle + math.copysign(k * STEP, steps)
            if alpha not in self.known:
                self.known[alpha] = self._followed(poses, theta, alpha)
            poses = self.known[alpha]
        return poses

    def _followed(self, poses: Array, theta: Array, joint_angle: float) -> Array:
        if not np.all(np.isfinite(poses)):
            return poses
        found, misfit = self.linkage.settled(self.guess(poses, theta, np.full(theta.shape, joint_angle)), self.moving)
        return found if np.max(misfit) < CLOSED else np.full(poses.shape, np.nan)

    def law(self, joint_angle: float) -> Array:
        """Return leads at even places of a turn, as many as tell all harmonics, array (p,) [rad]; nan if stuck."""
        if joint_angle not in self.laws:
            if len(self.laws) >= LAWS:
                self.laws.clear()
            poses = self.turn(joint_angle)
            leads, count = self._leads(poses, joint_angle), PLACES
            while count < FINEST and np.all(np.isfinite(leads)):
                if faded(leads):
                    break
                count *= 2
                theta = even(count) + self.start
                poses = self._followed(np.repeat(poses, 2, axis=0), theta, joint_angle)
                leads = self._leads(poses, joint_angle)
            if self.start:  # angles count from another mark than that drawn: the same curve from there
                leads = waved(even(max(FINE, len(leads))) - self.start, leads)[0]
            leads = leads - self.lead
            self.laws[joint_angle] = np.where(np.max(np.abs(leads)) < max(EVEN, self.blur), 0.0, leads)
        return self.laws[joint_angle]

    def _leads(self, poses: Array, joint_angle: float) -> Array:
        """Return how far the driven link runs ahead of the driving one, array (p,) [rad]."""
        index = self.linkage.links.index(self.driven)
        swing = turn_about(self.centre, self.basis[2], np.asarray(joint_angle - self.drawn_angle))[:3, :3]
        after = swing @ self.after
        beyond = frames.cross(self.basis[2], after)
        own = poses[..., index, :3, :3] @ frames.cross(self.basis[2], self.after)
        turned = np.arctan2(own @ self.basis[2], own @ beyond)
        theta = np.arange(len(poses)) * (2.0 * np.pi / len(poses))
        lead = (turned - theta + np.pi) % (2.0 * np.pi) - np.pi
        return np.unwrap(lead)

    @property
    def after(self) -> Array:
        """Direction of the driven shaft as drawn, array (3,)."""
        return math.cos(self.drawn_angle) * self.basis[0] + math.sin(self.drawn_angle) * self.basis[1]

    def several(self, joint_angles: Array) -> Iterator[Array]:
        """Yield the leads over a turn at each of some joint angles (m,) [rad].

        Many by polynomials in the joint angle through the nearest `NODES` full degrees: they miss the law by rounding.
        """
        tables: dict[int, Array | None] = {}
        for alpha in joint_angles.tolist():
            first = math.floor(alpha / DEGREE) - NODES // 2 + 1
            if len(joint_angles) > MANY and first not in tables:
                rows = [self._fine((first + k) * DEGREE) for k in range(NODES)]
                tables[first] = np.stack(rows) if {len(row) for row in rows} == {FINE} else None
            table = tables.get(first)
            if table is None or not np.all(np.isfinite(table)):
                yield self.law(alpha)
                continue
            near = [(first + k) * DEGREE for k in range(NODES)]
            weight = [math.prod((alpha - b) / (a - b) for b in near if b != a) for a in near]
            yield np.asarray(weight) @ table

    def _fine(self, joint_angle: float) -> Array:
        """Return leads at `FINE` places of a turn or more; a joint bent the other way stands as half a turn on."""
        leads = self.law(abs(joint_angle))
        if len(leads) < FINE:
            leads = waved(even(FINE), leads)[0]
        return np.roll(leads, len(leads) // 2) if joint_angle < 0.0 else leads

    @property
    def mapped(self) -> bool:
        """Whether its law is of the form tan θ' = κ tan θ."""
        for alpha in (ASKED, self.drawn_angle):
            leads = self.law(alpha)
            tau = steepness(leads)
            places = unit_complex(np.arange(len(leads)) * (4.0 * np.pi / len(leads)))
            root = math.sqrt(max(1.0 - tau * tau, 0.0))
            if not np.all(np.isfinite(leads)) or not root:
                return False
            own = mobius.angle_error(((1.0 + 0.0j) / root, (-1.0 + 0.0j) * tau / root), places)
            if np.max(np.abs(own - leads)) > max(MAPPED, self.blur):
                return False
        return True

    def at(self, theta: Array, joint_angle: Array) -> Array:
        """Return poses at angles of the driving mark and joint angles (...) [rad], array (..., n, 4, 4)."""
        table = self.turn(float(np.mean(joint_angle)))
        place = np.rint((theta - self.start) * (PLACES / (2.0 * np.pi))).astype(int) % PLACES
        if not np.all(np.isfinite(table)):
            return np.full((*theta.shape, *table.shape[1:]), np.nan)
        found, misfit = self.linkage.settled(self.guess(table[place], theta, joint_angle), self.moving)
        return np.where(np.max(misfit, axis=(-2, -1))[..., None, None, None] < CLOSED, found, np.nan)

    def carried_to(self, stance: Stance, poses: Array) -> tuple[Array, Array]:
        """Return turn (..., n, 3, 3) and shift (..., n, 3) [m] that carry links from their file to where they stand."""
        before, normal = np.broadcast_arrays(stance.before, stance.normal)
        there = np.stack((before, frames.cross(normal, before), normal), axis=-2)
        whole = (np.swapaxes(there, -1, -2) @ self.basis)[..., None, :, :]
        shift = (whole @ (poses[..., :3, 3] - self.centre)[..., None])[..., 0]
        return whole @ poses[..., :3, :3], shift + np.asarray(stance.centre)[..., None, :]

    def placed(self, stance: Stance) -> tuple[tuple[Array, Array, Array], Array]:
        """Return point, axis and second axis of all pairs of a joint that stands somewhere, arrays (..., m, 3).

        And the turn of their second links from where they are drawn, array (..., m, 3, 3).
        """
        theta = stance.theta
        poses = self.at(theta, np.asarray(stance.joint_angle) + 0.0 * theta)
        moved = np.zeros_like(poses)
        moved[..., :3, :3], moved[..., :3, 3] = self.carried_to(stance, poses)
        moved[..., 3, 3] = 1.0
        return self.linkage.placed(moved), moved[..., self.linkage.second, :3, :3]

    @cached_property
    def _among(self) -> Linkage:
        """The pairs between the shafts."""
        return Linkage([pair for k, pair in enumerate(self.linkage.joints) if k not in self.bearings])

    def _left(self, poses: Array) -> tuple[Array, int]:
        """Return what the pairs between the shafts hold, (..., s, 6 m), and which of the m links is the driven one."""
        among = self._among
        there = np.stack([poses[..., self.linkage.links.index(link), :, :] for link in among.links], axis=-3)
        moving = [k for k, link in enumerate(among.links) if link != self.driving]
        matrix = among.matrix(among.scaled(there, 1.0))[0][..., moving, :]
        return np.reshape(matrix, (*matrix.shape[:-2], -1)), moving.index(among.links.index(self.driven))

    def wrenches(self, poses: Array) -> Array:
        """Return what the joint can pass on where its links stand, array (..., 6 - `freedom`, 6).

        Wrenches (couple over the size; force) about the centre, square to each other: those that work on no motion of
        the driven against the driving link that the pairs between them leave.
        """
        matrix, driven = self._left(poses)
        twists = _null(matrix, self.freedom + self.idle)[..., 6 * driven : 6 * driven + 6]
        turning, arm = twists[..., :3], (self.centre - self._among.middle) / self._among.size
        twists = np.concatenate((turning, twists[..., 3:] + frames.cross(turning, arm + 0.0 * turning)), axis=-1)
        return np.linalg.svd(twists)[2][..., self.freedom :, :]

    def passed(self, theta: Array, joint_angle: Array) -> tuple[Array, Array]:
        """Return what force goes with a torque of 1 N·m on the driven shaft, and where none else can.

        theta, joint_angle (p,) [rad]. Returns the force on the driven shaft (p, 3) [1/m], and directions (p, k, 3) in
        which the joint passes on no other, both in the axes of the joint.

        Of the wrenches that the joint can pass on, those without a torque about the driven shaft are forces in the
        centre alone: their couples work on no turn and no bending about it. Across these forces that of the torque
        stands.
        """
        asked = theta.tobytes() + joint_angle.tobytes()
        if asked not in self.split:
            self.split.clear()
            self.split[asked] = self._passed(theta, joint_angle)
        return self.split[asked]

    def _passed(self, theta: Array, joint_angle: Array) -> tuple[Array, Array]:
        """Return the same, found anew."""
        found = self.wrenches(self.at(theta, joint_angle))
        bent = frames.rotate(np.broadcast_to(self.basis[0], (*theta.shape, 3)), self.basis[2], joint_angle)
        about = (found[..., :3] @ bent[..., None])[..., 0]
        whole = (about[..., None, :] @ found)[..., 0, 3:] / (self._among.size * np.sum(about * about, axis=-1))[:, None]
        forces = (_null(about[..., None, :], about.shape[-1] - 1) @ found)[..., 3:]
        free = _null(forces, self.freedom - 2)
        push = (np.swapaxes(free, -1, -2) @ (free @ whole[..., None]))[..., 0]
        return push @ self.basis.T, free @ self.basis.T

    def carrying(self) -> str:
        """Return in a sentence which shaft slides along itself, and how far."""
        text = _(
            "{link} slides along its axis as it turns, by {way:.3g} mm at a joint angle of {angle:.4g}°, or as the "
            "joint angle changes; a shaft that is held cannot"
        )
        way = (self.sliding or 0.0) / mm
        return text.format(link=repr(self.driven), way=way, angle=self.drawn_angle / deg)

    def stuck(self, joint_angle: float) -> str:
        """Return which pair opens first, at which angle and how far, over a turn at a joint angle [rad]; "" if none."""
        near, poses = self.drawn_angle, self.known[self.drawn_angle]
        theta = np.arange(PLACES) * (2.0 * np.pi / PLACES) + self.start
        for alpha in np.linspace(near, joint_angle, max(2, math.ceil(abs(joint_angle - near) / STEP) + 1))[1:]:
            poses, misfit = self.linkage.settled(self.guess(poses, theta, np.full(theta.shape, alpha)), self.moving)
            if np.max(misfit) > CLOSED:
                k = int(np.argmax(np.max(misfit, axis=(-2, -1))))
                return self.opened(misfit[k], float(theta[k]), float(alpha))
        return ""

    def opened(self, misfit: Array, theta: float, joint_angle: float) -> str:
        """Return which pair opens most, of which link, and how far."""
        pair = self.linkage.joints[int(np.argmax(np.max(misfit, axis=-1)))]
        gap, lean = open_by(misfit)
        text = _(
            "{link} cannot follow: with the driving link turned by {angle:.4g}°, at a joint angle of "
            "{joint_angle:.4g}°, {pair} stays open: its pairs lack {gap:.3g} mm and {lean:.3g}°"
        )
        link = next((one for one in pair.links[::-1] if one not in (*self.grounds, self.driving)), pair.links[1])
        said = text.format(
            link=repr(link),
            pair=repr(pair.id),
            gap=gap * self.linkage.size / mm,
            lean=lean / deg,
            angle=theta / deg,
            joint_angle=joint_angle / deg,
        )
        return said + by_rounding(gap)


def even(count: int) -> Array:
    """Return even places of a turn, array (count,) [rad]."""
    return np.arange(count) * (2.0 * np.pi / count)


def steepness(leads: Array) -> float:
    """Return τ of the map with the second order of a law, from its leads at even places of a turn."""
    return float(2.0 * np.mean(leads * np.sin(4.0 * np.pi * np.arange(len(leads)) / len(leads))))


@lru_cache(maxsize=64)
def inside_of(mechanism: Mechanism, driving: str, driven: str) -> Inside:
    """Return the loops of a mechanism that stands between two shafts, closed over a turn.

    driving, driven: its links that are shafts; those that it calls input and output when empty.
    Raises InputError: it is no joint: what is not as it must be, with link, angle and amount.
    """
    ends = [driving or mechanism.input_link, driven or mechanism.output_link]
    check(_link_problems(mechanism, ends))
    given, mechanism = mechanism, exactly(mechanism)
    one, two = (_bearing(mechanism, link) for link in ends)
    check(_pair_problems(mechanism, (one, two)))
    found = _drawn(mechanism, (ends[0], ends[1]), (one, two))
    if given.rounding is not None:
        found = replace(found, blur=fitted(given).turn + fitted(given).shift / found.radius)
    return _turned(found)


def _link_problems(mechanism: Mechanism, ends: list[str]) -> Iterator[Problem]:
    words = ("driving", "driven")
    for word, link, key in zip(words, ends, ("input_link", "output_link"), strict=True):
        if not link:
            text = _("missing: neither this key nor {key} of the mechanism file names the shaft")
            yield Problem(word, text.format(key=key), "missing")
        elif link not in mechanism.links:
            text = _("the mechanism has no moving link {link}; it has {links}")
            yield Problem(word, text.format(link=repr(link), links=", ".join(map(repr, mechanism.links))))
    if ends[0] and ends[0] == ends[1]:
        yield Problem("driven", _("is the driving link too"), "inconsistent")


def _bearing(mechanism: Mechanism, link: str) -> int:
    """Return which pair is the bearing of a shaft."""
    ends = {mechanism.frame, link}
    held = [k for k, pair in enumerate(mechanism.joints) if set(pair.links) == ends]
    if len(held) == 1 and mechanism.joints[held[0]].type in BEARINGS and mechanism.joints[held[0]].axis is not None:
        return held[0]
    text = _(
        "{link} needs one pair with the frame, of type R or C, or a ball, S or SG, with an axis: the bearing that "
        "tells where its axis lies"
    )
    raise InputError([Problem("file", text.format(link=repr(link)), "inconsistent")])


def _pair_problems(mechanism: Mechanism, bearings: tuple[int, int]) -> Iterator[Problem]:
    for k, pair in enumerate(mechanism.joints):
        if mechanism.frame in pair.links and k not in bearings:
            text = _("{pair} joins {link} with the frame; of a joint only both shafts stand in bearings")
            link = next(one for one in pair.links if one != mechanism.frame)
            yield Problem("file", text.format(pair=repr(pair.id), link=repr(link)), "inconsistent")
        if pair.kind.screw:
            text = _("{pair} is a helical pair; a joint that turns all round cannot have one")
            yield Problem("file", text.format(pair=repr(pair.id)), "inconsistent")
        if pair.kind.rolls:
            text = _(
                "{pair} rolls: it holds a speed, not a place; a joint stands alike after a turn, whatever way it came"
            )
            yield Problem("file", text.format(pair=repr(pair.id)), "inconsistent")


def _drawn(mechanism: Mechanism, ends: tuple[str, str], bearings: tuple[int, int]) -> Inside:
    """Return the loops where they are drawn."""
    grounds = mechanism.frame, f"{mechanism.frame} '"
    named = [
        tuple(grounds[1] if link == mechanism.frame and k == bearings[1] else link for link in pair.links)
        for k, pair in enumerate(mechanism.joints)
    ]
    joints = list(mechanism.joints)
    for k in bearings:  # a shaft that the joint centres and a ball holds keeps its direction as in a bearing
        joints[k] = replace(joints[k], type=BEARINGS[joints[k].type])
    linkage = Linkage(joints, [(one, two) for one, two in named])
    one, two = (mechanism.joints[k] for k in bearings)
    a, b = one.along, two.along
    p, q = np.asarray(one.point, dtype=float), np.asarray(two.point, dtype=float)
    normal = frames.cross(a, b)
    sine = float(frames.norm(normal))
    if sine < math.sin(LEAST):
        text = _("its shafts lie in one line ({angle:.3g}°): draw it at a joint angle, which tells centre and plane")
        raise InputError([Problem("file", text.format(angle=math.degrees(math.asin(sine))), "inconsistent")])
    apart = float((q - p) @ normal) / sine
    if abs(apart) > MEET * linkage.size:
        text = _("its shafts pass each other {gap:.6g} mm apart; those of a joint meet")
        raise InputError([Problem("file", text.format(gap=abs(apart) / mm), "inconsistent")])
    centre = p + (float(frames.cross(q - p, b) @ normal) / sine**2) * a
    before = frames.unit(centre - p) if frames.norm(centre - p) > MEET * linkage.size else a
    after = frames.unit(q - centre) if frames.norm(q - centre) > MEET * linkage.size else b
    if before @ after <= 0.0:
        text = _("its shafts enclose {angle:.4g}°; put the point of each bearing where its shaft lies, within 90°")
        raise InputError([Problem("file", text.format(angle=math.degrees(math.acos(before @ after))), "out_of_range")])
    plane = frames.unit(frames.cross(before, after))
    return Inside(
        linkage=linkage,
        driving=ends[0],
        driven=ends[1],
        bearings=bearings,
        grounds=grounds,
        centre=centre,
        basis=np.stack((before, frames.cross(plane, before), plane)),
        drawn_angle=float(np.arctan2(frames.norm(frames.cross(before, after)), before @ after)),
    )


def _turned(drawn_: Inside) -> Inside:
    """Return the loops with all that a turn tells of them; refuse those that do not turn, or not by one input."""
    driven = drawn_.linkage.links.index(drawn_.driven)
    poses, misfits = drawn_.all_round()
    if np.max(misfits[-1]) > CLOSED:
        theta = len(misfits) * 2.0 * np.pi / PLACES
        raise InputError([Problem("file", drawn_.opened(misfits[-1], theta, drawn_.drawn_angle), "out_of_range")])
    where = drawn_.moving.index(driven)
    loose = [drawn_.linkage.motions(one, drawn_.moving) for one in poses[3:-1:17]]
    free = min(_rank(one[:, where]) for one in loose)
    if free:
        text = plural(
            "{link} is not held: with {driving} at rest it has {count} motion left; a joint has one input",
            "{link} is not held: with {driving} at rest it has {count} motions left; a joint has one input",
            free,
        )
        said = text.format(link=repr(drawn_.driven), driving=repr(drawn_.driving), count=free)
        raise InputError([Problem("file", said, "inconsistent")])
    around = np.abs(poses[-1, driven, :3, :3] - np.eye(3)).max()
    if around > MOVES:
        text = _("{link} is turned by {angle:.4g}° after a turn of {driving}; the shafts of a joint turn equally often")
        turned = math.degrees(math.acos(min(1.0, max(-1.0, 0.5 * (np.trace(poses[-1, driven, :3, :3]) - 1.0)))))
        said = text.format(link=repr(drawn_.driven), driving=repr(drawn_.driving), angle=turned)
        raise InputError([Problem("file", said, "inconsistent")])
    drawn_.known[drawn_.drawn_angle] = poses[:-1]
    leads = drawn_.law(drawn_.drawn_angle)
    wave = 2.0 * np.mean(leads * np.exp(-4.0j * np.pi * np.arange(len(leads)) / len(leads)))
    start = 0.0
    if abs(wave) > EVEN:  # angles count from where the second order is a sine: the arms of a cross
        start = 0.5 * (float(np.angle(wave)) - 0.5 * np.pi)
        start = (start + 0.25 * np.pi) % (0.5 * np.pi) - 0.25 * np.pi
    known = {drawn_.drawn_angle: poses[:-1]}
    return replace(_held(drawn_), start=start, lead=float(np.mean(leads)), known=known, recent={}, laws={}, split={})


def _rank(motions: Array) -> int:
    """Return how many of some small motions (w, d) are independent."""
    return int(np.linalg.matrix_rank(motions, tol=MOVES)) if len(motions) else 0


def _held(inside: Inside) -> Inside:
    """Return the loops with what the pairs between the shafts hold, told by some places of the turn drawn."""
    theta, alpha = np.arange(PLACES)[3::17] * (2.0 * np.pi / PLACES), inside.drawn_angle
    every = inside.known[alpha]
    matrix, driven = inside._left(every[3::17])
    size = np.linalg.svd(matrix)[1]
    idle = matrix.shape[-1] - int(np.max(np.sum(size > LEFT * size[..., :1], axis=-1)))
    freedom = max(_rank(one) for one in _null(matrix, idle)[..., 6 * driven : 6 * driven + 6])
    found = replace(inside, freedom=freedom, idle=idle - freedom)
    couples = np.linalg.svd(found.wrenches(every[3::17])[..., :3])[1]
    if np.max(np.sum(couples > MOVES, axis=-1)) > 1:
        pose = every[:, inside.linkage.links.index(inside.driven)]
        way = np.ptp((pose[:, :3, :3] @ inside.centre + pose[:, :3, 3]) @ inside.after)
        return replace(found, sliding=float(way))
    ways = found.passed(theta, np.full(theta.shape, alpha))[1]
    middle = np.asarray([math.cos(0.5 * alpha), math.sin(0.5 * alpha), 0.0])
    along = np.min(frames.norm(ways @ middle)) > math.cos(0.5 * alpha) - MOVES  # some way between both shafts
    return replace(found, slides=bool(along) and 2 < freedom < 5)


def _null(rows: Array, count: int) -> Array:
    """Return directions that rows (..., s, d) leave, as many as are asked for, array (..., count, d)."""
    return np.linalg.svd(rows)[2][..., rows.shape[-1] - count :, :]


# The picture: every link as bars between its pairs, with its pins and balls.


def _link(inside: Inside, link: int, thin: float) -> Surface:
    """Return a link where it is drawn: bars from its middle to its pairs, with the pins and balls that it carries."""
    linkage, name = inside.linkage, inside.linkage.links[link]
    own = [k for k in range(len(linkage.joints)) if link in (linkage.first[k], linkage.second[k])]
    points = {k: np.asarray(linkage.joints[k].point, dtype=float) for k in own if k not in inside.bearings}
    shafts = {inside.driving: -inside.basis[0], inside.driven: inside.after}
    if name in shafts:
        middle = inside.centre + 1.3 * inside.radius * shafts[name]
    else:
        middle = np.mean(list(points.values()), axis=0)
    parts = [placed(ball(1.3 * thin, 12), None, middle)]
    for k, point in points.items():
        pair = linkage.joints[k]
        if frames.norm(point - middle) > thin:
            parts.append(_rod(middle, point, 0.8 * thin))
        wide = 0.5 * pair.diameter if pair.diameter else 1.1 * thin
        if linkage.first[k] == link and pair.type in ("R", "C", "P", "U"):
            parts.append(_rod(point - 2.0 * thin * pair.along, point + 2.0 * thin * pair.along, wide))
        elif linkage.second[k] == link and pair.type not in ("R", "C", "P", "U"):
            parts.append(placed(ball(1.5 * wide, 14), None, point))
    return joined(*parts)


def _rod(start: Array, end: Array, radius: float) -> Surface:
    """Return a round bar between two points."""
    length = float(frames.norm(end - start))
    along = (end - start) / length
    aside = frames.perpendicular(along)
    bar = revolved([(0.0, 0.0), (0.0, radius), (length, radius), (length, 0.0)], 14)
    return placed(bar, np.stack((along, aside, frames.cross(along, aside))), start)
