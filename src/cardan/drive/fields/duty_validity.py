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
    yield from _case_problems(drive)
    history = duty.torque_history
    if history is not None:
        if duty.blocks:
            yield Problem("duty.torque_history", _("blocks give the duty cycle already"), "inconsistent")
        if any(case.share is not None or case.cycles is not None for case in duty.cases):
            yield Problem("duty.torque_history", _("cases give the duty cycle already"), "inconsistent")
        if history.times or history.torques:
            law = TorqueHistory(file=history.file, times=history.times, torques=history.torques)
            for problem in law.problems():
                yield Problem("duty.torque_history", problem.message)
    for i, joint in enumerate(drive.joints):
        rating = joint.rating
        if rating is not None and rating.torque is None and rating.convention != "Tc":
            yield Problem(f"joints[{i}].rating.convention", _("belongs to the rated torque, which is not given"))


def _case_problems(drive: Described) -> Iterator[Problem]:
    """Yield what contradicts itself in the load cases of a drive."""
    duty = drive.duty
    names: set[str] = set()
    for k, case in enumerate(duty.cases):
        path = f"duty.cases[{k}]"
        if case.name in names:
            yield Problem(f"{path}.name", _("{name} names two load cases").format(name=repr(case.name)))
        names.add(case.name)
        if case.share is not None and case.cycles is not None:
            yield Problem(f"{path}.cycles", _("a load case has a share or cycles, not both"), "inconsistent")
        if case.speed is not None and case.speed_range is not None:
            yield Problem(f"{path}.speed_range", _("a load case has a speed or a range, not both"), "inconsistent")
        if case.cycles is not None and duty.life is None:
            yield Problem("duty.life", _("missing; load case {name} counts its turns in it").format(name=case.name))
        if case.cycles is not None and not (case.speed or case.speed_range or duty.speed):
            yield Problem(f"{path}.speed", _("missing; how long its cycles last depends on it"), "missing")
    if duty.cases and duty.blocks:
        yield Problem("duty.cases", _("blocks give the duty cycle already"), "inconsistent")
    shares = [case.share for case in duty.cases if case.share is not None]
    whole = sum(shares)
    least = 0.0 if duty.torque is not None else 1.0
    if shares and not least - WHOLE - SLACK <= whole <= 1.0 + WHOLE + SLACK:
        text = _("the shares of the load cases add up to {whole:.6g} %, not to 100 %")
        yield Problem("duty.cases", text.format(whole=100.0 * whole), "inconsistent")


def bound_problems(drive: Described) -> Iterator[Problem]:
    """Yield load cases of a file bound to poses or movements that it has not; a drive in a pose has no others."""
    known = {"pose": [pose.name for pose in drive.poses], "movement": [one.name for one in drive.movements]}
    what = {"pose": _("pose"), "movement": _("movement")}
    text = _("there is no {what} {name}; there are: {known}")
    for k, case in enumerate(drive.duty.cases):
        for field, others in known.items():
            name = getattr(case, field)
            if name and name not in others:
                there = ", ".join(filter(None, others)) or _("none")
                message = text.format(what=what[field], name=repr(name), known=there)
                yield Problem(f"duty.cases[{k}].{field}", message)
