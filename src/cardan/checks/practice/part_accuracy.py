"""Whether yokes and crosses are as accurate as the norm asks."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields

from cardan.catalogue.rows import PartLimit
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.drive.accuracy import Inspection
from cardan.texts import _, mark

NAMES = {
    "axis_offset": mark("offset of the axes of the yokes of joint {number}"),
    "yoke_perpendicularity": mark("squareness of the yokes of joint {number}, on 100 mm"),
    "face_symmetry": mark("symmetry of the faces of the yokes of joint {number}"),
    "half_height_difference": mark("difference of the halves of the cross of joint {number}"),
    "cross_perpendicularity": mark("squareness of the cross of joint {number}, on 100 mm"),
    "coplanarity": mark("journals of the cross of joint {number} in one plane"),
    "coaxiality": mark("journals of the cross of joint {number} on one axis"),
}


def _judge(design: Design, i: int) -> Iterator[Verdict]:
    rows = design.known.rows(PartLimit)
    for one in fields(Inspection) if design.drive.joints[i].inspection is not None else ():
        path = f"joints[{i}].inspection.{one.name}"
        value, row = design.value(path), rows.get(one.name)
        if value is not None and row is not None:
            title = _(NAMES[one.name])
            yield Verdict(
                title=title,
                value=value,
                limit=row.limit,
                source=row.source,
                confidence=row.confidence,
                design_variables=(path,),
            )


CHECK = Check(
    name="part_accuracy",
    doc=mark("what was measured on yokes and crosses against GOST 2752-74"),
    joint=_judge,
    dimension="length",
    unit="mm",
    crosses="each",
)
