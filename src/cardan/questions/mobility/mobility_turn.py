"""Does a mechanism bind everywhere, or only in special positions? Its mobility over a turn of the input."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from cardan.drive.drive import Drive
from cardan.maths.arrays import Array
from cardan.maths.kernel import screws
from cardan.mechanism.constraints import constraints
from cardan.mechanism.mechanism import Mechanism

from .drive_mechanism import mechanism_of
from .finite_mobility import CLOSED, finite_mobility

POSITIONS = 72
"""Positions of a turn: every 5°, dead centres at multiples of them included."""


@dataclass(frozen=True, eq=False, kw_only=True)
class MobilityTurn:
    """Mobility and redundant constraints over a turn of the input.

    Attributes
    ----------
    angle : array (p,) [rad]
        How far the input is turned.
    mobility, redundant : arrays of int (p,)
        W and q there.
    certain : array of bool (p,)
        Whether the rank is; where not, the mechanism stands next to a special position, or in one but for rounding.
    residual : array (p,)
        What keeps the loops from closing there [m, rad]; nought for drives, whose motion is known exactly.
    cancelled : bool
        Whether ``progress`` said "stop"; the arrays then end there.
    """

    angle: Array
    mobility: Array
    redundant: Array
    certain: Array
    residual: Array
    cancelled: bool = False

    @property
    def reached(self) -> Array:
        """Which positions the mechanism reaches without force, array of bool (p,)."""
        return self.residual < CLOSED

    @property
    def turns(self) -> bool:
        """Whether it reaches them all."""
        return bool(np.all(self.reached))

    @property
    def structural(self) -> int:
        """Redundant constraints of every position: those that come from how it is built."""
        return int(np.min(self.redundant[self.reached]))

    @property
    def special(self) -> Array:
        """Angles of positions with more of them, or next to one with more, array [rad]."""
        return self.angle[self.reached & ((self.redundant > self.structural) | ~self.certain)]


def mobility_over_turn(
    thing: Drive | Mechanism,
    *,
    driven_joint: str = "",
    positions: int = POSITIONS,
    progress: Callable[[float], object] | None = None,
) -> MobilityTurn:
    """Return mobility and redundant constraints over a turn of the input.

    Parameters
    ----------
    thing : Drive or Mechanism
    driven_joint : str
        Of a mechanism, the joint that is driven; see `cardan.questions.mobility.finite_mobility.finite_mobility`.
    positions : int
        Number of positions, evenly over the turn from the start on.
    progress : function, optional
        Called with the share done; answering "stop" ends there.

    Returns
    -------
    MobilityTurn
        angle, mobility, redundant : arrays (p,)

    Raises
    ------
    InputError
        A drive that is no mechanism yet, or no joint that could be driven.

    See Also
    --------
    mobility, finite_mobility

    Examples
    --------
    >>> from cardan.drive.support import Support
    >>> from dataclasses import replace
    >>> stiff = dict(radial=True, axial=True, tilt=True)
    >>> held = (Support(shaft=1, position=-0.3, **stiff), Support(shaft=2, position=0.3, **stiff))
    >>> found = mobility_over_turn(replace(Drive.from_angles([0.3]), supports=held), positions=8)
    >>> found.structural, len(found.special)
    (3, 0)
    """
    along = np.linspace(0.0, 2.0 * math.pi, positions, endpoint=False)
    if isinstance(thing, Mechanism):
        return _followed(thing, driven_joint, along, progress)
    drive = thing
    return _counted(along, lambda k: mechanism_of(drive, float(along[k])), np.zeros(positions), progress)


def _followed(
    mechanism: Mechanism, driven_joint: str, along: Array, progress: Callable[[float], object] | None
) -> MobilityTurn:
    """Return the same of a mechanism whose loops are closed from one position to the next."""
    per = max(1, math.ceil(POSITIONS / len(along)))
    moved = finite_mobility(
        mechanism,
        driven_joint=driven_joint,
        angle=float(along[-1]),
        steps=per * (len(along) - 1),
        progress=None if progress is None else lambda share: progress(0.8 * share),
    )
    residual = moved.residual[::per]
    rest = None if progress is None or moved.cancelled else lambda share: progress(0.8 + 0.2 * share)
    found = _counted(along[: len(residual)], lambda k: moved.at(per * k), residual, rest)
    return replace(found, cancelled=found.cancelled or moved.cancelled)


def _counted(
    along: Array, place: Callable[[int], Mechanism], residual: Array, progress: Callable[[float], object] | None
) -> MobilityTurn:
    rows: list[tuple[int, int, bool]] = []
    stopped = False
    for k in range(len(along)):
        matrix = constraints(place(k)).matrix()
        rank = screws.rank(matrix)
        rows.append((matrix.shape[1] - rank.value, matrix.shape[0] - rank.value, rank.certain))
        if progress is not None and progress((k + 1) / len(along)) == "stop":
            stopped = len(rows) < len(along)
            break
    mobility, redundant, certain = (np.asarray(column) for column in zip(*rows, strict=True))
    return MobilityTurn(
        angle=along[: len(rows)],
        mobility=mobility,
        redundant=redundant,
        certain=certain,
        residual=residual[: len(rows)],
        cancelled=stopped,
    )
