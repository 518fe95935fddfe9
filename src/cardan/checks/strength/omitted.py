"""What the stresses of a drive count of torsional vibration, and what they leave out, as it is told."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.checks.design import Design
from cardan.maths.ties import foremost_of
from cardan.questions.torsion.stability.in_use import grows_in_use
from cardan.texts import _


@dataclass(frozen=True, kw_only=True)
class Vibration:
    """Torsional vibration at the speed in use at which it raises the torque most."""

    speed: float  # [rad/s]: input speed
    stable: bool  # whether it dies out at the speeds in use; else the torque is the least that is reached
    name: str  # of the shaft whose torque it raises most
    low: float  # low, high [N·m]: least and largest torque there, counted along its mean
    high: float
    factor: float  # how many times the torque without it


@dataclass(frozen=True, kw_only=True)
class Journal:
    """The journal whose load all forces together raise most."""

    joint: int  # from 1
    load: float  # [N]
    more: float  # share by which that is more than counted
    several: bool = False  # whether the drive has other load cases beside the torque of the duty, which this is of


@dataclass(frozen=True, kw_only=True)
class LeftOut:
    """What the stresses leave out, as far as it can be told and matters."""

    journal: Journal | None = None
    supported: bool = False  # whether the supports of the drive are known, so that its forces are
    runs_up: bool = False  # whether its run-up is known, too


def vibration(subject: Design) -> Vibration | None:
    """Return what torsional vibration makes of the torque; None where the file does not let it be told.

    The torque of a steady motion that grows is the least that the drive reaches.
    """
    vibrating = [(case, one) for case in subject.loaded if (one := case.vibration) is not None]
    told = [(case, one) for case, one in vibrating if not np.all(np.isnan(one.growth))]  # some torque
    if not told:
        return None
    _case, worst = foremost_of(told, lambda one: float(np.nanmax(one[1].growth)))
    s, k = np.unravel_index(int(np.nanargmax(worst.growth)), worst.growth.shape)
    return Vibration(
        speed=abs(float(worst.speed[s])),
        stable=not grows_in_use(subject.drive),
        name=_("shaft {number}").format(number=int(k) + 1),
        low=float(worst.low[s, k]),
        high=float(worst.high[s, k]),
        factor=float(worst.growth[s, k]),
    )
