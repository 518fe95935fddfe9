"""A drive while it moves, as it stands at instants of its movements: for means over the time, and at its worst."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.models.dynamics_model import Train
from cardan.drive.models.geometry import Geometry, geometry, geometry_from_points, in_form
from cardan.drive.models.kinematics_model import Chain, turning, unmapped
from cardan.drive.movement import Movement, Oscillation, Random
from cardan.drive.shaft import Shaft
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.curves.extremes import ROUNDS, highest
from cardan.maths.kernel import frames

from .equivalence import after_each_joint
from .moving_points import default_times, moving_points, random_shifts, shortest_period

FEWEST, MOST = 180, 720
"""Instants over which means are taken; where a joint passes through straight their error falls with the square."""

CYCLE = 24
"""Instants in the shortest swing at least, up to `MOST`."""

WIDE = 6.5
"""Deviations of a random movement that a mean counts on either side."""

LIGHT = 1e-9
"""Places with less than this share of the weight of the heaviest count for nothing."""

LIMIT = 0.5 * np.pi * (1.0 - 1e-6)
"""Bend [rad] that no joint turns at."""

BESIDE = 2e-3
"""Instants closer than this share of a step are one: what is highest there differs by a ten-millionth."""


def mean_times(movements: Sequence[Movement], *, fewest: int = FEWEST) -> Array:
    """Return instants, array (t,) [s], whose plain mean is that over the time of some movements.

    fewest: how many instants at least.
    The middles of equal steps of the span that `default_times` follows: exact up to rounding for what swings smoothly.

    >>> from cardan.drive.movement import Harmonic
    >>> swing = Harmonic(moves=("output",), amplitude=(0, 0, 1), frequency=np.pi)
    >>> times = mean_times([swing])
    >>> times.size, round(float(np.mean(np.sin(np.pi * times) ** 2)), 12)
    (180, 0.5)
    """
    every = default_times(movements)
    first, last = float(every[0]), float(every[-1])
    swings = (last - first) / shortest_period(movements) if any(isinstance(m, Oscillation) for m in movements) else 0.0
    count = int(np.clip(np.ceil(CYCLE * swings), fewest, MOST))
    return first + (np.arange(count) + 0.5) * ((last - first) / count)


def standing(drive: Drive, machine: Train, *, fewest: int = FEWEST) -> tuple[list[Train], Array]:
    """Return the machine half of a drive as it stands over its movements, masses as drawn, and the share of each.

    drive: with movements; fewest: how many instants at least.
    Returns Trains and their shares (t,), which add up to 1: the mean of what depends on where the drive stands is over
    the time, and over all that chance may bring of random movements, not over one sample path of them.
    Raises InputError: a joint bends 90 degrees or more at an instant.
    """
    points, shares = _mean_points(drive, fewest)
    place = geometry_from_points(points)
    trains = [
        replace(
            machine,
            points=points[k],
            normal=place.normal[k],
            chain=turning(
                Chain(
                    joint_angle=place.joint_angle[k],
                    plane_twist=place.plane_twist[k],
                    yoke_angle=machine.chain.yoke_angle,
                    start_phase=machine.chain.start_phase,
                ),
                drive.joints,
                near=True,
            ),
        )
        for k in range(len(points))
    ]
    return trains, shares


def _mean_points(drive: Drive, fewest: int) -> tuple[Array, Array]:
    """Return places of the points over the movements (t, n+2, 3) [m] and the share of each (t,).

    One random movement at even steps of its normal law, two by Gauss and Hermite; more of them, or beside others, at
    `MOST` draws, whose means err by 4 % of the deviation of what is meant.
    """
    base = np.asarray(geometry(drive).points)
    chance = [one for one in drive.movements if isinstance(one, Random)]
    others = [one for one in drive.movements if not isinstance(one, Random)]
    if not chance:
        times = mean_times(others, fewest=fewest)
        return moving_points(base, others, times)[0], np.full(times.size, 1.0 / times.size)
    shifts = random_shifts(len(drive.joints), chance)
    if others or len(chance) > 2:
        drawn = np.random.default_rng(max(one.seed for one in chance)).normal(size=(MOST, len(chance)))
        moved = np.broadcast_to(base, (MOST, *base.shape))
        if others:
            times = mean_times(others, fewest=MOST)
            moved = moving_points(base, others, times)[0]
        return moved + np.tensordot(drawn, shifts, axes=1), np.full(MOST, 1.0 / MOST)
    if len(chance) == 1:
        at = np.linspace(-WIDE, WIDE, fewest + 1)
        places, weight = at[:, None], np.exp(-0.5 * at**2)
    else:
        at, each = np.polynomial.hermite_e.hermegauss(round(math.sqrt(2 * fewest)))
        places = np.stack(np.meshgrid(at, at, indexing="ij"), axis=-1).reshape(-1, 2)
        weight = np.outer(each, each).ravel()
    heavy = weight > LIGHT * np.max(weight)
    places, weight = places[heavy], weight[heavy]
    return base + np.tensordot(places, shifts, axes=1), weight / np.sum(weight)


def still(drive: Drive, time: float) -> Drive:
    """Return the drive that stands as a moving one does at an instant.

    drive: with movements; time [s].

    >>> from cardan.drive.movement import Harmonic
    >>> rise = Harmonic(moves=("output",), amplitude=(0, 0, 1), frequency=np.pi)
    >>> moving = replace(Drive.from_points([(0, 0, 0), (1, 0, 0), (2, 0, 0)]), movements=(rise,))
    >>> still(moving, 0.5).output.point
    (2.0, 0.0, 1.0)
    """
    rows = moving_points(geometry(drive).points, drive.movements, [time])[0][0]
    points = [(float(x), float(y), float(z)) for x, y, z in rows]
    bare = in_form(replace(drive, movements=()), "points")
    return replace(
        bare,
        input=replace(bare.input, point=points[0]),
        output=replace(bare.output, point=points[-1]),
        joints=tuple(replace(one, centre=point) for one, point in zip(bare.joints, points[1:-1], strict=True)),
        shafts=tuple(_stretched(one, rows) for one in bare.shafts),
    )


def _stretched(shaft: Shaft, points: Array) -> Shaft:
    """Return a shaft with the stretches of its body drawn to fit the distance of its joints, as `body.pieces` does.

    points (p, 3) [m]: of the drive, its ends included.
    """
    if not shaft.segments or not 1 < shaft.number < len(points) - 1:
        return shaft
    length = float(np.linalg.norm(points[shaft.number] - points[shaft.number - 1]))
    fit = length / sum(one.length for one in shaft.segments)
    return replace(shaft, segments=tuple(replace(one, length=fit * one.length) for one in shaft.segments))


def standing_chain(drive: Drive, times: ArrayLike) -> tuple[Chain, Array]:
    """Return the kinematic half of a drive as it stands at instants of its movements, and at which of them it turns.

    drive: with movements, of joints whose law is tan θ' = κ tan θ; times (t,) [s].
    Returns chain (t, n), a straight one where a joint bends 90° or more; array of bool (t,).
    """
    return chain_at(drive, moving_points(geometry(drive).points, drive.movements, times)[0])


def chain_at(drive: Drive, points: Array) -> tuple[Chain, Array]:
    """Return the kinematic half of a drive with its points elsewhere (t, n+2, 3) [m], see `standing_chain`."""
    chain, _place, possible = given_at(drive, points)
    return turning(chain, drive.joints, near=True), possible


def given_at(drive: Drive, points: Array) -> tuple[Chain, Geometry, Array]:
    """Return the same with its joints as they are, not as the Hooke joints that turn alike, and where they are."""
    possible = np.all(_joint_angles(points) < LIMIT, axis=-1)
    straight = np.arange(points.shape[-2])[:, None] * np.asarray((1.0, 0.0, 0.0))
    place = geometry_from_points(np.where(possible[:, None, None], points, straight))
    chain = Chain(
        joint_angle=place.joint_angle,
        plane_twist=place.plane_twist,
        yoke_angle=np.asarray([shaft.yoke_angle for shaft in drive.shafts[1:-1]], dtype=float),
        start_phase=np.asarray(drive.input.start_phase),
    )
    return chain, place, possible


def worst_instants(drive: Drive, course: Callable[[Array], Array], *, rounds: int = ROUNDS) -> tuple[float, ...]:
    """Return the instants [s] of a movement at which courses over it are highest, each once.

    drive: with movements; course: from instants (m,) to values (k, m), nan where there is none.
    rounds: how many times the instants get closer.
    Found between the instants of `default_times` too; one that lies beside another stands for both.
    """
    times = default_times(drive.movements)
    places = highest(course, times, course(times), rounds=rounds)[0]
    found: list[float] = []
    for place in places[np.isfinite(places)]:
        if all(abs(place - one) > BESIDE * (times[1] - times[0]) for one in found):
            found.append(float(place))
    return tuple(found)


def outermost(drive: Drive) -> tuple[float, ...]:
    """Return the instants [s] at which a moving drive lies or turns least as drawn.

    drive: with movements.
    Where a joint bends most, a shaft between two joints is longest or shortest, or a shaft turns least uniformly.
    """

    def course(times: Array) -> Array:
        points = moving_points(geometry(drive).points, drive.movements, times)[0]
        joint_angle = _joint_angles(points)
        length = frames.norm(np.diff(points, axis=-2))[:, 1:-1]
        each = [joint_angle, length, -length]
        if not unmapped(drive.joints):
            each.append(after_each_joint(standing_chain(drive, times)[0]).speed_fluctuation)
        possible = np.all(joint_angle < LIMIT, axis=-1)
        return np.where(possible, np.concatenate(each, axis=-1).T, np.nan)

    return worst_instants(drive, course)


def _joint_angles(points: Array) -> Array:
    """Return the joint angles of points (t, n+2, 3), array (t, n) [rad]; one may be 90° and more."""
    axis = np.diff(points, axis=-2)
    before, after = axis[:, :-1], axis[:, 1:]
    found: Array = np.arctan2(frames.norm(frames.cross(before, after)), frames.dot(before, after))
    return found
