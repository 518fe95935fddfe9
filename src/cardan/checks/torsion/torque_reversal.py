"""Whether the torque of a shaft turns about, measured or by torsional vibration, so that what has backlash rattles."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.answers.quantity import Quantity, say
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.load_case import Case
from cardan.checks.verdict import Verdict
from cardan.maths.arrays import Array
from cardan.questions.torsion.road.places import sign_changes
from cardan.texts import _, mark
from cardan.units import hour

from .line import lacking, worst

SOURCE = mark("where the torque passes through zero, backlash opens and strikes shut")


LEAST = 1e-9
"""Mean torque that counts where there is none [N·m]."""


def _judge(design: Design) -> Iterator[Verdict]:
    yield from _measured(design)
    missing = (*lacking(design), *design.unloaded)
    if missing:
        yield Verdict(missing=missing)
        return
    shaking = [case for case in design.loaded if case.vibration is not None]
    for k in range(design.joints + 1) if shaking else ():
        dips, means = zip(*(_dip(case, k) for case in shaking), strict=True)
        value, limit = worst([dip / mean for dip, mean in zip(dips, means, strict=True)], dips, means)
        loose = _loose(design, k)
        if not loose and not _reverses(design, k):
            continue
        yield Verdict(
            title=_("dip of the torque of shaft {number} below its mean, against reversal").format(number=k + 1),
            subject=f"shafts[{k}]",
            value=value,
            limit=limit,
            source=_(SOURCE),
            design_variables=(*design.torque_design_variables, *loose),
            note="" if loose else _("the file gives it no backlash: what has some will rattle"),
            advice=not loose,
        )


def _measured(design: Design) -> Iterator[Verdict]:
    """Yield the range of a measured torque beside its largest size, which it passes where it changes its sign."""
    history = design.duty.torque_history
    if history is None or len(history.torques) < 2:
        return
    low, high = min(history.torques), max(history.torques)
    if low >= 0.0 or high <= 0.0:
        return
    rate = float(sign_changes(np.asarray(history.torques))) / (history.times[-1] - history.times[0])
    loose = any(_loose(design, k) for k in range(design.joints + 1))
    struck = _("{count} reversals per hour; at each of them the backlash given strikes")
    free = _("{count} reversals per hour; the file gives no backlash: what has some will rattle")
    yield Verdict(
        title=_("range of the measured torque, against reversal"),
        value=np.asarray(high - low),
        limit=np.asarray(max(high, -low)),
        source=_(SOURCE),
        note=say(struck if loose else free, count=Quantity(hour * rate, digits=3)),
        advice=True,
    )


def _dip(case: Case, k: int) -> tuple[Array, Array]:
    """Return how far the torque of a shaft falls below its mean, and that mean, arrays (...) [N·m]."""
    low, high = case.torque_range
    mean = case.mean_torque[..., k]
    return np.maximum(mean - low[..., k], 0.0) + 0.0 * high[..., k], np.maximum(mean, LEAST)


def _reverses(design: Design, k: int) -> bool:
    """Tell whether the torque of a shaft passes through zero in the drive that the others vary."""
    return any(float(np.min(one.low[:, k])) < 0.0 for case in design.loaded if (one := case.vibration) is not None)


def _loose(design: Design, k: int) -> tuple[str, ...]:
    """Return the paths of the backlash in a shaft and in the joint behind it."""
    paths = [f"shafts[{k}].spline.backlash"]
    if k < design.joints:
        paths.append(f"joints[{k}].backlash")
    given = {path: design.value(path) for path in paths}
    return tuple(path for path, value in given.items() if value is not None and np.any(value))


CHECK = Check(
    name="torque_reversal",
    doc=mark("torque of shafts with backlash against reversal, as measured or by torsional vibration"),
    judge=_judge,
    moves=True,
    title=mark("reversal of the torque"),
    dimension="torque",
    unit="Nm",
)
