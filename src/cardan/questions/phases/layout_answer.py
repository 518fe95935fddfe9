"""What there is to say of joint centres moved within their limits: joint angles before and after, and the yokes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from cardan.answers.answer import Answer, Column, Remark, Table, heads
from cardan.answers.quantity import Quantity, Say, say
from cardan.drive.drive import Drive
from cardan.questions.motion.equivalence import equivalent_joint
from cardan.texts import _, plural
from cardan.units import mm

from .answer import command, letters, setting_facts, settings_table, spread
from .figure import layout_figures, phasing_figures
from .layout import Layout, Status

__all__ = ["answer", "values"]


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
        figures=lambda: (*layout_figures(result), *phasing_figures(result.phasing)),
        tables=(_joints(result), *((settings_table(result.drive, settings),) if settings else ())),
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
    return say(
        text,
        count=plural("{n} joint", "{n} joints", len(drive.joints)).format(n=len(drive.joints)),
        now=Quantity(float(equivalent_joint(drive).speed_fluctuation), "share"),
        least=Quantity(found.speed_fluctuation, "share"),
        angle=Quantity(float(found.joint_angle.max()), "angle", decimals=2),
        old=Quantity(float(found.joint_angle_before.max()), "angle", decimals=2),
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
        yield Remark(text=text)
    if meaning := letters(found.phasing, nearest=nearest):
        yield Remark(text=meaning)
    yield from spread(found.phasing)
    parts = command(fixed, "--layout", "-o", "better.toml", nearest=nearest)
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
        "settings": [setting_facts(one) for one in found.phasing.settings],
    }
