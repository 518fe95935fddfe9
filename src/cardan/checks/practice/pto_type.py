"""Whether a tractor's power take-off gives what the duty asks of it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.catalogue.rows import GuideValue
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.load_case import Case
from cardan.checks.verdict import ROUNDING, Verdict
from cardan.maths.arrays import Array
from cardan.texts import _, mark


def _judge(design: Design) -> Iterator[Verdict]:
    number = design.duty.pto_type
    if number is None:
        return
    row = design.known.table("limits", GuideValue)[f"pto_type_{number}"]
    power_title = _("power at the power take-off, type {type}").format(type=number)
    speed_title = _("speed of the power take-off, type {type}").format(type=number)
    if design.unloaded or design.unmoved:
        yield Verdict(title=power_title, missing=(*design.unloaded, *design.unmoved))
        return
    top = design.top_speed
    assert top is not None

    def power(case: Case) -> Array:
        return np.abs(np.asarray(case.torque)) * np.asarray(top if case.speed is None else case.speed)

    most, note = design.most(power, shocks=False)
    judged = [(power_title, most, row.power[0], "power", "kW", design.torque_design_variables, note)]
    if np.any(np.asarray(top) > row.speed[0] * (1.0 + ROUNDING)):  # most run at that speed, which is no warning
        judged.append((speed_title, np.asarray(top), row.speed[0], "angular_speed", "rpm", (), ""))
    for title, value, limit, dimension, unit, moved_by, said in judged:
        yield Verdict(
            title=title,
            value=value,
            limit=limit,
            dimension=dimension,
            unit=unit,
            source=row.source,
            confidence=row.confidence,
            design_variables=(*moved_by, *design.speed_design_variables),
            note=said,
        )


CHECK = Check(
    name="pto_type",
    doc=mark("power and speed of a tractor's power take-off against those of its type, ISO 500"),
    judge=_judge,
)
