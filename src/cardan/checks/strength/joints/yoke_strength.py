"""Whether the yokes of every joint carry the load of the journals."""

from __future__ import annotations

from collections.abc import Iterator

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.formulas.part_strength import PartStress, yoke_stress
from cardan.texts import _, mark

from .journal_strength import journal_load

SIZES = ("bending_arm", "torsion_arm", "section")


def lacking(design: Design, i: int) -> tuple[str, ...]:
    """Return what the stress of the yokes of a joint lacks."""
    return design.missing(f"joints[{i}].cross.span", *(f"joints[{i}].yoke.{one}" for one in SIZES))


def stress(design: Design, i: int) -> tuple[PartStress, str]:
    """Return the stress of the yokes of a joint, counted from 0, and a sentence on what decides it."""
    yoke = f"joints[{i}].yoke"
    load, note = journal_load(design, i)
    found = yoke_stress(
        load,
        bending_arm=design.value(f"{yoke}.bending_arm"),
        torsion_arm=design.value(f"{yoke}.torsion_arm"),
        height=design.value(f"{yoke}.section.height"),
        width=design.value(f"{yoke}.section.width"),
        shape=design.value(f"{yoke}.section.shape"),
    )
    return found, note


def _judge(design: Design, i: int) -> Iterator[Verdict]:
    yoke = f"joints[{i}].yoke"
    strength = f"{yoke}.material.yield_strength"
    missing = (*lacking(design, i), *design.missing(strength), *design.unloaded)
    if missing:
        yield Verdict(missing=missing)
        return
    found, note = stress(design, i)
    sizes = (f"{yoke}.section.height", f"{yoke}.section.width", f"{yoke}.bending_arm", f"{yoke}.torsion_arm")
    yield Verdict(
        value=found.mises,
        limit=design.allowed(strength),
        source=_("Kozhevnikov & Perfil'ev (1978), eq. 263 with Saint-Venant's torsion; yield strength over safety"),
        design_variables=(*sizes, f"joints[{i}].cross.span", strength, *design.torque_design_variables),
        note=note,
    )


CHECK = Check(
    name="yoke_strength",
    doc=mark("stress of the yokes of every joint against yielding"),
    joint=_judge,
    title=mark("stress of the yokes of joint {number}"),
    dimension="stress",
    unit="MPa",
    power=1.0,
    crosses="each",
    events=True,
)
