"""Arrays to write results to: fresh ones, or those of an earlier call."""

from __future__ import annotations

from collections.abc import Sequence
from math import prod

import numpy as np

from cardan.errors import Problem, check, refuse
from cardan.maths.arrays import Array
from cardan.texts import _

LINE = 8
"""Numbers in a cache line; writing past the caches goes by whole lines."""


def buffers(names: Sequence[str], shape: tuple[int, ...], out: object | None = None) -> tuple[Array, ...]:
    """Return an array of 64-bit floats for each name.

    names: names of the results.
    out: holds arrays under the same names that are to be used; fresh ones otherwise, which begin at whole cache lines.

    >>> [array.shape for array in buffers(["ratio", "angle"], (2, 3))]
    [(2, 3), (2, 3)]
    """
    if out is None:
        size = prod(shape)
        stride = size + -size % LINE
        block = np.empty(len(names) * stride + LINE)
        skew = -(block.ctypes.data // 8) % LINE
        return tuple(block[skew + k * stride :][:size].reshape(shape) for k in range(len(names)))
    given = {name: getattr(out, name) for name in names}
    check(
        Problem(f"out.{name}", _("needs to be a writeable array of 64-bit floats of shape {shape}").format(shape=shape))
        for name, array in given.items()
        if not _fits(array, shape)
    )
    arrays = tuple(given.values())
    if any(np.may_share_memory(one, two) for k, one in enumerate(arrays) for two in arrays[k + 1 :]):
        raise refuse("out", _("its arrays overlap"))
    return arrays


def _fits(array: object, shape: tuple[int, ...]) -> bool:
    return (
        isinstance(array, np.ndarray)
        and array.shape == shape
        and array.dtype == np.float64
        and array.flags.c_contiguous
        and array.flags.aligned
        and array.flags.writeable
    )
