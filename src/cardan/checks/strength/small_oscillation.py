"""Whether the needles of every joint swing far enough to share their tracks."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.formulas.needle_bearing import critical_swing
from cardan.texts import _, mark


def _judge(design: Design) -> Iterator[Verdict]:
    for i in range(design.joints):
        paths = tuple(f"joints[{i}].{one}" for one in ("needles.count", "needles.diameter", "cross.journal"))
        made = partial(
            Verdict,
            check="small_oscillation",
            subject=f"joints[{i}]",
            title=_("swing of the needles of joint {number}").format(number=i + 1),
            dimension="angle",
            unit="deg",
            sense="at_least",
            advice=True,
        )
        lacking = design.missing(*paths)
        if lacking:
            yield made(missing=lacking)
            continue
        yield made(
            value=design.bend[..., i],
            limit=critical_swing(*(design.value(path) for path in paths))[0],
            source=_("pure rolling: 360°/(z(1+γ))"),
            levers=design.bends_of(i),
            note=_("below it every needle wears its own patch, and life formulas promise too much; most drives do"),
        )


CHECK = Check(
    name="small_oscillation",
    doc=mark("bend of every joint against that from which needles share their tracks"),
    judge=_judge,
    crosses="each",
)
