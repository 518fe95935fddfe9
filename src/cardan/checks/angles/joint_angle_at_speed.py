"""The largest joint angle of one joint that practice allows at a speed."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.catalogue.rows import MaxJointAngle, sureness
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.moving import at_its_most
from cardan.checks.verdict import Verdict, bendable, joined
from cardan.maths.arrays import Array
from cardan.texts import mark


def _judge(design: Design) -> Iterator[Verdict]:
    rows = sorted(design.known.rows(MaxJointAngle).values(), key=lambda row: row.speed)
    speed = design.top_speed
    if speed is None:
        yield Verdict(missing=("duty.speed",))
        return
    if not rows:
        return
    # Speed times angle hardly changes along the table: straight in that product, and constant beyond its ends.
    at = np.asarray([row.speed for row in rows])
    turning = np.maximum(np.asarray(speed, dtype=float), 1e-9)
    limit: Array = np.interp(turning, at, at * np.asarray([row.max_joint_angle for row in rows])) / turning
    limit, said = bendable(design, limit)
    largest, note = at_its_most(design, lambda joint_angle: np.max(joint_angle, axis=-1, keepdims=True))
    yield Verdict(
        value=largest[..., 0],
        limit=limit,
        source=rows[0].source,
        confidence=min((row.confidence for row in rows), key=sureness),
        design_variables=(*design.joint_angle_design_variables, *design.speed_design_variables),
        note=joined(said, note),
    )


CHECK = Check(
    name="joint_angle_at_speed",
    doc=mark("largest joint angle at the highest speed, a maker's guide"),
    judge=_judge,
    title=mark("largest joint angle at the highest speed"),
    dimension="angle",
    unit="deg",
    advice=True,
    crosses="all",
    application="automotive",
)
