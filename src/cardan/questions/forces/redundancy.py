"""Is a chain of shafts held just enough, too much, or not enough? Which bearing is the one too many?"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from cardan.errors import Problem, check
from cardan.maths.arrays import Array
from cardan.maths.linear.redundant import RANK, surplus
from cardan.texts import _, plural

from .held import WIDTH, Hold, Layout

TAKES_PART = 1e-7
"""An unknown of less than this share of a force that balances itself does not take part in it."""

READY: dict[Hold, float] = {"tilt": 4.0, "axial": 2.0, "radial": 1.0}
"""How readily each hold is let go: a self-aligning bearing and a floating one are cheap, one bearing less is not."""

MOST_TRIALS = 1024
"""Layouts looked at when searching for what to let go; in the order of search the first is nearly always the answer."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Redundancy:
    """How far a drive is statically indeterminate, and where."""

    degree: int  # how many forces and couples the balance of the shafts leaves open
    strained: tuple[tuple[int, Hold], ...] = ()  # bearings, counted from 0, and what of them misfit can load
    # what could be let go all at once without setting anything free: the components too many. Another choice among
    # `strained` may do as well.
    spare: tuple[tuple[int, Hold], ...] = ()


def redundancy(matrix: Array, layout: Layout, *, field: str = "supports") -> Redundancy:
    """Return what of the bearings is too many.

    matrix (m, u) or (p, m, u): balance of the shafts, at one position or at several.
    Degree = unknowns - rank A, loose = equations - rank A; statics of rigid shafts. A force state that balances itself
    is a null vector of A: what has a share in it can be loaded by misfit. A shaft that can move without a bearing
    giving way is a null vector of Aᵀ.
    """
    rows = np.reshape(matrix, (-1, *matrix.shape[-2:]))
    open_, unmet = surplus(rows)
    worst = int(np.argmax(unmet))
    if unmet[worst] > 0:
        check(_movements(rows[worst], layout, field))
    degree = int(np.max(open_))
    if degree <= 0:
        return Redundancy(degree=0)
    strained = _strained(rows, layout)
    return Redundancy(degree=degree, strained=strained, spare=_spare(rows, layout, strained, degree))


def _holds(layout: Layout) -> list[tuple[int, Hold]]:
    return [(k, hold) for k, (_shaft, holds) in enumerate(layout.bearings) for hold in holds]


def _strained(rows: Array, layout: Layout) -> tuple[tuple[int, Hold], ...]:
    """Return which bearings have a share in a force state that balances itself, at any of the positions."""
    _left, size, right = np.linalg.svd(rows)
    share = np.zeros(rows.shape[-1])
    for values, states in zip(size, right, strict=True):
        null = states[int(np.sum(values > RANK * values[0])) :]
        if len(null):
            share = np.maximum(share, np.max(np.abs(null), axis=0))
    return tuple(one for one in _holds(layout) if np.max(share[layout.columns(*one)]) > TAKES_PART)


def _spare(
    rows: Array, layout: Layout, strained: tuple[tuple[int, Hold], ...], degree: int
) -> tuple[tuple[int, Hold], ...]:
    """Return what can be let go: first that without which the drive is still held best; turned back from dead ends.

    A hold that goes first may leave one degree over where every other hold counts two; another order then lets all go.
    Where no order does, as few degrees as can be stay open.
    """
    trials = MOST_TRIALS

    def search(kept: Array, left: list[tuple[int, Hold]], open_: int) -> list[tuple[int, Hold]]:
        nonlocal trials
        most: list[tuple[int, Hold]] = []
        if open_ <= 0:
            return most
        scores = {one: READY[one[1]] * _firm(rows, kept, layout, one) for one in left if WIDTH[one[1]] <= open_}
        trials -= len(scores)
        ranked = sorted((one for one in scores if scores[one] > RANK), key=scores.__getitem__, reverse=True)
        for k, one in enumerate(ranked):
            fewer = kept.copy()
            fewer[layout.columns(*one)] = False
            # What was tried first here led nowhere in any order, so it is not tried again behind this one.
            rest = [other for other in left if other != one and other not in ranked[:k]]
            found = [one, *search(fewer, rest, open_ - WIDTH[one[1]])]
            if _width(found) > _width(most):
                most = found
            if _width(most) == open_ or trials <= 0:
                break
        return most

    return tuple(search(np.ones(rows.shape[-1], dtype=bool), list(strained), degree))


def _width(holds: list[tuple[int, Hold]]) -> int:
    """Return how many forces and couples some holds take together."""
    return sum(WIDTH[hold] for _k, hold in holds)


def _firm(rows: Array, kept: Array, layout: Layout, one: tuple[int, Hold]) -> float:
    """Return how firmly the drive is held without one more hold: the smallest singular value of its balance."""
    trial = kept.copy()
    trial[layout.columns(*one)] = False
    if int(np.sum(trial)) < rows.shape[-2]:
        return 0.0
    return float(np.min(np.linalg.svd(rows[..., trial], compute_uv=False)[..., -1]))


def _movements(matrix: Array, layout: Layout, field: str) -> Iterator[Problem]:
    """Say which shafts are free, and along what."""
    left, size, _right = np.linalg.svd(matrix)
    rank = int(np.sum(size > RANK * size[0]))
    shafts = layout.joints + 1
    moved = np.abs(left[: 5 * shafts, rank:]).reshape(shafts, 5, -1).max(axis=-1)
    parted = np.abs(left[5 * shafts : 5 * shafts + len(layout.splines), rank:]).max(axis=-1, initial=0.0)
    ways = []
    for s in range(shafts):
        along = max(float(moved[s, 2]), *(float(parted[k]) for k, one in enumerate(layout.splines) if one == s), 0.0)
        across = float(np.max(moved[s, [0, 1, 3, 4]]))
        if max(along, across) <= TAKES_PART:
            continue
        if across <= TAKES_PART:
            text = _("shaft {number} from moving along its axis")
        elif along <= TAKES_PART:
            text = _("shaft {number} from moving sideways")
        else:
            text = _("shaft {number} from moving sideways and along its axis")
        ways.append(text.format(number=s + 1))
    count = matrix.shape[-2] - rank
    text = plural(
        "not held, {count} hold too few: nothing keeps {ways}",
        "not held, {count} holds too few: nothing keeps {ways}",
        count,
    )
    yield Problem(field, text.format(count=count, ways=", ".join(ways)))
