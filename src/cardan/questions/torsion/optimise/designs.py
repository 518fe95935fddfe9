"""What may change in a drive that is to run calmly, and how every such design runs over the band."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import floor, isfinite

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.fields.paths import place, read, with_values
from cardan.errors import InputError, Problem, check
from cardan.maths.arrays import Array
from cardan.questions.torsion.absorber.absorber_search import highest, rounded
from cardan.questions.torsion.absorber.band import (
    GROWS,
    Lines,
    band_speeds,
    built,
    check_swings,
    excited,
    growth,
    lines,
    train_at,
    with_loose,
)
from cardan.questions.torsion.model.torsional_train import TorsionalTrain
from cardan.questions.torsion.steady.alternating_torque import TorqueSwings, exactly_where_high
from cardan.questions.torsion.steady.torsion_response import parted
from cardan.texts import _

from .spread import Spread, corners, drive_off

TURN = 90.0
"""How far yokes may turn either way where nothing else is said [°]: beyond, they stand as before."""

COUNT = 15
"""Evenly spread speeds of a search."""

LOST = 10.0
"""What a motion that was not found counts as, times the largest torque as built."""

WORST = 1e3
"""What an unstable design, or one that breaks a limit, counts as at least, times the largest torque as built: it never
beats a stable one that keeps them."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Free:
    """A quantity of the drive that may change."""

    path: str  # as ``shafts[1].yoke_angle_deg``
    low: float  # low, high: its range, in the unit of the path
    high: float
    step: float | None  # only every such step from the lowest value can be made
    built: float

    def value(self, share: float) -> float:
        """Return the value at a share of the range."""
        value = self.low + share * (self.high - self.low)
        if self.step is None:
            return value
        most = floor((self.high - self.low) / self.step + 1e-9)
        return self.low + self.step * min(round((value - self.low) / self.step), most)

    def share(self, value: float) -> float:
        """Return where a value lies in the range, from 0 to 1."""
        return min(max((value - self.low) / (self.high - self.low), 0.0), 1.0)

    def places(self, points: int) -> Array:
        """Return shares of the range for an exhaustive search: every step, or so many points."""
        if self.step is None:
            return np.linspace(0.0, 1.0, points)
        count = floor((self.high - self.low) / self.step + 1e-9) + 1
        return np.arange(count) * self.step / (self.high - self.low)


def free_quantities(drive: Drive, free: Mapping[str, Sequence[float]] | None) -> tuple[Free, ...]:
    """Return what may change: as given by paths, or the yoke angles that are not fixed."""
    if free is None:
        found = tuple(_yokes(drive))
        if not found:
            check([Problem("free", _("no yoke of this drive may be turned; say what else may change"))])
        return found
    problems: list[Problem] = []
    quantities: list[Free] = []
    known: dict[tuple[str | int, ...], str] = {}
    for path, given in free.items():
        try:
            quantities.append(_free(drive, path, [float(one) for one in given]))
            steps = place(drive, path).steps
            if steps in known:
                problems.append(Problem(path, _("is the same as {other}").format(other=known[steps])))
            known[steps] = path
        except InputError as error:
            problems += error.problems
    if not free:
        problems.append(Problem("free", _("empty; say what may change")))
    check(problems)
    return tuple(quantities)


def _yokes(drive: Drive) -> Iterator[Free]:
    for shaft in drive.shafts[1:-1]:
        if shaft.yoke_fixed:
            continue
        path = f"shafts[{shaft.number - 1}].yoke_angle_deg"
        now = float(read(drive, path))
        step = None if shaft.spline is None or shaft.spline.teeth is None else 360.0 / shaft.spline.teeth
        low, high = now - TURN, now + TURN
        if step is not None:
            low = now - step * floor(TURN / step)
            high = low + 2.0 * (now - low)
        yield Free(path=path, low=low, high=high, step=step, built=now)


def _free(drive: Drive, path: str, given: Sequence[float]) -> Free:
    steps = place(drive, path).steps
    now = read(drive, path)
    problems = []
    if steps[:2] in (("duty", "speed"), ("duty", "speed_range")):
        problems.append(Problem(path, _("the speeds are given, and a design is sought for them; take a narrower band")))
    if now is None:
        problems.append(Problem(path, _("the drive gives no value; write one into it to begin with")))
    elif isinstance(now, bool) or not isinstance(now, float):
        problems.append(Problem(path, _("leads to no number; name one, as joints[0].centre_mm[2]")))
    if len(given) not in (2, 3) or not all(isfinite(one) for one in given):
        problems.append(
            Problem(path, _("lowest and highest value are needed, and a step where only steps can be made"))
        )
    elif not given[0] < given[1]:
        text = _("{low:g} to {high:g} given; the lowest value comes first")
        problems.append(Problem(path, text.format(low=given[0], high=given[1])))
    elif len(given) == 3 and not 0.0 < given[2] <= given[1] - given[0]:
        text = _("a step of {step:g} given; more than 0 and no more than the range")
        problems.append(Problem(path, text.format(step=given[2])))
    check(problems)
    return Free(path=path, low=given[0], high=given[1], step=given[2] if len(given) == 3 else None, built=float(now))


class Designs:
    """The drive with other values, over a band of speeds.

    drive: as built, with its duty; band [rad/s].
    elements: elements that are judged; all of the line by default.
    off: tolerances; every design counts as its worst at their corners.
    used: share of the limits that a drive uses, at most 1 where it keeps them; None where there are none.
    """

    def __init__(
        self,
        drive: Drive,
        free: tuple[Free, ...],
        band: tuple[float, float],
        elements: Array | None,
        off: tuple[Spread, ...] = (),
        used: Callable[[Drive], float] | None = None,
    ) -> None:
        self.drive, self.free, self.band, self.off, self.used = drive, free, band, off, used
        self.sides = corners(len(off))
        self.middle = 0.5 * (band[0] + band[1])
        self.built = lines([drive], self.middle)
        self.elements = self.built.elements if elements is None else elements
        self.count = len(self.built.trains[0].model.elements)
        self.orders = excited(drive, drive.duty)
        self.infeasible = 0
        self.asked = 0
        speed = self.speeds(self.built)
        self.peak = highest(self.built.swings(speed).swing, speed[0], self.elements)[0]
        check_swings(self.peak)

    @property
    def nonsynchronous(self) -> bool:
        """Whether the drive has torques that do not repeat within two turns."""
        return bool(parted(self.built.trains[0].model)[1])

    @property
    def start(self) -> Array:
        """The drive as built, as far as it lies in the ranges, array (v,)."""
        return np.asarray([one.share(one.built) for one in self.free])

    def values(self, at: Array) -> dict[str, float]:
        """Return the values of a place (v,) of the unit box by their paths."""
        return {one.path: one.value(float(x)) for one, x in zip(self.free, at, strict=True)}

    def made(self, at: Array) -> dict[str, float]:
        """Return the values of a place by their paths, with as many digits as can be made."""
        return {path: rounded(value) for path, value in self.values(at).items()}

    def drive_at(self, at: Array, *, made: bool = False) -> Drive | None:
        """Return the drive of a place, or of values as they can be made; None where these make none."""
        try:
            return with_values(self.drive, self.made(at) if made else self.values(at))
        except InputError:
            return None

    def groups(self, places: Array) -> Iterator[tuple[tuple[Array, Array], Lines]]:
        """Yield places (D, v), each with its tolerances used, by their build, with row of place and of the tolerances.

        What makes no drive is left out.
        """
        yield from self.builds([self.drive_at(at) for at in places])

    def builds(
        self, drives: Sequence[Drive | None], places: Sequence[Array] | None = None
    ) -> Iterator[tuple[tuple[Array, Array], Lines]]:
        """Yield the same of drives; places: parts of the tolerances, each (k,), instead of their corners."""
        every = self.sides if places is None else places
        found: dict[tuple[object, ...], list[tuple[int, int, Drive, TorsionalTrain]]] = {}
        for k, drawn in enumerate(drives):
            made = []
            for v, sides in enumerate(every):
                drive = None if drawn is None else drive_off(drawn, self.off, sides)
                try:
                    train = None if drive is None else train_at(drive, self.middle)
                except InputError:
                    train = None
                if drive is None or train is None or len(train.model.elements) != self.count:
                    self.infeasible += 1  # also where stations meet and are one
                    break
                made.append((k, v, drive, train))
            for one in made if len(made) == len(every) else ():
                found.setdefault(built(one[-1]), []).append(one)
        for members in found.values():
            rows, which, own, trains = zip(*members, strict=True)
            yield (np.asarray(rows), np.asarray(which)), Lines(drives=own, trains=trains, speed=self.middle)

    def speeds(self, line: Lines) -> Array:
        """Return the speeds at which designs are looked at, array (D, S) [rad/s]."""
        return band_speeds(*self.band, line.omega, self.orders, count=COUNT)

    def _peaks(self, found: TorqueSwings, count: int, bare: float) -> Array:
        """Return the largest swing of every design, array (D,) [N·m]."""
        swing = found.swing[:, self.elements]
        whole = np.where(np.isfinite(swing), swing, LOST * bare)
        peak: Array = np.max(whole.reshape(count, -1), axis=-1)
        return peak

    def cost(self, places: Array, beat: Array, *, closely: bool = False) -> Array:
        """Return the largest swing of designs over the band, array (D,) [N·m]; unstable ones beyond all others.

        With tolerances that at the worst of their corners. Stability and limits are asked for only where a design would
        beat the cost it competes with.
        closely: whether torques that do not repeat count beyond first order; stability is without them, see `grows`.
        """
        every = np.full((len(places), len(self.sides)), np.inf)
        self.asked += len(places)
        for (rows, which), line in self.groups(places):
            speed = self.speeds(line)
            found = line.swings(speed)
            if closely:
                found = exactly_where_high(found, len(rows), self.elements)
            peak = self._peaks(found, len(rows), self.peak)
            better = peak < beat[rows]
            if np.any(better):
                grown = np.where(better, growth(found, speed, line.omega, better), 0.0)
                peak = np.where(grown > 0.0, WORST * self.peak * (1.0 + grown), peak)
            every[rows, which] = peak
        cost: Array = np.max(every, axis=-1)
        for k in np.flatnonzero(cost < beat) if self.used is not None else ():
            share = self.share_used(self.drive_at(places[k]))
            if share > 1.0:
                cost[k] = WORST * self.peak * (1.0 + share)
        return cost

    def grows(self, at: Array) -> bool:
        """Tell whether disturbances of a place (v,) grow by torques that do not repeat, within its tolerances."""
        for (rows, _which), line in self.groups(at[None]) if self.nonsynchronous else ():
            speed = self.speeds(line)
            for k in range(len(rows)):
                own = Lines(drives=line.drives[k : k + 1], trains=line.trains[k : k + 1], speed=line.speed)
                found = exactly_where_high(own.swings(speed[k : k + 1]), 1, self.elements)
                if np.any(with_loose(found, line.omega[k], speed[k])[1] > GROWS):
                    return True
        return False

    def share_used(self, drive: Drive | None) -> float:
        """Return the largest share of a limit that a drive uses at the corners of its tolerances."""
        if self.used is None or drive is None:
            return 0.0
        made = [drive_off(drive, self.off, sides) for sides in self.sides]
        return max(np.inf if one is None else self.used(one) for one in made)

    def swings(self, places: Array, speed: Array) -> Array:
        """Return the swings of designs at the same speeds, array (D, S, E·V) [N·m], V times at their tolerances."""
        shape = len(places), len(self.sides), len(speed), len(self.elements)
        whole = np.full(shape, LOST * self.peak)
        for (rows, which), line in self.groups(places):
            found = line.swings(np.broadcast_to(speed, (len(rows), len(speed))))
            found = exactly_where_high(found, len(rows), self.elements)
            swing = found.swing[:, self.elements].reshape(len(rows), len(speed), -1)
            whole[rows, which] = np.where(np.isfinite(swing), swing, LOST * self.peak)
        return np.moveaxis(whole, 1, -1).reshape(len(places), len(speed), -1)
