"""What bearings inside of joints go through: of both crosses of a double cardan, of the rollers of a tripod."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from cardan.drive.joints import Joint
from cardan.formulas.joint_rating import POWER
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.questions.motion.joint_mechanism import joint_carried

PLACES = 360
"""Places of a turn at which the bearings are looked at."""


@lru_cache(maxsize=512)
def bearing_damage(joint: Joint, joint_angle: float) -> tuple[Array, Array]:
    """Return what the bearings in a joint go through for a torque of 1 N·m on its driven shaft.

    joint: with the sizes of `Joint.rated`; joint_angle [rad].
    Returns the largest force on any of them over the torque, array (`PLACES`,) [1/m], and for the one that wears most
    on the driving and on the driven side |dδ/dφ| (F/T)^(10/3), array (2, `PLACES`) [1/m^(10/3)]: δ the angle by which
    it turns, φ that of the driving shaft, at even places θ of its driving mark. A journal carries F = |R|/2 + |M|/l of
    the reaction (M; R) in its pin, l the distance of both its bearings; a roller that runs by s turns by s/r.
    """
    angle = np.arange(PLACES) * (2.0 * np.pi / PLACES)
    found = joint_carried(joint, joint_angle, angle, loads=True)
    forces, damages = [], []
    for k, pair in enumerate(found.pairs[: found.inner]):
        turn, couple = frames.norm(found.found.rate[:, k, :3]), frames.norm(found.found.reaction[:, k, :3])
        force = frames.norm(found.found.reaction[:, k, 3:])
        if pair.rolls > 0.0:
            turn = frames.norm(found.found.rate[:, k, 3:]) / pair.rolls
        elif np.isfinite(pair.spread):
            force = 0.5 * force + couple / pair.spread
        else:
            continue
        forces.append(force)
        damages.append(turn * force**POWER)
    half = max(len(damages) // 2, 1)
    worst = [max(side, key=lambda one: float(np.mean(one))) for side in (damages[:half], damages[-half:])]
    return np.max(forces, axis=0), np.stack(worst)
