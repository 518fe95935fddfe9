"""Joints with crosses: Hooke's, the one whose cross axes do not meet, and two of them close together."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from cardan.drive.joints import DoubleCardan, OffsetCross
from cardan.drive.joints.laws import double_cardan
from cardan.drive.shapes.support import bearing, bracket, floor_frame
from cardan.drive.shapes.yoke import caps, cross_body, fork
from cardan.maths.kernel import frames
from cardan.maths.kernel.meshes import ball, placed, revolved
from cardan.texts import _

from .build import BACK, Build, cross_text, forks, length_text, name_of
from .sizes import JointSize


def hooke(build: Build, i: int) -> None:
    """Add yokes, cross and bearings of a Hooke joint."""
    size, joint = build.sizes.joints[i], build.drive.joints[i]
    forks(build, i, size, driving=True)
    forks(build, i, size, driving=False)
    u, v = build.arms.driving[i], build.arms.driven[i]
    track = build.track(build.centre(i), u, v, frames.cross(u, v))
    made = cross_body(size.radius, size.ear, size.journal)
    build.add("cross", i + 1, f"joints[{i}]", cross_text(joint, i, size), track, made, role="cross")


def offset_cross(build: Build, i: int) -> None:
    """Add a joint whose cross axes stand apart, and the sliding ball that holds its driven shaft."""
    size, joint = build.sizes.joints[i], build.drive.joints[i]
    assert isinstance(joint, OffsetCross)
    forks(build, i, size, driving=True)
    forks(build, i, size, driving=False)
    u, v = build.arms.driving[i], build.arms.driven[i]
    track = build.track(build.centre(i), u, v, frames.cross(u, v))
    text = _("cross of {joint}: its pins stand {offset} mm apart").format(
        joint=name_of(joint, i), offset=length_text(joint.offset)
    )
    made = cross_body(size.radius, size.ear, size.journal, joint.offset)
    build.add("cross", i + 1, f"joints[{i}]", text, track, made, role="cross")
    axis = build.axis(i + 2)
    there = build.centre(i) + joint.reach * axis
    frame = floor_frame(axis, np.asarray(build.drive.settings.gravity))
    radius = build.body_radius(i + 2)
    said = _("sliding ball that holds shaft {number}").format(number=i + 2)
    for part, shape in (("ball", ball(1.5 * radius, 24, -0.8, 0.8)), ("support", bearing(1.2 * radius, wide=False))):
        build.add(part, i + 1, f"joints[{i}].reach", said, 0, placed(shape, frame, there), role="cross", shade=0.2)
    foot = bracket(1.2 * radius, soft=False, wide=False, axial=False)
    build.add("support", i + 1, f"joints[{i}].reach", said, 0, placed(foot, frame, there), role="muted")


def offset_shaft(build: Build, i: int) -> int:
    """Add the track of the shaft behind a joint whose cross axes stand apart: it wobbles about the sliding ball."""
    joint = build.drive.joints[i]
    assert isinstance(joint, OffsetCross)
    u, v = build.arms.driving[i], build.arms.driven[i]
    pin = build.centre(i) + joint.offset * frames.cross(u, v)
    held = build.centre(i) + joint.reach * build.axis(i + 2)
    return build.along(pin, frames.unit(held - pin), v)


def double_joint(build: Build, i: int) -> None:
    """Add two crosses, the piece between them and what centres it."""
    joint, whole = build.drive.joints[i], build.sizes.joints[i]
    assert isinstance(joint, DoubleCardan)
    apart = build.apart[i]
    size = replace(whole, cavity=min(whole.cavity, 0.72 * apart))
    before, behind = _spread(joint, float(build.place.bend[i]), 2.0 * apart)
    a, b = build.axis(i + 1), build.axis(i + 2)
    one, two = build.centre(i) - before * a, build.centre(i) + behind * b
    between = frames.unit(two - one)
    u, path = build.arms.driving[i], f"joints[{i}]"
    inner = frames.unit(frames.cross(np.broadcast_to(between, u.shape), u))
    outer = frames.unit(frames.cross(np.broadcast_to(b, u.shape), inner))
    forks(build, i, size, driving=True, away=before)
    forks(build, i, size, driving=False, away=behind)
    half = 0.5 * float(np.linalg.norm(two - one))
    track = build.along(0.5 * (one + two), between, inner)
    made = fork(size.radius, size.ear, size.lug, size.cap, min(size.cavity, 0.75 * half), half, 0.75 * size.radius)
    bearings = caps(size.radius, size.ear, size.cap)
    text = _("middle piece of {joint}").format(joint=name_of(joint, i))
    ways = ((None, (-half, 0.0, 0.0)), (BACK, (half, 0.0, 0.0)))
    build.add("middle yoke", i + 1, path, text, track, *(placed(made, *way) for way in ways), role="cross", shade=0.15)
    said = _("bearings of joint {number}").format(number=i + 1)
    caps_ = (placed(bearings, *way) for way in ways)
    build.add("bearing cap", i + 1, path, said, track, *caps_, role="cross", shade=0.35)
    shape = cross_body(size.radius, size.ear, size.journal)
    for at, first, second in ((one, u, inner), (two, inner, outer)):
        own = build.track(at, first, second, frames.cross(first, second))
        build.add("cross", i + 1, path, cross_text(joint, i, size), own, shape, role="cross")
    _centring(build, i, size, before, behind)


def _spread(joint: DoubleCardan, bend: float, apart: float) -> tuple[float, float]:
    """Return how far both crosses stand from where the shafts meet [m]; ``apart`` is their distance."""
    if joint.centring_ratio is None:
        half = 0.5 * apart / math.cos(0.5 * bend)
        return half, half
    fixed = joint.centring_ratio * apart
    free = float(double_cardan.slide(bend, joint.centring_ratio)) * apart
    return (fixed, free) if joint.ball_on == "driving" else (free, fixed)


def _centring(build: Build, i: int, size: JointSize, before: float, behind: float) -> None:
    """Add the ball on its stem, from the hub of its yoke to where the shafts meet."""
    joint = build.drive.joints[i]
    assert isinstance(joint, DoubleCardan)
    driving = joint.ball_on == "driving"
    track = build.ends[i + 1] if driving else build.starts[i + 2]
    stem, head = 0.2 * size.radius, 0.34 * size.radius
    far = (before if driving else behind) + size.cavity
    rod = revolved([(0.0, 0.0), (0.0, stem), (far, stem), (far, 0.0)], 14)
    turn = BACK if driving else None
    text = _("ball that centres {joint}").format(joint=name_of(joint, i))
    build.add(
        "centring", i + 1, f"joints[{i}]", text, track, placed(rod, turn), ball(head, 18), role="cross", shade=0.45
    )
