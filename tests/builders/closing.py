"""Truths for yoke settings, from plain vectors."""

from __future__ import annotations

import numpy as np

from tests.builders.vector_model import VectorModel


def speed_fluctuation(joint_angles, plane_twists, yoke_angles):
    """Return δ of drives, arrays (..., n) and (..., n-1), exactly, from three positions of the vector model.

    The inverse of the speed ratio is a constant and a sine of twice the input angle (u·u for an arm u that turns
    linearly); three positions fix both. Its extremes multiply to one, so δ is the double amplitude.
    """
    joint_angles, plane_twists, yoke_angles = np.broadcast_arrays(
        joint_angles, *(np.concatenate((x, np.zeros((*x.shape[:-1], 1))), axis=-1) for x in (plane_twists, yoke_angles))
    )
    n = joint_angles.shape[-1]
    model = VectorModel.from_angles(
        [joint_angles[..., i] for i in range(n)],
        [plane_twists[..., i] for i in range(n - 1)],
        [yoke_angles[..., i] for i in range(n - 1)],
    )
    samples = [1.0 / model.ratios(k * np.pi / 3)[-1] for k in range(3)]
    wave = sum(s * np.exp(2j * k * np.pi / 3) for k, s in enumerate(samples)) * (2 / 3)
    return 2.0 * np.abs(wave)
