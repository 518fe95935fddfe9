"""Histories of load: cycles counted by rainflow, time spent at each level."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from cardan.errors import refuse
from cardan.formulas.joint_rating import POWER
from cardan.maths.arrays import Array, ArrayLike
from cardan.texts import _

LEVELS = 40
"""Levels of a histogram when none are given."""

CHUNK = 20_000
"""Stretches of a history taken at once."""

STEEP = 0.1
"""Stretches that change by less than this share of their size are integrated by Gauss's rule, others in closed form."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Cycles:
    """Cycles of a history, one an entry.

    Attributes
    ----------
    range : array (k,)
        From trough to peak.
    mean : array (k,)
        Middle of both.
    count : array (k,)
        1 for a closed cycle, 0.5 for one that the history leaves open.
    start, end : arrays of int (k,)
        Places of its two turning points in the history.
    """

    range: Array
    mean: Array
    count: Array
    start: Array
    end: Array

    @property
    def total(self) -> float:
        """Cycles in all, open ones as halves."""
        return float(np.sum(self.count))

    def equivalent_range(self, slope: float, cycles: float | None = None) -> float:
        """Return the range that damages as much in so many cycles, (Σ count·range^m/N)^(1/m).

        Parameters
        ----------
        slope : float
            m, slope of the line of fatigue.
        cycles : float, optional
            N; those of the history when not given.
        """
        most = float(np.max(self.range, initial=0.0))
        if most == 0.0:
            return 0.0
        damage = float(np.sum(self.count * (self.range / most) ** slope))
        share = damage / (self.total if cycles is None else cycles)
        return float(most * share ** (1.0 / slope))


@dataclass(frozen=True, eq=False, kw_only=True)
class Levels:
    """Share of the time that a history spends between levels.

    Attributes
    ----------
    edge : array (k+1,)
        Levels, rising; a history of both signs has one at zero.
    share : array (k,)
        Of the whole time, between one level and the next; they add up to 1.
    value : array (k,)
        Value that damages as much as what lies between: mean of the 10/3rd power, with the sign of the level; the
        middle where there is nothing.
    duration : float [s]
        Time from the first to the last row.
    mean, low, high : float
        Of the whole history.
    """

    edge: Array
    share: Array
    value: Array
    duration: float
    mean: float
    low: float
    high: float

    @property
    def equivalent(self) -> float:
        """Constant value that damages rolling bearings as much, whatever the number of levels."""
        return float(np.sum(self.share * np.abs(self.value) ** POWER) ** (1.0 / POWER))


def turning_points(values: ArrayLike) -> Array:
    """Return the places of the peaks and troughs of a history, its first and last value included.

    values (t,): the history; on a level stretch the first place counts.
    Returns (k,) of int.
    """
    series = np.asarray(values, dtype=float)
    kept = np.flatnonzero(np.concatenate(([True], np.diff(series) != 0.0)))
    steps = np.sign(np.diff(series[kept]))
    turns = np.flatnonzero(steps[1:] != steps[:-1]) + 1
    last = [kept.size - 1] if kept.size > 1 else []
    return kept[np.concatenate(([0], turns, last)).astype(int)]


def rainflow(values: ArrayLike) -> Cycles:
    """Return the cycles of a history, counted by rainflow.

    Parameters
    ----------
    values : array (t,)
        The history, finite.

    Returns
    -------
    Cycles
        In the order in which they close; what stays open comes last, as halves.

    See Also
    --------
    time_at_level

    Notes
    -----
    ASTM E1049-85, 5.4.4: of three turning points the earlier range is a cycle once the later one is no smaller, half
    a cycle where it holds the start of the history.

    Examples
    --------
    >>> from cardan.recordings import rainflow
    >>> found = rainflow([-2, 1, -3, 5, -1, 3, -4, 4, -2])
    >>> for size in sorted(set(found.range)):
    ...     print(f"{size:.0f}: {found.count[found.range == size].sum()}")
    3: 0.5
    4: 1.5
    6: 0.5
    8: 1.0
    9: 0.5
    """
    series = np.asarray(values, dtype=float)
    if series.ndim != 1 or not np.all(np.isfinite(series)):
        raise refuse("values", _("a list of finite numbers is needed"))
    if series.size == 0:
        raise refuse("values", _("empty; a history has at least one value"), "empty")
    places = turning_points(series)
    level = series[places].tolist()
    stack: list[int] = []
    found: list[tuple[int, int, float]] = []
    for k, value in enumerate(level):
        stack.append(k)
        while len(stack) > 2:
            low, high = level[stack[-3]], level[stack[-2]]
            if abs(value - high) < abs(high - low):
                break
            if len(stack) == 3:
                found.append((stack[0], stack[1], 0.5))
                del stack[0]
            else:
                found.append((stack[-3], stack[-2], 1.0))
                del stack[-3:-1]
    found += [(one, two, 0.5) for one, two in pairwise(stack)]
    start, end = (np.asarray([cycle[side] for cycle in found], dtype=int) for side in (0, 1))
    turned = np.asarray(level)
    return Cycles(
        range=np.abs(turned[end] - turned[start]),
        mean=0.5 * (turned[end] + turned[start]),
        count=np.asarray([cycle[2] for cycle in found], dtype=float),
        start=places[start],
        end=places[end],
    )


def time_at_level(times: ArrayLike, values: ArrayLike, *, edges: ArrayLike | int = LEVELS) -> Levels:
    """Return which share of its time a history spends between levels, straight from row to row.

    Parameters
    ----------
    times : array (t,) [s]
        Rising, at least two.
    values : array (t,)
        The history.
    edges : array (k+1,) or int
        Levels, rising, that hold all values; or how many, evenly spaced.

    Returns
    -------
    Levels

    See Also
    --------
    rainflow

    Notes
    -----
    Shares and mean powers are integrated exactly along the straight stretches, so that they do not depend on the rate
    of sampling, and their sums not on the levels.

    Examples
    --------
    >>> from cardan.recordings import time_at_level
    >>> found = time_at_level([0.0, 1.0, 3.0], [0.0, 10.0, 10.0], edges=[0.0, 5.0, 10.0])
    >>> print(found.share.round(4), f"{found.mean:.4f}")
    [0.1667 0.8333] 8.3333
    """
    t, x = np.asarray(times, dtype=float), np.asarray(values, dtype=float)
    if t.ndim != 1 or t.shape != x.shape or t.size < 2 or not np.all(np.isfinite((t, x))) or np.any(np.diff(t) <= 0.0):
        raise refuse("times", _("rising finite times are needed, at least two, and a finite value for each"))
    low, high = float(np.min(x)), float(np.max(x))
    edge = _edges(low, high, edges) if isinstance(edges, int) else np.asarray(edges, dtype=float)
    if edge.ndim != 1 or edge.size < 2 or np.any(np.diff(edge) <= 0.0) or edge[0] > low or edge[-1] < high:
        raise refuse("edges", _("the levels must rise and hold all values"), "out_of_range")
    step = np.diff(t)
    time, power, count = np.zeros(edge.size - 1), np.zeros(edge.size - 1), step.size
    for begin in range(0, count, CHUNK):
        part = slice(begin, min(begin + CHUNK, count))
        some = _between(x[:-1][part], x[1:][part], step[part], edge)
        time, power = time + some[0], power + some[1]
    whole = float(t[-1] - t[0])
    middle = 0.5 * (edge[:-1] + edge[1:])
    spent = time > 0.0
    size = (power / np.where(spent, time, 1.0)) ** (1.0 / POWER)
    return Levels(
        edge=edge,
        share=time / float(np.sum(time)),
        value=np.where(spent, np.copysign(size, middle), middle),
        duration=whole,
        mean=float(np.sum(0.5 * (x[:-1] + x[1:]) * step)) / whole,
        low=low,
        high=high,
    )


def speed_at_level(times: ArrayLike, values: ArrayLike, speeds: ArrayLike, edges: ArrayLike) -> Array:
    """Return the mean size of the speed while a history is between levels, array (k,) [rad/s]: turns over time.

    times, values, speeds (t,) [s, any, rad/s], edges (k+1,) as of `time_at_level`; 0 where nothing is spent.
    Within a stretch the values count as even over the turning.
    """
    t, x, speed = (np.asarray(one, dtype=float) for one in (times, values, np.abs(np.asarray(speeds, dtype=float))))
    edge = np.asarray(edges, dtype=float)
    time, turned = np.zeros(edge.size - 1), np.zeros(edge.size - 1)
    step = np.diff(t)
    angle = 0.5 * (speed[:-1] + speed[1:]) * step
    for begin in range(0, step.size, CHUNK):
        part = slice(begin, begin + CHUNK)
        time = time + _between(x[:-1][part], x[1:][part], step[part], edge)[0]
        turned = turned + _between(x[:-1][part], x[1:][part], angle[part], edge)[0]
    return turned / np.where(time > 0.0, time, 1.0)


def _edges(low: float, high: float, count: int) -> Array:
    """Return levels from the least to the largest value, one of them at zero where that lies between."""
    if count < 1:
        raise refuse("edges", _("at least one level is needed"), "out_of_range")
    if low == high:
        half = 0.5 * abs(low) or 0.5
        return np.asarray([low, low + half] if low >= 0.0 else [low - half, low])
    if low < 0.0 < high and count > 1:
        below = min(max(round(count * -low / (high - low)), 1), count - 1)
        return np.concatenate((np.linspace(low, 0.0, below + 1), np.linspace(0.0, high, count - below + 1)[1:]))
    return np.linspace(low, high, count + 1)


def _between(first: Array, last: Array, step: Array, edge: Array) -> tuple[Array, Array]:
    """Return time and integral of the 10/3rd power between levels, summed over straight stretches."""
    bottom, top = np.minimum(first, last)[:, None], np.maximum(first, last)[:, None]
    level = bottom[:, 0] == top[:, 0]
    rise = np.where(level[:, None], 1.0, top - bottom)
    since, until = np.clip(edge[:-1], bottom, top), np.clip(edge[1:], bottom, top)
    share = (until - since) / rise
    if np.any(level):
        at = np.clip(np.searchsorted(edge, bottom[level, 0], side="right") - 1, 0, edge.size - 2)
        share[np.flatnonzero(level), at] = 1.0
        since[np.flatnonzero(level), at] = until[np.flatnonzero(level), at] = bottom[level, 0]
    mean = _mean_power(since, until)
    time = step[:, None] * share
    return np.sum(time, axis=0), np.sum(time * mean, axis=0)


def _mean_power(low: Array, high: Array) -> Array:
    """Return the mean of the size to the 10/3rd power between two values of one sign or of both."""
    size = np.maximum(np.abs(low), np.abs(high))
    width = high - low
    steep = width > STEEP * size
    closed = (_primitive(high) - _primitive(low)) / np.where(steep, width, 1.0)
    node, weight = np.polynomial.legendre.leggauss(6)
    middle, half = 0.5 * (low + high), 0.5 * width
    gauss = sum(0.5 * w * np.abs(middle + half * x) ** POWER for x, w in zip(node, weight, strict=True))
    return np.where(steep, closed, gauss)


def _primitive(value: Array) -> Array:
    return np.sign(value) * np.abs(value) ** (POWER + 1.0) / (POWER + 1.0)
