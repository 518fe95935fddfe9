"""Motion of many drives by JAX: the same formulas on its arrays, compiled as one, on its default device."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.laws import mixed
from cardan.errors import MissingExtraError
from cardan.maths.arrays import Array
from cardan.texts import _

from .many import Many, many

PIECE = 2**20
"""Points that the device is given at a time; a short last piece is filled up, so that one program serves all."""


def jax_numpy() -> tuple[Any, Any]:
    """Return JAX and its array library, set to 64 bits.

    Raises
    ------
    MissingExtraError
        It is not installed.
    """
    try:
        import jax
    except ImportError:
        raise MissingExtraError(_("computing on a GPU needs JAX: pip install 'cardan[gpu]'")) from None
    jax.config.update("jax_enable_x64", True)
    import jax.numpy as xp

    return jax, xp


def answered(
    drive: Drive, si: Mapping[str, Array], count: int, told: Callable[[Many], Iterable[tuple[str, Array]]]
) -> tuple[list[tuple[str, Array]], Array]:
    """Return answers to questions about motion, and which points are drives.

    Parameters
    ----------
    drive : Drive
        The drive in which places and angles vary.
    si : mapping of str to array (count,)
        Path without unit -> values in SI.
    count : int
    told : function
        Many drives -> names and arrays of the answers.

    Returns
    -------
    list of (str, array (count,)), array of bool (count,)
        In NumPy.
    """
    jax, xp = jax_numpy()
    piece = min(PIECE, 1 << max(0, count - 1).bit_length())

    def program(values: dict[str, Array]) -> tuple[dict[str, Array], Array]:
        found, real = many(drive, values, piece, xp=xp)
        return {name: xp.broadcast_to(column, (piece,)) for name, column in told(found)}, real

    run = program if mixed(drive.joints) else jax.jit(program)  # other kinds look at what they compute
    parts: dict[str, list[Array]] = {}
    reals: list[Array] = []
    for start in range(0, count, piece):
        rows = slice(start, min(start + piece, count))
        held = rows.stop - start
        values = {
            path: np.concatenate((one[rows], np.repeat(one[rows][-1:], piece - held))) for path, one in si.items()
        }
        columns, real = run({path: xp.asarray(one) for path, one in values.items()})
        for name, column in columns.items():
            parts.setdefault(name, []).append(np.asarray(column)[:held])
        reals.append(np.asarray(real)[:held])
    return [(name, np.concatenate(column)) for name, column in parts.items()], np.concatenate(reals)
