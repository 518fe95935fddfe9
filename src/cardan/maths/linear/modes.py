"""Natural modes of lines of beams: the lowest roots of symmetric eigenproblems, one at a time or many."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from cardan.maths.arrays import Array

from .rotor_beams import Line, beam_stiffness, layout, matrices


def lowest(stiffness: Array, inertia: Array, count: int) -> tuple[Array, Array]:
    """Return the lowest positive λ with (K - λN) x = 0, and their x.

    stiffness (..., f, f): K, positive definite.
    inertia (..., f, f): N, symmetric; it need not be positive, and each direction in which it is not has no λ.
    Returns roots (..., count): in rising order; nan where there are fewer; vectors (..., f, count): with x·N x = 1/λ;
    nan where there is none.
    The largest 1/λ of N x = (1/λ) K x, which is definite by K; only the wanted ones are found.
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


ALIKE = 1e-6
"""Share by which peaks of a shape may differ that counts as alike both ways: the first of them points up."""

NONE = 1e-14
"""Values of 1/λ below this share of the largest are what rounding leaves of none."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Modes:
    """Natural modes of one line or many (...)."""

    speed: Array  # (..., m) [rad/s]: ω of each mode in rising order; nan where there are fewer
    deflection: Array  # (..., m, e+1): at the nodes; the largest of each mode is 1
    slope: Array  # (..., m, s) [1/m]: in the order of `Line`


def synchronous(whole: Line, count: int, *, spinning: bool = True) -> Modes:
    """Return the lowest forward critical speeds of a line, by finite elements.

    whole: one line or many, held so that it cannot move without bending, divided as finely as wanted.
    spinning: whether it spins as fast as it whirls; else it stands still, and these are its natural frequencies.
    Returns Modes: fewer than asked for where lumps with more inertia about the line than across it take a mode away.
    Supports are alike all round, so a circular whirl stands still in the turning plane and is one symmetric problem,
    (K - Ω²(M - G)) x = 0; no sweep over the speed is needed.
    """
    found = matrices(whole)
    roots, vectors = lowest(found.stiffness, found.inertia - found.gyroscopic if spinning else found.inertia, count)
    at = layout(whole)
    full = np.zeros((*vectors.shape[:-2], count, len(at.deflection) + len(at.slope)))
    full[..., at.free] = np.swapaxes(vectors, -1, -2)
    deflection, slope = full[..., at.deflection], full[..., at.slope]
    size = np.max(np.abs(deflection), axis=-1, keepdims=True)
    first = np.argmax(np.abs(deflection) >= (1.0 - ALIKE) * size, axis=-1)[..., None]
    largest = np.copysign(size, np.take_along_axis(deflection, first, axis=-1))
    largest = np.where(largest == 0.0, 1.0, largest)
    return Modes(speed=np.sqrt(roots), deflection=deflection / largest, slope=slope / largest)


@dataclass(frozen=True, eq=False, kw_only=True)
class Strain:
    """Where the energy of modes sits while they are bent most; all parts of a mode add up to 1."""

    beams: Array  # (..., m, e)
    springs: Array  # (..., m, e+1): in the spring of each node
    tilt_springs: Array  # (..., m, s): in the spring of each slope


def strain(whole: Line, modes: Modes) -> Strain:
    """Return where the energy of modes sits.

    modes: as `synchronous` found them.

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
