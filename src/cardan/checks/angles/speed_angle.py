"""Whether speed times bend of every joint stays below what its maker or its type allow."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from cardan.catalogue.rows import JointType
from cardan.checks.case import largest
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.texts import _, mark


def _judge(design: Design) -> Iterator[Verdict]:
    for i, joint in enumerate(design.drive.joints):
        row = design.known.rows(JointType).get(joint.type)
        rated = design.value(f"joints[{i}].rating.speed_angle")
        limit = rated if rated is not None else row.max_speed_angle if row else None
        made = partial(
            Verdict,
            check="speed_angle",
            subject=f"joints[{i}]",
            title=_("speed times bend of joint {number}").format(number=i + 1),
            dimension="speed_angle",
            unit="rpm_deg",
        )
        lacking = () if limit is not None else (f"joints[{i}].rating.speed_angle",)
        running = [case for case in design.cases if case.speed is not None]
        if lacking or not running:
            yield made(missing=(*lacking, *(() if running else ("duty.speed",))))
            continue
        yield made(
            value=largest([np.asarray(case.speed) * case.bend[..., i] for case in running]),
            limit=limit,
            source=_("rating of the joint") if rated is not None or row is None else row.source,
            levers=(*design.bends_of(i), *design.speed_levers),
            note="" if design.duty.continuous else _("counts in continuous running; this drive runs for short times"),
            advice=not design.duty.continuous,
        )


CHECK = Check(name="speed_angle", doc=mark("speed times bend of every joint against its rating or type"), judge=_judge)
