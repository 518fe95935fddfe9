"""How does a drive vibrate in torsion while it moves? Resonance, growth and reversals of the torque along a movement.

A movement changes the joint angles slowly against the turn: at every instant the drive vibrates as if it stood so.
That holds where the movement is slow against the beats and the decay of the modes; else the equations are integrated in
time, see `in_time`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeAlias

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.movement import Movement, Oscillation, Random, Table
from cardan.drive.yokes import with_yokes
from cardan.errors import refuse
from cardan.maths.arrays import Array
from cardan.maths.curves.extremes import highest
from cardan.maths.curves.normal_coordinates import Chance, chance, grid_of
from cardan.maths.curves.paths import interpolated, rate_variance, variance
from cardan.maths.kernel import frames
from cardan.questions.motion.moving_points import default_times, moving_points, random_shifts
from cardan.questions.motion.random_motion import SURE
from cardan.questions.torsion.model.torsion import TorsionModes, torsion_modes
from cardan.questions.torsion.model.torsional_model import TorsionalModel
from cardan.questions.torsion.model.torsional_modes import joint_orders
from cardan.questions.torsion.model.torsional_train import TorsionalTrain
from cardan.questions.torsion.steady.several import stable_motions, widened
from cardan.questions.torsion.steady.steady import steady_orbits
from cardan.questions.torsion.steady.steady_result import read_off
from cardan.questions.torsion.steady.torsion_response import loaded_model, parted
from cardan.texts import _

from .in_time import SETTLED, follow, hindered
from .places import Places, Standing

Progress: TypeAlias = Callable[[float], object]
"""Told the share done; may answer "stop"."""

MULTIPLE = 2.0
"""Times the largest mean torque from which the torque is that of a resonance."""

NEAR, STRONG = 0.2, 0.2
"""Share of its speed within which a crossing is near, and amplitude of its order over the largest mean torque from
which it counts."""

SLOW = 0.1
"""Rate of the movement over that at which a mode comes to rest up to which every instant counts as standing."""

STEEP = math.radians(35.0)
"""Joint angle from which order 4 of the joints counts beside order 2."""

MOST = 4001
"""Instants looked at, at most."""

FEWER = 4
"""By how much fewer places than others the torques of several random movements are asked at."""

OPENED = 8
"""Instants or places at which motions with open backlash are looked for."""

EXTINCT = 1e3
"""Rate at which vibration dies out, over the speed, beyond which it does not matter how fast."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Lag:
    """How far the mode that follows worst stays behind a movement."""

    mode: int  # from 1
    rate: float  # [rad/s]: of the movement
    rest: float  # [rad/s]: at which the mode comes to rest, |δ + i(νΩ - ω)|: by its decay and its beats with the joints
    decay: float  # [1/s]: δ

    @property
    def share(self) -> float:
        """Error of taking every instant as if the drive stood, about."""
        return self.rate / self.rest if self.rest else math.inf


@dataclass(frozen=True, kw_only=True)
class ShaftDamage:
    """What the torques of a movement cost a shaft."""

    shaft: int  # its number
    rate: float  # [1/s]: share of its fatigue life a second; 0 where no cycle damages


@dataclass(frozen=True, eq=False, kw_only=True)
class Opened:
    """Torques with the play that backlash opens, at some of the instants or places at which it does."""

    row: Array  # (k,) of int: which of the places, those of the largest torques among them
    low: Array  # low, high (k, E) [N·m]: least and largest torque of every element; nan where no motion was found
    high: Array

    @property
    def largest(self) -> Array:
        """Largest torque of either sign of every element, array (k, E) [N·m]."""
        return np.asarray(np.maximum(np.abs(self.low), np.abs(self.high)))


@dataclass(frozen=True, eq=False, kw_only=True)
class RoadTorsion:
    """Torsional vibration of a drive along a movement, or over all that random movements bring."""

    train: TorsionalTrain  # the model
    speed: float  # [rad/s]: of the input
    drawn: Array  # (n-1,) [m]: lengths of the shafts between joints as drawn
    standing: Places  # as if the drive stood at every instant, or at places of the distribution of random movements
    lag: Lag  # by how much that may be wrong
    order: Array  # (K,): orders of the shaft
    # orders that meet a mode within `NEAR` of the speed: the order, the mode, the speed at which they meet [rad/s]
    meets: tuple[tuple[float, int, float], ...]
    span: float  # [s]: time that is followed, or the longest that the random movements say
    # largest torque [N·m], its element, its instant [s]; of a distribution, which has no instants, the torque that is
    # reached once in the span on average
    peak: tuple[float, int, float]
    moving: Places | None = None  # the same by integration in time; None where that was not needed, or not possible
    why: str = ""  # why nothing was integrated although the movement is too quick
    # over the distribution the least torque of every element, then the largest, then the amplitudes of its orders
    chance: Chance | None = None
    periodic: bool = False  # whether the movement repeats with the span
    opened: Opened | None = None  # with open backlash; None where it stays closed, and in time
    damage: tuple[ShaftDamage, ...] = ()  # what it costs the shafts whose strength is told

    @property
    def places(self) -> Places:
        """What holds: the motion in time where it was needed, else every instant as if the drive stood."""
        return self.standing if self.moving is None else self.moving

    @property
    def likely(self) -> Array:
        """Where a motion is known, of a distribution as far out as comes once in the span, array of bool (t,)."""
        if self.chance is None:
            return self.places.found
        rounds = max(self.lag.rate * self.span / (2.0 * math.pi), math.e)
        radius = np.tile(self.chance.grid.radius, len(self.chance.grid.ray))
        return self.places.found & np.asarray(radius <= math.sqrt(2.0 * math.log(rounds)))

    @property
    def extremes(self) -> tuple[Array, Array]:
        """Least and largest torque of every element, arrays (E,) [N·m]; see `peak` of what a distribution has."""
        if self.chance is not None:
            count, risk = len(self.train.elements), self.chance
            least = [_level(risk, e, self.span, least=True) for e in range(count)]
            return np.asarray(least), np.asarray([_level(risk, count + e, self.span) for e in range(count)])
        known = self.places.found
        return np.min(self.places.low[known], axis=0), np.max(self.places.high[known], axis=0)

    @property
    def stretched(self) -> tuple[float, int]:
        """Largest change of the length of a shaft between joints, as a share of it, and the shaft from 1; 0 if none."""
        lengths = np.linalg.norm(np.diff(self.standing.points, axis=1), axis=-1)[:, 1:-1]
        if not lengths.size:
            return 0.0, 0
        share = np.max(np.abs(lengths / self.drawn - 1.0), axis=0)
        k = int(np.argmax(share))
        return float(share[k]), k + 2

    @property
    def nominal(self) -> float:
        """Largest mean torque of an element [N·m]."""
        return float(np.max(np.abs(self.standing.averaged(self.standing.mean))))

    @property
    def above(self) -> Array:
        """Share of the time in which the torque of each element is above `MULTIPLE` of `nominal`, array (E,)."""
        return np.asarray([self.places.part(row > MULTIPLE * self.nominal) for row in self.places.largest.T])

    @property
    def resonance(self) -> float:
        """Share of the time in resonance: `above` in any element, or a strong order near a mode; nan without torque."""
        if not self.nominal > 0.0:
            return math.nan
        near, over = self._near, np.any(self.places.largest > MULTIPLE * self.nominal, axis=-1)
        if self.moving is not None:
            assert self.moving.times is not None
            assert self.standing.times is not None
            near = np.interp(self.moving.times, self.standing.times, near.astype(float)) > 0.5
        return self.places.part(over | near)

    @property
    def _near(self) -> Array:
        """Where an order that meets a mode is strong, array of bool (t,)."""
        met = [k for k, order in enumerate(self.order) if any(abs(order - one) < 1e-9 for one, _m, _s in self.meets)]
        assert self.standing.amplitude is not None
        strong = np.max(self.standing.amplitude[:, self.line][..., met], axis=(1, 2), initial=0.0)
        return np.asarray(strong >= STRONG * self.nominal) & bool(met)

    @property
    def line(self) -> list[int]:
        """Elements of the line itself, without those that absorbers and pendulums hang on."""
        return [e for e, (_a, b) in enumerate(self.train.model.elements) if self.train.hangs[b] is None]

    @property
    def unstable(self) -> float:
        """Share of the time in which vibration grows by itself where the drive stands."""
        assert self.standing.growth is not None
        return self.standing.part(self.standing.growth > 0.0)

    @property
    def mean_growth(self) -> float:
        """Mean rate at which vibration grows over the movement [1/s]; negative where it dies out in the end."""
        assert self.standing.growth is not None
        return float(self.standing.averaged(np.maximum(self.standing.growth, -EXTINCT * abs(self.speed))))

    @property
    def grown(self) -> float:
        """By what factor vibration grows at most in a stretch of the movement, its logarithm; nan without instants."""
        times, growth = self.standing.times, self.standing.growth
        if times is None or growth is None:
            return math.nan
        steps = 0.5 * np.nan_to_num(growth[1:] + growth[:-1]) * np.diff(times)
        most = now = 0.0
        for step in (*steps, *(steps if self.periodic else ())):
            now = max(0.0, now + float(step))
            most = max(most, now)
        return most

    @property
    def reversals(self) -> Array:
        """How often the torque of every element changes its sign, over the whole time, array (E,) [1/s]."""
        return self.places.averaged(self.places.reversals)

    @property
    def entries(self) -> Array:
        """How often the torque of every element begins to change its sign, array (E,) [1/s].

        Of random movements how often its least torque falls through 0, by Rice's formula; else counted.
        """
        if self.chance is not None:
            return np.asarray([self.chance.rate(e, [0.0])[0] for e in range(len(self.train.elements))])
        changing = (self.places.low < 0.0) & (self.places.high > 0.0)
        begins = changing & ~np.roll(changing, 1, axis=0)
        begins[0] &= self.periodic
        return np.asarray(np.sum(begins, axis=0) / self.span)

    @cached_property
    def envelope(self) -> Array:
        """Largest amplitude of every order in every element, array (E, K) [N·m]; see `peak` of a distribution."""
        amplitude = self.standing.amplitude
        assert amplitude is not None
        if self.chance is None:
            return np.asarray(np.max(amplitude[self.standing.found], axis=0, initial=0.0))
        shape = amplitude.shape[1:]
        levels = [_level(self.chance, 2 * shape[0] + k, self.span) for k in range(math.prod(shape))]
        return np.asarray(levels).reshape(shape)


def road_torsion(drive: Drive, *, progress: Progress | None = None) -> RoadTorsion:
    """Return how a drive vibrates in torsion along its movements.

    drive: with movements, a speed, and what `torsion_response` needs.
    progress: told the share done; when it answers "stop", an integration in time ends with what is done.
    Raises InputError: what the model misses; no movement; a joint that bends 90° or more.

    Masses, stiffness and damping are as drawn; angles and phases of the joints are those of every instant. Backlash
    counts as closed, and with its play at `OPENED` of the instants at which a torque falls through 0. Random movements
    alone are taken by their distribution: means over rays of normal coordinates, and the rate at which a level is
    crossed by S. O. Rice, Bell System Technical Journal 24 (1945). Otherwise the movement is followed, random ones
    along their sample path.

    >>> from cardan.drive.movement import Harmonic
    >>> from cardan.parts import Duty, Shaft, Station
    >>> swing = Harmonic(moves=("output",), amplitude=(0, 0, 0.2), frequency=1.0)
    >>> drive = replace(Drive.from_points([(-0.3, 0, 0), (0, 0, 0), (1, 0, 0.1)]), movements=(swing,),
    ...     shafts=(Shaft(number=2, stiffness=4000.0, damping=4.0),), stations=(Station(shaft=2, inertia=0.4),),
    ...     duty=Duty(speed=200.0, torque=100.0))
    >>> found = road_torsion(drive)
    >>> print(f"{found.peak[0]:.1f} {found.unstable:.1f}")
    199.1 0.0
    """
    if not drive.movements:
        raise refuse("movements", _("missing; torsion along a movement needs one"), "missing")
    train, whole, standing = _stood(drive)
    if all(train.hangs[b] is not None for _a, b in train.model.elements):
        text = _("missing; every shaft counts as rigid, so nothing vibrates: give a body of known length, or stiffness")
        raise refuse("shafts[0].stiffness", text)
    speed, modes = standing.speed, torsion_modes(replace(standing.drive, movements=()))
    random = [one for one in drive.movements if isinstance(one, Random)]
    if len(random) == len(drive.movements):
        places, risk = _at_random(standing, random, progress)
        times = np.zeros(0)
        span, periodic = max(one.duration for one in random), False
    else:
        times, risk = default_times(drive.movements), None
        times = times[:: -(-times.size // MOST)]
        places = standing.at(moving_points(standing.base, drive.movements, times)[0], progress)
        places = replace(places, times=times, share=_shares(times))
        span, periodic = float(times[-1] - times[0]), all(isinstance(one, Oscillation) for one in drive.movements)
    orders = {2.0, 4.0} if np.nanmax(places.joint_angle) > STEEP else {2.0}
    orders |= {order for order in joint_orders(modes.train.model) if order <= max(orders)}
    lag = _lag(modes, speed, max(map(_rate, drive.movements)), orders)
    found = RoadTorsion(
        train=train,
        speed=speed,
        drawn=np.linalg.norm(np.diff(standing.base, axis=0), axis=-1)[1:-1],
        standing=places,
        lag=lag,
        order=standing.order,
        meets=tuple(_meets(modes, speed)),
        span=span,
        peak=(math.nan, 0, math.nan),
        chance=risk,
        periodic=periodic,
    )
    if not lag.share <= SLOW:
        before = SETTLED / lag.decay if lag.decay else 0.0
        if not times.size:
            times = default_times(drive.movements)
        why = hindered(standing, modes.omega, float(times[-1] - times[0]), before)
        if why:
            found = replace(found, why=why)
        else:
            moving = follow(standing, times, before, progress=progress)
            found = replace(found, moving=moving, chance=None, span=float(times[-1] - times[0]))
    found = replace(found, peak=_peak(found, standing))
    return found if found.moving is not None else _with_play(found, standing, parted(whole)[0])


def _stood(drive: Drive) -> tuple[TorsionalTrain, TorsionalModel, Standing]:
    """Return the torsional model of a drive as drawn, with its play, and what tells its torques elsewhere, closed."""
    drive = with_yokes(drive, at_joint=True)
    still = replace(drive, movements=())
    speed = np.asarray(drive.duty.speed or 0.0)
    train, whole = loaded_model(still, drive.duty, speed)
    model, loose = parted(replace(whole, backlash=np.zeros_like(whole.backlash)))
    return train, whole, Standing(drive, model, loose, float(speed))


def standing_torques(drive: Drive, times: Array) -> Array:
    """Return the largest and the negative least torques of the elements at instants (t,) of a movement, (2E, t) [N·m].

    Backlash counts as closed; nan where no motion is found. Raises InputError: what the torsional model misses.
    """
    _train, _whole, standing = _stood(drive)
    low, high = standing.torques(moving_points(standing.base, drive.movements, times)[0])
    return np.concatenate([high, -low], axis=-1).T


def _with_play(found: RoadTorsion, standing: Standing, loose: TorsionalModel) -> RoadTorsion:
    """Return the same with what play makes of it where the torque of an element with backlash falls through 0.

    loose: the model with its backlash. The largest torque counts with the play where that makes it larger.
    """
    places, line = found.standing, found.line
    own = [e for e in line if np.any(loose.backlash[..., e] > 0.0)]
    opens = np.any((places.low[:, own] < 0.0) & (places.high[:, own] > 0.0), axis=-1) & found.likely
    rows = np.flatnonzero(opens)
    if not rows.size:
        return found
    rows = rows[np.argsort(-np.max(places.largest[rows][:, line], axis=-1), kind="stable")]
    rows = rows[np.unique(np.linspace(0, len(rows) - 1, OPENED).round().astype(int))]
    turns, _possible = standing.turned(places.points[rows])
    speeds = np.full(len(rows), found.speed)
    motions = steady_orbits(replace(loose, **turns), speed=speeds)
    orbit, _status, beside = stable_motions(*motions)
    torque = read_off(orbit, 1)
    low, high = widened(torque.lowest, torque.highest, beside)
    opened = Opened(row=rows, low=low, high=high)
    largest = np.nan_to_num(opened.largest[:, line])
    k, e = (int(one) for one in np.unravel_index(int(np.argmax(largest)), largest.shape))
    if largest[k, e] > found.peak[0]:
        time = math.nan if places.times is None else float(places.times[rows[k]])
        found = replace(found, peak=(float(largest[k, e]), line[e], time))
    return replace(found, opened=opened)


def _shares(times: Array) -> Array:
    """Return the share of the time of every instant (t,), by trapezia."""
    step = np.diff(times)
    own = 0.5 * (np.append(step, 0.0) + np.append(0.0, step))
    return np.asarray(own / np.sum(own))


def _at_random(standing: Standing, random: Sequence[Random], progress: Progress | None) -> tuple[Places, Chance]:
    """Return the vibration over the distribution of random movements, and the torques as functions of it."""
    grid = grid_of(len(random), fewer=FEWER if len(random) > 1 else 1)
    shifts = random_shifts(len(standing.drive.joints), random)
    every: list[Places] = []
    calls = 1 if len(random) == 1 else 1 + 2 * len(random)  # beside the places themselves a step to either side
    done = 0

    def told(share: float) -> object:
        return None if progress is None else progress((done + share) / calls)

    def torques(places: Array) -> Array:
        points = standing.base + np.tensordot(places, shifts, axes=1)
        inside = frames.norm(places) <= SURE
        if not np.all(standing.turned(points)[1] | ~inside):
            text = _("a joint bends 90° or more within {count} standard deviations of the random movements")
            raise refuse("movements", text.format(count=f"{SURE:.0f}"))
        nonlocal done
        found = standing.outward(points, len(grid.ray), told)
        done += 1
        every.append(found)
        # where nothing runs steadily, as far out as hardly ever, the torque of the nearest ray inside stands in
        assert found.amplitude is not None
        own = found.amplitude.reshape(len(found.low), -1)
        rows = np.concatenate([found.low, found.high, own], axis=-1).T
        if len(places) != len(grid.places):
            return np.nan_to_num(rows)
        wide = rows.reshape(len(rows), *grid.weight.shape)
        at = np.maximum.accumulate(np.where(np.isfinite(wide), np.arange(wide.shape[-1]), 0), axis=-1)
        return np.asarray(np.nan_to_num(np.take_along_axis(wide, at, axis=-1)).reshape(rows.shape))

    rates = [_rate(one) for one in random]
    risk = chance(torques, rates, grid)
    return replace(every[0], share=grid.weight.ravel()), risk


def _rate(movement: Movement) -> float:
    """Return how quick a movement is [rad/s]: deviation of its rate over that of itself."""
    if isinstance(movement, Random):
        spectrum = movement.spectrum
        own = spectrum.frequency, spectrum.density
        return math.sqrt(rate_variance(*own) / variance(*own))
    if isinstance(movement, Table):
        at = np.linspace(movement.times[0], movement.times[-1], 8 * len(movement.times) + 1)
        shift, rate, _acceleration = interpolated(movement.times, movement.shifts, at)
        spread = float(np.sum(np.var(shift, axis=0)))
        return math.sqrt(float(np.sum(np.mean(rate**2, axis=0))) / spread) if spread else 0.0
    return float(movement.frequency) if isinstance(movement, Oscillation) else 0.0


def _lag(modes: TorsionModes, speed: float, rate: float, orders: Iterable[float]) -> Lag:
    """Return the mode that stays behind most; orders: of the joints."""
    decay = modes.damping_ratio * modes.omega
    apart = np.min([np.abs(order * abs(speed) - modes.omega) for order in orders], axis=0)
    rest = np.hypot(decay, apart)
    k = int(np.argmin(rest))
    return Lag(mode=k + 1, rate=rate, rest=float(rest[k]), decay=float(decay[k]))


def _meets(modes: TorsionModes, speed: float) -> list[tuple[float, int, float]]:
    near = [one for one in modes.crossings if abs(abs(speed) / one.speed - 1.0) < NEAR]
    return [(one.order, one.mode, one.speed) for one in near]


def _peak(found: RoadTorsion, standing: Standing) -> tuple[float, int, float]:
    """Return the largest torque of the line, its element and its instant; see `RoadTorsion`."""
    line, places = found.line, found.places
    if found.chance is not None:
        ends = np.maximum(*np.abs(found.extremes))[line]
        k = int(np.argmax(ends))
        return float(ends[k]), line[k], math.nan
    known = places.found
    if not known.any():
        return math.nan, line[0], math.nan
    assert places.times is not None
    largest = np.where(known[:, None], places.largest[:, line], -np.inf)
    t, k = (int(one) for one in np.unravel_index(int(np.argmax(largest)), largest.shape))
    if found.moving is not None:
        return float(largest[t, k]), line[k], float(places.times[t])
    e, movements = line[k], standing.drive.movements

    def course(times: Array) -> Array:
        return standing.at(moving_points(standing.base, movements, times)[0]).largest[None, :, e]

    place, value = highest(course, places.times, places.largest[None, :, e], rounds=2)
    return float(value[0]), e, float(place[0])


def _level(risk: Chance, function: int, span: float, *, least: bool = False) -> float:
    """Return the level that a torque passes once in a span on average; its bound where it comes there often."""
    found = risk.level(function, 1.0 / span, least=least)
    ends = risk.value[function]
    return found if math.isfinite(found) else float(np.min(ends) if least else np.max(ends))
