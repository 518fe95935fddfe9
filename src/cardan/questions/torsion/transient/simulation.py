"""What a simulation found: angles, speeds and torques over time, their extremes, and the account of energy."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import IntEnum
from typing import TypeAlias

import numpy as np

from cardan.maths.arrays import Array
from cardan.questions.torsion.model.torsional_balance import (
    accelerations,
    balance,
    element_torques,
    energy,
    places,
)
from cardan.questions.torsion.model.torsional_model import TorsionalModel

from .time_integration import WITHIN, Freedom, Piece

Progress: TypeAlias = Callable[[float], object]
"""Called with the share done; answering "stop" ends the work."""

CLOSER = 20
"""How much finer the places around an extreme lie than before, twice."""

ALIKE = 1e-9
"""Peaks that differ by less of their size are one that repeats: integration is no more exact."""

PIECES = 96
"""Pieces whose extremes are looked for together."""


class Status(IntEnum):
    """How a simulation ended."""

    DONE = 0
    DIVERGED = 1
    """The motion left all bounds."""
    CANCELLED = 2
    """``progress`` said stop."""
    SNAPPED = 3
    """The torque snapped a joint without inertia through: its static balance ended."""
    STALLED = 4
    """No step was short enough for the tolerance, or contacts changed without end."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Extremes:
    """Lowest and highest values over the whole span, found between the samples too, and when they were reached."""

    torque_low: Array  # torque_low, torque_high (..., E) [N·m]: of every element
    torque_high: Array  # (..., E) [N·m]
    torque_low_time: Array  # (..., E) [s]
    torque_high_time: Array  # (..., E) [s]
    speed_low: Array  # speed_low, speed_high (..., N) [rad/s]: of every station
    speed_high: Array  # (..., N) [rad/s]
    speed_low_time: Array  # (..., N) [s]
    speed_high_time: Array  # (..., N) [s]


@dataclass(frozen=True, eq=False, kw_only=True)
class Simulation:
    """Motion of one drive or of many over time; nan after a drive ended early."""

    times: Array  # (t,) [s]: samples
    coordinate: Array  # coordinate, rate (..., t, R) [rad, rad/s]: angles and speeds of the coordinates
    rate: Array  # (..., t, R) [rad/s]
    angle: Array  # angle, speed (..., t, N) [rad, rad/s]: of every station
    speed: Array  # (..., t, N) [rad/s]
    torque: Array  # (..., t, E) [N·m]: of every element, positive when it carries power along the drive
    # (..., t) [N·m]: torque that forces the speed of the first station; None where it is free
    input_torque: Array | None
    energy: Array  # (..., t) [J]: Σ ½ J Ḟ² + Σ ½ c x_e²
    work: Array  # (..., t) [J]: what torques have brought since the start, less what dampers have taken
    extremes: Extremes
    status: Array  # (...) of int: a `Status` each
    ended: Array  # (...) [s]: time that was reached
    steps: int  # steps taken, of all drives
    method: str  # what integrated: "explicit", "implicit" or "fixed steps"

    @property
    def residual(self) -> Array:
        """What the account of energy misses: E(t) - E(0) - work, array (..., t) [J]."""
        return self.energy - self.energy[..., :1] - self.work

    @property
    def imbalance(self) -> Array:
        """Greatest `residual` over the greatest energy or work, array (...)."""
        largest = np.maximum(_largest(self.energy), _largest(self.work))
        return _largest(self.residual) / np.where(largest > 0.0, largest, 1.0)


def _largest(values: Array) -> Array:
    """Return the greatest size along the last axis, of what is finite."""
    return np.max(np.where(np.isfinite(values), np.abs(values), 0.0), axis=-1, initial=0.0)


def reported(
    model: TorsionalModel,
    times: Array,
    q: Array,
    rate: Array,
    work: Array,
    *,
    forced_acceleration: Array | None,
    extremes: Extremes,
    status: Array,
    ended: Array,
    steps: int,
    method: str,
) -> Simulation:
    """Return a simulation from the coordinates at its samples.

    times (t,) [s], q, rate (..., t, R) [rad, rad/s], work (..., t) [J].
    forced_acceleration (t,) [rad/s²]: of the first coordinate, where it is forced.
    extremes, status, ended, steps, method: as in `Simulation`.
    """
    place = places(model, q)
    speed = place.first * rate[..., list(model.coordinate)]
    reaction = None
    if forced_acceleration is not None:
        change = accelerations(model, q, rate, times) if model.hinges else np.zeros_like(q)
        change[..., 0] = forced_acceleration
        reaction = balance(model, q, rate, change, times)[..., 0]
    return Simulation(
        times=times,
        coordinate=q,
        rate=rate,
        angle=place.angle,
        speed=speed,
        torque=element_torques(model, q, rate, times),
        input_torque=reaction,
        energy=energy(model, q, rate),
        work=work,
        extremes=extremes,
        status=status,
        ended=ended,
        steps=steps,
        method=method,
    )


class Record:
    """Gathers the samples and extremes of one drive, piece by piece."""

    def __init__(self, model: TorsionalModel, times: Array) -> None:
        self.model, self.times = model, times
        self.q = np.full((len(times), model.coordinates), np.nan)
        self.rate = np.full((len(times), model.coordinates), np.nan)
        self.work = np.full(len(times), np.nan)
        self.filled = 0
        count = 2 * (len(model.elements) + len(model.driven))
        self.best, self.when = np.full(count, -np.inf), np.full(count, np.nan)
        self.around: list[list[tuple[Piece, Freedom]]] = [[] for _k in range(count)]
        self.waiting: list[tuple[Piece, Freedom]] = []

    def add(self, piece: Piece, freedom: Freedom) -> None:
        """Take one piece."""
        upto = int(np.searchsorted(self.times, piece.end, side="right"))
        if upto > self.filled:
            now = slice(self.filled, upto)
            self.q[now], self.rate[now], self.work[now] = self._whole(piece, freedom, self.times[now])
            self.filled = upto
        self.waiting.append((piece, freedom))
        if len(self.waiting) >= PIECES:
            self._flush(more=True)

    def _whole(self, piece: Piece, freedom: Freedom, times: Array) -> tuple[Array, Array, Array]:
        q, rate, work = piece.dense(times)
        return *freedom.whole(times, q, rate), work

    def _values(self, times: Array, q: Array, rate: Array) -> Array:
        """Return what extremes are wanted of, and its negative, array (m, 2 (E + N))."""
        place = places(self.model, q)
        both = (element_torques(self.model, q, rate, times), place.first * rate[:, list(self.model.coordinate)])
        found = np.concatenate(both, axis=-1)
        return np.concatenate((found, -found), axis=-1)

    def _flush(self, *, more: bool) -> None:
        """Look for extremes in the pieces that wait; the last one stays if more are to come, which may go on rising."""
        if not self.waiting:
            return
        times = np.concatenate([piece.within() for piece, _freedom in self.waiting])
        parts = [self._whole(piece, freedom, piece.within()) for piece, freedom in self.waiting]
        values = self._values(times, *(np.concatenate([one[k] for one in parts]) for k in range(2)))
        most = np.max(values, axis=0)
        least = ALIKE * np.max(np.abs(values), axis=0)
        top = np.argmax(values >= most - least, axis=0)  # of peaks that repeat the first
        for k, place in enumerate(top):
            if most[k] > self.best[k] + least[k]:
                self.best[k], self.when[k] = values[place, k], times[place]
                piece = place // WITHIN
                self.around[k] = self.waiting[piece : piece + 2 if (place + 1) % WITHIN == 0 else piece + 1]
        self.waiting = self.waiting[-1:] if more else []

    def extremes(self) -> Extremes:
        """Return the extremes so far, refined within their pieces."""
        self._flush(more=False)
        for k, pieces in enumerate(self.around):
            for piece, freedom in pieces:
                self._refine(k, piece, freedom)
        count, half = len(self.model.elements), len(self.best) // 2
        best, when = np.where(np.isfinite(self.best), self.best, np.nan), self.when
        return Extremes(
            torque_low=-best[half : half + count],
            torque_high=best[:count],
            torque_low_time=when[half : half + count],
            torque_high_time=when[:count],
            speed_low=-best[half + count :],
            speed_high=best[count:half],
            speed_low_time=when[half + count :],
            speed_high_time=when[count:half],
        )

    def _refine(self, k: int, piece: Piece, freedom: Freedom) -> None:
        spacing = (piece.end - piece.start) / WITHIN
        for _round in range(2):
            near = np.clip(self.when[k] + spacing * np.linspace(-1.0, 1.0, 2 * CLOSER + 1), piece.start, piece.end)
            values = self._values(near, *self._whole(piece, freedom, near)[:2])[:, k]
            top = int(np.argmax(values))
            if values[top] > self.best[k]:
                self.best[k], self.when[k] = values[top], near[top]
            spacing /= CLOSER
