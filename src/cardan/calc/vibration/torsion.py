"""Torsional vibration of drives by tables: response by orders, and whether steady running is stable."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from cardan.calc.calculation import Formulas, Problems, Values
from cardan.errors import Problem
from cardan.maths.arrays import Array
from cardan.maths.periodic.harmonics import Status
from cardan.questions.torsion.model.inputs import Asynchronous, Constant, Falling, History, Law, SpeedTable, Swinging
from cardan.questions.torsion.model.torsional_layouts import repeating
from cardan.questions.torsion.model.torsional_model import Torque, TorsionalModel, torsional_line
from cardan.questions.torsion.steady.run_stability import Floquet, Kind, Verdict, floquet
from cardan.questions.torsion.steady.steady import periodic_response
from cardan.questions.torsion.steady.steady_result import Orders
from cardan.reading.given import Given, at_least_zero, given, gives, joint_angle, positive, rows, whole
from cardan.texts import _

formula = Formulas(__doc__)


def _each(key: str, doc: str, **options: Any) -> Given:
    return given(key, doc, axes=1, entries=True, **options)


SHAFTS = rows(
    "shafts",
    "shafts along the power flow, each with its stations",
    _each("inertia_kgm2", "inertia of every station", low=0.0),
    _each("stiffness_Nm_per_rad", "between neighbouring stations", above=0.0, default=()),
    _each("damping_Nms_per_rad", "between neighbouring stations", low=0.0, default=None),
    _each("gap_rad", "whole play between neighbouring stations", low=0.0, default=None),
    _each("ground_damping_Nms_per_rad", "of every station to ground", low=0.0, default=None),
)
"""Shafts with their stations."""

JOINTS = rows(
    "joints",
    "joints between the shafts",
    joint_angle("alpha_deg", "joint angle"),
    given("psi_deg", "phase of the driving yoke at the start position", default=0.0),
)
"""Joints between the shafts."""

TORQUES = rows(
    "torques",
    "torques on stations, positive with the rotation",
    whole("shaft", "number of the shaft from 1"),
    whole("station", "number of the station on its shaft from 1"),
    default=(),
    kinds={
        "constant": (given("value_Nm", "torque"),),
        "harmonic": (
            given("amplitude_Nm", "amplitude"),
            given("order", "cycles in one turn of the station"),
            given("phase_deg", "phase of the sine at the start position", default=0.0),
        ),
        "linear_speed": (
            given("M0_Nm", "torque at standstill"),
            given("slope_Nms_per_rad", "by how much it falls with the speed"),
        ),
        "speed_table": (_each("omega_rad_s", "speeds of the table, rising"), _each("M_Nm", "torques at these speeds")),
        "time_history": (_each("t_s", "times of the table, rising"), _each("M_Nm", "torques at these times")),
        "asynchronous": (
            given("omega_sync_rad_s", "synchronous speed; negative turns the other way"),
            at_least_zero("M_pullout_Nm", "pull-out torque"),
            positive("slip_pullout", "slip at the pull-out torque"),
        ),
    },
)
"""Torques on stations."""

INPUT_SPEED = given("input_speed_rad_s", "speed forced on the first station; free without it", default=None)
"""Speed forced on the first station."""

MODEL = (SHAFTS, JOINTS, TORQUES, INPUT_SPEED)
"""Inputs of a calculation on the torsional model; `model_of` makes the model of them, `model_problems` checks it."""

_LAWS: dict[str, Callable[[Values], Law]] = {
    "constant": lambda row: Constant(value=row.value),
    "harmonic": lambda row: Swinging(amplitude=row.amplitude, frequency=row.order, phase=row.phase),
    "linear_speed": lambda row: Falling(standstill=row.M0, slope=row.slope),
    "speed_table": lambda row: SpeedTable(speeds=row.omega, torques=row.M),
    "time_history": lambda row: History(times=row.t, torques=row.M),
    "asynchronous": lambda row: Asynchronous(
        synchronous_speed=row.omega_sync, pullout_torque=row.M_pullout, pullout_slip=row.slip_pullout
    ),
}

_BETWEEN = ("stiffness", "damping", "gap")

_BRAKES = ("linear_speed", "speed_table", "asynchronous")
"""Kinds of torques that follow the speed."""


def model_of(v: Values) -> TorsionalModel:
    """Return the torsional model of values that were read by `MODEL` and passed `model_problems`."""
    shafts, joints = v.shafts, v.joints
    counts = [len(shaft.inertia) for shaft in shafts]
    starts = np.cumsum([0, *counts])

    def springs(name: str) -> list[Array]:
        return [np.zeros(n - 1) if _absent(one[name]) else one[name] for one, n in zip(shafts, counts, strict=True)]

    return torsional_line(
        [shaft.inertia for shaft in shafts],
        stiffness=springs("stiffness"),
        damping=springs("damping"),
        backlash=springs("gap"),
        ground_damping=[
            np.zeros(n) if _absent(shaft.ground_damping) else shaft.ground_damping
            for shaft, n in zip(shafts, counts, strict=True)
        ],
        joint_angle=np.asarray([joint["alpha"] for joint in joints]),
        phase=np.asarray([joint["psi"] for joint in joints]),
        torques=[
            Torque(station=int(starts[row.shaft - 1]) + row.station - 1, law=_LAWS[row.kind](row)) for row in v.torques
        ],
        input_speed=v.input_speed,
    )


def _absent(value: Array | None) -> bool:
    return value is None or len(value) == 0


def model_problems(v: Values) -> Problems:
    """Yield what is wrong with the tables taken together; those that are wrong by themselves are left out."""
    shafts, joints, torques = (v.get(name) for name in ("shafts", "joints", "torques"))
    if shafts is not None:
        if not shafts:
            yield v.wrong("shafts", _("a drive needs at least one shaft"))
        for shaft in shafts:
            yield from _length_problems(shaft)
    if shafts and joints is not None and len(joints) != len(shafts) - 1:
        text = _("{joints} joints given, {wanted} needed between {shafts} shafts")
        yield v.wrong("joints", text.format(joints=len(joints), wanted=len(shafts) - 1, shafts=len(shafts)))
    for row in torques or ():
        if shafts:
            yield from _station_problems(row, [len(shaft.inertia) for shaft in shafts])
        yield from _table_problems(row)
    if shafts and all(len(shaft.inertia) for shaft in shafts):
        yield from _loose_problems(shafts, v)


def _length_problems(shaft: Values) -> Problems:
    count = len(shaft.inertia)
    if not count:
        yield shaft.wrong("inertia", _("empty; a shaft has at least one station"))
        return
    text = _("{given} values given, {wanted} needed between {count} stations")
    for name in _BETWEEN:
        if len(() if shaft[name] is None else shaft[name]) != count - 1 and (
            name == "stiffness" or shaft[name] is not None
        ):
            yield shaft.wrong(name, text.format(given=len(shaft[name]), wanted=count - 1, count=count))
    ground = shaft.ground_damping
    if ground is not None and len(ground) != count:
        text = _("{given} values given, {wanted} needed, one a station")
        yield shaft.wrong("ground_damping", text.format(given=len(ground), wanted=count))


def _station_problems(row: Values, counts: list[int]) -> Problems:
    shaft, station = row.shaft, row.station
    if not 1 <= shaft <= len(counts):
        yield row.wrong("station", _("shaft {given} given; there are {count}"), given=shaft, count=len(counts))
    elif counts[shaft - 1] and not 1 <= station <= counts[shaft - 1]:
        text = _("station {given} given; shaft {shaft} has {count}")
        yield row.wrong("station", text.format(given=station, shaft=shaft, count=counts[shaft - 1]))


def _table_problems(row: Values) -> Problems:
    places = {"speed_table": "omega", "time_history": "t"}.get(row.kind)
    if places is None:
        if row.kind == "asynchronous" and row.omega_sync == 0.0:
            yield row.wrong("omega_sync", _("0 given; the synchronous speed is not 0"))
        return
    count = len(row[places])
    if not count:
        yield row.wrong(places, _("empty; a table has at least one row"))
    elif len(row.M) != count:
        text = _("{given} values given, {wanted} needed, one for each of {other}")
        yield row.wrong("M", text.format(given=len(row.M), wanted=count, other=row.key(places)))
    elif not np.all(np.diff(row[places]) > 0.0):
        yield row.wrong(places, _("does not rise; each value must be above the one before"))


def _loose_problems(shafts: list[Values], v: Values) -> Problems:
    """Yield groups of stations that nothing holds: without inertia, spring or damper."""
    held: list[bool] = []
    first: list[str] = []
    for i, shaft in enumerate(shafts):
        count = len(shaft.inertia)
        ground = shaft.ground_damping
        for k in range(count):
            any_here = (
                count > 1 or shaft.inertia[k] > 0.0 or (ground is not None and k < len(ground) and ground[k] > 0.0)
            )
            if k or not i:
                held.append(any_here)
                first.append(f"{v.key(f'shafts[{i}].inertia')}[{k}]")
            else:
                held[-1] |= any_here
    forced = v.get("input_speed") is not None
    for r, (good, place) in enumerate(zip(held, first, strict=True)):
        if not good and not (forced and r == 0):
            yield Problem(
                place, _("this station and those that joints bind to it have neither inertia nor spring nor damper")
            )
    if all(held) and not forced and not any(np.any(shaft.inertia > 0.0) for shaft in shafts):
        yield from _weightless_problems(shafts, v)


def _weightless_problems(shafts: list[Values], v: Values) -> Problems:
    """Yield that nothing sets the speed of a free drive without inertia: no damper to ground, no torque by speed."""
    grounded = any(shaft.ground_damping is not None and np.any(shaft.ground_damping > 0.0) for shaft in shafts)
    if not grounded and not any(row.kind in _BRAKES for row in v.get("torques") or ()):
        text = _("no station of the drive has inertia, and neither a damper to ground nor its torques set its speed")
        yield v.wrong("shafts[0].inertia", text)


MEAN_SPEED = given("mean_speed_rad_s", "mean speed of a free drive; its constant drive torque is sought", default=None)
"""Mean speed of a free drive."""


def speed_problems(v: Values) -> Problems:
    """Yield what is wrong with the tables, and with the speed: exactly one of the two is needed, and not 0."""
    yield from model_problems(v)
    speeds = {name: v.get(name) for name in ("input_speed", "mean_speed")}
    there = [name for name, value in speeds.items() if value is not None]
    if any(name not in v for name in speeds):
        return
    if not there:
        yield v.wrong(
            "input_speed", _("missing; give it, or {other} for a free drive").format(other=v.key("mean_speed"))
        )
    elif len(there) > 1:
        yield v.wrong("mean_speed", _("given beside {other}; give one of them"), other=v.key("input_speed"))
    for name in there:
        if speeds[name] == 0.0:
            yield v.wrong(name, _("0 given; steady running needs a speed"))


def _multipliers(found: Floquet) -> dict[str, Any]:
    left = found.multipliers[np.isfinite(found.multipliers)]
    return {
        "multiplier_modulus_sorted": np.abs(left),
        "multiplier_angle_deg": np.angle(left),
        "multipliers_removed": int(found.removed),
    }


def _table(orders: list[str], curves: Orders) -> list[dict[str, Array]]:
    return [dict(zip(orders, row, strict=True)) for row in curves.amplitude]


@formula(
    "steady torsional running at a speed: torque of every element and speed of every station by orders",
    "harmonic balance of the exact equations of motion",
    (*MODEL, MEAN_SPEED),
    "elements: of every element: mean, amplitude and phase of each order, true extremes",
    gives("station_speed_order_amplitude_rad_s", "amplitude of every station's speed by order", None),
    gives("constant_drive_torque_Nm", "constant torque on the first station that keeps the mean speed", None),
    gives("drive_torque_mean_Nm", "mean torque that the input needs to turn at its speed", None),
    gives("drive_torque_order_amplitude_Nm", "amplitude of that torque by order", None),
    "stable: whether small disturbances decay",
    "verdict: stable, neutral, unstable or unknown",
    "status: converged, coarse or no_convergence",
    "residual: by how much the equations fail to hold, over the largest torque",
    "power_residual: what the power balance misses, over the power that flows",
    check=speed_problems,
)
def _periodic_response(v: Values) -> Any:
    found = periodic_response(model_of(v), speed=v.mean_speed)
    model, steadiness = found.model, floquet(found)
    orders = [f"{order:g}" for order in found.order]
    free = model.free
    return {
        "elements": [
            {
                "mean_Nm": found.torque.mean[e],
                "order_amplitude_Nm": dict(zip(orders, found.torque.amplitude[e], strict=True)),
                "order_phase_deg": dict(zip(orders, np.degrees(found.torque.phase[e]), strict=True)),
                "peak_to_peak_Nm": found.peak_to_peak[e],
                "highest_Nm": found.torque_highest[e],
                "lowest_Nm": found.torque_lowest[e],
            }
            for e in range(len(model.elements))
        ],
        "station_speed_order_amplitude_rad_s": _table(orders, found.station_speed),
        "constant_drive_torque_Nm": found.drive_torque.mean[0] if free else None,
        "drive_torque_mean_Nm": None if free else found.drive_torque.mean[0],
        "drive_torque_order_amplitude_Nm": None if free else _table(orders, found.drive_torque)[0],
        "stable": bool(steadiness.stable),
        "verdict": Verdict(int(steadiness.verdict)).name.lower(),
        "status": Status(int(found.status)).name.lower(),
        "residual": found.residual,
        "power_residual": found.power_residual,
    }


@formula(
    "whether steady torsional running is stable: multipliers of a period, growth, nearest zone of resonance",
    "exact equations of motion linearised about their periodic motion",
    (*MODEL, MEAN_SPEED),
    gives("multiplier_period_rad = period", "shaft angle of a period", None),
    "multiplier_modulus_sorted: by what each disturbance is multiplied over a period",
    "multiplier_angle_deg: angle of these multipliers",
    "multipliers_removed: left out of a free drive: shift in time, and any speed being possible",
    "spectral_radius: the largest of them",
    "stable: whether every disturbance decays",
    "verdict: stable, neutral, unstable or unknown",
    gives("growth_rate_1_per_s", "rate at which the largest disturbance grows", None),
    "kind: how a growing disturbance oscillates: repeating, doubling or combination",
    "disturbance_order = order: lowest order at which it oscillates",
    "nearest_zone: nearest zone of parametric resonance",
    gives("nearest_zone_rad_s", "its speed by the straight drive", None),
    "status: of the steady motion: converged, coarse or no_convergence",
    "determinant_residual: what the product of the multipliers misses against the damping",
    "torques_left_out: numbers of torques whose order does not repeat within two turns",
    check=speed_problems,
)
def _floquet_stability(v: Values) -> Any:
    model, loose = repeating(model_of(v))
    steady = periodic_response(model, speed=v.mean_speed)
    found = floquet(steady)
    return found, {
        **_multipliers(found),
        "stable": bool(found.stable),
        "verdict": Verdict(int(found.verdict)).name.lower(),
        "growth_rate_1_per_s": np.where(np.isfinite(found.growth_rate), found.growth_rate, np.nan)[()],
        "kind": Kind(int(found.kind)).name.lower() if found.verdict == Verdict.UNSTABLE else None,
        "nearest_zone": found.zone.name(),
        "nearest_zone_rad_s": found.zone.speed,
        "status": Status(int(steady.status)).name.lower(),
        "torques_left_out": [k + 1 for k in loose] or None,
    }
