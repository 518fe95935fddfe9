"""Whether the line whirls within its clearance at the speeds held and passed, and as a standard advises."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.answers.quantity import Quantity, say
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict, joined, turning
from cardan.drive.conditions import load_cases, under
from cardan.errors import InputError
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost_of
from cardan.questions.bending.line_answer import lacking
from cardan.questions.bending.line_whirl import LineWhirl, whirl_in_use
from cardan.texts import _, mark
from cardan.units import rpm

ZONE = 9000e-6
"""Displacement from peak to peak at the end of zone B, times the root of the speed in rpm, ISO 20816-3 [m]."""

STAYS = ("limits.", "duty.life", "duty.upkeep", "duty.shock_factor", "duty.reliability")
"""Beginnings of paths that do not change the whirl of the line."""


def _judge(design: Design) -> Iterator[Verdict]:
    missing = lacking(design.drive)
    if missing:
        yield Verdict(missing=tuple(paths[0] for paths in missing))
        return
    if not all(path.startswith(STAYS) for path in design.varied):
        yield Verdict(unfit=_("judges one drive at a time; a sweep asks line_whirl"))
        return
    cases = [one for one in load_cases(design.duty) if one.pose in ("", design.pose)]
    try:
        found = [(one.name, whirl_in_use(under(design.drive, one))) for one in cases]
    except InputError as error:
        yield Verdict(missing=tuple(problem.field for problem in error.problems))
        return
    own = design.value("limits.whirl")
    if own is not None:
        case, whole = foremost_of(found, lambda one: one[1].peak()[0])
        size, speed, place = whole.peak()
        note = say(_("at {speed}, {place} behind joint 1"), speed=turning(speed), place=Quantity(place, "length", 3))
        source = _("limits of the drive file")
        yield Verdict(value=size, limit=own, source=source, note=joined(note, _decided(case)))
    case, whole = foremost_of(found, lambda one: float(np.max(_exposure(one[1]))))
    k = int(np.argmax(_exposure(whole)))
    yield Verdict(
        title=_("largest whirl of the line against the standard for shafts of machines"),
        value=float(np.max(whole.whirl[k])),
        limit=float(_allowed(whole)[k]),
        source=_("ISO 20816-3, end of zone B: 9000/√n µm from peak to peak, for shafts in the bearings of machines"),
        confidence="recalled",
        note=joined(say(_("at {speed}"), speed=turning(float(whole.speed[k]))), _decided(case)),
    )


def _allowed(found: LineWhirl) -> Array:
    """Return the amplitude that the standard allows at each speed, array (k,) [m]."""
    allowed: Array = 0.5 * ZONE / np.sqrt(np.maximum(found.speed, rpm) / rpm)
    return allowed


def _exposure(found: LineWhirl) -> Array:
    """Return the largest whirl at each speed in use over what the standard allows, array (k,); -1 at the others."""
    return np.where(found.within, np.max(found.whirl, axis=-1) / _allowed(found), -1.0)


def _decided(case: str) -> str:
    return _("decided by {case}").format(case=case) if case else ""


CHECK = Check(
    name="whirl_amplitude",
    doc=mark("largest whirl of the whole line at the speeds in use against the clearance, and against a standard"),
    judge=_judge,
    title=mark("largest whirl of the line"),
    dimension="displacement",
    unit="um",
)
