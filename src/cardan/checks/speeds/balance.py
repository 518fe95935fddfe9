"""Whether every shaft is balanced as well as a grade or a norm asks."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.catalogue.rows import BalanceGrade, BalanceNorm
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.strength.section import modulus, sections
from cardan.checks.verdict import Verdict
from cardan.drive.yokes import with_yokes
from cardan.maths.arrays import Array
from cardan.questions.bending.balance import SLOW, allowed_unbalance
from cardan.texts import _, mark


def _judge(design: Design, k: int) -> Iterator[Verdict]:
    grade, norm = design.duty.balance_grade, design.duty.balance_class
    shaft = design.drive.shafts[k]
    if not shaft.unbalance and (not (grade or norm) or not 0 < k < design.joints):
        return
    lacking = [] if shaft.unbalance else [f"shafts[{k}].unbalance"]
    if not grade and not norm:
        lacking.append("duty.balance_grade")
    mass = _mass(design, k)
    if grade:
        lacking += design.unmoved
        lacking += [] if mass is not None else [f"shafts[{k}].mass"]
    if lacking:
        yield Verdict(missing=tuple(lacking))
        return
    amount = _amount(design, k)
    design_variables = tuple(f"shafts[{k}].unbalance[{j}].amount" for j in range(len(shaft.unbalance)))
    slow = design.top_speed is not None and bool(np.all(np.asarray(design.top_speed) < SLOW))
    if grade:
        row = design.known.row(BalanceGrade, grade, field="duty.balance_grade")
        top = np.maximum(np.asarray(design.top_speed, dtype=float), 1e-9)
        yield Verdict(
            value=amount,
            limit=allowed_unbalance(mass, top, row.speed).whole,
            source=_("ISO 21940-11, grade {grade}: {row}").format(grade=grade, row=row.source),
            confidence=row.confidence,
            design_variables=(*design_variables, *design.speed_design_variables),
            note=_("below 500 rpm makers do not balance") if slow else "",
            advice=slow,
        )
    if norm:
        limit = design.known.row(BalanceNorm, norm, field="duty.balance_class")
        yield Verdict(
            title=_("unbalance of shaft {number}, permissible by Kozhevnikov and Perfil'ev (1978)"),
            value=amount,
            limit=limit.max_unbalance,
            source=f"{limit.source}, {limit.note}",
            confidence=limit.confidence,
            design_variables=design_variables,
        )


def _mass(design: Design, k: int) -> Array | None:
    """Return the mass of a shaft with the parts it carries [kg]; None where the drive does not say it."""
    given = design.value(f"shafts[{k}].mass")
    if given is None:
        body = list(sections(design, k))
        if not body or any(one.length is None for one in body):
            return None
        given = sum(
            0.25 * np.pi * np.asarray(modulus(design, one, "density")) * (one.outer**2 - one.inner**2) * one.length
            for one in body
        )
    mass: Array = np.asarray(given) + sum(lump.mass for lump in with_yokes(design.drive).shafts[k].masses)
    return mass if np.all(mass > 0.0) else None


def _amount(design: Design, k: int) -> Array:
    """Return the unbalance that counts: the resultant, or twice that of the worst plane where there are several."""
    planes = design.drive.shafts[k].unbalance
    path = f"shafts[{k}].unbalance"
    amounts = [np.asarray(design.value(f"{path}[{j}].amount"), dtype=float) for j in range(len(planes))]
    angles = [np.asarray(design.value(f"{path}[{j}].angle"), dtype=float) for j in range(len(planes))]
    whole: Array = np.hypot(
        sum(u * np.cos(a) for u, a in zip(amounts, angles, strict=True)),
        sum(u * np.sin(a) for u, a in zip(amounts, angles, strict=True)),
    )
    for one in amounts if len(amounts) > 1 else ():
        whole = np.maximum(whole, 2.0 * one)
    return whole


CHECK = Check(
    name="balance",
    doc=mark("unbalance of every shaft against its balance grade or the permissible value of its vehicle"),
    shaft=_judge,
    title=mark("unbalance of shaft {number}"),
    dimension="unbalance",
    unit="g_mm",
)
