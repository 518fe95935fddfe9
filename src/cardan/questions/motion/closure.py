"""Which bend would let the joints of a drive cancel out?"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.models.chain import turning_chain
from cardan.maths.arrays import Array


@dataclass(frozen=True, eq=False, kw_only=True)
class Closure:
    """Whether the sides of the phase polygon can close, in numbers."""

    length: Array  # (n,): L_i = -ln cos α_i, hyperbolic length of each joint's side
    longest: int  # number of the joint with the longest side
    others: float  # sum of the other sides
    joint_angle_allowed: float  # [rad]: largest joint angle of that joint that the others can cancel

    @property
    def closes(self) -> bool:
        """Whether free yokes can make the drive synchronous."""
        return float(self.length[self.longest - 1]) <= self.others * (1.0 + 1e-14)


def closure(drive: Drive) -> Closure:
    """Return whether free yokes can close the phase polygon of a drive, and what the longest side may be.

    drive: the drive; held yokes are not looked at.
    Synchronous, exactly, if and only if L_max ≤ Σ of the others, cos α_max ≥ Π cos α of the others. Book (86) is its
    limit for small angles.
    """
    length = -np.log(np.cos(np.asarray(turning_chain(drive).joint_angle)))
    longest = int(np.argmax(length))
    others = float(np.sum(length) - length[longest])
    # cos x = e^-S, as 2 asin √((1 - e^-S)/2): accurate for small bends.
    allowed = 2.0 * math.asin(math.sqrt(-0.5 * math.expm1(-others)))
    return Closure(length=length, longest=longest + 1, others=others, joint_angle_allowed=allowed)
