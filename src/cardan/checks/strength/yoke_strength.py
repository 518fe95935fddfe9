"""Whether the yokes of every joint carry the load of the journals."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.formulas.joint_strength import yoke_stress
from cardan.texts import _, mark


def _judge(design: Design) -> Iterator[Verdict]:
    for i, joint in enumerate(design.drive.joints):
        yoke = f"joints[{i}].yoke"
        made = partial(
            Verdict,
            check="yoke_strength",
            subject=f"joints[{i}]",
            title=_("stress of the yokes of joint {number}").format(number=i + 1),
            dimension="stress",
            unit="MPa",
        )
        span, strength = f"joints[{i}].cross.span", f"{yoke}.material.yield_strength"
        paths = tuple(f"{yoke}.{one}" for one in ("bending_arm", "torsion_arm", "section"))
        lacking = (*design.missing(span, *paths, strength), *design.unloaded)
        section = joint.yoke.section if joint.yoke is not None else None
        if lacking or section is None:
            yield made(missing=lacking)
            continue
        couple, note = design.most(lambda case, i=i: case.couple[..., i])  # type: ignore[misc]
        height, width = f"{yoke}.section.height", f"{yoke}.section.width"
        stress = yoke_stress(
            couple * design.shock / design.value(span),
            bending_arm=design.value(paths[0]),
            torsion_arm=design.value(paths[1]),
            height=design.value(height),
            width=design.value(width),
            shape=section.shape,
        )
        yield made(
            value=stress.mises,
            limit=design.allowed(strength),
            source=_("Book (263) with Saint-Venant's torsion; yield strength over safety"),
            levers=(height, width, *paths[:2], span, strength, *design.torque_levers),
            note=note,
        )


CHECK = Check(
    name="yoke_strength", doc=mark("stress of the yokes of every joint against yielding"), judge=_judge, crosses="each"
)
