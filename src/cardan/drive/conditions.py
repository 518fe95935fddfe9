"""The conditions in which a drive runs: as drawn or in a pose, at a speed, with a torque, for a share of the time.

A question answers for one condition; how it gathers over all of them is declared beside it, see
`cardan.answers.question.Question.gathers`. The conditions of a drive are made here, once, from its file.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import chain
from math import pi

import numpy as np

from cardan.answers.question import Gathering
from cardan.errors import refuse
from cardan.maths.arrays import Array, ArrayLike, floats
from cardan.texts import _

from .drive import Drive
from .duty import Case, Duty, Harmonic
from .fields.paths import pose_drives
from .models.geometry import in_form

ROUNDING = 1e-9  # what is left of the time by less than this is none


@dataclass(frozen=True, kw_only=True)
class LoadCase:
    """A way in which a drive runs under torque."""

    name: str = ""  # what to call it; empty for the duty itself
    torque: float | None = None  # [N·m]: mean torque, with its sign; None where the duty says none
    speed: float | None = None  # [rad/s]: input speed with its sign; the middle of a range
    share: float = 1.0  # share of the whole time; 0 for a peak, and for the duty beside its duty cycle
    path: str = "duty"  # where it stands in the drive file: ``duty``, ``duty.cases[1]``
    # [rad/s]: lowest and highest input speed, where the case has its own or they were measured
    speed_range: tuple[float, float] | None = None
    # whether it runs over the speed range of the duty: not where it holds a speed of its own beside the duty itself
    ranges: bool = True
    joint_angle: float | None = None  # [rad]: bend of every joint, where it is not that of the drive
    torque_at: str = "output"  # ``output`` or ``input``
    harmonics: tuple[Harmonic, ...] = ()  # swinging parts of the torque
    scale: float = 0.0  # [N·m]: mean torque that the harmonics belong to; zero when they do not grow with it
    shock_factor: float = 1.0
    pose: str = ""  # pose, movement: names of the pose and of the movement to which it is bound; empty where it is not
    movement: str = ""

    @property
    def held(self) -> bool:
        """Whether it holds its speed; the middle of a range that stands for a speed is not held."""
        return self.speed is not None and (self.speed_range is None or self.path == "duty")


@dataclass(frozen=True, kw_only=True)
class Condition:
    """One way in which a drive runs."""

    # its geometry there, with the load case as its duty; without poses, load cases and parts of a duty cycle
    drive: Drive
    pose: str = ""  # name of the pose; empty as drawn
    case: str = ""  # name of the load case; empty for the only one
    share: float | None = 1.0  # share of the whole time, 0 for a peak; None where the file does not say
    moving: bool = False  # whether the drive moves while it runs so, and each instant is a geometry of its own

    @property
    def speed(self) -> float | None:
        """Input speed [rad/s]."""
        return self.drive.duty.speed

    @property
    def torque(self) -> float | None:
        """Torque at the end where the duty gives it [N·m]."""
        return self.drive.duty.torque

    @property
    def name(self) -> str:
        """What to call it, in the language spoken; empty for the drive as drawn at its only torque."""
        pose = _("pose {name}").format(name=self.pose) if self.pose else ""
        return ", ".join(word for word in (pose, self.case) if word)


def load_cases(duty: Duty) -> tuple[LoadCase, ...]:
    """Return every way a duty has a drive run: steadily, load cases or parts of its duty cycle, its measured peak."""
    history = duty.torque_history
    measured = history is not None and bool(history.torques)
    own = duty.torque is not None  # then the range of speeds is that of the duty itself
    found = [
        _of_case(duty, case, f"duty.cases[{k}]", ranges=not own or case.speed is None)
        for k, case in enumerate(duty.cases)
    ]
    rest = max(0.0, 1.0 - sum(one.share for one in found))
    shocks, scale = duty.shock_factor, duty.torque or 0.0
    if duty.torque is not None or not (duty.blocks or found or measured):
        steady = LoadCase(
            torque=duty.torque,
            speed=duty.speed,
            share=0.0 if duty.blocks or measured else rest,
            speed_range=duty.speed_range,
            torque_at=duty.torque_at,
            harmonics=duty.harmonics,
            scale=scale,
            shock_factor=shocks,
        )
        found.insert(0, steady)
    for k, block in enumerate(duty.blocks):
        part = LoadCase(
            name=_("part {number} of the duty cycle").format(number=k + 1),
            torque=block.torque,
            speed=block.speed,
            share=block.share,
            path=f"duty.blocks[{k}]",
            ranges=not own,
            joint_angle=block.joint_angle,
            harmonics=duty.harmonics if scale else (),
            scale=scale,
            shock_factor=shocks,
        )
        found.append(part)
    if history is not None and measured:
        most = max(history.torques, key=abs)
        name = _("the peak of the torque history")
        path = "duty.torque_history"
        speeds = [abs(one) for one in history.speeds]
        between = (min(speeds), max(speeds)) if speeds else None
        speed = 0.5 * sum(between) if between and duty.speed is None else duty.speed
        peak = LoadCase(
            name=name, torque=most, speed=speed, share=0.0, path=path, speed_range=between, shock_factor=shocks
        )
        found.append(peak)
    return tuple(found)


def _of_case(duty: Duty, case: Case, path: str, *, ranges: bool) -> LoadCase:
    """Return a load case of the drive file; turns counted in the life asked for are a share of it."""
    speed = case.speed if case.speed_range is None else 0.5 * sum(case.speed_range)
    speed = duty.speed if speed is None else speed if (duty.speed or 0.0) >= 0.0 else -speed
    share = case.share or 0.0
    if case.cycles is not None and speed and duty.life:
        share = 2.0 * pi * case.cycles / (abs(speed) * duty.life)
    scale = duty.torque or 0.0
    return LoadCase(
        name=case.name,
        torque=-case.torque if case.flow == "coast" else case.torque,
        speed=speed,
        share=share,
        path=path,
        speed_range=case.speed_range,
        ranges=ranges,
        torque_at=duty.torque_at,
        harmonics=duty.harmonics if scale else (),
        scale=scale,
        shock_factor=duty.shock_factor if case.shock_factor is None else case.shock_factor,
        pose=case.pose,
        movement=case.movement,
    )


def held_speeds(duty: Duty) -> tuple[float, ...]:
    """Return the speeds that a duty holds, its own and those of its load cases, in rising order [rad/s].

    A load case bound to a pose is no part of the duty as drawn.

    >>> road = Case(name="road", torque=300.0, speed=314.0)
    >>> held_speeds(Duty(speed=150.0, cases=(road, Case(name="shunt", torque=900.0, speed_range=(20.0, 60.0)))))
    (150.0, 314.0)
    """
    own = (one.speed for one in load_cases(duty) if one.held and not one.pose)
    return tuple(sorted({abs(speed) for speed in (duty.speed, *own) if speed}))


def speed_ranges(duty: Duty) -> tuple[tuple[float, float], ...]:
    """Return the ranges of speed that a duty runs through [rad/s], its own first, then those of its load cases.

    A load case bound to a pose is no part of the duty as drawn.
    """
    every = (duty.speed_range, *(one.speed_range for one in load_cases(duty) if not one.pose))
    return tuple(dict.fromkeys(one for one in every if one is not None))


def used_speeds(duty: Duty) -> tuple[float, float] | None:
    """Return the lowest and highest speed of running [rad/s], None where the duty says none."""
    speeds = (*chain.from_iterable(speed_ranges(duty)), *held_speeds(duty))
    return (min(speeds), max(speeds)) if speeds else None


def acting(drive: Drive, pose: str) -> Drive:
    """Return a drive in a pose with the load cases that act there, bound to none; ``""`` is the drive as drawn."""
    cases = (replace(case, pose="") for case in drive.duty.cases if case.pose in ("", pose))
    return replace(drive, duty=replace(drive.duty, cases=tuple(cases)))


def conditions(drive: Drive) -> tuple[Condition, ...]:
    """Return every condition of a drive: as drawn, then in its poses, each load case in each of them.

    Returns: as drawn first. The poses take their shares, and the drive as drawn what they leave; where a pose has no
    share, that of the drive as drawn and of each such pose is not known. A load case bound to a pose has its own share
    there, and the others run in all poses by theirs.
    """
    return tuple(one for stand in in_poses(drive) for one in _loaded(stand.drive, stand.pose, stand.share))


def in_poses(drive: Drive) -> tuple[Condition, ...]:
    """Return a drive as drawn and in each of its poses, each with the whole duty."""
    shares = [pose.share for pose in drive.poses]
    left = 1.0 - sum(share for share in shares if share is not None)
    rest = None if None in shares else left if left > ROUNDING else 0.0
    drawn = replace(drive, poses=()) if drive.poses else drive
    found = [Condition(drive=drawn, share=rest, moving=bool(drive.movements))]
    for k, (pose, posed) in enumerate(zip(drive.poses, pose_drives(drive), strict=True), start=1):
        moving = bool(posed.movements)
        found.append(Condition(drive=posed, pose=pose.name or str(k), share=pose.share, moving=moving))
    return tuple(found)


def _loaded(drive: Drive, pose: str, share: float | None) -> list[Condition]:
    """Return a drive as drawn or in a pose in each of its load cases that acts there."""
    every = load_cases(drive.duty)
    resting = not any(case.share for case in every)
    found = []
    for case in every:
        if case.pose not in ("", pose):
            continue
        time = 1.0 if resting and case.path == "duty" else case.share
        own = time if case.pose or not time else None if share is None else time * share
        name = case.name or (_("the torque of the duty") if len(every) > 1 else "")
        run = under(drive, case)
        found.append(Condition(drive=run, pose=pose, case=name, share=own, moving=bool(run.movements)))
    return found


def under(drive: Drive, case: LoadCase) -> Drive:
    """Return a drive with one load case as its whole duty.

    case: its torque, speeds and factor for shocks; the joint angle of every joint and the only movement, where it names
    them.
    """
    duty = replace(
        drive.duty,
        blocks=(),
        cases=(),
        torque_history=None,
        torque=case.torque,
        speed=case.speed,
        speed_range=case.speed_range or (drive.duty.speed_range if case.ranges else None),
        torque_at=case.torque_at,
        harmonics=_grown(case),
        shock_factor=case.shock_factor,
    )
    if case.joint_angle is not None:
        flat = in_form(replace(drive, movements=()), "angles")
        bent = tuple(replace(joint, joint_angle=case.joint_angle) for joint in flat.joints)
        return replace(flat, joints=bent, duty=duty)
    moves = tuple(one for one in drive.movements if case.movement in ("", one.name))
    alone = duty == drive.duty and moves == drive.movements
    return drive if alone else replace(drive, duty=duty, movements=moves)


def _grown(case: LoadCase) -> tuple[Harmonic, ...]:
    """Return the swinging parts of a torque, which grow with its mean."""
    if not case.harmonics or not case.scale or case.torque is None:
        return case.harmonics
    growth = abs(case.torque / case.scale)
    return tuple(replace(one, torque=growth * one.torque) for one in case.harmonics)


def gathered(how: Gathering, values: ArrayLike, shares: Sequence[float | None]) -> Array:
    """Return what answers over conditions come to.

    how: one of `Gathering`; values (c, ...); shares: share of the time of each.
    Returns (...), or (c, ...) for ``"each"``.
    """
    (every,) = floats(values)
    if how == "each":
        return every
    if how == "worst":
        return np.asarray(np.max(every, axis=0))
    if any(share is None for share in shares):
        raise refuse("poses", _("missing share; the mean over the conditions depends on it"), "missing")
    weight = np.asarray(shares, dtype=float)
    if not np.any(weight):
        raise refuse("duty.cases", _("no load case has a share; how long each of them lasts is not known"), "missing")
    total = np.tensordot(weight, every, axes=1)
    return np.asarray(total if how == "sum" else total / np.sum(weight))
