"""Half the trace of Mathieu's equation at a million points, to the digits a map shows."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from cardan.later import later
from cardan.maths.arrays import NUMBERS, Array, ArrayLike, namespace, real
from cardan.maths.compiled.method import Compiled, Method, buffers, chosen, share
from cardan.maths.compiled.splitting import plan

from .mathieu import check_range, exponents

compiled = later("cardan.maths.compiled.mathieu_map")

LARGE = 100_000
"""Points from which on the kernel is the default."""

ACCURACY = 2e-6
"""Error of half the trace where it is of the order of one."""

STEP = 0.6
"""Product of step and √(\\|a\\| + 2\\|q\\|) that gives `ACCURACY`; the error falls with its sixth power."""

MOST_STEPS = 400
"""Where half a period needs more steps than this the exact form is used."""

_PIECE = 2**16


@dataclass(frozen=True, eq=False, kw_only=True)
class StabilityMap:
    """Which of many of Mathieu's equations are stable."""

    half_trace: Array  # (...): cos πβ of the equation freed of its damping
    damping: Array  # (...): n, per radian of z

    @property
    def stable(self) -> Array:
        """Whether nothing grows, array (...) of bool: \\|cos πβ\\| ≤ cosh πn."""
        xp = namespace(self.half_trace)
        return xp.abs(self.half_trace) <= xp.cosh(xp.pi * self.damping)

    @property
    def growth(self) -> Array:
        """Rate of growth per radian of z, array (...)."""
        xp = namespace(self.half_trace)
        return xp.acosh(xp.maximum(xp.abs(self.half_trace), xp.asarray(1.0))) / xp.pi - self.damping


def stability_map(
    a: ArrayLike,
    q: ArrayLike,
    n: ArrayLike = 0.0,
    *,
    accuracy: float = ACCURACY,
    out: StabilityMap | None = None,
    method: Method | None = None,
) -> StabilityMap:
    """Return the stability of y'' + 2n y' + (a - 2q cos 2z) y = 0 at many points.

    a, q, n (...): for a grid ``a[None, :]`` and ``q[:, None]``.
    accuracy: error of half the trace of the compiled form, a share of it where it is large.
    out: result of an earlier call of the same size, to be written over.
    method: Compiled by default from 100,000 points on, where numba is installed; plain is Hill's determinant, exact.
    Returns StabilityMap: arrays (...).
    Raises InputError: a value is not finite or out of range, or ``out`` has not the size of the results.
    Compiled: half a period by Blanes and Moan's splitting of sixth order, in as many steps as the fastest of 64 points
    needs. a' = a - n² takes in the damping exactly.
    """
    xp = namespace(a, q, n)
    xp = np if xp is NUMBERS else xp
    a, q, n = (real(value, xp) for value in (a, q, n))
    check_range(a, q, n, xp)
    shape = np.broadcast_shapes(a.shape, q.shape, n.shape)
    how = chosen(method, xp, math.prod(shape) >= LARGE)
    damping = xp.broadcast_to(n, shape)
    if xp is not np:
        return StabilityMap(half_trace=exponents(a, q, n).half_trace, damping=damping)
    (room,) = buffers(("half_trace",), shape, out)
    if room.size:
        columns = shape[-1] if shape else 1
        both = (np.broadcast_to(part, shape).reshape(-1, columns) for part in (a - n * n, q))
        inner, wave = (np.broadcast_to(part, part.shape) for part in both)  # not to be written to
        top = math.sqrt(float(np.max(np.abs(a - n * n)) + 2.0 * np.max(np.abs(q))))
        reach = STEP * (accuracy / ACCURACY) ** (1 / 6) / (0.5 * math.pi)
        if isinstance(how, Compiled) and top < MOST_STEPS * reach:
            _compiled(inner, wave, room.reshape(-1), reach, how.threads)
        else:
            rows = max(1, _PIECE // columns)
            for first in range(0, inner.shape[0], rows):
                part = slice(first, first + rows)
                found = exponents(inner[part], wave[part]).half_trace
                room.reshape(-1)[first * columns :][: found.size] = found.reshape(-1)
    return StabilityMap(half_trace=room, damping=damping)


def _compiled(a: Array, q: Array, out: Array, reach: float, threads: int | None) -> None:
    table, ladder, places = plans()

    def work(first: int, last: int) -> None:
        compiled().kernel(a, q, table, ladder, places, reach, first, last, out)

    share(work, a.shape[0], threads=threads, least=max(1, 4096 // a.shape[1]))


@cache
def plans() -> tuple[Array, Array, Array]:
    """Return the plans of all courses, the numbers of their steps, and where each plan begins."""
    steps: list[int] = []
    while not steps or steps[-1] < MOST_STEPS:
        steps.append(max(2, (steps or [1])[-1] + 1, int(1.06 * (steps or [1])[-1])))
    tables: list[Any] = [plan(count) for count in steps]
    places = np.cumsum([0, *(table.size for table in tables[:-1])])
    return np.concatenate(tables), np.asarray(steps, dtype=np.intp), np.asarray(places, dtype=np.intp)
