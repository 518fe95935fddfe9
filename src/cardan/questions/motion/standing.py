"""A drive while it moves, as it stands at instants of its movements: for means over the time, and at its worst."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.models.dynamics_model import Train
from cardan.drive.models.geometry import geometry, geometry_from_points, in_form
from cardan.drive.models.kinematics_model import Chain, turning, unmapped
from cardan.drive.movement import Movement, Oscillation
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.curves.extremes import highest
from cardan.maths.kernel import frames

from .equivalence import after_each_joint
from .moving_points import default_times, moving_points, shortest_period

FEWEST, MOST = 180, 720
"""Instants over which means are taken; where a joint passes through straight their error falls with the square."""

CYCLE = 24
"""Instants in the shortest swing at least, up to `MOST`."""

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


def standing(drive: Drive, machine: Train, times: Array) -> list[Train]:
    """Return the machine half of a drive as it stands at instants of its movements, masses as drawn.

    times (t,) [s].
    Raises InputError: a joint bends 90 degrees or more at an instant.
    """
    points = moving_points(geometry(drive).points, drive.movements, times)[0]
    place = geometry_from_points(points)
    return [
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
        for k in range(times.size)
    ]


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
    )


def standing_chain(drive: Drive, times: ArrayLike) -> tuple[Chain, Array]:
    """Return the kinematic half of a drive as it stands at instants of its movements, and at which of them it turns.

    drive: with movements, of joints whose law is tan θ' = κ tan θ; times (t,) [s].
    Returns chain (t, n), a straight one where a joint bends 90° or more; array of bool (t,).
    """
    points = moving_points(geometry(drive).points, drive.movements, times)[0]
    possible = np.all(_joint_angles(points) < LIMIT, axis=-1)
    straight = np.arange(points.shape[-2])[:, None] * np.asarray((1.0, 0.0, 0.0))
    place = geometry_from_points(np.where(possible[:, None, None], points, straight))
    chain = Chain(
        joint_angle=place.joint_angle,
        plane_twist=place.plane_twist,
        yoke_angle=np.asarray([shaft.yoke_angle for shaft in drive.shafts[1:-1]], dtype=float),
        start_phase=np.asarray(drive.input.start_phase),
    )
    return turning(chain, drive.joints, near=True), possible


def worst_instants(drive: Drive, course: Callable[[Array], Array]) -> tuple[float, ...]:
    """Return the instants [s] of a movement at which courses over it are highest, each once.

    drive: with movements; course: from instants (m,) to values (k, m), nan where there is none.
    Found between the instants of `default_times` too; one that lies beside another stands for both.
    """
    times = default_times(drive.movements)
    places = highest(course, times, course(times))[0]
    found: list[float] = []
    for place in places[np.isfinite(places)]:
        if all(abs(place - one) > BESIDE * (times[1] - times[0]) for one in found):
            found.append(float(place))
    return tuple(found)


def outermost(drive: Drive) -> tuple[float, ...]:
    """Return the instants [s] at which a moving drive lies or turns least as drawn.

    drive: with movements.
    Where a joint bends most, a shaft between two joints is longest or shortest, or a shaft turns most unevenly.
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
