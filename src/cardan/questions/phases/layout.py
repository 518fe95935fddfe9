"""Where should the joints stand so that the drive can be synchronous with the smallest joint angles?"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.fields.validity import axis_points
from cardan.drive.models.geometry import geometry
from cardan.drive.models.laws import refuse_kinds
from cardan.errors import Problem, check, refuse
from cardan.maths.arrays import Array
from cardan.texts import _

from .goal import SYNCHRONOUS, Goal
from .layout_search import Search, best_points
from .phases import Phasing, phases


class Status(StrEnum):
    """How a layout search ended."""

    CONVERGED = "converged"
    CANCELLED = "cancelled"
    INFEASIBLE = "infeasible"


@dataclass(frozen=True, eq=False, kw_only=True)
class Layout:
    """A drive with its joints moved within their boxes.

    Attributes
    ----------
    drive : Drive
        The drive in its new layout, with the best yoke angles set.
    points : array (n+2, 3) [m]
        Input point, joint centres, output point.
    joint_angle_before, joint_angle : array (n,) [rad]
        Bends as described and in the new layout.
    length_before, length : array (n+1,) [m]
        Shaft lengths as described and in the new layout.
    moved : array (n,) [m]
        How far each joint moved.
    speed_fluctuation : float
        δ of the new drive.
    feasible : bool
        Whether the new drive is synchronous.
    phasing : Phasing
        All yoke settings of the new layout.
    status : Status
        CONVERGED; INFEASIBLE when no layout in the boxes can be synchronous (the most even one is returned);
        CANCELLED when ``progress`` stopped the search (the best so far is returned).
    """

    drive: Drive
    points: Array
    joint_angle_before: Array
    joint_angle: Array
    length_before: Array
    length: Array
    moved: Array
    speed_fluctuation: float
    feasible: bool
    phasing: Phasing
    status: Status


def layout(
    drive: Drive,
    *,
    weights: Sequence[float] | None = None,
    shortest: float | None = None,
    goal: Goal = SYNCHRONOUS,
    progress: Callable[[float], object] | None = None,
) -> Layout:
    """Return the joint centres within ``move_within`` that allow a synchronous drive with the smallest bends.

    Parameters
    ----------
    drive : Drive
        Given by points; at least one joint has a box ``move_within``. Shafts with ``yoke_fixed`` keep their yokes.
    weights : sequence of n floats, optional
        Minimise Σ w (2 sin α/2)² over the joints; the largest joint angle by default, and then the sum with equal
        weights among the layouts that have it.
    shortest : float, optional
        Least distance between neighbouring points [m]; by default a fifth of what it is as described.
    goal : Goal
        What to choose where synchronism leaves a choice of yoke angles.
    progress : function, optional
        Called with the share done; answering "stop" ends the search.

    Returns
    -------
    Layout

    Raises
    ------
    InputError
        The drive is not given by points, no joint has a box, ``weights`` has the wrong length, or no drive
        fits the boxes.

    See Also
    --------
    phases

    Notes
    -----
    Sought are the smallest joint angles under L_i ≤ Σ L_j of the others, L = -ln cos α, for every joint i (joints with
    held yokes between them count as one): the exact condition of `phases`. Sequential quadratic programming from
    several starts, always the same ones; the answer is a minimum near one of them.

    Examples
    --------
    >>> from cardan.drive.joints import Hooke
    >>> start = Drive.from_points([(-1, 0, 0), (0, 0, 0), (1, 0, 0.1), (2, 0, 0.4)])
    >>> free = Hooke(centre=(1.0, 0.0, 0.1), move_within=((1.0, 1.0), (0.0, 0.0), (0.0, 0.4)))
    >>> found = layout(replace(start, joints=(start.joints[0], free)))
    >>> found.feasible, found.status.value
    (True, 'converged')
    """
    refuse_kinds(drive, _("layout"))
    check(_problems(drive, weights, shortest))
    before = geometry(drive)
    low, high = _boxes(drive)
    shorts = 0.2 * before.length if shortest is None else np.full(len(drive.joints) + 1, shortest)
    yokes = np.asarray([shaft.yoke_angle for shaft in drive.shafts[1:-1]], dtype=float)
    free = tuple(k for k, shaft in enumerate(drive.shafts[1:-1]) if not shaft.yoke_fixed)
    search = Search(
        points=np.asarray(axis_points(drive), dtype=float),
        low=low,
        high=high,
        shortest=shorts,
        yoke_angle=yokes,
        free=free,
        weights=None if weights is None else np.asarray(weights, dtype=float),
    )
    points, complete = best_points(search, progress)
    if complete and not search.possible(points):
        text = _("nowhere within the boxes does every joint angle less than 90° and every shaft have its least length")
        raise refuse("joints", text)
    joints = tuple(
        replace(joint, centre=tuple(float(x) for x in centre))  # type: ignore[arg-type]
        for joint, centre in zip(drive.joints, points[1:-1], strict=True)
    )
    moved = replace(drive, joints=joints)
    phasing = phases(moved, goal=goal, poses={})
    if phasing.settings:
        best = phasing.settings[0]
        shafts = [moved.shafts[0], *moved.shafts[1:-1], moved.shafts[-1]]
        for k, angle in enumerate(best.yoke_angle.tolist()):
            if k in free:
                shafts[k + 1] = replace(shafts[k + 1], yoke_angle=angle)
        moved = replace(moved, shafts=tuple(shafts))
    after = geometry(moved)
    left = phasing.settings[0].speed_fluctuation if phasing.settings else phasing.as_built.speed_fluctuation
    ended = Status.CONVERGED if phasing.feasible else Status.INFEASIBLE
    return Layout(
        drive=moved,
        points=after.points,
        joint_angle_before=before.joint_angle,
        joint_angle=after.joint_angle,
        length_before=before.length,
        length=after.length,
        moved=np.linalg.norm(after.points - before.points, axis=-1)[1:-1],
        speed_fluctuation=left,
        feasible=phasing.feasible,
        phasing=phasing,
        status=ended if complete else Status.CANCELLED,
    )


def _boxes(drive: Drive) -> tuple[Array, Array]:
    """Return the lower and upper corners of where each joint may stand, arrays (n, 3) [m]."""
    low, high = [], []
    for joint in drive.joints:
        box = joint.move_within or tuple((x, x) for x in joint.centre or ())
        low.append([side[0] for side in box])
        high.append([side[1] for side in box])
    return np.asarray(low, dtype=float), np.asarray(high, dtype=float)


def _problems(drive: Drive, weights: Sequence[float] | None, shortest: float | None) -> list[Problem]:
    n = len(drive.joints)
    found = []
    if drive.form != "points":
        found.append(
            Problem("joints", _("layout moves joint centres; this drive is given by {form}").format(form=drive.form))
        )
    if all(joint.move_within is None for joint in drive.joints):
        found.append(Problem("joints", _("no joint has a box move_within in which layout may put it")))
    if weights is not None and (len(weights) != n or not all(w >= 0.0 for w in weights) or not any(weights)):
        found.append(Problem("weights", _("{n} weights of at least 0, not all 0, are needed").format(n=n)))
    if shortest is not None and not shortest > 0.0:
        found.append(Problem("shortest", _("{value} m is not a length above 0").format(value=shortest)))
    return found
