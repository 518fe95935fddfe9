"""How does a drive run steadily? Periodic motion at a speed, its orders and extremes, and speed sweeps."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, replace
from typing import TypeAlias

import numpy as np

from cardan.errors import refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.curves.extremes import series_at
from cardan.maths.periodic.harmonics import HarmonicBalance, Status, Waves, harmonic_balance
from cardan.maths.periodic.switching_orbit import Pieces, Shooting
from cardan.questions.torsion.model.torsional_balance import places
from cardan.questions.torsion.model.torsional_layouts import Turning, leading, period_of
from cardan.questions.torsion.model.torsional_model import TorsionalModel
from cardan.texts import _

from .orbit import Orbit, at_rest, pieces_of, usual
from .steady_result import Orders, SteadyResponse, read_off

ORDERS = 10.0
"""Highest order told."""

Progress: TypeAlias = Callable[[float], object]
"""Told the share done; may answer "stop"."""

HARMONICS, MOST = 6, 96
"""Harmonics of half a turn to begin with, and those of a motion at most."""

KINKED = 16
"""The same where backlash may open: enough to read off where."""

JOINT_ANGLES = ((0.33, 0.0), (0.66, 0.0), (1.0, 0.0))
"""Shares of the joint angles on the way to a motion without play; no corners."""

WAY = ((0.33, 1.0), (0.66, 1.0), (1.0, 1.0), (1.0, 0.55), (1.0, 0.3), (1.0, 0.17), (1.0, 0.09), (1.0, 0.05))
"""Shares of the joint angles, radii of corners over half the backlash or over `WIDER` bands of friction, on the way to
a motion with open backlash or dry friction."""

RUBBED = (*WAY, (1.0, 0.02), (1.0, 0.005), (1.0, 0.0))
"""The same on the way to a motion with dry friction."""

CHUNK = 256
"""Drives solved at once: their matrices stay in the caches, and progress is told after each chunk."""

FRUITLESS = 5_000
"""What each search by shooting may take at least after others found nothing, each of which halves what the next may;
those that find something take some hundreds."""

ROUNDING = 1e-15
"""Angle [rad] below which one is rounding."""

LOWER = 25
"""Harmonics kept of motions in pieces, beside the pieces themselves."""


def periodic_response(
    model: TorsionalModel,
    *,
    speed: ArrayLike | None = None,
    method: HarmonicBalance | Shooting | None = None,
    orders: float = ORDERS,
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
    >>> from cardan.questions.torsion.model.inputs import Constant
    >>> from cardan.questions.torsion.model.torsional_model import Torque, torsional_line
    >>> load = Torque(station=3, law=Constant(value=-60.0))
    >>> drive = torsional_line([[1.0, 0.02], [0.02, 0.4]], stiffness=[[4000.0], [6000.0]],
    ...     damping=[[1.0], [1.0]], joint_angle=[0.35], torques=[load], input_speed=30.0)
    >>> found = periodic_response(drive)
    >>> found.torque.amplitude[:, 0].round(3)  # order 2
    array([123.541, 117.368])
    """
    orbit, status = steady_orbits(model, speed=speed, method=method, progress=progress)
    return described(orbit, status, orders)


def steady_orbits(
    model: TorsionalModel,
    *,
    speed: ArrayLike | None = None,
    method: HarmonicBalance | Shooting | None = None,
    opened: Shooting | None = None,
    progress: Progress | None = None,
) -> tuple[Orbit, Array]:
    """Return the motions of `periodic_response` alone, and their status, array of int (...).

    model, speed, method, progress: as `periodic_response` takes them.
    opened: how to find motions that are no Fourier sums, where the method does not say it; with no work none is.
    """
    omega = speeds_of(model, speed)
    outer = np.broadcast_shapes(leading(replace(model, input_speed=None)), omega.shape)
    if not model.free:
        model = replace(model, input_speed=omega)
    flat = np.broadcast_to(omega, outer).reshape(-1)
    turning = Turning(model, outer, flat, period_of(model))
    waves, pieces = _solved(turning, method, opened, progress)
    whole = np.pad(waves.coefficient, ((0, 0), (turning.first, 0), (0, 0)))
    orbit = Orbit(
        model=model,
        speed=np.broadcast_to(omega, outer),
        period=turning.period,
        coefficient=whole.reshape(*outer, *whole.shape[1:]),
        force=waves.force.reshape(outer),
        pieces=pieces,
    )
    return orbit, waves.status.reshape(outer)


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
    turning: Turning, method: HarmonicBalance | Shooting | None, opened: Shooting | None, progress: Progress | None
) -> tuple[Waves, dict[int, Pieces]]:
    """Return the motions of all drives, chunk by chunk."""
    count = len(turning.speed)
    parts: list[Waves] = []
    pieces: dict[int, Pieces] = {}
    stopped, fruitless = False, 0
    smooth_alone = turning.model.rubs and opened is not None and not opened.work
    for first in range(0, count, CHUNK):
        rows = np.arange(first, min(first + CHUNK, count))
        if stopped:
            parts.append(_nothing(len(rows), turning.coordinates, Status.CANCELLED))
            continue
        part = turning.part(rows)
        waves, near = (_nothing(len(rows), turning.coordinates, Status.NO_CONVERGENCE) for _each in range(2))
        if not isinstance(method, Shooting):
            waves, near = _by_waves(part, method, smooth_alone=smooth_alone)
        own: dict[int, Pieces] = {}
        lost: list[int] = []
        for k in np.flatnonzero(waves.status != Status.CONVERGED).tolist() if not smooth_alone else ():
            if stopped:
                waves.status[k] = Status.CANCELLED
                continue
            alone = part.part(np.asarray([k]))
            how = method if isinstance(method, Shooting) else opened or usual(alone)
            how = replace(how, work=min(how.work, max(how.work >> fruitless, FRUITLESS)))
            if isinstance(method, Shooting):
                found = pieces_of(alone, method=how)
            else:
                found = pieces_of(alone, near.coefficient[k], float(near.force[k]), method=how)
            if found is None:
                fruitless += 1
                lost.append(k)
            else:
                own[k] = found
            stopped = progress is not None and progress((int(rows[k]) + 1) / count) == "stop"
        if lost and not isinstance(method, Shooting) and _kinked(part):
            waves = _put(waves, np.asarray(lost), _sharp(part.part(np.asarray(lost)), _some(near, np.asarray(lost))))
        parts.append(_with_pieces(waves, own))
        pieces |= {int(rows[k]): found for k, found in own.items()}
        stopped = stopped or (progress is not None and progress((int(rows[-1]) + 1) / count) == "stop")
    wide = max(part.coefficient.shape[-1] for part in parts)
    whole = {name: np.concatenate([getattr(part, name) for part in parts]) for name in ("force", "status", "tail")}
    return Waves(coefficient=np.concatenate([_widened(part.coefficient, wide) for part in parts]), **whole), pieces


def _with_pieces(waves: Waves, pieces: dict[int, Pieces]) -> Waves:
    """Return the sums with the lower harmonics of motions in pieces in their place."""
    if not pieces:
        return waves
    coefficient, force, status = waves.coefficient.copy(), waves.force.copy(), waves.status.copy()
    if coefficient.shape[-1] < LOWER:
        coefficient = np.pad(coefficient, ((0, 0), (0, 0), (0, LOWER - coefficient.shape[-1])))
    for k, found in pieces.items():
        coefficient[k] = fourier_of(found, coefficient.shape[-1])
        force[k], status[k] = found.force, Status.CONVERGED
    return replace(waves, coefficient=coefficient, force=force, status=status)


def fourier_of(found: Pieces, width: int) -> Array:
    """Return the lower coefficients of a motion in pieces, array (R, width), complex."""
    time, weight, x, _v, _a = found.points
    turn = np.exp(-1j * found.omega * time[..., None] * np.arange(width)) * weight[..., None] * (2.0 / found.duration)
    turn[..., 0] *= 0.5
    return np.asarray(np.einsum("nsk,nsr->rk", turn, x))


def _nothing(count: int, coordinates: int, status: Status) -> Waves:
    return Waves(
        coefficient=np.full((count, coordinates, 1), np.nan + 0j),
        force=np.full(count, np.nan),
        status=np.full(count, int(status)),
        tail=np.full(count, np.nan),
    )


def _by_waves(part: Turning, method: HarmonicBalance | None, *, smooth_alone: bool = False) -> tuple[Waves, Waves]:
    """Return motions as Fourier sums, where play stays closed, and sums to search from where there are none.

    smooth_alone: whether the way to motions in which friction slips is left out, for nothing is searched from it.
    """
    half_turns, smooth = round(part.period / np.pi), closed(part)
    how = method or HarmonicBalance(harmonics=HARMONICS * half_turns, most=MOST)
    found = sums_of(smooth, at_rest(smooth), how)
    lost = np.flatnonzero((found.status == Status.NO_CONVERGENCE) | ~stays_closed(part, found.coefficient))
    if not lost.size:
        return found, found
    if smooth_alone:
        found.status[lost] = Status.NO_CONVERGENCE
        return found, found
    if _kinked(part):
        kinked = HarmonicBalance(harmonics=KINKED * half_turns, most=KINKED * half_turns)
        again = _along(part.part(lost), RUBBED if part.model.rubs else WAY, kinked)
        again = replace(again, status=np.full(len(lost), int(Status.NO_CONVERGENCE)))  # corners are not that round
    else:
        again = _along(part.part(lost), JOINT_ANGLES, how)
    there = (again.status != Status.NO_CONVERGENCE)[:, None, None]
    known = replace(again, coefficient=np.where(there, again.coefficient, np.nan))
    return _put(found, lost, known), _put(found, lost, again)


def _kinked(part: Turning) -> bool:
    """Tell whether motions have kinks: where backlash opens, or friction sticks."""
    return part.model.rubs or bool(np.any(part.model.backlash > 0.0))


def _sharp(part: Turning, near: Waves) -> Waves:
    """Return what motions with kinks are, at least coarsely, where no pieces were found."""
    half_turns = round(part.period / np.pi)
    how = HarmonicBalance(harmonics=KINKED * half_turns, most=2 * KINKED * half_turns)
    found = sums_of(part, near.coefficient, how)
    lost = np.flatnonzero(found.status == Status.NO_CONVERGENCE)
    if lost.size:  # the way from the straight drive may have turned back
        some = part.part(lost)
        found = _put(found, lost, sums_of(some, at_rest(some), how))
    return found


def sums_of(part: Turning, start: Array, how: HarmonicBalance) -> Waves:
    """Return motions by harmonic balance, those of free drives beginning with the shaft angle."""
    free = part.model.free
    found = harmonic_balance(part, part.frequency, part.coordinates, free=free, start=start, method=how)
    lost = found.status == Status.NO_CONVERGENCE
    coefficient = started(found.coefficient, part.period) if free else found.coefficient
    return replace(
        found,
        coefficient=np.where(lost[:, None, None], np.nan, coefficient),
        force=np.where(lost, 0.0, found.force),
    )


def _along(part: Turning, way: tuple[tuple[float, float], ...], how: HarmonicBalance) -> Waves:
    """Return the motions at the end of a way of growing bends and ever sharper corners of play.

    The sums of a step that has none are those of the step before, and so to be searched from alone.
    """
    found = Waves(
        coefficient=at_rest(part),
        force=np.zeros(len(part.speed)),
        status=np.full(len(part.speed), int(Status.NO_CONVERGENCE)),
        tail=np.zeros(len(part.speed)),
    )
    for share, rounding in way:
        bent = Turning(part.model, part.angle_error, part.speed, part.period, np.full(len(part.speed), share), rounding)
        next_ = sums_of(bent, found.coefficient, how)
        there = np.flatnonzero(next_.status != Status.NO_CONVERGENCE)
        found = replace(_put(found, there, _some(next_, there)), status=next_.status)
    return found


def _some(waves: Waves, rows: Array) -> Waves:
    """Return some of the motions."""
    return Waves(**{one.name: getattr(waves, one.name)[rows] for one in fields(Waves)})


def _put(waves: Waves, rows: Array, others: Waves) -> Waves:
    """Return motions with others in their place."""
    wide = max(waves.coefficient.shape[-1], others.coefficient.shape[-1])
    found = {one.name: getattr(waves, one.name).copy() for one in fields(Waves)}
    found["coefficient"] = _widened(waves.coefficient, wide)
    found["coefficient"][rows] = _widened(others.coefficient, wide)
    for name in ("force", "status", "tail"):
        found[name][rows] = getattr(others, name)
    return Waves(**found)


def _widened(coefficient: Array, width: int) -> Array:
    """Return sums of a given number of coefficients."""
    return np.pad(coefficient, ((0, 0), (0, 0), (0, width - coefficient.shape[-1])))


def started(coefficient: Array, period: float) -> Array:
    """Return motions shifted in time so that the first coordinate is 0 with the shaft angle."""
    scale = 2.0 * np.pi / period
    order = np.arange(coefficient.shape[-1])
    shift = np.zeros(len(coefficient))
    for _round in range(50):
        wave = coefficient[:, 0] * np.exp(1j * scale * shift[:, None] * order)
        value, slope = np.sum(wave.real, axis=-1), -scale * np.sum(order * wave.imag, axis=-1)
        step = (shift + value) / np.maximum(1.0 + slope, 0.2)
        shift = shift - step
        if np.all(np.abs(step) <= ROUNDING):
            break
    moved = coefficient * np.exp(1j * scale * shift[:, None, None] * order)
    moved[:, :, 0] += shift[:, None]
    return moved


def described(orbit: Orbit, status: Array, orders: float = ORDERS) -> SteadyResponse:
    """Return what is known of the motions."""
    base = 2.0 * np.pi / orbit.period
    count = max(1, int(np.ceil(orders / base - 1e-9)))
    found, angle_error = read_off(orbit, count), orbit.angle_error

    def named(curves: Array) -> Orders:
        whole = curves.reshape(*angle_error, *curves.shape[1:])
        return Orders(mean=whole[..., 0].real, amplitude=np.abs(whole[..., 1:]), phase=np.angle(whole[..., 1:]))

    return SteadyResponse(
        orbit=orbit,
        order=base * np.arange(1, count + 1),
        torque=named(found.torque),
        torque_lowest=found.lowest.reshape(*angle_error, -1),
        torque_highest=found.highest.reshape(*angle_error, -1),
        station_speed=named(found.speed),
        drive_torque=named(found.drive),
        status=status.reshape(angle_error),
        residual=found.residual.reshape(angle_error),
        power_residual=found.power_residual.reshape(angle_error),
    )


# Drives whose play stays closed: until a torque changes its sign they run as if they had none.

FINE = 512
"""Places of a period at which contact is looked at."""


def closed(turning: Turning) -> Turning:
    """Return drives without play that rest on the side to which their mean torques push them.

    turning: drives in one axis, as `Turning.part` gives them.
    """
    model, rest = turning.model, _rest(turning.model)
    shifted = replace(model, backlash=np.zeros_like(model.backlash), rest=rest + 0.5 * _sides(turning) * model.backlash)
    return Turning(shifted, turning.angle_error, turning.speed, turning.period)


def stays_closed(turning: Turning, coefficient: Array) -> Array:
    """Tell which motions keep all play on the side to which mean torques push it, array of bool (b,).

    turning: drives in one axis, with their play.
    coefficient (b, R, H+1), complex: motions of the free coordinates, as those of `closed` drives; nan where there is
    none.
    """
    if not np.any(turning.model.backlash > 0.0):
        return np.ones(len(turning.speed), dtype=bool)
    phase = 2.0 * np.pi * np.arange(FINE) / FINE
    twist = _twists(turning, phase, series_at(coefficient, phase)[0])
    sides, half = _sides(turning)[:, None], 0.5 * turning.model.backlash[:, None]
    found: Array = np.all((half == 0.0) | (sides * twist > half), axis=(1, 2))
    return found


def _rest(model: TorsionalModel) -> Array:
    return np.zeros_like(model.backlash) if model.rest is None else model.rest


def _twists(turning: Turning, phase: Array, x: Array) -> Array:
    """Return the twists of the elements off their rest, array (b, p, E)."""
    drives = turning.drives(np.arange(len(turning.speed)))
    angle = places(drives, turning.motion(np.arange(len(turning.speed)), phase, x, x, x)[0]).angle
    heads, tails = [a for a, _b in drives.elements], [b for _a, b in drives.elements]
    return angle[..., heads] - angle[..., tails] - _rest(drives)[:, None]


def _sides(turning: Turning) -> Array:
    """Return the side to which mean torques push each element, 0 where nothing does: array of int (b, E)."""
    model, rested = turning.model, at_rest(turning)[..., 0].real
    q = np.pad(rested, ((0, 0), (turning.first, 0)))
    ends = [(model.coordinate[a], model.coordinate[b]) for a, b in model.elements]
    twist = q[:, [a for a, _b in ends]] - q[:, [b for _a, b in ends]] - _rest(model)
    return np.where(np.abs(twist) > 0.5 * model.backlash, np.sign(twist), 0.0).astype(int)
