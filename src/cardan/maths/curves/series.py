"""Series of instants with rates: what happens between the instants, by the quintic that fits both ends."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np

from cardan.maths.arrays import Array

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
