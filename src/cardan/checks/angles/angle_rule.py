"""The rule of thumb for joint angles: none above 6°, and two joints within 1.5° of each other."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.moving import at_its_most
from cardan.checks.verdict import Verdict
from cardan.questions.motion.angle_limits import RULE_ANGLE, RULE_DIFFERENCE
from cardan.texts import _, mark


def _judge(design: Design) -> Iterator[Verdict]:
    rule = Verdict(
        source=_("rule of practice, source unknown: 6° and 1.5°"),
        confidence="recalled",
        design_variables=design.joint_angle_design_variables,
    )
    largest, note = at_its_most(design, lambda joint_angle: np.max(joint_angle, axis=-1, keepdims=True))
    yield replace(
        rule, title=_("largest joint angle, rule of thumb"), value=largest[..., 0], limit=RULE_ANGLE, note=note
    )
    if design.joints == 2:
        apart, note = at_its_most(design, lambda joint_angle: np.abs(joint_angle[..., :1] - joint_angle[..., 1:]))
        title = _("difference of the joint angles, rule of thumb")
        yield replace(rule, title=title, value=apart[..., 0], limit=RULE_DIFFERENCE, note=note)


CHECK = Check(
    name="angle_rule",
    doc=mark("rule of thumb: joint angles at most 6°, those of two joints within 1.5°"),
    judge=_judge,
    dimension="angle",
    unit="deg",
    advice=True,
    crosses="all",
    application="automotive",
)
