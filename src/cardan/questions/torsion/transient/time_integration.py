"""Steps through time of one torsional model: pieces of smooth motion between contacts, steps of tables and breaks.

While its sides of contact stay the same a drive with backlash is one without, its elements at rest at half the play. So
each piece is smooth, and an integrator of high order keeps its order up to the moment at which a contact changes.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np
import scipy

from cardan.maths.arrays import Array
from cardan.maths.periodic.radau import Radau, Step
from cardan.questions.torsion.model.inputs import Asynchronous, History, InputMotion, Swinging
from cardan.questions.torsion.model.torsional_balance import Slopes, balance, linearised, places, power
from cardan.questions.torsion.model.torsional_layouts import forces_of
from cardan.questions.torsion.model.torsional_model import TorsionalModel

WITHIN = 8
"""Places of a step at which contacts are looked at, and through which extremes are found."""

LENIENT = 0.75
"""Power of the tolerance by which the implicit method is judged."""

FELT = 1e-3
"""Torque [N·m] that an error of an angle in a step may make in the stiffest element."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Freedom:
    """Which coordinates of a drive are free, and which of them have inertia."""

    motion: InputMotion | None  # what is forced on the first coordinate
    free: Array  # coordinates that are not forced
    heavy: Array  # those of them that turn some inertia

    def whole(self, time: Array, q: Array, rate: Array) -> tuple[Array, Array]:
        """Return angles and speeds of all coordinates (m, R) for those of the free ones (m, u)."""
        if self.motion is None:
            return q, rate
        angle, speed, _acceleration = self.motion.at(time)
        return np.column_stack((angle, q)), np.column_stack((speed, rate))


@dataclass(frozen=True, kw_only=True, slots=True)
class Section:
    """A motion up to a time at which its acceleration jumps: there it is still that of before."""

    whole: InputMotion
    end: float

    @property
    def breaks(self) -> tuple[float, ...]:
        """Return no times."""
        return ()

    def at(self, time: Array) -> tuple[Array, Array, Array]:
        """Return angle, speed and acceleration."""
        return self.whole.at(np.minimum(time, np.nextafter(self.end, -np.inf)))


def freedom_of(model: TorsionalModel, motion: InputMotion | None) -> Freedom:
    """Return which coordinates of a model of one drive are free."""
    inertia = np.zeros(model.coordinates)
    np.add.at(inertia, list(model.coordinate), model.inertia)
    free = np.arange(model.coordinates)[0 if motion is None else 1 :]
    return Freedom(motion=motion, free=free, heavy=free[inertia[free] > 0.0])


@dataclass(frozen=True, eq=False, kw_only=True)
class Piece:
    """A step or the part of it before a contact changed."""

    start: float  # [s]
    end: float  # [s]
    # from times (m,) within the piece to angles and speeds of the free coordinates (m, u) and the work (m,)
    dense: Callable[[Array], tuple[Array, Array, Array]]

    def within(self) -> Array:
        """Return evenly spaced times without the start [s]."""
        return self.start + (self.end - self.start) * np.arange(1, WITHIN + 1) / WITHIN


class Stepper(Protocol):
    """Goes forward through a smooth piece of motion."""

    time: float

    @property
    def length(self) -> float:
        """Length of the step to come [s]."""

    def step(self) -> Piece | None:
        """Return the next step; None where none is short enough."""

    def cut(self, piece: Piece, end: float) -> Piece:
        """Return the last step as far as a time within it; no more steps follow."""


class Explicit:
    """Dormand and Prince's method of order eight, for drives all of whose coordinates turn some inertia."""

    def __init__(
        self,
        model: TorsionalModel,
        freedom: Freedom,
        tolerance: tuple[float, float],
        state: tuple[float, Array, Array, float],
        end: float,
        longest: float,
        first: float | None,
    ) -> None:
        start, q, rate, work = state
        self.count = count = len(freedom.free)
        forces, motion = forces_of(model), freedom.motion

        def derivative(time: float, y: Array) -> Array:
            numbers = y.tolist()
            angles, speeds = numbers[:count], numbers[count:-1]
            if motion is None:
                mass, force, brought = forces(time, angles, speeds)
                return np.array([*speeds, *(f / m for f, m in zip(force, mass, strict=True)), brought])
            angle, speed, acceleration = (float(one) for one in motion.at(time))
            mass, force, brought = forces(time, [angle, *angles], [speed, *speeds], acceleration)
            brought += (mass[0] * acceleration - force[0]) * speed
            return np.array([*speeds, *(f / m for f, m in zip(force[1:], mass[1:], strict=True)), brought])

        relative, absolute = tolerance
        size = _energy_size(model, freedom, start, q, rate)
        least = 100.0 * np.finfo(float).eps
        self.solver = scipy.integrate.DOP853(
            derivative,
            start,
            np.concatenate((q, rate, [work])),
            end,
            rtol=np.concatenate((np.full(count, least), np.full(count + 1, max(relative, least)))),  # type: ignore[arg-type]
            atol=np.concatenate((np.full(2 * count, absolute), [relative * size])),  # type: ignore[arg-type]
            max_step=longest,
            first_step=None if first is None else min(first, longest, end - start),
        )
        self.time = start

    @property
    def length(self) -> float:
        """Length of the step to come [s]."""
        return float(self.solver.h_abs)

    def step(self) -> Piece | None:
        """Return the next step; None where none is short enough."""
        start, count = self.time, self.count
        with np.errstate(all="ignore"):
            self.solver.step()
        if self.solver.status == "failed":
            return None
        self.time = float(self.solver.t)
        curve = self.solver.dense_output()

        def dense(time: Array) -> tuple[Array, Array, Array]:
            y = curve(time)
            return y[:count].T, y[count:-1].T, y[-1]

        return Piece(start=start, end=self.time, dense=dense)

    def cut(self, piece: Piece, end: float) -> Piece:
        """Return the last step as far as a time within it: between its ends it is right to order seven."""
        return replace(piece, end=end)


class Implicit:
    """Radau collocation, for stiff drives and for coordinates without inertia."""

    def __init__(
        self,
        model: TorsionalModel,
        freedom: Freedom,
        tolerance: tuple[float, float],
        state: tuple[float, Array, Array, float],
        end: float,
        longest: float,
        first: float | None,
    ) -> None:
        start, q, rate, self.work = state
        self.model, self.freedom = model, freedom
        self.count = len(freedom.free)
        self.own: Array = np.searchsorted(freedom.free, freedom.heavy)
        # The error of a step of order nine is judged by a formula of order five: by that the tolerance counts less.
        relative, absolute = (one**LENIENT for one in tolerance)
        angle = min(absolute, FELT / float(np.max(model.stiffness, initial=FELT)))

        def scale(y: Array) -> Array:
            speeds = absolute + relative * np.abs(y[self.count :])
            return np.concatenate((np.full(self.count, angle), speeds))

        self.radau = Radau(
            self,
            start,
            np.concatenate((q, rate[self.own])),
            end,
            scale=scale,
            first=1e-3 * (end - start) if first is None else first,
            longest=longest,
        )
        self.time = start

    @property
    def length(self) -> float:
        """Length of the step to come [s]."""
        return self.radau.length

    def motion(self, time: Array, y: Array, slope: Array) -> tuple[Array, Array, Array]:
        """Return angles, speeds and accelerations of all coordinates (m, R)."""
        u, own = self.count, self.own
        rate, change = slope[:, :u].copy(), np.zeros((len(y), u))
        rate[:, own], change[:, own] = y[:, u:], slope[:, u:]
        if self.freedom.motion is None:
            return y[:, :u], rate, change
        forced = self.freedom.motion.at(time)
        return tuple(  # type: ignore[return-value]
            np.column_stack(pair) for pair in zip(forced, (y[:, :u], rate, change), strict=True)
        )

    def residual(self, time: Array, y: Array, slope: Array) -> Array:
        """Return what is left of the balance of torques, and of speeds as derivatives of angles."""
        left = balance(self.model, *self.motion(time, y, slope), time)[:, self.freedom.free]
        return np.concatenate((left, slope[:, self.own] - y[:, self.count :]), axis=-1)

    def linearised(self, time: Array, y: Array, slope: Array) -> tuple[Array, Array, Array]:
        """Return `residual` and its slopes by angles and speeds, and by their derivatives."""
        left, by = linearised(self.model, *self.motion(time, y, slope), time)
        u, own, free = self.count, self.own, self.freedom.free
        inner = np.ix_(np.arange(len(y)), free, free)
        size = u + len(own)
        by_y, by_slope = np.zeros((len(y), size, size)), np.zeros((len(y), size, size))
        rows = np.arange(len(own))
        by_y[:, :u, :u] = by.stiffness[inner]
        by_y[:, :u, u:] = by.damping[inner][:, :, own]
        by_y[:, u + rows, u + rows] = -1.0
        light = np.setdiff1d(np.arange(u), own)
        by_slope[:, :u, light] = by.damping[inner][:, :, light]
        by_slope[:, own, u + rows] = by.mass[:, free[own]]
        if by.coupled is not None:
            by_slope[np.ix_(np.arange(len(y)), own, u + rows)] += by.coupled[
                np.ix_(np.arange(len(y)), free[own], free[own])
            ]
        by_slope[:, u + rows, own] = 1.0
        rest = np.concatenate((left[:, free], slope[:, own] - y[:, u:]), axis=-1)
        return rest, by_y, by_slope

    def step(self) -> Piece | None:
        """Return the next step; None where none is short enough."""
        with np.errstate(all="ignore"):
            found = self.radau.step()
        if found is None:
            return None
        return self._piece(found)

    def cut(self, piece: Piece, end: float) -> Piece:
        """Return the last step as far as a time within it, taken anew: its end is righter than what lies between."""
        last = self.radau.last
        assert last is not None
        self.radau.time, self.radau.y = last.start, last.before
        with np.errstate(all="ignore"):
            found = self.radau.step(upto=end)
        if found is None:
            return replace(piece, end=end)
        self.work = float(piece.dense(np.asarray([last.start]))[2][0])
        return self._piece(found)

    def _piece(self, found: Step) -> Piece:
        self.time = found.end
        brought, before = self._power(found), self.work
        self.work += found.integral(brought)

        def dense(time: Array) -> tuple[Array, Array, Array]:
            y, rate = found.at(time), found.slope(time)[:, : self.count]
            rate[:, self.own] = y[:, self.count :]
            return y[:, : self.count], rate, before + found.at(time, brought)

        return Piece(start=found.start, end=found.end, dense=dense)

    def _power(self, step: Step) -> Array:
        time, y, slope = step.stages
        q, rate, change = self.motion(time, y, slope)
        given, lost = power(self.model, q, rate, time)
        if self.freedom.motion is not None:
            given = given + balance(self.model, q, rate, change, time)[:, 0] * rate[:, 0]
        return given - lost


def _energy_size(model: TorsionalModel, freedom: Freedom, time: float, q: Array, rate: Array) -> float:
    """Return an energy that this drive may have [J]: that of its inertia at its fastest speed, at least 1 rad/s."""
    _q, speeds = freedom.whole(np.asarray([time]), q[None], rate[None])
    return float(0.5 * np.sum(model.inertia) * max(1.0, float(np.max(np.abs(speeds)))) ** 2)


def held(model: TorsionalModel, sides: Array, *, loose: float = 0.0) -> TorsionalModel:
    """Return the drive without backlash that moves like this one while the sides of its contacts stay.

    sides (E,) of int: 1 or -1 where an element touches, 0 within its play; 1 without play.
    loose: share of its stiffness that an element keeps within its play, drawn to the middle of it.
    """
    touching = np.abs(sides).astype(float)
    return replace(
        model,
        stiffness=model.stiffness * np.maximum(touching, loose),
        damping=model.damping * touching,
        backlash=np.zeros_like(model.backlash),
        friction=None if model.friction is None else model.friction * touching,
        rest=0.5 * sides * model.backlash,
    )


def twists(model: TorsionalModel, q: Array) -> Array:
    """Return F_A - F_B of all elements, array (m, E) for angles (m, R)."""
    angle = places(model, q).angle
    return angle[:, [a for a, _b in model.elements]] - angle[:, [b for _a, b in model.elements]]


def sides_of(model: TorsionalModel, twist: Array, rate: Array) -> Array:
    """Return on which side each element (E,) touches; where it just does, by the speed of its twist."""
    half = 0.5 * model.backlash
    sides = np.where(twist > half, 1, np.where(twist < -half, -1, 0))
    sides = np.where((twist == half) & (rate > 0.0), 1, np.where((twist == -half) & (rate < 0.0), -1, sides))
    return np.where(half == 0.0, 1, sides)


def passed(model: TorsionalModel, sides: Array, twist: Array) -> Array:
    """Return how far each element is past the end of its contact, or past either end of its play.

    sides (E,) of int, twist (m, E) [rad].
    Returns (m, E, 2) [rad]: positive past the end; of an element in contact the first one counts alone, of a loose one
    they are its positive and its negative side.
    """
    half = 0.5 * model.backlash
    touching, never = sides != 0, np.full_like(twist, -1.0)
    first = np.where(touching, half - sides * twist, twist - half)
    second = np.where(touching, never, -twist - half)
    return np.where(half[:, None] == 0.0, -1.0, np.stack((first, second), axis=-1))


def breaks_of(model: TorsionalModel, motion: InputMotion | None, start: float, end: float) -> Iterator[float]:
    """Yield times between which nothing jumps, the end last."""
    times = set() if motion is None else set(motion.breaks)
    for torque in model.torques:
        if isinstance(torque.law, History):
            times |= set(np.asarray(torque.law.times, dtype=float).tolist())
    yield from sorted(time for time in times if start < time < end)
    yield end


# How fast a drive can move: its own rates, what excites it, how short its contacts are.

FADED = 25.0
"""What is damped by e to this power is gone."""

ORDERS = 4.0
"""Order of the shaft up to which joints excite a drive noticeably."""

PLACES = 8
"""Positions of half a turn at which a drive is looked at; of a turn where joints have laws of their own."""


def own_rates(
    model: TorsionalModel, free: Array, q: Array, rate: Array, time: float, length: float
) -> tuple[Array, Array]:
    """Return the fastest rate of drives, and the fastest one that lives on.

    model: one drive, or many in one axis with torques ready for moments in a second one.
    free: coordinates that are not forced; all of them turn some inertia.
    q, rate (..., R) [rad, rad/s], time [s].
    length [s]: how long the drive is followed: what is damped away early counts by its share of that.
    Returns fastest, living (...) [rad/s]: largest |λ| of the linearised drive over half a turn, all elements in
    contact.
    """
    by = _turns(model, q, rate, time)
    count = len(free)
    inner = (..., free[:, None], free[None, :])
    share = 1.0 / by.mass[..., free, None]
    system = np.zeros((*by.mass.shape[:-1], 2 * count, 2 * count))
    system[..., :count, count:] = np.eye(count)
    system[..., count:, :count] = -share * by.stiffness[inner]
    system[..., count:, count:] = -share * by.damping[inner]
    values = np.linalg.eigvals(system)
    alive = 1.0 / np.maximum(1.0, -values.real * length / FADED)
    size = np.abs(values)
    return np.max(size, axis=(-2, -1), initial=0.0), np.max(size * alive, axis=(-2, -1), initial=0.0)


def _turns(model: TorsionalModel, q: Array, rate: Array, time: float) -> Slopes:
    """Return drives linearised over half a turn, all elements in contact."""
    half_turns = 1 if model.sums is None else 2
    turn = np.linspace(0.0, half_turns * math.pi, half_turns * PLACES, endpoint=False)
    places = q[..., None, :] + turn[:, None]
    rates = np.broadcast_to(rate[..., None, :], places.shape)
    touching = replace(held(model, np.ones(len(model.elements))), rest=None)
    return linearised(touching, places, rates, np.zeros_like(places), np.full(places.shape[:-1], time))[1]


def forced_rate(model: TorsionalModel, motion: InputMotion | None, rate: Array, span: tuple[float, float]) -> Array:
    """Return how fast joints and torques excite drives, array (...) [rad/s]."""
    speed = np.max(np.abs(rate), axis=-1)
    if motion is not None:
        moments = [*span, *(time for time in motion.breaks if span[0] < time < span[1])]
        speed = np.maximum(speed, np.max(np.abs(motion.at(np.asarray(moments))[1])))
    order = ORDERS
    for torque in model.torques:
        if isinstance(torque.law, Asynchronous):
            speed = np.maximum(speed, np.max(np.abs(torque.law.synchronous_speed)))
        if isinstance(torque.law, Swinging):
            order = max(order, float(np.max(np.abs(torque.law.frequency))))
    return speed * order


def contact_period(model: TorsionalModel, free: Array, q: Array) -> Array:
    """Return the shortest period of an element with play in contact, array (...) [s]; infinite without play."""
    if not np.any(model.backlash > 0.0):
        return np.full(q.shape[:-1], math.inf)
    mass = np.min(_turns(model, q, np.zeros_like(q), 0.0).mass, axis=-2)
    forced = np.setdiff1d(np.arange(model.coordinates), free)
    mass[..., forced] = math.inf
    light = np.min(np.where(mass > 0.0, mass, math.inf), axis=-1, keepdims=True)
    mass = np.where(mass > 0.0, mass, light)
    rate = np.zeros(q.shape[:-1])
    for e, (a, b) in enumerate(model.elements):
        ends = sum(1.0 / mass[..., model.coordinate[k]] for k in (a, b))
        own = np.sqrt(model.stiffness[..., e] * ends)
        rate = np.maximum(rate, np.where(model.backlash[..., e] > 0.0, own, 0.0))
    with np.errstate(divide="ignore"):
        return 2.0 * math.pi / rate
