"""Torsional models in steps of one length: many drives at once, compiled where numba is installed."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, fields, replace
from threading import Lock
from typing import Any, Protocol

import numpy as np

from cardan.errors import Problem, check, refuse
from cardan.later import later
from cardan.maths.arrays import Array
from cardan.maths.compiled import plain as plain_torsion
from cardan.maths.compiled import torsion_line as lines
from cardan.maths.compiled.method import Method as Compute
from cardan.maths.compiled.method import Plain, available, share
from cardan.maths.compiled.method import chosen as picked
from cardan.questions.torsion.model.torsional_layouts import chosen, leading, line_of
from cardan.questions.torsion.model.torsional_model import TorsionalModel
from cardan.texts import _

from .simulation import Extremes, Progress, Simulation, Status, reported
from .time_integration import breaks_of, contact_period, forced_rate, own_rates

compiled = later("cardan.maths.compiled.torsion_block")

STABLE = 5.0
"""Largest step times the fastest rate that the method bears."""

CALM = 2.5
"""The same for rates that are damped away."""

CONTACT = 20.0
"""Steps in the period of an element in contact."""

SMALL = 300
"""Fewer steps, of all drives together, do not need to be compiled."""

CHUNK = 4096
"""Steps after which progress is told."""

WIDE = 64
"""Drives of a block: so many hide each other's waiting."""

LANES = 8
"""Drives in a register."""


class Block(Protocol):
    """Drives on their way through time."""

    def advance(
        self, time: float, steps: int, h: float, motion: tuple[Array, Array, Array] | None, *, last: bool
    ) -> None:
        """Take steps of one length."""

    def now(self) -> tuple[Array, Array, Array]:
        """Return angles, speeds (R, b) and work (b,)."""

    def state(self) -> lines.State:
        """Return where the drives are."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Stretch:
    """Steps of one length between two times, counted from the start, and the sample at the end."""

    begin: float
    end: float
    steps: int
    sample: int | None


@dataclass(frozen=True, kw_only=True, slots=True)
class FixedStep:
    """Steps of one length by Dormand and Prince's method of order eight, many drives at once.

    Parameters
    ----------
    step : float, optional [s]
        Longest step; found from ``per_period`` when not given.
    per_period : float
        Steps in a period of the fastest swing that lives on: of the drive, of its joints up to order 4, of engines.
    compute : Plain or Compiled, optional
        Compiled by default for large jobs, where numba is installed.
    """

    step: float | None = None
    per_period: float = 10.0
    compute: Compute | None = None

    def __post_init__(self) -> None:
        text = _("{given} given; more than 0 is needed")
        given = {"per_period": self.per_period} | ({} if self.step is None else {"step": self.step})
        check(
            Problem(name, text.format(given=value))
            for name, value in given.items()
            if not (math.isfinite(value) and value > 0.0)
        )


def stepped(
    model: TorsionalModel,
    method: FixedStep,
    *,
    span: tuple[float, float],
    times: Array,
    q: Array,
    rate: Array,
    progress: Progress | None,
) -> Simulation:
    """Return the simulation of drives in fixed steps.

    model (...), span [s], times (t,) [s], q, rate (..., R) [rad, rad/s].
    """
    angle_error = leading(model)
    count = math.prod(angle_error)
    flat = chosen(model, angle_error, np.arange(count))
    angles, rates = q.reshape(count, -1), rate.reshape(count, -1)
    line = line_of(chosen(model, angle_error, np.arange(count), moments=False), count, span[0])
    stretches = list(_stretches(model, span, times, _longest(flat, method, angles, rates, span)))
    run = _Run(model, line, stretches, span[0], angles.T, rates.T, len(times), progress)
    compute = picked(method.compute, np, large=run.total > SMALL)
    if isinstance(compute, Plain):
        run.go(0, 1, width=count, plain=True)
    else:
        width = min(WIDE, -(-count // ((compute.threads or available()) * LANES)) * LANES)
        share(lambda *rows: run.go(*rows, width=width, plain=False), -(-count // width), threads=compute.threads)
    found = run.told(flat, span, times)
    own: dict[str, Any] = {name: _shaped(getattr(found, name), angle_error) for name in _BY_DRIVE}
    extremes = {one.name: _shaped(getattr(found.extremes, one.name), angle_error) for one in fields(Extremes)}
    return replace(found, **own, extremes=Extremes(**extremes))


_BY_DRIVE = (*("coordinate", "rate", "angle", "speed", "torque", "input_torque", "energy", "work", "status", "ended"),)


def _shaped(values: Array, outer: tuple[int, ...]) -> Array:
    return None if values is None else values.reshape((*outer, *values.shape[1:]))


def _longest(flat: TorsionalModel, method: FixedStep, angles: Array, rates: Array, span: tuple[float, float]) -> float:
    """Return the longest step [s]."""
    free = np.arange(flat.coordinates)[0 if flat.free else 1 :]
    length = span[1] - span[0]
    fastest, living = own_rates(flat, free, angles, rates, span[0], length)
    forced = forced_rate(flat, flat.input_motion, rates, span)
    swift, contact = float(np.max(fastest)), float(np.min(contact_period(flat, free, angles)))
    if method.step is not None:
        if method.step * swift > STABLE:
            text = _("{given:.3g} s given; the fastest oscillation of these drives needs steps of at most {most:.3g} s")
            raise refuse("step", text.format(given=method.step, most=STABLE / swift))
        return min(method.step, length)
    pace = max(float(np.max(living)), 0.5 * float(np.max(forced)), 1.0 / length)
    return min(2.0 * math.pi / (method.per_period * pace), CALM / max(swift, 1e-300), contact / CONTACT, length)


def _stretches(model: TorsionalModel, span: tuple[float, float], times: Array, longest: float) -> Iterator[Stretch]:
    """Yield stretches that end at samples and where something jumps."""
    ends: dict[float, int | None] = {float(time): None for time in breaks_of(model, model.input_motion, *span)}
    ends |= {float(time): k for k, time in enumerate(times) if time > span[0]}
    begin = span[0]
    for end in sorted(ends):
        steps = max(1, math.ceil((end - begin) / longest - 1e-9))
        yield Stretch(begin=begin - span[0], end=end - span[0], steps=steps, sample=ends[end])
        begin = end


class _Run:
    """Drives on their way, block by block, and what became of them."""

    def __init__(
        self,
        model: TorsionalModel,
        line: lines.Line,
        stretches: list[Stretch],
        start: float,
        q: Array,
        v: Array,
        samples: int,
        progress: Progress | None,
    ) -> None:
        self.model, self.line, self.stretches, self.start = model, line, stretches, start
        self.begin, self.progress = (q, v), progress
        rank, self.drives = q.shape
        self.q, self.v = (np.full((self.drives, samples, rank), np.nan) for _k in range(2))
        self.work = np.full((self.drives, samples), np.nan)
        self.status, self.ended = np.zeros(self.drives, dtype=int), np.zeros(self.drives)
        self.extremes = np.full((4, line.quantities, self.drives), np.nan)
        self.total = self.drives * sum(stretch.steps for stretch in stretches)
        self.done, self.stopped, self.lock = 0, False, Lock()

    def go(self, first: int, last: int, *, width: int, plain: bool) -> None:
        """Take some blocks of a width to the end."""
        for k in range(first, last):
            self._follow(slice(k * width, min((k + 1) * width, self.drives)), plain)

    def _follow(self, drives: slice, plain: bool) -> None:
        part = self.line.part(drives)
        block = _block(part, lines.begin(part, *(one[:, drives] for one in self.begin)), plain)
        if self.q.shape[1] and self.stretches[0].sample != 0:
            self._sample(block, drives, 0)
        reached = 0.0
        for n, stretch in enumerate(self.stretches):
            final, h = n == len(self.stretches) - 1, (stretch.end - stretch.begin) / stretch.steps
            for at in range(0, stretch.steps, CHUNK):
                steps, begin = min(CHUNK, stretch.steps - at), stretch.begin + at * h
                ends = final and at + steps == stretch.steps
                block.advance(begin, steps, h, self._motion(stretch, begin, drives), last=ends)
                reached = begin + steps * h
                if not self._told(steps * (drives.stop - drives.start)):
                    break
            if self.stopped and reached < stretch.end:
                break
            if stretch.sample is not None:
                self._sample(block, drives, stretch.sample)
            if self.stopped:
                break
        self._end(block.state(), drives, reached)

    def _told(self, steps: int) -> bool:
        """Tell the progress and return whether to go on."""
        if self.progress is not None:
            with self.lock:
                self.done += steps
                if not self.stopped and self.done < self.total:
                    self.stopped = self.progress(self.done / self.total) == "stop"
        return not self.stopped

    def _motion(self, stretch: Stretch, begin: float, drives: slice) -> tuple[Array, Array, Array] | None:
        if self.model.free:
            return None
        if self.model.input_motion is None:
            speed = self.begin[1][0, drives]
            return self.begin[0][0, drives] + speed * begin, speed, 0.0 * speed
        middle = self.start + 0.5 * (stretch.begin + stretch.end)
        acceleration = self.model.input_motion.at(np.asarray(middle))[2]
        angle, speed, _after = self.model.input_motion.at(np.asarray(self.start + begin))
        return tuple(np.full(drives.stop - drives.start, one) for one in (angle, speed, acceleration))  # type: ignore[return-value]

    def _sample(self, block: Block, drives: slice, k: int) -> None:
        q, v, work = block.now()
        self.q[drives, k], self.v[drives, k], self.work[drives, k] = q.T, v.T, work

    def _end(self, state: lines.State, drives: slice, reached: float) -> None:
        dead = state.alive < 0.5
        cut = Status.DONE if reached >= self.stretches[-1].end else Status.CANCELLED
        self.status[drives] = np.where(dead, int(Status.DIVERGED), int(cut))
        self.ended[drives] = np.where(dead, state.ended, reached)
        found = np.stack((state.high, state.low, state.high_time, state.low_time))
        self.extremes[:, :, drives] = np.where(dead, np.nan, found)

    def told(self, flat: TorsionalModel, span: tuple[float, float], times: Array) -> Simulation:
        """Return what became of the drives, in one axis."""
        late = times > span[0] + self.ended[:, None]
        self.q[late], self.v[late], self.work[late] = np.nan, np.nan, np.nan
        motion = flat.input_motion
        acceleration = None if flat.free else np.zeros(len(times)) if motion is None else motion.at(times)[2]
        count = len(flat.elements)
        places = [*flat.owner, *(k for k, source in enumerate(flat.driven) if source is not None)]
        order = [count + places.index(k) for k in range(len(places))]
        high, low, high_time, low_time = np.moveaxis(self.extremes, -1, 1)
        return reported(
            flat,
            times,
            self.q,
            self.v,
            self.work,
            forced_acceleration=acceleration,
            extremes=Extremes(
                torque_low=low[:, :count],
                torque_high=high[:, :count],
                torque_low_time=span[0] + low_time[:, :count],
                torque_high_time=span[0] + high_time[:, :count],
                speed_low=low[:, order],
                speed_high=high[:, order],
                speed_low_time=span[0] + low_time[:, order],
                speed_high_time=span[0] + high_time[:, order],
            ),
            status=self.status,
            ended=span[0] + self.ended,
            steps=self.total,
            method="fixed steps",
        )


def _block(line: lines.Line, state: lines.State, plain: bool) -> Block:
    if plain:
        return plain_torsion.Block(line, state)
    block: Block = compiled().Block(line, state)
    return block
