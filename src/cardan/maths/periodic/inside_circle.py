"""Where are all eigenvalues of a matrix that depends on a number inside the unit circle? Proved, not sampled.

The matrix is smooth in the number, so polynomials through its values at Chebyshev's points hold it to rounding. In
Bernstein's form such a polynomial is a mean of its control matrices with weights that are never negative: a norm in
which every control matrix is below 1 is below 1 all along, and no eigenvalue leaves the circle. The norm is Lyapunov's
of the matrix in the middle. Where it does not reach, the stretch is halved, so that stretches become as short as the
distance to the edge that they stand beside.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import cache
from typing import TypeAlias

import numpy as np

from cardan.maths.arrays import Array

DEGREE = 15
"""Of the polynomials."""

TOLERANCE = 1e-9
"""Largest share that the last coefficients of a polynomial may have."""

INSIDE = 5e-7
"""A modulus this close to 1 is not told from 1."""

COARSE = 1e-3
"""Share of the number below which a stretch whose ends and middle are outside counts as outside throughout."""

FRINGE = 1e-4
"""Share of the number that a stretch beside an edge may have and still counts as that edge."""

MOST, MATRICES, UNKNOWNS = 60_000, 32_000, 2_500_000
"""Stretches, matrices, and squares of the size of all stretches at most; what is left then stays unproved."""

BATCH, PANELS = 1024, 32
"""Stretches looked at, and polynomials sampled, together."""

DOUBLINGS = 26
"""Of the sum that gives Lyapunov's norm: 2^26 periods."""

Sample: TypeAlias = Callable[[Array], tuple[Array, Array, Array]]
"""From places (n, p), a polynomial a row, to matrices (n, p, m, m), whether each is one (n, p), and numbers (n, p).

The slope of the number tells which eigenvalue is apart.
"""

Largest: TypeAlias = Callable[[Array, Array, Array], Array]
"""From matrices (p, m, m), places and the slope of the number there (p,) to the largest modulus that counts, (p,)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Proof:
    """Stretches of an interval, each (k, 2): where it begins and ends, rising."""

    # some eigenvalue is outside the circle, or nothing is shown between two such stretches; the ends are known to the
    # width that was asked for
    outside: Array
    unproved: Array  # neither was shown; an end of what is outside is not counted
    unsampled: Array  # those among them that no polynomial holds: the matrix is missing there, or not smooth
    unfinished: Array  # those among them of which more matrices would have had to be taken than may be
    samples: int  # matrices taken
    stopped: bool = False  # whether the work was stopped


@dataclass(frozen=True, eq=False, kw_only=True)
class _Stretches:
    """Stretches with the control matrices of their polynomials."""

    low: Array  # (n,)
    high: Array  # (n,)
    control: Array  # (n, DEGREE+1, m, m)
    number: Array  # (n, DEGREE+1): the same of the number beside them
    missed: Array  # (n,): what the polynomial is off, about

    def some(self, rows: Array) -> _Stretches:
        return _Stretches(**{one.name: getattr(self, one.name)[rows] for one in fields(_Stretches)})

    def halves(self) -> _Stretches:
        """Return both halves of each, by de Casteljau."""
        first, last = _tables().halves
        middle = 0.5 * (self.low + self.high)
        return _Stretches(
            low=np.concatenate([self.low, middle]),
            high=np.concatenate([middle, self.high]),
            control=np.concatenate([np.einsum("ij,njab->niab", one, self.control) for one in (first, last)]),
            number=np.concatenate([self.number @ one.T for one in (first, last)]),
            missed=np.concatenate([self.missed, self.missed]),
        )


def inside_circle(
    sample: Sample,
    low: float,
    high: float,
    *,
    largest: Largest,
    one_apart: bool = False,
    breaks: Array | tuple[float, ...] = (),
    first: int = 8,
    width: float = 1e-6,
    slack: float = 0.0,
    most: int = MATRICES,
    progress: Callable[[float], object] | None = None,
) -> Proof:
    """Return where on an interval no eigenvalue is outside the unit circle, and where that is not so or not shown.

    sample: the matrices; largest: the modulus that decides at a place.
    one_apart: whether one real eigenvalue does not count, that which `largest` leaves out; all others are then shown to
    be inside.
    breaks: places at which the matrix is not smooth, as far as known.
    first: polynomials to begin with; width: share of the number at which halving ends.
    slack: by which a modulus may exceed 1 where nothing else is seen: of matrices whose moduli all are 1.
    most: matrices at most, the widest stretches first.
    progress: told the share done; when it answers "stop" what is left stays unproved.
    A zone of instability within what is proved is impossible, but for what the polynomials miss (1e-9), the error of
    the matrices themselves, and moduli within 5e-7 of 1, which are not called inside.
    """
    stopped = False

    def told(share: float) -> bool:
        nonlocal stopped
        stopped = stopped or (progress is not None and progress(min(share, 1.0)) == "stop")
        return stopped

    held, lost, left, samples = _polynomials(sample, low, high, breaks, first, width, most, told)
    outside: list[tuple[float, float]] = []
    short: list[tuple[float, float]] = []
    looked, settled, enough = 0, 0.0, min(MOST, UNKNOWNS // max(held.control.shape[-1] ** 2, 1))
    while len(held.low):
        looked += len(held.low)
        parts = [held.some(np.arange(k, min(k + BATCH, len(held.low)))) for k in range(0, len(held.low), BATCH)]
        judged = [_judged(part, largest, one_apart, width, slack) for part in parts]
        inside, beyond, ended, edge = (np.concatenate([one[k] for one in judged]) for k in range(4))
        outside += _pairs(held, beyond | (ended & edge))
        settled += float(np.sum((held.high - held.low)[inside | beyond | ended]))
        ended = ~(inside | beyond) if told(0.5 + 0.5 * settled / (high - low)) or looked >= enough else ended
        short += _pairs(held, ended & ~edge)
        held = held.some(np.flatnonzero(~(inside | beyond | ended))).halves()
    beyond = _runs(outside)
    fringe = _beside(_runs(short + lost + left), beyond)
    unproved = _runs([one for one in short + lost + left if not _within(one, fringe)])
    between = np.isin(unproved[:, 0], beyond[:, 1]) & np.isin(unproved[:, 1], beyond[:, 0])
    return Proof(
        outside=_runs([*beyond.tolist(), *unproved[between].tolist()]),
        unproved=unproved[~between],
        unsampled=_runs([one for one in lost if not _within(one, fringe)]),
        unfinished=_runs([one for one in left if not _within(one, fringe)]),
        samples=samples,
        stopped=stopped,
    )


def _pairs(part: _Stretches, mask: Array) -> list[tuple[float, float]]:
    return list(zip(part.low[mask].tolist(), part.high[mask].tolist(), strict=True))


def _beside(short: Array, outside: Array) -> Array:
    """Return the narrow stretches that touch something outside: where its edge is, no proof reaches, array (k, 2)."""
    touching = np.isin(short[:, 0], outside[:, 1]) | np.isin(short[:, 1], outside[:, 0])
    found: Array = short[touching & (short[:, 1] - short[:, 0] <= FRINGE * np.abs(short[:, 1]))]
    return found


def _within(one: tuple[float, float], runs: Array) -> bool:
    return bool(np.any((runs[:, 0] <= one[0]) & (one[1] <= runs[:, 1])))


def _runs(pairs: list[tuple[float, float]]) -> Array:
    """Return stretches joined where they touch, array (k, 2)."""
    found: list[list[float]] = []
    for begin, end in sorted(pairs):
        if found and begin <= found[-1][1]:
            found[-1][1] = max(found[-1][1], end)
        else:
            found.append([begin, end])
    return np.asarray(found, dtype=float).reshape(-1, 2)


@dataclass(frozen=True, eq=False, kw_only=True)
class _Tables:
    nodes: Array  # (n,): on (0, 1)
    control: Array  # (n, n): from values at the nodes to control points
    tail: Array  # (3, n): the last coefficients by Chebyshev's polynomials
    halves: tuple[Array, Array]  # (n, n): from control points to those of both halves
    middle: Array  # (n-1,): weights of the differences of control points in the slope of the middle


@cache
def _tables() -> _Tables:
    n = DEGREE + 1
    nodes = 0.5 * (1.0 - np.cos(np.pi * (np.arange(n) + 0.5) / n))
    choose = [1.0]
    for k in range(DEGREE):
        choose.append(choose[-1] * (DEGREE - k) / (k + 1))
    order = np.arange(n)
    bernstein = np.asarray(choose) * nodes[:, None] ** order * (1.0 - nodes[:, None]) ** (DEGREE - order)
    chebyshev = np.polynomial.chebyshev.chebvander(2.0 * nodes - 1.0, DEGREE)
    left = np.zeros((n, n))
    row = np.asarray([1.0])
    for k in range(n):
        left[k, : k + 1] = row
        row = 0.5 * (np.append(row, 0.0) + np.append(0.0, row))
    return _Tables(
        nodes=nodes,
        control=np.linalg.inv(bernstein),
        tail=np.linalg.inv(chebyshev)[-3:],
        halves=(left, left[::-1, ::-1].copy()),
        middle=left[-2, :-1].copy(),
    )


def _polynomials(
    sample: Sample,
    low: float,
    high: float,
    breaks: Array | tuple[float, ...],
    first: int,
    width: float,
    most: int,
    stops: Callable[[float], bool],
) -> tuple[_Stretches, list[tuple[float, float]], list[tuple[float, float]], int]:
    """Return polynomials that hold the matrix, stretches that none holds, those not done, and matrices taken."""
    table = _tables()
    cuts = np.unique([low, *(one for one in breaks if low < one < high), high])
    ends = [np.linspace(a, b, max(1, round(first * (b - a) / (high - low))) + 1) for a, b in itertools.pairwise(cuts)]
    queue = np.concatenate([np.stack([one[:-1], one[1:]], axis=-1) for one in ends])
    parts: list[_Stretches] = []
    lost: list[tuple[float, float]] = []
    samples, done = 0, 0.0
    while len(queue) and not stops(0.5 * done):
        room = min(PANELS, (most - samples) // len(table.nodes))
        if room < 1:
            break
        todo, queue = queue[:room], queue[room:]
        places = todo[:, :1] + (todo[:, 1:] - todo[:, :1]) * table.nodes
        matrix, there, number = sample(places)
        samples += places.size
        values = np.where(there[..., None, None], matrix, 0.0)
        tail = np.sqrt(np.sum(np.einsum("ij,njab->niab", table.tail, values) ** 2, axis=(-1, -2))).sum(axis=-1)
        good = there.all(axis=-1) & (tail <= TOLERANCE * np.maximum(1.0, np.max(np.abs(values), axis=(1, 2, 3))))
        rows = np.flatnonzero(good)
        if rows.size:
            control = np.einsum("ij,njab->niab", table.control, values[rows])
            beside = number[rows] @ table.control.T
            low_high = {"low": todo[rows, 0], "high": todo[rows, 1]}
            parts.append(_Stretches(**low_high, control=control, number=beside, missed=tail[rows]))
        shortest = np.where(there.any(axis=-1), max(width, LEAST), MISSING) * np.abs(todo[:, 1])
        short = ~good & (todo[:, 1] - todo[:, 0] <= shortest)
        lost += [(float(a), float(b)) for a, b in todo[short]]
        todo = todo[~good & ~short]
        middle = todo.mean(axis=-1)
        queue = np.concatenate([queue, np.stack([todo[:, 0], middle], -1), np.stack([middle, todo[:, 1]], -1)])
        done = 1.0 - float(np.sum(queue[:, 1] - queue[:, 0])) / (high - low)
    left = [(float(a), float(b)) for a, b in queue]
    if not parts:
        nothing, control = np.zeros(0), np.zeros((0, DEGREE + 1, 1, 1))
        empty = _Stretches(low=nothing, high=nothing, control=control, number=control[..., 0, 0], missed=nothing)
        return empty, lost, left, samples
    whole = {one.name: np.concatenate([getattr(part, one.name) for part in parts]) for one in fields(_Stretches)}
    return _Stretches(**whole), lost, left, samples


LEAST, MISSING = 1e-5, 0.02
"""Shares of the number below which a stretch is not halved further that no polynomial holds, and that has no matrix."""


def _judged(
    part: _Stretches, largest: Largest, one_apart: bool, width: float, slack: float
) -> tuple[Array, Array, Array, Array]:
    """Return which stretches are inside by proof, outside, too short to be halved, and in part outside."""
    control = part.control
    middle = np.einsum("j,njab->nab", _tables().halves[0][-1], control)
    count, size = len(control), control.shape[-1]
    three = np.stack([control[:, 0], middle, control[:, -1]], axis=1).reshape(3 * count, size, size)
    steps = np.diff(part.number, axis=-1)
    long = part.high - part.low
    slope = DEGREE * np.stack([steps[:, 0], steps @ _tables().middle, steps[:, -1]], axis=-1) / long[:, None]
    places = np.stack([part.low, 0.5 * (part.low + part.high), part.high], axis=-1)
    out = (largest(three, places.reshape(-1), slope.reshape(-1)) > 1.0 + INSIDE).reshape(count, 3)
    proved = np.zeros(count, dtype=bool)
    maybe = np.flatnonzero(~out.any(axis=-1))
    if maybe.size:
        proved[maybe] = _proved(
            (1.0 - slack) * control[maybe], (1.0 - slack) * middle[maybe], part.missed[maybe], one_apart
        )
    outside = out.all(axis=-1) & (long <= COARSE * np.abs(part.high))
    short = ~proved & ~outside & (long <= width * np.abs(part.high))
    return proved, outside, short, out.any(axis=-1)


def _proved(control: Array, middle: Array, missed: Array, one_apart: bool) -> Array:
    """Tell of which stretches every eigenvalue, or every one but a real one, is inside all along, (n,) of bool."""
    norm, factor = _norm(middle)
    with np.errstate(all="ignore"):
        moved = norm[:, None] @ control @ np.linalg.inv(norm)[:, None]
        found: Array = np.max(_spectral(moved), axis=-1) + factor * missed < 1.0 - INSIDE
    rows = np.flatnonzero(~found)
    if one_apart and rows.size:
        found[rows] = _proved_but_one(control[rows], middle[rows], missed[rows])
    return found


def _proved_but_one(control: Array, middle: Array, missed: Array) -> Array:
    """Tell of which stretches every eigenvalue but the real one nearest to 1 is inside all along, (n,) of bool."""
    right, left = _apart(middle)
    # basis: the vector apart, and what its left one does not see
    normal = left.copy()
    normal[:, 0] += np.where(left[:, 0] < 0.0, -1.0, 1.0)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    rest = (np.eye(left.shape[-1]) - 2.0 * normal[:, :, None] * normal[:, None, :])[:, :, 1:]
    base = np.concatenate([right[:, :, None], rest], axis=-1)
    with np.errstate(all="ignore"):
        inverse = _inverse(base)
        whole = inverse[:, None] @ control @ base[:, None]
        inner = (inverse @ middle @ base)[:, 1:, 1:]
        norm, factor = _norm(inner)
        back = np.linalg.inv(norm)
        missed = missed * factor * np.linalg.norm(base, axis=(1, 2)) * np.linalg.norm(inverse, axis=(1, 2))
        own = np.max(_spectral(norm[:, None] @ whole[..., 1:, 1:] @ back[:, None]), axis=-1) + missed
        # others by the one apart, and that one by others: Gershgorin's discs of the two blocks lie apart
        to_rest = np.max(np.linalg.norm(norm[:, None] @ whole[..., 1:, :1], axis=(-1, -2)), axis=-1) + missed
        to_one = np.max(np.linalg.norm(whole[..., :1, 1:] @ back[:, None], axis=(-1, -2)), axis=-1) + missed
        room = 1.0 - INSIDE - own
        lowest = np.min(whole[..., 0, 0], axis=-1) - missed
        good: Array = (room > 0.0) & (2.0 * to_rest / room * to_one < lowest - own - 0.5 * room)
    return good


def _inverse(matrix: Array) -> Array:
    """Return inverses; not a number where there is none."""
    try:
        return np.linalg.inv(matrix)
    except np.linalg.LinAlgError:
        good = np.abs(np.linalg.det(matrix)) > 0.0
        found = np.full_like(matrix, np.nan)
        found[good] = np.linalg.inv(matrix[good])
        return found


def _apart(matrix: Array) -> tuple[Array, Array]:
    """Return the right and left eigenvectors, of length 1, of the largest real eigenvalue above 1, arrays (n, m).

    Where there is none, of the real one nearest to 1: those that count are inside, or the stretch is not looked at.
    """
    values, vectors = np.linalg.eig(matrix)
    real = np.abs(values.imag) <= 1e-12 * np.abs(values)
    far = np.where(real, np.abs(values - 1.0), 1.0 + np.abs(values))
    far = np.where(real & (values.real > 1.0), -values.real, far)
    best = np.argmin(far, axis=-1)
    right = np.take_along_axis(vectors, best[:, None, None], axis=-1)[..., 0].real
    left = np.take_along_axis(_inverse(vectors.astype(complex)), best[:, None, None], axis=1)[:, 0].real
    with np.errstate(all="ignore"):
        return tuple(np.nan_to_num(one / np.linalg.norm(one, axis=-1, keepdims=True)) for one in (right, left))


def _norm(matrix: Array) -> tuple[Array, Array]:
    """Return N (n, m, m) with |N A N⁻¹| < 1 where the eigenvalues of A are inside, and its condition (n,).

    NᵀN = Σ (Aᵏ)ᵀ Aᵏ, Lyapunov's; the identity, which shows nothing, where the sum has no end.
    """
    size = matrix.shape[-1]
    total = np.broadcast_to(np.eye(size), matrix.shape).copy()
    power = matrix
    with np.errstate(all="ignore"):
        for _each in range(DOUBLINGS):
            total = total + power.swapaxes(-1, -2) @ total @ power
            power = power @ power
            if not np.any(np.abs(power) > 1e-18):
                break
    bad = ~np.isfinite(total).all(axis=(-1, -2)) | (np.max(np.abs(total), axis=(-1, -2)) > 1e12)
    total[bad] = np.eye(size)
    values, vectors = np.linalg.eigh(total)
    root = np.sqrt(np.maximum(values, 1.0))
    return root[..., None] * vectors.swapaxes(-1, -2), root[..., -1] / root[..., 0]


def _spectral(matrix: Array) -> Array:
    """Return the spectral norms of matrices (..., m, m); not finite ones have none that is small."""
    good = np.isfinite(matrix).all(axis=(-1, -2))
    finite = np.where(good[..., None, None], matrix, 0.0)
    values = np.linalg.eigvalsh(finite.swapaxes(-1, -2) @ finite)  # half the time of singular values
    found: Array = np.where(good, np.sqrt(values[..., -1]) if values.shape[-1] else 0.0, np.inf)
    return found
