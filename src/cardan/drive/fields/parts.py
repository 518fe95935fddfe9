"""What the parts of a drive must satisfy: crosses, bodies of shafts, splines, supports, and the torque they carry."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import fields

from cardan.drive.body import body_problems
from cardan.drive.described import Described
from cardan.drive.joints import Joint
from cardan.drive.profile_tube import LOBES
from cardan.drive.shaft import Shaft
from cardan.drive.support import Support
from cardan.errors import Problem
from cardan.reading.fields import fields_of
from cardan.texts import _
from cardan.units import mm, rpm

ROUNDING = 1e-9  # a part may stick out of its shaft by this share of the length: what is left of rounding


def part_problems(drive: Described) -> Iterator[Problem]:
    """Yield what contradicts itself in the parts of a drive, and keys that nothing can use beside the others."""
    for i, joint in enumerate(drive.joints):
        yield from _joint(joint, f"joints[{i}]")
    length = known_lengths(drive)
    for shaft in drive.shafts:
        if shaft.number <= len(drive.joints) + 1:
            path = f"shafts[{shaft.number - 1}]"
            yield from _body(shaft, path)
            yield from body_problems(shaft, length.get(shaft.number), path)
            yield from _crack(shaft, len(drive.joints), length, path)
            for k, lump in enumerate(shaft.masses):
                yield from place_problems(shaft.number, lump.position, len(drive.joints), length, f"{path}.masses[{k}]")
            yield from _spline(shaft, len(drive.joints), length, f"{path}.spline")
    for k, support in enumerate(drive.supports):
        yield from _support(support, len(drive.joints), length, f"supports[{k}]")
        yield from _binding(support, drive.joints, f"supports[{k}]")
    ranges = [("duty", drive.duty.speed_range)]
    ranges += [(f"duty.cases[{k}]", case.speed_range) for k, case in enumerate(drive.duty.cases)]
    for path, between in ranges:
        if between is not None and between[0] >= between[1]:
            text = _("its first speed, {low:.6g} rpm, is not below its second, {high:.6g} rpm")
            yield Problem(f"{path}.speed_range", text.format(low=between[0] / rpm, high=between[1] / rpm))
    if drive.duty.torque is None:
        at = drive.duty.torque_at != "output" and not drive.duty.cases
        for name, there in (("harmonics", drive.duty.harmonics), ("torque_at", at)):
            if there:
                yield Problem(f"duty.{name}", _("there is no duty torque that this could belong to"))


def known_lengths(drive: Described) -> dict[int, float]:
    """Return the lengths of the shafts between two joints by their number, as far as the drive says them [m]."""
    between = range(2, len(drive.joints) + 1)
    centres = [joint.centre for joint in drive.joints]
    known: dict[int, float] = {}
    given = {shaft.number: shaft.length for shaft in drive.shafts}
    for k in between:
        one, two = centres[k - 2], centres[k - 1]
        length = given.get(k) if one is None or two is None else math.dist(one, two)
        if length is not None and math.isfinite(length):
            known[k] = length
    return known


def spline_place(drive: Described, number: int, length: float) -> float:
    """Return where the spline of a shaft is, from the joint before it, on shaft 1 from joint 1 [m].

    length [m]: of the shaft. Where the file does not say, it is in the middle of the shaft; of an end shaft between its
    joint and the nearest support.
    """
    spline = drive.shafts[number - 1].spline
    if spline is not None and spline.position is not None:
        return spline.position
    if 1 < number <= len(drive.joints):
        return 0.5 * length
    reach = min((abs(one.position) for one in drive.supports if one.shaft == number), default=length)
    return math.copysign(0.5 * reach, number - 1.5)


def _joint(joint: Joint, path: str) -> Iterator[Problem]:
    for one in fields(joint):
        if one.name in joint.foreign and getattr(joint, one.name) != one.default:
            text = _("a joint of kind {kind} has none")
            yield Problem(f"{path}.{one.name}", text.format(kind=joint.kind), "unknown_key")
    for name in ("error", "tolerance"):
        yield from _departures(joint, name, f"{path}.{name}")
    for problem in joint.own_problems():
        yield Problem(f"{path}.{problem.field}", problem.message, problem.code)
    if joint.friction is not None and joint.material_friction is not None:
        yield Problem(f"{path}.material_friction", _("friction gives the reduced coefficient already"))
    if joint.fit != "new" and joint.material_friction is None:
        yield Problem(f"{path}.fit", _("belongs to material_friction, which is not given"))
    cross = joint.cross
    if cross is not None and cross.span is not None and cross.journal is not None and cross.journal >= cross.span:
        text = _("a journal of {journal:.6g} mm does not fit a cross with a span of {span:.6g} mm")
        yield Problem(f"{path}.cross.journal", text.format(journal=cross.journal / mm, span=cross.span / mm))


def _departures(joint: Joint, name: str, path: str) -> Iterator[Problem]:
    """Yield errors that a joint of its kind cannot have, and those of sizes that it does not give."""
    given = getattr(joint, name)
    if given is None:
        return
    known, sizes = fields_of(fields_of(type(joint))[name].type), joint.sizes()
    for one in fields(given):
        if getattr(given, one.name) == one.default:
            continue
        if one.name not in known:
            text = _("a joint of kind {kind} has none; it takes {names}")
            message = text.format(kind=joint.kind, names=", ".join(known))
            yield Problem(f"{path}.{one.name}", message, "unknown_key")
        elif one.name in sizes and sizes[one.name] is None:
            yield Problem(f"{path}.{one.name}", _("the joint does not give this size itself"), "missing")


def _body(shaft: Shaft, path: str) -> Iterator[Problem]:
    if shaft.outer is None:
        for name in ("inner", "wall", "material"):
            if getattr(shaft, name) is not None:
                yield Problem(f"{path}.{name}", _("belongs to a body, and its outer diameter is not given"))
    elif shaft.inner is not None and shaft.wall is not None:
        yield Problem(f"{path}.wall", _("inner gives the same already"))
    elif shaft.inner is not None and shaft.inner >= shaft.outer:
        yield Problem(f"{path}.inner", _("is not less than the outer diameter"))
    elif shaft.wall is not None and 2.0 * shaft.wall > shaft.outer:
        yield Problem(f"{path}.wall", _("is more than half the outer diameter"))
    yield from _profile(shaft, f"{path}.profile")
    if shaft.centre_of_mass is not None and shaft.mass is None and not shaft.has_body:
        yield Problem(f"{path}.centre_of_mass", _("the shaft has no mass: give its mass or its body"))


def _profile(shaft: Shaft, path: str) -> Iterator[Problem]:
    """Yield what contradicts itself in the contour of a tube."""
    profile = shaft.profile
    if profile is None:
        return
    if shaft.outer is None or shaft.wall is None:
        yield Problem(path, _("belongs to a tube: give its outer diameter over the lobes and its wall"), "missing")
    elif not 2.0 * shaft.wall < profile.inscribed < shaft.outer:
        text = _("needs to be between two walls, {walls:.6g} mm, and the outer diameter, {outer:.6g} mm")
        said = text.format(walls=2.0 * shaft.wall / mm, outer=shaft.outer / mm)
        yield Problem(f"{path}.inscribed", said, "inconsistent")
    if not profile.count:
        yield Problem(f"{path}.lobes", _("missing; a star needs the number of its lobes"), "missing")
    elif profile.count != LOBES.get(profile.form, profile.count):
        text = _("{given} given; a {form} has {count}")
        said = text.format(given=profile.count, form=profile.form, count=LOBES[profile.form])
        yield Problem(f"{path}.lobes", said, "inconsistent")
    for name in ("layup", "crack"):
        if getattr(shaft, name) is not None:
            yield Problem(f"{path}", _("a tube with a profile has no {name}").format(name=name), "inconsistent")


def _crack(shaft: Shaft, joints: int, length: dict[int, float], path: str) -> Iterator[Problem]:
    """Yield what contradicts itself in a crack."""
    crack = shaft.crack
    if crack is None:
        return
    if bool(crack.losses) == (crack.depth_ratio is not None):
        yield Problem(f"{path}.crack", _("give either its losses or its depth_ratio"), "inconsistent")
    if crack.losses and len(crack.losses) != 2:
        yield Problem(f"{path}.crack.losses", _("needs two shares, along the crack and across it"), "inconsistent")
    if any(not 0.0 <= one < 1.0 for one in crack.losses):
        yield Problem(f"{path}.crack.losses", _("needs to be at least 0 and below 1"), "out_of_range")
    yield from place_problems(shaft.number, crack.position, joints, length, f"{path}.crack")


def _spline(shaft: Shaft, joints: int, length: dict[int, float], path: str) -> Iterator[Problem]:
    spline = shaft.spline
    if spline is None:
        return
    if spline.friction is not None and spline.pitch_diameter is None:
        text = _("missing: friction acts at the mean diameter of the teeth; or give outer and root")
        yield Problem(f"{path}.mean_diameter", text)
    if spline.friction is None:
        for name, there in (("sliding", spline.sliding != "both"), ("pressure_angle", spline.pressure_angle != 0.0)):
            if there:
                yield Problem(f"{path}.{name}", _("counts only with friction, which is not given"))
    yield from place_problems(shaft.number, spline.position, joints, length, path)


def _support(support: Support, joints: int, length: dict[int, float], path: str) -> Iterator[Problem]:
    yield from place_problems(support.shaft, support.position, joints, length, path)
    if not (support.radial or support.axial or support.tilt):
        yield Problem(f"{path}.radial", _("a support that holds neither radial nor axial nor tilt is none"))
    for name, needs, there in (
        ("stiffness", "radial", support.radial),
        ("axial_stiffness", "axial", support.axial),
        ("tilt_stiffness", "tilt", support.tilt),
    ):
        if getattr(support, name) is not None and not there:
            yield Problem(f"{path}.{name}", _("counts only with {needs} = true").format(needs=needs))
    if support.friction is not None and support.bore is None and not support.bearing:
        yield Problem(f"{path}.bore", _("missing: friction acts at the bore"))
    if (support.seals > 1 or support.max_lip_speed is not None) and support.seal_diameter is None and not support.seal:
        yield Problem(f"{path}.seal_diameter", _("missing: seals rub on the shaft under their lips"))


def _binding(support: Support, joints: Sequence[Joint], path: str) -> Iterator[Problem]:
    """Yield that a support keeps an output shaft from pivoting where its joint says that it does."""
    place = joints[-1].held(None) if joints[-1].felt_beyond else None
    if support.shaft != len(joints) + 1 or place is None:
        return
    if support.hinders(float(place)):
        text = _("shaft {shaft} pivots {place:.6g} mm behind joint {joint}: it binds here")
        said = text.format(shaft=support.shaft, joint=len(joints), place=float(place) / mm)
        yield Problem(f"{path}.position", said, "inconsistent")


def place_problems(
    number: int, position: float | None, joints: int, length: dict[int, float], path: str
) -> Iterator[Problem]:
    """Yield a shaft that is not there, and a place that is not on it."""
    if number > joints + 1:
        text = _("there is no shaft {number}; the shafts are 1 to {last}")
        yield Problem(f"{path}.shaft", text.format(number=number, last=joints + 1))
    elif position is None:
        return
    elif number == 1:
        if position > 0.0:
            text = _("{position:.6g} mm lies behind joint 1; on the input shaft positions are zero or negative")
            yield Problem(f"{path}.position", text.format(position=position / mm))
    elif not inside(position, length.get(number)):
        yield Problem(f"{path}.position", outside(position, number, length.get(number)))


def inside(position: float, length: float | None) -> bool:
    """Tell whether a place lies on a shaft behind a joint, whose length may not be known."""
    if length is None:
        return not position < 0.0
    return not (position < 0.0 or position > length * (1.0 + ROUNDING))


def outside(position: float, number: int, length: float | None) -> str:
    """Return what to say of a place that does not lie on its shaft."""
    if length is None:
        text = _("{position:.6g} mm is outside shaft {number}, which begins at 0")
        return text.format(position=position / mm, number=number)
    text = _("{position:.6g} mm is outside shaft {number}, which reaches from 0 to {length:.6g} mm")
    return text.format(position=position / mm, number=number, length=length / mm)
