"""What the drive does, and the limits it is to keep."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.units import plain, quantity

from .machine import Engine, Event, MachineTorque, RunUp


@dataclass(frozen=True, kw_only=True, slots=True)
class Harmonic:
    """Part of a torque that alternates with the turning of the shaft where the torque is given."""

    order: float = plain(doc="cycles in one turn of that shaft", above=0.0)
    torque: float = quantity("torque", doc="amplitude", low=0.0)
    phase: float = quantity("angle", 0.0, doc="phase of the cosine at the start position")


@dataclass(frozen=True, kw_only=True, slots=True)
class Block:
    """Part of a duty cycle."""

    torque: float = quantity("torque", doc="torque at the output", low=0.0)
    speed: float = quantity("angular_speed", doc="input speed", above=0.0)
    share: float = quantity("share", doc="share of the whole time", low=0.0, high=1.0)
    joint_angle: float | None = quantity(
        "angle",
        None,
        doc="joint angle of every joint in this part; that of the drive when not given",
        low=0.0,
        below=1.5708,
    )


@dataclass(frozen=True, kw_only=True, slots=True)
class Case:
    """Load case: a way in which the drive runs, by its name; one with neither share nor cycles is a peak."""

    name: str = plain(doc="name of the load case")
    torque: float = quantity("torque", doc="size of the torque at the end that `duty.torque_at` names", low=0.0)
    speed: float | None = quantity("angular_speed", None, doc="input speed; that of the duty when not given", above=0.0)
    speed_range: tuple[float, float] | None = quantity(
        "angular_speed", None, doc="lowest and highest input speed [low, high], instead of one speed", low=0.0
    )
    share: float | None = quantity("share", None, doc="share of the whole time", low=0.0, high=1.0)
    cycles: float | None = plain(None, doc="turns of the input in the life asked for, instead of a share", above=0.0)
    shock_factor: float | None = plain(None, doc="factor for shocks; that of the duty when not given", low=1.0)
    flow: str = plain(
        "drive", doc="whether the input drives the output, or the output the input", choices=("drive", "coast")
    )
    pose: str = plain("", doc="pose in which it acts; in every one, by their shares, when not given")
    movement: str = plain("", doc="movement during which it acts; all of them together when not given")


@dataclass(frozen=True, kw_only=True, slots=True)
class History:
    """Measured torque over time from a CSV file, straight between its rows.

    Attributes
    ----------
    times : tuple of float
        Times of the rows [s], read when the drive is loaded.
    torques : tuple of float
        Torque in each row [N·m].
    speeds : tuple of float
        Speed of the input in each row [rad/s]; empty where the file has none.
    """

    file: str = plain(
        doc="CSV file beside the drive file with the columns time_s and torque_Nm, and speed_rpm where it was measured"
    )
    times: tuple[float, ...] = ()
    torques: tuple[float, ...] = ()
    speeds: tuple[float, ...] = ()


@dataclass(frozen=True, kw_only=True, slots=True)
class Vehicle:
    """What drives the shaft of a vehicle, and what its wheels can pass on."""

    place: str = plain("propshaft", doc="where the drive stands", choices=("propshaft", "halfshaft"))
    engine_torque: float | None = quantity("torque", None, doc="largest torque of the engine", above=0.0)
    engine_power: float | None = quantity("power", None, doc="power of the engine, with engine_speed", above=0.0)
    engine_speed: float | None = quantity("angular_speed", None, doc="engine speed at that power", above=0.0)
    gear_ratio: float = plain(1.0, doc="lowest gear: engine speed over shaft speed", above=0.0)
    axle_ratio: float = plain(1.0, doc="shaft speed over wheel speed", above=0.0)
    efficiency: float = plain(1.0, doc="efficiency from the engine to the shaft", above=0.0, high=1.0)
    split_fraction: float = plain(1.0, doc="share of the torque that this shaft carries", above=0.0, high=1.0)
    dynamic_factor: float = plain(1.0, doc="factor for jerks", above=0.0)
    wheel_radius: float | None = quantity("length", None, doc="rolling radius of the wheels", above=0.0)
    wheel_load: float | None = quantity("force", None, doc="load on the wheels that this shaft drives", above=0.0)
    adhesion: float | None = plain(None, doc="coefficient of adhesion of the wheels", above=0.0)
    wheelbase: float | None = quantity("length", None, doc="distance of the axles", above=0.0)


@dataclass(frozen=True, kw_only=True, slots=True)
class Upkeep:
    """Use since the last service."""

    hours: float | None = quantity("time", None, doc="running time since the last lubrication", low=0.0)
    distance: float | None = quantity("length", None, doc="distance run since the last lubrication", low=0.0)
    years: float | None = plain(None, doc="years since the last lubrication", low=0.0)
    items: tuple[str, ...] = plain((), doc="rows of the lubrication table that the drive has; needle bearings if none")
    severe: bool = plain(False, doc="severe use, water, mud or dust: half the intervals")


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
    pto_type: int | None = plain(None, doc="type of the tractor's power take-off at the input, ISO 500", low=1, high=4)
    torque: float | None = quantity(
        "torque",
        None,
        doc="torque of the load at the output, positive when it resists turning about the power flow; at the input "
        "the driving torque",
    )
    torque_at: str = plain("output", doc="at which end of the drive the torque is given", choices=("output", "input"))
    harmonics: tuple[Harmonic, ...] = plain((), doc="swinging parts of the torque, beside its mean")
    life: float | None = quantity("time", None, doc="running time that the joints are to last", above=0.0)
    shock_factor: float = plain(
        1.0,
        doc="factor for shocks, 1 for smooth running: on the torque in stresses, loads, lives; not in twist or fatigue",
        low=1.0,
    )
    reliability: float = quantity("share", 0.9, doc="share of parts that reach the life", low=0.5, high=0.99999)
    continuous: bool = plain(True, doc="whether the drive runs for long at a time")
    synchronous: bool = plain(False, doc="whether the output must turn uniformly")
    blocks: tuple[Block, ...] = plain((), doc="duty cycle, in parts that make up the whole time")
    cases: tuple[Case, ...] = plain(
        (), doc="load cases; where their shares leave time, and a torque of the duty is given, that is the rest"
    )
    torque_history: History | None = plain(
        None, doc="CSV file with the columns time_s and torque_Nm, measured at the output: a duty cycle"
    )
    vehicle: Vehicle | None = plain(None, doc="what drives the shaft of a vehicle, and what its wheels can pass on")
    upkeep: Upkeep | None = plain(None, doc="use since the last service")
    balance_grade: str = plain("", doc="balance grade that the shafts are to keep, as G16")
    balance_class: str = plain(
        "", doc="vehicle whose permissible unbalance Kozhevnikov and Perfil'ev (1978) give, as gaz_66"
    )
    input: str | None = plain(
        None,
        doc="whether the input turns uniformly at its speed, or freely as torques make it; free when not given and an "
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
    starts: float | None = plain(None, doc="run-ups, each as `run_up`, in the life asked for", above=0.0)
    events: tuple[Event, ...] = plain((), doc="what happens beside them in the life asked for: clutches, load steps")


@dataclass(frozen=True, kw_only=True, slots=True)
class Limits:
    """Limits that the user sets over the built-in ones."""

    speed_fluctuation: float | None = quantity(
        "share", None, doc="largest speed fluctuation of the output allowed", above=0.0
    )
    output_error: float | None = quantity("angle", None, doc="largest error of the output angle allowed", above=0.0)
    joint_angle: float | None = quantity("angle", None, doc="largest joint angle of a joint allowed", above=0.0)
    twist: float | None = quantity("angle", None, doc="largest twist of the shafts under torque allowed", above=0.0)
    shear_stress: float | None = quantity("stress", None, doc="largest shear stress of a shaft allowed", above=0.0)
    spline_pressure: float | None = quantity("stress", None, doc="largest pressure on spline teeth allowed", above=0.0)
    spline_overlap: float | None = quantity("length", None, doc="smallest engaged spline length allowed", above=0.0)
    whirl: float | None = quantity(
        "displacement", None, doc="largest whirl of the shafts allowed, from their mean position", above=0.0
    )
    safety: float = plain(1.5, doc="safety that yield strengths are divided by", low=1.0)
    fatigue_safety: float = plain(1.5, doc="smallest safety against fatigue", low=1.0)
    critical_speed: float | None = plain(
        None, doc="smallest ratio of the real critical speed to the highest speed", above=0.0
    )
