"""Where the search for steady running begins: the twist that the mean torques leave in straight joints."""

from __future__ import annotations

import numpy as np

from cardan.maths.arrays import Array
from cardan.questions.torsion.model.torsional_batch import Turning
from cardan.questions.torsion.model.torsional_model import TorsionalModel

SAMPLES = 16
"""Angles over which torques are averaged."""


def straight_stiffness(drives: TorsionalModel) -> Array:
    """Return the stiffness of drives between their coordinates, all joints straight, array (b, R, R) [N·m/rad]."""
    found = np.zeros((len(drives.stiffness), drives.coordinates, drives.coordinates))
    for e, (first, last) in enumerate(drives.elements):
        a, b = drives.coordinate[first], drives.coordinate[last]
        for r, s, sign in ((a, a, 1.0), (b, b, 1.0), (a, b, -1.0), (b, a, -1.0)):
            found[:, r, s] += sign * drives.stiffness[:, e]
    return found


def straight_frequencies(drives: TorsionalModel) -> Array:
    """Return the natural frequencies of drives, all joints straight and all backlash closed, array (b, m) [rad/s].

    drives (b,).
    Returns: rising; of a free drive the first is 0, its turning as a whole.
    """
    mass = np.zeros((len(drives.inertia), drives.coordinates))
    for k, r in enumerate(drives.coordinate):
        mass[:, r] += drives.inertia[:, k]
    first = 0 if drives.free else 1
    mass, stiffness = mass[:, first:], straight_stiffness(drives)[:, first:, first:]
    heavy = np.any(mass > 0.0, axis=0)
    inner = stiffness[:, heavy][:, :, heavy]
    if not heavy.all():
        across = stiffness[:, heavy][:, :, ~heavy]
        inner = inner - across @ np.linalg.solve(stiffness[:, ~heavy][:, :, ~heavy], across.swapaxes(-1, -2))
    root = np.sqrt(mass[:, heavy])
    values = np.linalg.eigvalsh(inner / (root[:, :, None] * root[:, None, :]))
    found: Array = np.sqrt(np.maximum(values, 0.0))
    if drives.free and found.shape[-1]:
        found[:, 0] = 0.0
    return found


def at_rest(turning: Turning) -> Array:
    """Return the twist of every coordinate under mean torques, all joints straight, array (B, R, 1), complex.

    Each element with backlash lies on the side that its torque pushes it to; one without torque lies amid it.
    """
    rows = np.arange(len(turning.speed))
    drives = turning.drives(rows)
    speed = turning.speed[:, None]
    angle = turning.period * np.arange(SAMPLES) / SAMPLES + 0.0 * speed
    load = np.zeros((len(rows), drives.coordinates))
    for torque in drives.torques:
        value = np.mean(torque.law.at(0.0, angle, speed + 0.0 * angle)[0], axis=-1)
        load[:, drives.coordinate[torque.station]] += value
    for k, r in enumerate(drives.coordinate):
        load[:, r] -= drives.ground_damping[:, k] * turning.speed
    ends = [(drives.coordinate[a], drives.coordinate[b]) for a, b in drives.elements]
    if drives.rest is not None:
        for e, (a, b) in enumerate(ends):
            load[:, a] += drives.stiffness[:, e] * drives.rest[:, e]
            load[:, b] -= drives.stiffness[:, e] * drives.rest[:, e]
    stiffness = straight_stiffness(drives)
    inner = stiffness[:, 1:, 1:]
    found = np.zeros((len(rows), drives.coordinates))
    if inner.shape[-1]:
        found[:, 1:] = np.linalg.solve(inner, load[:, 1:, None])[..., 0]
        if np.any(drives.backlash > 0.0):
            rest = np.zeros_like(drives.backlash) if drives.rest is None else drives.rest
            for e, (a, b) in enumerate(ends):
                push = (
                    0.5
                    * drives.backlash[:, e]
                    * np.sign(found[:, a] - found[:, b] - rest[:, e])
                    * drives.stiffness[:, e]
                )
                load[:, a] += push
                load[:, b] -= push
            found[:, 1:] = np.linalg.solve(inner, load[:, 1:, None])[..., 0]
    return found[:, turning.first :, None].astype(complex)
