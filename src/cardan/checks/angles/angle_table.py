"""The articles' table of joint angles: which second angle a first one and a speed allow."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.moving import at_its_most
from cardan.checks.verdict import Verdict, at_top_speed, bendable, joined
from cardan.maths.arrays import Array
from cardan.questions.motion.angle_limits import TABLE_TORSIONAL, angle_limits
from cardan.texts import _, mark

SET = 1e-3
"""Yokes this far [rad] from their place count as set right."""


def _judge(design: Design) -> Iterator[Verdict]:
    if design.joints != 2 or not _phased(design):
        return
    speed = design.top_speed
    if speed is None:
        yield Verdict(missing=("duty.speed",))
        return
    if np.any(np.asarray(speed) == 0.0):
        return
    high, note = at_its_most(design, lambda joint_angle: np.max(joint_angle, axis=-1, keepdims=True))
    low = np.min(design.joint_angle, axis=-1)
    if design.drive.movements:
        # √(low² + a/ω²) is kept where high² - low² is at most a/ω²: the largest difference decides. Where a joint
        # comes to bend 90° both are infinite: beside the drawn bend the limit stays a number.
        apart = at_its_most(design, lambda joint_angle: np.abs(joint_angle[..., :1] ** 2 - joint_angle[..., 1:] ** 2))[
            0
        ]
        finite = np.isfinite(high) & np.isfinite(apart)
        square = np.where(finite, high, 0.0) ** 2 - np.where(finite, apart, 0.0)
        low = np.where(finite, np.sqrt(np.maximum(square, 0.0)), low[..., None])[..., 0]
    second = np.where(np.isfinite(high[..., 0]), high[..., 0], low)
    most: Array = angle_limits(speed, low, second, torsional=TABLE_TORSIONAL).most
    most, said = bendable(design, most)
    yield Verdict(
        value=high[..., 0],
        limit=most,
        source=_("rule of practice, source unknown: table of joint angles, √(θ₁² + 400/ω²)"),
        confidence="recalled",
        design_variables=(*design.joint_angle_design_variables, *design.speed_design_variables),
        note=joined(at_top_speed(design), said, note),
    )


def _phased(design: Design) -> bool:
    """Tell whether the yokes of two joints are set so that their joint angles cancel."""
    turned = design.chain.turn_before[..., 1]
    return bool(np.all(np.abs(np.cos(turned)) < SET))


CHECK = Check(
    name="angle_table",
    doc=mark("table of joint angles by speed, for two joints set right"),
    judge=_judge,
    title=mark("larger joint angle beside the smaller, table of angles"),
    dimension="angle",
    unit="deg",
    advice=True,
    crosses="all",
    application="automotive",
)
