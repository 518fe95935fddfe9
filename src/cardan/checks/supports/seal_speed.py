"""Whether the seals of the supports bear how fast the shaft rubs under their lips."""

from __future__ import annotations

from collections.abc import Iterator

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.texts import _, mark


def _judge(design: Design) -> Iterator[Verdict]:
    speed = design.top_speed
    for k in range(len(design.drive.supports)):
        path = f"supports[{k}].max_lip_speed"
        limit, diameter = design.value(path), design.value(f"supports[{k}].seal_diameter")
        if limit is None or diameter is None:
            continue
        if speed is None:
            yield Verdict(subject=f"supports[{k}]", missing=design.unmoved)
            continue
        yield Verdict(
            subject=f"supports[{k}]",
            value=0.5 * diameter * speed,
            limit=limit,
            source=_("largest speed under the lip of the seal"),
            design_variables=design.speed_design_variables,
            rests=(path,),
        )


CHECK = Check(
    name="seal_speed",
    doc=mark("speed of the shaft's surface under the seals of every support against the largest they bear"),
    judge=_judge,
    title=mark("speed under the seals of support {number}"),
    dimension="speed",
    unit="m_s",
)
