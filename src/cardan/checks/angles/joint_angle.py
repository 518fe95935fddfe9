"""Whether every joint may bend as far as it does: by its maker, its type, or the user's own limit."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.catalogue.rows import JointType
from cardan.checks.case import largest
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.moving import largest_joint_angle
from cardan.checks.verdict import Verdict
from cardan.texts import _, mark


def _judge(design: Design, i: int) -> Iterator[Verdict]:
    row = design.known.rows(JointType).get(design.drive.joints[i].type)
    limits = [
        (design.value("limits.joint_angle"), _("limits of the drive file")),
        (design.value(f"joints[{i}].rating.max_joint_angle"), _("rating of the joint")),
        (row.max_joint_angle if row else None, row.source if row else ""),
    ]
    given = [(limit, source) for limit, source in limits if limit is not None]
    if not given:
        yield Verdict(missing=(f"joints[{i}].rating.max_joint_angle",))
        return
    limit, source = given[0]
    joint_angles = [np.asarray(case.joint_angle)[..., i] for case in design.cases] or [design.joint_angle[..., i]]
    moved = largest_joint_angle(design, i)
    note = _("while the drive moves") if np.all(moved > largest(joint_angles)) else ""
    yield Verdict(
        value=largest([*joint_angles, moved]),
        limit=limit,
        source=source,
        design_variables=design.joint_angles_of(i),
        note=note,
    )


CHECK = Check(
    name="joint_angle",
    doc=mark("joint angle of every joint against what maker, type or user allow"),
    joint=_judge,
    title=mark("joint angle of joint {number}"),
    dimension="angle",
    unit="deg",
)
