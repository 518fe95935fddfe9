"""The design whose torques swing least over a band of speeds: peaks between the speeds looked at are met on the way."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from cardan.maths.arrays import Array
from cardan.maths.curves.minimax import least_peak
from cardan.questions.torsion.steady.torsion_response import Progress

from .band import about_peaks

Swings: TypeAlias = Callable[[Array, Array], Array]
"""From places (D, v) in the unit box and speeds (S,) to swings of torques (D, S, E) [N·m], all finite."""

Closer: TypeAlias = Callable[[Array], Array]
"""From a place (v,) to the speeds, rising, at which it is looked at closer."""

ROUNDS = 6
"""Times that peaks are met between the speeds of the search, and the search goes on."""

CLOSE = 0.003
"""Peaks between the speeds of the search may be higher by this share."""

MET = 8
"""Peaks met at once."""


class Stopped(Exception):
    """The one who watches has answered "stop"."""


class Watch:
    """Tells how much of a work in several parts is done, and remembers the answer "stop"."""

    def __init__(self, progress: Progress | None) -> None:
        self.progress, self.stopped = progress, False

    def share(self, done: float) -> object:
        """Tell the share of the whole work that is done; return "stop" once that was the answer."""
        if self.progress is not None and not self.stopped and self.progress(done) == "stop":
            self.stopped = True
        return "stop" if self.stopped else None

    def part(self, low: float, high: float) -> Progress:
        """Return what tells the share of a part of the work, from one share of the whole to another."""
        return lambda done: self.share(low + (high - low) * done)


@dataclass(frozen=True, eq=False, kw_only=True)
class Watched:
    """How work is watched: told the share done, Stopped where the answer is "stop"."""

    progress: Progress
    expected: float  # designs that the work takes, about

    def tell(self, asked: int) -> None:
        """Tell how many designs are done."""
        if self.progress(min(asked / self.expected, 1.0)) == "stop":
            raise Stopped


class LeastSwing:
    """Finds the place whose largest swing is smallest; keeps the best it has seen.

    swings: `Swings`; speed (S,) [rad/s]: where the search begins to look.
    closer: `Closer`; None where these speeds are all that count.
    """

    def __init__(self, swings: Swings, speed: Array, closer: Closer | None, watched: Watched) -> None:
        self.swings, self.speed, self.closer, self.watched = swings, speed, closer, watched
        self.best: Array = np.zeros(0)
        self.least = np.inf
        self.asked = 0
        self.converged = False

    def run(self, start: Sequence[Array] | Array) -> None:
        """Search from the best of some places; raises Stopped when told to."""
        kept = [start[len(start) // 2]]
        self._curves(np.asarray(start))
        for _round in range(ROUNDS):
            self.converged = least_peak(self._curves, self.best).converged
            if self.closer is None or not self._met(self.closer(self.best)):
                return
            kept.append(self.best)
            self.least = np.inf
            self._curves(np.stack(kept))
        self.converged = False

    def _curves(self, places: Array) -> Array:
        """Return all swings of designs, array (D, S·E) [N·m]."""
        self.watched.tell(self.asked)
        swing = self.swings(places, self.speed)
        self.asked += len(places)
        peak = np.max(swing, axis=(-1, -2))
        if float(np.min(peak)) < self.least:
            self.best, self.least = places[int(np.argmin(peak))], float(np.min(peak))
        return swing.reshape(len(places), -1)

    def _met(self, speed: Array) -> bool:
        """Look closer at the best so far; tell whether peaks between the speeds of the search have been met."""
        peak = self._peaks(speed)
        between = about_peaks(speed, peak)
        order = np.argsort(np.append(speed, between), kind="stable")
        speed, peak = np.append(speed, between)[order], np.append(peak, self._peaks(between))[order]
        beside = np.pad(peak, 1, constant_values=-1.0)
        local = (peak >= beside[:-2]) & (peak >= beside[2:]) & (peak > self.least * (1.0 + CLOSE))
        if not local.any():
            return False
        met = np.flatnonzero(local)[np.argsort(-peak[local])][:MET]
        self.speed = np.unique(np.concatenate([self.speed, speed[met]]))
        return True

    def _peaks(self, speed: Array) -> Array:
        """Return the largest swing of the best so far at speeds, array (S,) [N·m]."""
        if not len(speed):
            return np.zeros(0)
        found: Array = np.max(self.swings(self.best[None], speed)[0], axis=-1)
        return found
