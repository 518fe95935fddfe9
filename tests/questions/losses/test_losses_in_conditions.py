"""Losses over poses, movements and load cases: means by the time, against drives turned by hand and shares by hand."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from cardan.answers.quantity import told
from cardan.answers.reader import Reader
from cardan.drive.cross import Cross
from cardan.drive.drive import Drive
from cardan.drive.duty import Block, Case, Duty
from cardan.drive.movement import Harmonic, Hitch
from cardan.drive.settings import Pose
from cardan.questions.losses.answer import answer
from cardan.questions.losses.losses import losses
from cardan.units import deg, rpm

SPEED, KAPPA = 540 * rpm, 0.05 * 0.02 / 0.08


def rubbing(drive, **fields):
    """Return a drive with the same friction in all joints."""
    cross = Cross(span=0.08, journal=0.02)
    return replace(drive, joints=tuple(replace(one, friction=0.05, cross=cross) for one in drive.joints), **fields)


def heat_of_one_joint(joint_angle, torque, speed=SPEED):
    """Return the heat of one joint that stands still [W]; `test_losses.py` has its truth."""
    drive = rubbing(Drive.from_angles([joint_angle]))
    return losses(drive, Duty(speed=speed, torque=torque)).heat


def test_poses_and_load_cases_are_a_mean_by_share():
    pose = Pose(name="turned", share=0.2, set=(("joints[0].joint_angle_deg", 30.0),))
    cases = (
        Case(name="field", torque=300.0, speed=SPEED, share=0.75),
        Case(name="road", torque=100.0, speed=2 * SPEED, share=0.25),
        Case(name="jerk", torque=5000.0),
    )
    found = losses(rubbing(Drive.from_angles([10 * deg]), poses=(pose,), duty=Duty(speed=SPEED, cases=cases)))
    heat = [
        share * part * heat_of_one_joint(joint_angle * deg, torque, speed)
        for share, joint_angle in ((0.8, 10), (0.2, 30))
        for part, torque, speed in ((0.75, 300.0, SPEED), (0.25, 100.0, 2 * SPEED))
    ]
    assert found.heat == pytest.approx(sum(heat), rel=1e-12)
    # The output turns as fast as the input on average, and its torque is constant: what leaves is torque times speed.
    useful = 0.75 * 300.0 * SPEED + 0.25 * 100.0 * 2 * SPEED
    assert found.efficiency == pytest.approx(useful / (useful + sum(heat)), rel=1e-9)
    assert [one.name for one in found.each] == ["field", "road", "pose turned, field", "pose turned, road"]


def test_parts_of_a_duty_cycle_are_a_mean_by_share():
    parts = (Block(torque=300.0, speed=SPEED, share=0.25), Block(torque=100.0, speed=SPEED, share=0.75))
    found = losses(rubbing(Drive.from_angles([10 * deg])), Duty(blocks=parts))
    wanted = 0.25 * heat_of_one_joint(10 * deg, 300.0) + 0.75 * heat_of_one_joint(10 * deg, 100.0)
    assert found.heat == pytest.approx(wanted, rel=1e-12)


@pytest.mark.slow
def test_a_movement_is_a_mean_over_its_time():
    """One joint whose output rises as a sine: own integration over the phase of the heat at each joint angle."""
    drive = rubbing(Drive.from_points([(-1, 0, 0), (0, 0, 0), (1, 0, -0.3)]))
    swing = Harmonic(moves=("output",), amplitude=(0.0, 0.0, 0.2), frequency=2.0)
    found = losses(replace(drive, movements=(swing,), duty=Duty(speed=SPEED, torque=300.0)))

    def heat(phase):
        return heat_of_one_joint(float(np.arctan(0.3 - 0.2 * np.sin(phase))), 300.0)

    wanted = quad(heat, 0.0, 2.0 * np.pi, epsrel=1e-9)[0] / (2.0 * np.pi)
    assert found.heat == pytest.approx(wanted, rel=1e-8)
    assert found.drawn.heat == pytest.approx(heat_of_one_joint(np.arctan(0.3), 300.0), rel=1e-9)
    assert found.residual < 1e-9


def test_a_hitch_loses_more_than_as_drawn():
    """The heat of small friction is κ T ω (2/π) (2 α) per joint: first order, against the exact mean over the swing."""
    drive = rubbing(Drive.from_points([(-0.12, 0, 0), (0, 0, 0), (1, 0, -0.02), (1.15, 0, -0.02)]))
    turn = Hitch(moves=("joints[1]", "output"), pivot=(0.5, 0, 0), yaw=20 * deg, frequency=0.6)
    moving = replace(drive, movements=(turn,), duty=Duty(speed=SPEED, torque=300.0))
    found = losses(moving)
    assert found.heat > 5.0 * found.drawn.heat
    angle = 10 * deg * 2.0 / np.pi  # mean of |yaw|, half of it in each joint
    small = 2 * KAPPA * 300.0 * SPEED * 4.0 * angle / np.pi
    assert found.heat == pytest.approx(small, rel=0.06)
    said = [one.text.told(Reader()) for one in answer(moving, found).remarks if hasattr(one.text, "told")]
    assert any(text.startswith("These are means over the movement") for text in said)


def test_poses_without_shares_leave_the_worst():
    pose = Pose(name="turned", set=(("joints[0].joint_angle_deg", 30.0),))
    drive = rubbing(Drive.from_angles([10 * deg]), poses=(pose,), duty=Duty(speed=SPEED, torque=300.0))
    found = losses(drive)
    assert found.heat == pytest.approx(heat_of_one_joint(30 * deg, 300.0), rel=1e-12)
    assert "no_share" in [one.code for one in answer(drive, found).remarks]


@pytest.mark.slow
def test_poses_movements_and_cases_add_to_one_mean_and_the_hottest_is_named():
    """One joint: its heat by the closed form, integrated over the swing in either pose and under either torque."""
    low = Pose(name="low", share=0.25, set=(("output.point_mm", (1000.0, 0.0, -500.0)),))
    swing = Harmonic(moves=("output",), amplitude=(0.0, 0.0, 0.1), frequency=2.0)
    cases = (Case(name="hill", torque=900.0, share=0.4),)
    drive = rubbing(Drive.from_points([(-1, 0, 0), (0, 0, 0), (1, 0, -0.2)]))
    drive = replace(drive, poses=(low,), movements=(swing,), duty=Duty(speed=SPEED, torque=400.0, cases=cases))
    found = losses(drive)
    phase = (np.arange(64) + 0.5) * (2.0 * np.pi / 64)

    def heat(drop, torque):
        return np.mean([heat_of_one_joint(np.arctan(drop - 0.1 * np.sin(at)), torque) for at in phase])

    each = {
        (pose, torque): share * part * heat(drop, torque)
        for pose, share, drop in (("", 0.75, 0.2), ("low", 0.25, 0.5))
        for torque, part in ((400.0, 0.6), (900.0, 0.4))
    }
    assert sum(one.share for one in found.each) == pytest.approx(1.0, abs=1e-12)
    assert found.heat == pytest.approx(sum(each.values()), rel=1e-5)
    (said,) = [told(one.text, Reader()) for one in answer(drive, found).remarks if one.code == "governing_condition"]
    most = max(each, key=each.get)
    assert most == ("", 900.0)
    share = 100 * each[most] / sum(each.values())
    assert said == f"Most heat arises in this condition: hill; {share:.1f} % of it in 30.0 % of the time."
