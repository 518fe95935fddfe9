"""Whether the rim of every joint runs no faster than it may."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from cardan.catalogue.rows import JointType
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.texts import _, mark


def _judge(design: Design) -> Iterator[Verdict]:
    for i, joint in enumerate(design.drive.joints):
        row = design.known.rows(JointType).get(joint.type)
        rated = design.value(f"joints[{i}].rating.rim_speed")
        limit = rated if rated is not None else row.max_rim_speed if row else None
        if limit is None:
            continue
        speed = design.top_speed
        outer = f"joints[{i}].rating.outer"
        made = partial(
            Verdict,
            check="rim_speed",
            subject=f"joints[{i}]",
            title=_("speed of the rim of joint {number}").format(number=i + 1),
            dimension="speed",
            unit="m_s",
        )
        lacking = (*design.missing(outer), *(("duty.speed",) if speed is None else ()))
        if lacking:
            yield made(missing=lacking)
            continue
        yield made(
            value=0.5 * np.asarray(speed) * design.value(outer),
            limit=limit,
            source=_("rating of the joint") if rated is not None or row is None else row.source,
            levers=(*design.speed_levers, outer),
        )


CHECK = Check(name="rim_speed", doc=mark("speed of the rim of joints that have a limit for it"), judge=_judge)
