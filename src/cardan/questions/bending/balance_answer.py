"""What there is to say of balance: what unbalance each shaft may have, and the masses that cancel what it has."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from cardan.answers.answer import Answer, Cell, Column, Remark, Table, Tone
from cardan.answers.quantity import Quantity, Text, Written, listed, say
from cardan.answers.question import Lacking, absent
from cardan.answers.sweepable import OutputColumn, SweepQuestion
from cardan.drive.body import body_length, weight
from cardan.drive.conditions import load_cases
from cardan.drive.drive import Drive
from cardan.drive.fields.parts import known_lengths
from cardan.drive.fields.wording import written
from cardan.drive.yokes import with_yokes
from cardan.errors import refuse
from cardan.maths.ties import foremost_of
from cardan.questions.assumed import yokes_estimated
from cardan.texts import _, mark

from .balance import SLOW, Balance
from .balance import balance as ask

__all__ = ["COLUMNS", "answer", "ask", "lacking"]


def lacking(drive: Drive) -> Lacking:
    """Return what the drive file lacks for the balance of its shafts: a highest speed, bodies or masses."""
    duty = drive.duty
    judged = [s for k, s in enumerate(drive.shafts) if 0 < k < len(drive.joints) or s.unbalance]
    speeds = (duty.speed, duty.speed_range, *(case.speed for case in load_cases(duty)))
    bodies = any(shaft.has_body or shaft.mass is not None or shaft.unbalance for shaft in judged)
    return absent((any(speeds), "duty.speed_range", "duty.speed"), (bodies, "shafts[1].outer", "shafts[1].mass"))


def answer(drive: Drive, result: Balance) -> Answer:
    """Return what there is to say of the balance of the shafts of a drive."""
    tone: Tone = "plain" if result.balanced is None else "good" if result.balanced else "failed"
    return Answer(
        name="balance",
        title=_("Balance"),
        sentence=_sentence(result),
        tone=tone,
        tables=(_shafts(drive, result), *_planes(result), *_corrections(result)),
        remarks=(*yokes_estimated(drive), *_remarks(result)),
        facts=_facts(result),
        full=lambda: _shafts(drive, result, name=""),
        code=1 if result.balanced is False else 0,
    )


def _sentence(result: Balance) -> Text:
    speed = Quantity(result.speed, "angular_speed")
    if result.balanced is not None:
        bad = [one for one in result.shafts if one.balanced is False and one.worst is not None]
        if bad:
            most = foremost_of(bad, lambda one: one.worst.utilisation if one.worst else 0.0)
            text = _("too much unbalance on shaft {which} at {speed}: {amount} in a plane that may have {limit}.")
            amount, limit = (Quantity(getattr(most.worst, key), "unbalance", 3) for key in ("unbalance", "allowed"))
            return say(text, which=listed([one.number for one in bad]), speed=speed, amount=amount, limit=limit)
        return say(_("balanced well enough for {speed}."), speed=speed)
    limits = [one for one in result.shafts if not math.isnan(one.limit)]
    if not limits:
        return _("no limit could be told; masses are missing.")
    least = foremost_of(limits, lambda one: one.limit, least=True)
    text = _("at {speed} shaft {number} may have {limit} at most.")
    return say(text, speed=speed, number=least.number, limit=Quantity(least.limit, "unbalance", 3))


def _shafts(drive: Drive, result: Balance, name: str = "") -> Table:
    names = {shaft.number: shaft.name for shaft in drive.shafts}
    states = {
        True: Cell(value=_("balanced"), tone="good"),
        False: Cell(value=_("too much"), tone="failed"),
        None: Cell(value=""),
    }
    shafts = result.shafts

    def column(key: str, heading: str, field: str, dimension: str) -> Column:
        return Column(key=key, heading=heading, values=[getattr(one, field) for one in shafts], dimension=dimension)

    return Table(
        name=name,
        columns=(
            Column(
                key="shaft",
                heading=_("shaft"),
                values=[f"{one.number} {names.get(one.number, '')}".strip() for one in shafts],
            ),
            column("mass", _("mass"), "mass", "mass"),
            column("allowed", _("allowed"), "allowed", "unbalance"),
            column("plane", _("allowed per plane"), "allowed_plane", "unbalance"),
            column("standard", _("vehicle standard"), "norm", "unbalance"),
            column("unbalance", _("static part"), "unbalance", "unbalance"),
            column("couple", _("couple part"), "couple", "inertia"),
            column("force", _("rotating force"), "force", "force"),
            Column(key="state", heading="", values=[states[one.balanced] for one in shafts]),
        ),
    )


def _planes(result: Balance) -> Iterator[Table]:
    """Yield what was measured in the tolerance planes, beside what may be there."""
    rows = [(one.number, plane) for one in result.shafts for plane in one.planes if one.corrections]
    if rows:
        planes = [plane for _number, plane in rows]

        def column(key: str, heading: str, field: str, dimension: str, **more: Any) -> Column:
            return Column(
                key=key, heading=heading, values=[getattr(one, field) for one in planes], dimension=dimension, **more
            )

        yield Table(
            title=_("Tolerance planes"),
            columns=(
                Column(key="shaft", heading=_("shaft"), values=[number for number, _plane in rows]),
                column("position", _("position"), "position", "length"),
                column("unbalance", _("measured"), "unbalance", "unbalance"),
                column("allowed", _("allowed"), "allowed", "unbalance"),
                column("utilisation", _("utilisation"), "utilisation", "share", digits=3),
            ),
            note=_("Measured unbalances are resolved into the planes at both ends; each plane is judged by itself."),
        )


def _corrections(result: Balance) -> Iterator[Table]:
    rows = [
        (one.number, fix, force)
        for one in result.shafts
        for fix, force in zip(one.corrections, one.joint_forces, strict=True)
    ]
    if rows:
        fixes = [fix for _number, fix, _force in rows]
        yield Table(
            title=_("Correction masses at the ends of the tubes"),
            columns=(
                Column(key="shaft", heading=_("shaft"), values=[number for number, *_rest in rows]),
                Column(
                    key="position", heading=_("position"), values=[fix.position for fix in fixes], dimension="length"
                ),
                Column(
                    key="angle", heading=_("angle"), values=[fix.angle for fix in fixes], dimension="angle", decimals=1
                ),
                Column(
                    key="unbalance",
                    heading=_("unbalance"),
                    values=[fix.unbalance for fix in fixes],
                    dimension="unbalance",
                ),
                Column(
                    key="mass",
                    heading=_("mass"),
                    values=[fix.mass for fix in fixes],
                    dimension="mass",
                    unit="g",
                    digits=3,
                ),
                Column(
                    key="force", heading=_("force on the joint"), values=[f for *_rest, f in rows], dimension="force"
                ),
            ),
        )


def _remarks(result: Balance) -> Iterator[Remark]:
    if result.grade is not None:
        yield Remark(text=_("Grade {grade}: {source}.").format(grade=result.grade.id, source=result.grade.source))
    if result.assumed:
        text = _("No balance grade is given{key}; {grade} is usual for these shafts.")
        grade = result.grade.id if result.grade else ""
        yield Remark(text=say(text, grade=grade, key=Written(" (duty.balance_grade)", "")))
    if result.norm is not None:
        text = _("Vehicle standard: {note}; {source}.")
        yield Remark(text=text.format(note=result.norm.note or result.norm.id, source=result.norm.source))
    if not result.needed:
        least = Quantity(SLOW, "angular_speed", trim=True)
        yield Remark(text=say(_("Below {speed} makers do not balance."), speed=least))
    missing = [path for one in result.shafts for path in one.missing]
    if missing:
        text = _("Warning: some limits could not be told; the file lacks {keys}, or a body.")
        yield Remark(text=say(text, keys=written(*missing)), tone="warning")
    if not any(one.corrections for one in result.shafts):
        text = _("Measured unbalances go into the file{key}: place, amount and angle.")
        yield Remark(text=say(text, key=Written(" as shafts[…].unbalance", "")), aside=True)
    yield Remark(text=_("Unbalance from clearances cannot be balanced out: mark parts before they come apart."))


def _facts(result: Balance) -> dict[str, Any]:
    return {
        "speed": Quantity(result.speed, "angular_speed"),
        "grade": None if result.grade is None else result.grade.id,
        "grade_assumed": result.assumed,
        "standard": None if result.norm is None else result.norm.id,
        "balanced": result.balanced,
        "shafts": [
            {
                "number": one.number,
                "mass": Quantity(one.mass, "mass"),
                "allowed": Quantity(one.allowed, "unbalance"),
                "allowed_plane": Quantity(one.allowed_plane, "unbalance"),
                "eccentricity": Quantity(one.eccentricity, "length"),
                "standard": Quantity(one.norm, "unbalance"),
                "unbalance": Quantity(one.unbalance, "unbalance"),
                "couple": Quantity(one.couple, "inertia"),
                "planes": [
                    {
                        "position": Quantity(plane.position, "length"),
                        "allowed": Quantity(plane.allowed, "unbalance"),
                        "unbalance": Quantity(plane.unbalance, "unbalance"),
                        "utilisation": plane.utilisation,
                    }
                    for plane in one.planes
                ],
                "force": Quantity(one.force, "force"),
                "joint_forces": Quantity(list(one.joint_forces), "force"),
                "balanced": one.balanced,
                "corrections": [
                    {
                        "position": Quantity(fix.position, "length"),
                        "unbalance": Quantity(fix.unbalance, "unbalance"),
                        "angle": Quantity(fix.angle, "angle"),
                        "mass": Quantity(fix.mass, "mass", unit="g"),
                    }
                    for fix in one.corrections
                ],
                "missing": one.missing,
            }
            for one in result.shafts
        ],
    }


def _mass(drive: Drive) -> tuple[float]:
    lengths, inside = known_lengths(drive), with_yokes(drive).shafts[1:-1]
    found = [weight(shaft, body_length(shaft, lengths.get(shaft.number))).mass for shaft in inside]
    lack = [shaft.number - 1 for shaft, mass in zip(inside, found, strict=True) if not mass]
    if lack:
        raise refuse(f"shafts[{lack[0]}].outer", _("missing; the mass of the shaft needs it, or its mass itself"))
    return (float(sum(mass for mass in found if mass)),)


def _column_values(found: Balance) -> tuple[float, float, float]:
    limits = [one.limit for one in found.shafts if not math.isnan(one.limit)]
    loads = [one.force for one in found.shafts if not math.isnan(one.force)]
    used = [one.worst.utilisation for one in found.shafts if one.worst is not None]
    return (min(limits, default=math.nan), max(loads, default=math.nan), max(used, default=math.nan))


COLUMNS = (
    SweepQuestion(
        name="mass",
        doc=mark("mass of the shafts between the joints"),
        told=(OutputColumn.of("mass_kg", mark("mass of the shafts")),),
        of_one=_mass,
    ),
    SweepQuestion(
        name="balance",
        doc=mark("permissible unbalance at the highest speed, the rotating force of unbalance, and the share used"),
        told=(
            OutputColumn.of("permissible_unbalance_g_mm", mark("least permissible unbalance of a shaft")),
            OutputColumn.of(
                "unbalance_force_N",
                mark("largest rotating force of unbalance, of the permissible one where none was measured"),
            ),
            OutputColumn.of(
                "unbalance_used_percent",
                mark("largest measured unbalance of a tolerance plane over the permissible one"),
            ),
        ),
        of_result=_column_values,
    ),
)
"""What a sweep may ask of balance."""
