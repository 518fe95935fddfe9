"""Places and angles of drives that differ in a few of them."""

from __future__ import annotations

import re
from collections.abc import Mapping

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.models.chain import Chain
from cardan.drive.models.geometry import geometry, points_from_angles
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames


def varied_points(
    drive: Drive, replaced: Mapping[str, Array], shape: tuple[int, ...], given: Chain | None = None
) -> Array:
    """Return the points of the axis of a drive, or of many, array (..., n+2, 3) [m].

    replaced, mapping of str to array (...): path without unit -> values of places and angles that vary.
    shape: leading axes of the drives; given: bends and planes of a drive that is given by angles.
    """
    outer = shape if replaced else ()
    place_of = geometry(drive)
    base = np.asarray(place_of.points, dtype=float)
    if given is not None:
        twist = np.asarray(replaced.get("joints[0].plane_twist", drive.joints[0].plane_twist or 0.0))
        length = over(outer, place_of.length, replaced, r"shafts\[(\d+)\]\.length$", 0)
        return points_from_angles(given.joint_angle, given.plane_twist, length, first_twist=twist)
    if drive.form == "slopes":
        length = over(outer, place_of.length, replaced, r"shafts\[(\d+)\]\.length$", 0)
        slopes = [
            over(
                outer,
                np.asarray([getattr(one, name) or 0.0 for one in drive.shafts]),
                replaced,
                rf"shafts\[(\d+)\]\.{name}$",
                0,
            )
            for name in ("plan_slope", "side_slope")
        ]
        axis = frames.unit(np.stack((np.ones_like(slopes[0]), np.tan(slopes[0]), np.tan(slopes[1])), axis=-1))
        steps = length[..., None] * axis
        after = np.cumsum(steps[..., 1:, :], axis=-2)
        return np.concatenate((-steps[..., :1, :], 0.0 * steps[..., :1, :], after), axis=-2)
    points = np.broadcast_to(base, (*outer, *base.shape)).copy()
    for path, values in replaced.items():
        row = row_of(path, len(drive.joints))
        if row is not None:
            part = re.search(r"\[(\d)\]$", path.partition(".")[2])
            points[..., row, int(part[1]) if part else slice(None)] = values
    return points


def over(shape: tuple[int, ...], values: Array, moved: Mapping[str, Array], pattern: str, first: int) -> Array:
    """Return values (..., k) with the varied ones in their places, whose index after ``first`` the pattern finds.

    One that lies outside them turns or bends nothing, as the plane of the first joint.
    """
    given = np.asarray(values, dtype=float)
    whole = np.broadcast_to(given, (*shape, given.shape[-1])).copy()
    for path, new in moved.items():
        match = re.match(pattern, path)
        if match and 0 <= int(match[1]) - first < whole.shape[-1]:
            whole[..., int(match[1]) - first] = new
    return whole


def row_of(path: str, joints: int) -> int | None:
    """Return which point of the axis a path moves; None where it moves none."""
    if path.startswith("input.point"):
        return 0
    if path.startswith("output.point"):
        return joints + 1
    match = re.match(r"joints\[(\d+)\]\.centre", path)
    return int(match[1]) + 1 if match else None
