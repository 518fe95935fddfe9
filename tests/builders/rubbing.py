"""Drives that rub: the same journals in every joint, supports, a spline that slides."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from cardan import Drive
from cardan.drive.cross import Cross
from cardan.drive.duty import Duty, Harmonic
from cardan.drive.movement import Harmonic as Swing
from cardan.drive.shaft import Shaft, Spline
from cardan.drive.support import Support
from cardan.units import deg, mm, rpm

CROSS = Cross(span=80 * mm, journal=20 * mm)
STEADY = Duty(speed=3000 * rpm, torque=200.0)


def rubbing(drive, friction=0.1, **parts):
    """Return a drive whose joints rub, κ = a quarter of the friction."""
    joints = tuple(replace(joint, friction=friction, cross=CROSS) for joint in drive.joints)
    return replace(drive, joints=joints, **parts)


def single(joint_angle=30 * deg, friction=0.1, **parts):
    return rubbing(
        Drive.from_points([[-0.4, 0, 0], [0, 0, 0], [np.cos(joint_angle), 0, -np.sin(joint_angle)]]), friction, **parts
    )


def loaded(plan, seed):
    """Return a drive with inertia, resisting torques and a torque that swings through zero."""
    random = np.random.default_rng(seed)
    shafts = tuple(
        Shaft(
            number=k + 1, yoke_angle=shaft.yoke_angle, inertia=random.uniform(0, 0.05), resisting_torque=random.normal()
        )
        for k, shaft in enumerate(plan.drive.shafts)
    )
    duty = Duty(
        speed=random.choice([-1, 1]) * random.uniform(50, 300),
        torque=random.normal() * 20,
        torque_at=random.choice(["output", "input"]),
        acceleration=random.normal() * 100,
        harmonics=(Harmonic(order=2, torque=30.0, phase=0.4), Harmonic(order=0.5, torque=5.0)),
    )
    return rubbing(plan.drive, shafts=shafts), duty


def book_layout(friction, joint_angle=30 * deg):
    """Both shafts in two bearings each, the cross free to slide along its journals: forces as in Book (106), (107)."""
    supports = tuple(
        Support(shaft=shaft, position=place, axial=place == -0.35, bore=40 * mm, friction=friction)
        for shaft, place in ((1, -0.05), (1, -0.35), (2, 0.1), (2, 0.4))
    )
    free = single(joint_angle, friction=0.0, supports=supports)
    joint = replace(free.joints[0], cross=replace(CROSS, slides=True))
    return replace(free, joints=(joint,))


TEETH = Spline(friction=0.12, mean_diameter=50 * mm, pressure_angle=30 * deg)


def sliding(spline=TEETH):
    points = [[-0.4, 0, 0], [0, 0, 0], [1, 0, 0], [1.4, 0, 0]]
    drive = rubbing(Drive.from_points(points), shafts=(Shaft(number=2, spline=spline),))
    swing = Swing(moves=("joints[1]", "output"), amplitude=(0.02, 0.0, 0.0), frequency=2 * np.pi * 3.0)
    return drive, swing
