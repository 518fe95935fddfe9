"""What a drive must satisfy to be one: every contradiction found, each with its path and the value given."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Any

from cardan.drive.body import FITS
from cardan.drive.cross import Cross
from cardan.drive.described import Described
from cardan.drive.duty import Vehicle
from cardan.drive.joint_parts import Needles
from cardan.drive.machine import MachineTorque, TorqueHistory
from cardan.drive.material import Material
from cardan.drive.movement import Movement
from cardan.drive.shaft import Shaft, Spline
from cardan.drive.station import Pendulum
from cardan.drive.torsional_layout import is_elastic, line_length, shaft_places
from cardan.errors import Problem
from cardan.reading.ranges import HUGE
from cardan.texts import _
from cardan.units import mm, nearest

from .parts import ROUNDING, known_lengths, part_problems, place_problems
from .paths import pose_problems
from .ranges import range_problems

MAX_JOINTS = 1000  # more joints than this are refused: no drive has them, and a report could not show them
COINCIDENT = 1e-9  # points nearer than this share of the largest distance are the same point


TINY = 1e-100  # points nearer than this [m] are the same point; the square of their distance would vanish


def wrong_count(field: str, values: Sequence[Any], wanted: int, *, empty: bool = False) -> Iterator[Problem]:
    """Yield a problem if a list has the wrong length."""
    if len(values) != wanted and not (empty and not len(values)):
        yield Problem(field, _("{given} values given, {wanted} needed").format(given=len(values), wanted=wanted))


def point_problems(points: Sequence[Sequence[float]]) -> Iterator[Problem]:
    """Yield what is wrong with the points of a drive's axis: too few, not finite, coincident, shafts at 90° or more."""
    if len(points) < 3:
        text = _("{count} points given; a drive needs at least 3: input, one joint, output")
        yield Problem("points", text.format(count=len(points)))
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
            text = _("there is no shaft {number}; {n} joints make shafts 1 to {last}")
            yield Problem(f"{path}.number", text.format(number=shaft.number, n=n, last=n + 1))
            continue
        if shaft.number in seen:
            yield Problem(f"{path}.number", _("shaft {number} is described twice").format(number=shaft.number))
        seen.add(shaft.number)
        teeth = shaft.spline.teeth if shaft.spline else None
        if teeth is not None and math.isfinite(teeth) and teeth != int(teeth):
            yield Problem(f"{path}.spline.teeth", _("{teeth} is not a whole number").format(teeth=teeth))
        if 1 < shaft.number <= n:
            continue
        for name, unused in (
            ("yoke_angle", shaft.yoke_angle != 0.0),
            ("yoke_fixed", shaft.yoke_fixed),
            ("weight", shaft.weight != 1.0),
        ):
            if unused:
                text = _("shaft {number} is an end shaft; only a shaft between two joints has this")
                yield Problem(f"{path}.{name}", text.format(number=shaft.number))


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
        text = _(
            "no geometry: give the joint centres (joints centre, input.point, output.point), or the angle of every "
            "joint, or side_slope and plan_slope of every shaft"
        )
        yield Problem("joints", text)
        return
    for owner, path, present in given:
        if not owner and present and form != "angles":
            yield Problem(path, _("only drives given by joint angles have plane twists"))
        elif owner and owner != form and present:
            text = _("this drive's geometry is given by {form}; this field belongs to another form")
            yield Problem(path, text.format(form=form))
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
                text = _("{moved} is not a point of this drive; its points are {known}")
                yield Problem(f"movements[{k}].moves", text.format(moved=repr(moved), known=", ".join(known)))
        axis = getattr(movement, "axis", None)
        if axis is not None and not any(axis):
            yield Problem(f"movements[{k}].axis", _("[0, 0, 0] has no direction"))
        for problem in movement.problems():
            yield Problem(f"movements[{k}].{problem.field}", problem.message)


# What a duty must satisfy to be a duty cycle, and what a maker's rating must say.

WHOLE = 1e-4  # shares of a duty cycle may miss the whole time by this, 0.01 %
SLACK = 1e-12  # what sums of decimal fractions may be off beside that


def duty_problems(drive: Described) -> Iterator[Problem]:
    """Yield what contradicts itself in the duty cycle of a drive, and keys of a rating that is not there."""
    duty = drive.duty
    if duty.blocks:
        whole = sum(block.share for block in duty.blocks)
        if abs(whole - 1.0) > WHOLE + SLACK:
            text = _("the shares of the blocks add up to {whole:.6g} %, not to 100 %")
            yield Problem("duty.blocks", text.format(whole=100.0 * whole), "inconsistent")
    yield from _case_problems(drive)
    history = duty.torque_history
    if history is not None:
        if duty.blocks:
            yield Problem("duty.torque_history", _("blocks give the duty cycle already"), "inconsistent")
        if any(case.share is not None or case.cycles is not None for case in duty.cases):
            yield Problem("duty.torque_history", _("cases give the duty cycle already"), "inconsistent")
        if history.times or history.torques:
            law = TorqueHistory(file=history.file, times=history.times, torques=history.torques, speeds=history.speeds)
            for problem in law.problems():
                yield Problem("duty.torque_history", problem.message)
    for i, joint in enumerate(drive.joints):
        rating = joint.rating
        if rating is not None and rating.torque is None and rating.convention != "Tc":
            yield Problem(f"joints[{i}].rating.convention", _("belongs to the rated torque, which is not given"))


def _case_problems(drive: Described) -> Iterator[Problem]:
    """Yield what contradicts itself in the load cases of a drive."""
    duty = drive.duty
    names: set[str] = set()
    for k, case in enumerate(duty.cases):
        path = f"duty.cases[{k}]"
        if case.name in names:
            yield Problem(f"{path}.name", _("{name} names two load cases").format(name=repr(case.name)))
        names.add(case.name)
        if case.share is not None and case.cycles is not None:
            yield Problem(f"{path}.cycles", _("a load case has a share or cycles, not both"), "inconsistent")
        if case.speed is not None and case.speed_range is not None:
            yield Problem(f"{path}.speed_range", _("a load case has a speed or a range, not both"), "inconsistent")
        if case.cycles is not None and duty.life is None:
            yield Problem("duty.life", _("missing; load case {name} counts its turns in it").format(name=case.name))
        if case.cycles is not None and not (case.speed or case.speed_range or duty.speed):
            yield Problem(f"{path}.speed", _("missing; how long its cycles last depends on it"), "missing")
    if duty.cases and duty.blocks:
        yield Problem("duty.cases", _("blocks give the duty cycle already"), "inconsistent")
    shares = [case.share for case in duty.cases if case.share is not None]
    whole = sum(shares)
    least = 0.0 if duty.torque is not None else 1.0
    if shares and not least - WHOLE - SLACK <= whole <= 1.0 + WHOLE + SLACK:
        text = _("the shares of the load cases add up to {whole:.6g} %, not to 100 %")
        yield Problem("duty.cases", text.format(whole=100.0 * whole), "inconsistent")


def bound_problems(drive: Described) -> Iterator[Problem]:
    """Yield load cases of a file bound to poses or movements that it has not; a drive in a pose has no others."""
    known = {"pose": [pose.name for pose in drive.poses], "movement": [one.name for one in drive.movements]}
    what = {"pose": _("pose"), "movement": _("movement")}
    text = _("there is no {what} {name}; there are: {known}")
    for k, case in enumerate(drive.duty.cases):
        for field, others in known.items():
            name = getattr(case, field)
            if name and name not in others:
                there = ", ".join(filter(None, others)) or _("none")
                message = text.format(what=what[field], name=repr(name), known=there)
                yield Problem(f"duty.cases[{k}].{field}", message)


# What a drive must satisfy to be a torsional line: its stations, its play and damping, and the torques on it.

ENDS = ("input", "output")  # words for the two ends of a drive; no station may be called so


def line_problems(drive: Described) -> Iterator[Problem]:
    """Yield what contradicts itself in the stations and torques of a drive, and keys that nothing can use in it."""
    lengths = _lengths(drive)
    yield from _station_problems(drive, lengths)
    for shaft in drive.shafts:
        if shaft.number <= len(drive.joints) + 1:
            yield from _twist_problems(drive, shaft, lengths)
    for i, joint in enumerate(drive.joints):
        if joint.backlash and not any(is_elastic(drive, k, lengths.get(k)) for k in (i + 1, i + 2)):
            text = _("shafts {one} and {two} are rigid; play counts beside a shaft that twists")
            yield Problem(f"joints[{i}].backlash", text.format(one=i + 1, two=i + 2))
    yield from _torque_problems(drive)


def _lengths(drive: Described) -> dict[int, float]:
    """Return the lengths of the shafts by their number, of end shafts too, as far as the drive says them [m]."""
    known = known_lengths(drive)
    found = {k: line_length(drive, k, known.get(k)) for k in range(1, len(drive.joints) + 2)}
    return {k: length for k, length in found.items() if length is not None}


def _station_problems(drive: Described, lengths: dict[int, float]) -> Iterator[Problem]:
    names: set[str] = set()
    known = known_lengths(drive)
    for k, station in enumerate(drive.stations):
        path = f"stations[{k}]"
        yield from place_problems(station.shaft, station.position, len(drive.joints), known, path)
        length = lengths.get(station.shaft)
        reach = 0.0 if station.shaft in known or length is None else abs(station.position or 0.0)
        if length is not None and reach > length * (1.0 + ROUNDING):
            text = _("is beyond the end of shaft {number}, which is {length:.6g} mm long")
            yield Problem(f"{path}.position", text.format(number=station.shaft, length=length / mm))
        if station.position is not None and station.end is not None:
            yield Problem(f"{path}.position", _("end says where it is already"))
        if station.absorber is not None and station.pendulum is not None:
            yield Problem(f"{path}.pendulum", _("an absorber is there already; put it on a station of its own"))
        if station.absorber is not None and not (station.absorber.stiffness or station.absorber.damping):
            text = _("missing; or damping, for a damper without spring: nothing holds the mass")
            yield Problem(f"{path}.absorber.stiffness", text)
        if station.pendulum is not None:
            yield from _stop_problems(station.pendulum, f"{path}.pendulum")
        if station.name in names or station.name in ENDS:
            text = _("{name} names an end of the drive") if station.name in ENDS else _("{name} names two stations")
            yield Problem(f"{path}.name", text.format(name=repr(station.name)))
        names |= {station.name} - {""}
    for number in range(1, len(drive.joints) + 2):
        own = [(k, one) for k, one in enumerate(drive.stations) if one.shaft == number]
        loose = [k for k, one in own if one.end is None and one.position is None]
        placed = any(one.position is not None for _k, one in own)
        for k in loose if placed else ():
            text = _("missing; other stations of shaft {number} have theirs")
            yield Problem(f"stations[{k}].position", text.format(number=number))
        if not (loose and placed):
            yield from _order_problems(drive, number, lengths.get(number))


def _stop_problems(pendulum: Pendulum, path: str) -> Iterator[Problem]:
    """Yield stops of which half is said."""
    if pendulum.stop_angle is not None and pendulum.stop_stiffness is None:
        yield Problem(f"{path}.stop_stiffness", _("missing; the stop at stop_angle needs it"), "missing")
    if pendulum.stop_angle is None:
        for name, given in (("stop_stiffness", pendulum.stop_stiffness), ("stop_damping", pendulum.stop_damping)):
            if given:
                yield Problem(f"{path}.{name}", _("counts only with stop_angle, which is not given"))


def _order_problems(drive: Described, number: int, length: float | None) -> Iterator[Problem]:
    """Yield elements that lead nowhere, and two of them from one place."""
    for place in (places := shaft_places(drive, number, length)):
        leading = [k for k in place.stations if drive.stations[k].to_next is not None]
        for k in leading if place is places[-1] else leading[1:]:
            text = _("there is no further station on shaft {number}")
            other = _("the element to the next station is given at another station of this place")
            message = text.format(number=number) if place is places[-1] else other
            yield Problem(f"stations[{k}].to_next", message)
    for k, one in enumerate(drive.stations):
        if one.shaft == number and one.to_next is not None:
            for problem in one.to_next.problems():
                yield Problem(f"stations[{k}].to_next.{problem.field}", problem.message)


def _twist_problems(drive: Described, shaft: Shaft, lengths: dict[int, float]) -> Iterator[Problem]:
    path = f"shafts[{shaft.number - 1}]"
    spline = shaft.spline
    if spline is not None and spline.stiffness is not None and shaft.stiffness is not None:
        yield Problem(f"{path}.spline.stiffness", _("the stiffness of the shaft includes it already"))
    if is_elastic(drive, shaft.number, lengths.get(shaft.number)):
        return
    text = _("the shaft is rigid; give its stiffness, or a body of known length")
    for name, there in (
        ("damping", shaft.damping is not None),
        ("loss_factor", shaft.loss_factor is not None),
        ("spline.backlash", spline is not None and spline.backlash > 0.0),
    ):
        if there:
            yield Problem(f"{path}.{name}", text)


def _torque_problems(drive: Described) -> Iterator[Problem]:
    duty = drive.duty
    known = (*ENDS, *(station.name for station in drive.stations if station.name))
    given: list[tuple[str, MachineTorque]] = [
        (f"duty.{name}", one) for name, one in (("motor", duty.motor), ("load", duty.load)) if one is not None
    ]
    given += [(f"duty.torques[{k}]", one) for k, one in enumerate(duty.torques)]
    for path, one in given:
        for problem in one.problems():
            yield Problem(f"{path}.{problem.field}", problem.message)
        if one.station and one.station not in known:
            near = nearest(one.station, known)
            text = _("there is no station {name}; the stations are {known}")
            message = text.format(name=repr(one.station), known=", ".join(known))
            yield Problem(f"{path}.station", message + (_("; the nearest is {near}").format(near=near) if near else ""))
        elif not one.station and path.startswith("duty.torques"):
            yield Problem(f"{path}.station", _("missing; one of {known}").format(known=", ".join(known)))
    if duty.engine is not None:
        for problem in duty.engine.problems():
            yield Problem(f"duty.engine.{problem.field}", problem.message)
    if duty.input == "uniform":
        driving = [name for name in ("engine", "motor") if getattr(duty, name) is not None]
        driving += [f"torques[{k}]" for k, one in enumerate(duty.torques) if one.station == "input"]
        for name in driving:
            text = _('the input turns uniformly whatever acts on it; write input = "free", or leave this out')
            yield Problem(f"duty.{name}", text)
    if duty.run_up is not None and duty.run_up.start == duty.run_up.end:
        yield Problem("duty.run_up.end", _("is the speed before; a run-up needs two"))
    if duty.starts is not None and duty.run_up is None:
        yield Problem("duty.run_up", _("missing; duty.starts counts run-ups"), "missing")
    for k, event in enumerate(duty.events):
        for name, value in (("speed", duty.speed), ("torque", duty.torque)):
            if value is None:
                yield Problem(f"duty.{name}", _("missing; an event starts from it"), "missing")
        if event.kind == "load_step" and event.start:
            yield Problem(
                f"duty.events[{k}].start", _("belongs to a clutch; a load step comes at the speed of the duty")
            )


# What the sizes, materials and figures must satisfy that strength and upkeep go by.

SPLINE_ROUNDING = 1e-9  # sizes that differ by this share are the same


ROOM = 0.02  # more needles than fit by this share are a matter of rounded diameters


def size_problems(drive: Described) -> Iterator[Problem]:
    """Yield sizes that do not go together, and keys that nothing can use beside the others."""
    for i, joint in enumerate(drive.joints):
        if joint.cross is not None:
            yield from _cross(joint.cross, f"joints[{i}].cross")
            yield from _needles(joint.cross, joint.needles, f"joints[{i}].needles")
        if joint.yoke is not None:
            yield from _material(joint.yoke.material, f"joints[{i}].yoke.material")
    for shaft in drive.shafts:
        path = f"shafts[{shaft.number - 1}]"
        yield from _material(shaft.material, f"{path}.material")
        for k, segment in enumerate(shaft.segments):
            yield from _material(segment.material, f"{path}.segments[{k}].material")
        yield from _layup(shaft, path)
        if shaft.spline is not None:
            yield from _spline(shaft.spline, f"{path}.spline")
        if not shaft.has_body:
            for name, there in (("notch", shaft.notch is not None), ("finish", shaft.finish != "machined")):
                if there:
                    yield Problem(f"{path}.{name}", _("belongs to a body, and its outer diameter is not given"))
    if drive.duty.vehicle is not None:
        yield from _vehicle(drive.duty.vehicle, "duty.vehicle")


def _cross(cross: Cross, path: str) -> Iterator[Problem]:
    if cross.journal is not None and cross.journal_bore >= cross.journal:
        text = _("{bore:.6g} mm is not less than the diameter of the journal, {journal:.6g} mm")
        yield Problem(f"{path}.journal_bore", text.format(bore=cross.journal_bore / mm, journal=cross.journal / mm))
    yield from _material(cross.material, f"{path}.material")


def _needles(cross: Cross, needles: Needles | None, path: str) -> Iterator[Problem]:
    """Yield a row of needles that has no room around its journal: z asin(d/(D + d)) ≤ π."""
    if needles is None or needles.count is None or needles.diameter is None or cross.journal is None:
        return
    most = math.pi / math.asin(needles.diameter / (cross.journal + needles.diameter))
    if needles.count > most * (1.0 + ROOM):
        text = _("{count} needles of {diameter:.6g} mm have no room around a journal of {journal:.6g} mm; {most} have")
        said = text.format(
            count=needles.count, diameter=needles.diameter / mm, journal=cross.journal / mm, most=math.floor(most)
        )
        yield Problem(f"{path}.count", said, "inconsistent")


def _material(material: Material | None, path: str) -> Iterator[Problem]:
    if material is None or material.yield_strength is None or material.ultimate_strength is None:
        return
    if material.ultimate_strength < material.yield_strength:
        yield Problem(f"{path}.ultimate_strength", _("is below the yield strength"), "inconsistent")


def _layup(shaft: Shaft, path: str) -> Iterator[Problem]:
    layup = shaft.layup
    if layup is None:
        return
    if shaft.outer is None:
        yield Problem(f"{path}.layup", _("belongs to a tube, and its outer diameter is not given"))
    elif 2.0 * len(layup.angles) * layup.ply_thickness > shaft.outer * (1.0 - FITS):
        yield Problem(f"{path}.layup.ply_thickness", _("the plies are thicker than half the outer diameter"))
    if not layup.angles:
        yield Problem(f"{path}.layup.angles", _("holds no ply"), "empty")
    for name in ("along", "across", "shear"):
        if getattr(layup.ply, name) is None and not layup.ply.grade:
            text = _('missing; or name a lamina of the catalogue, ply = "CFRP-HT-UD"')
            yield Problem(f"{path}.layup.ply.{name}", text, "missing")
    for name in ("material", "wall", "inner"):
        if getattr(shaft, name) is not None:
            yield Problem(f"{path}.{name}", _("layup gives the same already"))


def _spline(spline: Spline, path: str) -> Iterator[Problem]:
    if spline.outer is None or spline.root is None:
        return
    if spline.root >= spline.outer:
        yield Problem(f"{path}.root", _("is not less than the outer diameter of the teeth"))
    elif spline.outer - spline.root <= 4.0 * spline.chamfer * (1.0 + SPLINE_ROUNDING):
        yield Problem(f"{path}.chamfer", _("leaves no flank of the teeth to bear"), "out_of_range")


def _vehicle(vehicle: Vehicle, path: str) -> Iterator[Problem]:
    if vehicle.engine_torque is not None:
        for name in ("engine_power", "engine_speed"):
            if getattr(vehicle, name) is not None:
                yield Problem(f"{path}.{name}", _("engine_torque gives the torque already"))
