"""The pressure of Hertz on balls and rollers inside of joints without a cross."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.drive.joints import Joint
from cardan.formulas.hertz import point_contact
from cardan.maths.arrays import Array
from cardan.questions.forces.inner_loads import unit_loads
from cardan.texts import _, mark

FEW = 8
"""Joint angles that are looked at one by one; of more those at `STEP`, straight between them."""

STEP = np.radians(0.5)


def _judge(design: Design, i: int) -> Iterator[Verdict]:
    joint = design.drive.joints[i]
    if not joint.pressed:
        return
    missing = (*(f"joints[{i}].{name}" for name in joint.without(joint.pressed)), *design.unloaded)
    if missing:
        yield Verdict(missing=missing)
        return
    touching = [(k, one.contact) for k, one in enumerate(unit_loads(joint, 0.0)) if one.contact is not None]
    if not touching:
        yield Verdict(unfit=_("its balls do not fit all at once, so that it is open which of them carry"))
        return
    found = [_carried(design, i, k) for k, _contact in touching]
    worst = [
        point_contact(load * design.shock, one.across, one.along).pressure
        for (load, _note), (_k, one) in zip(found, touching, strict=True)
    ]
    yield Verdict(
        value=np.max(worst, axis=0),
        limit=joint.static_pressure,
        source=_("Hertz; {pressure} MPa stands behind ISO 76").format(pressure=round(joint.static_pressure / 1e6)),
        design_variables=(*design.joint_angles_of(i), *design.torque_design_variables),
        note=found[0][1],
    )


def _carried(design: Design, i: int, k: int) -> tuple[Array, str]:
    """Return the largest force on parts alike of a joint [N], and what decides it in a sentence."""
    joint = design.drive.joints[i]
    return design.most(lambda case: case.joint_torque[..., i] * _force(joint, k, case.joint_angle[..., i]))


def _force(joint: Joint, k: int, joint_angle: Array) -> Array:
    """Return the largest force on parts alike of a joint over its torque [1/m], at joint angles (...) [rad]."""

    def exact(angle: float) -> float:
        return float(np.max([unit_loads(joint, angle, fed=fed)[k].high for fed in (True, False)]))

    flat = np.unique(joint_angle)
    if flat.size > FEW:
        flat = np.arange(np.floor(flat[0] / STEP), np.ceil(flat[-1] / STEP) + 1) * STEP
    found: Array = np.interp(joint_angle, flat, [exact(float(one)) for one in flat])
    return found


CHECK = Check(
    name="inner_pressure",
    doc=mark("pressure of Hertz on the balls and rollers of joints without a cross"),
    joint=_judge,
    title=mark("contact pressure of the balls or rollers of joint {number}"),
    dimension="stress",
    unit="MPa",
    advice=True,
    power=1.0 / 3.0,
    events=True,
)
