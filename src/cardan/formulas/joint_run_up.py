"""What torque does a joint raise while its driving shaft runs up through the resonance of order 2?

The driving shaft turns evenly faster; the joint makes of that a motion with swings of order 2, 4, 6 …; the driven shaft
is a spring with an inertia at its end.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from cardan.errors import Problem, check, refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.curves.peaks import brackets, level
from cardan.maths.periodic.oscillator import advanced, chirp, stepped
from cardan.texts import _

from .run_up import STEPS, Progress, bad_times, instants, not_positive


@dataclass(frozen=True, eq=False, kw_only=True)
class JointRunUp:
    """Torque behind a joint whose driving shaft runs up evenly."""

    joint_angle: float  # [rad]: α
    stiffness: float  # [N·m/rad]: c of the driven shaft
    inertia: float  # [kg·m²]: J at its end
    damping: float  # [N·m·s/rad]: b of the driven shaft
    acceleration: float  # [rad/s²]: a of the driving shaft
    time: Array  # (p,) [s]: instants
    torque: Array  # (p,) [N·m]: in the driven shaft
    twist: Array  # (p,) [rad]: of the driven shaft, from the joint to the inertia
    peak_torque: float  # [N·m]: largest |torque|
    peak_time: float  # [s]: when
    residual: float  # torque at the peak, step by step, against the joint's series in closed forms, over the peak
    cancelled: bool = False  # whether ``progress`` stopped the run

    @property
    def peak_speed(self) -> float:
        """Speed of the driving shaft at the peak [rad/s]."""
        return self.acceleration * self.peak_time

    @property
    def order2_speed(self) -> float:
        """Speed at which two swings a turn meet the natural frequency, ½√(c/J) [rad/s]."""
        return 0.5 * math.sqrt(self.stiffness / self.inertia)

    @property
    def steady_torque(self) -> float:
        """Amplitude of order 2 when running steadily at `order2_speed` [N·m]; infinite without damping."""
        omega = 2.0 * self.order2_speed
        swing = math.tan(0.5 * self.joint_angle) ** 2
        if not self.damping:
            return math.inf if swing else 0.0
        return swing * abs(self.stiffness + 1j * omega * self.damping) * self.inertia * omega / self.damping


def joint_run_up(
    joint_angle: float,
    stiffness: float,
    inertia: float,
    acceleration: float,
    end: float,
    *,
    damping: float = 0.0,
    time: ArrayLike | None = None,
    progress: Progress | None = None,
) -> JointRunUp:
    """Return the torque behind a joint while its driving shaft runs up evenly from rest, and its peak.

    Parameters
    ----------
    joint_angle : float [rad]
        α in [0, π/2).
    stiffness : float [N·m/rad]
        c of the driven shaft.
    inertia : float [kg·m²]
        J at its end.
    acceleration : float [rad/s²]
        a of the driving shaft.
    end : float [s]
        Until when.
    damping : float [N·m·s/rad]
        b of the driven shaft.
    time : array (p,), optional [s]
        Instants of the curves, up to the end; evenly by default.
    progress : function, optional
        Told the share done; when it answers "stop" the run ends.

    Returns
    -------
    JointRunUp

    Raises
    ------
    InputError
        Values out of range, times out of the run, or a run of too many swings.

    Notes
    -----
    J φ̈_2 + b(φ̇_2 - ġ) + c(φ_2 - g) = 0 with g = T(½at²; α), the driving yoke in the plane of the shafts at the start.
    x = φ_2 - g is an oscillator under the force -g̈, taken from step to step by its impulse response; the torque is
    -cx - bẋ. The check takes g as a series, each term of it a force of rising frequency with a closed answer.

    Examples
    --------
    >>> from cardan.units import deg
    >>> found = joint_run_up(20 * deg, 2000.0, 0.5, 20.0, 4.0, damping=0.5)
    >>> print(f"{found.peak_torque:.2f} N·m at {found.peak_speed:.2f} rad/s, after {found.order2_speed:.2f} rad/s")
    842.25 N·m at 37.47 rad/s, after 31.62 rad/s
    """
    problems = not_positive({"stiffness": stiffness, "inertia": inertia, "acceleration": acceleration, "end": end})
    if not 0.0 <= joint_angle < 0.5 * math.pi:
        problems.append(Problem("joint_angle", _("needs to be at least 0 and below 90°")))
    if not 0.0 <= damping < math.inf:
        problems.append(Problem("damping", _("needs to be a number that is not negative")))
    check(problems + bad_times(time, end))
    omega, lossy = math.sqrt(stiffness / inertia), damping / inertia
    zeta = 0.5 * lossy / omega
    at = np.sort(instants(time, end, omega / (2.0 * math.pi)))
    cosine, square = math.cos(joint_angle), math.sin(joint_angle) ** 2

    def force(t: Array) -> Array:
        """Return -g̈."""
        theta, speed = 0.5 * acceleration * t * t, acceleration * t
        sine, along = np.sin(theta), np.cos(theta)
        near = sine * sine + (cosine * along) ** 2
        found: Array = cosine / near * (2.0 * square * sine * along / near * speed * speed - acceleration)
        return found

    def torque(state: tuple[Array, Array]) -> Array:
        return -(stiffness * state[0] + damping * state[1])

    def slope(t: Array, state: tuple[Array, Array]) -> Array:
        pushed = force(t) - lossy * state[1] - omega * omega * state[0]
        return -(stiffness * state[1] + damping * pushed)

    steps = _steps(joint_angle, acceleration, end, omega * (1.0 if zeta < 1.0 else 2.0 * zeta))
    best, best_time, cancelled = 0.0, 0.0, False
    curves = []
    for t, x, v in stepped(force, end, steps, omega, zeta):
        left, right = brackets(t, torque((x, v)), slope(t, (x, v)))
        row = np.searchsorted(t, left)
        start = x[row], v[row]

        def onward(span: Array, begin: Array = left, state: tuple[Array, Array] = start) -> tuple[Array, Array]:
            return advanced(force, begin, span, state, omega, zeta)

        def rising(span: Array, begin: Array = left, go: Callable[[Array], tuple[Array, Array]] = onward) -> Array:
            return slope(begin + span, go(span))

        span = level(rising, np.zeros_like(left), right - left)
        places = np.concatenate((left + span, t[-1:]))
        height = np.abs(np.concatenate((torque(onward(span)), torque((x[-1:], v[-1:])))))
        highest = int(np.argmax(height))
        if height[highest] > best:
            best, best_time = float(height[highest]), float(places[highest])
        final = bool(end - t[-1] < 0.5 * end / steps)
        inside = at[(at >= t[0]) & ((at < t[-1]) | final)]
        row = np.minimum(np.searchsorted(t, inside, side="right") - 1, t.size - 2)
        curves.append((inside, *advanced(force, t[row], inside - t[row], (x[row], v[row]), omega, zeta)))
        if progress is not None and progress(float(t[-1]) / end) == "stop":
            cancelled = not final
            break
    moments, x, v = (np.concatenate(rows) for rows in zip(*curves, strict=True))
    closed = _closed_torque(joint_angle, acceleration, best_time, omega, zeta) * inertia
    return JointRunUp(
        joint_angle=float(joint_angle),
        stiffness=float(stiffness),
        inertia=float(inertia),
        damping=float(damping),
        acceleration=float(acceleration),
        time=moments,
        torque=torque((x, v)),
        twist=-x,
        peak_torque=best,
        peak_time=best_time,
        residual=abs(abs(closed) - best) / best if best else 0.0,
        cancelled=cancelled,
    )


def _steps(joint_angle: float, acceleration: float, end: float, fastest: float) -> int:
    """Return how many steps follow the oscillator and the joint: g has a pole atanh(cos α) beside the real angles."""
    turn = min(0.2, 0.25 * math.atanh(math.cos(joint_angle)) if joint_angle else 0.2)
    steps = end * max(fastest / 0.4, acceleration * end / turn)
    if steps > STEPS:
        raise refuse(
            "end", _("{count:.3g} steps would be needed, at most {most:.0e} are taken").format(count=steps, most=STEPS)
        )
    return math.ceil(steps) + 1


def _closed_torque(joint_angle: float, acceleration: float, time: float, omega: float, zeta: float) -> float:
    """Return the torque over the inertia by the series g = θ + Σ (τ^k/k) sin 2kθ, in closed forms.

    A term Im E, E = e^(i a_k t²/2), a_k = 2ka, twists by Im L, L = E - Y - 2ζẎ/ω with the answer Y to ω²E; and the rate
    of L is Ė - Ẏ - 2ζωL.
    """
    tau = math.tan(0.5 * joint_angle) ** 2
    count = 1 if tau < 1e-17 else min(math.ceil(math.log(1e-17) / math.log(tau)) + 1, 200_000)
    k = np.arange(1, count + 1)
    rate = 2.0 * k * acceleration
    y, velocity = chirp(time, omega, zeta, rate)
    size = tau**k / k
    lag = np.exp(0.5j * rate * time * time) - y - 2.0 * zeta / omega * velocity
    swing = 1j * rate * time * np.exp(0.5j * rate * time * time) - velocity - 2.0 * zeta * omega * lag
    step, push = _even(time, omega, zeta)
    twist = acceleration * step + float(np.sum(size * lag.imag))
    rise = acceleration * push + float(np.sum(size * swing.imag))
    return omega * omega * twist + 2.0 * zeta * omega * rise


def _even(time: float, omega: float, zeta: float) -> tuple[float, float]:
    """Return the answer to a force of 1 from t = 0 on, and its rate."""
    root = omega * np.sqrt(complex(zeta - 1.0) * (zeta + 1.0) if abs(zeta - 1.0) > 1e-8 else 2e-8 + 0j)
    one, other = root - zeta * omega, -root - zeta * omega
    parts = np.exp(one * time), np.exp(other * time)
    x = (1.0 + (other * parts[0] - one * parts[1]) / (one - other)) / (omega * omega)
    return float(x.real), float(((parts[0] - parts[1]) / (one - other)).real)
