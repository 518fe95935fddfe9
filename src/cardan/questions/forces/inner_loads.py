"""What the parts inside of joints carry: balls in grooves, rollers on tracks, cages, tongues, pins, crosses."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.joints import Joint
from cardan.drive.joints.common.inner import Contact
from cardan.drive.models.kinematics_model import given_chain
from cardan.formulas.hertz import point_contact
from cardan.maths.arrays import Array
from cardan.maths.curves.cycle_statistics import harmonics
from cardan.maths.kernel import frames
from cardan.questions.motion.joint_mechanism import (
    CLOSER,
    STRAIGHT,
    JointCarried,
    joint_carried,
    over,
    rubbed_push,
    stance_of,
)
from cardan.questions.motion.motion import motion

from .forces import Forces

PLACES = 72
"""Places of a turn at which a joint is looked at; parts alike take each other's places."""

ROUNDING = 1e-9
"""Couples below this for a torque of 1 N·m, and forces below this share of the largest, are nothing but rounding."""

EVEN = np.arange(CLOSER) * (2.0 * np.pi / CLOSER)
"""Places of a turn at which the force that friction makes is taken [rad]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class UnitLoad:
    """What parts alike of a joint carry over a turn for a torque of 1 N·m on its driven shaft, arrays (`PLACES`,)."""

    name: str  # marked for translation, with places {number} for the joint and {count} for which of them
    count: int  # how many of them there are
    high: Array  # high, low [1/m]: largest and least force of any of them, over the torque
    low: Array
    couple: Array  # largest couple, over the torque
    contact: Contact | None  # what touches in each of them
    area: float  # [m²]: of one bearing, which carries ``high``; 0 where it is not given
    slide: Array  # [m]: how fast they slide on it, over the speed of the driving shaft


@dataclass(frozen=True, eq=False, kw_only=True)
class InnerLoad:
    """What parts alike of a joint carry over a turn."""

    joint: int  # number of the joint, from 1
    name: str  # marked for translation, see `UnitLoad`
    count: int
    high: float  # high, low [N]: largest force over a turn of any of them, and least
    low: float
    couple: float  # [N·m]: largest couple
    # [Pa]: largest pressure, by Hertz where they touch in a point, else over the area of a bearing; None where their
    # sizes are not given
    pressure: float | None = None
    heating: float | None = None  # [Pa·m/s]: largest product of pressure and speed of sliding in a bearing


def inner_loads(drive: Drive, found: Forces) -> tuple[InnerLoad, ...]:
    """Return what the parts inside of the joints of a drive carry, joints that tell it.

    found: forces of the drive as drawn. Rigid parts without play, with friction where the joint tells it; what balls
    and cage share beyond the balances they share so that the sum of squares is least, as equal springs do.
    """
    loads, still = [], "duty.speed" in found.assumed
    angles = given_chain(drive).joint_angle
    turned = np.asarray(motion(drive, found.angle).yoke_rotation)
    for i, joint in enumerate(drive.joints):
        torque = np.asarray(found.shaft_torque)[i + 1]
        for one, other in zip(*(unit_loads(joint, float(angles[i]), fed=fed) for fed in (True, False)), strict=True):
            high, low, couple = (
                np.abs(torque) * np.where(torque * found.speed[i + 1] < 0.0, *(over(row, turned[i]) for row in rows))
                for rows in ((other.high, one.high), (other.low, one.low), (other.couple, one.couple))
            )
            least, slide = float(np.min(low)), np.abs(found.speed[i]) * over(one.slide, turned[i])
            loads.append(
                InnerLoad(
                    joint=i + 1,
                    name=one.name,
                    count=one.count,
                    high=float(np.max(high)),
                    low=least if least > ROUNDING * np.max(high) else 0.0,
                    couple=float(np.max(couple)),
                    pressure=_pressure(one, high, torque),
                    heating=None if still or not one.area else float(np.max(high * slide)) / one.area,
                )
            )
        strains = (*joint.strained(float(angles[i])), *joint.shared(float(angles[i]), float(np.max(np.abs(torque)))))
        for one in strains:
            low = one.force if one.least is None else one.least
            parts = InnerLoad(joint=i + 1, name=one.name, count=one.count, high=one.force, low=low, couple=one.couple)
            loads.append(parts)
    return tuple(loads)


@dataclass(frozen=True, eq=False, kw_only=True)
class Thrust:
    """Force along the driven shaft that friction in a joint makes while its shafts slide along each other inside it."""

    joint: int  # number of the joint, from 1
    most: float  # [N]: largest over a turn
    order: int  # its main order: parts alike of the joint
    amplitude: float  # [N]: of this order


def thrusts(drive: Drive, found: Forces) -> tuple[Thrust, ...]:
    """Return the axial forces that friction makes in the joints of a drive that slide, sizes and friction given."""
    pushed = []
    angles = given_chain(drive).joint_angle
    turned = np.asarray(motion(drive, found.angle).yoke_rotation)
    for i, joint in enumerate(drive.joints):
        if joint.slides and joint.rubs:
            torque = np.asarray(found.shaft_torque)[i + 1]
            fed, back = (over(row, turned[i]) for row in unit_thrust(joint, float(angles[i])))
            force = torque * np.where(torque < 0.0, back, fed)
            amplitude = harmonics(found.angle, force, count=joint.alike + 1).amplitude[joint.alike]
            most = float(np.max(np.abs(force)))
            pushed.append(Thrust(joint=i + 1, most=most, order=joint.alike, amplitude=float(amplitude)))
    return tuple(pushed)


def unit_thrust(joint: Joint, joint_angle: float) -> Array:
    """Return the force of a joint along its driven shaft, on this, for 1 N·m, array (2, `CLOSER`) [1/m].

    joint_angle [rad]. While its driving shaft drives, and while the other does; nought where nothing in it moves.
    """
    along, aside = (rubbed_push(joint, joint_angle, EVEN)[:, k] for k in (1, 2))
    found: Array = np.cos(joint_angle) * along + np.sin(joint_angle) * aside
    return found


def _pressure(one: UnitLoad, force: Array, torque: Array) -> float | None:
    """Return the largest pressure of parts under forces [N] that a torque [N·m] makes [Pa]; None without their sizes.

    Where the contact changes as the joint turns, under the largest torque at every place.
    """
    high = float(np.max(force))
    if one.area:
        return high / one.area
    if one.contact is None:
        return None
    load = high if np.ndim(one.contact.across) == 0 else one.high * float(np.max(np.abs(torque)))
    return float(np.max(point_contact(load, one.contact.across, one.contact.along).pressure))


@lru_cache(maxsize=512)
def unit_loads(joint: Joint, joint_angle: float, *, fed: bool = True) -> tuple[UnitLoad, ...]:
    """Return what the parts of a joint carry at a joint angle [rad] for 1 N·m; empty where it tells nothing.

    fed: whether the driving shaft drives; where nothing rubs it makes no difference.
    """
    if not _tells(joint):
        return ()
    mu = (joint.friction or 0.0) if joint.rubs and joint_angle >= STRAIGHT else 0.0
    if not mu and not fed:
        return unit_loads(joint, joint_angle)
    repeats = joint.alike if PLACES % joint.alike == 0 else 1
    angle = np.arange(PLACES // repeats) * (2.0 * np.pi / PLACES)
    return tuple(_loads(joint_carried(joint, joint_angle, angle, friction=mu, fed=fed, loads=True), repeats))


def _tells(joint: Joint) -> bool:
    """Return whether a joint tells the loads of its parts."""
    return any(True for _pair in joint.loaded(stance_of(joint, 0.1, np.zeros(1))))


def _loads(found: JointCarried, repeats: int) -> Iterator[UnitLoad]:
    """Yield the loads of parts with one name together."""
    reaction = found.found.reaction[:, : found.inner]
    own = found.pairs[: found.inner]
    for name in dict.fromkeys(pair.name for pair in own if pair.told):
        which = [k for k, pair in enumerate(own) if pair.name == name]
        first = own[which[0]]
        couple = frames.norm(reaction[:, which, :3])
        couple = np.where(couple > ROUNDING, couple, 0.0)
        force = frames.norm(reaction[:, which, 3:])
        rate = found.found.rate[:, which]
        slide = first.lever * frames.norm(rate[..., :3]) + frames.norm(rate[..., 3:])
        if np.isfinite(first.spread):  # two bearings share force and couple
            force, couple = 0.5 * force + couple / first.spread, 0.0 * couple
        yield UnitLoad(
            name=name,
            count=len(which),
            high=np.tile(np.max(force, axis=-1), repeats),
            low=np.tile(np.min(force, axis=-1), repeats),
            couple=np.tile(np.max(couple, axis=-1), repeats),
            contact=first.contact,
            area=first.area,
            slide=np.tile(np.max(slide, axis=-1), repeats),
        )
