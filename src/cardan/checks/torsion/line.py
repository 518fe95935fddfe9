"""What the checks of torsional vibration ask of a drive: whether its file tells enough, and the speeds in use."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from cardan.answers.quantity import Joined, Text
from cardan.checks.design import Design
from cardan.drive.conditions import load_cases
from cardan.drive.drive import Drive
from cardan.drive.torsional_layout import has_torsion
from cardan.errors import InputError
from cardan.maths.arrays import Array
from cardan.questions.torsion.model.torsion import TorsionModes, modes_of
from cardan.texts import _

NO_MODEL = ("stations[0].inertia",)
"""What a file lacks that says nothing of masses and stiffness."""


@lru_cache(maxsize=4096)
def modes(drive: Drive, *, crossings: bool = False) -> TorsionModes | tuple[str, ...]:
    """Return the torsional modes of a drive, with crossings or without, or the paths of what its file lacks."""
    if not has_torsion(drive):
        return NO_MODEL
    try:
        return modes_of(drive, drive.duty, crossings=crossings)
    except InputError as error:
        return tuple(problem.field for problem in error.problems)


def lacking(design: Design) -> tuple[str, ...]:
    """Return what a design lacks to be judged: a torsional model, a speed."""
    found = modes(design.drive)
    return (*(found if isinstance(found, tuple) else ()), *design.unmoved)


def used(drive: Drive) -> list[tuple[float, float]]:
    """Return the ranges of input speed in use [rad/s], either way round; one speed where both ends are alike."""
    found: list[tuple[float, float]] = []
    for case in load_cases(drive.duty):
        if case.speed_range is not None:
            found.append(case.speed_range)
        if case.speed:
            found.append((abs(case.speed), abs(case.speed)))
    if drive.duty.speed_range is not None:
        found.append(drive.duty.speed_range)
    if drive.duty.speed:
        found.append((abs(drive.duty.speed),) * 2)
    return list(dict.fromkeys(found))


def nearest_used(drive: Drive, speed: float) -> float:
    """Return the speed in use that is nearest to a speed [rad/s], in their ratio."""
    inside = [float(np.clip(speed, *between)) for between in used(drive) if between[1] > 0.0]
    return min(inside, key=lambda one: abs(np.log(max(one, 1e-12) / speed)))


def rubbing(drive: Drive) -> bool:
    """Tell whether an element of the torsional line has dry friction."""
    return any(one.to_next is not None and one.to_next.friction > 0.0 for one in drive.stations)


def as_drawn(design: Design, note: Text) -> Text:
    """Return a note, of a drive that moves with the word that it is judged as drawn."""
    if not design.drive.movements:
        return note
    return Joined([note, _("as drawn; cardan torsion road tells it along the movement")], between="; ")


def worst(used: Sequence[Array], *columns: Sequence[Array]) -> tuple[Array, ...]:
    """Return of each column, one value (...) a way of running, that of the way that uses most, arrays (...)."""
    shape = np.broadcast_shapes(*(np.shape(one) for row in (used, *columns) for one in row))
    every = np.stack([np.broadcast_to(one, shape) for one in used])
    first = np.argmax(every, axis=0)[None]
    return tuple(
        np.take_along_axis(np.stack([np.broadcast_to(one, shape) for one in column]), first, axis=0)[0][()]
        for column in columns
    )
