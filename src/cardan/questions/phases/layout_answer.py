"""What there is to say of joint centres moved within their limits: joint angles before and after, and the yokes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from cardan.answers.answer import Answer, Column, Remark, Table, heads
from cardan.answers.quantity import Joined, Quantity, Say, say
from cardan.drive.drive import Drive
from cardan.later import later
from cardan.questions.motion.equivalence import equivalent_joint
from cardan.texts import _, plural
from cardan.units import mm

from .answer import command, letters, setting_facts, settings_table, spread
from .layout import Layout, Status

drawn = later("cardan.questions.phases.figures")

__all__ = ["answer", "values"]

FEW = 8
"""With more conditions than this their table stands in the report and in files alone."""


def answer(drive: Drive, result: Layout, *, fixed: Mapping[int, float] | None = None, nearest: bool = False) -> Answer:
    """Return what there is to say of a layout; see `cardan.questions.phases.answer.answer`.

    drive: the drive as it stands in the file; result: the same with its joints moved.
    fixed: what was held beside the file: shaft number -> yoke angle [rad].
    nearest: whether the goal was the least change of the present yokes.
    """
    settings = result.phasing.settings
    return Answer(
        name="layout",
        title=_("Layout of the joint centres"),
        sentence=_sentence(drive, result),
        figures=lambda: (*drawn().layout_figures(result), *drawn().phasing_figures(result.phasing)),
        tables=(
            _joints(result),
            *((settings_table(result.drive, settings),) if settings else ()),
            *((_conditions(result),) if result.conditions else ()),
        ),
        remarks=tuple(_remarks(result, fixed or {}, nearest)),
        facts=_facts(result),
        full=lambda: _joints(result),
        code=1 if result.status == Status.CANCELLED else 0,
    )


def values(found: Layout) -> dict[str, Any]:
    """Return the new joint centres as values of the drive file."""
    return {
        f"joints[{k}].centre_mm": [round(float(x) / mm, 12) for x in found.points[k + 1]]
        for k, way in enumerate(found.moved)
        if way > 0.0
    }


def _sentence(drive: Drive, found: Layout) -> Say:
    text = _("{count}; δ = {now} as specified, {least} with the joints moved; largest joint angle {angle}, was {old}.")
    if found.feasible:
        text = _(
            "{count}; δ = {now} as specified, exactly uniform with the joints moved; largest joint angle {angle}, was "
            "{old}."
        )
    if len(found.conditions) > 1:
        return _over(drive, found)
    return say(
        text,
        count=plural("{n} joint", "{n} joints", len(drive.joints)).format(n=len(drive.joints)),
        now=Quantity(float(equivalent_joint(drive).speed_fluctuation), "share"),
        least=Quantity(found.speed_fluctuation, "share"),
        angle=Quantity(float(found.joint_angle.max()), "angle", decimals=2),
        old=Quantity(float(found.joint_angle_before.max()), "angle", decimals=2),
    )


def _over(drive: Drive, found: Layout) -> Say:
    """Return in one sentence what becomes of a drive in all its poses and movements."""
    text = _(
        "{count}; in the worst of {conditions} conditions δ = {now} as specified, {least} with the joints moved; "
        "largest joint angle {angle}, was {old}."
    )
    if found.over == "mean":
        text = _(
            "{count}; on average over {conditions} conditions δ = {now} as specified, {least} with the joints moved; "
            "largest joint angle {angle}, was {old}."
        )
    before, after = (np.asarray(one) for one in (_before(found), _after(found)))
    shares = np.asarray([one.share for one in found.conditions])
    mean = found.over == "mean"
    return say(
        text,
        count=plural("{n} joint", "{n} joints", len(drive.joints)).format(n=len(drive.joints)),
        conditions=len(found.conditions),
        now=Quantity(float(shares @ before if mean else np.max(before)), "share"),
        least=Quantity(float(shares @ after if mean else np.max(after)), "share"),
        angle=Quantity(max(one.joint_angle for one in found.conditions), "angle", decimals=2),
        old=Quantity(max(one.joint_angle_before for one in found.conditions), "angle", decimals=2),
    )


def _before(found: Layout) -> list[float]:
    return [one.speed_fluctuation_before for one in found.conditions]


def _after(found: Layout) -> list[float]:
    return [one.speed_fluctuation for one in found.conditions]


def _conditions(found: Layout) -> Table:
    """Return what becomes of every pose and instant; of many on paper the worst before and after."""
    every = found.conditions
    return Table(
        name="conditions",
        title=_("In each condition"),
        records=True,
        depth="brief" if len(every) <= FEW else "full",
        columns=(
            Column(key="condition", heading=_("condition"), values=[one.name for one in every], left=True),
            Column(key="share", heading=_("time"), values=[one.share for one in every], dimension="share", decimals=1),
            Column(
                key="speed_fluctuation_before", heading=_("δ as specified"), values=_before(found), dimension="share"
            ),
            Column(key="speed_fluctuation", heading=_("δ now"), values=_after(found), dimension="share"),
            Column(
                key="joint_angle_before",
                heading=_("largest joint angle, was"),
                values=[one.joint_angle_before for one in every],
                dimension="angle",
                decimals=2,
            ),
            Column(
                key="joint_angle",
                heading=_("now"),
                values=[one.joint_angle for one in every],
                dimension="angle",
                decimals=2,
            ),
        ),
    )


def _joints(found: Layout) -> Table:
    where = np.asarray(found.points)[1:-1]
    places = {"x": _("to x"), "y": _("y"), "z": _("z")}
    return Table(
        name="joints",
        records=True,
        columns=(
            *heads(_("joint"), [joint.name for joint in found.drive.joints]),
            Column(
                key="joint_angle_before",
                heading=_("joint angle, was"),
                values=found.joint_angle_before,
                dimension="angle",
                decimals=2,
            ),
            Column(key="joint_angle", heading=_("now"), values=found.joint_angle, dimension="angle", decimals=2),
            Column(key="moved", heading=_("moved by"), values=found.moved, dimension="length", decimals=1),
            *(
                Column(key=key, heading=heading, values=where[:, k], dimension="length", decimals=1)
                for k, (key, heading) in enumerate(places.items())
            ),
        ),
    )


def _remarks(found: Layout, fixed: Mapping[int, float], nearest: bool) -> Iterator[Remark]:
    if found.status == Status.CANCELLED:
        text = _("Warning: the search was stopped; this is the best layout so far.")
        yield Remark(text=text, tone="warning")
    if not found.feasible:
        text = _("No position of the centres within their limits makes the drive uniform; wider limits may.")
        if len(found.conditions) > 1:
            text = _("No position of the centres within their limits makes the drive uniform in all its conditions.")
        yield Remark(text=text)
    if found.kept:
        text = _("A pose places {joints} by itself; there the new centre does not count.")
        joints = Joined([say(_("joint {number}"), number=k) for k in found.kept])
        yield Remark(text=say(text, joints=joints))
    if nearest and found.conditions:
        text = _("The goal does not count here: the yokes leave the least fluctuation in all conditions.")
        yield Remark(text=text)
    if meaning := letters(found.phasing, nearest=nearest):
        yield Remark(text=meaning)
    yield from spread(found.phasing)
    over = ("--over", "mean") if found.over == "mean" else ()
    parts = command(fixed, "--layout", *over, "-o", "better.toml", nearest=nearest)
    text = _("Write the new centres and yoke angles into a copy of the file:")
    yield Remark(text=text, command=parts, tone="next")


def _facts(found: Layout) -> dict[str, Any]:
    return {
        "status": str(found.status),
        "synchronous_possible": found.feasible,
        "speed_fluctuation": Quantity(found.speed_fluctuation, "share"),
        "joint_angle_before": Quantity(found.joint_angle_before, "angle"),
        "joint_angle": Quantity(found.joint_angle, "angle"),
        "length_before": Quantity(found.length_before, "length"),
        "length": Quantity(found.length, "length"),
        "points": Quantity(found.points, "length"),
        "over": found.over if found.conditions else None,
        "settings": [setting_facts(one) for one in found.phasing.settings],
    }
