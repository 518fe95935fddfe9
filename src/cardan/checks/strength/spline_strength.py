"""Whether the core and the teeth of every spline carry the torque."""

from __future__ import annotations

import math
from collections.abc import Iterator

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.texts import _, mark

from .spline_pressure import lacking, stresses


def _judge(design: Design, k: int) -> Iterator[Verdict]:
    if design.drive.shafts[k].spline is None:
        return
    path, strength = f"shafts[{k}].spline", f"shafts[{k}].material.yield_strength"
    missing = (*lacking(design, k), *design.missing(strength), *design.unloaded)
    if missing:
        yield Verdict(missing=missing)
        return
    found, note = stresses(design, k)
    design_variables = (strength, *design.torque_design_variables)
    yield Verdict(
        value=math.sqrt(3.0) * found.core_shear,
        limit=design.allowed(strength),
        source=_("torsion at the root diameter, von Mises; yield strength over safety"),
        design_variables=(f"{path}.root", *design_variables),
        note=note,
    )
    yield Verdict(
        title=_("stress of the teeth of the spline of shaft {number}"),
        value=math.sqrt(3.0) * found.tooth_shear,
        limit=design.allowed(strength),
        source=_("shear at the roots of the teeth, von Mises; yield strength over safety"),
        design_variables=(f"{path}.length", f"{path}.tooth_width", *design_variables),
        note=note,
    )


CHECK = Check(
    name="spline_strength",
    doc=mark("core and teeth of every spline against yielding"),
    shaft=_judge,
    title=mark("stress of the core of the spline of shaft {number}"),
    dimension="stress",
    unit="MPa",
    power=1.0,
    events=True,
)
