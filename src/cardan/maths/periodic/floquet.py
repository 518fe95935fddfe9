"""Linear oscillators whose coefficients repeat: how a disturbance changes over a period, and whether it grows.

M(t) ẍ + C(t) ẋ + K(t) x = 0 with M diagonal; M, C, K of period T. The monodromy matrix maps the disturbance at the
beginning of a period to that at its end; its eigenvalues are the multipliers. Coordinates without mass have no speed
of their own to disturb.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import TypeAlias

import numpy as np

from cardan.maths.arrays import Array, ArrayLike

Coefficients: TypeAlias = Callable[[Array], tuple[Array, Array, Array]]
"""From shares (p,) of the period to M (B, p, R), C and K (B, p, R, R) there."""

STAGES = 5
"""Stages of a step: order 10 by the points of Gauss, order 9 by those of Radau."""

REACH = 1.0
"""Largest phase of the fastest oscillation in a step; five stages then err by 1e-10 of it."""

FEWEST, MOST = 16, 4096
"""Steps of a period."""

BLOCK = 2_000_000
"""Numbers in the matrices of the steps that are held at once."""


@cache
def collocation(stages: int, *, stiff: bool = False) -> tuple[Array, Array]:
    """Return points (s,) and the integrals of their polynomials up to each point and to the end, array (s+1, s).

    stiff: points of Radau, the last of which is the end, instead of those of Gauss.
    """
    series = np.polynomial.legendre.Legendre.basis(stages)
    if stiff:
        series = series - np.polynomial.legendre.Legendre.basis(stages - 1)
    points = 0.5 * (1.0 + np.sort(np.real(series.roots())))
    powers = np.arange(1, stages + 1)
    ends = np.append(points, 1.0)
    return points, (ends[:, None] ** powers / powers) @ np.linalg.inv(points[:, None] ** (powers - 1))


def monodromy(
    coefficients: Coefficients, duration: ArrayLike, *, steps: int | None = None, reach: float = REACH
) -> Array:
    """Return the monodromy matrices of linear oscillators whose coefficients repeat.

    coefficients: `Coefficients`; duration (B,) [s]: T.
    steps: steps of a period; by default as many as the fastest oscillation asks for, none longer than this phase of it:
    reach.
    Returns (B, m, m): for the disturbance (x, ẋ) in the order of the coordinates, the speeds of those without mass left
    out.
    Collocation: within a step the accelerations (without mass, the speeds) are polynomials that fulfil the equations
    at the points of Gauss, or of Radau where a coordinate has no mass.
    """
    period = np.atleast_1d(np.asarray(duration, dtype=float))
    trial = np.arange(2 * FEWEST) / (2 * FEWEST)
    sample = coefficients(trial)
    heavy = np.any(sample[0] != 0.0, axis=(0, 1))
    if not heavy.size:
        return np.zeros((len(period), 0, 0))
    count = steps or _steps(sample, heavy, period, reach)
    points, _table = collocation(STAGES, stiff=not heavy.all())
    rank = len(heavy)
    states = rank + int(heavy.sum())
    at_once = max(1, BLOCK // max(1, len(period) * (STAGES * rank) ** 2))
    whole = np.broadcast_to(np.eye(states), (len(period), states, states))
    for first in range(0, count, at_once):
        inside = np.arange(first, min(first + at_once, count))
        share = ((inside[:, None] + points) / count).ravel()
        mass, damping, stiffness = (
            one.reshape(one.shape[0], len(inside), STAGES, *one.shape[2:]) for one in coefficients(share)
        )
        parts = propagators(mass, damping, stiffness, heavy, period / count)
        whole = np.matmul(_product(parts), whole)
    return whole


def _steps(sample: tuple[Array, Array, Array], heavy: Array, period: Array, reach: float) -> int:
    """Return how many steps the fastest oscillation asks for: bounds of the eigenvalues by the sums of rows."""
    mass, damping, stiffness = (one[:, :, heavy] for one in sample)
    if not heavy.any():
        return FEWEST
    spring = np.sqrt(np.max(np.sum(np.abs(stiffness), axis=-1) / mass, axis=(1, 2)))
    damper = np.max(np.sum(np.abs(damping), axis=-1) / mass, axis=(1, 2))
    fastest = np.max(period * np.maximum(spring, 0.5 * damper)) / reach
    return int(min(max(math.ceil(fastest), FEWEST), MOST))


def propagators(mass: Array, damping: Array, stiffness: Array, heavy: Array, step: Array) -> Array:
    """Return the matrices of steps of length step (B,), array (B, n, m, m), from coefficients at points (B, n, s, ...).

    mass (B, n, s, R), damping, stiffness (B, n, s, R, R): at the points of `collocation`, those of Radau where a
    coordinate has no mass; heavy (R,) of bool: which have some.
    """
    _points, table = collocation(mass.shape[2], stiff=not heavy.all())
    stages, rank = table.shape[1], len(heavy)
    light = ~heavy
    moving = np.flatnonzero(heavy)
    h = step[:, None, None, None]
    points = np.sum(table, axis=-1)  # the last is the end of the step
    twice = table @ table[:-1]
    # unknown of every stage and coordinate: the acceleration, or the speed of a coordinate without mass
    by_rate = np.where(heavy, h[..., None] * table[:-1, :, None], np.eye(stages)[:, :, None])
    by_place = np.where(heavy, h[..., None] ** 2 * twice[:-1, :, None], h[..., None] * table[:-1, :, None])
    matrix = damping[..., None, :] * by_rate[..., None, :, :]
    matrix += stiffness[..., None, :] * by_place[..., None, :, :]
    stage, own = np.ix_(range(stages), range(rank))
    matrix[:, :, stage, own, stage, own] += mass
    # what the state at the beginning makes of the balances: places through K, speeds through K and C
    pushed = np.concatenate(
        [stiffness, damping[..., moving] + (h[..., None] * points[:-1, None, None]) * stiffness[..., moving]], axis=-1
    )
    size = stages * rank
    answer = -np.linalg.solve(matrix.reshape(*mass.shape[:2], size, size), pushed.reshape(*mass.shape[:2], size, -1))
    answer = answer.reshape(*mass.shape[:2], stages, rank, -1)
    states = rank + len(moving)
    found = np.zeros((*mass.shape[:2], states, states))
    once = np.einsum("j,bnjrk->bnrk", table[-1], answer) * h
    both = np.einsum("j,bnjrk->bnrk", twice[-1], answer) * h**2
    found[:, :, :rank] = np.where(light[:, None], once, both)
    found[:, :, rank:] = once[:, :, moving]
    found[:, :, np.arange(states), np.arange(states)] += 1.0
    found[:, :, moving, rank + np.arange(len(moving))] += h[..., 0]
    return found


def _product(parts: Array) -> Array:
    """Return the product of the matrices of steps, the last one leftmost, array (B, m, m) of (B, n, m, m)."""
    while parts.shape[1] > 1:
        left, right = parts[:, 1::2], parts[:, : 2 * (parts.shape[1] // 2) : 2]
        rest = parts[:, 2 * (parts.shape[1] // 2) :]
        parts = np.concatenate([np.matmul(left, right), rest], axis=1)
    return parts[:, 0]


def without_direction(matrix: Array, direction: Array) -> Array:
    """Return matrices without an eigenvector: their other eigenvalues remain, array (B, m-1, m-1) of (B, m, m).

    matrix (B, m, m); direction (B, m): eigenvectors, of any length.
    Turned by a reflection that makes the direction the first axis, the matrix is block triangular.
    """
    return across_directions(matrix, direction, direction)


def across_directions(matrix: Array, before: Array, after: Array) -> Array:
    """Return matrices (B, m, m) that map directions before to those after, without these, array (B, m-1, m-1)."""
    found: Array = (_turned(after) @ matrix @ _turned(before))[:, 1:, 1:]
    return found


def _turned(direction: Array) -> Array:
    """Return reflections that make directions (B, m) the first axis."""
    unit = direction / np.linalg.norm(direction, axis=-1, keepdims=True)
    normal = unit.copy()
    normal[:, 0] += np.where(unit[:, 0] < 0.0, -1.0, 1.0)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    found: Array = np.eye(direction.shape[-1]) - 2.0 * normal[:, :, None] * normal[:, None, :]
    return found
