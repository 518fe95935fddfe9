"""Least, largest, mean and harmonics over a turn of whatever was computed at evenly spaced angles."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np

from cardan.errors import refuse
from cardan.maths.arrays import Array, namespace
from cardan.maths.ties import foremost_on
from cardan.texts import _

AROUND = 3
"""Samples to each side of the extreme one that a polynomial is laid through."""

FINE = 64
"""Parts of a step in which that polynomial is looked at."""

AGREE = 0.02
"""A polynomial counts where leaving out its outer samples changes what it adds to the extreme sample by less."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Turn:
    """A quantity over a turn; axes (...) are those of the quantity but for the positions."""

    low: Array  # low, high (...): least and largest value
    high: Array  # (...)
    # low_angle, high_angle (...) [rad]: input angle where they occur, the first time; what rounding alone makes higher
    # later does not count
    low_angle: Array
    high_angle: Array  # (...) [rad]
    mean: Array  # mean, rms (...): mean, and root of the mean square
    rms: Array  # (...)


@dataclass(frozen=True, eq=False, kw_only=True)
class Harmonics:
    """Orders of a quantity over a turn of the input: value = Σ amplitude cos(order φ_1 + phase)."""

    order: Array  # (k,): 0, 1, 2 …
    amplitude: Array  # (..., k): not negative but for order 0, the mean
    phase: Array  # (..., k) [rad]: in (-π, π]


def over_turn(angle: Array, values: Array) -> Turn:
    """Return least and largest value with their angles, mean and root mean square over a turn, or several.

    angle (p,) [rad]: input angles that divide whole turns evenly; the end of the last may be there or not.
    values (..., p).
    Raises InputError: the angles are not those of whole turns.
    Between samples a polynomial through seven of them is looked at, where it is to be trusted; on smooth curves sampled
    by the degree that leaves less than 1e-9 of the swing. Mean values are those of the samples, exact up to half as
    many orders as there are samples.
    """
    phi, table, _turns = _whole_turns(angle, values)
    step = float(phi[1] - phi[0])
    high, high_at = _highest(table, step)
    low, low_at = _highest(-table, step)
    return Turn(
        low=-low,
        high=high,
        low_angle=phi[0] + low_at,
        high_angle=phi[0] + high_at,
        mean=np.mean(table, axis=-1),
        rms=np.sqrt(np.mean(table**2, axis=-1)),
    )


def harmonics(angle: Array, values: Array, *, count: int = 13) -> Harmonics:
    """Return the first orders of a quantity over a turn.

    angle (p,) [rad]: input angles that divide one turn evenly, or several turns; values (..., p).
    count: how many orders, 0 included; at most half the samples of a turn.
    """
    phi, table, turns = _whole_turns(angle, values)
    samples = table.shape[-1] // turns
    kept = min(count, samples // 2 + 1)
    order = np.arange(kept)
    waves = np.fft.rfft(table, axis=-1)[..., ::turns][..., :kept] / table.shape[-1] * np.exp(-1j * order * phi[0])
    waves = np.where((order > 0) & (2 * order < samples), 2.0 * waves, waves)
    amplitude = np.abs(waves)
    amplitude[..., 0] = waves[..., 0].real
    phase = np.angle(waves)
    phase[..., 0] = 0.0
    return Harmonics(order=order, amplitude=amplitude, phase=phase)


def _whole_turns(angle: Array, values: Array) -> tuple[Array, Array, int]:
    """Return angles and values without the end of the last turn, and how many turns they are."""
    phi, table = np.asarray(angle, dtype=float), np.asarray(values, dtype=float)
    turns = max(round(float(phi[-1] - phi[0]) / (2.0 * np.pi)), 1) if phi.size else 1
    if phi.size > 2 and abs(phi[-1] - phi[0] - 2.0 * np.pi * turns) < 1e-9:
        phi, table = phi[:-1], table[..., :-1]
    step = 2.0 * np.pi * turns / max(phi.size, 1)
    even = phi.size > 2 * AROUND * turns + 1 and bool(np.allclose(np.diff(phi), step, rtol=0.0, atol=1e-9))
    if not even or phi.size % turns:
        raise refuse(
            "angle", _("these angles do not divide one turn into equal steps; leave them out, or give at least eight")
        )
    return phi, table, turns


def _highest(table: Array, step: float) -> tuple[Array, Array]:
    """Return the largest value of periodic curves and how far it lies from the first sample."""
    best = foremost_on(table)
    around = np.arange(-AROUND, AROUND + 1)
    index = (best[..., None] + around) % table.shape[-1]
    near = np.take_along_axis(table, index, axis=-1)
    at = np.linspace(-1.0, 1.0, 2 * FINE + 1)
    wide = near @ _lagrange(around, at)
    narrow = near[..., 1:-1] @ _lagrange(around[1:-1], at)
    top = near[..., AROUND]
    place = np.argmax(wide, axis=-1)
    value = np.take_along_axis(wide, place[..., None], axis=-1)[..., 0]
    other = np.max(narrow, axis=-1)
    edge = np.clip(place, 1, at.size - 2)
    three = np.take_along_axis(wide, edge[..., None] + np.arange(-1, 2), axis=-1)
    joint_angle = three[..., 0] - 2.0 * three[..., 1] + three[..., 2]
    slope = 0.5 * (three[..., 2] - three[..., 0])
    shift = np.where(joint_angle < 0.0, -slope / np.where(joint_angle < 0.0, joint_angle, 1.0), 0.0)
    inner = (np.abs(shift) <= 1.0) & (place == edge)
    value = np.where(inner, three[..., 1] + 0.5 * slope * np.where(inner, shift, 0.0), value)
    where = at[place] + np.where(inner, shift, 0.0) / FINE
    trusted = np.abs(value - other) <= AGREE * (value - top) + 1e-6 * np.max(np.abs(near - top[..., None]), axis=-1)
    far = np.where(trusted, where, 0.0)
    return np.where(trusted, value, top), np.remainder((best + far) * step, table.shape[-1] * step)


def _lagrange(nodes: Array, at: Array) -> Array:
    """Return the matrix that takes values at the nodes to those of their polynomial at other places."""
    rows = []
    for k, node in enumerate(nodes):
        others = np.delete(nodes, k)
        rows.append(np.prod((at[:, None] - others) / (node - others), axis=-1))
    return np.stack(rows)


# Means over a period of functions that are smooth between known kinks.

ORDERS = (12, 24, 48, 96, 192)
"""Points between two kinks, doubled until the mean rests."""

RESTS = 1e-12
"""Share of the mean magnitude by which a mean may still change when it rests; twice the points square its error."""


def mean_between(function: Callable[[Array], Array], kinks: Array, *, period: float, rests: float = RESTS) -> Array:
    """Return the mean over one period of a function with kinks, each stretch by Gauss's rule.

    function: from places (..., p) to values (..., k, p), of this period.
    kinks (..., m): where its derivative may jump, modulo the period, in any order; at least one.
    rests: share of the mean magnitude by which a mean may still change.
    Returns (..., k): nan where the function is.
    The error falls with the 2p-th power of the number of points p on each stretch, however sharp the kinks. Where a
    function is steep it is so at the kinks, where Gauss's points crowd.
    """
    xp = namespace(kinks)
    edges = xp.sort(xp.remainder(kinks, period), axis=-1)
    width = xp.concat((edges[..., 1:], edges[..., :1] + period), axis=-1) - edges
    found: Array = None
    for order in ORDERS:
        node, weight = (xp.asarray(row) for row in _rule(order))
        shape = (*edges.shape[:-1], edges.shape[-1] * order)
        place = xp.reshape(edges[..., None] + width[..., None] * node, shape)
        share = xp.reshape(width[..., None] * weight, shape) / period
        parts = function(place) * share[..., None, :]
        before, found = found, xp.sum(parts, axis=-1)
        if before is not None and not bool(xp.any(xp.abs(found - before) > rests * xp.sum(xp.abs(parts), axis=-1))):
            break
    return found


@cache
def _rule(order: int) -> tuple[Array, Array]:
    """Return nodes and weights on (0, 1)."""
    node, weight = np.polynomial.legendre.leggauss(order)
    return 0.5 + 0.5 * node, 0.5 * weight
