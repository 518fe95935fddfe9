"""Whether the bearings of the supports may turn as fast as they do."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.texts import _, mark


def _judge(design: Design) -> Iterator[Verdict]:
    source = _("limiting speed of the bearing as it is sealed")
    yield from of_supports(design, "max_speed", lambda _k: 1.0, source)


def of_supports(design: Design, name: str, arm: Callable[[int], Any], source: str) -> Iterator[Verdict]:
    """Yield verdicts on the supports that give a limit by this name: of the highest speed times the arm of each.

    arm: number of a support, from 0 -> by what its speed counts; None where it is not known.
    """
    speed = design.top_speed
    for k in range(len(design.drive.supports)):
        path = f"supports[{k}].{name}"
        limit, by = design.value(path), arm(k)
        if limit is None or by is None:
            continue
        if speed is None:
            yield Verdict(subject=f"supports[{k}]", missing=design.unmoved)
            continue
        yield Verdict(
            subject=f"supports[{k}]",
            value=by * speed,
            limit=limit,
            source=source,
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
