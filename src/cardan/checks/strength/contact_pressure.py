"""The pressure between the most loaded needle and its journal."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.formulas.needle_bearing import STATIC_PRESSURE, needle_contact
from cardan.texts import _, mark


def _judge(design: Design) -> Iterator[Verdict]:
    for i in range(design.joints):
        span, journal = f"joints[{i}].cross.span", f"joints[{i}].cross.journal"
        sizes = tuple(f"joints[{i}].needles.{one}" for one in ("count", "diameter", "length"))
        made = partial(
            Verdict,
            check="contact_pressure",
            subject=f"joints[{i}]",
            title=_("pressure on the needles of joint {number}").format(number=i + 1),
            dimension="stress",
            unit="MPa",
            advice=True,
        )
        lacking = (*design.missing(span, journal, *sizes), *design.unloaded)
        if lacking:
            yield made(missing=lacking)
            continue
        couple, note = design.most(lambda case, i=i: case.couple[..., i])  # type: ignore[misc]
        force = couple * design.shock / design.value(span)
        count, diameter, length = (design.value(path) for path in sizes)
        yield made(
            value=needle_contact(force, count, diameter, length, design.value(journal)).pressure,
            limit=STATIC_PRESSURE,
            source=_("Hertz; 4000 MPa stands behind ISO 76"),
            levers=(span, *sizes, journal, *design.torque_levers),
            note=note,
        )


CHECK = Check(
    name="contact_pressure", doc=mark("pressure of Hertz on the needles of every joint"), judge=_judge, crosses="each"
)
