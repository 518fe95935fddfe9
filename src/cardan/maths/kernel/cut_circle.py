"""A circle with a segment cut off: area, centroid and second moments of what remains."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np

from cardan.maths.arrays import Array, ArrayLike

NODES = 24
"""Points of Gauss's rule; the powers of sine and cosine below are exact with them to rounding."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CutCircle:
    """What remains of circles, the y axis through the middle of the chord, the segment beyond it away."""

    area: Array  # (...): of the rest
    shift: Array  # (...): from the centre of the circle to the centroid of the rest, away from the chord
    second_x: Array  # (...): ∫y² dA about the centre of the circle
    second_y: Array  # (...): ∫x² dA, about the centre and about the centroid
    second_x_centroid: Array  # (...): ∫y² dA about the centroid
    # loss_x, loss_y (...): shares by which the moments about the centroid are below that of the whole circle
    loss_x: Array
    loss_y: Array  # (...)


def cut_circle(radius: ArrayLike, depth: ArrayLike) -> CutCircle:
    """Return area, centroid and second moments of circles with a segment cut off.

    radius (...): R; depth (...): height of the segment over the radius, in [0, 2).
    Returns CutCircle: in the unit of the radius and its powers.
    With y = R cos t the chord lies at cos t = 1 - depth, a strip has the area 2R² sin² t dt, and every quantity is an
    integral of a positive function over t, by Gauss's rule: nothing cancels, whether the segment is almost nothing or
    almost all.
    """
    r, high = np.broadcast_arrays(np.asarray(radius, dtype=float), np.asarray(depth, dtype=float))
    edge = 2.0 * np.arcsin(np.sqrt(0.5 * high))
    node, weight = _rule()
    away, stay = edge[..., None] * node, np.pi + (edge[..., None] - np.pi) * node
    cut, kept = edge[..., None] * weight, (np.pi - edge[..., None]) * weight

    def total(values: Array, width: Array) -> Array:
        found: Array = np.sum(values * width, axis=-1)
        return found

    sine = np.sin(stay)
    area = total(2.0 * sine**2, kept)
    shift = 2.0 * np.sin(edge) ** 3 / (3.0 * area)
    second_y = total(sine**4, kept) * 2.0 / 3.0
    second_x = total(2.0 * (sine * np.cos(stay)) ** 2, kept)
    centred = total(2.0 * ((np.cos(stay) + shift[..., None]) * sine) ** 2, kept)
    gone_x = total(2.0 * (np.sin(away) * np.cos(away)) ** 2, cut) + area * shift**2
    gone_y = total(np.sin(away) ** 4, cut) * 2.0 / 3.0
    return CutCircle(
        area=r**2 * area,
        shift=r * shift,
        second_x=r**4 * second_x,
        second_y=r**4 * second_y,
        second_x_centroid=r**4 * centred,
        loss_x=4.0 * gone_x / np.pi,
        loss_y=4.0 * gone_y / np.pi,
    )


@cache
def _rule() -> tuple[Array, Array]:
    """Return nodes and weights on (0, 1)."""
    node, weight = np.polynomial.legendre.leggauss(NODES)
    return 0.5 + 0.5 * node, 0.5 * weight
