"""How near do the book's engineering formulas of torsional vibration come? Each by its number, to be compared with."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.errors import InputError, Problem, check
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.periodic.mathieu import exponents
from cardan.maths.periodic.mathieu_forced import ForcedSolution, forced
from cardan.texts import _
from cardan.units import rpm

RULE_Q, RULE_A, RULE_DISTANCE = 0.1, 0.1, 0.1
"""Limits of Book (237): largest q, least a, least distance of every order from ±β."""

RULE_ORDERS = (0.0, 1.0, 2.0)
"""Orders that (237) looks at besides those of the engine."""

TOO_FAR = 0.05
"""Share by which the simplified answer may miss the solved one before a warning."""


def book_half_trace(a: ArrayLike, q: ArrayLike) -> Array:
    """Return cos πβ by Book (208), for small q.

    Parameters
    ----------
    a, q : arrays (...)

    Returns
    -------
    array (...)

    Notes
    -----
    cos πβ ≈ cos π√a + π q² sin(π√a)/(4√a (a - 1)); at a = 1 its limit.

    Examples
    --------
    >>> print(book_half_trace([0.774, 1.0], 0.1))
    [-0.94408098 -1.01233701]
    """
    a, q = np.broadcast_arrays(np.asarray(a, dtype=float), np.asarray(q, dtype=float))
    s = np.sqrt(np.abs(a))
    turning = a >= 0.0
    near = -np.pi * np.sinc(s - 1.0) / (s * (s + 1.0) + (s == 0.0))
    far = np.where(turning, np.pi * np.sinc(s), np.sinh(np.pi * s) / np.where(s == 0.0, 1.0, s))
    share = np.where(turning & (s > 0.5), near, far / np.where(s == 1.0, 1.0, a - 1.0))
    return np.asarray(np.where(turning, np.cos(np.pi * s), np.cosh(np.pi * s)) + 0.25 * np.pi * q * q * share)


def book_beta(a: ArrayLike, q: ArrayLike) -> Array:
    """Return β by Book (225), β² ≈ a + q²/(2(1 - a)), array (...); nan unless 0 < a < 1 and β < 1.

    Parameters
    ----------
    a, q : arrays (...)

    Examples
    --------
    >>> print(f"{book_beta(0.774, 0.0066):.8f}")
    0.87982747
    """
    a, q = np.broadcast_arrays(np.asarray(a, dtype=float), np.asarray(q, dtype=float))
    inside = (a > 0.0) & (a < 1.0)
    square = a + q * q / (2.0 * np.where(inside, 1.0 - a, 1.0))
    inside &= square < 1.0
    return np.asarray(np.where(inside, np.sqrt(np.where(inside, square, 0.0)), np.nan))


def book_zone(q: ArrayLike, n: ArrayLike) -> tuple[Array, Array]:
    """Return the edges of the damped principal zone by Book (221), a = 1 ∓ √(q² - 4n²); nan where q < 2n.

    Parameters
    ----------
    q, n : arrays (...)

    Examples
    --------
    >>> lower, upper = book_zone(0.1, 0.03)
    >>> print(f"{lower:.4f} {upper:.4f}")
    0.9200 1.0800
    """
    rest = np.asarray(q, dtype=float) ** 2 - 4.0 * np.asarray(n, dtype=float) ** 2
    half = np.sqrt(np.where(rest >= 0.0, rest, np.nan))
    return 1.0 - half, 1.0 + half


@dataclass(frozen=True, eq=False, kw_only=True)
class Validity:
    """Whether the parametric term may be neglected, by the book's rule and by solving."""

    stable: bool  # whether steady running is stable
    beta: float  # characteristic exponent; nan where it is not
    order: Array  # (m,): forcing orders
    distance: Array  # (m,): of each from the nearest β + 2r or -β + 2r; nan where there is no β
    rule: bool  # whether Book (237) is met, orders 0, 1 and 2 included
    # solved, simple (m,): amplitude of each order's own response to a unit force: solved, and 1/|a - ν²|; infinite in
    # resonance
    solved: Array
    simple: Array  # (m,)
    side: Array  # (m,): largest amplitude at any other order

    @property
    def error(self) -> Array:
        """What neglecting the parametric term costs, a share of the simplified amplitude, array (m,)."""
        with np.errstate(invalid="ignore"):
            return np.asarray(np.maximum(np.abs(self.solved - self.simple), self.side) / self.simple)

    @property
    def too_far(self) -> bool:
        """Whether the simplified answer misses the solved one by more than 5 % at any order, or nothing is stable."""
        return not self.stable or bool(np.any(~(self.error <= TOO_FAR)))


def validity(a: float, q: float, order: ArrayLike) -> Validity:
    """Return whether the parametric term may be neglected.

    Parameters
    ----------
    a, q : float
        Parameters of Mathieu's equation.
    order : array (m,)
        Forcing orders.

    Returns
    -------
    Validity

    Raises
    ------
    InputError
        A value is out of range, or an order is negative: ``order[i]``.

    Notes
    -----
    Book (237): q ≤ 0.1, a > 0.1 and all orders, 0, 1 and 2 among them, 0.1 away from every ±β + 2r; "then the error is
    1-2 %". It is not: see `error`.

    Examples
    --------
    >>> found = validity(0.774, 0.0066, [0.0, 2.0, 6.8])
    >>> print(found.distance.round(4), found.rule, found.error.round(4), found.too_far)
    [0.8798 0.8798 0.0798] False [0.0041 0.0004 0.0003] False
    """
    orders = np.atleast_1d(np.asarray(order, dtype=float))
    text = _("{value} is not a finite number of at least 0")
    wrong = np.flatnonzero(~(np.isfinite(orders) & (orders >= 0.0)))
    check(Problem(f"order[{i}]", text.format(value=orders[i])) for i in wrong)
    found = exponents(a, q)
    beta = float(found.beta)
    distance = _distance(beta, orders)
    near = np.concatenate((distance, _distance(beta, np.asarray(RULE_ORDERS))))
    answer = [_response(a, q, float(nu)) for nu in orders]
    with np.errstate(divide="ignore"):
        simple = 1.0 / np.abs(a - orders**2)
    return Validity(
        stable=bool(found.stable),
        beta=beta,
        order=orders,
        distance=distance,
        rule=bool(abs(q) <= RULE_Q and a > RULE_A and np.all(near >= RULE_DISTANCE)),
        solved=np.asarray([own for own, _side in answer]),
        simple=simple,
        side=np.asarray([side for _own, side in answer]),
    )


def _distance(beta: float, order: Array) -> Array:
    """Return how far orders are from the nearest β + 2r or -β + 2r."""
    return np.asarray(np.minimum(*(np.abs(np.remainder(order + sign * beta + 1.0, 2.0) - 1.0) for sign in (1.0, -1.0))))


def _response(a: float, q: float, nu: float) -> tuple[float, float]:
    """Return the amplitudes of the own order and of the largest other one, under a unit force."""
    try:
        found = forced(a, q, order=[nu], amplitude=[1.0], phase=[0.5 * np.pi if nu == 0.0 else 0.0])
    except InputError:  # in resonance
        return np.inf, np.inf
    own = int(np.argmin(np.abs(found.order - nu)))
    others = np.delete(found.amplitude, own)
    return float(found.amplitude[own]), float(np.max(others, initial=0.0))


TRUCK = {
    "speed": 860.0 * rpm,
    "a": 0.774,
    "q": 0.0066,
    "sway": 0.0397,
    "constant": -0.0093,
    "engine": -0.00108,
    "order": 6.8,
    "phase": 25.0 / 180.0 * np.pi,
}
"""Printed numbers of the truck power unit, Book pp. 210-216: ω_1 [rad/s], a, q, Q_2, Q_1, Q_3, kξ, phase [rad]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class TruckExample:
    """The book's worked example, computed anew."""

    speed: float  # [rad/s]: ω_1
    natural_frequency: float  # [rad/s]: ω_e
    amplitude: float  # [rad]: s_41
    beta: float  # characteristic exponent
    solution: ForcedSolution  # steady twist y under the printed forcing

    @property
    def resonance_speed(self) -> float:
        """Speed of the forced resonance of second order, ω_e/2 [rad/s]."""
        return 0.5 * self.natural_frequency

    @property
    def principal_speed(self) -> float:
        """Speed of the principal zone, ω_e [rad/s]."""
        return self.natural_frequency


def truck_example(
    *,
    speed: float = TRUCK["speed"],
    a: float = TRUCK["a"],
    q: float = TRUCK["q"],
    sway: float = TRUCK["sway"],
) -> TruckExample:
    """Return the book's worked example, the power unit of a truck, computed anew.

    Parameters
    ----------
    speed : float [rad/s]
        ω_1; 860 rpm as printed.
    a, q : float
        Parameters of Mathieu's equation.
    sway : float
        Q_2 = a s_41.

    Returns
    -------
    TruckExample

    Raises
    ------
    InputError
        a or speed is not positive, or an order is in resonance.

    Notes
    -----
    Inertias and stiffnesses are not printed, so q cannot be computed anew; the printed one is taken.

    Examples
    --------
    >>> found = truck_example()
    >>> print(f"{found.speed ** 2:.2f} {found.natural_frequency:.1f} {found.amplitude:.5f} {found.beta:.7f}")
    8110.62 79.2 0.05129 0.8798275
    """
    check(Problem(name, _("needs to be positive")) for name, value in (("speed", speed), ("a", a)) if not value > 0.0)
    solution = forced(
        a,
        q,
        order=[0.0, 2.0, TRUCK["order"]],
        amplitude=[TRUCK["constant"], sway, TRUCK["engine"]],
        phase=[0.5 * np.pi, 0.0, TRUCK["phase"]],
    )
    return TruckExample(
        speed=speed,
        natural_frequency=float(np.sqrt(a)) * speed,
        amplitude=sway / a,
        beta=float(exponents(a, q).beta),
        solution=solution,
    )
