"""How hard the lip seals of a drive rub, for the answers that count it and those that leave it out."""

from __future__ import annotations

import numpy as np

from cardan.drive.drive import Drive
from cardan.formulas.friction import seal_friction
from cardan.maths.arrays import Array


def seal_torques(drive: Drive) -> Array:
    """Return the friction torque of the seals of each support, array (k,) [N·m]."""
    return np.asarray([one.seals * float(seal_friction(one.seal_diameter or 0.0)) for one in drive.supports])
