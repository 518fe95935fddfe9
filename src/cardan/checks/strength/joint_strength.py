"""What every joint of a drive goes through: torque, couple of its cross, stresses of journals, yokes and needles."""

from __future__ import annotations

import math
from dataclasses import dataclass

from cardan.checks.design import Design
from cardan.formulas.joint_strength import PartStress
from cardan.formulas.needle_bearing import Contact

from . import contact_pressure, journal_strength, yoke_strength
from .journal_load import journal_load
from .needle_static import static_capacity


@dataclass(frozen=True, eq=False, kw_only=True)
class JointStrength:
    """What a joint goes through over all ways of running, shocks counted; nan or None where it cannot be told."""

    number: int  # from 1
    torque: float  # [N·m]: largest torque on either side
    couple: float  # [N·m]: largest couple of the cross
    journal_force: float = math.nan  # [N]: largest load of a journal, couple over span
    journal: PartStress | None = None
    yoke: PartStress | None = None
    contact: Contact | None = None  # of the most loaded needle
    static_capacity: float = math.nan  # [N]: as given, or by ISO 76


def joint_strength(design: Design, i: int) -> JointStrength:
    """Return what a joint of one drive under torque goes through, counted from 0."""
    beside, couple = (
        float(design.most(ask)[0] * design.shock)
        for ask in (lambda case: case.joint_torque[..., i], lambda case: case.couple[..., i])
    )
    capacity, spanned = static_capacity(design, i), not design.missing(f"joints[{i}].cross.span")
    return JointStrength(
        number=i + 1,
        torque=beside,
        couple=couple,
        journal_force=float(journal_load(design, i)[0]) if spanned else math.nan,
        journal=None if journal_strength.lacking(design, i) else journal_strength.stress(design, i)[0],
        yoke=None if yoke_strength.lacking(design, i) else yoke_strength.stress(design, i)[0],
        contact=None if contact_pressure.lacking(design, i) else contact_pressure.contact(design, i)[0],
        static_capacity=math.nan if capacity is None else float(capacity),
    )
