"""The search behind `absorber`: a drive with an absorber of any setting, run over a band of speeds."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import product
from math import log10

import numpy as np

from cardan.analysis.torque_swing import torque_swings
from cardan.analysis.torsion_response import Progress
from cardan.analysis.torsional_batch import chosen
from cardan.analysis.torsional_model import TorsionalModel
from cardan.drive.drive import Drive
from cardan.drive.station import Absorber as Branch
from cardan.drive.station import Pendulum
from cardan.maths.arrays import Array

from .band import Lines, about_peaks, lines
from .hosts import Host, branch_of, hung
from .minimax import least_peak

FREQUENCY = 2.0
"""Range of the natural frequency of an absorber in the search: closed form over and times this."""

DAMPING = 10.0
"""The same of its damping."""

ORDER = 1.4
"""The same of the order a pendulum is tuned to."""

COARSE = (0.3, 0.4, 0.5, 0.6, 0.7)
"""Places in these ranges from which the search takes the best to begin with; 0.5 is the closed form."""

ROUNDS = 6
"""Times that peaks are met between the speeds of the search, and the search goes on."""

CLOSE = 0.003
"""Peaks between the speeds of the search may be higher by this share."""

MET = 8
"""Peaks met at once."""

LOST = 10.0
"""What a motion that was not found counts as, times the largest torque without absorber."""

DIGITS = 5
"""Digits of what is written into a drive: no absorber is made more accurately."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Setting:
    """How an absorber is set.

    Attributes
    ----------
    inertia : float [kg·m²]
        J_a; of pendulums all m (R + l)² together.
    stiffness : float [N·m/rad]
        c_a; of a pendulum J_a Ω² R/l at the middle of the band.
    damping : float [N·m·s/rad]
        b.
    arm : float or None [m]
        l of a pendulum.
    peak : float [N·m]
        Largest swing of a torque of the drive in the band, with it.
    peak_speed : float [rad/s]
        Where.
    peak_element : int
        In which element, from 0 in `Absorber.elements`.
    """

    inertia: float
    stiffness: float
    damping: float
    arm: float | None = None
    peak: float = float("nan")
    peak_speed: float = float("nan")
    peak_element: int = 0


def rounded(value: float) -> float:
    """Return a value with as many digits as can be made.

    Examples
    --------
    >>> rounded(65306.12244), rounded(0.0)
    (65306.0, 0.0)
    """
    return 0.0 if value == 0.0 else round(value, DIGITS - 1 - int(np.floor(log10(abs(value)))))


class Stopped(Exception):
    """The one who watches has answered "stop"."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Task:
    """A drive, what hangs on it, and the band it is judged in.

    Attributes
    ----------
    drive : Drive
        Without.
    host : Host
        Where it hangs.
    kind : str
    closed_form : Setting
    speed : array (S,) [rad/s]
        Speeds of the search.
    middle : float [rad/s]
        Speed at which trains are taken.
    elements : array of int
        Elements that are judged, in the model.
    radius : float [m]
        Of pendulums.
    count : int
        Of pendulums.
    closer : callable or None
        From a drive with an absorber to the speeds at which it is looked at closer; None where one speed counts.
    """

    drive: Drive
    host: Host
    kind: str
    closed_form: Setting
    speed: Array
    middle: float
    elements: Array
    radius: float
    count: int
    closer: Callable[[Lines], Array] | None = None

    @property
    def ranges(self) -> tuple[float, ...]:
        """Range of every unknown: closed form over and times it."""
        return {"tuned": (FREQUENCY,), "viscous": (DAMPING,), "pendulum": (ORDER,)}.get(self.kind, (FREQUENCY, DAMPING))

    def setting(self, place: Array) -> Setting:
        """Return the setting at a place (v,) of the unit box; the closed form is its middle."""
        factors = [float(reach ** (2.0 * x - 1.0)) for reach, x in zip(self.ranges, place, strict=True)]
        base = self.closed_form
        if self.kind == "viscous":
            return replace(base, damping=rounded(base.damping * factors[0]))
        if self.kind == "pendulum":
            assert base.arm is not None
            arm = rounded(base.arm / factors[0] ** 2)
            return replace(base, arm=arm, stiffness=base.inertia * self.middle**2 * self.radius / arm)
        damping = rounded(base.damping * factors[1]) if len(factors) > 1 else 0.0
        return replace(base, stiffness=rounded(base.stiffness * factors[0] ** 2), damping=damping)

    def thing(self, setting: Setting) -> Branch | Pendulum:
        """Return what hangs on the station."""
        if setting.arm is None:
            return Branch(inertia=setting.inertia, stiffness=setting.stiffness, damping=setting.damping)
        mass = setting.inertia / (self.count * (self.radius + setting.arm) ** 2)
        return Pendulum(mass=mass, radius=self.radius, length=setting.arm, count=self.count)

    def with_it(self, setting: Setting) -> tuple[Drive, int]:
        """Return the drive with it, and the number of its `[[stations]]`."""
        return hung(self.drive, self.host, self.thing(setting))

    def line(self, setting: Setting) -> tuple[Lines, int]:
        """Return the drive with it as lines, and its element in the model."""
        drive, table = self.with_it(setting)
        found = lines([drive], self.middle)
        return found, len(found.elements) + branch_of(drive, table)


class Search:
    """Finds the setting whose largest swing of a torque is smallest; keeps the best it has seen.

    Parameters
    ----------
    task : Task
    bare : float [N·m]
        Largest swing without.
    progress : function, optional
        Told the share done.
    """

    def __init__(self, task: Task, bare: float, progress: Progress | None) -> None:
        self.task, self.bare, self.progress = task, bare, progress
        self.line, self.element = task.line(task.closed_form)
        self.speed = task.speed
        self.kept: list[Array] = []
        self.best, self.least = np.full(len(task.ranges), 0.5), np.inf
        self.asked = 0
        self.converged = False

    def run(self) -> None:
        """Search; raises Stopped when told to."""
        unknowns = len(self.task.ranges)
        self._curves(np.asarray(list(product(COARSE, repeat=unknowns))))
        for _round in range(ROUNDS):
            self.converged = least_peak(self._curves, self.best).converged
            if self.task.closer is None or not self._met():
                return
            middle = np.full(unknowns, 0.5)
            places, self.least = np.stack([self.best, middle, *self.kept]), np.inf
            self._curves(places)
        self.converged = False

    def _met(self) -> bool:
        """Look closer at the best so far; tell whether peaks between the speeds of the search have been met."""
        assert self.task.closer is not None
        speed = self.task.closer(self.task.line(self.task.setting(self.best))[0])
        peak = self._peaks(speed)
        between = about_peaks(speed, peak)
        order = np.argsort(np.append(speed, between), kind="stable")
        speed, peak = np.append(speed, between)[order], np.append(peak, self._peaks(between))[order]
        beside = np.pad(peak, 1, constant_values=-1.0)
        local = (peak >= beside[:-2]) & (peak >= beside[2:]) & (peak > self.least * (1.0 + CLOSE))
        if not local.any():
            return False
        highest_first = np.flatnonzero(local)[np.argsort(-peak[local])][:MET]
        self.kept.append(self.best)
        self.speed = np.unique(np.concatenate([self.speed, speed[highest_first]]))
        return True

    def _peaks(self, speed: Array) -> Array:
        """Return the largest swing with the best setting at speeds, array (S,) [N·m]."""
        found = torque_swings(self._models(self.best[None], speed), speed)
        peak: Array = np.max(np.nan_to_num(found.swing[:, self.task.elements], nan=LOST * self.bare), axis=-1)
        return peak

    def _models(self, places: Array, speed: Array) -> TorsionalModel:
        """Return the drives of places (D, v) at speeds (S,), in one axis (D·S,)."""
        width, count = len(speed), len(places)
        model = chosen(self.line.at(speed[None]), (width,), np.tile(np.arange(width), count), moments=False)
        reach, middle = np.asarray(self.task.ranges), self.task.closed_form
        factor = np.repeat(reach ** (2.0 * places - 1.0), width, axis=0)
        stiffness, damping = model.stiffness.copy(), model.damping.copy()
        if self.task.kind == "viscous":
            damping[:, self.element] *= factor[:, 0]
        else:
            stiffness[:, self.element] *= factor[:, 0] ** 2
        if len(reach) > 1:
            damping[:, self.element] = middle.damping * factor[:, 1]
        return replace(model, stiffness=stiffness, damping=damping)

    def _curves(self, places: Array) -> Array:
        """Return the swings of the torques of drives, array (D, S·E) [N·m]."""
        if self.progress is not None:
            share = min(self.asked / (40.0 * len(self.task.ranges) + len(COARSE) ** len(self.task.ranges)), 1.0)
            if self.progress(share) == "stop":
                raise Stopped
        found = torque_swings(self._models(places, self.speed), np.tile(self.speed, len(places)))
        self.asked += len(places)
        swing = found.swing[:, self.task.elements]
        swing = np.where(np.isfinite(swing), swing, LOST * self.bare).reshape(len(places), -1)
        peak = np.max(swing, axis=-1)
        if float(np.min(peak)) < self.least:
            self.best, self.least = places[int(np.argmin(peak))], float(np.min(peak))
        return swing


def highest(swing: Array, speed: Array, elements: Sequence[int] | Array) -> tuple[float, float, int]:
    """Return the largest of swings (S, E), its speed and its element; what was not found does not count."""
    judged = np.nan_to_num(swing[:, np.asarray(elements, dtype=int)], nan=-1.0)
    row, column = np.unravel_index(int(np.argmax(judged)), judged.shape)
    return float(judged[row, column]), float(speed[row]), int(np.asarray(elements)[column])
