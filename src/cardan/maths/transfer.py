"""Exact whirl of lines of beams: transfer matrices of their sections, and a count of modes that misses none."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from .arrays import Array, ArrayLike
from .beam_elements import assembled, matrices
from .rotor_beams import Line, divided, rigid_motions

CLAMPED = 0.5
"""Pieces are so short that (speed over lowest frequency with both ends clamped)² stays below this."""

NARROW = 1.3
"""Ratio of the ends of a bracket from which on a root is polished instead of counted."""

CLOSE = 1e-3
"""Half the width of the bracket around a guess."""

PRECISE = 1e-13
"""Relative width within which a root is found."""


def speeds(whole: Line, count: int, *, spin: float | None = None, near: ArrayLike | None = None) -> Array:
    """Return the lowest natural speeds of a line in forward whirl, exactly and none missed.

    Parameters
    ----------
    whole : Line
        One line.
    count : int
        How many.
    spin : float [rad/s], optional
        Ω; 0 is at rest, negative against the whirl. As fast as it whirls when not given: these are critical speeds.
    near : array (count,) [rad/s], optional
        Where they are likely to be, which saves looking for them; wrong guesses do no harm.

    Returns
    -------
    array (count,) [rad/s]
        ω in rising order: a zero for each motion without bending, then the roots.

    Notes
    -----
    The state s = (w, θ, M, V) of each section follows from s' = A s by the matrix exponential,

        w' = θ + V/(κGA);  θ' = M/(EI);  M' = -V + ρI(2Ωω - ω²) θ;  V' = -ρAω² w.

    Solved for both ends, it is the section's dynamic stiffness, and the boundary determinant is that of the line. Over
    ω it falls with ω, so its negative eigenvalues count the roots below a speed (W. H. Wittrick and F. W. Williams,
    Q. J. Mech. Appl. Math. 24, 1971), provided that no piece can whirl between clamped ends. The count encloses root
    j; within, the j-th eigenvalue has its only zero.

    Examples
    --------
    >>> from cardan.maths.rotor_beams import line
    >>> (speeds(line(1.0, 1.0, 1.0, held=(0, 1)), 3) / np.pi**2).round(9)
    array([1., 4., 9.])
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
    """Return how many natural speeds of a line lie below a speed [rad/s]; see `speeds`.

    Examples
    --------
    >>> from cardan.maths.rotor_beams import line
    >>> beam = line(1.0, 1.0, 1.0, held=(0, 1))
    >>> [modes_below(beam, speed * np.pi**2) for speed in (0.99, 1.01, 4.01, 100.01)]
    [0, 1, 2, 10]
    """
    return int(np.sum(_spectrum(_fine(whole, speed, spin), spin)(speed) < 0.0))


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
    from scipy.optimize import brentq

    low, high = bracket
    spectrum = _spectrum(_fine(whole, high, spin), spin)

    def height(speed: float) -> float:
        return float(spectrum(speed)[number - 1])

    while height(low) <= 0.0:  # The root before coincides with this one: it is found within rounding.
        low *= 1.0 - 1e-9
    return float(brentq(height, low, high, xtol=PRECISE * high, rtol=PRECISE))


def _spectrum(fine: Line, spin: float | None) -> Callable[[float], Array]:
    """Return the function from a speed to the eigenvalues of the dynamic stiffness, in rising order."""
    scale = 1.0 / np.sqrt(np.diagonal(matrices(fine).stiffness))

    def eigenvalues(speed: float) -> Array:
        return np.linalg.eigvalsh(scale[:, None] * dynamic_stiffness(fine, speed, spin=spin) * scale)

    return eigenvalues


def _below_all(whole: Line, spin: float | None, sinking: int) -> float:
    """Return a speed below all roots that are not zero."""
    low = float(np.sqrt(np.max(whole.bending) / np.min(whole.mass))) / float(whole.place[-1]) ** 2
    while modes_below(whole, low, spin=spin) > sinking:
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


def _fine(whole: Line, speed: float, spin: float | None) -> Line:
    """Return the line in pieces that cannot whirl between clamped ends at speeds up to a given one."""
    square = speed**2
    slowing = max(square - 2.0 * _twist(speed, spin), 0.0)
    four = square * whole.mass * whole.length**4 / (500.0 * whole.bending)
    two = square * whole.mass * whole.length**2 * whole.shear / np.pi**2
    two = two + slowing * whole.rotary * whole.length**2 / (np.pi**2 * whole.bending)
    parts = np.sqrt((two + np.sqrt(two**2 + 4.0 * CLAMPED * four)) / (2.0 * CLAMPED))
    return divided(whole, np.ceil(np.maximum(parts, 1.0)))


def _twist(speed: float, spin: float | None) -> float:
    """Return Ωω, which moments of inertia about the line come with."""
    return speed * (speed if spin is None else spin)


def dynamic_stiffness(whole: Line, speed: float, *, spin: float | None = None) -> Array:
    """Return the exact dynamic stiffness of a line that whirls, array (f, f), for the unknowns that nothing holds.

    Parameters
    ----------
    whole : Line
        One line.
    speed : float [rad/s]
        ω, not zero and none at which a beam of the line whirls between clamped ends.
    spin : float [rad/s], optional
        Ω; as fast as it whirls when not given.

    Examples
    --------
    A beam on springs that hardly whirls is as stiff as they are:

    >>> from cardan.maths.rotor_beams import line
    >>> stiff = dynamic_stiffness(line(1.0, 1e6, 1.0, spring=[3.0, 0], clamped=(0, 1)), 1e-6)
    >>> print(np.sum(stiff).round(6))
    3.0
    """
    from scipy.linalg import expm

    h, stiff, twist = whole.length, whole.bending, _twist(speed, spin)
    a = np.zeros((whole.beams, 4, 4))
    # Lengths over h, couples over EI/h, forces over EI/h²: all entries are then of order one.
    a[:, 0, 1] = a[:, 1, 2] = 1.0
    a[:, 0, 3] = stiff * whole.shear / h**2
    a[:, 2, 1] = whole.rotary * (2.0 * twist - speed**2) * h**2 / stiff
    a[:, 2, 3] = -1.0
    a[:, 3, 0] = -whole.mass * speed**2 * h**4 / stiff
    across = expm(a)
    here, there = across[:, :2, :2], across[:, 2:, :2]
    inverse = np.linalg.inv(across[:, :2, 2:])
    behind = across[:, 2:, 2:] @ inverse
    start = np.concatenate((inverse @ here, -inverse), axis=-1)
    end = np.concatenate((there - behind @ here, behind), axis=-1)
    # Force before couple, as deflection before slope.
    found = np.concatenate((start[:, ::-1], end[:, ::-1]), axis=-2)
    one = np.ones_like(h)
    size = np.stack((one, h, one, h), axis=-1)
    found = (stiff / h**3)[:, None, None] * size[:, :, None] * size[:, None, :] * found
    found = 0.5 * (found + np.swapaxes(found, -1, -2))
    nodes = whole.spring - whole.lump * speed**2
    slopes = whole.tilt_spring + whole.polar * twist - whole.diametral * speed**2
    return assembled(whole, found, nodes, slopes)
