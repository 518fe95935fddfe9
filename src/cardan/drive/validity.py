"""What a drive must satisfy to be one: every contradiction found, each with its path and the value given."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import fields, is_dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from cardan.errors import Problem
from cardan.texts import _
from cardan.units import KEY, Key, factor, label, preferred

from .shaft import Shaft

if TYPE_CHECKING:
    from .drive import Drive
    from .movement import Movement

MAX_JOINTS = 1000
"""More joints than this are refused: no drive has them, and a report could not show them."""

COINCIDENT = 1e-9
"""Points nearer than this share of the largest distance are the same point."""


def shown(value: float, key: Key) -> str:
    """Return a value in SI as the user would write it.

    Examples
    --------
    >>> shown(0.02, Key("", "length"))
    '20 mm'
    """
    if key.dimension is None:
        return f"{value:.6g}"
    unit = preferred(key.dimension)
    text = label(unit)
    return f"{value / factor(key.dimension, unit):.6g}{'' if text == '°' else ' '}{text}"


def allowed(key: Key) -> str:
    """Return the allowed range of a key in words."""
    parts = []
    if key.low > -math.inf:
        parts.append(_("at least {value}").format(value=shown(key.low, key)))
    if key.above > -math.inf:
        parts.append(_("more than {value}").format(value=shown(key.above, key)))
    if key.high < math.inf:
        parts.append(_("at most {value}").format(value=shown(key.high, key)))
    if key.below < math.inf:
        parts.append(_("less than {value}").format(value=shown(key.below, key)))
    return _(" and ").join(parts) or _("a finite number")


def range_problems(thing: Any, path: str = "") -> Iterator[Problem]:
    """Yield every number of a dataclass tree that is out of its key's range or not finite."""
    for field in fields(thing):
        value = getattr(thing, field.name)
        here = f"{path}.{field.name}" if path else field.name
        if isinstance(value, tuple) and value and is_dataclass(value[0]):
            for index, item in enumerate(value):
                place = item.number - 1 if isinstance(item, Shaft) else index
                yield from range_problems(item, f"{here}[{place}]")
        elif is_dataclass(value):
            yield from range_problems(value, here)
        elif KEY in field.metadata and not isinstance(value, str | bool):
            yield from _number_problems(value, field.metadata[KEY], here)


def _number_problems(value: Any, key: Key, path: str) -> Iterator[Problem]:
    if isinstance(value, tuple):
        for index, item in enumerate(value):
            yield from _number_problems(item, key, f"{path}[{index}]")
    elif isinstance(value, int | float) and not key.allows(value):
        yield Problem(
            path,
            _("{value} is not allowed; allowed is {allowed}").format(value=shown(value, key), allowed=allowed(key)),
        )


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
    bad = False
    for k, point in enumerate(points):
        if len(point) != 3 or not all(math.isfinite(x) for x in point):
            bad = True
            yield Problem(f"points[{k}]", _("{point} is not three finite numbers").format(point=tuple(point)))
    if bad:
        return
    size = max(math.dist(a, b) for a, b in pairwise(points))
    axes: list[list[float] | None] = []
    for k, (a, b) in enumerate(pairwise(points), start=1):
        distance = math.dist(a, b)
        if distance <= COINCIDENT * size:
            yield Problem(f"points[{k}]", _("coincides with points[{k}]").format(k=k - 1))
            axes.append(None)
        else:
            axes.append([(y - x) / distance for x, y in zip(a, b, strict=True)])
    for i, (one, two) in enumerate(pairwise(axes), start=1):
        if one is None or two is None:
            continue
        cosine = sum(x * y for x, y in zip(one, two, strict=True))
        if cosine <= 1e-15:
            yield Problem(
                "points",
                _("shafts {one} and {two} enclose {bend:.4g}°; a universal joint needs less than 90°").format(
                    one=i, two=i + 1, bend=math.degrees(math.acos(max(-1.0, cosine)))
                ),
            )


def all_shafts(drive: Drive) -> tuple[Shaft, ...]:
    """Return shafts 1 to n+1, the ones not given with their defaults."""
    given = {shaft.number: shaft for shaft in drive.shafts}
    return tuple(given.get(k) or Shaft(number=k) for k in range(1, len(drive.joints) + 2))


def problems(drive: Drive) -> Iterator[Problem]:
    """Yield everything that is wrong with a drive."""
    n = len(drive.joints)
    if not n:
        yield Problem("joints", _("a drive needs at least one joint"))
        return
    if n > MAX_JOINTS:
        yield Problem("joints", _("{n} joints given; the limit is {limit}").format(n=n, limit=MAX_JOINTS))
        return
    found = [*range_problems(drive), *shaft_problems(drive.shafts, n), *_form_problems(drive)]
    yield from found
    if not found and drive.form == "points":
        for problem in point_problems(axis_points(drive)):
            message = re.sub(r"points\[\d+\]", lambda found: _drive_path(found[0], n), problem.message)
            yield Problem(_drive_path(problem.field, n), message)
    yield from movement_problems(drive.movements, n)


def axis_points(drive: Drive) -> list[tuple[float, float, float]]:
    """Return input point, joint centres and output point of a drive given by points."""
    return [drive.input.point, *(joint.centre for joint in drive.joints), drive.output.point]  # type: ignore[list-item]


def _drive_path(field: str, n: int) -> str:
    if "[" not in field:
        return "joints"
    k = int(field[field.index("[") + 1 : -1])
    return "input.point" if k == 0 else "output.point" if k == n + 1 else f"joints[{k - 1}].centre"


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


def _form_problems(drive: Drive) -> Iterator[Problem]:
    """Yield what is missing from the form in use, and what belongs to another."""
    form = drive.form
    given: list[tuple[str, str, bool]] = [
        ("points", "input.point", drive.input.point is not None),
        ("points", "output.point", drive.output.point is not None),
    ]
    for i, joint in enumerate(drive.joints):
        given += [
            ("points", f"joints[{i}].centre", joint.centre is not None),
            ("angles", f"joints[{i}].bend", joint.bend is not None),
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
        given.append(("slopes", f"shafts[{k - 1}].side_slope", sloped))
        if form == "points" and shaft is not None and shaft.length is not None:
            yield Problem(f"shafts[{k - 1}].length", _("the joint centres already give the length of every shaft"))
    if not any(present for owner, _path, present in given if owner):
        yield Problem(
            "joints",
            _(
                "no geometry: give the joint centres (joints centre, input.point, output.point), or the bend of every "
                "joint, or side_slope and plan_slope of every shaft"
            ),
        )
        return
    for owner, path, present in given:
        if not owner and present and form != "angles":
            yield Problem(path, _("only drives given by bends have plane twists"))
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
                    _("{moved} is no point of this drive; its points are {known}").format(
                        moved=repr(moved), known=", ".join(known)
                    ),
                )
        axis = getattr(movement, "axis", None)
        if axis is not None and not any(axis):
            yield Problem(f"movements[{k}].axis", _("[0, 0, 0] has no direction"))
        for problem in movement.problems():
            yield Problem(f"movements[{k}].{problem.field}", problem.message)
