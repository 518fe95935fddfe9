"""What of a drive decides how its faults show: masses, bends, critical speed, torque, and where sensors can sit."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from cardan.drive.body import body_length, weight
from cardan.drive.conditions import used_speeds
from cardan.drive.drive import Drive
from cardan.drive.fields.parts import known_lengths
from cardan.drive.models.geometry import geometry
from cardan.drive.models.kinematics_model import given_chain, turning
from cardan.drive.yokes import with_yokes
from cardan.errors import InputError
from cardan.maths.arrays import Array
from cardan.questions.bending.balance import balance
from cardan.questions.bending.bending import bending_speeds
from cardan.questions.motion.equivalence import equivalent_joint
from cardan.units import rpm

GRADE = 16.0e-3
"""Balance quality e ω of a shaft that its drive says nothing of [m/s]: G16, usual for drive shafts (ISO 21940-11)."""

A_METRE = 5.0  # mass of a metre of shaft that its drive says nothing of [kg/m]

SPEED, TORQUE, LENGTH = 3000.0 * rpm, 200.0, 1.0
"""Top speed [rad/s], torque [N·m] and length of a shaft [m] where the drive says none."""

DAMPING = 0.03
"""Damping ratio of the bending mode of a shaft in its joints; a usual figure, measured drives have 0.01 to 0.05."""

HOUSING, HANGER = 8.0, 2.0
"""Mass that moves with a gearbox or axle housing, and with a centre bearing, over that of the shafts."""


@dataclass(frozen=True, kw_only=True)
class Housing:
    """Where a sensor can sit."""

    kind: str  # ``input``, ``centre`` or ``output``
    place: str  # key path of the support, or of the shaft where the drive has no support there
    places: tuple[str, ...]  # all key paths that belong to it: supports, shafts and joints
    joints: tuple[int, ...]  # joints whose forces it takes, counted from 0
    mass: float  # [kg]: that moves with it


@dataclass(frozen=True, eq=False, kw_only=True)
class DriveModel:
    """Figures of a drive that decide how its faults show."""

    mass: Array  # mass, length (n-1,) [kg], [m]: of the shafts between two joints
    length: Array  # (n-1,) [kg], [m]
    inertia: float  # [kg·m²]: of these shafts together about their axes
    joint_angle: Array  # (n,) [rad]
    uneven: float  # [rad]: amplitude of order 2 of the angle of the output: |τ| of the equivalent joint
    allowed: Array  # (n-1,) [kg·m]: unbalance that the balance grade leaves in each of these shafts
    # [rad/s]: lowest bending critical speed in which a shaft bows (a soft support that gives way damps its mode); nan
    # where the drive does not say enough
    critical: float
    damping: float  # of that mode
    speed: tuple[float, float]  # [rad/s]: range of running
    torque: float  # [N·m]: of the duty
    housings: tuple[Housing, ...]  # from the input on
    assumed: tuple[str, ...]  # key paths of what the drive does not say

    def housing(self, kind: str) -> Housing | None:
        """Return the housing of a kind, None where the drive has none."""
        return next((one for one in self.housings if one.kind == kind), None)

    def housing_at(self, place: str) -> Housing | None:
        """Return the housing that a key path belongs to, None where it belongs to none."""
        return next((one for one in self.housings if place in one.places), None)


def plant(drive: Drive) -> DriveModel:
    """Return the figures of a drive that decide how its faults show.

    Each figure is that of the program's own analysis: `bending_speeds`, `balance`, `equivalent_joint`. What the drive
    does not say is assumed and listed: the answer is then about the shape of a vibration rather than its size.
    """
    place = geometry(drive)
    lengths = known_lengths(drive)
    assumed: list[str] = []
    mass, length, inertia = [], [], 0.0
    for shaft in with_yokes(drive).shafts[1:-1]:
        between = body_length(shaft, lengths.get(shaft.number))
        body = weight(shaft, between)
        length.append(between or LENGTH)
        if not body.mass:
            assumed.append(f"shafts[{shaft.number - 1}].mass")
        mass.append(body.mass or A_METRE * length[-1])
        inertia += body.inertia or 0.0
    if not mass:
        mass, length = [A_METRE * 0.3], [0.3]
    used = used_speeds(drive.duty)
    if used is None:
        assumed.append("duty.speed")
    low, high = used or (0.2 * SPEED, SPEED)
    torque = abs(drive.duty.torque or 0.0)
    if not torque:
        assumed.append("duty.torque")
    masses = np.asarray(mass)
    return DriveModel(
        mass=masses,
        length=np.asarray(length),
        inertia=inertia or float(np.sum(masses)) * 1e-3,
        joint_angle=np.asarray(place.joint_angle, dtype=float),
        uneven=float(np.abs(equivalent_joint(turning(given_chain(drive), drive.joints, near=True)).vertex[-1])),
        allowed=_allowed(drive, masses, high),
        critical=_critical(drive, assumed),
        damping=DAMPING,
        speed=(min(low, 0.3 * high), high),
        torque=torque or TORQUE,
        housings=_housings(drive, float(np.sum(masses))),
        assumed=tuple(assumed),
    )


def _allowed(drive: Drive, mass: Array, speed: float) -> Array:
    try:
        found = [one.allowed for one in balance(drive).shafts if 1 < one.number <= len(drive.joints)]
    except InputError:
        found = []
    usual = GRADE / speed * mass
    if len(found) != len(mass):
        return usual
    return np.where(np.isfinite(found), found, usual)


def _critical(drive: Drive, assumed: list[str]) -> float:
    try:
        found = bending_speeds(drive, modes=1)
        if found.deciding:
            found = bending_speeds(drive, modes=found.deciding + 1)
    except InputError as problem:
        assumed.extend(one.field for one in problem.problems)
        return math.nan
    return float(found.actual[found.deciding or 0])


def _housings(drive: Drive, mass: float) -> tuple[Housing, ...]:
    count = len(drive.joints)

    def housing(kind: str, first: int, last: int, joints: tuple[int, ...], share: float) -> Housing:
        numbers = range(first, last + 1)
        supports = [f"supports[{k}]" for k, one in enumerate(drive.supports) if one.shaft in numbers]
        shafts = [f"shafts[{number - 1}]" for number in numbers]
        places = (*supports, *shafts, *(f"joints[{k}]" for k in joints))
        return Housing(kind=kind, place=places[0], places=places, joints=joints, mass=share * mass)

    found = [housing("input", 1, 1, (0,), HOUSING)]
    if count > 2:
        found.append(housing("centre", 2, count, tuple(range(1, count - 1)), HANGER))
    return (*found, housing("output", count + 1, count + 1, (count - 1,), HOUSING))
