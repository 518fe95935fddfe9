"""The rule of thumb for joint angles: none above 6°, and two joints within 1.5° of each other."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from cardan.analysis.angle_limits import RULE_ANGLE, RULE_DIFFERENCE
from cardan.texts import _, mark

from .check import Check
from .design import Design
from .verdict import Verdict


def _judge(design: Design) -> Iterator[Verdict]:
    source = _("web articles on drive shafts: 6° and 1.5°")
    made = partial(
        Verdict,
        check="angle_rule",
        dimension="angle",
        unit="deg",
        source=source,
        advice=True,
        levers=design.bend_levers,
    )
    yield made(
        title=_("largest bend, rule of thumb"),
        value=np.max(design.bend, axis=-1),
        limit=RULE_ANGLE,
    )
    if design.joints == 2:
        yield made(
            title=_("difference of the bends, rule of thumb"),
            value=np.abs(design.bend[..., 0] - design.bend[..., 1]),
            limit=RULE_DIFFERENCE,
        )


CHECK = Check(
    name="angle_rule",
    doc=mark("rule of thumb: bends at most 6°, those of two joints within 1.5°"),
    judge=_judge,
    crosses="all",
)
