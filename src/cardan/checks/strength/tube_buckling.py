"""Whether tubes stay below the torque at which their wall buckles."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.formulas.shaft_strength import composite_tube, wall_buckling_torque
from cardan.maths.arrays import Array
from cardan.texts import _, mark

from .section import STEEL, modulus, sections


def _judge(design: Design, k: int) -> Iterator[Verdict]:
    yield from _of_metal(design, k) if design.drive.shafts[k].layup is None else _of_composite(design, k)


def _of_composite(design: Design, k: int) -> Iterator[Verdict]:
    title = _("torsional buckling of the composite tube, shaft {number}")
    buckles = composite_buckling(design, k)
    if buckles is None or design.unloaded:
        yield Verdict(title=title, missing=(*design.missing(f"shafts[{k}].outer"), *design.unloaded))
        return
    torque, note = design.most(lambda case: case.shaft_torque[..., k])
    yield Verdict(
        title=title,
        value=torque * design.shock,
        limit=buckles / design.value("limits.safety"),
        source=_("buckling of the wall, 2π r² t·0.272 (E_x E_y³)^(1/4) (t/r)^(3/2), over safety"),
        design_variables=(f"shafts[{k}].layup.ply_thickness", f"shafts[{k}].outer", *design.torque_design_variables),
        note=note,
    )


def composite_buckling(design: Design, k: int) -> Array | None:
    """Return the torque at which the wall of a composite shaft, counted from 0, buckles [N·m]; None for any other."""
    shaft = design.drive.shafts[k]
    if shaft.layup is None or shaft.outer is None:
        return None
    plies = len(shaft.layup.angles)
    given = shaft.outer - plies * shaft.layup.ply_thickness
    outer, ply = design.value(f"shafts[{k}].outer"), design.value(f"shafts[{k}].layup.ply_thickness")
    # With the same angles the moduli stay, and the torque goes with d^(1/2) t^(5/2).
    wide = (np.asarray(outer) - plies * np.asarray(ply)) / given
    thick: Array = np.sqrt(wide) * (np.asarray(ply) / shaft.layup.ply_thickness) ** 2.5
    return composite_tube(shaft.layup, given).buckling_torque * thick


def _of_metal(design: Design, k: int) -> Iterator[Verdict]:
    """Yield the verdicts of the tubes of a shaft of one material; a solid one has no wall."""
    for section in sections(design, k):
        if not np.any(np.asarray(section.inner) > 0.0):
            continue
        title = _("torsional buckling, shaft {number}") + section.words
        if section.profile is not None:
            why = _(
                "there is a formula for the wall of round tubes only, and a lobed wall is flatter between its lobes"
            )
            yield Verdict(title=title, unfit=why)
            continue
        if design.unloaded:
            yield Verdict(title=title, missing=design.unloaded)
            continue
        given = design.value(section.of_material("poisson"))
        poisson = STEEL.poisson if given is None else given
        torque, note = design.most(lambda case: case.shaft_torque[..., k])
        buckles = wall_buckling_torque(section.outer, section.inner, modulus(design, section, "youngs"), poisson)
        yield Verdict(
            title=title,
            value=torque * design.shock,
            limit=buckles / design.value("limits.safety"),
            source=_("buckling of the wall by Timoshenko and Gere, 11.11, over safety"),
            design_variables=(*section.design_variables, *design.torque_design_variables),
            note=note,
        )


CHECK = Check(
    name="tube_buckling",
    doc=mark("torque of tubes against buckling of their wall"),
    shaft=_judge,
    dimension="torque",
    unit="Nm",
    power=1.0,
    events=True,
)
