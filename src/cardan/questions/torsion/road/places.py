"""Torsional vibration where a movement brings a drive: the exact periodic motion of every instant as if it stood so."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.models.geometry import geometry
from cardan.maths.arrays import Array
from cardan.maths.curves.extremes import peak
from cardan.maths.periodic.harmonics import Status
from cardan.questions.motion.standing import given_at
from cardan.questions.torsion.model.joint_bends import Bends, bends
from cardan.questions.torsion.model.side_bands import side_waves
from cardan.questions.torsion.model.torsional_balance import element_torques
from cardan.questions.torsion.model.torsional_layouts import period_of
from cardan.questions.torsion.model.torsional_model import Torque, TorsionalModel
from cardan.questions.torsion.stability.floquet_map import LONG, NO_SEARCH, floquet_map
from cardan.questions.torsion.steady.alternating_torque import BANDS
from cardan.questions.torsion.steady.orbit import Orbit
from cardan.questions.torsion.steady.run_stability import Verdict
from cardan.questions.torsion.steady.steady import steady_orbits
from cardan.questions.torsion.steady.two_frequencies import envelope, of_drives

LOOK = 60
"""Places in half a turn at which torques are looked at."""

HIGHEST = 8.0
"""Highest order told."""

CHUNK = 256
"""Motions whose torques are read off at once."""

STRIDE, LOST = 32, 12
"""Places on a ray that are asked at once, and those behind each other without a motion from which on it is left."""

Progress: TypeAlias = Callable[[float], object]
"""Told the share done; may answer "stop"."""

NOISE = 1e-9
"""Share of the largest torque below which one has no sign."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Places:
    """Torsional vibration where a movement brings a drive; t instants, or places of a distribution, E elements."""

    share: Array  # (t,): of the time
    points: Array  # (t, n+2, 3) [m]: where the points of the drive are
    joint_angle: Array  # (t, n) [rad]
    # low, high, mean (t, E) [N·m]: least, largest and mean torque of every element; nan where no motion was found
    low: Array
    high: Array
    mean: Array
    reversals: Array  # (t, E) [1/s]: how often the torque changes its sign
    times: Array | None = None  # (t,) [s]: instants; None for a distribution
    amplitude: Array | None = None  # (t, E, K) [N·m]: of the orders; None in time, where they are not told apart
    growth: Array | None = None  # (t,) [1/s]: of vibration by itself; None in time

    @property
    def found(self) -> Array:
        """Whether there is a motion, array of bool (t,)."""
        return np.asarray(np.isfinite(self.high).all(axis=-1))

    @property
    def largest(self) -> Array:
        """Largest torque of either sign of every element, array (t, E) [N·m]."""
        return np.asarray(np.maximum(np.abs(self.low), np.abs(self.high)))

    def part(self, holds: Array) -> float:
        """Return the share of the time in which something holds (t,), of that in which there is a motion."""
        return float(self.averaged(np.asarray(holds, dtype=float)))

    def averaged(self, values: Array) -> Array:
        """Return the mean over the time of values (t, ...); nan where there is no motion at all."""
        known = self.found
        if not known.any():
            return np.full(np.shape(values)[1:], np.nan)
        return np.asarray(np.average(values[known], axis=0, weights=self.share[known]))


class Standing:
    """A drive as it stands at places of its points: what its torques do there.

    model: closed, at its speed; loose: torques that do not repeat within two turns, which count to first order with
    their side bands; speed [rad/s].
    """

    def __init__(
        self,
        drive: Drive,
        model: TorsionalModel,
        loose: tuple[Torque, ...],
        speed: float,
    ) -> None:
        self.drive, self.model, self.loose, self.speed = drive, model, loose, speed
        self.base = np.asarray(geometry(drive).points)

    def turned(self, points: Array, start: Array | float = 0.0) -> tuple[Bends, Array]:
        """Return how the joints turn at places of the points (t, n+2, 3), and where (t,) all can bend so.

        start (t,) [rad]: by how much the first yoke is ahead of where it starts as drawn.
        """
        chain, place, possible = given_at(self.drive, points)
        return bends(self.drive, replace(chain, start_phase=chain.start_phase + start), place), possible

    def at(self, points: Array, progress: Progress | None = None) -> Places:
        """Return the vibration at places of the points (t, n+2, 3) [m], all of the same share.

        Without friction every motion is smooth: none is searched by shooting where there is no Fourier sum.
        """
        turns, possible = self.turned(points)
        count = len(points)
        speeds = np.full(count, self.speed)
        opened = LONG if self.model.rubs else NO_SEARCH
        found = floquet_map(replace(self.model, **turns), speed=speeds, opened=opened, progress=progress)
        known = possible & (found.floquet.verdict != Verdict.UNKNOWN)
        parts = [self._read(found.orbit, rows) for rows in _chunks(count)]
        mean, low, high, reversals, amplitude = (np.concatenate(each) for each in zip(*parts, strict=True))

        def held(values: Array) -> Array:
            return np.asarray(np.where(known.reshape(-1, *(1,) * (values.ndim - 1)), values, np.nan))

        return Places(
            share=np.full(count, 1.0 / count),
            points=points,
            joint_angle=turns["joint_angle"],
            low=held(low),
            high=held(high),
            mean=held(mean),
            reversals=held(reversals),
            amplitude=held(amplitude),
            growth=held(found.floquet.growth_rate),
        )

    def outward(self, points: Array, rays: int, progress: Progress | None = None) -> Places:
        """Return the same at places along rays from the middle of a distribution, ray by ray (rays·r, n+2, 3).

        A ray is left where `LOST` places behind each other have no motion: farther out joints bend more steeply still,
        and every search there is in vain.
        """
        width = len(points) // rays
        rows, parts, lost, stopped = [], [], np.zeros(rays, dtype=int), False
        for first in range(0, width, STRIDE):
            columns = np.arange(first, min(first + STRIDE, width))
            left = np.flatnonzero(lost < LOST)
            if not left.size or stopped:
                break
            rows.append((left[:, None] * width + columns).ravel())
            parts.append(self.at(points[rows[-1]]))
            there = parts[-1].found.reshape(len(left), -1)
            behind = np.argmax(there[:, ::-1], axis=-1)
            lost[left] = np.where(there.any(axis=-1), behind, lost[left] + len(columns))
            stopped = progress is not None and progress((first + len(columns)) / width) == "stop"
        own, count = np.concatenate(rows), len(points)

        def whole(values: list[Array]) -> Array:
            found = np.full((count, *values[0].shape[1:]), np.nan)
            found[own] = np.concatenate(values)
            return found

        names = ("low", "high", "mean", "reversals", "amplitude", "growth")
        known = {name: whole([np.asarray(getattr(part, name)) for part in parts]) for name in names}
        angle = self.turned(points)[0]["joint_angle"]
        return Places(share=np.full(count, 1.0 / count), points=points, joint_angle=angle, **known)

    def torques(self, points: Array) -> tuple[Array, Array]:
        """Return least and largest torques of the elements at places of the points (t, n+2, 3), arrays (t, E) [N·m].

        As `at` tells them, without asking whether the motions are stable, but where friction leaves that unknown.
        """
        if self.model.rubs:
            found = self.at(points)
            return found.low, found.high
        turns, possible = self.turned(points)
        speeds = np.full(len(points), self.speed)
        orbit, status = steady_orbits(replace(self.model, **turns), speed=speeds, opened=NO_SEARCH)
        known = possible & (status <= Status.COARSE)
        parts = [self._read(orbit, rows)[1:3] for rows in _chunks(len(points))]
        low, high = (np.where(known[:, None], np.concatenate(each), np.nan) for each in zip(*parts, strict=True))
        return low, high

    @property
    def order(self) -> Array:
        """Orders of the shaft, array (K,)."""
        base = 2.0 * math.pi / self._period
        return np.asarray(base * np.arange(1, round(HIGHEST / base) + 1))

    @property
    def _period(self) -> float:
        return period_of(self.model)

    def _read(self, orbit: Orbit, rows: Array) -> tuple[Array, ...]:
        """Return mean, least, largest torque, changes of its sign [1/s] and amplitudes of the orders, (b, E, ...)."""
        count = LOOK * round(orbit.period / math.pi)
        motion = orbit.of(rows, np.arange(count) * (orbit.period / count))
        q, rate, _acceleration = motion
        drives = orbit.drives(rows)
        torque = np.moveaxis(element_torques(drives, q, rate), -1, -2)
        wave = np.fft.rfft(torque, axis=-1) / count
        orders = len(self.order)
        changes = sign_changes(np.concatenate([torque, torque[..., :1]], axis=-1))
        rate_of = changes / (orbit.period / abs(self.speed))
        amplitude = 2.0 * np.abs(wave[..., 1 : orders + 1])
        if not self.loose:
            return wave[..., 0].real, -peak(-torque), peak(torque), rate_of, amplitude
        others = of_drives(orbit.model, orbit.angle_error, rows, self.loose)
        speeds, bands = orbit.speed.reshape(-1)[rows], BANDS * round(orbit.period / math.pi)
        fall, rise = envelope(side_waves(drives, motion, speeds, orbit.period, others, bands), others)
        low, high = -peak(fall - torque), peak(torque + rise)
        order = min(abs(float(one.law.order or 0.0)) for one in self.loose)
        swung = (low < 0.0) & (high > 0.0) & (rate_of == 0.0)
        return wave[..., 0].real, low, high, np.where(swung, order * abs(self.speed) / math.pi, rate_of), amplitude


def sign_changes(torque: Array) -> Array:
    """Return how often torques (..., p) change their sign; what is but rounding has none.

    >>> sign_changes(np.asarray([[2.0, -1.0, 1e-12, -1.0, 3.0]]))
    array([2])
    """
    least = NOISE * np.nanmax(np.abs(torque), initial=0.0)
    sign = np.where(np.abs(torque) <= least, 0.0, np.sign(torque))
    at = np.maximum.accumulate(np.where(sign != 0.0, np.arange(sign.shape[-1]), 0), axis=-1)
    kept = np.take_along_axis(sign, at, axis=-1)  # a zero keeps the sign before it
    return np.asarray(np.sum(kept[..., 1:] * kept[..., :-1] < 0.0, axis=-1))


def _chunks(count: int) -> list[Array]:
    return [np.arange(first, min(first + CHUNK, count)) for first in range(0, count, CHUNK)]
