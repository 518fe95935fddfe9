"""Where a joint stands: its centre, its shafts and its marks, as bodies and inner mechanisms need them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.maths.arrays import Array
from cardan.maths.kernel import frames


@dataclass(frozen=True, eq=False, kw_only=True)
class Stance:
    """A joint in space, at one place of a turn or at many (...)."""

    centre: Array  # (3,) [m]: where its shafts meet
    before: Array  # before, after (3,): directions of the driving and the driven shaft, both along the power flow
    after: Array  # (3,)
    normal: Array  # (3,): normal of the plane of both
    joint_angle: float  # [rad]: angle between them
    # driving, driven (..., 3): directions of its marks: the arms of its cross in the driving and the driven yoke, where
    # it has one
    driving: Array
    driven: Array  # (..., 3)
    length: float  # [m]: length of the driven shaft

    @property
    def theta(self) -> Array:
        """Angle of the driving mark from the plane of the shafts, array (...) [rad]."""
        across = frames.cross(self.normal, self.before)
        found: Array = np.arctan2(self.driving @ self.normal, self.driving @ across)
        return found

    @property
    def middle(self) -> Array:
        """Normal of the plane that halves the joint angle, array (3,)."""
        return frames.unit(self.before + self.after)

    def halving(self, turn: Array) -> Array:
        """Return the direction in the halving plane whose meridian stands at an angle (...) [rad], array (..., 3)."""
        across = frames.cross(self.normal, self.middle)
        chi = np.arctan2(np.sin(turn) * np.cos(0.5 * self.joint_angle), np.cos(turn))
        found: Array = np.cos(chi)[..., None] * across + np.sin(chi)[..., None] * self.normal
        return found
