"""Whether the duty carries the torque that the vehicle can bring to the shaft."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.formulas.shaft_strength import design_torque
from cardan.texts import _, mark

VEHICLE = "duty.vehicle"


def _judge(design: Design) -> Iterator[Verdict]:
    vehicle = design.duty.vehicle
    if vehicle is None:
        return
    engine, power, speed = (
        design.value(f"{VEHICLE}.{name}") for name in ("engine_torque", "engine_power", "engine_speed")
    )
    if engine is None and power is not None and speed is not None:
        engine = np.asarray(power) / speed
    lacking = list(design.unloaded)
    if engine is None:
        lacking.insert(0, f"{VEHICLE}.{'engine_torque' if power is None else 'engine_speed'}")
    if lacking:
        yield Verdict(missing=tuple(lacking))
        return
    names = ("gear_ratio", "axle_ratio", "efficiency", "split_fraction", "dynamic_factor", "wheel_load", "wheel_radius")
    found = design_torque(
        engine,
        halfshaft=vehicle.place == "halfshaft",
        friction=design.value(f"{VEHICLE}.adhesion"),
        **{name: design.value(f"{VEHICLE}.{name}") for name in names},
    )
    adhesion = bool(np.all(found.by_adhesion))
    yield Verdict(
        value=design.most(lambda case: np.asarray(case.torque))[0] * design.shock,
        limit=found.design,
        source=_("adhesion of the wheels, μ W r") if adhesion else _("torque of the engine through the gears"),
        design_variables=("duty.torque",) if design.duty.torque is not None else design.torque_design_variables,
        note=_("the parts are judged with the torque of the duty"),
    )


CHECK = Check(
    name="design_torque",
    doc=mark("torque of the duty against what engine and wheels can bring"),
    judge=_judge,
    title=mark("largest torque of the duty beside that of the vehicle"),
    dimension="torque",
    unit="Nm",
    sense="at_least",
)
