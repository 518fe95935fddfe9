"""A whole drive as bodies and tracks: joints, shafts, supports and the masses that its file places."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise

import numpy as np

from cardan.answers.quantity import Text, say
from cardan.drive.body import body_length, pieces
from cardan.drive.drive import Drive
from cardan.drive.fields.parts import known_lengths
from cardan.drive.joints.common.site import length_text
from cardan.drive.joints.constant_velocity import ConstantVelocity
from cardan.drive.models.geometry import Geometry, geometry, geometry_from_points
from cardan.drive.models.kinematics_model import given_chain
from cardan.drive.models.wobble import Course, course
from cardan.drive.shaft import Shaft, Spline
from cardan.drive.shapes import ACROSS, bearing, bracket, disc, flange, floor_frame, ring, rubber, washer
from cardan.drive.station import Station
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.maths.kernel.meshes import Surface, joined, placed, plate, revolved, toothed
from cardan.texts import _

from .build import Build, Track
from .sizes import bearing_radius, sizes
from .solids import Arms, arms

FRAMES = 120  # places of a turn
STEEL = 7850.0  # density of the discs that stand for moments of inertia [kg/m³]


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
    found, lying = standing(drive, here, place, angle)
    build = Build(drive=drive, place=place, drawn=drawn, sizes=sizes(drive, drawn), arms=found, lying=lying)
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


def standing(drive: Drive, drawn: Geometry, place: Geometry, angle: Array) -> tuple[Arms, Course | None]:
    """Return the directions of all arms at input angles, and where shafts lie if any wobbles.

    The first yoke stays where it was drawn while points move.

    drawn, place: where it was drawn, and where it is; angle (p,) [rad].
    """
    train = given_chain(drive)
    if place is not drawn:
        start = frames.rotate(np.cross(drawn.normal[0], drawn.axis[0]), drawn.axis[0], train.start_phase)
        axis = place.axis[0]
        start = frames.unit(start - (start @ axis) * axis)
        phase = frames.angle_about(axis, np.cross(place.normal[0], axis), start)
        train = replace(
            train, joint_angle=place.joint_angle, plane_twist=place.plane_twist, start_phase=np.asarray(phase)
        )
    with np.errstate(invalid="ignore", divide="ignore"):
        if any(joint.wobbles for joint in drive.joints):
            lying = course(drive, angle, place, phase=float(train.start_phase))
            if np.all(np.isfinite(lying.driven)):
                return Arms(driving=lying.driving, driven=lying.driven), lying
        found = arms(place, train, angle, drive.joints)
    if np.all(np.isfinite(found.driven)):
        return found, None
    return arms(place, train, angle, [joint if joint.crossed else ConstantVelocity() for joint in drive.joints]), None


def turns(drive: Drive, build: Build) -> Iterator[int]:
    """Yield the joints, from 0, that do not turn at their joint angle with the sizes they are given."""
    for i, joint in enumerate(drive.joints):
        with np.errstate(invalid="ignore", divide="ignore"):
            angle_error = joint.deviation(np.linspace(0.0, 6.0, 7), np.asarray(build.place.joint_angle[i]))[0]
        if not np.all(np.isfinite(angle_error)):
            yield i


def _shaft_tracks(build: Build) -> None:
    """Add two tracks for each shaft between joints, of its start and of its end: in torsion they turn apart."""
    lying = build.lying
    for k in range(1, build.count + 2):
        axis = build.axis(k) if lying is None else lying.axis[k - 1]
        if k > 1:
            origin = build.centre(k - 2) if lying is None else lying.start[k - 2]
            build.starts[k] = build.along(origin, axis, build.arms.driven[k - 2])
        if k <= build.count:
            centre = build.centre(k - 1) if lying is None else lying.centre[k - 1]
            build.ends[k] = build.along(centre, axis, build.arms.driving[k - 1])


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
    axial = {one.position for one in build.drive.supports if one.shaft == k and one.axial}
    for place, thin in necks:
        if thin > 0.0 and place in axial:
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
        shape = placed(flange(radius, sense), None, (end - 0.05 * sense * radius, 0, 0))
        build.add("flange", k, path, text, track, shape, role=role, shade=0.2)


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
    text = name
    if one.inertia != 0.0:
        text = _("{name}: {inertia} kg m², as a disc of steel").format(name=name, inertia=f"{one.inertia:.4g}")
    track = build.twin(build.ends[1] if k == 1 else build.starts[k])
    build.stations[number] = track
    path, role = f"stations[{number}]", f"shaft {k}"
    shape = placed(disc(radius, thick, shaft_radius, 6), None, (place, 0.0, 0.0))
    build.add("station", k, path, text, track, shape, role=role, shade=0.15)
    if one.absorber is not None:
        side = -1.0 if k == 1 else 1.0
        at = (place - 0.72 * side * thick, 0.0, 0.0)
        springy = one.absorber.stiffness > 0.0
        said = (_("absorber on {name}") if springy else _("damper on {name}")).format(name=name)
        layer, outer = ring(0.52 * radius, 0.66 * radius, 0.5 * thick), ring(0.66 * radius, 0.86 * radius, 0.52 * thick)
        for shape, role, metal in ((layer, "ink", False), (outer, "cross", True)):
            build.add("absorber", k, f"{path}.absorber", said, track, placed(shape, None, at), role=role, metal=metal)
    if one.pendulum is not None:
        far = min(one.pendulum.radius, 0.8 * radius)
        weight = ring(1e-4 * radius, 0.16 * radius, 1.5 * thick, 18)
        places = [2.0 * np.pi * j / one.pendulum.count for j in range(one.pendulum.count)]
        heads = [placed(weight, None, (place, far * np.cos(turn), far * np.sin(turn))) for turn in places]
        said = _("pendulums on {name}").format(name=name)
        build.add("absorber", k, f"{path}.pendulum", said, track, *heads, role="cross")


# Tubes, stubs, slip splines, flanges and what else a shaft carries between its yokes.

SHOWN_TEETH = 40  # teeth of a spline that are drawn at most


@dataclass(frozen=True, kw_only=True, slots=True)
class Stretch:
    """A piece of a shaft with one cross section, along the shaft [m]."""

    start: float
    stop: float
    outer: float
    inner: float = 0.0


@dataclass(frozen=True, kw_only=True, slots=True)
class Slip:
    """Where a slip spline stands along its shaft [m], and which way it is put together."""

    start: float  # start, stop: ends of the engagement
    stop: float
    back: float  # where the bore of the sleeve ends
    out: float  # where the teeth end beyond the sleeve
    tip: float  # tip, root: radii of the teeth
    root: float
    teeth: int
    sleeve_first: bool  # whether the sleeve belongs to the start of the shaft


@dataclass(frozen=True, eq=False, kw_only=True)
class Piece:
    """A body of a shaft, along x from the joint before it, and whether it belongs to the shaft's start."""

    part: str
    surface: Surface
    first: bool


def shaft_stretches(
    shaft: Shaft, low: float, high: float, length: float | None, radius: float, necks: Sequence[tuple[float, float]]
) -> list[Stretch]:
    """Return the stretches of a shaft between its yokes: those of its file, else one with a neck at each support.

    low, high [m]: where it begins and ends, from the joint before it; on shaft 1 from joint 1.
    length [m]: between its joints; None for an end shaft.
    radius [m]: where it is thickest; necks [m]: places of supports and the radius there.
    """
    stretches = _stretches(shaft, low, high, length, radius)
    return stretches if shaft.segments else _necked(stretches, necks, radius)


def shaft_pieces(shaft: Shaft, low: float, high: float, radius: float, stretches: Sequence[Stretch]) -> Iterator[Piece]:
    """Yield the bodies of a shaft between its yokes.

    low, high [m]: where it begins and ends; radius [m]: where it is thickest.
    """
    slip = None if shaft.spline is None or high - low < 0.4 * radius else slip_of(shaft.spline, low, high, radius)
    if slip is None:
        for one in (*stretches, *_plugs(stretches)):
            yield Piece(part="tube", surface=_bar(one, welded=_hollow(one)), first=True)
        return
    end, begin = (slip.back, slip.out) if slip.sleeve_first else (slip.out, slip.back)
    for stretch in (*stretches, *_plugs(stretches)):
        before = replace(stretch, stop=min(stretch.stop, end))
        behind = replace(stretch, start=max(stretch.start, begin))
        for part, first in ((before, True), (behind, False)):
            if part.stop - part.start > 1e-3 * radius:
                yield Piece(part="tube", surface=_bar(part, welded=_hollow(part)), first=first)
    yield Piece(part="tube", surface=_neck(slip, stretches, low, high), first=not slip.sleeve_first)
    body = max(_radius_at(stretches, 0.5 * (slip.start + slip.stop)), slip.tip)
    yield Piece(part="spline sleeve", surface=_sleeve(slip, body, low, high), first=slip.sleeve_first)
    yield Piece(part="spline shaft", surface=_toothed_shaft(slip), first=not slip.sleeve_first)


def slip_of(spline: Spline, low: float, high: float, radius: float) -> Slip:
    """Return where a slip spline stands between the yokes of its shaft.

    spline: what the file says of it; low, high [m]: ends of the shaft beside its yokes; radius [m].
    """
    mean = 0.5 * spline.pitch_diameter if spline.pitch_diameter is not None else 0.62 * radius
    teeth = min(spline.teeth or 16, SHOWN_TEETH)
    height = min(0.9 * math.pi * mean / teeth, 0.2 * mean)
    tip = 0.5 * spline.outer if spline.outer is not None else mean + 0.5 * height
    root = 0.5 * spline.root if spline.root is not None else min(mean - 0.5 * height, 0.96 * tip)
    root = min(root, 0.97 * tip)
    room = high - low
    engaged = spline.engaged or spline.length or 2.6 * mean
    gap = spline.gap if spline.gap is not None else 0.5 * engaged
    engaged = min(engaged, 0.55 * room)
    gap, out = min(gap, 0.3 * room), min(max(0.7 * engaged, gap), 0.3 * room)
    middle = 0.5 * (low + high) if spline.position is None else spline.position
    middle = min(max(middle, low + 0.5 * engaged), high - 0.5 * engaged)
    first = middle - low <= high - middle
    start, stop = middle - 0.5 * engaged, middle + 0.5 * engaged
    if first:
        back, beyond = max(start - gap, low), min(stop + out, high)
    else:
        back, beyond = min(stop + gap, high), max(start - out, low)
    return Slip(
        start=start, stop=stop, back=back, out=beyond, tip=tip, root=root, teeth=max(teeth, 4), sleeve_first=first
    )


def _stretches(shaft: Shaft, low: float, high: float, length: float | None, radius: float) -> list[Stretch]:
    origin = 0.0
    if shaft.number == 1:
        origin = low if shaft.outer is not None else -sum(one.length for one in shaft.segments)
    whole = length if length is not None else high - origin
    if shaft.segments and length is None:
        whole = sum(one.length for one in shaft.segments)
    found = []
    for one in pieces(shaft, whole):
        start, stop = origin + one.start, origin + one.start + one.length
        outer = one.around or one.outer
        inner = one.inner if one.around is None else outer - 2.0 * (shaft.wall or 0.0)
        found.append(Stretch(start=start, stop=stop, outer=0.5 * outer, inner=0.5 * inner))
    if not found:
        return [Stretch(start=low, stop=high, outer=radius, inner=0.9 * radius if length is not None else 0.0)]
    found[0] = replace(found[0], start=min(found[0].start, low))
    found[-1] = replace(found[-1], stop=max(found[-1].stop, high))
    cut = [replace(one, start=max(one.start, low), stop=min(one.stop, high)) for one in found]
    return [one for one in cut if one.stop - one.start > 1e-6] or [Stretch(start=low, stop=high, outer=radius)]


def _necked(stretches: list[Stretch], necks: Sequence[tuple[float, float]], radius: float) -> list[Stretch]:
    """Return stretches with a thinner piece where a support holds the shaft."""
    found = stretches
    for place, thin in necks:
        if thin >= 0.97 * radius:
            continue
        half = max(0.9 * thin, 0.3 * radius)
        made: list[Stretch] = []
        for one in found:
            if one.stop <= place - half or one.start >= place + half or one.outer <= thin:
                made.append(one)
                continue
            start = place - half if place - half - one.start > 0.4 * radius else one.start
            stop = place + half if one.stop - place - half > 0.4 * radius else one.stop
            made += [replace(one, stop=start), Stretch(start=start, stop=stop, outer=thin), replace(one, start=stop)]
        found = [one for one in made if one.stop - one.start > 1e-6]
    return found


def _plugs(stretches: Sequence[Stretch]) -> Iterator[Stretch]:
    """Yield what closes a tube where a thinner stretch is welded into it."""
    for one, other in pairwise(stretches):
        for tube, thin, end, sense in ((one, other, one.stop, -1.0), (other, one, other.start, 1.0)):
            if tube.inner > thin.outer:
                ends = sorted((end, end + sense * min(0.2 * tube.inner, tube.stop - tube.start)))
                yield Stretch(start=ends[0], stop=ends[1], outer=tube.inner)


def _radius_at(stretches: Sequence[Stretch], place: float) -> float:
    return next((one.outer for one in stretches if one.start <= place <= one.stop), stretches[-1].outer)


def _hollow(one: Stretch) -> bool:
    return one.inner > 0.3 * one.outer and one.stop - one.start > 0.6 * one.outer


def _bar(one: Stretch, *, welded: bool = False) -> Surface:
    made = _bar_of(round(one.stop - one.start, 9), one.outer, one.inner, welded)
    return placed(made, None, (one.start, 0.0, 0.0))


@lru_cache(maxsize=128)
def _bar_of(length: float, outer: float, inner: float, welded: bool) -> Surface:
    """Return a tube or bar from 0 to its length, with weld seams at its ends."""
    bead = min(0.09 * outer, 0.2 * length) if welded else 0.0
    if bead:
        hump = [(0.0, 1.0), (0.3, 1.06), (0.7, 1.06), (1.0, 1.0)]
        side = [(bead * x, outer * r) for x, r in hump] + [(length - bead * x, outer * r) for x, r in hump[::-1]]
    else:
        edge = min(0.04 * outer, 0.2 * length)
        side = [(0.0, outer - edge), (edge, outer), (length - edge, outer), (length, outer - edge)]
    if inner > 0.0:
        return revolved([(0.0, inner), *side, (length, inner), (0.0, inner)], 28)
    return revolved([(0.0, 0.0), *side, (length, 0.0)], 28)


def _sleeve(slip: Slip, body: float, low: float, high: float) -> Surface:
    """Return the sleeve of a slip spline, toothed inside at its open end."""
    open_, sense = (slip.stop, 1.0) if slip.sleeve_first else (slip.start, -1.0)
    shut = slip.back
    wall = max(1.32 * slip.tip, min(1.5 * slip.tip, 0.92 * body))
    mouth = min(0.3 * (slip.stop - slip.start), 0.6 * slip.tip)
    length = abs(open_ - shut) - mouth
    neck = min(0.25 * length, 0.4 * abs(body - wall))
    profile = [
        (0.0, 0.0), (0.0, body), (neck, wall), (length - 0.2 * mouth, wall), (length, 1.09 * wall), (length, 0.0),
    ]  # fmt: skip
    solid = revolved(profile, 28)
    teeth = toothed(1.03 * slip.root, 1.03 * slip.tip, slip.teeth)
    ring = placed(plate(1.09 * wall * teeth / np.linalg.norm(teeth, axis=-1, keepdims=True), 0.0, mouth, teeth), ACROSS)
    whole = joined(solid, placed(ring, None, (length, 0.0, 0.0)))
    return placed(whole, np.diag([sense, 1.0, sense]), (shut, 0.0, 0.0))


def _neck(slip: Slip, stretches: Sequence[Stretch], low: float, high: float) -> Surface:
    """Return what joins the toothed shaft to the tube behind it: a plug that narrows toward the teeth."""
    sense = 1.0 if slip.sleeve_first else -1.0
    body = _radius_at(stretches, slip.out + sense * 1e-6)
    room = abs((high if slip.sleeve_first else low) - slip.out)
    long, thin = max(min(0.9 * body, 0.9 * room), 0.02 * body), min(0.97 * slip.root, body)
    side = [
        (-0.35 * long, thin),
        (0.0, max(0.8 * body, thin)),
        (0.05 * long, 0.985 * body),
        (0.35 * long, 0.985 * body),
    ]
    made = revolved([(-0.35 * long, 0.0), *side, (0.35 * long, 0.0)], 24)
    return placed(made, np.diag([sense, 1.0, sense]), (slip.out, 0.0, 0.0))


def _toothed_shaft(slip: Slip) -> Surface:
    teeth = toothed(slip.root, slip.tip, slip.teeth)
    low, high = (slip.start, slip.out) if slip.sleeve_first else (slip.out, slip.stop)
    return placed(plate(teeth, low, high), ACROSS)
