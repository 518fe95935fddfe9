"""Whether the needle bearings of every joint carry their largest load at rest and in motion."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.formulas.joint_rating import book_load, needle_rating
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost
from cardan.texts import _, mark

from .journal_strength import journal_load


def sizes_of(i: int) -> tuple[str, ...]:
    """Return the paths of the sizes of the needles of a joint, counted from 0."""
    return tuple(f"joints[{i}].needles.{one}" for one in ("count", "diameter", "length"))


def static_capacity(design: Design, i: int) -> Array | float | None:
    """Return the static capacity of the bearings of a joint: as given, or by ISO 76 [N]; None where it is not known."""
    given = design.value(f"joints[{i}].needles.static_capacity")
    paths = (*sizes_of(i), f"joints[{i}].cross.journal")
    if given is not None or design.missing(*paths):
        return given
    return needle_rating(*(design.value(path) for path in paths)).static


def _judge(design: Design, i: int) -> Iterator[Verdict]:
    span, given = f"joints[{i}].cross.span", f"joints[{i}].needles.static_capacity"
    sizes, journal = sizes_of(i), f"joints[{i}].cross.journal"
    capacity, rated = static_capacity(design, i), not design.missing(given)
    lacking = (*design.missing(span), *design.unloaded, *(() if capacity is not None else (given,)))
    if lacking or capacity is None:
        yield Verdict(missing=lacking)
        return
    load, note = journal_load(design, i)
    yield Verdict(
        value=load,
        limit=capacity,
        source=_("static capacity of the bearing") if rated else "ISO 76",
        design_variables=(span, *((given,) if rated else (*sizes, journal)), *design.torque_design_variables),
        note=note,
    )
    turning = [case for case in design.loaded if case.speed is not None and np.all(np.asarray(case.speed) > 0.0)]
    if design.missing(*sizes) or not turning or design.event is not None:
        return
    count, diameter, length = (design.value(path) for path in sizes)
    allowed = [book_load(count, diameter, length, np.asarray(case.speed) / (2.0 * np.pi)) for case in turning]
    used = [case.severity * case.couple[..., i] / limit for case, limit in zip(turning, allowed, strict=True)]
    worst = int(foremost([float(np.max(one)) for one in used]))
    yield Verdict(
        title=_("load of the needles of joint {number}, the handbook's rule"),
        value=turning[worst].severity * turning[worst].couple[..., i] * design.shock / design.value(span),
        limit=np.minimum(allowed[worst], capacity),
        source=_("Kozhevnikov & Perfil'ev (1978), eq. 266, one oscillation a turn"),
        design_variables=(span, *sizes, *design.torque_design_variables, *design.speed_design_variables),
        note=_("an old rule on the safe side; the life decides"),
        advice=True,
    )


CHECK = Check(
    name="needle_static",
    doc=mark("largest load of the needle bearings against ISO 76 and the handbook's rule"),
    joint=_judge,
    title=mark("load of the needles of joint {number} at rest"),
    dimension="force",
    unit="N",
    power=1.0,
    crosses="each",
    events=True,
)
