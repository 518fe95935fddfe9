"""Whether every shaft carries its torque together with the secondary couples of the joints at its ends."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.formulas.shaft_strength import torsion_modulus
from cardan.texts import _, mark

from .section import Section, number_of, sections


def _judge(design: Design) -> Iterator[Verdict]:
    for k, shaft in enumerate(design.drive.shafts):
        found = list(sections(design, k))
        between = 0 < k < design.joints
        if shaft.layup is not None or not (found or between):
            continue
        for section in found:
            yield _of_section(design, k, section)
        if not found:
            allowed = design.missing(f"shafts[{k}].material.yield_strength")
            allowed = () if design.value("limits.shear_stress") is not None else allowed
            yield _made(k)(missing=(f"shafts[{k}].outer", *allowed, *design.unloaded))


def _made(k: int, part: str = "") -> partial[Verdict]:
    return partial(
        Verdict,
        check="tube_strength",
        subject=f"shafts[{k}]",
        title=_("stress of shaft {number}").format(number=k + 1) + part,
        dimension="stress",
        unit="MPa",
    )


def _of_section(design: Design, k: int, section: Section) -> Verdict:
    made = _made(
        k, _(", stretch {number}").format(number=number_of(section.path)) if "segments" in section.path else ""
    )
    own = design.value("limits.shear_stress")
    strength = section.of_material("yield_strength")
    lacking = design.unloaded if own is not None else (*design.missing(strength), *design.unloaded)
    if lacking:
        return made(missing=lacking)
    resisting = torsion_modulus(section.outer, section.inner)
    if own is not None:
        moment, note = design.most(lambda case: case.end_moment[..., k])
        return made(
            value=moment * design.shock / resisting,
            limit=own,
            source=_("Book (261), largest shear stress; limits of the drive file"),
            levers=(*section.levers, *design.torque_levers),
            note=note,
        )
    moment, note = design.most(lambda case: case.mises_moment[..., k])
    return made(
        value=moment * design.shock / resisting,
        limit=design.allowed(strength),
        source=_("torsion with the secondary couples, von Mises; yield strength over safety"),
        levers=(*section.levers, strength, *design.torque_levers),
        note=note,
    )


CHECK = Check(
    name="tube_strength",
    doc=mark("torsion and secondary couples of every shaft against yielding or a limit"),
    judge=_judge,
)
