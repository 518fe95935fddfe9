"""Mathieu's equation y'' + 2n y' + (a - 2q cos 2z) y = 0: exponents, boundaries of stability, damped zones.

With u = y e^(nz) the damping goes into a' = a - n². Over the period π the solutions grow by e^(±iπβ), and half the
trace of the monodromy matrix, cos πβ, says all about stability. It is found from Hill's determinant, which falls into
four tridiagonal ones, one for each kind of periodic solution; so 1 - cos πβ and 1 + cos πβ are known each with its
own digits, and next to a boundary nothing cancels.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from cardan.errors import Problem, check
from cardan.maths.arrays import NUMBERS, Array, ArrayLike, namespace, real
from cardan.texts import _

LARGEST_Q, LEAST_A, LARGEST_A = 1e4, -1e4, 1e6
"""Range of the parameters: beyond, growth over a period leaves the range of numbers, or the rows become too many."""

ROWS, ROWS_A, ROWS_Q = 40.0, 10.0, 30.0
"""Last row of the determinants: the first number, or this multiple of √a, or this one of \\|q\\|^0.55."""

TAIL = 8
"""Terms in 1/r² of what lies beyond the last row."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Exponents:
    """How fast the solutions of Mathieu's equations turn and grow."""

    below: Array  # (...): 1 - cos πβ; negative in the zones with a period of π
    above: Array  # (...): 1 + cos πβ; negative in the zones with a period of 2π, the principal one among them
    damping: Array  # (...): n, per radian of z

    @property
    def half_trace(self) -> Array:
        """Half the trace, cos πβ, of the equation freed of its damping, array (...)."""
        xp = namespace(self.below)
        return xp.where(xp.abs(self.below) < xp.abs(self.above), 1.0 - self.below, self.above - 1.0)

    @property
    def beta(self) -> Array:
        """Characteristic exponent β in (0, 1), array (...); nan where \\|cos πβ\\| is not below 1."""
        xp = namespace(self.below)
        turning = (self.below > 0.0) & (self.above > 0.0)
        one, two = (xp.where(turning, part, 1.0) for part in (self.below, self.above))
        return xp.where(turning, (2.0 / xp.pi) * xp.atan2(xp.sqrt(one), xp.sqrt(two)), xp.nan)

    @property
    def growth(self) -> Array:
        """Rate of growth per radian of z, array (...); -n where the undamped equation is stable."""
        xp = namespace(self.below)
        least = xp.minimum(self.below, self.above)
        over = xp.where(least < 0.0, -least, 0.0)
        return (2.0 / xp.pi) * xp.asinh(xp.sqrt(0.5 * over)) - self.damping

    @property
    def stable(self) -> Array:
        """Whether nothing grows, array (...) of bool."""
        return self.growth <= 0.0

    @property
    def residual(self) -> Array:
        """How far the two forms of cos πβ are apart, a share of their size, array (...): a check of this answer."""
        xp = namespace(self.below)
        return xp.abs(self.below + self.above - 2.0) / (2.0 + xp.abs(self.below) + xp.abs(self.above))


def exponents(a: ArrayLike, q: ArrayLike, n: ArrayLike = 0.0) -> Exponents:
    """Return the exponents of y'' + 2n y' + (a - 2q cos 2z) y = 0.

    Parameters
    ----------
    a, q : arrays (...)
        Parameters; q and -q have the same exponents.
    n : array (...)
        Damping per radian of z.

    Returns
    -------
    Exponents
        arrays (...).

    Raises
    ------
    InputError
        A value is not finite or beyond `LARGEST_Q`, `LEAST_A`, `LARGEST_A`.

    Notes
    -----
    cos πβ = 1 - 2Δ(0) sin²(π√a'/2), a' = a - n² (Hill). With D_c, D_s of the rows r = 1, 3, 5 … and E_c, E_s of the
    rows 0, 2, 4 …, each r² - a' beside q and divided by r² - a', 1 + cos πβ = 2 cos²(π√a'/2) D_c D_s and
    1 - cos πβ = 2 sin²(π√a'/2) E_c E_s. The row next to a' is not divided; what it would be divided by goes to the
    sine. What lies beyond the last row is a series in its inverse.

    Examples
    --------
    >>> found = exponents([0.774, 1.0], [0.0132, 0.1])
    >>> print(found.half_trace, found.growth)
    [-0.9297672  -1.01233346] [0.         0.04994157]
    """
    xp = namespace(a, q, n)
    xp = np if xp is NUMBERS else xp
    a, q, n = (real(value, xp) for value in (a, q, n))
    check_range(a, q, n, xp)
    inner = a - n * n
    inner, q, n = xp.broadcast_arrays(inner, q, n)
    below = _half(inner, q, 0, xp)
    above = _half(inner, q, 1, xp)
    return Exponents(below=below, above=above, damping=n)


def check_range(a: Array, q: Array, n: Array, xp: Any) -> None:
    """Refuse parameters that are not finite or out of range."""

    def wrong(value: Array, low: float, high: float) -> bool:
        return not bool(xp.all((value >= low) & (value <= high)))

    text = _("needs to lie between {low:g} and {high:g}")
    limits = {"a": (a, LEAST_A, LARGEST_A), "q": (q, -LARGEST_Q, LARGEST_Q), "n": (n, -100.0, 100.0)}
    check(
        Problem(name, text.format(low=low, high=high))
        for name, (value, low, high) in limits.items()
        if wrong(value, low, high)
    )


def _half(a: Array, q: Array, odd: int, xp: Any) -> Array:
    """Return 1 + cos πβ from the rows 1, 3, 5 …, or 1 - cos πβ from the rows 0, 2, 4 …."""
    positive = a >= 0.0
    s = xp.sqrt(xp.abs(a))
    near = xp.where(positive, odd + 2.0 * xp.round(0.5 * xp.maximum(s - odd, 0.0 * s)), 1.0 * odd)
    gap = near * near - a
    last = float(xp.max(xp.abs(q))) ** 0.55 * ROWS_Q if q.size else 0.0
    last = max(ROWS, last, ROWS_A * math.sqrt(max(float(xp.max(a)), 0.0)) if q.size else 0.0)

    def row(r: float) -> tuple[Array, Array]:
        direct = r * r - a
        return direct, xp.where(near == r, 1.0, direct)

    square = (q * q)[None, ...]
    if odd:
        r = 1.0
        direct, by = row(r)
        before = xp.ones_like(xp.stack((a, a)))
        det = xp.stack((direct + q, direct - q)) / by
    else:
        r = 2.0
        first, by_first = row(0.0)
        direct, by = row(r)
        ones = xp.ones_like(a)
        before = xp.stack((first / by_first, ones))
        det = xp.stack((first * direct / (by_first * by) - 2.0 * q * q / (by_first * by), direct / by))
    while r < last:
        r += 2.0
        direct, by_next = row(r)
        det, before = det * (direct / by_next) - before * (square / (by * by_next)), det
        by = by_next
    product = det[0, ...] * det[1, ...] * xp.exp(2.0 * _beyond(r, a, q))
    return 2.0 * product * _front(s, near, gap, positive, odd, xp)


def _front(s: Array, near: Array, gap: Array, positive: Array, odd: int, xp: Any) -> Array:
    """Return sin² or cos² of π√a/2 over what the row next to a was not divided by, in both determinants."""
    both = xp.where(near == 0.0, 1.0, s + near)  # next to zero its own form serves: tiny s would overflow here
    x = 0.5 * math.pi * xp.where(positive, gap / both, 0.0)
    sinc = xp.where(x == 0.0, 1.0, xp.sin(x) / xp.where(x == 0.0, 1.0, x))
    close = (0.5 * math.pi * sinc / both) ** 2
    wide = xp.where(positive, 0.0, 0.5 * math.pi * s)
    if odd:
        return xp.where(positive, close, (xp.cosh(wide) / xp.where(positive, 1.0, gap)) ** 2)
    zero = s == 0.0
    size = xp.where(positive, xp.sin(0.5 * math.pi * xp.where(near == 0.0, s, 0.0)), xp.sinh(wide))
    about_zero = xp.where(zero, 0.5 * math.pi, size / xp.where(zero, 1.0, s)) ** 2
    return xp.where(near == 0.0, -about_zero, close)


def _beyond(r: float, a: Array, q: Array) -> Array:
    """Return the logarithm of what the rows beyond r multiply a determinant by.

    With x_r = q²/((r² - a)((r+2)² - a)) it is -Σ (x_r + x_r x_(r-2) + x_r²/2). In m = r + 1, x = q²/(m⁴ - 2(1+a) m² +
    (1-a)²) is a series in 1/m²; sums of powers by Euler and Maclaurin.
    """
    twice, square = 2.0 * (1.0 + a), (1.0 - a) ** 2
    before, term = 0.0 * a, 0.0 * a + 1.0
    total = 0.0 * a
    for k in range(TAIL):
        total = total + term * _power_sum(r, 4 + 2 * k)
        term, before = twice * term - square * before, term
    pairs = _power_sum(r - 1.0, 8) + (2.0 * twice + 4.0) * _power_sum(r - 1.0, 10)
    squares = _power_sum(r, 8) + 2.0 * twice * _power_sum(r, 10)
    return -q * q * total - q**4 * (pairs + 0.5 * squares)


def _power_sum(r: float, p: int) -> float:
    """Return Σ m^(-p) over m = r+1, r+3, r+5 ….

    >>> round(_power_sum(10.0, 4) * 1e6 - sum((11 + 2 * k) ** -4 for k in range(10**5)) * 1e6, 6)
    0.0
    """
    inner = 1.0 / (p - 1) - p / (6.0 * r**2) + 7.0 * p * (p + 1) * (p + 2) / (360.0 * r**4)
    inner -= 31.0 * p * (p + 1) * (p + 2) * (p + 3) * (p + 4) / (15120.0 * r**6)
    return 0.5 * inner * r ** (1 - p)


def boundaries(q: ArrayLike, order: int) -> tuple[Array, Array]:
    """Return the values of a at which the equation without damping has a periodic solution.

    Parameters
    ----------
    q : array (...)
    order : int
        N ≥ 0.

    Returns
    -------
    a_r : array (..., N + 1)
        a_0 … a_N.
    b_r : array (..., N)
        b_1 … b_N.

    Raises
    ------
    InputError
        q is not finite or beyond `LARGEST_Q`, or the order is below 0.

    Notes
    -----
    Solutions are bounded between a_r and b_(r+1), Book (198); for q > 0 the zones lie between b_r and a_r, with
    solutions of period π where r is even and 2π where it is odd. Eigenvalues of the four symmetric tridiagonal
    matrices of the Fourier coefficients. a_r(-q) = a_r(q) for even r, b_r(q) for odd r.

    Examples
    --------
    >>> a, b = boundaries(0.1, 2)
    >>> print(a, b)
    [-0.00499454  1.09873431  4.00416116] [0.89876556 3.9991667 ]
    """
    q = np.asarray(q, dtype=float)
    check([Problem("order", _("{given} is below 0").format(given=order))] if order < 0 else [])
    check_range(np.asarray(0.0), q, np.asarray(0.0), np)
    rows = order // 2 + 12 + math.ceil(1.3 * math.sqrt(float(np.max(np.abs(q), initial=0.0))))
    even, odd = (2.0 * np.arange(rows)) ** 2, (2.0 * np.arange(rows) + 1.0) ** 2
    a, b = np.empty((*q.shape, order + 1)), np.empty((*q.shape, order))
    a[..., 0::2] = _eigenvalues(even, q, first=math.sqrt(2.0))[..., : len(range(0, order + 1, 2))]
    a[..., 1::2] = _eigenvalues(odd, q, corner=1.0)[..., : len(range(1, order + 1, 2))]
    b[..., 0::2] = _eigenvalues(odd, q, corner=-1.0)[..., : len(range(1, order + 1, 2))]
    b[..., 1::2] = _eigenvalues(even[1:], q)[..., : len(range(2, order + 1, 2))]
    return a, b


def _eigenvalues(diagonal: Array, q: Array, *, corner: float = 0.0, first: float = 1.0) -> Array:
    """Return the eigenvalues (..., m) of tridiagonal matrices with q beside the diagonal, in rising order."""
    rows = np.arange(diagonal.size)
    matrix = np.zeros((*q.shape, rows.size, rows.size))
    matrix[..., rows, rows] = diagonal
    matrix[..., 0, 0] += corner * q
    matrix[..., rows[1:], rows[:-1]] = q[..., None] * np.where(rows[1:] == 1, first, 1.0)
    return np.linalg.eigvalsh(matrix)


PLACES, SECTIONS = 17, 12
"""Places at which a zone is looked at at a time, and how often the step beside an edge is divided so."""


def damped_zone(q: ArrayLike, n: ArrayLike, zone: int = 1) -> tuple[Array, Array]:
    """Return the edges of an unstable zone of the equation with damping.

    Parameters
    ----------
    q : array (...)
    n : array (...)
        Damping per radian of z, at least 0.
    zone : int
        1 is the principal zone, between b_1 and a_1 without damping.

    Returns
    -------
    lower, upper : arrays (...)
        Values of a; nan where damping leaves nothing of the zone.

    Raises
    ------
    InputError
        The zone is below 1, n is negative, or a value is out of range.

    Notes
    -----
    On an edge \\|cos πβ\\| = cosh πn, at a' = a - n². Found between b_r(q) and a_r(q), where \\|cos πβ\\| has one peak.

    Examples
    --------
    >>> lower, upper = damped_zone(0.1, 0.03)
    >>> print(lower.round(6), upper.round(6))
    0.918784 1.078717
    """
    check(
        [
            *([Problem("zone", _("{given} is below 1").format(given=zone))] if zone < 1 else []),
            *([Problem("n", _("needs to be at least 0"))] if bool(np.any(np.asarray(n) < 0.0)) else []),
        ]
    )
    q, n = np.broadcast_arrays(np.asarray(q, dtype=float), np.asarray(n, dtype=float))
    check_range(np.asarray(0.0), q, n, np)
    a, b = boundaries(np.abs(q), zone)
    low, wide = b[..., -1], a[..., -1] - b[..., -1]
    aim = 2.0 * np.sinh(0.5 * math.pi * n) ** 2

    def over(share: Array) -> Array:
        """Return \\|cos πβ\\| - cosh πn at shares (..., p) of the zone."""
        a, beside = np.broadcast_arrays(low[..., None] + wide[..., None] * share, q[..., None])
        check_range(a, beside, np.asarray(0.0), np)
        return -_half(a, beside, zone % 2, np) - aim[..., None]

    place = np.linspace(0.0, 1.0, PLACES)
    peak, step = np.full(q.shape, 0.5), np.ones(q.shape)
    for _round in range(4):
        around = np.clip(peak[..., None] + step[..., None] * (place - 0.5), 0.0, 1.0)
        peak = np.take_along_axis(around, np.argmax(over(around), axis=-1)[..., None], axis=-1)[..., 0]
        step = step * (2.0 / (PLACES - 1))
    there = (over(peak[..., None])[..., 0] > 0.0) | ((n == 0.0) & (wide >= 0.0))
    edges = []
    for end in (0.0, 1.0):
        outside, inside = np.full(q.shape, end), peak
        for _section in range(SECTIONS if bool(np.any(n > 0.0)) else 0):
            between = outside[..., None] + (inside - outside)[..., None] * place
            within = over(between) > 0.0
            within[..., 0], within[..., -1] = False, True
            first = np.argmax(within, axis=-1)[..., None]
            inside = np.take_along_axis(between, first, axis=-1)[..., 0]
            outside = np.take_along_axis(between, first - 1, axis=-1)[..., 0]
        share = np.where(n > 0.0, inside, end)
        edges.append(np.where(there, low + wide * share + n * n, np.nan))
    return edges[0], edges[1]


# Steady solution of Mathieu's equation under harmonic forcing, by harmonic balance.

TERMS = 15
"""Side bands on either side of a forcing order, beyond those that reach past nought and past √a."""

NOUGHT = 1e-200
"""Stiffness of a band that would be without any: its neighbour then rests, and the band answers in its stead."""

SAME = 1e-9
"""Orders nearer to one another than this are one."""

UNBOUNDED = 1e11
"""A response so many times the largest amplitude over the least stiffness is taken for a resonance."""


@dataclass(frozen=True, eq=False, kw_only=True)
class ForcedSolution:
    """A steady solution y = Im Σ C_ω e^(iωz)."""

    order: Array  # (k,): ω ≥ 0, rising
    coefficient: Array  # (..., k), complex: C_ω; purely imaginary where ω = 0

    @property
    def amplitude(self) -> Array:
        """Amplitude of each order, array (..., k)."""
        return np.abs(self.coefficient)

    @property
    def phase(self) -> Array:
        """Phase δ of each A sin(ωz + δ), array (..., k) [rad]."""
        return np.angle(self.coefficient)

    @property
    def mean(self) -> Array:
        """Mean of y, array (...)."""
        there = self.order < SAME
        return np.sum(np.where(there, self.coefficient.imag, 0.0), axis=-1)

    def at(self, z: ArrayLike) -> Array:
        """Return y at places (p,) [rad], array (..., p)."""
        wave = np.exp(1j * self.order[:, None] * np.asarray(z, dtype=float))
        return np.asarray((self.coefficient[..., None, :] @ wave)[..., 0, :].imag)


def forced(
    a: ArrayLike, q: ArrayLike, n: ArrayLike = 0.0, *, order: ArrayLike, amplitude: ArrayLike, phase: ArrayLike = 0.0
) -> ForcedSolution:
    """Return the steady solution of y'' + 2n y' + (a - 2q cos 2z) y = Σ Q sin(νz + δ).

    a, q, n (...): of one equation or many.
    order (m,): ν ≥ 0 of each forcing term; 0 is a constant Q sin δ.
    amplitude, phase (m,): Q, and δ [rad].
    Returns ForcedSolution: of all orders ν ± 2r.
    For each ν, (a - ω² + 2inω) Y_ω - q (Y_(ω+2) + Y_(ω-2)) = Q e^(iδ) where ω = ν, else 0, with ω = ν + 2r. Book
    (200)-(204) finds the same by variation of parameters.
    """
    a, q, n = np.broadcast_arrays(*(np.asarray(value, dtype=float) for value in (a, q, n)))
    check_range(a, q, n, np)
    order = np.atleast_1d(np.asarray(order, dtype=float))
    force = np.broadcast_to(np.asarray(amplitude) * np.exp(1j * np.asarray(phase, dtype=float)), order.shape)
    text = _("{value} is not a finite number of at least 0")
    check(
        Problem(f"order[{i}]", text.format(value=value))
        for i, value in enumerate(order)
        if not (math.isfinite(value) and value >= 0.0)
    )
    wide = math.sqrt(max(float(np.max(np.abs(a) + 2.0 * np.abs(q), initial=0.0)), 0.0))
    found: list[tuple[float, Array]] = []
    for i, nu in enumerate(order):
        reach = TERMS + math.ceil(0.5 * (nu + wide))
        omega = nu + 2.0 * np.arange(-reach, reach + 1)
        y = _bands(a, q, n, omega, reach)
        if not np.all(np.abs(y) < UNBOUNDED / max(1.0, wide) ** 2):
            text = _("order {order:g} is in resonance: without damping nothing bounds the vibration")
            check([Problem(f"order[{i}]", text.format(order=nu))])
        for k, w in enumerate(omega):
            part = force[i] * y[..., k]
            found.append((w, part) if w >= 0.0 else (-w, -np.conj(part)))
    found.sort(key=lambda row: row[0])
    orders: list[float] = []
    sums: list[Array] = []
    for w, part in found:
        if orders and w - orders[-1] < SAME:
            sums[-1] = sums[-1] + part
        else:
            orders.append(w)
            sums.append(part)
    coefficient = np.stack(sums, axis=-1) if sums else np.zeros((*a.shape, 0), dtype=complex)
    if orders and orders[0] < SAME:
        coefficient[..., 0] = 1j * coefficient[..., 0].imag
    return ForcedSolution(order=np.asarray(orders), coefficient=coefficient)


def _bands(a: Array, q: Array, n: Array, omega: Array, middle: int) -> Array:
    """Return the answer (..., k) of all bands to a unit force on the middle one, by sweeps from both ends.

    A band beyond the middle answers its inner neighbour by q over what is left of its stiffness.
    """
    direct = a[..., None] - omega**2 + (2j * n[..., None] * omega if np.any(n) else 0.0)
    share = np.zeros(direct.shape, dtype=direct.dtype)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        for k in (*range(middle), *range(omega.size - 1, middle, -1)):
            outer = k - 1 if k < middle else k + 1
            beyond = share[..., outer] if 0 <= outer < omega.size else 0.0
            left = direct[..., k] - q * beyond
            share[..., k] = q / np.where(left == 0.0, NOUGHT, left)
        y = np.empty(direct.shape, dtype=direct.dtype)
        y[..., middle] = 1.0 / (direct[..., middle] - q * (share[..., middle - 1] + share[..., middle + 1]))
        for k in range(middle - 1, -1, -1):
            y[..., k] = share[..., k] * y[..., k + 1]
        for k in range(middle + 1, omega.size):
            y[..., k] = share[..., k] * y[..., k - 1]
    return y
