"""The conditions in which a drive runs: as drawn or in a pose, at a speed, with a torque, for a share of the time.

A question answers for one condition; how it gathers over all of them is declared beside it, see
`cardan.answers.question.Question.gathers`. The conditions of a drive are made here, once, from its file.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from cardan.answers.question import Gathering
from cardan.errors import refuse
from cardan.maths.arrays import Array, ArrayLike, floats
from cardan.texts import _

from .drive import Drive
from .fields.paths import pose_drives


@dataclass(frozen=True, kw_only=True)
class Condition:
    """One way in which a drive runs.

    Attributes
    ----------
    drive : Drive
        Its geometry there, with speed and torque of the condition as its duty; without poses and parts of a duty cycle.
    pose : str
        Name of the pose; empty as drawn.
    part : int
        Number of the part of the duty cycle, from 1; 0 where there is none.
    share : float or None
        Share of the whole time; None where the file does not say.
    moving : bool
        Whether the drive moves while it runs so, and each instant is a geometry of its own.
    """

    drive: Drive
    pose: str = ""
    part: int = 0
    share: float | None = 1.0
    moving: bool = False

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
        part = _("part {number} of the duty cycle").format(number=self.part) if self.part else ""
        return ", ".join(word for word in (pose, part) if word)


def conditions(drive: Drive) -> tuple[Condition, ...]:
    """Return every condition of a drive, as drawn before its poses, the parts of a duty cycle in each.

    Parameters
    ----------
    drive : Drive
        With its poses, its movements and its duty.

    Returns
    -------
    tuple of Condition
        As drawn first. The poses take their shares, and the drive as drawn what they leave; where a pose has no share,
        that of the drive as drawn and of each such pose is not known.

    Raises
    ------
    InputError
        A pose changes what is not there, or makes no drive; the path names the pose.

    Examples
    --------
    >>> from cardan.drive.duty import Block, Duty
    >>> parts = (Block(torque=900.0, speed=30.0, share=0.2), Block(torque=300.0, speed=200.0, share=0.8))
    >>> drive = replace(Drive.from_angles([0.1, 0.1]), duty=Duty(blocks=parts))
    >>> [(one.name, one.torque, one.share) for one in conditions(drive)]
    [('part 1 of the duty cycle', 900.0, 0.2), ('part 2 of the duty cycle', 300.0, 0.8)]
    """
    shares = [pose.share for pose in drive.poses]
    known = [share for share in shares if share is not None]
    rest = max(0.0, 1.0 - sum(known)) if len(known) == len(shares) else None
    drawn = replace(drive, poses=())
    found = [*_parts(Condition(drive=drawn, share=rest, moving=bool(drive.movements)))]
    for k, (pose, posed) in enumerate(zip(drive.poses, pose_drives(drive), strict=True), start=1):
        one = Condition(drive=posed, pose=pose.name or str(k), share=pose.share, moving=bool(posed.movements))
        found += _parts(one)
    return tuple(found)


def gathered(how: Gathering, values: ArrayLike, shares: Sequence[float | None]) -> Array:
    """Return what answers over conditions come to.

    Parameters
    ----------
    how : str
        One of `Gathering`.
    values : array (c, ...)
        An answer for each condition.
    shares : sequence of float or None
        Share of the time of each.

    Returns
    -------
    array (...), or (c, ...) for ``"each"``

    Raises
    ------
    InputError
        A mean or a sum over conditions whose shares are not known.

    Examples
    --------
    >>> print(gathered("mean", [10.0, 20.0], [0.25, 0.75]))
    17.5
    """
    (every,) = floats(values)
    if how == "each":
        return every
    if how == "worst":
        return np.asarray(np.max(every, axis=0))
    if any(share is None for share in shares):
        raise refuse("poses", _("missing share; the mean over the conditions depends on it"), "missing")
    weight = np.asarray(shares, dtype=float)
    total = np.tensordot(weight, every, axes=1)
    return np.asarray(total if how == "sum" else total / np.sum(weight))


def _parts(whole: Condition) -> list[Condition]:
    """Return a condition in the parts of its duty cycle; itself where it has none."""
    duty = whole.drive.duty
    if not duty.blocks:
        return [whole]
    found = []
    for number, block in enumerate(duty.blocks, start=1):
        steady = replace(duty, blocks=(), torque=block.torque, speed=block.speed, torque_at="output")
        share = None if whole.share is None else whole.share * block.share
        found.append(replace(whole, drive=replace(whole.drive, duty=steady), part=number, share=share))
    return found
