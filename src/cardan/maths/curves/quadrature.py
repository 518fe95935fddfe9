"""Means over a period of functions that are smooth between known kinks."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np

from cardan.maths.arrays import Array, namespace

ORDERS = (12, 24, 48, 96, 192)
"""Points between two kinks, doubled until the mean rests."""

RESTS = 1e-12
"""Share of the mean magnitude by which a mean may still change when it rests; twice the points square its error."""


def mean_between(function: Callable[[Array], Array], kinks: Array, *, period: float, rests: float = RESTS) -> Array:
    """Return the mean over one period of a function with kinks, each stretch by Gauss's rule.

    function: from places (..., p) to values (..., k, p), of this period.
    kinks (..., m): where its derivative may jump, modulo the period, in any order; at least one.
    rests: share of the mean magnitude by which a mean may still change.
    Returns (..., k): nan where the function is.
    The error falls with the 2p-th power of the number of points p on each stretch, however sharp the kinks. Where a
    function is steep it is so at the kinks, where Gauss's points crowd.
    """
    xp = namespace(kinks)
    edges = xp.sort(xp.remainder(kinks, period), axis=-1)
    width = xp.concat((edges[..., 1:], edges[..., :1] + period), axis=-1) - edges
    found: Array = None
    for order in ORDERS:
        node, weight = (xp.asarray(row) for row in _rule(order))
        shape = (*edges.shape[:-1], edges.shape[-1] * order)
        place = xp.reshape(edges[..., None] + width[..., None] * node, shape)
        share = xp.reshape(width[..., None] * weight, shape) / period
        parts = function(place) * share[..., None, :]
        before, found = found, xp.sum(parts, axis=-1)
        if before is not None and not bool(xp.any(xp.abs(found - before) > rests * xp.sum(xp.abs(parts), axis=-1))):
            break
    return found


@cache
def _rule(order: int) -> tuple[Array, Array]:
    """Return nodes and weights on (0, 1)."""
    node, weight = np.polynomial.legendre.leggauss(order)
    return 0.5 + 0.5 * node, 0.5 * weight
