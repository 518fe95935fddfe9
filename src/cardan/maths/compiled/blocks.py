"""Kernel functions: systems made of blocks, eight at a time, factored without pivots."""

from __future__ import annotations

from typing import Any

from numba import njit

from .lanes import BYTES, step


def _add_scaled(to: Any, part: Any, number: Any) -> tuple[Any]:
    return (to + part * number,)


def _subtract_product(to: Any, one: Any, other: Any) -> tuple[Any]:
    return (to - one * other,)


def _add_four(a: Any, b: Any, c: Any, d: Any, p: Any, q: Any, r: Any, s: Any, number: Any) -> tuple[Any, ...]:
    return a + p * number, b + q * number, c + r * number, d + s * number


def _less_four(a: Any, b: Any, c: Any, d: Any, one: Any, p: Any, q: Any, r: Any, s: Any) -> tuple[Any, ...]:
    return a - one * p, b - one * q, c - one * r, d - one * s


def _inverse(one: Any) -> tuple[Any]:
    return (1.0 / one,)


def _times(one: Any, other: Any) -> tuple[Any]:
    return (one * other,)


add, _less = step(_add_scaled), step(_subtract_product)
_add_four_of, _less_four_of = step(_add_four), step(_less_four)
_inverse_of, _times_of = step(_inverse), step(_times)


@njit(nogil=True, error_model="numpy")
def add_row(to: int, part: int, count: int, number: float) -> None:
    """Add a row times a number."""
    for _four in range(count // 4):
        a, b, c = to + BYTES, to + 2 * BYTES, to + 3 * BYTES
        _add_four_of((to, a, b, c, part, part + BYTES, part + 2 * BYTES, part + 3 * BYTES), (number,), (to, a, b, c))
        to, part = to + 4 * BYTES, part + 4 * BYTES
    for _one in range(count % 4):
        add((to, part), (number,), (to,))
        to, part = to + BYTES, part + BYTES


@njit(nogil=True, error_model="numpy")
def less_row(to: int, factor: int, part: int, count: int) -> None:
    """Subtract a row times what stands at ``factor``."""
    for _four in range(count // 4):
        a, b, c = to + BYTES, to + 2 * BYTES, to + 3 * BYTES
        _less_four_of((to, a, b, c, factor, part, part + BYTES, part + 2 * BYTES, part + 3 * BYTES), (), (to, a, b, c))
        to, part = to + 4 * BYTES, part + 4 * BYTES
    for _one in range(count % 4):
        _less((to, factor, part), (), (to,))
        to, part = to + BYTES, part + BYTES


@njit(nogil=True, error_model="numpy")
def factor(matrix: int, inverse: int, size: int, wide: int, coupled: Any, start: int, rank: int) -> None:
    """Factor matrices in place, blocks of ``size``: a block that stays zero is left alone. No pivots are sought."""
    for k in range(wide):
        block = k // size
        pivot = matrix + BYTES * (k * wide + k)
        _inverse_of((pivot,), (), (inverse + BYTES * k,))
        for i in range(k + 1, wide):
            if not coupled[start + (i // size) * rank + block]:
                continue
            share = matrix + BYTES * (i * wide + k)
            _times_of((share, inverse + BYTES * k), (), (share,))
            for other in range(block, rank):
                if not coupled[start + block * rank + other]:
                    continue
                j = max(k + 1, other * size)
                to, part = matrix + BYTES * (i * wide + j), matrix + BYTES * (k * wide + j)
                less_row(to, share, part, (other + 1) * size - j)


@njit(nogil=True, error_model="numpy")
def solve(
    matrix: int, inverse: int, right: int, columns: int, size: int, wide: int, coupled: Any, start: int, rank: int
) -> None:
    """Solve for right sides (wide, columns) in place."""
    for i in range(wide):
        for block in range(i // size + 1):
            if not coupled[start + (i // size) * rank + block]:
                continue
            for k in range(block * size, min((block + 1) * size, i)):
                to, part = right + BYTES * i * columns, right + BYTES * k * columns
                less_row(to, matrix + BYTES * (i * wide + k), part, columns)
    for i in range(wide - 1, -1, -1):
        for block in range(i // size, rank):
            if not coupled[start + (i // size) * rank + block]:
                continue
            for k in range(max(block * size, i + 1), (block + 1) * size):
                to, part = right + BYTES * i * columns, right + BYTES * k * columns
                less_row(to, matrix + BYTES * (i * wide + k), part, columns)
        for c in range(columns):
            to = right + BYTES * (i * columns + c)
            _times_of((to, inverse + BYTES * i), (), (to,))
