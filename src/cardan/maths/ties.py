"""What rounding does not decide: which of several is the largest, and how large is what a check leaves over.

Two supports that carry alike by symmetry differ in the last digits, in which order the processor says. So the first of
those that are alike counts, or all of them are named; and of a residual no more is told than its power of ten, and
nothing but "to rounding" where it is as small as sums of rounded numbers leave it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import TypeVar

import numpy as np

from .arrays import Array, ArrayLike

TIE = 1e-9
"""Values that differ by less than this share are alike."""

ROUNDING = 1e-12
"""A relative residual up to this is rounding: sums of some thousand terms of one size leave less."""

NOTHING = 1e-13
"""A number without a unit that is smaller than this is nought but for rounding: shares and ratios are near 1."""

One = TypeVar("One")


def alike(values: ArrayLike, *, least: bool = False, scale: ArrayLike | None = None) -> Array:
    """Tell which values are the largest but for rounding.

    values (..., n): to be compared along the last axis; nan is never the largest.
    least: whether the smallest are asked for.
    scale (...): what a share is of; the extreme value itself when not given. Of a curve through zero it is its largest
    size.
    Returns (..., n) of bool.
    """
    given = np.asarray(values, dtype=float)
    table = np.where(np.isnan(given), -np.inf, -given if least else given)
    top = np.max(table, axis=-1, keepdims=True, initial=-np.inf)
    size = np.abs(top) if scale is None else np.asarray(scale, dtype=float)[..., None]
    return (table >= top - np.where(np.isfinite(top), TIE * size, 0.0)) & ~np.isnan(given)


def foremost(values: ArrayLike, *, least: bool = False, scale: ArrayLike | None = None) -> Array:
    """Return the place of the largest value, of those that differ by rounding alone the first.

    values, least, scale: as for `alike`.
    Returns (...) of int: 0 where all are nan.
    """
    return np.argmax(alike(values, least=least, scale=scale), axis=-1)


def foremost_on(curve: ArrayLike, *, least: bool = False) -> Array:
    """Return the place of the largest value of curves (..., p), where rounding is a share of their largest size."""
    table = np.asarray(curve, dtype=float)
    size = np.max(np.where(np.isfinite(table), np.abs(table), 0.0), axis=-1, initial=0.0)
    return foremost(table, least=least, scale=size)


def largest(values: ArrayLike) -> tuple[int, ...]:
    """Return the places of all values that are the largest but for rounding, in rising order. values (n,)."""
    return tuple(int(k) for k in np.flatnonzero(alike(values)))


def foremost_of(items: Iterable[One], size: Callable[[One], float], *, least: bool = False) -> One:
    """Return the first of the items whose size is the largest but for rounding."""
    every = list(items)
    if not every:
        raise ValueError("no items")
    return every[int(foremost([size(one) for one in every], least=least))]


def tidied(number: float) -> float:
    """Return a number without a unit, 0 where it is nothing but rounding.

    >>> tidied(5.4e-18), tidied(0.0031)
    (0.0, 0.0031)
    """
    return 0.0 if abs(number) < NOTHING else number


def summed(parts: ArrayLike, *, scale: ArrayLike | None = None) -> Array:
    """Return the sum of parts (..., n), real or complex, along the last axis, 0 where they cancel but for rounding.

    scale (...): what a share is of; the sizes of all parts together when not given.

    >>> summed([0.1, 0.2, -0.3]).tolist(), summed([0.1, 0.2]).tolist()
    (0.0, 0.30000000000000004)
    """
    given = np.asarray(parts)
    total, size = np.sum(given, axis=-1), np.sum(np.abs(given), axis=-1) if scale is None else np.asarray(scale)
    return np.where(np.abs(total) <= TIE * size, 0.0, total)


def in_a_turn(angle: ArrayLike) -> Array:
    """Return angles [rad] from 0 to below 2π, 0 where they are a whole turn but for rounding.

    >>> in_a_turn([-1e-16, -1.0]).round(4).tolist()
    [0.0, 5.2832]
    """
    found = np.asarray(angle, dtype=float) % (2.0 * np.pi)
    return np.where(2.0 * np.pi - found <= TIE, 0.0, found)


def power_of(residual: float) -> int | None:
    """Return the power of ten below which a relative residual is, None where it is rounding.

    residual: over the size of what is balanced; not nan or infinite.
    """
    if residual <= ROUNDING:
        return None
    return math.ceil(math.log10(residual))
