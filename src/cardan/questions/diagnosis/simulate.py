"""Recordings of a drive with a known fault: a run-up and two holds, as sensors would have written them."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
import scipy

from cardan.drive.drive import Drive
from cardan.errors import Problem, check
from cardan.maths.arrays import Array
from cardan.texts import _

from .expected import Expected, expected_orders
from .signals.signal import Channel, Progress, Signal, Watch

SPREAD = 0.25  # standard deviation of the logarithm of what decides a line's size in one recording and nobody knows
MOST_VALUES = 2e7  # values of a channel; what is made of all of them together would not fit the memory otherwise


@dataclass(frozen=True, kw_only=True)
class TestSchedule:
    """How a recording runs: up at one torque, then held at two.

    Attributes
    ----------
    run_up : float [s]
        From the lowest to the top speed; 0 for a recording at one speed.
    hold : float [s]
        Each hold.
    held : float
        Speed of the holds over the top speed.
    torques : (float, float, float)
        Torque over that of the duty while running up, in the first hold, in the second; negative is coasting.
    rate : float [Hz]
        Values a second.
    """

    run_up: float = 10.0
    hold: float = 4.0
    held: float = 0.8
    torques: tuple[float, float, float] = (0.6, 1.0, -0.25)
    rate: float = 2048.0

    __test__ = False  # a name that starts with Test is no test to pytest


RUNS = TestSchedule()


@dataclass(frozen=True, kw_only=True)
class _Course:
    """Angle, speed and torque at every value."""

    time: Array = field(repr=False)
    angle: Array = field(repr=False)
    speed: Array = field(repr=False)
    torque: Array = field(repr=False)


def simulate_fault(
    drive: Drive,
    fault: str = "healthy",
    *,
    severity: float = 1.0,
    seed: int = 0,
    snr: float = 10.0,
    runs: TestSchedule = RUNS,
    shaft: int | None = None,
    progress: Progress | None = None,
) -> Signal:
    """Return a recording of a drive with a fault, the same for the same seed.

    Parameters
    ----------
    drive : Drive
        The drive in order.
    fault : str
        One of `cardan.questions.diagnosis.expected.FAULTS`.
    severity : float
        1 for a plain fault.
    seed : int
        Of all that is by chance.
    snr : float [dB]
        Power of what follows the shaft over that of the noise, in each channel of vibration.
    runs : TestSchedule
        Run-up and holds.
    shaft : int, optional
        Number of the shaft with the fault.
    progress : function, optional
        Told the share done; when it answers "stop" the sensors not yet written are left out, and a caution says so.

    Returns
    -------
    Signal
        Tacho, radial acceleration at every housing, axial acceleration at both ends, speed of the output,
        torque.

    Raises
    ------
    InputError
        An unknown fault, one that the drive cannot have, or options out of range.

    See Also
    --------
    expected_orders, diagnose

    Notes
    -----
    The orders are those of `expected_orders`, each with a phase and a factor exp(N(0, 0.25)) by chance. Noise is half
    white and half coloured (a first-order low pass); an engine at 2.74 and a wheel at 0.26 times the speed of the shaft
    come on top of it.

    Examples
    --------
    >>> from cardan import example
    >>> from cardan.recordings import simulate_fault
    >>> found = simulate_fault(example("car-propshaft"), "unbalance", seed=1)
    >>> [one.name for one in found.channels]
    ['tacho', 'input radial', 'output radial', 'input axial', 'output axial', 'output speed', 'torque']
    """
    check(_problems(snr, runs))
    rng = np.random.default_rng([seed, 20])
    expected = expected_orders(drive, fault, severity=severity, shaft=shaft)
    course = _course(expected, runs)
    pulses = np.exp(20.0 * (np.cos(course.angle) - 1.0))
    channels = [Channel(name="tacho", quantity="pulses", values=pulses, rate=runs.rate, place="shafts[0]")]
    places = {line.kind: line.place for line in expected.orders}
    kinds = [one for one in ("input", "centre", "output") if one in places]
    wanted = [(kind, "radial") for kind in kinds] + [("input", "axial"), ("output", "axial"), ("output", "torsion")]
    watch = Watch(progress, len(wanted))
    for kind, direction in wanted:
        if watch.stopped:
            break
        values = _noised(_shaken(expected, kind, direction, course, rng), course, snr, rng)
        named = "speed" if direction == "torsion" else direction
        quantity = "angular_speed" if direction == "torsion" else "acceleration"
        if direction == "torsion":
            values = values + course.speed
        name = f"{kind} {named}"
        place = places[kind]
        channels.append(
            Channel(name=name, quantity=quantity, values=values, rate=runs.rate, place=place, direction=direction)
        )
        watch.next()
    torque = course.torque + rng.normal(scale=0.02 * expected.reference, size=course.torque.size)
    channels.append(Channel(name="torque", quantity="torque", values=torque, rate=runs.rate, direction="torsion"))
    cautions = (_("The recording was stopped: it lacks sensors."),) if len(channels) < len(wanted) + 2 else ()
    return Signal(name=f"{fault} {seed}", channels=tuple(channels), tacho=0, cautions=cautions)


def _problems(snr: float, runs: TestSchedule) -> list[Problem]:
    found = []
    if not math.isfinite(snr):
        found.append(Problem("snr", _("is not finite"), "not_finite"))
    if not 0.0 <= runs.run_up < math.inf:
        text = _("{value:.6g} given; a finite number that is not negative is needed").format(value=runs.run_up)
        found.append(Problem("runs.run_up", text, "negative"))
    for name in ("hold", "rate", "held"):
        value = getattr(runs, name)
        if not 0.0 < value < math.inf:
            text = _("{value:.6g} given; a finite number above 0 is needed").format(value=value)
            found.append(Problem(f"runs.{name}", text, "not_positive"))
    if not found and (count := (runs.run_up + 2.0 * runs.hold + 1.5) * runs.rate) > MOST_VALUES:
        text = _("{count:.3g} values a channel would not fit the memory; at most {most:.3g} are written")
        found.append(Problem("runs.rate", text.format(count=count, most=MOST_VALUES), "out_of_range"))
    return found


def _course(expected: Expected, runs: TestSchedule) -> _Course:
    """Return angle, speed and torque: up evenly, then down to the held speed in a second, and a change of torque."""
    low, top = expected.speed
    held = runs.held * top
    first, second, third = (one * expected.reference for one in runs.torques)
    lasting, speeds = [0.0, runs.run_up, 1.0, runs.hold, 0.5, runs.hold], [low, top, held, held, held, held]
    torques = [first, first, second, second, third, third]
    if not runs.run_up:
        lasting, speeds, torques = [0.0, runs.hold, 0.5, runs.hold], speeds[2:], torques[2:]
    ends = np.cumsum(lasting)
    time = np.arange(int(ends[-1] * runs.rate)) / runs.rate
    speed = np.interp(time, ends, speeds)
    torque = np.interp(time, ends, torques)
    angle = np.cumsum(speed) / runs.rate
    return _Course(time=time, angle=angle, speed=speed, torque=torque)


def _shaken(expected: Expected, kind: str, direction: str, course: _Course, rng: np.random.Generator) -> Array:
    """Return what follows the shaft at one sensor."""
    total = np.zeros(course.time.size)
    for line in expected.orders:
        if line.kind != kind or line.direction != direction:
            continue
        phase = rng.uniform(0.0, 2.0 * np.pi)
        gain = math.exp(rng.normal(scale=SPREAD))
        value = gain * expected.value(line, course.speed, course.torque)
        total += (value * np.exp(1j * (line.order * course.angle + phase))).real
    for burst in expected.bursts:
        near = 1.0 if burst.kind == kind else 0.25
        if direction == "torsion":
            continue
        share = course.torque / expected.reference
        still, signed, sized = burst.torque
        level = near * burst.size * np.clip(still + signed * share + sized * np.abs(share), 0.0, None)
        shape = np.exp(12.0 * (np.cos(burst.per_turn * (course.angle - rng.uniform(0.0, 6.0))) - 1.0))
        total += level * shape * rng.normal(size=course.time.size)
    return total


def _noised(values: Array, course: _Course, snr: float, rng: np.random.Generator) -> Array:
    """Return a channel with noise and with what is not of the drive."""
    power = float(np.mean(values**2)) or 1e-12
    white = rng.normal(size=values.size)
    brown = scipy.signal.lfilter([1.0], [1.0, -0.97], rng.normal(size=values.size))
    noise = math.sqrt(0.5) * (white + brown / float(np.std(brown)))
    level = math.sqrt(power * 10.0 ** (-snr / 10.0))
    other = sum(
        share * np.cos(order * course.angle + rng.uniform(0.0, 6.28)) for order, share in ((2.74, 0.4), (0.26, 0.2))
    )
    return np.asarray(values + level * (noise + other))
