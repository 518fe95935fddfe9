"""Drives with even joints whose points move: marks followed in space, and the sound of a swinging half shaft."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, articulation, motion
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.drive.duty import Duty
from cardan.drive.joints import Hooke
from cardan.drive.models.geometry import geometry
from cardan.drive.movement import Harmonic
from cardan.joints import (
    ConstantVelocity,
    DoubleCardan,
    HalfCardan,
    OffsetCross,
    PinCoupling,
    Rzeppa,
    Tracta,
    Tripod,
    Weiss,
)
from cardan.questions.motion.instants import speed_range
from cardan.questions.motion.moving_chain import law, moving_axes, moving_centres

EVEN = (Hooke(), ConstantVelocity(), ConstantVelocity())

POINTS = np.asarray([[-1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [1.0, 0.1, 0.2], [1.8, -0.1, 0.5], [2.6, 0.0, 0.3]])


def path(times):
    """Return points that swing in all directions, with exact derivatives."""
    size = 0.06 * np.sin(np.arange(15.0).reshape(5, 3) + 0.5)
    turn = 9.0 * np.asarray(times)[:, None, None] + np.arange(15.0).reshape(5, 3)
    return POINTS + size * np.sin(turn), 9.0 * size * np.cos(turn), -81.0 * size * np.sin(turn)


def marks(times, kinds=EVEN, speed=20.0):
    return moving_centres(path, times, yoke_angle=[0.3, -0.4], speed=speed, kinds=kinds)


def test_spins_are_those_of_the_marks_in_space():
    """ω = v̇·(a × v) of the driven mark, which turns with its shaft: a central difference, h² times its third rate."""
    times, step = np.linspace(0.0, 1.0, 23), 1e-6
    at, after, before = (marks(times + shift) for shift in (0.0, step, -step))
    for i in range(3):
        mark = at.spins.driven_arm[:, i]
        rate = (after.spins.driven_arm[:, i] - before.spins.driven_arm[:, i]) / (2.0 * step)
        spin = np.sum(rate * np.cross(at.shafts.axis[:, i + 1], mark), axis=-1)
        assert np.abs(spin - at.spins.spin[:, i + 1]).max() < 1e-6
        gain = (after.spins.spin[:, i + 1] - before.spins.spin[:, i + 1]) / (2.0 * step)
        assert np.abs(gain - at.spins.spin_acceleration[:, i + 1]).max() < 1e-4
    assert np.abs(np.sum(at.spins.driven_arm * at.shafts.axis[:, 1:], axis=-1)).max() < 1e-13


def test_still_axes_turn_as_in_motion():
    drive = Drive(
        joints=(
            Hooke(joint_angle=0.3),
            ConstantVelocity(joint_angle=0.4, plane_twist=0.5),
            Hooke(joint_angle=0.2, plane_twist=-0.8),
        ),
    )
    place = geometry(drive)
    still = np.zeros_like(place.axis)
    angle = np.linspace(0.0, 6.0, 13)
    across = np.cross(place.normal[0], place.axis[0])
    arms = np.cos(angle)[:, None] * across + np.sin(angle)[:, None] * place.normal[0]
    axes = tuple(np.broadcast_to(part, (13, 4, 3)) for part in (place.axis, still, still))
    found = moving_axes(axes, arms, yoke_angle=[0.0, 0.0], speed=1.0, kinds=(Hooke(), ConstantVelocity(), Hooke()))
    assert np.abs(found.spin.T - motion(drive, angle).shaft_ratio).max() < 1e-13
    assert np.abs(found.spin_acceleration.T - motion(drive, angle).shaft_slope).max() < 1e-13


def test_a_half_shaft_stays_even_but_for_the_swing_of_its_axis():
    joints = (Tripod(centre=(0.0, 0.0, 0.0)), Rzeppa(centre=(0.4, 0.0, -0.05)))
    drive = Drive.from_points([(-0.2, 0, 0), (0, 0, 0), (0.4, 0, -0.05), (0.6, 0, -0.05)])
    drive = replace(drive, joints=joints, duty=Duty(speed=60.0))
    bounce = Harmonic(moves=("joints[1]", "output"), amplitude=(0.0, 0.0, 0.06), frequency=2.0 * np.pi)
    found = articulation(drive, bounce)
    assert np.nanmax(found.speed_fluctuation) < 1e-14
    # bending in one plane only, an even joint passes on its spin exactly, however fast its axis swings
    assert np.abs(found.shaft_speed - 60.0).max() < 1e-9
    assert not any("has a joint angle" in told(text, USUAL) for text in found.warnings)


UNEVEN = [
    OffsetCross(offset=0.01, reach=0.2),
    DoubleCardan(centring_ratio=0.45),
    Tracta(driving_distance=0.03, driven_distance=0.04),
    HalfCardan(),
    Weiss(driving_offset=0.004, driven_offset=0.005, groove_radius=0.03),
    Rzeppa(lever_b=0.35, lever_c=0.6),
    PinCoupling(driving_distance=0.05, driven_distance=0.06),
]


@pytest.mark.parametrize("joint", UNEVEN, ids=lambda joint: joint.kind)
def test_spins_of_uneven_joints_are_those_of_their_marks(joint):
    """Marks stand where the law puts them; ω = v̇·(a × v) of them by a central difference."""
    kinds = (Hooke(), joint, ConstantVelocity())
    times, step = np.linspace(0.0, 0.6, 9), 1e-5
    at, after, before = (marks(times + shift, kinds) for shift in (0.0, step, -step))
    for i in range(3):
        mark = at.spins.driven_arm[:, i]
        rate = (after.spins.driven_arm[:, i] - before.spins.driven_arm[:, i]) / (2.0 * step)
        spin = np.sum(rate * np.cross(at.shafts.axis[:, i + 1], mark), axis=-1)
        assert np.abs(spin - at.spins.spin[:, i + 1]).max() < 2e-5 * 20.0
        gain = (after.spins.spin[:, i + 1] - before.spins.spin[:, i + 1]) / (2.0 * step)
        assert np.abs(gain - at.spins.spin_acceleration[:, i + 1]).max() < 2e-5 * 400.0


@pytest.mark.parametrize("joint", UNEVEN, ids=lambda joint: joint.kind)
def test_uneven_joints_at_rest_turn_as_in_motion(joint):
    drive = Drive(joints=(Hooke(joint_angle=0.3), replace(joint, joint_angle=0.35, plane_twist=0.5)))
    place = geometry(drive)
    still = np.zeros_like(place.axis)
    angle = np.linspace(0.0, 6.0, 13)
    across = np.cross(place.normal[0], place.axis[0])
    arms = np.cos(angle)[:, None] * across + np.sin(angle)[:, None] * place.normal[0]
    axes = tuple(np.broadcast_to(part, (13, 3, 3)) for part in (place.axis, still, still))
    found = moving_axes(axes, arms, yoke_angle=[0.0], speed=1.0, kinds=drive.joints)
    assert np.abs(found.spin.T - motion(drive, angle).shaft_ratio).max() < 1e-12
    assert np.abs(found.spin_acceleration.T - motion(drive, angle).shaft_slope).max() < 1e-6
    low, high = speed_range(tuple(part[:1] for part in axes), yoke_angle=[0.0], speed=1.0, kinds=drive.joints)
    ratio = motion(drive, np.linspace(0.0, 2.0 * np.pi, 1441)).ratio
    assert abs(float(np.ptp(ratio)) - float(high[0, -1] - low[0, -1])) < 0.01 * np.ptp(ratio)


@pytest.mark.slow
@pytest.mark.parametrize("joint", UNEVEN, ids=lambda joint: joint.kind)
def test_uneven_kinds_are_followed_over_a_movement(joint):
    drive = Drive.from_points([(-1, 0, 0), (0, 0, 0), (1, 0.1, 0)])
    drive = replace(drive, joints=(replace(joint, centre=(0.0, 0.0, 0.0)),), duty=Duty(speed=100.0))
    found = articulation(drive, Harmonic(moves=("output",), amplitude=(0.0, 0.05, 0.0), frequency=1.0))
    k = int(np.argmax(found.joint_angle[:, 0]))
    still = Drive(joints=(replace(joint, joint_angle=float(found.joint_angle[k, 0])),))
    ratio = motion(still, np.linspace(0.0, 2.0 * np.pi, 1441)).ratio
    assert found.speed_fluctuation[k] == pytest.approx(float(np.ptp(ratio)), rel=0.01)


def test_waves_of_a_law_are_the_law():
    joint = Weiss(driving_offset=0.004, driven_offset=0.005, groove_radius=0.03)
    theta, alpha = np.linspace(0.0, 6.0, 40), np.linspace(0.01, 0.48, 40)
    lead, ratio = law(joint, theta, alpha)
    for k in range(40):
        one = joint.deviation(theta[k : k + 1], np.asarray(alpha[k]))
        assert abs(lead[k] - one[0][0]) < 1e-13
        assert abs(ratio[k] - one[1][0]) < 1e-12
