"""Whether the bearings of the supports may turn as fast as they do."""

from __future__ import annotations

from collections.abc import Iterator

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.texts import _, mark


def _judge(design: Design) -> Iterator[Verdict]:
    speed = design.top_speed
    for k in range(len(design.drive.supports)):
        path = f"supports[{k}].max_speed"
        limit = design.value(path)
        if limit is None:
            continue
        if speed is None:
            yield Verdict(subject=f"supports[{k}]", missing=design.unmoved)
            continue
        yield Verdict(
            subject=f"supports[{k}]",
            value=speed,
            limit=limit,
            source=_("limiting speed of the bearing as it is sealed"),
            design_variables=design.speed_design_variables,
            rests=(path,),
        )


CHECK = Check(
    name="support_speed",
    doc=mark("highest speed against the limiting speed of the bearing of every support"),
    judge=_judge,
    title=mark("speed of the bearing of support {number}"),
    dimension="angular_speed",
    unit="rpm",
)
