"""Whether the journals of every cross carry their largest load."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.formulas.joint_strength import journal_stress
from cardan.texts import _, mark


def _judge(design: Design) -> Iterator[Verdict]:
    for i in range(design.joints):
        cross = f"joints[{i}].cross"
        made = partial(
            Verdict,
            check="journal_strength",
            subject=f"joints[{i}]",
            title=_("stress of the journals of joint {number}").format(number=i + 1),
            dimension="stress",
            unit="MPa",
        )
        strength = f"{cross}.material.yield_strength"
        arm, half = design.value(f"{cross}.bending_arm"), design.value(f"{cross}.journal_length")
        lacking = (*design.missing(f"{cross}.span", f"{cross}.journal", strength), *design.unloaded)
        if arm is None and half is None:
            lacking = (*lacking, f"{cross}.bending_arm")
        if lacking:
            yield made(missing=lacking)
            continue
        couple, note = design.most(lambda case, i=i: case.couple[..., i])  # type: ignore[misc]
        stress = journal_stress(
            couple * design.shock / design.value(f"{cross}.span"),
            diameter=design.value(f"{cross}.journal"),
            arm=0.5 * half if arm is None else arm,
            bore=design.value(f"{cross}.journal_bore"),
        )
        lever = f"{cross}.journal_length" if arm is None else f"{cross}.bending_arm"
        yield made(
            value=stress.mises,
            limit=design.allowed(strength),
            source=_("Book (264), (265) with the grease bore; yield strength over safety"),
            levers=(f"{cross}.journal", f"{cross}.span", lever, strength, *design.torque_levers),
            note=note,
        )


CHECK = Check(
    name="journal_strength",
    doc=mark("stress at the roots of the journals against yielding"),
    judge=_judge,
    crosses="each",
)
