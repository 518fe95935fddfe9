"""Whether the bearings of the supports carry their largest load as at rest."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.drive.conditions import load_cases, under
from cardan.maths.ties import foremost
from cardan.questions.life.support_loads import SupportLoads, rated_supports, support_loads
from cardan.texts import _, mark

from .support_life import alone


def _judge(design: Design) -> Iterator[Verdict]:
    which = [k for k in rated_supports(design.drive)[0] if not design.missing(f"supports[{k}].static_capacity")]
    if not which:
        return
    cases = [one for one in load_cases(design.duty) if one.pose in ("", design.pose) and one.torque is not None]
    if not cases or not alone(design):
        many = "" if alone(design) else _("judges one drive at a time; a sweep asks life")
        for k in which:
            yield Verdict(subject=f"supports[{k}]", missing=() if many else design.unloaded, unfit=many)
        return
    found = [support_loads(under(design.drive, one), which, one.shock_factor, factor=1.0) for one in cases]
    told = [(one.name, loads) for one, loads in zip(cases, found, strict=True) if isinstance(loads, SupportLoads)]
    for place, k in enumerate(which):
        why = next((loads for loads in found if isinstance(loads, str)), "")
        if why:
            yield Verdict(subject=f"supports[{k}]", unfit=why)
            continue
        most = int(foremost([float(loads.static[place]) for _name, loads in told]))
        name, worst = told[most]
        yield Verdict(
            subject=f"supports[{k}]",
            value=np.asarray(worst.static)[place],
            limit=design.value(f"supports[{k}].static_capacity"),
            source=_("static capacity of the bearing, ISO 76"),
            rests=(f"supports[{k}].static_capacity",),
            note=_("decided by {case}").format(case=name) if name else "",
        )


CHECK = Check(
    name="support_static",
    doc=mark("largest equivalent load of the ball bearings of the supports at rest against ISO 76"),
    judge=_judge,
    title=mark("load of the bearing of support {number} at rest"),
    dimension="force",
    unit="N",
)
