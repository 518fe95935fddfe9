"""How do torques and speeds of a drive run in time?"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields, replace
from typing import TypeAlias

import numpy as np
import scipy

from cardan.errors import Problem, check
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.compiled.torsion_line import SPEED_LIMIT, TWIST_LIMIT
from cardan.questions.torsion.model.inputs import InputMotion, Uniform
from cardan.questions.torsion.model.torsional_balance import energy, linearised, places
from cardan.questions.torsion.model.torsional_layouts import leading, single
from cardan.questions.torsion.model.torsional_model import TorsionalModel
from cardan.texts import _

from .fixed_steps import FixedStep, stepped
from .simulation import Extremes, Progress, Record, Simulation, Status, reported
from .time_integration import (
    Explicit,
    Freedom,
    Implicit,
    Piece,
    Section,
    Stepper,
    breaks_of,
    contact_period,
    forced_rate,
    freedom_of,
    held,
    own_rates,
    passed,
    sides_of,
    twists,
)

SAMPLES = 1001
"""Samples where none are asked for."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Adaptive:
    """Steps as long as their error allows, contacts located exactly.

    Parameters
    ----------
    rtol : float
        Error of speeds and of the work in one step, as a share.
    atol : float [rad, rad/s]
        Error of angles and of speeds in one step.
    stiff : bool, optional
        Whether to integrate implicitly; found from the fastest rate of the drive when not given. Coordinates without
        inertia always need it.
    """

    rtol: float = 1e-10
    atol: float = 1e-11
    stiff: bool | None = None

    def __post_init__(self) -> None:
        text = _("{given} given; more than 0 is needed")
        check(
            Problem(name, text.format(given=getattr(self, name)))
            for name in ("rtol", "atol")
            if not (math.isfinite(getattr(self, name)) and getattr(self, name) > 0.0)
        )


Method: TypeAlias = Adaptive | FixedStep


def simulate(
    model: TorsionalModel,
    *,
    span: float | tuple[float, float],
    times: int | ArrayLike = SAMPLES,
    angle: ArrayLike | None = None,
    speed: ArrayLike | None = None,
    method: Method | None = None,
    progress: Progress | None = None,
) -> Simulation:
    """Return the motion of a torsional model in time.

    Parameters
    ----------
    model : TorsionalModel
        One drive, or many (...).
    span : float or (float, float) [s]
        How long, or from when to when.
    times : int or array (t,) [s]
        How many samples evenly over the span, or when.
    angle : array (..., R) [rad], optional
        Angles of the coordinates at the start; 0 when not given. Of coordinates without inertia or damper they are
        where their balance is looked for.
    speed : float or array (..., R) [rad/s], optional
        Speeds of the coordinates at the start; that of the forced station when not given, else 0.
    method : Adaptive or FixedStep, optional
        How to integrate; FixedStep takes many drives at once.
    progress : function, optional
        Called with the share done; answering "stop" ends the simulation with what is done.

    Returns
    -------
    Simulation

    Raises
    ------
    InputError
        A span that does not go forward, samples outside it, initial values that do not fit.

    Notes
    -----
    (Σ J F'²) q̈ + (Σ J F' F'') q̇² = Σ F' τ for every coordinate, exact for any angles.

    Examples
    --------
    >>> from cardan.questions.torsion.model.torsional_model import torsional_line
    >>> line = torsional_line([[1.0], [0.0, 0.5]], stiffness=[[], [2000.0]], joint_angle=[0.35], input_speed=30.0)
    >>> found = simulate(line, span=0.2)
    >>> round(float(found.extremes.torque_high[0]), 2), bool(found.imbalance < 1e-9)
    (349.64, True)
    """
    begin, end = (float(one) for one in (span if isinstance(span, tuple) else (0.0, span)))
    way = Adaptive() if method is None else method
    samples = np.linspace(begin, end, times) if isinstance(times, int) else np.asarray(times, dtype=float)
    check(_span_problems(begin, end, samples))
    angle_error = leading(model)
    q, rate = _start(model, angle_error, begin, angle, speed)
    if isinstance(way, FixedStep):
        return stepped(model, way, span=(begin, end), times=samples, q=q, rate=rate, progress=progress)
    tasks = [
        Task(
            model=one,
            motion=_motion(one, begin, q[place]),
            tolerance=(way.rtol, way.atol),
            stiff=way.stiff,
            span=(begin, end),
            times=samples,
            q=q[place],
            rate=rate[place],
        )
        for k, place in enumerate(np.ndindex(angle_error))
        for one in [single(model, angle_error, k) if angle_error else model]
    ]
    found = [march(task, _part(progress, k, len(tasks))) for k, task in enumerate(tasks)]
    return found[0] if not angle_error else _together(found, angle_error)


def _span_problems(begin: float, end: float, samples: Array) -> Iterator[Problem]:
    if not (math.isfinite(begin) and math.isfinite(end) and end > begin):
        yield Problem("span", _("from {begin:.6g} s to {end:.6g} s is not a span of time").format(begin=begin, end=end))
    elif samples.ndim != 1 or not np.all(np.diff(samples) > 0.0):
        yield Problem("times", _("need to rise"))
    elif len(samples) and not (begin <= samples[0] and samples[-1] <= end):
        text = _("from {first:.6g} s to {last:.6g} s given; the span is from {begin:.6g} s to {end:.6g} s")
        yield Problem("times", text.format(first=samples[0], last=samples[-1], begin=begin, end=end))


def _start(
    model: TorsionalModel, outer: tuple[int, ...], begin: float, angle: ArrayLike | None, speed: ArrayLike | None
) -> tuple[Array, Array]:
    """Return angles and speeds of the coordinates at the start, arrays (..., R)."""
    shape = (*outer, model.coordinates)
    forced: Array = 0.0
    if model.input_motion is not None:
        forced = model.input_motion.at(np.asarray(begin))[1]
    elif model.input_speed is not None:
        forced = np.asarray(model.input_speed)[..., None]
    problems, found = [], []
    for name, value, default in (("angle", angle, 0.0), ("speed", speed, forced)):
        given = np.asarray(default if value is None else value, dtype=float)
        try:
            found.append(np.broadcast_to(given, shape).copy())
        except ValueError:
            text = _("{given} values given, {wanted} needed, one for each coordinate")
            problems.append(Problem(name, text.format(given=given.shape[-1], wanted=model.coordinates)))
            continue
        if not np.all(np.isfinite(given)):
            problems.append(Problem(name, _("{value} is not finite").format(value=given[~np.isfinite(given)].flat[0])))
    check(problems)
    if not model.free:
        found[1][..., :1] = forced
        if model.input_motion is not None:
            found[0][..., 0] = model.input_motion.at(np.asarray(begin))[0]
    return found[0], found[1]


def _motion(model: TorsionalModel, begin: float, q: Array) -> InputMotion | None:
    """Return what is forced on the first station of one drive."""
    if model.input_speed is None:
        return model.input_motion
    speed = float(model.input_speed)
    return Uniform(speed=speed, angle=float(q[0]) - speed * begin)


def _part(progress: Progress | None, k: int, count: int) -> Progress | None:
    """Return what tells the progress of one of several drives as that of all."""
    if progress is None or count == 1:
        return progress
    return lambda share: progress((k + share) / count)


def _together(found: list[Simulation], outer: tuple[int, ...]) -> Simulation:
    """Return simulations of single drives as one of many."""

    def stacked(parts: list[Array]) -> Array:
        return np.stack(parts).reshape(*outer, *np.shape(parts[0]))

    first = found[0]
    own = {
        one.name: stacked([getattr(single, one.name) for single in found])
        for one in fields(Simulation)
        if one.name not in ("times", "extremes", "steps", "method") and getattr(first, one.name) is not None
    }
    extremes = Extremes(
        **{one.name: stacked([getattr(single.extremes, one.name) for single in found]) for one in fields(Extremes)}
    )
    methods = sorted({single.method for single in found})
    return replace(
        first, **own, extremes=extremes, steps=sum(single.steps for single in found), method=", ".join(methods)
    )


# Coordinates without inertia: what of them is in static balance, how firmly, and where.

SNAP = 1e-10
"""A static stiffness below this share of the stiffest element's holds no joint."""

LOOSE = 1e-8
"""Share of its stiffness that an element keeps within its play where a station without inertia may hang loose in it."""


def still_part(
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


def hold(model: TorsionalModel, freedom: Freedom, time: float, q: Array, rate: Array) -> float:
    """Return the least static stiffness of what has neither inertia nor damper [N·m/rad]."""
    stiffness = still_part(model, freedom, time, q, rate)[3]
    return float(np.min(np.linalg.eigvalsh(0.5 * (stiffness + stiffness.T)), initial=math.inf))


def settled(model: TorsionalModel, freedom: Freedom, q: Array, rate: Array, time: float) -> Array | None:
    """Return the angles with what has neither inertia nor damper in balance; None where torque snaps it through."""
    found, rank = q.copy(), freedom.free
    for _round in range(100):
        light, still, left, stiffness = still_part(model, freedom, time, found[rank], rate[rank])
        if not len(left):
            return found
        try:
            change = np.linalg.solve(stiffness, left)
        except np.linalg.LinAlgError:
            return None
        change *= min(1.0, 0.5 / max(float(np.max(np.abs(change))), 1e-300))
        found[light] -= still @ change
        if float(np.max(np.abs(change))) <= 1e-14 * max(1.0, float(np.max(np.abs(found)))):
            least = hold(model, freedom, time, found[rank], rate[rank])
            return found if least > SNAP * float(np.max(model.stiffness, initial=0.0)) else None
    return None


# Steps through time as long as their error allows, from contact to contact.

RESTLESS = 200
"""Contacts that change so often while time all but stands still never settle."""

IMPLICIT_COST = 6.0
"""Work of the implicit method for one radian of a rate that lives over that of the explicit one, measured."""

CONTACT_STEPS = 4.0
"""Steps in the period of an element in contact, at least: within each, eight places are looked at."""

SETTLING = 20
"""How often contacts may follow from a balance and the balance from contacts, before it is left as it is."""

HALVINGS = 30
"""How often the distance to the start is halved in search of a contact that lasts a moment."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Task:
    """What is to be done."""

    model: TorsionalModel  # one drive
    motion: InputMotion | None  # what is forced on the first coordinate
    tolerance: tuple[float, float]  # share for speeds and work; angles [rad] and speeds [rad/s]
    stiff: bool | None  # whether to integrate implicitly; None to find out
    span: tuple[float, float]  # [s]
    times: Array  # (t,) [s]: samples
    q: Array  # q, rate (R,) [rad, rad/s]: at the start
    rate: Array  # (R,) [rad/s]


def march(task: Task, progress: Progress | None) -> Simulation:
    """Return the simulation of one drive."""
    model, motion = task.model, task.motion
    freedom = freedom_of(model, motion)
    record = Record(model, task.times)
    ended, steps = task.span[0], 0
    walk = _Walk(task, freedom, implicit=_implicit(task, freedom))
    for piece, now in walk.pieces():
        record.add(piece, now)
        ended, steps = piece.end, steps + 1
        if progress is not None and progress(_share(task.span, ended)) == "stop" and ended < task.span[1]:
            walk.status = Status.CANCELLED
            break
    acceleration = None if motion is None else _accelerations(motion, task.times)
    return reported(
        model,
        task.times,
        record.q,
        record.rate,
        record.work,
        forced_acceleration=acceleration,
        extremes=record.extremes(),
        status=np.asarray(int(walk.status)),
        ended=np.asarray(ended),
        steps=steps,
        method="implicit" if walk.implicit else "explicit",
    )


def _share(span: tuple[float, float], time: float) -> float:
    return (time - span[0]) / (span[1] - span[0])


def _accelerations(motion: InputMotion, times: Array) -> Array:
    return np.broadcast_to(motion.at(times)[2], times.shape)


class _Walk:
    """The way through time: pieces of steps, and how it ended."""

    def __init__(self, task: Task, freedom: Freedom, *, implicit: bool) -> None:
        self.task, self.freedom, self.implicit = task, freedom, implicit
        self.light = len(freedom.heavy) < len(freedom.free)
        self.state = (task.span[0], task.q[freedom.free], task.rate[freedom.free], 0.0)
        self.status = Status.DONE
        self.sides = self._sides()
        self._settle(None)
        self.state = (*self.state[:3], 0.0)
        self.longest = float(contact_period(task.model, freedom.free, task.q)) / CONTACT_STEPS
        self.first: float | None = None

    def _held(self) -> TorsionalModel:
        return held(self.task.model, self.sides, loose=LOOSE if self.light else 0.0)

    def _settle(self, changed: int | None) -> None:
        """Bring what has neither inertia nor damper to its balance; what a spring loses thereby counts as taken.

        The element that changed its contact has its side; the others get theirs from where this leads.
        """
        if not self.light:
            return
        time, q, rate, work = self.state
        angles, rates = (one[0] for one in self.freedom.whole(np.asarray([time]), q[None], rate[None]))
        stored = float(energy(self.task.model, angles, rates))
        for _round in range(SETTLING):
            found = settled(self._held(), self.freedom, angles, rates, time)
            if found is None:
                self.status = Status.SNAPPED
                return
            angles = found
            self.state = (time, angles[self.freedom.free], rate, work)
            before, self.sides = self.sides, self._sides()
            if changed is not None:
                self.sides[changed] = before[changed]
            if np.array_equal(before, self.sides):
                break
        lost = stored - float(energy(self.task.model, angles, rates))
        self.state = (*self.state[:3], work - lost)

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
        if self.status is not Status.DONE:
            return
        restless = 0
        for end in breaks_of(task.model, task.motion, *task.span):
            if task.motion is not None:
                self.freedom = replace(self.freedom, motion=Section(whole=task.motion, end=end))
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
        model = self._held()
        kind = Implicit if self.implicit else Explicit
        stepper: Stepper = kind(model, self.freedom, task.tolerance, self.state, end, self.longest, self.first)
        while stepper.time < end:
            piece = stepper.step()
            if piece is None:
                self.status = self._cause(model)
                return
            change = self._change(piece)
            if change is not None:
                piece = stepper.cut(piece, change[0])
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
                self._settle(change[1])
                self.first = min(stepper.length, self.longest)
                return

    def _change(self, piece: Piece) -> tuple[float, int, int] | None:
        """Return when the first contact changes within a piece, of which element, and to which side."""
        model = self.task.model
        if not np.any(model.backlash > 0.0):
            return None
        times = piece.within()
        over = passed(model, self.sides, twists(model, self._whole(piece, times)[0]))
        late = np.flatnonzero(np.any(over > 0.0, axis=(-2, -1)))
        if not len(late):
            return None
        before = float(times[late[0] - 1]) if late[0] else piece.start
        found = []
        for e, end in np.argwhere(over[late[0]] > 0.0).tolist():

            def past(time: float, e: int = e, end: int = end) -> float:
                twist = twists(model, self._whole(piece, np.asarray([time]))[0])
                return float(passed(model, self.sides, twist)[0, e, end])

            side = 0 if self.sides[e] else (1, -1)[end]
            found.append((_first_zero(past, before, float(times[late[0]])), e, side))
        when, e, side = min(found)
        return max(when, float(np.nextafter(piece.start, np.inf))), e, side

    def _bounded(self, model: TorsionalModel, time: float, q: Array, rate: Array, work: float) -> bool:
        if not (np.all(np.isfinite(q)) and np.all(np.isfinite(rate)) and math.isfinite(work)):
            return False
        twist = twists(model, self.freedom.whole(np.asarray([time]), q[None], rate[None])[0])
        heavy = np.searchsorted(self.freedom.free, self.freedom.heavy)
        return bool(np.all(np.abs(twist) < TWIST_LIMIT) and np.all(np.abs(rate[heavy]) < SPEED_LIMIT))

    def _cause(self, model: TorsionalModel) -> Status:
        """Return why no step was short enough."""
        if self.light and hold(model, self.freedom, *self.state[:3]) < 1e-2 * _stiffest(model):
            return Status.SNAPPED
        return Status.STALLED

    def _snapped(self, model: TorsionalModel) -> bool:
        return self.light and hold(model, self.freedom, *self.state[:3]) <= SNAP * _stiffest(model)


def _stiffest(model: TorsionalModel) -> float:
    return float(np.max(model.stiffness, initial=0.0))


def _first_zero(past: Callable[[float], float], before: float, after: float) -> float:
    """Return when a function becomes positive that is so at the end.

    Where the piece begins at the end of a contact rounding may make it so there too: if it falls from there, the place
    is the one at which it has risen again.
    """
    low = before
    if past(before) >= 0.0:
        shares = (0.5**k for k in range(1, HALVINGS + 1))
        fallen = (before + share * (after - before) for share in shares)
        low = next((time for time in fallen if past(time) < 0.0), before)
        if low == before:
            return before
    return float(scipy.optimize.brentq(past, low, after, xtol=1e-15))


def _implicit(task: Task, freedom: Freedom) -> bool:
    """Tell whether the implicit method is needed, or is asked for, or costs less."""
    if len(freedom.heavy) < len(freedom.free) or task.stiff:
        return True
    if task.stiff is False or not len(freedom.free):
        return False
    length = task.span[1] - task.span[0]
    fastest, living = own_rates(task.model, freedom.free, task.q, task.rate, task.span[0], length)
    forced = forced_rate(task.model, task.motion, task.rate, task.span)
    return bool(fastest > IMPLICIT_COST * max(float(living), float(forced), 1.0 / length))
