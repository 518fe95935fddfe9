"""What does a cracked shaft show while it runs up or down? Its whirling at a speed that changes evenly.

A slow run through half the critical speed is the first test for a crack: order 2 swells there.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from cardan.errors import Problem, check
from cardan.formulas.run_up import Progress, bad_times, instants, negative, not_finite, not_positive
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.periodic.cosine_power import hump
from cardan.maths.periodic.turning_spring import pull
from cardan.texts import _

from .crack import UNCRACKED, Crack
from .cracked_rotor import GRAVITY, cracked_rotor
from .whirl_in_time import fitted_orders, followed, longest_step


@dataclass(frozen=True, eq=False, kw_only=True)
class CrackedRun:
    """Whirling of a cracked, unbalanced shaft while its speed rises or falls evenly, X down, Y 90° ahead."""

    natural_frequency: float  # [rad/s]: critical speed of the sound shaft, ω_0
    speed: Array  # (t,) [rad/s]: at the instants
    time: Array  # (t,) [s]: instants
    angle: Array  # (t,) [rad]: of the crack from the vertical
    deflection: Array  # (t,) [m], complex: X + iY
    velocity: Array  # (t,) [m/s], complex: its rate
    static: float  # [m]: what the weight bends the sound shaft
    peak: float  # [m]: largest distance from the static place, among the instants
    peak_time: float  # [s]: when
    cancelled: bool = False  # whether ``progress`` stopped the run; the curves end there

    @property
    def peak_speed(self) -> float:
        """Speed at the peak [rad/s]."""
        return float(self.speed[int(np.flatnonzero(self.time == self.peak_time)[0])])

    def orders(self, *, turns: int = 4, reach: int = 4, parts: int = 1) -> tuple[Array, Array, Array]:
        """Return the orders along the run: speeds (w,) [rad/s], orders (N,), amplitudes (w, N) [m], complex.

        turns: turns in a window; it moves on by half of them.
        parts: 2 for half orders too.
        Least squares in each window; the instants are to be at least four to a swing of the highest order.
        """
        width = 2.0 * math.pi * turns
        ends = np.arange(self.angle[0] + width, self.angle[-1], 0.5 * width)
        rows, speeds, order = [], [], np.arange(-reach * parts, reach * parts + 1) / parts
        for end in ends:
            inside = (self.angle > end - width) & (self.angle <= end)
            if np.count_nonzero(inside) >= 2 * order.size:
                fit = fitted_orders(self.angle[inside], self.deflection[inside], turns=turns, reach=reach, parts=parts)
                rows.append(fit[1])
                speeds.append(float(np.mean(self.speed[inside])))
        return np.asarray(speeds), order, np.asarray(rows).reshape(-1, order.size)


def cracked_run(
    mass: float,
    stiffness: float,
    start_speed: float,
    acceleration: float,
    end: float,
    *,
    crack: Crack = UNCRACKED,
    damping_ratio: float = 0.0,
    unbalance: float = 0.0,
    unbalance_phase: float = 0.0,
    gravity: float = GRAVITY,
    time: ArrayLike | None = None,
    progress: Progress | None = None,
) -> CrackedRun:
    """Return how a cracked shaft whirls while its speed changes evenly.

    Parameters
    ----------
    mass : float [kg]
        m of the disc.
    stiffness : float [N/m]
        k_0 of the sound shaft, at the disc.
    start_speed : float [rad/s]
        At the start, at least 0.
    acceleration : float [rad/s²]
        Positive when running up, negative when running down, 0 at a steady speed; the shaft does not turn back.
    end : float [s]
        Until when.
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
    time : array (t,), optional [s]
        Instants of the curves, up to the end; evenly, sixteen to a turn of the fastest speed, by default. The start is
        always among them.
    progress : function, optional
        Told the share done; when it answers "stop" the run ends.

    Returns
    -------
    CrackedRun

    Raises
    ------
    InputError
        Values out of range, a shaft that would turn back, or a run of too many steps.

    Notes
    -----
    m z̈ + c ż + K(θ) z = m g + m_u e (θ̇² - iθ̈) e^(i(θ+χ)) with θ = θ̇_0 t + ½at², the disc at the start on its steady
    orbit where there is a stable one, otherwise at rest where the weight bends the sound shaft.

    Examples
    --------
    A run down through half the critical speed of 175 rad/s:

    >>> crack = Crack(loss_xi=0.1, loss_eta=0.02)
    >>> found = cracked_run(0.617, 18875.0, 100.0, -20.0, 1.5, crack=crack, damping_ratio=0.02)
    >>> speed, order, size = found.orders()
    >>> print(speed[np.argmax(abs(size[:, order == 2]))].round(0))
    84.0
    """
    problems = not_positive({"mass": mass, "stiffness": stiffness, "end": end})
    amounts = {"start_speed": start_speed, "damping_ratio": damping_ratio, "unbalance": unbalance, "gravity": gravity}
    problems += negative(amounts) + not_finite({"acceleration": acceleration, "unbalance_phase": unbalance_phase})
    if not problems and start_speed + acceleration * end < -1e-9 * start_speed:
        problems.append(Problem("end", _("the shaft would turn back before"), "out_of_range"))
    check(problems + ([] if time is None else bad_times(time, end)))
    omega = math.sqrt(stiffness / mass)
    fastest = max(start_speed, start_speed + acceleration * end)
    at = np.union1d(0.0, instants(time, end, max(omega, 2.0 * fastest) / (2.0 * math.pi)))
    drop = gravity / omega**2
    z, v = complex(drop), 0j
    if start_speed >= 1e-2 * omega:
        steady = cracked_rotor(
            mass,
            stiffness,
            start_speed,
            crack=crack,
            damping_ratio=damping_ratio,
            unbalance=unbalance,
            unbalance_phase=unbalance_phase,
            gravity=gravity,
            orders=max(16, math.ceil(3.0 * omega / start_speed) + 4 * crack.breathing),
        )
        if steady.stable and not steady.resonant:
            z = complex(np.sum(steady.amplitude))
            v = complex(np.sum(1j * start_speed * steady.order * steady.amplitude))
    push = unbalance / mass * cmath.exp(1j * unbalance_phase)
    rate = _rates(omega, damping_ratio, crack, (start_speed, acceleration), push, gravity)
    quick = fastest * max(1.0, math.sqrt(crack.breathing))
    size = max(drop, unbalance / mass, 1e-12)
    small = np.array([1e-12 * size, 1e-12 * size, 1e-12 * omega * size, 1e-12 * omega * size])
    longest = longest_step(omega, 2.0 * damping_ratio * omega, quick)
    states, cancelled = followed(rate, np.array([z.real, z.imag, v.real, v.imag]), at, small, longest, progress)
    at, curve = at[: len(states)], states[:, 0] + 1j * states[:, 1]
    away = np.abs(curve - drop)
    highest = int(np.argmax(away))
    return CrackedRun(
        natural_frequency=omega,
        speed=start_speed + acceleration * at,
        time=at,
        angle=start_speed * at + 0.5 * acceleration * at**2,
        deflection=curve,
        velocity=states[:, 2] + 1j * states[:, 3],
        static=drop,
        peak=float(away[highest]),
        peak_time=float(at[highest]),
        cancelled=cancelled,
    )


def _rates(
    omega: float, damping: float, crack: Crack, motion: tuple[float, float], push: complex, gravity: float
) -> Callable[[float, Array], Array]:
    """Return the function from time and state to the rates of the state."""
    (begin, rise), losses, power, square = motion, crack.losses, crack.breathing, omega * omega

    def rate(time: float, state: Array) -> Array:
        x, y, vx, vy = state.tolist()
        speed = begin + rise * time
        unit = cmath.exp(1j * time * (begin + 0.5 * rise * time))
        drawn = pull(complex(x, y), unit, hump(unit, power)[0], losses)
        pushed = gravity + push * complex(speed * speed, -rise) * unit
        a = pushed - square * drawn - 2.0 * damping * omega * complex(vx, vy)
        return np.array([vx, vy, a.real, a.imag])

    return rate
