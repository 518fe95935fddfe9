"""Whether speed times joint angle of every joint stays below what its maker or its type allow."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.catalogue.rows import JointType
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.load_case import largest
from cardan.checks.verdict import Verdict
from cardan.texts import _, mark


def _judge(design: Design, i: int) -> Iterator[Verdict]:
    path = f"joints[{i}].rating.speed_angle"
    row = design.known.rows(JointType).get(design.drive.joints[i].type)
    rated = design.value(path)
    limit = rated if rated is not None else row.max_speed_angle if row else None
    running = [case for case in design.cases if case.speed is not None]
    if limit is None or not running:
        yield Verdict(missing=(*(() if limit is not None else (path,)), *(() if running else ("duty.speed",))))
        return
    yield Verdict(
        value=largest([np.asarray(case.speed) * case.joint_angle[..., i] for case in running]),
        limit=limit,
        source=_("rating of the joint") if rated is not None or row is None else row.source,
        confidence="" if rated is not None or row is None else row.confidence,
        rests=() if rated is None else (path,),
        design_variables=(*design.joint_angles_of(i), *design.speed_design_variables),
        note="" if design.duty.continuous else _("counts in continuous running; this drive runs for short times"),
        advice=not design.duty.continuous,
    )


CHECK = Check(
    name="speed_angle",
    doc=mark("speed times angle n·α of every joint against its rating or type"),
    joint=_judge,
    title=mark("speed times angle n·α of joint {number}"),
    dimension="speed_angle",
    unit="rpm_deg",
)
