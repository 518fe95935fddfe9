"""A chain with rubbing journals as plain vectors: couples of crosses, torques and rates at one input angle.

No angle, no phase and no integral of the package: arms of the crosses from `vector_model`, the couple a cross can
carry, and the friction moments of its two pairs of journals against their sliding.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from tests.builders.vector_model import VectorModel, cross, dot


@dataclass(frozen=True)
class Torques:
    """Torque of every shaft (n+1 of them, or of both sides of every joint) and power rubbed away, at input angles."""

    shaft: list[Any]
    speed: list[Any]
    lost_driving: list[Any]
    lost_driven: list[Any]


def torques(model: VectorModel, angle: Any, drag: Any, load: float = 1.0, speed: float = 1.0, at: str = "output"):
    """Carry a torque from one end to the other; positive resists positive turning."""
    driving, driven = model.arms(angle)
    ratio = model.ratios(angle)
    omega = [speed * r for r in ratio]
    joints = len(driving)
    shaft: list[Any] = [None] * (joints + 1)
    shaft[-1 if at == "output" else 0] = load + 0.0 * np.asarray(angle)
    lost_driving, lost_driven = [None] * joints, [None] * joints
    for i in range(joints - 1, -1, -1) if at == "output" else range(joints):
        u, v, before, after = driving[i], driven[i], model.axes[i], model.axes[i + 1]
        n = cross(u, v)
        p = omega[i + 1] * dot(after, u)  # of the cross in the driving yoke, about u
        q = omega[i] * dot(before, v)  # of the driven yoke in the cross, about v

        def along(axis, sign, u=u, v=v, n=n, p=p, q=q, k=drag[i]):
            """Return the torque about an axis for a couple of unit size and a sign."""
            return sign * dot(n, axis) - k * np.sign(p) * dot(u, axis) + k * np.sign(q) * dot(v, axis)

        known, axis = (shaft[i + 1], after) if at == "output" else (shaft[i], before)
        sign = np.sign(known)  # without locking the couple has the sign of the torque it carries
        size = known / along(axis, sign)
        assert np.all(size > 0.0)
        shaft[i if at == "output" else i + 1] = size * along(before if at == "output" else after, sign)
        lost_driving[i], lost_driven[i] = drag[i] * size * np.abs(p), drag[i] * size * np.abs(q)
    return Torques(shaft=shaft, speed=omega, lost_driving=lost_driving, lost_driven=lost_driven)


def over_a_turn(count: int = 20_000) -> np.ndarray:
    """Return angles whose plain mean misses that of a function with kinks by some 1e-9 of its kinks."""
    return (np.arange(count) + 0.5) * (2 * np.pi / count)
