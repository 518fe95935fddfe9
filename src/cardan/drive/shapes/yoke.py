"""Yokes, crosses and their bearing caps."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from cardan.maths.arrays import Array
from cardan.maths.kernel.meshes import Surface, circle, joined, placed, plate, revolved, swept

Y_FIRST = np.asarray([(0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)])
"""Carries what is turned about x to y."""

Z_FIRST = np.asarray([(0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)])
"""Carries what is turned about x to z."""

EDGEWISE = np.asarray([(1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, -1.0, 0.0)])
"""Carries a plate in x, y to one in x, z."""

ACROSS = np.asarray([(0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)])
"""Carries a plate in x, y to one in y, z."""


@lru_cache(maxsize=256)
def fork(
    radius: float, ear: float, lug: float, bore: float, cavity: float, reach: float, body: float, tip: float = 0.0
) -> Surface:
    """Return a yoke: its ears across y, its hub along x away from the joint centre.

    Parameters
    ----------
    radius : float [m]
        From the joint centre to the middle of an ear.
    ear, lug, bore : float [m]
        Thickness, outer radius and radius of the bore of an ear; no bore where 0.
    cavity : float [m]
        From the joint centre to the bottom between the ears.
    reach : float [m]
        From the joint centre to the end of the hub.
    body : float [m]
        Radius of the shaft there.
    tip : float [m]
        Where ears without a bore begin, from the joint centre toward the hub.

    Examples
    --------
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

    Parameters
    ----------
    radius, ear, journal : float [m]
        Half the span, length and diameter of the journals.
    offset : float [m]
        How far the driven journals stand off the driving ones, along z.
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
