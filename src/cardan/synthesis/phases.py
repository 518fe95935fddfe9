"""Which yoke angles make a drive synchronous, or as even as it can be?"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from cardan.analysis.equivalence import SYNCHRONOUS as EVEN
from cardan.drive.chain import chain
from cardan.drive.drive import Drive
from cardan.errors import Problem, check
from cardan.maths import polygon
from cardan.maths.arrays import Array
from cardan.texts import _

from .blocks import Blocks, blocks
from .goal import NEAREST, SYNCHRONOUS, Choice, Goal, LeastIntermediate
from .setting import YokeSetting, settings


@dataclass(frozen=True, eq=False, kw_only=True)
class Phasing:
    """What the yoke angles of a drive can do.

    Attributes
    ----------
    as_built : YokeSetting
        The drive as described.
    feasible : bool
        Whether the free yokes can make it synchronous, exactly and in all harmonics.
    irregularity_min, irregularity_max : float
        δ that the free yokes can reach, and everything between.
    bend_min, bend_max : float [rad]
        The same as equivalent angles.
    free, fixed : tuple of int
        Numbers of the shafts whose yokes may be turned, and of those held.
    settings : tuple of YokeSetting
        Exact optima, best by the goal first: a setting and its mirror image, and what else the goal found.
    spline_settings : tuple of YokeSetting
        Best settings and runners-up that spline teeth allow; empty where no shaft has ``spline.teeth``.
    limiting_joint : int or None
        Number of the joint whose bend is too large for the others, where not feasible.
    limiting_joints : tuple of int
        The same with the joints that held yokes tie to it.
    """

    as_built: YokeSetting
    feasible: bool
    irregularity_min: float
    irregularity_max: float
    bend_min: float
    bend_max: float
    free: tuple[int, ...]
    fixed: tuple[int, ...]
    settings: tuple[YokeSetting, ...]
    spline_settings: tuple[YokeSetting, ...] = ()
    limiting_joint: int | None = None
    limiting_joints: tuple[int, ...] = ()


def phases(
    drive: Drive,
    *,
    fixed: Mapping[int, float] | None = None,
    goal: Goal = SYNCHRONOUS,
    progress: Callable[[float], object] | None = None,
) -> Phasing:
    """Return the yoke angles that make a drive synchronous, or as even as it can be, with the proof.

    Parameters
    ----------
    drive : Drive
        The drive; shafts with ``yoke_fixed`` keep their yoke angles.
    fixed : mapping of int to float, optional
        Shaft number -> yoke angle to hold [rad].
    goal : Goal
        What to choose where synchronism leaves a choice.
    progress : function, optional
        Called with the share done.

    Returns
    -------
    Phasing

    Raises
    ------
    InputError
        ``fixed`` names a shaft that has no yokes to set, or a value that is not finite.

    Notes
    -----
    Exact: with L_i = -ln cos α_i the drive can be synchronous if and only if the largest L is no more than the sum of
    the others. Joints with held yokes between them count as one. Replaces the first-order Book (77)-(86).

    Examples
    --------
    >>> from cardan.units import deg
    >>> found = phases(Drive.from_angles([10 * deg, 15 * deg, 17 * deg]))
    >>> found.feasible, [s.irregularity < 1e-14 for s in found.settings]
    (True, [True, True])
    """
    whole = chain(drive)
    as_built = np.asarray(whole.yoke_angle)
    held = _held(drive, fixed or {})
    start = as_built.copy()
    for number, angle in held.items():
        start[number - 2] = angle
    free = [k for k in range(whole.joints - 1) if k + 2 not in held]
    figure = blocks(whole, start, free)
    low, high = polygon.reach(figure.lengths)
    feasible = 2.0 * math.sinh(low) <= EVEN
    choice = Choice(chain=whole, as_built=as_built, weight=_weights(drive))
    rows, names = _optima(figure, choice, goal, family=feasible and len(free) > 2)
    limiting = () if feasible else figure.joints[int(np.argmax(figure.lengths))]
    return Phasing(
        as_built=settings(whole, as_built[None], [_("as built")], as_built)[0],
        feasible=feasible,
        irregularity_min=2.0 * math.sinh(low),
        irregularity_max=2.0 * math.sinh(high),
        bend_min=_bend(low),
        bend_max=_bend(high),
        free=tuple(k + 2 for k in free),
        fixed=tuple(sorted(held)),
        settings=settings(whole, rows, names, as_built) if whole.joints > 1 else (),
        limiting_joint=max(limiting, key=lambda i: whole.bend[i]) + 1 if limiting else None,
        limiting_joints=tuple(i + 1 for i in limiting),
    )


def _bend(length: float) -> float:
    return 2.0 * math.atan(math.sqrt(math.tanh(0.5 * length)))


def _weights(drive: Drive) -> Array:
    return np.asarray([shaft.weight for shaft in drive.shafts[1:-1]], dtype=float)


def _held(drive: Drive, fixed: Mapping[int, float]) -> dict[int, float]:
    """Return shaft number -> held yoke angle, from the drive and from ``fixed``."""
    n = len(drive.joints)
    problems = []
    for number, angle in fixed.items():
        if not 2 <= number <= n:
            between = _("shafts 2 to {last} have").format(last=n) if n > 1 else _("this drive has no such shaft")
            problems.append(
                Problem(
                    f"fixed[{number}]",
                    _("shaft {number} has no two yokes to set; {between}").format(number=number, between=between),
                )
            )
        if not math.isfinite(angle):
            problems.append(Problem(f"fixed[{number}]", _("{angle} is not a finite angle").format(angle=angle)))
    check(problems)
    own = {shaft.number: shaft.yoke_angle for shaft in drive.shafts[1:-1] if shaft.yoke_fixed}
    return {**own, **{number: float(angle) for number, angle in fixed.items()}}


def _optima(figure: Blocks, choice: Choice, goal: Goal, *, family: bool) -> tuple[Array, list[str]]:
    """Return the sets of yoke angles to show and their names."""
    aims = None
    if family and isinstance(goal, LeastIntermediate):
        weight = choice.weight if goal.weights is None else np.asarray(goal.weights)
        aims = polygon.shortest_diagonals(figure.lengths, [*weight.tolist(), 0.0], 0.0)
    rows = figure.closed(aims)
    nearest = int(np.argmin(NEAREST.cost(choice, rows)))
    rows = rows[nearest - nearest % 2 : nearest - nearest % 2 + 2]
    return rows, ["A", "B"][: len(rows)]


__all__ = ["NEAREST", "SYNCHRONOUS", "Phasing", "YokeSetting", "phases"]
