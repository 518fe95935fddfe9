"""Whether the output runs ahead and back no more than it may."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.load_case import largest
from cardan.checks.verdict import Verdict, as_drawn, joined
from cardan.questions.motion.equivalence import equivalent_joint
from cardan.texts import _, mark


def _judge(design: Design) -> Iterator[Verdict]:
    own = design.value("limits.output_error")
    output = f"shafts[{design.joints}]"
    if own is None:
        yield Verdict(subject=output, missing=("limits.output_error",))
        return
    angle_error = (
        equivalent_joint(design.chain).max_angle_error if design.swing is None else design.swing.max_angle_error[-1]
    )
    made = design.made
    angle_error = angle_error if made is None else np.asarray(made.angle_error)
    moved = design.while_moving(lambda chain: equivalent_joint(chain).max_angle_error[..., None])
    worse = moved is not None and np.all(moved.most[..., 0] > angle_error)
    yield Verdict(
        subject=output,
        value=angle_error if moved is None else largest([angle_error, moved.most[..., 0]]),
        limit=own,
        source=_("limits of the drive file"),
        design_variables=(*design.yoke_design_variables, *design.joint_angle_design_variables),
        note=joined(
            moved.when() if moved is not None and worse else as_drawn(design),
            design.made_note,
        ),
    )


CHECK = Check(
    name="output_error",
    doc=mark("angle error of the output, an amplitude, against the limit of the user"),
    judge=_judge,
    title=mark("angle error of the output (±)"),
    dimension="angle",
    unit="deg",
    crosses="law",
)
