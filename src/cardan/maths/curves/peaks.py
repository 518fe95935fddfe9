"""Where smooth curves are highest, to all digits that matter: over a period, or from slopes at known places."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from cardan.maths.arrays import Array

CLOSER = 20
"""How much finer the places around each peak lie than before."""

ROUNDS = 3
"""Times that the places get closer. From steps of a degree three rounds lead to 2e-6 rad: at a smooth peak the value
is then right to the square of that."""

NEAR = 2e-3
"""Steps within this share of the highest are looked at closely: more than cubics through their ends err by."""

ROUNDS_MOST = 60
"""Times that the place of a level slope is bettered at most; ten are usual."""

TIE = 1e-9
"""Places whose values differ by less than this share are equally high: the first counts, whatever rounding says."""


def peaks(function: Callable[[Array], Array], places: Array, values: Array) -> tuple[Array, Array]:
    """Return where each of several curves is highest, and how high.

    function: from places (m,) to the values of all curves there (k, m).
    places (p,): evenly spaced, close enough that the highest place is beside the highest point.
    values (k, p): ``function(places)``.
    Returns place, value (k,).
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


def brackets(place: Array, value: Array, slope: Array) -> tuple[Array, Array]:
    """Return the steps in which a curve is level about as far from nought as anywhere, by cubics through their ends.

    place, value, slope (p,): places, and the curve and its slope there, close enough that a step holds one level place
    at most.
    Returns left, right (m,): ends of the steps whose levels are within `NEAR` of the farthest.

    >>> x = np.linspace(0.0, 6.0, 31)
    >>> print(*brackets(x, x * np.sin(x), np.sin(x) + x * np.cos(x)))
    [4.8] [5.]
    """
    rows = np.flatnonzero(slope[:-1] * slope[1:] <= 0.0)
    h = (place[rows + 1] - place[rows])[:, None]
    u = np.linspace(0.0, 1.0, 9)
    cubic = (
        value[rows, None] * (1.0 + 2.0 * u) * (1.0 - u) ** 2
        + value[rows + 1, None] * (3.0 - 2.0 * u) * u * u
        + h * (slope[rows, None] * (1.0 - u) - slope[rows + 1, None] * u) * u * (1.0 - u)
    )
    height = np.max(np.abs(cubic), axis=-1)
    rows = rows[height >= (1.0 - NEAR) * np.max(height, initial=0.0)]
    return place[rows], place[rows + 1]


def level(slope: Callable[[Array], Array], left: Array, right: Array) -> Array:
    """Return where slopes change sign between two places, array (m,).

    slope: from a place of each of m curves (m,) to their slopes there.
    left, right (m,): places with slopes of unlike signs.
    By chords, the end that stays halved in weight (Illinois).

    >>> level(np.cos, np.asarray([1.0]), np.asarray([2.0])).round(9)
    array([1.57079633])
    """
    low, high = slope(left), slope(right)
    middle = right
    for _round in range(ROUNDS_MOST):
        span = high - low
        before = middle
        middle = np.where(span != 0.0, right - high * (right - left) / np.where(span != 0.0, span, 1.0), left)
        here = slope(middle)
        beyond = (here > 0.0) == (high > 0.0)
        left, low = np.where(beyond, left, right), np.where(beyond, 0.5 * low, high)
        right, high = middle, here
        if np.all(np.abs(middle - before) <= 1e-15 * np.abs(middle)):
            break
    return middle


def peak(values: Array) -> Array:
    """Return the largest values of periodic curves: of the quartic through the five samples about the largest.

    values (..., p): at evenly spaced places of a period.

    >>> print(f"{float(peak(2.0 + np.cos(np.arange(120) * 2 * np.pi / 120 + 0.02))):.9f}")
    3.000000000
    """
    at = np.argmax(values, axis=-1)[..., None]
    count = values.shape[-1]
    a, b, top, c, d = (np.take_along_axis(values, (at + k) % count, axis=-1)[..., 0] for k in range(-2, 3))
    first = (a - 8.0 * b + 8.0 * c - d) / 12.0
    second = (-a + 16.0 * b - 30.0 * top + 16.0 * c - d) / 12.0
    third = 0.5 * (-a + 2.0 * b - 2.0 * c + d)
    fourth = a - 4.0 * b + 6.0 * top - 4.0 * c + d
    curved = np.where(second < 0.0, second, -1.0)
    place = np.where(second < 0.0, np.clip(-first / curved, -1.0, 1.0), 0.0)
    for _step in range(2):
        slope = first + place * (second + place * (0.5 * third + place * fourth / 6.0))
        rise = second + place * (third + 0.5 * place * fourth)
        place = np.where(rise < 0.0, np.clip(place - slope / np.where(rise < 0.0, rise, -1.0), -1.0, 1.0), 0.0)
    found = top + place * (first + place * (0.5 * second + place * (third / 6.0 + place * fourth / 24.0)))
    return np.maximum(top, found)
