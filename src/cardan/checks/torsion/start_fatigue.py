"""Whether every shaft lasts through the starts of its life, by the damage of each and of running between them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from cardan.answers.quantity import Quantity, say
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.strength.section import sections
from cardan.checks.strength.shaft_life import STRENGTHS, fatigue_life, fatigue_variables, start_cycles, start_damage
from cardan.checks.verdict import Verdict
from cardan.questions.torsion.steady.dynamic_torque import has_torsion
from cardan.texts import _, mark

from .line import NO_MODEL


def _judge(design: Design, k: int) -> Iterator[Verdict]:
    found = list(sections(design, k))
    asked = design.value("duty.starts") is not None
    if not asked or not found or design.drive.shafts[k].layup is not None:
        return
    strengths = [section.of_material(name) for section in found for name in STRENGTHS]
    lacking = (*design.missing("duty.life", *strengths), *design.unloaded)
    if not has_torsion(design.drive):
        lacking = (*NO_MODEL, *lacking)
    cycles = () if lacking else start_cycles(replace(design.drive, poses=()))
    if lacking or isinstance(cycles, tuple):
        yield Verdict(missing=(*lacking, *(cycles if isinstance(cycles, tuple) else ())))
        return
    if k not in cycles:
        return
    one, starts = start_damage(design, k), design.value("duty.starts")
    share = Quantity(float(np.max(one)), "share", 3)
    yield Verdict(
        value=np.asarray(design.value("duty.life")) / fatigue_life(design, k),
        limit=1.0,
        source=_("run-up in time, rainflow by ASTM E1049, Palmgren-Miner; S-N line of Shigley chapter 6"),
        design_variables=(*fatigue_variables(design, k), "duty.starts", "duty.life"),
        note=say(
            _("{share} of the fatigue life per start, {count} starts"),
            share=share,
            count=Quantity(float(np.max(starts)), trim=True),
        ),
    )


CHECK = Check(
    name="start_fatigue",
    doc=mark("fatigue damage of every shaft by the starts of its life and by running"),
    shaft=_judge,
    title=mark("fatigue damage of shaft {number} by starts and running"),
)
