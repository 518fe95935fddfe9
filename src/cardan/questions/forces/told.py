"""What answers about forces share: extremes over a turn without rounding, parts that are loaded alike, curves."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from cardan.answers.answer import Column, Remark
from cardan.answers.quantity import Joined, Quantity, numbered, say
from cardan.drive.drive import Drive
from cardan.drive.shaft import Shaft
from cardan.maths.arrays import Array
from cardan.maths.curves.over_turn import Turn, over_turn
from cardan.maths.kernel import frames
from cardan.maths.ties import TIE
from cardan.texts import _, plural

from .forces import Forces

ROUNDING = 1e-9
"""Share of the largest value below which a value is nothing but rounding, and which a balance may leave."""


def senses(found: Forces) -> tuple[Forces, ...]:
    """Return the forces, and those with the splines sliding back where that differs.

    found: of one drive.
    """
    return (found,) if found.reverse is None else (found, found.reverse)


def tidy(values: Any) -> Array:
    """Return values with what is nothing but rounding set to zero.

    >>> tidy([1.0, 1e-15]).tolist()
    [1.0, 0.0]
    """
    table = np.asarray(values, dtype=float)
    largest = np.max(np.abs(table), initial=0.0, where=np.isfinite(table))
    return np.where(np.abs(table) <= ROUNDING * largest, 0.0, table)


def turn(angle: Array, values: Any) -> Turn:
    """Return least and largest of quantities (..., p) over a turn, rounding left out."""
    return over_turn(angle, tidy(values))


def size(vectors: Any) -> Array:
    """Return the sizes of vectors (..., 3)."""
    return np.asarray(frames.norm(np.asarray(vectors, dtype=float)))


def from_start(angle: float) -> float:
    """Return an input angle [rad] within a turn to 1e-9 degrees, as exactly as extremes are found; a whole turn is 0.

    >>> from_start(2.0 * math.pi - 1e-13), round(from_start(0.5), 9)
    (0.0, 0.5)
    """
    return math.radians(round(math.degrees(float(angle)), 9) % 360.0)


def along_axis(found: Forces) -> Array:
    """Return the axial reactions; beside the radial ones, what is nothing but rounding is zero."""
    axial = np.asarray(found.axial)
    return np.where(np.abs(axial) <= ROUNDING * np.max(size(found.reaction), initial=0.0), 0.0, axial)


def together(names: Sequence[str], places: Sequence[int]) -> Joined:
    """Return the parts at some places, counted from 0, as a sentence names them.

    >>> from cardan.answers.reader import USUAL
    >>> together(["left", "right", ""], [1, 2]).told(USUAL)
    '2 (right) and 3'
    """
    return Joined([numbered(k + 1, names[k]) for k in places], last=_(" and "))


def span(low: float, high: float, dimension: str, digits: int = 4) -> dict[str, Any]:
    """Return the places ``{low:bare}`` and ``{high}`` of a sentence."""
    return {"low": Quantity(low, dimension, digits), "high": Quantity(high, dimension, digits)}


def constant(low: float, high: float) -> bool:
    """Tell whether a quantity is the same over a turn but for rounding."""
    return high - low <= TIE * max(abs(low), abs(high))


def called(shaft: Shaft, shafts: int) -> str:
    """Return the name of a shaft; input and output where it has none."""
    ends = {1: _("input"), shafts: _("output")}
    return shaft.name or ends.get(shaft.number, "")


def support_names(drive: Drive) -> list[str]:
    """Return the names of the supports."""
    return [one.name for one in drive.supports]


def held_by_machines(machines: tuple[int, ...]) -> Iterator[Remark]:
    """Yield that machines hold the end shafts on which no support stands."""
    if machines:
        text = plural(
            "Shaft {which} is held by its machine, at the joint; [[supports]] on it would tell its bearings apart.",
            "Shafts {which} are held by their machines, at the joints; [[supports]] on them would tell their bearings "
            "apart.",
            len(machines),
        )
        yield Remark(text=say(text, which=Joined([str(number) for number in machines], last=_(" and "))))


def curve(key: str, values: Any, dimension: str = "", unit: str = "") -> Column:
    """Return a column for programs."""
    return Column(key=key, values=values, dimension=dimension, unit=unit)


def vector(key: str, values: Any, dimension: str, unit: str = "") -> tuple[Column, ...]:
    """Return the columns of the parts of a vector (p, 3)."""
    table = np.asarray(values)
    return tuple(curve(f"{key}_{way}", table[:, k], dimension, unit) for k, way in enumerate("xyz"))


def largest_left(*parts: Array | None) -> float:
    """Return the largest of what balances leave."""
    return max(float(np.max(np.asarray(part))) for part in parts if part is not None)
