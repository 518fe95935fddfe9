"""Whether every shaft lasts under torque that swings and secondary couples that turn with it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.load_case import Case
from cardan.checks.verdict import Verdict
from cardan.drive.shaft import Notch
from cardan.formulas.shaft_strength import Fatigue, shaft_fatigue
from cardan.maths.arrays import ArrayLike
from cardan.texts import _, mark

from .section import Section, sections

STRENGTHS = ("ultimate_strength", "yield_strength")


def _judge(design: Design, k: int) -> Iterator[Verdict]:
    if design.drive.shafts[k].layup is not None:
        return
    found = list(sections(design, k))
    if not found:
        if 0 < k < design.joints:
            strong = design.missing(*(f"shafts[{k}].material.{name}" for name in STRENGTHS))
            yield Verdict(missing=(f"shafts[{k}].outer", *strong, *design.unloaded))
        return
    strengths = [section.of_material(name) for section in found for name in STRENGTHS]
    lacking = (*design.missing(*strengths), *design.unloaded)
    if lacking:
        yield Verdict(missing=lacking)
        return
    safeties = [fatigue(design, k, section, case).safety for case in design.loaded for section in found]
    sizes = tuple(path for section in found for path in section.design_variables)
    notches = design.design_variables(f"shafts[{k}].notch.bending", f"shafts[{k}].notch.torsion")
    yield Verdict(
        value=np.min(np.stack(np.broadcast_arrays(*safeties)), axis=0),
        limit=design.value("limits.fatigue_safety"),
        source=_("Goodman with Marin's factors, Shigley chapter 6"),
        design_variables=(
            *sizes,
            strengths[0],
            *notches,
            *design.joint_angle_design_variables,
            *design.torque_design_variables,
        ),
    )


def fatigue(design: Design, k: int, section: Section, case: Case) -> Fatigue:
    """Return the fatigue of a stretch of a shaft, counted from 0, in one way of running."""
    least, most = (torque[..., k] for torque in case.torque_range)
    return of_loads(design, k, section, 0.5 * (most + least), 0.5 * (most - least), case.end_bending[..., k])


def of_loads(
    design: Design, k: int, section: Section, mean: ArrayLike, alternating: ArrayLike, bending: ArrayLike
) -> Fatigue:
    """Return the fatigue of a stretch under a mean and an alternating torque and a bending moment that turns [N·m]."""
    shaft = design.drive.shafts[k]
    notch = shaft.notch or Notch()
    factors = {name: design.value(f"shafts[{k}].notch.{name}") for name in ("bending", "torsion")}
    return shaft_fatigue(
        mean_torque=mean,
        swinging_torque=alternating,
        mean_bending=0.0,
        swinging_bending=bending,
        outer=np.asarray(section.outer, dtype=float),
        inner=section.inner,
        ultimate=design.value(section.of_material("ultimate_strength")),
        yield_strength=design.value(section.of_material("yield_strength")),
        finish=shaft.finish,
        bending_notch=notch.bending if factors["bending"] is None else factors["bending"],
        torsion_notch=notch.torsion if factors["torsion"] is None else factors["torsion"],
        reliability=design.duty.reliability,
    )


CHECK = Check(
    name="tube_fatigue",
    doc=mark("safety of every shaft against fatigue by alternating torque and rotating bending"),
    shaft=_judge,
    title=mark("safety of shaft {number} against fatigue"),
    sense="at_least",
    power=1.0,
)
