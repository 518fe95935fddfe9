"""The rule of thumb for the distance of two joints."""

from __future__ import annotations

from collections.abc import Iterator

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.texts import _, mark

LONGEST = 1.5
"""Distance of two joints beyond which unbalance becomes a problem [m]."""


def _judge(design: Design, k: int) -> Iterator[Verdict]:
    if not 0 < k < design.joints:
        return
    length = design.length(k)
    if length is None:
        yield Verdict(missing=(f"shafts[{k}].length",))
        return
    yield Verdict(
        value=length,
        limit=LONGEST,
        source=_("rule of practice, source unknown: at most 1.5 m between joints"),
        confidence="recalled",
        design_variables=design.design_variables(f"shafts[{k}].length") if design.drive.form != "points" else (),
        note=_("a composite tube may be longer") if design.drive.shafts[k].layup is not None else "",
    )


CHECK = Check(
    name="length",
    doc=mark("rule of thumb: at most 1.5 m between two joints"),
    shaft=_judge,
    title=mark("length of shaft {number}"),
    dimension="length",
    unit="mm",
    advice=True,
    application="automotive",
)
