"""Torsional simulation: torques and speeds of a drive in time."""

from __future__ import annotations

from typing import Any

import numpy as np

from cardan.calc.calculation import Formulas, Problems, Values
from cardan.errors import InputError, Problem, check
from cardan.questions.torsion.transient.simulation import Status
from cardan.questions.torsion.transient.transient import simulate
from cardan.reading.given import given, positive
from cardan.texts import _, mark

from .torsion import MODEL, model_of, model_problems

formula = Formulas(__doc__)

_NAMES = {"angle": "initial_angles", "speed": "initial_speed", "span": "t_end"}

_CAUSES = {
    Status.DIVERGED: mark("the motion leaves all bounds at {time:.6g} s"),
    Status.SNAPPED: mark(
        "at {time:.6g} s the torque snaps a joint without inertia through: no static balance holds it"
    ),
    Status.STALLED: mark("at {time:.6g} s no step is short enough for the tolerance"),
}


def _problems(v: Values) -> Problems:
    """Yield what is wrong with the tables, and angles that are not one for each coordinate."""
    yield from model_problems(v)
    shafts, angles = v.get("shafts"), v.get("initial_angles")
    if shafts and angles is not None:
        wanted = sum(len(shaft.inertia) for shaft in shafts) - (len(shafts) - 1)
        if len(angles) != wanted:
            text = _("{given} values given, {wanted} needed, one for each coordinate: stations without driven yokes")
            yield v.wrong("initial_angles", text.format(given=len(angles), wanted=wanted))


@formula(
    "torsional motion of a drive in time: angles, speeds and torques at the end, and their extremes",
    "exact equations of motion, one coordinate a group of stations that joints bind together",
    *MODEL,
    given(
        "initial_speed_rad_s", "speed of all coordinates at the start; the forced one without it, else 0", default=None
    ),
    given(
        "initial_angles_rad",
        "angle of every coordinate at the start, in the order of stations; 0 without it",
        axes=1,
        entries=True,
        default=None,
    ),
    positive("t_end_s", "how long"),
    "station_angle_rad: angle of every station",
    "station_speed_rad_s: speed of every station",
    "element_torque_Nm: torque of every element, positive along the power flow",
    "energy_J: kinetic and elastic energy",
    "energy_residual_J: what the account of energy misses",
    "input_torque_Nm: torque that forces the speed of the first station",
    "highest_element_torque_Nm: highest torque of every element over the whole time",
    "lowest_element_torque_Nm: lowest torque of every element over the whole time",
    "highest_station_speed_rad_s: highest speed of every station over the time",
    "lowest_station_speed_rad_s: lowest speed of every station over the time",
    "method: what integrated: explicit or implicit",
    "steps: steps taken",
    check=_problems,
)
def _torsional_simulation(v: Values) -> Any:
    speed = v.initial_speed
    try:
        found = simulate(
            model_of(v), span=v.t_end, times=np.asarray([0.0, v.t_end]), angle=v.initial_angles, speed=speed
        )
    except InputError as error:
        raise error.renamed(lambda field: _NAMES.get(field, field)) from None
    status = Status(int(found.status))
    text = _(_CAUSES.get(status, ""))
    check([Problem("t_end", text.format(time=float(found.ended)))] if text else [])
    curves = found.angle, found.speed, found.torque, found.energy, found.residual, found.input_torque
    ends = (None if one is None else one[-1] for one in curves)
    reached = found.extremes
    extremes = reached.torque_high, reached.torque_low, reached.speed_high, reached.speed_low
    return *ends, *extremes, found.method, found.steps
