"""Where the search for steady running begins: the twist that the mean torques leave in straight joints."""

from __future__ import annotations

import numpy as np

from cardan.maths.arrays import Array

from .torsional_batch import Turning

SAMPLES = 16
"""Angles over which torques are averaged."""


def at_rest(turning: Turning) -> Array:
    """Return the twist of every coordinate under mean torques, all joints straight, array (B, R, 1), complex.

    Notes
    -----
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
    stiffness = np.zeros((len(rows), drives.coordinates, drives.coordinates))
    ends = [(drives.coordinate[a], drives.coordinate[b]) for a, b in drives.elements]
    for e, (a, b) in enumerate(ends):
        spring = drives.stiffness[:, e]
        for r, s, sign in ((a, a, 1.0), (b, b, 1.0), (a, b, -1.0), (b, a, -1.0)):
            stiffness[:, r, s] += sign * spring
        if drives.rest is not None:
            load[:, a] += spring * drives.rest[:, e]
            load[:, b] -= spring * drives.rest[:, e]
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
