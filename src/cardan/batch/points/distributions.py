"""Distributions of the values of a field, by their inverse: a share in (0, 1) to a value."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields
from typing import Any, ClassVar, Protocol

import numpy as np
import scipy

from cardan.errors import Problem, check
from cardan.maths.arrays import Array
from cardan.texts import _


class Distribution(Protocol):
    """How the values of a field are distributed, in the unit of its path."""

    kind: ClassVar[str]

    def at(self, share: Array) -> Array:
        """Return the values (k,) below which the shares (k,) in (0, 1) lie."""

    def told(self) -> dict[str, Any]:
        """Return the distribution as keys of a plan file."""


def _told(one: Any) -> dict[str, Any]:
    return {"distribution": one.kind, **{item.name: getattr(one, item.name) for item in fields(one)}}


def _finite(one: Any) -> Iterator[Problem]:
    for item in fields(one):
        value = getattr(one, item.name)
        if not math.isfinite(value):
            yield Problem(item.name, _("{value} is not a finite number").format(value=value))


def _rising(low: float, high: float) -> Iterator[Problem]:
    if not low < high:
        yield Problem("high", _("{high} is not above {low}").format(high=high, low=low))


def _wide(std: float) -> Iterator[Problem]:
    if not std > 0.0:
        yield Problem("std", _("{value} is not above 0").format(value=std))


@dataclass(frozen=True, kw_only=True)
class Uniform:
    """Every value between two bounds alike.

    Parameters
    ----------
    low, high : float
        In the unit of the path.

    Examples
    --------
    >>> import numpy as np
    >>> from cardan.sweeps import Uniform
    >>> Uniform(low=-1.0, high=1.0).at(np.asarray([0.25]))
    array([-0.5])
    """

    kind: ClassVar[str] = "uniform"
    low: float
    high: float

    def __post_init__(self) -> None:
        check([*_finite(self), *_rising(self.low, self.high)])

    def at(self, share: Array) -> Array:
        """Return the values (k,) below which the shares (k,) lie."""
        return self.low + (self.high - self.low) * share

    def told(self) -> dict[str, Any]:
        """Return the distribution as keys of a plan file."""
        return _told(self)


@dataclass(frozen=True, kw_only=True)
class Normal:
    """The normal distribution of a mean and a standard deviation.

    Parameters
    ----------
    mean, std : float
        In the unit of the path.

    Examples
    --------
    >>> import numpy as np
    >>> from cardan.sweeps import Normal
    >>> Normal(mean=10.0, std=2.0).at(np.asarray([0.5]))
    array([10.])
    """

    kind: ClassVar[str] = "normal"
    mean: float
    std: float

    def __post_init__(self) -> None:
        check([*_finite(self), *_wide(self.std)])

    def at(self, share: Array) -> Array:
        """Return the values (k,) below which the shares (k,) lie."""
        found: Array = self.mean + self.std * scipy.special.ndtri(share)
        return found

    def told(self) -> dict[str, Any]:
        """Return the distribution as keys of a plan file."""
        return _told(self)


@dataclass(frozen=True, kw_only=True)
class Truncated:
    """The normal distribution of a mean and a standard deviation, cut at two bounds.

    Parameters
    ----------
    mean, std : float
        Of the whole distribution, in the unit of the path.
    low, high : float
        Where it is cut.

    Examples
    --------
    >>> import numpy as np
    >>> from cardan.sweeps import Truncated
    >>> Truncated(mean=0.0, std=1.0, low=-1.0, high=1.0).at(np.asarray([0.0, 0.5, 1.0])) + 0.0
    array([-1.,  0.,  1.])
    """

    kind: ClassVar[str] = "truncated"
    mean: float
    std: float
    low: float
    high: float

    def __post_init__(self) -> None:
        check([*_finite(self), *_wide(self.std), *_rising(self.low, self.high)])

    def at(self, share: Array) -> Array:
        """Return the values (k,) below which the shares (k,) lie."""
        below, above = (float(scipy.special.ndtr((bound - self.mean) / self.std)) for bound in (self.low, self.high))
        found: Array = np.clip(
            self.mean + self.std * scipy.special.ndtri(below + (above - below) * share), self.low, self.high
        )
        return found

    def told(self) -> dict[str, Any]:
        """Return the distribution as keys of a plan file."""
        return _told(self)


@dataclass(frozen=True, kw_only=True)
class Triangular:
    """Rising in a straight line to the likeliest value and falling in one behind it.

    Parameters
    ----------
    low, mode, high : float
        Least, likeliest and largest value, in the unit of the path.

    Examples
    --------
    >>> import numpy as np
    >>> from cardan.sweeps import Triangular
    >>> Triangular(low=0.0, mode=0.0, high=1.0).at(np.asarray([0.75]))
    array([0.5])
    """

    kind: ClassVar[str] = "triangular"
    low: float
    mode: float
    high: float

    def __post_init__(self) -> None:
        outside = not self.low <= self.mode <= self.high
        text = _("{mode} does not lie between {low} and {high}")
        message = text.format(mode=self.mode, low=self.low, high=self.high)
        check([*_finite(self), *_rising(self.low, self.high), *([Problem("mode", message)] if outside else [])])

    def at(self, share: Array) -> Array:
        """Return the values (k,) below which the shares (k,) lie."""
        width, up = self.high - self.low, self.mode - self.low
        rising = self.low + np.sqrt(share * width * up)
        falling = self.high - np.sqrt((1.0 - share) * width * (width - up))
        return np.where(share * width < up, rising, falling)

    def told(self) -> dict[str, Any]:
        """Return the distribution as keys of a plan file."""
        return _told(self)


DISTRIBUTIONS: dict[str, type[Any]] = {one.kind: one for one in (Uniform, Normal, Truncated, Triangular)}
"""Key ``distribution`` of a plan file -> class."""


def correlated(paths: Sequence[str], correlations: Sequence[tuple[str, str, float]]) -> Array | None:
    """Return the factor L of the correlation matrix L Lᵀ of normal scores, array (k, k); None where independent."""
    if not correlations:
        return None
    problems = []
    matrix = np.eye(len(paths))
    for one, other, value in correlations:
        for path in (one, other):
            if path not in paths:
                problems.append(Problem("correlations", _("{path} does not vary in this design").format(path=path)))
        if one == other or not -1.0 < value < 1.0:
            text = _("{value} for {one} and {other}: needed are two fields and a number between -1 and 1")
            problems.append(Problem("correlations", text.format(value=value, one=one, other=other)))
        elif one in paths and other in paths:
            i, j = paths.index(one), paths.index(other)
            matrix[i, j] = matrix[j, i] = value
    check(problems)
    try:
        factor: Array = np.linalg.cholesky(matrix)
    except np.linalg.LinAlgError:
        check([Problem("correlations", _("they contradict each other: no numbers are correlated so"))])
    return factor


# Points of a unit cube that depend on their number alone: any part of a design can be made anywhere.

METHODS = ("random", "sobol", "halton", "lhs")  # ways of drawing points
BLOCK = 4096  # random numbers are made in blocks of so many points, each block from its own counter
EDGE = 2.0**-54  # shares stay so far from 0 and 1, where some distributions have no value
_ROUNDS = 4  # rounds of the cipher that shuffles the cells of a Latin hypercube


def uniforms(method: str, dimensions: int, seed: int, start: int, stop: int, count: int) -> Array:
    """Return points ``start`` to ``stop`` of a design in the unit cube, array (stop - start, dimensions) in (0, 1).

    method: one of `METHODS`; start, stop: numbers of the points, from 0.
    count: points of the whole design; a Latin hypercube divides its axes into so many cells.
    """
    if method == "sobol":
        found = _sobol(dimensions, seed, start, stop)
    elif method == "halton":
        found = _halton(dimensions, seed, start, stop)
    elif method == "lhs":
        found = _latin(dimensions, seed, start, stop, count)
    else:
        found = _random(dimensions, seed, start, stop)
    return np.clip(found, EDGE, 1.0 - EDGE)


def _random(dimensions: int, seed: int, start: int, stop: int) -> Array:
    """Return independent random numbers, by a generator that counts: Philox."""
    first, last = start // BLOCK, -(-stop // BLOCK)
    parts = [
        np.random.Generator(np.random.Philox(key=seed, counter=[0, 0, 0, block])).random((BLOCK, dimensions))
        for block in range(first, last)
    ]
    whole = np.concatenate(parts) if parts else np.empty((0, dimensions))
    return whole[start - first * BLOCK : stop - first * BLOCK]


def _engine(kind: str, dimensions: int, seed: int) -> Any:
    """Return a scrambled sequence of scipy."""
    return getattr(scipy.stats.qmc, kind)(dimensions, scramble=True, rng=np.random.default_rng(seed))


_KEPT: dict[tuple[int, int], tuple[Any, int]] = {}
"""Sobol' sequences where they stand, one of each: to go on costs nothing, to begin again costs the way there."""


def _sobol(dimensions: int, seed: int, start: int, stop: int) -> Array:
    engine, at = _KEPT.pop((dimensions, seed), (None, 0))
    if engine is None or at > start:
        engine, at = _engine("Sobol", dimensions, seed), 0
    if start > at:
        engine.fast_forward(start - at)
    with warnings.catch_warnings():  # a sequence cut anywhere is what is asked for here
        warnings.simplefilter("ignore", UserWarning)
        found: Array = engine.random(stop - start)
    if len(_KEPT) >= 8:
        _KEPT.clear()
    _KEPT[dimensions, seed] = engine, stop
    return found


def _halton(dimensions: int, seed: int, start: int, stop: int) -> Array:
    engine = _engine("Halton", dimensions, seed)
    engine.fast_forward(start)
    found: Array = engine.random(stop - start)
    return found


def _latin(dimensions: int, seed: int, start: int, stop: int, count: int) -> Array:
    """Return points of a Latin hypercube: along every axis, each of ``count`` cells holds one point."""
    within = _random(dimensions, seed, start, stop)
    number = np.arange(start, stop, dtype=np.uint64)
    cells = [shuffled(number, count, seed * 1_000_003 + k) for k in range(dimensions)]
    return (np.stack(cells, axis=-1) + within) / count


def shuffled(number: Array, count: int, key: int) -> Array:
    """Return the places of numbers in a shuffled row of ``count``, each made by itself.

    number (k,) of int: in [0, count); key: chooses the order.
    A Feistel cipher on the smallest square of powers of two that holds ``count``, applied until the place lies within:
    a bijection whatever the round function.
    """
    half = np.uint64(max(1, -(-max(count - 1, 1).bit_length() // 2)))
    mask = np.uint64((1 << int(half)) - 1)
    found = np.asarray(number, dtype=np.uint64)
    left = np.ones(found.shape, dtype=bool)
    while np.any(left):
        found[left] = _enciphered(found[left], half, mask, key)
        left &= found >= count
    return found.astype(np.int64)


def _enciphered(value: Array, half: Any, mask: Any, key: int) -> Array:
    high, low = value >> half, value & mask
    for k in range(_ROUNDS):
        high, low = low, high ^ (_mixed(low + np.uint64((key * _ROUNDS + k) & 0xFFFFFFFFFFFFFFFF)) & mask)
    return (high << half) | low


def _mixed(value: Array) -> Array:
    """Return well-mixed bits of numbers: the finaliser of SplitMix64 (Steele, Lea, Flood 2014)."""
    with np.errstate(over="ignore"):
        value = value + np.uint64(0x9E3779B97F4A7C15)
        value = (value ^ (value >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
        value = (value ^ (value >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
        return value ^ (value >> np.uint64(31))
