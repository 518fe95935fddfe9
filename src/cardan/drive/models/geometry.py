"""From joint centres to bends and plane twists, and back."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import reduce
from itertools import pairwise
from typing import Any, TypeAlias

import numpy as np

from cardan.drive.described import Form
from cardan.drive.drive import Drive
from cardan.drive.fields.paths import place
from cardan.drive.fields.validity import axis_points
from cardan.drive.joints.joint import Point
from cardan.drive.movement import Movement
from cardan.errors import JointAngleLimitError, Problem, check
from cardan.maths.arrays import Array, namespace
from cardan.maths.kernel import frames
from cardan.maths.kernel.frames import angle_about
from cardan.texts import _

STRAIGHT = 1e-12
"""Below this joint angle [rad] a joint counts as straight: its plane is undefined, the plane before it is kept."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Geometry:
    """Where a drive lies in space."""

    points: Array  # (..., n+2, 3) [m]: B_0 … B_{n+1}
    length: Array  # (..., n+1) [m]: distance between neighbouring points
    axis: Array  # (..., n+1, 3): directions a_i of the shafts along the power flow
    normal: Array  # (..., n, 3): normals N_i of the joints' planes
    joint_angle: Array  # (..., n) [rad]: α_i
    plane_twist: Array  # (..., n-1) [rad]: β_2 … β_n in (-π, π]
    assumed: tuple[str, ...] = ()  # paths of what the drive does not say and the drawing assumes


def geometry_from_points(points: Array) -> Geometry:
    """Return bends, planes and lengths of the polyline through points, in batches.

    points (..., n+2, 3) [m]: point of the input axis, joint centres, point of the output axis.
    Raises JointAngleLimitError: two shafts enclose 90 degrees or more; ``where`` is the mask of the joints (..., n).
    Book (87)-(89) without their acos: α_i = atan2(|a_i × a_{i+1}|, a_i·a_{i+1}), β_i = atan2(a_i·(N_{i-1}×N_i),
    N_{i-1}·N_i). A straight joint takes over the normal before it; straight joints at the start take the first one
    defined.
    """
    axis = frames.unit(points[..., 1:, :] - points[..., :-1, :])
    _refuse_right_angles(frames.dot(axis[..., :-1, :], axis[..., 1:, :]))
    return polyline(points)


def polyline(points: Array) -> Geometry:
    """Return what `geometry_from_points` does and refuse nothing: who asks has to look at the joint angles himself.

    points (..., n+2, 3) [m]: point of the input axis, joint centres, point of the output axis.
    """
    xp = namespace(points)
    shaft = points[..., 1:, :] - points[..., :-1, :]
    length = frames.norm(shaft)
    axis = shaft / length[..., None]
    across = frames.cross(axis[..., :-1, :], axis[..., 1:, :])
    sine = frames.norm(across)
    cosine = frames.dot(axis[..., :-1, :], axis[..., 1:, :])
    straight = sine <= STRAIGHT
    joint_angle = xp.where(straight, 0.0 * sine, xp.atan2(sine, cosine))
    safe = xp.where(straight, 1.0 + 0.0 * sine, sine)
    normal = _fill(axis, across / safe[..., None], straight)
    twist = frames.angle_about(axis[..., 1:-1, :], normal[..., :-1, :], normal[..., 1:, :])
    return Geometry(points=points, length=length, axis=axis, normal=normal, joint_angle=joint_angle, plane_twist=twist)


def _refuse_right_angles(cosine: Array) -> None:
    xp = namespace(cosine)
    bad = cosine <= 1e-15
    if not bool(xp.any(bad)):
        return
    n = cosine.shape[-1]
    flat = xp.reshape(bad, (-1, n))
    joints = [i for i in range(n) if bool(xp.any(flat[:, i]))]
    text = _("shafts {one} and {two} enclose 90° or more; a universal joint needs less")
    problems = [Problem("points", text.format(one=i + 1, two=i + 2)) for i in joints]
    raise JointAngleLimitError(problems, where=bad)


def _fill(axis: Array, normal: Array, straight: Array) -> Array:
    """Give straight joints the normal before them, or the first defined one, or any perpendicular."""
    xp = namespace(axis)
    n = normal.shape[-2]
    known: Array = frames.perpendicular(axis[..., 0, :])
    for i in reversed(range(n)):
        known = xp.where(straight[..., i, None], known, normal[..., i, :])
    filled = []
    for i in range(n):
        along = axis[..., i + 1, :]
        kept = frames.unit(known - frames.dot(known, along)[..., None] * along)
        known = xp.where(straight[..., i, None], kept, normal[..., i, :])
        filled.append(known)
    return xp.stack(filled, axis=-2)


def points_from_angles(joint_angle: Array, plane_twist: Array, length: Array, *, first_twist: Array = 0.0) -> Array:
    """Return the points of a drive with given joint angles, joint 1 at the origin, shaft 1 along x.

    joint_angle (..., n) [rad]: α_1 … α_n; plane_twist (..., n-1) [rad]: β_2 … β_n.
    length (..., n+1) [m]: lengths of shafts 1 to n+1.
    first_twist (...) [rad]: turn of the whole drive about shaft 1; at zero joint 1 bends downwards.
    Returns (..., n+2, 3) [m].
    """
    xp = namespace(joint_angle, plane_twist, length)
    zero = 0.0 * joint_angle[..., 0]
    axis = xp.stack((zero + 1.0, zero, zero), axis=-1)
    normal = frames.rotate(xp.stack((zero, zero + 1.0, zero), axis=-1), axis, zero + first_twist)
    points = [-length[..., 0, None] * axis, 0.0 * axis]
    for i in range(joint_angle.shape[-1]):
        if i:
            normal = frames.rotate(normal, axis, plane_twist[..., i - 1])
        axis = frames.rotate(axis, normal, joint_angle[..., i])
        points.append(points[-1] + length[..., i + 1, None] * axis)
    return xp.stack(points, axis=-2)


def geometry(drive: Drive) -> Geometry:
    """Return where a drive lies, whatever form its file gives.

    Lengths that a drive given by angles or slopes does not say are assumed equal to the mean of those it says (one
    metre when it says none); ``assumed`` lists them. They matter for pictures and length compensation only.
    """
    if drive.form == "points":
        return geometry_from_points(np.asarray(axis_points(drive), dtype=float))
    length, assumed = _lengths(drive)
    if drive.form == "slopes":
        side = np.asarray([shaft.side_slope or 0.0 for shaft in drive.shafts])
        plan = np.asarray([shaft.plan_slope or 0.0 for shaft in drive.shafts])
        axis = frames.unit(np.stack((np.ones_like(side), np.tan(plan), np.tan(side)), axis=-1))
        steps = length[:, None] * axis
        points = np.concatenate((-steps[:1], np.zeros((1, 3)), np.cumsum(steps[1:], axis=0)))
        found = geometry_from_points(points)
        return replace(found, assumed=assumed)
    return replace(geometry_from_angles(*given_angles(drive), length), assumed=assumed)


def geometry_from_angles(joint_angle: Array, twist: Array, length: Array) -> Geometry:
    """Return where a drive lies that is given by joint angles and plane twists (n,) [rad] and lengths (n+1,) [m].

    twist: β_1 … β_n, the first that of the plane of joint 1 about shaft 1.
    """
    points = points_from_angles(joint_angle, twist[1:], length, first_twist=twist[0])
    found = geometry_from_points(points)
    normal = _normals(found.axis, twist)
    return replace(found, length=length, normal=normal, joint_angle=joint_angle, plane_twist=twist[1:])


def one_of(place: Geometry, k: int) -> Geometry:
    """Return one of many geometries, counted through all their leading axes."""
    parts = {"points": 2, "length": 1, "axis": 2, "normal": 2, "joint_angle": 1, "plane_twist": 1}
    rows = {name: getattr(place, name) for name in parts}
    many = math.prod(place.points.shape[:-2])
    return Geometry(**{name: np.reshape(row, (many, *row.shape[-parts[name] :]))[k] for name, row in rows.items()})


def given_angles(drive: Drive) -> tuple[Array, Array]:
    """Return bends and plane twists (n,) of a drive that is given by them [rad]."""
    joint_angle = np.asarray([joint.joint_angle for joint in drive.joints], dtype=float)
    return joint_angle, np.asarray([joint.plane_twist or 0.0 for joint in drive.joints])


def _normals(axis: Array, twist: Array) -> Array:
    """Return the normals of a drive given by angles: defined by the twists even where a joint is straight."""
    normal = frames.rotate(np.asarray([0.0, 1.0, 0.0]), axis[0], twist[0])
    normals = [normal]
    for along, angle in zip(axis[1:-1], twist[1:], strict=True):
        normal = frames.rotate(normal, along, angle)
        normals.append(normal)
    return np.stack(normals)


def _lengths(drive: Drive) -> tuple[Array, tuple[str, ...]]:
    said = [shaft.length for shaft in drive.shafts if shaft.length is not None]
    usual = sum(said) / len(said) if said else 1.0
    length = np.asarray([usual if shaft.length is None else shaft.length for shaft in drive.shafts])
    assumed = tuple(f"shafts[{k}].length" for k, shaft in enumerate(drive.shafts) if shaft.length is None)
    return length, assumed


__all__ = ["Geometry", "geometry", "geometry_from_points", "given_angles", "points_from_angles", "polyline"]


# Joint angles and plane twists of polylines of which few coordinates vary: by coordinate, not drive by drive.
#
# What is the same in all of them is a number, not an array, and costs nothing.

Number: TypeAlias = "Array | float"  # the same in all drives, or an array (n,)

Vector: TypeAlias = tuple[Number, Number, Number]


@dataclass(frozen=True, eq=False, kw_only=True)
class Columns:
    """Many polylines, a number or an array (n,) for each joint or shaft."""

    joint_angle: tuple[Number, ...]  # α_1 … α_n [rad]
    plane_twist: tuple[Number, ...]  # β_2 … β_n [rad]
    length: tuple[Number, ...]  # of shafts 1 to n+1 [m]


def columns(points: Sequence[Vector], count: int) -> Columns:
    """Return bends, plane twists and lengths of polylines, as `cardan.drive.models.geometry.polyline` does.

    points, sequence of n+2 triples of float or array (count,) [m]: point of the input axis, joint centres, point of the
    output axis.
    Drives with a straight joint, whose plane is that of a neighbour, go through `polyline` itself, each by itself, so
    that what comes out for a drive does not depend on those beside it.
    """
    with np.errstate(all="ignore"):  # points that coincide have no direction, straight joints no plane
        return _columns(points, count)


def _columns(points: Sequence[Vector], count: int) -> Columns:
    steps = [_minus(b, a) for a, b in pairwise(points)]
    length = [_norm(step) for step in steps]
    axis = [_over(step, size) for step, size in zip(steps, length, strict=True)]
    across = [_cross(a, b) for a, b in pairwise(axis)]
    sine = [_norm(one) for one in across]
    cosine = [_dot(a, b) for a, b in pairwise(axis)]
    joint_angle: list[Number] = [np.arctan2(s, c) for s, c in zip(sine, cosine, strict=True)]
    normal = [_over(one, size) for one, size in zip(across, sine, strict=True)]
    twist: list[Number] = [
        np.arctan2(_dot(along, _cross(a, b)), _dot(a, b))
        for along, (a, b) in zip(axis[1:-1], pairwise(normal), strict=True)
    ]
    straight = reduce(np.logical_or, (one <= STRAIGHT for one in sine))
    rows = np.flatnonzero(np.broadcast_to(straight, (count,)))
    if rows.size:
        whole = np.stack([_rows(value, rows) for point in points for value in point], axis=-1)
        exact = polyline(whole.reshape(rows.size, len(points), 3))
        joint_angle = [_put(one, rows, exact.joint_angle[:, k], count) for k, one in enumerate(joint_angle)]
        twist = [_put(one, rows, exact.plane_twist[:, k], count) for k, one in enumerate(twist)]
    return Columns(joint_angle=tuple(joint_angle), plane_twist=tuple(twist), length=tuple(length))


def table(values: Sequence[Number], count: int) -> Array:
    """Return numbers and arrays (count,) as the columns of one array (count, k)."""
    found = np.empty((count, len(values)))
    for k, one in enumerate(values):
        found[:, k] = one
    return found


def _rows(value: Number, rows: Array) -> Array:
    return np.asarray(value)[rows] if np.ndim(value) else np.full(rows.size, value)


def _put(values: Number, rows: Array, exact: Array, count: int) -> Array:
    found = np.array(np.broadcast_to(values, (count,)))
    found[rows] = exact
    return found


def _minus(a: Vector, b: Vector) -> Vector:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def _dot(a: Vector, b: Vector) -> Any:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: Vector, b: Vector) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def _norm(a: Vector) -> Any:
    return np.sqrt(_dot(a, a))


def _over(a: Vector, size: Number) -> Vector:
    share = np.divide(1.0, size)
    return a[0] * share, a[1] * share, a[2] * share


# From one form of geometry to another: joint centres, bends, slopes.

UNTURNED = 1e-12  # a shaft whose direction differs by less runs along x
LEVEL = 1e-3  # share of a direction in the ground plan below which it counts as upright
STEEP = 1.57  # a shaft that rises or turns aside by more [rad] has no slope that a file could give

GEOMETRY = ("centre", "joint_angle", "plane_twist", "move_within", "point", "length", "side_slope", "plan_slope")
"""Fields that belong to a form of the geometry."""


def in_form(drive: Drive, form: Form) -> Drive:
    """Return the same drive with its geometry in another form; its motion does not change.

    form: the form wanted. Angles put joint 1 at the origin and shaft 1 along x, which turns the drive as a whole,
    gravity with it; slopes put joint 1 at the origin, and where shafts do not run along +x they turn the drive as a
    whole, about the upright where that will do. Movements are carried along where the drive is shifted but not turned.
    Returns Drive: where joint 1 is straight, its plane is a matter of the form, and the start phase is measured from
    the new one.
    """
    if form == drive.form:
        return drive
    here = geometry(drive)
    ahead = _ahead(here) if form == "slopes" else here
    turned = form == "angles" and bool(np.any(np.abs(here.axis[0] - np.asarray([1.0, 0.0, 0.0])) > UNTURNED))
    turned |= ahead is not here
    check(_tied_to_form(drive, form, turned=turned))
    if form == "points":
        return _phased(_to_points(drive, here), here)
    other = _to_angles(drive, here) if form == "angles" else _phased(_to_slopes(drive, ahead), ahead)
    other = _with_vectors(other, here) if turned else other
    return replace(other, movements=tuple(_shifted(one, here.points[1]) for one in drive.movements))


def movable(drive: Drive) -> dict[str, tuple[Point, bool]]:
    """Return ends and joint centres of a drive by their paths [m], each with whether `with_point` can put it elsewhere.

    A form without coordinates keeps the input shaft and joint 1 where they are. None where it does not say the lengths
    of the shafts between joints.
    """
    here = geometry(drive)
    if any(f"shafts[{k}].length" in here.assumed for k in range(1, len(drive.joints))):
        return {}
    paths = ["input", *(f"joints[{k}]" for k in range(len(drive.joints))), "output"]
    points = zip(paths, here.points.tolist(), strict=True)
    return {path: ((x, y, z), drive.form == "points" or k > 1) for k, (path, (x, y, z)) in enumerate(points)}


def with_point(drive: Drive, path: str, point: Point) -> Drive:
    """Return a drive with one of its `movable` points elsewhere [m], in its own form; the others stay where they are.

    Lengths of the outer shafts that the drive does not give stay so.
    """
    moved = _to_points(drive, geometry(drive)) if drive.form != "points" else drive
    if path in ("input", "output"):
        moved = replace(moved, **{path: replace(getattr(moved, path), point=point)})
    else:
        joints = (replace(one, centre=point) if f"joints[{k}]" == path else one for k, one in enumerate(moved.joints))
        moved = replace(moved, joints=tuple(joints))
    if drive.form == "points":
        return moved
    made = (_to_angles if drive.form == "angles" else _to_slopes)(moved, geometry(moved))
    pairs = zip(drive.shafts, made.shafts, strict=True)
    shafts = (new if old.length is not None else replace(new, length=None) for old, new in pairs)
    return replace(made, shafts=tuple(shafts))


def _with_vectors(other: Drive, old: Geometry) -> Drive:
    """Return a drive that was turned as a whole with gravity and the offsets of its supports turned alike."""
    now = geometry(other)
    ours, theirs = (
        np.stack((place.axis[0], place.normal[0], np.cross(place.axis[0], place.normal[0]))) for place in (now, old)
    )
    turn = ours.T @ theirs

    def turned(vector: Point) -> Point:
        x, y, z = (float(c) for c in turn @ np.asarray(vector))
        return x, y, z

    supports = tuple(replace(s, offset=turned(s.offset)) if any(s.offset) else s for s in other.supports)
    heavy = any(s.mass or s.has_body or s.masses for s in other.shafts)
    if not heavy and not any((j.cross and j.cross.mass) or j.estimable for j in other.joints):
        return replace(other, supports=supports)
    return replace(other, supports=supports, settings=replace(other.settings, gravity=turned(other.settings.gravity)))


def _tied_to_form(drive: Drive, form: Form, *, turned: bool) -> list[Problem]:
    """Return what the other form cannot express."""
    tied = [(f"joints[{i}].move_within", joint.move_within is not None) for i, joint in enumerate(drive.joints)]
    tied += [("movements", turned and bool(drive.movements))]
    bare = replace(drive, poses=())
    for k, pose in enumerate(drive.poses):
        tied += [(f"poses[{k}].set", any(place(bare, path).field.name in GEOMETRY for path, _item in pose.set))]
    message = _("stands in the coordinates of the present form and would lose its meaning by {form}")
    return [Problem(path, message.format(form=form)) for path, there in tied if there]


def _shifted(movement: Movement, origin: Array) -> Movement:
    """Return a movement in coordinates whose origin is a point of the present ones."""
    pivot = getattr(movement, "pivot", None)
    if pivot is None:
        return movement
    return replace(movement, pivot=tuple(float(x - x0) for x, x0 in zip(pivot, origin, strict=True)))  # type: ignore[call-arg]


def _phased(other: Drive, old: Geometry) -> Drive:
    """Return the drive with its start phase from the new plane of a straight first joint."""
    if old.joint_angle[0] > STRAIGHT:
        return other
    shift = float(angle_about(old.axis[0], geometry(other).normal[0], old.normal[0]))
    return replace(other, input=replace(other.input, start_phase=other.input.start_phase + shift))


def _to_points(drive: Drive, place: Geometry) -> Drive:
    points: list[Point] = [(float(p[0]), float(p[1]), float(p[2])) for p in place.points]
    return replace(
        drive,
        input=replace(drive.input, point=points[0]),
        output=replace(drive.output, point=points[-1]),
        joints=tuple(
            replace(joint, centre=point, joint_angle=None, plane_twist=None)
            for joint, point in zip(drive.joints, points[1:-1], strict=True)
        ),
        shafts=tuple(replace(s, length=None, side_slope=None, plan_slope=None) for s in drive.shafts),
    )


def _to_angles(drive: Drive, place: Geometry) -> Drive:
    first = _first_twist(place)
    twists = [first, *(float(t) for t in place.plane_twist)]
    return replace(
        drive,
        input=replace(drive.input, point=None),
        output=replace(drive.output, point=None),
        joints=tuple(
            replace(joint, centre=None, joint_angle=float(joint_angle), plane_twist=twist)
            for joint, joint_angle, twist in zip(drive.joints, place.joint_angle, twists, strict=True)
        ),
        shafts=tuple(
            replace(shaft, length=length, side_slope=None, plan_slope=None)
            for shaft, length in zip(drive.shafts, _shaft_lengths(drive, place), strict=True)
        ),
    )


def _first_twist(place: Geometry) -> float:
    """Return the turn of the whole drive about shaft 1, from joint 1 bending downwards (N_1 to the left, level)."""
    axis = place.axis[0]
    left = np.asarray([-axis[1], axis[0], 0.0])
    size = float(np.linalg.norm(left))
    level = left / size if size > 1e-9 else np.asarray([0.0, 1.0, 0.0])
    return float(angle_about(axis, level, place.normal[0]))


def _ahead(place: Geometry) -> Geometry:
    """Return where a drive lies once its shafts run along +x, about the upright if they are not upright themselves."""
    if not np.any(_steep(place.axis)):
        return place
    along = np.sum(place.axis, axis=0)
    x, y, z = along / np.linalg.norm(along)
    flat = math.hypot(x, y)
    level = math.atan2(y, x) if flat > LEVEL else 0.0
    turn = np.asarray(
        [[math.cos(level), math.sin(level), 0.0], [-math.sin(level), math.cos(level), 0.0], [0.0, 0.0, 1.0]]
    )
    if np.any(_steep(place.axis @ turn.T)):
        rise = math.atan2(z, flat if flat > LEVEL else x)
        down = np.asarray(
            [[math.cos(rise), 0.0, math.sin(rise)], [0.0, 1.0, 0.0], [-math.sin(rise), 0.0, math.cos(rise)]]
        )
        turn = down @ turn
    return replace(place, points=place.points @ turn.T, axis=place.axis @ turn.T, normal=place.normal @ turn.T)


def _steep(axis: Array) -> Array:
    """Return which shafts have no slopes, array of bool (n+1)."""
    side, plan = np.arctan2(axis[:, 2], axis[:, 0]), np.arctan2(axis[:, 1], axis[:, 0])
    return np.maximum(np.abs(side), np.abs(plan)) >= STEEP


def _to_slopes(drive: Drive, place: Geometry) -> Drive:
    check(
        Problem(
            f"shafts[{k}]",
            _("shaft {number} runs across or against the others, so it has no side and plan slope along +x").format(
                number=k + 1
            ),
        )
        for k in np.flatnonzero(_steep(place.axis)).tolist()
    )
    return replace(
        drive,
        input=replace(drive.input, point=None),
        output=replace(drive.output, point=None),
        joints=tuple(replace(joint, centre=None, joint_angle=None, plane_twist=None) for joint in drive.joints),
        shafts=tuple(
            replace(
                shaft, length=length, side_slope=math.atan2(axis[2], axis[0]), plan_slope=math.atan2(axis[1], axis[0])
            )
            for shaft, axis, length in zip(drive.shafts, place.axis, _shaft_lengths(drive, place), strict=True)
        ),
    )


def _shaft_lengths(drive: Drive, place: Geometry) -> list[float | None]:
    """Return the lengths the drive says; what a drawing assumes is not written into a file."""
    assumed = {f"shafts[{k}].length" for k in range(len(drive.shafts))} & set(place.assumed)
    return [None if f"shafts[{k}].length" in assumed else float(length) for k, length in enumerate(place.length)]
