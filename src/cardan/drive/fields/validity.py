"""What a drive must satisfy to be one: every contradiction found, each with its path and the value given."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Any

from cardan.drive.described import Described
from cardan.drive.movement import Movement
from cardan.drive.shaft import Shaft
from cardan.errors import Problem
from cardan.reading.ranges import HUGE
from cardan.texts import _

from .duty_validity import duty_problems
from .line_validity import line_problems
from .parts import part_problems
from .paths import pose_problems
from .ranges import range_problems
from .size_validity import size_problems

MAX_JOINTS = 1000
"""More joints than this are refused: no drive has them, and a report could not show them."""

COINCIDENT = 1e-9
"""Points nearer than this share of the largest distance are the same point."""


TINY = 1e-100
"""Points nearer than this [m] are the same point; the square of their distance would vanish."""


def wrong_count(field: str, values: Sequence[Any], wanted: int, *, empty: bool = False) -> Iterator[Problem]:
    """Yield a problem if a list has the wrong length."""
    if len(values) != wanted and not (empty and not len(values)):
        yield Problem(field, _("{given} values given, {wanted} needed").format(given=len(values), wanted=wanted))


def point_problems(points: Sequence[Sequence[float]]) -> Iterator[Problem]:
    """Yield what is wrong with the points of a drive's axis: too few, not finite, coincident, shafts at 90° or more."""
    if len(points) < 3:
        yield Problem(
            "points",
            _("{count} points given; a drive needs at least 3: input, one joint, output").format(count=len(points)),
        )
        return
    for k, point in enumerate(points):
        if not _is_point(point):
            yield Problem(f"points[{k}]", _("{point} is not three finite numbers").format(point=tuple(point)))
    axes = _axes([point if _is_point(point) else None for point in points])
    for k, axis in enumerate(axes, start=1):
        if axis == ():
            yield Problem(f"points[{k}]", _("coincides with points[{k}]").format(k=k - 1))
    for _joint, message in _folds(axes):
        yield Problem("points", message)


def _is_point(point: Sequence[float] | None) -> bool:
    return point is not None and len(point) == 3 and all(math.isfinite(x) and abs(x) <= HUGE for x in point)


def _axes(points: Sequence[Sequence[float] | None]) -> list[tuple[float, ...] | None]:
    """Return the direction of every shaft: empty between points that coincide, None where a point is not known."""
    pairs = [None if a is None or b is None else (a, b) for a, b in pairwise(points)]
    apart = [None if pair is None else math.dist(*pair) for pair in pairs]
    least = max(COINCIDENT * max((one for one in apart if one is not None), default=0.0), TINY)
    axes: list[tuple[float, ...] | None] = []
    for pair, distance in zip(pairs, apart, strict=True):
        if pair is None or distance is None:
            axes.append(None)
        else:
            near = distance <= least
            axes.append(() if near else tuple((y - x) / distance for x, y in zip(*pair, strict=True)))
    return axes


def _folds(axes: Sequence[Sequence[float] | None]) -> Iterator[tuple[int, str]]:
    """Yield the number of each joint whose shafts enclose 90° or more, and what to say of it."""
    for i, (one, two) in enumerate(pairwise(axes), start=1):
        if not one or not two:
            continue
        cosine = sum(x * y for x, y in zip(one, two, strict=True))
        if cosine <= 1e-15:
            message = _("shafts {one} and {two} enclose {joint_angle:.4g}°; a universal joint needs less than 90°")
            joint_angle = math.degrees(math.acos(max(-1.0, cosine)))
            yield i, message.format(one=i, two=i + 1, joint_angle=joint_angle)


def problems(drive: Described) -> Iterator[Problem]:
    """Yield everything that is wrong with a drive."""
    n = len(drive.joints)
    if not n:
        yield Problem("joints", _("a drive needs at least one joint"))
        return
    if n > MAX_JOINTS:
        yield Problem("joints", _("{n} joints given; the limit is {limit}").format(n=n, limit=MAX_JOINTS))
        return
    found = [
        *range_problems(drive),
        *shaft_problems(drive.shafts, n),
        *_form_problems(drive),
        *_place_problems(drive),
        *movement_problems(drive.movements, n),
        *part_problems(drive),
        *line_problems(drive),
        *duty_problems(drive),
        *size_problems(drive),
        *_unused(drive),
    ]
    yield from found
    yield from _pose_problems(drive, whole=not found)


def axis_points(drive: Described) -> list[tuple[float, float, float]]:
    """Return input point, joint centres and output point of a drive given by points."""
    return [drive.input.point, *(joint.centre for joint in drive.joints), drive.output.point]  # type: ignore[list-item]


def _place_problems(drive: Described) -> Iterator[Problem]:
    """Yield joints that coincide and joints that fold back, as far as the geometry is known."""
    n = len(drive.joints)
    if drive.form == "points":
        names = ["input.point", *(f"joints[{i}].centre" for i in range(n)), "output.point"]
        axes = _axes([point if _is_point(point) else None for point in axis_points(drive)])
        for k, axis in enumerate(axes, start=1):
            if axis == ():
                yield Problem(names[k], _("coincides with {other}").format(other=names[k - 1]))
        for i, message in _folds(axes):
            yield Problem(names[i], message)
    elif drive.form == "slopes":
        given = {shaft.number: shaft for shaft in drive.shafts}
        for i, message in _folds([_sloped_axis(given.get(k)) for k in range(1, n + 2)]):
            yield Problem(f"shafts[{i}].side_slope", message)


def _sloped_axis(shaft: Shaft | None) -> tuple[float, float, float] | None:
    if shaft is None or (shaft.side_slope is None and shaft.plan_slope is None):
        return None
    side, plan = shaft.side_slope or 0.0, shaft.plan_slope or 0.0
    if not abs(side) < math.pi / 2 or not abs(plan) < math.pi / 2:
        return None
    y, z = math.tan(plan), math.tan(side)
    size = math.hypot(1.0, y, z)
    return (1.0 / size, y / size, z / size)


def _unused(drive: Described) -> Iterator[Problem]:
    """Yield what no question can use in this drive."""
    if drive.limits.spline_overlap is not None and not any(shaft.spline for shaft in drive.shafts):
        yield Problem("limits.spline_overlap", _("no shaft of this drive has a spline that it could limit"))


def _pose_problems(drive: Described, *, whole: bool) -> Iterator[Problem]:
    """Yield what is wrong with the poses: their paths and values; if the drive is whole, what they make of it."""
    if not drive.poses:
        return
    names: set[str] = set()
    for k, pose in enumerate(drive.poses):
        if pose.name in names:
            yield Problem(f"poses[{k}].name", _("{name} names two poses").format(name=repr(pose.name)))
        names.add(pose.name)
    total = sum(pose.share for pose in drive.poses if pose.share is not None)
    if total > 1.0 + 1e-9:
        last = max(k for k, pose in enumerate(drive.poses) if pose.share is not None)
        message = _("the shares of all poses add up to {total:.6g} %; allowed is at most 100 %")
        yield Problem(f"poses[{last}].share", message.format(total=100.0 * total))
    yield from pose_problems(drive, whole=whole)


def shaft_problems(shafts: Sequence[Shaft], n: int) -> Iterator[Problem]:
    """Yield what is wrong with the shafts of an n-joint drive."""
    seen: set[int] = set()
    for shaft in shafts:
        path = f"shafts[{shaft.number - 1}]"
        if shaft.number > n + 1:
            yield Problem(
                f"{path}.number",
                _("there is no shaft {number}; {n} joints make shafts 1 to {last}").format(
                    number=shaft.number, n=n, last=n + 1
                ),
            )
            continue
        if shaft.number in seen:
            yield Problem(f"{path}.number", _("shaft {number} is described twice").format(number=shaft.number))
        seen.add(shaft.number)
        if 1 < shaft.number <= n:
            teeth = shaft.spline.teeth if shaft.spline else None
            if teeth is not None and math.isfinite(teeth) and teeth != int(teeth):
                yield Problem(f"{path}.spline.teeth", _("{teeth} is not a whole number").format(teeth=teeth))
            continue
        for name, unused in (
            ("yoke_angle", shaft.yoke_angle != 0.0),
            ("yoke_fixed", shaft.yoke_fixed),
            ("weight", shaft.weight != 1.0),
            ("spline", shaft.spline is not None),
        ):
            if unused:
                yield Problem(
                    f"{path}.{name}",
                    _("shaft {number} is an end shaft; only a shaft between two joints has this").format(
                        number=shaft.number
                    ),
                )


def _form_problems(drive: Described) -> Iterator[Problem]:
    """Yield what is missing from the form in use, and what belongs to another."""
    form = drive.form
    given: list[tuple[str, str, bool]] = [
        ("points", "input.point", drive.input.point is not None),
        ("points", "output.point", drive.output.point is not None),
    ]
    for i, joint in enumerate(drive.joints):
        given += [
            ("points", f"joints[{i}].centre", joint.centre is not None),
            ("angles", f"joints[{i}].joint_angle", joint.joint_angle is not None),
            ("", f"joints[{i}].plane_twist", joint.plane_twist is not None),
        ]
        if form != "points" and joint.move_within is not None:
            yield Problem(f"joints[{i}].move_within", _("only drives given by joint centres can be moved within a box"))
        for box, (low, high) in enumerate(joint.move_within or ()):
            if low > high:
                yield Problem(f"joints[{i}].move_within[{box}]", _("its first bound is above its second"))
    numbers = {shaft.number: shaft for shaft in drive.shafts}
    for k in range(1, len(drive.joints) + 2):
        shaft = numbers.get(k)
        sloped = shaft is not None and (shaft.side_slope is not None or shaft.plan_slope is not None)
        name = "plan_slope" if sloped and shaft is not None and shaft.side_slope is None else "side_slope"
        given.append(("slopes", f"shafts[{k - 1}].{name}", sloped))
        if form == "points" and shaft is not None and shaft.length is not None:
            yield Problem(f"shafts[{k - 1}].length", _("the joint centres already give the length of every shaft"))
    if not any(present for owner, _path, present in given if owner):
        yield Problem(
            "joints",
            _(
                "no geometry: give the joint centres (joints centre, input.point, output.point), or the angle of every "
                "joint, or side_slope and plan_slope of every shaft"
            ),
        )
        return
    for owner, path, present in given:
        if not owner and present and form != "angles":
            yield Problem(path, _("only drives given by joint angles have plane twists"))
        elif owner and owner != form and present:
            yield Problem(
                path,
                _("this drive's geometry is given by {form}; this field belongs to another form").format(form=form),
            )
        elif owner == form and not present:
            yield Problem(path, _("missing; a drive given by {form} needs it").format(form=form))


def movement_problems(movements: Sequence[Movement], n: int) -> Iterator[Problem]:
    """Yield what is wrong with the movements of an n-joint drive."""
    known = ["input", *(f"joints[{i}]" for i in range(n)), "output"]
    for k, movement in enumerate(movements):
        if not movement.moves:
            yield Problem(f"movements[{k}].moves", _("names no point"))
        for moved in movement.moves:
            if moved not in known:
                yield Problem(
                    f"movements[{k}].moves",
                    _("{moved} is not a point of this drive; its points are {known}").format(
                        moved=repr(moved), known=", ".join(known)
                    ),
                )
        axis = getattr(movement, "axis", None)
        if axis is not None and not any(axis):
            yield Problem(f"movements[{k}].axis", _("[0, 0, 0] has no direction"))
        for problem in movement.problems():
            yield Problem(f"movements[{k}].{problem.field}", problem.message)
