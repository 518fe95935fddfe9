"""Whether the teeth of every spline bear their pressure."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.formulas.part_strength import SplineStress, spline_stress
from cardan.texts import _, mark

SIZES = ("outer", "root", "teeth", "tooth_width", "length")


def lacking(design: Design, k: int) -> tuple[str, ...]:
    """Return what the stresses of the spline of a shaft lack."""
    return design.missing(*(f"shafts[{k}].spline.{name}" for name in SIZES))


def stresses(design: Design, k: int) -> tuple[SplineStress, str]:
    """Return the stresses of the spline of a shaft, counted from 0, and a sentence on what decides them."""
    path = f"shafts[{k}].spline"
    torque, note = design.most(lambda case: case.shaft_torque[..., k])
    outer, root, teeth, width, length = (design.value(f"{path}.{name}") for name in SIZES)
    found = spline_stress(
        np.asarray(torque) * design.shock,
        outer=outer,
        root=root,
        teeth=teeth,
        tooth_width=width,
        length=length,
        chamfer=design.value(f"{path}.chamfer"),
        load_share=design.value(f"{path}.load_share"),
    )
    return found, note


def _judge(design: Design, k: int) -> Iterator[Verdict]:
    if design.drive.shafts[k].spline is None:
        return
    path = f"shafts[{k}].spline"
    missing = (*lacking(design, k), *design.missing("limits.spline_pressure"), *design.unloaded)
    if missing:
        yield Verdict(missing=missing)
        return
    found, note = stresses(design, k)
    yield Verdict(
        value=found.pressure,
        limit=design.value("limits.spline_pressure"),
        source=_("2T/(d_m z ψ h l); limits of the drive file, no source gives one"),
        design_variables=(f"{path}.length", f"{path}.outer", f"{path}.teeth", *design.torque_design_variables),
        note=note,
    )


CHECK = Check(
    name="spline_pressure",
    doc=mark("pressure on the teeth of every spline against the limit of the user"),
    shaft=_judge,
    title=mark("flank pressure of the spline of shaft {number}"),
    dimension="stress",
    unit="MPa",
    power=1.0,
)
