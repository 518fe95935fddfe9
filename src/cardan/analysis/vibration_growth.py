"""How fast does vibration of running drives grow? For searches: many motions at once, drift of the mean speed aside."""

from __future__ import annotations

import numpy as np

from cardan.maths.arrays import Array
from cardan.maths.floquet import monodromy

from .orbit import Orbit
from .stability_kernel import fits, harmonics_for, mapped
from .steady_start import straight_frequencies
from .torsional_balance import slopes
from .torsional_batch import Turning, chosen
from .torsional_model import TorsionalModel

SURE = 2e-5
"""Largest last Newton step, over the motion, of a motion that the kernel is trusted with."""

WORTH = 3000.0
"""Oscillations of the fastest mode in all motions together, in radians, from which the kernel is worth loading."""

RIGID = 0.7
"""Share of turning as a whole in a disturbance from which it is one of the mean speed, not of vibration."""

CHUNK = 64
"""Motions whose periods are integrated at once as array expressions."""


def vibration_growth(orbit: Orbit, rows: Array) -> Array:
    """Return by how much disturbances of motions grow in a period, ln max|ρ|: array (b,).

    Parameters
    ----------
    orbit : Orbit (...)
        As `cardan.analysis.torque_swing.torque_swings` gives it.
    rows : array of int (b,)
        Which motions, counted through the leading axes.

    Returns
    -------
    array (b,)
        Negative where every disturbance dies out; nan where there is no motion.

    Notes
    -----
    As `cardan.analysis.stability.floquet`, but for one thing: where torques turn a drive freely, what drifts to another
    mean speed, as behind a weak motor above a resonance, is no vibration and left out. Such disturbances turn the drive
    as a whole: |Σ M x| > 0.7 √(Σ M Σ M |x|²). Compiled where it is worth it.

    Examples
    --------
    >>> from .torque_swing import torque_swings
    >>> from .torsional_model import torsional_line
    >>> drive = torsional_line([[1.0, 0.01], [0.4]], stiffness=[[1000.0], []], damping=[[0.2], []],
    ...     bend=[np.radians(25)], input_speed=49.386)
    >>> print(np.exp(vibration_growth(torque_swings(drive, [49.386]).orbit, np.asarray([0]))))
    [1.14415]
    """
    found = np.full(len(rows), np.nan)
    there = np.isfinite(orbit.coefficient.reshape(orbit.count, -1)[rows]).all(axis=-1)
    smooth = np.flatnonzero(there & ~np.isin(rows, list(orbit.pieces)))
    for k in np.flatnonzero(there & np.isin(rows, list(orbit.pieces))):
        pieces = orbit.pieces[int(rows[k])]
        found[k] = _largest(orbit.drives(rows[k : k + 1]), pieces.monodromy[None])[0]
    if smooth.size:
        found[smooth] = _smooth(orbit, rows[smooth])
    return found


def _smooth(orbit: Orbit, rows: Array) -> Array:
    speed = orbit.speed.reshape(-1)[rows]
    part = Turning(chosen(orbit.model, orbit.lead, rows, moments=False), (len(rows),), speed, orbit.period)
    found = np.full(len(rows), np.nan)
    fastest = straight_frequencies(part.drives(np.arange(len(rows))))[:, -1]
    if np.sum(fastest * orbit.period / np.abs(speed)) >= WORTH and fits(part.model, speed):
        said = mapped(part, harmonics_for(part.model, orbit.period))
        sure = np.flatnonzero((said.moved <= SURE) & np.isfinite(said.matrix).all(axis=(1, 2)))
        if sure.size:
            found[sure] = _largest(part.drives(sure), said.matrix[sure])
    left = np.flatnonzero(np.isnan(found))
    for first in range(0, len(left), CHUNK):
        some = left[first : first + CHUNK]
        found[some] = _largest(orbit.drives(rows[some]), _matrix(orbit, rows[some]))
    return found


def _matrix(orbit: Orbit, rows: Array) -> Array:
    """Return the monodromy matrices of motions, array (b, m, m)."""
    drives, omega = orbit.drives(rows), orbit.speed.reshape(-1)[rows]
    first, backward = 0 if drives.free else 1, (omega < 0.0)[:, None, None]

    def coefficients(share: Array) -> tuple[Array, Array, Array]:
        ahead = orbit.of(rows, share * orbit.period)
        if np.any(backward):
            back = orbit.of(rows, -share * orbit.period)
            ahead = tuple(np.where(backward, b, a) for a, b in zip(ahead, back, strict=True))
        at = slopes(drives, *ahead)
        return at.mass[..., first:], at.damping[..., first:, first:], at.stiffness[..., first:, first:]

    return monodromy(coefficients, orbit.period / np.abs(omega))


def _largest(drives: TorsionalModel, matrix: Array) -> Array:
    """Return ln of the largest modulus of the multipliers of drives, array (b,)."""
    if not drives.free:
        return _log(np.max(np.abs(np.linalg.eigvals(matrix)), axis=-1))
    values, vectors = np.linalg.eig(matrix)
    place = vectors[:, : drives.coordinates]
    mass = np.zeros((len(matrix), drives.coordinates))
    for k, r in enumerate(drives.coordinate):
        mass[:, r] += drives.inertia[:, k]
    whole = np.abs(np.einsum("br,brk->bk", mass, place))
    size = np.sqrt(np.sum(mass, axis=-1)[:, None] * np.einsum("br,brk->bk", mass, np.abs(place) ** 2))
    return _log(np.max(np.where(whole > RIGID * size, 0.0, np.abs(values)), axis=-1))


def _log(radius: Array) -> Array:
    with np.errstate(divide="ignore"):
        found: Array = np.log(radius)
    return found
