"""Which rows no other row beats: the Pareto front of a table, exactly."""

from __future__ import annotations

import numpy as np

from cardan.maths.arrays import Array, ArrayLike

SIEVES = 64
"""Good rows that all others are first compared with."""

BLOCK = 32
"""Rows that are compared one by one with each other before blocks are merged."""

PIECE = 2**16
"""Rows compared with the front at once, in four columns and more."""


def front(values: ArrayLike) -> Array:
    """Return which rows are not dominated: none other is at least as good in all columns and better in one.

    values (N, m): what is to be small. Rows with a value that is not a number belong to no front and dominate nothing.
    Returns (N,) of bool: equal rows of the front belong to it all.
    Rows in lexicographic order are dominated by earlier ones alone, so that one column less needs to be looked at: a
    running minimum for two columns; for three, blocks are merged in the order of the second column, the rows of the
    later block compared with the running minimum of the third over the earlier one (Kung, Luccio, Preparata 1975), in
    O(N log² N) whatever the front. With four columns and more rows are compared with the front found so far.
    """
    table = np.asarray(values, dtype=float)
    found = np.zeros(table.shape[0], dtype=bool)
    known = np.flatnonzero(~np.any(np.isnan(table), axis=1))
    if not known.size or not table.shape[1]:
        found[known] = True
        return found
    table = table[known]
    kept = _sieved(table)
    rows = table[kept]
    order = np.lexsort(rows.T[::-1])
    rows = rows[order]
    first = np.ones(len(rows), dtype=bool)
    first[1:] = np.any(rows[1:] != rows[:-1], axis=1)
    beaten = _beaten(rows[first])[np.cumsum(first) - 1]
    found[known[kept[order[~beaten]]]] = True
    return found


def _sieved(table: Array) -> Array:
    """Return the rows that a few good ones do not beat: nearly all of a large table goes here."""
    rows = np.arange(len(table))
    if len(table) < 4 * SIEVES:
        return rows
    low, high = np.min(table, axis=0), np.max(table, axis=0)
    with np.errstate(invalid="ignore", over="ignore"):
        share = (table - low) / np.where(high > low, high - low, 1.0)
    merit = np.sum(np.where(np.isfinite(share), share, 1.0), axis=1)
    best = np.argpartition(merit, SIEVES)[:SIEVES]
    for row in table[best[np.argsort(merit[best], kind="stable")]]:
        here = table[rows]
        rows = rows[~(np.all(row <= here, axis=1) & np.any(row < here, axis=1))]
    return rows


def _beaten(rows: Array) -> Array:
    """Return which rows, all different and in lexicographic order, an earlier one beats."""
    count, columns = rows.shape
    if columns == 1:
        return np.arange(count) > 0
    if columns == 2:
        beaten = np.zeros(count, dtype=bool)
        beaten[1:] = np.minimum.accumulate(rows[:-1, 1]) <= rows[1:, 1]
        return beaten
    return _merged(rows[:, 1], rows[:, 2]) if columns == 3 else _compared(rows[:, 1:])


def _merged(second: Array, third: Array) -> Array:
    """Return which rows have an earlier one that is not greater in both columns."""
    count = len(second)
    blocks = 1 << max(0, -(-count // BLOCK) - 1).bit_length()
    room = blocks * BLOCK
    rank = np.arange(room)  # what fills up the last block lies behind and above all
    rank[:count][np.argsort(second, kind="stable")] = np.arange(count)
    height = np.full(room, np.inf)
    height[:count] = third
    beaten = np.zeros(room, dtype=bool)
    low, high = rank.reshape(blocks, BLOCK), height.reshape(blocks, BLOCK)
    inside = beaten.reshape(blocks, BLOCK)
    for k in range(1, BLOCK):
        inside[:, k] = np.any((low[:, :k] < low[:, k, None]) & (high[:, :k] <= high[:, k, None]), axis=1)
    order = np.argsort(low, axis=1) + BLOCK * np.arange(blocks)[:, None]
    while blocks > 1:
        blocks //= 2
        width = room // blocks
        pair = order.reshape(blocks, width)
        pair = np.take_along_axis(pair, np.argsort(rank[pair], axis=1, kind="stable"), axis=1)
        early = pair % width < width // 2
        least = np.minimum.accumulate(np.where(early, height[pair], np.inf), axis=1)
        beaten[pair[~early & (least <= height[pair])]] = True
        order = pair
    found: Array = beaten[:count]
    return found


def _compared(rows: Array) -> Array:
    """Return which rows have an earlier one that is not greater in any column."""
    beaten = np.zeros(len(rows), dtype=bool)
    kept = rows[:0]
    for start in range(0, len(rows), PIECE):
        piece = rows[start : start + PIECE]
        out = np.zeros(len(piece), dtype=bool)
        for row in kept:
            out |= np.all(row <= piece, axis=1)
        for k in range(len(piece)):
            if not out[k]:
                out[k + 1 :] |= np.all(piece[k] <= piece[k + 1 :], axis=1)
        beaten[start : start + PIECE] = out
        kept = np.concatenate([kept, piece[~out]])
    return beaten
