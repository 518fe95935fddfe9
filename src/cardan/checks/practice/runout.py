"""The rule of practice for the run-out of tubes."""

from __future__ import annotations

from collections.abc import Iterator

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.texts import _, mark
from cardan.units import mm

STRAIGHT, HEAVY = 0.25 * mm, 0.8 * mm
"""Run-out to which shafts are straightened before balancing, and that of trucks of 5 t and more [m]."""


def _judge(design: Design, k: int) -> Iterator[Verdict]:
    heavy = design.duty.balance_class == "truck_over_5t"
    if design.drive.shafts[k].runout is not None:
        yield Verdict(
            value=design.value(f"shafts[{k}].runout"),
            limit=HEAVY if heavy else STRAIGHT,
            source=_("Kozhevnikov & Perfil'ev (1978), p. 247, trucks of 5 t and more")
            if heavy
            else _("rule of practice, source unknown: 0.25 mm"),
            confidence="book" if heavy else "recalled",
            design_variables=(f"shafts[{k}].runout",),
        )


CHECK = Check(
    name="runout",
    doc=mark("run-out of tubes against practice"),
    shaft=_judge,
    title=mark("run-out of shaft {number}"),
    dimension="length",
    unit="mm",
    advice=True,
    application="automotive",
)
