"""Where the bodies of a joint are put together: what they have to fit, and what takes them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from cardan.answers.quantity import Quantity, Text, say
from cardan.drive.cross import Cross
from cardan.drive.joint_parts import Needles
from cardan.drive.shapes import caps, cross_body, fork
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.maths.kernel.meshes import Surface, ball, placed, revolved
from cardan.texts import _

from .inner import Stance

BACK = np.diag([-1.0, 1.0, -1.0])  # turns a yoke round, so that its hub lies against the power flow


@dataclass(frozen=True, kw_only=True, slots=True)
class JointSize:
    """Sizes of a joint [m]."""

    radius: float  # from the joint centre to the middle of a bearing
    ear: float  # thickness of the ears of a yoke, along the journals
    journal: float  # diameter of the journals
    cap: float  # outer radius of a bearing cap
    lug: float  # outer radius of an ear
    cavity: float  # from the joint centre to the bottom between the ears
    given: bool  # whether the file says how large the joint is

    @property
    def base(self) -> float:
        """From the joint centre to where the hub of a yoke begins [m]."""
        return self.cavity + 0.4 * self.radius

    @property
    def reach(self) -> float:
        """From the joint centre to the end of a yoke's hub [m]."""
        return self.base + 0.35 * self.radius

    @property
    def outer(self) -> float:
        """Radius that the joint needs when it turns straight [m]."""
        return self.radius + 0.5 * self.ear + 0.04 * self.radius


STEEPEST, LEAST = math.radians(42.0), math.radians(13.0)
"""Yokes leave room for joint angles between these, and a little more."""


def joint_size(
    span: float | None, cross: Cross | None, needles: Needles | None, joint_angle: float, usual: float = 0.0
) -> JointSize:
    """Return how large a joint is: what the file says of it, the rest in proportion.

    span, usual [m]: distance of opposite bearings; half of it where the file says none.
    joint_angle [rad]: for which its yokes leave room.
    """
    radius = usual if span is None else 0.5 * span
    journal = cross.journal if cross is not None and cross.journal is not None else 0.52 * radius
    journal = min(journal, 0.9 * radius)
    rolls = needles.diameter if needles is not None and needles.diameter is not None else 0.12 * journal
    cap = min(0.5 * journal + rolls + 0.1 * journal, 0.62 * radius)
    ear = cross.journal_length if cross is not None and cross.journal_length is not None else 0.95 * journal
    ear = min(ear, 0.6 * radius)
    lug = min(1.42 * cap, 0.85 * radius)
    tilt = min(max(joint_angle, LEAST), STEEPEST) + math.radians(4.0)
    cavity = lug * math.cos(tilt) + (radius + 0.5 * ear) * math.sin(tilt) + 0.05 * radius
    return JointSize(radius=radius, ear=ear, journal=journal, cap=cap, lug=lug, cavity=cavity, given=span is not None)


class Stage(Protocol):
    """What takes tracks and bodies."""

    def track(self, origin: Array, *directions: Array) -> int:
        """Add a track whose x, y and z point to directions (p, 3), and return its number."""

    def add(
        self,
        part: str,
        number: int,
        path: str,
        text: Text,
        track: int,
        *surfaces: Surface,
        role: str,
        shade: float = 0.0,
        metal: bool = True,
    ) -> None:
        """Add a body, whose surface is told in the frame of its track."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Side:
    """One side of a joint, where its shaft begins."""

    driving: bool
    number: int  # number of the shaft
    track: int  # track of its end; x runs along the power flow
    turn: Array | None  # (3, 3): turns a body whose x runs away from the joint to the track
    reach: float  # [m]: from the joint centre to the end of the yoke's hub
    body: float  # [m]: radius of the shaft there
    thickest: float  # [m]: radius of the shaft where it is thickest

    @property
    def role(self) -> str:
        """Role of the colour of what belongs to the shaft."""
        return f"shaft {self.number}"

    @property
    def yoke(self) -> str:
        """What its yoke is called among the parts."""
        return "driving yoke" if self.driving else "driven yoke"


@dataclass(frozen=True, eq=False, kw_only=True)
class Site:
    """A joint while its bodies are put together."""

    stage: Stage  # what takes them
    number: int  # number of the joint, from 1
    name: str  # what it is called, in words
    first: bool  # whether it is the first of several, whose wide side then belongs on the driving shaft
    stance: Stance  # where it stands over a turn, marks (p, 3)
    size: JointSize
    apart: float  # [m]: from the joint centre to the middle of either of two crosses that there is room for
    driving: Side
    driven: Side
    gravity: tuple[float, float, float]  # [m/s²]

    @property
    def path(self) -> str:
        """Where the file speaks of the joint."""
        return f"joints[{self.number - 1}]"

    @property
    def sides(self) -> tuple[Side, Side]:
        """The driving side and the driven one."""
        return self.driving, self.driven

    def along(self, origin: Array, axis: Array, across: Array) -> int:
        """Add a track whose x points along an axis and y across it."""
        return self.stage.track(origin, axis, across, frames.cross(np.broadcast_to(axis, across.shape), across))

    def said(self, text: str) -> str:
        """Return a text in which {joint} stands for what the joint is called."""
        return text.format(joint=self.name)

    def add(
        self,
        part: str,
        text: Text,
        track: int,
        *surfaces: Surface,
        role: str = "cross",
        shade: float = 0.0,
        metal: bool = True,
    ) -> None:
        """Add a body of the joint itself."""
        self.stage.add(part, self.number, self.path, text, track, *surfaces, role=role, shade=shade, metal=metal)

    def add_to(self, side: Side, part: str, text: Text, surface: Surface) -> None:
        """Add a body of a shaft, whose x runs away from the joint."""
        shape = placed(surface, side.turn)
        self.stage.add(part, side.number, self.path, text, side.track, shape, role=side.role)


# Bodies that joints of several kinds have: yokes, a cross, a bell with balls.

QUARTER = np.asarray([(1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, -1.0, 0.0)])
"""Turns a yoke by a quarter turn from the mark of its shaft."""

BALLS = 6  # number of balls of a joint that is only known to be even


def about(surface: Surface, angle: float) -> Surface:
    """Return a surface turned about x."""
    c, s = float(np.cos(angle)), float(np.sin(angle))
    return placed(surface, np.asarray([(1.0, 0.0, 0.0), (0.0, c, s), (0.0, -s, c)]))


def length_text(value: float) -> Quantity:
    """Return a length as it is told."""
    return Quantity(value, "length", 4, trim=True)


def cross_text(site: Site, size: JointSize) -> Text:
    """Return what to say of a cross."""
    if size.given:
        text = _("cross of {joint}: span {span}, journals {journal}")
        span, journal = length_text(2.0 * size.radius), length_text(size.journal)
        return say(text, joint=site.name, span=span, journal=journal)
    return _("cross of {joint}; the file gives no span, so its size is in proportion to the shafts").format(
        joint=site.name
    )


def yoke(
    site: Site,
    side: Side,
    size: JointSize,
    *,
    bore: bool = True,
    away: float = 0.0,
    tip: float = 0.0,
    quarter: bool = False,
) -> None:
    """Add a yoke and its bearing caps.

    It swings ``away`` off the joint centre; ears without bores end at ``tip``, counted toward the hub.
    """
    reach = side.reach - away
    cavity = min(size.cavity, 0.66 * reach)
    made = fork(size.radius, size.ear, size.lug, size.cap if bore else 0.0, cavity, reach, side.body, tip)
    turn = BACK if side.driving else None
    shift = np.asarray([-away if side.driving else away, 0.0, 0.0])
    text = _("driving yoke of shaft {number}") if side.driving else _("driven yoke of shaft {number}")
    shape = placed(made, turn, shift)
    shape = placed(shape, QUARTER) if quarter else shape
    said = text.format(number=side.number)
    site.stage.add(side.yoke, side.number, site.path, said, side.track, shape, role=side.role)
    if bore:
        cap = placed(caps(size.radius, size.ear, size.cap), turn, shift)
        site.add("bearing cap", _("bearings of joint {number}").format(number=site.number), side.track, cap, shade=0.35)


def yokes_and_cross(site: Site, *, offset: float = 0.0, text: Text = "") -> None:
    """Add yokes, cross and bearings of a joint with one cross, whose pins may stand a distance apart [m]."""
    for side in site.sides:
        yoke(site, side, site.size)
    u, v = site.stance.driving, site.stance.driven
    track = site.stage.track(site.stance.centre, u, v, frames.cross(u, v))
    made = cross_body(site.size.radius, site.size.ear, site.size.journal, offset)
    site.add("cross", text or cross_text(site, site.size), track, made)


def bell_and_balls(site: Site, *, count: int = BALLS, groove: float | None = None) -> None:
    """Add bell, inner race, cage and balls, which run in the bisecting plane.

    count: number of balls.
    groove: radius of the middle line of their grooves; in proportion to the joint when not given.
    """
    groove = groove or 0.82 * site.size.radius
    outside, inside = site.sides if site.first else site.sides[::-1]
    bead = min(0.27, 0.8 * np.sin(np.pi / count)) * groove
    site.add_to(outside, "bell", site.said(_("bell of {joint}")), _bell(groove, bead, outside))
    site.add_to(inside, "inner race", site.said(_("inner race of {joint}")), _inner_race(groove, bead, inside))
    stance = site.stance
    theta, middle = stance.theta, stance.middle
    cage = site.along(stance.centre, middle, stance.halving(theta))
    site.add("cage", site.said(_("cage of {joint}, in the bisecting plane")), cage, _cage(groove), shade=0.1)
    for j in range(count):
        own = across_halving(site, theta + j * 2.0 * np.pi / count)
        shape = placed(ball(bead, 14), None, (groove, 0.0, 0.0))
        site.add("ball", site.said(_("ball of {joint}")), own, shape, shade=0.55)


def across_halving(site: Site, turn: Array) -> int:
    """Add a track in the bisecting plane: its x out to the meridian at an angle (p,) [rad]."""
    way = site.stance.halving(turn)
    return site.along(site.stance.centre, way, frames.cross(np.broadcast_to(site.stance.middle, way.shape), way))


def _bell(groove: float, bead: float, side: Side) -> Surface:
    inner, outer = 1.12 * groove, max(1.12 * groove + 0.62 * bead, 1.36 * groove)
    reach = max(side.reach, 1.5 * groove)
    body = min(side.body, 0.9 * outer)
    turn = np.linspace(0.0, 0.46 * np.pi, 7)
    cup = [(inner * float(np.cos(t)), inner * float(np.sin(t))) for t in turn]
    cup[0] = (inner, 0.0)
    mouth = -0.08 * groove
    cup.append((mouth, 1.0 * inner))
    shell = [(mouth, outer), (0.1 * groove, 1.03 * outer), (0.62 * groove, outer), (1.25 * groove, 1.15 * body)]
    return revolved([*cup, *shell, (1.32 * groove, body), (reach, body), (reach, 0.0)], 36)


def _inner_race(groove: float, bead: float, side: Side) -> Surface:
    inner = groove - 0.3 * bead
    reach = side.reach
    body = min(side.body, 0.55 * groove)
    turn = np.linspace(0.72 * np.pi, 0.28 * np.pi, 9)
    race = [(inner * float(np.cos(t)), inner * float(np.sin(t))) for t in turn]
    return revolved(
        [(race[0][0], 0.0), *race, (race[-1][0] + 0.02 * groove, body), (reach - 0.1 * groove, body),
         (reach, side.body), (reach, 0.0)],
        28,
    )  # fmt: skip


def _cage(groove: float) -> Surface:
    turn = np.linspace(0.64 * np.pi, 0.36 * np.pi, 7)
    low, high = 0.96 * groove, 1.08 * groove
    out = [(high * float(np.cos(t)), high * float(np.sin(t))) for t in turn]
    into = [(low * float(np.cos(t)), low * float(np.sin(t))) for t in turn[::-1]]
    return revolved([*out, *into, out[0]], 36)
