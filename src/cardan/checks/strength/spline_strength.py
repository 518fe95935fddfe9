"""Whether the core and the teeth of every spline carry the torque."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.texts import _, mark

from .spline_pressure import SIZES, stresses


def _judge(design: Design) -> Iterator[Verdict]:
    for k, shaft in enumerate(design.drive.shafts):
        if shaft.spline is None:
            continue
        path, strength = f"shafts[{k}].spline", f"shafts[{k}].material.yield_strength"
        made = partial(
            Verdict,
            check="spline_strength",
            subject=f"shafts[{k}]",
            title=_("stress of the core of the spline of shaft {number}").format(number=k + 1),
            dimension="stress",
            unit="MPa",
        )
        lacking = (*design.missing(*(f"{path}.{name}" for name in SIZES), strength), *design.unloaded)
        if lacking:
            yield made(missing=lacking)
            continue
        found, note = stresses(design, k)
        made = partial(made, limit=design.allowed(strength), note=note)
        levers = (strength, *design.torque_levers)
        yield made(
            value=math.sqrt(3.0) * found.core_shear,
            source=_("torsion at the root diameter, von Mises; yield strength over safety"),
            levers=(f"{path}.root", *levers),
        )
        yield made(
            title=_("stress of the teeth of the spline of shaft {number}").format(number=k + 1),
            value=math.sqrt(3.0) * found.tooth_shear,
            source=_("shear at the roots of the teeth, von Mises; yield strength over safety"),
            levers=(f"{path}.length", f"{path}.tooth_width", *levers),
        )


CHECK = Check(name="spline_strength", doc=mark("core and teeth of every spline against yielding"), judge=_judge)
