"""The key figures on page 1, by which drives are compared."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from cardan.answers.answer import KeyFigure, Tone
from cardan.answers.quantity import Joined, Quantity, Text, say
from cardan.answers.reader import reader
from cardan.checks.checks import check
from cardan.checks.design import Design
from cardan.checks.moving import WORSE, posed
from cardan.checks.verdict import AMBER, Verdict
from cardan.errors import InputError
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost
from cardan.texts import _

from .block import Page, Table, verdict_columns
from .page import row
from .subject import Subject

CALM = 1e-3
"""Speed fluctuation below which a drive is called nearly uniform: some tenth of what one joint of 5° does."""

UTMOST = 1e-9
"""Changes of the speed fluctuation smaller than this help nobody."""


def key_table(keys: Sequence[Any]) -> Table:
    """Return key figures as a table: what, value, unit, limit, utilisation, verdict."""
    return Table(
        columns=verdict_columns(), rows=[row(one, reader()) if isinstance(one, KeyFigure) else one for one in keys]
    )


def key_figures(on: Subject, pages: Sequence[Page] = ()) -> list[KeyFigure]:
    """Return the figures a reader compares drives by, with their limits where there are any.

    Parameters
    ----------
    on : Subject
        The drive.
    pages : sequence of Page
        Parts of the report whose own key figures stand below.
    """
    return [*own_figures(on), *(one for page in pages for one in page.keys)]


def own_figures(on: Subject) -> Iterator[KeyFigure]:
    """Yield how the output turns, and the largest joint angle."""
    whole, (verdict, tone) = on.whole, _uniformity(on)
    yield KeyFigure(
        name="speed_fluctuation",
        title=_("speed fluctuation δ of the output"),
        value=Quantity(float(whole.speed_fluctuation), "share"),
        verdict=verdict,
        tone=tone,
    )
    yield from _worst_pose(on)
    alike, error = (0.0 if on.even else float(value) for value in (whole.joint_angle, whole.max_angle_error))
    title = _("equivalent joint angle of the drive")
    yield KeyFigure(name="equivalent_joint_angle", title=title, value=Quantity(alike, "angle"))
    yield KeyFigure(name="angle_error", title=_("angle error of the output, ±"), value=Quantity(error, "angle"))
    yield _acceleration(on)
    yield _joint_angle(on)
    if on.moving is not None:
        yield from _moving(on)


def _worst_pose(on: Subject) -> Iterator[KeyFigure]:
    """Yield the speed fluctuation in the worst pose, where it is worse than as drawn."""
    share = on.phasing.as_built.pose_speed_fluctuation
    if share.size and float(np.max(share)) > float(on.whole.speed_fluctuation) + UTMOST:
        worst, name = float(np.max(share)), on.phasing.poses[int(foremost(share))]
        place = say(_("in the pose {name}"), name=name)
        title = _("speed fluctuation δ of the output")
        yield KeyFigure(name="pose_speed_fluctuation", title=title, place=place, value=Quantity(worst, "share"))


def _joint_angle(on: Subject) -> KeyFigure:
    """Return the joint angle that comes nearest to its limit: that of the checks, else the utmost of its kind."""
    allowed = {one.subject: one for one in _judged(on) if one.run}
    moving = {one.number: one.value for one in on.moving.worst if one.what == "joint_angle"} if on.moving else {}
    poses = [] if len(allowed) == on.joints else _in_poses(on)
    found: list[tuple[float, int, float, float, Text, bool]] = []
    for k, (kind, drawn) in enumerate(zip(on.drive.joints, on.joint_angle, strict=True), start=1):
        one = allowed.get(f"joints[{k - 1}]")
        if one is None:
            most, moves, where = max(float(drawn), moving.get(k, 0.0)), moving.get(k, 0.0) > drawn, ""
            for pose, stands, reaches in poses:
                angle = max(stands[k - 1], reaches[k - 1])
                if angle > most * WORSE:
                    most, moves, where = float(angle), bool(angle > stands[k - 1] * WORSE), pose
            pose_said: Text = say(_("in the pose {name}"), name=where) if where else ""
            found.append((most / kind.steepest, k, most, kind.steepest, pose_said, moves))
        elif not isinstance(one.limit, tuple):
            found.append((float(one.utilisation), k, float(one.value), float(one.limit), one.note, False))
    use, joint, angle, limit, place, moves = max(found, key=lambda one: (round(one[0], 9), -one[1]))
    title = _("largest joint angle while moving") if moves else _("largest joint angle")
    at, value = Joined([say(_("joint {number}"), number=joint), place]), Quantity(angle, "angle")
    if f"joints[{joint - 1}]" not in allowed and use < AMBER:
        return KeyFigure(name="joint_angle", title=title, place=at, value=value)
    tone: Tone = "failed" if use > 1.0 else "warning" if use >= AMBER else "good"
    verdict = {"failed": _("too much"), "warning": _("near the limit"), "good": _("passed")}[tone]
    bound = Quantity(limit, "angle", 6, trim=True)
    return KeyFigure(name="joint_angle", title=title, place=at, value=value, limit=bound, verdict=verdict, tone=tone)


def _in_poses(on: Subject) -> list[tuple[str, Array, Array]]:
    """Return of every pose its name, the angle of each joint in it and the largest while it moves, arrays (n) [rad]."""
    if not on.drive.poses:
        return []
    each = posed(Design(drive=on.drive, duty=on.drive.duty))
    return [
        (name, one.joint_angle, one.moving_joint_angle if one.drive.movements else one.joint_angle)
        for name, one in each
    ]


def _judged(on: Subject) -> tuple[Verdict, ...]:
    """Return the verdicts on the joint angles; none where the drive cannot be judged."""
    try:
        return check(on.drive, only=["joint_angle"], known=on.known)
    except InputError:
        return ()


def _acceleration(on: Subject) -> KeyFigure:
    relative = 0.0 if on.even else float(on.whole.max_acceleration)
    return acceleration(relative, on.drive.duty.speed)


def acceleration(relative: float, speed: float | None) -> KeyFigure:
    """Return the largest acceleration of the output as a key figure, over ω₁² where no speed is known."""
    if speed is None:
        title: Text = _("largest acceleration of the output over ω₁²")
        return KeyFigure(name="relative_acceleration", title=title, value=Quantity(relative))
    return KeyFigure(
        name="acceleration",
        title=_("largest acceleration of the output"),
        place=say(_("at {speed}"), speed=Quantity(abs(speed), "angular_speed")),
        value=Quantity(relative * speed**2, "angular_acceleration"),
    )


def _uniformity(on: Subject) -> tuple[str, Tone]:
    """Return verdict and tone of the speed fluctuation."""
    if on.even:
        return _("exactly uniform"), "good"
    if on.rounded:
        return _("uniform but for rounding"), "good"
    if float(on.whole.speed_fluctuation) < CALM:
        return _("nearly uniform"), "plain"
    return (_("can be made uniform") if on.curable else _("cannot be uniform")), "warning"


def _moving(on: Subject) -> Iterator[KeyFigure]:
    assert on.moving is not None
    titles = {
        "speed_fluctuation": _("largest speed fluctuation if it stopped on its way"),
        "moving_speed_fluctuation": _("largest speed fluctuation while moving"),
    }
    for one in on.moving.worst:
        if one.what in titles:
            when, value = say(_("at {time}"), time=Quantity(one.time, "time", 3)), Quantity(one.value, "share", 3)
            yield KeyFigure(name=f"{one.what}_moving", title=titles[one.what], place=when, value=value)
    overlap, worst = on.drive.limits.spline_overlap, _worst_of_poses(on)
    for spline in on.moving.splines:
        failed = {flag.field.rpartition(".")[2] for flag in spline.flags}
        for field, title, left, limit in (
            ("engaged", _("shortest engaged length of the spline"), spline.engaged_min, overlap),
            ("gap", _("least remaining travel of the spline"), spline.gap_min, None),
        ):
            if left is None:
                continue
            verdict, bad = worst.get(f"shafts[{spline.shaft - 1}].spline.{field}"), field in failed
            if verdict is not None:
                left, bad = float(verdict.value), bad or not verdict.passed
            shaft = say(_("shaft {number}"), number=spline.shaft)
            place = Joined([shaft, verdict.note if verdict is not None else ""])
            use = limit / left if limit is not None and left > 0.0 else None
            tone: Tone = "failed" if bad else "warning" if use is not None and use >= AMBER else "good"
            yield KeyFigure(
                name=f"spline_{field}",
                title=title,
                place=place,
                value=Quantity(left, "length", decimals=1),
                limit=None if limit is None else Quantity(limit, "length", 6, trim=True),
                better="more",
                tone=tone,
                verdict={"failed": _("too little"), "warning": _("near the limit"), "good": _("passed")}[tone],
            )


def _worst_of_poses(on: Subject) -> dict[str, Verdict]:
    """Return the verdicts on splines by their design variable, where poses of the drive may be worse than as drawn."""
    found = check(on.drive, only=["spline_overlap"], known=on.known) if on.drive.poses else ()
    return {one.design_variables[0]: one for one in found if one.run}
