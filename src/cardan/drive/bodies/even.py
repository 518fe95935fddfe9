"""Joints without a cross: balls, rollers, tongues, rubber and pins, each moved by the law of its kind."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from cardan.drive.joints import Clemens, ElasticHalfCardan, HalfCardan, PinCoupling, Rzeppa, Tripod, Weiss
from cardan.drive.joints.laws import tripod
from cardan.drive.shapes.ring import ring
from cardan.drive.shapes.yoke import ACROSS, bolt_ring
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.maths.kernel.meshes import Surface, ball, circle, joined, placed, plate, revolved
from cardan.texts import _

from .build import BACK, Build, forks, name_of
from .sizes import JointSize


def _sides(build: Build, i: int) -> tuple[tuple[int, int, Array | None], tuple[int, int, Array | None]]:
    """Return shaft, track and turn of the driving and of the driven side; x then runs away from the joint."""
    return (i + 1, build.ends[i + 1], BACK), (i + 2, build.starts[i + 2], None)


def _theta(build: Build, i: int) -> Array:
    """Return the angle of the driving mark from the plane of the joint, array (p,)."""
    u, normal = build.arms.driving[i], build.place.normal[i]
    across = frames.cross(normal, build.axis(i + 1))
    found: Array = np.arctan2(u @ normal, u @ across)
    return found


def _halving(build: Build, i: int) -> tuple[Array, Array, Array]:
    """Return the normal of the plane that halves the bend, and its directions in and across the plane of the joint."""
    a, b, normal = build.axis(i + 1), build.axis(i + 2), build.place.normal[i]
    middle = frames.unit(a + b)
    return middle, frames.cross(normal, middle), normal


def _in_plane(build: Build, i: int, turn: Array) -> Array:
    """Return the direction of a place in the halving plane whose meridian stands at an angle, array (p, 3)."""
    _middle, across, normal = _halving(build, i)
    chi = np.arctan2(np.sin(turn) * np.cos(0.5 * float(build.place.bend[i])), np.cos(turn))
    found: Array = np.cos(chi)[:, None] * across + np.sin(chi)[:, None] * normal
    return found


def _say(build: Build, i: int, text: str) -> str:
    return text.format(joint=name_of(build.drive.joints[i], i))


def balls(build: Build, i: int) -> None:
    """Add bell, inner race, cage and balls of a Rzeppa joint, or of one that is only known to be even."""
    joint, size, path = build.drive.joints[i], build.sizes.joints[i], f"joints[{i}]"
    count = joint.balls if isinstance(joint, Rzeppa) else 6
    groove = joint.groove_radius if isinstance(joint, Rzeppa) and joint.groove_radius else 0.82 * size.radius
    driving, driven = _sides(build, i)
    outside, inside = (driving, driven) if i == 0 and build.count > 1 else (driven, driving)
    bead = min(0.27, 0.8 * np.sin(np.pi / count)) * groove
    for (k, track, turn), shape, part, text in (
        (outside, _bell(groove, bead, size, build, outside[0], i), "bell", _("bell of {joint}")),
        (inside, _inner_race(groove, bead, build, inside[0], i), "inner race", _("inner race of {joint}")),
    ):
        build.add(part, k, path, _say(build, i, text), track, placed(shape, turn), role=f"shaft {k}")
    theta = _theta(build, i)
    middle, _across, _normal = _halving(build, i)
    cage = build.along(build.centre(i), middle, _in_plane(build, i, theta))
    text = _say(build, i, _("cage of {joint}, in the plane that halves the bend"))
    build.add("cage", i + 1, path, text, cage, _cage(groove), role="cross", shade=0.1)
    said = _say(build, i, _("ball of {joint}"))
    for j in range(count):
        way = _in_plane(build, i, theta + j * 2.0 * np.pi / count)
        own = build.along(build.centre(i), way, frames.cross(np.broadcast_to(middle, way.shape), way))
        shape = placed(ball(bead, 14), None, (groove, 0.0, 0.0))
        build.add("ball", i + 1, path, said, own, shape, role="cross", shade=0.55)


def _bell(groove: float, bead: float, size: JointSize, build: Build, k: int, i: int) -> Surface:
    inner, outer = 1.12 * groove, max(1.12 * groove + 0.62 * bead, 1.36 * groove)
    reach = max(build.reach(i, driving=k == i + 1), 1.5 * groove)
    body = min(build.end_radius(k, driving=k == i + 1), 0.9 * outer)
    turn = np.linspace(0.0, 0.46 * np.pi, 7)
    cup = [(inner * float(np.cos(t)), inner * float(np.sin(t))) for t in turn]
    cup[0] = (inner, 0.0)
    mouth = -0.08 * groove
    cup.append((mouth, 1.0 * inner))
    shell = [(mouth, outer), (0.1 * groove, 1.03 * outer), (0.62 * groove, outer), (1.25 * groove, 1.15 * body)]
    del size
    return revolved([*cup, *shell, (1.32 * groove, body), (reach, body), (reach, 0.0)], 36)


def _inner_race(groove: float, bead: float, build: Build, k: int, i: int) -> Surface:
    inner = groove - 0.3 * bead
    reach = build.reach(i, driving=k == i + 1)
    end = build.end_radius(k, driving=k == i + 1)
    body = min(end, 0.55 * groove)
    turn = np.linspace(0.72 * np.pi, 0.28 * np.pi, 9)
    race = [(inner * float(np.cos(t)), inner * float(np.sin(t))) for t in turn]
    return revolved(
        [(race[0][0], 0.0), *race, (race[-1][0] + 0.02 * groove, body), (reach - 0.1 * groove, body),
         (reach, end), (reach, 0.0)],
        28,
    )  # fmt: skip


def _cage(groove: float) -> Surface:
    turn = np.linspace(0.64 * np.pi, 0.36 * np.pi, 7)
    low, high = 0.96 * groove, 1.08 * groove
    out = [(high * float(np.cos(t)), high * float(np.sin(t))) for t in turn]
    into = [(low * float(np.cos(t)), low * float(np.sin(t))) for t in turn[::-1]]
    return revolved([*out, *into, out[0]], 36)


def weiss(build: Build, i: int) -> None:
    """Add the two claws of a Weiss joint and the balls where their grooves cross."""
    joint, size, path = build.drive.joints[i], build.sizes.joints[i], f"joints[{i}]"
    assert isinstance(joint, Weiss)
    tip = -0.5 * size.radius
    forks(build, i, size, driving=True, bore=False, tip=tip)
    _turned_fork(build, i, size, tip)
    groove = joint.groove_radius or 0.72 * size.radius
    middle, _across, _normal = _halving(build, i)
    theta, said = _theta(build, i), _say(build, i, _("ball of {joint}"))
    for j in range(4):
        way = _in_plane(build, i, theta + (j + 0.5) * 0.5 * np.pi)
        own = build.along(build.centre(i), way, frames.cross(np.broadcast_to(middle, way.shape), way))
        shape = placed(ball(0.32 * groove, 18), None, (0.94 * groove, 0.0, 0.0))
        build.add("ball", i + 1, path, said, own, shape, role="cross", shade=0.55)
    own = build.along(build.centre(i), middle, _in_plane(build, i, theta))
    build.add("ball", i + 1, path, said, own, ball(0.28 * groove, 18), role="cross", shade=0.4)


def _turned_fork(build: Build, i: int, size: JointSize, tip: float) -> None:
    """Add a driven claw a quarter turn from the mark of its shaft."""
    forks(build, i, size, driving=False, bore=False, tip=tip)
    last = build.solids.pop()
    quarter = np.asarray([(1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, -1.0, 0.0)])
    build.add(last.part, last.number, last.path, last.text, last.track, placed(last.surface, quarter), role=last.role)


def tracta(build: Build, i: int) -> None:
    """Add the two forks of a Tracta joint and the slotted halves between them."""
    size, path = build.sizes.joints[i], f"joints[{i}]"
    tip = -0.3 * size.radius
    forks(build, i, size, driving=True, bore=False, tip=tip)
    _turned_fork(build, i, size, tip)
    middle, _across, _normal = _halving(build, i)
    own = build.along(build.centre(i), middle, _in_plane(build, i, _theta(build, i)))
    inner = 0.96 * (size.radius - 0.5 * size.ear)
    halves = (placed(ball(inner, 22, 0.06, 1.0), None), placed(ball(inner, 22, -1.0, -0.06), None))
    tongue = plate(circle(0.86 * inner, 24), -0.3 * inner, 0.3 * inner)
    text = _say(build, i, _("tongue of {joint}, in the plane that halves the bend"))
    build.add("tongue", i + 1, path, text, own, *halves, placed(tongue, ACROSS), role="cross", shade=0.2)


def tripod_joint(build: Build, i: int) -> None:
    """Add housing, spider and rollers of a tripod joint; its spider runs round three times a turn."""
    joint, size, path = build.drive.joints[i], build.sizes.joints[i], f"joints[{i}]"
    assert isinstance(joint, Tripod)
    track = joint.track_radius or 0.8 * size.radius
    (one, first, back), (two, second, _turn) = _sides(build, i)
    bend = float(build.place.bend[i])
    role = f"shaft {one}"
    housing = _tulip(track, build, i, bend)
    build.add("housing", one, path, _say(build, i, _("housing of {joint}")), first, placed(housing, back), role=role)
    theta = _theta(build, i)
    x, y = (np.asarray(part) for part in tripod.spider_centre(theta, bend, track))
    b, normal = build.axis(two), build.place.normal[i]
    plane = frames.cross(normal, b)
    centre = build.centre(i) + x[:, None] * plane + y[:, None] * normal
    arm = build.arms.driven[i]
    own = build.along(centre, b, arm)
    text = _say(build, i, _("spider of {joint}"))
    build.add("spider", two, path, text, own, _spider(track, bend), role=f"shaft {two}")
    stub = revolved(
        [(0.1 * track, 0.0), (0.1 * track, 0.34 * track), (build.reach(i, driving=False), 0.34 * track),
         (build.reach(i, driving=False), 0.0)], 20,
    )  # fmt: skip
    build.add("driven yoke", two, path, text, second, stub, role=f"shaft {two}")
    roller = placed(ball(0.36 * track, 18, -0.62, 0.62))
    said = _say(build, i, _("roller of {joint}"))
    for j in range(3):
        angle = j * 2.0 * np.pi / 3.0
        way = frames.rotate(arm, np.broadcast_to(b, arm.shape), np.full(len(arm), angle))
        far = np.asarray(tripod.roller_reach(theta + angle, bend, track))
        moved = build.along(centre + far[:, None] * way, way, frames.cross(np.broadcast_to(b, way.shape), way))
        build.add("roller", i + 1, path, said, moved, roller, role="cross", shade=0.5)


def _tulip(track: float, build: Build, i: int, bend: float) -> Surface:
    """Return the housing of a tripod joint: three lobes round the tracks, open toward the spider."""
    turn = np.arange(60) * (2.0 * np.pi / 60)
    off = np.abs((turn + np.pi / 3.0) % (2.0 * np.pi / 3.0) - np.pi / 3.0)
    roller, thick = 0.4 * track, 0.2 * track
    inside = np.sqrt(np.maximum(roller**2 - (track * np.sin(off)) ** 2, 0.0)) + track * np.cos(off)
    hole = np.where(track * np.sin(off) < 0.96 * roller, inside, 0.78 * track)
    outer = np.maximum(hole + thick, 1.12 * track)
    way = np.stack((np.cos(turn), np.sin(turn)), axis=-1)
    mouth = -(0.08 * track + track * np.tan(bend))
    floor = max(0.55 * track + 1.1 * track * np.tan(bend), 0.7 * track)
    shell = placed(plate(outer[:, None] * way, mouth, floor, hole[:, None] * way, 0.06 * track), ACROSS)
    lid = placed(plate(outer[:, None] * way, floor - 0.1 * track, floor + 0.3 * track, bevel=0.08 * track), ACROSS)
    reach, body = max(build.reach(i, driving=True), floor + 0.5 * track), build.end_radius(i + 1, driving=True)
    low = floor + 0.2 * track
    hub = revolved([(low, 0.0), (low, 0.8 * track), (low + 0.2 * track, body), (reach, body), (reach, 0.0)], 28)
    return joined(shell, lid, hub)


def _spider(track: float, bend: float) -> Surface:
    hub = revolved(
        [(-0.3 * track, 0.0), (-0.3 * track, 0.44 * track), (0.3 * track, 0.44 * track), (0.3 * track, 0.0)], 22
    )
    far = (1.0 + 2.0 * (1.0 / np.cos(bend) - 1.0)) * 1.24 * track
    arm = revolved([(0.0, 0.0), (0.0, 0.22 * track), (far, 0.22 * track), (far, 0.0)], 14)
    arms = [_about(placed(arm, np.roll(np.eye(3), -1, axis=0)), j * 2.0 * np.pi / 3.0) for j in range(3)]
    return joined(hub, *arms)


def _about(surface: Surface, angle: float) -> Surface:
    """Return a surface turned about x."""
    c, s = float(np.cos(angle)), float(np.sin(angle))
    return placed(surface, np.asarray([(1.0, 0.0, 0.0), (0.0, c, s), (0.0, -s, c)]))


def half_cardan(build: Build, i: int) -> None:
    """Add the toothed head and the sleeve round it of a rigid half-cardan."""
    joint, size, path = build.drive.joints[i], build.sizes.joints[i], f"joints[{i}]"
    assert isinstance(joint, HalfCardan)
    (one, first, back), (two, second, _turn) = _sides(build, i)
    corners = 2 * joint.pairs
    head = 0.72 * size.radius
    if corners <= 8:
        turn = (
            np.repeat(np.arange(corners) * (2.0 * np.pi / corners), 2) + np.tile((-0.3, 0.3), corners) * np.pi / corners
        )
        flat = head * np.stack((np.cos(turn), np.sin(turn)), axis=-1)
    else:
        from cardan.maths.kernel.meshes import toothed

        flat = toothed(0.9 * head, head, min(corners, 48))
    block = placed(plate(flat, -0.42 * head, 0.42 * head, bevel=0.08 * head), ACROSS)
    body = build.end_radius(one, driving=True)
    stem = 0.55 * head
    neck = revolved(
        [(0.0, 0.0), (0.0, stem), (0.75 * build.reach(i, driving=True), stem), (build.reach(i, driving=True), body),
         (build.reach(i, driving=True), 0.0)], 24,
    )  # fmt: skip
    text = _say(build, i, _("head of {joint}"))
    build.add("driving yoke", one, path, text, first, placed(joined(block, neck), back), role=f"shaft {one}")
    hole = 1.04 * flat
    outline = 1.34 * head * hole / np.linalg.norm(hole, axis=-1, keepdims=True)
    bell = placed(plate(outline, -0.5 * head, 0.75 * head, hole), ACROSS)
    body, reach = build.end_radius(two, driving=False), build.reach(i, driving=False)
    floor = 0.7 * head
    hub = revolved(
        [(floor, 0.0), (floor, 1.34 * head), (floor + 0.3 * head, 1.3 * head), (floor + 0.5 * head, body),
         (max(reach, floor + 0.6 * head), body), (max(reach, floor + 0.6 * head), 0.0)], 32,
    )  # fmt: skip
    text = _say(build, i, _("sleeve of {joint}"))
    build.add("driven yoke", two, path, text, second, joined(bell, hub), role=f"shaft {two}")


def elastic(build: Build, i: int) -> None:
    """Add the two arms and the disc between them of an elastic half-cardan."""
    joint, size, path = build.drive.joints[i], build.sizes.joints[i], f"joints[{i}]"
    assert isinstance(joint, ElasticHalfCardan)
    count = 3 if joint.pairs is None else joint.pairs
    far, thick = 0.95 * size.radius, 0.34 * size.radius
    for (k, track, turn), driving in zip(_sides(build, i), (True, False), strict=True):
        reach, body = build.reach(i, driving=driving), build.end_radius(k, driving=driving)
        low = 0.62 * thick
        hub = revolved(
            [(low, 0.0), (low, 0.4 * far), (low + 0.5 * thick, 0.42 * far), (low + 0.8 * thick, 0.36 * far),
             (max(reach, low + thick), body), (max(reach, low + thick), 0.0)], 24,
        )  # fmt: skip
        offset = 0.0 if driving else np.pi / count
        arms = [_about(_flange_arm(far, low, 0.42 * thick), offset + j * 2.0 * np.pi / count) for j in range(count)]
        made = placed(joined(hub, *arms), turn)
        part = "driving yoke" if driving else "driven yoke"
        text = _say(build, i, _("flange of {joint}"))
        build.add(part, k, path, text, track, made, role=f"shaft {k}")
    middle, _across, _normal = _halving(build, i)
    own = build.along(build.centre(i), middle, _in_plane(build, i, _theta(build, i)))
    shape = ring(0.52 * far, 1.22 * far, 1.1 * thick, 40)
    heads = bolt_ring(2 * count, 0.88 * far, 0.11 * far, -0.66 * thick, 0.66 * thick)
    text = _say(build, i, _("elastic disc of {joint}"))
    build.add("disc", i + 1, path, text, own, shape, role="ink", metal=False)
    build.add("disc", i + 1, path, text, own, heads, role="cross", shade=0.3)


def _flange_arm(far: float, low: float, thick: float) -> Surface:
    """Return one arm of a flange along y, its eye at a distance."""
    turn = np.linspace(-0.5 * np.pi, 0.5 * np.pi, 9)
    eye = 0.2 * far
    tip = np.stack((0.88 * far + eye * np.cos(turn), eye * np.sin(turn)), axis=-1)
    outline = np.concatenate((tip, [(0.0, 0.3 * far), (0.0, -0.3 * far)]))
    return placed(plate(outline, low, low + thick, bevel=0.12 * thick), ACROSS)


def pins(build: Build, i: int) -> None:
    """Add the hubs of a pin coupling and the pins that lean toward each other and touch."""
    joint, size, path = build.drive.joints[i], build.sizes.joints[i], f"joints[{i}]"
    assert isinstance(joint, PinCoupling)
    slants = joint.driving_slant, joint.driving_slant if joint.driven_slant is None else joint.driven_slant
    usual = 0.85 * size.radius
    starts = joint.driving_distance or usual, joint.driven_distance or usual
    alike = slants[0] == slants[1] and starts[0] == starts[1]
    count = 3 if alike else 1
    bend = float(build.place.bend[i])
    for (k, track, turn), driving, slant, start in zip(_sides(build, i), (True, False), slants, starts, strict=True):
        long = 1.12 * start / max(np.cos(slant) - np.sin(slant) * np.tan(0.5 * bend), 0.35)
        thin = 0.09 * start
        pin = revolved([(0.0, 0.0), (0.0, thin), (long - thin, thin), (long - 0.3 * thin, 0.7 * thin), (long, 0.0)], 14)
        lean = np.asarray([-np.cos(slant), np.sin(slant), 0.0])
        frame = np.stack((lean, np.asarray([-np.sin(slant), -np.cos(slant), 0.0]), np.asarray([0.0, 0.0, 1.0])))
        one = placed(pin, frame, (start, 0.0, 0.0))
        reach, body = max(build.reach(i, driving=driving), 1.12 * start), build.end_radius(k, driving=driving)
        hub = revolved(
            [(0.72 * start, 0.0), (0.72 * start, 0.4 * start), (start, 0.55 * start), (1.06 * start, 0.55 * start),
             (reach, body), (reach, 0.0)], 24,
        )  # fmt: skip
        made = joined(hub, *(_about(one, j * 2.0 * np.pi / count) for j in range(count)))
        text = _say(build, i, _("hub and pins of {joint}"))
        build.add(
            "driving yoke" if driving else "driven yoke", k, path, text, track, placed(made, turn), role=f"shaft {k}"
        )


def clemens(build: Build, i: int) -> None:
    """Add the hubs of a Clemens coupling and its hinged arms, which meet in the plane that halves the bend."""
    joint, size, path = build.drive.joints[i], build.sizes.joints[i], f"joints[{i}]"
    assert isinstance(joint, Clemens)
    tan = np.tan(0.5 * float(build.place.bend[i]))
    marks = build.arms.driving[i], build.arms.driven[i]
    for (k, track, turn), driving, mark in zip(_sides(build, i), (True, False), marks, strict=True):
        profile = joint.driving if driving or joint.driven is None else joint.driven
        axial, radial, arm = (
            (profile.axial, profile.radial, profile.radius)
            if profile is not None
            else (1.0 * size.radius, 0.3 * size.radius, 1.2 * size.radius)
        )
        reach, body = max(build.reach(i, driving=driving), 1.15 * axial), build.end_radius(k, driving=driving)
        wide = max(1.25 * radial, 0.3 * arm)
        hub = revolved(
            [(0.9 * axial, 0.0), (0.9 * axial, 0.8 * wide), (0.94 * axial, wide), (1.08 * axial, wide), (reach, body),
             (reach, 0.0)], 24,
        )  # fmt: skip
        role = f"shaft {k}"
        text = _say(build, i, _("hub of {joint}"))
        part = "driving yoke" if driving else "driven yoke"
        build.add(part, k, path, text, track, placed(hub, turn), role=role)
        away = (-1.0 if driving else 1.0) * build.axis(k)
        inward = frames.cross(build.place.normal[i], build.axis(k))
        said = _say(build, i, _("arm of {joint}"))
        for j in range(3):
            spread = np.full(len(mark), j * 2.0 * np.pi / 3.0)
            way = frames.rotate(mark, np.broadcast_to(build.axis(k), mark.shape), spread)
            slope = (way @ inward) * tan
            half = (slope * axial + radial) / (1.0 + slope**2)
            left = half**2 - (axial**2 + radial**2 - arm**2) / (1.0 + slope**2)
            height = half + np.sqrt(np.maximum(left, 0.0))
            hinge = build.centre(i) + axial * away + radial * way
            tip = build.centre(i) + (slope * height)[:, None] * away + height[:, None] * way
            along = frames.unit(tip - hinge)
            side = frames.unit(frames.cross(np.broadcast_to(away, way.shape), way))
            own = build.track(hinge, along, frames.cross(side, along), side)
            build.add("arm", k, path, said, own, _link(arm), role=role, shade=0.2)


def _link(length: float) -> Surface:
    """Return an arm along x with an eye at its hinge and a knob at its end."""
    thin = 0.075 * length
    bar = revolved([(0.0, 0.0), (0.0, thin), (length, 0.8 * thin), (length, 0.0)], 12)
    eye = placed(
        ring(0.5 * thin, 1.7 * thin, 2.4 * thin, 16), np.asarray([(0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)])
    )
    return joined(bar, eye, placed(ball(1.3 * thin, 12), None, (length, 0.0, 0.0)))


MAKERS: dict[str, Callable[[Build, int], None]] = {
    "constant_velocity": balls,
    "rzeppa": balls,
    "weiss": weiss,
    "tracta": tracta,
    "tripod": tripod_joint,
    "half_cardan": half_cardan,
    "elastic_half_cardan": elastic,
    "pin_coupling": pins,
    "clemens": clemens,
}
"""Kind of a joint without a cross -> what adds its bodies."""
