"""Whether flexible couplings twist no farther than they may."""

from __future__ import annotations

from collections.abc import Iterator

from cardan.catalogue.rows import JointType
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.texts import _, mark


def _judge(design: Design, i: int) -> Iterator[Verdict]:
    joint, path = design.drive.joints[i], f"joints[{i}]"
    if "max_windup" not in joint.own_fields():
        return
    row = design.known.rows(JointType).get(joint.type)
    own = design.value(f"{path}.max_windup")
    limit = own if own is not None else row.max_windup if row else None
    missing = (
        *design.missing(f"{path}.stiffness"),
        *(() if limit is not None else (f"{path}.max_windup",)),
        *design.unloaded,
    )
    if missing:
        yield Verdict(missing=missing)
        return
    torque, note = design.most(lambda case: case.joint_torque[..., i])
    typed = own is None and row is not None
    yield Verdict(
        value=torque * design.shock / design.value(f"{path}.stiffness"),
        limit=limit,
        source=row.source if row is not None and typed else _("limit of the joint"),
        confidence=row.confidence if row is not None and typed else "",
        design_variables=design.torque_design_variables,
        note=note,
    )


CHECK = Check(
    name="windup",
    doc=mark("angle by which every flexible coupling twists under torque, shocks counted, against its limit"),
    joint=_judge,
    title=mark("angle of twist of joint {number}"),
    dimension="angle",
    unit="deg",
    power=1.0,
    events=True,
)
