"""Many drives that differ in places and angles alone, as arrays: the fast way to questions about motion."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from functools import cached_property, reduce
from typing import Any

import numpy as np

from cardan.checks.angles.acceleration import swings, swings_of_laws
from cardan.drive.drive import Drive
from cardan.drive.fields.validity import COINCIDENT, TINY, axis_points
from cardan.drive.models.geometry import Number, Vector, columns, geometry, polyline, table
from cardan.drive.models.kinematics_model import Chain, given_chain, mixed, turning, unlike_hooke
from cardan.errors import InputError, refuse
from cardan.maths.arrays import Array
from cardan.maths.compiled.method import Method
from cardan.questions.motion.equivalence import after_each_joint
from cardan.questions.motion.extremes import Extremes, extremes
from cardan.questions.motion.turning import Evenness, Swing, swing
from cardan.texts import _

RIGHT = 1e-15  # bends nearer to a right angle than this are none: the cosine that the loader refuses


@dataclass(frozen=True, eq=False, kw_only=True)
class OneShaft:
    """How even one shaft turns, arrays (n,), under the names of `Extremes`."""

    speed_fluctuation: Array
    joint_angle: Array
    ratio_min: Array
    ratio_max: Array
    max_angle_error: Array
    max_acceleration: Array


@dataclass(frozen=True, eq=False, kw_only=True)
class Many:
    """Drives in arrays (n,), one of each attribute for all.

    speed, acceleration (n,) [rad/s, rad/s²]: of the input; nan where the drive does not say.
    """

    chain: Chain  # Chain (n, joints): the Hooke joints that turn alike
    joint_angle: Array  # (n, joints) [rad]: bends of the joints themselves
    length: Array | None  # (n, joints + 1) [m]: lengths of the shafts, where the joint centres give them
    speed: Array | float
    method: Method | None = None  # how extremes are computed

    @cached_property
    def output(self) -> Extremes | OneShaft:
        """How even the output turns, axes (n,)."""
        return extremes(self.chain, method=self.method)

    @cached_property
    def each(self) -> Evenness:
        """How even the shafts that joints drive turn, axes (n, joints)."""
        return after_each_joint(self.chain)

    @property
    def lengths(self) -> Array:
        """Lengths of the shafts between two joints, array (n, joints - 1) [m]."""
        if self.length is None:
            raise refuse("joints", _("only drives given by joint centres have lengths here"))
        return self.length[..., 1:-1]

    @cached_property
    def swings(self) -> Array:
        """Largest accelerations over the square of the speed: output, inside shafts in drive and coast (n, 1 or 3)."""
        return swings(self.chain)


@dataclass(frozen=True, eq=False, kw_only=True)
class FollowedDrive(Many):
    """One drive that no chain of Hooke joints turns like, as its motion over a turn shows it; n = 1."""

    seen: Swing

    @property
    def output(self) -> OneShaft:
        """How even the output turns."""
        return OneShaft(**{one.name: getattr(self.seen, one.name)[-1:] for one in fields(OneShaft)})

    @property
    def each(self) -> Evenness:
        """How even the shafts that joints drive turn, arrays (joints,)."""
        return self.seen

    @property
    def swings(self) -> Array:
        """Largest accelerations over the square of the speed (1, k)."""
        return swings_of_laws(self.seen)[None]


def one(drive: Drive) -> Many:
    """Return a single drive, n = 1."""
    if not unlike_hooke(drive):
        return many(drive, {}, 1)[0]
    given = given_chain(drive)
    rows = replace(
        given, **{f: getattr(given, f)[None] for f in ("joint_angle", "plane_twist", "yoke_angle", "start_phase")}
    )
    place = geometry(drive)
    length = place.length[None] if drive.form == "points" else None
    speed = float("nan") if drive.duty.speed is None else drive.duty.speed
    return FollowedDrive(chain=rows, joint_angle=rows.joint_angle, length=length, speed=speed, seen=swing(drive))


def many(
    drive: Drive, varied: Mapping[str, Array], count: int, *, method: Method | None = None, xp: Any = np
) -> tuple[Many, Array]:
    """Return drives that differ in places and angles, and which of them are drives.

    drive: the drive in which values vary; varied, mapping of str to array (count,): path without unit -> values in SI.
    Returns Many: where there is no drive, its arrays hold the drive as it is; real, array of bool (count,): whether
    bends are below 90°, points do not coincide and joints turn at their bends.
    """
    here = {path: xp.asarray(values, dtype=xp.float64) for path, values in varied.items()}

    def spread(path: str, own: float | None) -> Array:
        value = here.get(path)
        return xp.broadcast_to(xp.asarray(own or 0.0, dtype=xp.float64), (count,)) if value is None else value

    def row(paths_and_own: list[tuple[str, float | None]]) -> Array:
        if not paths_and_own:
            return xp.zeros((count, 0), dtype=xp.float64)
        return xp.stack([spread(path, own) for path, own in paths_and_own], axis=-1)

    yokes = row([(f"shafts[{k}].yoke_angle", drive.shafts[k].yoke_angle) for k in range(1, len(drive.joints))])
    start = spread("input.start_phase", drive.input.start_phase)
    joint_angle, twist, length, real = _lie(drive, here, row, count, xp)
    given = Chain(joint_angle=joint_angle, plane_twist=twist, yoke_angle=yokes, start_phase=start)
    chain, real = _turning(drive, given, real, xp)
    speed = spread("duty.speed", float("nan") if drive.duty.speed is None else drive.duty.speed)
    return Many(chain=chain, joint_angle=joint_angle, length=length, speed=speed, method=method), real


def _lie(drive: Drive, here: Mapping[str, Array], row: Any, count: int, xp: Any) -> tuple[Array, Array, Any, Array]:
    """Return bends, plane twists and lengths, and which drives there are."""
    n = len(drive.joints)
    if drive.form == "angles":
        joint_angle = row([(f"joints[{i}].joint_angle", drive.joints[i].joint_angle) for i in range(n)])
        twist = row([(f"joints[{i}].plane_twist", drive.joints[i].plane_twist) for i in range(1, n)])
        real = xp.all((joint_angle >= 0.0) & (joint_angle < 0.5 * xp.pi), axis=-1)
        own = np.asarray([joint.joint_angle for joint in drive.joints])
        return _mended(joint_angle, own, real, xp), twist, None, real
    if xp is np:
        return _lie_in_columns(drive, here, count)
    points, own = _points(drive, row, xp)
    apart = xp.linalg.vector_norm(points[:, 1:, :] - points[:, :-1, :], axis=-1)
    least = xp.maximum(COINCIDENT * xp.max(apart, axis=-1), xp.asarray(TINY))
    real = xp.all(apart > least[:, None], axis=-1)
    points = _mended(points, own, real, xp)
    found = polyline(points)
    real = real & xp.all(found.joint_angle < 0.5 * xp.pi - RIGHT, axis=-1)
    base = polyline(np.asarray(own))
    joint_angle = _mended(found.joint_angle, base.joint_angle, real, xp)
    twist = _mended(found.plane_twist, base.plane_twist, real, xp)
    return joint_angle, twist, found.length if drive.form == "points" else None, real


def _lie_in_columns(drive: Drive, here: Mapping[str, Array], count: int) -> tuple[Array, Array, Any, Array]:
    """Return the same by NumPy, coordinate by coordinate."""
    found = columns(_vectors(drive, here), count)
    most = reduce(np.maximum, found.length)
    least = np.maximum(COINCIDENT * most, TINY)
    fits = [one > least for one in found.length] + [one < 0.5 * np.pi - RIGHT for one in found.joint_angle]
    real = np.array(np.broadcast_to(reduce(np.logical_and, fits), (count,)))
    base = geometry(drive)
    joint_angle = _mended(table(found.joint_angle, count), base.joint_angle, real, np)
    twist = _mended(table(found.plane_twist, count), base.plane_twist, real, np)
    return joint_angle, twist, table(found.length, count) if drive.form == "points" else None, real


def _vectors(drive: Drive, here: Mapping[str, Array]) -> list[Vector]:
    """Return the points of the axes, an array where a coordinate varies and a number where it does not."""
    n = len(drive.joints)

    def value(path: str, own: float) -> Number:
        return here.get(path, own)

    if drive.form == "points":
        names = ["input.point", *(f"joints[{i}].centre" for i in range(n)), "output.point"]
        own = axis_points(drive)
        return [
            (value(f"{name}[0]", point[0]), value(f"{name}[1]", point[1]), value(f"{name}[2]", point[2]))
            for name, point in zip(names, own, strict=True)
        ]
    found: list[Vector] = [(0.0, 0.0, 0.0)]
    for k, shaft in enumerate(drive.shafts):
        slopes = [
            np.tan(value(f"shafts[{k}].{name}", getattr(shaft, name) or 0.0)) for name in ("plan_slope", "side_slope")
        ]
        x, y, z = found[-1]
        found.append((x + 1.0, y + slopes[0], z + slopes[1]))
    return found


def _mended(values: Array, own: Array, real: Array, xp: Any) -> Array:
    """Return values (count, ...) with those of the drive as it is where there is no drive."""
    if xp is np and bool(real.all()):
        return values
    return xp.where(xp.reshape(real, (-1, *(1 for _axis in values.shape[1:]))), values, xp.asarray(own))


def _points(drive: Drive, row: Any, xp: Any) -> tuple[Array, Array]:
    """Return points of the axes (count, n+2, 3), and those of the drive as it is (n+2, 3)."""
    n = len(drive.joints)
    if drive.form == "points":
        named = [
            ("input.point", drive.input.point),
            *((f"joints[{i}].centre", drive.joints[i].centre) for i in range(n)),
            ("output.point", drive.output.point),
        ]
        own = [[float(x) for x in point] for _path, point in named if point is not None]
        columns = [
            (f"{path}[{k}]", point[k]) for (path, _point), point in zip(named, own, strict=True) for k in range(3)
        ]
        whole = row(columns)
        return xp.reshape(whole, (whole.shape[0], n + 2, 3)), np.asarray(own)
    slopes = {
        name: row([(f"shafts[{k}].{name}", getattr(drive.shafts[k], name)) for k in range(n + 1)])
        for name in ("plan_slope", "side_slope")
    }
    steps = xp.stack(
        (xp.ones_like(slopes["plan_slope"]), xp.tan(slopes["plan_slope"]), xp.tan(slopes["side_slope"])), axis=-1
    )
    after = xp.cumulative_sum(steps, axis=1)
    points = xp.concat((0.0 * after[:, :1, :], after), axis=1)
    own_slopes = [(1.0, np.tan(shaft.plan_slope or 0.0), np.tan(shaft.side_slope or 0.0)) for shaft in drive.shafts]
    return points, np.concatenate((np.zeros((1, 3)), np.cumsum(own_slopes, axis=0)))


def _turning(drive: Drive, given: Chain, real: Array, xp: Any) -> tuple[Chain, Array]:
    """Return the Hooke joints that turn alike, where a joint does not turn those of the drive as it is."""
    if not mixed(drive.joints):
        return given, real
    for _joint in range(len(drive.joints) + 1):
        try:
            return turning(given, drive.joints), real
        except InputError as error:
            if error.where is None:
                raise
            stuck = error.where
            real = real & ~stuck
            given = replace(given, joint_angle=xp.where(stuck[:, None], 0.0 * given.joint_angle, given.joint_angle))
    return turning(given, drive.joints), real
