"""Whether the output turns as evenly as it must."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.load_case import largest
from cardan.checks.verdict import Verdict, as_drawn, joined
from cardan.questions.motion.equivalence import equivalent_joint
from cardan.texts import _, mark

EVEN = 0.0027
"""Largest speed fluctuation of a drive that counts as even: that of one joint bent by 2.98°."""


def _judge(design: Design) -> Iterator[Verdict]:
    own = design.value("limits.speed_fluctuation")
    output = f"shafts[{design.joints}]"
    if own is None and not design.duty.synchronous:
        yield Verdict(subject=output, missing=("limits.speed_fluctuation",))
        return
    drawn = (
        equivalent_joint(design.chain).speed_fluctuation if design.swing is None else design.swing.speed_fluctuation[-1]
    )
    made = design.made
    drawn = drawn if made is None else np.asarray(made.fluctuation)
    moved = design.while_moving(lambda chain: equivalent_joint(chain).speed_fluctuation[..., None])
    yield Verdict(
        subject=output,
        value=drawn if moved is None else largest([drawn, moved.most[..., 0]]),
        limit=EVEN if own is None else own,
        source=_("Elbe Group: Technical annex 3, fluctuation rate (elbe-group.de)")
        if own is None
        else _("limits of the drive file"),
        design_variables=(*design.yoke_design_variables, *design.joint_angle_design_variables),
        note=joined(
            as_drawn(design) if moved is None or not np.all(moved.most[..., 0] > drawn) else moved.when(),
            design.made_note,
        ),
    )


CHECK = Check(
    name="speed_fluctuation",
    doc=mark("speed fluctuation of the output against the limit of the user"),
    judge=_judge,
    title=mark("speed fluctuation δ of the output"),
    dimension="share",
    unit="percent",
    crosses="law",
)
