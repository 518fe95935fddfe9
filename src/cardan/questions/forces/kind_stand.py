"""How joints of any kinds stand while a drive turns, and which way the couples point that they pass on."""

from __future__ import annotations

import numpy as np

from cardan.drive.models.chain import Chain
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.questions.motion.motion import Motion

from .turn_loads import lean


def kind_arms(chain: Chain, axis: Array, normal: Array, found: Motion) -> tuple[Array, Array, Array]:
    """Return arms or marks of the joints of a chain of mixed kinds, and the directions of their couples.

    chain (..., n): with its laws.
    axis, normal (..., n+1, 3), (..., n, 3): directions of the shafts, and normals of the joints' planes.
    found (..., p).
    Returns driving, driven, way (..., p, n, 3): unit vectors.
    The couple of a joint without a cross is along (1, (1 - i cos α)/sin α, -f_α) in (e, N×e, N), see
    `cardan.questions.forces.turn_loads.across`: the bisector of e and e' where the joint is even.
    """
    laws = chain.laws
    assert laws is not None
    theta, ratio = (np.moveaxis(np.asarray(part), -2, -1) for part in (found.yoke_rotation, found.shaft_ratio))
    steps = ratio[..., 1:] / ratio[..., :-1]
    before, after, plane = axis[..., None, :-1, :], axis[..., None, 1:, :], normal[..., None, :, :]
    across, beyond = frames.cross(plane, before), frames.cross(plane, after)
    sine, cosine = np.sin(theta)[..., None], np.cos(theta)[..., None]
    driving = cosine * across + sine * plane
    steep, growth, joint_angle = (
        np.asarray(part)[..., None, :] for part in (laws.steepness, laws.growth, laws.joint_angle)
    )
    turned = np.arctan2(steep * np.sin(theta), np.cos(theta))[..., None]
    marked = np.cos(turned) * beyond + np.sin(turned) * plane
    driven = np.where(np.asarray(laws.own)[:, None], marked, frames.unit(frames.cross(after, driving)))
    aside, swept = lean(theta, steps, joint_angle, steep, growth)
    way = frames.unit(before + aside[..., None] * across - swept[..., None] * plane)
    return driving, driven, np.where(np.asarray(laws.own)[:, None], way, frames.cross(driving, driven))
