"""What the stresses of a drive leave out, as it is told."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Vibration:
    """Torsional vibration at the speed of the duty.

    Attributes
    ----------
    speed : float [rad/s]
        Input speed.
    stable : bool
        Whether it dies out; where it does not, no torque is told.
    name : str
        Of the part whose torque it raises most.
    torque : float [N·m]
        Largest torque there.
    factor : float
        How many times the torque that the strength counts.
    """

    speed: float
    stable: bool
    name: str = ""
    torque: float = math.nan
    factor: float = math.nan


@dataclass(frozen=True, kw_only=True)
class Journal:
    """The journal whose load all forces together raise most.

    Attributes
    ----------
    joint : int
        From 1.
    load : float [N]
    more : float
        Share by which that is more than counted.
    """

    joint: int
    load: float
    more: float


@dataclass(frozen=True, kw_only=True)
class LeftOut:
    """What the stresses leave out, as far as it can be told and matters.

    Attributes
    ----------
    vibration : Vibration or None
    journal : Journal or None
    supported : bool
        Whether the supports of the drive are known, so that its forces are.
    runs_up : bool
        Whether its run-up is known, too.
    """

    vibration: Vibration | None = None
    journal: Journal | None = None
    supported: bool = False
    runs_up: bool = False
