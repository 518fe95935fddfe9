"""The rule of thumb for the wheelbase that a number of shafts goes with."""

from __future__ import annotations

import math
from collections.abc import Iterator

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import BELOW, Verdict
from cardan.formulas.maintenance import ONE_SHAFT, TWO_SHAFTS
from cardan.texts import _, mark, plural


def _judge(design: Design) -> Iterator[Verdict]:
    vehicle = design.duty.vehicle
    if vehicle is None or vehicle.place != "propshaft":
        return
    shafts = design.joints - 1
    title = plural("wheelbase for {count} shaft", "wheelbase for {count} shafts", shafts).format(count=shafts)
    if vehicle.wheelbase is None:
        yield Verdict(title=title, missing=("duty.vehicle.wheelbase",))
        return
    limits = {0: 0.0, 1: ONE_SHAFT * BELOW, 2: TWO_SHAFTS}
    yield Verdict(
        title=title,
        value=design.value("duty.vehicle.wheelbase"),
        limit=limits.get(shafts, math.inf),
        source=_("rule of practice, source unknown: one shaft below 3.4 m, two up to 4.8 m, three above"),
        confidence="recalled",
    )


CHECK = Check(
    name="layout",
    doc=mark("rule of thumb: how many shafts a wheelbase needs"),
    judge=_judge,
    dimension="length",
    unit="m",
    advice=True,
)
