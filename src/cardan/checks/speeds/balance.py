"""Whether every shaft is balanced as well as a grade or a norm asks."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from cardan.answers.quantity import Quantity, Text, say
from cardan.catalogue.rows import BalanceGrade, BalanceNorm
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.strength.section import modulus, sections
from cardan.checks.verdict import Verdict, joined
from cardan.drive.body import body_length, weight
from cardan.drive.fields.parts import known_lengths
from cardan.drive.yokes import with_yokes
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost
from cardan.questions.bending.balance import SLOW, USUAL, allowed_unbalance, in_planes, plane_shares, tolerance_planes
from cardan.texts import _, mark


def _judge(design: Design, k: int) -> Iterator[Verdict]:
    grade, norm = design.duty.balance_grade, design.duty.balance_class
    shaft = design.drive.shafts[k]
    if not shaft.unbalance and (not (grade or norm) or not 0 < k < design.joints):
        return
    assumed = not grade and not norm
    grade = USUAL if assumed else grade
    lacking = [] if shaft.unbalance else [f"shafts[{k}].unbalance"]
    if shaft.unbalance and _length(design, k) is None:
        lacking.append(f"shafts[{k}].length")
    mass = _mass(design, k)
    if grade:
        lacking += design.unmoved
        lacking += [] if mass is not None else [f"shafts[{k}].mass"]
    if lacking:
        yield Verdict(missing=tuple(lacking))
        return
    amounts, shares, planes = _planes(design, k)
    worst = foremost(amounts / shares)
    value, share = (
        np.take_along_axis(one + 0.0 * amounts, worst[..., None], axis=-1)[..., 0] for one in (amounts, shares)
    )
    design_variables = tuple(f"shafts[{k}].unbalance[{j}].amount" for j in range(len(shaft.unbalance)))
    slow = design.top_speed is not None and bool(np.all(np.asarray(design.top_speed) < SLOW))
    note: Text = _("below 500 rpm makers do not balance") if slow else ""
    if not note and amounts.ndim == 1:
        note = say(_("in the plane at {place}"), place=Quantity(float(planes[int(worst)]), "length", 3))
    if assumed:
        note = joined(note, say(_("no balance grade is given, {grade} is usual"), grade=grade))
    if grade:
        row = design.known.row(BalanceGrade, grade, field="duty.balance_grade")
        top = np.maximum(np.asarray(design.top_speed, dtype=float), 1e-9)
        yield Verdict(
            value=value,
            limit=allowed_unbalance(mass, top, row.speed).whole * share,
            source=_("ISO 21940-11, grade {grade}: {row}").format(grade=grade, row=row.source),
            confidence=row.confidence,
            design_variables=(*design_variables, *design.speed_design_variables),
            note=note,
            advice=slow,
        )
    if norm:
        limit = design.known.row(BalanceNorm, norm, field="duty.balance_class")
        yield Verdict(
            title=_("unbalance of shaft {number}, permissible by Kozhevnikov and Perfil'ev (1978)"),
            value=value,
            limit=limit.max_unbalance * share,
            source=f"{limit.source}, {limit.note}",
            confidence=limit.confidence,
            design_variables=design_variables,
            note="" if slow else note,
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


def _length(design: Design, k: int) -> float | None:
    """Return the length of the body of a shaft as drawn [m]; None where the drive does not say it."""
    return body_length(design.drive.shafts[k], known_lengths(design.drive).get(k + 1))


def _planes(design: Design, k: int) -> tuple[Array, Array, tuple[Any, Any]]:
    """Return the unbalance in both tolerance planes (..., 2) [kg m], their shares of the limit, and the planes [m]."""
    shaft, path = with_yokes(design.drive).shafts[k], f"shafts[{k}].unbalance"
    drawn, length = _length(design, k), design.length(k)
    length = drawn if length is None or not 0 < k < design.joints else length
    rows = range(len(shaft.unbalance))

    def column(key: str) -> Array:
        return np.stack(
            np.broadcast_arrays(*(np.asarray(design.value(f"{path}[{j}].{key}"), dtype=float) for j in rows)), -1
        )

    centre = design.value(f"shafts[{k}].centre_of_mass") if f"shafts[{k}].centre_of_mass" in design.varied else None
    if centre is None:
        centre = weight(shaft, drawn).centre
        # A body keeps the place of its centre of mass over its length.
        centre = centre if centre is None or not drawn else centre * np.asarray(length) / drawn
    ends = tolerance_planes(k + 1, length)
    assert ends is not None
    there = in_planes(ends, column("position"), column("amount") * np.exp(1j * column("angle")))
    return np.abs(there), plane_shares(ends, centre), ends


CHECK = Check(
    name="balance",
    doc=mark("unbalance of every shaft against its balance grade or the permissible value of its vehicle"),
    shaft=_judge,
    title=mark("unbalance of shaft {number}"),
    dimension="unbalance",
    unit="g_mm",
)
