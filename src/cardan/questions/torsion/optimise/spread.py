"""How far the quantities of a drive may be off as made, and the drives at the corners of their tolerances."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from math import isfinite

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.fields.paths import read, with_values
from cardan.errors import InputError, Problem, check
from cardan.maths.arrays import Array
from cardan.texts import _

MOST = 6
"""Tolerances at most: 64 corners."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Spread:
    """The tolerance of a quantity, to either side."""

    path: str  # as ``shafts[1].stiffness_Nm_per_rad``
    size: float  # in the unit of the path, or a share of the value
    share: bool  # whether it is a share

    def off(self, value: float, side: float) -> float:
        """Return a value that is off by so much of its tolerance, from -1 to 1.

        >>> Spread(path="", size=0.05, share=True).off(200.0, -1.0), Spread(path="", size=0.5, share=False).off(3.0, 1)
        (190.0, 3.5)
        """
        return value * (1.0 + side * self.size) if self.share else value + side * self.size


def spreads(drive: Drive, tolerances: Mapping[str, float | str] | None) -> tuple[Spread, ...]:
    """Return tolerances by their paths: a size in the unit of the path, or a share as ``"5%"``."""
    found: list[Spread] = []
    problems: list[Problem] = []
    for path, given in (tolerances or {}).items():
        try:
            now = read(drive, path)
        except InputError as error:
            problems += error.problems
            continue
        text = str(given).strip()
        try:
            size, share = float(text.removesuffix("%")), text.endswith("%")
        except ValueError:
            size, share = float("nan"), False
        size = 0.01 * size if share else size
        if isinstance(now, bool) or not isinstance(now, float):
            problems.append(Problem(path, _("leads to no number; name one, as joints[0].centre_mm[2]")))
        elif not (isfinite(size) and size > 0.0 and not (share and size >= 1.0)):
            said = _("not a tolerance: {given}; write more than 0 in the unit of the key, or a share below 100%, as 5%")
            problems.append(Problem(path, said.format(given=text)))
        else:
            found.append(Spread(path=path, size=size, share=share))
    if len(found) > MOST:
        said = _("{count} tolerances; at most {most} are counted, each doubles the work")
        problems.append(Problem("tolerances", said.format(count=len(found), most=MOST)))
    check(problems)
    return tuple(found)


def corners(count: int) -> list[Array]:
    """Return the drive as drawn and the corners of so many tolerances, arrays (count,) of -1, 0, 1.

    >>> [one.tolist() for one in corners(1)]
    [[0.0], [-1.0], [1.0]]
    """
    return [np.zeros(count), *(np.asarray(one) for one in product((-1.0, 1.0), repeat=count) if count)]


def drive_off(drive: Drive, off: Sequence[Spread], sides: Array) -> Drive | None:
    """Return a drive that is off by parts of its tolerances; None where that makes none."""
    if not np.any(sides):
        return drive
    try:
        values = {one.path: one.off(read(drive, one.path), float(side)) for one, side in zip(off, sides, strict=True)}
        return with_values(drive, values)
    except InputError:
        return None
