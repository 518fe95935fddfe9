"""From one form of geometry to another: joint centres, bends, slopes."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from cardan.drive.described import Form
from cardan.drive.drive import Drive
from cardan.drive.fields.paths import place
from cardan.drive.joints.joint import Point
from cardan.drive.movement import Movement
from cardan.errors import Problem, check
from cardan.maths.arrays import Array
from cardan.maths.kernel.frames import angle_about
from cardan.texts import _

from .geometry import STRAIGHT, Geometry, geometry

UNTURNED = 1e-12
"""A shaft whose direction differs by less runs along x."""

STEEP = 1.57
"""A shaft that rises or turns aside by more [rad] has no slope that a file could give."""

GEOMETRY = ("centre", "joint_angle", "plane_twist", "move_within", "point", "length", "side_slope", "plan_slope")
"""Fields that belong to a form of the geometry."""


def in_form(drive: Drive, form: Form) -> Drive:
    """Return the same drive with its geometry in another form; its motion does not change.

    form: the form wanted. Angles put joint 1 at the origin and shaft 1 along x, which turns the drive as a whole,
    gravity with it; slopes put joint 1 at the origin. Movements are carried along where the drive is shifted but not
    turned.
    Returns Drive: where joint 1 is straight, its plane is a matter of the form, and the start phase is measured from
    the new one.
    """
    if form == drive.form:
        return drive
    here = geometry(drive)
    turned = form == "angles" and bool(np.any(np.abs(here.axis[0] - np.asarray([1.0, 0.0, 0.0])) > UNTURNED))
    check(_tied_to_form(drive, form, turned=turned))
    if form == "points":
        return _phased(_to_points(drive, here), here)
    other = _to_angles(drive, here) if form == "angles" else _phased(_to_slopes(drive, here), here)
    other = _with_vectors(other, here) if turned else other
    return replace(other, movements=tuple(_shifted(one, here.points[1]) for one in drive.movements))


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
    if not heavy and not any(j.cross and j.cross.mass for j in other.joints):
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
            for shaft, length in zip(drive.shafts, _lengths(drive, place), strict=True)
        ),
    )


def _first_twist(place: Geometry) -> float:
    """Return the turn of the whole drive about shaft 1, from joint 1 bending downwards (N_1 to the left, level)."""
    axis = place.axis[0]
    left = np.asarray([-axis[1], axis[0], 0.0])
    size = float(np.linalg.norm(left))
    level = left / size if size > 1e-9 else np.asarray([0.0, 1.0, 0.0])
    return float(angle_about(axis, level, place.normal[0]))


def _to_slopes(drive: Drive, place: Geometry) -> Drive:
    check(
        Problem(
            f"shafts[{k}]",
            _("shaft {number} does not run along +x, so it has no side and plan slope").format(number=k + 1),
        )
        for k, axis in enumerate(place.axis)
        if max(abs(math.atan2(axis[1], axis[0])), abs(math.atan2(axis[2], axis[0]))) >= STEEP
    )
    return replace(
        drive,
        input=replace(drive.input, point=None),
        output=replace(drive.output, point=None),
        joints=tuple(replace(joint, centre=None, joint_angle=None, plane_twist=None) for joint in drive.joints),
        shafts=tuple(
            replace(
                shaft,
                length=length,
                side_slope=math.atan2(axis[2], axis[0]),
                plan_slope=math.atan2(axis[1], axis[0]),
            )
            for shaft, axis, length in zip(drive.shafts, place.axis, _lengths(drive, place), strict=True)
        ),
    )


def _lengths(drive: Drive, place: Geometry) -> list[float | None]:
    """Return the lengths the drive says; what a drawing assumes is not written into a file."""
    assumed = {f"shafts[{k}].length" for k in range(len(drive.shafts))} & set(place.assumed)
    return [None if f"shafts[{k}].length" in assumed else float(length) for k, length in enumerate(place.length)]
