"""What a drive does over a band of speeds without an absorber, by its closed form, and in its best setting."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from cardan.maths.arrays import Array
from cardan.questions.torsion.model.torsional_balance import places
from cardan.questions.torsion.steady.torque_swing import TorqueSwings
from cardan.questions.torsion.steady.torsion_response import Progress

from .absorber_search import Setting, Task, highest
from .band import Lines, about_peaks, fine_speeds, lines, unstable_speeds

SAMPLES = 96
"""Angles of a period at which the swing of an absorber is read off."""


class Curves:
    """What a drive does over the band without an absorber, with the closed form, and with the best setting."""

    def __init__(self, task: Task, best: Setting, band: tuple[float, float], watch: Progress) -> None:
        bare = lines([task.drive], task.middle)
        (first, _at), (last, element) = task.line(task.closed_form), task.line(best)
        serves = task.speed if task.kind == "tuned" else []
        self.task = task
        rough = np.unique(np.append(fine_speeds(band, (bare, last)), serves))
        closer = [rough]
        for k, line in enumerate((bare, first, last)):
            peak = np.max(line.swings(rough[None]).swing[:, task.elements], axis=-1)
            closer.append(about_peaks(rough, peak))
            watch(0.1 * (k + 1))
        self.speed = np.unique(np.concatenate(closer))
        runs = []
        for k, line in enumerate((bare, first, last)):
            runs.append(line.swings(self.speed[None]))
            watch(0.3 + 0.1 * (k + 1))
        self.before, self.closed, self.after = (one.swing[:, bare.elements] for one in runs)
        self.torque = runs[2].swing[:, element]
        self.twist, self.heat = self._swing(runs[2], last, element, best)
        self.unstable = tuple(
            unstable_speeds(one, line.omega, self.speed) for one, line in ((runs[0], bare), (runs[2], last))
        )
        watch(1.0)

    def peaked(self, setting: Setting, swing: Array) -> Setting:
        """Return a setting with its peak; where it serves one speed, that of this speed."""
        rows = np.isin(self.speed, self.task.speed) if self.task.kind == "tuned" else slice(None)
        peak, speed, element = highest(swing[rows], self.speed[rows], self.task.elements)
        return replace(setting, peak=peak, peak_speed=speed, peak_element=element)

    def _swing(self, found: TorqueSwings, line: Lines, element: int, setting: Setting) -> tuple[Array, Array]:
        """Return how far the absorber swings against its station, and what its damper turns to heat, arrays (s,)."""
        orbit, rows = found.orbit, np.arange(found.orbit.count)
        q, rate, _acceleration = orbit.of(rows, orbit.period * np.arange(SAMPLES) / SAMPLES)
        drives = orbit.drives(rows)
        place = places(drives, q)
        host, tail = drives.elements[element]
        speed = place.first * rate[..., list(drives.coordinate)]
        angle = place.angle[..., tail] - place.angle[..., host]
        heat = np.mean(setting.damping * (speed[..., tail] - speed[..., host]) ** 2, axis=-1)
        swing = 0.5 * np.ptp(angle, axis=-1)
        if setting.arm is not None:
            swing = swing * (self.task.radius + setting.arm) / setting.arm
        return swing, heat
