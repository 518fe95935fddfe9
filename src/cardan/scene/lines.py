"""What is drawn round the bodies of a scene: axes, planes, angles, dimensions and names."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from cardan.answers import palette
from cardan.answers.quantity import Quantity
from cardan.answers.reader import half_turn, reader
from cardan.drive.bodies.assembly import extent
from cardan.drive.bodies.build import Build
from cardan.drive.shapes import floor_frame
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.texts import _
from cardan.units import deg

from .parts import SceneArea, SceneGroup, SceneLabel, SceneLine

STEP = math.radians(5.0)
"""Step of an arc."""

LEAST = math.radians(0.05)
"""Smaller angles are not drawn, only told."""

SHOWN = ("names", "axes")
"""Groups that are drawn from the start."""
Drawn = tuple[tuple[SceneLine, ...], tuple[SceneArea, ...], tuple[SceneLabel, ...], tuple[SceneGroup, ...]]


@dataclass(eq=False, kw_only=True)
class _Paper:
    """Lines, areas and labels while they are made."""

    build: Build
    lines: list[SceneLine] = field(default_factory=list)
    areas: list[SceneArea] = field(default_factory=list)
    labels: list[SceneLabel] = field(default_factory=list)

    def line(
        self, group: str, points: Array, role: str, *, dashed: bool = False, width: float = 1.0, track: int = 0
    ) -> None:
        points, colour = np.asarray(points), palette.colour(role)
        self.lines.append(SceneLine(group=group, points=points, colour=colour, dashed=dashed, width=width, track=track))

    def label(self, group: str, text: str, at: Array, role: str, track: int = 0) -> None:
        self.labels.append(SceneLabel(group=group, text=text, at=np.asarray(at), role=role, track=track))

    def fan(
        self, group: str, middle: Array, rim: Array, role: str, text: str, *, opacity: float = 0.3, track: int = 0
    ) -> None:
        """Add the area between a point and a rim (m, 3)."""
        one = np.arange(1, len(rim))
        corners = np.concatenate((np.asarray(middle)[None], rim))
        faces, tint = np.stack((np.zeros_like(one), one, one + 1), axis=-1), palette.colour(role)
        self.areas.append(
            SceneArea(
                group=group, positions=corners, indices=faces, colour=tint, opacity=opacity, text=text, track=track
            )
        )

    def sector(
        self,
        group: str,
        middle: Array,
        start: Array,
        other: Array,
        angle: float,
        radius: float,
        role: str,
        text: str,
        *,
        track: int = 0,
        say: bool = True,
    ) -> None:
        """Add a sector from a direction over an angle toward one at right angles, its rim an arrow, and its label."""
        if abs(angle) > LEAST:
            turn = np.linspace(0.0, angle, max(3, int(abs(angle) / STEP) + 2))[:, None]
            rim = middle + radius * (np.cos(turn) * start + np.sin(turn) * other)
            self.fan(group, middle, rim, role, text, track=track)
            self.line(group, rim, role, width=1.5, track=track)
            tip, way = rim[-1], frames.unit(rim[-1] - rim[-2])
            out = frames.unit(tip - middle)
            size = min(0.16 * radius, 0.6 * radius * abs(angle))
            barbs = np.stack((tip - size * way + 0.4 * size * out, tip, tip - size * way - 0.4 * size * out))
            self.line(group, barbs, role, width=1.5, track=track)
        if say:
            half = 0.5 * angle
            at = middle + 1.22 * radius * (math.cos(half) * start + math.sin(half) * other)
            self.label(group, text, at, "value", track)


def drawn_round(build: Build, size: float) -> Drawn:
    """Return lines, areas and labels round the bodies of a drive, and the switches of their groups. size [m]."""
    paper = _Paper(build=build)
    for draw in (_axes, _planes, _joint_angles, _yokes):
        draw(paper)
    _dimensions(paper, size)
    _names(paper)
    yokes = _(
        "γ runs from the driving to the driven yoke of a shaft, ψ from the plane of a joint to its driving "
        "yoke at the start; clockwise along the power flow is positive."
    )
    planes = _("The plane of a joint holds its two shafts; β is the twist from one plane to the next.")
    rows = (
        ("names", _("Names"), ""),
        ("axes", _("Axes"), _("Chain lines are the axes of the shafts.")),
        ("planes", _("Planes"), planes),
        ("angles", _("Joint angles"), _("The joint angle of a joint is the angle between its two shafts.")),
        ("yokes", _("Yoke angles"), yokes),
        (
            "dimensions",
            _("Dimensions"),
            _("Lengths between joint centres, and how far the last one lies off the first."),
        ),
    )
    groups = (SceneGroup(name=name, title=title, on=name in SHOWN, text=text) for name, title, text in rows)
    return tuple(paper.lines), tuple(paper.areas), tuple(paper.labels), tuple(groups)


def _ends(build: Build, k: int) -> tuple[Array, Array]:
    """Return the two ends of shaft k, from 1, as drawn."""
    low, high = extent(build, k)
    if 1 < k <= build.count:
        return build.centre(k - 2), build.centre(k - 1)
    joint = build.centre(0 if k == 1 else k - 2)
    return joint + low * build.axis(k), joint + high * build.axis(k)


def _axes(paper: _Paper) -> None:
    build = paper.build
    for k in range(1, build.count + 2):
        start, stop = _ends(build, k)
        axis = build.axis(k)
        more = 1.5 * build.sizes.usual
        first = start - (more if k == 1 else 2.2 * build.sizes.joints[k - 2].radius) * axis
        last = stop + (more if k > build.count else 2.6 * build.sizes.joints[k - 1].radius) * axis
        paper.line("axes", np.stack((first, last)), f"shaft {k}", dashed=True)


def _planes(paper: _Paper) -> None:
    build = paper.build
    for i in range(build.count):
        if float(build.place.joint_angle[i]) < LEAST:
            continue
        middle, normal = build.centre(i), build.place.normal[i]
        before, behind = (0.42 * float(np.linalg.norm(np.subtract(*_ends(build, k)))) for k in (i + 1, i + 2))
        a, b = build.axis(i + 1), build.axis(i + 2)
        half = 2.4 * build.sizes.joints[i].radius
        outward = frames.unit(a - b)
        corners = np.stack(
            (
                middle - before * a,
                middle - before * a + half * frames.cross(normal, a) * -1.0,
                middle + half * outward,
                middle + behind * b - half * frames.cross(normal, b),
                middle + behind * b,
                middle + behind * b + half * frames.cross(normal, b),
                middle - half * outward,
                middle - before * a + half * frames.cross(normal, a),
                middle - before * a,
            )
        )
        text = _("plane of joint {number}").format(number=i + 1)
        paper.fan("planes", middle, corners, "accent", text, opacity=0.14)
        paper.line("planes", corners[[1, 2, 3, 5, 6, 7, 1]], "accent")
    for k in range(2, build.count + 1):
        _twist(paper, k)


def _twist(paper: _Paper, k: int) -> None:
    """Draw the twist from the plane of the joint before shaft k to that of the joint behind it."""
    build = paper.build
    beta = float(build.place.plane_twist[k - 2])
    start, stop = _ends(build, k)
    axis = build.axis(k)
    before = frames.cross(build.place.normal[k - 2], axis)
    across = frames.cross(axis, before)
    radius = 2.0 * build.sizes.usual
    middle = start + 0.42 * (stop - start)
    for way in (before, math.cos(beta) * before + math.sin(beta) * across):
        paper.line("planes", np.stack((middle - radius * way, middle + 1.15 * radius * way)), "muted", dashed=True)
    text = _marked("β", k, beta)
    paper.sector("planes", middle, before, across, beta, radius, "muted", text)


def _joint_angles(paper: _Paper) -> None:
    build = paper.build
    for i in range(build.count):
        joint_angle, middle = float(build.place.joint_angle[i]), build.centre(i)
        a, normal = build.axis(i + 1), build.place.normal[i]
        start, stop = _ends(build, i + 2)
        clear = 1.35 * build.body_radius(i + 2) / max(math.sin(joint_angle), 1e-3)
        radius = max(3.0 * build.sizes.joints[i].radius, min(clear, 0.55 * float(np.linalg.norm(stop - start))))
        text = _angle(joint_angle)
        paper.sector("angles", middle, a, frames.cross(normal, a), joint_angle, radius, "warning", text, say=False)
        paper.line("angles", np.stack((middle, middle + 1.12 * radius * a)), "muted", dashed=True)
        paper.label("angles", text, middle + 1.18 * radius * a, "value")


def _yokes(paper: _Paper) -> None:
    """Draw yoke angles on their shafts, which carry them round, and phase angles where joints stand at the start."""
    build = paper.build
    for k in range(2, build.count + 1):
        gamma = math.radians(half_turn(build.drive.shafts[k - 1].yoke_angle / deg))
        track, length = build.starts[k], float(build.place.length[k - 1])
        radius = 1.9 * build.body_radius(k)
        first, last = build.reach(k - 2, driving=False), length - build.reach(k - 1, driving=True)
        middle = np.asarray([0.5 * (first + last), 0.0, 0.0])
        driven = np.asarray([0.0, 1.0, 0.0])
        driving = np.asarray([0.0, math.cos(gamma), -math.sin(gamma)])
        across = np.asarray([0.0, math.sin(gamma), math.cos(gamma)])
        skin = 1.03 * build.body_radius(k)
        for way, end in ((driven, first), (driving, last)):
            from_ = np.asarray([end, 0.0, 0.0]) + skin * way
            points = np.stack((from_, middle + skin * way, middle + 1.15 * radius * way))
            paper.line("yokes", points, f"shaft {k}", width=2.0, track=track)
        text = _marked("γ", k, gamma)
        paper.sector("yokes", middle, driving, across, gamma, radius, f"shaft {k}", text, track=track)
    for i in range(build.count):
        a, normal = build.axis(i + 1), build.place.normal[i]
        across = frames.cross(normal, a)
        u = build.arms.driving[i, 0]
        psi = math.radians(half_turn(math.atan2(float(u @ normal), float(u @ across)) / deg))
        size = build.sizes.joints[i]
        middle = build.centre(i) - 1.1 * build.reach(i, driving=True) * a
        radius = 1.7 * size.radius
        text = _marked("ψ", i + 1, psi)
        paper.line("yokes", np.stack((middle, middle + 1.2 * radius * across)), "muted", dashed=True)
        paper.sector("yokes", middle, across, normal, psi, radius, "accent", text)


def _dimensions(paper: _Paper, size: float) -> None:
    """Draw the lengths between joint centres below the shafts, and what joints lie apart sideways and in height."""
    build = paper.build
    gravity = np.asarray(build.drive.settings.gravity)
    off = 3.2 * max(one.radius for one in build.sizes.joints)
    for k in range(2, build.count + 1):
        start, stop = _ends(build, k)
        down = -floor_frame(build.axis(k), gravity)[2]
        _measure(paper, start, stop, off * down, _length(float(np.linalg.norm(stop - start)), 4))
    first, last = build.centre(0), build.centre(build.count - 1)
    apart = last - first
    for axis, name in ((2, "Δz"), (1, "Δy")):
        if build.count > 1 and abs(float(apart[axis])) > 0.004 * size:
            corner = last.copy()
            corner[axis] = first[axis]
            side = np.zeros(3)
            side[0] = 1.3 * off * (1.0 if apart[0] >= 0.0 else -1.0)
            _measure(paper, corner, last, side, f"{name} {_length(float(apart[axis]), 3)}")


def _length(length: float, digits: int) -> str:
    return Quantity(length, "length", digits).told(reader())


def _angle(value: float) -> str:
    return Quantity(value, "angle", decimals=1).told(reader())


def _marked(letter: str, number: int, value: float) -> str:
    """Return an angle behind its letter: γ₂ = 30.0°."""
    return f"{letter}{_lowered(number)} = {_angle(value)}"


def _measure(paper: _Paper, start: Array, stop: Array, off: Array, text: str) -> None:
    """Draw a dimension line beside two points, with its two extension lines, its arrowheads and its figure."""
    one, two = start + off, stop + off
    way = stop - start
    length = float(np.linalg.norm(way))
    if length <= 0.0:
        return
    side = off / float(np.linalg.norm(off))
    along = way / length
    head = min(0.12 * float(np.linalg.norm(off)), 0.2 * length)
    for foot, end in ((start, one), (stop, two)):
        paper.line("dimensions", np.stack((foot, end + 0.08 * off)), "muted")
    paper.line("dimensions", np.stack((one, two)), "ink")
    for end, sense in ((one, 1.0), (two, -1.0)):
        back = end + sense * head * along
        paper.line("dimensions", np.stack((back + 0.3 * head * side, end, back - 0.3 * head * side)), "ink")
    paper.label("dimensions", text, 0.5 * (one + two) + 0.12 * off, "dimension")


def _names(paper: _Paper) -> None:
    build = paper.build
    gravity = np.asarray(build.drive.settings.gravity)
    for i, joint in enumerate(build.drive.joints):
        up = floor_frame(build.axis(i + 1), gravity)[2]
        text = joint.name or _("joint {number}").format(number=i + 1)
        paper.label("names", text, build.centre(i) + 2.1 * build.sizes.joints[i].radius * up, "joint")
    for k, shaft in enumerate(build.drive.shafts, start=1):
        start, stop = _ends(build, k)
        up = floor_frame(build.axis(k), gravity)[2]
        share = 0.3 if k == 1 else 0.7 if k > build.count else 0.5
        text = shaft.name or _("shaft {number}").format(number=k)
        at = start + share * (stop - start) + (1.25 * build.body_radius(k) + 0.5 * build.sizes.usual) * up
        paper.label("names", text, at, f"shaft {k}")


def _lowered(number: int) -> str:
    """Return a number as an index."""
    return "".join("₀₁₂₃₄₅₆₇₈₉"[int(digit)] for digit in str(number))
