"""Whether every shaft carries its torque together with the secondary couples of the joints at its ends."""

from __future__ import annotations

from collections.abc import Iterator

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.formulas.shaft_strength import torsion_modulus
from cardan.texts import _, mark

from .section import Section, sections


def _judge(design: Design, k: int) -> Iterator[Verdict]:
    if design.drive.shafts[k].layup is not None:
        return
    found = list(sections(design, k))
    yield from (_of_section(design, k, section) for section in found)
    if not found and 0 < k < design.joints:
        allowed = design.missing(f"shafts[{k}].material.yield_strength")
        allowed = () if design.value("limits.shear_stress") is not None else allowed
        yield Verdict(missing=(f"shafts[{k}].outer", *allowed, *design.unloaded))


def _of_section(design: Design, k: int, section: Section) -> Verdict:
    title = _("stress of shaft {number}") + section.words
    own = design.value("limits.shear_stress")
    strength = section.of_material("yield_strength")
    lacking = design.unloaded if own is not None else (*design.missing(strength), *design.unloaded)
    if lacking:
        return Verdict(title=title, missing=lacking)
    resisting = torsion_modulus(*section.stressed)
    if own is not None:
        moment, note = design.most(lambda case: case.end_moment[..., k])
        return Verdict(
            title=title,
            value=moment * design.shock / resisting,
            limit=own,
            source=_("Kozhevnikov & Perfil'ev (1978), eq. 261, largest shear stress; limits of the drive file"),
            design_variables=(*section.design_variables, *design.torque_design_variables),
            note=note,
        )
    moment, note = design.most(lambda case: case.mises_moment[..., k])
    return Verdict(
        title=title,
        value=moment * design.shock / resisting,
        limit=design.allowed(strength),
        source=_("torsion with the secondary couples, von Mises; yield strength over safety"),
        design_variables=(*section.design_variables, strength, *design.torque_design_variables),
        note=note,
    )


CHECK = Check(
    name="tube_strength",
    doc=mark("torsion and secondary couples of every shaft against yielding or a limit"),
    shaft=_judge,
    title=mark("stress of shaft {number}"),
    dimension="stress",
    unit="MPa",
    power=1.0,
    events=True,
)
