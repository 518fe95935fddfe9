"""Whether the needles of every joint oscillate far enough for their paths to overlap."""

from __future__ import annotations

from collections.abc import Iterator

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.formulas.joint_rating import critical_swing
from cardan.texts import _, mark


def _judge(design: Design, i: int) -> Iterator[Verdict]:
    paths = tuple(f"joints[{i}].{one}" for one in ("needles.count", "needles.diameter", "cross.journal"))
    lacking = design.missing(*paths)
    if lacking:
        yield Verdict(missing=lacking)
        return
    yield Verdict(
        value=design.joint_angle[..., i],
        limit=critical_swing(*(design.value(path) for path in paths))[0],
        source=_("pure rolling: 360°/(z(1+γ))"),
        design_variables=design.joint_angles_of(i),
        note=_("below it roller paths do not overlap: false brinelling, and the computed life is optimistic"),
    )


CHECK = Check(
    name="small_oscillation",
    doc=mark("oscillation angle of the needle bearings against that from which roller paths overlap"),
    joint=_judge,
    title=mark("oscillation angle of the needle bearings of joint {number}"),
    dimension="angle",
    unit="deg",
    sense="at_least",
    advice=True,
    crosses="each",
)
