"""Periodic motions of oscillators that switch, as those with play do: smooth pieces between switches, by shooting.

Every element of the oscillator has a side; while all sides stay, its equations are smooth. A period is cut at the
switches, each piece into steps of collocation. The state at the beginning of every step, the times of the switches and
what happens within the steps are found together by Newton's method, with exact slopes; what a disturbance becomes over
the period, switches included, is the product of the same slopes.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Protocol

import numpy as np

from cardan.maths.arrays import Array, ArrayLike

from .floquet import STAGES, collocation
from .harmonics import Linearised, Status

WITHIN = 1024
"""Places of a period at which switches are looked for, at least."""

BRIEF = 1e-8
"""Pieces shorter than this share of the period have vanished: the order of the switches is another one."""

HALVINGS = 12
"""How often a switch is halved in: Newton's method moves it to its place."""

GRAZING = 1e-6
"""An element that switches for less than this share of the period only grazes."""

NEAR = 1e-9
"""Overlap of sides that rounding explains, over the play."""


LEAST = 4
"""Newton steps that the work must allow for, for the search to begin."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Shooting:
    """How to find periodic motions by shooting over pieces.

    Attributes
    ----------
    steps : int
        Newton steps at most.
    rounds : int
        Times that the order of the switches is read off anew.
    reach : float
        Largest phase of the fastest oscillation in a step: at 0.4 even what is amid a step, where the order is only
        six, is right to 1e-8.
    leap : float
        Longest way of a coordinate in one Newton step.
    work : int
        Steps of collocation linearised at most, times the coordinates: some seconds, then there is no motion.
    """

    steps: int = 16
    rounds: int = 6
    reach: float = 0.4
    leap: float = 0.3
    work: int = 150_000


class Curve(Protocol):
    """A motion of the right period."""

    @property
    def force(self) -> float:
        """Constant force on the first coordinate."""

    def at(self, phase: Array) -> tuple[Array, Array, Array]:
        """Return x and its first two derivatives by the phase, arrays (p, R)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Pieces:
    """A periodic motion in steps of collocation."""

    omega: float  # [rad/s]: rate of the phase
    time: Array  # (n+1,) [s]: ends of the steps, the last one period after the first, which is 0
    x: Array  # x, v (n+1, R): state there; the speeds of coordinates without mass mean nothing
    v: Array  # (n+1, R)
    inner: Array  # (n, s, R): accelerations at the points of the steps; speeds of coordinates without mass
    sides: Array  # (n, E) of int: side of every element in every step
    heavy: Array  # (R,) of bool
    force: float  # constant force on the first coordinate of a free motion
    # (m, m): what a disturbance (x, v) at time 0 has become after a period, speeds without mass left out
    monodromy: Array
    status: Status
    work: int  # what the search took of `Shooting.work`

    @property
    def duration(self) -> float:
        """Of a period [s]."""
        return float(self.time[-1])

    @property
    def switches(self) -> Array:
        """Times at which a side changes, array (k,) [s]."""
        changes = np.any(self.sides[1:] != self.sides[:-1], axis=-1)
        found: Array = self.time[1:-1][changes]
        return found

    @cached_property
    def points(self) -> tuple[Array, Array, Array, Array, Array]:
        """Times (n, s), weights (n, s) that integrate over the period, and x, v, a there (n, s, R)."""
        h = np.diff(self.time)
        places, table = collocation(self.inner.shape[1], stiff=not self.heavy.all())
        x, v, a = stages(self.x[:-1], self.v[:-1], self.inner, h, self.heavy)
        return self.time[:-1, None] + h[:, None] * places, h[:, None] * table[-1], x, v, a

    @cached_property
    def _powers(self) -> Array:
        """Coefficients of what is within the steps by powers of the share of the step, array (n, s, R)."""
        places, _table = collocation(self.inner.shape[1], stiff=not self.heavy.all())
        return np.matmul(np.linalg.inv(places[:, None] ** np.arange(len(places))), self.inner)

    def at(self, phase: ArrayLike) -> tuple[Array, Array, Array]:
        """Return x and its first two derivatives by the phase at phases (p,), arrays (p, R)."""
        turned = np.asarray(phase, dtype=float) / self.omega
        time = turned - self.duration * np.floor(turned / self.duration)
        step = np.clip(np.searchsorted(self.time, time, side="right") - 1, 0, len(self.inner) - 1)
        x, v, a = self.inside(step, time - self.time[step])
        return x, v / self.omega, a / self.omega**2

    def inside(self, step: Array, since: Array) -> tuple[Array, Array, Array]:
        """Return x, v and a in steps (p,) at times since their beginning, arrays (p, R)."""
        powers = np.arange(1, self.inner.shape[1] + 1)
        span = np.diff(self.time)[step][:, None]
        share = since[:, None] / span
        each = self._powers[step]
        value = np.einsum("pk,pkr->pr", share ** (powers - 1), each)
        once = np.einsum("pk,pkr->pr", share**powers / powers, each) * span
        twice = np.einsum("pk,pkr->pr", share ** (powers + 1) / (powers * (powers + 1)), each) * span**2
        lean = np.einsum("pk,pkr->pr", (powers - 1) * share ** np.maximum(powers - 2, 0), each) / span
        x0, v0, heavy = self.x[step], self.v[step], self.heavy
        return (
            np.where(heavy, x0 + since[:, None] * v0 + twice, x0 + once),
            np.where(heavy, v0 + once, value),
            np.where(heavy, value, lean),
        )


def periodic_pieces(
    system: Switching, omega: float, start: Curve, *, free: bool = False, method: Shooting | None = None
) -> Pieces | None:
    """Return a periodic motion of an oscillator that switches.

    omega [rad/s]: rate of the phase z, of either sign; a period is 2π of it.
    start: motion to begin with.
    free: whether a motion may be shifted in time; then the first coordinate is 0 at time 0 and the constant force on it
    is sought.
    Returns Pieces or None: its status says whether Newton's method came to rest and all sides are as assumed. None
    where a period holds too many swings of the fastest for the work that may be done.
    The order of the switches is read off the motion at hand; when Newton's method has come to rest with them, it is
    read off again, until it stays.
    """
    how = method or Shooting()
    curve: Curve = start
    found: Pieces | None = None
    work = 0
    if LEAST * len(system.heavy) * 2.0 * math.pi * system.fastest / (abs(omega) * how.reach) > how.work:
        return None
    for _round in range(how.rounds if np.any(system.play > 0.0) else min(how.rounds, 2)):
        plan = _plan(system, omega, curve, how.reach)
        guess = _first_guess(plan, omega, curve, system.heavy)
        each = int(plan.counts.sum()) * len(system.heavy)
        guess, good, whole, done = _newton(system, omega, plan, guess, free, how, max((how.work - work) // each, 1))
        work += done * each
        found = _pieces(omega, plan, guess, system.heavy, whole, good, work)
        if not np.isfinite(found.x).all():
            break
        if good and _fits(system, found):
            return found
        if work + each > how.work:
            break
        curve = found
    assert found is not None
    return replace(found, status=Status.NO_CONVERGENCE)


def _pieces(omega: float, plan: Plan, guess: Guess, heavy: Array, whole: Array, good: bool, work: int) -> Pieces:
    ends = [
        start + (end - start) * np.arange(count) / count
        for start, end, count in zip(guess.times[:-1], guess.times[1:], plan.counts, strict=True)
    ]
    return Pieces(
        omega=omega,
        time=np.concatenate([*ends, guess.times[-1:]]),
        x=guess.x,
        v=guess.v,
        inner=guess.inner,
        sides=np.repeat(plan.sides, plan.counts, axis=0),
        heavy=heavy,
        force=guess.force,
        monodromy=whole,
        status=Status.CONVERGED if good else Status.NO_CONVERGENCE,
        work=work,
    )


def _side(twist: Array, play: Array) -> Array:
    return np.where(play == 0.0, 1, np.where(twist > play, 1, np.where(twist < -play, -1, 0)))


def _plan(system: Switching, omega: float, curve: Curve, reach: float) -> Plan:
    """Return the switches of a motion."""
    duration = 2.0 * math.pi / abs(omega)
    play = system.play
    count = max(WITHIN, 8 * math.ceil(system.fastest * duration)) if np.any(play > 0.0) else 1
    time = duration * np.arange(count + 1) / count

    def twists(when: Array) -> Array:
        return system.twist(omega * when, curve.at(omega * when)[0])[0]

    sides = _side(twists(time), play)
    passes: list[tuple[int, int, int, int]] = []
    for k, e in np.argwhere(sides[1:] != sides[:-1]).tolist():
        old, new = int(sides[k, e]), int(sides[k + 1, e])
        passes += [(k, e, a, b) for a, b in ([(old, new)] if abs(new - old) == 1 else [(old, 0), (0, new)])]
    at, element, before, after = np.asarray(passes, dtype=int).reshape(-1, 4).T
    when = _crossings(twists, time[at], time[at + 1], element, np.where(before, before, after) * play[element])
    found = zip(when.tolist(), *(one.tolist() for one in (element, before, after)), strict=True)
    events = _lasting(sorted(found), duration)
    here = sides[0].copy()
    all_sides = [here.copy()]
    for event in events:
        here[event[1]] = event[3]
        all_sides.append(here.copy())
    times = np.asarray([0.0, *[event[0] for event in events], duration])
    lengths = np.maximum(np.diff(times), 2.0 * BRIEF * duration)
    times = np.concatenate([[0.0], np.cumsum(lengths)])
    times *= duration / times[-1]
    return Plan(
        times=times,
        elements=np.asarray([event[1] for event in events], dtype=int),
        levels=np.asarray([(a or b) * play[e] for _w, e, a, b in events], dtype=float),
        sides=np.asarray(all_sides),
        counts=np.maximum(np.ceil(np.diff(times) * system.fastest / reach).astype(int), 3),
    )


def _lasting(events: list[tuple[float, int, int, int]], duration: float) -> list[tuple[float, int, int, int]]:
    """Return the switches without those that are taken back at once."""
    kept: list[tuple[float, int, int, int]] = []
    for event in events:
        last = next((k for k in range(len(kept) - 1, -1, -1) if kept[k][1] == event[1]), None)
        if last is not None and event[0] - kept[last][0] < GRAZING * duration and event[3] == kept[last][2]:
            del kept[last]
        else:
            kept.append(event)
    return kept


def _crossings(twists: Callable[[Array], Array], low: Array, high: Array, element: Array, level: Array) -> Array:
    """Return when twists pass levels between two times each (k,), by halving."""
    each = np.arange(len(low))
    if not each.size:
        return low
    below = twists(low)[each, element] < level
    for _round in range(HALVINGS):
        middle = 0.5 * (low + high)
        later = (twists(middle)[each, element] < level) == below
        low, high = np.where(later, middle, low), np.where(later, high, middle)
    return 0.5 * (low + high)


def _first_guess(plan: Plan, omega: float, curve: Curve, heavy: Array) -> Guess:
    points, _table = collocation(STAGES, stiff=not heavy.all())
    ends = np.concatenate(
        [
            start + (end - start) * np.arange(count) / count
            for start, end, count in zip(plan.times[:-1], plan.times[1:], plan.counts, strict=True)
        ]
        + [plan.times[-1:]]
    )
    x, rate, _joint_angle = curve.at(omega * ends)
    middle = (ends[:-1, None] + np.diff(ends)[:, None] * points).ravel()
    _x, inner_rate, inner_joint_angle = (one.reshape(len(ends) - 1, STAGES, -1) for one in curve.at(omega * middle))
    return Guess(
        times=plan.times.copy(),
        x=x,
        v=omega * rate,
        inner=np.where(heavy, omega**2 * inner_joint_angle, omega * inner_rate),
        force=float(curve.force),
    )


def _newton(
    system: Switching, omega: float, plan: Plan, guess: Guess, free: bool, how: Shooting, most: int
) -> tuple[Guess, bool, Array, int]:
    """Return the motion, whether Newton's method came to rest, the monodromy matrix, and how many steps it took."""
    heavy = system.heavy
    rank, states = len(heavy), len(heavy) + int(heavy.sum())
    whole = np.full((states, states), np.nan)
    done = 0
    for done in range(1, min(how.steps, most) + 1):
        chain = Chain(system, omega, plan, guess)
        if not chain.finite:
            return guess, False, whole, done
        try:
            moved, whole = chain.closed(free)
        except np.linalg.LinAlgError:
            return guess, False, whole, done
        times, state, inner, force = moved
        lengths, change = np.diff(guess.times), np.diff(times)
        share = min(1.0, float(np.min(np.where(change < 0.0, -0.6 * lengths / np.minimum(change, -1e-300), 1.0))))
        size = float(np.max(np.abs(state[:, :rank]), initial=0.0))
        share = min(share, how.leap / max(size, 1e-300))
        guess = Guess(
            times=guess.times + share * times,
            x=guess.x + share * state[:, :rank],
            v=guess.v + share * _spread(state[:, rank:], heavy),
            inner=guess.inner + share * inner,
            force=guess.force + share * force,
        )
        if not np.isfinite(size) or float(np.min(np.diff(guess.times))) < BRIEF * guess.times[-1]:
            return guess, False, whole, done
        if share == 1.0 and size <= 1e-10 * float(np.max(np.abs(guess.x), initial=0.0)) + 1e-13:
            return guess, True, whole, done
    return guess, False, whole, done


def _spread(speeds: Array, heavy: Array) -> Array:
    found = np.zeros((len(speeds), len(heavy)))
    found[:, heavy] = speeds
    return found


def _fits(system: Switching, found: Pieces) -> bool:
    """Tell whether every element is on the side that was assumed, all along."""
    play = system.play
    if not np.any(play > 0.0):
        return True
    n = len(found.inner)
    share = (np.arange(16) + 0.5) / 16
    step = np.repeat(np.arange(n), len(share))
    since = np.tile(share, n) * np.diff(found.time)[step]
    x, _v, _a = found.inside(step, since)
    twist = system.twist(found.omega * (found.time[step] + since), x)[0]
    sides = found.sides[step]
    past = np.where(sides == 0, np.abs(twist) - play, play - sides * twist)
    return bool(np.all((past <= NEAR * play) | (play == 0.0)))


# Steps of collocation between switches, linearised, and Newton's step that closes a period of them.


class Switching(Protocol):
    """An oscillator with elements that switch."""

    @property
    def play(self) -> Array:
        """Half the play of every element (E,); 0 where it never switches."""

    @property
    def heavy(self) -> Array:
        """Which coordinates have mass (R,)."""

    @property
    def fastest(self) -> float:
        """Bound of the frequencies at which it swings [rad/s]."""

    def at(self, sides: Array, phase: Array, x: Array, v: Array, a: Array) -> tuple[Linearised, Array]:
        """Return the balance of steps (n,) at phases (n, s), and its slope by the phase at standing x, (n, s, R)."""

    def twist(self, phase: Array, x: Array) -> tuple[Array, Array, Array]:
        """Return the twists of the elements at phases (m,), (m, E), their slopes by x (m, E, R) and by phase (m, E)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Plan:
    """Switches of a period in their order, and the steps between them."""

    times: Array  # (k+2,) [s]: 0, the switches, the duration
    elements: Array  # (k,) of int: which element switches
    levels: Array  # (k,): at what twist
    sides: Array  # (k+1, E) of int: side of every element between the times
    counts: Array  # (k+1,) of int: steps there


@dataclass(frozen=True, eq=False, kw_only=True)
class Guess:
    """What Newton's method moves: times, states at the ends of the steps, what is within them, constant force."""

    times: Array
    x: Array
    v: Array
    inner: Array
    force: float


def stages(x: Array, v: Array, inner: Array, h: Array, heavy: Array) -> tuple[Array, Array, Array]:
    """Return x, v, a at the points of the steps, arrays (n, s, R)."""
    points, table = collocation(inner.shape[1], stiff=not heavy.all())
    twice = table[:-1] @ table[:-1]
    h = h[:, None, None]
    once = h * np.matmul(table[:-1], inner)
    joint_angle = h**2 * np.matmul(twice, inner)
    x0, v0 = x[:, None], v[:, None]
    place = np.where(heavy, x0 + h * points[:, None] * v0 + joint_angle, x0 + once)
    return place, np.where(heavy, v0 + once, inner), np.where(heavy, inner, 0.0)


class Chain:
    """The steps of a period linearised: each inner value by the state before it, the switches and the force."""

    def __init__(self, system: Switching, omega: float, plan: Plan, guess: Guess) -> None:
        self.system, self.omega, self.plan, self.guess = system, omega, plan, guess
        heavy = self.heavy = system.heavy
        rank, moving = len(heavy), np.flatnonzero(heavy)
        states = rank + len(moving)
        lengths, counts = np.diff(guess.times), plan.counts
        phase_of = np.repeat(np.arange(len(counts)), counts)
        inside = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
        h = (lengths / counts)[phase_of]
        begin = guess.times[phase_of] + inside * h
        points, table = collocation(STAGES, stiff=not heavy.all())
        twice = table @ table[:-1]
        n = len(h)
        x, v, a = stages(guess.x[:-1], guess.v[:-1], guess.inner, h, heavy)
        here, by_phase = system.at(plan.sides[phase_of], omega * (begin[:, None] + h[:, None] * points), x, v, a)
        left = here.balance.copy()
        left[..., 0] -= guess.force
        self.finite = bool(np.isfinite(left).all() and np.isfinite(here.stiffness).all())
        if not self.finite:
            return
        size = STAGES * rank
        hh = h[:, None, None, None]
        by_v = np.where(heavy, hh * table[:-1, :, None], np.eye(STAGES)[:, :, None])
        by_x = np.where(heavy, hh**2 * twice[:-1, :, None], hh * table[:-1, :, None])
        matrix = (
            here.damping[:, :, :, None, :] * by_v[:, :, None] + here.stiffness[:, :, :, None, :] * by_x[:, :, None]
        )  # (n, i, r, j, s)
        stage, own = np.arange(STAGES)[:, None], np.arange(rank)
        matrix[:, stage, own, stage, own] += here.mass
        # by the length of the step: places and speeds inside, and the phase
        inner = guess.inner
        x_h = np.where(
            heavy,
            points[:, None] * guess.v[:-1, None] + 2.0 * h[:, None, None] * np.matmul(twice[:-1], inner),
            np.matmul(table[:-1], inner),
        )
        v_h = np.where(heavy, np.matmul(table[:-1], inner), 0.0)
        by_h = (
            np.einsum("nirs,nis->nir", here.stiffness, x_h)
            + np.einsum("nirs,nis->nir", here.damping, v_h)
            + omega * by_phase * points[:, None]
        )
        by_begin = omega * by_phase
        pushed = np.concatenate(
            [
                left[..., None],
                here.stiffness,
                here.damping[..., moving]
                + (h[:, None, None, None] * points[:, None, None]) * here.stiffness[..., moving],
                by_h[..., None],
                by_begin[..., None],
                np.broadcast_to(-(own == 0).astype(float)[:, None], (n, STAGES, rank, 1)),
            ],
            axis=-1,
        )
        answer = -np.linalg.solve(matrix.reshape(n, size, size), pushed.reshape(n, size, -1))
        answer = answer.reshape(n, STAGES, rank, -1)
        knots = len(guess.times)
        share_h = np.zeros((n, knots))
        share_h[np.arange(n), phase_of + 1] = 1.0 / counts[phase_of]
        share_h[np.arange(n), phase_of] = -1.0 / counts[phase_of]
        share_begin = inside[:, None] * share_h
        share_begin[np.arange(n), phase_of] += 1.0
        by_knots = (
            answer[..., states + 1, None] * share_h[:, None, None]
            + answer[..., states + 2, None] * share_begin[:, None, None]
        )
        self.inner_by = np.concatenate([answer[..., : states + 1], by_knots, answer[..., -1:]], axis=-1)
        once = np.einsum("j,njrk->nrk", table[-1], self.inner_by) * h[:, None, None]
        both = np.einsum("j,njrk->nrk", twice[-1], self.inner_by) * h[:, None, None] ** 2
        after = np.concatenate([np.where(heavy[:, None], both, once), once[:, moving]], axis=1)
        after[:, np.arange(states), 1 + np.arange(states)] += 1.0
        after[:, moving, 1 + rank + np.arange(len(moving))] += h[:, None]
        sums, sums2 = np.einsum("j,njr->nr", table[-1], inner), np.einsum("j,njr->nr", twice[-1], inner)
        x_end_h = np.where(heavy, guess.v[:-1] + 2.0 * h[:, None] * sums2, sums)
        after[:, :rank, states + 1 : -1] += x_end_h[:, :, None] * share_h[:, None]
        after[:, rank:, states + 1 : -1] += sums[:, moving, None] * share_h[:, None]
        x_end = np.where(heavy, guess.x[:-1] + h[:, None] * guess.v[:-1] + h[:, None] ** 2 * sums2, 0.0)
        x_end = np.where(heavy, x_end, guess.x[:-1] + h[:, None] * sums)
        v_end = guess.v[:-1] + h[:, None] * sums
        after[:, :rank, 0] += x_end - guess.x[1:]
        after[:, rank:, 0] += (v_end - guess.v[1:])[:, moving]
        self.after, self.states, self.moving, self.knots = after, states, moving, knots

    def closed(self, free: bool) -> tuple[tuple[Array, Array, Array, float], Array]:
        """Return Newton's step that closes the period and meets the switches, and the monodromy matrix."""
        states, knots, guess = self.states, self.knots, self.guess
        rank, moving, n = len(self.heavy), self.moving, len(self.after)
        width = 1 + states + knots + 1
        # every state as a function of (1, first state, knots, force)
        by = np.zeros((n + 1, states, width))
        by[0, :, 1 : 1 + states] = np.eye(states)
        with np.errstate(over="ignore", invalid="ignore"):  # a motion that leaves all bounds closes no period
            for k in range(n):
                step = self.after[k]
                by[k + 1] = step[:, 1 : 1 + states] @ by[k]
                by[k + 1][:, 0] += step[:, 0]
                by[k + 1][:, 1 + states :] += step[:, 1 + states :]
        switches = np.cumsum(self.plan.counts)[:-1]
        events = len(switches)
        state = np.concatenate([guess.x, guess.v[:, moving]], axis=-1)
        rows, right = [], []
        closing = by[n].copy()
        closing[:, 1 : 1 + states] -= np.eye(states)
        rows.append(closing[:, 1:])
        right.append(-(state[-1] - state[0]) - closing[:, 0])
        if events:
            twist, by_x, by_phase = self.system.twist(self.omega * guess.times[1:-1], guess.x[switches])
            pick = np.arange(events), self.plan.elements
            meets = np.einsum("mr,mrk->mk", by_x[pick], by[switches][:, :rank])
            meets[np.arange(events), 1 + states + 1 + np.arange(events)] += self.omega * by_phase[pick]
            rows.append(meets[:, 1:])
            right.append(self.plan.levels - twist[pick] - meets[:, 0])
        columns = [*range(states), *range(states + 1, states + 1 + events)]
        if free:
            fixed = np.zeros((1, width - 1))
            fixed[0, 0] = 1.0
            rows.append(fixed)
            right.append(-guess.x[:1, 0])
            columns.append(width - 2)
        system = np.concatenate(rows)[:, columns]
        answer = np.zeros(width)
        answer[0] = 1.0
        answer[1 + np.asarray(columns)] = np.linalg.solve(system, np.concatenate(right))
        with np.errstate(over="ignore", invalid="ignore"):
            moved = by @ answer
        knot = answer[1 + states : 1 + states + knots]
        local = np.concatenate(
            [np.ones((n, 1)), moved[:-1], np.broadcast_to(answer[1 + states :], (n, knots + 1))], axis=-1
        )
        inner = np.einsum("njrk,nk->njr", self.inner_by, local)
        whole = by[n][:, 1 : 1 + states]
        if events:
            slots = 1 + states + 1 + np.arange(events)
            shift = np.linalg.solve(meets[:, slots], -meets[:, 1 : 1 + states])
            whole = whole + by[n][:, slots] @ shift
        return (knot, moved, inner, float(answer[-1])), whole
