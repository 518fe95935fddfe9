"""How does a drive turn, and how far does it slide, while it moves?"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from cardan.answers.quantity import Quantity, Text, say
from cardan.drive.drive import Drive
from cardan.drive.fields.ranges import range_problems
from cardan.drive.fields.validity import movement_problems
from cardan.drive.models.geometry import Geometry, geometry
from cardan.drive.movement import Movement
from cardan.errors import InputError, JointAngleLimitError, Problem, check, refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.curves.extremes import highest
from cardan.maths.curves.paths import Path
from cardan.maths.ties import foremost_on
from cardan.texts import _

from .instants import Instants, Position, Question
from .kinds import kind_name
from .length import LengthCompensation, length_compensation, plunge_of, slip_ends, slipping
from .moving_points import default_times, moving_path, shortest_period, start_time
from .random_motion import RandomMotion, random_motion

SPARSE = 0.25
"""Instants further apart than this share of the shortest period are warned of."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Worst:
    """The worst instant in one respect."""

    # ``joint_angle`` [rad], ``speed_fluctuation``, ``moving_speed_fluctuation``, ``speed_error``, ``acceleration``
    # [rad/s²], ``length_max`` [m], ``length_min`` [m]
    what: str
    number: int  # number of the joint (``joint_angle``) or shaft
    time: float  # [s]: when
    value: float  # how much, in SI


@dataclass(frozen=True, eq=False, kw_only=True)
class Articulation:
    """Motion of a drive over the instants of a movement; nan where `status` is ``Position.IMPOSSIBLE``.

    Attributes
    ----------
    times : array (t,) [s]
        Instants.
    points : array (t, n+2, 3) [m]
        B_0 … B_{n+1}.
    joint_angle : array (t, n) [rad]
        α_i.
    plane_twist : array (t, n-1) [rad]
        β_i, continuous where the planes turn; it jumps by π where a joint angle passes through zero.
    length, length_rate, length_acceleration : arrays (t, n+1) [m, m/s, m/s²]
        L_i of every shaft and its time derivatives. On the end shafts only the direction of the axis counts.
    shaft_speed_fluctuation : array (t, n)
        δ of shafts 2 … n+1 if the drive stood still at that instant.
    speed, acceleration : float [rad/s, rad/s²]
        ω_1 at the first instant of the movement and ε_1; speed is None when the drive does not say.
    shaft_speed, shaft_acceleration : arrays (t, n+1) [rad/s, rad/s²] or None
        Exact ω_i and ε_i at these very instants. The shafts turn many times while the centres hardly move, so
        neighbouring instants catch unrelated yoke positions: plot `speed_low` and `speed_high` instead.
    speed_low, speed_high : arrays (t, n+1) [rad/s] or None
        Exact extremes of ω_i over all yoke positions at each instant.
    acceleration_low, acceleration_high : arrays (t, n+1) [rad/s²] or None
        The same of ε_i.
    moving_speed_fluctuation : array (t,)
        (ω_max - ω_min)/\\|ω_1\\| of the output over all yoke positions at each instant, the movement counted; nan
        without a speed.
    speed_error : array (t,)
        Largest \\|ω_out/ω_1 - 1\\| over all yoke positions at each instant, the movement counted; nan without a speed.
    status : array of int (t,)
        `Position` of every instant.
    splines : tuple of LengthCompensation
        One for each intermediate shaft that slides or has a spline.
    worst : tuple of Worst
        The worst instants; between the instants when the drive chose them itself.
    warnings : tuple of Text
        What the user should know.
    assumed : tuple of str
        Paths of what the drive does not say and this answer assumes.
    random : RandomMotion or None
        Mean, deviation, spectrum and rare levels under its random movements, of which all else is one sample path.
    """

    times: Array
    points: Array
    joint_angle: Array
    plane_twist: Array
    length: Array
    length_rate: Array
    length_acceleration: Array
    shaft_speed_fluctuation: Array
    speed: float | None
    acceleration: float
    shaft_speed: Array | None
    shaft_acceleration: Array | None
    speed_low: Array | None
    speed_high: Array | None
    acceleration_low: Array | None
    acceleration_high: Array | None
    moving_speed_fluctuation: Array
    speed_error: Array
    status: Array
    splines: tuple[LengthCompensation, ...]
    worst: tuple[Worst, ...]
    warnings: tuple[Text, ...]
    assumed: tuple[str, ...] = ()
    random: RandomMotion | None = None

    @property
    def speed_fluctuation(self) -> Array:
        """δ of the output if the drive stood still at each instant, array (t,)."""
        return self.shaft_speed_fluctuation[..., -1]

    @property
    def envelope(self) -> dict[str, tuple[Array, Array]]:
        """Least and greatest over the instants: joint_angle (n,), plane_twist (n-1,), length (n+1,), δ ()."""
        tables = {name: getattr(self, name) for name in ("joint_angle", "plane_twist", "length", "speed_fluctuation")}
        good = self.status < Position.IMPOSSIBLE
        return {
            name: (np.min(table[good], axis=0, initial=np.inf), np.max(table[good], axis=0, initial=-np.inf))
            for name, table in tables.items()
        }


def articulation(
    drive: Drive,
    movement: Movement | Sequence[Movement] | Path | None = None,
    times: ArrayLike | None = None,
    *,
    until: float | None = None,
    speed: float | None = None,
) -> Articulation:
    """Return how a drive turns and slides while its joint centres move, exactly.

    Parameters
    ----------
    drive : Drive
        One drive.
    movement : Movement, sequence of Movement or function, optional
        What moves, applied one after the other; all movements of the drive by default. Or a function of the times (t,)
        that returns positions, velocities and accelerations (t, n+2, 3) of the points.
    times : array (t,) [s], optional
        Instants. By default the common period of the swings, the span of the tables, or the duration of the random
        movements, in steps fine enough to follow them.
    until : float, optional [s]
        End of the time span from zero, in such steps too; instead of ``times``.
    speed : float [rad/s], optional
        Spin of the input shaft; that of the drive's duty by default.

    Returns
    -------
    Articulation

    Raises
    ------
    InputError
        No movement, one that does not fit the drive, or instants outside a table.
    JointAngleLimitError
        A joint angle is 90 degrees or more at every instant.

    See Also
    --------
    motion, moving_forces

    Notes
    -----
    Steep and impossible instants do not stop the series, they carry a status. `speed_fluctuation` freezes each instant;
    `shaft_speed`, `shaft_acceleration` and the ranges count how the centres move, see `moving_centres`. The start
    phase counts at time zero (the first time of tables that do not hold zero).

    On the end shafts the point of the axis only gives a direction: their length says nothing about sliding.

    Examples
    --------
    A hitch half way between the joints keeps the drive synchronous at any angle.

    >>> from cardan import Drive, articulation
    >>> from cardan.parts import Hitch
    >>> from cardan.units import deg
    >>> drive = Drive.from_points([[-1, 0, 0], [-0.4, 0, 0], [0.4, 0, 0], [1, 0, 0]])
    >>> turn = Hitch(moves=("joints[1]", "output"), pivot=(0, 0, 0), yaw=40 * deg, frequency=1.0)
    >>> found = articulation(drive, turn)
    >>> round(float(found.joint_angle.max() / deg), 6), bool(found.speed_fluctuation.max() < 1e-14)
    (20.0, True)
    """
    path, at, start, chosen, moves = _plan(drive, movement, times, until)
    place = geometry(drive)
    omega = drive.duty.speed if speed is None else speed
    ask = Question(drive, place, path, omega, drive.duty.acceleration, start)
    found = ask.answer(at)
    if np.all(found.status == Position.IMPOSSIBLE):
        raise JointAngleLimitError(
            [Problem("movements", _("at every instant a joint angle is 90° or more; a universal joint needs less"))]
        )
    splines = _splines(drive, place, found)
    random, unknown = _random(drive, moves)
    return Articulation(
        times=at,
        points=found.points,
        joint_angle=found.joint_angle,
        plane_twist=found.plane_twist,
        length=found.shafts.length,
        length_rate=found.shafts.length_rate,
        length_acceleration=found.shafts.length_acceleration,
        shaft_speed_fluctuation=found.shaft_speed_fluctuation,
        speed=omega,
        acceleration=drive.duty.acceleration,
        shaft_speed=found.shaft_speed,
        shaft_acceleration=found.shaft_acceleration,
        speed_low=None if found.speed_range is None else found.speed_range[0],
        speed_high=None if found.speed_range is None else found.speed_range[1],
        acceleration_low=None if found.acceleration_range is None else found.acceleration_range[0],
        acceleration_high=None if found.acceleration_range is None else found.acceleration_range[1],
        moving_speed_fluctuation=found.unevenness,
        speed_error=found.speed_error,
        status=found.status,
        splines=splines,
        worst=tuple(_worst(ask, found, splines, refine=chosen)),
        warnings=(*_sparse(moves, at), *_warnings(drive, place, found, splines), *unknown),
        assumed=place.assumed,
        random=random,
    )


def _random(drive: Drive, moves: Sequence[Movement]) -> tuple[RandomMotion | None, tuple[str, ...]]:
    """Return what random movements make of the drive, or why that is not told."""
    try:
        return random_motion(drive, moves), ()
    except InputError as error:
        return None, tuple(one.message for one in error.problems)


def _plan(
    drive: Drive, movement: Movement | Sequence[Movement] | Path | None, times: ArrayLike | None, until: float | None
) -> tuple[Path, Array, float, bool, tuple[Movement, ...]]:
    """Return the path of the points, the instants, the start, whether the instants were chosen here, and what moves."""
    if until is not None and not (times is None and math.isfinite(until) and until > 0.0):
        raise refuse("until", _("must be a finite time above 0, without times beside it"))
    if callable(movement):
        if times is None:
            raise refuse("times", _("missing; a movement given as a function does not say how long it lasts"))
        return movement, _instants(times), 0.0, False, ()
    moves = drive.movements if movement is None else (movement,) if isinstance(movement, Movement) else tuple(movement)
    if not moves:
        raise refuse("movements", _("nothing moves: add a [[movements]] table to the drive file"))
    if movement is not None:
        check(_foreign_problems(moves, len(drive.joints)))
    at = default_times(moves, until) if times is None else _instants(times)
    return moving_path(geometry(drive).points, moves), at, start_time(moves), times is None, moves


def _foreign_problems(moves: Sequence[Movement], joints: int) -> Iterator[Problem]:
    """Yield what is wrong with movements that came beside the drive and so were never checked with it."""
    for k, movement in enumerate(moves):
        yield from range_problems(movement, f"movements[{k}]")
    yield from movement_problems(moves, joints)


def _instants(times: ArrayLike) -> Array:
    at = np.atleast_1d(np.asarray(times, dtype=float))
    if at.ndim != 1 or at.size == 0 or not np.all(np.isfinite(at)) or np.any(np.diff(at) <= 0.0):
        raise refuse("times", _("the instants must be finite numbers, at least one, rising from one to the next"))
    return at


def _splines(drive: Drive, place: Geometry, found: Instants) -> tuple[LengthCompensation, ...]:
    """Judge every shaft that slides or has a spline, over the instants at which its ends lie apart."""
    ends, splines = slip_ends(drive), []
    shafts = slipping(found.shafts, place.length, ends)
    for k in sorted({*range(1, len(drive.joints)), *ends}):
        good = np.isfinite(shafts.length_acceleration[:, k])
        if not np.any(good):
            continue
        one = length_compensation(
            found.times[good],
            shafts.length[good, k],
            shafts.length_rate[good, k],
            shafts.length_acceleration[good, k],
            spline=drive.shafts[k].spline,
            limits=drive.limits,
            drawn=float(place.length[k]),
            shaft=k + 1,
            plunge=plunge_of(drive, k),
        )
        if one.slides or drive.shafts[k].spline:
            splines.append(one)
    return tuple(splines)


def _sparse(moves: Sequence[Movement], times: Array) -> Iterator[Text]:
    """Warn of instants that lie too far apart to see what the movement does between them."""
    period, step = shortest_period(moves), float(np.max(np.diff(times), initial=0.0))
    if step > SPARSE * period:
        yield say(
            _(
                "the instants lie up to {step} apart, the shortest period is {period}: extremes between them are "
                "missed, and the splines' travel is not to be trusted"
            ),
            step=Quantity(step, "time", trim=True),
            period=Quantity(period, "time", trim=True),
        )


def _warnings(drive: Drive, place: Geometry, found: Instants, splines: Sequence[LengthCompensation]) -> Iterator[Text]:
    impossible = int(np.sum(found.status == Position.IMPOSSIBLE))
    if impossible:
        first = float(found.times[int(np.argmax(found.status == Position.IMPOSSIBLE))])
        yield say(
            _("at {count} of {all} instants, first at {time}, a joint angle is 90° or more: nothing turns"),
            count=impossible,
            all=found.times.size,
            time=Quantity(first, "time", trim=True),
        )
    for i in range(found.joint_angle.shape[1]):
        column = found.joint_angle[:, i]
        joint = drive.joints[i]
        beyond = np.nonzero(column > joint.steepest)[0]
        if beyond.size:
            k = beyond[int(foremost_on(column[beyond]))]
            text = _("joint {number} has a joint angle of {angle} at {time}; no real cross joint works above {limit}")
            if not joint.single_cross:
                text = _("joint {number} has a joint angle of {angle} at {time}; no {kind} joint works above {limit}")
            yield say(
                text,
                number=i + 1,
                angle=Quantity(float(column[k]), "angle"),
                time=Quantity(float(found.times[k]), "time", trim=True),
                limit=Quantity(joint.steepest, "angle", 2, trim=True),
                kind=kind_name(joint),
            )
    for one in splines:
        if one.slides and not takes_up(drive, one.shaft):
            text = _("shaft {number} changes its length by {stroke} but has no spline")
            yield say(text, number=one.shaft, stroke=Quantity(one.stroke, "length", decimals=1))
        yield from (flag.message for flag in one.flags)
    if place.assumed:
        yield _("lengths that the drive does not say are assumed: {paths}").format(paths=", ".join(place.assumed))


def takes_up(drive: Drive, number: int) -> bool:
    """Tell whether something takes up the length of a shaft: its spline, that of an end shaft beside it, a joint."""
    ends = {1, len(drive.shafts)} & {number - 1, number + 1}
    splines = any(drive.shafts[k - 1].spline is not None for k in (number, *ends))
    return splines or any(joint.slides or joint.loose for joint in drive.joints[number - 2 : number])


def _worst(ask: Question, found: Instants, splines: Sequence[LengthCompensation], *, refine: bool) -> Iterator[Worst]:
    """Yield the worst instants, sharpened between the instants where there are finer ones to be asked for."""
    n = found.joint_angle.shape[1]
    names = [
        *(("joint_angle", i + 1) for i in range(n)),
        *((what, n + 1) for what in ("speed_fluctuation", "moving_speed_fluctuation", "speed_error", "acceleration")),
    ]
    values = _judged(found)
    if refine:
        places, most = highest(lambda times: _judged(ask.answer(times, yokes=False)), found.times, values)
    else:
        k = foremost_on(values)
        places, most = found.times[k], np.take_along_axis(values, k[:, None], axis=-1)[:, 0]
    for (what, number), time, value in zip(names, places, most, strict=True):
        if np.isfinite(value):
            yield Worst(what=what, number=number, time=float(time), value=float(value))
    for one in splines:
        if one.slides:
            yield Worst(what="length_min", number=one.shaft, time=one.time_min, value=one.length_min)
            yield Worst(what="length_max", number=one.shaft, time=one.time_max, value=one.length_max)


def _judged(some: Instants) -> Array:
    """Return what is to be least at every instant, array (n+4, t): joint angles, then what the output does."""
    output = some.shaft_speed_fluctuation[:, -1], some.unevenness, some.speed_error, some.largest_acceleration
    return np.concatenate((some.joint_angle.T, np.stack(output)))
