"""What does passing a resonance cost? Peak amplitude of an oscillator while the frequency of its force rises.

A steady amplitude takes time to build up: the faster the run-up, the lower the peak, and the later it comes.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from cardan.errors import Problem, check, refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.curves.extremes import brackets, level
from cardan.maths.periodic.oscillator import CHUNK, advanced, chirp, stepped
from cardan.texts import _

Progress: TypeAlias = Callable[[float], object]
"""Told the share done; may answer "stop"."""

STEPS = 20_000_000
"""More steps than this are refused: hours of vibration."""

CHECKED = 400_000
"""Runs of fewer steps are also followed step by step, to check the closed form."""

_SCAN = 2.0 * math.pi / 12.0
"""Phase between the places where a peak is looked for."""

BUILT_UP = {"half": 0.2552289, "full": 1.3768514}
"""ζω_0/√a of a run-up whose peak is half of the steady one, and 95 % of it."""


def passing_time(natural_frequency: float, damping_ratio: float, width: float, reached: str = "half") -> float:
    """Return how long a run-up may take through a band about a resonance, so that no more than a share builds up.

    Parameters
    ----------
    natural_frequency : float [rad/s]
        ω_0, the middle of the band.
    damping_ratio : float
        ζ, small.
    width : float
        Width of the band over its middle.
    reached : str
        ``"half"`` of the steady peak, or ``"full"``: 95 percent of it.

    Returns
    -------
    float [s]
        Shorter than this less builds up. An excitation n times a turn takes as long through its own band, which is n
        times narrower.

    Notes
    -----
    The amplitude obeys a' = -ζω_0 a + ½ω_0 exp(½ i a_s t²), so the share of the steady peak depends on p = ζω_0/√a_s
    alone: 1/2 at p = 0.255, 0.95 at 1.377 (the limit of ISO 7626-2 for slow sweeps is 1.32). Undamped the peak is
    1.466 ω_0/√a_s (Lewis 1932).

    Examples
    --------
    >>> print(f"{passing_time(144.0, 0.05, 0.4):.3f} {passing_time(144.0, 0.05, 0.4, 'full'):.2f}")
    0.072 2.11
    """
    return width * (BUILT_UP[reached] / damping_ratio) ** 2 / natural_frequency


@dataclass(frozen=True, eq=False, kw_only=True)
class RunUp:
    """Response of an oscillator while the frequency of its force rises through its own, over the static one."""

    natural_frequency: float  # [rad/s]: ω_0
    damping_ratio: float  # ζ
    acceleration: float  # [rad/s²]: a_s: the frequency of the force is a_s t
    time: Array  # (p,) [s]: instants
    response: Array  # (p,): y there
    peak: float  # largest |y|
    peak_time: float  # [s]: when
    # closed form against the impulse response summed step by step, at the peak; nan where the run is too long for that
    residual: float
    cancelled: bool = False  # whether ``progress`` stopped the search; the peak is that of what was searched

    @property
    def passing_time(self) -> float:
        """When the frequency of the force passes the natural one [s]."""
        return self.natural_frequency / self.acceleration

    @property
    def steady_peak(self) -> float:
        """Largest steady amplitude, what an infinitely slow run-up comes to."""
        zeta = self.damping_ratio
        return 0.5 / (zeta * math.sqrt(1.0 - zeta * zeta)) if zeta < math.sqrt(0.5) else 1.0


def run_up(
    natural_frequency: float,
    damping_ratio: float,
    acceleration: float,
    end: float,
    *,
    time: ArrayLike | None = None,
    progress: Progress | None = None,
) -> RunUp:
    """Return the response of an oscillator to a force of rising frequency, and its peak.

    Parameters
    ----------
    natural_frequency : float [rad/s]
        ω_0.
    damping_ratio : float
        ζ, between 0 and 1.
    acceleration : float [rad/s²]
        a_s.
    end : float [s]
        The peak is looked for up to here.
    time : array (p,), optional [s]
        Instants of the response; evenly up to the end by default.
    progress : function, optional
        Told the share done; when it answers "stop" the search ends.

    Returns
    -------
    RunUp

    Raises
    ------
    InputError
        ω_0, a_s or the end not positive, ζ not between 0 and 1, times that are negative.

    Notes
    -----
    y'' + 2ζω_0 y' + ω_0² y = ω_0² cos(½ a_s t²), at rest at t = 0; exact, see `cardan.maths.periodic.oscillator.chirp`.

    Examples
    --------
    >>> found = run_up(20.0, 0.02, 8.0, 6.0)
    >>> print(f"{found.peak:.6f} at {found.peak_time:.6f} s, steady {found.steady_peak:.2f}")
    7.773220 at 3.180880 s, steady 25.01
    """
    given = {"natural_frequency": natural_frequency, "acceleration": acceleration, "end": end}
    problems = not_positive(given)
    if not 0.0 < damping_ratio < 1.0:
        problems.append(Problem("damping_ratio", _("needs to be between 0 and 1")))
    check(problems + bad_times(time))
    omega, zeta, rate = float(natural_frequency), float(damping_ratio), float(acceleration)
    at = instants(time, end, omega / (2.0 * math.pi))

    def slope(t: Array) -> Array:
        return chirp(t, omega, zeta, rate)[1].real

    best, best_time = 0.0, 0.0
    runs = [run for begin, stop in _windows(omega, zeta, rate, end) for run in _scan(begin, stop, omega, rate)]
    count = sum(run.count for run in runs)
    if count > STEPS:
        text = _("{count:.3g} places would have to be searched, at most {most:.0e} are; end soon after {time:.4g} s")
        raise refuse("end", text.format(count=count, most=STEPS, time=omega / rate))
    cancelled, done = False, 0
    for piece in (piece for run in runs for piece in run.pieces()):
        x, v = chirp(piece, omega, zeta, rate)
        left, right = brackets(piece, x.real, v.real)
        places = np.concatenate(([piece[0], piece[-1]], level(slope, left, right)))
        height = np.abs(chirp(places, omega, zeta, rate)[0].real)
        highest = int(np.argmax(height))
        if height[highest] > best:
            best, best_time = float(height[highest]), float(places[highest])
        done += piece.size - 1
        if progress is not None and progress(done / count) == "stop":
            cancelled = done < count
            break
    return RunUp(
        natural_frequency=omega,
        damping_ratio=zeta,
        acceleration=rate,
        time=at,
        response=chirp(at, omega, zeta, rate)[0].real,
        peak=best,
        peak_time=best_time,
        residual=_sweep_residual(omega, zeta, rate, best_time),
        cancelled=cancelled,
    )


def _windows(omega: float, zeta: float, rate: float, end: float) -> list[tuple[float, float]]:
    """Return the times in which the largest response may be.

    A slow run with little damping peaks where the frequency is within a dozen √a of the natural one. Later than four
    times the natural frequency, or one and a half times where the run is not fast, everything only dies away.
    """
    slow, passing, width = omega * omega / rate, omega / rate, 12.0 / math.sqrt(rate)
    if slow > 1e4 and zeta < 0.2 and passing + width < end:
        peak = passing * math.sqrt(1.0 - 2.0 * zeta * zeta)
        return [(peak - width, peak + width)]
    over = 1.5 * passing if slow > 100.0 else 4.0 * passing + 4.0 * math.pi / omega
    return [(0.0, min(end, over))]


@dataclass(frozen=True, kw_only=True)
class _Run:
    """Times from one to another, evenly spread or evenly in their squares."""

    first: float
    last: float
    count: int
    power: float = 1.0

    def pieces(self) -> Iterator[Array]:
        """Yield the times, in pieces that share their end points."""
        step = (self.last - self.first) / self.count
        for k in range(0, self.count, CHUNK):
            row = np.arange(k, min(k + CHUNK, self.count) + 1)
            yield (self.first + step * row) ** self.power


def _scan(begin: float, end: float, omega: float, rate: float) -> list[_Run]:
    """Return times that follow the swings of force and oscillator."""
    passing, fast = omega / rate, 2000.0 * omega / rate
    runs = []
    if begin < passing:
        stop = min(passing, end)
        runs.append(_Run(first=begin, last=stop, count=math.ceil((stop - begin) * omega / _SCAN) + 1))
    if end > passing and begin < fast:
        first, last = max(begin, passing) ** 2, min(end, fast) ** 2
        runs.append(_Run(first=first, last=last, count=math.ceil(0.5 * rate * (last - first) / _SCAN) + 1, power=0.5))
    if end > fast:  # the force is too quick to be seen: its share is below 1e-6
        runs.append(_Run(first=fast, last=end, count=math.ceil((end - fast) * 2000.0 * omega / _SCAN) + 1))
    return runs


def _sweep_residual(omega: float, zeta: float, rate: float, end: float) -> float:
    steps = math.ceil(end * max(omega, rate * end) / 0.4) + 1
    if not end or steps > CHECKED:
        return math.nan

    def force(t: Array) -> Array:
        found: Array = omega * omega * np.cos(0.5 * rate * t * t)
        return found

    *_before, (_t, x, _v) = stepped(force, end, steps, omega, zeta)
    return float(abs(x[-1] - chirp(end, omega, zeta, rate)[0].real))


def not_positive(given: dict[str, float]) -> list[Problem]:
    """Return what is wrong with numbers that need to be positive."""
    return [
        Problem(name, _("needs to be positive and finite"))
        for name, value in given.items()
        if not 0.0 < value < math.inf
    ]


def negative(given: dict[str, float]) -> list[Problem]:
    """Return what is wrong with amounts, which may be nought."""
    return [
        Problem(name, _("needs to be a number that is not negative"), "negative")
        for name, value in given.items()
        if not 0.0 <= value < math.inf
    ]


def not_finite(given: dict[str, float]) -> list[Problem]:
    """Return what is wrong with numbers of either sign."""
    return [
        Problem(name, _("needs to be a finite number"), "not_finite")
        for name, value in given.items()
        if not math.isfinite(value)
    ]


def bad_times(time: ArrayLike | None, end: float = math.inf) -> list[Problem]:
    """Return what is wrong with the instants asked for."""
    values = np.asarray(0.0 if time is None else time, dtype=float)
    if np.all(np.isfinite(values) & (values >= 0.0) & (values <= end)):
        return []
    return [Problem("time", _("instants lie between 0 and the end"))]


def instants(time: ArrayLike | None, end: float, frequency: float) -> Array:
    """Return the instants asked for, or enough of them to show a frequency [Hz], within reason."""
    if time is not None:
        return np.atleast_1d(np.asarray(time, dtype=float))
    return np.linspace(0.0, end, int(min(max(2001, 8 * frequency * end), 20_001)))


# What torque does a joint raise while its driving shaft runs up through the resonance of order 2?
#
# The driving shaft turns evenly faster; the joint makes of that a motion with swings of order 2, 4, 6 …; the driven
# shaft is a spring with an inertia at its end.


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
