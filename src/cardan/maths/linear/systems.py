"""Square linear systems in batches: solved where they can be, told apart where they cannot."""

from __future__ import annotations

import numpy as np

from cardan.maths.arrays import Array, namespace

WORST = 1e9
"""Largest condition number at which a system counts as regular; its rows and columns are of like size."""


def solve_regular(matrix: Array, load: Array) -> tuple[Array, Array]:
    """Return the solutions of A x = b for many right-hand sides, and which systems are regular.

    matrix (..., m, m): a; load (..., p, m): b, p of them for each A.
    Returns solution (..., p, m): x; nan where A is singular; regular (...) of bool: whether A is not singular: its
    condition number, by the largest sums of columns, is at most `WORST`.
    """
    xp = namespace(matrix, load)
    m, count = matrix.shape[-1], load.shape[-2]
    unit = xp.broadcast_to(xp.eye(m, dtype=xp.float64), matrix.shape)
    right = xp.concat((xp.matrix_transpose(load), unit), axis=-1)
    try:
        both = xp.linalg.solve(matrix, right)
        fits = xp.ones(matrix.shape[:-2], dtype=xp.bool)
    except np.linalg.LinAlgError:
        fits = xp.linalg.slogdet(matrix)[0] != 0.0
        both = xp.linalg.solve(xp.where(fits[..., None, None], matrix, unit), right)
    condition = _size(matrix) * _size(both[..., count:])
    regular = fits & (condition <= WORST)
    solution = xp.matrix_transpose(both[..., :count])
    return xp.where(regular[..., None, None], solution, xp.nan), regular


def _size(matrix: Array) -> Array:
    xp = namespace(matrix)
    return xp.max(xp.sum(xp.abs(matrix), axis=-2), axis=-1)
