"""Where smooth curves over a period are highest, to all digits that matter."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from .arrays import Array

CLOSER = 20
"""How much finer the places around each peak lie than before."""

ROUNDS = 3
"""Times that the places get closer. From steps of a degree three rounds lead to 2e-6 rad: at a smooth peak the value
is then right to the square of that."""

TIE = 1e-9
"""Places whose values differ by less than this share are equally high: the first counts, whatever rounding says."""


def peaks(function: Callable[[Array], Array], places: Array, values: Array) -> tuple[Array, Array]:
    """Return where each of several curves is highest, and how high.

    Parameters
    ----------
    function : callable
        From places (m,) to the values of all curves there (k, m).
    places : array (p,)
        Evenly spaced, close enough that the highest place is beside the highest point.
    values : array (k, p)
        ``function(places)``.

    Returns
    -------
    place, value : arrays (k,)

    Examples
    --------
    >>> coarse = np.linspace(0.0, 6.0, 61)
    >>> curves = lambda x: np.stack((np.sin(x), np.cos(x - 1.23456)))
    >>> place, value = peaks(curves, coarse, curves(coarse))
    >>> place.round(4)
    array([1.5708, 1.2346])
    """
    top = np.max(values, axis=-1, keepdims=True)
    best = np.argmax(values >= top - TIE * np.abs(top), axis=-1)
    place = places[best]
    value = np.take_along_axis(values, best[:, None], axis=-1)[:, 0]
    step = float(places[1] - places[0]) if places.size > 1 else 0.0
    curves = np.arange(len(place))
    for _round in range(ROUNDS if step and len(place) else 0):
        around = place[:, None] + step * np.linspace(-1.0, 1.0, 2 * CLOSER + 1)
        found = function(around.ravel()).reshape(len(place), *around.shape)[curves, curves]
        best = np.argmax(found, axis=-1)
        better = found[curves, best] > value
        place = np.where(better, around[curves, best], place)
        value = np.where(better, found[curves, best], value)
        step /= CLOSER
    return place, value
