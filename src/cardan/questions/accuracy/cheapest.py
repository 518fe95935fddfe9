"""The cheapest of numbers that must share a budget at every one of several places."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.maths.arrays import Array

ROUNDS = 80
"""Most steps of the interior-point method; it takes about twenty."""

GAP = 1e-13
"""Share of the cost by which the optimum may be missed."""

TINY = 1e-25
"""Below this share of the cost at a place nothing is left to be gained but rounding."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Cheapest:
    """The cheapest numbers, and the proof."""

    value: Array  # (m,): the numbers t
    price: Array  # (p,): what a bound at each place costs at the margin, λ ≥ 0; zero where there is room left
    # cost less the bound that λ proves, as a share of the cost; no numbers within the bounds cost less than that
    gap: float


def single(weight: Array, use: Array, power: int) -> Array:
    """Return the t of least Σ w/t with Σ u t^q = 1 at a single place, in closed form; array (m,).

    weight (m,): w > 0; use (m,): u > 0; power: q.
    w/t² = λ q u t^(q-1), so t = (w/u)^(1/(q+1)) times a constant.
    """
    shape = (weight / use) ** (1.0 / (power + 1))
    found: Array = shape / np.sum(use * shape**power) ** (1.0 / power)
    return found


def cheapest(weight: Array, use: Array, power: int) -> Cheapest:
    """Return the t of least Σ w/t with Σ u t^q ≤ 1 at every place.

    weight (m,): w > 0; use (p, m): u ≥ 0, each column with something above zero; power: q ≥ 1.
    In x = t^q the bounds are linear and Σ w x^(-1/q) is strictly convex. Primal-dual interior-point steps, with x kept
    within the bounds and λ ≥ 0 throughout; x = (w/(q Σ λ u))^(q/(q+1)) of the last λ, drawn into the bounds, is the
    answer, and the Lagrange function there bounds the cost from below.
    """
    places = use.shape[0]
    scale = single(weight, np.max(use, axis=0), power)  # of the right order, and within the bounds
    whole = float(np.sum(weight / scale))
    u, w = use * scale**power, weight / scale / whole
    share = 1.0 / power
    x, price = np.full(len(w), 0.5), np.full(places, 1.0 / places)
    room = 1.0 - u @ x  # followed by its own steps: the difference loses its digits where a bound is reached
    best = _proved(w, u, power, price)
    for _round in range(ROUNDS):
        if best.gap < GAP:
            break
        root = np.sqrt(share * (share + 1.0) * w * x ** (-share - 2.0))  # of the curvature of the cost
        missing = price @ u - share * w * x ** (-share - 1.0)
        target = 0.1 * float(price @ room) / places
        bent = u / root
        force = -(missing + (target / room - price) @ u) / root
        # E + bentᵀ diag(λ/room) bent by its triangular root: the product would lose E beside large λ/room.
        upper: Array = np.linalg.qr(np.concatenate((np.eye(len(w)), bent * np.sqrt(price / room)[:, None])), mode="r")
        step = np.linalg.solve(upper, np.linalg.solve(upper.T, force)) / root
        along = u @ step
        price_step = (target + price * along) / room - price
        go = min(1.0, 0.995 * min(_way(x, step), _way(room, -along), _way(price, price_step)))
        x, room, price = x + go * step, room - go * along, price + go * price_step
        now = _proved(w, u, power, price)
        best = now if now.gap < best.gap else best
        if not target > TINY:
            break
    return Cheapest(value=best.value * scale, price=best.price * whole, gap=best.gap)


def _way(values: Array, step: Array) -> float:
    """Return how far positive values can go along a step before one of them is zero."""
    down = step < 0.0
    return float(np.min(-values[down] / step[down])) if np.any(down) else np.inf


def _proved(w: Array, u: Array, power: int, price: Array) -> Cheapest:
    """Return the x that prices ask for, drawn into the bounds, and how far it is from the bound they prove."""
    share = 1.0 / power
    x = (share * w / (price @ u)) ** (power / (power + 1.0))
    bound = float(np.sum(w * x**-share) + price @ (u @ x - 1.0))
    within = x / np.max(u @ x)
    cost = float(np.sum(w * within**-share))
    return Cheapest(value=within**share, price=price, gap=max(cost - bound, 0.0) / cost)
