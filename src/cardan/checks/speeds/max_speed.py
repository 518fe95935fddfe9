"""Whether every joint may turn as fast as it does."""

from __future__ import annotations

from collections.abc import Iterator

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.texts import _, mark


def _judge(design: Design, i: int) -> Iterator[Verdict]:
    path, speed = f"joints[{i}].rating.max_speed", design.top_speed
    limit = design.value(path)
    if limit is None or speed is None:
        yield Verdict(missing=(*design.missing(path), *design.unmoved))
        return
    yield Verdict(
        value=speed,
        limit=limit,
        source=_("rating of the joint"),
        design_variables=design.speed_design_variables,
        rests=(path,),
    )


CHECK = Check(
    name="max_speed",
    doc=mark("highest speed against the rating of every joint"),
    joint=_judge,
    title=mark("speed of joint {number}"),
    dimension="angular_speed",
    unit="rpm",
)
