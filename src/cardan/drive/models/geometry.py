"""From joint centres to bends and plane twists, and back."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.fields.validity import axis_points
from cardan.errors import JointAngleLimitError, Problem
from cardan.maths.arrays import Array, namespace
from cardan.maths.kernel import frames
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
    raise JointAngleLimitError(
        [
            Problem(
                "points",
                _("shafts {one} and {two} enclose 90° or more; a universal joint needs less").format(
                    one=i + 1, two=i + 2
                ),
            )
            for i in joints
        ],
        where=bad,
    )


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
        return Geometry(**{**vars(found), "assumed": assumed})
    joint_angle, twist = given_angles(drive)
    points = points_from_angles(joint_angle, twist[1:], length, first_twist=twist[0])
    found = geometry_from_points(points)
    normal = _normals(found.axis, twist)
    return Geometry(
        points=points,
        length=length,
        axis=found.axis,
        normal=normal,
        joint_angle=joint_angle,
        plane_twist=twist[1:],
        assumed=assumed,
    )


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
