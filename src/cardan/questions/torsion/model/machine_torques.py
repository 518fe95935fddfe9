"""Which torques act on the stations of a drive under its duty."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.machine import MachineTorque
from cardan.maths.arrays import ArrayLike

from .excitation import engine_torque, law_of
from .torques import Constant, Law, Swinging
from .torsional_model import Torque


def turns_freely(drive: Drive, duty: Duty) -> bool:
    """Tell whether torques turn the input of a drive, rather than a speed that is forced on it.

    >>> from cardan.drive.machine import Engine
    >>> drive = Drive.from_angles([0.1])
    >>> turns_freely(drive, Duty()), turns_freely(drive, Duty(engine=Engine(cylinders=4)))
    (False, True)
    """
    if duty.input is not None:
        return duty.input == "free"
    swings = duty.torque_at == "input" and bool(duty.harmonics)
    pushed = any(one.station == "input" for one in duty.torques)
    return duty.engine is not None or duty.motor is not None or pushed or swings


def machine_torques(
    drive: Drive,
    duty: Duty,
    stations: Mapping[str, int],
    last: int,
    ends: Sequence[int],
    *,
    speed: ArrayLike | None = None,
    free: bool = True,
) -> tuple[Torque, ...]:
    """Return the torques on the stations of a drive.

    stations: stations by name; last: station of the output end.
    ends: last station of every shaft, for what resists its turning; speed (s,) [rad/s].
    free: whether torques turn the input; torques there are left out when its speed is forced.
    The torque of the duty loads the output; where it is that of the input, the mean of the output is the same but for
    what resists between.
    """
    at = {"input": 0, "output": last} | dict(stations)
    found: list[Torque] = []

    def act(station: int, *laws: Law) -> None:
        found.extend(Torque(station=station, law=law) for law in laws if station or free)

    def placed(machine: MachineTorque, default: str) -> int:
        return at[machine.station or default]

    if duty.engine is not None:
        act(0, *engine_torque(duty.engine, speed).laws)
    if duty.motor is not None:
        act(placed(duty.motor, "input"), law_of(duty.motor))
    if duty.load is not None:
        act(placed(duty.load, "output"), law_of(duty.load, resists=True))
    elif duty.torque is not None:
        act(last, Constant(value=-duty.torque))
    if duty.torque is not None:
        drives = duty.torque_at == "input"
        if drives:
            act(0, Constant(value=duty.torque))
        if drives or duty.load is None:
            sign, end = (1.0, 0) if drives else (-1.0, last)
            for one in duty.harmonics:  # a cosine is a sine a quarter ahead
                act(end, Swinging(amplitude=sign * one.torque, frequency=one.order, phase=one.phase + 0.5 * math.pi))
    for machine in duty.torques:
        act(placed(machine, "input"), law_of(machine))
    for shaft, end in zip(drive.shafts, ends, strict=True):
        if shaft.resisting_torque:
            act(end, Constant(value=-shaft.resisting_torque))
    return tuple(found)
