"""Chains of masses, each coupled to the next: forced response at many frequencies, natural frequencies and modes.

A chain's matrices are tridiagonal, and nothing here subtracts what could be added: dynamic stiffnesses of the two sides
meet at the driven place instead of an elimination down the matrix, and frequencies are singular values of a bidiagonal
matrix instead of roots of eigenvalues. So stiff couplings beside soft ones, and slow frequencies of free chains, keep
their digits.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from cardan.later import later
from cardan.maths.arrays import NUMBERS, Array, ArrayLike, complex_of, namespace, real
from cardan.maths.compiled.method import Compiled, Method, chosen, share

groups_of = later("cardan.maths.compiled.lanes")
compiled = later("cardan.maths.compiled.tridiagonal")

LARGE = 1_000_000
"""Places times frequencies from which the kernel is worth loading numba."""

TINY = 1e-100
"""Stands for a dynamic stiffness of nought, over that of the coupling, where a half of the chain is in resonance."""

_THREAD = 20_000
"""Places times frequencies worth a thread."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Response:
    """Steady vibration of chains under harmonic loads; nan at a resonance without damping."""

    displacement: Array  # (..., n, f), complex: amplitude and phase of each place
    # (..., n-1, f), complex: what each coupling passes on from its place to the next: coupling times difference of
    # displacements
    flow: Array

    @property
    def resonant(self) -> Array:
        """Whether a frequency meets a natural one without damping, so that nothing is steady: array (..., f)."""
        xp = namespace(self.displacement)
        return xp.isnan(xp.real(self.displacement[..., 0, :]))


def response(
    mass: ArrayLike,
    coupling: ArrayLike,
    omega: ArrayLike,
    load: ArrayLike,
    *,
    drag: ArrayLike = 0.0,
    ground: ArrayLike = 0.0,
    ground_drag: ArrayLike = 0.0,
    attached: ArrayLike | None = None,
    method: Method | None = None,
) -> Response:
    """Return the steady vibration x e^(iωt) of chains under loads F e^(iωt).

    mass (..., n): m of each place, at least 0.
    coupling (..., n-1): k between neighbours, not 0; complex where it loses energy.
    omega (f,) [rad/s]: ω; load (..., n): F at each place, complex.
    drag (..., n-1) or number: d of the couplings: they carry (k + iωd) times the difference of displacements.
    ground, ground_drag (..., n) or numbers: the same from each place to the ground.
    attached (..., n, f), complex: dynamic stiffness of whatever else hangs on each place; array expressions only.
    method: Compiled by default from a million places times frequencies on, where numba is installed.

    Looking from a coupling to one side, the chain is a dynamic stiffness Z; through the coupling k it is felt as
    Zk/(Z + k), and the next place adds -ω²m to that. Swept from both ends, the sums of both sides at each place give
    its displacement under its own load, and k/(Z + k) what of it reaches the next place. The quotient keeps its digits
    through any resonance of a part, where an elimination without exchange of rows loses them.
    """
    given = (mass, coupling, load, drag, ground, ground_drag)
    xp = namespace(*given, omega, [] if attached is None else attached)
    xp = np if xp is NUMBERS else xp
    m, k, force, d, g, gd = (xp.asarray(one) for one in given)
    w = real(omega, xp)
    outer = tuple(np.broadcast_shapes(*(tuple(one.shape[:-1]) for one in (m, k, force, d, g, gd) if one.ndim)))
    n, f = int(m.shape[-1]), int(w.shape[0])
    how = chosen(method, xp, math.prod(outer) * n * f >= LARGE) if attached is None else None
    if isinstance(how, Compiled):
        return _compiled(outer, (m, g.real, g.imag, gd, force.real, force.imag), (k.real, k.imag, d), w, how.threads)
    own = _places(m, g, gd, w, n)
    if attached is not None:
        own = [one + attached[..., s, :] for s, one in enumerate(own)]
    turning = 1j * complex_of(w, xp)
    couplings = [_at(k, s) + turning * _at(d, s) if _given(d) else _at(k, s) for s in range(n - 1)]
    loads = [_at(force, s) for s in range(n)]
    with np.errstate(divide="ignore", invalid="ignore"):
        found = _swept(own, couplings, loads, (*outer, f), guarded=False)
        if bool(xp.all(xp.isfinite(found.displacement))):
            return found
        return _swept(own, couplings, loads, (*outer, f), guarded=True)


def _at(values: Array, place: int) -> Array:
    """Return the value of a place, shape (..., 1), from those of all places or one for all."""
    return values[..., place, None] if values.ndim else values


def _given(values: Array) -> bool:
    return bool(values.ndim) or bool(values != 0.0)


def _places(mass: Array, ground: Array, drag: Array, omega: Array, n: int) -> list[Array]:
    """Return the dynamic stiffness of each place by itself, shapes (..., f); real where it can be."""
    square = -(omega * omega)
    own = [square * _at(mass, s) for s in range(n)]
    if _given(ground):
        own = [one + _at(ground, s) for s, one in enumerate(own)]
    if _given(drag):
        turning = 1j * complex_of(omega, namespace(omega))
        own = [one + turning * _at(drag, s) for s, one in enumerate(own)]
    return own


def _swept(
    own: list[Array], coupling: list[Array], load: list[Array], shape: tuple[int, ...], *, guarded: bool
) -> Response:
    xp = namespace(own[0])
    n = len(own)

    def sweep(places: list[Array], between: list[Array]) -> tuple[list[Array], list[Array]]:
        """Return k/(Z + k) of each coupling from an end on, and the stiffness Z felt through it."""
        through: list[Array] = []
        felt: list[Array] = []
        z = places[0]
        for k, place in zip(between, places[1:], strict=True):
            below = z + k
            if guarded:
                below = xp.where(below == 0.0, TINY * k, below)
            through.append(k / below)
            felt.append(z * through[-1])
            z = place + felt[-1]
        return through, felt

    left, left_felt = sweep(own, coupling)
    right, right_felt = (part[::-1] for part in sweep(own[::-1], coupling[::-1]))

    nothing = xp.zeros(shape, dtype=xp.complex128)
    driven = []
    for s, force in enumerate(load):
        if xp is np and not np.any(force):
            driven.append(nothing)
            continue
        total = own[s]
        for felt in left_felt[s - 1 : s] if s else []:
            total = total + felt
        for felt in right_felt[s : s + 1]:
            total = total + felt
        if guarded:
            total = xp.where(total == 0.0, xp.nan, total)
        driven.append(nothing + force / total)
    onward = [driven[0]]
    for s in range(1, n):
        onward.append(driven[s] + right[s - 1] * onward[-1])
    places, flows, back = [onward[-1]], [], nothing
    for s in range(n - 2, -1, -1):
        behind = back + driven[s + 1]
        back = left[s] * behind
        places.append(onward[s] + back)
        flows.append(right_felt[s] * onward[s] - left_felt[s] * behind)
    empty = xp.zeros((*shape[:-1], 0, shape[-1]), dtype=xp.complex128)
    return Response(
        displacement=xp.stack(places[::-1], axis=-2), flow=xp.stack(flows[::-1], axis=-2) if flows else empty
    )


def _compiled(
    outer: tuple[int, ...], places: tuple[Array, ...], couplings: tuple[Array, ...], omega: Array, threads: int | None
) -> Response:
    lanes, kernel, numbers_each = groups_of().LANES, compiled().kernel, compiled().NUMBERS
    n, f = int(places[0].shape[-1]), omega.size
    rows, groups = math.prod(outer), -(-f // lanes)
    table = np.zeros((*outer, n, numbers_each))
    for column, values in enumerate(places):
        table[..., column] = values
    for column, values in enumerate(couplings, start=len(places)):
        table[..., :-1, column] = values
    padded = np.ones(groups * lanes)
    padded[:f] = omega
    moved, flow = (np.empty((*outer, n, groups * lanes), dtype=complex) for _result in range(2))
    numbers = table.reshape(-1), n, padded, moved.view(float).reshape(-1), flow.view(float).reshape(-1)

    def work(first: int, last: int) -> None:
        kernel(*numbers, first, last)

    share(work, rows * groups, threads=threads, least=max(1, _THREAD // (n * lanes)))
    return Response(displacement=moved[..., :f], flow=flow[..., : n - 1, :f])


def modes(mass: ArrayLike, coupling: ArrayLike, ground: ArrayLike = 0.0) -> tuple[Array, Array]:
    """Return natural frequencies and modes of chains without damping.

    mass (..., n): m of each place, at least 0 and not all of a chain 0.
    coupling (..., n-1): k between neighbours, positive.
    ground (..., n) or number: k from each place to the ground, at least 0.
    Returns omega (..., n) [rad/s]: natural frequencies, the slowest first; exactly 0 for the first of a free chain.
    Each place without mass adds one that is infinite; shape (..., n, n): displacements of each mode, a mode a row, with
    Σ m x² = 1; nan where the frequency is infinite.

    With differences D, couplings C and masses M the stiffness is DᵀCD; ω are the singular values of the bidiagonal
    matrix C^½ D M^-½, which LAPACK finds with full accuracy, not the square roots of eigenvalues. Places
    without mass are taken out beforehand; all terms of that are positive.
    """
    m = np.asarray(mass, dtype=float)
    k, g = np.asarray(coupling, dtype=float), np.asarray(ground, dtype=float)
    outer = np.broadcast_shapes(m.shape[:-1], k.shape[:-1], g.shape[:-1])
    n = m.shape[-1]
    m, k, g = (np.broadcast_to(one, (*outer, size)) for one, size in ((m, n), (k, n - 1), (g, n)))
    bare = m == 0.0
    if not np.any(bare):
        return _modes(m, k, g)
    omega, shape = np.full((*outer, n), np.inf), np.full((*outer, n, n), np.nan)
    for pattern in np.unique(bare.reshape(-1, n), axis=0):
        rows = np.all(bare == pattern, axis=-1)
        omega[rows], shape[rows] = _condensed(m[rows], k[rows], g[rows], pattern)
    return omega, shape


def _modes(mass: Array, coupling: Array, ground: Array) -> tuple[Array, Array]:
    """Return frequencies and modes of chains (..., n) whose masses are positive."""
    n = mass.shape[-1]
    root = np.sqrt(mass)
    matrix = np.zeros((*mass.shape, n))
    here, there = np.arange(n - 1), np.arange(1, n)
    stiff = np.sqrt(coupling)
    matrix[..., here, here] = stiff / root[..., :-1]
    matrix[..., here, there] = -stiff / root[..., 1:]
    held = np.sqrt(ground) / root
    matrix[..., -1, -1] = held[..., -1]
    if np.any(held[..., :-1]):
        matrix = np.concatenate((matrix, held[..., :-1, None] * np.eye(n - 1, n)), axis=-2)
    _left, found, right = np.linalg.svd(matrix, full_matrices=False)
    omega, shape = np.flip(found, axis=-1).copy(), np.flip(right, axis=-2) / root[..., None, :]
    free = ~np.any(ground, axis=-1)
    omega[..., 0] = np.where(free, 0.0, omega[..., 0])
    rigid = np.broadcast_to(np.sum(mass, axis=-1)[..., None] ** -0.5, mass.shape)
    shape[..., 0, :] = np.where(free[..., None], rigid, shape[..., 0, :])
    largest = np.take_along_axis(shape, np.argmax(np.abs(shape), axis=-1)[..., None], axis=-1)
    return omega, shape * np.sign(largest)


def _condensed(mass: Array, coupling: Array, ground: Array, bare: Array) -> tuple[Array, Array]:
    """Return frequencies and modes of chains (r, n) that lack mass at the same places."""
    places = list(range(len(bare)))
    k, g = [coupling[:, j] for j in range(coupling.shape[-1])], [ground[:, s] for s in places]
    taken: list[tuple[int, list[tuple[int, Any]]]] = []
    for s in np.flatnonzero(bare):
        at = places.index(int(s))
        sides = [(at - 1, k[at - 1])] if at else []
        sides += [(at + 1, k[at])] if at + 1 < len(places) else []
        total = g[at] + sum(one for _place, one in sides)
        taken.append((int(s), [(places[place], one / total) for place, one in sides]))
        for place, one in sides:
            g[place] = g[place] + one * g[at] / total
        if len(sides) == 2:
            k[at - 1 : at + 1] = [sides[0][1] * sides[1][1] / total]
        else:
            del k[0 if at == 0 else -1]
        del places[at], g[at]
    rows, n, rest = len(mass), len(bare), len(places)
    inner = np.stack(k, axis=-1) if k else np.empty((rows, 0))
    found, moved = _modes(mass[:, places], inner, np.stack(g, axis=-1))
    omega, shape = np.full((rows, n), np.inf), np.full((rows, n, n), np.nan)
    omega[:, :rest], shape[:, :rest, places] = found, moved
    for s, sides in reversed(taken):
        shape[:, :rest, s] = sum(part[:, None] * shape[:, :rest, place] for place, part in sides)
    return omega, shape
