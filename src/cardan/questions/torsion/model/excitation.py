"""What excites a drive: the torque of a piston engine by its harmonics, and the laws of motors and loads."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from functools import cache
from typing import Any

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.machine import (
    AsynchronousMachine,
    ConstantTorque,
    Engine,
    HarmonicTorque,
    LinearTorque,
    MachineTorque,
    RunUp,
    SpeedTorque,
    TorqueHistory,
)
from cardan.errors import refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.texts import _

from .inputs import Asynchronous, Constant, Falling, History, Law, SpeedTable, Swinging
from .torsional_model import Torque

HIGHEST = 12.0
"""Highest order of the crank that a crank drive is asked for; higher ones are small."""

SMALL = 1e-3
"""Harmonics of a crank drive below this share of the largest are left out."""

AMBIENT = 101325.0
"""Pressure of the surroundings [Pa]."""

POLYTROPIC = 1.3
"""Exponent of compression and expansion."""

NODES = 64
"""Points of integration in a stroke; pressure and crank drive are smooth within it."""


@dataclass(frozen=True, eq=False, kw_only=True)
class EngineTorque:
    """Torque of an engine on the input shaft: mean + Σ amplitude sin(order·angle of the crank + phase)."""

    mean: float | None  # [N·m]: None where the engine does not say
    order: Array  # (h,): k, swings in one turn of the crank, rising
    amplitude: Array  # (..., h) [N·m]: M_k; leading axes are those of the speed
    phase: Array  # (..., h) [rad]: δ_k, cylinder 1 at its top dead centre in the start position
    speed_ratio: float  # ξ: a harmonic has the order kξ of the input shaft

    @property
    def laws(self) -> tuple[Law, ...]:
        """Laws of the torque on the input shaft, its mean first where there is one."""
        mean: tuple[Law, ...] = () if self.mean is None else (Constant(value=self.mean),)
        return mean + tuple(
            Swinging(amplitude=self.amplitude[..., h], frequency=float(k) * self.speed_ratio, phase=self.phase[..., h])
            for h, k in enumerate(self.order)
        )


def engine_torque(engine: Engine, speed: ArrayLike | None = None) -> EngineTorque:
    """Return the torque of an engine on the input shaft by its harmonics, as given or from its crank drive.

    speed (...) [rad/s]: of the input shaft; the oscillating masses need it.
    Crank drive: p A s' - m s' s'' ω² with the way of the piston s/r = 1 - cos φ + (1 - √(1 - λ² sin²φ))/λ; p between
    polytropic compression and expansion with the mean pressure given, combustion at the dead centre. Cylinders that
    fire evenly spaced add up where k times the spacing is a whole number of turns and cancel elsewhere.
    """
    given = engine.harmonics
    if engine.mean_pressure is None and engine.piston_mass is None:
        rank = sorted(given, key=lambda one: one.order)
        return EngineTorque(
            mean=engine.mean_torque,
            order=np.asarray([one.order for one in rank]),
            amplitude=np.asarray([one.torque for one in rank]),
            phase=np.asarray([one.phase for one in rank]),
            speed_ratio=engine.speed_ratio,
        )
    if engine.piston_mass and speed is None:
        raise refuse("duty.speed", _("missing; the oscillating masses of the engine need it"), "missing")
    order, gas, inertia = _crank_harmonics(engine)
    one = gas
    if engine.piston_mass:
        one = gas + inertia * (engine.speed_ratio * np.asarray(speed, dtype=float)[..., None]) ** 2
    size = np.abs(one)
    small = size <= SMALL * np.max(size, axis=-1, keepdims=True, initial=0.0)
    kept = ~np.all(small.reshape(-1, len(order)), axis=0)
    mean = engine.mean_torque
    if engine.mean_pressure is not None:
        volume = 0.25 * math.pi * float(engine.bore or 0.0) ** 2 * float(engine.stroke or 0.0)
        share = engine.speed_ratio * int(engine.cylinders or 1) / (engine.strokes * math.pi)
        mean = share * engine.mean_pressure * volume
    return EngineTorque(
        mean=mean,
        order=order[kept],
        amplitude=size[..., kept],
        phase=np.angle(one[..., kept]) + 0.5 * math.pi,
        speed_ratio=engine.speed_ratio,
    )


@cache
def _crank_harmonics(engine: Engine) -> tuple[Array, Array, Array]:
    """Return orders of the crank and what they carry, as coefficients of e^(ikφ) of the torque on the input shaft.

    Arrays (h,): orders, complex torques of the gas [N·m], and those of the masses over ω² of the crank [N·m·s²].
    """
    cylinders, step = int(engine.cylinders or 1), 2.0 / engine.strokes  # given, by Engine.problems
    order = np.arange(1, round(HIGHEST / step) + 1) * step
    together = order * engine.strokes / (2.0 * cylinders)
    adds = np.abs(together - np.round(together)) < 1e-9
    scale = np.where(adds, cylinders * engine.speed_ratio, 0.0)
    inertia = np.zeros_like(order) + 0.0j
    if engine.piston_mass:
        whole = np.abs(order - np.round(order)) < 1e-9
        inertia[whole] = engine.piston_mass * _inertia_harmonics(engine, order[whole])
    return order, scale * _gas_harmonics(engine, order), scale * inertia


def piston(angle: ArrayLike, radius: float, rod_ratio: float) -> tuple[Array, Array, Array]:
    """Return the way of a piston from its top dead centre and its first two derivatives by the crank's angle.

    angle (p,) [rad]: φ from the top dead centre; radius [m]: r of the crank; rod_ratio: λ = r/l.
    Returns tuple of arrays (p,) [m]: s, s', s''.
    """
    phi = np.asarray(angle, dtype=float)
    sine, cosine = np.sin(phi), np.cos(phi)
    root = np.sqrt(1.0 - (rod_ratio * sine) ** 2)
    way = radius * (1.0 - cosine + (1.0 - root) / rod_ratio)
    first = radius * sine * (1.0 + rod_ratio * cosine / root)
    bent = rod_ratio * (cosine**2 - sine**2 + rod_ratio**2 * sine**4) / root**3
    return way, first, radius * (cosine + bent)


def _inertia_harmonics(engine: Engine, order: Array) -> Array:
    """Return coefficients of e^(ikφ), doubled, of -s' s'' over a turn of the crank, complex array (h,) [m²]."""
    assert engine.stroke is not None

    def torque(angle: Array, _stroke: int) -> Array:
        _way, first, second = piston(angle, 0.5 * float(engine.stroke or 0.0), engine.rod_ratio)
        return -first * second

    return _coefficients(torque, 2, order)


def _gas_harmonics(engine: Engine, order: Array) -> Array:
    """Return coefficients of e^(ikφ), doubled, of the gas torque of a cylinder over its cycle, complex (h,) [N·m]."""
    if engine.mean_pressure is None or engine.bore is None or engine.stroke is None:
        return np.zeros_like(order) + 0.0j
    area, squeeze = 0.25 * math.pi * engine.bore**2, engine.compression_ratio
    expansion, compression = 0, engine.strokes - 1
    top = AMBIENT * squeeze**POLYTROPIC
    fired = top + engine.mean_pressure * (squeeze - 1.0) * (POLYTROPIC - 1.0) / (1.0 - squeeze ** (1.0 - POLYTROPIC))

    def torque(angle: Array, stroke: int) -> Array:
        way, first, _second = piston(angle, 0.5 * float(engine.stroke or 0.0), engine.rod_ratio)
        volume = 1.0 + (squeeze - 1.0) * way / float(engine.stroke or 1.0)  # over the dead space
        highest = {expansion: fired, compression: top}.get(stroke)
        pressure = 0.0 * way if highest is None else highest * volume**-POLYTROPIC - AMBIENT
        return pressure * area * first

    return _coefficients(torque, engine.strokes, order)


def _coefficients(torque: Any, strokes: int, order: Array) -> Array:
    """Return (2/P) ∫ torque e^(-ikφ) over a period of so many strokes, each integrated by itself; complex (h,)."""
    place, weight = np.polynomial.legendre.leggauss(NODES)
    whole = np.zeros_like(order) + 0.0j
    for stroke in range(strokes):
        angle = math.pi * (stroke + 0.5 * (place + 1.0))
        values = torque(angle, stroke) * weight * 0.5 * math.pi
        whole += np.exp(-1j * np.multiply.outer(order, angle)) @ values
    return 2.0 * whole / (strokes * math.pi)


def law_of(machine: MachineTorque, *, resists: bool = False) -> Law:
    """Return the law of a torque on a station, positive with the rotation.

    machine: as the drive gives it; resists: whether it is a load, positive when it resists.
    """
    sign = -1.0 if resists else 1.0
    if isinstance(machine, ConstantTorque):
        return Constant(value=sign * machine.torque)
    if isinstance(machine, LinearTorque):  # a load that rises falls with the speed when it is counted as driving
        return Falling(standstill=sign * machine.standstill, slope=machine.slope)
    if isinstance(machine, SpeedTorque):
        return SpeedTable(speeds=np.asarray(machine.speeds), torques=sign * np.asarray(machine.torques))
    if isinstance(machine, TorqueHistory):
        return History(times=np.asarray(machine.times), torques=sign * np.asarray(machine.torques))
    if isinstance(machine, AsynchronousMachine):
        return Asynchronous(**{one.name: getattr(machine, one.name) for one in fields(Asynchronous)})
    assert isinstance(machine, HarmonicTorque)
    return Swinging(amplitude=sign * machine.amplitude, frequency=machine.order, phase=machine.phase)


# Which torques act on the stations of a drive under its duty.


def turns_freely(drive: Drive, duty: Duty) -> bool:
    """Tell whether torques turn the input of a drive, rather than a speed that is forced on it.

    >>> from cardan.parts import Engine
    >>> drive = Drive.from_angles([0.1])
    >>> turns_freely(drive, Duty()), turns_freely(drive, Duty(engine=Engine(cylinders=4)))
    (False, True)
    """
    if duty.input is not None:
        return duty.input == "free"
    swings = duty.torque_at == "input" and bool(duty.harmonics)
    pushed = any(one.station == "input" for one in duty.torques)
    return duty.engine is not None or duty.motor is not None or pushed or swings


def forced_run_up(drive: Drive, duty: Duty) -> RunUp | None:
    """Return the run-up that is forced on the input of a drive; None where torques turn it freely, or there is none."""
    return None if turns_freely(drive, duty) else duty.run_up


def machine_torques(
    drive: Drive,
    duty: Duty,
    stations: Mapping[str, int],
    last: int,
    ends: Sequence[int],
    *,
    speed: ArrayLike | None = None,
    free: bool = True,
) -> tuple[Torque, ...]:
    """Return the torques on the stations of a drive.

    stations: stations by name; last: station of the output end.
    ends: last station of every shaft, for what resists its turning; speed (s,) [rad/s].
    free: whether torques turn the input; torques there are left out when its speed is forced.
    The torque of the duty loads the output; where it is that of the input, the mean of the output is the same but for
    what resists between.
    """
    at = {"input": 0, "output": last} | dict(stations)
    found: list[Torque] = []

    def act(station: int, *laws: Law) -> None:
        found.extend(Torque(station=station, law=law) for law in laws if station or free)

    def placed(machine: MachineTorque, default: str) -> int:
        return at[machine.station or default]

    if duty.engine is not None:
        act(0, *engine_torque(duty.engine, speed).laws)
    if duty.motor is not None:
        act(placed(duty.motor, "input"), law_of(duty.motor))
    if duty.load is not None:
        act(placed(duty.load, "output"), law_of(duty.load, resists=True))
    elif duty.torque is not None:
        act(last, Constant(value=-duty.torque))
    if duty.torque is not None:
        drives = duty.torque_at == "input"
        if drives:
            act(0, Constant(value=duty.torque))
        if drives or duty.load is None:
            sign, end = (1.0, 0) if drives else (-1.0, last)
            for one in duty.harmonics:  # a cosine is a sine a quarter ahead
                act(end, Swinging(amplitude=sign * one.torque, frequency=one.order, phase=one.phase + 0.5 * math.pi))
    for machine in duty.torques:
        act(placed(machine, "input"), law_of(machine))
    for shaft, end in zip(drive.shafts, ends, strict=True):
        if shaft.resisting_torque:
            act(end, Constant(value=-shaft.resisting_torque))
    return tuple(found)
