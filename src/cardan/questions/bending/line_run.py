"""How does the whole line of a drive whirl while its speed changes: less than it would at each speed held?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.drive.drive import Drive
from cardan.errors import refuse
from cardan.formulas.run_up import Progress
from cardan.maths.arrays import Array
from cardan.texts import _

from .line_whirl import LineModel, LineWhirl, line_model

PER_TURN = 128
"""Steps of time in a turn at the highest speed: the frequency of a mode in order n is met within 2e-4 n²."""

LOOKED = 4
"""Steps from one look at the line to the next."""

PARTS = 400
"""Stretches of the run, each with one gyroscopic action, and each with its largest whirl."""

MOST = 1_500_000
"""Steps that are waited for."""


@dataclass(frozen=True, eq=False, kw_only=True)
class LineRun:
    """Whirl of the whole line while its speed rises or falls evenly, and what it would be at each speed held."""

    duration: float  # [s]
    time: Array  # (b,) [s]: middles of the stretches of the run
    speed: Array  # (b,) [rad/s]: of the input, there
    shaft: Array  # (s,) of int: numbers of the shafts
    whirl: Array  # (b, s) [m]: largest distance of each shaft from its mean position in each stretch
    peak: float  # [m]: largest of all
    peak_speed: float  # [rad/s]: of the input, when
    peak_place: float  # [m]: along the line from joint 1 on
    steady: LineWhirl  # at the speeds passed, each held
    cracked: tuple[int, ...]  # shafts with a crack, which does not count here
    cancelled: bool = False  # whether ``progress`` stopped the run

    @property
    def share(self) -> float:
        """Largest whirl over the largest of the speeds held."""
        size = self.steady.peak()[0]
        return self.peak / size if size else 1.0


def line_run(drive: Drive, *, damping_ratio: float | None = None, progress: Progress | None = None) -> LineRun:
    """Return how the whole line of a drive whirls while its speed changes as the `run_up` of its duty.

    drive: as of `line_whirl`, with the `run_up` of its duty, which may run down as well; damping_ratio: as there.

    z̈ + (C - iΩG) ż + K z + ΔK z* = Σ (Ω² - iΩ̇/n) S_n e^(inφ) + Σ F_n e^(inφ) in the basis of `line_whirl`, from the
    steady whirl at the start on, in steps of Newmark's average acceleration, which neither feed nor damp a mode. The
    moment of acceleration on tilted cross sections does not count. Cracks do not count.
    """
    course = drive.duty.run_up
    if course is None:
        raise refuse("duty.run_up", _("missing: start, end and duration of a change of speed"), "missing")
    first, last = abs(course.start), abs(course.end)
    top = max(first, last)
    step = 2.0 * np.pi / (PER_TURN * top)
    steps = int(np.ceil(course.duration / step / PARTS))
    if steps * PARTS > MOST:
        text = _("{turns:.3g} turns are too many to follow; so slow a run whirls as at each speed held, rotor --line")
        raise refuse("duty.run_up.duration", text.format(turns=course.duration * top / (2.0 * np.pi)))
    model = line_model(drive, drive.duty, damping_ratio)
    cracked = tuple(model.cracked)
    model.cracked = []
    low = min(first, last)
    steady = model.steady(model.speeds(low, top, (low, top)), (low, top))
    found = _Run(model, first, (last - first) / course.duration, course.duration / (steps * PARTS))
    return found.followed(steady, steps, course.duration, cracked, progress)


class _Run:
    """The line in time: state in the basis, X before Y."""

    def __init__(self, model: LineModel, start: float, rise: float, step: float) -> None:
        self.model, self.start, self.rise, self.step = model, start, rise, step
        basis = model.basis
        m = basis.shape[1]
        self.turned = basis.T @ model.gyroscopic @ basis
        rows = basis[model.support_row]
        apart = (rows.T * model.unequal) @ rows
        lost = np.diag(2.0 * model.damping * np.sqrt(model.square)) + (rows.T * model.damper) @ rows
        plain, none = np.diag(model.square), np.zeros((m, m))
        self.stiff = np.block([[plain + apart, none], [none, plain - apart]])
        self.lost = np.block([[lost, none], [none, lost]])
        self.spinning, self.standing = model.spinning @ basis, (model.couples + model.weight) @ basis
        seen = model.number[model.at.deflection]
        self.shape = np.where((seen >= 0)[:, None], basis[np.maximum(seen, 0)], 0.0)

    def angle(self, time: Array) -> Array:
        """Return the angle of the input at instants (t,) [rad]."""
        return self.start * time + 0.5 * self.rise * time**2

    def pushed(self, time: Array) -> Array:
        """Return the forces in the basis at instants (t,), array (t, 2m)."""
        order = self.model.order
        speed = self.start + self.rise * time
        turning = np.where(order == 0, 1.0, order)
        factor = speed[:, None] ** 2 - 1j * self.rise / turning
        wave = np.exp(1j * np.outer(self.angle(time), order))
        force = (wave * factor) @ self.spinning + wave @ self.standing
        return np.concatenate([force.real, force.imag], axis=-1)

    def begun(self) -> tuple[Array, Array]:
        """Return place and rate in the basis where the steady whirl at the start is."""
        model, speed = self.model, np.asarray([self.start])
        value = model.solved(speed, (speed[:, None, None] ** 2 * self.spinning + self.standing))[0]
        z, v = np.sum(value, axis=0), np.sum(1j * self.start * model.order[:, None] * value, axis=0)
        return np.concatenate([z.real, z.imag]), np.concatenate([v.real, v.imag])

    def followed(
        self, steady: LineWhirl, steps: int, duration: float, cracked: tuple[int, ...], progress: Progress | None
    ) -> LineRun:
        """Return the run, stretch by stretch of so many steps."""
        h = self.step
        q, v = self.begun()
        m = len(q) // 2
        numbers = np.unique(steady.shaft)
        mean = steady.deflection[0, steady.order == 0][0]
        none = np.zeros((m, m))
        whirl, best, cancelled = np.zeros((PARTS, len(numbers))), (0.0, 0.0, 0.0), False
        for part in range(PARTS):
            time = h * (part * steps + np.arange(steps + 1))
            force = self.pushed(time)
            spin = (self.start + self.rise * 0.5 * (time[0] + time[-1])) * self.turned
            lost = self.lost + np.block([[none, spin], [-spin, none]])
            inverse = np.linalg.inv(4.0 / h**2 * np.eye(2 * m) + 2.0 / h * lost + self.stiff)
            a = force[0] - lost @ v - self.stiff @ q
            states = np.empty((steps, 2 * m))
            for k in range(steps):
                inert, drag = 4.0 / h**2 * q + 4.0 / h * v + a, 2.0 / h * q + v
                new = inverse @ (force[k + 1] + inert + lost @ drag)
                a = 4.0 / h**2 * (new - q) - 4.0 / h * v - a
                v = 2.0 / h * (new - q) - v
                q = states[k] = new
            looked = states[(steps - 1) % LOOKED :: LOOKED]
            away = np.abs((looked[:, :m] + 1j * looked[:, m:]) @ self.shape.T - mean)
            whirl[part] = [np.max(away[:, steady.shaft == number]) for number in numbers]
            row, p = map(int, np.unravel_index(int(np.argmax(away)), away.shape))
            if away[row, p] > best[0]:
                when = float(time[1 + (steps - 1) % LOOKED :: LOOKED][row])
                best = float(away[row, p]), self.start + self.rise * when, float(steady.place[p])
            if progress is not None and progress((part + 1) / PARTS) == "stop":
                whirl, cancelled = whirl[: part + 1], part + 1 < PARTS
                break
        middle = h * steps * (np.arange(len(whirl)) + 0.5)
        return LineRun(
            duration=duration,
            time=middle,
            speed=self.start + self.rise * middle,
            shaft=numbers,
            whirl=whirl,
            peak=best[0],
            peak_speed=best[1],
            peak_place=best[2],
            steady=steady,
            cracked=cracked,
            cancelled=cancelled,
        )
