"""Shafts that wobble while they turn: where every shaft of a drive lies over a turn, and how far it has turned then.

A joint whose driven shaft does not start at the joint centre (two pins apart, a spider that orbits) makes that shaft
wobble about the place that holds it. The next joint then has a driving shaft whose direction, and perhaps a centre that
moves: its law holds at every instant with the joint angle and the plane of that instant.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cardan.drive.described import Described
from cardan.drive.drive import Drive
from cardan.drive.fields.parts import known_lengths
from cardan.drive.joints import Joint
from cardan.drive.joints.common.inner import Stance
from cardan.drive.joints.joint import EXACT
from cardan.maths.arrays import Array
from cardan.maths.curves.extremes import sampled_series, series_at
from cardan.maths.kernel import frames

from .floating import Way, gives_way, swivels_at_next
from .geometry import STRAIGHT, Geometry, geometry

SAMPLES = 720  # places in a turn at which wobbling shafts are looked at; between them by the harmonics
ROUNDS = 60  # rounds in which a shaft finds its place; each leaves less than the radius of its orbit over its length
CLOSE = 1e-15  # change of a direction at which that place is found
NODES = 14  # joint angles at which a law without a map is asked; between them by the polynomial through these
PLACES = 512  # places in a turn by which the laws of joints are told that wobbling shafts change
ROUNDED = 1e-13  # harmonics and steps [rad] that are rounding
STEPS = 8  # Newton's steps from the angle of a driving yoke to that of the input
MEAN = 48  # places in a turn over which the start of a shaft is averaged


def wobbling(drive: Described) -> tuple[int, ...]:
    """Return the joints, from 0, whose driven shaft wobbles so that a further joint feels it, in the file or beyond."""
    known = known_lengths(drive)
    joints = drive.joints if drive.joints[-1].felt_beyond else drive.joints[:-1]
    return tuple(i for i, one in enumerate(joints) if one.wobbles and one.held(known.get(i + 2)) is not None)


def binding(drive: Described) -> Iterator[tuple[int, int]]:
    """Yield joints whose driven shaft would wobble, and supports that hold it beside the place about which it does.

    Both from 0.
    """
    known = known_lengths(drive)
    for i in wobbling(drive):
        place = float(np.asarray(drive.joints[i].held(known.get(i + 2))))
        yield from ((i, k) for k, one in enumerate(drive.supports) if one.shaft == i + 2 and one.hinders(place))


@dataclass(frozen=True, eq=False, kw_only=True)
class Course:
    """Where shafts and joints of a drive are at input angles (p,)."""

    start: Array  # (n, p, 3) [m]: where shafts 2 … n+1 start
    axis: Array  # (n+1, p, 3): directions of the shafts
    centre: Array  # (n, p, 3) [m]: joint centres, on the driving shaft of each
    driving: Array  # driving, driven (n, p, 3): directions of the marks
    driven: Array
    theta: Array  # (n, p) [rad]: of each driving mark from the plane of its joint
    joint_angle: Array  # (n, p) [rad]
    turned: Array  # (n+1, p) [rad]: angle of each shaft, as an exact joint of constant velocity on it would pass it on


def course(
    drive: Drive,
    angle: Array,
    place: Geometry | None = None,
    *,
    phase: float | None = None,
    still: bool = False,
    off: Sequence[Mapping[str, Array]] = (),
    yokes: Array | None = None,
) -> Course:
    """Return where the shafts of a drive are at input angles (p,), or (..., p), [rad] from the start position.

    place: where its joints are; as drawn when not given. phase [rad]: ψ_1; as the drive says when not given.
    still: whether a joint that does not turn at its joint angle passes on its mark as one of constant velocity would.
    off: errors of each joint by which its driven shaft leaves its place, see `Joint.head`, as wide as the angles.
    yokes (..., n-1) [rad]: γ of shafts 2 … n in place of those of the drive, with the axes of the angles before p.
    A shaft that starts off the centre of its joint swivels where it is held: in the ball of an offset cross, in its
    next joint otherwise. An end shaft that nothing holds keeps its direction. Beyond its ball a shaft carries the
    next joint around: at its length from where it starts, or, where it slides in a spline, as far along as drawn. Where
    its length is not said the next joint stays where it is. A shaft that swivels in its next joint keeps its length
    where this joint or its own one slides with a neighbouring shaft, see `gives_way`; else both joints stay.
    """
    place = geometry(drive) if place is None else place
    known, count = known_lengths(drive), len(drive.joints)
    phi = np.asarray(angle, dtype=float) + (drive.input.start_phase if phase is None else phase)
    before = np.broadcast_to(place.axis[0], (*phi.shape, 3))
    centre = np.broadcast_to(place.points[1], before.shape)
    zero = frames.cross(place.normal[0], place.axis[0])
    mark = frames.rotate(zero, place.axis[0], phi)
    rows: list[Stance] = []
    starts, turned = [], [phi]
    for i, joint in enumerate(drive.joints):
        rest, here = place.axis[i + 1], place.points[i + 1]
        length = float(place.length[i + 1]) if i + 2 in known else None
        held, own = joint.held(length), off[i] if off else EXACT
        made = held if held == length else joint.held(length, own)
        stop = None if made is None else here + np.asarray(made)[..., None] * rest
        drawn_angle, far = float(place.joint_angle[i]), float(place.length[i + 1])
        slide = _slide(drive, place, i)
        stance, stop = _settled(joint, centre, before, rest, stop, mark, far, still, own, drawn_angle, slide)
        head = joint.head(stance, own)
        rows.append(stance)
        starts.append(head)
        zero = frames.cross(place.normal[i], rest)
        upright = _carried(stance.driven, stance.after, rest)
        turned.append(frames.angle_about(rest, zero, upright) - (0.5 * np.pi if joint.crossed else 0.0))
        if i + 1 == count:
            break
        there = place.points[i + 2]
        if stop is not None and slide is not None and slide.ahead:
            centre = stop
        elif stop is None or length is None or held == length or swivels_at_next(drive, i):
            centre = np.broadcast_to(there, before.shape)
        elif drive.shafts[i + 1].spline is not None:
            centre = stop + (((there - stop) @ rest) / (stance.after @ rest))[..., None] * stance.after
        else:
            centre = head + (length - _ahead(joint, place, i)) * stance.after
        before = stance.after
        yoke = np.asarray(drive.shafts[i + 1].yoke_angle) if yokes is None else yokes[..., i, None]
        mark = frames.rotate(stance.driven, before, -yoke)
    return Course(
        start=np.stack(starts),
        axis=np.stack([np.broadcast_to(place.axis[0], (*phi.shape, 3)), *(one.after for one in rows)]),
        centre=np.stack([np.broadcast_to(one.centre, (*phi.shape, 3)) for one in rows]),
        driving=np.stack([one.driving for one in rows]),
        driven=np.stack([one.driven for one in rows]),
        theta=np.stack([one.theta for one in rows]),
        joint_angle=np.stack([np.asarray(one.joint_angle) for one in rows]),
        turned=np.stack(turned),
    )


def _settled(
    joint: Joint,
    centre: Array,
    before: Array,
    rest: Array,
    stop: Array | None,
    mark: Array,
    length: float,
    still: bool,
    off: Mapping[str, Array],
    drawn_angle: float,
    slide: _Slide | None,
) -> tuple[Stance, Array | None]:
    """Return how a joint stands once its driven shaft points from its start to where it is held, and that place."""
    after = np.broadcast_to(rest, before.shape) if stop is None else frames.unit(stop - centre)
    for _round in range(ROUNDS):
        stance = replace(_stance(joint, centre, before, after, mark, length, still), drawn_angle=drawn_angle)
        if stop is None:
            return stance, None
        head = joint.head(stance, off)
        if slide is not None and slide.ahead:
            stop = slide.point + slide.way(head - slide.point)[..., None] * slide.axis
        elif slide is not None:
            far = stop - head + frames.dot(centre - slide.point, slide.axis)[..., None] * slide.axis
            moved_to = slide.way(far)[..., None] * slide.axis
            head, centre = head - centre + slide.point + moved_to, slide.point + moved_to
        turned = frames.unit(stop - head)
        moved = float(np.max(np.abs(turned - after)))
        after = turned
        if moved <= CLOSE:
            break
    return replace(_stance(joint, centre, before, after, mark, length, still), drawn_angle=drawn_angle), stop


@dataclass(frozen=True, eq=False, slots=True)
class _Slide:
    """A joint at an end of a wobbling shaft slides along a line, as that shaft keeps its length."""

    ahead: bool  # whether it is the joint behind that shaft; else that before it
    point: Array  # (3,) [m]: where it is as drawn
    axis: Array  # (3,): of the shaft with which it slides
    length: float  # [m]: from the start of the wobbling shaft to its next joint

    def way(self, far: Array) -> Array:
        """Return how far along its line it is at that length from a place (..., 3) [m] relative to its point."""
        along, off = frames.dot(far, self.axis), frames.dot(far, far) - self.length**2
        root = np.sqrt(np.maximum(along**2 - off, 0.0))
        return np.asarray(off / (along + np.copysign(root, along)))


def _slide(drive: Drive, place: Geometry, i: int) -> _Slide | None:
    """Return which joint slides as the shaft behind joint i wobbles, and how; None where none does."""
    if not swivels_at_next(drive, i):
        return None
    way = gives_way(drive, i)
    if way not in (Way.AHEAD, Way.BACK):
        return None
    length = float(place.length[i + 1]) - _ahead(drive.joints[i], place, i)
    k = i + 1 if way is Way.AHEAD else i
    axis = place.axis[i + 2 if way is Way.AHEAD else i]
    return _Slide(ahead=way is Way.AHEAD, point=place.points[k + 1], axis=axis, length=length)


def _stance(
    joint: Joint, centre: Array, before: Array, after: Array, mark: Array, length: float, still: bool = False
) -> Stance:
    """Return how a joint stands between shafts of given directions (p, 3): its driven mark by its law."""
    across = frames.cross(before, after)
    size = frames.norm(across)
    straight = size <= STRAIGHT
    normal = np.where(
        straight[..., None], frames.perpendicular(before), across / np.where(straight, 1.0, size)[..., None]
    )
    joint_angle = np.where(straight, 0.0, np.atan2(size, frames.dot(before, after)))
    if joint.single_cross:
        driven = frames.unit(frames.cross(after, mark))
    else:
        theta = np.atan2(frames.dot(mark, normal), frames.dot(mark, frames.cross(normal, before)))
        ahead = _ahead_of(joint, theta, joint_angle)
        ahead = np.where(np.isfinite(ahead) | (not still), ahead, 0.0) + (0.5 * np.pi if joint.crossed else 0.0)
        driven = frames.rotate(frames.rotate(mark, normal, joint_angle), after, ahead)
    return Stance(
        centre=centre,
        before=before,
        after=after,
        normal=normal,
        joint_angle=joint_angle,
        driving=mark,
        driven=driven,
        length=length,
    )


def _ahead_of(joint: Joint, theta: Array, joint_angle: Array) -> Array:
    """Return how far a joint runs ahead at angles (...) [rad], each with a joint angle of its own."""
    shape, theta, joint_angle = np.shape(theta), np.ravel(theta), np.ravel(joint_angle)
    low, high = float(np.min(joint_angle)), float(np.max(joint_angle))
    with np.errstate(invalid="ignore", divide="ignore"):
        if joint.has_map:
            return np.reshape(np.asarray(joint.deviation(theta, joint_angle)[0], dtype=float), shape)
        if high - low <= STRAIGHT:
            return np.reshape(np.asarray(joint.deviation(theta, np.asarray(high))[0], dtype=float), shape)
        nodes = np.cos(np.pi * np.arange(NODES) / (NODES - 1))
        places = 0.5 * (low + high) + 0.5 * (high - low) * nodes
        each = np.asarray([joint.deviation(theta, np.asarray(one))[0] for one in places])
    weight = (-1.0) ** np.arange(NODES)
    weight[[0, -1]] *= 0.5
    apart = joint_angle - places[:, None]
    near = np.abs(apart) <= STRAIGHT
    share = weight[:, None] / np.where(near, 1.0, apart)
    found = np.sum(share * each, axis=0) / np.sum(share, axis=0)
    found = np.where(np.any(near, axis=0), np.sum(near * each, axis=0) / np.maximum(np.sum(near, axis=0), 1), found)
    return np.reshape(found, shape)


def _carried(mark: Array, axis: Array, rest: Array) -> Array:
    """Return marks (p, 3) after the shortest turn from their axes to another one."""
    share = (mark @ rest) / (1.0 + axis @ rest)
    found: Array = mark - share[..., None] * (axis + rest)
    return found


def _ahead(joint: Joint, place: Geometry, i: int) -> float:
    """Return how far ahead of the joint centre a driven shaft starts in the mean [m]; lengths count from the centre."""
    if not joint.wobbles:
        return 0.0
    before, after = (np.broadcast_to(place.axis[k], (MEAN, 3)) for k in (i, i + 1))
    turn = np.arange(MEAN) * (2.0 * np.pi / MEAN)
    mark = frames.rotate(frames.cross(place.normal[i], place.axis[i]), place.axis[i], turn)
    stance = _stance(joint, np.broadcast_to(place.points[i + 1], (MEAN, 3)), before, after, mark, 1.0)
    return float(np.mean((joint.head(stance) - place.points[i + 1]) @ place.axis[i + 1]))


def leads(drive: Drive, place: Geometry, yokes: Array, theta: Array) -> Array:
    """Return how far ahead each joint turns where shafts wobble, at angles of its driving yoke, array (n, q) [rad].

    place: where the joints are; yokes (n-1,) [rad]: γ of shafts 2 … n; theta (n, q) [rad]: of the driving yokes from
    the planes of the joints as drawn. What a wobble does to a joint goes with the angle of that joint, as on shafts
    that do not twist: a twist of the shaft shifts order k of it by k times that.
    """
    turn = np.arange(PLACES) * (2.0 * np.pi / PLACES)
    found = course(drive, turn, place, phase=0.0, yokes=yokes)
    rows, driving = [], turn
    for i, joint in enumerate(drive.joints):
        wave = sampled_series(np.unwrap(np.stack((driving - turn, found.turned[i + 1] - driving)), axis=-1))
        wave = wave[:, : 2 + np.flatnonzero(np.max(np.abs(wave), axis=0) > ROUNDED)[-1:].sum()]
        at = theta[i]
        for _step in range(STEPS):  # the input angle at which the driving yoke stands there
            ahead, slope, _bow = (part[:, 0] for part in series_at(wave[:1], at))
            step = (at + ahead - theta[i]) / (1.0 + slope)
            at = at - step
            if np.max(np.abs(step)) < ROUNDED:
                break
        rows.append(series_at(wave[1:], at)[0][:, 0])
        if i + 1 < len(drive.joints):
            quarter = 0.5 * np.pi if joint.crossed else 0.0
            driving = found.turned[i + 1] + quarter - yokes[i] - place.plane_twist[i]
    return np.stack(rows)


@dataclass(frozen=True, eq=False, kw_only=True)
class Wobble:
    """How far shaft and joint behind a joint leave their places, over a turn."""

    joint: int  # the joint, from 0, whose driven shaft it is
    lean: float  # [rad]: largest angle of the shaft with its place as drawn
    nutation: float  # [rad]: half the range of its directions
    way: float  # [m]: half the way on which the centre of the next joint is carried
    gives: Way | None = None  # what gives way along the shafts where this one swivels in its next joint, and how far
    slide: float = 0.0  # [m]: half that way


def wobbles(drive: Drive) -> Iterator[Wobble]:
    """Yield how far shafts wobble that a further joint feels, and those behind them."""
    found = wobbling(drive)
    if not found:
        return
    lying, place = course(drive, np.arange(SAMPLES) * (2.0 * np.pi / SAMPLES)), geometry(drive)
    for i in range(found[0], len(drive.joints)):
        axis = lying.axis[i + 1]
        lean = float(np.max(frames.angle_between(axis, np.broadcast_to(place.axis[i + 1], axis.shape))))
        if lean <= STRAIGHT:
            continue
        way = 0.5 * _widest(lying.centre[i + 1]) if i + 1 < len(drive.joints) else 0.0
        gives, slide = None, 0.0
        if swivels_at_next(drive, i):
            gives = gives_way(drive, i)
            ends = {Way.AHEAD: lying.centre[i + 1], Way.BACK: lying.centre[i]}
            drawn = frames.norm(lying.centre[i + 1] - lying.start[i])
            slide = 0.5 * (_widest(ends[gives]) if gives in ends else float(np.ptp(drawn)))
        yield Wobble(joint=i, lean=lean, nutation=0.5 * _widest(axis), way=way, gives=gives, slide=slide)


def _widest(points: Array) -> float:
    """Return the greatest distance of points (p, 3) from each other, of a curve looked at finely."""
    some = points[:: max(1, len(points) // 240)]
    return float(np.max(frames.norm(some[:, None] - some[None])))
