"""Shapes of which bodies are made: yokes and crosses, rings and flanges, bearings and their brackets."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from cardan.maths.arrays import Array
from cardan.maths.kernel.meshes import Surface, box, circle, joined, placed, plate, revolved, swept

Y_FIRST = np.asarray([(0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)])  # carries what is turned about x to y
Z_FIRST = np.asarray([(0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)])  # carries what is turned about x to z
EDGEWISE = np.asarray([(1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, -1.0, 0.0)])  # carries a plate in x, y to one in x, z
ACROSS = np.asarray([(0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)])  # carries a plate in x, y to one in y, z


@lru_cache(maxsize=256)
def fork(
    radius: float, ear: float, lug: float, bore: float, cavity: float, reach: float, body: float, tip: float = 0.0
) -> Surface:
    """Return a yoke: its ears across y, its hub along x away from the joint centre.

    radius [m]: from the joint centre to the middle of an ear.
    ear, lug, bore [m]: thickness, outer radius and radius of the bore of an ear; no bore where 0.
    cavity [m]: from the joint centre to the bottom between the ears.
    reach [m]: from the joint centre to the end of the hub; body [m]: radius of the shaft there.
    tip [m]: where ears without a bore begin, from the joint centre toward the hub.

    >>> from cardan.maths.kernel.meshes import volume
    >>> volume(fork(0.05, 0.02, 0.02, 0.014, 0.045, 0.09, 0.05)) > 0.0
    True
    """
    inner, outer = radius - 0.5 * ear, radius + 0.5 * ear
    root = min(0.98 * lug, 0.75 * cavity) if bore else tip
    base = cavity + 0.5 * (reach - cavity)
    wide = max(1.12 * lug, min(0.85 * body, 1.35 * lug))
    foot = lug + (wide - lug) * min(1.0, max(root, 0.0) / base)
    parts = [_hub(cavity, base, reach, wide, body)]
    parts.append(swept(_bow(inner, outer, root, cavity, base, foot, wide), range(8)))
    if bore:
        bevel = 0.14 * min(ear, foot)
        outline, hole = _lug(lug, bore, root + bevel, foot)
        tongue = plate(outline, -outer, -inner, hole, bevel)
        other = plate(outline, inner, outer, hole, bevel)
        parts += [placed(tongue, EDGEWISE), placed(other, EDGEWISE)]
    return joined(*parts)


def _hub(cavity: float, base: float, reach: float, wide: float, body: float) -> Surface:
    """Return what joins the bow of a fork to its shaft: a foot inside the bow that runs out to the shaft's radius."""
    low = cavity + 0.35 * (base - cavity)
    small = min(0.96 * wide, max(0.8 * body, 0.6 * wide))
    profile = [(low, 0.0), (low, 0.7 * small), (low + 0.1 * (base - low), 0.86 * small), (base, small)]
    for share in (0.3, 0.6, 1.0):
        ease = share * share * (3.0 - 2.0 * share)
        profile.append((base + share * (reach - base), small + ease * (body - small)))
    return revolved([*profile, (reach, 0.0)], 22)


def _lug(lug: float, bore: float, root: float, foot: float) -> tuple[Array, Array]:
    """Return outline and bore of an ear: round at its end, straight to its root."""
    corner = float(np.arctan2(foot, root))
    back = np.linspace(0.5 * np.pi, 1.5 * np.pi, 11)
    side = np.linspace(corner, 0.5 * np.pi, 3)[:-1]
    front = np.linspace(-corner, corner, 4)
    turn = np.concatenate((side, back, -side[::-1], front[1:-1]))
    cosine, sine = np.cos(turn), np.abs(np.sin(turn))
    slope = (foot - lug) / root
    flank = lug / np.maximum(sine - slope * np.maximum(cosine, 0.0), 1e-9)
    end = np.where(cosine > 1e-9, root / np.maximum(cosine, 1e-9), np.inf)
    far = np.where(cosine <= 1e-9, lug, np.minimum(flank, end))
    way = np.stack((np.cos(turn), np.sin(turn)), axis=-1)
    return far[:, None] * way, bore * way


def _bow(inner: float, outer: float, root: float, cavity: float, base: float, foot: float, wide: float) -> Array:
    """Return the cross sections of the bow from one ear to the other, array (m, 8, 3)."""
    turn = np.radians([0.0, 18.0, 36.0, 54.0, 72.0, 90.0])
    into, out = min(0.8 * inner, cavity - root), min(1.15 * outer, base - root)
    near = np.stack((cavity - into + into * np.sin(turn), inner * np.cos(turn)), axis=-1)
    square = np.cos(turn) ** 0.8
    far = np.stack((base - out + out * np.sin(turn) ** 0.8, outer * np.where(turn > 1.57, 0.0, square)), axis=-1)
    near = np.concatenate(([(root, inner)], near))
    far = np.concatenate(([(root, outer)], far))
    half = np.linspace(foot, wide, len(near))
    mirror = np.asarray([1.0, -1.0])
    near = np.concatenate((near, near[-2::-1] * mirror))
    far = np.concatenate((far, far[-2::-1] * mirror))
    half = np.concatenate((half, half[-2::-1]))
    way = far - near
    thick = np.linalg.norm(way, axis=-1)
    bevel = 0.14 * np.minimum(thick, half)
    along = way / thick[:, None]

    def corner(share: float, off: float, height: float, low: float) -> Array:
        flat = (near if share == 0.0 else far) + (off * bevel)[:, None] * along
        return np.concatenate((flat, (height * (half - low * bevel))[:, None]), axis=-1)

    return np.stack(
        [
            corner(1.0, 0.0, -1.0, 1.0),
            corner(1.0, 0.0, 1.0, 1.0),
            corner(1.0, -1.0, 1.0, 0.0),
            corner(0.0, 1.0, 1.0, 0.0),
            corner(0.0, 0.0, 1.0, 1.0),
            corner(0.0, 0.0, -1.0, 1.0),
            corner(0.0, 1.0, -1.0, 0.0),
            corner(1.0, -1.0, -1.0, 0.0),
        ],
        axis=1,
    )


@lru_cache(maxsize=256)
def cross_body(radius: float, ear: float, journal: float, offset: float = 0.0) -> Surface:
    """Return a cross: its driving journals along x, the driven ones along y.

    radius, ear, journal [m]: half the span, length and diameter of the journals.
    offset [m]: how far the driven journals stand off the driving ones, along z.
    """
    one = _arm(radius, ear, journal)
    other = placed(_arm(radius, ear, journal), Y_FIRST, (0.0, 0.0, offset))
    half = 0.62 * journal + 0.5 * abs(offset)
    round_ = 0.66 * (radius - 0.5 * ear)
    hub = revolved(
        [
            (-half, 0.0),
            (-half, 0.75 * round_),
            (-0.6 * half, round_),
            (0.6 * half, round_),
            (half, 0.75 * round_),
            (half, 0.0),
        ],
        16,
    )
    return joined(one, other, placed(hub, Z_FIRST, (0.0, 0.0, 0.5 * offset)))


def _arm(radius: float, ear: float, journal: float) -> Surface:
    """Return one arm of a cross with its two journals, along x."""
    end, root, thin = radius + 0.34 * ear, radius - 0.5 * ear, 0.5 * journal
    side = [(0.0, 1.42 * thin), (0.92 * root, 1.22 * thin), (0.95 * root, thin)]
    side += [(end - 0.12 * ear, thin), (end, 0.8 * thin), (end, 0.0)]
    return revolved([*((-x, r) for x, r in side[::-1]), *side[1:]], 14)


@lru_cache(maxsize=256)
def caps(radius: float, ear: float, cap: float) -> Surface:
    """Return the bearing caps in the ears of a yoke, across y."""
    low, high = radius - 0.52 * ear, radius + 0.5 * ear + 0.05 * cap
    top = [(high - 0.12 * cap, cap), (high, 0.86 * cap), (high, 0.5 * cap), (high - 0.1 * cap, 0.42 * cap)]
    one = revolved([(low, 0.0), (low, cap), *top, (high - 0.1 * cap, 0.0)], 14)
    upper = placed(one, Y_FIRST)
    lower = placed(upper, np.diag([1.0, -1.0, -1.0]))
    return joined(upper, lower)


@lru_cache(maxsize=64)
def bolt_ring(count: int, radius: float, size: float, low: float, high: float) -> Surface:
    """Return heads of bolts round x between two heights."""
    heads = [
        plate(circle(size, 6, (float(x), float(y))), low, high) for x, y in circle(radius, count, start=0.5 * np.pi)
    ]
    return placed(joined(*heads), ACROSS)


# Rings, discs and flanges about x.


@lru_cache(maxsize=32)
def flange(radius: float, sense: float) -> Surface:
    """Return the flange at the free end of a shaft, its face at x = 0; ``sense`` +1 where the shaft lies behind it."""
    wide, thick = 1.75 * radius, 0.34 * radius
    disc = [(0.0, 0.0), (0.0, 0.95 * wide), (0.05 * wide, wide), (thick, wide), (thick, 1.22 * radius)]
    made = revolved([*disc, (2.2 * thick, radius), (2.2 * thick, 0.0)], 26)
    heads = bolt_ring(6, 1.45 * radius, 0.15 * radius, -0.16 * radius, 0.02 * radius)
    return placed(joined(made, heads), np.diag([sense, 1.0, sense]))


@lru_cache(maxsize=32)
def disc(radius: float, thickness: float, bore: float, holes: int = 0) -> Surface:
    """Return a disc that turns with a shaft, its middle at x = 0, with a rim and a hub."""
    half, rim, hub = 0.5 * thickness, 0.78 * radius, max(1.5 * bore, 0.3 * radius)
    hub = min(hub, 0.7 * rim)
    edge = 0.06 * thickness
    right = [(half, 0.6 * bore), (half, hub), (0.55 * half, 1.08 * hub), (0.55 * half, 0.96 * rim), (half, rim)]
    right += [(half, radius - edge), (half - edge, radius)]
    side = [(-x, r) for x, r in right]
    loop = [*side, *right[::-1], side[0]]
    made = revolved(loop, 32)
    if holes:
        made = joined(made, bolt_ring(holes, 0.89 * radius, 0.05 * radius, -1.3 * half, 1.3 * half))
    return made


@lru_cache(maxsize=32)
def washer(inner: float, outer: float, thickness: float) -> Surface:
    """Return a flat ring, its middle at x = 0."""
    half = 0.5 * thickness
    loop = [(-half, inner), (-half, outer), (half, outer), (half, inner), (-half, inner)]
    return revolved(loop, 22)


@lru_cache(maxsize=32)
def ring(inner: float, outer: float, thickness: float, sides: int = 36) -> Surface:
    """Return a ring with broken edges, its middle at x = 0."""
    half, edge = 0.5 * thickness, 0.08 * min(thickness, outer - inner)
    side = [(-half, outer - edge), (edge - half, outer), (half - edge, outer), (half, outer - edge)]
    return revolved([(-half, inner), *side, (half, inner), (-half, inner)], sides)


# Bearings in the housing, and the bracket that holds them.


@lru_cache(maxsize=64)
def bearing(radius: float, *, wide: bool) -> Surface:
    """Return the rolling bearing that sits on a shaft of a radius: two races, balls between them; x is the shaft."""
    half = (0.75 if wide else 0.4) * radius
    low, mid, out, high = radius, 1.24 * radius, 1.48 * radius, 1.72 * radius
    side = [(half, mid), (0.75 * half, mid), (0.75 * half, out), (half, out), (half, high)]
    loop = [(-half, low), *((-x, r) for x, r in side), *side[::-1], (half, low), (-half, low)]
    return revolved(loop, 18)


@lru_cache(maxsize=64)
def rubber(radius: float, *, wide: bool) -> Surface:
    """Return the rubber between a soft bearing and its housing."""
    width = (1.3 if wide else 0.7) * radius
    low, high = 1.72 * radius, 2.28 * radius
    bulge = [
        (-0.5, low), (-0.42, 0.5 * (low + high)), (-0.5, high), (0.5, high), (0.42, 0.5 * (low + high)), (0.5, low),
    ]  # fmt: skip
    return revolved([(width * x, r) for x, r in [*bulge, bulge[0]]], 32)


@lru_cache(maxsize=64)
def bracket(radius: float, *, soft: bool, wide: bool, axial: bool) -> Surface:
    """Return the housing of a bearing and its foot: x along the shaft, z away from the floor.

    radius [m]: of the shaft in the bearing; soft: whether rubber lies between.
    wide: whether the bearing holds the slope too.
    axial: whether it holds the shaft lengthwise: the housing has a collar on either side.
    """
    inner = (2.28 if soft else 1.72) * radius
    outer = 1.17 * inner
    width = (1.6 if wide else 0.95) * radius
    parts = [ring(inner, outer, width, 24)]
    if axial:
        collar = washer(0.84 * inner, 1.04 * outer, 0.18 * radius)
        parts += [placed(collar, None, (side * 0.52 * width, 0.0, 0.0)) for side in (1.0, -1.0)]
    floor, half = -1.55 * outer, 1.35 * outer
    # The web reaches from the foot to the ring: between two curves, one across the foot, one along the ring.
    turn = np.linspace(-0.35, -np.pi + 0.35, 9)
    arc = inner * np.stack((np.cos(turn), np.sin(turn)), axis=-1)
    base = np.stack((np.linspace(0.9 * half, -0.9 * half, len(arc)), np.full(len(arc), floor)), axis=-1)
    rows = []
    for side in (-0.3 * width, 0.3 * width):
        rows.append(
            np.stack([np.concatenate((np.full((len(arc), 1), side), one), axis=-1) for one in (base, 1.08 * arc)])
        )
    rings = np.stack([rows[0][0], rows[1][0], rows[1][1], rows[0][1]], axis=1)
    parts.append(swept(rings, range(4)))
    foot = 0.16 * outer
    parts.append(box((1.5 * width, 2.0 * half, foot), (0.0, 0.0, floor), 0.15 * foot))
    head = plate(circle(0.16 * outer, 6), 0.0, 0.12 * outer)
    for side in (1.0, -1.0):
        parts.append(placed(head, None, (0.0, side * 0.84 * half, floor + 0.5 * foot)))
    return joined(*parts)


def floor_frame(axis: Array, gravity: Array) -> Array:
    """Return the directions of a bracket: along the shaft, across, away from the floor; array (3, 3).

    axis (3,): direction of the shaft; gravity (3,): where things fall; downwards where it is zero.
    """
    down = gravity if float(np.linalg.norm(gravity)) > 1e-9 else np.asarray([0.0, 0.0, -1.0])
    up = -down + float(down @ axis) * axis
    if float(np.linalg.norm(up)) < 1e-6 * float(np.linalg.norm(down)):
        up = np.cross(axis, np.asarray([0.0, 1.0, 0.0]) if abs(axis[1]) < 0.9 else np.asarray([1.0, 0.0, 0.0]))
    up = up / np.linalg.norm(up)
    return np.stack((axis, np.cross(up, axis), up))
