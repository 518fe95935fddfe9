"""What a duty must satisfy to be a duty cycle, and what a maker's rating must say."""

from __future__ import annotations

from collections.abc import Iterator

from cardan.drive.described import Described
from cardan.drive.machine import TorqueHistory
from cardan.errors import Problem
from cardan.texts import _

WHOLE = 1e-4
"""Shares of a duty cycle may miss the whole time by this, 0.01 %."""

SLACK = 1e-12
"""What sums of decimal fractions may be off beside that."""


def duty_problems(drive: Described) -> Iterator[Problem]:
    """Yield what contradicts itself in the duty cycle of a drive, and keys of a rating that is not there."""
    duty = drive.duty
    if duty.blocks:
        whole = sum(block.share for block in duty.blocks)
        if abs(whole - 1.0) > WHOLE + SLACK:
            text = _("the shares of the blocks add up to {whole:.6g} %, not to 100 %")
            yield Problem("duty.blocks", text.format(whole=100.0 * whole), "inconsistent")
    history = duty.torque_history
    if history is not None:
        if duty.blocks:
            yield Problem("duty.torque_history", _("blocks give the duty cycle already"), "inconsistent")
        if history.times or history.torques:
            law = TorqueHistory(file=history.file, times=history.times, torques=history.torques)
            for problem in law.problems():
                yield Problem("duty.torque_history", problem.message)
    for i, joint in enumerate(drive.joints):
        rating = joint.rating
        if rating is not None and rating.torque is None and rating.convention != "Tc":
            yield Problem(f"joints[{i}].rating.convention", _("belongs to the rated torque, which is not given"))
