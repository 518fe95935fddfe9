"""Points of a unit cube that depend on their number alone: any part of a design can be made anywhere."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import scipy

from cardan.maths.arrays import Array

METHODS = ("random", "sobol", "halton", "lhs")
"""Ways of drawing points."""

BLOCK = 4096
"""Random numbers are made in blocks of so many points, each block from its own counter."""

EDGE = 2.0**-54
"""Shares stay so far from 0 and 1, where some distributions have no value."""

_ROUNDS = 4
"""Rounds of the cipher that shuffles the cells of a Latin hypercube."""


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
