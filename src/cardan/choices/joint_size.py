"""The smallest row of the catalogue at which a joint's checks pass."""

from __future__ import annotations

import math
from dataclasses import replace

from cardan.catalogue import Catalogue, completed
from cardan.catalogue.rows import JointSize
from cardan.checks import Verdict, check
from cardan.drive.drive import Drive
from cardan.errors import refuse
from cardan.maths.ties import foremost_of
from cardan.texts import _

from .sized import CHECKS, Sizing, Tried, used


def smallest_row(drive: Drive, number: int, rows: Catalogue) -> Sizing:
    """Return the smallest row of the catalogue that passes, for one joint or for all alike."""
    if number:
        refuse_other(drive, number)
    chosen = [number - 1] if number else [i for i, joint in enumerate(drive.joints) if not joint.refusal("sizing")]
    if not chosen:
        raise refuse("part", _("no joint of the drive is a cross joint, and rows of the catalogue are of such"))
    subjects = [f"joints[{i}]" for i in chosen]
    sizes = sorted(rows.rows(JointSize).values(), key=_order)
    if not sizes:
        raise refuse("catalogue", _("holds no sizes of joints"), "empty")
    tried: list[Tried] = []
    best: tuple[Drive, tuple[Verdict, ...], JointSize] | None = None
    for row in sizes:
        whole = drive
        for i in chosen:
            whole = with_joint(whole, i, size=row.id, type="", cross=None, needles=None, yoke=None, rating=None)
        whole = completed(whole, rows)
        every = [one for one in check(whole, only=CHECKS["joint"], known=rows) if one.subject in subjects]
        judged = tuple(one for one in every if one.run and not one.advice)
        worst = foremost_of(judged, used) if judged else None
        passed = worst is not None and used(worst) <= 1.0
        tried.append(
            Tried(
                id=row.id,
                outer=math.nan if row.rating is None or row.rating.outer is None else row.rating.outer,
                mass=math.nan if row.mass is None else row.mass,
                utilisation=math.nan if worst is None else used(worst),
                passed=passed,
                worst=worst,
                missing=tuple(dict.fromkeys(path for one in every for path in one.missing)),
            )
        )
        if passed and best is None:
            best = whole, judged, row
    subject = subjects[0] if number else ""
    before = {f"{one}.size": drive.joints[i].size or None for one, i in zip(subjects, chosen, strict=True)}
    if best is None:
        return Sizing(
            part="joint",
            subject=subject,
            exact={},
            values={},
            before=before,
            limits=(),
            made=(),
            drive=drive,
            tried=tuple(tried),
        )
    whole, judged, row = best
    at = next(one for one in tried if one.id == row.id)
    return Sizing(
        part="joint",
        subject=subject,
        exact={},
        values={f"{one}.size": row.id for one in subjects},
        before=before,
        limits=judged,
        made=judged,
        drive=whole,
        tried=tuple(tried),
        skipped=at.missing,
    )


def refuse_other(drive: Drive, number: int) -> None:
    """Refuse a joint that is no cross joint: its parts are not sized."""
    joint = drive.joints[number - 1]
    if joint.refusal("sizing"):
        text = _("joint {number} is of kind {kind}; only cross joints are sized")
        raise refuse("part", text.format(number=number, kind=joint.kind), "out_of_range")


def _order(row: JointSize) -> tuple[float, ...]:
    """Return by what sizes are put in order: outer diameter, mass, rating."""
    rating = row.rating
    outer = math.inf if rating is None or rating.outer is None else rating.outer
    torque = math.inf if rating is None or rating.torque is None else rating.torque
    return outer, math.inf if row.mass is None else row.mass, torque


def with_joint(drive: Drive, i: int, **changes: object) -> Drive:
    """Return a drive with some fields of a joint, counted from 0, changed."""
    joints = list(drive.joints)
    joints[i] = replace(joints[i], **changes)  # type: ignore[arg-type]
    return replace(drive, joints=tuple(joints))
