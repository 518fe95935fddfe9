"""Exact whirl of lines of beams: transfer matrices of their sections, and a count of modes that misses none."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import scipy

from cardan.maths.arrays import Array, ArrayLike

from .rotor_beams import Line, assembled, divided, line, matrices, rigid_motions

CLAMPED = 0.2
"""Pieces are so short that (speed over lowest frequency with both ends clamped)² stays below this."""

SHORT = 0.01
"""Pieces shorter than this share of the line are taken together with their neighbours."""

NARROW = 1.3
"""Ratio of the ends of a bracket from which on a root is polished instead of counted."""

LOWEST = 40
"""How often a speed is quartered in search of one below all roots: 24 decades."""

CLOSE = 1e-3
"""Half the width of the bracket around a guess."""

PRECISE = 1e-13
"""Relative width within which a root is found."""

PASSES = 3
"""How often rows are scaled; each pass takes the square root of what their sizes differ by."""

TINY = 1e-60
"""Keeps a row of zeros as it is."""


def speeds(whole: Line, count: int, *, spin: float | None = None, near: ArrayLike | None = None) -> Array:
    """Return the lowest natural speeds of a line in forward whirl, exactly and none missed.

    whole: one line.
    spin [rad/s]: Ω; 0 is at rest, negative against the whirl. As fast as it whirls when not given: these are critical
    speeds.
    near (count,) [rad/s]: where they are likely to be, which saves looking for them; wrong guesses do no harm.
    Returns (count,) [rad/s]: ω in rising order: a zero for each motion without bending, then the roots.

    The state s = (w, θ, M, V) of each section follows from s' = A s by the matrix exponential,

        w' = θ + V/(κGA);  θ' = M/(EI);  M' = -V + ρI(2Ωω - ω²) θ;  V' = -ρAω² w.

    Solved for both ends, it is the section's dynamic stiffness, and the boundary determinant is that of the line. Over
    ω it falls with ω, so its negative eigenvalues count the roots below a speed (W. H. Wittrick and F. W. Williams,
    Q. J. Mech. Appl. Math. 24, 1971), provided that no piece can whirl between clamped ends. The count encloses root
    j; within, the j-th eigenvalue has its only zero.
    """
    rigid = rigid_motions(whole)
    zeros = min(rigid.shape[-1], count)
    found = np.zeros(count)
    if zeros < count:
        sinking = _sinking(whole, rigid, spin)
        guess = np.full(count, np.nan) if near is None else np.asarray(near, dtype=float)
        low = None
        for k in range(zeros, count):
            number = sinking + k - zeros + 1
            bracket = _around(whole, spin, number, float(guess[k]))
            if bracket is None:
                bracket = _bracket(whole, spin, number, _below_all(whole, spin, sinking) if low is None else low)
            low = found[k] = _root(whole, spin, number, bracket)
    return found


def modes_below(whole: Line, speed: float, *, spin: float | None = None) -> int:
    """Return how many natural speeds of a line lie below a speed [rad/s]; see `speeds`."""
    height, within = _spectrum(_pieces(whole, speed, spin), speed, spin)
    return within + int(np.sum(height < 0.0))


def _around(whole: Line, spin: float | None, number: int, guess: float) -> tuple[float, float] | None:
    """Return a narrow bracket around a guess, None where root ``number`` is not in it."""
    if not guess > 0.0:
        return None
    low, high = guess * (1.0 - CLOSE), guess * (1.0 + CLOSE)
    there = modes_below(whole, low, spin=spin) < number <= modes_below(whole, high, spin=spin)
    return (low, high) if there else None


def _bracket(whole: Line, spin: float | None, number: int, low: float) -> tuple[float, float]:
    """Return speeds below and above root ``number``, from one below it."""
    high = 1.5 * low
    while modes_below(whole, high, spin=spin) < number:
        low, high = high, 1.5 * high
    while high > NARROW * low:
        middle = float(np.sqrt(low * high))
        if modes_below(whole, middle, spin=spin) < number:
            low = middle
        else:
            high = middle
    return low, high


def _root(whole: Line, spin: float | None, number: int, bracket: tuple[float, float]) -> float:
    """Return the speed at which the count of `modes_below` comes to a number."""
    low, high = bracket
    pieces = _pieces(whole, high, spin)
    while high - low > PRECISE * high:
        ends = [_spectrum(pieces, speed, spin) for speed in (low, high)]
        inside = ends[0][1]
        # Between these the determinant has no pole, and eigenvalue number - inside of the rest is smooth.
        if inside == ends[1][1] and inside < number <= inside + len(ends[0][0]):
            one, other = (float(height[number - inside - 1]) for height, _within in ends)
            if one > 0.0 > other:
                break
        middle = 0.5 * (low + high)
        height, within = _spectrum(pieces, middle, spin)
        if within + int(np.sum(height < 0.0)) < number:
            low = middle
        else:
            high = middle
    else:
        return 0.5 * (low + high)

    def signed(speed: float) -> float:
        return float(_spectrum(pieces, speed, spin)[0][number - inside - 1])

    return float(scipy.optimize.brentq(signed, low, high, xtol=PRECISE * high, rtol=PRECISE))


def _spectrum(pieces: _Pieces, speed: float, spin: float | None) -> tuple[Array, int]:
    """Return the eigenvalues of the dynamic stiffness in rising order, and how many roots lie below within pieces."""
    matrix, within = _stiffness(pieces, speed, spin)
    return np.linalg.eigvalsh(_even(matrix)), within


def _even(matrix: Array) -> Array:
    """Return a symmetric matrix scaled on both sides so that the largest entries of its rows are alike, near 1.

    The scale of a row is its largest entry and not the one on the diagonal, which passes through zero: at the lowest
    root of a free beam all of those of the deflections do, and eigenvalues from 1e-10 to 1e10 leave eleven digits of
    the root. Daniel Ruiz, A scaling algorithm to equilibrate both rows and columns norms in matrices, RAL-TR-2001-034.
    """
    if not matrix.size:
        return matrix
    size, scale = np.abs(matrix), np.ones(len(matrix))
    for _pass in range(PASSES):
        row = 1.0 / np.sqrt(size.max(axis=-1) + TINY)
        size *= np.multiply.outer(row, row)
        scale = scale * row
    return matrix * np.multiply.outer(scale, scale)


def _below_all(whole: Line, spin: float | None, sinking: int) -> float:
    """Return a speed below all roots that are not zero."""
    low = float(np.sqrt(np.max(whole.bending) / np.min(whole.mass))) / float(whole.place[-1]) ** 2
    for _step in range(LOWEST):
        if modes_below(whole, low, spin=spin) <= sinking:
            break
        low *= 0.25
    return low


def _sinking(whole: Line, rigid: Array, spin: float | None) -> int:
    """Return how many eigenvalues are negative at the lowest speeds: motions without bending that only inertia feels.

    The others are held by gyroscopic action, and count from the speed on at which inertia overcomes it.
    """
    found = matrices(whole)
    inertia, gyroscopic = (rigid.T @ part @ rigid for part in (found.inertia, found.gyroscopic))
    if spin is None:
        return int(np.sum(np.linalg.eigvalsh(inertia - gyroscopic) > 0.0))
    lasting = np.linalg.eigvalsh(gyroscopic) > 1e-12 * np.max(np.abs(inertia), initial=0.0)
    return int(rigid.shape[-1]) - (int(np.sum(lasting)) if spin > 0.0 else 0)


def _twist(speed: float, spin: float | None) -> float:
    """Return Ωω, which moments of inertia about the line come with."""
    return speed * (speed if spin is None else spin)


@dataclass(frozen=True, eq=False)
class _Pieces:
    """A line in pieces short enough for a speed, and which of them are taken together."""

    fine: Line
    rough: Line
    first: tuple[int, ...]
    nodes: tuple[int, ...]
    slopes: tuple[int, ...]


def _pieces(whole: Line, speed: float, spin: float | None) -> _Pieces:
    """Return a line in pieces that cannot whirl between clamped ends at speeds up to a given one.

    Short pieces are taken together with their neighbours: the stiffness of one alone would drown that of the line in
    rounding. Hinges and what is held part them all the same.
    """
    square = speed**2
    slowing = max(square - 2.0 * _twist(speed, spin), 0.0)
    four = square * whole.mass * whole.length**4 / (500.0 * whole.bending)
    two = square * whole.mass * whole.length**2 * whole.shear / np.pi**2
    two = two + slowing * whole.rotary * whole.length**2 / (np.pi**2 * whole.bending)
    parts = np.sqrt((two + np.sqrt(two**2 + 4.0 * CLAMPED * four)) / (2.0 * CLAMPED))
    count = np.ceil(np.maximum(parts, 1.0))
    fine = divided(whole, count)
    still = {
        k for k in range(fine.beams + 1) if fine.slope_before(k) in fine.clamped or fine.slope_after(k) in fine.clamped
    }
    parting = {*fine.held, *fine.hinged, *still}
    # what the speed has cut short is as long as it can be
    least = min(SHORT * float(fine.place[-1]), float(np.min((whole.length / count)[count > 1.0], initial=np.inf)))
    first, size = [0], 0.0
    for k, long in enumerate(fine.length):
        if k and (k in parting or (size >= least and long >= least)):
            first.append(k)
            size = 0.0
        size += long
    nodes = (*first, fine.beams)
    place = {node: k for k, node in enumerate(nodes)}
    slopes = sorted({slope for node in nodes for slope in (fine.slope_before(node), fine.slope_after(node))})
    rough = line(
        np.diff(fine.place[list(nodes)]),
        1.0,
        1.0,
        hinged=tuple(place[k] for k in fine.hinged),
        held=tuple(place[k] for k in fine.held),
        clamped=tuple(slopes.index(k) for k in fine.clamped),
    )
    return _Pieces(fine, rough, tuple(first), nodes, tuple(slopes))


def dynamic_stiffness(whole: Line, speed: float, *, spin: float | None = None) -> Array:
    """Return the exact dynamic stiffness of a line that whirls, for what nothing holds at its nodes.

    whole: one line, without beams that are short beside it.
    speed [rad/s]: ω, not zero, and so low that no beam whirls between clamped ends.
    spin [rad/s]: Ω; as fast as it whirls when not given.
    Returns (f, f).
    """
    return _stiffness(_pieces(whole, speed, spin), speed, spin)[0]


def _stiffness(pieces: _Pieces, speed: float, spin: float | None) -> tuple[Array, int]:
    """Return the dynamic stiffness at the ends of what is taken together, and how many roots lie below within that."""
    fine, twist = pieces.fine, _twist(speed, spin)
    across = _across(fine, speed, twist)
    nodes = fine.spring - fine.lump * speed**2
    slopes = fine.tilt_spring + fine.polar * twist - fine.diametral * speed**2
    within = 0
    if len(pieces.first) < fine.beams:
        together = []
        for start, end in pairwise(pieces.nodes):
            part = across[start]
            for k in range(start + 1, end):
                stand = np.asarray([[nodes[k], 0.0], [0.0, slopes[fine.slope_before(k)]]])
                meet = _ends(part)[2:, 2:] + _ends(across[k])[:2, :2] + stand
                within += int(np.sum(np.linalg.eigvalsh(meet) < 0.0))
                jump = np.eye(4)
                jump[3, 0], jump[2, 1] = stand[0, 0], stand[1, 1]
                part = across[k] @ jump @ part
            together.append(part)
        across = np.stack(together)
    matrix = assembled(pieces.rough, _ends(across), nodes[list(pieces.nodes)], slopes[list(pieces.slopes)])
    return matrix, within


def _across(whole: Line, speed: float, twist: float) -> Array:
    """Return the transfer matrices of the beams for w, θ, M, V, array (e, 4, 4)."""
    h, stiff = whole.length, whole.bending
    load = whole.mass * speed**2 * h**4 / stiff
    # Lengths over h, couples over EI/h, forces over EI/h², and all in powers of what makes the entries alike.
    wave = np.maximum(load**0.25, 1.0)
    a = np.zeros((whole.beams, 4, 4))
    a[:, 0, 1] = a[:, 1, 2] = wave
    a[:, 0, 3] = wave**3 * stiff * whole.shear / h**2
    a[:, 2, 1] = whole.rotary * (2.0 * twist - speed**2) * h**2 / (stiff * wave)
    a[:, 2, 3] = -wave
    a[:, 3, 0] = -load / wave**3
    size = np.stack((h, wave, stiff * wave**2 / h, stiff * wave**3 / h**2), axis=-1)
    return _exponential(a) * size[:, :, None] / size[:, None, :]


def _ends(across: Array) -> Array:
    """Return the stiffness of beams for deflection and slope at both ends from their transfer matrices (..., 4, 4)."""
    here, there = across[..., :2, :2], across[..., 2:, :2]
    inverse = np.linalg.inv(across[..., :2, 2:])
    behind = across[..., 2:, 2:] @ inverse
    start = np.concatenate((inverse @ here, -inverse), axis=-1)
    end = np.concatenate((there - behind @ here, behind), axis=-1)
    # Force before couple, as deflection before slope.
    found = np.concatenate((start[..., ::-1, :], end[..., ::-1, :]), axis=-2)
    return 0.5 * (found + np.swapaxes(found, -1, -2))


def _exponential(matrix: Array) -> Array:
    """Return the exponential of small matrices (..., m, m), all at once: a Taylor series, squared."""
    halvings = max(int(np.ceil(np.log2(2.0 * np.max(np.sum(np.abs(matrix), axis=-1))))), 0)
    small = matrix / 2.0**halvings
    unit = np.eye(matrix.shape[-1])
    found = unit + small / TERMS
    for term in range(TERMS - 1, 0, -1):
        found = unit + small @ found / term
    for _square in range(halvings):
        found = found @ found
    return found


TERMS = 14
"""Terms of the series of an exponential: of a matrix with the norm ½ the rest is below 1e-16."""
