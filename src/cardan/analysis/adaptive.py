"""Steps through time as long as their error allows, from contact to contact."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from cardan.maths.arrays import Array

from .input_motion import InputMotion
from .marching import (
    Explicit,
    Freedom,
    Implicit,
    Piece,
    Stepper,
    Upto,
    breaks_of,
    freedom_of,
    held,
    passed,
    sides_of,
    twists,
)
from .simulation import Progress, Record, Simulation, Status, reported
from .torques import Asynchronous, Swinging
from .torsional_balance import linearised, places
from .torsional_model import TorsionalModel

TWIST_LIMIT = 1e3
"""Elements twisted by more than this [rad] have left all bounds."""

RESTLESS = 200
"""Contacts that change so often while time all but stands still never settle."""

IMPLICIT_COST = 6.0
"""Work of the implicit method for one radian of a rate that lives over that of the explicit one, measured."""

FADED = 25.0
"""What is damped by e to this power is gone."""

ORDERS = 4.0
"""Order of the shaft up to which joints excite a drive noticeably."""

SNAP = 1e-9
"""A static stiffness below this share of the stiffest element's holds no joint."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Task:
    """What is to be done.

    Attributes
    ----------
    model : TorsionalModel
        One drive.
    motion : InputMotion or None
        What is forced on the first coordinate.
    tolerance : (float, float)
        Share for speeds and work; angles [rad] and speeds [rad/s].
    stiff : bool or None
        Whether to integrate implicitly; None to find out.
    span : (float, float) [s]
    times : array (t,) [s]
        Samples.
    q, rate : array (R,) [rad, rad/s]
        At the start.
    """

    model: TorsionalModel
    motion: InputMotion | None
    tolerance: tuple[float, float]
    stiff: bool | None
    span: tuple[float, float]
    times: Array
    q: Array
    rate: Array


def march(task: Task, progress: Progress | None) -> Simulation:
    """Return the simulation of one drive."""
    model, motion = task.model, task.motion
    freedom = freedom_of(model, motion)
    record = Record(model, task.times)
    settled = _settled(model, freedom, task.q, task.rate, task.span[0])
    status, ended, steps = Status.SNAPPED, task.span[0], 0
    implicit = _implicit(task, freedom)
    if settled is not None:
        walk = _Walk(task, freedom, settled, implicit)
        for piece, now in walk.pieces():
            record.add(piece, now)
            ended, steps = piece.end, steps + 1
            if progress is not None and progress(_share(task.span, ended)) == "stop" and ended < task.span[1]:
                walk.status = Status.CANCELLED
                break
        status = walk.status
    acceleration = None if motion is None else _accelerations(motion, task.times)
    return reported(
        model,
        task.times,
        record.q,
        record.rate,
        record.work,
        forced_acceleration=acceleration,
        extremes=record.extremes(),
        status=np.asarray(int(status)),
        ended=np.asarray(ended),
        steps=steps,
        method="implicit" if implicit else "explicit",
    )


def _share(span: tuple[float, float], time: float) -> float:
    return (time - span[0]) / (span[1] - span[0])


def _accelerations(motion: InputMotion, times: Array) -> Array:
    return np.broadcast_to(motion.at(times)[2], times.shape)


class _Walk:
    """The way through time: pieces of steps, and how it ended."""

    def __init__(self, task: Task, freedom: Freedom, q: Array, implicit: bool) -> None:
        self.task, self.freedom, self.implicit = task, freedom, implicit
        self.state = (task.span[0], q[freedom.free], task.rate[freedom.free], 0.0)
        self.status = Status.DONE
        self.sides = self._sides()
        self.longest = _contact_period(task, freedom) / 4.0
        self.first: float | None = None

    def _whole(self, piece: Piece, times: Array) -> tuple[Array, Array]:
        return self.freedom.whole(times, *piece.dense(times)[:2])

    def _sides(self) -> Array:
        time, q, rate, _work = self.state
        angles, rates = self.freedom.whole(np.asarray([time]), q[None], rate[None])
        speeds = places(self.task.model, angles).first * rates[:, list(self.task.model.coordinate)]
        turning = (
            speeds[0, [a for a, _b in self.task.model.elements]] - speeds[0, [b for _a, b in self.task.model.elements]]
        )
        return sides_of(self.task.model, twists(self.task.model, angles)[0], turning)

    def pieces(self) -> Iterator[tuple[Piece, Freedom]]:
        """Yield the pieces to the end of the span, or to where the motion ends."""
        task = self.task
        restless = 0
        for end in breaks_of(task.model, task.motion, *task.span):
            if task.motion is not None:
                self.freedom = replace(self.freedom, motion=Upto(whole=task.motion, end=end))
            while self.state[0] < end:
                begin = self.state[0]
                for piece in self._smooth(end):
                    yield piece, self.freedom
                if self.status is not Status.DONE:
                    return
                restless = restless + 1 if self.state[0] - begin < 1e-9 * (task.span[1] - task.span[0]) else 0
                if restless > RESTLESS:
                    self.status = Status.STALLED
                    return

    def _smooth(self, end: float) -> Iterator[Piece]:
        """Yield pieces up to the next change of a contact or to the end."""
        task = self.task
        model = held(task.model, self.sides)
        kind = Implicit if self.implicit else Explicit
        stepper: Stepper = kind(model, self.freedom, task.tolerance, self.state, end, self.longest, self.first)
        while stepper.time < end:
            piece = stepper.step()
            if piece is None:
                self.status = self._cause(model)
                return
            change = self._change(piece)
            if change is not None:
                piece = replace(piece, end=change[0])
            q, rate, work = (one[0] for one in piece.dense(np.asarray([piece.end])))
            if not self._bounded(model, piece.end, q, rate, work):
                self.status = Status.DIVERGED
                return
            self.state = (piece.end, q, rate, float(work))
            yield piece
            if self._snapped(model):
                self.status = Status.SNAPPED
                return
            if change is not None:
                self.sides[change[1]] = change[2]
                self.first = min(stepper.length, self.longest)
                return

    def _change(self, piece: Piece) -> tuple[float, int, int] | None:
        """Return when the first contact changes within a piece, of which element, and to which side."""
        model = self.task.model
        if not np.any(model.backlash > 0.0):
            return None
        from scipy.optimize import brentq

        times = piece.within()
        over = passed(model, self.sides, twists(model, self._whole(piece, times)[0]))
        late = np.flatnonzero(np.any(over > 0.0, axis=-1))
        if not len(late):
            return None
        before = times[late[0] - 1] if late[0] else piece.start
        found = []
        for e in np.flatnonzero(over[late[0]] > 0.0):

            def past(time: float, e: int = int(e)) -> float:
                twist = twists(model, self._whole(piece, np.asarray([time]))[0])
                return float(passed(model, self.sides, twist)[0, e])

            when = (
                float(before) if past(float(before)) >= 0.0 else float(brentq(past, before, times[late[0]], xtol=1e-15))
            )
            found.append((when, int(e)))
        when, e = min(found)
        when = max(when, float(np.nextafter(piece.start, np.inf)))
        twist = twists(model, self._whole(piece, np.asarray([when]))[0])[0, e]
        return when, e, 0 if self.sides[e] else int(math.copysign(1.0, twist))

    def _bounded(self, model: TorsionalModel, time: float, q: Array, rate: Array, work: float) -> bool:
        if not (np.all(np.isfinite(q)) and np.all(np.isfinite(rate)) and math.isfinite(work)):
            return False
        twist = twists(model, self.freedom.whole(np.asarray([time]), q[None], rate[None])[0])
        return bool(np.all(np.abs(twist) < TWIST_LIMIT))

    def _cause(self, model: TorsionalModel) -> Status:
        """Return why no step was short enough."""
        if len(self.freedom.heavy) < len(self.freedom.free):
            least = _hold(model, self.freedom, *self.state[:3])
            if least < 1e-2 * float(np.max(model.stiffness, initial=0.0)):
                return Status.SNAPPED
        return Status.STALLED

    def _snapped(self, model: TorsionalModel) -> bool:
        if len(self.freedom.heavy) == len(self.freedom.free):
            return False
        return _hold(model, self.freedom, *self.state[:3]) <= SNAP * float(np.max(model.stiffness, initial=0.0))


def _light(
    model: TorsionalModel, freedom: Freedom, time: float, q: Array, rate: Array
) -> tuple[Array, Array, Array, Array]:
    """Return coordinates without inertia, their undamped directions, and balance and stiffness along these."""
    moment = np.asarray([time])
    angles, rates = freedom.whole(moment, q[None], rate[None])
    left, by = linearised(model, angles, rates, np.zeros_like(angles), moment)
    light = np.setdiff1d(freedom.free, freedom.heavy)
    damping = by.damping[0][np.ix_(light, light)]
    sizes, ways = np.linalg.eigh(0.5 * (damping + damping.T))
    still = ways[:, np.abs(sizes) <= 1e-12 * max(1e-300, float(np.max(np.abs(sizes), initial=0.0)))]
    stiffness = still.T @ by.stiffness[0][np.ix_(light, light)] @ still
    return light, still, still.T @ left[0, light], stiffness


def _hold(model: TorsionalModel, freedom: Freedom, time: float, q: Array, rate: Array) -> float:
    """Return the least static stiffness of what has neither inertia nor damper [N·m/rad]."""
    stiffness = _light(model, freedom, time, q, rate)[3]
    return float(np.min(np.linalg.eigvalsh(0.5 * (stiffness + stiffness.T)), initial=math.inf))


def _settled(model: TorsionalModel, freedom: Freedom, q: Array, rate: Array, time: float) -> Array | None:
    """Return the angles with what has neither inertia nor damper in balance; None where torque snaps it through."""
    if len(freedom.heavy) == len(freedom.free):
        return q
    found, rank = q.copy(), freedom.free
    for _round in range(100):
        light, still, left, stiffness = _light(model, freedom, time, found[rank], rate[rank])
        if not len(left):
            return found
        try:
            change = np.linalg.solve(stiffness, left)
        except np.linalg.LinAlgError:
            return None
        change *= min(1.0, 0.5 / max(float(np.max(np.abs(change))), 1e-300))
        found[light] -= still @ change
        if float(np.max(np.abs(change))) <= 1e-14 * max(1.0, float(np.max(np.abs(found)))):
            least = _hold(model, freedom, time, found[rank], rate[rank])
            return found if least > SNAP * float(np.max(model.stiffness, initial=0.0)) else None
    return None


def _turns(task: Task) -> tuple[Array, Array, Array]:
    """Return the drive linearised over half a turn: masses (m, R), damping and stiffness (m, R, R), all in contact."""
    turn = np.linspace(0.0, math.pi, 8, endpoint=False)
    q = task.q + turn[:, None]
    rate = np.broadcast_to(task.rate, q.shape)
    model = held(task.model, np.ones(len(task.model.elements)))
    model = replace(model, rest=None)
    by = linearised(model, q, rate, np.zeros_like(q), np.full(len(q), task.span[0]))[1]
    return by.mass, by.damping, by.stiffness


def _implicit(task: Task, freedom: Freedom) -> bool:
    """Tell whether the implicit method is needed, or is asked for, or costs less."""
    if len(freedom.heavy) < len(freedom.free) or task.stiff:
        return True
    if task.stiff is False or not len(freedom.free):
        return False
    mass, damping, stiffness = _turns(task)
    inner = np.ix_(np.arange(len(mass)), freedom.free, freedom.free)
    share = 1.0 / mass[:, freedom.free, None]
    count = len(freedom.free)
    system = np.zeros((len(mass), 2 * count, 2 * count))
    system[:, :count, count:] = np.eye(count)
    system[:, count:, :count], system[:, count:, count:] = -share * stiffness[inner], -share * damping[inner]
    values = np.linalg.eigvals(system)
    length = task.span[1] - task.span[0]
    alive = 1.0 / np.maximum(1.0, -values.real * length / FADED)
    fastest, living = float(np.max(np.abs(values))), float(np.max(np.abs(values) * alive))
    return fastest > IMPLICIT_COST * max(living, _forced_rate(task), 1.0 / length)


def _forced_rate(task: Task) -> float:
    """Return how fast joints and torques excite the drive [rad/s]."""
    speeds = [float(np.max(np.abs(task.rate)))]
    if task.motion is not None:
        moments = [*task.span, *(time for time in task.motion.breaks if task.span[0] < time < task.span[1])]
        speeds.append(float(np.max(np.abs(task.motion.at(np.asarray(moments))[1]))))
    orders = [ORDERS]
    for torque in task.model.torques:
        if isinstance(torque.law, Asynchronous):
            speeds.append(abs(float(torque.law.synchronous_speed)))
        if isinstance(torque.law, Swinging):
            orders.append(abs(torque.law.frequency))
    return max(speeds) * max(orders)


def _contact_period(task: Task, freedom: Freedom) -> float:
    """Return the shortest period of an element with play in contact [s]; infinite where there is no play."""
    model = task.model
    if not np.any(model.backlash > 0.0):
        return math.inf
    mass = np.min(_turns(task)[0], axis=0)
    mass[np.setdiff1d(np.arange(model.coordinates), freedom.free)] = math.inf
    light = float(np.min(mass[freedom.heavy], initial=math.inf))
    mass = np.where(mass > 0.0, mass, light)
    rate = 0.0
    for e, (a, b) in enumerate(model.elements):
        if model.backlash[e] > 0.0:
            ends = (model.coordinate[a], model.coordinate[b])
            rate = max(rate, math.sqrt(float(model.stiffness[e]) * sum(1.0 / mass[r] for r in ends)))
    return 2.0 * math.pi / rate if rate > 0.0 else math.inf
