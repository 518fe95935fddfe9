"""Coordinates without inertia: what of them is in static balance, how firmly, and where."""

from __future__ import annotations

import math

import numpy as np

from cardan.maths.arrays import Array
from cardan.questions.torsion.model.torsional_balance import linearised
from cardan.questions.torsion.model.torsional_model import TorsionalModel

from .marching import Freedom

SNAP = 1e-10
"""A static stiffness below this share of the stiffest element's holds no joint."""

LOOSE = 1e-8
"""Share of its stiffness that an element keeps within its play where a station without inertia may hang loose in it."""


def still_part(
    model: TorsionalModel, freedom: Freedom, time: float, q: Array, rate: Array
) -> tuple[Array, Array, Array, Array]:
    """Return coordinates without inertia, their undamped directions, and balance and stiffness along these."""
    moment = np.asarray([time])
    angles, rates = freedom.whole(moment, q[None], rate[None])
    left, by = linearised(model, angles, rates, np.zeros_like(angles), moment)
    light = np.setdiff1d(freedom.free, freedom.heavy)
    damping = by.damping[0][np.ix_(light, light)]
    sizes, ways = np.linalg.eigh(0.5 * (damping + damping.T))
    still = ways[:, np.abs(sizes) <= 1e-12 * max(1e-300, float(np.max(np.abs(sizes), initial=0.0)))]
    stiffness = still.T @ by.stiffness[0][np.ix_(light, light)] @ still
    return light, still, still.T @ left[0, light], stiffness


def hold(model: TorsionalModel, freedom: Freedom, time: float, q: Array, rate: Array) -> float:
    """Return the least static stiffness of what has neither inertia nor damper [N·m/rad]."""
    stiffness = still_part(model, freedom, time, q, rate)[3]
    return float(np.min(np.linalg.eigvalsh(0.5 * (stiffness + stiffness.T)), initial=math.inf))


def settled(model: TorsionalModel, freedom: Freedom, q: Array, rate: Array, time: float) -> Array | None:
    """Return the angles with what has neither inertia nor damper in balance; None where torque snaps it through."""
    found, rank = q.copy(), freedom.free
    for _round in range(100):
        light, still, left, stiffness = still_part(model, freedom, time, found[rank], rate[rank])
        if not len(left):
            return found
        try:
            change = np.linalg.solve(stiffness, left)
        except np.linalg.LinAlgError:
            return None
        change *= min(1.0, 0.5 / max(float(np.max(np.abs(change))), 1e-300))
        found[light] -= still @ change
        if float(np.max(np.abs(change))) <= 1e-14 * max(1.0, float(np.max(np.abs(found)))):
            least = hold(model, freedom, time, found[rank], rate[rank])
            return found if least > SNAP * float(np.max(model.stiffness, initial=0.0)) else None
    return None
