"""Periodic motions of oscillators that switch, as those with play do: smooth pieces between switches, by shooting.

Every element of the oscillator has a side; while all sides stay, its equations are smooth. A period is cut at the
switches, each piece into steps of collocation. The state at the beginning of every step, the times of the switches and
what happens within the steps are found together by Newton's method, with exact slopes; what a disturbance becomes over
the period, switches included, is the product of the same slopes.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from .arrays import Array, ArrayLike
from .floquet import STAGES, collocation
from .periodic import Status
from .piece_chain import Chain, Guess, Plan, Switching, stages

WITHIN = 1024
"""Places of a period at which switches are looked for, at least."""

NEAR = 1e-9
"""Overlap of sides that rounding explains, over the play."""


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
    """

    steps: int = 16
    rounds: int = 6
    reach: float = 0.4
    leap: float = 0.3


class Curve(Protocol):
    """A motion of the right period."""

    @property
    def force(self) -> float:
        """Constant force on the first coordinate."""

    def at(self, phase: Array) -> tuple[Array, Array, Array]:
        """Return x and its first two derivatives by the phase, arrays (p, R)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Pieces:
    """A periodic motion in steps of collocation.

    Attributes
    ----------
    omega : float [rad/s]
        Rate of the phase.
    time : array (n+1,) [s]
        Ends of the steps, the last one period after the first, which is 0.
    x, v : arrays (n+1, R)
        State there; the speeds of coordinates without mass mean nothing.
    inner : array (n, s, R)
        Accelerations at the points of the steps; speeds of coordinates without mass.
    sides : array of int (n, E)
        Side of every element in every step.
    heavy : array of bool (R,)
    force : float
        Constant force on the first coordinate of a free motion.
    monodromy : array (m, m)
        What a disturbance (x, v) at time 0 has become after a period, speeds without mass left out.
    status : Status
    """

    omega: float
    time: Array
    x: Array
    v: Array
    inner: Array
    sides: Array
    heavy: Array
    force: float
    monodromy: Array
    status: Status

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

    def at(self, phase: ArrayLike) -> tuple[Array, Array, Array]:
        """Return x and its first two derivatives by the phase at phases (p,), arrays (p, R)."""
        turned = np.asarray(phase, dtype=float) / self.omega
        time = turned - self.duration * np.floor(turned / self.duration)
        step = np.clip(np.searchsorted(self.time, time, side="right") - 1, 0, len(self.inner) - 1)
        x, v, a = self.inside(step, time - self.time[step])
        return x, v / self.omega, a / self.omega**2

    def inside(self, step: Array, since: Array) -> tuple[Array, Array, Array]:
        """Return x, v and a in steps (p,) at times since their beginning, arrays (p, R)."""
        places, _table = collocation(self.inner.shape[1], stiff=not self.heavy.all())
        powers = np.arange(1, len(places) + 1)
        spread = np.linalg.inv(places[:, None] ** (powers - 1))
        share = (since / np.diff(self.time)[step])[:, None]
        span = np.diff(self.time)[step][:, None]
        each = np.matmul(spread, self.inner)[step]
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
) -> Pieces:
    """Return a periodic motion of an oscillator that switches.

    Parameters
    ----------
    system : Switching
    omega : float [rad/s]
        Rate of the phase z, of either sign; a period is 2π of it.
    start : Curve
        Motion to begin with.
    free : bool
        Whether a motion may be shifted in time; then the first coordinate is 0 at time 0 and the constant force on it
        is sought.
    method : Shooting, optional

    Returns
    -------
    Pieces
        Its status says whether Newton's method came to rest and all sides are as assumed.

    Notes
    -----
    The order of the switches is read off the motion at hand; when Newton's method has come to rest with them, it is
    read off again, until it stays.
    """
    how = method or Shooting()
    curve: Curve = start
    found: Pieces | None = None
    for _round in range(how.rounds):
        plan = _plan(system, omega, curve, how.reach)
        guess = _first_guess(plan, omega, curve, system.heavy)
        guess, good, whole = _newton(system, omega, plan, guess, free, how)
        found = _pieces(omega, plan, guess, system.heavy, whole, good)
        if not np.isfinite(found.x).all():
            break
        if good and _fits(system, found):
            return found
        curve = found
    assert found is not None
    return _pieces(omega, plan, guess, system.heavy, whole, False)


def _pieces(omega: float, plan: Plan, guess: Guess, heavy: Array, whole: Array, good: bool) -> Pieces:
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
    )


def _side(twist: Array, play: Array) -> Array:
    return np.where(play == 0.0, 1, np.where(twist > play, 1, np.where(twist < -play, -1, 0)))


def _plan(system: Switching, omega: float, curve: Curve, reach: float) -> Plan:
    """Return the switches of a motion."""
    duration = 2.0 * math.pi / abs(omega)
    play = system.play
    count = max(WITHIN, 8 * math.ceil(system.fastest * duration))
    time = duration * np.arange(count + 1) / count

    def twists(when: Array) -> Array:
        return system.twist(omega * when, curve.at(omega * when)[0])[0]

    sides = _side(twists(time), play)
    events: list[tuple[float, int, int, int]] = []
    for e in np.flatnonzero(np.any(sides[1:] != sides[:-1], axis=0)):
        for k in np.flatnonzero(sides[1:, e] != sides[:-1, e]):
            old, new = int(sides[k, e]), int(sides[k + 1, e])
            for a, b in [(old, new)] if abs(new - old) == 1 else [(old, 0), (0, new)]:
                events.append((_crossing(twists, time[k], time[k + 1], int(e), (a or b) * play[e]), int(e), a, b))
    events.sort()
    here = sides[0].copy()
    all_sides = [here.copy()]
    for event in events:
        here[event[1]] = event[3]
        all_sides.append(here.copy())
    times = np.asarray([0.0, *[event[0] for event in events], duration])
    lengths = np.maximum(np.diff(times), 1e-9 * duration)
    times = np.concatenate([[0.0], np.cumsum(lengths)])
    times *= duration / times[-1]
    return Plan(
        times=times,
        elements=np.asarray([event[1] for event in events], dtype=int),
        levels=np.asarray([(a or b) * play[e] for _w, e, a, b in events], dtype=float),
        sides=np.asarray(all_sides),
        counts=np.maximum(np.ceil(np.diff(times) * system.fastest / reach).astype(int), 3),
    )


def _crossing(twists: Callable[[Array], Array], low: float, high: float, element: int, level: float) -> float:
    """Return when a twist passes a level between two times, by halving."""
    below = twists(np.asarray([low]))[0, element] < level
    for _round in range(30):
        middle = 0.5 * (low + high)
        if (twists(np.asarray([middle]))[0, element] < level) == below:
            low = middle
        else:
            high = middle
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
    x, rate, _bend = curve.at(omega * ends)
    middle = (ends[:-1, None] + np.diff(ends)[:, None] * points).ravel()
    _x, inner_rate, inner_bend = (one.reshape(len(ends) - 1, STAGES, -1) for one in curve.at(omega * middle))
    return Guess(
        times=plan.times.copy(),
        x=x,
        v=omega * rate,
        inner=np.where(heavy, omega**2 * inner_bend, omega * inner_rate),
        force=float(curve.force),
    )


def _newton(
    system: Switching, omega: float, plan: Plan, guess: Guess, free: bool, how: Shooting
) -> tuple[Guess, bool, Array]:
    """Return the motion, whether Newton's method came to rest, and the monodromy matrix."""
    heavy = system.heavy
    rank, states = len(heavy), len(heavy) + int(heavy.sum())
    whole = np.full((states, states), np.nan)
    for _step in range(how.steps):
        chain = Chain(system, omega, plan, guess)
        if not chain.finite:
            return guess, False, whole
        try:
            moved, whole = chain.closed(free)
        except np.linalg.LinAlgError:
            return guess, False, whole
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
        if not np.isfinite(size):
            return guess, False, whole
        if share == 1.0 and size <= 1e-10 * float(np.max(np.abs(guess.x), initial=0.0)) + 1e-13:
            return guess, True, whole
    return guess, False, whole


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
