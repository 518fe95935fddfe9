"""Whether the needle bearings of every joint carry their largest load at rest and in motion."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.formulas.needle_bearing import book_load, needle_rating
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost
from cardan.texts import _, mark


def _judge(design: Design) -> Iterator[Verdict]:
    for i in range(design.joints):
        yield from _of_joint(design, i)


def _of_joint(design: Design, i: int) -> Iterator[Verdict]:
    made = partial(
        Verdict,
        check="needle_static",
        subject=f"joints[{i}]",
        title=_("load of the needles of joint {number} at rest").format(number=i + 1),
        dimension="force",
        unit="N",
    )
    span, given = f"joints[{i}].cross.span", f"joints[{i}].needles.static_capacity"
    sizes = tuple(f"joints[{i}].{one}" for one in ("needles.count", "needles.diameter", "needles.length"))
    journal = f"joints[{i}].cross.journal"
    rated = design.value(given)
    lacking = (*design.missing(span), *design.unloaded)
    if rated is None and design.missing(*sizes, journal):
        lacking = (*lacking, given)
    if lacking:
        yield made(missing=lacking)
        return
    load, note = design.most(lambda case: case.couple[..., i])
    load = load * design.shock / design.value(span)
    count, diameter, length = (design.value(path) for path in sizes)
    capacity = rated
    if capacity is None:
        capacity = needle_rating(count, diameter, length, design.value(journal)).static
    inside = (given,) if rated is not None else (*sizes, journal)
    yield made(
        value=load,
        limit=capacity,
        source=_("static capacity of the bearing") if rated is not None else "ISO 76",
        levers=(span, *inside, *design.torque_levers),
        note=note,
    )
    if design.missing(*sizes):
        return
    turning = [case for case in design.loaded if case.speed is not None and np.all(np.asarray(case.speed) > 0.0)]
    if not turning:
        return
    used = [
        case.couple[..., i] / book_load(count, diameter, length, np.asarray(case.speed) / (2.0 * np.pi))
        for case in turning
    ]
    worst = int(foremost([float(np.max(one)) for one in used]))
    limit: Array = book_load(count, diameter, length, np.asarray(turning[worst].speed) / (2.0 * np.pi))
    yield made(
        title=_("load of the needles of joint {number}, the book's rule").format(number=i + 1),
        value=turning[worst].couple[..., i] * design.shock / design.value(span),
        limit=np.minimum(limit, capacity),
        source=_("Book (266), one swing a turn"),
        levers=(span, *sizes, *design.torque_levers, *design.speed_levers),
        note=_("an old rule on the safe side; the life decides"),
        advice=True,
    )


CHECK = Check(
    name="needle_static",
    doc=mark("largest load of the needle bearings against ISO 76 and the book's rule"),
    judge=_judge,
    crosses="each",
)
