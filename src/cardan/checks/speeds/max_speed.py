"""Whether every joint may turn as fast as it does."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.texts import _, mark


def _judge(design: Design) -> Iterator[Verdict]:
    for i in range(design.joints):
        limit = design.value(f"joints[{i}].rating.max_speed")
        speed = design.top_speed
        made = partial(
            Verdict,
            check="max_speed",
            subject=f"joints[{i}]",
            title=_("speed of joint {number}").format(number=i + 1),
            dimension="angular_speed",
            unit="rpm",
        )
        if limit is None or speed is None:
            lacking = (*design.missing(f"joints[{i}].rating.max_speed"), *(("duty.speed",) if speed is None else ()))
            yield made(missing=lacking)
            continue
        yield made(
            value=speed,
            limit=limit,
            source=_("rating of the joint"),
            levers=design.speed_levers,
        )


CHECK = Check(name="max_speed", doc=mark("highest speed against the rating of every joint"), judge=_judge)
