"""Keys of the torsional model in calculations: shafts with their stations, joints, torques."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from cardan.calc.calculation import Given, Values, given, rows
from cardan.calc.motion.kinematics import RIGHT
from cardan.errors import Problem
from cardan.maths.arrays import Array
from cardan.questions.torsion.model.torques import Asynchronous, Constant, Falling, History, Law, SpeedTable, Swinging
from cardan.questions.torsion.model.torsional_model import Torque, TorsionalModel, torsional_line
from cardan.texts import _, mark


def _each(key: str, doc: str, dimension: str, **options: object) -> Given:
    return given(key, doc, dimension, axes=(1,), entries=True, **options)  # type: ignore[arg-type]


SHAFTS = rows(
    "shafts",
    mark("shafts along the power flow, each with its stations"),
    _each("inertia_kgm2", mark("inertia of every station"), "inertia", low=0.0),
    _each("stiffness_Nm_per_rad", mark("between neighbouring stations"), "turning_stiffness", above=0.0, default=()),
    _each("damping_Nms_per_rad", mark("between neighbouring stations"), "turning_damping", low=0.0, default=None),
    _each("gap_rad", mark("whole play between neighbouring stations"), "angle", low=0.0, default=None),
    _each("ground_damping_Nms_per_rad", mark("of every station to ground"), "turning_damping", low=0.0, default=None),
)
"""Shafts with their stations."""

JOINTS = rows(
    "joints",
    mark("joints between the shafts"),
    given("alpha_deg", mark("joint angle"), "angle", low=0.0, below=RIGHT),
    given("psi_deg", mark("phase of the driving yoke at the start position"), "angle", default=0.0),
)
"""Joints between the shafts."""

TORQUES = rows(
    "torques",
    mark("torques on stations, positive with the rotation"),
    given("shaft", mark("number of the shaft from 1"), kind="whole"),
    given("station", mark("number of the station on its shaft from 1"), kind="whole"),
    default=(),
    kinds={
        "constant": (given("value_Nm", mark("torque"), "torque"),),
        "harmonic": (
            given("amplitude_Nm", mark("amplitude"), "torque"),
            given("order", mark("cycles in one turn of the station")),
            given("phase_deg", mark("phase of the sine at the start position"), "angle", default=0.0),
        ),
        "linear_speed": (
            given("M0_Nm", mark("torque at standstill"), "torque"),
            given("slope_Nms_per_rad", mark("by how much it falls with the speed"), "turning_damping"),
        ),
        "speed_table": (
            _each("omega_rad_s", mark("speeds of the table, rising"), "angular_speed"),
            _each("M_Nm", mark("torques at these speeds"), "torque"),
        ),
        "time_history": (
            _each("t_s", mark("times of the table, rising"), "time"),
            _each("M_Nm", mark("torques at these times"), "torque"),
        ),
        "asynchronous": (
            given("omega_sync_rad_s", mark("synchronous speed; negative turns the other way"), "angular_speed"),
            given("M_pullout_Nm", mark("pull-out torque"), "torque", low=0.0),
            given("slip_pullout", mark("slip at the pull-out torque"), above=0.0),
        ),
    },
)
"""Torques on stations."""

INPUT_SPEED = given(
    "input_speed_rad_s", mark("speed forced on the first station; free without it"), "angular_speed", default=None
)
"""Speed forced on the first station."""

MODEL = (SHAFTS, JOINTS, TORQUES, INPUT_SPEED)
"""Inputs of a calculation on the torsional model; `model_of` makes the model of them, `model_problems` checks it."""

_LAWS: dict[str, Callable[[Values], Law]] = {
    "constant": lambda row: Constant(value=row["value"]),
    "harmonic": lambda row: Swinging(amplitude=row["amplitude"], frequency=row["order"], phase=row["phase"]),
    "linear_speed": lambda row: Falling(standstill=row["M0"], slope=row["slope"]),
    "speed_table": lambda row: SpeedTable(speeds=row["omega"], torques=row["M"]),
    "time_history": lambda row: History(times=row["t"], torques=row["M"]),
    "asynchronous": lambda row: Asynchronous(
        synchronous_speed=row["omega_sync"], pullout_torque=row["M_pullout"], pullout_slip=row["slip_pullout"]
    ),
}

_BETWEEN = ("stiffness", "damping", "gap")

_BRAKES = ("linear_speed", "speed_table", "asynchronous")
"""Kinds of torques that follow the speed."""


def model_of(values: Values) -> TorsionalModel:
    """Return the torsional model of values that were read by `MODEL` and passed `model_problems`."""
    shafts, joints = values["shafts"], values["joints"]
    counts = [len(shaft["inertia"]) for shaft in shafts]
    starts = np.cumsum([0, *counts])

    def springs(name: str) -> list[Array]:
        return [np.zeros(n - 1) if _absent(one[name]) else one[name] for one, n in zip(shafts, counts, strict=True)]

    return torsional_line(
        [shaft["inertia"] for shaft in shafts],
        stiffness=springs("stiffness"),
        damping=springs("damping"),
        backlash=springs("gap"),
        ground_damping=[
            np.zeros(n) if _absent(shaft["ground_damping"]) else shaft["ground_damping"]
            for shaft, n in zip(shafts, counts, strict=True)
        ],
        joint_angle=np.asarray([joint["alpha"] for joint in joints]),
        phase=np.asarray([joint["psi"] for joint in joints]),
        torques=[
            Torque(station=int(starts[row["shaft"] - 1]) + row["station"] - 1, law=_LAWS[row["kind"]](row))
            for row in values["torques"]
        ],
        input_speed=values["input_speed"],
    )


def _absent(value: Array | None) -> bool:
    return value is None or len(value) == 0


def model_problems(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Yield what is wrong with the tables taken together; those that are wrong by themselves are left out."""
    shafts, joints, torques = (values.get(name) for name in ("shafts", "joints", "torques"))
    if shafts is not None:
        if not shafts:
            yield Problem(key("shafts"), _("a drive needs at least one shaft"))
        for i, shaft in enumerate(shafts):
            yield from _length_problems(shaft, f"shafts[{i}].", key)
    if shafts and joints is not None and len(joints) != len(shafts) - 1:
        text = _("{joints} joints given, {wanted} needed between {shafts} shafts")
        yield Problem(key("joints"), text.format(joints=len(joints), wanted=len(shafts) - 1, shafts=len(shafts)))
    for i, row in enumerate(torques or ()):
        if shafts:
            yield from _station_problems(row, [len(shaft["inertia"]) for shaft in shafts], f"torques[{i}].", key)
        yield from _table_problems(row, f"torques[{i}].", key)
    if shafts and all(len(shaft["inertia"]) for shaft in shafts):
        yield from _loose_problems(shafts, values, key)


def _length_problems(shaft: Values, at: str, key: Callable[[str], str]) -> Iterator[Problem]:
    count = len(shaft["inertia"])
    if not count:
        yield Problem(key(at + "inertia"), _("empty; a shaft has at least one station"))
        return
    text = _("{given} values given, {wanted} needed between {count} stations")
    for name in _BETWEEN:
        if len(() if shaft[name] is None else shaft[name]) != count - 1 and (
            name == "stiffness" or shaft[name] is not None
        ):
            yield Problem(key(at + name), text.format(given=len(shaft[name]), wanted=count - 1, count=count))
    ground = shaft["ground_damping"]
    if ground is not None and len(ground) != count:
        text = _("{given} values given, {wanted} needed, one a station")
        yield Problem(key(at + "ground_damping"), text.format(given=len(ground), wanted=count))


def _station_problems(row: Values, counts: list[int], at: str, key: Callable[[str], str]) -> Iterator[Problem]:
    shaft, station = row["shaft"], row["station"]
    if not 1 <= shaft <= len(counts):
        text = _("shaft {given} given; there are {count}")
        yield Problem(key(at + "station"), text.format(given=shaft, count=len(counts)))
    elif counts[shaft - 1] and not 1 <= station <= counts[shaft - 1]:
        text = _("station {given} given; shaft {shaft} has {count}")
        yield Problem(key(at + "station"), text.format(given=station, shaft=shaft, count=counts[shaft - 1]))


def _table_problems(row: Values, at: str, key: Callable[[str], str]) -> Iterator[Problem]:
    places = {"speed_table": "omega", "time_history": "t"}.get(row["kind"])
    if places is None:
        if row["kind"] == "asynchronous" and row["omega_sync"] == 0.0:
            yield Problem(key(at + "omega_sync"), _("0 given; the synchronous speed is not 0"))
        return
    count = len(row[places])
    if not count:
        yield Problem(key(at + places), _("empty; a table has at least one row"))
    elif len(row["M"]) != count:
        text = _("{given} values given, {wanted} needed, one for each of {other}")
        yield Problem(key(at + "M"), text.format(given=len(row["M"]), wanted=count, other=key(at + places)))
    elif not np.all(np.diff(row[places]) > 0.0):
        yield Problem(key(at + places), _("does not rise; each value must be above the one before"))


def _loose_problems(shafts: list[Values], values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Yield groups of stations that nothing holds: without inertia, spring or damper."""
    held: list[bool] = []
    first: list[str] = []
    for i, shaft in enumerate(shafts):
        count = len(shaft["inertia"])
        ground = shaft["ground_damping"]
        for k in range(count):
            any_here = (
                count > 1 or shaft["inertia"][k] > 0.0 or (ground is not None and k < len(ground) and ground[k] > 0.0)
            )
            if k or not i:
                held.append(any_here)
                first.append(f"{key(f'shafts[{i}].inertia')}[{k}]")
            else:
                held[-1] |= any_here
    forced = values.get("input_speed") is not None
    for r, (good, place) in enumerate(zip(held, first, strict=True)):
        if not good and not (forced and r == 0):
            yield Problem(
                place, _("this station and those that joints bind to it have neither inertia nor spring nor damper")
            )
    if all(held) and not forced and not any(np.any(shaft["inertia"] > 0.0) for shaft in shafts):
        yield from _weightless_problems(shafts, values, key)


def _weightless_problems(shafts: list[Values], values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Yield that nothing sets the speed of a free drive without inertia: no damper to ground, no torque by speed."""
    grounded = any(shaft["ground_damping"] is not None and np.any(shaft["ground_damping"] > 0.0) for shaft in shafts)
    if not grounded and not any(row["kind"] in _BRAKES for row in values.get("torques") or ()):
        text = _("no station of the drive has inertia, and neither a damper to ground nor its torques set its speed")
        yield Problem(key("shafts[0].inertia"), text)
