"""Finite elements of lines of beams: stiffness, inertia and gyroscopic action."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from cardan.maths.arrays import Array

from .rotor_beams import Line, layout


def assembled(whole: Line, elements: Array, nodes: Array, slopes: Array) -> Array:
    """Return the matrix of a line from those of its beams and what stands at its nodes and slopes.

    whole: how the beams are joined and held.
    elements (..., e, 4, 4): of each beam, for deflection and slope at its start and end.
    nodes (..., e+1): entries for the deflections; slopes (..., s): entries for the slopes.
    Returns (..., f, f): for the unknowns that nothing holds.
    """
    at = layout(whole)
    size = len(at.deflection) + len(at.slope)
    outer = np.broadcast_shapes(elements.shape[:-3], nodes.shape[:-1], slopes.shape[:-1])
    full = np.zeros((*outer, size, size))
    # Neighbours share entries, beams two apart do not: each half of them can be added at once.
    for half in (slice(0, None, 2), slice(1, None, 2)):
        rows = at.element[half]
        full[..., rows[:, :, None], rows[:, None, :]] += elements[..., half, :, :]
    full[..., at.deflection, at.deflection] += nodes
    full[..., at.slope, at.slope] += slopes
    return full[..., at.free[:, None], at.free]


class Matrices(NamedTuple):
    """Of one line or many (..., f, f)."""

    stiffness: Array
    """K."""
    inertia: Array
    """M: translation and rotation."""
    gyroscopic: Array
    """G, whose product with the speeds of spin and whirl adds to the stiffness in forward whirl."""


def matrices(whole: Line) -> Matrices:
    """Return the finite-element matrices of a line.

    whole: one line or many, divided as finely as wanted.
    Returns Matrices: for the unknowns that nothing holds, in the order of `layout`. A forward whirl with ω at the spin
    Ω has (K + ωΩ G - ω² M) x = 0; where both are the same, (K - Ω²(M - G)) x = 0.
    Timoshenko's beam with the exact static shape, so that thin beams do not lock; consistent inertia. E. P. Friedman
    and J. B. Kosmatka, Computers & Structures 47 (1993); H. D. Nelson, J. Mech. Design 102 (1980).
    """
    h, phi, size = _shape(whole)
    soft = 1.0 / (1.0 + phi)
    moved = (whole.mass[..., None, None] * h) * soft**2 * size * (_M0 + phi * (_M1 + phi * _M2))
    turned = whole.rotary[..., None, None] / h * soft**2 * size * (_R0 + phi * (_R1 + phi * _R2))
    none = np.zeros(whole.beams + 1)
    return Matrices(
        stiffness=assembled(whole, beam_stiffness(whole), whole.spring, whole.tilt_spring),
        inertia=assembled(whole, moved + turned, whole.lump, whole.diametral),
        gyroscopic=assembled(whole, 2.0 * turned, none, whole.polar),
    )


def beam_stiffness(whole: Line) -> Array:
    """Return the stiffness of each beam for deflection and slope at its start and end, array (..., e, 4, 4)."""
    h, phi, size = _shape(whole)
    return whole.bending[..., None, None] / (h**3 * (1.0 + phi)) * size * (_K0 + phi * _K1)


def _shape(whole: Line) -> tuple[Array, Array, Array]:
    """Return of each beam its length, its softness in shear, and the products of lengths its unknowns stand with."""
    h = whole.length[..., None, None]
    phi = 12.0 * (whole.bending * whole.shear)[..., None, None] / h**2
    one = np.ones_like(h)
    size = np.concatenate((one, h, one, h), axis=-1)
    return h, phi, size * np.swapaxes(size, -1, -2)


def _table(*rows: tuple[float, ...], over: float = 1.0) -> Array:
    """Return a symmetric 4 × 4 matrix from its upper rows."""
    found = np.zeros((4, 4))
    for k, row in enumerate(rows):
        found[k, k:] = found[k:, k] = row
    return found / over


_K0 = _table((12, 6, -12, 6), (4, -6, 2), (12, -6), (4,))
_K1 = _table((0, 0, 0, 0), (1, 0, -1), (0, 0), (1,))
_M0 = _table((312, 44, 108, -26), (8, 26, -6), (312, -44), (8,), over=840)
_M1 = _table((588, 77, 252, -63), (14, 63, -14), (588, -77), (14,), over=840)
_M2 = _table((280, 35, 140, -35), (7, 35, -7), (280, -35), (7,), over=840)
_R0 = _table((36, 3, -36, 3), (4, -3, -1), (36, -3), (4,), over=30)
_R1 = _table((0, -15, 0, -15), (5, 15, -5), (0, 15), (5,), over=30)
_R2 = _table((0, 0, 0, 0), (10, 0, 5), (0, 0), (10,), over=30)
