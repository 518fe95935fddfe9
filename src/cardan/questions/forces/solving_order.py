"""In which groups of shafts do the forces of a drive follow from each other?"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.models.machine_held import machine_held
from cardan.drive.models.train import place_of, train
from cardan.maths.arrays import Array
from cardan.maths.linear.redundant import RANK, surplus

from .held import Layout
from .kinetostatics import standing
from .reactions import frame

LOOK = 8
"""Positions of a turn looked at where crosses slide."""


def reaction_groups(drive: Drive) -> tuple[tuple[int, ...], ...]:
    """Return the groups of shafts in whose order the reactions of a drive can be found.

    drive: the drive with its supports.
    Returns: numbers of the shafts of each group; empty where supports miss, or do not hold the drive just enough.
    """
    if not drive.supports:
        return ()
    whole = train(machine_held(drive), kinds=True)
    place = place_of(whole)
    turn = np.arange(LOOK) * (2.0 * np.pi / LOOK)
    stand = standing(whole.chain, place.axis, place.normal, turn, speed=1.0)
    held = frame(whole, stand, whole.points[None])
    if np.any(np.asarray(surplus(held.matrix)) != 0):
        return ()
    return solving_order(held.matrix, held.layout)


def solving_order(matrix: Array, layout: Layout) -> tuple[tuple[int, ...], ...]:
    """Return the groups of shafts whose forces can be found one after the other, each group by itself.

    matrix (p, m, m) or (m, m): balance of the shafts of a drive held just enough, at one position or at several; then
    the conditions that no force acts along journals that slide.
    Returns: numbers of the shafts of each group. The forces on a group follow from its own balance and from those of
    the groups before it; the last group is, as a rule, the one that is driven.

    Book p. 148-150 takes statically determinate groups away from the far end of the drive: a shaft with the cross
    before it is a group of two links and three pairs (Fig. 67), two of them a group of four links and five pairs
    (Fig. 69). Smallest groups first, those farther from the input before others.
    """
    rows = np.reshape(matrix, (-1, *matrix.shape[-2:]))
    left, known, found = list(range(layout.joints + 1)), set[int](), []
    while left:
        group = next((run for run in _runs(left) if _solvable(rows, layout, run, known)), tuple(left))
        found.append(tuple(shaft + 1 for shaft in group))
        left = [shaft for shaft in left if shaft not in group]
        known |= _joints(layout, group)
    return tuple(found)


def _runs(left: list[int]) -> Iterator[tuple[int, ...]]:
    """Yield runs of neighbouring shafts, short ones first, of these the last."""
    for count in range(1, len(left)):
        for start in reversed(range(len(left) - count + 1)):
            run = left[start : start + count]
            if run[-1] - run[0] == count - 1:
                yield tuple(run)


def _joints(layout: Layout, group: tuple[int, ...]) -> set[int]:
    """Return the joints at the ends of the shafts of a group."""
    return {i for shaft in group for i in (shaft - 1, shaft) if 0 <= i < layout.joints}


def _solvable(rows: Array, layout: Layout, group: tuple[int, ...], known: set[int]) -> bool:
    """Tell whether the balance of a group by itself has exactly one solution, the forces of some joints known."""
    open_ = _joints(layout, group) - known
    shafts, splined = layout.joints + 1, sorted(layout.splines)
    sliding = [i for i, pair in enumerate(layout.slides) for slides in pair if slides]
    lines = [5 * shaft + k for shaft in group for k in range(5)]
    lines += [5 * shafts + k for k, shaft in enumerate(splined) if shaft in group]
    lines += [5 * shafts + len(splined) + k for k, i in enumerate(sliding) if i in open_]
    columns = [3 * i + k for i in sorted(open_) for k in range(3)]
    for bearing, (shaft, holds) in enumerate(layout.bearings):
        if shaft in group:
            for hold in holds:
                own = layout.columns(bearing, hold)
                columns += range(own.start, own.stop)
    if len(lines) != len(columns):
        return False
    size = np.linalg.svd(rows[:, lines][:, :, columns], compute_uv=False)
    return bool(np.all(size[:, -1] > RANK * size[:, 0]))
