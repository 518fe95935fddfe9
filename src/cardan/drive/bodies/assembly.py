"""A whole drive as bodies and tracks: joints, shafts, supports and the masses that its file places."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from cardan.answers.quantity import Text, say
from cardan.drive.body import body_length
from cardan.drive.drive import Drive
from cardan.drive.fields.parts import known_lengths
from cardan.drive.joints import ConstantVelocity
from cardan.drive.joints.common.drawn import length_text
from cardan.drive.models.chain import Chain, given_chain
from cardan.drive.models.geometry import Geometry, geometry, geometry_from_points
from cardan.drive.shapes.ring import disc, flange, ring, washer
from cardan.drive.shapes.support import bearing, bracket, floor_frame, rubber
from cardan.drive.station import Station
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.maths.kernel.meshes import placed
from cardan.texts import _

from .build import Build, Track
from .shaft import shaft_pieces, shaft_stretches
from .sizes import bearing_radius, sizes
from .solids import Arms, arms

FRAMES = 120
"""Places of a turn."""

STEEL = 7850.0
"""Density of the discs that stand for moments of inertia [kg/m³]."""


def assembled(
    drive: Drive, *, count: int = FRAMES, points: Array | None = None, drawn: Geometry | None = None
) -> Build:
    """Return a drive as bodies, each with the track it moves along over one turn of the input.

    drive: its sizes filled in from the catalogue; count: places of the turn, evenly by the input angle.
    points (n+2, 3) [m]: where the points of the drive are meanwhile; as drawn when not given.
    drawn: where its rigid parts were measured, where that is another pose of it.
    Returns Build: rigid parts keep their lengths; a slip spline takes up the difference.
    """
    here = geometry(drive)
    place = here if points is None else moved(here, points)
    drawn = here if drawn is None else drawn
    angle = np.arange(count) * (2.0 * np.pi / count)
    found = standing(drive, here, place, angle)
    build = Build(drive=drive, place=place, drawn=drawn, sizes=sizes(drive, drawn), arms=found)
    still = np.zeros((count, 4))
    still[:, 3] = 1.0
    build.tracks.append(Track(origin=np.zeros(3), turn=still))
    _shaft_tracks(build)
    for k in range(1, build.count + 2):
        _shaft(build, k)
    for i, joint in enumerate(drive.joints):
        joint.solid(build.site(i))
    for number in range(len(drive.supports)):
        _support(build, number)
    for number in range(len(drive.stations)):
        _station(build, number)
    return build


def moved(drawn: Geometry, points: Array) -> Geometry:
    """Return where a drive lies whose points have moved; straight joints keep the planes they were drawn with."""
    found = geometry_from_points(np.asarray(points, dtype=float))
    if np.any(found.joint_angle == 0.0):
        kept = [
            frames.unit(normal - (normal @ axis) * axis) if joint_angle == 0.0 else own
            for normal, axis, own, joint_angle in zip(
                drawn.normal, found.axis[1:], found.normal, found.joint_angle, strict=True
            )
        ]
        return replace(found, normal=np.stack(kept))
    return found


def standing(drive: Drive, drawn: Geometry, place: Geometry, angle: Array) -> Arms:
    """Return the directions of all arms at input angles; the first yoke stays where it was drawn while points move.

    drawn, place: where it was drawn, and where it is; angle (p,) [rad].
    """
    train = given_chain(drive)
    if place is not drawn:
        start = frames.rotate(np.cross(drawn.normal[0], drawn.axis[0]), drawn.axis[0], train.start_phase)
        axis = place.axis[0]
        start = frames.unit(start - (start @ axis) * axis)
        phase = frames.angle_about(axis, np.cross(place.normal[0], axis), start)
        train = Chain(
            joint_angle=place.joint_angle,
            plane_twist=place.plane_twist,
            yoke_angle=train.yoke_angle,
            start_phase=np.asarray(phase),
        )
    with np.errstate(invalid="ignore", divide="ignore"):
        found = arms(place, train, angle, drive.joints)
    if np.all(np.isfinite(found.driven)):
        return found
    return arms(place, train, angle, [joint if joint.crossed else ConstantVelocity() for joint in drive.joints])


def turns(drive: Drive, build: Build) -> Iterator[int]:
    """Yield the joints, from 0, that do not turn at their joint angle with the sizes they are given."""
    for i, joint in enumerate(drive.joints):
        with np.errstate(invalid="ignore", divide="ignore"):
            angle_error = joint.deviation(np.linspace(0.0, 6.0, 7), np.asarray(build.place.joint_angle[i]))[0]
        if not np.all(np.isfinite(angle_error)):
            yield i


def _shaft_tracks(build: Build) -> None:
    """Add two tracks for each shaft between joints, of its start and of its end: in torsion they turn apart."""
    for k in range(1, build.count + 2):
        axis = build.axis(k)
        if k > 1:
            origin, along = build.drive.joints[k - 2].shaft_behind(build.stance(k - 2))
            build.starts[k] = build.along(origin, along, build.arms.driven[k - 2])
        if k <= build.count:
            build.ends[k] = build.along(build.centre(k - 1), axis, build.arms.driving[k - 1])


def extent(build: Build, k: int) -> tuple[float, float]:
    """Return where shaft k, from 1, is drawn: from the joint before it, on shaft 1 from joint 1 [m]."""
    first, last = build.sizes.ends
    return (-first if k == 1 else 0.0), (
        0.0 if k == 1 else last if k > build.count else float(build.drawn.length[k - 1])
    )


def _shaft(build: Build, k: int) -> None:
    shaft = build.drive.shafts[k - 1]
    between = 1 < k <= build.count
    known = known_lengths(build.drive).get(k)
    low, high = extent(build, k)
    start = low if k == 1 else build.reach(k - 2, driving=False)
    slides = shaft.spline is not None
    drawn = float(build.drawn.length[k - 1])
    length = drawn if slides or not between else float(build.place.length[k - 1])
    high = high if not between or slides else length
    stop = high - build.reach(k - 1, driving=True) if k <= build.count else high
    solid = build.sizes.solid[k - 1]
    radius = build.body_radius(k)
    necks = [
        (one.position, bearing_radius(one, radius, solid=solid or between))
        for one in build.drive.supports
        if one.shaft == k
    ]
    body = length if between else body_length(shaft, known)
    path, role = f"shafts[{k - 1}]", f"shaft {k}"
    stretches = shaft_stretches(shaft, start, stop, body, radius, necks)
    build.profiles[k] = stretches[0].outer, stretches[-1].outer
    for piece in shaft_pieces(shaft, start, stop, radius, stretches):
        first = k > 1 and piece.first
        track = build.starts[k] if first or k > build.count else build.ends[k]
        shift = 0.0 if first or k in (1, build.count + 1) else -length
        surface = placed(piece.surface, None, (shift, 0.0, 0.0))
        toothed = piece.part != "tube"
        said = _spline_text(build, k) if toothed else _tube_text(build, k)
        where = f"{path}.spline" if toothed else path
        build.add(piece.part, k, where, said, track, surface, role=role, shade=0.0 if toothed else 0.4)
    for place, thin in necks:
        if build.drive.supports and thin > 0.0 and _axial_at(build, k, place):
            collars = (
                placed(washer(0.9 * thin, 1.16 * thin, 0.25 * thin), None, (place + d * 0.75 * thin, 0, 0))
                for d in (1, -1)
            )
            track = build.ends[1] if k == 1 else build.starts[k]
            build.add("collar", k, path, _tube_text(build, k), track, *collars, role=role, shade=0.2)
    if not between and not any(one.shaft == k and _at_free_end(build, one, k) for one in build.drive.stations):
        end, sense, text = (low, 1.0, _("input end")) if k == 1 else (high, -1.0, _("output end"))
        track = build.twin(build.ends[1] if k == 1 else build.starts[k])
        build.free[k] = track
        path = "input" if k == 1 else "output"
        build.add(
            "flange",
            k,
            path,
            text,
            track,
            placed(flange(radius, sense), None, (end - 0.05 * sense * radius, 0, 0)),
            role=role,
            shade=0.2,
        )


def _axial_at(build: Build, k: int, place: float) -> bool:
    return any(one.axial for one in build.drive.supports if one.shaft == k and one.position == place)


def _tube_text(build: Build, k: int) -> Text:
    shaft = build.drive.shafts[k - 1]
    name = _("shaft {number}").format(number=k) + (f", {shaft.name}" if shaft.name else "")
    if shaft.outer is not None and shaft.wall is not None:
        outer, wall = length_text(shaft.outer), length_text(shaft.wall)
        return say(_("{shaft}: tube {outer:bare} × {wall}"), shaft=name, outer=outer, wall=wall)
    if shaft.outer is not None:
        return say(_("{shaft}: outer diameter {size}"), shaft=name, size=length_text(shaft.outer))
    if shaft.segments:
        return _("{shaft}: stretches as the file gives them").format(shaft=name)
    return _("{shaft}; the file gives no body, so its size is assumed").format(shaft=name)


def _spline_text(build: Build, k: int) -> str:
    spline = build.drive.shafts[k - 1].spline
    assert spline is not None
    if spline.teeth is None:
        return _("slip spline of shaft {number}").format(number=k)
    return _("slip spline of shaft {number}, {teeth} teeth").format(number=k, teeth=spline.teeth)


def _support(build: Build, number: int) -> None:
    one = build.drive.supports[number]
    k = one.shaft
    axis = build.axis(k)
    joint = build.centre(max(k - 2, 0))
    middle = joint + one.position * axis + np.asarray(one.offset)
    solid = build.sizes.solid[k - 1] or 1 < k <= build.count
    radius = bearing_radius(one, build.body_radius(k), solid=solid)
    gravity = np.asarray(build.drive.settings.gravity)
    frame = floor_frame(axis, gravity)
    name = one.name or _("support {number}").format(number=number + 1)
    text = _("{name}, on shaft {shaft}").format(name=name, shaft=k)
    path, soft = f"supports[{number}]", one.stiffness is not None
    parts = [("bearing", bearing(radius, wide=one.tilt), "cross", 0.25, True)]
    if soft:
        parts.append(("rubber", rubber(radius, wide=one.tilt), "ink", 0.12, False))
    parts.append(("support", bracket(radius, soft=soft, wide=one.tilt, axial=one.axial), "muted", 0.25, True))
    for part, shape, role, shade, metal in parts:
        build.add(part, number + 1, path, text, 0, placed(shape, frame, middle), role=role, shade=shade, metal=metal)


def _at_free_end(build: Build, station: Station, k: int) -> bool:
    """Tell whether a station stands at the free end of an end shaft: it says so, or it says no place at all."""
    if station.shaft != k or 1 < k <= build.count:
        return False
    if station.end is not None:
        return station.end == ("start" if k == 1 else "end")
    return station.position is None and all(one.position is None for one in build.drive.stations if one.shaft == k)


def _station(build: Build, number: int) -> None:
    """Add a station as a disc of steel with its moment of inertia, where the file says or implies its place."""
    one = build.drive.stations[number]
    k = one.shaft
    low, high = extent(build, k)
    shaft_radius, most = build.body_radius(k), 5.5 * build.sizes.usual
    thick = 0.0
    if one.position is not None:
        place = one.position
    elif _at_free_end(build, one, k):
        before = [s for s in build.drive.stations[:number] if _at_free_end(build, s, k)]
        step = 1.1 * build.sizes.usual * len(before)
        place = low + step if k == 1 else high - step
    else:
        return
    radius = (8.0 * one.inertia / (STEEL * np.pi)) ** 0.2 if one.inertia > 0.0 else 1.4 * shaft_radius
    radius = max(min(radius, most), 1.7 * shaft_radius)
    thick = min(0.3 * radius, 0.9 * build.sizes.usual)
    name = one.name or _("station {number}").format(number=number + 1)
    text = (
        name
        if one.inertia == 0.0
        else _("{name}: {inertia} kg m², as a disc of steel").format(name=name, inertia=f"{one.inertia:.4g}")
    )
    track = build.twin(build.ends[1] if k == 1 else build.starts[k])
    build.stations[number] = track
    path, role = f"stations[{number}]", f"shaft {k}"
    shape = placed(disc(radius, thick, shaft_radius, 6), None, (place, 0.0, 0.0))
    build.add("station", k, path, text, track, shape, role=role, shade=0.15)
    if one.absorber is not None:
        side = -1.0 if k == 1 else 1.0
        at = (place - 0.72 * side * thick, 0.0, 0.0)
        springy = one.absorber.stiffness > 0.0
        layer = ring(0.52 * radius, 0.66 * radius, 0.5 * thick)
        said = _("absorber on {name}") if springy else _("damper on {name}")
        build.add(
            "absorber",
            k,
            f"{path}.absorber",
            said.format(name=name),
            track,
            placed(layer, None, at),
            role="ink",
            metal=False,
        )
        outer = ring(0.66 * radius, 0.86 * radius, 0.52 * thick)
        build.add(
            "absorber", k, f"{path}.absorber", said.format(name=name), track, placed(outer, None, at), role="cross"
        )
    if one.pendulum is not None:
        heads = []
        count = one.pendulum.count
        far = min(one.pendulum.radius, 0.8 * radius)
        weight = ring(0.0 + 1e-4 * radius, 0.16 * radius, 1.5 * thick, 18)
        for j in range(count):
            turn = 2.0 * np.pi * j / count
            heads.append(placed(weight, None, (place, far * np.cos(turn), far * np.sin(turn))))
        build.add(
            "absorber", k, f"{path}.pendulum", _("pendulums on {name}").format(name=name), track, *heads, role="cross"
        )
