"""How near do the book's engineering formulas of torsional vibration come? Each by its number, to be compared with."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.errors import InputError, Problem, check
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.periodic.mathieu import ForcedSolution, exponents, forced
from cardan.texts import _
from cardan.units import rpm

from .mathieu_drive import MathieuReduction

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
    *, speed: float = TRUCK["speed"], a: float = TRUCK["a"], q: float = TRUCK["q"], sway: float = TRUCK["sway"]
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
    orders, sizes = [0.0, 2.0, TRUCK["order"]], [TRUCK["constant"], sway, TRUCK["engine"]]
    solution = forced(a, q, order=orders, amplitude=sizes, phase=[0.5 * np.pi, 0.0, TRUCK["phase"]])
    return TruckExample(
        speed=speed,
        natural_frequency=float(np.sqrt(a)) * speed,
        amplitude=sway / a,
        beta=float(exponents(a, q).beta),
        solution=solution,
    )


# What torque does the last shaft take? The book's engineering formulas, and Mathieu's equation solved beside them.


@dataclass(frozen=True, eq=False, kw_only=True)
class EngineeringTorque:
    """Torque in the last shaft by Book (246), the parametric term neglected."""

    mean: float  # [N·m]: its mean, without sign
    order2: float  # [N·m]: amplitude of second order, from the joints
    drive: Array  # drive, load (m,) [N·m]: amplitudes of the orders of the drive torque and of the load
    load: Array  # (m,) [N·m]
    speed: float  # [rad/s]: ω_1 that belongs to a


def engineering_torque(
    *,
    stiffness: float,
    amplitude: float,
    a: float,
    first_inertia: float,
    last_inertia: float,
    mean: float,
    drive_order: ArrayLike = (),
    drive_torque: ArrayLike = (),
    load_order: ArrayLike = (),
    load_torque: ArrayLike = (),
) -> EngineeringTorque:
    """Return the torque in the last shaft by the book's formula for sizing.

    Parameters
    ----------
    stiffness : float [N·m/rad]
        c of all springs in a row.
    amplitude : float [rad]
        s_n1 of the joints.
    a : float
        (ω_e/ω_1)².
    first_inertia, last_inertia : float [kg m²]
        J_1, J_(n+1).
    mean : float [N·m]
        Mean torque.
    drive_order, load_order : arrays (m,)
        Orders of the harmonics per turn of shaft 1.
    drive_torque, load_torque : arrays (m,) [N·m]
        Their amplitudes, on J_1 and on J_(n+1).

    Returns
    -------
    EngineeringTorque

    Raises
    ------
    InputError
        a is not positive, or an order is in resonance.

    Notes
    -----
    Book (246): 4cs/\\|a - 4\\| of the joints, (J_0/J_1) M_k a/\\|a - k²ξ²\\| of each harmonic of the drive, J_0/J_(n+1)
    for those of the load. For sizing, not for proof: first order in tan²(α/2), no damping, no inertia between the ends.

    Examples
    --------
    >>> found = engineering_torque(stiffness=900.0, amplitude=0.0513, a=0.774, first_inertia=2.0, last_inertia=0.64,
    ...                            mean=150.0, drive_order=[6.8], drive_torque=[72.0])
    >>> print(f"{found.order2:.3f} {found.drive[0]:.4f} {found.speed:.3f}")
    57.247 0.2971 48.972
    """
    orders = {"drive_order": np.asarray(drive_order, dtype=float), "load_order": np.asarray(load_order, dtype=float)}
    text = _("order {order:g} is in resonance: without damping nothing bounds the torque")
    positive = {"a": a, "stiffness": stiffness, "first_inertia": first_inertia, "last_inertia": last_inertia}
    check(
        [
            *(Problem(name, _("needs to be positive")) for name, value in positive.items() if not value > 0.0),
            *([Problem("a", text.format(order=2.0))] if a == 4.0 and amplitude else []),
            *(
                Problem(f"{name}[{k}]", text.format(order=value))
                for name, values in orders.items()
                for k, value in enumerate(values)
                if value * value == a
            ),
        ]
    )
    inertia = first_inertia * last_inertia / (first_inertia + last_inertia)
    drive, load = (
        np.abs(np.asarray(torque, dtype=float)) * inertia / own * a / np.abs(a - orders[name] ** 2)
        for name, torque, own in (
            ("drive_order", drive_torque, first_inertia),
            ("load_order", load_torque, last_inertia),
        )
    )
    order2 = 4.0 * stiffness * abs(amplitude) / abs(a - 4.0) if amplitude else 0.0
    speed = float(np.sqrt(stiffness / (inertia * a)))
    return EngineeringTorque(mean=abs(mean), order2=order2, drive=drive, load=load, speed=speed)


@dataclass(frozen=True, eq=False, kw_only=True)
class TorqueCourse:
    """Torque in the last shaft over a turn, by the book's formulas and solved; positive as it carries power on."""

    angle: Array  # (p,) [rad]: φ of shaft 1, its mean
    simple: Array  # (p,) [N·m]: Book (246): the parametric term neglected
    book: Array  # (p,) [N·m]: Book (245) with y solved for the book's q
    solved: Array  # (p,) [N·m]: with y solved for the true q, the joints where the twist takes them

    @property
    def worst(self) -> float:
        """Largest difference of simple and solved, a share of the largest torque."""
        return float(np.max(np.abs(self.simple - self.solved)) / np.max(np.abs(self.solved)))

    @property
    def too_far(self) -> bool:
        """Whether the simplified torque misses the solved one by more than 5 %."""
        return self.worst > TOO_FAR


def torque_course(reduction: MathieuReduction, angle: ArrayLike, mean: float) -> TorqueCourse:
    """Return the torque in the last shaft over a turn, by the book's formulas and solved.

    Parameters
    ----------
    reduction : MathieuReduction
        The drive.
    angle : array (p,) [rad]
        φ.
    mean : float [N·m]
        Constant drive torque, and load.

    Returns
    -------
    TorqueCourse

    Raises
    ------
    InputError
        Order 0 or 2 is in resonance.

    Notes
    -----
    Book (196): y'' + (a - 2q cos 2(φ + δ_0)) y = Q_1 + a s sin 2(φ + δ_1), Q_1 = -mean/(J_0 ω_1²). (245): the torque
    -c (y - A sin 2φ - B cos 2φ)/(1 + cD cos 2φ - cF sin 2φ). In the solved form φ is the angle of the common centre of
    inertia, and cD, cF come from σ_k + κ_k instead of σ_k, as the twist moves the joints.

    Examples
    --------
    >>> from cardan.book.mathieu_drive import mathieu_reduction
    >>> values = {"first_inertia": 1.0, "last_inertia": 0.4, "speed": 80.0}
    >>> red = mathieu_reduction([0.35], [0.0], [1000.0, 4000.0], **values)
    >>> found = torque_course(red, np.linspace(0.0, np.pi, 181), 40.0)
    >>> print(f"{np.ptp(found.simple):.2f} {np.ptp(found.solved):.2f} {found.too_far}")
    56.16 56.82 True
    """
    phi = np.asarray(angle, dtype=float)
    c, a, s = reduction.stiffness, reduction.a, reduction.amplitude
    constant = -mean / (reduction.inertia * reduction.speed**2)
    shift, angle_error = reduction.wave_phase, reduction.forcing_phase
    sway = (reduction.forcing * np.exp(2j * phi)).imag

    def twist(q: float) -> Array:
        phases = [0.5 * np.pi, 2.0 * (angle_error - shift)]
        found = forced(a, q, order=[0.0, 2.0], amplitude=[constant, a * s], phase=phases)
        return found.at(phi + shift)

    moved = 2.0 * np.sum(reduction.arms * (reduction.share + reduction.off_node))
    return TorqueCourse(
        angle=phi,
        simple=-c * (twist(0.0) - sway),
        book=-c * (twist(reduction.q_book) - sway) / (1.0 + c * (reduction.play * np.exp(2j * phi)).real),
        solved=-c * (twist(reduction.q) - sway) / (1.0 + (moved * np.exp(2j * phi)).real),
    )
