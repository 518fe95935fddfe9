"""Whether every joint may bend as far as it does: by its maker, its type, its kind, or the user's own limit."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from cardan.catalogue import Catalogue
from cardan.catalogue.rows import UNSURE, JointType
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.load_case import largest
from cardan.checks.moving import largest_joint_angle
from cardan.checks.verdict import Verdict
from cardan.drive.joints import Joint
from cardan.texts import _, mark


def _judge(design: Design, i: int) -> Iterator[Verdict]:
    joint = design.drive.joints[i]
    row = design.known.rows(JointType).get(joint.type)
    path = f"joints[{i}].rating.max_joint_angle"
    own, rated = design.value("limits.joint_angle"), design.value(path)
    typed = row.max_joint_angle if row else None
    kind = of_kind(joint, design.known) if rated is None and typed is None else None
    given = [
        (own, _("limits of the drive file"), ""),
        (rated, _("rating of the joint"), ""),
        (typed, row.source if row else "", row.confidence if row else ""),
        kind or (None, "", ""),
    ]
    found = [one for one in given if one[0] is not None]
    if not found:
        yield Verdict(missing=(path,))
        return
    # What the user wants of all joints makes none of them able to do it.
    bound = kind is not None and kind[2] not in UNSURE
    limit, source, confidence = min(found, key=lambda one: float(np.max(np.asarray(one[0])))) if bound else found[0]
    joint_angles = [np.asarray(case.joint_angle)[..., i] for case in design.cases] or [design.joint_angle[..., i]]
    moved, when = largest_joint_angle(design, i)
    note = when if np.all(moved > largest(joint_angles)) else ""
    yield Verdict(
        value=largest([*joint_angles, moved]),
        limit=limit,
        source=source,
        confidence=confidence,
        design_variables=design.joint_angles_of(i),
        rests=(path,) if limit is rated else (),
        note=note,
    )


def of_kind(joint: Joint, known: Catalogue) -> tuple[float, str, str] | None:
    """Return the largest joint angle [rad] of a kind, where it comes from and how sure it is; None where it has none.

    A row of the catalogue with a type of the kind that reaches as far is the source.
    """
    if joint.steepest >= 0.5 * math.pi:
        return None
    rows = known.rows(JointType)
    for row in (rows[name] for name in joint.types if name in rows):
        if row.max_joint_angle is not None and math.isclose(row.max_joint_angle, joint.steepest):
            return joint.steepest, row.source, row.confidence
    return joint.steepest, _("what joints of this kind usually reach"), "recalled"


CHECK = Check(
    name="joint_angle",
    doc=mark("joint angle of every joint against what maker, type or user allow"),
    joint=_judge,
    title=mark("joint angle of joint {number}"),
    dimension="angle",
    unit="deg",
)
