"""What the stresses of a drive count of torsional vibration, and what they leave out, as it is told."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Vibration:
    """Torsional vibration at the speed in use at which it raises the torque most."""

    speed: float  # [rad/s]: input speed
    stable: bool  # whether it dies out at the speed of the duty; else the torque is the least that is reached
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
