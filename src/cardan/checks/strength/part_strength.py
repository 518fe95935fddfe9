"""What every joint and every shaft of a drive goes through: torque, couples, stresses, fatigue."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from cardan.checks.design import Design
from cardan.formulas.joint_rating import Contact
from cardan.formulas.part_strength import PartStress, SplineStress
from cardan.formulas.shaft_strength import Fatigue, ShaftStress, shaft_stress, torsion_modulus
from cardan.maths.ties import foremost_of

from .joints import contact_pressure, journal_strength, yoke_strength
from .joints.journal_strength import journal_load
from .joints.needle_static import static_capacity
from .section import modulus, sections
from .shaft_life import STRENGTHS, fatigue, fatigue_life, fatigue_used, hardest_cycle, lasting, life_safety, measured
from .spline_pressure import lacking, stresses
from .tube_buckling import composite_buckling
from .twist import compliance


@dataclass(frozen=True, eq=False, kw_only=True)
class ShaftStrength:
    """What a shaft goes through; None where the drive does not say enough."""

    number: int  # 1 is the input shaft
    # torque, bending [N·m]: largest torque and largest secondary couple over all ways of running, shocks counted
    torque: float
    bending: float  # [N·m]
    # [N·m]: largest bending moment of its own weight between its joints; not part of the stresses. nan if not known.
    weight_bending: float = math.nan
    stress: ShaftStress | None = None  # of the stretch that is worst off
    stretch: int = 1  # which stretch that is, from 1
    # of the stretch and the way of running, or the cycle of a measured torque, with the least safety
    fatigue: Fatigue | None = None
    safety: float = math.nan  # against fatigue, in the life asked for under a measured torque; nan where not known
    # [s]: running time until the shaft breaks by Palmgren's and Miner's rule; infinite where it does not, nan where not
    # known
    fatigue_life: float = math.nan
    # share of its fatigue life that starts, events and running use in the life asked for; nan where there are no
    # starts and events, or it is not known
    fatigue_used: float = math.nan
    twist: float = math.nan  # [rad]: under its largest torque, without shocks; nan where not known
    spline: SplineStress | None = None
    buckling_torque: float = math.nan  # [N·m]: of a tube of composite; else nan
    # case, fatigue_case: load cases in which its torque is largest, and its safety against fatigue least; empty if one
    case: str = ""
    fatigue_case: str = ""


def shaft_strength(design: Design, k: int) -> ShaftStrength:
    """Return what a shaft of one drive under torque goes through, counted from 0."""
    shock, shaft = float(design.shock), design.drive.shafts[k]
    torque, shocked = (
        float(design.most(lambda case: case.shaft_torque[..., k], shocks=one)[0]) for one in (False, True)
    )
    soft, buckles = compliance(design, k)[0], composite_buckling(design, k)
    found = list(sections(design, k))
    plain = ShaftStrength(
        number=k + 1,
        torque=shock * shocked,
        bending=shock * float(design.most(lambda case: case.end_bending[..., k])[0]),
        weight_bending=weight_bending(design, k),
        twist=math.nan if soft is None else float(soft) * torque,
        spline=None if shaft.spline is None or lacking(design, k) else stresses(design, k)[0],
        buckling_torque=math.nan if buckles is None else float(buckles),
        case=design.case_of(lambda case: case.shaft_torque[..., k]),
    )
    if not found or shaft.layup is not None:
        return plain
    worst = foremost_of(range(len(found)), lambda s: 1.0 / float(torsion_modulus(*found[s].stressed)))
    case = foremost_of(design.loaded, lambda one: one.severity * float(one.mises_moment[k]))
    size = shock * case.severity
    moments = size * float(case.shaft_torque[k]), size * float(case.end_bending[k])
    stress = shaft_stress(*moments, *found[worst].stressed)
    plain = replace(plain, stress=stress, stretch=worst + 1)
    if design.missing(*(one.of_material(name) for one in found for name in STRENGTHS)):
        return plain
    every = [(fatigue(design, k, one, c), c) for one in found for c in design.loaded]
    tired, at = foremost_of(every, lambda one: float(one[0].safety), least=True)
    moving = any(one.speed for one in lasting(design)) or design.duty.torque_history is not None
    safety = float(tired.safety)
    if measured(design):
        cycled, safety = hardest_cycle(design, k), min(safety, float(life_safety(design, k)))
        tired = cycled if float(cycled.safety) < float(tired.safety) else tired
    life = float(fatigue_life(design, k)) if moving else math.nan
    used = fatigue_used(design, k) if design.events else None
    return replace(
        plain,
        fatigue=tired,
        fatigue_case=design.called(at),
        safety=safety,
        fatigue_life=life,
        fatigue_used=math.nan if used is None else float(used),
    )


def weight_bending(design: Design, k: int) -> float:
    """Return the largest bending moment of a shaft's weight between its joints, counted from 0 [N·m].

    design: one drive; k: shaft, counted from 0.
    A beam on two hinges, g across its full length: weights of its stretches and of the parts it carries; nan for the
    end shafts, and where body or length is not given.
    """
    found, length = list(sections(design, k)), design.length(k)
    if not 0 < k < design.joints or not found or length is None:
        return math.nan
    length = float(length)
    lengths = [float(one.length or 0.0) for one in found]
    fit, gravity = length / (sum(lengths) or length), math.hypot(*design.drive.settings.gravity)
    edges = fit * np.concatenate(([0.0], np.cumsum(lengths)))
    at = np.linspace(0.0, length, 401)
    moment = np.zeros(at.size)
    for one, start, end in zip(found, edges[:-1], edges[1:], strict=True):
        area = 0.25 * math.pi * (one.outer**2 - one.inner**2)
        load = gravity * modulus(design, one, "density") * area
        force, middle = load * (end - start), 0.5 * (start + end)
        beside = np.clip(at - start, 0.0, end - start)
        moment += force * (1.0 - middle / length) * at - load * beside * (at - start - 0.5 * beside)
    for lump in design.drive.shafts[k].masses:
        force = gravity * lump.mass
        moment += force * (1.0 - lump.position / length) * at - force * np.clip(at - lump.position, 0.0, None)
    return float(np.max(np.abs(moment)))


# What every joint of a drive goes through: torque, couple of its cross, stresses of journals, yokes and needles.


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
    case: str = ""  # load case in which its torque is largest; empty where there is one only


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
        case=design.case_of(lambda case: case.joint_torque[..., i]),
    )
