"""How does a drive run steadily? Periodic motion at a speed, its orders and extremes, and speed sweeps."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TypeAlias

import numpy as np

from cardan.errors import refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.periodic import HarmonicBalance, Status, Waves, harmonic_balance
from cardan.maths.pieces import Pieces, Shooting
from cardan.maths.waves import series_at
from cardan.texts import _

from .backlash_orbit import Backlashed, pieces_of
from .orbit import Orbit
from .steady_orders import read_off
from .steady_result import Orders, SteadyResponse
from .steady_start import at_rest
from .torsional_batch import Turning, leading, period_of
from .torsional_model import TorsionalModel

Progress: TypeAlias = Callable[[float], object]
"""Told the share done; may answer "stop"."""

HARMONICS = 6
"""Harmonics of half a turn to begin with."""

KINKED = 16
"""The same where backlash may open: enough to read off where."""

CHUNK = 256
"""Drives solved at once: their matrices stay in the caches, and progress is told after each chunk."""

LOWER = 25
"""Harmonics kept of motions in pieces, beside the pieces themselves."""

FINE = 512
"""Places of a period at which contact is looked at."""


def periodic_response(
    model: TorsionalModel,
    *,
    speed: ArrayLike | None = None,
    method: HarmonicBalance | Shooting | None = None,
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
    method : HarmonicBalance or Shooting, optional
        By default harmonic balance, and shooting where backlash opens or no Fourier sum was found.
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
    omega = speeds_of(model, speed)
    lead = np.broadcast_shapes(leading(replace(model, input_speed=None)), omega.shape)
    if not model.free:
        model = replace(model, input_speed=omega)
    flat = np.broadcast_to(omega, lead).reshape(-1)
    turning = Turning(model, lead, flat, period_of(model))
    waves, pieces = _solved(turning, method, progress)
    whole = np.pad(waves.coefficient, ((0, 0), (turning.first, 0), (0, 0)))
    orbit = Orbit(
        model=model,
        speed=np.broadcast_to(omega, lead),
        period=turning.period,
        coefficient=whole.reshape(*lead, *whole.shape[1:]),
        force=waves.force.reshape(lead),
        pieces=pieces,
    )
    return _described(orbit, waves.status, orders)


def speeds_of(model: TorsionalModel, speed: ArrayLike | None) -> Array:
    """Return the speeds asked for; refuse those at which nothing runs steadily."""
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


def _solved(
    turning: Turning, method: HarmonicBalance | Shooting | None, progress: Progress | None
) -> tuple[Waves, dict[int, Pieces]]:
    """Return the motions of all drives, chunk by chunk."""
    count = len(turning.speed)
    parts: list[Waves] = []
    pieces: dict[int, Pieces] = {}
    stopped = False
    for first in range(0, count, CHUNK):
        rows = np.arange(first, min(first + CHUNK, count))
        if stopped:
            parts.append(_nothing(len(rows), turning.coordinates, Status.CANCELLED))
            continue
        waves = _nothing(len(rows), turning.coordinates, Status.NO_CONVERGENCE)
        if not isinstance(method, Shooting):
            waves = _by_waves(turning.part(rows), method)
        for k, row in enumerate(rows):
            if stopped or (waves.status[k] == Status.CONVERGED and not _switches(turning, int(row), waves, k)):
                continue
            alone = turning.part(rows[k : k + 1])
            if isinstance(method, Shooting):
                found = pieces_of(alone, method=method)
            else:
                found = pieces_of(alone, waves.coefficient[k], float(waves.force[k]))
            if found is not None:
                pieces[int(row)] = found
            stopped = progress is not None and progress((int(row) + 1) / count) == "stop"
        parts.append(_with_pieces(waves, {k: pieces[int(row)] for k, row in enumerate(rows) if int(row) in pieces}))
        stopped = stopped or (progress is not None and progress((int(rows[-1]) + 1) / count) == "stop")
    wide = max(part.coefficient.shape[-1] for part in parts)
    padded = [np.pad(part.coefficient, ((0, 0), (0, 0), (0, wide - part.coefficient.shape[-1]))) for part in parts]
    whole = {name: np.concatenate([getattr(part, name) for part in parts]) for name in ("force", "status", "tail")}
    return Waves(coefficient=np.concatenate(padded), **whole), pieces


def _with_pieces(waves: Waves, pieces: dict[int, Pieces]) -> Waves:
    """Return the sums with the lower harmonics of motions in pieces in their place."""
    if not pieces:
        return waves
    coefficient, force, status = waves.coefficient.copy(), waves.force.copy(), waves.status.copy()
    if coefficient.shape[-1] < LOWER:
        coefficient = np.pad(coefficient, ((0, 0), (0, 0), (0, LOWER - coefficient.shape[-1])))
    order = np.arange(coefficient.shape[-1])
    for k, found in pieces.items():
        time, weight, x, _v, _a = found.points
        turn = np.exp(-1j * found.omega * time[..., None] * order) * weight[..., None] * (2.0 / found.duration)
        turn[..., 0] *= 0.5
        coefficient[k] = np.einsum("nsk,nsr->rk", turn, x)
        force[k], status[k] = found.force, Status.CONVERGED
    return replace(waves, coefficient=coefficient, force=force, status=status)


def _switches(turning: Turning, row: int, waves: Waves, k: int) -> bool:
    """Tell whether an element of a motion comes out of contact, or changes its side."""
    drives = turning.drives(np.asarray([row]))
    if not np.any(drives.backlash > 0.0):
        return False
    switching = Backlashed(turning.part(np.asarray([row])))
    phase = 2.0 * np.pi * np.arange(FINE) / FINE
    twist = switching.twist(phase, series_at(waves.coefficient[k], phase)[0])[0]
    inside = (np.abs(twist) <= switching.play) & (switching.play > 0.0)
    return bool(np.any(inside) or np.any(np.any(twist > switching.play, axis=0) & np.any(twist < 0.0, axis=0)))


def _nothing(count: int, coordinates: int, status: Status) -> Waves:
    return Waves(
        coefficient=np.full((count, coordinates, 1), np.nan + 0j),
        force=np.full(count, np.nan),
        status=np.full(count, int(status)),
        tail=np.full(count, np.nan),
    )


def _by_waves(part: Turning, method: HarmonicBalance | None) -> Waves:
    """Return the motions of some drives as Fourier sums; those without one are nan."""
    free, half_turns = part.model.free, round(part.period / np.pi)
    start = rested = at_rest(part)
    how = method or HarmonicBalance(harmonics=HARMONICS * half_turns, most=96)
    if method is None and np.any(part.model.backlash > 0.0):
        how = HarmonicBalance(harmonics=KINKED * half_turns, most=2 * KINKED * half_turns)
        few = replace(how, most=how.harmonics)
        for share in (0.25, 0.5, 0.75):
            shares = np.full(len(part.speed), share)
            bent = Turning(part.model, part.lead, part.speed, part.period, shares)
            start = harmonic_balance(
                bent, bent.frequency, bent.coordinates, free=free, start=start, method=few
            ).coefficient
    found = harmonic_balance(part, part.frequency, part.coordinates, free=free, start=start, method=how)
    lost = found.status == Status.NO_CONVERGENCE
    if start is not rested and np.any(lost):  # the way from the straight drive turned back
        again = harmonic_balance(part, part.frequency, part.coordinates, free=free, start=rested, method=how)
        found = _either(found, again, lost)
        lost = found.status == Status.NO_CONVERGENCE
    coefficient = np.where(lost[:, None, None], np.nan, found.coefficient)
    if free:
        coefficient = started(coefficient, part.period)
    return replace(found, coefficient=coefficient, force=np.where(lost, np.nan, found.force))


def _either(one: Waves, other: Waves, chosen: Array) -> Waves:
    """Return the other motions where chosen."""
    wide = max(one.coefficient.shape[-1], other.coefficient.shape[-1])
    pair = [np.pad(w.coefficient, ((0, 0), (0, 0), (0, wide - w.coefficient.shape[-1]))) for w in (one, other)]
    rest = {name: np.where(chosen, getattr(other, name), getattr(one, name)) for name in ("force", "status", "tail")}
    return Waves(coefficient=np.where(chosen[:, None, None], pair[1], pair[0]), **rest)


def started(coefficient: Array, period: float) -> Array:
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


def _described(orbit: Orbit, status: Array, orders: float) -> SteadyResponse:
    """Return what is known of the motions."""
    base = 2.0 * np.pi / orbit.period
    count = max(1, int(np.ceil(orders / base - 1e-9)))
    found, lead = read_off(orbit, count), orbit.lead

    def named(curves: Array) -> Orders:
        whole = curves.reshape(*lead, *curves.shape[1:])
        return Orders(mean=whole[..., 0].real, amplitude=np.abs(whole[..., 1:]), phase=np.angle(whole[..., 1:]))

    return SteadyResponse(
        orbit=orbit,
        order=base * np.arange(1, count + 1),
        torque=named(found.torque),
        torque_lowest=found.lowest.reshape(*lead, -1),
        torque_highest=found.highest.reshape(*lead, -1),
        station_speed=named(found.speed),
        drive_torque=named(found.drive),
        status=status.reshape(lead),
        residual=found.residual.reshape(lead),
        power_residual=found.power_residual.reshape(lead),
    )
