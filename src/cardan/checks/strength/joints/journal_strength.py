"""Whether the journals of every cross carry their largest load."""

from __future__ import annotations

from collections.abc import Iterator

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.formulas.part_strength import PartStress, journal_stress
from cardan.maths.arrays import Array
from cardan.texts import _, mark

# The load that a cross puts on its journals, and through them on needles and yokes.


def journal_load(design: Design, i: int) -> tuple[Array, str]:
    """Return the largest load of the journals of a joint, shocks counted (...) [N], and what decides it in a sentence.

    design: under torque, and with the span of this joint's cross; i: joint, counted from 0.
    """
    couple, note = design.most(lambda case: case.couple[..., i])
    return couple * design.shock / design.value(f"joints[{i}].cross.span"), note


def lacking(design: Design, i: int) -> tuple[str, ...]:
    """Return what the stress of the journals of a joint lacks."""
    cross = f"joints[{i}].cross"
    arm = (
        () if len(design.missing(f"{cross}.bending_arm", f"{cross}.journal_length")) < 2 else (f"{cross}.bending_arm",)
    )
    return (*design.missing(f"{cross}.span", f"{cross}.journal"), *arm)


def stress(design: Design, i: int) -> tuple[PartStress, str]:
    """Return the stress of the journals of a joint, counted from 0, and a sentence on what decides it."""
    cross = f"joints[{i}].cross"
    arm = design.value(f"{cross}.bending_arm")
    load, note = journal_load(design, i)
    found = journal_stress(
        load,
        diameter=design.value(f"{cross}.journal"),
        arm=0.5 * design.value(f"{cross}.journal_length") if arm is None else arm,
        bore=design.value(f"{cross}.journal_bore"),
    )
    return found, note


def _judge(design: Design, i: int) -> Iterator[Verdict]:
    cross = f"joints[{i}].cross"
    strength, arm = f"{cross}.material.yield_strength", f"{cross}.bending_arm"
    missing = (*lacking(design, i), *design.missing(strength), *design.unloaded)
    if missing:
        yield Verdict(missing=missing)
        return
    found, note = stress(design, i)
    design_variable = f"{cross}.journal_length" if design.missing(arm) else arm
    yield Verdict(
        value=found.mises,
        limit=design.allowed(strength),
        source=_("Kozhevnikov & Perfil'ev (1978), eq. 264, 265 with the grease bore; yield strength over safety"),
        design_variables=(
            f"{cross}.journal",
            f"{cross}.span",
            design_variable,
            strength,
            *design.torque_design_variables,
        ),
        note=note,
    )


CHECK = Check(
    name="journal_strength",
    doc=mark("stress at the roots of the journals against yielding"),
    joint=_judge,
    title=mark("stress of the journals of joint {number}"),
    dimension="stress",
    unit="MPa",
    power=1.0,
    crosses="each",
    events=True,
)
