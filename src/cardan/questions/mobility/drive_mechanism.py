"""A drive as links and pairs: its shafts, the crosses of its joints, its splines and its supports."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.fields.parts import known_lengths
from cardan.drive.joints.common.inner import DRIVEN, DRIVING, Stance
from cardan.drive.models.geometry import Geometry, geometry
from cardan.drive.models.machine_held import machine_held
from cardan.drive.support import Support
from cardan.errors import Problem, check
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
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


def mechanism_of(drive: Drive, angle: float = 0.0) -> Mechanism:
    """Return a drive as a mechanism.

    drive: with its supports, its end shafts held by their machines where they have none; angle [rad]: input angle φ_1
    from the start position.
    Returns Mechanism: links: the frame, the shafts (two parts where a spline slides), the crosses. Joints: pins,
    splines, supports.
    A radial support is a sphere in a cylinder (SG), with an axial hold a sphere (S), with a hold against tilting a
    cylinder or hinge (C, R). A cross has hinges, or cylinders along journals that slide. Joints of other kinds stand as
    pairs that turn about two axes of the bisecting plane, unless they slide as well or hold nothing but the torque.
    """
    check(_problems(drive))
    drive = machine_held(drive)
    place = geometry(drive)
    driving, driven = marks(drive, place, angle)
    joints = list(_joints(drive, place, driving, driven))
    for number, shaft in enumerate(drive.shafts, 1):
        if shaft.spline is not None:
            at = _spline_place(drive, place, number)
            point = _row(_start(place, number) + at * place.axis[number - 1])
            name = _("spline of shaft {number}").format(number=number)
            joints.append(_pair(name, "P", (_front(number), _rear(number)), point, place.axis[number - 1]))
    for k, support in enumerate(drive.supports):
        joints += _support(drive, place, support, k)
    return Mechanism(
        name=drive.name,
        frame=_(FRAME),
        input_link=_front(1) if _splined(drive, 1) else _whole(1),
        output_link=_end_link(drive, len(drive.joints) + 1, last=True),
        joints=tuple(joints),
    )


def support_name(drive: Drive, index: int) -> str:
    """Return what the joint of a support, counted from 0, is called."""
    name = drive.supports[index].name
    text = _("support {number}").format(number=index + 1)
    return f"{text} ({name})" if name else text


def marks(drive: Drive, place: Geometry, angle: float) -> tuple[Array, Array]:
    """Return the directions of the driving and the driven mark of every joint, arrays (n, 3).

    u_1 = rot(a_1, φ_1+ψ_1)(N_1 × a_1); a cross holds v = unit(a_{i+1} × u), any other joint carries its mark around the
    normal of its plane by the joint angle; u_{i+1} = rot(a_{i+1}, -γ) v.
    """
    axis, normal = place.axis, place.normal
    turn = np.asarray(angle + drive.input.start_phase)
    mark = frames.rotate(frames.cross(normal[0], axis[0]), axis[0], turn)
    driving, driven = [], []
    for i, joint in enumerate(drive.joints):
        driving.append(mark)
        if joint.crossed:
            arm = frames.unit(frames.cross(axis[i + 1], mark))
        else:
            arm = frames.rotate(mark, normal[i], np.asarray(place.joint_angle[i]))
        driven.append(arm)
        mark = frames.rotate(arm, axis[i + 1], np.asarray(-drive.shafts[i + 1].yoke_angle))
    return np.asarray(driving), np.asarray(driven)


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


def _start(place: Geometry, number: int) -> Array:
    """Return the point from which positions on a shaft count: the joint before it, on shaft 1 joint 1."""
    return place.points[1] if number == 1 else place.points[number - 1]


def _spline_place(drive: Drive, place: Geometry, number: int) -> float:
    spline = drive.shafts[number - 1].spline
    if spline is not None and spline.position is not None:
        return spline.position
    half = 0.5 * float(place.length[number - 1])
    return -half if number == 1 else half


def _row(vector: Array) -> Point:
    x, y, z = (float(one) for one in vector)
    return x, y, z


def _pair(name: str, kind: str, links: tuple[str, str], point: Point, axis: Array, second: Array | None = None) -> Pair:
    return Pair(
        id=name,
        type=kind,
        links=links,
        point=point,
        axis=_row(axis),
        axis2=None if second is None else _row(second),
    )


def _joints(drive: Drive, place: Geometry, driving: Array, driven: Array) -> Iterator[Pair]:
    """Yield the pairs of all joints in the order of the power flow."""
    for i, joint in enumerate(drive.joints):
        ends = {DRIVING: _end_link(drive, i + 1, last=True), DRIVEN: _end_link(drive, i + 2, last=False)}
        stance = Stance(
            centre=place.points[i + 1],
            before=place.axis[i],
            after=place.axis[i + 1],
            normal=place.normal[i],
            joint_angle=float(place.joint_angle[i]),
            driving=driving[i],
            driven=driven[i],
            length=float(place.length[i + 1]),
        )
        for one in joint.inner(stance):
            first, second = (ends.get(link) or _(link).format(number=i + 1) for link in one.links)
            name = _(one.name).format(number=i + 1)
            yield _pair(name, one.type, (first, second), _row(one.point), one.axis, one.second)


def _support(drive: Drive, place: Geometry, support: Support, index: int) -> Iterator[Pair]:
    """Yield the pair of a support; none where it holds nothing."""
    number = support.shaft
    axis = place.axis[number - 1]
    point = _row(_start(place, number) + support.position * axis)
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
