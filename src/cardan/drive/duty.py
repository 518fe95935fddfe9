"""What the drive does, and the limits it is to keep."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.units import plain, quantity

from .machine import Engine, MachineTorque, RunUp


@dataclass(frozen=True, kw_only=True, slots=True)
class Harmonic:
    """Part of a torque that swings with the turning of the shaft where the torque is given."""

    order: float = plain(doc="swings in one turn of that shaft", above=0.0)
    torque: float = quantity("torque", doc="amplitude", low=0.0)
    phase: float = quantity("angle", 0.0, doc="phase of the cosine at the start position")


@dataclass(frozen=True, kw_only=True, slots=True)
class Duty:
    """Steady running of the input shaft."""

    speed: float | None = quantity("angular_speed", None, doc="input speed; negative runs the other way")
    speed_range: tuple[float, float] | None = quantity(
        "angular_speed", None, doc="lowest and highest input speed in use [low, high], either way round", low=0.0
    )
    acceleration: float = quantity("angular_acceleration", 0.0, doc="input angular acceleration")
    application: str = plain(
        "automotive", doc="trade whose rules hold, where makers have two", choices=("automotive", "industrial")
    )
    torque: float | None = quantity(
        "torque",
        None,
        doc="torque of the load at the output, positive when it resists turning about the power flow; at the input "
        "the driving torque",
    )
    torque_at: str = plain("output", doc="at which end of the drive the torque is given", choices=("output", "input"))
    harmonics: tuple[Harmonic, ...] = plain((), doc="swinging parts of the torque, beside its mean")
    input: str | None = plain(
        None,
        doc="whether the input turns evenly at its speed, or freely as torques make it; free when not given and an "
        "engine, a motor or a torque on the input drives it",
        choices=("uniform", "free"),
    )
    engine: Engine | None = plain(None, doc="piston engine on the input shaft")
    motor: MachineTorque | None = plain(None, doc="motor on the input shaft; its torque drives")
    load: MachineTorque | None = plain(
        None, doc="machine on the output shaft, for torsional vibration in place of `torque`; positive when it resists"
    )
    torques: tuple[MachineTorque, ...] = plain((), doc="further torques on stations, positive with the rotation")
    run_up: RunUp | None = plain(None, doc="change of the input speed at a steady rate")


@dataclass(frozen=True, kw_only=True, slots=True)
class Limits:
    """Limits that the user sets over the built-in ones."""

    spline_overlap: float | None = quantity("length", None, doc="smallest engaged spline length allowed", above=0.0)
