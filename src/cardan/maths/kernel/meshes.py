"""Closed surfaces as triangles: turned, swept and cut from plates, put together and set in place.

Corners at sharp edges are doubled, so that normals averaged over the triangles of a corner make round faces look round
and edges sharp. Triangles run counter-clockwise seen from outside.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from cardan.maths.arrays import Array, ArrayLike

CREASE = np.cos(np.radians(32.0))
"""Cosine of the turn between two edges beyond which they meet sharply."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Surface:
    """Closed surface, or several of them that may pass through each other."""

    positions: Array  # (m, 3) [m]: corners
    indices: Array  # (t, 3) of int: corners of each triangle


def joined(*surfaces: Surface) -> Surface:
    """Return several surfaces as one."""
    starts = np.cumsum([0, *(len(one.positions) for one in surfaces)])
    return Surface(
        positions=np.concatenate([one.positions for one in surfaces]),
        indices=np.concatenate([one.indices + start for one, start in zip(surfaces, starts, strict=False)]),
    )


def placed(surface: Surface, frame: ArrayLike | None = None, shift: ArrayLike = 0.0) -> Surface:
    """Return a surface turned, then shifted.

    frame (3, 3): where its x, y and z point to, one a row: a rotation; shift (3,) [m].
    """
    turned = surface.positions if frame is None else surface.positions @ np.asarray(frame, dtype=float)
    return Surface(positions=turned + np.asarray(shift, dtype=float), indices=surface.indices)


def volume(surface: Surface) -> float:
    """Return what a surface encloses [m³]; positive where its triangles look outwards."""
    corners = surface.positions - np.mean(surface.positions, axis=0)
    one, two, three = (corners[surface.indices[:, k]] for k in range(3))
    return float(np.sum(np.cross(one, two) * three)) / 6.0


@dataclass(frozen=True, eq=False, kw_only=True)
class MassProperties:
    """What a body of density 1 kg/m³ weighs, and where."""

    mass: float  # [kg]
    centre: Array  # (3,) [m]
    inertia: Array  # (3, 3) [kg·m²]: about its centre of mass


def mass_properties(surface: Surface) -> MassProperties:
    """Return mass, centre and inertia of what a surface encloses, at a density of 1 kg/m³.

    By the divergence theorem: each triangle a, b, c makes a tetrahedron with the origin, of volume det(a, b, c)/6 and
    second moment V/20 (Σ p pᵀ + Σp Σpᵀ). What two surfaces share counts twice.

    >>> found = mass_properties(box((2.0, 1.0, 1.0), (0.0, 0.5, 0.5)))
    >>> round(found.mass, 12), found.centre.round(12) + 0.0, np.diag(found.inertia).round(12)
    (2.0, array([0. , 0.5, 0.5]), array([0.33333333, 0.83333333, 0.83333333]))
    """
    corners = surface.positions[surface.indices]
    volumes = np.linalg.det(corners) / 6.0
    sums = np.sum(corners, axis=1)
    mass = float(np.sum(volumes))
    centre = np.asarray(volumes @ sums / (4.0 * mass))
    second = np.einsum("t,tki,tkj->ij", volumes, corners, corners) + np.einsum("t,ti,tj->ij", volumes, sums, sums)
    moment = second / 20.0 - mass * np.outer(centre, centre)
    return MassProperties(mass=mass, centre=centre, inertia=np.trace(moment) * np.eye(3) - moment)


def revolved(profile: Sequence[tuple[float, float]], sides: int = 24) -> Surface:
    """Return a body turned about x.

    profile, sequence of (x, r) [m]: its outline: from the axis along rising x back to the axis, or a loop round a ring
    whose outer side runs along rising x.
    sides: faces round the axis.
    """
    points = _distinct(np.asarray(profile, dtype=float))
    turn = np.arange(sides) * (2.0 * np.pi / sides)
    around = np.stack((np.cos(turn), np.sin(turn)), axis=-1)
    loop = bool(np.all(points[0] == points[-1]))
    parts = []
    for run in _runs(points, loop):
        ring = np.empty((len(run), sides, 3))
        ring[..., 0] = run[:, :1]
        ring[..., 1:] = run[:, 1, None, None] * around
        parts.append(_grid(ring, wrapped=True, start=run[0, 1] > 0.0, stop=run[-1, 1] > 0.0))
    return joined(*parts)


def swept(rings: Array, creases: Sequence[int] = ()) -> Surface:
    """Return a body through cross sections, closed at both ends.

    rings (m, c, 3) [m]: corners of each cross section, counter-clockwise about the way from the first to the last; all
    star-shaped.
    creases: corners of a cross section at which its sides meet sharply; all round without any.
    """
    count = rings.shape[1]
    parts = []
    if creases:
        ends = [*creases, creases[0] + count]
        for one, two in pairwise(ends):
            parts.append(_grid(rings[:, np.arange(one, two + 1) % count], wrapped=False))
    else:
        parts.append(_grid(rings, wrapped=True))
    return joined(*parts, _fan(rings[0][::-1]), _fan(rings[-1]))


def plate(outline: ArrayLike, low: float, high: float, hole: ArrayLike | None = None, bevel: float = 0.0) -> Surface:
    """Return a flat body between two heights z.

    outline (k, 2) [m]: counter-clockwise; star-shaped about its middle where it has no hole.
    low, high [m]; hole (k, 2) [m]: counter-clockwise too, each point facing one of the outline.
    bevel [m]: how far the upper and lower edges of the outline are broken, toward the hole or the middle.
    """
    outer = np.asarray(outline, dtype=float)
    middle = np.mean(outer, axis=0) if hole is None else np.asarray(hole, dtype=float)
    inward = middle - outer
    inward /= np.maximum(np.linalg.norm(inward, axis=-1, keepdims=True), 1e-30)
    edge = outer + bevel * inward
    heights = (low, low + bevel, high - bevel, high) if bevel else (low, high)
    outlines = (edge, outer, outer, edge) if bevel else (outer, outer)
    wall = np.stack([_at(line, height) for line, height in zip(outlines, heights, strict=True)])
    parts = [_walls(wall[k : k + 2]) for k in range(len(wall) - 1)]
    if hole is None:
        return joined(*parts, _fan(wall[0][::-1]), _fan(wall[-1]))
    inner = np.stack((_at(middle, low), _at(middle, high)))
    parts.append(_walls(inner[:, ::-1]))
    for out, inside, up in ((wall[-1], inner[-1], True), (wall[0], inner[0], False)):
        pair = np.stack((out, inside) if up else (inside, out))
        parts.append(_grid(pair, wrapped=True))
    return joined(*parts)


def ball(radius: float, sides: int = 16, low: float = -1.0, high: float = 1.0) -> Surface:
    """Return a ball about the origin, or the zone of it between two heights x, in radii."""
    angle = np.linspace(np.arccos(low), np.arccos(high), max(sides // 2, 4) + 1)
    arc = [(radius * float(np.cos(a)), radius * max(float(np.sin(a)), 0.0)) for a in angle]
    arc = [(x, 0.0 if r < 1e-9 * radius else r) for x, r in arc]
    start = [] if arc[0][1] == 0.0 else [(arc[0][0], 0.0)]
    stop = [] if arc[-1][1] == 0.0 else [(arc[-1][0], 0.0)]
    return revolved([*start, *arc, *stop], sides)


def box(size: ArrayLike, middle: ArrayLike = 0.0, bevel: float = 0.0) -> Surface:
    """Return a box with its sides along x, y and z."""
    x, y, z = (0.5 * float(one) for one in np.asarray(size, dtype=float))
    made = plate([(x, y), (-x, y), (-x, -y), (x, -y)], -z, z, bevel=bevel)
    return placed(made, None, middle)


def circle(radius: float, count: int, middle: tuple[float, float] = (0.0, 0.0), start: float = 0.0) -> Array:
    """Return points round a circle, counter-clockwise, array (count, 2)."""
    turn = start + np.arange(count) * (2.0 * np.pi / count)
    return np.asarray(middle) + radius * np.stack((np.cos(turn), np.sin(turn)), axis=-1)


def toothed(root: float, tip: float, teeth: int) -> Array:
    """Return the outline of a toothed shaft, counter-clockwise, four points a tooth, array (4 teeth, 2)."""
    step = 2.0 * np.pi / teeth
    turn = (np.arange(teeth)[:, None] + np.asarray([-0.3, -0.17, 0.17, 0.3])) * step
    size = np.asarray([root, tip, tip, root])
    return np.reshape(np.stack((size * np.cos(turn), size * np.sin(turn)), axis=-1), (-1, 2))


def quaternions(frame: Array) -> Array:
    """Return the turns that carry x, y and z into frames, x y z w, signs continuous along the first axis.

    frame (p, 3, 3): where x, y and z point to, one a row.
    Returns (p, 4).
    """
    m = np.swapaxes(frame, -1, -2)
    xx, yy, zz = m[:, 0, 0], m[:, 1, 1], m[:, 2, 2]
    square = np.stack((1 + xx - yy - zz, 1 - xx + yy - zz, 1 - xx - yy + zz, 1 + xx + yy + zz), axis=-1)
    (xy, yz, zx) = (m[:, 1, 0] + m[:, 0, 1], m[:, 2, 1] + m[:, 1, 2], m[:, 0, 2] + m[:, 2, 0])
    (wz, wx, wy) = (m[:, 1, 0] - m[:, 0, 1], m[:, 2, 1] - m[:, 1, 2], m[:, 0, 2] - m[:, 2, 0])
    rows = np.stack(
        [
            np.stack((square[:, 0], xy, zx, wx), axis=-1),
            np.stack((xy, square[:, 1], yz, wy), axis=-1),
            np.stack((zx, yz, square[:, 2], wz), axis=-1),
            np.stack((wx, wy, wz, square[:, 3]), axis=-1),
        ],
        axis=1,
    )
    largest = np.argmax(square, axis=-1)
    q = rows[np.arange(len(rows)), largest]
    q = q / np.linalg.norm(q, axis=-1, keepdims=True)
    q[0] *= 1.0 if q[0, 3] >= 0.0 else -1.0
    turned = np.sign(np.sum(q[1:] * q[:-1], axis=-1))
    signs = np.cumprod(np.concatenate(([1.0], np.where(turned == 0.0, 1.0, turned))))
    continued: Array = q * signs[:, None]
    return continued


def _distinct(points: Array) -> Array:
    """Return a polyline without points that stand where the one before does."""
    apart = np.any(points[1:] != points[:-1], axis=-1)
    kept: Array = points[np.concatenate(([True], apart))]
    return kept


def _runs(points: Array, loop: bool) -> list[Array]:
    """Return a polyline in pieces without sharp corners."""
    way = np.diff(points, axis=0)
    way = way / np.linalg.norm(way, axis=-1, keepdims=True)
    sharp = np.flatnonzero(np.sum(way[1:] * way[:-1], axis=-1) < CREASE) + 1
    if loop and not len(sharp):
        sharp = np.asarray([len(points) - 1])
    cuts = [0, *sharp.tolist(), len(points) - 1]
    return [points[a : b + 1] for a, b in pairwise(cuts) if b > a]


def _walls(pair: Array) -> Surface:
    """Return the side between two outlines (2, k, 3), sharp where these turn sharply."""
    low = pair[0]
    way = np.roll(low, -1, axis=0) - low
    way = way / np.maximum(np.linalg.norm(way, axis=-1, keepdims=True), 1e-30)
    sharp = np.flatnonzero(np.sum(way * np.roll(way, 1, axis=0), axis=-1) < CREASE)
    if not len(sharp):
        return _grid(pair, wrapped=True)
    corner = np.arange(len(low))
    # Where edges meet sharply each has a corner of its own: the first of a pair ends an edge, the second begins one.
    order = np.sort(np.concatenate((corner, sharp)))
    begin = np.searchsorted(order, corner, side="right") - 1
    end = np.roll(np.searchsorted(order, corner, side="left"), -1)
    width = len(order)
    indices = np.concatenate(
        (np.stack((begin, end, width + end), axis=-1), np.stack((begin, width + end, width + begin), axis=-1))
    )
    return Surface(positions=np.reshape(pair[:, order], (-1, 3)), indices=indices)


def _grid(rings: Array, *, wrapped: bool, start: bool = True, stop: bool = True) -> Surface:
    """Return the side through rings (m, c, 3); ``start`` and ``stop`` tell that the end ring is no single point."""
    m, c = rings.shape[:2]
    row = np.arange(m - 1)[:, None] * c
    one = np.arange(c if wrapped else c - 1)
    two = (one + 1) % c
    a, b = row + one, row + two
    lower = np.stack((a, b, b + c), axis=-1)
    upper = np.stack((a, b + c, a + c), axis=-1)
    lower = lower if start else lower[1:]
    upper = upper if stop else upper[:-1]
    indices = np.concatenate((lower.reshape(-1, 3), upper.reshape(-1, 3)))
    return Surface(positions=np.reshape(rings, (-1, 3)), indices=indices)


def _fan(ring: Array) -> Surface:
    """Return the flat end over a ring (c, 3), counter-clockwise seen from outside."""
    count = len(ring)
    one = np.arange(count)
    middle = np.full(count, count)
    return Surface(
        positions=np.concatenate((ring, np.mean(ring, axis=0, keepdims=True))),
        indices=np.stack((one, (one + 1) % count, middle), axis=-1),
    )


def _at(line: Array, height: float) -> Array:
    """Return points of a plane at a height, array (k, 3)."""
    return np.concatenate((line, np.full((len(line), 1), height)), axis=-1)
