"""Motion of many drives by JAX: the same formulas on its arrays, compiled as one, on its default device."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Any

import numpy as np

from cardan.answers.sweepable import OutputColumn
from cardan.drive.drive import Drive
from cardan.drive.models.laws import mixed
from cardan.later import later
from cardan.maths.arrays import Array
from cardan.texts import mark

from .many import many
from .questions import asked

jax = later("jax", mark("computing on a GPU needs JAX: pip install 'cardan[gpu]'"))
numpy = later("jax.numpy")

PIECES = (2**10, 2**15, 2**20)
"""Points that the device is given at a time: the least of these that holds them, filled up.

Each size is compiled once, which takes seconds; a piece of the largest takes about a gigabyte.
"""


def jax_numpy() -> tuple[Any, Any]:
    """Return JAX and its array library, set to 64 bits.

    Raises MissingExtraError: it is not installed.
    """
    jax().config.update("jax_enable_x64", True)
    return jax(), numpy()


def answered(
    drive: Drive, questions: tuple[str, ...], si: Mapping[str, Array], count: int
) -> tuple[list[tuple[str, Array]], Array]:
    """Return answers to questions about motion, and which points are drives.

    drive: the drive in which places and angles vary; questions: names of questions about motion.
    si, mapping of str to array (count,): path without unit -> values in SI.
    Returns list of (str, array (count,)), array of bool (count,).
    """
    _jax, xp = jax_numpy()
    piece = next((size for size in PIECES if size >= count), PIECES[-1])
    run = _program(drive, questions, piece)
    parts: dict[str, list[Array]] = {}
    reals: list[Array] = []
    for start in range(0, count, piece):
        rows = slice(start, min(start + piece, count))
        held = rows.stop - start
        filled = {
            path: np.concatenate((one[rows], np.repeat(one[rows][-1:], piece - held))) for path, one in si.items()
        }
        columns, real = run({path: xp.asarray(one) for path, one in filled.items()})
        for name, column in columns.items():
            parts.setdefault(name, []).append(np.asarray(column)[:held])
        reals.append(np.asarray(real)[:held])
    if not count:
        return [(told.name, np.empty(0)) for told in _told(drive, questions)], np.empty(0, dtype=bool)
    return [(name, np.concatenate(column)) for name, column in parts.items()], np.concatenate(reals)


@lru_cache(maxsize=16)
def _program(drive: Drive, questions: tuple[str, ...], piece: int) -> Callable[[dict[str, Array]], Any]:
    """Return what answers so many points at once, compiled where it does not look at what it computes."""
    jax, xp = jax_numpy()

    def program(values: dict[str, Array]) -> tuple[dict[str, Array], Array]:
        found, real = many(drive, values, piece, xp=xp)
        answers = (column for one in asked(questions) if one.of_many for column in one.of_many(found))
        pairs = zip(_told(drive, questions), answers, strict=True)
        return {told.name: xp.broadcast_to(column / told.factor, (piece,)) for told, column in pairs}, real

    return program if mixed(drive.joints) else jax.jit(program)


def _told(drive: Drive, questions: tuple[str, ...]) -> list[OutputColumn]:
    return [told for one in asked(questions) for told in one.columns(drive)]
