"""Rings, discs and flanges about x."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from cardan.maths.kernel.meshes import Surface, joined, placed, revolved

from .yoke import bolt_ring


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
