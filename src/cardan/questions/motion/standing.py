"""A drive while it moves, as it stands at instants of its movements: for means over the time, and at its worst."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.models.dynamics_model import Train
from cardan.drive.models.geometry import geometry, geometry_from_points, in_form
from cardan.drive.models.kinematics_model import Chain, turning
from cardan.drive.movement import Movement, Oscillation
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.maths.ties import foremost

from .moving_points import default_times, moving_points, shortest_period

FEWEST, MOST = 180, 720
"""Instants over which means are taken; where a joint passes through straight their error falls with the square."""

CYCLE = 24
"""Instants in the shortest swing at least, up to `MOST`."""

LIMIT = 0.5 * np.pi * (1.0 - 1e-6)
"""Bend [rad] that no joint turns at."""


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


def steepest(drive: Drive) -> tuple[float, ...]:
    """Return the instants [s] at which the joints of a moving drive bend most, one a joint, each once.

    drive: with movements.
    Of the instants of `default_times`, those at which the checks look; none at which nothing turns.
    """
    times = default_times(drive.movements)
    axis = np.diff(moving_points(geometry(drive).points, drive.movements, times)[0], axis=-2)
    joint_angle = np.arctan2(
        frames.norm(frames.cross(axis[:, :-1], axis[:, 1:])), frames.dot(axis[:, :-1], axis[:, 1:])
    )
    possible = np.all(joint_angle < LIMIT, axis=-1)
    found = (float(times[possible][int(foremost(row[possible]))]) for row in joint_angle.T if np.any(possible))
    return tuple(dict.fromkeys(found))
