"""Whether the largest torque at every joint over a turn stays below what its maker allows for short times."""

from __future__ import annotations

from collections.abc import Iterator

from cardan.catalogue.rows import JointType
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.texts import _, mark


def _judge(design: Design, i: int) -> Iterator[Verdict]:
    path = f"joints[{i}].rating.max_torque"
    row = design.known.rows(JointType).get(design.drive.joints[i].type)
    rated = design.value(path)
    limit = rated if rated is not None else row.max_torque if row else None
    lacking = (*(() if limit is not None else (path,)), *design.unloaded)
    if lacking:
        yield Verdict(missing=lacking)
        return
    value, note = design.most(lambda case: case.joint_torque[..., i])
    yield Verdict(
        value=value * design.shock,
        limit=limit,
        source=_("rating of the joint") if rated is not None or row is None else row.source,
        confidence="" if rated is not None or row is None else row.confidence,
        rests=() if rated is None else (path,),
        design_variables=(
            *(() if rated is None else (path,)),
            *design.joint_angles_of(i),
            *design.torque_design_variables,
        ),
        note=note,
    )


CHECK = Check(
    name="joint_torque",
    doc=mark("largest torque over a turn at every joint, shocks counted, against its rating"),
    joint=_judge,
    title=mark("largest torque of joint {number}"),
    dimension="torque",
    unit="Nm",
    power=1.0,
    events=True,
)
