"""The links of a mechanism as bodies: bars between their pairs, with the pins, balls and slides that they carry."""

from __future__ import annotations

import numpy as np

from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.maths.kernel.meshes import Surface, ball, joined, placed, revolved
from cardan.mechanism.mechanism import Mechanism, Pair

THIN = 0.018
"""Radius of a bar over the size of the mechanism."""

SIDES = 12
"""Faces round a bar."""


def size_of(mechanism: Mechanism) -> float:
    """Return the largest distance of a pair from the middle of all [m]."""
    points = np.asarray([pair.point for pair in mechanism.joints], dtype=float)
    return float(np.max(frames.norm(points - 0.5 * (points.min(axis=0) + points.max(axis=0))))) or 0.1


def link_body(mechanism: Mechanism, link: str) -> Surface:
    """Return a link where it is drawn, the frame as the halves of its pairs alone."""
    thin = THIN * size_of(mechanism)
    own = [pair for pair in mechanism.joints if link in pair.links]
    middle = np.mean([pair.point for pair in own], axis=0)
    parts = [] if link == mechanism.frame else [placed(ball(1.2 * thin, SIDES), None, middle)]
    for pair in own:
        point = np.asarray(pair.point, dtype=float)
        if link != mechanism.frame and frames.norm(point - middle) > thin:
            parts.append(_bar(middle, point, thin))
        parts.append(_half(pair, link, point, thin))
    return joined(*parts)


def _half(pair: Pair, link: str, point: Array, thin: float) -> Surface:
    """Return what a link has of a pair: the first one the longer, thinner half."""
    first = pair.links[0] == link
    if pair.kind.rolls:
        return placed(ball((1.2 if first else 1.6) * thin, SIDES), None, point)
    if pair.axis is None or pair.kind.turns == "all":
        return placed(ball((1.4 if first else 2.0) * thin, SIDES), None, point)
    along = pair.along
    reach, wide = ((4.5 if pair.kind.slides else 3.2), 1.1) if first else (2.0, 1.8)
    return _bar(point - reach * thin * along, point + reach * thin * along, wide * thin)


def _bar(start: Array, end: Array, radius: float) -> Surface:
    """Return a round bar between two points."""
    length = float(frames.norm(end - start))
    along = (end - start) / length
    aside = frames.perpendicular(along)
    bar = revolved([(0.0, 0.0), (0.0, radius), (length, radius), (length, 0.0)], SIDES)
    return placed(bar, np.stack((along, aside, frames.cross(along, aside))), start)
