"""Where are the points of a drive while it moves? One function a kind of movement, and its name in `CARRY`."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from cardan.drive import movement as kinds
from cardan.drive.movement import Movement
from cardan.errors import Problem, check, refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.curves import paths
from cardan.maths.curves.paths import Jet, Path
from cardan.texts import _

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)

STEPS = 120
"""Instants in the shortest period of a movement, when no times are given."""

FEWEST, MOST = 361, 20_001
"""Bounds of the number of instants, when no times are given; more than `MOST` only where `LEAST` asks for it."""

LEAST = 6
"""Instants that the shortest period needs; with fewer the extremes between them are lost."""

LIMIT = 200_001
"""More instants than this are refused."""

SPAN = 20
"""Periods of the slowest movement that are followed when several have no common period."""


def moving_points(points: ArrayLike, movements: Sequence[Movement], times: ArrayLike) -> Jet:
    """Return positions, velocities and accelerations of the points of a drive, exactly.

    points (n+2, 3) [m]: B_0 … B_{n+1} as drawn: "input", "joints[0]" …, "output".
    movements: applied one after the other, each to where the ones before left the points; times (t,) [s].
    Returns (t, n+2, 3) [m, m/s, m/s²].
    Raises InputError: an instant outside the span of a table.
    """
    at = np.atleast_1d(np.asarray(times, dtype=float))
    rest = np.asarray(points, dtype=float)
    still = np.broadcast_to(rest, (at.size, *rest.shape))
    jet: Jet = (still.copy(), np.zeros(still.shape), np.zeros(still.shape))
    names = point_names(len(rest) - 2)
    for movement in movements:
        chosen = list(dict.fromkeys(names.index(name) for name in movement.moves))
        moved = CARRY[movement.kind](movement, tuple(part[:, chosen] for part in jet), at)
        for part, new in zip(jet, moved, strict=True):
            part[:, chosen] = new
    return jet


def point_names(joints: int) -> list[str]:
    """Return the names of the points that can move.

    >>> point_names(2)
    ['input', 'joints[0]', 'joints[1]', 'output']
    """
    return ["input", *(f"joints[{i}]" for i in range(joints)), "output"]


def moving_path(points: ArrayLike, movements: Sequence[Movement]) -> Path:
    """Return the function of time that gives the moving points of a drive, see `moving_points`."""

    def path(times: Array) -> Jet:
        return moving_points(points, movements, times)

    return path


def _hitch(movement: kinds.Hitch, points: Jet, times: Array) -> Jet:
    yaw = _swing(movement, movement.yaw, times)
    pitch = _swing(movement, movement.pitch, times, movement.pitch_phase)
    return paths.carried(paths.chained(paths.turning(Z, yaw), paths.turning(Y, pitch)), movement.pivot, points)


def _arm(movement: kinds.Arm, points: Jet, times: Array) -> Jet:
    angle = _swing(movement, movement.amplitude, times)
    return paths.carried(paths.turning(movement.axis, angle), movement.pivot, points)


def _parallel(movement: kinds.Parallel, points: Jet, times: Array) -> Jet:
    angle = _swing(movement, movement.amplitude, times)
    guided: Jet = tuple(part[:, :1] for part in points)
    swung = paths.carried(paths.turning(movement.axis, angle), movement.pivot, guided)
    return tuple(part + (new - old) for part, new, old in zip(points, swung, guided, strict=True))


def _harmonic(movement: kinds.Harmonic, points: Jet, times: Array) -> Jet:
    return _shifted(points, paths.swing(movement.amplitude, movement.frequency, movement.phase, times))


def _body(movement: kinds.Body, points: Jet, times: Array) -> Jet:
    roll = paths.turning(X, _swing(movement, movement.roll, times, movement.roll_phase))
    pitch = paths.turning(Y, _swing(movement, movement.pitch, times, movement.pitch_phase))
    yaw = paths.turning(Z, _swing(movement, movement.yaw, times, movement.yaw_phase))
    rotation = paths.chained(yaw, paths.chained(pitch, roll))
    shift = paths.swing(movement.amplitude, movement.frequency, movement.phase, times)
    return _shifted(paths.carried(rotation, movement.pivot, points), shift)


def _table(movement: kinds.Table, points: Jet, times: Array) -> Jet:
    check(_table_problems(movement, times))
    return _shifted(points, paths.interpolated(movement.times, movement.shifts, times))


def _random(movement: kinds.Random, points: Jet, times: Array) -> Jet:
    spectrum = movement.spectrum
    path = paths.sample_path(
        spectrum.frequency,
        spectrum.density,
        times,
        seed=movement.seed,
        components=paths.enough_components(spectrum.frequency, movement.duration),
    )
    axis = np.asarray(movement.axis, dtype=float)
    size = movement.deviation / math.sqrt(paths.variance(spectrum.frequency, spectrum.density))
    along = size * axis / np.linalg.norm(axis)
    return _shifted(points, tuple(part[:, None] * along for part in path))


def random_shifts(joints: int, movements: Sequence[kinds.Random]) -> Array:
    """Return where one standard deviation of each random movement carries the points, array (m, n+2, 3) [m]."""
    names, found = point_names(joints), np.zeros((len(movements), joints + 2, 3))
    for row, movement in zip(found, movements, strict=True):
        axis = np.asarray(movement.axis, dtype=float)
        chosen = [names.index(name) for name in dict.fromkeys(movement.moves)]
        row[chosen] = movement.deviation * axis / np.linalg.norm(axis)
    return found


CARRY: dict[str, Callable[[Any, Jet, Array], Jet]] = {
    kinds.Hitch.kind: _hitch,
    kinds.Arm.kind: _arm,
    kinds.Parallel.kind: _parallel,
    kinds.Harmonic.kind: _harmonic,
    kinds.Body.kind: _body,
    kinds.Table.kind: _table,
    kinds.Random.kind: _random,
}
"""Kind of movement -> function of the movement, the jet of the points moved (t, k, 3) and the times (t,)."""


def _swing(movement: Any, amplitude: float, times: Array, ahead: float = 0.0) -> Jet:
    return paths.swing(amplitude, movement.frequency, movement.phase + ahead, times)


def _shifted(points: Jet, shift: Jet) -> Jet:
    return tuple(part + way[:, None, :] for part, way in zip(points, shift, strict=True))


def _table_problems(movement: kinds.Table, times: Array) -> list[Problem]:
    if not movement.times:
        return _unread(movement)
    first, last = movement.times[0], movement.times[-1]
    outside = (times < first - 1e-9 * (last - first)) | (times > last + 1e-9 * (last - first))
    if not outside.any():
        return []
    message = _("{time:.6g} s lies outside the table {file}, which runs from {first:.6g} s to {last:.6g} s")
    worst = times[outside][0]
    return [Problem("times", message.format(time=worst, file=repr(movement.file), first=first, last=last))]


def _unread(movement: kinds.Table) -> list[Problem]:
    return [Problem("movements", _("the table {file} has not been read").format(file=repr(movement.file)))]


def start_time(movements: Sequence[Movement]) -> float:
    """Return the instant at which a drive starts to turn: zero, or the first one of tables that do not hold zero."""
    first, last = _table_span(movements)
    return min(max(0.0, first), last)


def default_times(movements: Sequence[Movement], until: float | None = None) -> Array:
    """Return the instants at which a movement is looked at when none are given, array (t,) [s].

    until [s]: end of a time span from zero, instead of the one that suits the movements.
    The span that the tables share; else the longest duration of the random movements; else the common period of the
    swings. Swings without a common period within 1000 of their periods are followed over `SPAN` periods of the slowest.
    `STEPS` instants in the shortest swing, 20 in the shortest period of a random movement, 4 to a row of a table; at
    least `FEWEST`, at most `MOST` in all unless that leaves the shortest period less than `LEAST`.
    """
    randoms = [m for m in movements if isinstance(m, kinds.Random)]
    tables = [m for m in movements if isinstance(m, kinds.Table)]
    swings = _swings(movements)
    first, last = 0.0, 0.0
    if tables:
        check(problem for table in tables if not table.times for problem in _unread(table))
        first, last = _table_span(movements)
    elif randoms:
        last = max(m.duration for m in randoms)
    elif swings:
        last = common_period(swings)
    if until is not None:
        first, last = 0.0, until
    finest = [period / STEPS for period in swings] + [0.1 * math.pi / m.spectrum.frequency[-1] for m in randoms]
    steps = [FEWEST - 1, *((last - first) / step for step in finest), *(4 * len(t.times) for t in tables)]
    needed = LEAST * (last - first) / shortest_period(movements)
    if needed > LIMIT:
        text = _("following {span:.6g} s takes {count:.3g} instants; the limit is {limit}: look at a shorter time")
        raise refuse("movements", text.format(span=last - first, count=needed, limit=LIMIT))
    count = min(max(steps), max(MOST - 1.0, needed))
    return np.linspace(first, last, math.ceil(count - 1e-6) + 1)


def shortest_period(movements: Sequence[Movement]) -> float:
    """Return the shortest period of the swings and random movements [s]; infinite when there are only tables."""
    shortest = [2.0 * math.pi / m.spectrum.frequency[-1] for m in movements if isinstance(m, kinds.Random)]
    return min(_swings(movements) + shortest, default=math.inf)


def _swings(movements: Sequence[Movement]) -> list[float]:
    return [2.0 * math.pi / m.frequency for m in movements if isinstance(m, kinds.Oscillation)]


def common_period(periods: Sequence[float]) -> float:
    """Return the shortest time in which every period fits a whole number of times.

    `SPAN` times the longest one when there is none within a thousand periods.
    """
    shortest = min(periods)
    together = Fraction(1)
    for period in periods:
        share = Fraction(period / shortest).limit_denominator(1000)
        if abs(float(share) * shortest / period - 1.0) > 1e-9:
            return SPAN * max(periods)
        together = Fraction(
            math.lcm(together.numerator, share.numerator), math.gcd(together.denominator, share.denominator)
        )
    return float(together) * shortest if together <= 1000 else SPAN * max(periods)


def _table_span(movements: Sequence[Movement]) -> tuple[float, float]:
    tables = [m for m in movements if isinstance(m, kinds.Table) and m.times]
    first = max((m.times[0] for m in tables), default=-math.inf)
    last = min((m.times[-1] for m in tables), default=math.inf)
    if first >= last:
        check([Problem("movements", _("the tables have no time span in common"))])
    return first, last
