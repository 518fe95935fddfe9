"""Whether the drive keeps away from half the critical speed, where the secondary couples shake its shafts."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.formulas.critical_speed import HALF_BAND
from cardan.maths.arrays import Array
from cardan.texts import _, mark

from .whirl import whirls


def _judge(design: Design) -> Iterator[Verdict]:
    for one in whirls(design):
        k, speed, lacking, design_variables = one.shaft, one.speed, one.missing, one.design_variables
        running = [case.speed for case in design.cases if case.speed is not None]
        between = design.duty.speed_range
        subject, source = (
            f"shafts[{k}]",
            _("Cardan India: Speed limit, cardanindia.com/speedlimit.html: 8 % to either side"),
        )
        if lacking or not (running or between):
            yield Verdict(subject=subject, missing=(*lacking, *(() if running or between else ("duty.speed",))))
            continue
        if speed is None:
            continue
        middle = 0.5 * np.asarray(one.wear * speed)
        low, high = middle * (1.0 - HALF_BAND), middle * (1.0 + HALF_BAND)
        if running:
            yield Verdict(
                subject=subject,
                value=_nearest([np.asarray(case, dtype=float) for case in running], np.sqrt(low * high)),
                limit=(low, high),
                source=source,
                design_variables=(
                    *design_variables,
                    *(path for path in design.speed_design_variables if "range" not in path),
                ),
            )
        if between is not None:
            nearest = np.clip(middle, design.value("duty.speed_range[0]"), design.value("duty.speed_range[1]"))
            yield Verdict(
                subject=subject,
                title=_("clearance of the speed range from half critical speed, shaft {number}"),
                value=nearest,
                limit=(low, high),
                source=source,
                design_variables=design_variables,
                note=_("pass through it quickly") if np.all((nearest > low) & (nearest < high)) else "",
                advice=True,
            )


def _nearest(speeds: list[Array], middle: Array) -> Array:
    """Return of some speeds the one whose ratio to the middle is nearest to 1."""
    rows = np.stack(np.broadcast_arrays(*speeds, middle)[:-1])
    off = np.abs(np.log(np.maximum(rows, 1e-9) / middle))
    found: Array = np.take_along_axis(rows, np.argmin(off, axis=0)[None], axis=0)[0]
    return found


CHECK = Check(
    name="half_critical",
    doc=mark("operating speeds against the band about half the critical speed"),
    judge=_judge,
    title=mark("clearance from half critical speed, shaft {number}"),
    dimension="angular_speed",
    unit="rpm",
    sense="outside",
)
