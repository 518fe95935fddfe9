"""Largest loads of the shafts of a drive, one row for each way of running."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cardan.maths.arrays import Array
from cardan.questions.forces.turn_loads import TurnLoads


@dataclass(frozen=True, eq=False, kw_only=True)
class ShaftLoads:
    """Largest loads of the shafts of a drive in each way of running, arrays (c, n+1), factor for shocks not counted.

    Attributes
    ----------
    low, high : arrays [N·m]
        Least and largest torque over a turn.
    bending : array [N·m]
        Largest secondary couple at either end.
    moment : array [N·m]
        Largest √(T² + M²).
    mises : array [N·m]
        Largest √(4 M² + 3 T²).
    """

    low: Array
    high: Array
    bending: Array
    moment: Array
    mises: Array

    @property
    def torque(self) -> Array:
        """Largest size of the torque [N·m]."""
        return np.maximum(np.abs(self.low), np.abs(self.high))


def shaft_loads(loads: Sequence[TurnLoads]) -> ShaftLoads:
    """Return the loads of the shafts in all ways of running, one below the other."""
    return ShaftLoads(
        **{
            name: np.stack([getattr(one, name) for one in loads])
            for name in ("low", "high", "bending", "moment", "mises")
        }
    )
