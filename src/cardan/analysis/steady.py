"""How does a drive run steadily? Periodic motion at a speed, its orders and extremes, and speed sweeps."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TypeAlias

import numpy as np

from cardan.errors import refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.periodic import HarmonicBalance, Status, Waves, harmonic_balance
from cardan.maths.waves import extremes, sampled_series
from cardan.texts import _

from .orbit import Orbit
from .steady_result import Orders, SteadyResponse
from .steady_start import at_rest
from .torsional_balance import balance, element_torques, places, power
from .torsional_batch import Turning, leading, period_of
from .torsional_model import TorsionalModel

Progress: TypeAlias = Callable[[float], object]
"""Told the share done; may answer "stop"."""

HARMONICS = 6
"""Harmonics of half a turn to begin with."""

CHUNK = 256
"""Drives solved at once: their matrices stay in the caches, and progress is told after each chunk."""


def periodic_response(
    model: TorsionalModel,
    *,
    speed: ArrayLike | None = None,
    method: HarmonicBalance | None = None,
    orders: float = 10.0,
    progress: Progress | None = None,
) -> SteadyResponse:
    """Return the steady running of drives.

    Parameters
    ----------
    model : TorsionalModel (...)
        Its torques follow the angle of their station or its speed.
    speed : array (...) [rad/s], optional
        Of the input, or mean speed of a free drive; by default the input speed of the model. Its axes and those of
        the model spread over each other.
    method : HarmonicBalance, optional
    orders : float
        Highest order told.
    progress : function, optional
        Told the share done; when it answers "stop" the remaining drives are left out as cancelled.

    Returns
    -------
    SteadyResponse

    Raises
    ------
    InputError
        No speed, a speed of 0, torques that do not repeat with the turning.

    Notes
    -----
    Unknown: what each coordinate is off even rotation, by harmonics of π, 2π or 4π of shaft angle, the shortest that
    all torques allow. Of a free drive the mean speed is given and the constant torque that keeps it is sought; time is
    counted so that its first station passes its start position with the shaft angle.

    Examples
    --------
    >>> from .torques import Constant
    >>> from .torsional_model import Torque, torsional_line
    >>> load = Torque(station=3, law=Constant(value=-60.0))
    >>> drive = torsional_line([[1.0, 0.02], [0.02, 0.4]], stiffness=[[4000.0], [6000.0]],
    ...     damping=[[1.0], [1.0]], bend=[0.35], torques=[load], input_speed=30.0)
    >>> found = periodic_response(drive)
    >>> found.torque.amplitude[:, 0].round(3)  # order 2
    array([123.541, 117.368])
    """
    omega = _speeds(model, speed)
    lead = np.broadcast_shapes(leading(replace(model, input_speed=None)), omega.shape)
    if not model.free:
        model = replace(model, input_speed=omega)
    flat = np.broadcast_to(omega, lead).reshape(-1)
    turning = Turning(model, lead, flat, period_of(model))
    how = method or HarmonicBalance(harmonics=HARMONICS * round(turning.period / np.pi), most=96)
    waves = _solved(turning, how, progress)
    whole = np.pad(waves.coefficient, ((0, 0), (turning.first, 0), (0, 0)))
    orbit = Orbit(
        model=model,
        speed=np.broadcast_to(omega, lead),
        period=turning.period,
        coefficient=whole.reshape(*lead, *whole.shape[1:]),
        force=waves.force.reshape(lead),
    )
    return _described(orbit, turning, waves, orders)


def _speeds(model: TorsionalModel, speed: ArrayLike | None) -> Array:
    """Return the speeds asked for."""
    if model.input_motion is not None:
        raise refuse("input_motion", _("its speed changes; steady running needs one speed"))
    if speed is None and model.input_speed is None:
        raise refuse("speed", _("missing; a free drive needs the mean speed it turns at"))
    omega = np.asarray(model.input_speed if speed is None else speed, dtype=float)
    wrong = ~np.isfinite(omega) | (omega == 0.0)
    if np.any(wrong):
        text = _("{value:.6g} given; steady running needs a speed other than 0")
        raise refuse("speed", text.format(value=float(omega[wrong].flat[0])))
    return omega


def _solved(turning: Turning, how: HarmonicBalance, progress: Progress | None) -> Waves:
    """Return the motions of all drives chunk by chunk."""
    count = len(turning.speed)
    parts: list[Waves] = []
    stopped = False
    for first in range(0, count, CHUNK):
        rows = np.arange(first, min(first + CHUNK, count))
        if stopped:
            parts.append(_nothing(len(rows), turning.coordinates))
            continue
        parts.append(_chunk(turning, rows, how))
        stopped = progress is not None and progress((int(rows[-1]) + 1) / count) == "stop"
    wide = max(part.coefficient.shape[-1] for part in parts)
    padded = [np.pad(part.coefficient, ((0, 0), (0, 0), (0, wide - part.coefficient.shape[-1]))) for part in parts]
    return Waves(
        coefficient=np.concatenate(padded),
        **{name: np.concatenate([getattr(part, name) for part in parts]) for name in ("force", "status", "tail")},
    )


def _nothing(count: int, coordinates: int) -> Waves:
    return Waves(
        coefficient=np.full((count, coordinates, 1), np.nan + 0j),
        force=np.full(count, np.nan),
        status=np.full(count, int(Status.CANCELLED)),
        tail=np.full(count, np.nan),
    )


def _chunk(turning: Turning, rows: Array, how: HarmonicBalance) -> Waves:
    """Return the motions of some drives; those without one are nan."""
    part = turning.part(rows)
    found = harmonic_balance(
        part, part.frequency, part.coordinates, free=part.model.free, start=at_rest(part), method=how
    )
    lost = found.status == Status.NO_CONVERGENCE
    coefficient = np.where(lost[:, None, None], np.nan, found.coefficient)
    if part.model.free:
        coefficient = _started(coefficient, part.period)
    return replace(found, coefficient=coefficient, force=np.where(lost, np.nan, found.force))


def _started(coefficient: Array, period: float) -> Array:
    """Return motions shifted in time so that the first coordinate is 0 with the shaft angle."""
    scale = 2.0 * np.pi / period
    order = np.arange(coefficient.shape[-1])
    shift = np.zeros(len(coefficient))
    for _round in range(50):
        wave = coefficient[:, 0] * np.exp(1j * scale * shift[:, None] * order)
        value, slope = np.sum(wave.real, axis=-1), -scale * np.sum(order * wave.imag, axis=-1)
        shift = shift - (shift + value) / np.maximum(1.0 + slope, 0.2)
    moved = coefficient * np.exp(1j * scale * shift[:, None, None] * order)
    moved[:, :, 0] += shift[:, None]
    return moved


def _described(orbit: Orbit, turning: Turning, waves: Waves, orders: float) -> SteadyResponse:
    """Return what is known of the motions."""
    base = 2.0 * np.pi / orbit.period
    count = max(1, int(np.ceil(orders / base - 1e-9)))
    samples = max(8 * (waves.coefficient.shape[-1] + 1), 2 * count + 2)
    angle = orbit.period * np.arange(samples) / samples
    parts = [
        _curves(orbit, turning, np.arange(first, min(first + CHUNK, orbit.count)), angle)
        for first in range(0, orbit.count, CHUNK)
    ]
    torque, speed, drive, residual, missed = (np.concatenate(each) for each in zip(*parts, strict=True))
    lead = orbit.lead
    lowest, highest = extremes(sampled_series(torque))
    return SteadyResponse(
        orbit=orbit,
        order=base * np.arange(1, count + 1),
        torque=_orders(torque, count, lead),
        torque_lowest=lowest.reshape(*lead, -1),
        torque_highest=highest.reshape(*lead, -1),
        station_speed=_orders(speed, count, lead),
        drive_torque=_orders(drive, count, lead),
        status=waves.status.reshape(lead),
        residual=residual.reshape(lead),
        power_residual=missed.reshape(lead),
    )


def _orders(samples: Array, count: int, lead: tuple[int, ...]) -> Orders:
    found = sampled_series(samples)[..., : count + 1]
    found = found.reshape(*lead, *found.shape[1:])
    return Orders(mean=found[..., 0].real, amplitude=np.abs(found[..., 1:]), phase=np.angle(found[..., 1:]))


def _curves(orbit: Orbit, turning: Turning, rows: Array, angle: Array) -> tuple[Array, ...]:
    """Return samples of torques (b, E, p), speeds (b, N, p) and drive torque (b, 1, p), and the two residuals (b,)."""
    drives = orbit.drives(rows)
    q, rate, acceleration = orbit.of(rows, angle)
    torque = element_torques(drives, q, rate)
    speed = places(drives, q).first * rate[..., list(drives.coordinate)]
    left = balance(drives, q, rate, acceleration)
    given, lost = power(drives, q, rate)
    omega = np.abs(turning.speed[rows])
    force = orbit.force.reshape(-1)[rows][:, None]
    if drives.free:
        left[..., 0] -= force
        drive = force + 0.0 * given
    else:
        drive = left[..., 0]
    outer = np.max(np.abs(given), axis=-1) / omega
    largest = np.maximum(np.max(np.abs(torque), axis=(-1, -2), initial=0.0), outer)
    largest = np.where(largest > 0.0, largest, 1.0)
    brought = drive * rate[..., 0]
    missed = np.abs(np.mean(given + brought - lost, axis=-1))
    residual = np.max(np.abs(left[..., turning.first :]), axis=(-1, -2), initial=0.0)
    return (
        torque.swapaxes(-1, -2),
        speed.swapaxes(-1, -2),
        drive[:, None, :],
        residual / largest,
        missed / (largest * omega),
    )
