"""Whether the line whirls within its clearance at the speeds held and passed, and as a standard advises."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.answers.quantity import Quantity, say
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict, turning
from cardan.errors import InputError
from cardan.maths.arrays import Array
from cardan.questions.bending.line_answer import lacking
from cardan.questions.bending.line_whirl import whirl_in_use
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
    try:
        found = whirl_in_use(design.drive)
    except InputError as error:
        yield Verdict(missing=tuple(problem.field for problem in error.problems))
        return
    size, speed, place = found.peak()
    note = _("at {speed}, {place} behind joint 1")
    own = design.value("limits.whirl")
    if own is not None:
        yield Verdict(
            value=size,
            limit=own,
            source=_("limits of the drive file"),
            note=say(note, speed=turning(speed), place=Quantity(place, "length", 3)),
        )
    allowed: Array = 0.5 * ZONE / np.sqrt(np.maximum(found.speed, rpm) / rpm)
    whirl = np.where(found.within, np.max(found.whirl, axis=-1), -1.0)
    k = int(np.argmax(whirl / allowed))
    yield Verdict(
        title=_("largest whirl of the line against the standard for shafts of machines"),
        value=float(whirl[k]),
        limit=float(allowed[k]),
        source=_("ISO 20816-3, end of zone B: 9000/√n µm from peak to peak, for shafts in the bearings of machines"),
        confidence="recalled",
        note=say(_("at {speed}"), speed=turning(float(found.speed[k]))),
    )


CHECK = Check(
    name="whirl_amplitude",
    doc=mark("largest whirl of the whole line at the speeds in use against the clearance, and against a standard"),
    judge=_judge,
    title=mark("largest whirl of the line"),
    dimension="displacement",
    unit="um",
)
