"""Bearings in the housing, and the bracket that holds them."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from cardan.maths.arrays import Array
from cardan.maths.kernel.meshes import Surface, box, circle, joined, placed, plate, revolved, swept

from .ring import ring, washer


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
        (-0.5, low),
        (-0.42, 0.5 * (low + high)),
        (-0.5, high),
        (0.5, high),
        (0.42, 0.5 * (low + high)),
        (0.5, low),
    ]
    return revolved([(width * x, r) for x, r in [*bulge, bulge[0]]], 32)


@lru_cache(maxsize=64)
def bracket(radius: float, *, soft: bool, wide: bool, axial: bool) -> Surface:
    """Return the housing of a bearing and its foot: x along the shaft, z away from the floor.

    Parameters
    ----------
    radius : float [m]
        Of the shaft in the bearing.
    soft : bool
        Whether rubber lies between.
    wide : bool
        Whether the bearing holds the slope too.
    axial : bool
        Whether it holds the shaft lengthwise: the housing has a collar on either side.
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

    Parameters
    ----------
    axis : array (3,)
        Direction of the shaft.
    gravity : array (3,)
        Where things fall; downwards where it is zero.
    """
    down = gravity if float(np.linalg.norm(gravity)) > 1e-9 else np.asarray([0.0, 0.0, -1.0])
    up = -down + float(down @ axis) * axis
    if float(np.linalg.norm(up)) < 1e-6 * float(np.linalg.norm(down)):
        up = np.cross(axis, np.asarray([0.0, 1.0, 0.0]) if abs(axis[1]) < 0.9 else np.asarray([1.0, 0.0, 0.0]))
    up = up / np.linalg.norm(up)
    return np.stack((axis, np.cross(up, axis), up))
