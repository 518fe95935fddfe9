"""Whether the rim of every joint runs no faster than it may."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.catalogue.rows import JointType
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.texts import _, mark


def _judge(design: Design, i: int) -> Iterator[Verdict]:
    row = design.known.rows(JointType).get(design.drive.joints[i].type)
    rated, outer = design.value(f"joints[{i}].rating.rim_speed"), f"joints[{i}].rating.outer"
    limit = rated if rated is not None else row.max_rim_speed if row else None
    if limit is None:
        return
    lacking = (*design.missing(outer), *design.unmoved)
    if lacking:
        yield Verdict(missing=lacking)
        return
    yield Verdict(
        value=0.5 * np.asarray(design.top_speed) * design.value(outer),
        limit=limit,
        source=_("rating of the joint") if rated is not None or row is None else row.source,
        confidence="" if rated is not None or row is None else row.confidence,
        rests=() if rated is None else (f"joints[{i}].rating.rim_speed",),
        design_variables=(*design.speed_design_variables, outer),
    )


CHECK = Check(
    name="rim_speed",
    doc=mark("speed of the rim of joints that have a limit for it"),
    joint=_judge,
    title=mark("speed of the rim of joint {number}"),
    dimension="speed",
    unit="m_s",
)
