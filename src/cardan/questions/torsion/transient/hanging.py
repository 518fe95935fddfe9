"""Does a motor hang on a resonance? Speed that stops rising while power is there: the Sommerfeld effect."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.maths.arrays import Array
from cardan.questions.torsion.model.torsional_model import TorsionalModel

from .simulation import Simulation

TURNS = 4.0
"""Turns of a window: speeds are means over them, whole periods of joints and engines."""

STANDING = 0.1
"""A drive that speeds up by less than this share of what it could hangs."""

MATTERS = 0.05
"""Share of its speed that a drive could have gained meanwhile, for its hanging to be told."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Hang:
    """A stretch of time in which the speed did not rise although torque was left over."""

    start: float  # [s]
    end: float  # [s]
    speed: float  # [rad/s]: mean speed of the first station meanwhile
    could: float  # [rad/s²]: mean acceleration that the torques would give the same drive if it did not swing
    did: float  # [rad/s²]
    power: float  # [W]: mean power that went into swinging


def hanging(model: TorsionalModel, found: Simulation) -> tuple[Hang, ...]:
    """Return where a drive that torques turn hung on a resonance.

    model: one drive, as it was simulated; found: with some samples in every turn.
    Returns: empty where it passed all resonances, and where its speed is forced.
    Near half a natural frequency the joints swing the drive, and its dampers take the power that would raise the
    speed: the torque that is left, M(Ω) - Σ b_g Ω over Σ J, is compared with the rise of the mean speed over turns.
    """
    if not model.free or np.ndim(found.status):
        return ()
    good = np.isfinite(found.coordinate[:, 0])
    times, angle = found.times[good], np.abs(found.coordinate[good, 0] - found.coordinate[0, 0])
    angle = np.maximum.accumulate(angle) if len(angle) else angle
    count = int(angle[-1] / (2.0 * np.pi * TURNS)) if len(angle) else 0
    if count < 3:
        return ()
    edges = np.interp(2.0 * np.pi * TURNS * np.arange(count + 1), angle, times)
    sense = np.sign(found.coordinate[good, 0][-1] - found.coordinate[0, 0])
    speed = 2.0 * np.pi * TURNS / np.diff(edges)
    middle = 0.5 * (edges[1:] + edges[:-1])
    did = np.diff(speed) / np.diff(middle)
    between = 0.5 * (middle[1:] + middle[:-1])
    mean = 0.5 * (speed[1:] + speed[:-1])
    inertia = float(np.sum(model.inertia))
    could = sense * _torque(model, between, sense * mean) / inertia
    stuck = (could > 0.0) & (did < STANDING * could)
    hangs = []
    for first, last in _stretches(stuck):
        part = slice(first, last)
        length = middle[last] - middle[first]
        gain = float(np.mean(could[part]))
        if gain * length > MATTERS * float(np.mean(mean[part])):
            rise = float(np.mean(did[part]))
            hangs.append(
                Hang(
                    start=float(middle[first]),
                    end=float(middle[last]),
                    speed=float(sense * np.mean(mean[part])),
                    could=gain,
                    did=rise,
                    power=(gain - rise) * inertia * float(np.mean(mean[part])),
                )
            )
    return tuple(hangs)


def _torque(model: TorsionalModel, time: Array, speed: Array) -> Array:
    """Return the sum of the torques on a drive that turns evenly, swinging ones left out."""
    total = -np.sum(model.ground_damping) * speed
    for torque in model.torques:
        if torque.law.order is None or torque.law.order == 0.0:
            total = total + torque.law.at(time, 0.0 * speed, speed)[0]
    return total


def _stretches(flags: Array) -> list[tuple[int, int]]:
    """Return first and last index of each run of true flags, the last one past its end."""
    edges = np.diff(np.concatenate(([0], flags.astype(int), [0])))
    return list(zip(np.flatnonzero(edges == 1).tolist(), np.flatnonzero(edges == -1).tolist(), strict=True))
