"""Axes that fit what they hold: round ticks, written with as many decimals as they need."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import pairwise

import numpy as np

from cardan.answers.numbers import significant
from cardan.maths.arrays import Array

from .figure import Axis


def steps(low: float, high: float, count: int = 5) -> tuple[float, ...]:
    """Return round values between two bounds, about ``count`` of them."""
    span = high - low
    if not span > 0.0:
        return (low,)
    rough = span / max(count, 1)
    size = 10.0 ** math.floor(math.log10(rough))
    step = min((m * size for m in (1.0, 2.0, 5.0, 10.0)), key=lambda s: abs(math.log(s / rough)))
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return tuple(round(k * step, 12 - math.floor(math.log10(step))) + 0.0 for k in range(first, last + 1))


def written(values: Sequence[float]) -> tuple[str, ...]:
    """Return tick values with as many decimals as tell them apart, and a true minus."""
    gap = min((b - a for a, b in pairwise(values)), default=abs(values[0]) if values else 1.0)
    if gap and gap < 1e-5:
        told = ([significant(v, digits) for v in values] for digits in (1, 2, 3))
        return tuple(next((row for row in told if len(set(row)) == len(row)), [significant(v, 4) for v in values]))
    decimals = max(0, 2 - math.floor(math.log10(gap) + 1e-9)) if gap > 0.0 else 3
    texts = [f"{v:,.{decimals}f}" for v in values]
    while decimals and all(t.endswith("0") for t in texts):
        decimals -= 1
        texts = [f"{v:,.{decimals}f}" for v in values]
    return tuple(
        "0" if v == 0.0 else t.replace(",", "\u202f").replace("-", "−") for v, t in zip(values, texts, strict=True)
    )


def axis(
    label: str,
    unit: str,
    values: Iterable[Array] = (),
    *,
    dimension: str = "",
    include: Sequence[float] = (),
    least: float = 0.0,
    mirrored: float | None = None,
    count: int = 5,
    margin: float = 0.06,
) -> Axis:
    """Return an axis that fits values, never narrower than ``least``: rounding noise stays a flat line.

    label, unit, dimension: what runs along it; see `Axis`.
    include: values always within its range; least: smallest range drawn; mirrored: value in the middle of the axis.
    count: about how many ticks; margin: share of the range left free at both ends.
    """
    flat = [np.asarray(value, dtype=float).ravel() for value in values]
    every = np.concatenate([*flat, np.asarray(include, dtype=float)]) if flat or include else np.asarray([0.0, 1.0])
    every = every[np.isfinite(every)]
    low, high = (float(np.min(every)), float(np.max(every))) if every.size else (0.0, 1.0)
    if mirrored is not None:
        reach = max(high - mirrored, mirrored - low)
        low, high = mirrored - reach, mirrored + reach
    span = high - low
    if span < least or span == 0.0:
        middle = mirrored if mirrored is not None else 0.5 * (low + high)
        half = 0.5 * (least or abs(middle) or 1.0)
        low, high = middle - half, middle + half
    else:
        below = margin if low < 0.0 or low > 0.0 else 0.02  # a range from nought begins there
        low, high = low - min(below, margin) * span, high + margin * span
    ticks = steps(low, high, count)
    return Axis(label=label, unit=unit, dimension=dimension, low=low, high=high, ticks=ticks, texts=written(ticks))


def clear_way(places: Array, rings: Sequence[float], first: complex) -> complex:
    """Return the diagonal direction along which words at rings are farthest from what is drawn.

    places (p,), complex: where something is drawn; rings: distances of the words from the middle.
    first: the diagonal taken where that is as good as any, of length 1.

    >>> import numpy as np
    >>> way = clear_way(np.asarray([1.0 + 1.0j]), [1.4], np.exp(0.25j * np.pi))
    >>> bool(np.isclose(way, np.exp(0.75j * np.pi)))
    True
    """
    ways = [first * 1j**k for k in (0, 1, 3, 2)]
    known = places[np.isfinite(places)]
    if not known.size or not len(rings):
        return first
    words = np.asarray(ways)[:, None] * np.asarray(rings)
    free = np.min(np.abs(words[..., None] - known), axis=(1, 2))
    return ways[int(np.argmax(np.minimum(free, 0.3 * max(rings))))]


def angle_axis(label: str, stop: float = 360.0) -> Axis:
    """Return the axis of an angle of rotation [°], marked every eighth of a turn."""
    ticks = tuple(float(k) for k in range(0, int(stop) + 1, 45 if stop <= 360.0 else 90))
    return Axis(label=label, unit="deg", dimension="angle", low=0.0, high=stop, ticks=ticks, texts=written(ticks))
