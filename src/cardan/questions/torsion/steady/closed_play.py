"""Drives whose play stays closed: until a torque changes its sign they run as if they had none."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from cardan.maths.arrays import Array
from cardan.maths.curves.waves import series_at
from cardan.questions.torsion.model.torsional_balance import places
from cardan.questions.torsion.model.torsional_batch import Turning
from cardan.questions.torsion.model.torsional_model import TorsionalModel

from .steady_start import at_rest

FINE = 512
"""Places of a period at which contact is looked at."""


def closed(turning: Turning) -> Turning:
    """Return drives without play that rest on the side to which their mean torques push them.

    turning: drives in one axis, as `Turning.part` gives them.
    """
    model, rest = turning.model, _rest(turning.model)
    shifted = replace(model, backlash=np.zeros_like(model.backlash), rest=rest + 0.5 * _sides(turning) * model.backlash)
    return Turning(shifted, turning.angle_error, turning.speed, turning.period)


def stays_closed(turning: Turning, coefficient: Array) -> Array:
    """Tell which motions keep all play on the side to which mean torques push it, array of bool (b,).

    turning: drives in one axis, with their play.
    coefficient (b, R, H+1), complex: motions of the free coordinates, as those of `closed` drives; nan where there is
    none.
    """
    if not np.any(turning.model.backlash > 0.0):
        return np.ones(len(turning.speed), dtype=bool)
    phase = 2.0 * np.pi * np.arange(FINE) / FINE
    twist = _twists(turning, phase, series_at(coefficient, phase)[0])
    sides, half = _sides(turning)[:, None], 0.5 * turning.model.backlash[:, None]
    found: Array = np.all((half == 0.0) | (sides * twist > half), axis=(1, 2))
    return found


def _rest(model: TorsionalModel) -> Array:
    return np.zeros_like(model.backlash) if model.rest is None else model.rest


def _twists(turning: Turning, phase: Array, x: Array) -> Array:
    """Return the twists of the elements off their rest, array (b, p, E)."""
    drives = turning.drives(np.arange(len(turning.speed)))
    angle = places(drives, turning.motion(np.arange(len(turning.speed)), phase, x, x, x)[0]).angle
    heads, tails = [a for a, _b in drives.elements], [b for _a, b in drives.elements]
    return angle[..., heads] - angle[..., tails] - _rest(drives)[:, None]


def _sides(turning: Turning) -> Array:
    """Return the side to which mean torques push each element, 0 where nothing does: array of int (b, E)."""
    model, rested = turning.model, at_rest(turning)[..., 0].real
    q = np.pad(rested, ((0, 0), (turning.first, 0)))
    ends = [(model.coordinate[a], model.coordinate[b]) for a, b in model.elements]
    twist = q[:, [a for a, _b in ends]] - q[:, [b for _a, b in ends]] - _rest(model)
    return np.where(np.abs(twist) > 0.5 * model.backlash, np.sign(twist), 0.0).astype(int)
