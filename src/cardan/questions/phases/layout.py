"""Where should the joints stand so that the drive can be synchronous with the smallest joint angles?"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property
from typing import Any

import numpy as np
import scipy

from cardan.answers.quantity import Text
from cardan.drive.drive import Drive
from cardan.drive.fields.validity import axis_points
from cardan.drive.models.geometry import Geometry, geometry, geometry_from_points
from cardan.drive.models.kinematics_model import Chain, refuse_kinds
from cardan.errors import Problem, check, refuse
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames, mobius
from cardan.texts import _

from .layout_conditions import CLOSED, ConditionSearch, Over, best_in_conditions, placed
from .phases import Phasing, phases
from .setting import SYNCHRONOUS, Goal


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
        Joint angles as described and in the new layout.
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
    conditions : tuple of ConditionAfter
        What becomes of every pose and instant of a movement; empty where the drive has neither.
    over : str
        Of what the least was sought in them, ``"worst"`` or ``"mean"``.
    kept : tuple of int
        Numbers of the joints with a box that some pose puts elsewhere by itself.
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
    conditions: tuple[ConditionAfter, ...] = ()
    over: Over = "worst"
    kept: tuple[int, ...] = ()


@dataclass(frozen=True, kw_only=True)
class ConditionAfter:
    """What the layout makes of one condition."""

    name: Text
    share: float  # of the time, in the mean
    speed_fluctuation_before: float  # δ with joints and yokes as described
    speed_fluctuation: float
    joint_angle_before: float  # [rad]: largest of the joints
    joint_angle: float  # [rad]


def layout(
    drive: Drive,
    *,
    weights: Sequence[float] | None = None,
    shortest: float | None = None,
    goal: Goal = SYNCHRONOUS,
    over: Over = "worst",
    progress: Callable[[float], object] | None = None,
) -> Layout:
    """Return the joint centres within ``move_within`` that allow a synchronous drive with the smallest joint angles.

    Of a drive with poses, movements or spline teeth they are those with the least speed fluctuation in all of these.

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
    over : str
        Whether the speed fluctuation is to be least in the ``"worst"`` pose and instant of the movements, or in their
        ``"mean"`` over the time.
    progress : function, optional
        Called with the share done; answering "stop" ends the search.

    Returns
    -------
    Layout

    Raises
    ------
    InputError
        The drive is not given by points, no joint has a box, ``weights`` has the wrong length or stands beside poses,
        movements or teeth, or no drive fits the boxes.

    See Also
    --------
    phases

    Notes
    -----
    Sought are the smallest joint angles under L_i ≤ Σ L_j of the others, L = -ln cos α, for every joint i (joints with
    held yokes between them count as one): the exact condition of `phases`. Sequential quadratic programming from
    several starts, always the same ones; the answer is a minimum near one of them. With poses, movements or teeth
    joint centres and yoke angles are sought together, for the least speed fluctuation first, then for the smallest
    largest joint angle in any condition; a centre that a pose sets stays there in that pose.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from cardan import Drive, layout
    >>> from cardan.joints import Hooke
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
    teeth = {k: drive.shafts[k + 1].spline.teeth for k in free if drive.shafts[k + 1].spline}  # type: ignore[union-attr]
    teeth = {k: z for k, z in teeth.items() if z is not None}
    if drive.poses or drive.movements or teeth:
        check(_beside_conditions(weights))
        conditions = ConditionSearch(
            conditions=placed(drive),
            low=low,
            high=high,
            shortest=shorts,
            yoke_angle=yokes,
            free=free,
            teeth=teeth,  # type: ignore[arg-type]
            over=over,
        )
        return _in_conditions(drive, before, conditions, progress)
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
        raise _nowhere()
    moved = _moved(drive, points[1:-1])
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


def _beside_conditions(weights: Sequence[float] | None) -> list[Problem]:
    text = _("weights of the joint angles cannot be given beside poses, movements or spline teeth")
    return [] if weights is None else [Problem("weights", text)]


def _in_conditions(
    drive: Drive, before: Geometry, search: ConditionSearch, progress: Callable[[float], object] | None
) -> Layout:
    """Return the layout that is best in all poses, instants of movements and places of the teeth."""
    drawn = np.where(search.loose, search.high - search.low, 1.0)
    drawn = np.clip((before.points[1:-1] - search.low) / drawn, 0.0, 1.0)[search.loose]
    x, yokes, complete = best_in_conditions(search, drawn, progress)
    if complete and not search.possible(x):
        raise _nowhere()
    shafts = tuple(
        replace(shaft, yoke_angle=float(yokes[k])) if (k := shaft.number - 2) in search.free else shaft
        for shaft in drive.shafts
    )
    moved = replace(_moved(drive, search.centres(x)), shafts=shafts)
    after = geometry(moved)
    phasing = phases(moved)
    chosen = replace(phasing.as_built, label=_("layout"))
    ways = zip(search.fluctuations(drawn, search.yoke_angle), search.fluctuations(x, yokes), strict=True)
    steep = [np.arccos(1.0 - np.max(search.measured(one)[0], axis=-1)) for one in (drawn, x)]
    every = tuple(
        ConditionAfter(
            name=one.name,
            share=one.share,
            speed_fluctuation_before=float(was),
            speed_fluctuation=float(now),
            joint_angle_before=float(steep[0][k]),
            joint_angle=float(steep[1][k]),
        )
        for k, (one, (was, now)) in enumerate(zip(search.conditions, ways, strict=True))
    )
    feasible = all(one.speed_fluctuation <= CLOSED for one in every)
    return Layout(
        drive=moved,
        points=after.points,
        joint_angle_before=before.joint_angle,
        joint_angle=after.joint_angle,
        length_before=before.length,
        length=after.length,
        moved=np.linalg.norm(after.points - before.points, axis=-1)[1:-1],
        speed_fluctuation=chosen.speed_fluctuation,
        feasible=feasible,
        phasing=replace(phasing, settings=(chosen,), spline_settings=(), pose_settings=(), steering=()),
        status=(Status.CONVERGED if feasible else Status.INFEASIBLE) if complete else Status.CANCELLED,
        conditions=every,
        over=search.over,
        kept=tuple(
            i + 1
            for i in range(len(drive.joints))
            if any(bool(np.any(search.loose[i] & ~one.follows[i])) for one in search.conditions)
        ),
    )


def _moved(drive: Drive, centres: Array) -> Drive:
    """Return a drive with other joint centres (n, 3) [m]."""
    joints = tuple(
        replace(joint, centre=tuple(float(x) for x in centre))  # type: ignore[arg-type]
        for joint, centre in zip(drive.joints, centres, strict=True)
    )
    return replace(drive, joints=joints)


def _nowhere() -> Exception:
    text = _("nowhere within the boxes does every joint angle less than 90° and every shaft have its least length")
    return refuse("joints", text)


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


# The search behind `layout`: smallest joint angles under the polygon's triangle inequality.

STARTS = 16
"""Layouts from which the search starts: as described, the middle of all boxes, the others spread at random."""

STEEP = 0.99
"""Largest 1 - cos α that the search looks at; just below a right angle."""

SHUT = 1e-7
"""By how much [-] of its size a constraint may miss and count as kept; `_closed` then closes it to rounding."""

STEP = 1e-6
"""Step of the difference quotients, share of a box."""

OPTIONS: Any = {"maxiter": 60, "ftol": 1e-10}


@dataclass(frozen=True, eq=False, kw_only=True)
class Search:
    """What is given and what may change."""

    points: Array  # (n+2, 3) [m]: the drive as described
    low: Array  # low, high (n, 3) [m]: corners of the joints' boxes
    high: Array  # (n, 3) [m]
    shortest: Array  # (n+1,) [m]: least length of each shaft
    yoke_angle: Array  # (n-1,) [rad]: held yoke angles; the others do not matter
    free: tuple[int, ...]  # indices 0 … n-2 of the yokes that may be turned
    weights: Array | None  # (n,): of the joints' bends; None minimises the largest

    @cached_property
    def loose(self) -> Array:
        """Coordinates of the joints that can move, mask (n, 3)."""
        return np.asarray(self.high > self.low)

    def placed(self, x: Array) -> Array:
        """Return the points for shares (..., v) of the boxes in [0, 1], array (..., n+2, 3)."""
        centre = np.array(np.broadcast_to(self.low, (*x.shape[:-1], *self.low.shape)))
        wide = (self.high - self.low)[self.loose]
        centre[..., self.loose] = self.low[self.loose] + x * wide
        whole = np.array(np.broadcast_to(self.points, (*x.shape[:-1], *self.points.shape)))
        whole[..., 1:-1, :] = centre
        return whole

    def share(self, points: Array) -> Array:
        """Return the shares of the boxes nearest to given points, array (v,)."""
        wide = np.where(self.loose, self.high - self.low, 1.0)
        return np.clip((points[1:-1] - self.low) / wide, 0.0, 1.0)[self.loose]

    def measured(self, x: Array) -> tuple[Array, Array, Array]:
        """Return versines 1 - cos α (..., n), polygon sides (..., m) and shaft lengths (..., n+1)."""
        points = self.placed(x)
        shaft = points[..., 1:, :] - points[..., :-1, :]
        length = frames.norm(shaft)
        axis = shaft / np.maximum(length, 1e-12)[..., None]
        step = axis[..., 1:, :] - axis[..., :-1, :]
        versine = 0.5 * frames.dot(step, step)
        single = -np.log1p(-np.minimum(versine, STEEP))
        n = single.shape[-1]
        if len(self.free) == n - 1:
            return versine, single, length
        return versine, self._merged(points, single, versine), length

    def _merged(self, points: Array, single: Array, versine: Array) -> Array:
        """Return the lengths of the polygon's sides where held yokes tie joints together."""
        steep = np.any(versine > STEEP, axis=-1)
        sides = self._sides(np.where(steep[..., None, None], self.points, points))
        merged = np.stack([mobius.length(side) for side in sides], axis=-1)
        return np.where(steep[..., None], np.sum(single, axis=-1)[..., None], merged)

    def _sides(self, points: Array) -> list[mobius.Pair]:
        """Return the sides of the polygon: joints with held yokes between them are one."""
        place = geometry_from_points(points)
        turn = Chain(
            joint_angle=place.joint_angle,
            plane_twist=place.plane_twist,
            yoke_angle=self.yoke_angle,
            start_phase=np.asarray(0.0),
        ).turn_before
        sides: list[mobius.Pair] = []
        for i in range(place.joint_angle.shape[-1]):
            joint = mobius.hooke(place.joint_angle[..., i])
            if i == 0 or i - 1 in self.free:
                sides.append(joint)
            else:
                sides[-1] = mobius.compose(mobius.compose(joint, mobius.turn(turn[..., i])), sides[-1])
        return sides

    @property
    def tied(self) -> bool:
        """Whether all yokes are held, so that the polygon has a single side."""
        return len(self.low) > 1 and not self.free

    def end(self, x: Array) -> Array:
        """Return where the polygon ends when all yokes are held, array (..., 2); smooth where `gap` has a corner."""
        points = self.placed(x)
        versine, lengths, _length = self.measured(x)
        steep = np.any(versine > STEEP, axis=-1)[..., None]
        _a, b = self._sides(np.where(steep[..., None], self.points, points))[0]
        return np.where(steep, lengths, np.stack((b.real, b.imag), axis=-1))

    def possible(self, points: Array) -> bool:
        """Tell whether points within the boxes make a drive whose shafts are long enough."""
        return bool(np.isfinite(_rank(self, self.share(points))[0]))

    def gap(self, x: Array) -> Array:
        """Return by how much the longest side exceeds the sum of the others, negative when it does not."""
        sides = self.measured(x)[1]
        return 2.0 * np.max(sides, axis=-1) - np.sum(sides, axis=-1)


def best_points(search: Search, progress: Callable[[float], object] | None) -> tuple[Array, bool]:
    """Return the points (n+2, 3) [m] of the best layout found, and whether the search came to its end."""
    count = int(search.loose.sum())
    drawn = search.share(search.points)
    if not count:
        return search.placed(drawn), True
    spread = np.random.default_rng(count).uniform(0.0, 1.0, (STARTS - 2, count))
    starts = [drawn, np.full(count, 0.5), *spread]
    best, rank = drawn, _rank(search, drawn)
    for k, start in enumerate(starts):
        if progress is not None and progress(k / (STARTS + 1)) == "stop":
            return search.placed(best), False
        for x in _candidates(search, start):
            value = _rank(search, x)
            if value < rank:
                best, rank = x, value
    if rank[0] == 0.0 and search.weights is None:
        finer = _shut(search, _minimised(search, best, _smallest_sum(search, best), closed=True))
        if _rank(search, finer)[0] == 0.0 and _largest(search, finer) <= _largest(search, best) * (1.0 + 1e-6):
            best = finer
    return search.placed(best), True


def _candidates(search: Search, start: Array) -> list[Array]:
    found = _shut(search, _minimised(search, start, _objective(search), closed=True))
    if _rank(search, found)[0] == 0.0:
        return [found]
    return [found, _minimised(search, start, _objective(search), closed=False)]


def _rank(search: Search, x: Array) -> tuple[float, float]:
    """Return a key to sort layouts by: how far from closing, then how steep; too short or too steep comes last."""
    versine, sides, length = search.measured(x)
    if np.any(length < search.shortest * (1.0 - SHUT)) or np.any(versine > STEEP):
        return np.inf, np.inf
    gap = float(2.0 * np.max(sides) - np.sum(sides))
    return (0.0 if gap <= 1e-14 else gap), _steepness(search, versine)


def _steepness(search: Search, versine: Array) -> float:
    return float(np.max(versine) if search.weights is None else np.sum(search.weights * versine))


def _largest(search: Search, x: Array) -> float:
    return float(np.max(search.measured(x)[0]))


@dataclass(frozen=True)
class _Objective:
    """Σ weights · versine + peak · (a bound over all versines); never above ``cap``."""

    weights: Array
    peak: float
    cap: float


def _objective(search: Search) -> _Objective:
    n = len(search.low)
    if search.weights is None:
        return _Objective(np.zeros(n), 1.0, STEEP)
    return _Objective(search.weights / np.sum(search.weights), 0.0, STEEP)


def _smallest_sum(search: Search, x: Array) -> _Objective:
    n = len(search.low)
    return _Objective(np.full(n, 1.0 / n), 0.0, max(_largest(search, x), 1e-12))


def _minimised(search: Search, start: Array, objective: _Objective, *, closed: bool) -> Array:
    """Return the shares that minimise an objective, or the gap where the polygon need not close.

    The last unknown is the bound over all versines, or over all gaps, in units of the start's.
    """
    versine, sides, _length = search.measured(start)
    size = max(float(np.max(versine)), 1e-9)
    total = max(float(np.sum(sides)), 1e-9)

    def values(x: Array) -> tuple[Array, Array]:
        v, s, length = search.measured(x)
        gaps = (np.sum(s, axis=-1, keepdims=True) - 2.0 * s) / total
        return v / size, np.concatenate((gaps, (length / search.shortest) ** 2 - 1.0), axis=-1)

    sides_count = len(sides)
    pair, held = closed and sides_count == 2, closed and search.tied

    def goal(z: Array) -> float:
        if not closed:
            return float(z[-1])
        return float(np.sum(objective.weights * values(z[:-1])[0]) + objective.peak * z[-1])

    def limits(z: Array, v: Array, rest: Array) -> Array:
        bound = z[..., -1:]
        cap = objective.cap / size
        if closed:
            above = bound - v if objective.peak else cap - v
            return np.concatenate((above, rest[..., sides_count:] if pair or held else rest), axis=-1)
        gaps, short = rest[..., :sides_count], rest[..., sides_count:]
        return np.concatenate((bound + gaps, cap - v, short), axis=-1)

    def room(z: Array) -> Array:
        return limits(z, *values(z[:-1]))

    count = len(start)
    both = STEP * np.concatenate((np.eye(count), -np.eye(count)))

    def room_slope(z: Array) -> Array:
        x = z[:-1] + both
        far = np.concatenate((x, np.full((len(x), 1), z[-1])), axis=-1)
        up, down = np.split(limits(far, *values(x)), 2)
        last = np.zeros(len(up[0]))
        moved = limits(np.append(z[:-1], z[-1] + 1.0), *values(z[:-1])) - room(z)
        last[:] = moved
        return np.column_stack((((up - down) / (2.0 * STEP)).T, last))

    def slope(z: Array) -> Array:
        if not closed:
            return np.append(np.zeros(count), 1.0)
        up, down = np.split(np.sum(objective.weights * values(z[:-1] + both)[0], axis=-1), 2)
        return np.append((up - down) / (2.0 * STEP), objective.peak)

    def vanishing(x: Array) -> Array:
        return search.end(x) / total if held else values(x)[1][..., :1]

    def difference(z: Array) -> Array:
        return vanishing(z[:-1])

    def difference_slope(z: Array) -> Array:
        up, down = np.split(vanishing(z[:-1] + both), 2)
        slopes = (up - down).T / (2.0 * STEP)
        return np.column_stack((slopes, np.zeros(len(slopes))))

    kept: Any = [{"type": "ineq", "fun": room, "jac": room_slope}]
    if pair or held:
        kept.append({"type": "eq", "fun": difference, "jac": difference_slope})
    first = 1.0 if closed else float(search.gap(start)) / total
    found = scipy.optimize.minimize(
        goal,
        np.append(start, first),
        jac=slope,
        method="SLSQP",
        bounds=[(0.0, 1.0)] * count + [(None, None)],
        constraints=kept,
        options=OPTIONS,
    ).x
    return np.clip(found[:-1], 0.0, 1.0)


def _shut(search: Search, x: Array) -> Array:
    """Return a layout whose polygon closes to rounding, next to one that closes nearly (Newton's method)."""
    if not 0.0 < float(search.gap(x)) <= SHUT:
        return x
    if search.tied:
        return _ended(search, x)
    best, least = x, float(search.gap(x))
    both = STEP * np.concatenate((np.eye(len(x)), -np.eye(len(x))))
    for _step in range(12):
        up, down = np.split(search.gap(best + both), 2)
        slope = (up - down) / (2.0 * STEP)
        inside = ~(((best <= 0.0) & (slope > 0.0)) | ((best >= 1.0) & (slope < 0.0)))
        slope = np.where(inside, slope, 0.0)
        square = float(slope @ slope)
        if square == 0.0:
            break
        moved = np.clip(best - (least + 1e-16) * slope / square, 0.0, 1.0)
        now = float(search.gap(moved))
        if now >= least:
            break
        best, least = moved, now
        if least <= 0.0:
            break
    return best


def _ended(search: Search, x: Array) -> Array:
    """Return the same where all yokes are held: two equations, for the gap has a corner where it vanishes."""
    best, least = x, float(search.gap(x))
    both = STEP * np.concatenate((np.eye(len(x)), -np.eye(len(x))))
    for _step in range(12):
        up, down = np.split(search.end(best + both), 2)
        step = np.linalg.lstsq((up - down).T / (2.0 * STEP), -search.end(best), rcond=1e-9)[0]
        moved = np.clip(best + step, 0.0, 1.0)
        now = float(search.gap(moved))
        if now >= least:
            break
        best, least = moved, now
    return best
