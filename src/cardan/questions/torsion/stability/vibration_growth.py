"""How fast does vibration of running drives grow? For searches: many motions at once, drift of the mean speed aside."""

from __future__ import annotations

import numpy as np

from cardan.maths.arrays import Array
from cardan.maths.periodic.floquet import monodromy
from cardan.questions.torsion.model.torsional_batch import Turning, chosen
from cardan.questions.torsion.steady.multipliers import CHUNK, linear_motion, vibrating
from cardan.questions.torsion.steady.orbit import Orbit
from cardan.questions.torsion.steady.steady_start import straight_frequencies

from .stability_kernel import SURE, fits, harmonics_for, mapped

WORTH = 3000.0
"""Oscillations of the fastest mode in all motions together, in radians, from which the kernel is worth loading."""


def vibration_growth(orbit: Orbit, rows: Array) -> Array:
    """Return by how much disturbances of motions grow in a period, ln max|ρ|: array (b,).

    orbit (...): as `cardan.questions.torsion.steady.torque_swing.torque_swings` gives it.
    rows (b,) of int: which motions, counted through the leading axes.
    Returns: negative where every disturbance dies out; nan where there is no motion.
    As `run_stability.floquet`, but that the drift of free drives to another mean speed is always left out,
    also where a motor or load governs it, as a weak motor fails to above a resonance: that is no vibration, and the
    speeds of a search are given. Compiled where it is worth it.
    """
    found = np.full(len(rows), np.nan)
    there = np.isfinite(orbit.coefficient.reshape(orbit.count, -1)[rows]).all(axis=-1)
    smooth = np.flatnonzero(there & ~np.isin(rows, list(orbit.pieces)))
    for k in np.flatnonzero(there & np.isin(rows, list(orbit.pieces))):
        pieces = orbit.pieces[int(rows[k])]
        found[k] = _largest(pieces.monodromy[None], free=orbit.model.free)[0]
    if smooth.size:
        found[smooth] = _smooth(orbit, rows[smooth])
    return found


def _smooth(orbit: Orbit, rows: Array) -> Array:
    speed = orbit.speed.reshape(-1)[rows]
    part = Turning(chosen(orbit.model, orbit.angle_error, rows, moments=False), (len(rows),), speed, orbit.period)
    found = np.full(len(rows), np.nan)
    fastest = straight_frequencies(part.drives(np.arange(len(rows))))[:, -1]
    if np.sum(fastest * orbit.period / np.abs(speed)) >= WORTH and fits(part.model, speed):
        said = mapped(part, harmonics_for(part.model, orbit.period))
        sure = np.flatnonzero((said.moved <= SURE) & np.isfinite(said.matrix).all(axis=(1, 2)))
        if sure.size:
            found[sure] = _largest(said.matrix[sure], free=orbit.model.free)
    left = np.flatnonzero(np.isnan(found))
    for first in range(0, len(left), CHUNK):
        some = left[first : first + CHUNK]
        matrix = monodromy(linear_motion(orbit, rows[some]), orbit.time.reshape(-1)[rows[some]])
        found[some] = _largest(matrix, free=orbit.model.free)
    return found


def _largest(matrix: Array, *, free: bool) -> Array:
    """Return ln of the largest modulus of the multipliers of drives, array (b,)."""
    values = np.linalg.eigvals(matrix)
    values = vibrating(values, 2) if free else values
    with np.errstate(divide="ignore"):
        found: Array = np.log(np.max(np.abs(values), axis=-1, initial=0.0))
    return found
