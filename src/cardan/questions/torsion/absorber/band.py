"""Drives over a band of speeds: at which speeds to look, and how far torques swing there, many drives at once."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import TypeAlias

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.errors import Problem, refuse
from cardan.maths.arrays import Array
from cardan.maths.curves.search import least_peak
from cardan.questions.torsion.model.inputs import base_period
from cardan.questions.torsion.model.torsion import orders
from cardan.questions.torsion.model.torsional_layouts import chosen
from cardan.questions.torsion.model.torsional_model import TorsionalModel
from cardan.questions.torsion.model.torsional_modes import main_order
from cardan.questions.torsion.model.torsional_train import TorsionalTrain, chained, in_time, stacked, torsional_train
from cardan.questions.torsion.stability.stability_kernel import vibration_growth
from cardan.questions.torsion.steady.alternating_torque import TorqueSwings, torque_swings
from cardan.questions.torsion.steady.orbit import straight_frequencies
from cardan.questions.torsion.steady.torsion_response import Progress, loaded_model, zone_order
from cardan.questions.torsion.steady.two_frequency_stability import growth_with_torques, meetings
from cardan.texts import _

# The design whose torques swing least over a band of speeds: peaks between the speeds looked at are met on the way.

OneAtATime: TypeAlias = Callable[[Array, Array], Array]
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

    def __init__(self, swings: OneAtATime, speed: Array, closer: Closer | None, watched: Watched) -> None:
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


BESIDE = (0.0, -0.006, 0.006, -0.015, 0.015, -0.04, 0.04)
"""Where to look beside a resonance, as shares of its speed."""

FINER = (0.0, *(sign * step for step in (0.001, 0.002, 0.004, 0.007, 0.012, 0.02, 0.03, 0.045) for sign in (-1, 1)))
"""The same for the curves of a picture."""

ZONED = 3
"""Modes whose sums with others are looked at for parametric resonance."""

GROWS = 1e-5
"""Growth in a period from which a motion is called unstable in a search."""

JUDGED, LOOSE = 6, 3
"""Speeds of a drive at which a search asks for stability, and those at which torques that do not repeat meet modes."""

FINE = 81
"""Evenly spread speeds of curves."""

SPREAD = 25
"""Evenly spread speeds at which curves are asked for stability, beside those amid the zones."""

HIGH = 0.7
"""Share of the highest peak from which others are looked at closer."""

BETWEEN = 5
"""Parts into which the way to a neighbour of a peak is divided."""

GOLDEN = 0.6180339887498949


@dataclass(frozen=True, eq=False, kw_only=True)
class Lines:
    """Drives of one build, ready to be run at speeds."""

    drives: tuple[Drive, ...]
    trains: tuple[TorsionalTrain, ...]  # at the middle of the band
    speed: float  # [rad/s]

    @property
    def elements(self) -> Array:
        """Elements of the line itself, what hangs on it left out: array of int."""
        train = self.trains[0]
        line = set(train.line)
        return np.asarray([k for k, ends in enumerate(train.model.elements) if line.issuperset(ends)], dtype=int)

    @property
    def element_names(self) -> tuple[str, ...]:
        """Names of these elements."""
        names = self.trains[0].element_names
        return tuple(names[k] for k in self.elements)

    @property
    def omega(self) -> Array:
        """Natural frequencies of the straight lines, without turning as a whole, array (D, m) [rad/s]."""
        model = stacked([one.model for one in self.trains])
        whole = straight_frequencies(chosen(model, (len(self.trains),), np.arange(len(self.trains))))
        return whole[:, 1:] if model.free else whole

    @property
    def play(self) -> bool:
        """Whether any of its elements has play, which counts as closed here."""
        return bool(np.any(self.trains[0].model.backlash > 0.0))

    def at(self, speed: Array) -> TorsionalModel:
        """Return the models at speeds (D, S) [rad/s], all play closed, drive by drive in one axis (D·S,).

        Structural damping counts as in `cardan.questions.torsion.steady.torsion_response.loaded_model`.
        """
        count, width = speed.shape
        train, duty = self.trains[0], self.drives[0].duty
        if duty.engine is not None and duty.engine.piston_mass:  # its torques change with the speed
            parts = []
            for drive, row in zip(self.drives, speed, strict=True):
                model = replace(loaded_model(drive, drive.duty, row)[1], tables=(), friction=None, creep=None)
                parts.append(chosen(model, (width,), np.arange(width), moments=False))
            return _closed(chained(parts))
        rows = np.repeat(np.arange(count), width)
        model = chosen(stacked([one.model for one in self.trains]), (count,), rows, moments=False)
        if train.pendulums:
            stiffness, at = model.stiffness.copy(), list(train.pendulums)
            stiffness[:, at] *= (speed.reshape(-1, 1) / self.speed) ** 2
            model = replace(model, stiffness=stiffness)
        if not model.free:
            model = replace(model, input_speed=speed.reshape(-1))
        turning = np.abs(speed)
        disturbed = None
        if np.any(model.loss_factor):
            disturbed = np.concatenate(
                [zone_order(train.model, own) * own for train, own in zip(self.trains, turning, strict=True)]
            )
        return in_time(_closed(model), main_order(model) * turning.reshape(-1), disturbed)

    def swings(self, speed: Array, progress: Progress | None = None) -> TorqueSwings:
        """Return how far torques swing at speeds (D, S) [rad/s]; axes (D·S,)."""
        return torque_swings(self.at(speed), speed.reshape(-1), progress=progress)


def _closed(model: TorsionalModel) -> TorsionalModel:
    return replace(model, backlash=np.zeros_like(model.backlash))


def lines(drives: Sequence[Drive], speed: float) -> Lines:
    """Return drives of one build, their trains taken at a speed."""
    return Lines(drives=tuple(drives), trains=tuple(train_at(one, speed) for one in drives), speed=speed)


def train_at(drive: Drive, speed: float) -> TorsionalTrain:
    """Return the torsional model of a drive at a speed [rad/s]; refused where nothing of it twists."""
    train = torsional_train(drive, drive.duty, speed=speed)
    if not train.model.elements:
        text = _("missing; every shaft counts as rigid, so nothing vibrates: give a body of known length, or stiffness")
        raise refuse("shafts[0].stiffness", text)
    return train


def built(train: TorsionalTrain) -> tuple[object, ...]:
    """Return what drives must share to be solved at once."""
    model = train.model
    laws = tuple((torque.station, type(torque.law), torque.law.order) for torque in model.torques)
    return model.driven, model.elements, model.free, train.pendulums, laws


def excited(drive: Drive, duty: Duty) -> tuple[float, ...]:
    """Return the orders of the input shaft that excite a drive, rising; those of a joint where nothing does.

    Orders that no two turns hold a whole number of times have their first side bands among them.
    """
    found = [order for order, _cause in orders(drive, duty)] or [2.0, 4.0]
    loose = [order for order in found if base_period((order,)) is None]
    return tuple(sorted({*found, *(abs(order + beside) for order in loose for beside in (-2.0, 2.0))}))


def zone_speeds(omega: Array) -> Array:
    """Return the speeds of parametric resonance of straight lines, array (D, z): Ω = ω_i and (ω_i + ω_j)/2."""
    low = omega[:, :ZONED]
    sums = [0.5 * (low[:, i] + low[:, j]) for i, j in combinations(range(low.shape[1]), 2)]
    return np.concatenate([omega, *(one[:, None] for one in sums)], axis=-1)


def band_speeds(
    low: float,
    high: float,
    omega: Array,
    at: Sequence[float],
    *,
    count: int,
    beside: Sequence[float] = BESIDE,
) -> Array:
    """Return speeds of a band for every drive, evenly spread and closer at its resonances, rising: array (D, S).

    low, high [rad/s]: ends of the band; one speed where they are the same.
    omega (D, m) [rad/s]: natural frequencies; at: orders that excite; count: evenly spread speeds.
    beside: where to look beside a resonance, as shares of its speed.

    >>> band_speeds(50.0, 100.0, np.asarray([[140.0]]), [2.0], count=3, beside=(0.0, 0.1))
    array([[ 50.,  70.,  75.,  77., 100.]])
    """
    if low == high:
        return np.full((len(omega), 1), low)
    even = np.broadcast_to(np.linspace(low, high, count), (len(omega), count))
    meeting = (omega[:, :, None] / np.asarray(at)).reshape(len(omega), -1)
    zones = zone_speeds(omega)
    near = (meeting[:, :, None] * (1.0 + np.asarray(beside))).reshape(len(omega), -1)
    centres = np.concatenate([near, zones], axis=-1)
    inside = (centres > low) & (centres < high)
    most = int(np.max(np.sum(inside, axis=-1), initial=0))
    order = np.argsort(~inside, axis=-1, kind="stable")[:, :most]
    taken, real = np.take_along_axis(centres, order, axis=-1), np.take_along_axis(inside, order, axis=-1)
    between = low + (high - low) * ((0.5 + GOLDEN * np.arange(most)) % 1.0)
    return np.sort(np.concatenate([even, np.where(real, taken, between)], axis=-1), axis=-1)


def about_peaks(speed: Array, peak: Array) -> Array:
    """Return speeds between the highest local peaks of a curve and their neighbours, array (k,) [rad/s].

    speed (S,) [rad/s]: rising; peak (S,): largest value at each.

    >>> about_peaks(np.asarray([1.0, 2.0, 3.0, 4.0]), np.asarray([0.0, 5.0, 3.0, 1.0])).round(2)
    array([1.2, 1.4, 1.6, 1.8, 2.2, 2.4, 2.6, 2.8])
    """
    value = np.nan_to_num(peak, nan=-np.inf)
    beside = np.pad(value, 1, constant_values=-np.inf)
    local = (value >= beside[:-2]) & (value >= beside[2:]) & (value >= HIGH * np.max(value, initial=0.0))
    found = [
        np.linspace(speed[a], speed[b], BETWEEN + 1)[1:-1]
        for k in np.flatnonzero(local)
        for a, b in ((k - 1, k), (k, k + 1))
        if a >= 0 and b < len(speed) and speed[b] > speed[a]
    ]
    return np.unique(np.concatenate(found)) if found else np.zeros(0)


def growth(found: TorqueSwings, speed: Array, omega: Array, asked: Array) -> Array:
    """Return how fast disturbances grow in drives, the largest growth of any speed asked: array (D,) [per period].

    Looked at amid the zones of parametric resonance, and at the speed of the largest torque: not at every speed.
    found (D·S,), speed (D, S) [rad/s]; omega (D, m) [rad/s]: natural frequencies; asked (D,) of bool.
    Returns: ln of the largest multiplier; 0 where nothing grows, and for drives not asked.
    """
    count, width = speed.shape
    zones = zone_speeds(omega)
    inside = (zones >= speed[:, :1]) & (zones <= speed[:, -1:])
    largest = np.argmax(np.nan_to_num(np.max(found.swing, axis=-1)).reshape(count, width), axis=-1)
    rows: set[int] = set()
    for d in np.flatnonzero(asked):
        columns = {int(np.argmin(np.abs(speed[d] - one))) for one in np.sort(zones[d][inside[d]])[: JUDGED - 1]}
        rows |= {int(d) * width + k for k in columns | {int(largest[d])}}
    judged = np.asarray(sorted(row for row in rows if found.found.reshape(-1)[row]), dtype=int)
    worst = np.zeros(count)
    if judged.size:
        grown = vibration_growth(found.orbit, judged)
        np.maximum.at(worst, judged // width, np.where(grown > GROWS, grown, 0.0))
    return worst


def with_loose(found: TorqueSwings, omega: Array, speed: Array) -> tuple[Array, Array]:
    """Return speeds of a drive at which torques that do not repeat may make disturbances grow, and the growth there.

    At that of its largest torque, and where they meet a mode twice or two as a sum: arrays (k,) [rad/s] and
    (k,) [per period], nan where it is not known.
    found (S,); omega (m,) [rad/s]: natural frequencies; speed (S,) [rad/s]: rising.
    """
    swing = np.max(np.nan_to_num(found.swing, nan=-1.0), axis=-1)
    meeting = np.sort(meetings(omega, found.loose))
    meeting = meeting[(meeting >= speed[0]) & (meeting <= speed[-1])][:LOOSE]
    columns = np.unique([int(np.argmax(swing)), *(int(np.argmin(np.abs(speed - one))) for one in meeting)])
    rows = columns[found.found[columns]]
    return speed[rows], growth_with_torques(found.orbit, rows, found.loose)


def element_problems(line: Lines, elements: Sequence[int] | None) -> Iterator[Problem]:
    """Yield what is wrong with the elements of a drive that are to be judged."""
    names = line.element_names
    if elements is not None and not len(elements):
        yield Problem("elements", _("empty; name one at least, or leave it out"))
    if any(not 0 <= k < len(names) for k in (() if elements is None else elements)):
        text = _("not all of these are there; the line has {count}: {names}")
        yield Problem("elements", text.format(count=len(names), names=", ".join(names)))


def check_swings(peak: float) -> None:
    """Refuse a drive whose torques do not swing in the band."""
    if not peak > STILL:
        text = _("nothing oscillates in this band: the joints are straight, and no engine or torque has orders")
        raise refuse("duty.speed_range", text)


def wanted_band(duty: Duty, speeds: tuple[float, float] | None) -> tuple[float, float] | None:
    """Return lowest and highest speed of a band: as asked, else the range or the speed of the duty; None without."""
    if speeds is not None:
        low, high = sorted(abs(float(one)) for one in speeds)
    elif duty.speed_range is not None:
        low, high = sorted(duty.speed_range)
    elif duty.speed is not None:
        low = high = abs(duty.speed)
    else:
        return None
    if not (np.isfinite(high) and high > 0.0):
        raise refuse("speeds", _("a band of speeds above 0 is needed"))
    return max(low, LOWEST * high), high


STILL = 1e-9
"""Torque [N·m] that counts as none."""

LOWEST = 0.02
"""Share of the highest speed below which a band does not reach: nothing vibrates at standstill."""


def fine_speeds(band: tuple[float, float], runs: Sequence[Lines]) -> Array:
    """Return the speeds of curves of drives, rising: evenly, and close about their resonances, array (S,) [rad/s]."""
    drive = runs[0].drives[0]
    omega = np.concatenate([one.omega for one in runs], axis=-1)
    return band_speeds(*band, omega, excited(drive, drive.duty), count=FINE, beside=FINER)[0]


def unstable_speeds(found: TorqueSwings, omega: Array, speed: Array) -> tuple[Array, bool]:
    """Return the speeds at which a disturbance grows: looked at evenly, and amid the zones of resonance.

    Torques that do not repeat count where they may make it grow, see `with_loose`.
    found (S,); omega (1, m) [rad/s]: natural frequencies; speed (S,) [rad/s]: rising.
    Returns them, array (k,) [rad/s], and whether it is known of all these speeds.
    """
    zones, low, high = zone_speeds(omega)[0], speed[0], speed[-1]
    wanted = np.append(np.linspace(low, high, SPREAD), zones[(zones > low) & (zones < high)])
    rows = np.unique([int(np.argmin(np.abs(speed - one))) for one in wanted])
    rows = rows[found.found[rows]]
    grown = vibration_growth(found.orbit, rows) if rows.size else np.zeros(0)
    unstable = speed[rows][grown > GROWS]
    if unstable.size or not found.loose:  # one that is unstable without them is so anyway
        return unstable, True
    looked, together = with_loose(found, omega[0], speed)
    return np.union1d(unstable, looked[together > GROWS]), bool(np.all(np.isfinite(together)))
