"""Which joint must be freed, and in which direction, so that a mechanism is no longer held too much?"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from cardan.errors import refuse
from cardan.maths.arrays import ArrayLike
from cardan.maths.kernel import frames, screws
from cardan.mechanism.constraints import constraints
from cardan.mechanism.mechanism import Mechanism
from cardan.mechanism.pair import LENGTHS, Way
from cardan.texts import _
from cardan.units import nearest


@dataclass(frozen=True, kw_only=True, slots=True)
class Release:
    """What one more freedom at a joint does.

    Attributes
    ----------
    joint : str
        Name of the joint.
    way : "rot" or "trans"
        Whether it may turn or slide.
    redundant : int
        Change of the redundant constraints q.
    mobility : int
        Change of the mobility W.
    """

    joint: str
    way: Way
    redundant: int
    mobility: int

    @property
    def verdict(self) -> Literal["remedy", "spoil", "free"]:
        """Whether it takes a redundant constraint away, lets something loose, or was free before."""
        return "remedy" if self.redundant < 0 else "spoil" if self.mobility > 0 else "free"


def release(mechanism: Mechanism, joint: str, way: Way, axis: ArrayLike) -> Release:
    """Return what one more freedom at a joint does to a mechanism.

    Parameters
    ----------
    mechanism : Mechanism
    joint : str
        Name of the joint.
    way : "rot" or "trans"
        Whether it may turn about the axis through its point, or slide along it.
    axis : array (3,)
        Direction, of any length.

    Returns
    -------
    Release

    Raises
    ------
    InputError
        No such joint or way, or no direction.

    See Also
    --------
    repairs, mobility

    Notes
    -----
    Either the freedom takes part in a state of stress, then q falls by one, or it does not, then W rises by one; what
    the joint could do before changes nothing. Ranks are taken anew.

    Examples
    --------
    >>> from cardan.mechanism.pair import Pair
    >>> hinge = Pair(id="upper", type="R", links=("wall", "door"), point=(0.0, 0.0, 2.0), axis=(0.0, 0.0, 1.0))
    >>> lower = Pair(id="lower", type="R", links=("wall", "door"), point=(0.0, 0.0, 0.2), axis=(0.0, 0.0, 1.0))
    >>> release(Mechanism(frame="wall", joints=(hinge, lower)), "upper", "trans", [0.0, 0.0, 1.0]).verdict
    'remedy'
    """
    names = [pair.id for pair in mechanism.joints]
    if joint not in names:
        near = nearest(joint, names)
        hint = _("; did you mean {near}?").format(near=near) if near else ""
        raise refuse("joint", _("there is no joint {name}").format(name=repr(joint)) + hint, "inconsistent")
    if way not in ("rot", "trans"):
        raise refuse("way", _("{value} is none of {choices}").format(value=repr(way), choices="rot, trans"))
    direction = np.asarray(axis, dtype=float)
    if direction.shape != (3,) or not LENGTHS[0] < math.hypot(*direction) < LENGTHS[1]:
        raise refuse("axis", _("{value} is not a direction").format(value=direction.tolist()), "out_of_range")
    system = constraints(mechanism)
    number = names.index(joint)
    unit = frames.unit(direction)
    point = system.place(mechanism.joints[number].point)
    twist = screws.rotation(unit, point) if way == "rot" else screws.translation(unit)
    after = system.with_freedom(number, twist[None])
    (before_w, before_q), (after_w, after_q) = (_numbers(one.matrix()) for one in (system, after))
    return Release(joint=joint, way=way, redundant=after_q - before_q, mobility=after_w - before_w)


def _numbers(matrix: np.ndarray) -> tuple[int, int]:
    """Return mobility and redundant constraints of a matrix of constraints."""
    rank = screws.rank(matrix).value
    return matrix.shape[1] - rank, matrix.shape[0] - rank
