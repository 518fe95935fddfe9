"""Whether the plies of composite tubes, and the bond of their metal ends, carry torque and secondary couples."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.load_case import Case
from cardan.checks.verdict import Verdict
from cardan.drive.shaft import Layup
from cardan.formulas.shaft_strength import PLY_STRENGTHS, PlyExposure, bond_shear, ply_exposure
from cardan.maths.arrays import Array
from cardan.texts import _, mark


def _judge(design: Design, k: int) -> Iterator[Verdict]:
    layup, path = design.drive.shafts[k].layup, f"shafts[{k}].layup"
    if layup is None:
        return
    strengths = tuple(f"{path}.ply.{name}" for name in PLY_STRENGTHS)
    lacking = (*design.missing(*strengths), *design.missing(f"shafts[{k}].outer"), *design.unloaded)
    if lacking:
        yield Verdict(missing=lacking)
    else:
        yield from _of_plies(design, k, layup, strengths)
    if layup.bond is not None and not design.unloaded and not design.missing(f"shafts[{k}].outer"):
        yield _of_bond(design, k, layup)


def _of_plies(design: Design, k: int, layup: Layup, strengths: tuple[str, ...]) -> Iterator[Verdict]:
    """Yield the exposure of the plies, and their shear along the fibres."""
    outer, ply = design.value(f"shafts[{k}].outer"), design.value(f"shafts[{k}].layup.ply_thickness")
    mean = outer - len(layup.angles) * np.asarray(ply)

    def used(case: Case) -> PlyExposure:
        return ply_exposure(layup, mean, ply, case.shaft_torque[..., k], case.end_bending[..., k])

    most, note = design.most(lambda case: used(case).exposure)
    shear, shear_note = design.most(lambda case: used(case).shear)
    safety = design.value("limits.safety")
    common = Verdict(
        design_variables=(f"shafts[{k}].layup.ply_thickness", f"shafts[{k}].outer", *design.torque_design_variables),
        rests=strengths,
    )
    yield replace(
        common,
        value=most * design.shock,
        limit=1.0 / safety,
        source=_("classical laminate theory, Tsai and Wu (1971), over safety; torque either way round"),
        note=note,
    )
    yield replace(
        common,
        title=_("shear along the fibres of the plies, shaft {number}"),
        value=shear * design.shock,
        limit=layup.ply.shear_strength / safety,
        dimension="stress",
        unit="MPa",
        source=_("classical laminate theory; shear strength of the ply over safety"),
        note=shear_note,
    )


def _of_bond(design: Design, k: int, layup: Layup) -> Verdict:
    """Return what is judged of the bond of the metal ends."""
    bond, path = layup.bond, f"shafts[{k}].layup.bond"
    assert bond is not None
    outer, ply = design.value(f"shafts[{k}].outer"), design.value(f"shafts[{k}].layup.ply_thickness")
    given = {name: design.value(f"{path}.{name}") for name in ("length", "thickness", "strength")}

    def stress(case: Case) -> Array:
        changed = replace(bond, length=given["length"], thickness=given["thickness"])
        return bond_shear(changed, layup, outer, ply, case.shaft_torque[..., k])

    value, note = design.most(stress)
    return Verdict(
        title=_("shear of the bond of the metal ends, shaft {number}"),
        value=value * design.shock,
        limit=given["strength"] / design.value("limits.safety"),
        dimension="stress",
        unit="MPa",
        source=_("lap of two tubes in torsion, Adams and Peppiatt (1977), over safety"),
        design_variables=(f"{path}.length", f"{path}.strength", *design.torque_design_variables),
        note=note,
    )


CHECK = Check(
    name="ply_strength",
    doc=mark("plies of composite tubes by laminate theory, and the bond of their metal ends"),
    shaft=_judge,
    title=mark("exposure of the plies of the composite tube, shaft {number}"),
    dimension="share",
    unit="percent",
    power=1.0,
    events=True,
)
