"""Whether the largest torque at every joint over a turn stays below what its maker allows for short times."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from cardan.catalogue.rows import JointType
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.texts import _, mark


def _judge(design: Design) -> Iterator[Verdict]:
    for i, joint in enumerate(design.drive.joints):
        row = design.known.rows(JointType).get(joint.type)
        rated = design.value(f"joints[{i}].rating.max_torque")
        limit = rated if rated is not None else row.max_torque if row else None
        made = partial(
            Verdict,
            check="joint_torque",
            subject=f"joints[{i}]",
            title=_("largest torque of joint {number}").format(number=i + 1),
            dimension="torque",
            unit="Nm",
        )
        lacking = (*(() if limit is not None else (f"joints[{i}].rating.max_torque",)), *design.unloaded)
        if lacking:
            yield made(missing=lacking)
            continue
        value, note = design.most(lambda case, i=i: case.joint_torque[..., i])  # type: ignore[misc]
        yield made(
            value=value * design.shock,
            limit=limit,
            source=_("rating of the joint") if rated is not None or row is None else row.source,
            levers=(f"joints[{i}].rating.max_torque", *design.bends_of(i), *design.torque_levers)
            if rated is not None
            else (*design.bends_of(i), *design.torque_levers),
            note=note,
        )


CHECK = Check(
    name="joint_torque",
    doc=mark("largest torque over a turn at every joint, shocks counted, against its rating"),
    judge=_judge,
)
