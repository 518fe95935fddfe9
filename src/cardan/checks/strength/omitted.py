"""What the stresses of a drive leave out, as it is told."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Vibration:
    """Torsional vibration at the speed of the duty."""

    speed: float  # [rad/s]: input speed
    stable: bool  # whether it dies out; where it does not, no torque is told
    name: str = ""  # of the part whose torque it raises most
    torque: float = math.nan  # [N·m]: largest torque there
    factor: float = math.nan  # how many times the torque that the strength counts


@dataclass(frozen=True, kw_only=True)
class Journal:
    """The journal whose load all forces together raise most."""

    joint: int  # from 1
    load: float  # [N]
    more: float  # share by which that is more than counted


@dataclass(frozen=True, kw_only=True)
class LeftOut:
    """What the stresses leave out, as far as it can be told and matters."""

    vibration: Vibration | None = None
    journal: Journal | None = None
    supported: bool = False  # whether the supports of the drive are known, so that its forces are
    runs_up: bool = False  # whether its run-up is known, too
