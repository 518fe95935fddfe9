"""Synchronous yokes of many drives at once."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.drives import Drives, kinematics
from cardan.drive.fields.validity import wrong_count
from cardan.drive.models.kinematics_model import Chain
from cardan.errors import Problem, check
from cardan.maths.arrays import Array, namespace
from cardan.maths.kernel import mobius, polygon
from cardan.questions.motion.equivalence import SYNCHRONOUS as EVEN
from cardan.texts import _

from .setting import wrapped


@dataclass(frozen=True, eq=False, kw_only=True)
class YokeAngles:
    """Best yoke angles of each drive of a batch.

    Attributes
    ----------
    yoke_angle : array (..., n-1) [rad]
        γ of shafts 2 … n in (-π/2, π/2].
    speed_fluctuation : array (...)
        δ that they leave.
    feasible : bool array (...)
        Whether the drive is synchronous with them.
    speed_fluctuation_min, speed_fluctuation_max : array (...)
        δ that the yokes of the drive can reach, by the lengths alone.
    """

    yoke_angle: Array
    speed_fluctuation: Array
    feasible: Array
    speed_fluctuation_min: Array
    speed_fluctuation_max: Array


def synchronous_yokes(
    drive: Drive | Drives | Chain,
    *,
    fixed: Sequence[int] = (),
    weights: Sequence[float] | None = None,
    mirror: bool = False,
) -> YokeAngles:
    """Return the yoke angles that make each drive synchronous, or as even as it can be.

    Parameters
    ----------
    drive : Drive or Drives (...)
        One drive, or many as arrays.
    fixed : sequence of int
        Numbers of the shafts whose yokes stay as they are.
    weights : sequence of n-1 floats, optional
        Weights of shafts 2 … n: of all synchronous settings take the one with the least Σ w δ over them (equal
        weights by default). With yokes held, take the shortest diagonals side by side.
    mirror : bool
        Take the mirror image of the polygon.

    Returns
    -------
    YokeAngles

    Raises
    ------
    InputError
        ``fixed`` names a shaft that has no two yokes, or ``weights`` has the wrong length.

    See Also
    --------
    phases

    Notes
    -----
    No loop over drives, no iteration for up to four joints. A yoke that changes nothing keeps its angle. `phases` looks
    further: at all foldings, spline teeth, poses.

    Examples
    --------
    >>> from cardan.sweeps import Drives, synchronous_yokes
    >>> drives = Drives.from_angles([[0.2, 0.3, 0.25], [0.1, 0.1, 0.4]])
    >>> synchronous_yokes(drives).feasible
    array([ True, False])
    """
    chain = kinematics(drive)
    n = chain.joints
    _check(n, fixed, weights)
    single = isinstance(chain.joint_angle, np.ndarray) and chain.joint_angle.ndim == 1
    joint_angles, twists, yokes = (
        _columns(x, single) for x in (chain.joint_angle, chain.plane_twist, chain.yoke_angle)
    )
    between = [0.5 * math.pi - t for t in twists]
    sides: list[mobius.Pair] = []
    free: list[int] = []
    for i, joint_angle in enumerate(joint_angles):
        joint = mobius.hooke(joint_angle)
        if i and i + 1 in fixed:
            held = mobius.turn(between[i - 1] - yokes[i - 1])
            sides[-1] = mobius.compose(joint, mobius.compose(held, sides[-1]))
            continue
        sides.append(joint)
        if i:
            free.append(i - 1)
    lengths = [mobius.length(side) for side in sides]
    low, high = polygon.reach(lengths)
    aims = None
    if len(sides) == n:
        each = [1.0] * (n - 1) if weights is None else [float(w) for w in weights]
        aims = polygon.shortest_diagonals(lengths, [*each, 0.0], low)
    closure = polygon.close(
        sides,
        end=low,
        aims=aims,
        folds=[1.0 if mirror else -1.0] * len(sides),
        keep=[between[k] - yokes[k] for k in free],
    )
    for k, turn in zip(free, closure.turns, strict=True):
        yokes[k] = between[k] - turn
    xp = namespace(low)
    found: Array = [wrapped(yoke) for yoke in yokes]
    left, least, most = mobius.speed_fluctuation(closure.pair), 2.0 * xp.sinh(low), 2.0 * xp.sinh(high)
    if single:
        found, left, least, most = np.asarray(found), np.asarray(left), np.asarray(least), np.asarray(most)
    elif found:
        found = xp.stack(found, axis=-1)
    else:
        found = chain.yoke_angle
    return YokeAngles(
        yoke_angle=found,
        speed_fluctuation=left,
        feasible=least <= EVEN,
        speed_fluctuation_min=least,
        speed_fluctuation_max=most,
    )


def _columns(table: Array, single: bool) -> list[Array]:
    """Return the columns of an array (..., k), as plain numbers when there is a single row."""
    return list(table.tolist()) if single else [table[..., k] for k in range(table.shape[-1])]


def _check(joints: int, fixed: Sequence[int], weights: Sequence[float] | None) -> None:
    problems = [
        Problem(
            f"fixed[{k}]",
            _("shaft {number} has no two yokes; the shafts between joints are 2 to {last}").format(
                number=number, last=joints
            ),
        )
        for k, number in enumerate(fixed)
        if not 2 <= number <= joints
    ]
    if weights is not None:
        problems += wrong_count("weights", weights, joints - 1)
    check(problems)
