"""Key figures that verdicts decide: the joint angle nearest its limit, and the splines in their worst pose."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from cardan.answers.answer import KeyFigure, Tone
from cardan.answers.quantity import Joined, Quantity, Text, numbered, say
from cardan.drive.drive import Drive
from cardan.drive.models.geometry import geometry
from cardan.maths.arrays import Array
from cardan.questions.motion.articulation_answer import spline_key
from cardan.texts import _

from .design import Design
from .moving import WORSE, posed
from .verdict import AMBER, Verdict
from .verdict_table import word_of


def key_figures(drive: Drive, verdicts: Sequence[Verdict]) -> Iterator[KeyFigure]:
    """Yield the figures of the first page that verdicts decide.

    verdicts: on it; those that were not run decide nothing.
    """
    run = [one for one in verdicts if one.run]
    yield _joint_angle(drive, {one.subject: one for one in run if one.check == "joint_angle" and not one.advice})
    for one in run if drive.poses else ():
        if one.check == "spline_overlap":
            yield spline_key(
                drive,
                int(one.subject[len("shafts[") : -1]) + 1,
                one.design_variables[0].rpartition(".")[2],
                float(one.value),
                failed=not one.passed,
                note=one.note,
            )


def _joint_angle(drive: Drive, allowed: dict[str, Verdict]) -> KeyFigure:
    """Return the joint angle that comes nearest to its limit: that of the checks, else the utmost of its kind."""
    poses = [] if len(allowed) == len(drive.joints) else _in_poses(drive)
    found: list[tuple[float, int, float, float, Text, bool]] = []
    for k, kind in enumerate(drive.joints, start=1):
        one = allowed.get(f"joints[{k - 1}]")
        if one is None:
            most, moves, where = 0.0, False, ""
            for pose, stands, reaches in poses:
                angle = max(float(stands[k - 1]), float(reaches[k - 1]))
                if angle > most * WORSE:
                    most, moves, where = angle, angle > float(stands[k - 1]) * WORSE, pose
            pose_said: Text = say(_("in the pose {name}"), name=where) if where else ""
            found.append((most / kind.steepest, k, most, kind.steepest, pose_said, moves))
        elif not isinstance(one.limit, tuple):
            found.append((float(one.utilisation), k, float(one.value), float(one.limit), one.note, False))
    use, joint, angle, limit, place, moves = max(found, key=lambda one: (round(one[0], 9), -one[1]))
    title = _("largest joint angle while moving") if moves else _("largest joint angle")
    name = "joint_angle"
    if angle * WORSE < max(one[2] for one in found):  # a larger one is farther from the limit of its own joint
        name, title = "joint_angle_nearest", _("joint angle nearest to its limit")
    which = numbered(joint, drive.joints[joint - 1].name)
    at, value = Joined([say(_("joint {number}"), number=which), place]), Quantity(angle, "angle")
    judged = f"joints[{joint - 1}]" in allowed
    if not judged and use < AMBER:
        return KeyFigure(name=name, title=title, place=at, value=value)
    tone: Tone = "good" if use < AMBER else "failed" if use > 1.0 and judged else "warning"
    verdict = _("passed") if use < AMBER else _("near the limit") if use <= 1.0 else _("too much")
    if judged and allowed[f"joints[{joint - 1}]"].state == "unconfirmed":
        tone, verdict = "warning", word_of(allowed[f"joints[{joint - 1}]"])
    bound = Quantity(limit, "angle", 6, trim=True)
    return KeyFigure(
        name=name,
        title=title,
        place=at,
        value=value,
        limit=bound,
        verdict=verdict,
        tone=tone,
        check="joint_angle",
    )


def _in_poses(drive: Drive) -> list[tuple[str, Array, Array]]:
    """Return name, angles of the joints and the largest while it moves (n) [rad], as drawn and in every pose."""
    drawn = Design(drive=drive, duty=drive.duty)
    return [
        (
            name,
            geometry(one.drive).joint_angle,
            one.moving_joint_angle.most if one.drive.movements else geometry(one.drive).joint_angle,
        )
        for name, one in (("", drawn), *posed(drawn))
    ]
