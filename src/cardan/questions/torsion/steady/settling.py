"""What does a non-linear drive settle to at a speed? Followed in time, also from a slow run-up and a slow run-down."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from cardan.later import later
from cardan.maths.arrays import Array
from cardan.maths.compiled import plain
from cardan.maths.compiled import torsion_line as lines
from cardan.maths.compiled.method import has_numba
from cardan.questions.torsion.model.torsional_balance import element_torques
from cardan.questions.torsion.model.torsional_layouts import Turning, chosen, line_of, single
from cardan.questions.torsion.model.torsional_modes import straight_modes

from .orbit import Backlashed, at_rest, straight_stiffness
from .steady import LOWER

compiled = later("cardan.maths.compiled.torsion_block")

FADED, PERIODS, SHARP = 5.0, (60, 250), 0.25
"""By e to which power what a drive with play begins with has faded when it is looked at, after how many periods, and
share of them that is added in the steps in which it is looked at."""

REPEATS = 0.02
"""Share of its swing by which it may still change from one period to the next."""

STEPS, GROSS, REACH, LIGHT = 256, 64, 0.4, 3.0
"""Steps of a period at least where a motion is looked at and on the way there, phase of the fastest oscillation in one,
by how much what has no inertia is faster."""

LONGEST, RUN = 6, 36
"""Periods after which a motion is looked at whether it repeats, and how many are followed of one that does not."""

CLOSE, COARSE = 64, 32
"""Samples of a period, to tell a motion and to follow what does not repeat."""

SETTLED = 0.2
"""Share by which the swing of what does not repeat may change from one half of that run to the other."""

ALIKE = 0.03
"""Difference of two motions, over the larger of them, below which it is one as sought."""

RAMPS, SLOW = (0.5, 1.5), 8
"""Shares of the speed from which it is run up and run down to, and in how many times the periods that are settled."""

MOST = 1_000_000
"""Steps of a ramp at most: they take seconds."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Run:
    """Where a search led: a sum (R, H+1) over some periods; of what never repeats its mean period and torques (E,)."""

    wave: Array
    periods: int = 1
    lowest: Array | None = None
    highest: Array | None = None
    reached: bool = False  # whether the drive does so after a slow run-up or run-down

    @property
    def mean(self) -> Array:
        """Its mean over one period, sum (R, h+1): the motion itself but for jitter where that repeats with each."""
        found: Array = self.wave[..., :: max(self.periods, 1)]
        return found

    def same(self, other: Run) -> bool:
        """Tell whether another is alike, be it some periods later; those that do not repeat are."""
        if self.periods != other.periods or not self.periods:
            return self.periods == other.periods
        turn = 2j * np.pi * np.arange(self.wave.shape[-1]) / self.periods
        return any(near(self.wave * np.exp(turn * k), other.wave, ALIKE) for k in range(self.periods))


class _Line:
    """One drive in time. What turns no inertia gets so little that it swings faster than all else."""

    def __init__(self, part: Turning) -> None:
        model, switching = part.drives(np.zeros(1, dtype=int)), Backlashed(part)
        modes = straight_modes(replace(single(part.model, (1,), 0), torques=(), input_speed=0.0))
        self.duration, self.base = 2.0 * np.pi / abs(float(part.frequency[0])), float(part.frequency[0])
        decay = float(np.min(modes.damping_ratio * modes.omega, initial=np.inf))
        inertia, fastest = np.array(model.inertia), switching.fastest
        if not switching.heavy.all():
            spring = np.max(np.diagonal(straight_stiffness(model), axis1=-2, axis2=-1))
            for r in np.flatnonzero(~switching.heavy) + part.first:
                inertia[:, model.owner[r]] = spring / (LIGHT * fastest) ** 2
            fastest *= LIGHT
        self.model = replace(part.model, inertia=inertia)
        least = math.ceil(self.duration * fastest / REACH)
        self.steps, self.gross = STEPS * max(1, math.ceil(least / STEPS)), max(least, GROSS)
        self.fading = FADED / (decay * self.duration) if decay else math.inf
        self.periods = math.ceil(min(max(self.fading, PERIODS[0]), PERIODS[1]))

    def block(self, q: Array, v: Array) -> Any:
        """Return as many of it as there are columns of angles and speeds (R, b), to be moved on."""
        count = q.shape[-1]
        line = line_of(chosen(self.model, (1,), np.zeros(count, dtype=int), moments=False), count)
        return (compiled() if has_numba() else plain).Block(line, lines.begin(line, q, v))

    def ramped(self, part: Turning) -> tuple[Array, Array]:
        """Return angles off the input and speeds (R, 2) at the end of a slow run-up and a slow run-down."""
        speed, rest = float(part.speed[0]), at_rest(part)[0, :, 0].real
        first = speed * np.asarray(RAMPS)
        turns = 4 * math.ceil(SLOW * self.periods / 4)  # so that either ramp takes whole periods
        time, turned = turns * self.duration, turns * 0.5 * (first / speed + 1.0) * part.period * np.sign(speed)
        block = self.block(np.repeat(np.append(0.0, rest)[:, None], 2, axis=1), np.tile(first, (len(rest) + 1, 1)))
        block.advance(
            0.0,
            turns * self.gross,
            self.duration / self.gross,
            (0.0 * first, first, (speed - first) / time),
            last=False,
        )
        angle, turning, _work = block.now()
        return angle - turned, turning


def settled(part: Turning, starts: Array) -> list[Run]:
    """Return what one drive does after a while, followed in time.

    starts (b, R, h+1), complex: motions whose places and speeds at the angle 0 are those to begin with.
    """
    line, order = _Line(part), np.arange(starts.shape[-1])
    place = np.sum(starts, axis=-1).real.T
    rate = np.sum(1j * line.base * order * starts, axis=-1).real.T
    q = np.vstack([np.zeros(len(starts)), place])
    return _led(part, line, q, np.vstack([np.full(len(starts), part.speed[0]), rate + part.speed[0]]), reached=False)


def ramped(part: Turning) -> list[Run]:
    """Return what a slow run-up from half the speed and a slow run-down from one and a half times it lead to.

    Torques and dampers are those at the speed itself. Nothing is told of a drive in which what it begins with takes
    longer to fade than a ramp, since at its end it is still on the way, nor of one that swings so much faster than it
    turns that a ramp takes more than `MOST` steps.
    """
    line = _Line(part)
    lasting = line.fading > SLOW * PERIODS[1] or SLOW * line.periods * line.gross > MOST
    return [] if lasting else _led(part, line, *line.ramped(part), reached=True)


def _led(part: Turning, line: _Line, q: Array, v: Array, *, reached: bool) -> list[Run]:
    """Return where angles off the input and speeds (R, b) at its angle 0 lead to."""
    duration, base, sharp = line.duration, line.base, math.ceil(SHARP * line.periods)
    periods = line.periods + sharp
    speed = np.full(q.shape[-1], float(part.speed[0]))
    block = line.block(q, v)

    def advanced(begin: float, time: float, taken: int) -> Array:
        """Return what each coordinate is off even rotation, and that of its speed, some time and steps later."""
        block.advance(begin, taken, time / taken, (begin * speed, speed, 0.0 * speed), last=False)
        angle, turning, _work = block.now()
        then = begin + time
        return np.stack([angle[1:] - then * speed, (turning[1:] - speed) / abs(base)])

    def followed(first: int, count: int, samples: int) -> Array:
        """Return the same at the samples of some periods, each at the end of its step, array (2, R, k, s)."""
        times, each = duration * (first + np.arange(count * samples) / samples), line.steps // samples
        return np.stack([advanced(float(time), duration / samples, each) for time in times], axis=-1)

    advanced(0.0, line.periods * duration, line.periods * line.gross)
    advanced(line.periods * duration, sharp * duration, sharp * line.steps)
    path = followed(periods, LONGEST + 1, CLOSE)
    swing = np.max(np.ptp(path[0], axis=-1), axis=0)
    finite = np.isfinite(path).all(axis=(0, 1, 3))
    found: list[Run] = []
    left = finite.copy()
    for m in range(1, LONGEST + 1):
        shifted = np.max(np.abs(path[..., m * CLOSE :] - path[..., : -m * CLOSE]), axis=(0, 1, 3))
        rows = np.flatnonzero(left & (shifted <= REPEATS * swing))
        left[rows] = False
        waves = _sums(path[0][:, rows, : m * CLOSE], m * LOWER, base)
        found += [Run(wave=waves[:, k], periods=m, reached=reached) for k in range(len(rows))]
    rows = np.flatnonzero(left)
    if rows.size:
        path = followed(periods + LONGEST + 1, RUN, COARSE)[:, :, rows]
        halves = [np.max(np.ptp(one[0], axis=-1), axis=0) for one in np.split(path, 2, axis=-1)]
        lasts = np.abs(halves[0] - halves[1]) <= SETTLED * np.maximum(*halves)
        times = duration * (periods + LONGEST + 1 + (np.arange(RUN * COARSE) + 1) / COARSE)
        angle = np.pad(np.moveaxis(path[0], 0, -1), ((0, 0), (0, 0), (1, 0)))
        rate = np.pad(np.moveaxis(path[1] * abs(base), 0, -1), ((0, 0), (0, 0), (1, 0)))
        torque = element_torques(
            part.drives(np.zeros(len(rows), dtype=int)), angle + (times * speed[0])[:, None], rate + speed[0]
        )
        waves = _sums(np.mean(path[0].reshape(*path[0].shape[:2], RUN, COARSE), axis=-2), COARSE // 2, base)
        for k in np.flatnonzero(lasts).tolist():
            ends = {"lowest": np.min(torque[k], axis=0), "highest": np.max(torque[k], axis=0)}
            found.append(Run(wave=waves[:, k], periods=0, reached=reached, **ends))
    return found


def _sums(samples: Array, width: int, base: float) -> Array:
    """Return sums (R, k, width) through samples (R, k, s), each at the end of its step."""
    wave = np.fft.rfft(np.roll(samples, 1, axis=-1), axis=-1)[..., :width] / samples.shape[-1]
    wave[..., 1:] *= 2.0
    return wave if base > 0.0 else wave.conj()


def near(one: Array, other: Array, share: float) -> bool:
    """Tell whether two sums (R, H+1) differ by less than a share of their swing."""
    width = max(one.shape[-1], other.shape[-1])
    first, second = padded(one, width), padded(other, width)
    swing = max(float(np.max(np.abs(each[:, 1:]), initial=0.0)) for each in (first, second))
    return bool(np.max(np.abs(first - second)) <= share * swing)


def padded(coefficient: Array, width: int) -> Array:
    """Return sums with zeros up to a number of coefficients."""
    return np.pad(coefficient, [(0, 0)] * (coefficient.ndim - 1) + [(0, width - coefficient.shape[-1])])
