"""Yokes, crosses and tubes as simple bodies: what a drive looks like, at any input angle.

They are as large as those that turn in space, see `sizes`, and simpler, so that many of them can be printed.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.joints import Joint
from cardan.drive.models.geometry import Geometry, geometry
from cardan.drive.models.kinematics_model import Chain, given_chain
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.kernel import frames

from .sizes import ROOM, sizes

Part: TypeAlias = Literal["driving yoke", "driven yoke", "cross", "tube"]

SIDES = 10  # faces around a tube


@dataclass(frozen=True, eq=False, kw_only=True)
class Arms:
    """Where the yokes stand, at one input angle or many (...)."""

    # (n, ..., 3): u_i, direction of the cross arm that the driving yoke of joint i holds; the yoke is part of shaft i
    driving: Array
    # (n, ..., 3): v_{i+1}, direction of the cross arm that the driven yoke of joint i holds; the yoke is part of shaft
    # i+1. Joints without a cross have marks instead.
    driven: Array


def arms(place: Geometry, train: Chain, angle: ArrayLike = 0.0, joints: Sequence[Joint] = ()) -> Arms:
    """Return the directions of all cross arms.

    place: where the drive lies; train: its yoke angles and start phase.
    angle (...) [rad]: input angle φ_1 from the start position.
    joints: their kinds; Hooke joints when empty.
    Returns Arms: driving, driven (n, ..., 3).

    Positions alone, by plain vectors: u_1 stands φ_1 + ψ_1 from N_1 × a_1, v_{i+1} = unit(a_{i+1} × u_i), and u_i is
    v_i turned by -γ_i about a_i. No planes are needed, so straight joints are nothing special. Joints of another kind
    turn by their own law, counted from their plane.
    """
    axis = place.axis
    first = frames.cross(place.normal[0], axis[0])
    start = np.asarray(angle, dtype=float) + train.start_phase
    driving, driven = [frames.rotate(first, axis[0], start)], []
    for i in range(train.joints):
        if joints and not joints[i].single_cross:
            driven.append(_driven_mark(joints[i], place, i, driving[-1], np.asarray(train.joint_angle)[i]))
        else:
            driven.append(frames.unit(frames.cross(axis[i + 1], driving[-1])))
        if i + 1 < train.joints:
            driving.append(frames.rotate(driven[-1], axis[i + 1], -train.yoke_angle[i]))
    return Arms(driving=np.stack(driving), driven=np.stack(driven))


def _driven_mark(joint: Joint, place: Geometry, i: int, driving: Array, joint_angle: Array) -> Array:
    """Return the direction of the driven mark of a joint that turns by a law of its own, array (..., 3)."""
    normal, before, after = place.normal[i], place.axis[i], place.axis[i + 1]
    across = frames.cross(normal, before)
    theta = np.arctan2(frames.dot(driving, normal), frames.dot(driving, across))
    turned = theta + joint.deviation(theta, joint_angle)[0] + (0.5 * np.pi if joint.crossed else 0.0)
    plane = frames.cross(normal, after)
    found: Array = np.cos(turned)[..., None] * plane + np.sin(turned)[..., None] * normal
    return found


@dataclass(frozen=True, eq=False, kw_only=True)
class Body:
    """One solid, its surface as flat faces with outward normals by the right-hand rule."""

    part: Part
    number: int  # number of the shaft it belongs to; of the joint for a cross
    corners: Array  # (m, 3) [m]
    faces: tuple[tuple[int, ...], ...]  # corners of each face in order; a face may be concave
    triangles: tuple[tuple[int, int, int], ...]  # the same surface as triangles
    smooth: bool = False  # faces stand for a round surface: their edges are not drawn


@dataclass(frozen=True, eq=False, kw_only=True)
class Solids:
    """The bodies of a drive and the sizes they were given."""

    bodies: tuple[Body, ...]  # tubes, yokes and crosses
    centres: Array  # (n, 3) [m]: joint centres
    ends: Array  # (2, 3) [m]: where the drawing cuts the input and the output shaft
    radius: float  # [m]: of the largest joint
    place: Geometry  # where the drive lies
    arms: Arms  # where its yokes stand


def solids(drive: Drive, angle: float = 0.0) -> Solids:
    """Return a drive as bodies in space.

    angle [rad]: input angle φ_1 from the start position.
    Returns Solids: sizes are those of the file, where it gives them, else in proportion, see `sizes`; what is drawn of
    the end shafts shows all that stands on them.
    """
    place, train = geometry(drive), given_chain(drive)
    stand = arms(place, train, angle, drive.joints)
    centres = place.points[1:-1]
    size = sizes(drive, place)
    radius = [one.outer for one in size.joints]
    ends = np.stack((centres[0] - size.ends[0] * place.axis[0], centres[-1] + size.ends[1] * place.axis[-1]))
    stations = np.concatenate((ends[:1], centres, ends[1:]))
    # How far the yokes of each joint reach along their shafts, in yoke radii: as far as there is room on short shafts.
    room = [math.inf, *(ROOM * float(one) for one in place.length[1:-1]), math.inf]
    slim = [[min(_NECK, room[k] / one) / _NECK for k in (i, i + 1)] for i, one in enumerate(radius)]
    bodies: list[Body] = []
    for k, along in enumerate(place.axis):
        start = stations[k] + (_NECK * slim[k - 1][1] * radius[k - 1] * along if k else 0.0)
        end = stations[k + 1] - (_NECK * slim[k][0] * radius[k] * along if k < len(centres) else 0.0)
        bodies.append(_tube(k + 1, start, end, size.bodies[k]))
    for i, (centre, own) in enumerate(zip(centres, radius, strict=True)):
        u, v = stand.driving[i], stand.driven[i]
        before, after = place.axis[i], place.axis[i + 1]
        if not drive.joints[i].crossed:
            bodies += _bells(i, centre, slim[i][0] * before, slim[i][1] * after, own)
            continue
        bodies.append(_yoke("driving yoke", i + 1, centre, -before, u, own, slim[i][0]))
        bodies.append(_yoke("driven yoke", i + 2, centre, after, v, own, slim[i][1]))
        bodies.append(_beam(i + 1, centre, u, frames.unit(frames.cross(v, u)), own))
        bodies.append(_beam(i + 1, centre, v, frames.unit(frames.cross(u, v)), own))
    return Solids(bodies=tuple(bodies), centres=centres, ends=ends, radius=max(radius), place=place, arms=stand)


_NECK = 1.35  # where a yoke ends and its tube begins, in yoke radii from the joint centre


_FORK = (
    *((0.72, -0.34), (1.0, -0.34), (1.0, 0.62), (0.46, 1.36), (-0.46, 1.36), (-1.0, 0.62), (-1.0, -0.34)),
    *((-0.72, -0.34), (-0.72, 0.5), (-0.34, 0.86), (0.34, 0.86), (0.72, 0.5)),
)
"""Outline of a yoke in yoke radii: along its arm, and outward from the joint centre."""


def _yoke(part: Part, shaft: int, centre: Array, outward: Array, arm: Array, radius: float, slim: float) -> Body:
    """Return a fork: two ears at the ends of the arm, joined behind the joint.

    outward (3,): from the joint centre into the yoke's own shaft; arm (3,): direction of the cross arm it holds.
    slim: share of its usual length along its shaft.
    """
    half = np.asarray(_FORK) * (1.0, slim)
    across = frames.cross(arm, outward)
    flat = radius * (half[:, :1] * arm + half[:, 1:] * outward)
    thick = 0.3 * radius * across
    corners = centre + np.concatenate((flat + thick, flat - thick))
    count = len(half)
    cap = (
        (0, 1, 2), (0, 2, 11), (2, 3, 11), (3, 10, 11), (3, 4, 10), (4, 9, 10), (4, 5, 9), (5, 8, 9), (5, 6, 8),
        (6, 7, 8),
    )  # fmt: skip
    return _prism(part, shaft, corners, count, cap)


def _bells(joint: int, centre: Array, before: Array, after: Array, radius: float) -> list[Body]:
    """Return a joint without a cross: a bell on the driving shaft and a thinner piece on the driven one."""
    return [
        _tube(
            joint + 1, centre - _NECK * radius * before, centre + 0.35 * radius * before, 0.95 * radius, "driving yoke"
        ),
        _tube(joint + 2, centre - 0.1 * radius * after, centre + _NECK * radius * after, 0.7 * radius, "driven yoke"),
    ]


def _beam(joint: int, centre: Array, arm: Array, across: Array, radius: float) -> Body:
    """Return one arm of a cross, from ear to ear."""
    third = frames.cross(arm, across)
    width = 0.2 * radius
    square = np.asarray([(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)])
    flat = width * (square[:, :1] * across + square[:, 1:] * third)
    corners = centre + np.concatenate((flat + 1.06 * radius * arm, flat - 1.06 * radius * arm))
    return _prism("cross", joint, corners, 4, ((0, 1, 2), (0, 2, 3)))


def _tube(shaft: int, start: Array, end: Array, radius: float, part: Part = "tube") -> Body:
    """Return a round bar; of no length where the yokes of a short shaft meet."""
    along = frames.unit(end - start) if float(np.linalg.norm(end - start)) > 0.0 else np.asarray([1.0, 0.0, 0.0])
    one = frames.perpendicular(along)
    two = frames.cross(along, one)
    turn = 2.0 * np.pi * np.arange(SIDES) / SIDES
    ring = radius * (np.cos(turn)[:, None] * one + np.sin(turn)[:, None] * two)
    cap = tuple((0, k, k + 1) for k in range(1, SIDES - 1))
    return _prism(part, shaft, np.concatenate((end + ring, start + ring)), SIDES, cap, smooth=True)


def _prism(
    part: Part, number: int, corners: Array, count: int, cap: tuple[tuple[int, ...], ...], *, smooth: bool = False
) -> Body:
    """Return a prism between two congruent caps: corners 0 … count-1 of the upper one, then those of the lower one."""
    upper = tuple(range(count))
    lower = tuple(range(2 * count - 1, count - 1, -1))
    walls = tuple((k, count + k, count + (k + 1) % count, (k + 1) % count) for k in range(count))
    rest = tuple((a + count, c + count, b + count) for a, b, c in cap)
    halves = tuple(triangle for a, b, c, d in walls for triangle in ((a, b, c), (a, c, d)))
    return Body(
        part=part,
        number=number,
        corners=corners,
        faces=(upper, lower, *walls),
        triangles=(*cap, *rest, *halves),  # type: ignore[arg-type]
        smooth=smooth,
    )
