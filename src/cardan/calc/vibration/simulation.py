"""Calculation of a torsional simulation: torques and speeds of a drive in time."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from cardan.calc.calculation import Calculation, Values, given, gives
from cardan.errors import InputError, Problem, check
from cardan.questions.torsion.transient.simulation import Simulation, Status
from cardan.questions.torsion.transient.transient import simulate
from cardan.texts import _, mark

from .torsion_tables import MODEL, model_of, model_problems

_NAMES = {"angle": "initial_angles", "speed": "initial_speed", "span": "t_end"}

_CAUSES = {
    Status.DIVERGED: mark("the motion leaves all bounds at {time:.6g} s"),
    Status.SNAPPED: mark(
        "at {time:.6g} s the torque snaps a joint without inertia through: no static balance holds it"
    ),
    Status.STALLED: mark("at {time:.6g} s no step is short enough for the tolerance"),
}


def _problems(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Yield what is wrong with the tables, and angles that are not one for each coordinate."""
    yield from model_problems(values, key)
    shafts, angles = values.get("shafts"), values.get("initial_angles")
    if shafts and angles is not None:
        wanted = sum(len(shaft["inertia"]) for shaft in shafts) - (len(shafts) - 1)
        if len(angles) != wanted:
            text = _("{given} values given, {wanted} needed, one for each coordinate: stations without driven yokes")
            yield Problem(key("initial_angles"), text.format(given=len(angles), wanted=wanted))


def _answer(values: Values) -> Values:
    speed = values["initial_speed"]
    try:
        found = simulate(
            model_of(values),
            span=values["t_end"],
            times=np.asarray([0.0, values["t_end"]]),
            angle=values["initial_angles"],
            speed=speed,
        )
    except InputError as error:
        raise error.renamed(lambda field: _NAMES.get(field, field)) from None
    status = Status(int(found.status))
    text = _(_CAUSES.get(status, ""))
    check([Problem("t_end", text.format(time=float(found.ended)))] if text else [])
    return {
        "station_angle_rad": found.angle[-1],
        "station_speed_rad_s": found.speed[-1],
        "element_torque_Nm": found.torque[-1],
        "energy_J": found.energy[-1],
        "energy_residual_J": found.residual[-1],
        "input_torque_Nm": None if found.input_torque is None else found.input_torque[-1],
        **_extremes(found),
        "method": found.method,
        "steps": found.steps,
    }


def _extremes(found: Simulation) -> Values:
    return {
        "highest_element_torque_Nm": found.extremes.torque_high,
        "lowest_element_torque_Nm": found.extremes.torque_low,
        "highest_station_speed_rad_s": found.extremes.speed_high,
        "lowest_station_speed_rad_s": found.extremes.speed_low,
    }


CALCULATIONS = (
    Calculation(
        name="torsional_simulation",
        doc=mark("torsional motion of a drive in time: angles, speeds and torques at the end, and their extremes"),
        source="exact equations of motion, one coordinate a group of stations that joints bind together",
        takes=(
            *MODEL,
            given(
                "initial_speed_rad_s",
                mark("speed of all coordinates at the start; the forced one without it, else 0"),
                "angular_speed",
                default=None,
            ),
            given(
                "initial_angles_rad",
                mark("angle of every coordinate at the start, in the order of stations; 0 without it"),
                "angle",
                axes=(1,),
                entries=True,
                default=None,
            ),
            given("t_end_s", mark("how long"), "time", above=0.0),
        ),
        returns=(
            gives("station_angle_rad", mark("angle of every station"), "angle"),
            gives("station_speed_rad_s", mark("speed of every station"), "angular_speed"),
            gives("element_torque_Nm", mark("torque of every element, positive along the power flow"), "torque"),
            gives("energy_J", mark("kinetic and elastic energy"), "work"),
            gives("energy_residual_J", mark("what the account of energy misses"), "work"),
            gives("input_torque_Nm", mark("torque that forces the speed of the first station"), "torque"),
            gives("highest_element_torque_Nm", mark("highest torque of every element over the whole time"), "torque"),
            gives("lowest_element_torque_Nm", mark("lowest torque of every element over the whole time"), "torque"),
            gives("highest_station_speed_rad_s", mark("highest speed of every station over the time"), "angular_speed"),
            gives("lowest_station_speed_rad_s", mark("lowest speed of every station over the time"), "angular_speed"),
            gives("method", mark("what integrated: explicit or implicit")),
            gives("steps", mark("steps taken")),
        ),
        answer=_answer,
        check=_problems,
    ),
)
