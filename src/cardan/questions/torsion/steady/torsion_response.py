"""How does a drive vibrate in torsion as it runs? Steady motion at a speed or over many, and whether it is stable."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from typing import TypeAlias

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.machine import TorqueHistory
from cardan.errors import Problem, check, refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.periodic.harmonics import HarmonicBalance
from cardan.maths.periodic.switching_orbit import Shooting
from cardan.questions.torsion.model.inputs import Swinging, base_period
from cardan.questions.torsion.model.torsional_model import Torque, TorsionalModel
from cardan.questions.torsion.model.torsional_modes import base_order, main_order, straight_modes, straight_waves
from cardan.questions.torsion.model.torsional_train import TorsionalTrain, in_time, sprung, torsional_train
from cardan.texts import _

from .orbit import Orbit
from .run_stability import SECOND, Floquet, floquet, nearest_zone
from .several import Beside, stable_motions, told_motions, widened
from .steady import described, steady_orbits
from .steady_result import SteadyResponse
from .two_frequencies import SideBands, grouped, side_bands
from .two_frequency_stability import with_torques

Progress: TypeAlias = Callable[[float], object]
"""Told the share done; may answer "stop"."""

ROUNDING = 1e-8
"""Share of a swing below which the mean about which it goes is left over by rounding."""

UNLOADED = 1e-3
"""The same where no mean torque acts: what damping and the joints leave of it is below the last digit told."""

ROUNDS, CLOSER, FLAT = 8, 3, 1e-3
"""How often further speeds are put about the largest alternating torque, how many on either side, and the share by
which its neighbours may lie lower where none are needed."""

COUNTED = 40
"""Speeds at most at which the stability counts torques that do not repeat: seconds all together."""

SHARE = 0.35
"""Share of the work that finds motions; the rest judges them."""


@dataclass(frozen=True, eq=False, kw_only=True)
class NonsynchronousOrder:
    """A torque whose order no two turns hold a whole number of times: what it makes of the order that is its own."""

    order: float  # of the input shaft
    station: int  # on which it acts
    torque: Array  # (..., E) [N·m], complex: of every element
    exact: Array  # (...) of bool: whether by the motion of both frequencies; else by the straight line


@dataclass(frozen=True, eq=False, kw_only=True)
class TorsionResponse:
    """Steady torsional vibration of a drive; leading axes (...) are those of the speeds.

    Attributes
    ----------
    train : TorsionalTrain
        The model, and where its stations are.
    steady : SteadyResponse (...)
        Torques and speeds by their orders, true extremes.
    floquet : Floquet (...)
        Whether the motion is stable; with torques whose orders do not repeat within two turns where they count.
    apart : tuple of NonsynchronousOrder
        Torques of orders that do not repeat within two turns.
    bands : tuple of SideBands
        The exact motions under the joints and these torques, with the side bands |ν ± 2r|; where there is none, as
        with open backlash, the straight line answers and its amplitudes are added.
    beside : tuple of Beside
        Further stable motions, each with a smaller swing than the one that is told at its speed, or of several periods:
        where these run, they count in the extremes; orders and stability are those of the motion of one period.
    assumed : tuple of str
        Paths of what the drive does not say and the answer assumes.
    together : array of bool (...)
        Whether the stability counts torques of orders that do not repeat within two turns, by the motion with them; it
        does at up to `COUNTED` speeds, where that motion is known.
    """

    train: TorsionalTrain
    steady: SteadyResponse
    floquet: Floquet
    apart: tuple[NonsynchronousOrder, ...]
    assumed: tuple[str, ...]
    bands: tuple[SideBands, ...] = ()
    beside: tuple[Beside, ...] = ()
    together: Array = field(default_factory=lambda: np.asarray(False))

    @property
    def speed(self) -> Array:
        """Input speed, mean speed of a free drive, array (...) [rad/s]."""
        return self.steady.speed

    @property
    def torque_highest(self) -> Array:
        """Highest torque of every element, array (..., E) [N·m]."""
        return self._extreme(self.steady.torque_highest, 1.0)

    @property
    def torque_lowest(self) -> Array:
        """Lowest torque of every element, array (..., E) [N·m]; below 0 it lifts off, and backlash rattles."""
        return self._extreme(self.steady.torque_lowest, -1.0)

    def _extreme(self, alone: Array, sign: float) -> Array:
        """Return lowest or highest torques with what does not repeat, from those without it."""
        more = np.zeros_like(alone)
        for one in self.apart:
            more = more + np.where(one.exact[..., None], 0.0, sign * np.abs(one.torque))
        for band in self.bands:
            whole = (band.highest if sign > 0.0 else band.lowest).reshape(alone.shape)
            more = more + np.where(band.found.reshape(self.speed.shape)[..., None], whole - alone, 0.0)
        flat = (alone + more).reshape(-1, alone.shape[-1])
        return widened(flat, flat, self.beside)[int(sign > 0.0)].reshape(alone.shape)

    @property
    def loaded(self) -> bool:
        """Whether a mean torque acts on it: of machines, of the duty, of bearings."""
        model = self.train.model
        speed = np.abs(np.ravel(self.speed))
        means = (one.law.at(0.0 * speed, 0.0 * speed, speed)[0] for one in model.torques if one.law.order == 0.0)
        return bool(np.any(model.ground_damping)) or any(bool(np.any(one != 0.0)) for one in means)

    def side_orders(self, share: float) -> list[tuple[float, float]]:
        """Return the side bands with their largest torque, of an element and at a speed, above a share of the whole.

        share: of the largest alternating torque. The orders of the torques themselves are not among them.
        """
        own = [abs(one.order) for one in self.apart]
        found = []
        for band in self.bands:
            size = np.max(np.abs(band.amplitude[band.found]), axis=(0, 1), initial=0.0)
            found += [(float(order), float(one)) for order, one in zip(band.order, size, strict=True)]
        least = share * float(np.nanmax(self.swing, initial=0.0))
        return [(order, one) for order, one in found if one > least and not np.any(np.isclose(order, own))]

    @property
    def swing(self) -> Array:
        """Half of highest less lowest torque of every element, array (..., E) [N·m]."""
        found: Array = 0.5 * (self.torque_highest - self.torque_lowest)
        return found


def torsion_response(
    drive: Drive,
    duty: Duty | None = None,
    *,
    speed: ArrayLike | None = None,
    method: HarmonicBalance | Shooting | None = None,
    pieces: int = 1,
    progress: Progress | None = None,
) -> TorsionResponse:
    """Return how a drive vibrates in torsion while it runs steadily.

    Parameters
    ----------
    drive : Drive
        With bodies or inertias and stiffnesses of its shafts, or `[[stations]]`; better with damping.
    duty : Duty, optional
        What it does; that of the drive by default.
    speed : float or array (s,) [rad/s], optional
        Input speeds, none of them 0; that of the duty by default.
    method : HarmonicBalance or Shooting, optional
        How to find the motion; harmonic balance by default, shooting where backlash opens.
    pieces : int
        Into how many equal stretches the body between two stations is divided.
    progress : function, optional
        Told the share done; when it answers "stop", the speeds not yet done are left out as cancelled.

    Returns
    -------
    TorsionResponse

    Raises
    ------
    InputError
        What the model misses, each with the key to add; a torque that runs in time.

    See Also
    --------
    torsion_modes, stability, transient

    Notes
    -----
    Exact equations of motion with their periodic solution. Structural damping counts as viscous, b = ηc/(2Ω), equal at
    order 2; for the stability it is equal at the order at which disturbances vibrate, 1 in principal zones. See
    `steady.periodic_response`, `run_stability.floquet` and `two_frequency_stability.with_torques`.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from cardan import Drive, torsion_response
    >>> from cardan.parts import Duty, Shaft, Station
    >>> tube = Shaft(number=2, length=1.0, outer=0.07, wall=0.002, loss_factor=0.02)
    >>> drive = replace(Drive.from_angles([0.2, 0.2]), shafts=(tube,), stations=(Station(shaft=3, inertia=0.5),))
    >>> found = torsion_response(drive, Duty(speed=100.0, torque=150.0))
    >>> found.steady.torque.mean.round(1), found.floquet.stable
    (array([150.1]), np.True_)
    """
    chosen = drive.duty if duty is None else duty
    speeds = np.asarray(_speeds(chosen, speed), dtype=float)
    train, model = loaded_model(drive, chosen, speeds, pieces=pieces)
    model, loose = parted(model)
    part = _scaled(progress, 0.0, SHARE)
    if method is None:
        orbit, status, beside = _told(drive, chosen, model, speeds, pieces, part)
    else:
        orbit, status, beside = stable_motions(*steady_orbits(model, speed=speeds, method=method, progress=part))
    steady = described(orbit, status)
    part = _scaled(progress, SHARE, 1.0)
    few = loose if speeds.size <= COUNTED else ()
    verdict, together = with_torques(steady.orbit, floquet(steady), few, progress=part)
    bands = {base: (side_bands(steady.orbit, base, group), group) for base, group in grouped(loose)}
    if progress is not None:
        progress(1.0)
    return TorsionResponse(
        train=train,
        steady=replace(steady, stable=verdict.stable),
        floquet=verdict,
        apart=tuple(_apart(model, tuple(bands.values()), speeds)),
        bands=tuple(band for band, _group in bands.values()),
        beside=beside,
        together=together,
        assumed=train.assumed,
    )


def _told(
    drive: Drive, duty: Duty, model: TorsionalModel, speeds: Array, pieces: int, progress: Progress | None
) -> tuple[Orbit, Array, tuple[Beside, ...]]:
    """Return the motions told at speeds; at one speed those of a list of one, which other questions ask for."""
    if speeds.ndim:
        return told_motions(model, speeds, progress=progress)
    listed = parted(loaded_model(drive, duty, speeds[None], pieces=pieces)[1])[0]
    orbit, status, beside = told_motions(listed, speeds[None], progress=progress)
    alone = replace(orbit, model=model, speed=speeds, coefficient=orbit.coefficient[0], force=orbit.force[0])
    return alone, status[0], beside


def peak_refined(drive: Drive, found: TorsionResponse, *, progress: Progress | None = None) -> TorsionResponse:
    """Return steady motions over many speeds with further ones about that of the largest alternating torque.

    found (s,): over rising speeds; progress: as of `torsion_response`.
    The highest of some speeds is not the top of the curve: the speeds beside it lie ever closer until its neighbours
    are as high to a thousandth. Where it is at an end of the speeds, nothing is added.
    """
    speed, swing = found.speed, _most(found)
    for _round in range(ROUNDS):
        k = int(np.argmax(swing))
        if k in (0, speed.size - 1) or swing[k] - min(swing[k - 1], swing[k + 1]) <= FLAT * swing[k]:
            break
        near = np.concatenate([np.linspace(speed[k], speed[far], CLOSER + 2)[1:-1] for far in (k - 1, k + 1)])
        order = np.argsort(np.concatenate((speed, near)))
        swing = np.concatenate((swing, _most(torsion_response(drive, speed=near))))[order]
        speed = np.concatenate((speed, near))[order]
    return found if speed is found.speed else torsion_response(drive, speed=speed, progress=progress)


def _most(found: TorsionResponse) -> Array:
    """Return the largest alternating torque at each speed, array (s,) [N·m]; -1 where there is no motion."""
    most: Array = np.max(np.nan_to_num(found.swing, nan=-1.0), axis=-1)
    return most


def _speeds(duty: Duty, speed: ArrayLike | None) -> ArrayLike:
    if speed is None and duty.speed is None:
        raise refuse("duty.speed", _("missing; torsional vibration needs it"), "missing")
    return float(duty.speed or 0.0) if speed is None else speed


def loaded_model(drive: Drive, duty: Duty, speeds: Array, *, pieces: int = 1) -> tuple[TorsionalTrain, TorsionalModel]:
    """Return the model of a drive under its duty at input speeds, one or (s,), and the train of the first of them.

    Springs follow their tables, with dry friction.

    Structural damping counts as viscous, equal at the order at which the joints swing most, 2 of cross joints; that of
    disturbances at the order of the zone of parametric resonance nearest to the speed, at which they vibrate.
    """
    check(_timed(duty))
    flat = speeds.reshape(-1)
    if not len(flat) or speeds.ndim > 1:
        raise refuse("speed", _("one list of speeds is needed"))
    if np.any(flat == 0.0) or not np.all(np.isfinite(flat)):
        field = "speed" if speeds.ndim else "duty.speed"
        raise refuse(field, _("steady running needs a speed other than 0, and a finite one"))
    train = torsional_train(drive, duty, speed=float(flat[0]), pieces=pieces)
    model = train.model
    masses = duty.engine is not None and bool(duty.engine.piston_mass)
    if speeds.ndim and (train.pendulums or masses):  # what changes with the speed
        model = torsional_train(drive, duty, speed=speeds, pieces=pieces).model
    if not model.elements:
        text = _("missing; every shaft counts as rigid, so nothing vibrates: give a body of known length, or stiffness")
        raise refuse("shafts[0].stiffness", text)
    if not model.free:
        model = replace(model, input_speed=speeds)
    return train, sprung(damped(model, train.model, speeds), train, speeds)


def damped(model: TorsionalModel, like: TorsionalModel, speeds: Array) -> TorsionalModel:
    """Return a model with its structural damping as viscous, for its steady motion and for disturbances of it.

    like: the drive at one of the speeds (...), by whose modes the zones are told.
    """
    if not np.any(model.loss_factor):
        return model
    turning = np.abs(speeds)
    return in_time(model, main_order(model) * turning, zone_order(like, speeds) * turning)


def zone_order(model: TorsionalModel, speeds: Array) -> Array:
    """Return the order at which disturbances vibrate in the nearest zone of one mode or a sum of two, as the speeds."""
    flat = np.abs(speeds.reshape(-1))
    omega = straight_modes(replace(model, torques=())).omega
    base = base_order(model)
    zone = nearest_zone(np.broadcast_to(omega, (len(flat), len(omega))), flat, np.full(len(flat), -1), base)
    return np.where(np.isfinite(zone.speed), 0.5 * base * zone.multiple, 2.0).reshape(speeds.shape)


def order_jumps(model: TorsionalModel) -> Array:
    """Return the speeds at which `zone_order` jumps, and structural damping with it, array (k,) [rad/s]."""
    if not np.any(model.loss_factor):
        return np.zeros(0)
    omega = straight_modes(replace(model, torques=())).omega
    i, j = np.triu_indices(len(omega))
    base = base_order(model)
    orders = base * np.arange(1.0, SECOND // base + 1.0)
    multiple = np.repeat(orders, len(i))
    where = np.tile(omega[i] + omega[j], len(orders)) / multiple
    order = np.argsort(where)
    where, multiple = where[order], multiple[order]
    found: Array = 0.5 * (where[1:] + where[:-1])[multiple[1:] != multiple[:-1]]
    return found


def _timed(duty: Duty) -> Iterator[Problem]:
    """Yield torques that run in time."""
    named = [("duty.motor", duty.motor), ("duty.load", duty.load)]
    named += [(f"duty.torques[{k}]", one) for k, one in enumerate(duty.torques)]
    for path, machine in named:
        if isinstance(machine, TorqueHistory):
            text = _("runs in time; steady running needs torques that follow angle or speed, so simulate it instead")
            yield Problem(f"{path}.kind", text)


def parted(model: TorsionalModel) -> tuple[TorsionalModel, tuple[Torque, ...]]:
    """Return a model with the torques that repeat within two turns, and those that do not."""
    fits = [torque.law.order is not None and base_period((torque.law.order,)) is not None for torque in model.torques]
    loose = tuple(torque for torque, fit in zip(model.torques, fits, strict=True) if not fit)
    return replace(model, torques=tuple(t for t, fit in zip(model.torques, fits, strict=True) if fit)), loose


def _apart(
    model: TorsionalModel, bands: tuple[tuple[SideBands, tuple[Torque, ...]], ...], speeds: Array
) -> Iterator[NonsynchronousOrder]:
    """Yield what torques make of their own orders: by the motion of both frequencies, else by the straight line."""
    for band, group in bands:
        for torque in group:
            law = torque.law
            assert isinstance(law, Swinging)
            amplitude = np.asarray(law.amplitude) * np.exp(1j * (np.asarray(law.phase) - 0.5 * np.pi))
            straight = straight_waves(model, torque.station, amplitude, law.frequency * np.abs(speeds)).torque
            k = int(np.argmin(np.abs(band.order - abs(law.frequency))))
            exact = band.found.reshape(speeds.shape)
            own = band.amplitude[..., k].reshape(straight.shape)
            yield NonsynchronousOrder(
                order=law.frequency,
                station=torque.station,
                torque=np.where(exact[..., None], own, straight),
                exact=exact,
            )


def _scaled(progress: Progress | None, low: float, high: float) -> Progress | None:
    """Return what tells the share of a part of the work as that of the whole."""
    if progress is None:
        return None
    return lambda share: progress(low + (high - low) * share)


def level(mean: float, swing: float, *, loaded: bool = True) -> float:
    """Return a mean, 0 where it is nothing beside the swing about it.

    loaded: whether a mean torque acts, and it is nothing but rounding that is.

    >>> level(3e-11, 0.2), level(400.0, 1300.0), level(-4e-7, 0.1, loaded=False)
    (0.0, 400.0, 0.0)
    """
    return 0.0 if abs(mean) < (ROUNDING if loaded else UNLOADED) * abs(swing) else mean
