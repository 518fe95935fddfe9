"""Whether joints make the output and the shafts between swing no harder than the norm of joint angles allows."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.catalogue.rows import AngleNorm
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.load_case import Case
from cardan.checks.verdict import Verdict, as_drawn, at_top_speed, joined
from cardan.drive.models.kinematics_model import Chain
from cardan.drive.torsional_layout import has_torsion
from cardan.maths.arrays import Array, namespace
from cardan.maths.kernel import mobius
from cardan.questions.motion.equivalence import after_each_joint, largest_acceleration
from cardan.questions.motion.turning import Swing
from cardan.texts import _, mark


def _judge(design: Design) -> Iterator[Verdict]:
    rows, asked = design.known.rows(AngleNorm), design.drive.settings.norm
    usual = (row for row in rows.values() if row.application == design.duty.application)
    norm = design.known.row(AngleNorm, asked, field="settings.norm") if asked else next(usual, None)
    speed = design.top_speed
    output = f"shafts[{design.joints}]"
    if norm is None:
        why = _("the catalogue has no such limits for the application {name}; the settings can name a row")
        unfit = why.format(name=design.duty.application)
        yield Verdict(subject=output, title=_("torsional acceleration of the output"), unfit=unfit)
        return
    said = [(_("torsional acceleration of the output"), output, norm.torsional)]
    if design.joints > 1:
        said.append((_("inertia excitation, drive"), "", norm.inertia_drive))
        said.append((_("inertia excitation, coast"), "", norm.inertia_coast))
    drawn_swings = None if speed is None else swings_of_laws(design.swing) if design.swing else swings(design.chain)
    moved = None if speed is None else design.while_moving(swings)
    rigid = _("of rigid shafts: torsional vibration is not in it")
    for k, (title, subject, limit) in enumerate(said):
        if speed is None or drawn_swings is None:
            yield Verdict(subject=subject, title=title, missing=("duty.speed",))
            continue
        drawn = drawn_swings[..., k]
        most = drawn if moved is None else moved.most[..., k]
        when = as_drawn(design) if moved is None or not np.all(most > drawn) else moved.when(k)
        yokes = design.yoke_design_variables if k == 0 or design.joints > 2 else ()
        yield Verdict(
            subject=subject,
            title=title,
            limit=limit,
            source=norm.source,
            confidence=norm.confidence,
            value=np.asarray(speed) ** 2 * np.maximum(drawn, most),
            design_variables=(*yokes, *design.joint_angle_design_variables, *design.speed_design_variables),
            note=joined(at_top_speed(design), when, rigid if k == 0 and has_torsion(design.drive) else ""),
        )


def swings_of_laws(seen: Swing) -> Array:
    """Return the same as `swings` of a drive that no chain of Hooke joints turns like, seen over a turn (k,)."""
    inside = seen.max_acceleration[:-1], seen.coast_acceleration
    return np.asarray([seen.max_acceleration[-1], *(float(np.max(one)) for one in inside if one.size)])


def swings(chain: Chain) -> Array:
    """Return the largest accelerations over the square of the speed: of the output, in drive, in coast (..., k).

    chain (..., n): k is 3, or 1 where there is one joint and no shaft inside.
    """
    each: Array = after_each_joint(chain).max_acceleration
    n = chain.joints
    if n == 1:
        return each
    coast = [largest_acceleration(mobius.joint_angle(Case(chain=chain).between(i, n))) for i in range(1, n)]
    xp = namespace(each)
    inside = xp.max(each[..., :-1], axis=-1), xp.max(xp.stack(coast, axis=-1), axis=-1)
    return xp.stack((each[..., -1], *inside), axis=-1)


CHECK = Check(
    name="acceleration",
    doc=mark("torsional excitation and the inertia excitation in drive and in coast, against a standard"),
    judge=_judge,
    dimension="angular_acceleration",
    unit="rad_s2",
    crosses="law",
)
