"""How far do pendulums oscillate in steady running, and is that small, and off their stops? By small oscillations."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

import numpy as np

from cardan.answers.answer import FILE, Remark
from cardan.answers.quantity import Quantity, Text, say
from cardan.drive.conditions import load_cases
from cardan.drive.drive import Drive
from cardan.drive.torsional_layout import has_torsion
from cardan.errors import InputError
from cardan.formulas.pendulum import pendulum
from cardan.maths.arrays import Array
from cardan.texts import _
from cardan.units import deg

from .torsion_response import TorsionResponse, torsion_response

RANGE = 41
"""Speeds at which a range of speeds is looked at."""

WIDE = 10.0 * deg
"""Swing from which small oscillations are not small: near its tuning a pendulum that swings so far makes a tenth more
torque alternate, one that swings twice as far half more."""


def pendulum_swing(found: TorsionResponse) -> Array:
    """Return the amplitudes with which pendulums oscillate on their stations, array (..., p) [rad].

    All of them on a station take the torque m R (R + l) Ω² φ, to first order.
    """
    train = found.train
    each = [found.swing[..., e] for e in train.pendulums]
    answers = [pendulum(one.mass, one.radius, one.length, 0.0, count=one.count).answer for one in train.hung]
    told = [answer * one / found.speed**2 for one, answer in zip(each, answers, strict=True)]
    return np.stack(told, axis=-1) if told else np.zeros((*found.speed.shape, 0))


def strikes(found: TorsionResponse) -> Iterator[Remark]:
    """Yield which pendulums would hit their stops or swing wide, so that the motion told is none that the drive has."""
    speed = np.abs(found.speed).reshape(-1)
    swing = np.nan_to_num(pendulum_swing(found)).reshape(speed.size, len(found.train.pendulums))
    for k, (e, hung) in enumerate(zip(found.train.pendulums, found.train.hung, strict=True)):
        worst = int(np.argmax(swing[:, k]))
        struck = hung.stop_angle is not None and swing[worst, k] > hung.stop_angle
        if not struck and swing[worst, k] <= WIDE:
            continue
        text = _(
            "Warning: the {name} would oscillate by ±{angle} at {speed}, too wide for the small oscillations that are "
            "counted: torsional vibration may be several times stronger, and is followed in time by:"
        )
        values: dict[str, Text] = {
            "angle": Quantity(float(swing[worst, k]), "angle", 3),
            "speed": Quantity(float(speed[worst]), "angular_speed", 4),
        }
        if struck:
            text = _(
                "Warning: the {name} would oscillate by ±{angle} at {speed} and hits its stops at ±{stop}: torsional "
                "vibration is stronger there than counted, and is followed in time by:"
            )
            values["stop"] = Quantity(hung.stop_angle, "angle", 3)
        said = say(text, name=found.train.elements[e], **values)
        command = ("cardan", "torsion", "simulate", FILE, "--settled")
        yield Remark(text=said, command=command, tone="warning", alarm=True)


@lru_cache(maxsize=64)
def strikes_in_use(drive: Drive) -> tuple[Remark, ...]:
    """Return the same of a drive at the speeds in use; nothing where its vibration is not told."""
    if not any(one.pendulum is not None for one in drive.stations):
        return ()
    given = [(one.speed, one.speed_range) for one in load_cases(drive.duty)]
    given.append((drive.duty.speed, drive.duty.speed_range))
    ranges = [np.linspace(between[0], between[1], RANGE) for _speed, between in given if between is not None]
    speeds = [abs(speed) for speed, _between in given if speed]
    speeds += [float(one) for between in ranges for one in between if one]
    if not has_torsion(drive) or not speeds:
        return ()
    try:
        return tuple(strikes(torsion_response(drive, speed=np.unique(speeds))))
    except InputError:
        return ()
