"""Torsional vibration from the pulses of a tooth wheel: how far and how fast a shaft swings about its even turning."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import scipy

from cardan.errors import Problem, check, refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.texts import _

from .signal import Channel
from .turning import counted

EVEN_TURNS = 4
"""Turns over which the even turning is averaged; with Hann's weights all orders that are quarters from 1/2 up go."""

LEAST_WINDOWS = 3  # of these turns a recording needs so many: one goes at each end
LEAST_TEETH = 8  # a wheel of fewer teeth sees too little of a turn: 4 teeth are needed in a period of the highest order
KEPT = 8  # whole orders that belong to the shaft; what repeats from turn to turn above them is put down to the teeth


@dataclass(frozen=True, eq=False, kw_only=True)
class TorsionalVibration:
    """How a shaft swings about its even turning.

    Attributes
    ----------
    name : str
        Of the channel.
    teeth : int
        Of the wheel.
    time : array (m,) [s]
        Of the pulses.
    angle : array (m,) [rad]
        The even turning: whole teeth.
    twist : array (m,) [rad]
        How far the shaft is ahead of it.
    swing : array (m,) [rad/s]
        How much faster than the mean it turns.
    speed : array (m,) [rad/s]
        Mean speed there.
    order : array (k,)
        Orders of the spectrum, up to half the teeth; those of quarters of a turn are exact.
    twist_amplitude : array (k,) [rad]
        Peak amplitude of each.
    tooth_error : array (teeth,) [rad]
        How far each tooth stands ahead of its place, from that of the first pulse on: left out of the twist.
    jitter : float [rad]
        What the sampling rate leaves of doubt in each pulse.
    missing : int
        Pulses that did not come, read between their neighbours.
    confidence : float
        From 0 to 1.
    cautions : tuple of str
        What was doubtful.
    """

    name: str
    teeth: int
    time: Array
    angle: Array
    twist: Array
    swing: Array
    speed: Array
    order: Array
    twist_amplitude: Array
    tooth_error: Array
    jitter: float
    missing: int
    confidence: float
    cautions: tuple[str, ...] = ()

    def at(self, order: float) -> float:
        """Return the amplitude of the twist in an order [rad]."""
        return float(self.twist_amplitude[int(np.argmin(np.abs(self.order - order)))])


def torsional_vibration(
    channel: Channel, teeth: int, *, kept: int | None = None, tooth_error: ArrayLike | None = None
) -> TorsionalVibration:
    """Return the torsional vibration of a shaft from the pulses of a tooth wheel on it.

    Parameters
    ----------
    channel : Channel
        Of pulses, one for each tooth.
    teeth : int
        Of the wheel.
    kept : int, optional
        Highest whole order that belongs to the shaft, 8 when not given. What repeats turn after turn above it is put
        down to uneven teeth and left out; what does below it, a joint's even orders above all, stays.
    tooth_error : array (teeth,) [rad], optional
        How far each tooth stands ahead of its place, where it is known, as from a run without torque at 0°; from
        any tooth on. That is left out instead.

    Returns
    -------
    TorsionalVibration

    Raises
    ------
    InputError
        Too few teeth, pulses or turns.

    See Also
    --------
    estimate_rotation, order_spectrum

    Notes
    -----
    Pulse k comes at t_k when the shaft stands at φ_k = 2πk/z. The even turning is the curve through (t̄_k, φ_k), where
    t̄_k is the mean of the times over four turns about k with Hann's weights: it holds no order of 1/2, 3/4, 1 and so
    on. The twist is φ_k less that curve at t_k, and less its own mean over four turns, which a run-up makes. Errors of
    teeth are what is left of its mean over the turns, tooth by tooth, without the orders kept: at one speed nobody can
    tell a wheel divided unevenly twice a turn from a shaft that swings so.

    Examples
    --------
    >>> import numpy as np
    >>> from cardan.recordings import Channel, torsional_vibration
    >>> time = np.arange(60000) / 20000
    >>> angle = 100 * time + 0.01 * np.sin(2 * 100 * time)
    >>> found = torsional_vibration(Channel(name="wheel", quantity="pulses", rate=2e4, values=np.sin(40 * angle)), 40)
    >>> print(f"{found.at(2.0):.4f} rad, {np.max(found.swing):.1f} rad/s")
    0.0100 rad, 2.0 rad/s
    """
    highest = KEPT if kept is None else kept
    check(_bad_options(teeth, highest, tooth_error))
    pulses = counted(channel)
    number = np.arange(int(pulses.count[-1]) + 1)
    times = np.interp(number, pulses.count, pulses.time)
    window = EVEN_TURNS * teeth
    turns = number.size / teeth
    if number.size < LEAST_WINDOWS * window:
        text = _("holds {given:.3g} turns; at least {wanted} are needed for torsional vibration")
        raise refuse(channel.name, text.format(given=turns, wanted=LEAST_WINDOWS * EVEN_TURNS), "out_of_range")
    step = 2.0 * math.pi / teeth
    half = window // 2
    inner = number[half:-half]
    twist, slope = _ahead(times[inner], _averaged(times, window), step * inner)
    twist, slope, inner = twist[half:-half] - _averaged(twist, window), slope[half:-half], inner[half:-half]
    whole = inner.size // window * window
    twist, slope, inner = twist[:whole], slope[:whole], inner[:whole]
    error = _tooth_error(twist, inner, teeth, highest, tooth_error)
    twist = _at_even_angles(twist + error[inner % teeth], step * inner)
    order, lines, swing = _spectrum(twist, teeth, slope)
    jitter = float(np.median(slope)) / (channel.rate * math.sqrt(12.0))
    told = _told(channel, pulses.missing, float(np.std(twist)), jitter, turns)
    return TorsionalVibration(
        name=channel.name,
        teeth=teeth,
        time=times[inner],
        angle=step * inner,
        twist=twist,
        swing=swing,
        speed=slope,
        order=order,
        twist_amplitude=lines,
        tooth_error=error,
        jitter=jitter,
        missing=pulses.missing,
        confidence=channel.trust
        * max(0.05, 1.0 - 2.0 * pulses.doubtful)
        * (0.5 if len(told) > (pulses.missing > 0) else 1),
        cautions=told,
    )


def _bad_options(teeth: int, kept: int, tooth_error: ArrayLike | None) -> list[Problem]:
    found = []
    if teeth < LEAST_TEETH:
        text = _("{value} given; at least {least} are needed").format(value=teeth, least=LEAST_TEETH)
        found.append(Problem("teeth", text, "out_of_range"))
    if not 0 <= kept <= max(teeth, 1) // 2:
        text = _("{value} given; from 0 to half the teeth can be kept").format(value=kept)
        found.append(Problem("kept", text, "out_of_range"))
    if tooth_error is not None and np.shape(tooth_error) != (teeth,):
        found.append(Problem("tooth_error", _("one number for each tooth is needed"), "inconsistent"))
    return found


def _averaged(values: Array, window: int) -> Array:
    """Return means about each value with Hann's weights, for all values with a whole window about them."""
    weights = 0.5 - 0.5 * np.cos(2.0 * np.pi * (np.arange(window + 1)) / window)
    return np.convolve(values, weights / np.sum(weights), mode="valid")


def _ahead(times: Array, even: Array, angle: Array) -> tuple[Array, Array]:
    """Return by how much the angle is ahead of the even turning at each pulse [rad], and its speed [rad/s]."""
    curve = scipy.interpolate.CubicSpline(even, angle)
    return angle - curve(times), np.asarray(curve(times, 1))


def _tooth_error(twist: Array, number: Array, teeth: int, kept: int, known: ArrayLike | None) -> Array:
    """Return how far each tooth stands ahead: what repeats from turn to turn, or what is known, turned to fit that."""
    rows = twist.reshape(-1, teeth)
    lines = -np.fft.rfft(np.roll(np.mean(rows, axis=0), int(number[0]) % teeth))
    lines[: kept + 1] = 0.0
    if known is None:
        return np.fft.irfft(lines, teeth)
    given = np.asarray(known, dtype=float)
    match = np.fft.irfft(lines * np.conj(np.fft.rfft(given)), teeth)
    return np.roll(given, int(np.argmax(match)))


def _at_even_angles(twist: Array, angle: Array) -> Array:
    """Return the twist where the even turning, not the shaft, stands at whole teeth."""
    twist = twist - np.mean(twist)
    found = scipy.interpolate.CubicSpline(angle - twist, twist)(angle)
    return np.asarray(found - np.mean(found))


def _spectrum(twist: Array, teeth: int, speed: Array) -> tuple[Array, Array, Array]:
    """Return orders, peak amplitudes of the twist, and the swing of the speed over the turns."""
    lines = np.fft.rfft(twist)
    turns = twist.size / teeth
    order = np.arange(lines.size) / turns
    amplitude = np.abs(lines) * 2.0 / twist.size
    amplitude[0] *= 0.5
    tapered = np.where(order <= 0.25 * teeth, lines, 0.0)  # beyond, a wheel sees less than four teeth in a period
    swing = np.fft.irfft(1j * order * tapered, twist.size) * speed
    return order, amplitude, swing


def _told(channel: Channel, missing: int, level: float, jitter: float, turns: float) -> tuple[str, ...]:
    told = []
    if missing:
        text = _("{name}: {missing} teeth gave no pulse; they were read between their neighbours.")
        told.append(text.format(name=channel.name, missing=missing))
    if level < 2.0 * jitter:
        text = _("{name}: the oscillation is no larger than what the sampling rate leaves of doubt in each pulse.")
        told.append(text.format(name=channel.name))
    if turns < 4 * EVEN_TURNS:
        text = _("{name}: only {turns:.0f} turns; errors of teeth and vibration can hardly be told apart.")
        told.append(text.format(name=channel.name, turns=turns))
    return tuple(told)
