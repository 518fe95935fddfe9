"""What does a cracked shaft show while it runs up or down? Its whirling at a speed that changes evenly.

A slow run through half the critical speed is the first test for a crack: order 2 swells there.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy

from cardan.errors import Problem, check, refuse
from cardan.formulas.run_up import Progress, bad_times, instants, negative, not_finite, not_positive
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.periodic.turning_spring import hump, pull
from cardan.texts import _

from .cracked_rotor import GRAVITY, UNCRACKED, Crack, cracked_rotor


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


# Motion in time of shafts that whirl: steps of order eight, curves at given instants, and their orders.

RELATIVE = 1e-11
"""Tolerance of a step."""

MOST = 2_000_000
"""Steps of a run at most."""


def followed(
    rate: Callable[[float, Array], Array],
    state: Array,
    time: Array,
    small: Array,
    longest: float,
    progress: Progress | None = None,
) -> tuple[Array, bool]:
    """Return the states at rising instants, from the first of them on.

    rate: from time and state (n,) to the rates of it; state (n,); time (t,) [s]; small (n,): sizes of no matter.
    longest [s]: longest step.
    Returns states (m, n): as many as were reached.

    >>> swing, _stopped = followed(lambda t, y: np.array([y[1], -y[0]]), np.array([1.0, 0.0]), np.array([0.0, np.pi]),
    ...                            np.full(2, 1e-12), 1.0)
    >>> swing[-1].round(9)
    array([-1., -0.])
    """
    if (time[-1] - time[0]) / longest > MOST:
        raise refuse("end", _("more than {most:.0e} steps would be needed").format(most=MOST), "out_of_range")
    if time.size < 2 or time[-1] == time[0]:
        return np.tile(state, (time.size, 1)), False
    solver = scipy.integrate.DOP853(rate, time[0], state, time[-1], rtol=RELATIVE, atol=small, max_step=longest)
    found = np.empty((time.size, state.size))
    found[0], done, told = state, 1, 0.0
    while done < time.size:
        with np.errstate(all="ignore"):
            solver.step()
        if solver.status == "failed" or not np.isfinite(solver.y).all():
            text = _("the motion grows beyond all numbers after {time:.4g} s")
            raise refuse("end", text.format(time=solver.t), "out_of_range")
        upto = int(np.searchsorted(time, solver.t, side="right"))
        if upto > done:
            found[done:upto] = solver.dense_output()(time[done:upto]).T
            done = upto
        share = (solver.t - time[0]) / (time[-1] - time[0])
        if progress is not None and (share >= told + 0.01 or done == time.size):
            told = share
            if progress(float(share)) == "stop" and done < time.size:
                return found[:done], True
    return found, False


def longest_step(*frequencies: float) -> float:
    """Return the longest step that follows swings of these frequencies [rad/s], an eighth of a turn of the fastest."""
    return 0.25 * math.pi / max(frequencies)


def fitted_orders(
    angle: Array, deflection: Array, *, turns: int = 8, reach: int = 4, parts: int = 1
) -> tuple[Array, Array]:
    """Return the orders of whirling over the last turns, by least squares.

    angle (t,) [rad]: θ, rising; deflection (t,) [m], complex: X + iY.
    turns: how many of the last whole turns; fewer where there are no more.
    parts: into how many parts the step from order to order is divided.
    Returns order (N,); amplitude (N,) [m], complex: Z_n of Σ Z_n e^(inθ).

    >>> turn = np.linspace(0.0, 30.0, 400)
    >>> order, size = fitted_orders(turn, 1e-3 * np.exp(-2j * turn), reach=2)
    >>> order, (1e3 * abs(size)).round(6)
    (array([-2., -1.,  0.,  1.,  2.]), array([1., 0., 0., 0., 0.]))
    """
    whole = max(1, min(turns, int((angle[-1] - angle[0]) / (2.0 * math.pi))))
    late = angle >= angle[-1] - 2.0 * math.pi * whole * (1.0 + 1e-12)
    theta, z = angle[late], deflection[late]
    order = np.arange(-reach * parts, reach * parts + 1) / parts
    weight = np.sqrt(np.maximum(np.gradient(theta), 0.0))
    wave = np.exp(1j * np.outer(theta, order))
    found: Array = np.linalg.lstsq(weight[:, None] * wave, weight * z, rcond=None)[0]
    return order, found
