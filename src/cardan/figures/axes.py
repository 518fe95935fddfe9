"""Axes that fit what they hold: round ticks, written with as many decimals as they need."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from cardan.answers.palette import DASHES
from cardan.answers.reader import raised, significant
from cardan.maths.arrays import Array
from cardan.texts import _

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


# Numbers as people read them.


def percent(share: float, digits: int = 3) -> str:
    """Return a share in percent; what is nothing but rounding is 0."""
    if abs(share) < 1e-13:
        return "0 %"
    return f"{significant(100.0 * share, digits)} %"


def decades(low: float, high: float) -> tuple[float, ...]:
    """Return round values along a logarithmic axis: powers of ten, steps of 2 and 5 where these are few, or even ones.

    >>> decades(0.5, 2000.0), decades(8.0, 300.0)
    ((1.0, 10.0, 100.0, 1000.0), (10.0, 20.0, 50.0, 100.0, 200.0))
    >>> decades(55.0, 130.0)
    (60.0, 80.0, 100.0, 120.0)
    """
    first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
    powers = [10.0**k for k in range(first, last + 1) if low <= 10.0**k <= high]
    if len(powers) >= 3:
        return tuple(powers[:: math.ceil(len(powers) / 6)])
    marks = tuple(m * 10.0**k for k in range(first, last + 1) for m in (1, 2, 5) if low <= m * 10.0**k <= high)
    return marks if len(marks) >= 3 else steps(low, high, 4)


def log_axis(label: str, unit: str, low: float, high: float, *, dimension: str) -> Axis:
    """Return a logarithmic axis between two bounds; label, unit, dimension: what runs along it, see `Axis`."""
    ticks = decades(low, high)
    texts = tuple(written((one,))[0] for one in ticks)
    return Axis(label=label, unit=unit, dimension=dimension, low=low, high=high, ticks=ticks, texts=texts, log=True)


def powers_of_ten(values: Sequence[float]) -> tuple[str, ...]:
    """Return powers of ten, in full where all of them are short.

    >>> powers_of_ten((0.01, 1.0)), powers_of_ten((1e-6, 1.0))
    (('0.01', '1'), ('10⁻⁶', '10⁰'))
    """
    powers = [round(math.log10(value)) for value in values]
    if all(-3 < power < 4 for power in powers):
        return tuple(f"{value:g}" for value in values)
    return tuple(f"10{raised(power)}" for power in powers)


# What figures over the input angle share: the axis, and how shafts and supports are called.

LONG = 24
"""Letters of a name in a legend."""


def across(angle: Array, *, named: bool = False) -> Axis:
    """Return the axis of the input angle [°]; without name and unit where a panel below carries them.

    angle (p,): input angles [°]; named: write what runs along it.
    """
    label = _("input angle φ₁ from the start position") if named else ""
    stop = float(np.max(angle)) if angle.size else 360.0
    if float(np.min(angle, initial=0.0)) < 0.0 or stop > 1080.0 or stop < 45.0:
        made = axis(label, "deg", [angle], dimension="angle", margin=0.0, least=1.0)
    else:
        made = angle_axis(label, stop)
    bare = Axis(low=made.low, high=made.high, ticks=made.ticks, texts=made.texts)
    return replace(made if named else bare, turning=True)


def shaft_name(number: int, count: int) -> str:
    """Return what a shaft is called in a legend.

    >>> shaft_name(1, 3), shaft_name(2, 3), shaft_name(3, 3)
    ('shaft 1, input', 'shaft 2', 'shaft 3, output')
    """
    if number == 1:
        return _("shaft 1, input")
    if number == count:
        return _("shaft {number}, output").format(number=number)
    return _("shaft {number}").format(number=number)


def support_name(number: int, shaft: int, name: str = "") -> str:
    """Return what a support is called in a legend.

    >>> support_name(3, 2), support_name(3, 2, "centre bearing")
    ('support 3 on shaft 2', '3 centre bearing')
    """
    if name:
        return f"{number} {name if len(name) <= LONG else name[: LONG - 1] + '…'}"
    return _("support {number} on shaft {shaft}").format(number=number, shaft=shaft)


def support_dashes(shafts: Sequence[int]) -> tuple[str, ...]:
    """Return how the curve of every support is drawn: in the colour of its shaft, the second on it dashed, and so on.

    >>> support_dashes([1, 1, 2])
    ('solid', 'dashed', 'solid')
    """
    return tuple(DASHES[list(shafts[:k]).count(shaft) % len(DASHES)] for k, shaft in enumerate(shafts))
