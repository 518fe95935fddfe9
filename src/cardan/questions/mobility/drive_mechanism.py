"""A drive as links and pairs: its shafts, the crosses of its joints, its splines and its supports."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.fields.parts import known_lengths, spline_place
from cardan.drive.joints.common.inner import DRIVEN, DRIVING, Stance
from cardan.drive.models.geometry import Geometry, geometry
from cardan.drive.models.machine_held import balls_of, machine_held
from cardan.drive.models.wobble import Course, course
from cardan.drive.support import Support
from cardan.errors import Problem, check, refuse
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames, screws
from cardan.mechanism.constraints import constraints
from cardan.mechanism.mechanism import Mechanism, Pair, Point
from cardan.texts import _

SUPPORT: dict[tuple[bool, bool, bool], str] = {
    (True, False, False): "SG",
    (True, True, False): "S",
    (True, False, True): "C",
    (True, True, True): "R",
    (False, True, False): "PT",
    (False, True, True): "E",
}
"""What a support holds, radial, axial and against tilting -> kind of pair along the shaft."""

FRAME = "frame"

ACROSS = 1e-7
"""Share of a motion below which it is rounding."""


def mechanism_of(drive: Drive, angle: float = 0.0) -> Mechanism:
    """Return a drive as a mechanism.

    drive: with its supports, its end shafts held by their machines where they have none; angle [rad]: input angle φ_1
    from the start position.
    Returns Mechanism: links: the frame, the shafts (two parts where a spline slides), the crosses. Joints: pins,
    splines, supports.
    A radial support is a sphere in a cylinder (SG), with an axial hold a sphere (S), with a hold against tilting a
    cylinder or hinge (C, R). Joints stand with their inner mechanism, with the first of parts alike that hold the same.
    """
    check(_problems(drive))
    balls, drive = balls_of(drive, pivots=True), machine_held(drive)
    place, known = geometry(drive), course(drive, np.asarray([angle]), still=True)
    starts = (place.points[1], *known.start[:, 0])
    lying = [_Line(start, axis) for start, axis in zip(starts, known.axis[:, 0], strict=True)]
    joints = list(_joints(drive, place, known))
    for number, shaft in enumerate(drive.shafts, 1):
        if shaft.spline is not None:
            along, at = lying[number - 1].axis, _spline_place(drive, place, number)
            name = _("spline of shaft {number}").format(number=number)
            joints.append(
                _pair(name, "P", (_front(number), _rear(number)), _at(drive, place, lying, number, at), along)
            )
    for i, reach in balls.items():
        along, slides = lying[i + 1].axis, drive.joints[i].slides
        links = _(FRAME), _end_link(drive, i + 2, last=False)
        name = _("ball behind joint {number}").format(number=i + 1)
        point = _row(place.points[i + 1] + reach * place.axis[i + 1])
        joints.append(_pair(name, "S" if slides else "SG", links if slides else links[::-1], point, along))
    for k, support in enumerate(drive.supports):
        if support.shaft - 2 not in balls:
            joints += _support(drive, place, lying, support, k)
    return Mechanism(
        name=drive.name,
        frame=_(FRAME),
        input_link=_input_link(drive),
        output_link=_end_link(drive, len(drive.joints) + 1, last=True),
        joints=tuple(joints),
    )


def _input_link(drive: Drive) -> str:
    """Return the part of the first shaft that is driven: where a support holds it."""
    if not _splined(drive, 1):
        return _whole(1)
    cut = _spline_place(drive, geometry(drive), 1)
    front = any(one.position < cut for one in drive.supports if one.shaft == 1)
    return _front(1) if front else _rear(1)


def support_name(drive: Drive, index: int) -> str:
    """Return what the joint of a support, counted from 0, is called."""
    name = drive.supports[index].name
    text = _("support {number}").format(number=index + 1)
    return f"{text} ({name})" if name else text


@dataclass(frozen=True, eq=False, slots=True)
class _Line:
    """Where a shaft lies."""

    start: Array  # (3,) [m]
    axis: Array  # (3,)

    def nearest(self, point: Array) -> Point:
        """Return the place on it that is nearest to a point (3,) [m]."""
        return _row(self.start + ((point - self.start) @ self.axis) * self.axis)


def _problems(drive: Drive) -> Iterator[Problem]:
    if not drive.supports:
        text = _("missing; whether a drive binds comes from how its shafts are held")
        yield Problem("supports", text, "missing")
        return
    known = known_lengths(drive)
    for number in range(2, len(drive.joints) + 1):
        if number not in known:
            yield Problem(f"shafts[{number - 1}].length", _("missing; where the joints lie follows from it"), "missing")


def _whole(number: int) -> str:
    return _("shaft {number}").format(number=number)


def _front(number: int) -> str:
    return _("shaft {number} up to its spline").format(number=number)


def _rear(number: int) -> str:
    return _("shaft {number} behind its spline").format(number=number)


def _splined(drive: Drive, number: int) -> bool:
    return drive.shafts[number - 1].spline is not None


def _end_link(drive: Drive, number: int, *, last: bool) -> str:
    """Return the link that stands for the first or last part of a shaft."""
    if not _splined(drive, number):
        return _whole(number)
    return _rear(number) if last else _front(number)


def _at(drive: Drive, place: Geometry, lying: Sequence[_Line], number: int, position: float) -> Point:
    """Return the place on a shaft at a position from the joint before it, on shaft 1 from joint 1."""
    start = place.points[1] if number == 1 else place.points[number - 1]
    return lying[number - 1].nearest(start + position * place.axis[number - 1])


def _spline_place(drive: Drive, place: Geometry, number: int) -> float:
    return spline_place(drive, number, float(place.length[number - 1]))


def _row(vector: Array) -> Point:
    x, y, z = (float(one) for one in vector)
    return x, y, z


def _pair(name: str, kind: str, links: tuple[str, str], point: Point, axis: Array, second: Array | None = None) -> Pair:
    return Pair(
        id=name, type=kind, links=links, point=point, axis=_row(axis), axis2=None if second is None else _row(second)
    )


def _joints(drive: Drive, place: Geometry, known: Course) -> Iterator[Pair]:
    """Yield the pairs of all joints in the order of the power flow."""
    for i in range(len(drive.joints)):
        ends = {DRIVING: _end_link(drive, i + 1, last=True), DRIVEN: _end_link(drive, i + 2, last=False)}
        yield from _inside(drive, place, known, i, ends)


def _inside(drive: Drive, place: Geometry, known: Course, i: int, ends: Mapping[str, str]) -> Iterator[Pair]:
    """Yield the pairs of joint i, from 0; ends: its shafts -> names of links."""
    stance = Stance(
        centre=known.centre[i, 0],
        before=known.axis[i, 0],
        after=known.axis[i + 1, 0],
        normal=place.normal[i],
        joint_angle=float(known.joint_angle[i, 0]),
        driving=known.driving[i, 0],
        driven=known.driven[i, 0],
        length=float(place.length[i + 1]),
    )
    joint = drive.joints[i]
    pairs = [one for one in (*joint.mechanism(stance), *joint.centring(stance)) if not one.repeats]
    if not all(np.all(np.isfinite(one.point)) for one in pairs):
        raise refuse(f"joints[{i}].joint_angle", joint.stuck(float(stance.joint_angle)), "out_of_range")
    for one in pairs:
        first, second = (ends.get(link) or _(link).format(number=i + 1, count=one.count) for link in one.links)
        name = _(one.name).format(number=i + 1, count=one.count)
        yield _pair(name, one.type, (first, second), _row(one.point), one.axis, one.second)


def unheld(drive: Drive) -> tuple[int, ...]:
    """Return the joints, from 0, that let their driven shaft move across their driving one, turned about itself alone.

    Such a shaft stands where its own bearings hold it, not where the joint is. Shafts that slide along one of them, or
    along a direction between both, are held across.
    """
    found = []
    centres = geometry(drive).points[1:-1]
    for i, (twists, axes) in enumerate(_freed(drive)):
        turning = twists[:, :3]
        aside = frames.perpendicular(axes[1])
        still = screws.null_spaces(np.stack((turning @ aside, turning @ frames.cross(axes[1], aside))))[2]
        shifts = twists[:, 3:] + frames.cross(turning, centres[i] + 0.0 * turning)
        _left, size, ways = np.linalg.svd(still @ shifts)
        middle = frames.unit(np.sum(axes, axis=0))
        count = int(np.sum(size > ACROSS))
        if count > 1 or (count and abs(ways[0] @ middle) < axes[0] @ middle - ACROSS):
            found.append(i)
    return tuple(found)


def joint_freedoms(drive: Drive) -> tuple[int, ...]:
    """Return in how many ways each joint lets its driven shaft move against its driving one."""
    return tuple(len(screws.independent(twists)) for twists, _along in _freed(drive))


def _freed(drive: Drive) -> Iterator[tuple[Array, Array]]:
    """Yield the motions (m, 6) of its driven against its driving shaft that each joint leaves, and both axes (2, 3)."""
    place, known = geometry(drive), course(drive, np.zeros(1), still=True)
    for i in range(len(drive.joints)):
        pairs = tuple(_inside(drive, place, known, i, {DRIVING: DRIVING, DRIVEN: DRIVEN}))
        inner = Mechanism(frame=DRIVING, output_link=DRIVEN, joints=pairs)
        motions = screws.null_spaces(constraints(inner).matrix())[2]
        yield motions.reshape(len(motions), -1, 6)[:, inner.links.index(DRIVEN)], known.axis[i : i + 2, 0]


def _support(drive: Drive, place: Geometry, lying: Sequence[_Line], support: Support, index: int) -> Iterator[Pair]:
    """Yield the pair of a support; none where it holds nothing."""
    number = support.shaft
    axis, point = lying[number - 1].axis, _at(drive, place, lying, number, support.position)
    link = _whole(number)
    if _splined(drive, number):
        link = _front(number) if support.position < _spline_place(drive, place, number) else _rear(number)
    holds = (support.radial, support.axial, support.tilt)
    name = support_name(drive, index)
    kind = SUPPORT.get(holds)
    if kind is not None:
        pair = _pair(name, kind, (_(FRAME), link), point, axis)
        yield _with_offset(pair, support)
    elif support.tilt:  # it holds the slope alone: free along and across
        part = _("ring of {support}").format(support=name)
        yield _pair(_("slide of {support}").format(support=name), "P", (_(FRAME), part), point, axis)
        yield _with_offset(_pair(name, "E", (part, link), point, axis), support)


def _with_offset(pair: Pair, support: Support) -> Pair:
    return replace(pair, misalignment=support.offset)
