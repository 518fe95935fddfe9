"""What does every part of a drive carry while its joint centres move?"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.movement import Movement
from cardan.errors import refuse
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.maths.ties import foremost_on
from cardan.questions.motion.moving_points import STEPS, default_times, shortest_period, start_time
from cardan.texts import _

from .forces import Forces, JournalLoads, forces

SAMPLES = 72
"""Positions looked at in each turn: steps of 5°."""

MOST_TURNS = 240
"""More turns than this are not all looked at, but so many of them, evenly spread over the movement."""

AT_ONCE = 12
"""Turns calculated between two tellings of the share done."""

AMOUNTS = (
    "angle",
    "speed",
    "acceleration",
    "shaft_torque",
    "output_torque",
    "joint_torque",
    "spline_thrust",
    "loss",
    "power_left",
    "force_left",
    "moment_left",
)
"""Fields of the forces whose last axis is that of the positions."""

VECTORS = (
    "driving_couple",
    "driven_couple",
    "secondary_couple",
    "driving_arm",
    "driven_arm",
    "axis",
    "joint_force",
    "reaction",
    "support_couple",
)
"""Fields of vectors, whose last axis but one is that of the positions."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Extreme:
    """Largest and least value of a quantity over a movement; axes (...) are its own but for that of the positions."""

    low: Array  # low, high (...): least and largest value
    high: Array  # (...)
    low_time: Array  # low_time, high_time (...) [s]: when, the first time
    high_time: Array  # (...) [s]


@dataclass(frozen=True, eq=False, kw_only=True)
class MovingForces:
    """Torques, couples and forces of a drive over a movement, turn by turn.

    Attributes
    ----------
    movements : tuple of Movement
        What moves.
    times : array (p,) [s]
        Instants, `samples` in each turn looked at.
    samples : int
        Instants in a turn, so that ``values.reshape(..., -1, samples)`` parts a quantity into turns.
    forces : Forces
        At these instants.
    turns : float
        Turns of the input in the whole movement.
    complete : bool
        Whether all turns were looked at; else some, evenly spread.
    cancelled : bool
        Whether the reader stopped the work; what was found by then is there.
    """

    movements: tuple[Movement, ...]
    times: Array
    samples: int
    forces: Forces
    turns: float
    complete: bool
    cancelled: bool = False

    @property
    def turn_times(self) -> Array:
        """Middle of every turn looked at, array (t,) [s]."""
        return np.mean(np.reshape(self.times, (-1, self.samples)), axis=-1)

    def each_turn(self, values: Array) -> tuple[Array, Array]:
        """Return least and largest value of a quantity (..., p) in every turn looked at, arrays (..., t).

        Parameters
        ----------
        values : array (..., p)
            The quantity at `times`.
        """
        parted = np.reshape(values, (*np.shape(values)[:-1], -1, self.samples))
        return np.min(parted, axis=-1), np.max(parted, axis=-1)

    def extreme(self, values: Array) -> Extreme:
        """Return least and largest value of a quantity over the whole movement.

        Parameters
        ----------
        values : array (..., p)
            The quantity at `times`.
        """
        table = np.asarray(values)
        low, high = foremost_on(table, least=True), foremost_on(table)
        return Extreme(
            low=np.min(table, axis=-1),
            high=np.max(table, axis=-1),
            low_time=np.asarray(self.times)[low],
            high_time=np.asarray(self.times)[high],
        )

    @property
    def reaction_size(self) -> Array:
        """Size of the force on every support, array (k, p) [N]; needs supports."""
        if self.forces.reaction is None:
            raise refuse("supports", _("missing; reactions need [[supports]] that hold the shafts"))
        return np.asarray(frames.norm(np.asarray(self.forces.reaction)))


def moving_forces(
    drive: Drive,
    duty: Duty | None = None,
    movements: Sequence[Movement] | None = None,
    *,
    progress: Callable[[float], object] | None = None,
) -> MovingForces:
    """Return what every part of a drive carries while it moves, over the whole of the movement.

    Parameters
    ----------
    drive : Drive
        One drive.
    duty : Duty, optional
        Torque and speed; those of the drive by default.
    movements : sequence of Movement, optional
        What moves, all at once; the movements of the drive by default.
    progress : function, optional
        Told the share done; answering "stop" leaves out the turns that are still to come.

    Returns
    -------
    MovingForces
        forces : Forces of p positions, `samples` in each of p / `samples` turns.

    Raises
    ------
    InputError
        No movement, no torque, no speed, or what `forces` refuses.

    See Also
    --------
    forces, articulation

    Notes
    -----
    The span of `articulation`: the common period of the swings, or the length of tables and random movements. Exact at
    every instant, the speed of the axes, gyroscopic couples and swinging masses included, see `forces`. Extremes are
    those of the instants looked at: in steps of 5° of the input they miss the crest of a quantity that swings twice a
    turn by 0.4 % of its swing at most.

    Examples
    --------
    >>> from cardan import Drive, moving_forces
    >>> from cardan.drive.movement import Harmonic
    >>> from cardan.parts import Duty
    >>> from cardan.units import deg, rpm
    >>> bounce = Harmonic(moves=("output",), amplitude=(0.0, 0.0, 0.05), frequency=20.0)
    >>> drive = Drive.from_angles([10 * deg])
    >>> found = moving_forces(drive, Duty(torque=100.0, speed=3000 * rpm), [bounce])
    >>> round(found.turns, 3), found.complete
    (15.708, True)
    >>> print(f"{found.extreme(found.forces.bending_couple[1]).high:.1f} N·m")
    22.7 N·m
    """
    used = drive.duty if duty is None else duty
    moves = drive.movements if movements is None else tuple(movements)
    if not moves:
        raise refuse("movements", _("missing; nothing moves"))
    if not used.speed:
        raise refuse(
            "duty.speed", _("missing; how fast the axes move counts only beside how fast the shafts turn"), "missing"
        )
    span = default_times(moves)
    start, length = start_time(moves), float(span[-1] - start_time(moves))
    turns = length * abs(used.speed) / (2.0 * math.pi)
    count = min(max(1, math.ceil(turns - 1e-9)), MOST_TURNS)
    complete = turns <= MOST_TURNS
    samples = SAMPLES
    if complete:
        samples = max(SAMPLES, math.ceil(STEPS * length / (count * shortest_period(moves))))
        times = np.linspace(start, start + length, count * samples)
    else:
        firsts = np.linspace(0.0, length - length / turns, count)
        times = (start + firsts[:, None] + length / turns * np.arange(samples) / samples).ravel()
    parts: list[Forces] = []
    cancelled = False
    block = AT_ONCE * samples
    for first in range(0, times.size, block):
        angle = used.speed * (times[first : first + block] - start)
        parts.append(forces(drive, used, angle, movement=moves))
        if progress is not None and progress(min(1.0, (first + block) / times.size)) == "stop":
            cancelled = first + block < times.size
            break
    found = parts[0] if len(parts) == 1 else _joined(parts)
    return MovingForces(
        movements=moves,
        times=times[: found.angle.shape[0]],
        samples=samples,
        forces=found,
        turns=turns,
        complete=complete,
        cancelled=cancelled,
    )


def _joined(parts: Sequence[Forces]) -> Forces:
    """Return the forces of successive positions as one."""
    first = parts[0]

    def along(name: str, axis: int) -> Array | None:
        rows = [getattr(part, name) for part in parts]
        return None if rows[0] is None else np.concatenate(rows, axis=axis)

    journals = JournalLoads(
        load=np.concatenate([part.journals.load for part in parts], axis=-3),
        thrust=np.concatenate([part.journals.thrust for part in parts], axis=-2),
    )
    status = np.max(np.stack([np.asarray(part.status) for part in parts]), axis=0)
    joined: dict[str, Any] = {name: along(name, -1) for name in AMOUNTS} | {name: along(name, -2) for name in VECTORS}
    return replace(first, **joined, journals=journals, status=status)
