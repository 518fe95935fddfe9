"""Linear systems: square ones in batches, and those with more unknowns than equations."""

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


# Linear systems with more unknowns than equations: how many are too many, and which state stores the least energy.

RANK = 1e-9
"""Singular values below this share of the largest count as nought."""


def surplus(matrix: Array) -> tuple[Array, Array]:
    """Return how many unknowns and how many equations of A x = b are too many.

    matrix (..., m, u): a, its rows and columns of like size.
    Returns unknowns (...) of int: u - rank A, unknowns that the equations leave open; equations (...) of int: m - rank
    A, equations that no unknown can meet.
    """
    xp = namespace(matrix)
    size = xp.linalg.svdvals(matrix)
    kept = size > RANK * xp.max(size, axis=-1, keepdims=True)
    rank = xp.sum(xp.astype(kept, xp.int64), axis=-1)
    return matrix.shape[-1] - rank, matrix.shape[-2] - rank


def least_energy(matrix: Array, load: Array, compliance: Array, gap: Array) -> tuple[Array, Array]:
    """Return the unknowns that meet all equations and store the least energy.

    matrix (..., m, u): a of the equations A x = b; its rank is m.
    load (..., m): b; compliance (..., u, u): C, symmetric, positive definite on all x that A x = 0 leaves open.
    gap (..., u): d, what each unknown has to close.
    Returns unknowns (..., u): x with the least ½ x·C x - d·x among those with A x = b; multipliers (..., m): y with C x
    + Aᵀ y = d: how far each equation gives way.

    Least complementary energy (Castigliano) with the equations as side conditions. C and d are divided by the largest
    entry of C, so that both blocks of the bordered matrix are of order one. Where A and C are the same along the last
    axis of the batch, length one or none there, the matrix is factored once.
    """
    xp = namespace(matrix, load, compliance, gap)
    m, u = matrix.shape[-2:]
    outer = broadcast_shapes(matrix.shape[:-2], compliance.shape[:-2])
    whole = broadcast_shapes(outer, load.shape[:-1], gap.shape[:-1])
    a = xp.broadcast_to(matrix, (*outer, m, u))
    c = xp.broadcast_to(compliance, (*outer, u, u))
    largest = xp.max(xp.abs(c), axis=(-2, -1), keepdims=True)
    scale = xp.where(largest > 0.0, largest, 1.0)
    top = xp.concat((c / scale, xp.matrix_transpose(a)), axis=-1)
    bottom = xp.concat((a, xp.zeros((*outer, m, m), dtype=xp.float64)), axis=-1)
    bordered = xp.concat((top, bottom), axis=-2)
    right = xp.concat((xp.broadcast_to(gap, (*whole, u)) / scale[..., 0], xp.broadcast_to(load, (*whole, m))), axis=-1)
    if whole and (not outer or outer[-1] == 1):
        matrices = bordered[..., 0, :, :] if outer else bordered
        found = xp.matrix_transpose(xp.linalg.solve(matrices, xp.matrix_transpose(right)))
    else:
        found = xp.linalg.solve(bordered, right[..., None])[..., 0]
    return found[..., :u], found[..., u:] * scale[..., 0]


def broadcast_shapes(*shapes: tuple[int, ...]) -> tuple[int, ...]:
    """Return the shape that arrays of these shapes have together."""
    depth = max(len(shape) for shape in shapes)
    full = [(1,) * (depth - len(shape)) + shape for shape in shapes]
    return tuple(max(sizes) if 0 not in sizes else 0 for sizes in zip(*full, strict=True))
