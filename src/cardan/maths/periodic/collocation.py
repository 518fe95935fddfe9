"""Steps of collocation between switches, linearised, and Newton's step that closes a period of them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from cardan.maths.arrays import Array

from .floquet import STAGES, collocation
from .harmonics import Linearised


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
