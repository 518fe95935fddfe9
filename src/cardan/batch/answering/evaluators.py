"""Answers by plain functions: for formulas of one's own beside the questions of a drive."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from cardan.batch.work import STATUS, Column, Rows, Status
from cardan.maths.arrays import Array


@dataclass(frozen=True, kw_only=True)
class Formula:
    """Functions of the fields, each an answer; where one is not finite there is none.

    Attributes
    ----------
    points, answers : tuple of Column
        Fields and answers.
    functions : tuple of callable
        One for each answer; takes an array (n,) for each field and returns one.
    """

    points: tuple[Column, ...]
    answers: tuple[Column, ...]
    functions: tuple[Callable[..., Any], ...]

    @classmethod
    def of(cls, fields: Sequence[str], answers: Mapping[str, Callable[..., Any]]) -> Formula:
        """Return formulas over fields without units.

        Parameters
        ----------
        fields : sequence of str
            Their names.
        answers : mapping of str to callable
            Name and function of each answer.
        """
        return cls(
            points=tuple(Column(name=name, unit="", role="point", text=name) for name in fields),
            answers=tuple(Column(name=name, unit="", role="answer", text=name) for name in answers),
            functions=tuple(answers.values()),
        )

    def __call__(self, points: Array) -> Rows:
        """Return the answers at points (n, d)."""
        columns = np.asarray(points, dtype=float).T
        with np.errstate(all="ignore"):
            values = [np.broadcast_to(one(*columns), columns.shape[1:]).astype(float) for one in self.functions]
        rows: Rows = {column.name: value for column, value in zip(self.answers, values, strict=True)}
        known = np.all(np.isfinite(np.stack(values)), axis=0) if values else np.ones(columns.shape[1:], dtype=bool)
        rows[STATUS] = np.where(known, int(Status.ANSWERED), int(Status.NO_ANSWER)).astype(np.int8)
        return rows
