"""How the joints of a drive bend and turn, as a torsional model has it."""

from __future__ import annotations

from dataclasses import replace
from typing import TypedDict

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.models.geometry import Geometry
from cardan.drive.models.kinematics_model import Chain, turning
from cardan.drive.models.law_series import beside_maps
from cardan.maths.arrays import Array
from cardan.questions.motion.motion import initial_phases

from .torsional_balance import joint_law
from .torsional_model import flat_sums


class Bends(TypedDict):
    """Fields of a `TorsionalModel` that tell how its joints turn."""

    joint_angle: Array
    phase: Array
    sums: Array | None


def bends(drive: Drive, given: Chain, place: Geometry | None = None) -> Bends:
    """Return how joints turn, as fields of a torsional model: each as the Hooke joint nearest to it and what is beside.

    given (..., n): joint angles, planes and yokes of the drive as they are; place (...): where its joints are then; by
    these angles when not given.
    Raises InputError: a joint that does not turn at its joint angle, or whose law is too sharp to be followed.
    """
    near = turning(given, drive.joints, near=True)
    sums = beside_maps(drive, given, near, place)
    if sums is None:
        phase = initial_phases(replace(near, laws=None))
    else:
        before = np.broadcast_to(near.turn_before, np.shape(near.joint_angle))
        each = [before[..., 0]]
        for i in range(1, near.joints):
            turned = joint_law(each[-1], near.joint_angle[..., i - 1], sums[..., i - 1])[0]
            each.append(turned + before[..., i])
        phase = np.stack(each, axis=-1)
    return Bends(joint_angle=np.asarray(near.joint_angle, dtype=float), phase=np.asarray(phase), sums=flat_sums(sums))
