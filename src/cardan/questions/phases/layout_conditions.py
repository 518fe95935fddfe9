"""Where should the joints stand for all poses and movements of a drive, on the spline teeth that it has?

No layout makes a drive uniform in every pose. Sought are joint centres and yoke angles together, with the least speed
fluctuation in the worst condition or in the mean over the time; among those alike the smallest largest joint angle.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal, TypeAlias

import numpy as np
import scipy

from cardan.answers.quantity import Joined, Quantity, Text, say
from cardan.drive.conditions import in_poses
from cardan.drive.drive import Drive
from cardan.drive.fields.paths import place
from cardan.drive.fields.validity import axis_points
from cardan.drive.models.geometry import polyline
from cardan.drive.models.kinematics_model import Chain
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.questions.motion.moving_points import moving_points
from cardan.questions.motion.standing import mean_times
from cardan.texts import _

from .family import distinct
from .setting import wrapped
from .spline_pitch import on_teeth

Over: TypeAlias = Literal["worst", "mean"]
"""What of the speed fluctuations in all conditions is to be least."""

INSTANTS = 36
"""So many instants of a movement are conditions of their own."""

STARTS = 8
"""Layouts from which the search starts: as drawn, the middle of all boxes, the others spread at random."""

TRIALS = 512
"""Settings of the yokes tried at each start."""

PICKED = 8
"""Settings on teeth from which the joints are placed anew."""

STEEP = 0.99
"""Largest 1 - cos α that the search looks at; just below a right angle."""

STEP = 1e-6
"""Step of the difference quotients, share of a box or [rad]."""

BLURS = (1e-2, 1e-4)
"""Rounding of the corner that δ has where it vanishes, share of the best δ, in turn, for the mean."""

SMALL = 1e-3
"""Speed fluctuation below which a layout is driven to exact uniformity, if there is one near."""

SLACK = 1e-3
"""Share by which the speed fluctuation may grow for smaller joint angles."""

FLOOR = 1e-7
"""Speed fluctuation that may be left for the moment while smaller joint angles are looked for."""

CLOSED = 1e-9
"""Speed fluctuation in a condition below which a layout found by search is synchronous there."""

OPTIONS: Any = {"maxiter": 150, "ftol": 1e-11}


@dataclass(frozen=True, eq=False, kw_only=True)
class Placed:
    """One condition: where the points of the drive are for given joint centres."""

    name: Text
    share: float  # of the time, in the mean
    points: Array  # (n+2, 3) [m]: in the pose
    follows: Array  # (n, 3): which coordinates of the joints the pose leaves as they are drawn
    move: Callable[[Array], Array]  # from the points of the pose to those of this instant of its movement

    def at(self, centres: Array) -> Array:
        """Return the points for joint centres as drawn (n, 3), array (n+2, 3) [m]."""
        whole = self.points.copy()
        whole[1:-1] = np.where(self.follows, centres, whole[1:-1])
        return self.move(whole)


def placed(drive: Drive) -> tuple[Placed, ...]:
    """Return the conditions of a drive given by points: as drawn, in its poses, and at instants of its movements."""
    every = [one for one in in_poses(drive) if one.share != 0.0]
    known = sum(one.share for one in every if one.share is not None)
    unknown = sum(one.share is None for one in every)
    sets = {pose.name or str(k): pose.set for k, pose in enumerate(drive.poses, start=1)}
    found = []
    for one in every:
        share = one.share if one.share is not None else max(0.0, 1.0 - known) / unknown
        follows = np.ones((len(drive.joints), 3), dtype=bool)
        for path, _value in sets.get(one.pose, ()):
            steps = place(drive, path).steps
            if steps[0] == "joints" and steps[2] == "centre":
                follows[int(steps[1])][[int(k) for k in steps[3:]] or slice(None)] = False
        times = mean_times(one.drive.movements, fewest=INSTANTS) if one.moving else np.zeros(1)
        times = times[np.linspace(0, len(times) - 1, min(len(times), INSTANTS)).astype(int)]
        for time in times.tolist():
            at = say(_("at {time} of the movement"), time=Quantity(time, "time", 3, trim=True))
            name = one.name if one.name != "" else _("as drawn")
            found.append(
                Placed(
                    name=Joined([name, at]) if one.moving else name,
                    share=share / len(times),
                    points=np.asarray(axis_points(one.drive), dtype=float),
                    follows=follows,
                    move=_moving(one.drive, time) if one.moving else np.asarray,
                )
            )
    total = sum(one.share for one in found) or 1.0
    even = 1.0 / len(found) if not any(one.share for one in found) else 0.0
    return tuple(
        Placed(name=one.name, share=even or one.share / total, points=one.points, follows=one.follows, move=one.move)
        for one in found
    )


def _moving(drive: Drive, time: float) -> Callable[[Array], Array]:
    def moved(points: Array) -> Array:
        return np.asarray(moving_points(points, drive.movements, [time])[0][0])

    return moved


@dataclass(frozen=True, eq=False, kw_only=True)
class ConditionSearch:
    """What is given and what may change: shares x of the boxes and yoke angles."""

    conditions: Sequence[Placed]
    low: Array  # low, high (n, 3) [m]: corners of the joints' boxes
    high: Array
    shortest: Array  # (n+1,) [m]: least length of each shaft
    yoke_angle: Array  # (n-1,) [rad]: as described
    free: tuple[int, ...]  # indices 0 … n-2 of the yokes that may be turned
    teeth: Mapping[int, int]  # index of a free yoke -> teeth of its spline
    over: Over

    @cached_property
    def loose(self) -> Array:
        """Coordinates of the joints that can move, mask (n, 3)."""
        return np.asarray(self.high > self.low)

    @cached_property
    def share(self) -> Array:
        """Shares of time of the conditions, array (c,)."""
        return np.asarray([one.share for one in self.conditions])

    def centres(self, x: Array) -> Array:
        """Return joint centres (n, 3) [m] for shares (v,) of the boxes."""
        found: Array = self.low.copy()
        found[self.loose] += x * (self.high - self.low)[self.loose]
        return found

    @cached_property
    def _affine(self) -> tuple[Array, Array]:
        """Points of every condition with all shares 0, (c, n+2, 3), and what each share adds, (v, c, n+2, 3).

        All movements carry points as rigid bodies or shift them: the points of a condition are affine in the centres.
        """
        count = int(self.loose.sum())

        def points(x: Array) -> Array:
            return np.stack([one.at(self.centres(x)) for one in self.conditions])

        start = points(np.zeros(count))
        ways = [points(one) - start for one in np.eye(count)]
        return start, np.stack(ways) if ways else np.zeros((0, *start.shape))

    def points(self, x: Array) -> Array:
        """Return the points of every condition for shares (..., v), array (..., c, n+2, 3) [m]."""
        start, ways = self._affine
        found: Array = start + np.tensordot(x, ways, axes=(-1, 0))
        return found

    def measured(self, x: Array) -> tuple[Array, Array]:
        """Return versines 1 - cos α (..., c, n) and shaft lengths (..., c, n+1) [m]."""
        shaft = np.diff(self.points(x), axis=-2)
        length = frames.norm(shaft)
        step = np.diff(shaft / np.maximum(length, 1e-12)[..., None], axis=-2)
        return 0.5 * frames.dot(step, step), length

    def ends(self, x: Array, yokes: Array) -> Array:
        """Return b of the Möbius pair of each condition for shares (..., v) and yoke angles (..., n-1), complex."""
        lies = polyline(self.points(x))
        shape = (*lies.joint_angle.shape[:-1], yokes.shape[-1])
        chain = Chain(
            joint_angle=np.minimum(lies.joint_angle, np.arccos(1.0 - STEEP)),
            plane_twist=lies.plane_twist,
            yoke_angle=np.broadcast_to(yokes[..., None, :], shape),
            start_phase=np.asarray(0.0),
        )
        found: Array = chain.products()[-1][1]
        return found

    def fluctuations(self, x: Array, yokes: Array) -> Array:
        """Return δ in every condition, array (..., c)."""
        square = np.abs(self.ends(x, yokes)) ** 2
        return np.sqrt(16.0 * square * (1.0 + square))

    def judged(self, x: Array, yokes: Array) -> Array:
        """Return δ in the worst condition or in the mean over the time, array (...)."""
        uneven = self.fluctuations(x, yokes)
        return np.max(uneven, axis=-1) if self.over == "worst" else np.sum(self.share * uneven, axis=-1)

    def possible(self, x: Array) -> bool:
        """Tell whether the shafts are long enough and no joint is too steep in any condition."""
        versine, length = self.measured(x)
        return not (np.any(versine > STEEP) or np.any(length < self.shortest * (1.0 - 1e-7)))

    def rank(self, x: Array, yokes: Array) -> tuple[bool, float, float]:
        """Return a key to sort layouts by: possible, calm, with small joint angles."""
        judged = float(self.judged(x, yokes))
        calm = 0.0 if judged < CLOSED else float(f"{judged:.4g}")
        return not self.possible(x), calm, float(np.max(self.measured(x)[0]))


def best_in_conditions(
    search: ConditionSearch, drawn: Array, progress: Callable[[float], object] | None
) -> tuple[Array, Array, bool]:
    """Return shares (v,) of the boxes and yoke angles (n-1,) of the best layout, and whether it came to its end.

    drawn (v,): shares of the boxes as described.
    """
    count = len(drawn)
    random = np.random.default_rng(count + len(search.free))
    starts = [drawn, np.full(count, 0.5), *random.uniform(0.0, 1.0, (STARTS - 2, count))] if count else [drawn]
    found: list[tuple[Array, Array]] = [(drawn, search.yoke_angle)]
    for k, start in enumerate(starts):
        if progress is not None and progress(k / (len(starts) + 1)) == "stop":
            return *_foremost(search, found), False
        yokes = np.repeat(search.yoke_angle[None], TRIALS, axis=0)
        yokes[1:, list(search.free)] = random.uniform(0.0, np.pi, (TRIALS - 1, len(search.free)))
        cost = search.judged(np.broadcast_to(start, (TRIALS, count)), yokes)
        for one in distinct(yokes[np.argsort(cost, kind="stable")], 2):
            found.append(_improved(search, start, one, search.free))
    x, yokes = _foremost(search, found)
    if search.teeth:
        x, yokes = _on_teeth(search, sorted(found, key=lambda one: search.rank(*one))[:3])
        kept = tuple(k for k in search.free if k not in search.teeth)
    else:
        kept = search.free
    return *_foremost(search, [(x, yokes), _flatter(search, x, yokes, kept)]), True


def _foremost(search: ConditionSearch, found: Sequence[tuple[Array, Array]]) -> tuple[Array, Array]:
    x, yokes = min(found, key=lambda one: search.rank(*one))
    return x, wrapped(yokes)


def _on_teeth(search: ConditionSearch, starts: Sequence[tuple[Array, Array]]) -> tuple[Array, Array]:
    """Return the best layout on teeth: the best settings at each start, the joints placed anew for each, once more."""
    loose = tuple(k for k in search.free if k not in search.teeth)
    best: list[tuple[Array, Array]] = []
    for x, yokes in starts:
        for _round in range(2):
            grid = on_teeth(yokes, search.yoke_angle, search.teeth)
            cost = np.concatenate(
                [search.judged(np.broadcast_to(x, (len(part), len(x))), part) for part in _parted(grid)]
            )
            picked = grid[np.argsort(cost, kind="stable")[:PICKED]]
            best += [_improved(search, x, one, loose) for one in picked]
            x, yokes = _foremost(search, best)
    return _foremost(search, best)


def _parted(rows: Array) -> Sequence[Array]:
    return np.array_split(rows, max(1, len(rows) // 2048))


def _improved(search: ConditionSearch, x: Array, yokes: Array, free: Sequence[int]) -> tuple[Array, Array]:
    """Return joints and yokes moved to where the speed fluctuation is least nearby."""
    step = _Step(search=search, yokes=yokes, free=tuple(free))
    z = np.concatenate((x, yokes[list(free)]))
    if not z.size:
        return x, yokes
    for blur in BLURS if search.over == "mean" else (0.0,):
        z = step.calmest(z, blur)
    found = [(x, yokes), step.split(z)]
    if float(search.judged(*found[1])) < SMALL:
        found.append(step.split(step.closed(z)))
    return _foremost(search, found)


def _flatter(search: ConditionSearch, x: Array, yokes: Array, free: Sequence[int]) -> tuple[Array, Array]:
    """Return the layout with smaller joint angles that leaves hardly more speed fluctuation."""
    step = _Step(search=search, yokes=yokes, free=tuple(free))
    z = np.concatenate((x, yokes[list(free)]))
    if not len(x):
        return x, yokes
    near = step.flattest(z, max(float(search.judged(x, yokes)) * (1.0 + 0.1 * SLACK), FLOOR))
    other = step.split(near)
    if float(search.judged(*other)) < SMALL:
        other = _foremost(search, [other, step.split(step.closed(near))])
    before, after = float(search.judged(x, yokes)), float(search.judged(*other))
    flat = np.max(search.measured(other[0])[0]) < np.max(search.measured(x)[0])
    return other if after <= max(before * (1.0 + SLACK), CLOSED) and flat and search.possible(other[0]) else (x, yokes)


@dataclass(frozen=True, eq=False, kw_only=True)
class _Step:
    """Searches (SLSQP) over z: shares of the boxes, then free yoke angles [rad]."""

    search: ConditionSearch
    yokes: Array
    free: tuple[int, ...]

    def split(self, z: Array) -> tuple[Array, Array]:
        """Return shares and all yoke angles of unknowns (..., v + f)."""
        count = z.shape[-1] - len(self.free)
        yokes = np.array(np.broadcast_to(self.yokes, (*z.shape[:-1], len(self.yokes))))
        yokes[..., list(self.free)] = z[..., count:]
        return z[..., :count], yokes

    def room(self, z: Array) -> Array:
        """Return what must not fall below 0: versines and lengths of every condition, array (..., k)."""
        versine, length = self.search.measured(self.split(z)[0])
        rooms = (STEEP - versine, (length / self.search.shortest) ** 2 - 1.0)
        return np.concatenate([one.reshape(*z.shape[:-1], -1) for one in rooms], axis=-1)

    def squares(self, z: Array) -> Array:
        """Return |b|² of every condition, array (..., c); δ² = 16 |b|² (1 + |b|²)."""
        found: Array = np.abs(self.search.ends(*self.split(z))) ** 2
        return found

    def slope(self, function: Callable[[Array], Array], z: Array) -> Array:
        """Return the derivatives of a function of rows of unknowns, array (k, v + f)."""
        both = STEP * np.concatenate((np.eye(z.size), -np.eye(z.size)))
        up, down = np.split(function(z + both), 2)
        return np.asarray((up - down).T / (2.0 * STEP))

    def calmest(self, z: Array, blur: float) -> Array:
        """Return the unknowns with the least speed fluctuation, in the worst condition or the mean."""
        unit = max(float(np.max(self.squares(z))), 1e-18)
        if self.search.over == "mean":
            scale = max(float(self.search.judged(*self.split(z))), 1e-9)

            def mean(rows: Array) -> Array:
                square = self.squares(rows)
                uneven = np.sqrt(16.0 * square * (1.0 + square) + (blur * scale) ** 2)
                return np.sum(self.search.share * uneven, axis=-1) / scale

            return self._solved(z, mean, self.room)

        def bound(rows: Array) -> Array:
            return rows[..., -1]

        def rooms(rows: Array) -> Array:
            left = rows[..., -1:] - self.squares(rows[..., :-1]) / unit
            return np.concatenate((left, self.room(rows[..., :-1])), axis=-1)

        return self._solved(np.append(z, 1.0), bound, rooms)[:-1]

    def flattest(self, z: Array, most: float) -> Array:
        """Return the unknowns with the smallest largest joint angle at no more speed fluctuation than given."""
        limit = (0.25 * most) ** 2
        size = float(np.max(self.search.measured(self.split(z)[0])[0]))

        def bound(rows: Array) -> Array:
            return rows[..., -1]

        def rooms(rows: Array) -> Array:
            inner = rows[..., :-1]
            versine = self.search.measured(self.split(inner)[0])[0].reshape(*inner.shape[:-1], -1)
            if self.search.over == "mean":
                square = self.squares(inner)
                uneven = np.sqrt(16.0 * square * (1.0 + square) + (1e-4 * most) ** 2)
                calm = 1.0 - np.sum(self.search.share * uneven, axis=-1, keepdims=True) / most
            else:
                square = self.squares(inner)
                calm = 1.0 - square * (1.0 + square) / limit
            return np.concatenate((rows[..., -1:] - versine / size, calm, self.room(inner)), axis=-1)

        return self._solved(np.append(z, 1.0), bound, rooms)[:-1]

    def closed(self, z: Array) -> Array:
        """Return the unknowns nearby that make every condition uniform, as nearly as they can (least squares)."""
        count = z.size - len(self.free)

        def rest(one: Array) -> Array:
            end = self.search.ends(*self.split(one))
            return np.concatenate((end.real, end.imag))

        low = np.concatenate((np.zeros(count), np.full(len(self.free), -np.inf)))
        high = np.concatenate((np.ones(count), np.full(len(self.free), np.inf)))
        inside = np.clip(z, low + 1e-12, high - 1e-12)
        ends: Array = scipy.optimize.least_squares(
            rest, inside, bounds=(low, high), xtol=1e-15, ftol=1e-15, gtol=1e-15
        ).x
        return ends

    def _solved(self, start: Array, goal: Callable[[Array], Array], rooms: Callable[[Array], Array]) -> Array:
        count = len(start) - len(self.free)

        def value(z: Array) -> float:
            return float(goal(z))

        def value_slope(z: Array) -> Array:
            return self.slope(goal, z)

        def rooms_slope(z: Array) -> Array:
            return self.slope(rooms, z)

        boxes = len(self.search.loose[self.search.loose])
        bounds = [(0.0, 1.0)] * boxes + [(None, None)] * (count - boxes + len(self.free))
        kept: Any = [{"type": "ineq", "fun": rooms, "jac": rooms_slope}]
        with np.errstate(invalid="ignore", over="ignore"):
            found: Array = scipy.optimize.minimize(
                value, start, jac=value_slope, method="SLSQP", bounds=bounds, constraints=kept, options=OPTIONS
            ).x
        found[:boxes] = np.clip(found[:boxes], 0.0, 1.0)
        return found if np.all(np.isfinite(found)) else start
