"""How large the parts of a drive are: what its file says, and the rest in proportion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from cardan.drive.drive import Drive
from cardan.drive.joints.common.site import JointSize, joint_size
from cardan.drive.models.geometry import Geometry
from cardan.drive.shaft import Shaft
from cardan.drive.support import Support

ROOM = 0.46  # share of a shaft between two joints that one yoke takes at most

SHOWN = 4.0
"""How much of an end shaft is drawn behind its yoke, in radii of the joint, where nothing stands farther out."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Sizes:
    """Sizes of all parts of a drive."""

    joints: tuple[JointSize, ...]
    bodies: tuple[float, ...]  # [m]: radius of each shaft where it is thickest
    solid: tuple[bool, ...]  # whether the file says what the shaft looks like
    ends: tuple[float, float]  # [m]: how long the input and the output shaft are drawn, from their joint
    usual: float  # [m]: radius of a joint of this drive where the file says none


def sizes(drive: Drive, place: Geometry) -> Sizes:
    """Return how large the parts of a drive are drawn.

    drive: its sizes filled in from the catalogue; place: where it lies.
    A joint is as large as its cross, else as its rating, else in proportion to its shafts: their diameter where it is
    given, else their lengths.
    """
    lengths = [float(one) for one in place.length]
    usual = _usual(drive, lengths)
    joint_angles = [float(joint_angle) for joint_angle in place.joint_angle]
    joints = tuple(
        joint_size(one.span, one.cross, one.needles, joint_angle, usual)
        for one, joint_angle in zip(drive.joints, joint_angles, strict=True)
    )
    bodies, solid = [], []
    for k, shaft in enumerate(drive.shafts):
        radius = thickest(shaft)
        beside = [joints[i].radius for i in (k - 1, k) if 0 <= i < len(joints)]
        bores = [one.bore for one in drive.supports if one.shaft == shaft.number and one.bore]
        inner = 0 < k < len(joints)
        alone = 0.5 * max(bores) if bores and not inner else (0.66 if inner else 0.5) * min(beside)
        bodies.append(alone if radius is None else radius)
        solid.append(radius is not None)
    ends = tuple(
        _end(drive, number, length, size)
        for number, length, size in ((1, lengths[0], joints[0]), (len(drive.shafts), lengths[-1], joints[-1]))
    )
    return Sizes(joints=joints, bodies=tuple(bodies), solid=tuple(solid), ends=ends, usual=usual)  # type: ignore[arg-type]


def thickest(shaft: Shaft) -> float | None:
    """Return the radius of a shaft where it is thickest [m], None where the file does not say."""
    if shaft.outer is not None:
        return 0.5 * shaft.outer
    return 0.5 * max(one.outer for one in shaft.segments) if shaft.segments else None


def _usual(drive: Drive, lengths: Sequence[float]) -> float:
    """Return the radius of a joint whose size the file does not say [m]."""
    given = [0.5 * span for joint in drive.joints if (span := joint.span) is not None]
    tubes = [1.02 * radius for radius in map(thickest, drive.shafts[1:-1]) if radius is not None]
    between = lengths[1:-1]
    if between:
        whole = sum(between) + 2.0 * max(0.6 * max(between), min(between))
        drawn = min(0.04 * whole, 0.24 * min(between))
    else:
        drawn = 0.16 * min(lengths)
    most = 0.3 * min(between) if between else 0.4 * min(lengths)
    for found in (given, tubes):
        if found:
            return min(sum(found) / len(found), most)
    return drawn


def _end(drive: Drive, number: int, length: float, size: JointSize) -> float:
    """Return how far an end shaft is drawn [m]: a piece of it, and all that stands on it."""
    shown = size.reach + SHOWN * size.radius
    held = [abs(one.position) for one in drive.supports if one.shaft == number]
    held += [abs(one.position) for one in drive.stations if one.shaft == number and one.position is not None]
    return max([min(length, shown), size.reach + size.radius, *(place + 0.9 * size.radius for place in held)])


def bearing_radius(support: Support, body: float, *, solid: bool) -> float:
    """Return the radius at which a support holds its shaft [m]."""
    if support.bore is not None:
        return 0.5 * support.bore
    return 0.62 * body if solid else body
