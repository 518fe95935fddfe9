"""Whether the speeds in use keep away from torsional resonance, and whether the shafts bear what alternates there."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from cardan.answers.quantity import Quantity, say
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.load_case import Case
from cardan.checks.strength.section import Section, sections
from cardan.checks.strength.shaft_life import STRENGTHS, fatigue, fatigue_variables
from cardan.checks.verdict import Verdict
from cardan.drive.models.kinematics_model import given_chain
from cardan.formulas.shaft_strength import torsion_modulus
from cardan.maths.arrays import Array
from cardan.questions.torsion.model.torsion import Crossing
from cardan.texts import _, mark

from .line import as_drawn, lacking, modes, nearest_used, worst

APART = 0.1
"""Share by which a speed should differ from one at which an excitation meets a natural frequency."""

LEAST = 1e-9
"""Alternating torque that a shaft bears where it bears none [N·m]."""

STRONG = 0.2
"""Share of a torque from which the torque that its side band makes with the joints in resonance counts."""

STEEP = math.radians(35.0)
"""Joint angle from which order 4 is a twentieth of order 2: below, it shakes too little to count."""


def _judge(design: Design) -> Iterator[Verdict]:
    missing = lacking(design)
    if missing:
        yield Verdict(missing=missing)
        return
    if not design.at_an_instant:
        yield from _apart(design)
    for k in range(design.joints + 1):
        yield from _borne(design, k)


def _apart(design: Design) -> Iterator[Verdict]:
    """Yield how far the speeds in use are from the nearest meeting of an excitation with a natural frequency."""
    found = modes(design.drive, crossings=True)
    assert not isinstance(found, tuple)
    bent = bool(np.any(given_chain(design.drive).joint_angle > STEEP))
    met = [one for one in found.crossings if bent or one.order != 4.0 or "," in one.cause]
    met = [one for one in met if one.share is None or one.share >= STRONG]
    if not met:
        return
    used = [(one, nearest_used(design.drive, one.speed)) for one in met]

    def apart(pair: tuple[Crossing, float]) -> float:
        return abs(math.log(pair[1] / pair[0].speed))

    nearest, speed = min(used, key=apart)
    running = [np.asarray(case.speed, dtype=float) for case in design.cases if case.speed is not None]
    value = np.asarray(speed)
    if design.varied and design.duty.speed_range is None and running:
        (value,) = worst([-np.abs(np.log(one / nearest.speed)) for one in running], running)
    text = _("order {order} ({cause}) meets mode {mode} at that speed")
    order = Quantity(nearest.order, trim=True)
    yield Verdict(
        value=np.asarray(value)[()],
        limit=(nearest.speed * (1.0 - APART), nearest.speed * (1.0 + APART)),
        sense="outside",
        dimension="angular_speed",
        unit="rpm",
        source=_("API 617: 10 % between an excitation and a torsional natural frequency"),
        design_variables=design.speed_design_variables,
        note=as_drawn(design, say(text, order=order, cause=nearest.cause, mode=nearest.mode)),
        advice=True,
    )


def _borne(design: Design, k: int) -> Iterator[Verdict]:
    """Yield the alternating torque of a shaft beside that which it bears for ever."""
    shaking = [case for case in design.loaded if case.vibration is not None]
    found = list(sections(design, k))
    if not shaking or not found or design.drive.shafts[k].layup is not None:
        return
    strengths = [section.of_material(name) for section in found for name in STRENGTHS]
    title = _("alternating torque of shaft {number} in torsional vibration")
    if design.missing(*strengths):
        yield Verdict(title=title, subject=f"shafts[{k}]", missing=design.missing(*strengths))
        return
    swings = [0.5 * (case.torque_range[1] - case.torque_range[0])[..., k] for case in shaking]
    limits = [np.min([_bears(design, k, one, case) for one in found], axis=0) for case in shaking]
    used = [swing / np.maximum(limit, LEAST) for swing, limit in zip(swings, limits, strict=True)]
    swing, limit = worst(used, swings, limits)
    none = not np.any(limit)
    yield Verdict(
        title=title.format(number=k + 1),
        subject=f"shafts[{k}]",
        value=swing,
        limit=np.maximum(limit, LEAST),
        dimension="torque",
        unit="Nm",
        source=_("Goodman with Marin's factors beside mean torque and secondary couples, over the safety asked for"),
        design_variables=fatigue_variables(design, k),
        note=_("its mean torque, with the secondary couples, alone takes more than the safety allows") if none else "",
    )


def _bears(design: Design, k: int, section: Section, case: Case) -> Array:
    """Return the alternating torque that a stretch of a shaft bears for ever, array (...) [N·m]; 0 where none.

    Secondary couples grow with the largest torque, and so with what alternates.
    """
    shaft = design.drive.shafts[k]
    now = fatigue(design, k, section, case)
    least, most = (one[..., k] for one in case.torque_range)
    swing, mean = 0.5 * (most - least), 0.5 * np.abs(most + least)
    notch = 1.0 if shaft.notch is None else design.value(f"shafts[{k}].notch.torsion")
    twisted = math.sqrt(3.0) * np.asarray(notch) / torsion_modulus(*section.stressed)  # stress of a newton metre
    bent = np.sqrt(np.maximum(now.alternating**2 - (twisted * swing) ** 2, 0.0)) / np.maximum(mean + swing, LEAST)
    ultimate = design.value(section.of_material("ultimate_strength"))
    left = now.endurance * np.maximum(1.0 / design.value("limits.fatigue_safety") - now.mean / ultimate, 0.0)
    # (twisted s)² + (bent (mean + s))² = left², for s
    both, beside = twisted**2 + bent**2, bent**2 * mean
    found: Array = (np.sqrt(np.maximum(beside**2 + both * (left**2 - beside * mean), 0.0)) - beside) / both
    return np.maximum(found, 0.0)


CHECK = Check(
    name="torsional_resonance",
    doc=mark("speeds in use against torsional resonance, and alternating torque against what the shafts bear"),
    judge=_judge,
    moves=True,
    title=mark("clearance of the speeds in use from torsional resonance"),
)
