"""Beams end to end that spin about their own line: how they are joined and held, and how they move without bending."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from typing import NamedTuple

import numpy as np

from cardan.maths.arrays import Array, ArrayLike


@dataclass(frozen=True, eq=False, kw_only=True)
class Line:
    """Straight beams end to end, of one line or of many (...) that are joined and held alike.

    Beam k runs from node k to node k+1. The slope is the same on both sides of a node unless it is hinged; so slopes
    are counted along the line, two of them at a hinge: the one that ends before it, then the one that begins there.
    """

    length: Array  # (..., e) [m]: of each beam
    bending: Array  # (..., e) [N m²]: EI
    shear: Array  # (..., e) [1/N]: 1/(κGA); zero where shear does not count
    mass: Array  # (..., e) [kg/m]: ρA
    rotary: Array  # (..., e) [kg m]: ρI; zero where rotary inertia and gyroscopic action of the beams do not count
    spring: Array  # (..., e+1) [N/m]: stiffness that holds each node sideways
    lump: Array  # (..., e+1) [kg]: mass at each node
    tilt_spring: Array  # (..., s) [N m/rad]: stiffness that holds each slope
    diametral: Array  # diametral, polar (..., s) [kg m²]: moments of inertia at each slope, across and about the line
    polar: Array  # (..., s) [kg m²]
    # nodes at which the slope jumps and no moment passes, in rising order, none of them an end
    hinged: tuple[int, ...] = ()
    held: tuple[int, ...] = ()  # nodes that do not move sideways
    clamped: tuple[int, ...] = ()  # slopes that stay zero

    @property
    def beams(self) -> int:
        """Number of beams e."""
        return int(self.length.shape[-1])

    @property
    def place(self) -> Array:
        """Where the nodes are, array (..., e+1) [m]."""
        start = np.zeros((*self.length.shape[:-1], 1))
        return np.concatenate((start, np.cumsum(self.length, axis=-1)), axis=-1)

    def slope_before(self, node: int) -> int:
        """Return the number of the slope that ends at a node."""
        return node + sum(hinge < node for hinge in self.hinged)

    def slope_after(self, node: int) -> int:
        """Return the number of the slope that begins at a node."""
        return node + sum(hinge <= node for hinge in self.hinged)


def line(
    length: ArrayLike,
    bending: ArrayLike,
    mass: ArrayLike,
    *,
    shear: ArrayLike = 0.0,
    rotary: ArrayLike = 0.0,
    spring: ArrayLike = 0.0,
    lump: ArrayLike = 0.0,
    tilt_spring: ArrayLike = 0.0,
    diametral: ArrayLike = 0.0,
    polar: ArrayLike = 0.0,
    hinged: tuple[int, ...] = (),
    held: tuple[int, ...] = (),
    clamped: tuple[int, ...] = (),
) -> Line:
    """Return beams end to end; what is one number holds for all of them. See `Line` for every argument.

    length, bending, mass, shear, rotary (..., e): of each beam [m, N m², kg/m, 1/N, kg m].
    spring, lump (..., e+1): at each node [N/m, kg].
    tilt_spring, diametral, polar (..., s): at each slope [N m/rad, kg m², kg m²].
    hinged, held, clamped: nodes with a hinge, nodes held, slopes held.
    """
    size = np.atleast_1d(np.asarray(length, dtype=float))
    beams = size.shape[-1]
    slopes = beams + 1 + len(hinged)

    def wide(value: ArrayLike, count: int) -> Array:
        given = np.asarray(value, dtype=float)
        return np.broadcast_to(given, (*given.shape[:-1], count))

    return Line(
        length=size,
        bending=wide(bending, beams),
        shear=wide(shear, beams),
        mass=wide(mass, beams),
        rotary=wide(rotary, beams),
        spring=wide(spring, beams + 1),
        lump=wide(lump, beams + 1),
        tilt_spring=wide(tilt_spring, slopes),
        diametral=wide(diametral, slopes),
        polar=wide(polar, slopes),
        hinged=tuple(sorted(hinged)),
        held=tuple(sorted(held)),
        clamped=tuple(sorted(clamped)),
    )


class Section(NamedTuple):
    """What a cross section makes of a beam, arrays (...)."""

    bending: Array
    """EI [N m²]."""
    shear: Array
    """1/(κGA) [1/N]; zero without shear."""
    mass: Array
    """ρA [kg/m]."""
    rotary: Array
    """ρI [kg m]; zero without rotary inertia."""


def round_section(
    outer: ArrayLike,
    inner: ArrayLike,
    youngs: ArrayLike,
    density: ArrayLike,
    *,
    poisson: ArrayLike | None = None,
    shear_modulus: ArrayLike | None = None,
) -> Section:
    """Return stiffness and inertia of round hollow beams.

    Parameters
    ----------
    outer, inner : arrays (...) [m]
        Diameters.
    youngs : array (...) [Pa]
        Young's modulus E.
    density : array (...) [kg/m³]
        ρ.
    poisson : array (...), optional
        ν; without it the beam is Euler's and Bernoulli's, with neither shear nor rotary inertia.
    shear_modulus : array (...) [Pa], optional
        G; E/(2(1+ν)) when not given.

    Notes
    -----
    Timoshenko's beam with the coefficient of G. R. Cowper, J. Appl. Mech. 33 (1966):
    κ = 6(1+ν)(1+m²)²/((7+6ν)(1+m²)² + (20+12ν)m²), m the ratio of the diameters.

    Examples
    --------
    >>> round_section(0.076, 0.072, 2.1e11, 7850.0).mass.round(4)
    np.float64(3.6499)
    """
    d, b, e = (np.asarray(value, dtype=float) for value in (outer, inner, youngs))
    area = 0.25 * np.pi * (d**2 - b**2)
    second = np.pi * (d**4 - b**4) / 64.0
    mass = density * area
    if poisson is None:
        return Section(e * second, 0.0 * mass, mass, 0.0 * mass)
    nu = np.asarray(poisson, dtype=float)
    g = 0.5 * e / (1.0 + nu) if shear_modulus is None else np.asarray(shear_modulus, dtype=float)
    ratio = (b / d) ** 2
    square = (1.0 + ratio) ** 2
    kappa = 6.0 * (1.0 + nu) * square / ((7.0 + 6.0 * nu) * square + (20.0 + 12.0 * nu) * ratio)
    return Section(e * second, 1.0 / (kappa * g * area), mass, density * second)


def divided(whole: Line, parts: ArrayLike) -> Line:
    """Return the same line with each beam cut into equal parts. parts (e,) of int: into how many."""
    count = np.asarray(parts, dtype=int)
    node = np.concatenate(([0], np.cumsum(count)))
    total, hinges = int(node[-1]), len(whole.hinged)
    # Slopes keep their order; those between old nodes are new ones.
    slope = np.sort([int(node[k]) + sum(h < k for h in whole.hinged) for k in range(len(node))])
    after = [int(node[h]) + sum(one <= h for one in whole.hinged) for h in whole.hinged]
    slope = np.sort(np.concatenate((slope, np.asarray(after, dtype=int))))

    def spread(values: Array, where: Array, size: int) -> Array:
        found = np.zeros((*values.shape[:-1], size))
        found[..., where] = values
        return found

    def cut(values: Array) -> Array:
        return np.repeat(values, count, axis=-1)

    return replace(
        whole,
        length=cut(whole.length / count),
        bending=cut(whole.bending),
        shear=cut(whole.shear),
        mass=cut(whole.mass),
        rotary=cut(whole.rotary),
        spring=spread(whole.spring, node, total + 1),
        lump=spread(whole.lump, node, total + 1),
        tilt_spring=spread(whole.tilt_spring, slope, total + 1 + hinges),
        diametral=spread(whole.diametral, slope, total + 1 + hinges),
        polar=spread(whole.polar, slope, total + 1 + hinges),
        hinged=tuple(int(node[k]) for k in whole.hinged),
        held=tuple(int(node[k]) for k in whole.held),
        clamped=tuple(int(slope[k]) for k in whole.clamped),
    )


class Layout(NamedTuple):
    """Where deflections and slopes stand among the unknowns."""

    deflection: Array
    """Unknown of each node, int array (e+1,)."""
    slope: Array
    """Unknown of each slope, int array (s,)."""
    element: Array
    """The four unknowns of each beam: deflection and slope at its start and end, int array (e, 4)."""
    free: Array
    """Unknowns that nothing holds, in rising order."""


def layout(whole: Line) -> Layout:
    """Return where deflections and slopes of a line stand among the unknowns."""
    return _layout(whole.beams, whole.hinged, whole.held, whole.clamped)


@cache
def _layout(beams: int, hinged: tuple[int, ...], held: tuple[int, ...], clamped: tuple[int, ...]) -> Layout:
    node = np.arange(beams + 1)
    gaps = np.asarray(hinged, dtype=int)
    before = node + np.searchsorted(gaps, node, side="left")
    after = node + np.searchsorted(gaps, node, side="right")
    deflection = node + before
    slope = np.empty(beams + 1 + len(hinged), dtype=int)
    slope[before] = deflection + 1
    slope[after] = deflection + 1 + (after - before)
    element = np.stack((deflection[:-1], slope[after[:-1]], deflection[1:], slope[before[1:]]), axis=-1)
    still = np.concatenate((deflection[list(held)], slope[list(clamped)])).astype(int)
    free = np.setdiff1d(np.arange(2 * (beams + 1) + len(hinged)), still)
    return Layout(deflection, slope, element, free)


def rigid_motions(whole: Line) -> Array:
    """Return how a line can move without bending and without straining a spring.

    whole: one line.
    Returns (f, r): deflections and slopes of the r independent motions, for the unknowns that nothing holds.
    The beams between two hinges move as one: a deflection and a slope each. What a hinge joins, and what nodes,
    slopes and springs hold, are linear conditions on these; the motions are what the conditions leave.
    """
    at = layout(whole)
    place = whole.place / whole.place[-1]
    start = np.asarray([0, *whole.hinged])
    body = np.searchsorted(start[1:], np.arange(whole.beams), side="right")
    motion = np.zeros((len(at.deflection) + len(at.slope), 2 * len(start)))
    rules: list[Array] = []
    for k in range(whole.beams):
        for node, (deflection, slope) in zip((k, k + 1), at.element[k].reshape(2, 2), strict=True):
            row = np.zeros(2 * len(start))
            row[2 * body[k]], row[2 * body[k] + 1] = 1.0, place[node] - place[start[body[k]]]
            motion[deflection] = row
            motion[slope, 2 * body[k] + 1] = 1.0 / whole.place[-1]
            if node == k + 1 and node in whole.hinged:
                row[2 * body[k] + 2] = -1.0
                rules.append(row)
    held = at.deflection[[*whole.held, *np.flatnonzero(whole.spring > 0.0)]]
    still = at.slope[[*whole.clamped, *np.flatnonzero(whole.tilt_spring > 0.0)]]
    rules += [*motion[held], *(motion[still] * whole.place[-1])]
    return motion[at.free] @ _null_space(np.asarray(rules).reshape(len(rules), 2 * len(start)))


def _null_space(rules: Array) -> Array:
    """Return an orthonormal basis of what satisfies linear conditions of like size."""
    if not len(rules):
        return np.eye(rules.shape[-1])
    _left, size, right = np.linalg.svd(rules)
    return right[int(np.sum(size > RANK * size[0])) :].T


RANK = 1e-9
"""Singular values below this share of the largest count as nought."""


# Finite elements of lines of beams: stiffness, inertia and gyroscopic action.


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
