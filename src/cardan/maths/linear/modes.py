"""Natural modes of lines of beams: the lowest roots of symmetric eigenproblems, one at a time or many."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from cardan.maths.arrays import Array

from .beam_elements import beam_stiffness, matrices
from .rotor_beams import Line, layout


def lowest(stiffness: Array, inertia: Array, count: int) -> tuple[Array, Array]:
    """Return the lowest positive λ with (K - λN) x = 0, and their x.

    Parameters
    ----------
    stiffness : array (..., f, f)
        K, positive definite.
    inertia : array (..., f, f)
        N, symmetric; it need not be positive, and each direction in which it is not has no λ.
    count : int
        How many are wanted.

    Returns
    -------
    roots : array (..., count)
        In rising order; nan where there are fewer.
    vectors : array (..., f, count)
        With x·N x = 1/λ; nan where there is none.

    Notes
    -----
    The largest 1/λ of N x = (1/λ) K x, which is definite by K; only the wanted ones are found.

    Examples
    --------
    >>> lowest(np.eye(2), np.diag([0.25, -1.0]), 2)[0]
    array([ 4., nan])
    """
    size = stiffness.shape[-1]
    wanted = min(count, size)
    outer = np.broadcast_shapes(stiffness.shape[:-2], inertia.shape[:-2])
    roots, vectors = np.full((*outer, count), np.nan), np.full((*outer, size, count), np.nan)
    if not wanted:
        return roots, vectors
    one, other = (np.broadcast_to(part, (*outer, size, size)) for part in (stiffness, inertia))
    for at in np.ndindex(outer):
        inverse, shape = scipy.linalg.eigh(
            other[at], one[at], subset_by_index=[size - wanted, size - 1], check_finite=False
        )
        inverse, shape = inverse[::-1], shape[:, ::-1]
        there = inverse > NONE * abs(inverse[0])
        roots[(*at, slice(0, wanted))] = np.where(there, 1.0 / np.where(there, inverse, 1.0), np.nan)
        vectors[(*at, slice(None), slice(0, wanted))] = np.where(there, shape, np.nan)
    return roots, vectors


NONE = 1e-14
"""Values of 1/λ below this share of the largest are what rounding leaves of none."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Modes:
    """Natural modes of one line or many (...).

    Attributes
    ----------
    speed : array (..., m) [rad/s]
        ω of each mode in rising order; nan where there are fewer.
    deflection : array (..., m, e+1)
        At the nodes; the largest of each mode is 1.
    slope : array (..., m, s) [1/m]
        In the order of `Line`.
    """

    speed: Array
    deflection: Array
    slope: Array


def synchronous(whole: Line, count: int, *, spinning: bool = True) -> Modes:
    """Return the lowest forward critical speeds of a line, by finite elements.

    Parameters
    ----------
    whole : Line
        One line or many, held so that it cannot move without bending, divided as finely as wanted.
    count : int
        How many modes.
    spinning : bool
        Whether it spins as fast as it whirls; else it stands still, and these are its natural frequencies.

    Returns
    -------
    Modes
        Fewer than asked for where lumps with more inertia about the line than across it take a mode away.

    Notes
    -----
    Supports are alike all round, so a circular whirl stands still in the turning plane and is one symmetric problem,
    (K - Ω²(M - G)) x = 0; no sweep over the speed is needed.

    Examples
    --------
    >>> from cardan.maths.linear.rotor_beams import divided, line
    >>> beam = divided(line(1.0, 1.0, 1.0, held=(0, 1)), [8])
    >>> (synchronous(beam, 2).speed / np.pi**2).round(2)
    array([1., 4.])
    """
    found = matrices(whole)
    roots, vectors = lowest(found.stiffness, found.inertia - found.gyroscopic if spinning else found.inertia, count)
    at = layout(whole)
    full = np.zeros((*vectors.shape[:-2], count, len(at.deflection) + len(at.slope)))
    full[..., at.free] = np.swapaxes(vectors, -1, -2)
    deflection, slope = full[..., at.deflection], full[..., at.slope]
    place = np.argmax(np.abs(deflection), axis=-1)[..., None]
    largest = np.take_along_axis(deflection, place, axis=-1)
    largest = np.where(largest == 0.0, 1.0, largest)
    return Modes(speed=np.sqrt(roots), deflection=deflection / largest, slope=slope / largest)


@dataclass(frozen=True, eq=False, kw_only=True)
class Strain:
    """Where the energy of modes sits while they are bent most; all parts of a mode add up to 1.

    Attributes
    ----------
    beams : array (..., m, e)
        In each beam.
    springs : array (..., m, e+1)
        In the spring of each node.
    tilt_springs : array (..., m, s)
        In the spring of each slope.
    """

    beams: Array
    springs: Array
    tilt_springs: Array


def strain(whole: Line, modes: Modes) -> Strain:
    """Return where the energy of modes sits.

    Parameters
    ----------
    whole : Line
        The line of the modes.
    modes : Modes
        As `synchronous` found them.

    Returns
    -------
    Strain

    Examples
    --------
    >>> from cardan.maths.linear.rotor_beams import divided, line
    >>> beam = divided(line(1.0, 1e6, 1.0, spring=[3.0, 1.0]), [8])
    >>> print(strain(beam, synchronous(beam, 1)).springs.sum().round(3))
    1.0
    """
    at = layout(whole)
    full = np.empty((*modes.deflection.shape[:-1], len(at.deflection) + len(at.slope)))
    full[..., at.deflection], full[..., at.slope] = modes.deflection, modes.slope
    ends = full[..., at.element]
    beams = np.einsum("...mei,...eij,...mej->...me", ends, beam_stiffness(whole), ends)
    springs = whole.spring[..., None, :] * modes.deflection**2
    tilts = whole.tilt_spring[..., None, :] * modes.slope**2
    total = (np.sum(beams, axis=-1) + np.sum(springs, axis=-1) + np.sum(tilts, axis=-1))[..., None]
    return Strain(beams=beams / total, springs=springs / total, tilt_springs=tilts / total)
