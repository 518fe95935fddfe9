"""Whether the drive keeps away from half the critical speed, where the secondary couples shake its shafts."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.load_case import largest
from cardan.checks.verdict import Verdict
from cardan.formulas.critical_speed import HALF_BAND, SEPARATION
from cardan.texts import _, mark

from .whirl import bounces, clearances, hurry, nearest, whirls


def _judge(design: Design) -> Iterator[Verdict]:
    for one in whirls(design):
        k, speed, lacking, design_variables = one.shaft, one.speed, one.missing, one.design_variables
        running, between = design.held_speeds, design.range_tops
        top = largest(between) if between else design.top_speed
        subject, source = (
            f"shafts[{k}]",
            _("Cardan India: Speed limit, cardanindia.com/speedlimit.html: 8 % to either side"),
        )
        if lacking or top is None:
            yield Verdict(subject=subject, missing=(*lacking, *(() if top is not None else ("duty.speed",))))
            continue
        if speed is None:
            continue
        middle = 0.5 * np.asarray(one.wear * speed)
        low, high = middle * (1.0 - HALF_BAND), middle * (1.0 + HALF_BAND)
        if running:
            yield Verdict(
                subject=subject,
                value=nearest(running, np.sqrt(low * high)),
                limit=(low, high),
                source=source,
                design_variables=(
                    *design_variables,
                    *(path for path in design.speed_design_variables if "range" not in path),
                ),
            )
        if between or np.any(np.asarray(top) > low):
            value = np.minimum(middle, top)
            single = np.ndim(value) == 0
            yield Verdict(
                subject=subject,
                title=_("clearance of the speed range from half critical speed, shaft {number}"),
                value=value,
                limit=(low, high),
                source=source,
                design_variables=design_variables,
                note=hurry(float(2.0 * middle), "shaft", HALF_BAND) if single and low < value < high else "",
                advice=True,
            )
    for bounce in bounces(design):
        texts = (
            _("clearance from half critical speed, bounce mode on support {number}"),
            _("passing half critical speed, bounce mode on support {number}"),
        )
        if bounce.sideways:
            texts = (
                _("clearance from half critical speed, bounce mode on support {number}, sideways"),
                _("passing half critical speed, bounce mode on support {number}, sideways"),
            )
        source = _("separation of 20 % from a resonance; couples of the joints come twice a turn")
        yield from clearances(design, bounce, 0.5, SEPARATION, texts, source)


CHECK = Check(
    name="half_critical",
    doc=mark("operating speeds against the band about half the critical speed"),
    judge=_judge,
    title=mark("clearance from half critical speed, shaft {number}"),
    dimension="angular_speed",
    unit="rpm",
    sense="outside",
    moves=True,
    slides=True,
)
