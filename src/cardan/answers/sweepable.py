"""What a sweep may ask of a drive: the numbers that a question lists as its ``COLUMNS``, beside its result."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Any

from cardan.units import DIMENSIONS, dimension_of

MODES = 3  # how many natural frequencies and critical speeds are told


@dataclass(frozen=True, kw_only=True)
class OutputColumn:
    """One number of an answer."""

    name: str  # its column in the table, with its unit at the end
    dimension: str = ""  # key of `cardan.units.DIMENSIONS`; empty for a plain number
    unit: str = ""  # unit of the column
    text: str  # what it is, to be translated where it is shown

    @property
    def factor(self) -> float:
        """SI units in one unit of the column."""
        return DIMENSIONS[self.dimension][self.unit] if self.dimension else 1.0

    @classmethod
    def of(cls, name: str, text: str) -> OutputColumn:
        """Return the column of a quantity: the end of its name is its unit, which tells the dimension."""
        words = name.partition("[")[0].split("_")
        ends = ("_".join(words[k:]) for k in range(1, len(words)))
        unit = next(end for end in ends if dimension_of(end))
        return cls(name=name, dimension=dimension_of(unit), unit=unit, text=text)


@dataclass(frozen=True, kw_only=True)
class SweepQuestion:
    """Something that a sweep may ask of a drive."""

    name: str  # its name in a plan
    doc: str  # one sentence on what it answers, to be translated where it is shown
    # the numbers of the answer; of the drive in which fields vary where they depend on it
    told: Sequence[OutputColumn] | Callable[[Any], Sequence[OutputColumn]]
    # drive -> the numbers in SI; an `InputError` where it has none
    of_one: Callable[[Any], Sequence[float]] | None = None
    # `cardan.questions.motion.answer.Motions` -> the numbers in SI, one array (n,) each: of what motion alone decides,
    # asked of all drives at once
    of_many: Callable[[Any], Sequence[Any]] | None = None
    # what the question itself asks of a drive -> the numbers in SI. One of the three is given.
    of_result: Callable[[Any], Sequence[float]] | None = None
    # poses, movements, load cases and errors (`cardan.answers.question.Aspect`) that count in it; without the others it
    # is of the drive as drawn at its duty, and a sweep says so
    counts: tuple[str, ...] = ()
    needs_speed: bool = False  # whether a drive without a speed has no answer
    needs_centres: bool = False  # whether only a drive given by joint centres has an answer

    def columns(self, drive: Any) -> tuple[OutputColumn, ...]:
        """Return the numbers of the answer.

        Parameters
        ----------
        drive : Drive
            The one in which fields vary.
        """
        return tuple(self.told(drive) if callable(self.told) else self.told)


def each(stem: str, dimension: str, unit: str, text: str) -> tuple[OutputColumn, ...]:
    """Return the columns of the first `MODES` of a list."""
    return tuple(
        OutputColumn(name=f"{stem}_{unit}[{k}]", dimension=dimension, unit=unit, text=text) for k in range(MODES)
    )


def first(values: Iterable[float]) -> list[float]:
    """Return the first `MODES` values, nan where there are fewer."""
    kept = [float(one) for one in islice(values, MODES)]
    return kept + [math.nan] * (MODES - len(kept))
