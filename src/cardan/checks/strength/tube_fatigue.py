"""Whether every shaft lasts under torque that swings and secondary couples that turn with it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.maths.arrays import Array
from cardan.texts import _, mark

from .section import sections
from .shaft_life import STRENGTHS, fatigue, fatigue_variables, life_safety, measured


def _judge(design: Design, k: int) -> Iterator[Verdict]:
    if design.drive.shafts[k].layup is not None:
        return
    found = list(sections(design, k))
    if not found:
        if 0 < k < design.joints:
            strong = design.missing(*(f"shafts[{k}].material.{name}" for name in STRENGTHS))
            yield Verdict(missing=(f"shafts[{k}].outer", *strong, *design.unloaded))
        return
    strengths = [section.of_material(name) for section in found for name in STRENGTHS]
    lacking = (*design.missing(*strengths), *design.unloaded)
    if lacking:
        yield Verdict(missing=lacking)
        return
    safeties = [fatigue(design, k, section, case).safety for case in design.loaded for section in found]
    steady: Array = np.min(np.stack(np.broadcast_arrays(*safeties)), axis=0)
    cycled = life_safety(design, k) if measured(design) else np.inf
    yield Verdict(
        value=np.minimum(steady, cycled),
        limit=design.value("limits.fatigue_safety"),
        source=_("Goodman with Marin's factors, Shigley chapter 6"),
        design_variables=fatigue_variables(design, k),
        note=_("decided by the cycles of the measured torque") if np.all(cycled < steady) else "",
    )


CHECK = Check(
    name="tube_fatigue",
    doc=mark("safety of every shaft against fatigue by alternating torque and rotating bending"),
    shaft=_judge,
    title=mark("safety of shaft {number} against fatigue"),
    sense="at_least",
    power=1.0,
)
