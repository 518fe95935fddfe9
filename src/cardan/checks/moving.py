"""What the movements of a drive and its poses make of its joints."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from cardan.answers.quantity import Joined, Quantity, Text, say
from cardan.drive.conditions import in_poses
from cardan.drive.fields.paths import bare_path
from cardan.maths.arrays import Array
from cardan.questions.motion.standing import steepest, still
from cardan.texts import _

from .design import Design
from .verdict import Verdict, joined

WORSE = 1.0 + 1e-9
"""A pose is worse than another from here on; less is rounding."""

NOISE = 1e-12
"""Share of a limit that comes from rounding alone."""


def largest_joint_angle(design: Design, i: int) -> Array | float:
    """Return the largest angle of a joint while the drive moves, counted from 0 (...) [rad]; 0 where nothing moves."""
    return design.moving_joint_angle[..., i] if design.drive.movements else 0.0


def at_its_most(design: Design, ask: Callable[[Array], Array]) -> tuple[Array, str]:
    """Return the largest answers on the joint angles, as drawn and moving (..., k), and a word where it moves.

    design: of Hooke joints; ask: from bends (..., n) [rad] to answers (..., k).
    """
    drawn = ask(design.joint_angle)
    moved = design.while_moving(lambda chain: ask(chain.joint_angle))
    if moved is None:
        return drawn, ""
    return np.maximum(drawn, moved), _("while the drive moves") if np.all(moved > drawn * WORSE) else ""


def posed(design: Design) -> list[tuple[str, Design]]:
    """Return the name of every pose of a drive and the design in it; what the pose sets does not vary there."""
    found = []
    stands = in_poses(design.drive)[1:] if design.drive.poses else ()
    for pose, stand in zip(design.drive.poses, stands, strict=True):
        own = [bare_path(design.drive, path) for path, _value in pose.set]
        varied = {
            path: values
            for path, values in design.varied.items()
            if not any(path == one or path.startswith((f"{one}[", f"{one}.")) for one in own)
        }
        one = stand.drive
        found.append(
            (stand.pose, replace(design, drive=one, duty=one.duty, varied=varied, drawn=design, pose=stand.pose))
        )
    return found


def stood(design: Design) -> list[tuple[Text, Design]]:
    """Return the design in every pose, and which that is."""
    return [(_("in the pose {name}").format(name=name), one) for name, one in posed(design)]


def stopped(design: Design) -> list[tuple[Text, Design]]:
    """Return the design as drawn and in every pose at the instants of its movements at which a joint bends most.

    Where the geometry varies, there are no such instants.
    """
    found: list[tuple[Text, Design]] = []
    for pose, one in (("", design), *stood(design)):
        for time in steepest(one.drive) if one.drive.movements and not one.replaced else ():
            here = still(one.drive, time)
            at = say(_("at {time} of the movement"), time=Quantity(time, "time", 3, trim=True))
            other = replace(one, drive=here, duty=here.duty, drawn=design.drawn or design)
            found.append((Joined([pose, at]), other))
    return found


def stands(design: Design) -> list[tuple[float, Design]]:
    """Return the share of the time of every pose with the design in it; each counts wholly where no share is known."""
    if not design.drive.poses:
        return [(1.0, design)]
    shares = [one.share for one in in_poses(design.drive)]
    every = [design, *(one for _name, one in posed(design))]
    return [(1.0 if share is None else share, one) for share, one in zip(shares, every, strict=True)]


def worst_of_poses(drawn: Sequence[Verdict], poses: Sequence[tuple[Text, Sequence[Verdict]]]) -> tuple[Verdict, ...]:
    """Return for each verdict the worst of the drive as drawn and in its poses, with a word on which pose it is.

    drawn: of the drive as drawn, or of many.
    poses, sequence of (Text, sequence of Verdict): which pose or instant it is, and the verdicts there.
    """
    found = []
    for one in drawn:
        worst = one
        for said, verdicts in poses:
            other = next((its for its in verdicts if (its.check, its.title) == (one.check, one.title)), None)
            if other is None or not other.run:
                continue
            worst = _worse(worst, other, said) if worst.run else replace(other, note=joined(other.note, said))
        found.append(worst)
    return tuple(found)


def _worse(worst: Verdict, other: Verdict, said: Text) -> Verdict:
    """Return the worse of two verdicts, of many drives place by place; the other one with a word on its pose."""
    worse = np.asarray(other.utilisation > np.asarray(worst.utilisation) * WORSE + NOISE)
    if not np.any(worse):
        return worst
    if np.all(worse):
        return replace(other, note=joined(other.note, said))
    limit: Any = np.where(worse, other.limit, worst.limit)
    if isinstance(other.limit, tuple) and isinstance(worst.limit, tuple):
        limit = tuple(np.where(worse, *ends) for ends in zip(other.limit, worst.limit, strict=True))
    return replace(worst, value=np.where(worse, other.value, worst.value), limit=limit)
