"""Where curves are highest: smooth and periodic ones, Fourier sums, and series of instants with rates."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from cardan.maths.arrays import Array, ArrayLike

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


ALIKE = 1e-6
"""Tops of samples, by parabolas, that differ by less than this share may be the highest alike: the first counts."""


def tops(values: Array) -> Array:
    """Return each of evenly spaced samples (..., p), where it stands above its neighbours the top of the parabola.

    >>> tops(np.asarray([0.0, 1.0, 1.0, 0.0]))
    array([0.   , 1.125, 1.125, 0.   ])
    """
    table = np.asarray(values, dtype=float)
    if table.shape[-1] < 3:
        return table
    before, most, after = table[..., :-2], table[..., 1:-1], table[..., 2:]
    with np.errstate(invalid="ignore"):
        curve = 2.0 * most - before - after
        inside = (most >= before) & (most >= after) & (curve > 0.0) & np.isfinite(curve)
        rise = np.where(inside, (after - before) ** 2, 0.0) / (8.0 * np.where(inside, curve, 1.0))
    found = table.copy()
    found[..., 1:-1] += rise
    return found


def highest(
    function: Callable[[Array], Array], places: Array, values: Array, *, rounds: int = ROUNDS
) -> tuple[Array, Array]:
    """Return where each of several curves is highest between two ends, and how high.

    function: from places (m,), none beyond the ends, to the values of all curves there (k, m), nan where there is none.
    places (p,): evenly spaced, close enough for the tops of parabolas to tell which is the highest.
    values (k, p): ``function(places)``; rounds: how many times the places get closer.
    Returns place, value (k,): nan where a curve has no value at all.

    >>> x = np.linspace(0.0, 3.0, 31)
    >>> place, value = highest(lambda x: np.stack((np.sin(x), x)), x, np.stack((np.sin(x), x)))
    >>> place.round(5), value
    (array([1.5708, 3.    ]), array([1., 3.]))
    """
    table = np.where(np.isnan(values), -np.inf, values)
    height = tops(table)
    top = np.max(height, axis=-1, keepdims=True)
    with np.errstate(invalid="ignore"):
        best = np.argmax(height >= np.where(np.isfinite(top), top - ALIKE * np.abs(top), top), axis=-1)
    place = places[best]
    value = np.take_along_axis(table, best[:, None], axis=-1)[:, 0]
    step = float(places[1] - places[0]) if places.size > 1 else 0.0
    curves = np.arange(len(place))
    for _round in range(rounds if step and len(place) else 0):
        around = np.clip(place[:, None] + step * np.linspace(-1.0, 1.0, 2 * CLOSER + 1), places[0], places[-1])
        found = np.asarray(function(around.ravel())).reshape(len(place), *around.shape)[curves, curves]
        found = np.where(np.isnan(found), -np.inf, found)
        best = np.argmax(found, axis=-1)
        better = found[curves, best] > value
        place = np.where(better, around[curves, best], place)
        value = np.where(better, found[curves, best], value)
        step /= CLOSER
    none = value == -np.inf
    return np.where(none, np.nan, place), np.where(none, np.nan, value)


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


def peak(values: Array, *, smooth: bool = False) -> Array:
    """Return the largest values of periodic curves: of the quartic through the five samples about the largest.

    values (..., p): at evenly spaced places of a period.
    smooth: whether the curves have no kinks; then the two highest tops are looked at, for of two of nearly the same
    height the sample at the lower one may be the larger.

    >>> print(f"{float(peak(2.0 + np.cos(np.arange(120) * 2 * np.pi / 120 + 0.02))):.9f}")
    3.000000000
    """
    at = np.argmax(values, axis=-1)[..., None]
    count = values.shape[-1]
    if smooth:
        above = (values >= np.roll(values, 1, axis=-1)) & (values >= np.roll(values, -1, axis=-1))
        others = np.where(above & (np.arange(count) != at), values, -np.inf)
        at = np.concatenate((at, np.argmax(others, axis=-1)[..., None]), axis=-1)
    a, b, top, c, d = (np.take_along_axis(values, (at + k) % count, axis=-1) for k in range(-2, 3))
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
    highest: Array = np.max(np.maximum(top, found), axis=-1)
    return highest


# Series of instants with rates: what happens between the instants, by the quintic that fits both ends.

Series: TypeAlias = tuple[Array, Array, Array, Array]
"""Times (t,), rising, and value, rate and acceleration (t,) there."""

HALVINGS = 52
"""Bisections of an interval: down to rounding."""


def crossings(series: Series, level: float = 0.0, *, order: int = 0) -> Array:
    """Return the times at which the value (order 0) or the rate (order 1) passes through a level.

    series: times, values, rates, accelerations; order: 0 for the value, 1 for the rate.
    Returns (m,).
    An interval with an odd number of passages gives one of them; two passages within one interval go unseen.
    """
    times, value = series[0], series[1 + order] - level
    exact = times[value == 0.0]
    inside = np.flatnonzero(value[:-1] * value[1:] < 0.0)
    parts = _quintics(series, inside)
    low, high = np.zeros(inside.size), np.ones(inside.size)
    start = np.sign(value[inside])
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        before = np.sign(_at(parts, middle, order) - level) == start
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    width = times[inside + 1] - times[inside]
    found: Array = np.sort(np.concatenate((exact, times[inside] + 0.5 * (low + high) * width)))
    return found


def values_at(series: Series, at: Array, *, order: int = 0) -> Array:
    """Return the value (order 0) or rate (order 1) between the instants of a series.

    The quintic has the error h⁶ x⁽⁶⁾/46080 in the value at most, h the interval.
    """
    times = series[0]
    inside = np.clip(np.searchsorted(times, at, side="right") - 1, 0, times.size - 2)
    share = (at - times[inside]) / (times[inside + 1] - times[inside])
    return _at(_quintics(series, inside), share, order)


def turning_points(series: Series) -> tuple[Array, Array]:
    """Return the times at which the rate changes its sign, both ends included, and the values there."""
    times = series[0]
    if times.size < 2:
        return times, series[1]
    at = np.unique(np.concatenate((times[[0, -1]], crossings(series, order=1))))
    return at, values_at(series, at)


def _quintics(series: Series, inside: Array) -> tuple[Array, Array]:
    """Return coefficients (6, m) over the share of each interval, and the widths (m,)."""
    times, x, v, a = series
    h = times[inside + 1] - times[inside]
    p0, p1, p2 = x[inside], h * v[inside], 0.5 * h * h * a[inside]
    d = x[inside + 1] - p0 - p1 - p2
    e = h * v[inside + 1] - p1 - 2.0 * p2
    f = h * h * a[inside + 1] - 2.0 * p2
    return np.stack((p0, p1, p2, 10 * d - 4 * e + 0.5 * f, -15 * d + 7 * e - f, 6 * d - 3 * e + 0.5 * f)), h


def _at(parts: tuple[Array, Array], share: Array, order: int) -> Array:
    coefficients, width = parts
    if order:
        coefficients = coefficients[1:] * np.arange(1.0, 6.0)[:, None] / width
    total = coefficients[-1]
    for coefficient in coefficients[-2::-1]:
        total = total * share + coefficient
    return total


# Fourier sums: their values, their coefficients from samples, and their true extremes.

FINER = 8
"""Places on a period for each harmonic, before extremes are refined."""

WAVE_ROUNDS = 4
"""Newton steps towards an extreme; from a sixteenth of the shortest wave they reach rounding."""


def series_at(coefficient: Array, phase: ArrayLike) -> tuple[Array, Array, Array]:
    """Return Re Σ c_k e^(ikz) and its first two derivatives by z.

    coefficient (..., R, H+1), complex, phase (p,) [rad].
    Returns three arrays (..., p, R).
    """
    order = np.arange(coefficient.shape[-1])
    angle = np.asarray(phase, dtype=float)[:, None] * order
    # all three share the waves: their coefficients stand side by side
    every = np.concatenate((coefficient, 1j * order * coefficient, -(order**2) * coefficient), axis=-2).swapaxes(-1, -2)
    value, rate, second = np.split(np.cos(angle) @ every.real - np.sin(angle) @ every.imag, 3, axis=-1)
    return value, rate, second


def sampled_series(samples: Array) -> Array:
    """Return the coefficients c_k, k < p/2, of curves sampled evenly over a period, array (..., p/2) of (..., p)."""
    count = samples.shape[-1]
    found = np.fft.rfft(samples, axis=-1)[..., : (count + 1) // 2] * (2.0 / count)
    found[..., 0] *= 0.5
    return found


def extremes(coefficient: Array) -> tuple[Array, Array]:
    """Return the lowest and the highest value of Fourier sums, arrays (...), of coefficients (..., H+1)."""
    outer = coefficient.shape[:-1]
    flat = coefficient.reshape(-1, coefficient.shape[-1])
    size = np.abs(flat)
    if not size.size or not np.isfinite(size).all():
        size = np.where(np.isfinite(size), size, 0.0)
    heavy = np.flatnonzero(np.any(size > 1e-14 * np.max(size, initial=0.0), axis=0))
    flat = flat[:, : (heavy[-1] + 1 if heavy.size else 1)]
    order = np.arange(flat.shape[-1])
    count = FINER * max(len(order), 2)
    padded = np.zeros((len(flat), count // 2 + 1), dtype=complex)
    padded[:, : len(order)] = 0.5 * count * flat
    padded[:, 0] *= 2.0
    values = np.fft.irfft(padded, n=count, axis=-1)
    ends = []
    for side in (-1.0, 1.0):
        best = np.argmax(side * values, axis=-1)
        place = 2.0 * np.pi * best / count
        level = values[np.arange(len(flat)), best]
        for _round in range(WAVE_ROUNDS):
            wave = flat * np.exp(1j * place[:, None] * order)
            slope, joint_angle = -np.sum(order * wave.imag, axis=-1), -np.sum(order**2 * wave.real, axis=-1)
            safe = np.where(side * joint_angle < 0.0, joint_angle, -side)
            step = np.where(side * joint_angle < 0.0, -slope / safe, 0.0)
            place = place + np.clip(step, -2.0 * np.pi / count, 2.0 * np.pi / count)
        refined = np.sum((flat * np.exp(1j * place[:, None] * order)).real, axis=-1)
        ends.append(side * np.maximum(side * refined, side * level))
    return ends[0].reshape(outer), ends[1].reshape(outer)
