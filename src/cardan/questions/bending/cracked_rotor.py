"""How does a shaft with a crack whirl? A heavy disc amid a shaft whose stiffness turns and breathes, out of balance.

At a steady speed the motion repeats with the turn; its orders are the marks of the crack. The same stiffness can make
every such motion unstable, about twice the critical speed at half the order.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache

import numpy as np

from cardan.errors import Problem, check
from cardan.formulas.run_up import Progress, negative, not_finite, not_positive
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.periodic.floquet import monodromy
from cardan.maths.periodic.turning_spring import energy_slope, hump, hump_coefficients, matrices, orbit
from cardan.texts import _

# What does a crack take from a shaft? Its section, and how it opens and closes as the shaft turns under its weight.

MOST_POWER = 1000
"""Highest power of the law of breathing."""


def _bad_power(power: int, name: str = "breathing") -> list[Problem]:
    if power == int(power) and 0 <= power <= MOST_POWER:
        return []
    text = _("needs to be a whole number from 0 to {most}").format(most=MOST_POWER)
    return [Problem(name, text, "out_of_range")]


@dataclass(frozen=True, kw_only=True, slots=True)
class Crack:
    """A crack that opens and closes once a turn.

    Attributes
    ----------
    loss_xi : float
        Δ_ξ: share of its stiffness that the shaft loses along the crack's direction when the crack is open, in [0, 1).
    loss_eta : float
        Δ_η: the same across it.
    breathing : int
        m of the law f(θ) = cos^(2m)(θ/2), 1 where it is open (θ = 0: the crack on the side in tension). 1 is the law of
        Mayes, more a crack that opens for a shorter part of the turn, 0 one that is always open.
    """

    loss_xi: float
    loss_eta: float
    breathing: int = 1

    def __post_init__(self) -> None:
        """Refuse values out of range."""
        problems = [
            Problem(name, _("needs to be at least 0 and below 1"), "out_of_range")
            for name, loss in (("loss_xi", self.loss_xi), ("loss_eta", self.loss_eta))
            if not 0.0 <= loss < 1.0
        ]
        check(problems + _bad_power(self.breathing))

    @property
    def losses(self) -> tuple[float, float]:
        """Both losses, along the crack and across it."""
        return self.loss_xi, self.loss_eta

    @property
    def coefficients(self) -> Array:
        """Return a_0 … a_m of the law as a sum of cosines, array (m+1,)."""
        return hump_coefficients(self.breathing)

    def opening(self, unit: Array) -> tuple[Array, Array]:
        """Return how far the crack is open at e^(iθ) and the slope of that by θ [1/rad], arrays (...)."""
        return hump(unit, self.breathing)


UNCRACKED = Crack(loss_xi=0.0, loss_eta=0.0)
"""A sound shaft."""


def crack_section(radius: ArrayLike, depth_ratio: ArrayLike) -> CutCircle:
    """Return the section that a straight-fronted crack leaves of a round solid shaft.

    Parameters
    ----------
    radius : array (...) [m]
        R.
    depth_ratio : array (...)
        δ = h/R, depth of the crack over the radius, in [0, 2).

    Returns
    -------
    CutCircle
        Its ``loss_x`` is that of bending in the crack's direction (Δ_ξ), ``loss_y`` of bending across it (Δ_η).

    Raises
    ------
    InputError
        A radius that is not positive, a depth out of range.

    Notes
    -----
    Article on the cracked Cardan shaft (17)-(19). The losses are those of this one section; the article takes them for
    the whole shaft, which far overstates one crack. A single crack adds a local compliance only.

    Examples
    --------
    >>> found = crack_section(5e-3, 0.45)
    >>> print(f"{found.loss_x:.4f} along the crack, {found.loss_y:.4f} across it")
    0.4459 along the crack, 0.1004 across it
    """
    r, high = np.asarray(radius, dtype=float), np.asarray(depth_ratio, dtype=float)
    problems = []
    if not np.all(np.isfinite(r) & (r > 0.0)):
        problems.append(Problem("radius", _("needs to be positive and finite"), "not_positive"))
    if not np.all((high >= 0.0) & (high < 2.0)):
        problems.append(Problem("depth_ratio", _("needs to be at least 0 and below 2"), "out_of_range"))
    check(problems)
    return cut_circle(r, high)


def breathing_law(power: int) -> Array:
    """Return the law of breathing cos^(2m)(θ/2) as a sum of cosines.

    Parameters
    ----------
    power : int
        m, at least 0.

    Returns
    -------
    array (m+1,)
        a_0 … a_m of a_0 + Σ a_j cos jθ.

    Raises
    ------
    InputError
        m out of range.

    Notes
    -----
    Article (21): a_0 = C(2m, m)/4^m, a_j = 2 C(2m, m-j)/4^m.

    Examples
    --------
    >>> breathing_law(1)
    array([0.5, 0.5])
    """
    check(_bad_power(power, "power"))
    return hump_coefficients(power)


GRAVITY = 9.81
"""g [m/s²]."""

SLOWEST = 1e-3
"""Slowest speed over the critical one; the orders up to the resonance are all counted."""

NEUTRAL = 1e-9
"""How far a multiplier may be beyond 1, and how near to 1, for the motion to be unstable, and not to be one."""

AT_ONCE = 32
"""Speeds taken together."""

PHASE = 0.5
"""Largest phase of the free swing in a step of the monodromy matrix."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CrackedRotor:
    """Steady whirling of a cracked, unbalanced shaft, X down, Y 90° ahead in the sense of rotation."""

    mass: float  # [kg]: m
    stiffness: float  # [N/m]: k_0 of the sound shaft
    damping_ratio: float  # ζ
    crack: Crack  # losses and law of breathing
    unbalance: float  # [kg·m]: m_u e
    speed: Array  # (...) [rad/s]: Ω
    order: Array  # (N,) of int: n; negative ones run backward
    # (..., N) [m], complex: Z_n of X + iY = Σ Z_n e^(inΩt), the crack down at t = 0; nan where a multiplier is 1
    amplitude: Array
    left_out: Array  # (...) [m]: largest amplitude of an order not given
    multiplier: Array  # (..., 4), complex: what a small disturbance is multiplied by in a turn
    # (...): what damping takes, against what unbalance and drive put in, over the sum of both; and how far the
    # multipliers are from their exact product e^(-8πζω_0/Ω), where that is no smaller than 1e-6
    residual: Array
    cancelled: bool = False  # whether ``progress`` stopped the work; what was not computed is nan

    @property
    def natural_frequency(self) -> float:
        """Critical speed of the sound shaft, ω_0 [rad/s]."""
        return math.sqrt(self.stiffness / self.mass)

    @property
    def spectral_radius(self) -> Array:
        """Largest size of a multiplier, array (...)."""
        return np.max(np.abs(self.multiplier), axis=-1)

    @property
    def stable(self) -> Array:
        """Whether disturbances do not grow, array of bool (...)."""
        return self.spectral_radius <= 1.0 + NEUTRAL

    @property
    def half_order(self) -> Array:
        """Whether what grows changes its sign every turn, so that orders ½, 1½ … appear, array of bool (...)."""
        largest = np.take_along_axis(self.multiplier, np.argmax(np.abs(self.multiplier), axis=-1)[..., None], -1)[
            ..., 0
        ]
        return ~self.stable & (largest.real < 0.0) & (np.abs(largest.imag) < 1e-6 * np.abs(largest))

    @property
    def resonant(self) -> Array:
        """Whether there is no steady motion, as a multiplier is 1, array of bool (...)."""
        return np.isnan(self.amplitude.real).any(axis=-1) & ~np.isnan(self.multiplier.real).any(axis=-1)

    @property
    def vibration_share(self) -> Array:
        """Sum of the amplitudes of all orders but 0 over what stands still, array (...).

        The law of breathing holds where this is well below 1: there the weight opens and closes the crack.
        """
        size = np.abs(self.amplitude)
        still = self.order_amplitude(0)
        found: Array = (np.sum(size, axis=-1) - still) / np.where(still > 0.0, still, np.nan)
        return found

    def order_amplitude(self, order: int) -> Array:
        """Return \\|Z_n\\| of one order [m], array (...)."""
        found: Array = np.abs(self.amplitude[..., int(np.flatnonzero(self.order == order)[0])])
        return found

    def at(self, angle: ArrayLike) -> Array:
        """Return X + iY [m] at angles of the crack (p,) [rad] from the vertical, complex array (..., p): the orbit."""
        wave = np.exp(1j * self.order[:, None] * np.asarray(angle, dtype=float))
        found: Array = self.amplitude @ wave
        return found

    def torque(self, angle: ArrayLike) -> Array:
        """Return the torque [N·m] that the crack asks of the drive at angles (p,) [rad], array (..., p): ½ zᵀK'z."""
        unit = np.exp(1j * np.asarray(angle, dtype=float))
        share, slope = self.crack.opening(unit)
        return self.stiffness * energy_slope(self.at(angle), unit, share, slope, self.crack.losses)


def cracked_rotor(
    mass: float,
    stiffness: float,
    speed: ArrayLike,
    *,
    crack: Crack = UNCRACKED,
    damping_ratio: float = 0.0,
    unbalance: float = 0.0,
    unbalance_phase: float = 0.0,
    gravity: float = GRAVITY,
    orders: int = 16,
    progress: Progress | None = None,
) -> CrackedRotor:
    """Return the steady whirling of a shaft with a breathing crack and an unbalance, and whether it is stable.

    Parameters
    ----------
    mass : float [kg]
        m of the disc.
    stiffness : float [N/m]
        k_0 of the sound shaft, at the disc.
    speed : array (...) [rad/s]
        Ω.
    crack : Crack, optional
        None by default.
    damping_ratio : float
        ζ, c = 2ζ√(k_0 m).
    unbalance : float [kg·m]
        m_u e.
    unbalance_phase : float [rad]
        χ, by which the unbalance is ahead of the crack.
    gravity : float [m/s²]
        g across the shaft.
    orders : int
        How many orders are given, forward and backward.
    progress : function, optional
        Told the share of the speeds done; when it answers "stop" the work ends.

    Returns
    -------
    CrackedRotor

    Raises
    ------
    InputError
        Values out of range.

    Notes
    -----
    m z̈ + c ż + K(θ) z = m g + m_u e Ω² e^(i(θ+χ)), θ = Ωt, with K of `periodic.turning_spring`. Linear, so the
    orders are one banded system, without integration and exact to rounding. The crack breathes by the weight: what
    bends it down is to be much more than it vibrates.

    Examples
    --------
    At half the critical speed the crack shows by order 2:

    >>> crack = Crack(loss_xi=0.1, loss_eta=0.02)
    >>> found = cracked_rotor(0.617, 18875.0, [60.0, 87.45], crack=crack, damping_ratio=0.02)
    >>> print((1e6 * found.order_amplitude(2)).round(2), found.stable)
    [ 12.86 136.75] [ True  True]
    """
    problems = not_positive({"mass": mass, "stiffness": stiffness})
    omega = math.sqrt(stiffness / mass) if not problems else math.nan
    turning = np.asarray(speed, dtype=float)
    slow = not problems and bool(np.any(turning < SLOWEST * omega * (1.0 - 1e-12)))
    if slow or not np.all(np.isfinite(turning) & (turning > 0.0)):
        text = _("needs to be finite and at least a thousandth of the critical speed")
        problems.append(Problem("speed", text, "not_positive" if np.any(turning <= 0.0) else "out_of_range"))
    problems += negative({"damping_ratio": damping_ratio, "unbalance": unbalance, "gravity": gravity})
    problems += not_finite({"unbalance_phase": unbalance_phase})
    if orders < 4:
        problems.append(Problem("orders", _("needs to be at least 4"), "out_of_range"))
    check(problems)
    ratio = turning.ravel() / omega
    order = np.arange(-orders, orders + 1)
    multiplier = np.full((ratio.size, 4), complex(math.nan, math.nan))
    amplitude = np.full((ratio.size, order.size), complex(math.nan, math.nan))
    left_out, missed = np.full(ratio.size, math.nan), np.full(ratio.size, math.nan)
    cancelled = False
    for first in range(0, ratio.size, AT_ONCE):
        some = slice(first, min(first + AT_ONCE, ratio.size))
        multiplier[some] = _multipliers(ratio[some], damping_ratio, crack)
        for k in range(some.start, some.stop):
            eta, values = float(ratio[k]), multiplier[k]
            spun = unbalance / mass * eta**2 * complex(math.cos(unbalance_phase), math.sin(unbalance_phase))
            z = orbit(eta, damping_ratio, crack.coefficients, crack.losses, gravity / omega**2, spun)
            if np.min(np.abs(values - 1.0)) < NEUTRAL:
                z = np.full_like(z, complex(math.nan, math.nan))
            amplitude[k], left_out[k] = _kept(z, orders)
            gap = _power_gap(z, eta, damping_ratio, crack, spun)
            missed[k] = max(gap, _product_gap(values, damping_ratio / eta))
        if progress is not None and progress(some.stop / ratio.size) == "stop":
            cancelled = some.stop < ratio.size
            break
    outer = turning.shape
    return CrackedRotor(
        mass=float(mass),
        stiffness=float(stiffness),
        damping_ratio=float(damping_ratio),
        crack=crack,
        unbalance=float(unbalance),
        speed=turning,
        order=order,
        amplitude=amplitude.reshape(*outer, order.size),
        left_out=left_out.reshape(outer),
        multiplier=multiplier.reshape(*outer, 4),
        residual=missed.reshape(outer),
        cancelled=cancelled,
    )


def _multipliers(ratio: Array, damping: float, crack: Crack) -> Array:
    """Return the multipliers over a turn, complex array (B, 4)."""
    along = ratio[:, None, None, None]

    def coefficients(share: Array) -> tuple[Array, Array, Array]:
        angle = 2.0 * np.pi * share
        spring = matrices(angle, crack.opening(np.exp(1j * angle))[0], crack.losses)
        one = np.ones((ratio.size, share.size, 1, 1))
        return (one * along**2)[..., 0] * np.ones(2), one * (2.0 * damping * along) * np.eye(2), one * spring

    fastest = max(1.0, 2.0 * damping) / float(np.min(ratio))
    steps = max(24, math.ceil(2.0 * np.pi * fastest / PHASE), math.ceil(12.0 * math.sqrt(crack.breathing)))
    found: Array = np.linalg.eigvals(monodromy(coefficients, np.full(ratio.size, 2.0 * np.pi), steps=steps))
    return found


def _kept(z: Array, orders: int) -> tuple[Array, float]:
    """Return the orders from -orders to orders, and the largest of the others."""
    middle = len(z) // 2 - 1
    inside = np.arange(middle - orders, middle + orders + 1)
    there = (inside >= 0) & (inside < len(z))
    row = np.zeros(inside.size, dtype=complex)
    row[there] = z[inside[there]]
    rest = np.delete(np.abs(z), inside[there])
    return row, float(np.max(rest, initial=0.0))


def _power_gap(z: Array, ratio: float, damping: float, crack: Crack, spun: complex) -> float:
    """Return what the powers, over k_0 Ω, do not balance, over their sum."""
    if np.isnan(z.real).any():
        return math.nan
    order = np.arange(len(z)) - (len(z) // 2 - 1)
    count = 1 << math.ceil(math.log2(2 * len(z) + 2 * crack.breathing + 8))
    unit = np.exp(2j * np.pi * np.arange(count) / count)
    spectrum = np.zeros(count, dtype=complex)
    spectrum[order % count] = z
    curve = count * np.fft.ifft(spectrum)
    share, slope = crack.opening(unit)
    asked = energy_slope(curve, unit, share, slope, crack.losses)
    lost = 2.0 * damping * ratio * float(np.sum((order * np.abs(z)) ** 2))
    spent = float(np.real(spun * np.conj(1j * z[order == 1][0])))
    scale = lost + abs(spent) + float(np.mean(np.abs(asked))) + 1e-4 * float(np.max(np.abs(z))) ** 2
    return abs(lost - spent - float(np.mean(asked))) / scale if scale else 0.0


def _product_gap(values: Array, decay: float) -> float:
    """Return how far the multipliers are from their product, where it is not too small to compare."""
    exact = math.exp(-8.0 * math.pi * decay)
    return float(abs(np.prod(values) / exact - 1.0)) if exact >= 1e-6 else 0.0


# A circle with a segment cut off: area, centroid and second moments of what remains.

NODES = 24
"""Points of Gauss's rule; the powers of sine and cosine below are exact with them to rounding."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CutCircle:
    """What remains of circles, the y axis through the middle of the chord, the segment beyond it away."""

    area: Array  # (...): of the rest
    shift: Array  # (...): from the centre of the circle to the centroid of the rest, away from the chord
    second_x: Array  # (...): ∫y² dA about the centre of the circle
    second_y: Array  # (...): ∫x² dA, about the centre and about the centroid
    second_x_centroid: Array  # (...): ∫y² dA about the centroid
    # loss_x, loss_y (...): shares by which the moments about the centroid are below that of the whole circle
    loss_x: Array
    loss_y: Array  # (...)


def cut_circle(radius: ArrayLike, depth: ArrayLike) -> CutCircle:
    """Return area, centroid and second moments of circles with a segment cut off.

    radius (...): R; depth (...): height of the segment over the radius, in [0, 2).
    Returns CutCircle: in the unit of the radius and its powers.
    With y = R cos t the chord lies at cos t = 1 - depth, a strip has the area 2R² sin² t dt, and every quantity is an
    integral of a positive function over t, by Gauss's rule: nothing cancels, whether the segment is almost nothing or
    almost all.
    """
    r, high = np.broadcast_arrays(np.asarray(radius, dtype=float), np.asarray(depth, dtype=float))
    edge = 2.0 * np.arcsin(np.sqrt(0.5 * high))
    node, weight = _rule()
    away, stay = edge[..., None] * node, np.pi + (edge[..., None] - np.pi) * node
    cut, kept = edge[..., None] * weight, (np.pi - edge[..., None]) * weight

    def total(values: Array, width: Array) -> Array:
        found: Array = np.sum(values * width, axis=-1)
        return found

    sine = np.sin(stay)
    area = total(2.0 * sine**2, kept)
    shift = 2.0 * np.sin(edge) ** 3 / (3.0 * area)
    second_y = total(sine**4, kept) * 2.0 / 3.0
    second_x = total(2.0 * (sine * np.cos(stay)) ** 2, kept)
    centred = total(2.0 * ((np.cos(stay) + shift[..., None]) * sine) ** 2, kept)
    gone_x = total(2.0 * (np.sin(away) * np.cos(away)) ** 2, cut) + area * shift**2
    gone_y = total(np.sin(away) ** 4, cut) * 2.0 / 3.0
    return CutCircle(
        area=r**2 * area,
        shift=r * shift,
        second_x=r**4 * second_x,
        second_y=r**4 * second_y,
        second_x_centroid=r**4 * centred,
        loss_x=4.0 * gone_x / np.pi,
        loss_y=4.0 * gone_y / np.pi,
    )


@cache
def _rule() -> tuple[Array, Array]:
    """Return nodes and weights on (0, 1)."""
    node, weight = np.polynomial.legendre.leggauss(NODES)
    return 0.5 + 0.5 * node, 0.5 * weight
